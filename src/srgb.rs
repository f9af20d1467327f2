//! sRGB: from stored levels to linear light, in which colours are blended and averaged, and back.
//!
//! decode: c/12.92 up to c = 0.04045, ((c + 0.055)/1.055)^2.4 above. encode: 12.92·c up to c = 0.0031308,
//! 1.055·c^(1/2.4) − 0.055 above. Linear light is in units of 2^-28 of full, as in [`Rgba`](crate::blend::Rgba). Alpha is
//! never converted.
//!
//! Integers only; the tables are computed by the compiler.
//!
//! | function | tables | error (`tests/srgb.rs`) |
//! |---|---|---|
//! | [`decode`] | 1024 bytes | ½ unit |
//! | [`decode_wide`] | 276 bytes | ½ unit + 2^-28 of the value |
//! | [`encode`] | 1224 bytes | 0…0.0002 level |
//!
//! A surface of half the light is not half as many levels:
//!
//! ```
//! use fixel::blend::{ONE, Rgba};
//! use fixel::srgb::{decode, encode};
//! let white = Rgba { color: [decode(255); 3], alpha: ONE / 2 };
//! let black = Rgba { color: [decode(0); 3], alpha: ONE };
//! assert_eq!(white.over(black).color.map(|c| encode(c) >> 16), [187; 3]); // 187.5
//! ```

use crate::blend::ONE;

/// The linear value of a level of 0…255 in units of 2^-28 of full, rounded to nearest. A table of 1024 bytes.
///
/// ```
/// use fixel::srgb::decode;
/// assert_eq!((decode(0), decode(128), decode(255)), (0, 57_944_612, 1 << 28)); // 0.215861
/// ```
#[inline]
pub fn decode(level: u8) -> i32 {
    LEVELS.get(level as usize).copied().unwrap_or(0)
}

/// The linear value of any encoded number: in units of 2^-24 of full, ±128 times full; the result in units of 2^-28, up
/// to 2^45. Beyond full the power curve goes on, below 0 the straight part.
///
/// **Error**: ½ unit + 2^-28 of the value.
///
/// ```
/// use fixel::srgb::decode_wide;
/// assert_eq!(decode_wide(1 << 24), 1 << 28);
/// assert_eq!(decode_wide(-1 << 24), -20_776_738); // -1/12.92
/// assert_eq!(decode_wide(2 << 24) >> 28, 4); // 4.954
/// ```
pub fn decode_wide(encoded: i32) -> i64 {
    // 0.04045·2^24 = 678638.4.
    if encoded <= 678_638 {
        // 1/12.92·2^4 = 400/323 in units of 2^-31, 2^31.3: the product stays below 2^62.4.
        const SLOPE: i64 = ((400 << 32) / 323 + 1) / 2;
        return (encoded as i64 * SLOPE + (1 << 30)) >> 31;
    }
    // (c + 0.055)/1.055 is this over 211·2^24, exactly; 2^28.2…2^38.7.
    let base = 200 * encoded as u64 + (11 << 24);
    let zeros = base.leading_zeros();
    // In ½…1, in units of 2^-32, cut; its five bits below the first pick the interval.
    let mantissa = ((base << zeros) >> 32) as u32;
    let power = power_12_5(mantissa);
    // Times 2^(12/5·(32 − zeros))/(211/256)^(12/5), a power of two and one of five factors in units of 2^-30.
    let twelfths = 12 * (32 - zeros as i32);
    let whole = twelfths.div_euclid(5);
    let factor = FACTORS.get(twelfths.rem_euclid(5) as usize).copied().unwrap_or(0);
    // whole is in −8…16 and the product below 2^63.5, units of 2^-62 before and 2^-28 after.
    let shift = (34 - whole) as u32 & 63;
    ((power * factor as u64 + ((1 << shift) >> 1)) >> shift) as i64
}

/// The level of a linear value: in units of 2^-16 level, 0…255·2^16, for a value in units of 2^-28 of full, which is
/// taken as the nearer end where it lies outside 0…1.
///
/// 0 and 1 are exact, and a brighter value is never a lower level. **Error**: 0 to 12 units too much, 0.0002 level, and
/// never too little: so a level that was decoded, cut off with `>> 16`, is the same level again. To round to the nearest
/// level instead, add 2^15 first.
///
/// Parabolas through a table of 34 entries per octave, 1224 bytes.
///
/// ```
/// use fixel::srgb::{decode, encode};
/// assert_eq!(encode(decode(77)) >> 16, 77);
/// assert_eq!((encode(0), encode(-5), encode(1 << 28), encode(i32::MAX)), (0, 0, 255 << 16, 255 << 16));
/// ```
pub fn encode(linear: i32) -> u32 {
    if linear <= 0 {
        return 0;
    }
    let linear = linear as u32;
    if linear >= ONE as u32 {
        return 255 << 16;
    }
    // 0.0031308·2^28 = 840416.98.
    if linear <= 840_416 {
        // 12.92·255·2^-12 in units of 2^-32; rounded up.
        const SLOPE: u64 = ((1292 * 255) << 20) / 100 + 1;
        return ((linear as u64 * SLOPE + u32::MAX as u64) >> 32) as u32;
    }
    // 4 zeros in the octave below 1. Five bits below the first pick the interval, 22 are left.
    let octave = linear.leading_zeros().wrapping_sub(4);
    let aligned = linear << (octave & 31);
    let interval = ((aligned >> 22) & 31) as usize;
    let t = (aligned & ((1 << 22) - 1)) as i64;
    let entries = CURVE
        .get(octave as usize)
        .and_then(|curve| curve.get(interval..interval + 3));
    let Some(&[a, b, c]) = entries else {
        // Never: octave is in 0…8, interval in 0…31.
        return 0;
    };
    // a + (b − a)·t + (c − 2b + a)·t·(t − 1)/2, exact until the one shift, so that it rises with t. The first slope is
    // below 2^17.5: products below 2^62.6.
    let (slope, bend) = (b as i64 - a as i64, c as i64 - 2 * b as i64 + a as i64);
    let rise = t * ((slope << 23) + bend * (t - (1 << 22)));
    ((a as i64 + (rise >> 45)) as u32).min(255 << 16)
}

/// m^(12/5) in units of 2^-32 for a mantissa m in ½…1 in units of 2^-32: (c·(1 + u))^(12/5) with c in the middle of m's
/// interval, |u| ≤ 2^-6. What the series leaves out is below 2^-28.8 of it.
#[inline]
fn power_12_5(mantissa: u32) -> u64 {
    let interval = ((mantissa >> 26) & 31) as usize;
    let middle = 1 << 31 | (interval as u32) << 26 | 1 << 25;
    let inverse = INVERSES.get(interval).copied().unwrap_or(0);
    let power = POWERS.get(interval).copied().unwrap_or(0);
    // Units of 2^-32 and 2^-31 make 2^-63; u in units of 2^-36 is at most 2^30.
    let u = ((mantissa as i64 - middle as i64) * inverse as i64) >> 27;
    // 12/5·u + 42/25·u² + 28/125·u³, coefficients in units of 2^-28.
    let series = SERIES.iter().fold(0, |sum, &c| c + ((u * sum) >> 36));
    let change = (u * series) >> 30;
    (power as i64 + ((power as i64 * change) >> 34)) as u64
}

/// The binomials of 12/5 over 3, 2 and 1 in units of 2^-28, rounded to nearest.
const SERIES: [i64; 3] = [60_129_542, 450_971_566, 644_245_094];

/// 1 in the units of what the compiler computes.
const UNIT: u128 = 1 << 60;

/// x^(numerator/denominator), both in units of 2^-60 for x in 2^-12…1.04: Newton's method from above, ended where it no
/// longer falls; off by fewer than 200 units.
const fn power(x: u128, numerator: u32, denominator: u32) -> u128 {
    let mut root = 5 * UNIT / 4;
    loop {
        let slope = integer_power(root, denominator - 1);
        let next = ((denominator as u128 - 1) * root + (x << 60) / slope) / denominator as u128;
        if next >= root {
            return integer_power(root, numerator);
        }
        root = next;
    }
}

const fn integer_power(x: u128, exponent: u32) -> u128 {
    let (mut product, mut i) = (UNIT, 0);
    while i < exponent {
        product = (product * x) >> 60;
        i += 1;
    }
    product
}

/// Linear values of the levels in units of 2^-28, rounded to nearest.
const LEVELS: [i32; 256] = {
    let mut levels = [0; 256];
    let mut i = 0;
    while i < 256 {
        let level = i as u128;
        // 0.04045·255 = 10.3. (level/255 + 0.055)/1.055 = (40·level + 561)/10761.
        let linear = if level <= 10 {
            level * 100 * UNIT / (255 * 1292)
        } else {
            power((40 * level + 561) * UNIT / 10_761, 12, 5)
        };
        levels[i] = ((linear + (1 << 31)) >> 32) as i32;
        i += 1;
    }
    levels
};

/// What [`encode`] adds to all of the curve, in units of 2^-16 level: the least with which it is never too little. The
/// parabolas lie up to 10 units below the curve (4.96/32³ level in the octave below 1), and rounding takes up to 1.
const RAISE: u128 = 11;

/// 255·(1.055·x^(5/12) − 0.055) + RAISE in units of 2^-16, rounded to nearest, at x = 2^-(octave+1)·(1 + i/32).
const CURVE: [[u32; 34]; 9] = {
    let mut curve = [[0; 34]; 9];
    let mut octave = 0;
    while octave < 9 {
        let mut i = 0;
        while i < 34 {
            let x = (32 + i as u128) << (54 - octave);
            // 255·1055/1000 = 269.025; 255·0.055 = 14.025.
            let level = (269_025 * power(x, 5, 12) - 14_025 * UNIT) / 1000;
            curve[octave][i] = (((level + (1 << 43)) >> 44) + RAISE) as u32;
            i += 1;
        }
        octave += 1;
    }
    curve
};

/// 1/c for the middles c = (65 + 2i)/128 of the 32 intervals of ½…1, in units of 2^-31, rounded to nearest.
const INVERSES: [u32; 32] = {
    let mut inverses = [0; 32];
    let mut i = 0;
    while i < 32 {
        inverses[i] = ((1u64 << 39) / (65 + 2 * i as u64)).div_ceil(2) as u32;
        i += 1;
    }
    inverses
};

/// c^(12/5) in units of 2^-32, rounded to nearest.
const POWERS: [u32; 32] = {
    let mut powers = [0; 32];
    let mut i = 0;
    while i < 32 {
        powers[i] = ((power((65 + 2 * i as u128) << 53, 12, 5) + (1 << 27)) >> 28) as u32;
        i += 1;
    }
    powers
};

/// 2^(i/5)/(211/256)^(12/5) in units of 2^-30, rounded to nearest.
const FACTORS: [u32; 5] = {
    let divisor = power(211 << 52, 12, 5);
    let mut factors = [0; 5];
    let mut i = 0;
    while i < 5 {
        // 2^(i/5) = 2·2^-((5 − i)/5).
        let factor = 2 * (power(UNIT / 2, 5 - i, 5) << 60) / divisor;
        factors[i as usize] = ((factor + (1 << 29)) >> 30) as u32;
        i += 1;
    }
    factors
};
