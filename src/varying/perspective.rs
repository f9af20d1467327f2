//! Values in perspective, divided at every pixel, in words of 64 bits.

use core::convert::Infallible;

use super::{Varying, each, hold, settle, widen};
use crate::gradient::{Basis, EXTRA_BITS, Place, Plane, Ramp};
use crate::num::reciprocal;

/// N values in perspective: each corner carries value/w and 1/w, which are linear over the screen; every pixel divides.
///
/// Where all corners have the same w nothing is divided. With w of one sign the pixel's value lies in the range of the
/// corners' values; with mixed signs 1/w passes through 0 inside the polygon, and the value saturates there.
///
/// **Error**: 1/w and value/w are within 2^-27 of their largest corner value, and value/w is rounded to a unit at the
/// corners. With ρ the largest 1/w of the polygon over that of the pixel, the value is within
/// ρ·(2^-26·largest + 1) + 3 units + 2^-30·|value| (`tests/interpolation.rs`). That is from the plane through three corners: where
/// a polygon has a fourth that rounding took off it, and a row would leave the corners' range there, all of the row is moved to stay
/// in it, 1/w and each value/w by itself, and the quotient by what they differ.
///
/// ```
/// use fixel::varying::Perspective;
/// // u = 100 at w = 1 and u = 300 at w = 2; inverse is 1/w in units of 2^-30.
/// let near = Perspective::new([100], 1 << 30);
/// let far = Perspective::new([300], 1 << 29);
/// assert_eq!(far.over_w, [150]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Perspective<const N: usize> {
    /// value · inverse / 2^30.
    pub over_w: [i32; N],
    /// 1/w in units of 2^-30 of any number that makes every corner's |1/w| at most 1, best the polygon's largest.
    pub inverse: i32,
    /// The values themselves, |v| ≤ 2^30: the range of the polygon's pixels. Not looked at where signs of w are mixed.
    pub values: [i32; N],
}

impl<const N: usize> Perspective<N> {
    /// A corner with these values and this 1/w.
    #[inline]
    pub fn new(values: [i32; N], inverse: i32) -> Self {
        let over_w = values.map(|v| ((v as i64 * inverse as i64 + (1 << 29)) >> 30) as i32);
        Perspective {
            over_w,
            inverse,
            values,
        }
    }
}

/// The planes of a [`Perspective`].
#[derive(Debug)]
pub struct PerspectivePlanes<const N: usize> {
    over_w: [Plane; N],
    inverse: Plane,
    /// Least and largest of the corners' values.
    ranges: [(i32, i32); N],
    /// All corners have inverse 1: the values are linear.
    affine: bool,
}

/// The ramps of a [`Perspective`].
#[derive(Debug)]
pub struct PerspectiveRamps<const N: usize> {
    over_w: [Ramp<i64>; N],
    inverse: Ramp<i64>,
}

impl<const N: usize> PerspectivePlanes<N> {
    /// One corner, and which of the basis it is.
    #[inline(always)]
    fn hold(&mut self, place: Option<usize>, corner: &Perspective<N>) {
        self.inverse.hold(place, corner.inverse);
        hold(&mut self.over_w, place, &corner.over_w);
        for (range, &value) in self.ranges.iter_mut().zip(&corner.values) {
            widen(range, value);
        }
    }

    #[inline(always)]
    fn settle(&mut self, basis: &Basis) {
        let (least, most) = self.inverse.range();
        self.affine = (least, most) == (1 << 30, 1 << 30);
        if least < 0 && most > 0 {
            self.ranges.fill((i32::MIN, i32::MAX));
        }
        self.inverse.settle(basis);
        settle(&mut self.over_w, basis);
    }
}

impl<const N: usize> Varying for Perspective<N> {
    type Planes = PerspectivePlanes<N>;
    type Slopes = Infallible;
    type Ramps = PerspectiveRamps<N>;
    type Values = [i32; N];

    const NO_PLANES: PerspectivePlanes<N> = PerspectivePlanes {
        over_w: [Plane::NONE; N],
        inverse: Plane::NONE,
        ranges: [(0, 0); N],
        affine: false,
    };

    // A function of its own: what setting planes up takes is free again when pixels are drawn.
    #[inline(never)]
    fn lay(planes: &mut PerspectivePlanes<N>, basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) {
        planes.inverse.empty();
        planes.over_w.iter_mut().for_each(Plane::empty);
        planes.ranges.fill((i32::MAX, i32::MIN));
        for i in 0..count {
            planes.hold(basis.place_of(i), &corner(i));
        }
        planes.settle(basis);
    }

    #[inline]
    fn ramps(planes: &PerspectivePlanes<N>, place: &Place) -> PerspectiveRamps<N> {
        let mut ramps = PerspectiveRamps {
            over_w: [Ramp::default(); N],
            inverse: planes.inverse.fine_ramp(place),
        };
        for (ramp, plane) in ramps.over_w.iter_mut().zip(&planes.over_w) {
            *ramp = plane.fine_ramp(place);
        }
        ramps
    }

    #[inline(always)]
    fn values(planes: &PerspectivePlanes<N>, ramps: &PerspectiveRamps<N>) -> [i32; N] {
        if planes.affine {
            return each(&ramps.over_w, |ramp| {
                ((ramp.value + (1 << (EXTRA_BITS - 1))) >> EXTRA_BITS) as i32
            });
        }
        let divisor = Divisor::new(ramps.inverse.value);
        let mut values = each(&ramps.over_w, |ramp| divisor.divide(ramp.value));
        for (value, (least, most)) in values.iter_mut().zip(&planes.ranges) {
            *value = (*value).max(*least).min(*most);
        }
        values
    }

    #[inline(always)]
    fn advance(ramps: &mut PerspectiveRamps<N>) {
        ramps.over_w.iter_mut().for_each(Ramp::<i64>::advance);
        ramps.inverse.advance();
    }
    #[inline(always)]
    fn advance_by(ramps: &mut PerspectiveRamps<N>, count: i32) {
        ramps.over_w.iter_mut().for_each(|ramp| *ramp = ramp.after(count));
        ramps.inverse = ramps.inverse.after(count);
    }
}

/// 1/w of one pixel, ready to divide by: one reciprocal for all values.
struct Divisor {
    /// 2^63 / (|1/w| · 2^(shift − 29)).
    reciprocal: u64,
    /// Takes |1/w| into 2^60…2^61.
    shift: u32,
    negative: bool,
}

impl Divisor {
    #[inline(always)]
    fn new(inverse: i64) -> Self {
        let magnitude = inverse.unsigned_abs().max(1);
        let shift = magnitude.leading_zeros().saturating_sub(3);
        Divisor {
            reciprocal: reciprocal(((magnitude << shift) >> 29) as u32),
            shift,
            negative: inverse < 0,
        }
    }

    /// `over_w` / inverse, in units of the values (2^30 of `over_w`), saturating.
    #[inline(always)]
    fn divide(&self, over_w: i64) -> i32 {
        let over_w = if self.negative { -over_w } else { over_w };
        // A quotient of 2^31 or more: only next to the pole of mixed signs, or where 1/w is all rounding.
        if over_w.unsigned_abs().leading_zeros() < self.shift + 2 {
            return if over_w < 0 { i32::MIN } else { i32::MAX };
        }
        // To the nearest, so that where a quotient is a whole number, as on a border of texels, it is that.
        let quotient = (((over_w << self.shift) >> 31) * self.reciprocal as i64 + (1 << 30)) >> 31;
        quotient.max(i32::MIN as i64).min(i32::MAX as i64) as i32
    }
}
