//! Values that are linear over a triangle, in 32-bit words: the cheap way for triangles of a usual shape and size.
//!
//! Every value of a pixel is a·λ_a + b·λ_b + c·λ_c, and the weights λ are the same for all that a triangle carries. So the
//! triangle computes once what one column and one row add to λ_b and λ_c ([`Weights`]), and a value costs two products for
//! each of its three numbers ([`Slope`]). From there on everything is addition modulo 2^32, whose order does not matter:
//! a strip or tile has the bits of the whole picture, and nothing is clamped.
//!
//! **Error.** Weights are in units of 2^-(32 − up) per pixel, to 2^-29 of the largest, with `up` the least that keeps them
//! below 2^30: 0 where the triangle is 4 px high in every direction, one more for each halving of that. A step is cut to
//! 2^up units of its value, and by the weights' cut to as much again where the value uses all of 31 bits; the value at the
//! anchor is less than a column and a row from the first corner, and off by no more than those. [`Weights`] exist where rows
//! and columns of the triangle's box together are at most 1024 >> up, those two among them. A step is off by 4 times 2^up units or
//! less, of 23 bits by little more than one. So a value of 31 bits is within 2^12 units, an eighth of a step of depth, and one of
//! 23 bits (a channel of RGB565 in 2^-16 level) within 1100 units (`tests/narrow.rs`, `tests/bounds.rs`). Whoever uses slopes leaves that much room at both ends of his range.

use core::convert::Infallible;

use crate::edge::{SUBPIXEL_BITS, SUBPIXELS};
use crate::fragment::Fragment;
use crate::gradient::Ramp;
use crate::num::{high, high_sum, near_reciprocal, product, short_sum, sum_of_parts, sum_of_signed_parts};
use crate::span::Span;
use crate::varying::Varying;

/// Rows and columns of the largest box, times 2^up.
const REACH: u32 = 1024;
/// The thinnest triangle: 1/32 px high, of a few columns.
const MOST_UP: u32 = 7;

/// `up` of all small triangles: below 16 columns and rows, they have no more than 1024 >> 5 of both.
pub(crate) const SMALL_UP: u32 = 5;

/// What a triangle's pixels add to the weights of its second and third corner; see the [module](self).
#[derive(Debug, Clone, Copy, Default)]
pub struct Weights {
    /// The anchor: the pixel that the first corner is in.
    pixel: (i32, i32),
    /// At the anchor pixel.
    anchor: (i32, i32),
    /// Per column.
    x: (i32, i32),
    /// Per row.
    y: (i32, i32),
    up: u32,
    /// As `up`, of the anchor.
    anchor_up: u32,
}

impl Weights {
    /// Of a triangle on the screen, in subpixels; `None` where it is too large or too thin, or has no area.
    ///
    /// ```
    /// use fixel::{gradient::Ramp, slope::Weights};
    /// let weights = Weights::new([(0, 0), (0, 1024), (1024, 0)]).unwrap();
    /// // In units of 2^-16: 0 at (0, 0), 4 at (0, 4) and 8 at (4, 0).
    /// let slope = weights.slope([0, 4 << 16, 8 << 16]);
    /// let at = |x, y| slope.ramp((x, y)).value;
    /// assert!(at(0, 0).abs() <= 8 && (at(2, 1) - (5 << 16)).abs() <= 8);
    /// ```
    #[inline]
    pub fn new(corners: [(i32, i32); 3]) -> Option<Self> {
        let (weights, whole) = Self::of(&corners);
        whole.then_some(weights)
    }

    /// What [`new`](Self::new) gives, and whether it gives any.
    ///
    /// A function of its own: the same for all that is drawn. No option, which would be copied.
    #[inline(never)]
    pub(crate) fn of(&[corner, b, c]: &[(i32, i32); 3]) -> (Self, bool) {
        let ((x1, y1), (x2, y2)) = ((b.0 - corner.0, b.1 - corner.1), (c.0 - corner.0, c.1 - corner.1));
        let area = product(x1, y2) - product(y1, x2);
        if area == 0 {
            return (Weights::default(), false);
        }
        let mut weights = Weights::default();
        let whole = weights.lay_with_area(corner, (x1, y1), (x2, y2), area < 0, normalized(area.unsigned_abs()));
        (weights, whole)
    }

    /// Becomes [that](Self::of) of a triangle with an area: whether that is negative, and its magnitude [normalized]; whether
    /// there is any.
    #[inline(always)]
    pub(crate) fn lay_with_area(
        &mut self,
        corner: (i32, i32),
        (x1, y1): (i32, i32),
        (x2, y2): (i32, i32),
        negative: bool,
        (divisor, shift): (u32, i32),
    ) -> bool {
        // Of a negative side the complement, so that −2^bits ≤ side < 2^bits.
        let [width, height] = [(x1, x2), (y1, y2)].map(|(a, b)| (a ^ a >> 31 | b ^ b >> 31) as u32);
        let bits = 32 - (width | height).leading_zeros() as i32;
        // 1/|area| = reciprocal · 2^-(62 + shift). |side| ≤ 2^bits and reciprocal < 2^31, so that a weight, which is
        // 2^(8 + 32 − up) · side / area, is below 2^30.
        let up = (bits - 21 - shift).max(0) as u32;
        // The or of two numbers is less than twice the larger.
        let reach = (width + height) >> SUBPIXEL_BITS;
        if up > MOST_UP || (reach + 2) << up > REACH {
            return false;
        }
        // In 5…31 − bits, since a box below 2^10 px has an area below 2^37: shifted sides fit 32 bits.
        let side_shift = (10 - shift - up as i32) as u32;
        let reciprocal = near_reciprocal(divisor);
        let reciprocal = if negative { -reciprocal } else { reciprocal };
        let weight = |side: i32, reciprocal: i32| high(side.wrapping_shl(side_shift), reciprocal);
        // Not the sides are negated: the complement of −2^bits has less bits than its negative.
        let x = (weight(y2, reciprocal), weight(y1, -reciprocal));
        let y = (weight(x2, -reciprocal), weight(x1, reciprocal));
        // Below 2^31.
        let part = (corner.0 & (SUBPIXELS - 1), corner.1 & (SUBPIXELS - 1));
        let at = |x: i32, y: i32| sum_of_parts((x, y), part);
        *self = Weights {
            pixel: (corner.0 >> SUBPIXEL_BITS, corner.1 >> SUBPIXEL_BITS),
            anchor: (at(x.0, y.0), at(x.1, y.1)),
            x,
            y,
            up,
            anchor_up: up,
        };
        true
    }

    /// With the weights at a covered sample, negated, in units of 2^-29, and steps in units of 2^-(32 − up).
    #[inline(always)]
    pub(crate) fn at_sample(pixel: (i32, i32), anchor: (i32, i32), x: (i32, i32), y: (i32, i32), up: u32) -> Self {
        Weights {
            pixel,
            anchor,
            x,
            y,
            up,
            anchor_up: 3,
        }
    }

    /// The least number for which no row of the triangle has two pixels more than 2^ that apart, of 2 to 10.
    #[inline(always)]
    pub(crate) fn widest_row(&self) -> u32 {
        // Along a row no weight changes by more than 1, which is 2^(32 − up).
        let (b, c) = self.x;
        let sum = ((b >> 1) + (c >> 1)).unsigned_abs() << 1;
        let steepest = b.unsigned_abs() | c.unsigned_abs() | sum;
        (steepest.leading_zeros() + 1).saturating_sub(self.up).clamp(2, 10)
    }

    /// The slope through `values` at the triangle's corners, each less than 2^31 from the first.
    #[inline(always)]
    pub fn slope(&self, values: [i32; 3]) -> Slope {
        self.at_origin(self.anchored(values))
    }

    /// The same from the anchor pixel, where the value is about the first.
    #[inline(always)]
    pub(crate) fn anchored(&self, [a, b, c]: [i32; 3]) -> Slope {
        let values = (b.wrapping_sub(a), c.wrapping_sub(a));
        // |weights| < 2^31, those at the anchor less by a 256th: below 2^63.
        let dot = |weights| high_sum(values, weights);
        Slope {
            value: a.wrapping_sub(dot(self.anchor).wrapping_shl(self.anchor_up)),
            x: dot(self.x).wrapping_shl(self.up),
            y: dot(self.y).wrapping_shl(self.up),
        }
    }

    /// An [anchored](Self::anchored) slope from the picture's origin on, once for all of its pixels: modulo 2^32 that is the same.
    #[inline(always)]
    pub(crate) fn at_origin(&self, slope: Slope) -> Slope {
        slope.moved_from(self.pixel)
    }
}

/// The [`Weights`] of a small triangle, of less than 16 columns and rows: in units of 2^-27 whatever its size.
///
/// The value at the anchor is that of the first corner and a part of a step, so that the weights there need not be known. What
/// [`Slopes::small`] is given: a varying of your own that has no use for it gets [`Weights`] instead, if it leaves that as it is.
#[derive(Debug, Clone, Copy, Default)]
pub struct SmallWeights {
    /// The anchor: the pixel whose sample is nearest to the first corner.
    pixel: (i32, i32),
    /// From the anchor to the first corner, in subpixels: −128…127.
    part: (i32, i32),
    /// Per column.
    x: (i32, i32),
    /// Per row.
    y: (i32, i32),
}

impl SmallWeights {
    /// With the first `corner`, in subpixels, and what a column and a row add, below 2^30.
    #[inline(always)]
    pub(crate) fn new(corner: (i32, i32), x: (i32, i32), y: (i32, i32)) -> Self {
        let nearest = |v: i32| (v + SUBPIXELS / 2) >> SUBPIXEL_BITS;
        let part = |v: i32| v << (32 - SUBPIXEL_BITS) >> (32 - SUBPIXEL_BITS);
        SmallWeights {
            pixel: (nearest(corner.0), nearest(corner.1)),
            part: (part(corner.0), part(corner.1)),
            x,
            y,
        }
    }

    /// The weights that any other triangle has.
    #[inline(always)]
    pub(crate) fn wide(&self) -> Weights {
        let at = |x: i32, y: i32| sum_of_signed_parts((x, y), self.part);
        Weights {
            pixel: self.pixel,
            anchor: (at(self.x.0, self.y.0), at(self.x.1, self.y.1)),
            x: self.x,
            y: self.y,
            up: SMALL_UP,
            anchor_up: SMALL_UP,
        }
    }

    /// The slope through `values` at the triangle's corners, each less than 2^31 from the first.
    #[inline(always)]
    pub(crate) fn slope(&self, [a, b, c]: [i32; 3]) -> Slope {
        let values = (b.wrapping_sub(a), c.wrapping_sub(a));
        let (x, y) = (high_sum(values, self.x), high_sum(values, self.y));
        let slope = Slope {
            value: a.wrapping_sub(sum_of_signed_parts((x, y), self.part) << SMALL_UP),
            x: x << SMALL_UP,
            y: y << SMALL_UP,
        };
        slope.moved_from(self.pixel)
    }

    /// As [`slope`](Self::slope), from the anchor on, in 2^[`SMALL_UP`] units of `values` whose differences, below
    /// 2^(14 + `CUT`), are cut to 2^`CUT` units: products of 32 bits.
    ///
    /// Steps are below 2^23, and a part of them fits a word.
    #[inline(always)]
    pub(crate) fn short<const CUT: u32>(&self, [a, b, c]: [i32; 3]) -> Slope {
        let values = (b.wrapping_sub(a) >> CUT, c.wrapping_sub(a) >> CUT);
        let (x, y) = (short_sum::<CUT>(values, self.x), short_sum::<CUT>(values, self.y));
        let part = x * self.part.0 + y * self.part.1;
        Slope {
            value: (a >> SMALL_UP).wrapping_sub(part >> SUBPIXEL_BITS),
            x,
            y,
        }
    }

    /// As [`Weights::at_origin`].
    #[inline(always)]
    pub(crate) fn at_origin(&self, slope: Slope) -> Slope {
        slope.moved_from(self.pixel)
    }
}

/// `magnitude` · 2^-shift in 2^31…2^32−1, cut, and the shift; by halves.
#[inline(always)]
pub(crate) fn normalized(magnitude: u64) -> (u32, i32) {
    let (high, low) = ((magnitude >> 32) as u32, magnitude as u32);
    if high == 0 {
        let up = low.leading_zeros();
        (low.wrapping_shl(up), -(up as i32))
    } else {
        let up = high.leading_zeros();
        (high.wrapping_shl(up) | (low >> 1).wrapping_shr(31 - up), 32 - up as i32)
    }
}

/// A value over a triangle: at the picture's origin, and what a column and a row add; modulo 2^32.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Slope {
    /// At the origin.
    pub value: i32,
    /// Per column.
    pub x: i32,
    /// Per row.
    pub y: i32,
}

impl Slope {
    /// Along a row from a pixel on: columns and rows from the picture's origin.
    #[inline(always)]
    pub fn ramp(&self, (columns, rows): (i32, i32)) -> Ramp<i32> {
        let value = self.value.wrapping_add(self.y.wrapping_mul(rows));
        Ramp {
            value: value.wrapping_add(self.x.wrapping_mul(columns)),
            step: self.x,
        }
    }
}

impl Slope {
    /// From the origin on instead of an anchor's `pixel`.
    #[inline(always)]
    fn moved_from(&self, (column, row): (i32, i32)) -> Slope {
        Slope {
            value: self.ramp((column.wrapping_neg(), row.wrapping_neg())).value,
            ..*self
        }
    }

    /// Of 2^`up` times the value.
    #[inline(always)]
    pub(crate) fn shifted(&self, up: u32) -> Slope {
        Slope {
            value: self.value.wrapping_shl(up),
            x: self.x.wrapping_shl(up),
            y: self.y.wrapping_shl(up),
        }
    }
}

/// What a varying keeps of a triangle that has [`Weights`]; [`Infallible`] for those that always take the wide way.
pub trait Slopes<V: Varying>: Sized {
    /// Whether there is anything to set up at all.
    const CARRIES: bool = true;
    /// Whether [`new`](Self::new) gives any: always or never.
    const EXIST: bool = true;
    /// Whether spans are drawn by [`draw`](Self::draw), after depth is compared and stored: for values that would leave no registers
    /// for it.
    const DRAWS: bool = false;

    /// Set up once per triangle; `None` where a varying has no use for weights.
    fn new(weights: &Weights, corners: [V; 3]) -> Option<Self>;
    /// As [`new`](Self::new), of a triangle below 16 columns and rows.
    #[inline(always)]
    fn small(weights: &SmallWeights, corners: [V; 3]) -> Option<Self> {
        Self::new(&weights.wide(), corners)
    }
    /// Along a row from a place on.
    fn ramps(&self, place: (i32, i32)) -> V::Ramps;
    /// At the current pixel.
    fn values(&self, ramps: &V::Ramps) -> V::Values;

    /// Draws all of `pixels`, which are those of the span, where [`DRAWS`](Self::DRAWS) says so.
    #[inline(always)]
    fn draw<F: Fragment<Varying = V>>(&self, _span: &Span, _pixels: &mut [F::Pixel], _fragment: &F) {}
}

impl<V: Varying> Slopes<V> for Infallible {
    const EXIST: bool = false;

    #[inline(always)]
    fn new(_: &Weights, _: [V; 3]) -> Option<Self> {
        None
    }
    fn ramps(&self, _: (i32, i32)) -> V::Ramps {
        match *self {}
    }
    fn values(&self, _: &V::Ramps) -> V::Values {
        match *self {}
    }
}
