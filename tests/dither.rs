//! Dither against its stated errors: the mean of a constant area, a single pixel, levels as they are, strips.

use fixel::dither::{one_bit, rgb565, rgb565_fine, sixteenth};
use proptest::prelude::*;

/// The pixels of a 4×4 block at any place.
fn block((left, top): (i32, i32)) -> impl Iterator<Item = (i32, i32)> {
    (0..16).map(move |i| (left.wrapping_add(i % 4), top.wrapping_add(i / 4)))
}

fn channels(pixel: u16) -> [f64; 3] {
    [pixel >> 11, pixel >> 5 & 63, pixel & 31].map(f64::from)
}

const MOST: [f64; 3] = [31.0, 63.0, 31.0];

/// Bounds of the mean and of a pixel, in levels.
const MEAN: f64 = 1.0 / 32.0;
const PIXEL: f64 = 1.0;

/// The largest errors of the mean and of a pixel over a block of one colour, `exact` in levels.
fn errors(exact: [f64; 3], at: (i32, i32), pixel: impl Fn((i32, i32)) -> u16) -> [f64; 2] {
    let mut sum = [0.0; 3];
    let mut worst = 0.0f64;
    for place in block(at) {
        let got = channels(pixel(place));
        for i in 0..3 {
            sum[i] += got[i];
            worst = worst.max((got[i] - exact[i]).abs());
            if exact[i].fract() == 0.0 {
                assert_eq!(got[i], exact[i], "a level is itself");
            }
        }
    }
    let mean = (0..3).map(|i| (sum[i] / 16.0 - exact[i]).abs()).fold(0.0, f64::max);
    [mean, worst]
}

fn check([mean, pixel]: [f64; 2]) -> Result<(), TestCaseError> {
    // The oracle's own rounding is below 2^-40.
    prop_assert!(mean <= MEAN + 1e-12 && pixel < PIXEL, "mean {mean}, pixel {pixel}");
    Ok(())
}

fn place() -> impl Strategy<Value = (i32, i32)> {
    prop_oneof![(-5000..5000i32, -5000..5000i32), any::<(i32, i32)>()]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bytes_are_as_near_as_stated(color in any::<[u8; 3]>(), at in place()) {
        let exact = [0, 1, 2].map(|i| f64::from(color[i]) * MOST[i] / 255.0);
        check(errors(exact, at, |place| rgb565(color, place)))?;
    }

    #[test]
    fn interpolated_channels_are_as_near_as_stated(
        color in [-1000..32 << 16i32, -1000..64 << 16i32, -1000..32 << 16i32], at in place(),
    ) {
        let exact = [0, 1, 2].map(|i| (f64::from(color[i]) / 65536.0).clamp(0.0, MOST[i]));
        check(errors(exact, at, |place| rgb565_fine(color, place)))?;
    }

    #[test]
    fn any_numbers_at_all(color in any::<[i32; 3]>(), at in any::<(i32, i32)>()) {
        rgb565_fine(color, at);
        rgb565(color.map(|c| c as u8), at);
        one_bit(color[0] as u8, at);
        prop_assert!(sixteenth(at) < 16);
    }
}

/// Every brightness, and every level of every channel; the bounds are not looser than four times the worst.
#[test]
fn every_byte() {
    let mut worst = [0.0f64; 2];
    for value in 0..=255u8 {
        let white = block((0, 0)).filter(|&at| one_bit(value, at)).count();
        let off = (white as f64 / 16.0 - f64::from(value) / 255.0).abs();
        assert!(off <= MEAN + 1e-12, "{value}: {white} of 16");
        let exact = MOST.map(|most| f64::from(value) * most / 255.0);
        let [mean, pixel] = errors(exact, (0, 0), |at| rgb565([value; 3], at));
        worst = [worst[0].max(mean), worst[1].max(pixel)];
    }
    println!("of the mean {:.4}, of a pixel {:.4} levels", worst[0], worst[1]);
    assert!(worst[0] <= MEAN + 1e-12 && MEAN <= 4.0 * worst[0]);
    assert!(worst[1] < PIXEL && PIXEL <= 4.0 * worst[1]);
}

/// Each threshold once in every block of 4×4, wherever it begins.
#[test]
fn every_block_has_every_threshold() {
    for at in [(0, 0), (1, 2), (-3, 7), (i32::MAX, i32::MIN), (-1, -1)] {
        let mut seen: Vec<_> = block(at).map(sixteenth).collect();
        seen.sort_unstable();
        assert_eq!(seen, (0..16).collect::<Vec<_>>(), "{at:?}");
    }
}

/// Rows of a strip have the bits that they have in the whole picture: nothing but the position counts.
#[test]
fn strips_are_the_picture() {
    let color = |x: i32, y: i32| [x * 5, y * 9, x * y].map(|c| c as u8);
    let row = |y: i32| (0..48).map(move |x| rgb565(color(x, y), (x, y)));
    let whole: Vec<u16> = (0..30).flat_map(row).collect();
    for height in [1, 7, 30] {
        let strips = (0..30).step_by(height).map(|top| top..(top + height as i32).min(30));
        let strips: Vec<u16> = strips.flat_map(|rows| rows.flat_map(row)).collect();
        assert_eq!(strips, whole, "strips of {height} rows");
    }
}
