//! Reciprocals without a divider.

use core::num::NonZeroU32;

use super::product::{BY_HALVES, high, product_unsigned};

/// floor(2^63 / `divisor`), exactly, for a normalised divisor in 2^31…2^32−1; the result lies in 2^31…2^32.
///
/// A seed from a table of 128 entries is within 2^-8, each of two Newton steps squares the error, and what the remainder is
/// worth is added (numerics: a 128-entry table and two steps give 2^-31). No divide instruction, so that a core without one
/// pays the same. A divisor below 2^31 is taken as 2^31.
///
/// ```
/// use fixel::num::reciprocal;
/// assert_eq!(reciprocal(1 << 31), 1 << 32);
/// assert_eq!(reciprocal(3 << 30), (1 << 63) / (3 << 30));
/// ```
#[inline]
pub fn reciprocal(divisor: u32) -> u64 {
    let divisor = divisor.max(1 << 31);
    // Twice of what is less than 8 units below: less than 17 below 2^63/divisor.
    let near = nearer_reciprocal(divisor);
    let below = (near as u32) << 1;
    let rest = (1u64 << 63).wrapping_sub(product_unsigned(below, divisor));
    // rest/divisor, 17 at most, rounded down or one less: 31 bits of the rest by 31 of the reciprocal.
    let more = (high((rest >> 6) as i32, near) >> 24) as u32;
    let left = rest.wrapping_sub(product_unsigned(more, divisor));
    below as u64 + (more + (left >= divisor as u64) as u32) as u64
}

/// 2^62 / `divisor` from below, by less than 4 units, for a normalised divisor in 2^31…2^32−1; the result lies in
/// 2^30−1…2^31−1.
///
/// As [`reciprocal`], in words of 32 bits and without the last comparison: 13 instructions on Cortex-M4.
#[inline]
pub(crate) fn near_reciprocal(divisor: u32) -> i32 {
    let seed = SEEDS.get(((divisor >> 24) & 127) as usize).copied().unwrap_or(u16::MAX);
    let mut y = (seed as i32) << 15;
    for _ in 0..2 {
        // 1 − d·y in units of 2^-30, never too large: y stays below the reciprocal, that is below 2^31. The upper word of the
        // product of d − 2^32 is less by y: of signed numbers, since compilers take that of unsigned ones by halves for one of
        // 64 bits, which is a call there.
        let product = high(y, divisor as i32).wrapping_add(y);
        let error = ((1 << 30) - 1i32).wrapping_sub(product);
        y = y.wrapping_add(high(y, error << 2));
    }
    y
}

/// As [`near_reciprocal`], by less than 8 units: the first step in halves of words, whose product is one instruction everywhere.
#[inline]
pub(crate) fn nearer_reciprocal(divisor: u32) -> i32 {
    let y = within_thousands(divisor).cast_signed();
    let product = high(y, divisor as i32).wrapping_add(y);
    let error = ((1 << 30) - 1i32).wrapping_sub(product);
    y.wrapping_add(high(y, error << 2))
}

/// floor((2^32 − 1) / `divisor`): an instruction where the core divides.
#[inline(always)]
pub(crate) fn quotient_of_ones(divisor: NonZeroU32) -> u32 {
    // ARMv6-M has no divider, as it has no long products.
    if BY_HALVES && (2..1 << 17).contains(&divisor.get()) {
        stepwise_quotient_of_ones(divisor.get())
    } else {
        u32::MAX / divisor
    }
}

/// The same of divisors in 2…2^17, by products of words.
#[inline(always)]
fn stepwise_quotient_of_ones(divisor: u32) -> u32 {
    let zeros = divisor.leading_zeros();
    let near = within_thousands(divisor << zeros);
    let mut quotient = near >> (30 - zeros);
    let mut rest = u32::MAX.wrapping_sub(quotient.wrapping_mul(divisor));
    // Of what is left, below 2^19, 13 bits more each time: then less than a unit.
    for _ in 0..2 {
        let more = rest.wrapping_mul(near >> 18) >> (44 - zeros);
        quotient = quotient.wrapping_add(more);
        rest = rest.wrapping_sub(more.wrapping_mul(divisor));
    }
    quotient.wrapping_add((rest >= divisor) as u32)
}

/// 2^62 / `divisor` from below, within 2^-13 of itself, as [`near_reciprocal`] without its last step and by products of words.
#[inline(always)]
fn within_thousands(divisor: u32) -> u32 {
    let seed = SEEDS.get(((divisor >> 24) & 127) as usize).copied().unwrap_or(u16::MAX) as u32;
    // 1 − d·y in units of 2^-31, within 2^-7, of the divisor's upper half rounded up: y stays below the reciprocal.
    let error = (1u32 << 31).wrapping_sub(seed.wrapping_mul((divisor >> 16) + 1)) as i32;
    (seed << 15).wrapping_add_signed((seed.cast_signed().wrapping_mul(error >> 9)) >> 7)
}

/// seed·2^16 ≈ 2^63 / divisor for the divisors that share their top eight bits, 128 + i.
const SEEDS: [u16; 128] = {
    let mut seeds = [0; 128];
    let mut i = 0;
    while i < 128 {
        // The middle of the interval is (128 + i + ½)·2^24: 2^63 over that, over 2^16.
        let seed = (1u64 << 47) / (((257 + 2 * i as u64) << 24) >> 1);
        seeds[i] = if seed > u16::MAX as u64 { u16::MAX } else { seed as u16 };
        i += 1;
    }
    seeds
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stepwise_quotients_are_exact() {
        for divisor in 2..1 << 17 {
            assert_eq!(stepwise_quotient_of_ones(divisor), u32::MAX / divisor, "{divisor}");
        }
    }

    #[test]
    fn near_reciprocals_are_below_and_nearer() {
        for i in 0..1u64 << 22 {
            let divisor = (1u64 << 31 | (i * 1_000_003) & 0x7fff_ffff) as u32;
            // In quarters of a unit: four units are not reached, with what a floor cuts off.
            let (found, exact) = (near_reciprocal(divisor) as i64, (1u128 << 64) / divisor as u128);
            let off = exact as i64 - 4 * found;
            assert!((0..16).contains(&off), "{divisor}: {off} quarters of a unit off");
            // Over 2^35 that is what a ratio of a number up to the divisor is off by, in units.
            assert!(
                off as u64 * divisor as u64 <= 9 << 32,
                "{divisor}: more than 1 1/8 unit of a ratio"
            );
        }
        assert_eq!(near_reciprocal(u32::MAX), (1 << 30) - 1);
    }

    #[test]
    fn nearer_reciprocals_are_below_and_near() {
        for i in 0..1u64 << 22 {
            // A prime's multiples, over all divisors; the ends too.
            let divisor = (1u64 << 31 | (i * 1_000_003) & 0x7fff_ffff) as u32;
            let found = nearer_reciprocal(divisor) as i64;
            let exact = ((1u64 << 62) / divisor as u64) as i64;
            assert!(
                found > 0 && found <= exact && exact - found < 8,
                "{divisor}: {found}, not {exact}"
            );
        }
        assert!(nearer_reciprocal(u32::MAX) >= (1 << 30) - 7);
    }
}
