//! The two word sizes that the geometry is generic over.

use core::fmt::Debug;
use core::ops::{Add, BitAnd, Mul, Neg, Shl, Shr, Sub};

use super::quotient::Divisor;

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
    + BitAnd<Output = Self>
    + Shl<u32, Output = Self>
    + Shr<u32, Output = Self>
    + 'static
{
    /// Twice as wide: exact products.
    type Wide: Wide<Word = Self>;
    /// What several numbers are divided by.
    type Divisor: Copy;
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
    /// Bits of the magnitude: 0 for 0, 3 for ±5.
    fn bit_length(self) -> u32;
    /// All bits set for a negative number, none for any other.
    fn sign(self) -> Self;
    /// Sum modulo 2 to the word's width, and whether it carries: of a negative number and one that is not, whether the sum is 0
    /// or above.
    fn carrying_add(self, other: Self) -> (Self, bool);
    /// Exact product.
    fn times(self, other: Self) -> Self::Wide;
    /// Quotient rounded down and remainder in 0…divisor−1, for a positive divisor; 0, 0 for any other.
    fn div_rem_floor(self, divisor: Self) -> (Self, Self);
    /// self · 2^[`BITS`](Word::BITS) / divisor rounded down, for a positive divisor and a magnitude of at most twice that.
    fn ratio(self, divisor: Self) -> Self::Wide;
    /// Twice this word, from 1 to 2^[`BITS`](Word::BITS), to divide by.
    fn twice(self) -> Self::Divisor;
    /// What a divisor is multiplied by instead, if so: a power of two and then, in units of 2^-31 of what that leaves, a number.
    fn reciprocal(divisor: &Self::Divisor) -> Option<(i32, u32)>;
    /// numerator/divisor rounded down, where that lies within ±2^26.
    fn quotient(numerator: Self::Wide, divisor: &Self::Divisor) -> i32;
    /// numerator/divisor rounded down, where that lies within ±(2^31 − 16).
    fn large_quotient(numerator: Self::Wide, divisor: &Self::Divisor) -> i32;
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
    /// All numbers times the same power of two, so that the largest has [`Word::BITS`] bits, halves rounded upwards; and
    /// the bits that the largest had. All 0 for all 0.
    fn normalized<const N: usize>(values: [Self; N]) -> ([Self::Word; N], u32);
    /// As [`normalized`](Self::normalized), in place. A function of its own: the same for however many numbers.
    fn normalize(values: &mut [Self]) -> u32;
    /// The low half; the caller has shown that the rest is sign.
    fn narrow(self) -> Self::Word;
    /// Quotient rounded down, for a positive divisor; 0 for any other.
    fn div_floor(self, divisor: Self) -> Self;
    /// floor(√self); 0 for negative numbers.
    fn isqrt(self) -> Self;
    /// Exact product with a small constant; the caller has shown that it fits.
    fn times_small(self, factor: i32) -> Self;
}

/// [`Wide::normalize`], where it stands.
macro_rules! normalize {
    ($values:ident, $word:ty, $wide:ty) => {{
        const WORD: u32 = <$word>::BITS;
        // The longest of the magnitudes is as long as all of them laid over one another.
        let all = $values.iter().fold(0, |all, v| all | v.unsigned_abs());
        let bits = <$wide>::BITS - all.leading_zeros();
        // One bit more than a mantissa has, at the top of the upper half, which rounds as it is cut off. Only numbers
        // that fill their word have no room for the sign that way.
        let fills = bits == <$wide>::BITS;
        let up = if fills {
            0
        } else {
            (<$wide>::BITS - 1 - bits) & (<$wide>::BITS - 1)
        };
        for v in $values.iter_mut() {
            let mut top = ((*v << up) >> WORD) as $word;
            if fills {
                top >>= 1;
            }
            *v = ((top >> 1) + (top & 1)) as $wide;
        }
        bits
    }};
}

macro_rules! word {
    ($word:ty, $wide:ty, $divisor:ty, $bits:literal, $guard:literal, $sines:expr) => {
        impl Word for $word {
            type Wide = $wide;
            type Divisor = $divisor;
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
            fn sign(self) -> Self {
                self >> (<$word>::BITS - 1)
            }
            #[inline(always)]
            fn bit_length(self) -> u32 {
                <$word>::BITS - self.unsigned_abs().leading_zeros()
            }
            #[inline(always)]
            fn carrying_add(self, other: Self) -> (Self, bool) {
                let (sum, carry) = self.cast_unsigned().overflowing_add(other.cast_unsigned());
                (sum.cast_signed(), carry)
            }
            #[inline(always)]
            fn times(self, other: Self) -> $wide {
                self as $wide * other as $wide
            }
            #[inline(always)]
            fn div_rem_floor(self, divisor: Self) -> (Self, Self) {
                // floor(a / d) of a negative a is the complement of floor(−(a + 1) / d), where −(a + 1) is the complement of a:
                // an unsigned division, which rounds down as it is. The checked form has no panic path.
                let sign = self.sign();
                match (self ^ sign).cast_unsigned().checked_div(divisor.cast_unsigned()) {
                    Some(quotient) => {
                        let quotient = quotient.cast_signed() ^ sign;
                        (quotient, self.wrapping_sub(quotient.wrapping_mul(divisor)))
                    }
                    None => (0, 0),
                }
            }
            #[inline(always)]
            fn twice(self) -> $divisor {
                <$divisor>::new((self as u64).wrapping_mul(2) as _)
            }
            #[inline(always)]
            fn reciprocal(divisor: &$divisor) -> Option<(i32, u32)> {
                divisor.reciprocal()
            }
            #[inline(always)]
            fn ratio(self, divisor: Self) -> $wide {
                <$divisor>::ratio(self, divisor)
            }
            #[inline(always)]
            fn quotient(numerator: $wide, divisor: &$divisor) -> i32 {
                divisor.floor_small(numerator)
            }
            #[inline(always)]
            fn large_quotient(numerator: $wide, divisor: &$divisor) -> i32 {
                divisor.floor(numerator)
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
            fn normalized<const N: usize>(mut values: [Self; N]) -> ([$word; N], u32) {
                let bits = normalize!(values, $word, $wide);
                (values.map(|v| v as $word), bits)
            }
            #[inline(never)]
            fn normalize(values: &mut [Self]) -> u32 {
                normalize!(values, $word, $wide)
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

/// Divides as the machine does: words of 64 bits are for machines that can.
#[derive(Debug, Clone, Copy)]
pub struct Plain(i128);

impl Plain {
    fn new(divisor: u64) -> Self {
        Plain(divisor as i128)
    }
    fn reciprocal(self) -> Option<(i32, u32)> {
        None
    }
    fn floor_small(self, numerator: i128) -> i32 {
        Wide::div_floor(numerator, self.0) as i32
    }
    fn floor(self, numerator: i128) -> i32 {
        Wide::div_floor(numerator, self.0) as i32
    }
    fn ratio(numerator: i64, divisor: i64) -> i128 {
        Wide::div_floor((numerator as i128) << <i64 as Word>::BITS, divisor as i128)
    }
}

word!(i32, i64, Divisor, 30, 4096, super::trig::SINES_30);
word!(i64, i128, Plain, 62, 32768, super::trig::SINES_62);
