//! The bounds that each precision states, measured: every bound holds, none is looser than four times the largest error, and
//! `docs/dials.md` has both.
//!
//! `cargo test --test precision -- --nocapture` prints them.

use fixel::num::{OneStep, Precision, Table, TwoSteps};

/// Splitmix64: the same cases every time.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Of any size from 0 to `bits` bits, either sign.
    fn signed(&mut self, bits: u64) -> i64 {
        let magnitude = (self.next() >> (64 - bits) >> (self.next() % bits)) as i64;
        if self.next() & 1 == 0 { magnitude } else { -magnitude }
    }

    fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = [(); 3].map(|()| (self.next() as i64 >> 11) as f64 / (1u64 << 52) as f64);
            let length = length(v);
            if (0.1..1.0).contains(&length) {
                return v.map(|c| c / length);
            }
        }
    }
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

const ONE: i32 = 1 << 30;
const ONE64: f64 = ONE as f64;

const PAGE: &str = include_str!("../docs/dials.md");

/// What is wrong with the bounds.
#[derive(Default)]
struct Judged(Vec<String>);

impl Judged {
    /// `worst` and the bound are in the same unit.
    fn judge(&mut self, what: &str, worst: f64, bound: u32) {
        println!("{what}: {worst:.2}, bound {bound}");
        let row = PAGE.lines().find(|line| line.starts_with(&format!("| `{what}` |")));
        if !row.is_some_and(|row| row.ends_with(&format!("| {worst:.1} | {bound} |"))) {
            self.0
                .push(format!("{what}: docs/dials.md is stale: {worst:.1} and {bound}"));
        }
        if worst > f64::from(bound) {
            self.0.push(format!("{what}: {worst:.2} passes its bound {bound}"));
        } else if f64::from(bound) > 4.0 * worst {
            self.0
                .push(format!("{what}: {worst:.2} is far below its bound {bound}"));
        }
    }
}

/// Each 1009th normalised word, and 4000 on either side of every 256th of the range, where entries of tables end.
fn words() -> impl Iterator<Item = u32> {
    let borders = (64..256u32).flat_map(|i| (i << 24).saturating_sub(4000)..=(i << 24).saturating_add(4000));
    (1 << 30..=u32::MAX)
        .step_by(1009)
        .chain(borders.filter(|w| *w >= 1 << 30))
        .chain([u32::MAX])
}

fn reciprocals<P: Precision>(name: &str, judged: &mut Judged) {
    let error = |d: u32| (P::reciprocal(d) as f64 / ((1u64 << 63) as f64 / f64::from(d)) - 1.0).abs() * 2f64.powi(32);
    let divisors = words().filter(|d| *d >= 1 << 31);
    let range = 1u64 << 31..=1 << 32;
    let divisors = divisors.inspect(|d| assert!(range.contains(&P::reciprocal(*d))));
    judged.judge(
        &format!("{name}::reciprocal"),
        divisors.map(error).fold(0.0, f64::max),
        P::RECIPROCAL_ERROR,
    );
    assert_eq!(P::reciprocal(5), P::reciprocal(1 << 31));

    let error = |s: u32| {
        let exact = (1u64 << 47) as f64 / f64::from(s).sqrt();
        (f64::from(P::reciprocal_square_root(s)) / exact - 1.0).abs() * 2f64.powi(32)
    };
    let squares = words().inspect(|s| assert!(P::reciprocal_square_root(*s) >= 1 << 31));
    judged.judge(
        &format!("{name}::reciprocal_square_root"),
        squares.map(error).fold(0.0, f64::max),
        P::ROOT_ERROR,
    );
    assert_eq!(P::reciprocal_square_root(5), P::reciprocal_square_root(1 << 30));
}

#[test]
fn reciprocals_are_as_near_as_stated() {
    let mut judged = Judged::default();
    reciprocals::<Table>("Table", &mut judged);
    reciprocals::<OneStep>("OneStep", &mut judged);
    reciprocals::<TwoSteps>("TwoSteps", &mut judged);
    assert!(judged.0.is_empty(), "{:#?}", judged.0);
}

/// The largest difference of a component in units of 2^-30.
fn unit_error(vector: [i64; 3], unit: Option<[i32; 3]>) -> f64 {
    let exact = vector.map(|c| c as f64);
    let length = length(exact);
    let Some(unit) = unit else {
        assert_eq!(vector, [0; 3]);
        return 0.0;
    };
    let errors = exact
        .iter()
        .zip(unit)
        .map(|(e, u)| (f64::from(u) - e / length * ONE64).abs());
    errors.fold(0.0, f64::max)
}

/// Every vector within ±30, and two million whose components are of any size each or of the same size.
fn units<P: Precision>(name: &str, judged: &mut Judged) {
    let mut worst = 0.0f64;
    let mut check = |vector: [i64; 3]| {
        if vector.iter().all(|c| i32::try_from(*c).is_ok()) {
            let narrow = P::unit(vector.map(|c| c as i32));
            worst = worst.max(unit_error(vector, narrow));
        }
        worst = worst.max(unit_error(vector, P::unit_wide(vector)));
    };
    for i in 0..61 * 61 * 61 {
        check([i % 61 - 30, i / 61 % 61 - 30, i / 3721 - 30]);
    }
    let mut random = Random(2);
    for bits in (1..=63).cycle().take(1_000_000) {
        check([(); 3].map(|()| random.signed(bits)));
        check([(); 3].map(|()| random.next() as i64 >> (64 - bits)));
    }
    for extreme in [i32::MIN as i64, i32::MAX as i64, i64::MIN, i64::MAX] {
        for other in [0, 1, -1, extreme] {
            check([extreme, other, other]);
            check([other, extreme, 0]);
        }
    }
    // Among the worst of `Table`, found by climbing.
    check([-1_074_102_273, 132_612_094, -189_169_663]);
    check([170_950_655, 1_074_233_344, 152_272_895]);
    judged.judge(&format!("{name}::unit"), worst, P::UNIT_ERROR);
}

#[test]
fn unit_vectors_are_as_near_as_stated() {
    let mut judged = Judged::default();
    units::<Table>("Table", &mut judged);
    units::<OneStep>("OneStep", &mut judged);
    units::<TwoSteps>("TwoSteps", &mut judged);
    assert!(judged.0.is_empty(), "{:#?}", judged.0);
}

/// A million pairs of directions, and of those the ones that are nearly the same, nearly opposite and along an axis.
fn dots<P: Precision>(name: &str, judged: &mut Judged) {
    let fixed = |v: [f64; 3]| v.map(|c| (c * ONE64).round() as i32);
    let mut random = Random(3);
    let mut worst = 0.0f64;
    for i in 0..1_000_000 {
        let (a, b) = (random.direction(), random.direction());
        let (a, b) = (
            fixed(a),
            match i % 4 {
                0 => fixed(a),
                1 => fixed(a.map(|c| -c)),
                2 => [[ONE, 0, 0], [0, -ONE, 0], [0, 0, ONE]][i / 4 % 3],
                _ => fixed(b),
            },
        );
        let exact = a.iter().zip(b).map(|(a, b)| f64::from(*a) * f64::from(b)).sum::<f64>() / ONE64;
        worst = worst.max((f64::from(P::dot(a, b)) - exact).abs());
    }
    judged.judge(&format!("{name}::dot"), worst, P::DOT_ERROR);
}

#[test]
fn dot_products_are_as_near_as_stated() {
    let mut judged = Judged::default();
    dots::<Table>("Table", &mut judged);
    dots::<OneStep>("OneStep", &mut judged);
    dots::<TwoSteps>("TwoSteps", &mut judged);
    assert!(judged.0.is_empty(), "{:#?}", judged.0);
}

const EXPONENTS: [f64; 26] = [
    0.00001, 0.01, 0.1, 0.3, 0.5, 0.9, 1.0, 1.5, 2.0, 3.3, 5.0, 8.0, 10.0, 20.0, 32.0, 45.5, 64.0, 100.0, 128.0, 200.0,
    256.0, 500.0, 1000.0, 10_000.0, 32_768.0, 65_535.0,
];

/// Bases all over, near 0 and near 1, and a million random pairs.
fn powers<P: Precision>(name: &str, judged: &mut Judged) {
    let mut worst = 0.0f64;
    let mut check = |base: i32, exponent: u32| {
        let exact = (f64::from(base) / ONE64).powf(f64::from(exponent) / 65536.0) * ONE64;
        let result = P::power(base, exponent);
        assert!((0..=ONE).contains(&result), "{base}^{exponent} = {result}");
        let allowance = (f64::from(exponent) / f64::from(256 << 16)).max(1.0);
        worst = worst.max((f64::from(result) - exact).abs() / allowance);
    };
    for exponent in EXPONENTS.map(|e| (e * 65536.0).round() as u32) {
        let sweep = (1 << 16..ONE).step_by(10_007);
        for base in (0..1 << 13).chain(sweep).chain(ONE - (1 << 14)..=ONE) {
            check(base, exponent);
        }
    }
    let mut random = Random(4);
    for _ in 0..1_000_000 {
        let exponent = (random.next() as u32) >> (random.next() % 32);
        let near = random.next() as i32 & i32::MAX;
        let base = near >> (random.next() % 31 + 1);
        check(base, exponent);
        check(ONE - base, exponent);
    }
    for exponent in [1, 655, 1 << 16, 10_000 << 16, u32::MAX] {
        assert_eq!((P::power(0, exponent), P::power(-5, exponent)), (0, 0));
        assert_eq!((P::power(ONE, exponent), P::power(i32::MAX, exponent)), (ONE, ONE));
    }
    assert_eq!((P::power(0, 0), P::power(ONE / 3, 0)), (ONE, ONE));
    judged.judge(&format!("{name}::power"), worst, P::POWER_ERROR);
}

#[test]
fn powers_are_as_near_as_stated() {
    let mut judged = Judged::default();
    powers::<Table>("Table", &mut judged);
    powers::<OneStep>("OneStep", &mut judged);
    powers::<TwoSteps>("TwoSteps", &mut judged);
    assert!(judged.0.is_empty(), "{:#?}", judged.0);
}
