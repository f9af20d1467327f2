//! The cheapest precision: tables with linear interpolation, and no product longer than 32 bits.

use super::Precision;
use super::power::{EXP_STEPS, log2};

/// Directions and powers from tables: fractions of 15 bits, one table each, no Newton step, and not one product of more than
/// 32 bits, which a core without a long multiplication (ARMv6-M) would have to call a function for.
///
/// Far below a level of 255 in what is diffuse. A highlight magnifies the error of its cosine by its exponent.
///
/// ```
/// use fixel::num::{Precision, Table};
/// let [x, y, z] = Table::unit([3, 0, 4]).unwrap();
/// let near = |c: i32, wanted: f64| (c as f64 / (1 << 30) as f64 - wanted).abs() < 2e-4;
/// assert!(near(x, 0.6) && y == 0 && near(z, 0.8));
/// assert!(near(Table::power(1 << 29, 3 << 16), 0.125));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Table {}

impl Precision for Table {
    const RECIPROCAL_ERROR: u32 = 1 << 18;
    const ROOT_ERROR: u32 = 1 << 18;
    const UNIT_ERROR: u32 = 80_000;
    const DOT_ERROR: u32 = 1 << 16;
    const POWER_ERROR: u32 = 5 << 18;
    const LONG: bool = false;

    #[inline]
    fn reciprocal(divisor: u32) -> u64 {
        (reciprocal_seed(divisor.max(1 << 31)) as u64) << 16
    }

    #[inline]
    fn reciprocal_square_root(square: u32) -> u32 {
        root_seed(square.max(1 << 30)) << 16
    }

    #[inline]
    fn unit(vector: [i32; 3]) -> Option<[i32; 3]> {
        let [x, y, z] = vector;
        if x | y | z == 0 {
            return None;
        }
        // One less than a negative number's magnitude is as good, and a bit more keeps what is left a number.
        let all_bits = (x ^ x >> 31) | (y ^ y >> 31) | (z ^ z >> 31) | 1;
        // The largest component in 2^30…2^31, then rounded to 2^14…2^15: the sum of squares is in 2^28…3·2^30.
        let room = all_bits.leading_zeros().wrapping_sub(1);
        let [x, y, z] = vector.map(|c| ((c.wrapping_shl(room) >> 15) + 1) >> 1);
        let sum = (x * x) as u32 + (y * y) as u32 + (z * z) as u32;
        let (sum, up) = if sum >> 30 == 0 { (sum << 2, 1) } else { (sum, 0) };
        // c/√sum = c · 2^30/√sum · 2^-30, the root's reciprocal in 2^14…2^15, so that no product passes 2^30·(1 + 2^-13).
        let inverse = ((root_seed(sum) + 1) >> 1) as i32;
        Some([x, y, z].map(|c| c.wrapping_mul(inverse) << up))
    }

    #[inline]
    fn dot([a, b, c]: [i32; 3], [x, y, z]: [i32; 3]) -> i32 {
        let short = |c: i32| c.wrapping_add(1 << 14) >> 15;
        // Of unit vectors the sum is at most 2^30 and a little; of others it wraps.
        let product = |a: i32, b: i32| short(a).wrapping_mul(short(b));
        product(a, x).wrapping_add(product(b, y)).wrapping_add(product(c, z))
    }

    #[inline]
    fn power(base: i32, exponent: u32) -> i32 {
        const ONE: i32 = 1 << 30;
        if exponent == 0 || base >= ONE {
            return ONE;
        }
        if base <= 0 {
            return 0;
        }
        // −log₂ base = zeros − 2 + (1 − log₂ mantissa) in units of 2^-22, at most 30.
        let zeros = (base as u32).leading_zeros();
        let [fraction, slope, position] = entry(&LOGARITHMS, ((base as u32) << zeros) << 1, 6);
        let logarithm = (zeros.wrapping_sub(2) << 22) + (fraction << 6) + ((slope * position) >> 9);
        let (whole, part) = (exponent >> 16, exponent & 0xffff);
        // From 16 on nothing is left of 15 bits.
        if whole * (logarithm >> 12) >= 16 << 10 {
            return 0;
        }
        // So the first product is below (2^14 + 2^16)·2^12.
        let power = whole * logarithm + part * (logarithm >> 16) + ((part * (logarithm & 0xffff)) >> 16);
        let [next, slope, position] = entry(&POWERS, power << 10, 5);
        let value = next + ((slope * position) >> 15);
        (value << 14).checked_shr(power >> 22).unwrap_or(0) as i32
    }
}

/// Where `fraction`, in units of 2^-32, lies in a falling table of 2^`BITS` intervals: the value at the end of its interval, what
/// the value falls by from the start, and how far it is before the end, in units of 2^-15 interval.
#[inline(always)]
fn entry<const N: usize>(table: &[u16; N], fraction: u32, bits: u32) -> [u32; 3] {
    let index = (fraction >> (32 - bits)) as usize;
    let position = (1 << 15) - ((fraction << bits) >> 17);
    // The compiler sees that both are there.
    let first = table.get(index).copied().unwrap_or(0) as u32;
    let next = table.get(index + 1).copied().unwrap_or(0) as u32;
    [next, first.wrapping_sub(next), position]
}

/// 2^47 / `divisor` for a normalised divisor: within 2^-14.6 of it, in 2^15…2^16−1.
#[inline(always)]
pub(super) fn reciprocal_seed(divisor: u32) -> u32 {
    let [next, slope, position] = entry(&RECIPROCALS, divisor << 1, 6);
    next + ((slope * position) >> 15)
}

/// 2^31 / √`square` for a normalised square in 2^30…2^32−1: within 2^-14 of it, in 2^15…2^16−1.
#[inline(always)]
pub(super) fn root_seed(square: u32) -> u32 {
    let [next, slope, position] = entry(&ROOTS, square, 7);
    next + ((slope * position) >> 15)
}

/// 2^16 · 64/(64 + i), less half of what a chord lies above the curve: 2^-15 of it at the first interval.
const RECIPROCALS: [u16; 65] = {
    let mut table = [0; 65];
    let mut i = 0;
    while i < 65 {
        let n = 64 + i as u64;
        // x·(1 − 1/(8·n²)), rounded.
        let x = (1u64 << 50) / n;
        table[i] = ((x - x / (8 * n * n) + (1 << 27)) >> 28) as u16;
        i += 1;
    }
    table
};

/// 2^16 · √(32/i), less half of what a chord lies above the curve: 2^-14.4 of it at the first interval in use, i = 32.
const ROOTS: [u16; 129] = {
    let mut table = [0; 129];
    let mut i = 32;
    while i < 129 {
        let n = i as u128;
        // x·(1 − 3/(64·n²)), rounded.
        let x = ((1u128 << 95) / n).isqrt() as u64;
        table[i] = ((x - 3 * (x / 64) / (n * n) as u64 + (1 << 28)) >> 29) as u16;
        i += 1;
    }
    table
};

/// 1 − log₂(1 + i/64) in units of 2^-16; the first is a unit short of 1.
const LOGARITHMS: [u16; 65] = {
    let mut table = [0; 65];
    table[0] = u16::MAX;
    let mut i = 1;
    while i < 64 {
        let log = log2((64 + i as u128) << 56);
        table[i] = ((((1u64 << 32) - log as u64) + (1 << 15)) >> 16) as u16;
        i += 1;
    }
    table
};

/// 2^-i/32 in units of 2^-16, less half of what a chord lies above the curve, 2^-15 of it.
const POWERS: [u16; 33] = {
    let mut table = [0; 33];
    let mut i = 0;
    while i < 33 {
        let x = if i < 32 { EXP_STEPS[i] as u64 } else { 1 << 30 };
        // (ln 2)²/(16·32²) = 2^-15.06.
        table[i] = ((x - ((x * 62_974) >> 31) + (1 << 14)) >> 15) as u16;
        i += 1;
    }
    table
};
