//! `reciprocal` is floor(2^63 / d), exactly, for every divisor tried: all that share their top 21 bits with one, the ends
//! of each table interval, and random ones.

use fixel::num::reciprocal;
use proptest::prelude::*;

fn exact(divisor: u32) -> u64 {
    (1u64 << 63) / divisor as u64
}

/// One divisor for each of 2^20 mantissas, its low bits all 0, all 1, and mixed: every seed with every first step.
#[test]
fn every_mantissa_of_twenty_bits() {
    for top in 0..1u32 << 20 {
        for low in [0, 0x7ff, 0x400, top.wrapping_mul(0x9e37_79b9) >> 21] {
            let divisor = 1 << 31 | top << 11 | low;
            assert_eq!(reciprocal(divisor), exact(divisor), "{divisor:#x}");
        }
    }
}

/// All of them: that one correction is enough is known from here. Half a minute.
#[test]
#[ignore = "walks 2^31 divisors"]
fn every_divisor() {
    for divisor in 1 << 31..=u32::MAX {
        assert_eq!(reciprocal(divisor), exact(divisor), "{divisor:#x}");
    }
}

/// Around the ends of the 128 intervals of the seed table, and of the domain.
#[test]
fn every_interval_of_the_table() {
    for interval in 0..=128u64 {
        let edge = (128 + interval) << 24;
        for divisor in edge.saturating_sub(2000).max(1 << 31)..(edge + 2000).min(1 << 32) {
            assert_eq!(reciprocal(divisor as u32), exact(divisor as u32), "{divisor:#x}");
        }
    }
    assert_eq!(reciprocal(u32::MAX), 1 << 31);
    assert_eq!(reciprocal(1 << 31), 1 << 32);
}

/// Divisors of which 2^63 is nearly a multiple, so that one unit more or less in the estimate is another floor.
#[test]
fn next_to_exact_quotients() {
    for quotient in ((1u64 << 31) + 1..1 << 32).step_by(4093) {
        let divisor = (1u64 << 63) / quotient;
        for divisor in divisor - 1..=divisor + 1 {
            let divisor = divisor.clamp(1 << 31, u32::MAX as u64) as u32;
            assert_eq!(reciprocal(divisor), exact(divisor), "{divisor:#x}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100_000))]

    #[test]
    fn any_divisor(divisor in any::<u32>()) {
        // One below the domain counts as its least.
        prop_assert_eq!(reciprocal(divisor), exact(divisor.max(1 << 31)));
        prop_assert_eq!(reciprocal(divisor | 1 << 31), exact(divisor | 1 << 31));
    }
}
