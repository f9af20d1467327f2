//! What the exact tier promises of texture coordinates, on random triangles: within 1/16 texel of the exact value for the
//! triangle as it is snapped, on textures up to 1024² with w varying by up to 100 times.

mod naive;
mod triangles;

use std::cell::Cell;

use fixel::quality::{Exact, Quality};
use fixel::varying::Perspective;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use triangles::{Case, Triangle, cases, values};

/// In texels.
const PROMISED: f64 = 1.0 / 16.0;
/// What `Perspective` states is not looser than this many times the worst error seen.
const LOOSEST: f64 = 4.0;
/// The customary fraction bits, and as many as fit 1024 texels.
const BITS: [u32; 2] = [16, 20];

type Varying = <Exact as Quality>::Perspective<2>;

/// Texels at the corners, and 1/w of each over the largest in units of 2^-30.
#[derive(Debug, Clone)]
struct Textured {
    case: Case,
    texels: [[i32; 2]; 3],
    inverses: [i32; 3],
}

/// Triangles of all sizes within ±1024 px, with a texture of 64 to 1024 texels a side somewhere on them.
fn textured() -> impl Strategy<Value = Textured> {
    const ONE: i32 = 1 << 30;
    const LEAST: i32 = ONE / 100 + 1;
    let inverse = || prop_oneof![LEAST..=ONE, Just(LEAST), Just(ONE)];
    let side = prop_oneof![Just(64), Just(256), Just(1024)];
    let texels = side.prop_flat_map(|side| {
        let corner = || prop_oneof![0..=side, Just(0), Just(side)];
        [[corner(), corner()], [corner(), corner()], [corner(), corner()]]
    });
    (cases(1024), texels, [inverse(), inverse()], 0..3usize).prop_map(|(case, texels, [a, b], turn)| {
        let mut inverses = [ONE, a, b];
        inverses.rotate_left(turn);
        Textured { case, texels, inverses }
    })
}

/// The largest error in texels with so many fraction bits, and as a share of what `Perspective` states for the pixel.
fn worst(Textured { case, texels, inverses }: &Textured, bits: u32) -> [f64; 2] {
    let varyings = [0, 1, 2].map(|i| Varying::from(Perspective::new(texels[i].map(|t| t << bits), inverses[i])));
    let shape = Triangle {
        corners: case.corners,
        depths: [0; 3],
        varyings,
    };
    let mut worst = [0.0f64; 2];
    for ((x, y), place) in values::<i32, _>(&shape, case.window) {
        let (inverse, area) = naive::value(case.corners, inverses.map(i64::from), x, y);
        let ratio = f64::from(1 << 30) * area as f64 / inverse as f64;
        for (axis, found) in place.into_iter().enumerate() {
            let over_w = [0, 1, 2].map(|i| i64::from(texels[i][axis]) * i64::from(inverses[i]));
            let (numerator, _) = naive::value(case.corners, over_w, x, y);
            // Exact integers; one division.
            let off = i128::from(found) * inverse - (numerator << bits);
            let off = (off as f64 / inverse as f64).abs();
            let largest = texels
                .iter()
                .map(|texel| f64::from(texel[axis] << bits))
                .fold(0.0, f64::max);
            let stated = ratio * (largest / 2f64.powi(26) + 1.0) + 3.0 + largest / 2f64.powi(30);
            worst = [worst[0].max(off / f64::from(1 << bits)), worst[1].max(off / stated)];
        }
    }
    worst
}

/// The same cases every time.
fn runner() -> TestRunner {
    TestRunner::new_with_rng(config(), TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

fn config() -> Config {
    Config {
        cases: 100_000,
        failure_persistence: None,
        ..Config::default()
    }
}

#[test]
fn coordinates_are_within_a_sixteenth_of_a_texel() {
    for bits in BITS {
        let seen = Cell::new([0.0f64; 2]);
        let checked = runner().run(&textured(), |textured| {
            let [texels, share] = worst(&textured, bits);
            prop_assert!(
                texels <= PROMISED && share <= 1.0,
                "{texels} texels off, {share} of what is stated"
            );
            let [a, b] = seen.get();
            seen.set([a.max(texels), b.max(share)]);
            Ok(())
        });
        checked.unwrap();
        let [texels, share] = seen.get();
        println!("{bits} fraction bits: worst {texels:.5} texel, {share:.3} of what is stated");
        assert!(LOOSEST * share >= 1.0);
    }
}
