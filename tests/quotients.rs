//! Quotients by a reciprocal are floor(n/d), to the bit.

use fixel::num::{Divisor, Word};
use proptest::prelude::*;

/// The largest quotient.
const MOST: i64 = (1 << 31) - 16;

fn exact(numerator: i64, divisor: u32) -> i64 {
    numerator.div_euclid(divisor as i64)
}

/// Numerators around the multiples of `divisor` by `quotient`.
fn check(divisor: u32, quotient: i64) {
    let by = Divisor::new(divisor);
    for off in [-1, 0, 1, divisor as i64 / 2] {
        let numerator = quotient * divisor as i64 + off;
        let expected = exact(numerator, divisor);
        if expected.abs() <= MOST {
            assert_eq!(by.floor(numerator) as i64, expected, "{numerator} / {divisor}");
        }
        if expected.abs() <= 1 << 26 {
            assert_eq!(
                by.floor_small(numerator) as i64,
                expected,
                "{numerator} / {divisor}, small"
            );
        }
    }
}

/// Every divisor of 13 bits by every numerator of 13 bits, either sign.
#[test]
fn every_small_quotient() {
    for divisor in 1..1 << 13 {
        let by = Divisor::new(divisor);
        for numerator in (-1 << 13..1 << 13).step_by(1 + divisor as usize % 7) {
            let expected = exact(numerator, divisor) as i32;
            assert_eq!((by.floor(numerator), by.floor_small(numerator)), (expected, expected));
        }
    }
}

/// A divisor for each of 2^20 mantissas, at every length, next to multiples of the largest quotients.
#[test]
fn every_mantissa_of_twenty_bits() {
    for top in 0..1u32 << 20 {
        let divisor = (1 << 31 | top << 11 | top.wrapping_mul(0x9e37_79b9) >> 21) >> (1 + top % 31);
        for quotient in [MOST, -MOST, (1 << 26) - 1, -(1 << 26), 1 << 21] {
            check(divisor, quotient);
        }
    }
    [(1, 5), (1 << 31, MOST), (1 << 31, -MOST)]
        .into_iter()
        .for_each(|(divisor, quotient)| check(divisor, quotient));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200_000))]

    #[test]
    fn any_quotient(divisor in 1..=1u32 << 31, shift in 0..31u32, quotient in any::<i32>(), down in 0..31u32) {
        check((divisor >> shift).max(1), (quotient >> down) as i64);
    }

    /// Numbers that are out of range give some number.
    #[test]
    fn nothing_panics(divisor in any::<u32>(), numerator in any::<i64>()) {
        let by = Divisor::new(divisor);
        let _ = (by.floor(numerator), by.floor_small(numerator), (numerator as i32).ratio(divisor as i32));
    }

    /// Of numbers up to twice the divisor, whatever its length.
    #[test]
    fn ratios(divisor in 1..=1i32 << 30, shift in 0..30u32, part in any::<u32>(), off in -2..3i64) {
        let divisor = (divisor >> shift).max(1) as i64;
        for at in [0, divisor, 2 * divisor, (part as i64 * 2 * divisor) >> 32] {
            for numerator in [at + off, -at + off] {
                if numerator.abs() <= 2 * divisor {
                    let expected = (numerator << 30).div_euclid(divisor);
                    let found = (numerator as i32).ratio(divisor as i32);
                    prop_assert_eq!(found, expected, "{} / {}", numerator, divisor);
                    let expected = ((numerator as i128) << 62).div_euclid(divisor as i128);
                    prop_assert_eq!(numerator.ratio(divisor), expected, "{} / {}", numerator, divisor);
                }
            }
        }
    }

    /// What divides in the geometry, both words alike.
    #[test]
    fn words_divide_alike(half in 1..=1i32 << 30, quotient in any::<i32>(), down in 0..31u32, off in -2..3i64) {
        let divisor = 2 * half as i64;
        let numerator = (quotient >> down) as i64 * divisor + off;
        let expected = numerator.div_euclid(divisor);
        prop_assume!(expected.abs() <= MOST);
        let (narrow, wide) = (half.twice(), (half as i64).twice());
        prop_assert_eq!(i32::large_quotient(numerator, &narrow) as i64, expected);
        prop_assert_eq!(i64::large_quotient(numerator as i128, &wide) as i64, expected);
        if expected.abs() <= 1 << 26 {
            prop_assert_eq!(i32::quotient(numerator, &narrow) as i64, expected);
            prop_assert_eq!(i64::quotient(numerator as i128, &wide) as i64, expected);
        }
    }
}
