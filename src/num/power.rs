//! Powers of fractions, as a highlight needs them.
//!
//! Measured errors: `docs/functions.md`.

/// `base`^`exponent`: base and result in 0…2^30 in units of 2^-30, the exponent in units of 2^-16, all of `u32`
/// (0…65535.99998).
///
/// Within 3 units (3·2^-30) for every base and exponent; 0^0 = 1 and 0^x = 0 for every other x, 1^x = 1, both exactly.
/// A base outside 0…2^30 is taken as the nearer end.
///
/// That is the error of the function. An error δ of the *base* is multiplied by a·base^(a−1) as in any arithmetic: by
/// up to 240 at exponent 240, and without bound towards base 0 for exponents below 1.
///
/// 2^(a·log₂ base), both functions from a table of 32 entries and a polynomial; 288 bytes of tables, 13 long
/// multiplications, no division.
///
/// ```
/// use fixel::num::power;
/// const ONE: i32 = 1 << 30;
/// assert_eq!(power(ONE / 2, 3 << 16), ONE / 8);
/// assert_eq!(power(ONE / 4, 1 << 15), ONE / 2); // a square root
/// assert_eq!(power(ONE / 2, 10_000 << 16), 0);
/// assert_eq!((power(0, 0), power(0, 1)), (ONE, 0));
/// ```
pub fn power(base: i32, exponent: u32) -> i32 {
    const ONE: i32 = 1 << 30;
    if exponent == 0 || base >= ONE {
        return ONE;
    }
    if base <= 0 {
        return 0;
    }
    let logarithm = minus_log2(base as u32);
    // Units of 2^-(58 + 16 − 32) = 2^-42. The high word is below 30·2^26, so that the sum fits 64 bits.
    let low = ((logarithm & u32::MAX as u64) * exponent as u64) >> 32;
    exp2_minus((logarithm >> 32) * exponent as u64 + low) as i32
}

/// −log₂(base·2^-30) in units of 2^-58 for 1 ≤ base < 2^30: 2^-30 of itself off near base 1, 2^-33 elsewhere.
#[inline]
fn minus_log2(base: u32) -> u64 {
    let zeros = base.leading_zeros();
    // The mantissa in 1…2 with 31 fraction bits. Its five bits below the first pick c with mantissa·c = 1 + t.
    let mantissa = base << zeros;
    let index = ((mantissa >> 26) & 31) as usize;
    let inverse = INVERSES.get(index).copied().unwrap_or(0);
    let inverse_log = INVERSE_LOGS.get(index).copied().unwrap_or(0);
    // |t| < 0.0197 in units of 2^-36. Exact in the last interval, the one next to base 1, where c = ½.
    let t = ((mantissa as i64 * inverse as i64 - (1 << 39)) >> 3) as i32;
    let series = LOG_SERIES.iter().fold(0, |sum, &c| c + product(t, sum, 36));
    // log₂ base = 2 − zeros − log₂ 2c + log₂(1 + t); the sum of the three is positive.
    let whole = (zeros.saturating_sub(2) as u64) << 58;
    (whole + ((inverse_log as u64) << 26)).wrapping_add_signed(-((t as i64 * series as i64) >> 8))
}

/// 2^-x in units of 2^-30, for x in units of 2^-42.
#[inline]
fn exp2_minus(x: u64) -> u32 {
    let whole = (x >> 42) as u32;
    if whole >= 31 {
        return 0;
    }
    // Five bits pick 2^-j/32, the rest r < 1/32 in units of 2^-36 gives the 1 − 2^-r that it loses.
    let step = EXP_STEPS.get(((x >> 37) & 31) as usize).copied().unwrap_or(0);
    let r = ((x >> 6) & ((1 << 31) - 1)) as i32;
    let series = EXP_SERIES.iter().fold(0, |sum, &c| c - product(r, sum, 36));
    let loss = product(r, series, 36) as u32;
    // Both products are cut, so that what is left is half a unit too much each: the 2^31 takes that back.
    let value = step - ((step as u64 * loss as u64 + (1 << 31)) >> 31) as u32;
    // At most 2^31 in units of 2^-31; the half that rounds is at most 2^30.
    (value + (1 << whole)) >> (whole + 1)
}

/// a·b·2^-shift, rounded down; the caller has shown that it fits.
#[inline(always)]
fn product(a: i32, b: i32, shift: u32) -> i32 {
    ((a as i64 * b as i64) >> shift) as i32
}

/// c for the mantissas 1 + i/32 … 1 + (i + 1)/32 in units of 2^-8: 1 over the middle, but ½ for the last.
pub(super) const INVERSES: [u8; 32] = {
    let mut inverses = [128; 32];
    let mut i = 0;
    while i < 31 {
        inverses[i] = ((1 << 15) / (65 + 2 * i)).div_ceil(2) as u8;
        i += 1;
    }
    inverses
};

/// log₂ 2c in units of 2^-32, rounded to nearest, bit by bit: squaring doubles a logarithm.
pub(super) const INVERSE_LOGS: [u32; 32] = {
    let mut logs = [0; 32];
    let mut i = 0;
    while i < 32 {
        logs[i] = log2((INVERSES[i] as u128) << 55);
        i += 1;
    }
    logs
};

/// log₂ of a number in 1…2 in units of 2^-62, in units of 2^-32.
pub(super) const fn log2(mut x: u128) -> u32 {
    let (mut log, mut bit) = (0u64, 0);
    while bit < 33 {
        x = (x * x) >> 62;
        let carry = x >> 63;
        log = 2 * log + carry as u64;
        x >>= carry;
        bit += 1;
    }
    log.div_ceil(2) as u32
}

/// 2^-j/32 in units of 2^-31, rounded to nearest: products of 2^-1/2, 2^-1/4 … 2^-1/32, each the root of the one
/// before.
pub(super) const EXP_STEPS: [u32; 32] = {
    let mut steps = [0; 32];
    let mut j = 0;
    while j < 32 {
        let (mut root, mut step, mut bit) = (1u128 << 61, 1u128 << 62, 5);
        while bit > 0 {
            bit -= 1;
            root = (root << 62).isqrt();
            if j >> bit & 1 == 1 {
                step = (step * root) >> 62;
            }
        }
        steps[j] = ((step + (1 << 30)) >> 31) as u32;
        j += 1;
    }
    steps
};

/// log₂(1 + t)/t in units of 2^-30, highest power first: ±1/(n·ln 2). What is left out, t⁶/(6·ln 2), is below 2^-30 of
/// t.
const LOG_SERIES: [i32; 5] = [309_816_401, -387_270_501, 516_360_668, -774_541_002, 1_549_082_005];

/// (1 − 2^-r)/r in units of 2^-31, highest power first: (ln 2)ⁿ/n!. What is left out, (r·ln 2)⁵/120, is below 2^-34.
const EXP_SERIES: [i32; 4] = [20_654_775, 119_194_166, 515_882_496, 1_488_522_236];
