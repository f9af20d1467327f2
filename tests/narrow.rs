//! Triangles that are interpolated in 32-bit words: colours within a level, quotients within their stated error, the same
//! bits in any window.

mod naive;
mod triangles;

use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::{Flat565, Fragment, Gouraud565};
use fixel::slope::Weights;
use fixel::span::doubled_area;
use fixel::target::Buffer;
use fixel::varying::{Color565, Linear32, Perspective, Perspective32, Varying};
use fixel::window::Window;
use proptest::prelude::*;
use triangles::{Case, Triangle, cases, positions, values};

/// Levels of each channel, from the top.
const MOST: [i64; 3] = [31, 63, 31];

fn triangle<V>(case: &Case, varyings: [V; 3]) -> Triangle<V> {
    Triangle {
        corners: case.corners,
        depths: [0; 3],
        varyings,
    }
}

fn channels(pixel: u16) -> [i64; 3] {
    [pixel >> 11, pixel >> 5 & 63, pixel & 31].map(i64::from)
}

/// The pixels of `window` that are drawn.
fn drawn(shape: &Triangle<Color565>, window: Window) -> Vec<((i32, i32), u16)> {
    let mut pixels = vec![None; window.width() * window.height()];
    let mut target = Buffer::strip(&mut pixels, window).unwrap();
    let area = doubled_area(shape);
    draw::polygon::<i32, _, _, _, _>(&mut target, &mut NoDepth, shape, area, &Keep);
    positions(window)
        .zip(pixels)
        .filter_map(|(at, pixel)| Some((at, pixel?)))
        .collect()
}

/// [`Gouraud565`], into pixels that tell whether they were drawn.
struct Keep;

impl Fragment for Keep {
    type Varying = Color565;
    type Pixel = Option<u16>;
    fn shade(&self, color: <Color565 as Varying>::Values, _: Option<u16>) -> Option<Option<u16>> {
        Gouraud565.shade(color, 0).map(Some)
    }
}

/// Colours with many at the ends of the range, where a channel would spill into its neighbour.
fn color() -> impl Strategy<Value = [u8; 3]> {
    prop::array::uniform3(prop_oneof![any::<u8>(), Just(0), Just(255)])
}

/// Within a level of the exact value, on spans of up to 1024 px and, with what is stated for each pixel beyond, on longer
/// ones.
fn check_colors(case: &Case, colors: [[u8; 3]; 3]) -> Result<(), TestCaseError> {
    let shape = triangle(case, colors.map(|[r, g, b]| Gouraud565::corner(r, g, b)));
    let columns = case.corners.map(|p| p.0 >> 8);
    let width = columns.iter().max().unwrap() - columns.iter().min().unwrap();
    let allowed = 1.0 + (width - 1024).max(0) as f64 / 2048.0;
    for ((x, y), pixel) in drawn(&shape, case.window) {
        for (channel, stored) in channels(pixel).into_iter().enumerate() {
            let exact = colors.map(|color| color[channel] as i64 * MOST[channel]);
            let (numerator, area) = naive::value(case.corners, exact, x, y);
            let error = (stored as f64 - numerator as f64 / area as f64 / 255.0).abs();
            prop_assert!(
                error <= allowed,
                "({}, {}), channel {}: {} levels off",
                x,
                y,
                channel,
                error
            );
        }
    }
    Ok(())
}

/// 1/w of three corners, the largest 1, the others not under 1/8 of it.
fn inverses() -> impl Strategy<Value = [i32; 3]> {
    let one = ((1 << 27)..=1 << 30i32).prop_map(|v| v);
    (prop::array::uniform2(one), 0..3usize).prop_map(|([a, b], turn)| {
        let mut all = [1 << 30, a, b];
        all.rotate_left(turn);
        all
    })
}

/// Texels of a side of the largest texture.
const SIDE: i32 = 512;

fn check_perspective(case: &Case, corner: [i32; 3], inverses: [i32; 3]) -> Result<(), TestCaseError> {
    let largest = corner.iter().map(|v| v.abs()).max().unwrap() as f64;
    let shape = triangle(
        case,
        [0, 1, 2].map(|i| Perspective32(Perspective::new([corner[i]], inverses[i]))),
    );
    let (columns, rows) = (case.corners.map(|p| p.0 >> 8), case.corners.map(|p| p.1 >> 8));
    let reach = |v: [i32; 3]| (v.iter().max().unwrap() - v.iter().min().unwrap() + 2) as f64;
    let small = Weights::new(case.corners).is_some();
    for ((x, y), [value]) in values::<i32, _>(&shape, case.window) {
        let over_w = [0, 1, 2].map(|i| corner[i] as i64 * inverses[i] as i64);
        let (numerator, area) = naive::value(case.corners, over_w, x, y);
        let (inverse, _) = naive::value(case.corners, inverses.map(i64::from), x, y);
        let truth = numerator as f64 / inverse as f64;
        let ratio = (1u64 << 30) as f64 / (inverse as f64 / area as f64);
        // The wide way loses a unit per pixel of the span, in the value and in 1/w.
        let units = if small {
            2200.0
        } else {
            2.0 * reach(columns) + reach(rows)
        };
        let bound = largest * 2f64.powi(-15) * (1.5 * ratio + 1.0) + ratio * units * (1.0 + largest * 2f64.powi(-30));
        prop_assert!(
            (value as f64 - truth).abs() <= bound,
            "({}, {}): {} is not {} ± {}",
            x,
            y,
            value,
            truth,
            bound
        );
    }
    Ok(())
}

/// Triangles of the standard workloads' kind: up to 100 rows and columns, w varying by 3, textures of 64 texels.
fn textured() -> impl Strategy<Value = (Case, [i32; 3], [i32; 3])> {
    let point = (0..12_800i32, 0..12_800i32);
    let inverse = prop::array::uniform2((1 << 30) / 3..=1 << 30i32);
    let corners = (
        prop::array::uniform3(point),
        prop::array::uniform3(0..=64 << 16i32),
        inverse,
    );
    corners.prop_filter_map("too thin", |(corners, texels, [a, b])| {
        let case = Case {
            corners,
            window: Window::new(0, 0, 51, 51),
        };
        let long = [(0, 1), (1, 2), (2, 0)].map(|(i, j): (usize, usize)| {
            let (dx, dy) = (corners[i].0 - corners[j].0, corners[i].1 - corners[j].1);
            ((dx as f64).powi(2) + (dy as f64).powi(2)).sqrt()
        });
        let height = doubled_area(&corners).unsigned_abs() as f64 / long.into_iter().fold(1.0, f64::max);
        (height > 1024.0).then_some((case, texels, [1 << 30, a, b]))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn colors_are_within_a_level(case in cases(4096), colors in prop::array::uniform3(color())) {
        check_colors(&case, colors)?;
    }

    #[test]
    fn quotients_are_near_the_exact_ones(
        case in cases(4096), corner in prop::array::uniform3(-(SIDE << 16)..=SIDE << 16), inverses in inverses(),
    ) {
        check_perspective(&case, corner, inverses)?;
    }

    #[test]
    fn affine_values_are_near_the_exact_plane(
        case in cases(4096), corner in prop::array::uniform3(-(SIDE << 16)..=SIDE << 16),
    ) {
        let shape = triangle(&case, corner.map(|v| Linear32([v])));
        for ((x, y), [value]) in values::<i32, _>(&shape, case.window) {
            let (numerator, area) = naive::value(case.corners, corner.map(i64::from), x, y);
            let error = (value as f64 - numerator as f64 / area as f64).abs();
            prop_assert!(error <= 2200.0, "({}, {}): {} units off", x, y, error);
        }
    }

    #[test]
    fn texels_are_within_a_thirty_second((case, texels, inverses) in textured()) {
        let shape = triangle(&case, [0, 1, 2].map(|i| Perspective32(Perspective::new([texels[i]], inverses[i]))));
        for ((x, y), [value]) in values::<i32, _>(&shape, case.window) {
            let over_w = [0, 1, 2].map(|i| texels[i] as i64 * inverses[i] as i64);
            let (numerator, _) = naive::value(case.corners, over_w, x, y);
            let (inverse, _) = naive::value(case.corners, inverses.map(i64::from), x, y);
            let error = (value as f64 - numerator as f64 / inverse as f64).abs() / 65536.0;
            prop_assert!(error <= 1.0 / 32.0, "({}, {}): {} texels off", x, y, error);
        }
    }

    #[test]
    fn any_window_has_the_same_bits(
        case in cases(200), colors in prop::array::uniform3(color()), texels in prop::array::uniform3(0..=64 << 16i32),
        inverses in inverses(), left in -30..30i32, top in -30..30i32, width in 1..30i32, height in 1..30i32,
    ) {
        let (window, part) = (Window::new(-60, -60, 60, 60), Window::new(left, top, left + width, top + height));
        let inside = |&(x, y): &(i32, i32)| part.contains((x, y));
        let shape = triangle(&case, colors.map(|[r, g, b]| Gouraud565::corner(r, g, b)));
        let whole: Vec<_> = drawn(&shape, window).into_iter().filter(|(at, _)| inside(at)).collect();
        prop_assert_eq!(whole, drawn(&shape, part));
        let shape = triangle(&case, [0, 1, 2].map(|i| Perspective32(Perspective::new([texels[i]], inverses[i]))));
        let whole: Vec<_> = values::<i32, _>(&shape, window).into_iter().filter(|(at, _)| inside(at)).collect();
        prop_assert_eq!(whole, values::<i32, _>(&shape, part));
    }

    /// What slopes state of themselves: for values of all 31 bits an eighth of 2^15 units, for 23 bits 1100.
    #[test]
    fn slopes_are_near_the_exact_plane(case in cases(4096), corner in prop::array::uniform3(0..=65535 << 15i32)) {
        let Some(weights) = Weights::new(case.corners) else { return Ok(()) };
        for (shift, stated) in [(0, 4096.0), (8, 1100.0)] {
            let values = corner.map(|v| v >> shift);
            let slope = weights.slope(values);
            for (x, y) in positions(case.window).filter(|&at| naive::covers(case.corners, at.0, at.1)) {
                let (numerator, area) = naive::value(case.corners, values.map(i64::from), x, y);
                let error = slope.ramp((x, y)).value as f64 - numerator as f64 / area as f64;
                prop_assert!(error.abs() <= stated, "({}, {}), {} bits: {} units off", x, y, 31 - shift, error);
            }
        }
    }

    #[test]
    fn filling_by_words_reaches_every_pixel(count in 0..200usize, skip in 0..4usize, pixel in any::<u16>()) {
        let mut pixels = vec![!pixel; count + skip];
        let spared = skip.min(pixels.len());
        prop_assert!(Flat565::new(pixel).fill(&mut pixels[spared..]));
        prop_assert!(pixels[..spared].iter().all(|&p| p != pixel) && pixels[spared..].iter().all(|&p| p == pixel));
    }
}
