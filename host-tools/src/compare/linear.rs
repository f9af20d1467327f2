//! Functions linear on the screen through a triangle's corners.

use super::interval::Interval;
use super::stated::GRADIENT;
use crate::reference::log::Corner;

/// A function linear on the screen.
#[derive(Debug, Clone, Copy)]
pub struct Linear {
    origin: [f64; 2],
    value: f64,
    /// Its gradient per px.
    pub gradient: [f64; 2],
}

impl Linear {
    /// Its value at a point.
    pub fn at(&self, p: [f64; 2]) -> f64 {
        self.value + self.gradient[0] * (p[0] - self.origin[0]) + self.gradient[1] * (p[1] - self.origin[1])
    }

    /// What the core's relative error of gradients adds up to over the extents of a polygon.
    pub fn swing(&self, extents: [f64; 2]) -> f64 {
        GRADIENT * (self.gradient[0].abs() * extents[0] + self.gradient[1].abs() * extents[1])
    }

    /// The gradient's length.
    pub fn slope(&self) -> f64 {
        self.gradient[0].hypot(self.gradient[1])
    }
}

/// A triangle's corners, ready to lay functions through them.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// Which corner comes first, second and third: by distance from the picture's centre.
    order: [usize; 3],
    origin: [f64; 2],
    /// The second and the third corner from the first.
    sides: [[f64; 2]; 2],
    area: f64,
    /// Rounding of these functions in float64, relative to the largest corner value.
    pub noise: f64,
}

impl Frame {
    /// None if the triangle has no area that float64 can tell.
    pub fn through(corners: &[Corner; 3], size: [f64; 2]) -> Option<Self> {
        let distance = |&i: &usize| {
            let [x, y] = corners[i].position;
            (x - size[0] / 2.0).hypot(y - size[1] / 2.0)
        };
        // From the corner nearest to the screen, so that rounding grows with the distance from there.
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let origin = corners[order[0]].position;
        let sides = [1, 2].map(|k| [0, 1].map(|i| corners[order[k]].position[i] - origin[i]));
        let [a, b] = sides;
        let area = a[0] * b[1] - a[1] * b[0];
        let noise = 4.0 * f64::EPSILON * a[0].hypot(a[1]) * b[0].hypot(b[1]) / area.abs();
        let known = noise <= 1e-3;
        known.then_some(Self {
            order,
            origin,
            sides,
            area,
            noise,
        })
    }

    /// The function with these values at the corners.
    pub fn linear(&self, values: [f64; 3]) -> Linear {
        let [value, second, third] = self.order.map(|i| values[i]);
        let ([a, b], area) = (self.sides, self.area);
        let (da, db) = (second - value, third - value);
        Linear {
            origin: self.origin,
            value,
            gradient: [(da * b[1] - db * a[1]) / area, (db * a[0] - da * b[0]) / area],
        }
    }
}

/// What N values may be at a sample.
#[derive(Debug, Clone, Copy)]
pub struct Range<const N: usize> {
    /// As the reference has them; not a number where that is not known.
    pub value: [f64; N],
    /// Where moving the corners by δ may take them.
    pub moved: [Interval; N],
    /// What the core's own arithmetic may make of that.
    pub full: [Interval; N],
}

impl<const N: usize> Range<N> {
    /// Values that do not change over the primitive, and the core's error of them.
    pub fn constant(value: [f64; N], error: f64) -> Self {
        Self {
            value,
            moved: value.map(|v| Interval::around(v, 0.0)),
            full: value.map(|v| Interval::around(v, error)),
        }
    }
}
