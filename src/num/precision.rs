//! How precisely directions and powers are computed, chosen by type.

use super::root::cut;
use super::{dot, power, reciprocal, reciprocal_square_root, unit};

/// Reciprocals, roots, unit vectors, dot products and powers at one precision.
///
/// All levels take and give the same units, so that a program is generic over the level; they differ in how many of the low
/// bits mean anything. The constants are their bounds, each in the unit of the function's result.
///
/// ```
/// use fixel::num::{Precision, TwoSteps};
///
/// /// The cosine between two vectors in units of 2^-30.
/// fn cosine<P: Precision>(a: [i32; 3], b: [i32; 3]) -> Option<i32> {
///     Some(P::dot(P::unit(a)?, P::unit(b)?))
/// }
/// assert_eq!(cosine::<TwoSteps>([0, 3, 0], [0, -7, 0]), Some(-1 << 30));
/// ```
pub trait Precision {
    /// Of [`reciprocal`](Self::reciprocal), in units of 2^-32 of the result.
    const RECIPROCAL_ERROR: u32;
    /// Of [`reciprocal_square_root`](Self::reciprocal_square_root), in units of 2^-32 of the result.
    const ROOT_ERROR: u32;
    /// Of a component of [`unit`](Self::unit) and [`unit_wide`](Self::unit_wide), in units of 2^-30.
    const UNIT_ERROR: u32;
    /// Of [`dot`](Self::dot), in units of 2^-30.
    const DOT_ERROR: u32;
    /// Of [`power`](Self::power), in units of 2^-30, for the base given and exponents up to 256; times a/256 for larger ones.
    const POWER_ERROR: u32;
    /// Whether lights are summed in words of 64 bits; if not, in words of 32, of which a share of light has 15.
    const LONG: bool;

    /// 2^63 / `divisor` for a normalised divisor in 2^31…2^32−1; a smaller one is taken as 2^31.
    fn reciprocal(divisor: u32) -> u64;
    /// 2^47 / √`square` for a normalised square in 2^30…2^32−1; a smaller one is taken as 2^30.
    fn reciprocal_square_root(square: u32) -> u32;
    /// The same direction with length 1, in units of 2^-30; `None` for the zero vector.
    fn unit(vector: [i32; 3]) -> Option<[i32; 3]>;
    /// [`unit`](Self::unit) of longer numbers.
    #[inline]
    fn unit_wide(vector: [i64; 3]) -> Option<[i32; 3]> {
        Self::unit(cut(vector))
    }
    /// The dot product in units of 2^-30 of two unit vectors, as [`unit`](Self::unit) gives them, in units of 2^-30.
    fn dot(a: [i32; 3], b: [i32; 3]) -> i32;
    /// `base`^`exponent`: base and result in 0…2^30 in units of 2^-30, the exponent in units of 2^-16.
    fn power(base: i32, exponent: u32) -> i32;
}

/// What the plain functions of [`num`](crate::num) do: a table and two Newton steps, as near as the words hold.
///
/// ```
/// use fixel::num::{Precision, TwoSteps, power};
/// assert_eq!(TwoSteps::power(1 << 29, 3 << 16), power(1 << 29, 3 << 16));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TwoSteps {}

impl Precision for TwoSteps {
    // The floor: less than a unit of a result of at least 2^31.
    const RECIPROCAL_ERROR: u32 = 2;
    const ROOT_ERROR: u32 = 3;
    const UNIT_ERROR: u32 = 3;
    const DOT_ERROR: u32 = 1;
    const POWER_ERROR: u32 = 3;
    const LONG: bool = true;

    #[inline(always)]
    fn reciprocal(divisor: u32) -> u64 {
        reciprocal(divisor)
    }
    #[inline(always)]
    fn reciprocal_square_root(square: u32) -> u32 {
        reciprocal_square_root(square)
    }
    #[inline(always)]
    fn unit(vector: [i32; 3]) -> Option<[i32; 3]> {
        unit(vector)
    }
    #[inline(always)]
    fn dot(a: [i32; 3], b: [i32; 3]) -> i32 {
        // From units of 2^-60, rounded.
        ((dot(a, b) + (1 << 29)) >> 30) as i32
    }
    #[inline(always)]
    fn power(base: i32, exponent: u32) -> i32 {
        power(base, exponent)
    }
}
