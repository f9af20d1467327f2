//! Several quotients by one divisor: a reciprocal once, and a multiplication for each, exact all the same.

use super::recip::near_reciprocal;

/// A divisor in 1…2^31 and its reciprocal.
///
/// A quotient is estimated by the reciprocal, and its remainder says by how much the estimate is off: what comes out is
/// floor(n/d), to the bit, without a division of 64 bits, which is a library call on every Cortex-M.
///
/// ```
/// use fixel::num::Divisor;
/// let third = Divisor::new(3);
/// assert_eq!([-4, -3, -1, 0, 5].map(|n| third.floor(n)), [-2, -1, -1, 0, 1]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Divisor {
    divisor: u32,
    /// Takes the divisor to 2^31…2^32.
    shift: u32,
    /// 2^62 over that, within [`ERROR`].
    reciprocal: i32,
}

/// Units of the reciprocal that it can be off: below 4, as `recip` tests.
const ERROR: i64 = 4;

/// Bits of a quotient that [`Divisor::floor_small`] takes.
const SMALL: u32 = 26;

// The estimate is off by the error of the reciprocal, times less than 2^31, by the bits cut off the numerator, and by those
// cut off the product: by less than 1 for small quotients, by less than 2^4 for large ones.
const _: () = assert!((ERROR << 31) + (1 << 31) < 1 << (61 - SMALL) && (ERROR << 31) + (1 << 31) < 15 << 30);

impl Divisor {
    /// 0 is taken as 1, and what is larger than 2^31 as that.
    #[inline]
    pub fn new(divisor: u32) -> Self {
        let divisor = divisor.clamp(1, 1 << 31);
        let shift = divisor.leading_zeros();
        Divisor {
            divisor,
            shift,
            reciprocal: near_reciprocal(divisor << shift),
        }
    }

    /// 2^62 over the divisor times a power of two that takes it to 2^31…2^32, within 4 units; and that power.
    #[inline(always)]
    pub(super) fn reciprocal(&self) -> Option<(i32, u32)> {
        Some((self.reciprocal, self.shift))
    }

    /// floor(n/d), where that lies within ±2^26; anything where it does not.
    ///
    /// ```
    /// use fixel::num::Divisor;
    /// let d = 123_456_789;
    /// assert_eq!(Divisor::new(d).floor_small(d as i64 * 7_654_321 - 1), 7_654_320);
    /// ```
    #[inline]
    pub fn floor_small(&self, numerator: i64) -> i32 {
        self.corrected(numerator, self.estimate::<SMALL>(numerator))
    }

    /// floor(n/d), where that lies within ±(2^31 − 16); anything where it does not.
    ///
    /// ```
    /// use fixel::num::Divisor;
    /// assert_eq!(Divisor::new(1 << 30).floor((65535 << 45) - 1), (65535 << 15) - 1);
    /// ```
    #[inline]
    pub fn floor(&self, numerator: i64) -> i32 {
        // Off by less than 16, so that it fits.
        let estimate = self.estimate::<31>(numerator);
        let remainder = self.remainder(numerator, estimate);
        self.corrected(numerator, estimate.wrapping_add(self.estimate::<SMALL>(remainder)))
    }

    /// numerator · 2^30 / divisor, rounded down, for a positive divisor and a numerator of at most twice that, either way.
    ///
    /// A function of its own: the same for however many numbers.
    #[inline(never)]
    pub(super) fn ratio(numerator: i32, divisor: i32) -> i64 {
        // Of what is beyond the divisor, so that the quotient is at most 1.
        let (rest, whole) = if numerator >= divisor {
            (numerator.wrapping_sub(divisor), 1i64 << 30)
        } else if numerator <= divisor.wrapping_neg() {
            (numerator.wrapping_add(divisor), -1i64 << 30)
        } else {
            (numerator, 0)
        };
        Divisor::new(divisor as u32).floor((rest as i64) << 30) as i64 + whole
    }

    /// A quotient of less than 2^`BITS`.
    #[inline(always)]
    fn estimate<const BITS: u32>(&self, numerator: i64) -> i32 {
        // The numerator is below 2^(32 − shift + BITS).
        let top = (numerator.wrapping_shl(self.shift) >> (BITS + 1)) as i32;
        ((top as i64 * self.reciprocal as i64) >> (61 - BITS)) as i32
    }

    #[inline(always)]
    fn remainder(&self, numerator: i64, quotient: i32) -> i64 {
        // The product is below 2^62, so that only numerators that are too large wrap.
        numerator.wrapping_sub(quotient as i64 * self.divisor as i64)
    }

    /// The exact quotient, from one that is off by at most 1.
    #[inline(always)]
    fn corrected(&self, numerator: i64, estimate: i32) -> i32 {
        let remainder = self.remainder(numerator, estimate);
        let over = (remainder >= self.divisor as i64) as i32;
        estimate.wrapping_add(over).wrapping_add((remainder >> 63) as i32)
    }
}
