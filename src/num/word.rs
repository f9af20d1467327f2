//! The two word sizes that the geometry is generic over.

use core::fmt::Debug;
use core::ops::{Add, Mul, Neg, Shl, Shr, Sub};

mod sealed {
    pub trait Sealed {}
    impl Sealed for i32 {}
    impl Sealed for i64 {}
}

/// A machine word: `i32` (fast on every microcontroller) or `i64` (exact, and for pictures beyond 4096 pixels).
///
/// The same code runs on both. A *mantissa* is a word of at most [`BITS`](Word::BITS) bits, 2^BITS itself included, so
/// that the sum of four products of mantissas fits a [`Wide`] with its sign: 4·2^(2·BITS) ≤ 2^(width of Wide − 2).
///
/// ```
/// use fixel::num::Word;
/// assert_eq!(i32::BITS, 32);
/// assert_eq!(<i32 as Word>::BITS, 30);
/// assert_eq!(<i64 as Word>::BITS, 62);
/// ```
pub trait Word:
    sealed::Sealed
    + Copy
    + Ord
    + Debug
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<Output = Self>
    + Shl<u32, Output = Self>
    + Shr<u32, Output = Self>
    + 'static
{
    /// Twice as wide: exact products.
    type Wide: Wide<Word = Self>;
    /// Bits of a mantissa.
    const BITS: u32;
    /// Largest coordinate of a screen position in pixels, either sign: what the edge walk of this word proves
    /// (see [`edge`](mod@crate::edge)).
    const GUARD: i32;
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// Sine at i·π/128 for i = 0…64 in units of 2^-BITS, rounded to nearest.
    const SINES: &'static [Self; 65];

    /// The same number.
    fn from_i32(value: i32) -> Self;
    /// The same number, sign-extended.
    fn to_i64(self) -> i64;
    /// The low 32 bits; the caller has shown that the rest is sign.
    fn low_i32(self) -> i32;
    /// `value`, given in units of 2^-62, in units of 2^-BITS, rounded down.
    fn from_q62(value: i64) -> Self;
    /// The same number with twice the width.
    fn widen(self) -> Self::Wide;
    /// Exact product.
    fn times(self, other: Self) -> Self::Wide;
    /// Quotient rounded down and remainder in 0…divisor−1, for a positive divisor; 0, 0 for any other.
    fn div_rem_floor(self, divisor: Self) -> (Self, Self);
}

/// Twice the width of a [`Word`].
pub trait Wide:
    Copy
    + Ord
    + Debug
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Shl<u32, Output = Self>
    + Shr<u32, Output = Self>
{
    /// Half as wide.
    type Word: Word<Wide = Self>;
    /// 0.
    const ZERO: Self;
    /// Bits of the magnitude: 0 for 0, 3 for ±5.
    fn bit_length(self) -> u32;
    /// The low half; the caller has shown that the rest is sign.
    fn narrow(self) -> Self::Word;
    /// Quotient rounded down, for a positive divisor; 0 for any other.
    fn div_floor(self, divisor: Self) -> Self;
    /// floor(√self); 0 for negative numbers.
    fn isqrt(self) -> Self;
    /// Exact product with a small constant; the caller has shown that it fits.
    fn times_small(self, factor: i32) -> Self;
}

macro_rules! word {
    ($word:ty, $wide:ty, $bits:literal, $guard:literal, $sines:expr) => {
        impl Word for $word {
            type Wide = $wide;
            const BITS: u32 = $bits;
            const GUARD: i32 = $guard;
            const ZERO: Self = 0;
            const ONE: Self = 1;
            const SINES: &'static [Self; 65] = &$sines;

            #[inline(always)]
            fn from_i32(value: i32) -> Self {
                value as Self
            }
            #[inline(always)]
            fn to_i64(self) -> i64 {
                self as i64
            }
            #[inline(always)]
            fn low_i32(self) -> i32 {
                self as i32
            }
            #[inline(always)]
            fn from_q62(value: i64) -> Self {
                (value >> (62 - $bits)) as Self
            }
            #[inline(always)]
            fn widen(self) -> $wide {
                self as $wide
            }
            #[inline(always)]
            fn times(self, other: Self) -> $wide {
                self as $wide * other as $wide
            }
            #[inline(always)]
            fn div_rem_floor(self, divisor: Self) -> (Self, Self) {
                // The checked forms have no panic path; a positive divisor always takes the `Some`.
                match self.checked_div_euclid(divisor) {
                    Some(quotient) => (quotient, self.wrapping_sub(quotient.wrapping_mul(divisor))),
                    None => (0, 0),
                }
            }
        }

        impl Wide for $wide {
            type Word = $word;
            const ZERO: Self = 0;

            #[inline(always)]
            fn bit_length(self) -> u32 {
                <$wide>::BITS - self.unsigned_abs().leading_zeros()
            }
            #[inline(always)]
            fn narrow(self) -> $word {
                self as $word
            }
            #[inline(always)]
            fn div_floor(self, divisor: Self) -> Self {
                self.checked_div_euclid(divisor).unwrap_or(0)
            }
            #[inline(always)]
            fn isqrt(self) -> Self {
                self.max(0).unsigned_abs().isqrt() as Self
            }
            #[inline(always)]
            fn times_small(self, factor: i32) -> Self {
                self * factor as $wide
            }
        }
    };
}

word!(i32, i64, 30, 4096, super::trig::SINES_30);
word!(i64, i128, 62, 32768, super::trig::SINES_62);
