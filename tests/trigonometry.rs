//! Sine and cosine, and their table, against a series of 190 bits.

mod exact;

use exact::Exact;
use fixel::num::{Angle, ShortSine, SineTable, Trigonometry, Word};
use proptest::prelude::*;

/// The largest error of [`SineTable`] in units of 2^-BITS: 2^-28 with 32-bit words, 2^-59 with 64-bit ones, as it states.
const TABLE_ERROR: [f64; 2] = [4.0, 8.0];
/// A stated bound is not looser than this many times the worst error seen.
const LOOSEST: f64 = 4.0;
/// sin² + cos² = 1 to twice the error of either, in units of 2^-BITS.
const CIRCLE_ERROR: i128 = 16;

/// Fraction bits of the oracle: far below 2^-62.
const PRECISION: i64 = 190;

fn quotient(numerator: &Exact, divisor: u32) -> Exact {
    // Times 1/divisor, which long division gives to 2^-256.
    let mut reciprocal = Exact::zero();
    let mut remainder = 1u64;
    for word in 1..9 {
        remainder <<= 32;
        reciprocal = &reciprocal + &Exact::new(remainder / divisor as u64, -32 * word);
        remainder %= divisor as u64;
    }
    (numerator * &reciprocal).cut(PRECISION)
}

/// π = 16·atan(1/5) − 4·atan(1/239) (Machin).
fn pi() -> Exact {
    let arctangent = |inverse: u32| {
        let mut term = quotient(&Exact::new(1, 0), inverse);
        let mut sum = Exact::zero();
        for odd in 0..100u32 {
            let part = quotient(&term, 2 * odd + 1);
            sum = if odd % 2 == 0 { &sum + &part } else { &sum - &part };
            term = quotient(&quotient(&term, inverse), inverse);
        }
        sum
    };
    &(&Exact::new(16, 0) * &arctangent(5)) - &(&Exact::new(4, 0) * &arctangent(239))
}

/// The sine of `turns`·2^-64 turns, π given: brought to 0…π/4 exactly, then the series.
fn sine(turns: u64, pi: &Exact) -> Exact {
    let (negative, within) = (turns >> 63 == 1, turns & (u64::MAX >> 1));
    // sin(½ − t) = sin(t), and beyond an eighth the cosine of the rest of the quarter.
    let within = if within > 1 << 62 { (1 << 63) - within } else { within };
    let (angle, is_cosine) = if within > 1 << 61 {
        ((1 << 62) - within, true)
    } else {
        (within, false)
    };
    let radians = (&Exact::new(angle, -63) * pi).cut(PRECISION);
    let square = (&radians * &radians).cut(PRECISION);
    let mut term = if is_cosine { Exact::new(1, 0) } else { radians };
    let mut sum = Exact::zero();
    let first = if is_cosine { 0 } else { 1 };
    for i in 0..24u32 {
        sum = if i % 2 == 0 { &sum + &term } else { &sum - &term };
        let k = first + 2 * i;
        term = quotient(&(&term * &square).cut(PRECISION), (k + 1) * (k + 2));
    }
    if negative { -&sum } else { sum }
}

fn cosine(turns: u64, pi: &Exact) -> Exact {
    sine(turns.wrapping_add(1 << 62), pi)
}

/// The error of both in units of 2^-BITS.
fn error<S: Trigonometry, T: Word>(turns: u64, pi: &Exact) -> f64 {
    let (sin, cos) = S::sin_cos::<T>(Angle::from_turns(turns));
    let off = |found: T, truth: Exact| {
        (&Exact::new(found.to_i64(), 0) - &(&truth * &Exact::power(T::BITS as i32)))
            .abs()
            .to_f64()
    };
    off(sin, sine(turns, pi)).max(off(cos, cosine(turns, pi)))
}

/// Angles of every kind: next to the table's steps and half-way between them, and spread over the turn.
fn angles() -> impl Iterator<Item = u64> {
    let near = (0..256u64).flat_map(|step| {
        let around = [
            0,
            1,
            1 << 20,
            1 << 54,
            (1 << 55) - 1,
            1 << 55,
            (1 << 55) + 1,
            u64::MAX,
            u64::MAX - (1 << 30),
        ];
        around.map(|off| (step << 56).wrapping_add(off))
    });
    near.chain((0..6000u64).map(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15)))
}

fn worst<S: Trigonometry, T: Word>(pi: &Exact) -> f64 {
    angles().map(|turns| error::<S, T>(turns, pi)).fold(0.0, f64::max)
}

#[test]
fn the_oracle_knows_some_sines() {
    let pi = pi();
    assert!((pi.to_f64() - std::f64::consts::PI).abs() < 1e-15);
    assert_eq!(sine(1 << 62, &pi), Exact::new(1, 0));
    assert!((sine((1u64 << 63) / 6, &pi).to_f64() - 0.5).abs() < 1e-15);
    for i in 0..1000u64 {
        let turns = i.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let radians = turns as f64 / 2f64.powi(64) * std::f64::consts::TAU;
        assert!((sine(turns, &pi).to_f64() - radians.sin()).abs() < 1e-14);
        let (s, c) = (sine(turns, &pi), cosine(turns, &pi));
        assert!((&(&(&s * &s) + &(&c * &c)) - &Exact::new(1, 0)).abs() < Exact::power(-160));
    }
}

/// Every entry is the nearest: half a unit off at most.
#[test]
fn the_tables_are_the_nearest_sines() {
    let pi = pi();
    fn check<T: Word>(pi: &Exact) {
        for (i, entry) in T::SINES.iter().enumerate() {
            let truth = &sine((i as u64) << 56, pi) * &Exact::power(T::BITS as i32);
            assert!(
                (&truth - &Exact::new(entry.to_i64(), 0)).abs() <= Exact::power(-1),
                "entry {i}"
            );
        }
    }
    check::<i32>(&pi);
    check::<i64>(&pi);
}

#[test]
fn the_table_is_as_near_as_it_says() {
    let pi = pi();
    for (worst, stated) in [worst::<SineTable, i32>(&pi), worst::<SineTable, i64>(&pi)]
        .into_iter()
        .zip(TABLE_ERROR)
    {
        println!("worst {worst} of {stated} units");
        assert!(worst <= stated, "{worst} units");
        assert!(
            stated <= LOOSEST * worst,
            "{worst} units are far below the stated {stated}"
        );
    }
}

#[test]
fn the_short_table_is_as_near_as_it_says() {
    /// Whatever the word.
    const SHORT_ERROR: f64 = 1e-4;
    let pi = pi();
    let narrow = worst::<ShortSine, i32>(&pi) / 2f64.powi(30);
    let wide = worst::<ShortSine, i64>(&pi) / 2f64.powi(62);
    println!("worst {narrow} and {wide}");
    assert!(narrow.max(wide) <= SHORT_ERROR && SHORT_ERROR <= LOOSEST * narrow);
    // A million more, for which float64 is exact enough.
    for i in 0..1_000_000u64 {
        let turns = i.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let (sin, cos) = (turns as f64 / 2f64.powi(64) * std::f64::consts::TAU).sin_cos();
        let (s, c) = ShortSine::sin_cos::<i32>(Angle::from_turns(turns));
        let error = |table: i32, exact: f64| (f64::from(table) / 2f64.powi(30) - exact).abs();
        assert!(error(s, sin).max(error(c, cos)) <= SHORT_ERROR, "{turns}");
    }
}

#[cfg(feature = "micromath")]
#[test]
fn micromath_is_as_near_as_it_says() {
    /// Its own approximation, whatever the word.
    const MICROMATH_ERROR: f64 = 1.2e-3;
    let pi = pi();
    let narrow = worst::<fixel::num::Micromath, i32>(&pi) / 2f64.powi(30);
    let wide = worst::<fixel::num::Micromath, i64>(&pi) / 2f64.powi(62);
    println!("worst {narrow} and {wide}");
    assert!(narrow.max(wide) <= MICROMATH_ERROR && MICROMATH_ERROR <= LOOSEST * narrow);
}

fn check_circle<T: Word>(turns: u64) -> Result<(), TestCaseError> {
    let (sin, cos) = SineTable::sin_cos::<T>(Angle::from_turns(turns));
    let (s, c) = (sin.to_i64() as i128, cos.to_i64() as i128);
    let off = s * s + c * c - (1 << (2 * T::BITS));
    prop_assert!(
        off.abs() <= CIRCLE_ERROR << T::BITS,
        "sin² + cos² is off by {} units",
        off >> T::BITS
    );
    // A quarter turn on, the same two numbers.
    let (next_sin, next_cos) = SineTable::sin_cos::<T>(Angle::from_turns(turns.wrapping_add(1 << 62)));
    prop_assert_eq!((next_sin, next_cos), (cos, -sin));
    Ok(())
}

proptest! {
    #[test]
    fn sine_and_cosine_lie_on_the_circle(turns in any::<u64>()) {
        check_circle::<i32>(turns)?;
        check_circle::<i64>(turns)?;
    }

    /// Any number of turns, either way, is the same angle, rounded down to its unit.
    #[test]
    fn angles_wrap_around(degrees in any::<i32>()) {
        let angle = Angle::from_degrees(degrees);
        let exact = (degrees.rem_euclid(360) as u128) << 64;
        prop_assert!(angle.turns() as u128 * 360 <= exact && exact < (angle.turns() as u128 + 1) * 360);
        if let Some(more) = degrees.checked_add(360) {
            prop_assert_eq!(Angle::from_degrees(more), angle);
        }
    }
}

#[test]
fn right_angles_are_exact() {
    for (degrees, sin, cos) in [
        (0, 0, 1),
        (90, 1, 0),
        (180, 0, -1),
        (270, -1, 0),
        (-90, -1, 0),
        (720, 0, 1),
    ] {
        let angle = Angle::from_degrees(degrees);
        assert_eq!(SineTable::sin_cos::<i32>(angle), (sin << 30, cos << 30));
        assert_eq!(
            SineTable::sin_cos::<i64>(angle),
            ((sin as i64) << 62, (cos as i64) << 62)
        );
    }
}
