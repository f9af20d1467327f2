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
//! anchor, which is within half a column and row of the first corner, is that corner's and a part of a step, and off by less.
//! [`Weights`] exist where rows and columns from the first corner on, the farthest of each, are together at most 1024 >> up, two of
//! them for the anchor. A step is off by 4 times 2^up units or less, of 23 bits by little more than one. So a value of 31 bits is within 2^12 units, an
//! eighth of a step of depth, and one of 23 bits (a channel of RGB565 in 2^-16 level) within 1100 units (`tests/narrow.rs`,
//! `tests/bounds.rs`). Whoever uses slopes leaves that much room at both ends of his range.

use core::convert::Infallible;

use crate::edge::{SUBPIXEL_BITS, SUBPIXELS};
use crate::fragment::Fragment;
use crate::gradient::Ramp;
use crate::num::{high, high_sum, near_reciprocal, short_sum, sum_of_signed_parts};
use crate::span::{Span, doubled_area};
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
    /// In units of 2^-(32 − up).
    steps: SmallWeights,
    up: u32,
}

impl Weights {
    /// Of a triangle on the screen, in subpixels within ±2^28; `None` where it is too large or too thin, or has no area.
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
        let area = doubled_area(&corners);
        let mut weights = Weights::default();
        (area != 0 && weights.lay(&corners, &Inverse::of(area))).then_some(weights)
    }

    /// Becomes what [`new`](Self::new) gives of a triangle with an area, whose inverse is known; whether it gives any, else these
    /// are any numbers.
    ///
    /// A function of its own: the same for all that is drawn. In place: returned, they would be copied.
    #[inline(never)]
    pub(crate) fn lay(&mut self, &[corner, b, c]: &[(i32, i32); 3], area: &Inverse) -> bool {
        let ((x1, y1), (x2, y2)) = ((b.0 - corner.0, b.1 - corner.1), (c.0 - corner.0, c.1 - corner.1));
        // Of a negative side the complement, so that −2^bits ≤ side < 2^bits.
        let [width, height] = [(x1, x2), (y1, y2)].map(|(a, b)| (a ^ a >> 31 | b ^ b >> 31) as u32);
        let bits = 32 - (width | height).leading_zeros() as i32;
        // |side| ≤ 2^bits and the reciprocal < 2^31, so that a weight, which is 2^(8 + 32 − up) · side / area, is below 2^30.
        let up = (bits - 21 - area.shift).max(0) as u32;
        // The or of two numbers is less than twice the larger.
        let reach = (width + height) >> SUBPIXEL_BITS;
        let whole = up <= MOST_UP && (reach + 2).wrapping_shl(up) <= REACH;
        // In 5…31 − bits if whole, since a box below 2^10 px has an area below 2^37: shifted sides fit 32 bits.
        let side_shift = (10 - area.shift).wrapping_sub(up as i32) as u32;
        let reciprocal = (area.reciprocal ^ area.sign) - area.sign;
        let weight = |side: i32, reciprocal: i32| high(side.wrapping_shl(side_shift), reciprocal);
        // Not the sides are negated: the complement of −2^bits has less bits than its negative.
        let x = (weight(y2, reciprocal), weight(y1, -reciprocal));
        let y = (weight(x2, -reciprocal), weight(x1, reciprocal));
        let steps = SmallWeights::new(corner, x, y);
        *self = Weights { steps, up };
        whole
    }

    /// Any weights, to be replaced: words that are all the same, which costs a store each and no call.
    #[inline(always)]
    pub(crate) fn placeholder(word: i32) -> Self {
        let two = (word, word);
        let steps = SmallWeights {
            pixel: two,
            part: two,
            x: two,
            y: two,
        };
        Weights { steps, up: word as u32 }
    }

    /// Of the samples right of a covered one, with the weights `at` that, and what a column adds: in units of 2^-30.
    ///
    /// The value there is the first corner's and one row's step.
    #[inline(always)]
    pub(crate) fn at_sample((column, row): (i32, i32), at: (i32, i32), x: (i32, i32)) -> Self {
        let steps = SmallWeights {
            pixel: (column, row - 1),
            part: (0, 0),
            x,
            y: at,
        };
        Weights { steps, up: 2 }
    }

    /// The least number for which no row of the triangle has two pixels more than 2^ that apart, of 2 to 11: from the first corner
    /// a row reaches less than 1024 columns either way.
    #[inline(always)]
    pub(crate) fn widest_row(&self) -> u32 {
        // Along a row no weight changes by more than 1, which is 2^(32 − up).
        let (b, c) = self.steps.x;
        let sum = ((b >> 1) + (c >> 1)).unsigned_abs() << 1;
        let steepest = b.unsigned_abs() | c.unsigned_abs() | sum;
        (steepest.leading_zeros() + 1).saturating_sub(self.up).clamp(2, 11)
    }

    /// The slope through `values` at the triangle's corners, each less than 2^31 from the first.
    #[inline(always)]
    pub fn slope(&self, values: [i32; 3]) -> Slope {
        self.at_origin(self.anchored(values))
    }

    /// The same from the anchor pixel, where the value is about the first.
    #[inline(always)]
    pub(crate) fn anchored(&self, values: [i32; 3]) -> Slope {
        self.steps.anchored(values, self.up)
    }

    /// An [anchored](Self::anchored) slope from the picture's origin on, once for all of its pixels: modulo 2^32 that is the same.
    #[inline(always)]
    pub(crate) fn at_origin(&self, slope: Slope) -> Slope {
        slope.moved_from(self.steps.pixel)
    }
}

/// 1/|area| = reciprocal · 2^-(62 + shift), of a triangle's doubled area in square subpixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inverse {
    /// In 2^30…2^31−1, to 2^-29 of itself.
    pub(crate) reciprocal: i32,
    pub(crate) shift: i32,
    /// −1 where the corners run counter-clockwise, which is an area above 0, else 0: the sign of x₁·y₂ − y₁·x₂.
    pub(crate) sign: i32,
}

impl Inverse {
    /// Of a [`doubled_area`] below 2^62; of none, anything.
    #[inline(always)]
    pub(crate) fn of(area: i64) -> Self {
        let (divisor, shift) = normalized(area.unsigned_abs());
        Inverse {
            reciprocal: near_reciprocal(divisor),
            shift,
            sign: (!area >> 63) as i32,
        }
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
        let part = |v: i32| v << (32 - SUBPIXEL_BITS) >> (32 - SUBPIXEL_BITS);
        SmallWeights {
            pixel: (Self::nearest(corner.0), Self::nearest(corner.1)),
            part: (part(corner.0), part(corner.1)),
            x,
            y,
        }
    }

    /// The column, or row, whose samples are nearest to a coordinate.
    #[inline(always)]
    pub(crate) fn nearest(coordinate: i32) -> i32 {
        (coordinate + SUBPIXELS / 2) >> SUBPIXEL_BITS
    }

    /// Where columns and rows count from: the anchor.
    #[inline(always)]
    pub(crate) fn origin(&self) -> (i32, i32) {
        self.pixel
    }

    /// The weights that any other triangle has, with the anchor as the origin.
    #[inline(always)]
    pub(crate) fn wide(&self) -> Weights {
        Weights {
            steps: SmallWeights { pixel: (0, 0), ..*self },
            up: SMALL_UP,
        }
    }

    /// The slope through `values` at the triangle's corners, each less than 2^31 from the first, from the anchor on.
    #[inline(always)]
    pub(crate) fn slope(&self, values: [i32; 3]) -> Slope {
        self.anchored(values, SMALL_UP)
    }

    /// The same from the anchor pixel on, where steps are of 2^`up` units. |weights| ≤ 2^30: steps are below 2^31.
    #[inline(always)]
    fn anchored(&self, [a, b, c]: [i32; 3], up: u32) -> Slope {
        let values = (b.wrapping_sub(a), c.wrapping_sub(a));
        let (x, y) = (high_sum(values, self.x), high_sum(values, self.y));
        Slope {
            value: a.wrapping_sub(sum_of_signed_parts((x, y), self.part).wrapping_shl(up)),
            x: x.wrapping_shl(up),
            y: y.wrapping_shl(up),
        }
    }

    /// As [`slope`](Self::slope), from the anchor on, in 2^[`SMALL_UP`] units of `values` whose differences, below
    /// 2^(14 + `CUT`), are cut to 2^`CUT` units: products of 32 bits.
    ///
    /// Steps are below 2^23, and a part of them fits a word.
    #[inline(always)]
    pub(crate) fn short<const CUT: u32>(&self, [a, b, c]: [i32; 3]) -> Slope {
        let values = (b.wrapping_sub(a) >> CUT, c.wrapping_sub(a) >> CUT);
        let (x, y) = (short_sum::<CUT>(values, self.x), short_sum::<CUT>(values, self.y));
        // Wrapping: of colours that are none, anything.
        let part = x.wrapping_mul(self.part.0).wrapping_add(y.wrapping_mul(self.part.1));
        Slope {
            value: (a >> SMALL_UP).wrapping_sub(part >> SUBPIXEL_BITS),
            x,
            y,
        }
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

/// A value over a triangle: at its origin, and what a column and a row add; modulo 2^32. The origin is the picture's, but the
/// [anchor](SmallWeights) of a small triangle.
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
    /// Along a row from a pixel on: columns and rows from the origin.
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
    /// As [`new`](Self::new), of a triangle below 16 columns and rows; places then count from the weights' anchor.
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
