//! The errors of roots, unit vectors, powers and sRGB, measured over their whole ranges; `docs/functions.md` is the result.
//!
//! `cargo test --test functions -- --nocapture` prints it. A test fails when a row of the page is stale, when the error
//! passes the bound, and when the bound is looser than four times the error.

use fixel::num::{power, reciprocal_square_root, square_root, unit, unit_wide};
use fixel::srgb::{decode, decode_wide, encode};

const PAGE: &str = include_str!("../docs/functions.md");

/// Compares with the page's row of that name.
fn document(name: &str, measured: f64) {
    let row = PAGE.lines().find(|line| line.starts_with(&format!("| {name} |")));
    let row = row.unwrap_or_else(|| panic!("docs/functions.md has no row {name}: measured {measured:.2}"));
    let cells: Vec<&str> = row.split('|').map(str::trim).collect();
    let bound: f64 = cells[5].parse().expect("a bound");
    println!("{name}: {measured:.2} x {}, bound {bound}", cells[3]);
    assert_eq!(cells[4], format!("{measured:.2}"), "docs/functions.md is stale: {name}");
    assert!(
        measured <= bound && bound <= 4.0 * measured,
        "{name}: {measured} and bound {bound}"
    );
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Of any size from 1 to `bits` bits, either sign.
    fn signed(&mut self, bits: u64) -> i64 {
        let magnitude = self.next() >> (64 - bits) >> (self.next() % bits);
        if self.next() & 1 == 0 {
            magnitude as i64
        } else {
            -(magnitude as i64)
        }
    }
}

fn assert_square_root(n: u64) {
    let root = square_root(n) as u128;
    assert!(
        root * root <= n as u128 && (root + 1) * (root + 1) > n as u128,
        "√{n} = {root}"
    );
}

/// Every n below 2^24; r², r² − 1 and r² + 2r for every r below 2^20 and each 251st above; random n of every size.
#[test]
fn square_root_is_exact() {
    (0..1 << 24).for_each(assert_square_root);
    for r in (1..1u64 << 20)
        .chain((1 << 20..1 << 32).step_by(251))
        .chain([u32::MAX as u64])
    {
        [r * r - 1, r * r, r * r + 2 * r]
            .into_iter()
            .for_each(assert_square_root);
    }
    let mut random = Random(1);
    for i in 0..4_000_000 {
        assert_square_root(random.next() >> (i % 64));
    }
    assert_square_root(u64::MAX);
    document("`square_root`", 0.0);
}

fn reciprocal_square_root_error(square: u32) -> f64 {
    let exact = (1u64 << 47) as f64 / (square as f64).sqrt();
    let result = reciprocal_square_root(square);
    assert!(result >= 1 << 31, "{square}: {result}");
    (result as f64 / exact - 1.0).abs() * (1u64 << 32) as f64
}

/// Each 31st normalised word, and those next to where the table's entry changes.
#[test]
fn reciprocal_square_root_error_is_documented() {
    let borders =
        (32..128u32).flat_map(|i| (i << 25..(i << 25) + 1000).chain((i << 25) + 0x1ff_fc00..=(i << 25) + 0x1ff_ffff));
    let worst = (1 << 30..=u32::MAX)
        .step_by(31)
        .chain(borders)
        .map(reciprocal_square_root_error)
        .fold(0.0, f64::max);
    document("`reciprocal_square_root`", worst);
    assert_eq!(reciprocal_square_root(0), reciprocal_square_root(1 << 30));
}

/// All 3·2^30 words: a minute at most. `cargo test --release --test functions -- --ignored --nocapture`
#[test]
#[ignore = "3.2 billion words"]
fn reciprocal_square_root_of_every_word() {
    let worst = (1 << 30..=u32::MAX)
        .map(reciprocal_square_root_error)
        .fold(0.0, f64::max);
    println!("{worst:.4} x 2^-32");
    assert!(worst <= 2.5);
}

/// Largest difference of a component in units of 2^-30.
fn unit_error(vector: [i64; 3], result: Option<[i32; 3]>) -> f64 {
    let exact = vector.map(|c| c as f64);
    let length = exact.iter().map(|c| c * c).sum::<f64>().sqrt();
    let Some(result) = result else {
        assert_eq!(vector, [0; 3]);
        return 0.0;
    };
    let errors = exact
        .iter()
        .zip(result)
        .map(|(e, r)| (r as f64 - e / length * (1 << 30) as f64).abs());
    errors.fold(0.0, f64::max)
}

/// Every vector within ±40, and eight million whose components are of any size each.
#[test]
fn unit_error_is_documented() {
    let mut worst = [0.0f64; 2];
    let mut check = |vector: [i64; 3], narrow: bool| {
        worst[1] = worst[1].max(unit_error(vector, unit_wide(vector)));
        if narrow {
            worst[0] = worst[0].max(unit_error(vector, unit(vector.map(|c| c as i32))));
        }
    };
    for i in 0..81 * 81 * 81 {
        check([i % 81 - 40, i / 81 % 81 - 40, i / 6561 - 40], true);
    }
    let mut random = Random(2);
    for bits in (1..=63).cycle().take(4_000_000) {
        check([(); 3].map(|()| random.signed(bits)), bits < 32);
        // The same size each: the longest sums of squares.
        check([(); 3].map(|()| random.next() as i64 >> (64 - bits)), bits < 32);
    }
    for extreme in [i32::MIN as i64, i32::MAX as i64] {
        for other in [0, 1, i32::MIN as i64, i32::MAX as i64] {
            check([extreme, other, other], true);
            check([other, extreme, 0], true);
        }
    }
    for extreme in [i64::MIN, i64::MAX] {
        check([extreme; 3], false);
        check([0, extreme, 1], false);
    }
    document("`unit`", worst[0]);
    document("`unit_wide`", worst[1]);
}

/// The largest error in units of 2^-30 over the bases of a sweep: the 2^16 smallest, the 2^16 next to 1, and 300,000
/// between.
fn power_error(exponents: impl Iterator<Item = u32>) -> f64 {
    let one = 1i32 << 30;
    let mut worst = 0.0f64;
    for exponent in exponents {
        for base in (0..1 << 16)
            .chain((1 << 16..one).step_by(3571))
            .chain(one - (1 << 16)..=one)
        {
            let exact = (base as f64 / one as f64).powf(exponent as f64 / 65536.0) * one as f64;
            let result = power(base, exponent);
            assert!((0..=one).contains(&result), "{base}^{exponent} = {result}");
            worst = worst.max((result as f64 - exact).abs());
        }
    }
    worst
}

fn fixed(exponents: &[f64]) -> impl Iterator<Item = u32> {
    exponents.iter().map(|e| (e * 65536.0).round() as u32)
}

#[test]
fn power_error_below_exponent_1_is_documented() {
    let some = fixed(&[0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 0.9]).chain([1, 2, 65_535]);
    document("`power`, a < 1", power_error(some));
}

#[test]
fn power_error_to_exponent_256_is_documented() {
    let some = fixed(&[
        1.0, 1.5, 2.0, 3.3, 5.0, 8.0, 10.0, 20.0, 32.0, 45.5, 50.0, 64.0, 80.0, 100.0, 128.0, 200.0, 240.0, 256.0,
    ]);
    document("`power`, 1 ≤ a ≤ 256", power_error(some));
}

#[test]
fn power_error_above_exponent_256_is_documented() {
    let some = fixed(&[300.0, 500.0, 1000.0, 3000.0, 10_000.0, 32_768.0, 65_535.0]).chain([u32::MAX]);
    document("`power`, a > 256", power_error(some));
}

#[test]
fn power_at_the_ends() {
    let one = 1 << 30;
    for exponent in [1, 655, 1 << 16, 10_000 << 16, u32::MAX] {
        assert_eq!(power(0, exponent), 0);
        assert_eq!(power(-5, exponent), 0);
        assert_eq!(power(one, exponent), one);
        assert_eq!(power(one + 7, exponent), one);
    }
    for base in [0, 1, one / 3, one - 1, one] {
        assert_eq!(power(base, 0), one);
        assert!((power(base, 1 << 16) - base).abs() <= 1);
    }
}

fn decode64(c: f64) -> f64 {
    if c <= 0.04045 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    }
}

fn encode64(c: f64) -> f64 {
    if c <= 0.003_130_8 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    }
}

/// All 256 levels, in units of 2^-28.
#[test]
fn srgb_decode_error_is_documented() {
    let error = |level: u8| decode64(f64::from(level) / 255.0) * f64::from(1 << 28) - f64::from(decode(level));
    document(
        "`srgb::decode`",
        (0..=255).map(|level| error(level).abs()).fold(0.0, f64::max),
    );
}

/// Each 1,009th argument, and the 2^20 on either side of 0.04045, of 1 and before the last. Up to full the error is in
/// units of 2^-28; beyond, where it is relative, what is more than the ½ of rounding.
#[test]
fn srgb_decode_wide_error_is_documented() {
    let one = 1 << 24;
    let mut worst = [0.0f64; 2];
    let around = |middle: i32| middle - (1 << 20)..=middle.saturating_add(1 << 20);
    let all = (i32::MIN..=i32::MAX).step_by(1009);
    for encoded in all.chain(around(678_638)).chain(around(one)).chain(around(i32::MAX)) {
        let exact = decode64(f64::from(encoded) / f64::from(one)) * f64::from(1 << 28);
        let error = (decode_wide(encoded) as f64 - exact).abs();
        if encoded <= one {
            worst[0] = worst[0].max(error);
            assert!(error <= 0.5 + exact.abs() * 2f64.powi(-28), "{encoded}: {error}");
        } else {
            worst[1] = worst[1].max((error - 0.5) / exact * f64::from(1 << 28));
        }
    }
    document("`srgb::decode_wide`, c ≤ 1", worst[0]);
    document("`srgb::decode_wide`, c > 1", worst[1]);
}

/// How much too large in units of 2^-16 level; never too little.
fn encode_error(linear: i32) -> f64 {
    let exact = 255.0 * encode64(f64::from(linear) / f64::from(1 << 28)) * 65536.0;
    let error = f64::from(encode(linear)) - exact;
    // The oracle is off by 2^-50 of 2^24.
    assert!(error >= -2f64.powi(-26), "{linear}: {error}");
    error
}

/// Every value below 2^21 and each 17th above.
#[test]
fn srgb_encode_error_is_documented() {
    let one = 1 << 28;
    let all = (0..1 << 21).chain((1 << 21..one).step_by(17)).chain([one]);
    document("`srgb::encode`", all.map(encode_error).fold(0.0, f64::max));
}

/// `cargo test --release --test functions -- --ignored --nocapture`
#[test]
#[ignore = "2^28 values"]
fn srgb_encode_of_every_value() {
    let worst = (0..=1 << 28).map(encode_error).fold(0.0, f64::max);
    println!("{worst:.4} x 2^-16 level");
    assert!(worst <= 12.0);
}
