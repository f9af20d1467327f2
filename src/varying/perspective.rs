//! Values in perspective, divided at every pixel, in words of 64 bits.

use core::convert::Infallible;
use core::hint::black_box;

use super::{Varying, each, hold, settle, widen};
use crate::gradient::{Basis, EXTRA_BITS, Place, Plane, Ramp};
use crate::num::product::product;
use crate::num::reciprocal;

/// N values in perspective: each corner carries value/w and 1/w, which are linear over the screen; every pixel divides.
///
/// Where all corners have the same w nothing is divided. With w of one sign the pixel's value lies in the range of the
/// corners' values; with mixed signs 1/w passes through 0 inside the polygon, and the value saturates there.
///
/// **Error**: 1/w and value/w are within 2^-27 of their largest corner value, and value/w is rounded to a unit at the
/// corners. With ρ the unit of 1/w over that of the pixel (best the largest of the polygon over that of the pixel, through a
/// [view](crate::view) up to four times as much), the value is within ρ·(2^-26·largest + 1) + 3 units + 2^-30·|value|
/// (`tests/interpolation.rs`). That is from the plane through three corners: where a polygon has a fourth that rounding took off
/// it, and a row would leave the corners' range there, all of the row is moved to stay
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
///
/// On Cortex-M4 some 65 instructions, and 30 for each value.
struct Divisor {
    /// 1/w.
    inverse: i64,
    /// 2^63 / (|1/w| · 2^(shift − 29)), less 2^32: from −2^31 to 0.
    reciprocal: i32,
    /// Takes |1/w| into 2^60…2^61.
    shift: u32,
    /// Before the camera, and no less than 2^-12 of the largest 1/w.
    is_usual: bool,
}

impl Divisor {
    #[inline(always)]
    fn new(inverse: i64) -> Self {
        let upper = (inverse >> 32) as u32;
        let is_usual = upper.wrapping_sub(1) < (1 << 28) - 1;
        let (shift, divisor) = if is_usual {
            let zeros = upper.leading_zeros();
            let lower = inverse as u32 >> (32u32.wrapping_sub(zeros) & 31);
            (zeros.wrapping_sub(3), upper.wrapping_shl(zeros) | lower)
        } else {
            Self::unusual(inverse)
        };
        Divisor {
            inverse,
            reciprocal: reciprocal(divisor) as i32,
            shift,
            is_usual,
        }
    }

    #[cold]
    #[inline(never)]
    fn unusual(inverse: i64) -> (u32, u32) {
        let magnitude = inverse.unsigned_abs().max(1);
        let shift = magnitude.leading_zeros().saturating_sub(3);
        (shift, ((magnitude << shift) >> 29) as u32)
    }

    /// `over_w` / inverse, in units of the values (2^30 of `over_w`), to the nearest and saturating: so that where a quotient is
    /// a whole number, as on a border of texels, it is that.
    #[inline(always)]
    fn divide(&self, over_w: i64) -> i32 {
        if self.is_usual {
            let top = over_w >> (31u32.wrapping_sub(self.shift) & 31);
            Self::quotient(over_w, top, self.reciprocal)
        } else {
            Self::divide_unusual(over_w, self.inverse < 0, self.shift, self.reciprocal)
        }
    }

    #[cold]
    #[inline(never)]
    fn divide_unusual(over_w: i64, negative: bool, shift: u32, reciprocal: i32) -> i32 {
        let over_w = if negative { -over_w } else { over_w };
        let top = match 31u32.checked_sub(shift) {
            Some(right) => over_w >> right,
            None => over_w.saturating_mul(1 << (shift & 31) << 1),
        };
        Self::quotient(over_w, top, reciprocal)
    }

    /// `top` is over_w · 2^(shift − 31).
    #[inline(always)]
    fn quotient(over_w: i64, top: i64, reciprocal: i32) -> i32 {
        let saturated = if over_w < 0 { i32::MIN } else { i32::MAX };
        // A quotient of 2^31 or more: only next to the pole of mixed signs, or where 1/w is all rounding.
        let Ok(top) = i32::try_from(top) else {
            return saturated;
        };
        // As a word, which the compiler would look through and multiply as a long one.
        let top = black_box(top);
        // Times the reciprocal, which is 2^32 more than kept: between ±2^63.
        let quotient = (product(top, reciprocal) + ((top as i64) << 32) + (1 << 30)) >> 31;
        i32::try_from(quotient).unwrap_or(saturated)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As [`Divisor::divide`], in words in which nothing overflows.
    fn plain(over_w: i64, inverse: i64) -> i32 {
        let over_w = over_w as i128 * inverse.signum() as i128;
        let magnitude = inverse.unsigned_abs();
        let shift = magnitude.leading_zeros() - 3;
        let reciprocal = (1u128 << 63) / ((magnitude << shift) >> 29) as u128;
        let quotient = (((over_w << shift) >> 31) * reciprocal as i128 + (1 << 30)) >> 31;
        quotient.clamp(i32::MIN as i128, i32::MAX as i128) as i32
    }

    #[test]
    fn quotients_are_those_of_wide_words() {
        let mut state = 1u64;
        let mut next = |most: u32| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            // Of every length.
            let bits = (state >> 58) as u32 % most;
            (state.rotate_left(3) as i64 >> (63 - bits)) ^ (state as i64 & 1)
        };
        let ends = [
            1,
            -1,
            2,
            3,
            1 << 13,
            1 << 43,
            (1 << 44) - 1,
            -(1 << 44),
            1 << 44,
            (1 << 45) + 1,
        ];
        for case in 0..2_000_000 {
            let pick = |case: usize, other: i64| ends.get(case % 40).copied().unwrap_or(other);
            let (over_w, inverse) = (pick(case, next(47)), pick(case / 40, next(46)));
            if inverse != 0 {
                let found = Divisor::new(inverse).divide(over_w);
                assert_eq!(found, plain(over_w, inverse), "{over_w} over {inverse}");
            }
        }
    }
}
