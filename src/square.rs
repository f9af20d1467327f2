//! Squares around a point: points and billboards.
//!
//! A square of size S around (X, Y) covers the samples with X − S/2 ≤ x < X + S/2 and as many rows: the polygon's rule,
//! *ceil, half-open*. The left side is computed once, 2·X − S in 1/512 px rounded up to 1/256, the right one is S further:
//! no sample lies between the rounded side and the true one, so that coverage is exact, and the width is.
//!
//! Sides beyond ±32768 px are moved there, off every picture, and carry the values that the whole square has there.

use crate::edge::{SUBPIXELS, first_row};
use crate::num::Word;
use crate::screen::{Center, Shape, SubPx, depth_bits};
use crate::span::{Corners, Span, Spans};
use crate::varying::{Linear, Varying};
use crate::window::Window;

/// A square on the screen, at one depth; see the [module](self) and [`draw::square`](crate::draw::square).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Square<V> {
    columns: Sides,
    rows: Sides,
    depth: i32,
    /// Upper left, lower left, lower right, upper right.
    varyings: [V; 4],
}

impl<V: Copy> Square<V> {
    /// With the same values everywhere. A size below 0 counts as 0, and covers nothing.
    ///
    /// ```
    /// use fixel::{screen::{Center, FineDepth, SubPx}, square::Square};
    /// let center = Center { x: SubPx::lit("3"), y: SubPx::lit("2.5"), depth: FineDepth::ZERO };
    /// let square = Square::new(center, SubPx::lit("2"), ()); // columns 2 and 3, rows 2 and 3
    /// ```
    pub fn new(center: Center, size: SubPx, varying: V) -> Self {
        Square {
            columns: Sides::new(center.x, size),
            rows: Sides::new(center.y, size),
            depth: depth_bits(center.depth),
            varyings: [varying; 4],
        }
    }
}

impl Square<Linear<2>> {
    /// With two values that run from `from` at the left and upper side to `to` at the right and lower side, |v| ≤ 2^30:
    /// texture coordinates.
    ///
    /// The sample at column x gets from + (to − from)·(x − left)/S, with the left side as it is rounded, to one unit a column
    /// ([`Linear`]) and 2^-14 a row, and three units, so that units are best much finer than texels over the size; half a texel is added to `from` and `to` alike.
    ///
    /// ```
    /// use fixel::{screen::{Center, FineDepth, SubPx}, square::Square};
    /// let center = Center { x: SubPx::lit("30"), y: SubPx::lit("20"), depth: FineDepth::ZERO };
    /// // All of a texture, in units of 2^-28 of its sides.
    /// let billboard = Square::billboard(center, SubPx::lit("16"), [0; 2], [1 << 28; 2]);
    /// ```
    pub fn billboard(center: Center, size: SubPx, from: [i32; 2], to: [i32; 2]) -> Self {
        let ([s0, t0], [s1, t1]) = (from, to);
        let plain = Square::new(center, size, ());
        let (left, right) = plain.columns.values(s0, s1);
        let (top, bottom) = plain.rows.values(t0, t1);
        Square {
            columns: plain.columns,
            rows: plain.rows,
            depth: plain.depth,
            varyings: [[left, top], [left, bottom], [right, bottom], [right, top]].map(Linear),
        }
    }
}

impl<V> Square<V> {
    /// The rows of `window` that it covers.
    pub(crate) fn rows_on(&self, window: Window) -> core::ops::Range<i32> {
        let (top, bottom) = self.rows.samples();
        top.max(window.top)..bottom.min(window.bottom)
    }
}

impl<V> Corners for Square<V> {
    #[inline]
    fn count(&self) -> usize {
        4
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        let x = if index < 2 { self.columns.near } else { self.columns.far };
        let y = if matches!(index, 1 | 2) {
            self.rows.far
        } else {
            self.rows.near
        };
        (x, y)
    }
}

impl<V: Varying> Shape for Square<V> {
    type Varying = V;
    #[inline]
    fn depth(&self, _: usize) -> i32 {
        self.depth
    }
    #[inline]
    fn varying(&self, index: usize) -> V {
        let [a, b, c, d] = self.varyings;
        match index {
            0 => a,
            1 => b,
            2 => c,
            _ => d,
        }
    }
}

impl<V> Spans for Square<V> {
    /// Cost: nothing per row, its sides are upright.
    #[inline]
    fn each(&self, window: Window, mut draw: impl FnMut(Span)) {
        let (whole_left, whole_right) = self.columns.samples();
        let (left, right) = (whole_left.max(window.left), whole_right.min(window.right));
        if left >= right {
            return;
        }
        for row in self.rows_on(window) {
            draw(Span {
                row,
                left,
                right,
                whole_left,
                whole_right,
            });
        }
    }
}

/// The left and right, or upper and lower, side in subpixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Sides {
    /// Within the guard band.
    near: i32,
    far: i32,
    /// Where the near side really is, and how far the far one is from it.
    start: i64,
    size: i64,
}

impl Sides {
    fn new(center: SubPx, size: SubPx) -> Self {
        const LIMIT: i64 = <i64 as Word>::GUARD as i64 * SUBPIXELS as i64;
        let size = size.to_bits().max(0) as i64;
        let start = (2 * center.to_bits() as i64 - size + 1) >> 1;
        let within = |v: i64| v.clamp(-LIMIT, LIMIT) as i32;
        Sides {
            near: within(start),
            far: within(start + size),
            start,
            size,
        }
    }

    /// The first sample covered and the one after the last.
    fn samples(&self) -> (i32, i32) {
        (first_row(self.near), first_row(self.far))
    }

    /// What runs from `from` at the true near side to `to` at the far one, at the sides kept.
    fn values(&self, from: i32, to: i32) -> (i32, i32) {
        let rise = to as i64 - from as i64;
        let at = |side: i32| {
            // No `clamp`, which panics for a negative size: that there is none, not every compiler sees.
            let distance = (side as i64 - self.start).max(0).min(self.size);
            // 2^31·2^31 in the domain.
            let product = rise.saturating_mul(distance).saturating_add(self.size / 2);
            let value = from as i64 + product.checked_div_euclid(self.size).unwrap_or(0);
            value.clamp(i32::MIN as i64, i32::MAX as i64) as i32
        };
        (at(self.near), at(self.far))
    }
}
