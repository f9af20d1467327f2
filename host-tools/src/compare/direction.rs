//! Directions known to an angle. A vector of length L that is off by at most ε is turned by at most asin(ε/L), and two
//! directions at an angle θ that are turned by at most α and β are at an angle between θ - α - β and θ + α + β then: angles
//! are the metric of the sphere. So intervals of cosines are exact, at θ = 0 too, where they are narrow and powers steep.

use std::f64::consts::PI;

use super::interval::Interval;
use crate::reference::matrix::{cross, length};

/// Rounding in float64 of an angle made here, in radians.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A direction.
#[derive(Debug, Clone, Copy)]
pub struct Direction {
    unit: [f64; 3],
    /// How far it may be turned, in radians; π is any direction.
    turn: f64,
}

impl Direction {
    /// That of a vector off by at most `by`: any direction, if that is not less than the vector's length.
    pub fn of(vector: [f64; 3], by: f64) -> Self {
        let length = length(vector);
        let turn = if by < length {
            (by / length).asin() + ROUNDING
        } else {
            PI
        };
        Self {
            unit: vector.map(|c| c / length),
            turn,
        }
    }

    /// That of a vector in a box.
    pub fn within(sides: [Interval; 3]) -> Self {
        let (centre, radius) = ball(sides);
        Self::of(centre, radius)
    }

    /// Turned by at most so much more.
    #[must_use]
    pub fn turned(self, by: f64) -> Self {
        Self {
            turn: self.turn + by,
            ..self
        }
    }

    /// The direction halfway between both, and the least length of their sum. Unit vectors turned by α are off by less than α.
    pub fn halfway(&self, other: &Self) -> (Self, f64) {
        let sum = [0, 1, 2].map(|i| self.unit[i] + other.unit[i]);
        let off = self.turn + other.turn;
        (Self::of(sum, off), (length(sum) - off).max(0.0))
    }

    /// The cosine of the angle between both: as it is without turning either, and what it may be. A vector without a
    /// direction has the cosine 0, by hw2.md section 7.
    pub fn cosine(&self, other: &Self) -> (f64, Interval) {
        let (a, b) = (self.unit, other.unit);
        let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let between = length(cross(a, b)).atan2(dot);
        let off = self.turn + other.turn;
        // `min` and `max` pass over what is not a number.
        let range = Interval {
            low: (between + off).min(PI).cos(),
            high: (between - off).max(0.0).cos(),
        };
        (if dot.is_nan() { 0.0 } else { dot }, range)
    }
}

/// Centre and radius of the ball around a box.
pub fn ball(sides: [Interval; 3]) -> ([f64; 3], f64) {
    let halves = sides.map(|s| (s.high - s.low) / 2.0);
    (sides.map(|s| s.low + (s.high - s.low) / 2.0), length(halves))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cosine_is_between_those_of_the_outermost_angles() {
        let a = Direction::of([2.0, 0.0, 0.0], 0.2);
        let b = Direction::of([1.0, 1.0, 0.0], 0.0);
        let (value, range) = a.cosine(&b);
        let (low, high) = (PI / 4.0 + 0.1f64.asin(), PI / 4.0 - 0.1f64.asin());
        assert!((value - 0.5f64.sqrt()).abs() < 1e-15);
        assert!((range.low - low.cos()).abs() < 1e-14 && (range.high - high.cos()).abs() < 1e-14);
        // No vector within 0.2 of (2, 0, 0) is beyond, and the tangents reach the ends.
        let tangent = [2.0 - 0.02, 0.2 * 0.99f64.sqrt(), 0.0];
        assert!((Direction::of(tangent, 0.0).cosine(&b).0 - range.high).abs() < 1e-14);
    }

    #[test]
    fn near_0_a_cosine_changes_by_the_square_of_the_angle() {
        let a = Direction::of([0.0, 1.0, 0.0], 1e-4);
        let (_, range) = a.cosine(&a);
        assert!(range.high == 1.0 && (1.0 - range.low - 2e-8).abs() < 1e-12);
    }

    #[test]
    fn a_vector_that_may_be_0_may_point_anywhere() {
        let any = Direction::of([1e-3, 0.0, 0.0], 1e-3);
        let nothing = Direction::of([0.0; 3], 0.0);
        for direction in [any, nothing] {
            let (_, range) = direction.cosine(&Direction::of([1.0, 2.0, 3.0], 0.0));
            assert_eq!(range, Interval { low: -1.0, high: 1.0 });
        }
        assert_eq!(nothing.cosine(&any).0, 0.0);
    }
}
