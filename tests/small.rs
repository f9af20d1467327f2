//! Triangles of a few pixels, which are walked in words of 32 bits: the samples of exact geometry, depths and colours within
//! their stated errors, the same bits in any window and target.

mod naive;
mod row_by_row;

use fixel::depth::{Always, DepthBuffer, FAR, NoDepth};
use fixel::draw;
use fixel::fragment::{Flat, Gouraud565};
use fixel::screen::{Corner, FineDepth, Position, SubPx};
use fixel::span::doubled_area;
use fixel::target::Buffer;
use fixel::varying::{Color565, Varying};
use fixel::window::Window;
use naive::Point;
use row_by_row::RowByRow;

/// From the first corner to the others: triangles count as small below 16 columns and rows, so that some are not.
const REACH: i32 = 4096;

/// Units of a corner's depth in a step of the buffer.
const STEP: f64 = 32768.0;

/// What is stated for values of 31 bits: at most 1024 >> up steps, each off by 4·2^up units.
const UNITS: f64 = 4096.0;

/// A small generator: its state is the case's name.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, limit: i32) -> i32 {
        (self.next() % limit as u64) as i32
    }

    fn near(&mut self, (x, y): Point, reach: i32) -> Point {
        (
            x + self.below(2 * reach + 1) - reach,
            y + self.below(2 * reach + 1) - reach,
        )
    }

    /// Of any size up to 16 px and one subpixel beyond, tiny, thin, and on whole samples.
    fn triangle(&mut self) -> [Point; 3] {
        let a = self.near((0, 0), 3000);
        let b = self.near(a, REACH);
        match self.below(6) {
            0 => [a, b, self.near(a, REACH)],
            1 => [a, self.near(a, 1500), self.near(a, 1500)],
            2 => [a, self.near(a, 300), self.near(a, 300)],
            3 => {
                // A sliver: the third corner within a few subpixels of the line through the others.
                let t = self.below(1000);
                let on = |u: i32, v: i32| u + (v - u) * t / 1000;
                let c = self.near((on(a.0, b.0), on(a.1, b.1)), 4);
                let turn = self.below(3) as usize;
                let mut corners = [a, b, c];
                corners.rotate_left(turn);
                corners
            }
            4 => [a, self.near(a, 1500), self.near(a, 1500)].map(|p| (p.0 & !255, p.1 & !255)),
            _ => [a, (a.0, b.1), (self.near(b, 200).0, self.near(a, 200).1)],
        }
    }

    fn window(&mut self) -> Window {
        let (left, top) = self.near((0, 0), 20);
        Window::new(left, top, left + 1 + self.below(30), top + 1 + self.below(30))
    }

    /// The ends of the range more often than not.
    fn depth(&mut self) -> u32 {
        match self.below(4) {
            0 => 0,
            1 => 65535 << 15,
            _ => (self.next() as u32) % (65535 << 15),
        }
    }

    fn color(&mut self) -> [u8; 3] {
        [(); 3].map(|()| match self.below(4) {
            0 => 0,
            1 => 255,
            _ => self.next() as u8,
        })
    }
}

/// All pixels of the window in the order of a buffer.
fn positions(window: Window) -> impl Iterator<Item = Point> {
    (window.top..window.bottom).flat_map(move |y| (window.left..window.right).map(move |x| (x, y)))
}

fn corners<V: Varying>(points: [Point; 3], depths: [u32; 3], varyings: [V; 3]) -> [Corner<V>; 3] {
    [0, 1, 2].map(|i| Corner {
        position: Position::new(SubPx::from_bits(points[i].0), SubPx::from_bits(points[i].1)).unwrap(),
        depth: FineDepth::from_bits(depths[i]),
        varying: varyings[i],
    })
}

fn covered(points: [Point; 3], window: Window, pixels: &mut Vec<bool>) {
    pixels.clear();
    pixels.resize(window.width() * window.height(), false);
    let mut target = Buffer::strip(pixels, window).unwrap();
    draw::triangle(&mut target, &mut NoDepth, corners(points, [0; 3], [(); 3]), &Flat(true));
}

/// Every triangle whose corners lie on a grid of 2 subpixel bits over 3×3 pixels: 4,651,032 with an area.
#[test]
fn every_triangle_on_a_small_grid() {
    let points: Vec<Point> = (0..13 * 13).map(|i| (i % 13 * 64, i / 13 * 64)).collect();
    let window = Window::new(0, 0, 4, 4);
    let (mut with_area, mut pixels) = (0u32, Vec::new());
    for &a in &points {
        for &b in &points {
            for &c in &points {
                with_area += (doubled_area(&[a, b, c]) != 0) as u32;
                covered([a, b, c], window, &mut pixels);
                let expected = positions(window).map(|(x, y)| naive::covers([a, b, c], x, y));
                assert!(pixels.iter().copied().eq(expected), "{:?}", [a, b, c]);
            }
        }
    }
    assert_eq!(with_area, 4_651_032);
}

#[test]
fn random_triangles_cover_the_exact_samples() {
    let (mut random, mut pixels) = (Random(1), Vec::new());
    let mut samples = 0;
    for case in 0..300_000 {
        let (points, window) = (random.triangle(), random.window());
        covered(points, window, &mut pixels);
        for ((x, y), &drawn) in positions(window).zip(&pixels) {
            assert_eq!(
                drawn,
                naive::covers(points, x, y),
                "case {case}: {points:?} at ({x}, {y})"
            );
            samples += drawn as usize;
        }
    }
    assert!(samples > 300_000, "{samples}");
}

/// Colours over `below`, and depths.
fn shaded(corners: &[Corner<Color565>; 3], window: Window, below: u16) -> (Vec<u16>, Vec<u16>) {
    let size = window.width() * window.height();
    let (mut colors, mut depths) = (vec![below; size], vec![FAR; size]);
    let mut depth = DepthBuffer::<_, Always>::new(Buffer::strip(&mut depths, window).unwrap());
    draw::triangle(
        &mut Buffer::strip(&mut colors, window).unwrap(),
        &mut depth,
        corners,
        &Gouraud565,
    );
    (colors, depths)
}

fn channels(pixel: u16) -> [i64; 3] {
    [pixel >> 11, pixel >> 5 & 63, pixel & 31].map(i64::from)
}

/// Depths within an eighth of a step before rounding, colours within a 64th of a level; both compared with the exact value.
#[test]
fn values_are_near_the_exact_ones() {
    const MOST: [i64; 3] = [31, 63, 31];
    const ALL: Window = Window::new(-48, -48, 48, 48);
    let mut random = Random(2);
    let (mut worst_depth, mut worst_color) = (0f64, 0f64);
    for case in 0..100_000 {
        let points = random.triangle();
        let (depths, colors) = ([(); 3].map(|()| random.depth()), [(); 3].map(|()| random.color()));
        let shape = corners(points, depths, colors.map(|[r, g, b]| Gouraud565::corner(r, g, b)));
        let (stored_colors, stored_depths) = shaded(&shape, ALL, 0);
        for (((x, y), color), depth) in positions(ALL).zip(stored_colors).zip(stored_depths) {
            if !naive::covers(points, x, y) {
                continue;
            }
            let exact = |values: [i64; 3]| {
                let (numerator, area) = naive::value(points, values, x, y);
                numerator as f64 / area as f64
            };
            let error = (depth as f64 * STEP - exact(depths.map(i64::from))).abs();
            worst_depth = worst_depth.max(error);
            for (channel, stored) in channels(color).into_iter().enumerate() {
                let exact = exact(colors.map(|color| color[channel] as i64 * MOST[channel])) / 255.0;
                worst_color = worst_color.max((stored as f64 - exact).abs());
            }
            assert!(
                error <= STEP / 2.0 + UNITS,
                "case {case}: {points:?} at ({x}, {y}): depth {error} off"
            );
            assert!(
                worst_color <= 0.5 + 1.0 / 64.0,
                "case {case}: {points:?} at ({x}, {y}): color {worst_color} off"
            );
        }
    }
    println!("worst: {worst_depth} units of depth, {worst_color} levels of color");
}

#[test]
fn any_window_has_the_same_bits() {
    const ALL: Window = Window::new(-48, -48, 64, 64);
    let mut random = Random(3);
    let mut samples = 0;
    for case in 0..50_000 {
        let (points, part) = (random.triangle(), random.window());
        let (depths, colors) = ([(); 3].map(|()| random.depth()), [(); 3].map(|()| random.color()));
        let shape = corners(points, depths, colors.map(|[r, g, b]| Gouraud565::corner(r, g, b)));
        let below = random.next() as u16;
        let whole = shaded(&shape, ALL, below);
        let found = shaded(&shape, part, below);
        let pixels = positions(ALL).zip(whole.0.into_iter().zip(whole.1));
        let expected: Vec<_> = pixels
            .filter(|&(at, _)| part.contains(at))
            .map(|(_, pixel)| pixel)
            .collect();
        let found: Vec<_> = found.0.into_iter().zip(found.1).collect();
        samples += found.iter().filter(|pixel| pixel.1 != FAR).count();
        assert_eq!(found, expected, "case {case}: {points:?} in {part:?}");
    }
    assert!(samples > 30_000, "{samples}");
}

#[test]
fn any_target_has_the_same_bits() {
    const ALL: Window = Window::new(-48, -48, 48, 48);
    let mut random = Random(4);
    let mut samples = 0;
    for case in 0..20_000 {
        let points = random.triangle();
        let (depths, colors) = ([(); 3].map(|()| random.depth()), [(); 3].map(|()| random.color()));
        let shape = corners(points, depths, colors.map(|[r, g, b]| Gouraud565::corner(r, g, b)));
        let expected = shaded(&shape, ALL, 7);
        let size = ALL.width() * ALL.height();
        let (mut colors, mut depths) = (vec![7; size], vec![FAR; size]);
        let mut depth = DepthBuffer::<_, Always>::new(RowByRow(Buffer::strip(&mut depths, ALL).unwrap()));
        let mut target = RowByRow(Buffer::strip(&mut colors, ALL).unwrap());
        draw::triangle(&mut target, &mut depth, &shape, &Gouraud565);
        samples += colors.iter().filter(|&&color| color != 7).count();
        assert!((colors, depths) == expected, "case {case}: {points:?}");
    }
    assert!(samples > 30_000, "{samples}");
}
