//! The lights of a scene, all in one unit.

use fixel::error::Error;
use fixel::light::{self, Light, Lights, Matte};
use fixel::num::{self, Block, OneStep, Table, TwoSteps};

use super::material::Polished;
use crate::fixed::dials::Precision;

/// Suns that a scene may set.
pub const SUNS: usize = 1024;
/// Bulbs that a scene may set.
pub const BULBS: usize = 1024;

/// The core's lights, and their colours as they were given: a brighter one makes the unit of all larger.
pub struct Lamps {
    given: Vec<(Place, Block<i64, 3>)>,
    lights: AllLights,
    precision: Precision,
    shift: i32,
    bulbs: bool,
}

/// The core's lights at a precision.
enum AllLights {
    TwoSteps(Box<Lights<i64, SUNS, BULBS, TwoSteps>>),
    OneStep(Box<Lights<i64, SUNS, BULBS, OneStep>>),
    Table(Box<Lights<i64, SUNS, BULBS, Table>>),
}

impl AllLights {
    /// None.
    fn new(precision: Precision) -> Self {
        match precision {
            Precision::TwoSteps => AllLights::TwoSteps(Box::default()),
            Precision::OneStep => AllLights::OneStep(Box::default()),
            Precision::Table => AllLights::Table(Box::default()),
        }
    }

    fn add(&mut self, light: Light<i64>) -> Result<(), Error> {
        match self {
            AllLights::TwoSteps(lights) => lights.add(light),
            AllLights::OneStep(lights) => lights.add(light),
            AllLights::Table(lights) => lights.add(light),
        }
    }

    fn at_scale(&self, exponent: i32) -> Lit<'_> {
        match self {
            AllLights::TwoSteps(lights) => Lit::TwoSteps(lights.at_scale(exponent)),
            AllLights::OneStep(lights) => Lit::OneStep(lights.at_scale(exponent)),
            AllLights::Table(lights) => Lit::Table(lights.at_scale(exponent)),
        }
    }
}

/// The core's lights for places at one scale. Which precision, and whether there are highlights, is told when a pixel is lit:
/// that is little beside its light, and fragment programs are compiled once for all.
pub enum Lit<'a> {
    /// At the precision of exact.
    TwoSteps(light::Lit<'a, BULBS, TwoSteps>),
    /// At that of balanced.
    OneStep(light::Lit<'a, BULBS, OneStep>),
    /// At that of fast.
    Table(light::Lit<'a, BULBS, Table>),
}

impl Lit<'_> {
    /// See [`light::Lit::shade_wide`]; `polish` for highlights.
    pub fn shade(
        &self,
        normal: [i32; 3],
        position: [i32; 3],
        surface: [i32; 3],
        polish: Option<&Polished>,
    ) -> [i64; 3] {
        match self {
            Lit::TwoSteps(lit) => shade(lit, normal, position, surface, polish),
            Lit::OneStep(lit) => shade(lit, normal, position, surface, polish),
            Lit::Table(lit) => shade(lit, normal, position, surface, polish),
        }
    }
}

fn shade<P: num::Precision>(
    lit: &light::Lit<'_, BULBS, P>,
    normal: [i32; 3],
    position: [i32; 3],
    surface: [i32; 3],
    polish: Option<&Polished>,
) -> [i64; 3] {
    match polish {
        Some(polished) => lit.shade_wide(normal, position, surface, polished),
        None => lit.shade_wide(normal, position, surface, &Matte),
    }
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
    /// None, for light at a precision.
    pub fn new(precision: Precision) -> Self {
        Lamps {
            given: Vec::new(),
            lights: AllLights::new(precision),
            precision,
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
        self.lights = AllLights::new(self.precision);
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
        self.given.is_empty()
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
    at: Option<(i32, Lit<'a>)>,
}

impl<'a> AtScale<'a> {
    /// At no scale.
    pub fn lamps(&self) -> &'a Lamps {
        self.lamps
    }

    /// For places in units of 2^`exponent`.
    pub fn lit(&mut self, exponent: i32) -> &Lit<'a> {
        if self.at.as_ref().is_some_and(|(last, _)| *last != exponent) {
            self.at = None;
        }
        let fresh = || (exponent, self.lamps.lights.at_scale(exponent));
        &self.at.get_or_insert_with(fresh).1
    }
}
