//! Square roots and unit vectors without a divider: one seed table of 192 bytes serves all three.
//!
//! Measured errors: `docs/functions.md`.

/// floor(√`square`), exactly, for every `u64`.
///
/// The estimate from [`reciprocal_square_root`] is off by a few units of the normalised square; the remainder says how
/// many. (`u64::isqrt` divides 64 bits, a library call on every Cortex-M.)
///
/// ```
/// use fixel::num::square_root;
/// assert_eq!(square_root(99), 9);
/// assert_eq!(square_root(100), 10);
/// assert_eq!(square_root(u64::MAX), u32::MAX);
/// ```
pub fn square_root(square: u64) -> u32 {
    if square == 0 {
        return 0;
    }
    // An even shift is taken back by half of it: floor(floor(√(n·4^k)) / 2^k) = floor(√n).
    let shift = square.leading_zeros() & !1;
    let normalised = square << shift;
    let word = (normalised >> 32) as u32;
    // √(word·2^32) = word · (2^47/√word) / 2^31: a few units of 2^31…2^32 off, cut bits of the square included.
    let mut root = ((word as u64 * reciprocal_square_root(word) as u64) >> 31).min(u32::MAX as u64);
    let mut remainder = normalised.wrapping_sub(root * root) as i64;
    while remainder < 0 {
        root -= 1;
        remainder += 2 * root as i64 + 1;
    }
    while remainder > 2 * root as i64 {
        remainder -= 2 * root as i64 + 1;
        root += 1;
    }
    (root >> (shift / 2)) as u32
}

/// 2^47 / √`square` for a normalised square in 2^30…2^32−1; the result lies in 2^31…2^32−1.
///
/// As fractions: 1/√s in units of 2^-31 for s = `square`·2^-32 in ¼…1. Within 3·2^-32 of the true value, relatively. A
/// smaller square is taken as 2^30.
///
/// A seed from a table of 96 entries is within 2^-7; a step of third order, y·(1 + e/2 + 3e²/8) with e = 1 − s·y²,
/// takes that to 2^-19, Newton's y·(1 + e/2) to what 32 bits hold. Five long multiplications.
///
/// ```
/// use fixel::num::reciprocal_square_root;
/// let y = reciprocal_square_root(1 << 31); // 1/√½
/// assert!(y.abs_diff(3_037_000_500) <= 2);
/// ```
#[inline]
pub fn reciprocal_square_root(square: u32) -> u32 {
    let square = square.max(1 << 30);
    let y = SEEDS.get(((square >> 25) - 32) as usize).copied().unwrap_or(1 << 15) as u32;
    // e in units of 2^-30, |e| < 2^-5.8, and e² in units of 2^-28: 3/8 of it are 3/2 units of 2^-30.
    let error = (1 << 30) - high(square as u64 * (y * y) as u64) as i32;
    let error_squared = high_signed(error as i64 * error as i64);
    let factor = (error >> 1) + error_squared + (error_squared >> 1);
    let y = corrected(y << 16, high_signed((y << 15) as i64 * factor as i64) << 3);

    // y² in units of 2^-30, rounded: y ≤ 2^32 − 1 leaves room for the half. |e| < 2^-18, in units of 2^-32.
    let y_squared = high(y as u64 * y as u64 + HALF);
    let error = (ONE.wrapping_sub(square as u64 * y_squared as u64) as i64 >> 30) as i32;
    let step = high_signed((y >> 1) as i64 * error as i64 + HALF as i64);
    corrected(y, step)
}

/// An estimate in 2^31…2^32 plus a small step, but 2^32 − 1 where that passes the word.
#[inline(always)]
fn corrected(estimate: u32, step: i32) -> u32 {
    let sum = estimate.wrapping_add_signed(step);
    if sum < 1 << 30 { u32::MAX } else { sum }
}

/// The same direction with length 1, in units of 2^-30; `None` for the zero vector.
///
/// Every component is within 1.7·2^-30 of the true one, however long or short the vector.
///
/// ```
/// use fixel::num::unit;
/// assert_eq!(unit([0, 0, -7]), Some([0, 0, -1 << 30]));
/// assert_eq!(unit([3, 0, 4]).map(|u| u.map(|c| (c + 50) / 100)), Some([6_442_451, 0, 8_589_935]));
/// assert_eq!(unit([0; 3]), None);
/// ```
#[inline]
pub fn unit(vector: [i32; 3]) -> Option<[i32; 3]> {
    unit_by(vector, reciprocal_square_root)
}

/// [`unit`](fn@unit) with a reciprocal square root of any precision.
#[inline(always)]
pub(super) fn unit_by(vector: [i32; 3], reciprocal_square_root: impl Fn(u32) -> u32) -> Option<[i32; 3]> {
    // −2^31 has no magnitude in 31 bits; one unit less is 2^-31 of it.
    let vector = vector.map(|c| c.max(-i32::MAX));
    let all_bits = vector.iter().fold(0, |bits, c| bits | c.unsigned_abs());
    if all_bits == 0 {
        return None;
    }
    // The largest component in 2^30…2^31, so the sum of squares in 2^60…3·2^62.
    let room = all_bits.leading_zeros().saturating_sub(1);
    let vector = vector.map(|c| c << room);
    let sum: u64 = vector.iter().map(|&c| (c as i64 * c as i64) as u64).sum();
    // As a word of 2^30…2^32: from 2^62 up the high one, below that times 4, which is taken back by half.
    let (word, down) = if sum >> 62 == 0 {
        ((sum >> 30) as u32, 0)
    } else {
        (high(sum), 1)
    };
    let inverse = reciprocal_square_root(word);
    // c/√sum = c · inverse · 2^-(62 + down). |c·inverse| ≤ (2^31 − 1)·(2^32 − 1), which leaves room for the half.
    let half = (HALF as i64) << down;
    Some(vector.map(|c| high_signed(c as i64 * inverse as i64 + half) >> down))
}

/// [`unit`](fn@unit) of longer numbers: differences of positions, cross products.
///
/// Every component is within 3·2^-30 of the true one.
///
/// ```
/// use fixel::num::{unit, unit_wide};
/// assert_eq!(unit_wide([3 << 60, 0, -4 << 60]), unit([3, 0, -4]));
/// ```
#[inline]
pub fn unit_wide(vector: [i64; 3]) -> Option<[i32; 3]> {
    unit(cut(vector))
}

/// The same direction in 31 bits and a sign; as it is where that is enough.
#[inline]
pub(super) fn cut(vector: [i64; 3]) -> [i32; 3] {
    let all_bits = vector.iter().fold(0, |bits, c| bits | c.unsigned_abs());
    // 31 bits and a sign remain; what is cut off is below 2^-30 of the largest. As a rule nothing is, and that is seen without a
    // count of zeros.
    if all_bits >> 31 == 0 {
        return vector.map(|c| c as i32);
    }
    let excess = 33u32.saturating_sub(all_bits.leading_zeros());
    vector.map(|c| (c >> excess) as i32)
}

/// The dot product of two unit vectors in units of 2^-60; components of at most 2^30 + 8.
///
/// ```
/// use fixel::num::dot;
/// assert_eq!(dot([1 << 30, 0, 0], [-1 << 29, 1 << 29, 0]), -1 << 59);
/// ```
#[inline]
pub fn dot(a: [i32; 3], b: [i32; 3]) -> i64 {
    a.into_iter().zip(b).map(|(a, b)| a as i64 * b as i64).sum()
}

/// Bits 32 and up: a register on its own.
#[inline(always)]
fn high(product: u64) -> u32 {
    (product >> 32) as u32
}

/// Bits 32 and up.
#[inline(always)]
fn high_signed(product: i64) -> i32 {
    (product >> 32) as i32
}

/// Half a unit of [`high`].
const HALF: u64 = 1 << 31;

/// 1 in units of 2^-62.
const ONE: u64 = 1 << 62;

/// seed·2^16 ≈ 2^47/√square for the squares that share their top seven bits, 32 + i.
const SEEDS: [u16; 96] = {
    let mut seeds = [0; 96];
    let mut i = 0;
    while i < 96 {
        // The middle of the interval is (32 + i + ½)·2^25: 2^31 over its root.
        let middle = (65 + 2 * i as u64) << 24;
        seeds[i] = ((1u64 << 62) / middle).isqrt() as u16;
        i += 1;
    }
    seeds
};
