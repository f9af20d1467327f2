//! The middle precision: the seeds of [`Table`](super::Table) and one Newton step.

use super::power::{EXP_STEPS, INVERSE_LOGS, INVERSES};
use super::root::unit_by;
use super::table::{reciprocal_seed, root_seed};
use super::{Precision, dot};

/// Reciprocals and roots from [`Table`](super::Table)'s seeds and one Newton step, powers from shorter polynomials: two thirds of
/// the long multiplications of [`TwoSteps`](super::TwoSteps), a sixth of them in a power.
///
/// ```
/// use fixel::num::{OneStep, Precision, power, unit};
/// let [x, y, z] = OneStep::unit([3, 0, 4]).unwrap();
/// assert!(x.abs_diff(644_245_094) < 16 && y == 0 && z.abs_diff(858_993_459) < 16);
/// assert!(OneStep::power(1 << 29, 3 << 16).abs_diff(1 << 27) < 1 << 12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OneStep {}

impl Precision for OneStep {
    const RECIPROCAL_ERROR: u32 = 32;
    const ROOT_ERROR: u32 = 32;
    const UNIT_ERROR: u32 = 16;
    const DOT_ERROR: u32 = 1;
    const POWER_ERROR: u32 = 1 << 12;
    const LONG: bool = false;

    #[inline]
    fn reciprocal(divisor: u32) -> u64 {
        let divisor = divisor.max(1 << 31);
        let seed = reciprocal_seed(divisor);
        // y·(1 + e) with e = 1 − d·y in units of 2^-30, |e| < 2^-14: two bits less leave room for the product.
        let error = ((1i64 << 47) - (divisor as u64 * seed as u64) as i64) >> 17;
        let step = (seed as i32 * (error >> 2) as i32) >> 12;
        ((seed as u64) << 16).saturating_add_signed(step as i64).min(1 << 32)
    }

    #[inline]
    fn reciprocal_square_root(square: u32) -> u32 {
        let square = square.max(1 << 30);
        let seed = root_seed(square);
        // y·(1 + e/2) with e = 1 − s·y² in units of 2^-30, |e| < 2^-12.7: two bits less leave room for the product.
        let product = (square as u64 * (seed * seed) as u64) >> 32;
        let error = (1 << 30) - product as i32;
        let step = (seed as i32 * (error >> 2)) >> 13;
        (seed << 16).saturating_add_signed(step).max(1 << 31)
    }

    #[inline]
    fn unit(vector: [i32; 3]) -> Option<[i32; 3]> {
        unit_by(vector, Self::reciprocal_square_root)
    }

    #[inline(always)]
    fn dot(a: [i32; 3], b: [i32; 3]) -> i32 {
        ((dot(a, b) + (1 << 29)) >> 30) as i32
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
        // Units of 2^-42.
        exp2_minus(minus_log2(base as u32) as u64 * exponent as u64)
    }
}

/// −log₂(base·2^-30) in units of 2^-26 for 1 ≤ base < 2^30.
#[inline(always)]
fn minus_log2(base: u32) -> u32 {
    let zeros = base.leading_zeros();
    // As the exact function does: the mantissa in 1…2, five bits pick c with mantissa·c = 1 + t, |t| < 0.0197.
    let mantissa = base << zeros;
    let index = ((mantissa >> 26) & 31) as usize;
    let inverse = INVERSES.get(index).copied().unwrap_or(0) as u32;
    let inverse_log = INVERSE_LOGS.get(index).copied().unwrap_or(0);
    // In units of 2^-36, of which 32 bits hold t, but not the 1.
    let t = (mantissa >> 3).wrapping_mul(inverse) as i32;
    // log₂(1 + t) = t·(1.4427 − t·(0.7213 − 0.4809·t)), the inner bracket in units of 2^-15.
    let inner = 23_637 - ((15_758 * (t >> 21)) >> 15);
    let outer = 1_549_082_005 - (((t >> 16) * inner) >> 5);
    let log = ((t as i64 * outer as i64) >> 40) as i32;
    let whole = zeros.wrapping_sub(2) << 26;
    (whole + (inverse_log >> 6)).wrapping_sub(log as u32)
}

/// 2^-x in units of 2^-30, for x in units of 2^-42.
#[inline(always)]
fn exp2_minus(x: u64) -> i32 {
    let whole = (x >> 42) as u32;
    if whole >= 31 {
        return 0;
    }
    let step = EXP_STEPS.get(((x >> 37) & 31) as usize).copied().unwrap_or(0);
    // r < 1/32 in units of 2^-30: 1 − 2^-r = r·(0.6931 − r·(0.2402 − 0.0555·r)).
    let r = ((x >> 12) & ((1 << 25) - 1)) as u32;
    let inner = 15_744 - ((3_638 * (r >> 15)) >> 15);
    let outer = 45_426 - (((r >> 14) * inner) >> 16);
    let loss = ((r >> 9) * outer) >> 15;
    let value = step - (((step >> 16) * loss) >> 6);
    (value >> (whole + 1)) as i32
}
