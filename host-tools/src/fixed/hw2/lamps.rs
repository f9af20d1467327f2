//! The lights of a scene, all in one unit.

use fixel::light::{Light, Lights, Lit};
use fixel::num::Block;

/// Suns that a scene may set.
pub const SUNS: usize = 1024;
/// Bulbs that a scene may set.
pub const BULBS: usize = 1024;

/// The core's lights, and their colours as they were given: a brighter one makes the unit of all larger.
pub struct Lamps {
    given: Vec<(Place, Block<i64, 3>)>,
    lights: Box<Lights<i64, SUNS, BULBS>>,
    shift: i32,
    bulbs: bool,
}

/// Where a light is.
#[derive(Debug, Clone, Copy)]
pub enum Place {
    /// Infinitely far, in this direction of length 1 in units of 2^-30, or 0 for a light that shines nowhere.
    Sun([i32; 3]),
    /// At this point.
    Bulb(Block<i64, 3>),
}

impl Lamps {
    /// None.
    pub fn new() -> Self {
        Lamps {
            given: Vec::new(),
            lights: Box::default(),
            shift: 0,
            bulbs: false,
        }
    }

    /// One light more.
    ///
    /// # Errors
    /// Where there is no room for it.
    pub fn add(&mut self, place: Place, color: Block<i64, 3>) -> Result<(), String> {
        self.given.push((place, color));
        self.bulbs |= matches!(place, Place::Bulb(_));
        let exponents = self
            .given
            .iter()
            .filter(|(_, c)| !c.is_zero())
            .map(|(_, c)| c.exponent());
        // At most 2^(62 + exponent) of full, which is to be 2^30 units of 2^(shift − 16) of full.
        self.shift = exponents.max().unwrap_or(0).saturating_add(48);
        *self.lights = Lights::default();
        for &(place, color) in &self.given {
            let light = self.light(place, color);
            let full = |_| match place {
                Place::Sun(_) => format!("more than {SUNS} lights of sunlight"),
                Place::Bulb(_) => format!("more than {BULBS} lights of bulb"),
            };
            self.lights.add(light).map_err(full)?;
        }
        Ok(())
    }

    /// The core's lights, in the order in which they were given.
    pub fn all(&self) -> Vec<Light<i64>> {
        let light = |&(place, color)| self.light(place, color);
        self.given.iter().map(light).collect()
    }

    fn light(&self, place: Place, color: Block<i64, 3>) -> Light<i64> {
        let color = color
            .scaled(self.shift.saturating_neg())
            .split()
            .map(|c| c.to_fixed(16) as i32);
        match place {
            Place::Sun(direction) => Light::Sun { direction, color },
            Place::Bulb(position) => Light::Bulb { position, color },
        }
    }

    /// Whether surfaces show their own colours.
    pub fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// Whether light depends on the place, if only by bulbs.
    pub fn has_bulbs(&self) -> bool {
        self.bulbs
    }

    /// Colours of lights are in units of 2^(shift − 16) of full.
    pub fn shift(&self) -> i32 {
        self.shift
    }

    /// For one triangle, or for all of a patch.
    pub fn scaled(&self) -> AtScale<'_> {
        AtScale { lamps: self, at: None }
    }
}

/// Lights at the scale that was asked for last: most triangles of a patch share one.
pub struct AtScale<'a> {
    lamps: &'a Lamps,
    at: Option<(i32, Lit<'a, BULBS>)>,
}

impl<'a> AtScale<'a> {
    /// At no scale.
    pub fn lamps(&self) -> &'a Lamps {
        self.lamps
    }

    /// For places in units of 2^`exponent`.
    pub fn lit(&mut self, exponent: i32) -> &Lit<'a, BULBS> {
        if self.at.as_ref().is_some_and(|(last, _)| *last != exponent) {
            self.at = None;
        }
        let fresh = || (exponent, self.lamps.lights.at_scale(exponent));
        &self.at.get_or_insert_with(fresh).1
    }
}
