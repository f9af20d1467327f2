//! Which settings are worth having: those that nothing beats both in cost and in error.

use super::{Point, Sweep, Unit};

/// Which points no other one beats: as cheap, with as small a mean error, and better in one of the two.
pub fn pareto(points: &[Point]) -> Vec<bool> {
    let beaten = |p: &Point| {
        points.iter().any(|q| {
            let (cost, mean) = (q.cost <= p.cost, q.errors.mean <= p.errors.mean);
            cost && mean && (q.cost < p.cost || q.errors.mean < p.errors.mean)
        })
    };
    points.iter().map(|point| !beaten(point)).collect()
}

/// What a user can afford.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Budget {
    /// Levels of 255 that 99.9 % of the pixels must not exceed.
    pub max_error: Option<u8>,
    /// Instructions per drawn pixel, everything that is done once per vertex or triangle included.
    pub max_instructions: Option<f64>,
}

impl Budget {
    /// Whether nothing is asked for.
    pub fn is_open(&self) -> bool {
        self.max_error.is_none() && self.max_instructions.is_none()
    }

    fn allows(&self, point: &Point, sweep: &Sweep) -> bool {
        let near = self.max_error.is_none_or(|most| point.errors.p999 <= most);
        let cheap = self
            .max_instructions
            .is_none_or(|most| sweep.unit == Unit::Instructions && sweep.per_pixel(point) <= most);
        near && cheap
    }
}

impl Sweep {
    /// A point's cost for each pixel drawn.
    pub fn per_pixel(&self, point: &Point) -> f64 {
        point.cost / self.pixels.max(1) as f64
    }
}

/// The best point within a budget: the cheapest where an error is allowed, else the one with the smallest mean error.
pub fn recommended<'s>(sweep: &'s Sweep, budget: &Budget) -> Option<&'s Point> {
    let within = sweep.points.iter().filter(|point| budget.allows(point, sweep));
    let key = |point: &Point| {
        let (cost, mean) = (point.cost, point.errors.mean);
        if budget.max_error.is_some() {
            [cost, mean]
        } else {
            [mean, cost]
        }
    };
    within.min_by(|a, b| {
        let ([a0, a1], [b0, b1]) = (key(a), key(b));
        a0.total_cmp(&b0).then(a1.total_cmp(&b1))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::Errors;

    fn point(name: &str, cost: f64, mean: f64, p999: u8) -> Point {
        Point {
            name: name.to_owned(),
            errors: Errors {
                mean,
                p999,
                ..Errors::default()
            },
            cost,
            pareto: false,
        }
    }

    fn four() -> Sweep {
        Sweep {
            scene: String::new(),
            size: (10, 10),
            pixels: 10,
            unit: Unit::Instructions,
            points: vec![
                point("near", 900.0, 0.0, 1),
                point("middle", 500.0, 1.0, 3),
                point("beaten", 500.0, 1.5, 3),
                point("cheap", 100.0, 9.0, 40),
            ],
        }
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        assert_eq!(pareto(&four().points), [true, true, false, true]);
        let twins = [point("a", 1.0, 1.0, 0), point("b", 1.0, 1.0, 0)];
        assert_eq!(pareto(&twins), [true, true]);
    }

    #[test]
    fn a_budget_is_kept() {
        let sweep = four();
        let best = |max_error, max_instructions| {
            let budget = Budget {
                max_error,
                max_instructions,
            };
            recommended(&sweep, &budget).map(|point| point.name.as_str())
        };
        assert_eq!(best(Some(2), None), Some("near"));
        assert_eq!(best(Some(3), None), Some("middle"));
        assert_eq!(best(Some(255), None), Some("cheap"));
        assert_eq!(best(Some(0), None), None);
        assert_eq!(best(None, Some(1000.0)), Some("near"));
        assert_eq!(best(None, Some(50.0)), Some("middle"));
        assert_eq!(best(None, Some(9.0)), None);
        assert_eq!(best(Some(2), Some(50.0)), None);
    }
}
