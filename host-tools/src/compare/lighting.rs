//! What light may make of a fragment whose normal and eye position are known to intervals: formats/hw2.md section 7 in
//! interval arithmetic. Every step is monotone or a cosine, so that the intervals hold whatever values lie inside.
//!
//! The core's own errors, as `fixel::light` states them, come on top ([`Errors::Core`]): of c, of k = n·h, of the
//! power, of the light's colour. A light that may be on or off gives two sums, as the highlight jumps there.

use super::direction::{Direction, ball};
use super::interval::Interval;
use super::stated::{COSINE, EXPONENT, FAR_BULB, HALFWAY, LIGHT_COLOR, POWER, UNIT_VECTOR};
use crate::reference::material::{Light, Source};

/// Where a fragment is and how it is turned.
pub struct Place {
    /// Its normal.
    pub normal: Direction,
    /// Its eye position.
    pub eye: [Interval; 3],
    /// Half the diagonal of a unit of eye positions at least: bulbs are rounded to it.
    pub unit: f64,
    /// The specular exponent; no highlight at 0 and below.
    pub shininess: f64,
}

/// Whose errors count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Errors {
    /// None: the light of an exact machine.
    None,
    /// Those of the core.
    Core,
}

/// What the lights add up to: the fragment's colour is `diffuse` times its surface's plus `specular`.
#[derive(Debug, Clone, Copy)]
pub struct Sum {
    diffuse: [Interval; 3],
    specular: [Interval; 3],
}

/// More uncertain lights than this many doublings are taken for partly on.
const DOUBLINGS: usize = 16;

impl Sum {
    const DARK: Self = Self {
        diffuse: [Interval::ZERO; 3],
        specular: [Interval::ZERO; 3],
    };

    /// The fragment's colour, given its surface's.
    pub fn color(&self, surface: [Interval; 3]) -> [Interval; 3] {
        [0, 1, 2].map(|i| surface[i].times(self.diffuse[i]).plus(self.specular[i]))
    }

    fn add(&mut self, color: [Interval; 3], cosine: Interval, strength: Interval) {
        for (i, light) in color.into_iter().enumerate() {
            self.diffuse[i] = self.diffuse[i].plus(light.times(cosine));
            self.specular[i] = self.specular[i].plus(light.times(strength));
        }
    }
}

/// One light at one fragment.
struct Share {
    /// Its colour.
    color: [Interval; 3],
    /// max(0, n·l).
    cosine: Interval,
    /// max(0, n·h)^a.
    strength: Interval,
    /// Whether n·l > 0 without any error.
    on: bool,
    /// Whether n·l may be on the other side of 0, and that makes a difference.
    uncertain: bool,
}

/// All that the lights may add up to. In the first sum every light is on or off as it is without any error; the others
/// switch those that may be switched otherwise.
pub fn sums(lights: &[Light], place: &Place, errors: Errors) -> Vec<Sum> {
    let mut sums = vec![Sum::DARK];
    let brightest = brightest(lights);
    for light in lights.iter().filter(|light| light.source != Source::Sun([0.0; 3])) {
        let share = Share::new(light, place, errors, brightest);
        let strength = |on: bool| if on { share.strength } else { Interval::ZERO };
        let mut switched = Vec::new();
        if share.uncertain && sums.len() < DOUBLINGS {
            switched = sums.clone();
        }
        for (i, sum) in sums.iter_mut().enumerate() {
            let either = share.uncertain && switched.is_empty() && i > 0;
            let strength = if either {
                share.strength.join(Interval::ZERO)
            } else {
                strength(share.on)
            };
            sum.add(share.color, share.cosine, strength);
        }
        for sum in &mut switched {
            sum.add(share.color, share.cosine, strength(!share.on));
        }
        sums.append(&mut switched);
    }
    sums
}

/// The largest channel of all lights.
pub fn brightest(lights: &[Light]) -> f64 {
    lights.iter().flat_map(|l| l.color).map(f64::abs).fold(0.0, f64::max)
}

impl Share {
    fn new(light: &Light, place: &Place, errors: Errors, brightest: f64) -> Self {
        let core = |error: f64| if errors == Errors::Core { error } else { 0.0 };
        let towards = towards(light, place, errors);
        let (value, range) = place.normal.cosine(&towards);
        let cosine = range.widened(core(COSINE));
        let (on, shiny) = (value > 0.0, place.shininess > 0.0);
        let unit = Interval {
            low: 0.0,
            high: 1.0 + core(COSINE),
        };
        Self {
            color: light.color.map(|c| Interval::around(c, core(LIGHT_COLOR * brightest))),
            cosine: cosine.clamped(unit),
            strength: if shiny {
                strength(&towards, place, errors)
            } else {
                Interval::ZERO
            },
            on,
            uncertain: shiny && errors == Errors::Core && cosine.low <= 0.0 && cosine.high > 0.0,
        }
    }
}

/// The direction to a light.
fn towards(light: &Light, place: &Place, errors: Errors) -> Direction {
    let core = |error: f64| if errors == Errors::Core { error } else { 0.0 };
    match light.source {
        Source::Sun(direction) => Direction::of(direction, core(light.error + UNIT_VECTOR)),
        Source::Bulb(position) => {
            let (centre, radius) = ball(place.eye);
            let to_light = [0, 1, 2].map(|i| position[i] - centre[i]);
            Direction::of(to_light, radius + core(light.error + place.unit)).turned(core(FAR_BULB))
        }
    }
}

/// max(0, n·h)^a with h halfway between the light and the eye, which is the origin.
fn strength(towards: &Direction, place: &Place, errors: Errors) -> Interval {
    let (centre, radius) = ball(place.eye);
    let to_eye = Direction::of(centre.map(|c| -c), radius);
    let (half, length) = towards.halfway(&to_eye);
    let base = place.normal.cosine(&half).1;
    if errors == Errors::None {
        return base.powered(Interval::around(place.shininess, 0.0));
    }
    let base = base.widened(COSINE + HALFWAY / length);
    base.powered(Interval::around(place.shininess, EXPONENT)).widened(POWER)
}
