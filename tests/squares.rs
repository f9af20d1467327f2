//! Squares and discs: the samples of the rule, ties included, whatever their size; billboards' values near the exact ones.

use fixel::depth::{Always, DepthBuffer, FAR, NoDepth};
use fixel::disc::Disc;
use fixel::draw;
use fixel::fragment::{Flat, Fragment};
use fixel::screen::{Center, FineDepth, SubPx};
use fixel::square::Square;
use fixel::target::Buffer;
use fixel::varying::Linear;
use fixel::window::Window;
use proptest::prelude::*;

/// A center and a size in subpixels.
#[derive(Debug, Clone, Copy)]
struct Around {
    x: i32,
    y: i32,
    size: i32,
}

impl Around {
    fn center(&self) -> Center {
        Center {
            x: SubPx::from_bits(self.x),
            y: SubPx::from_bits(self.y),
            depth: FineDepth::from_bits(77 << 15),
        }
    }

    /// X − S/2 ≤ px < X + S/2, and rows likewise; in 1/512 px.
    fn in_square(&self, (x, y): (i32, i32)) -> bool {
        let inside = |p: i32, center: i32| {
            let (p, center, size) = (512 * p as i64, 2 * center as i64, self.size as i64);
            center - size <= p && p < center + size
        };
        inside(x, self.x) && inside(y, self.y)
    }

    /// Of the square, (px − X)² + (py − Y)² ≤ (S/2)².
    fn in_disc(&self, at: (i32, i32)) -> bool {
        let from = |p: i32, center: i32| 512 * p as i128 - 2 * center as i128;
        let (dx, dy, size) = (from(at.0, self.x), from(at.1, self.y), self.size as i128);
        self.in_square(at) && dx * dx + dy * dy <= size * size
    }

    /// Where its square starts, rounded up to a subpixel, for a center coordinate.
    fn start(&self, center: i32) -> i64 {
        (2 * center as i64 - self.size as i64 + 1).div_euclid(2)
    }
}

fn positions(window: Window) -> impl Iterator<Item = (i32, i32)> {
    (window.top..window.bottom).flat_map(move |y| (window.left..window.right).map(move |x| (x, y)))
}

fn check_coverage(around: Around, window: Window, picture: &mut [bool]) -> Result<(), TestCaseError> {
    let size = SubPx::from_bits(around.size);
    let picture = &mut picture[..window.width() * window.height()];

    picture.fill(false);
    let square = Square::new(around.center(), size, ());
    let mut target = Buffer::strip(picture, window).unwrap();
    draw::square(&mut target, &mut NoDepth, &square, &Flat(true));
    for (at, &covered) in positions(window).zip(&*picture) {
        prop_assert_eq!(covered, around.in_square(at), "square {:?} at {:?}", around, at);
    }

    picture.fill(false);
    let disc = Disc::new(around.center(), size, ());
    let mut target = Buffer::strip(picture, window).unwrap();
    draw::disc(&mut target, &mut NoDepth, &disc, &Flat(true));
    for (at, &covered) in positions(window).zip(&*picture) {
        prop_assert_eq!(covered, around.in_disc(at), "disc {:?} at {:?}", around, at);
    }
    Ok(())
}

/// All sizes up to 5 px in subpixels, around 7×7 places in a pixel.
#[test]
fn every_small_square_and_disc_covers_the_samples_of_the_rule() {
    let window = Window::new(-2, -2, 6, 6);
    let mut picture = [false; 64];
    for (x, y) in [0, 1, 64, 127, 128, 129, 255]
        .into_iter()
        .flat_map(|x| [0, 1, 64, 127, 128, 129, 255].map(|y| (x, y)))
    {
        for size in 0..=5 * 256 {
            let (x, y) = (512 + x, 512 + y);
            check_coverage(Around { x, y, size }, window, &mut picture).unwrap();
        }
    }
}

/// Where the extreme points fall on samples, the left and upper are covered, the right and lower not.
#[test]
fn extreme_points_on_samples() {
    for (size, reach) in [(512, 1), (1024, 2), (2560, 5)] {
        let around = Around {
            x: 8 * 256,
            y: 8 * 256,
            size,
        };
        let mut picture = [false; 256];
        let disc = Disc::new(around.center(), SubPx::from_bits(size), ());
        draw::disc(
            &mut Buffer::new(&mut picture, 16, 16).unwrap(),
            &mut NoDepth,
            &disc,
            &Flat(true),
        );
        let at = |x: usize, y: usize| picture[16 * y + x];
        assert!(at(8 - reach, 8) && at(8, 8 - reach), "left and upper, {size}");
        assert!(!at(8 + reach, 8) && !at(8, 8 + reach), "right and lower, {size}");
        assert!(at(8 + reach - 1, 8) && at(8, 8 + reach - 1), "the next, {size}");
    }
    // 3² + 4² = 5²: a point of the circle that is no extreme one is covered on every side.
    let around = Around { x: 0, y: 0, size: 2560 };
    for at in [(3, 4), (4, -3), (-3, 4), (-4, -3)] {
        assert!(around.in_disc(at));
    }
    let window = Window::new(-8, -8, 8, 8);
    check_coverage(around, window, &mut [false; 256]).unwrap();
}

/// Squares and discs of any size whose border passes near a small window.
fn cases() -> impl Strategy<Value = (Around, Window)> {
    let size = prop_oneof![2 => 0..60_000i32, 1 => 0..i32::MAX, 1 => -5..5i32, 1 => (0..31u32).prop_map(|b| 1 << b)];
    let at = (
        -2_000_000..2_000_000i32,
        -2_000_000..2_000_000i32,
        0.0..std::f64::consts::TAU,
    );
    (size, at, -300..300i32, 0..3usize).prop_map(|(size, (x, y, angle), off, kind)| {
        let radius = size as f64 / 2.0;
        // From a point near the border to the center: on the circle, on a side, inside.
        let (dx, dy) = match kind {
            0 => (radius * angle.cos(), radius * angle.sin()),
            1 => (radius, radius * angle.sin()),
            _ => (radius * angle.cos() * 0.9, -radius),
        };
        let around = Around {
            x: (x as f64 + dx) as i32 + off,
            y: (y as f64 + dy) as i32,
            size,
        };
        let (x, y) = (x / 256, y / 256);
        (around, Window::new(x - 6, y - 4, x + 6, y + 4))
    })
}

/// Keeps both values.
struct Keep;

impl Fragment for Keep {
    type Varying = Linear<2>;
    type Pixel = Option<[i32; 2]>;
    fn shade(&self, values: [i32; 2], _: Self::Pixel) -> Option<Self::Pixel> {
        Some(Some(values))
    }
}

/// Near from + (to − from)·(px − left)/S: to a unit per column and 2^-14 per row from the first covered within ±32768 px,
/// three units more, and 2^-27 of the range.
fn check_billboard(around: Around, window: Window, from: [i32; 2], to: [i32; 2]) -> Result<(), TestCaseError> {
    let mut picture = vec![None; window.width() * window.height()];
    let mut depths = vec![FAR; picture.len()];
    let square = Square::billboard(around.center(), SubPx::from_bits(around.size), from, to);
    let mut depth = DepthBuffer::<_, Always>::new(Buffer::strip(&mut depths, window).unwrap());
    draw::square(
        &mut Buffer::strip(&mut picture, window).unwrap(),
        &mut depth,
        &square,
        &Keep,
    );
    let (left, top) = (around.start(around.x), around.start(around.y));
    let [first, upper] = [left, top].map(|side| side.max(-32768 * 256));
    for ((at, kept), depth) in positions(window).zip(&picture).zip(&depths) {
        prop_assert_eq!(kept.is_some(), around.in_square(at));
        let Some(values) = *kept else { continue };
        prop_assert_eq!(*depth, 77);
        let columns = (at.0 as i64 - first / 256) as f64;
        for (i, distance) in [256 * at.0 as i64 - left, 256 * at.1 as i64 - top]
            .into_iter()
            .enumerate()
        {
            let rise = to[i] as i128 - from[i] as i128;
            let numerator = from[i] as i128 * around.size as i128 + rise * distance as i128;
            let off = (values[i] as i128 * around.size as i128 - numerator) as f64 / around.size as f64;
            let rows = (at.1 as i64 - upper / 256) as f64;
            let bound = columns + rows * 2f64.powi(-14) + 3.0 + rise.abs() as f64 * 2f64.powi(-27);
            prop_assert!(
                off.abs() <= bound,
                "{:?}: value {} of {:?} is {} off, not {}",
                at,
                i,
                values,
                off,
                bound
            );
            prop_assert!(values[i] >= from[i].min(to[i]) && values[i] <= from[i].max(to[i]));
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6000))]

    #[test]
    fn any_square_and_disc((around, window) in cases()) {
        let mut picture = [false; 96];
        check_coverage(around, window, &mut picture)?;
        // A window of one pixel has the same.
        let (x, y) = (window.left + 5, window.top + 3);
        check_coverage(around, Window::new(x, y, x + 1, y + 1), &mut picture)?;
    }

    #[test]
    fn billboards_run_from_side_to_side(
        (around, window) in cases(), from in prop::array::uniform2(-(1 << 30)..=1 << 30), to in prop::array::uniform2(-(1 << 30)..=1 << 30),
    ) {
        check_billboard(around, window, from, to)?;
        check_billboard(around, window, [0; 2], [1 << 28; 2])?;
    }
}
