//! Upper words of products.
//!
//! Cores of ARMv6-M have no product of more than 32 bits: the library's is a call of 52 instructions for 64 bits, of which
//! 32 are thrown away. From four products of halves it is 20, with the same bits.

/// Whether products of 64 bits are calls: ARMv6-M, which is the one of its family without compare-and-swap.
pub(super) const BY_HALVES: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));

/// Whether one instruction adds such a product to 64 bits, or the machine's words have them.
pub(crate) const LONG_SUM: bool = !BY_HALVES && cfg!(any(target_arch = "arm", target_pointer_width = "64"));

/// a·b.
#[inline(always)]
pub(crate) fn product(a: i32, b: i32) -> i64 {
    if BY_HALVES {
        (high(a, b) as i64) << 32 | a.wrapping_mul(b) as u32 as i64
    } else {
        a as i64 * b as i64
    }
}

/// a·b.
#[inline(always)]
pub(crate) fn product_unsigned(a: u32, b: u32) -> u64 {
    if BY_HALVES {
        (high_unsigned(a, b) as u64) << 32 | a.wrapping_mul(b) as u64
    } else {
        a as u64 * b as u64
    }
}

/// a·b · 2^-32, rounded down.
#[inline(always)]
pub(crate) fn high(a: i32, b: i32) -> i32 {
    if BY_HALVES {
        high_by_halves(a, b)
    } else {
        ((a as i64 * b as i64) >> 32) as i32
    }
}

/// a·b · 2^-32, rounded down.
#[inline(always)]
pub(crate) fn high_unsigned(a: u32, b: u32) -> u32 {
    if BY_HALVES {
        high_unsigned_by_halves(a, b)
    } else {
        ((a as u64 * b as u64) >> 32) as u32
    }
}

/// (a·p + b·q) · 2^-32, rounded down, for a sum that fits 64 bits.
#[inline(always)]
pub(crate) fn high_sum((a, b): (i32, i32), (p, q): (i32, i32)) -> i32 {
    if BY_HALVES {
        high_sum_by_halves((a, b), (p, q))
    } else {
        ((a as i64 * p as i64).wrapping_add(b as i64 * q as i64) >> 32) as i32
    }
}

/// A word with the sign of a·p + b·q, for a sum that fits 64 bits: negative where that is, and only there.
#[inline(always)]
pub(crate) fn sign_of_sum((a, b): (i32, i32), (p, q): (i32, i32)) -> i32 {
    if BY_HALVES && is_short([a, b, p, q]) {
        a.wrapping_mul(p).wrapping_add(b.wrapping_mul(q))
    } else {
        high_sum((a, b), (p, q))
    }
}

/// Whether all lie in ±2^14: two products are below 2^29.
#[inline(always)]
fn is_short(values: [i32; 4]) -> bool {
    let bits = values
        .into_iter()
        .fold(0, |bits, v| bits | v.wrapping_add(1 << 14) as u32);
    bits >> 15 == 0
}

/// (a·p + b·q) · 2^-8, rounded down, for p and q in −128…127 and a sum that fits 32 bits.
#[inline(always)]
pub(crate) fn sum_of_signed_parts((a, b): (i32, i32), (p, q): (i32, i32)) -> i32 {
    if BY_HALVES {
        sum_of_parts_by_bytes((a, b), (p, q))
    } else {
        high_sum((a, b), (p << 24, q << 24))
    }
}

/// (a·p + b·q) · 2^(`UP` − 32), rounded down, for a and b within ±2^14 and a sum of whose result there is room in a word.
#[inline(always)]
pub(crate) fn short_sum<const UP: u32>((a, b): (i32, i32), (p, q): (i32, i32)) -> i32 {
    if BY_HALVES {
        short_sum_by_halves::<UP>((a, b), (p, q))
    } else {
        high_sum((a << UP, b << UP), (p, q))
    }
}

#[inline(always)]
fn short_sum_by_halves<const UP: u32>((a, b): (i32, i32), (p, q): (i32, i32)) -> i32 {
    let low = a.wrapping_mul(p & 0xffff).wrapping_add(b.wrapping_mul(q & 0xffff));
    let high = a.wrapping_mul(p >> 16).wrapping_add(b.wrapping_mul(q >> 16));
    high.wrapping_add(low >> 16) >> (16 - UP)
}

#[inline(always)]
fn sum_of_parts_by_bytes((a, b): (i32, i32), (p, q): (i32, i32)) -> i32 {
    let low = (a & 255) * p + (b & 255) * q;
    ((a >> 8) * p).wrapping_add((b >> 8) * q).wrapping_add(low >> 8)
}

#[inline(always)]
fn high_by_halves(a: i32, b: i32) -> i32 {
    let ((a1, a0), (b1, b0)) = ((a >> 16, a & 0xffff), (b >> 16, b & 0xffff));
    let low = (a0 as u32).wrapping_mul(b0 as u32) >> 16;
    // 2^15·(2^16 − 1) + 2^16 − 1 at most, either way: within 31 bits and the sign.
    let first = a1 * b0 + low as i32;
    let second = a0 * b1 + (first & 0xffff);
    (a1 * b1).wrapping_add(first >> 16).wrapping_add(second >> 16)
}

#[inline(always)]
fn high_unsigned_by_halves(a: u32, b: u32) -> u32 {
    let ((a1, a0), (b1, b0)) = ((a >> 16, a & 0xffff), (b >> 16, b & 0xffff));
    // (2^16 − 1)^2 + 2^16 − 1 at most: 32 bits.
    let first = a1 * b0 + ((a0 * b0) >> 16);
    let second = a0 * b1 + (first & 0xffff);
    a1 * b1 + (first >> 16) + (second >> 16)
}

#[inline(always)]
fn high_sum_by_halves((a, b): (i32, i32), (p, q): (i32, i32)) -> i32 {
    let low = a.wrapping_mul(p) as u32;
    let (_, carry) = low.overflowing_add(b.wrapping_mul(q) as u32);
    high_by_halves(a, p)
        .wrapping_add(high_by_halves(b, q))
        .wrapping_add(carry as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_make_the_same_words() {
        let ends = [
            0,
            1,
            -1,
            0xffff,
            0x1_0000,
            -0x1_0000,
            0x7fff_ffff,
            -0x8000_0000,
            0x7fff_0000,
            -0x7fff_0001,
            0x1234_5678,
            -0x0edc_ba98,
        ];
        for a in ends {
            for p in ends {
                assert_eq!(high_by_halves(a, p) as i64, (a as i64 * p as i64) >> 32, "{a} {p}");
                let (ua, up) = (a as u32 as u64, p as u32 as u64);
                assert_eq!(
                    high_unsigned_by_halves(a as u32, p as u32) as u64,
                    (ua * up) >> 32,
                    "{a} {p}"
                );
                for b in ends {
                    for q in ends {
                        let sum = a as i128 * p as i128 + b as i128 * q as i128;
                        if sum as i64 as i128 == sum {
                            assert_eq!(high_sum_by_halves((a, b), (p, q)) as i128, sum >> 32, "{a} {p} {b} {q}");
                            assert_eq!(sign_of_sum((a, b), (p, q)) < 0, sum < 0, "{a} {p} {b} {q}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn short_sums_by_halves_are_the_same() {
        let weights = [
            0,
            1,
            -1,
            0xffff,
            -0x1_0000,
            0x3fff_ffff,
            -0x4000_0000,
            0x1234_5678,
            -0x0edc_ba98,
        ];
        let values = [0, 1, -1, 127, -128, 16128, -16128, 16383, -16383];
        let bytes = [0, 1, -1, 127, -128];
        for p in weights {
            for q in weights {
                for a in values {
                    for b in values {
                        let exact = a as i64 * p as i64 + b as i64 * q as i64;
                        assert_eq!(short_sum::<7>((a, b), (p, q)) as i64, exact >> 25, "{a} {p} {b} {q}");
                        assert_eq!(
                            short_sum_by_halves::<7>((a, b), (p, q)) as i64,
                            exact >> 25,
                            "{a} {p} {b} {q}"
                        );
                        assert_eq!(
                            short_sum_by_halves::<8>((a, b), (p, q)) as i64,
                            exact >> 24,
                            "{a} {p} {b} {q}"
                        );
                    }
                }
                for a in bytes {
                    for b in bytes {
                        let exact = a as i64 * p as i64 + b as i64 * q as i64;
                        assert_eq!(sum_of_signed_parts((p, q), (a, b)) as i64, exact >> 8);
                        assert_eq!(sum_of_parts_by_bytes((p, q), (a, b)) as i64, exact >> 8);
                    }
                }
            }
        }
    }

    #[test]
    fn short_sums_fit_a_word() {
        let ends = [-(1 << 14), -1, 0, 1, (1 << 14) - 1];
        for a in ends {
            for p in ends {
                assert!(is_short([a, p, 0, 0]) && is_short([0, 0, p, a]));
                assert_eq!((a * p + p * p) as i64, a as i64 * p as i64 + p as i64 * p as i64);
            }
        }
        for beyond in [1 << 14, -(1 << 14) - 1, i32::MAX, i32::MIN] {
            for i in 0..4 {
                let mut values = [0; 4];
                values[i] = beyond;
                assert!(!is_short(values));
            }
        }
    }
}
