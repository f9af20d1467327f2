//! The measured points, and which of them no other one beats.

use serde_json::{Value, json};

use super::error::Errors;

/// Machines whose instructions are counted, and what people call them.
pub const MACHINES: [(&str, &str); 3] = [("m4", "Cortex-M4"), ("m0", "Cortex-M0 code"), ("riscv", "RV32IMC")];

/// A scene drawn in one way.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The tier, or what is turned of the exact one.
    pub dial: String,
    /// Of a frame, machine by machine.
    pub instructions: [f64; MACHINES.len()],
    /// Against float64.
    pub errors: Errors,
}

/// All points of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Which scene.
    pub scene: String,
    /// Pixels that float64 covers.
    pub pixels: f64,
    /// In the order of the program.
    pub points: Vec<Point>,
}

impl Sweep {
    /// Whether nothing is as cheap on a machine, with as small a mean error, and better in one of the two.
    pub fn is_on_front(&self, point: &Point, machine: usize) -> bool {
        let key = |p: &Point| (p.instructions[machine], p.errors.mean);
        let (cost, error) = key(point);
        let beats = |other: &Point| {
            let (c, e) = key(other);
            c <= cost && e <= error && (c < cost || e < error)
        };
        !self.points.iter().any(beats)
    }

    /// The point of a tier or dial.
    pub fn point(&self, dial: &str) -> Option<&Point> {
        self.points.iter().find(|point| point.dial == dial)
    }

    /// Instructions for each pixel covered, all that is done once a frame, vertex or triangle included.
    pub fn per_pixel(&self, point: &Point, machine: usize) -> f64 {
        point.instructions[machine] / self.pixels
    }

    /// As it is stored.
    pub fn to_json(&self) -> Value {
        let point = |point: &Point| {
            let Errors {
                max,
                p999,
                mean,
                differing,
            } = point.errors;
            let mut value = json!({
                "dial": point.dial,
                "max_error": rounded(max),
                "p999_error": rounded(p999),
                "mean_error": rounded(mean),
                "differing_share": rounded(differing),
            });
            for ((machine, _), count) in MACHINES.iter().zip(point.instructions) {
                value[*machine] = (count as u64).into();
            }
            value
        };
        json!({
            "scene": self.scene,
            "pixels": self.pixels as u64,
            "points": self.points.iter().map(point).collect::<Vec<_>>(),
        })
    }

    /// From what is stored.
    pub fn from_json(value: &Value) -> Option<Self> {
        let point = |value: &Value| {
            let number = |key: &str| value[key].as_f64();
            let mut instructions = [0.0; MACHINES.len()];
            for (count, (machine, _)) in instructions.iter_mut().zip(MACHINES) {
                *count = number(machine)?;
            }
            Some(Point {
                dial: value["dial"].as_str()?.into(),
                instructions,
                errors: Errors {
                    max: number("max_error")?,
                    p999: number("p999_error")?,
                    mean: number("mean_error")?,
                    differing: number("differing_share")?,
                },
            })
        };
        Some(Sweep {
            scene: value["scene"].as_str()?.into(),
            pixels: value["pixels"].as_f64()?,
            points: value["points"].as_array()?.iter().map(point).collect::<Option<_>>()?,
        })
    }
}

/// To a millionth.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

#[cfg(test)]
pub mod tests {
    use super::*;

    pub fn point(dial: &str, cost: f64, mean: f64) -> Point {
        Point {
            dial: dial.into(),
            instructions: [cost, 2.0 * cost, cost],
            errors: Errors {
                max: 4.0 * mean,
                p999: 3.0 * mean,
                mean,
                differing: 0.25,
            },
        }
    }

    pub fn sweep(points: Vec<Point>) -> Sweep {
        Sweep {
            scene: "lit".into(),
            pixels: 100.0,
            points,
        }
    }

    #[test]
    fn what_is_beaten_is_not_on_the_front() {
        let sweep = sweep(vec![
            point("fast", 10.0, 2.0),
            point("worse", 10.0, 2.5),
            point("dearer", 11.0, 2.0),
            point("exact", 30.0, 0.5),
            point("twin", 30.0, 0.5),
        ]);
        let front: Vec<_> = sweep.points.iter().map(|point| sweep.is_on_front(point, 1)).collect();
        assert_eq!(front, [true, false, false, true, true]);
    }

    #[test]
    fn what_is_stored_is_read() {
        let sweep = sweep(vec![point("fast", 10.0, 2.0)]);
        assert_eq!(Sweep::from_json(&sweep.to_json()), Some(sweep));
        assert_eq!(Sweep::from_json(&json!({"scene": "lit"})), None);
    }
}
