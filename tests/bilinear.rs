//! Linear filtering of RGB565 texels against float64, by definition: within what is stated, which is not loose.

use std::cell::Cell;

use fixel::fragment::Fragment;
use fixel::pipeline::{ClampToEdge, Repeat};
use fixel::texture::{Bilinear565, Rgb565, Texture, TiledBilinear565};
use fixel::varying::Linear;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Error of a channel for each level that neighbouring texels differ by, to the right or downwards.
const STATED: f64 = 1.0 / 64.0;
/// A stored pixel's, in levels, beside that.
const ROUNDED: f64 = 0.5;
/// A stated bound is not looser than this many times the worst error seen.
const LOOSEST: f64 = 4.0;
/// A side of [`TiledBilinear565`].
const SIDE: usize = 8;

fn channels(texel: u16) -> [f64; 3] {
    [texel >> 11, texel >> 5 & 63, texel & 31].map(f64::from)
}

/// A picture, and a coordinate of it.
#[derive(Debug, Clone)]
struct Case {
    texels: Vec<u16>,
    size: [u16; 2],
    bits: u32,
    st: [i32; 2],
}

/// A channel at the place, and the largest differences of the texels beside and above one another: of the four centres around.
fn exact(case: &Case, wrap: impl Fn(f64, f64) -> f64, channel: usize) -> (f64, f64) {
    let size = case.size.map(f64::from);
    let place = case.st.map(|c| f64::from(c) / 2f64.powi(case.bits as i32) - 0.5);
    let [(i, s), (j, t)] = place.map(|c| (c.floor(), c - c.floor()));
    let texel = |i: f64, j: f64| {
        let index = wrap(j, size[1]) * size[0] + wrap(i, size[0]);
        channels(case.texels[index as usize])[channel]
    };
    let [a, b, c, d] = [
        texel(i, j),
        texel(i + 1.0, j),
        texel(i, j + 1.0),
        texel(i + 1.0, j + 1.0),
    ];
    let mixed = (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * c + s * d);
    let differences = (a - b).abs().max((c - d).abs()) + (a - c).abs().max((b - d).abs());
    (mixed, differences)
}

fn repeated(index: f64, size: f64) -> f64 {
    index.rem_euclid(size)
}

fn clamped(index: f64, size: f64) -> f64 {
    index.clamp(0.0, size - 1.0)
}

/// The largest share of the stated error that is made use of, of interpolated and of stored channels; 1 is the limit.
fn shares(case: &Case, wrap: impl Fn(f64, f64) -> f64, levels: [i32; 3], stored: u16) -> [f64; 2] {
    let mut worst = [0.0f64; 2];
    for (channel, (level, stored)) in levels.into_iter().zip(channels(stored)).enumerate() {
        let (exact, differences) = exact(case, &wrap, channel);
        // Beside what float64 rounds.
        let bound = STATED * differences + 1e-9;
        worst[0] = worst[0].max((f64::from(level) / 65536.0 - exact).abs() / bound);
        worst[1] = worst[1].max((stored - exact).abs() / (bound + ROUNDED));
    }
    worst
}

fn places() -> impl Strategy<Value = [i32; 2]> {
    let place = || prop_oneof![any::<i32>(), -200_000..200_000i32];
    [place(), place()]
}

/// Textures of any size and any texels.
fn cases() -> impl Strategy<Value = Case> {
    let size = prop_oneof![[1..=9u16, 1..=9u16], [Just(8), Just(8)], [1..=300u16, 1..=2u16]];
    (size, 5..=31u32, places()).prop_flat_map(|(size, bits, st)| {
        let count = usize::from(size[0]) * usize::from(size[1]);
        let texel = prop_oneof![any::<u16>(), Just(0), Just(u16::MAX)];
        prop::collection::vec(texel, count).prop_map(move |texels| Case { texels, size, bits, st })
    })
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
fn filtered_texels_are_as_near_as_stated() {
    let worst = Cell::new([0.0f64; 2]);
    let checked = runner().run(&cases(), |case| {
        let texture = Texture::new(Rgb565, &case.texels, case.size[0], case.size[1]).unwrap();
        let sampler = Bilinear565::new(texture, case.bits);
        let clamp = sampler.wrapped(ClampToEdge, ClampToEdge);
        let found = [
            shares(&case, repeated, sampler.levels(case.st), sampler.stored(case.st)),
            shares(&case, clamped, clamp.levels(case.st), clamp.stored(case.st)),
        ];
        for [levels, stored] in found {
            prop_assert!(levels <= 1.0 && stored <= 1.0, "{:?} of what is stated", found);
            let [a, b] = worst.get();
            worst.set([a.max(levels), b.max(stored)]);
        }
        Ok(())
    });
    checked.unwrap();
    let [levels, stored] = worst.get();
    println!("worst {levels:.4} of what is stated for channels, {stored:.4} of that for pixels");
    assert!(LOOSEST * levels >= 1.0 && LOOSEST * stored >= 1.0);
}

/// A level of 31 and two of 63 are the most that it can be, and nearly what is seen.
#[test]
fn the_largest_error_there_is() {
    // A board: every texel is the opposite of its neighbours.
    let texels: Vec<u16> = (0..4).map(|i| if i % 3 == 0 { 0 } else { u16::MAX }).collect();
    let mut worst = [0.0f64; 3];
    for (s, t) in (0..1024).flat_map(|s| (0..1024).map(move |t| (s, t))) {
        let case = Case {
            texels: texels.clone(),
            size: [2, 2],
            bits: 9,
            st: [s, t],
        };
        let sampler = Bilinear565::new(Texture::new(Rgb565, &texels, 2, 2).unwrap(), 9);
        let levels = sampler.levels([s, t]).map(|level| f64::from(level) / 65536.0);
        for (channel, level) in levels.into_iter().enumerate() {
            worst[channel] = worst[channel].max((level - exact(&case, repeated, channel).0).abs());
        }
    }
    println!("worst {worst:.4?} levels of 31, 63 and 31");
    for (worst, stated) in worst
        .into_iter()
        .zip([62.0, 126.0, 62.0].map(|differences| STATED * differences))
    {
        assert!(worst <= stated && stated <= LOOSEST * worst);
    }
}

proptest! {
    #![proptest_config(config())]

    /// To the bit.
    #[test]
    fn tiles_are_the_repeated_texture(texels in prop::collection::vec(any::<u16>(), SIDE * SIDE), st in places()) {
        let rows: [[u16; SIDE]; SIDE] = std::array::from_fn(|j| std::array::from_fn(|i| texels[j * SIDE + i]));
        let tiled = TiledBilinear565::<Linear<2>, SIDE, SIDE>::new(&rows);
        let sampler = Bilinear565::new(Texture::new(Rgb565, &texels, SIDE as u16, SIDE as u16).unwrap(), 16);
        prop_assert_eq!(tiled.shade(st, 0), Some(sampler.stored(st)));
        prop_assert_eq!(tiled.levels(st), sampler.levels(st));
    }

    /// One colour is that colour, and a centre is its texel.
    #[test]
    fn what_is_no_mixture_is_exact(texels in prop::array::uniform4(any::<u16>()), st in places(), i in -9..9i32, j in -9..9i32) {
        let plain = Bilinear565::new(Texture::new(Rgb565, &texels, 1, 1).unwrap(), 16);
        prop_assert_eq!(plain.stored(st), texels[0]);
        let sampler = Bilinear565::new(Texture::new(Rgb565, &texels, 2, 2).unwrap(), 16).wrapped(Repeat, Repeat);
        let index = (j.rem_euclid(2) * 2 + i.rem_euclid(2)) as usize;
        prop_assert_eq!(sampler.stored([i, j].map(|c| (c << 16) + 0x8000)), texels[index]);
    }
}
