//! sRGB: round trips, ends and order over every argument there is. How far the functions are from the true ones is
//! measured in `functions.rs`.

use fixel::srgb::{decode, decode_wide, encode};

/// Cut off, rounded to the nearest, and by way of `decode_wide`.
#[test]
fn every_level_comes_back() {
    for level in 0..=255u8 {
        let same = u32::from(level);
        let encoded = encode(decode(level));
        assert_eq!(encoded >> 16, same);
        assert_eq!((encoded + 0x8000) >> 16, same);
        // level/255 in units of 2^-24, rounded up: a level cut off must not be one of the next below.
        let fraction = ((u64::from(level) << 24).div_ceil(255)) as i32;
        assert_eq!(encode(decode_wide(fraction) as i32) >> 16, same);
    }
}

/// All 2^28 + 1 of them.
#[test]
fn encode_never_falls() {
    let mut last = 0;
    for linear in 0..=1 << 28 {
        let level = encode(linear);
        assert!(level >= last, "{linear}: {level} after {last}");
        last = level;
    }
    assert_eq!(last, 255 << 16);
}

#[test]
fn ends_are_exact() {
    for linear in [i32::MIN, -1, 0] {
        assert_eq!(encode(linear), 0);
    }
    for linear in [1 << 28, (1 << 28) + 1, i32::MAX] {
        assert_eq!(encode(linear), 255 << 16);
    }
    assert_eq!((decode(0), decode(255)), (0, 1 << 28));
    assert_eq!((decode_wide(0), decode_wide(1 << 24)), (0, 1 << 28));
}

/// Rises as long as a unit more of the argument is more than the error: by 2.4 in 2^24·1.055 or more of itself, against
/// 2^-28; below 0.04045 by 1.2 units.
#[test]
fn decode_wide_rises() {
    for near in [i32::MIN + 1, -5, 0, 678_638, 678_639, 1 << 24, 1 << 26] {
        for encoded in near.saturating_sub(1000).max(i32::MIN + 1)..near.saturating_add(1000) {
            assert!(decode_wide(encoded) > decode_wide(encoded - 1), "{encoded}");
        }
    }
    for level in 1..=255 {
        assert!(decode(level) > decode(level - 1));
    }
}
