//! The dials of interpolated values on 100,000 random triangles each: what is stated holds, and the worst that is seen comes
//! within a quarter of it. Where a triangle has no [`Weights`], the wide way is as near as `tests/interpolation.rs` has it.

mod naive;
mod triangles;

use std::cell::Cell;

use fixel::depth::{Always, DepthBuffer, FAR};
use fixel::draw;
use fixel::fragment::Flat;
use fixel::slope::Weights;
use fixel::span::doubled_area;
use fixel::target::Buffer;
use fixel::varying::{Linear32, Perspective, Perspective32};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use triangles::{Case, Triangle, cases, positions, values};

/// A stated bound is not looser than this many times the worst error seen.
const LOOSEST: f64 = 4.0;
/// Of slopes: a value of 23 bits in units, and a depth in steps.
const SLOPE: f64 = 2200.0;
const DEPTH: f64 = 0.125;
/// Units of a corner's depth in a step of the buffer.
const STEP: f64 = 32768.0;

/// Triangles with slopes.
fn with_slopes() -> impl Strategy<Value = Case> {
    cases(250).prop_filter("no slopes", |case| Weights::new(case.corners).is_some())
}

/// Of those also the largest that there are.
fn large() -> impl Strategy<Value = Case> {
    cases(500).prop_filter("no slopes", |case| Weights::new(case.corners).is_some())
}

/// Texels of a side, in units of 2^-16.
fn texel() -> impl Strategy<Value = i32> {
    const MOST: i32 = 512 << 16;
    prop_oneof![-MOST..=MOST, Just(-MOST), Just(MOST)]
}

/// The same cases every time.
fn same() -> TestRng {
    TestRng::deterministic_rng(RngAlgorithm::ChaCha)
}

/// The largest share of its bound that `share` finds in a case; 1 is the limit.
fn hold<T: std::fmt::Debug>(name: &str, strategy: impl Strategy<Value = T>, share: impl Fn(&T) -> f64) {
    let worst = Cell::new(0.0f64);
    let config = Config {
        cases: 100_000,
        failure_persistence: None,
        max_local_rejects: 10_000_000,
        ..Config::default()
    };
    let checked = TestRunner::new_with_rng(config, same()).run(&strategy, |case| {
        let share = share(&case);
        worst.set(worst.get().max(share));
        prop_assert!(share <= 1.0, "{name}: {share} of what is stated");
        Ok(())
    });
    checked.unwrap();
    println!("{name}: {:.3} of what is stated", worst.get());
    assert!(
        LOOSEST * worst.get() >= 1.0,
        "{name}: {} of what is stated",
        worst.get()
    );
}

fn triangle<V>(case: &Case, varyings: [V; 3]) -> Triangle<V> {
    Triangle {
        corners: case.corners,
        depths: [0; 3],
        varyings,
    }
}

#[test]
fn affine_values() {
    hold(
        "affine",
        (with_slopes(), [texel(), texel(), texel()]),
        |(case, texels)| {
            let found = values::<i32, _>(&triangle(case, texels.map(|t| Linear32([t]))), case.window);
            let errors = found.into_iter().map(|((x, y), [value])| {
                let (numerator, area) = naive::value(case.corners, texels.map(i64::from), x, y);
                (f64::from(value) - numerator as f64 / area as f64).abs()
            });
            errors.fold(0.0, f64::max) / SLOPE
        },
    );
}

#[test]
fn perspective_in_32_bits() {
    let inverse = || (1 << 27)..=1 << 30i32;
    let strategy = (with_slopes(), [texel(), texel(), texel()], [inverse(), inverse()]);
    hold("32-bit words", strategy, |(case, texels, [a, b])| {
        let inverses = [1 << 30, *a, *b];
        let corners = [0, 1, 2].map(|i| Perspective32(Perspective::new([texels[i]], inverses[i])));
        let largest = f64::from(texels.map(i32::abs).into_iter().max().unwrap());
        let found = values::<i32, _>(&triangle(case, corners), case.window);
        let shares = found.into_iter().map(|((x, y), [value])| {
            let over_w = [0, 1, 2].map(|i| i64::from(texels[i]) * i64::from(inverses[i]));
            let (numerator, area) = naive::value(case.corners, over_w, x, y);
            let (inverse, _) = naive::value(case.corners, inverses.map(i64::from), x, y);
            let ratio = f64::from(1 << 30) * area as f64 / inverse as f64;
            let stated = largest / 32768.0 * (1.5 * ratio + 1.0) + ratio * SLOPE;
            (f64::from(value) - numerator as f64 / inverse as f64).abs() / stated
        });
        shares.fold(0.0, f64::max)
    });
}

/// Half a step of rounding beside what is stated.
#[test]
fn depths() {
    let depth = || prop_oneof![1 => 0..=65535 << 15, 3 => Just(0), 3 => Just(65535 << 15)];
    hold("depth", (large(), [depth(), depth(), depth()]), |(case, depths)| {
        let size = case.window.width() * case.window.height();
        let (mut colors, mut stored) = (vec![false; size], vec![FAR; size]);
        let mut buffer = DepthBuffer::<_, Always>::new(Buffer::strip(&mut stored, case.window).unwrap());
        let mut target = Buffer::strip(&mut colors, case.window).unwrap();
        let shape = Triangle {
            corners: case.corners,
            depths: *depths,
            varyings: [(); 3],
        };
        draw::polygon::<i32, _, _, _, _>(
            &mut target,
            &mut buffer,
            &shape,
            doubled_area(&case.corners),
            &Flat(true),
        );
        let pixels = positions(case.window)
            .zip(colors)
            .zip(stored)
            .filter(|((_, covered), _)| *covered);
        let errors = pixels.map(|(((x, y), _), stored)| {
            let (numerator, area) = naive::value(case.corners, depths.map(i64::from), x, y);
            (f64::from(stored) - numerator as f64 / area as f64 / STEP).abs() - 0.5
        });
        errors.fold(0.0, f64::max) / DEPTH
    });
}
