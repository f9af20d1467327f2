//! The lighting function of formats/iv.md in interval arithmetic. Every step is monotone or a cosine, so that the intervals hold
//! whatever values lie inside. The core's own errors, as `fixel::light::world` states them, come on top.

use crate::compare::direction::{Direction, ball};
use crate::compare::interval::Interval;
use crate::compare::stated::{COSINE, EXPONENT, LIGHT_COLOR, POWER, WORLD_HALFWAY, WORLD_UNIT};
use crate::scene::iv::{Light, Material};

/// Where a point is and how it is turned.
pub struct Place {
    /// Its normal.
    pub normal: Direction,
    /// Its position in the world.
    pub at: [Interval; 3],
    /// By how much lights and eye may be off, beside it.
    pub unit: f64,
}

/// What lights a surface.
pub struct Lighting {
    /// The surface.
    pub material: Material,
    /// The lights.
    pub lights: Vec<Light>,
    /// Where the eye is.
    pub eye: [f64; 3],
}

impl Lighting {
    /// What the colour at a place may be, without the core's errors or with them.
    pub fn color(&self, place: &Place, core: bool) -> [Interval; 3] {
        let error = |error: f64| if core { error } else { 0.0 };
        let mut diffuse = [Interval::ZERO; 3];
        let mut specular = [Interval::ZERO; 3];
        let to_eye = towards(self.eye, place, error(place.unit));
        let shines = self.material.specular != [0.0; 3];
        for light in &self.lights {
            let towards = towards(light.location, place, error(place.unit));
            let cosine = place.normal.cosine(&towards).1.widened(error(COSINE));
            let strength = if shines {
                self.strength(place, &towards, &to_eye, core)
            } else {
                Interval::ZERO
            };
            let brightest = light.color.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
            for (i, c) in light.color.into_iter().enumerate() {
                let color = Interval::around(c, error(LIGHT_COLOR * brightest));
                diffuse[i] = diffuse[i].plus(positive(color.times(cosine)));
                specular[i] = specular[i].plus(positive(color.times(strength)));
            }
        }
        let Material {
            ambient: a,
            diffuse: d,
            specular: s,
            ..
        } = &self.material;
        [0, 1, 2].map(|i| {
            let [a, d, s] = [a[i], d[i], s[i]].map(|c| Interval::around(c, error(WORLD_UNIT)));
            let sum = a.plus(at_most_1(diffuse[i]).times(d)).plus(specular[i].times(s));
            at_most_1(sum.widened(error(WORLD_UNIT)))
        })
    }

    /// max(0, n·h)^shininess with h halfway between a light and the eye.
    fn strength(&self, place: &Place, towards: &Direction, to_eye: &Direction, core: bool) -> Interval {
        let (half, length) = towards.halfway(to_eye);
        let base = place.normal.cosine(&half).1;
        let shininess = self.material.shininess;
        if !core {
            return base.powered(Interval::around(shininess, 0.0));
        }
        // An exponent of 0 is exact.
        let exponent = Interval::around(shininess, if shininess > 0.0 { EXPONENT } else { 0.0 });
        let base = base.widened(COSINE + WORLD_HALFWAY / length);
        base.powered(exponent).widened(POWER)
    }
}

/// The direction from a place to a point.
fn towards(point: [f64; 3], place: &Place, error: f64) -> Direction {
    let (centre, radius) = ball(place.at);
    let vector = [0, 1, 2].map(|i| point[i] - centre[i]);
    Direction::of(vector, radius + error)
}

fn positive(range: Interval) -> Interval {
    Interval {
        low: range.low.max(0.0),
        high: range.high.max(0.0),
    }
}

fn at_most_1(range: Interval) -> Interval {
    Interval {
        low: range.low.min(1.0),
        high: range.high.min(1.0),
    }
}
