//! The texels that a coordinate known to an interval may pick.

use super::interval::Interval;
use super::linear::Range;
use super::stated::TEXEL_NUDGE;
use crate::picture::Picture;

/// Columns and rows of a texture.
pub struct Texels<'a> {
    texture: &'a Picture,
    axes: [Axis; 2],
}

/// Indices along one side of a texture, before wrapping.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Axis {
    first: i64,
    count: i64,
    /// The reference's own, wrapped; none if its coordinate lies so near a border that it may have either.
    own: Option<i64>,
    size: i64,
}

impl Axis {
    /// x + ½ made whole, of the coordinates x and of the one that the reference has, which is known to an interval too.
    fn new(own: Interval, coordinates: Interval, size: u32, round: fn(f64) -> f64) -> Self {
        let whole = |s: f64| round(s * f64::from(size) + 0.5);
        let (first, last) = (whole(coordinates.low), whole(coordinates.high));
        let size = i64::from(size);
        let many = last - first + 1.0;
        let some = many < size as f64;
        Self {
            first: if some { first.rem_euclid(size as f64) as i64 } else { 0 },
            count: if some { many as i64 } else { size },
            own: (whole(own.low) == whole(own.high)).then(|| whole(own.low).rem_euclid(size as f64) as i64),
            size,
        }
    }

    fn indices(self) -> impl Iterator<Item = i64> {
        (0..self.count).map(move |i| (self.first + i).rem_euclid(self.size))
    }
}

impl<'a> Texels<'a> {
    /// Those that the coordinates s and t may pick, with an error of the larger of both in units of the texture before they are
    /// interpolated: the core has them in texels, in a common unit. The reference's own are `noise` from the ranges' values at the
    /// most. A coordinate x picks the texel `round`(x + ½).
    pub fn new(texture: &'a Picture, coordinates: &Range<2>, [error, noise]: [f64; 2], round: fn(f64) -> f64) -> Self {
        let longer = f64::from(texture.width.max(texture.height));
        let axis = |i: usize, size: u32| {
            let may_be = coordinates.full[i].widened((error * longer + TEXEL_NUDGE) / f64::from(size));
            Axis::new(Interval::around(coordinates.value[i], noise), may_be, size, round)
        };
        let axes = [axis(0, texture.width), axis(1, texture.height)];
        Self { texture, axes }
    }

    /// Every one with its colour, and whether it is certainly the one that the reference picks.
    pub fn all(&self) -> impl Iterator<Item = ([u8; 4], bool)> {
        let [columns, rows] = self.axes;
        let width = self.texture.width as usize;
        let row = move |j: i64| {
            columns.indices().map(move |i| {
                let texel = self.texture.pixels[j as usize * width + i as usize];
                (texel, columns.own == Some(i) && rows.own == Some(j))
            })
        };
        rows.indices().flat_map(row)
    }
}

/// The decal rule: rgb·α + colour·(1 - α). The core's own error of it is one unit of 2⁻¹⁶ level, which the caller adds.
pub fn blended([r, g, b, alpha]: [u8; 4], color: &Range<3>) -> Range<3> {
    let alpha = f64::from(alpha) / 255.0;
    let rgb = [r, g, b].map(|level| f64::from(level) / 255.0 * alpha);
    let below = |i: usize, c: Interval| {
        let rest = 1.0 - alpha;
        c.times(Interval::around(rest, 0.0)).plus(Interval::around(rgb[i], 0.0))
    };
    let value = [0, 1, 2].map(|i| rgb[i] + color.value[i] * (1.0 - alpha));
    let moved = [0, 1, 2].map(|i| below(i, color.moved[i]));
    Range {
        value,
        moved,
        full: [0, 1, 2].map(|i| below(i, color.full[i])),
    }
}
