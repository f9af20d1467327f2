//! Coverage equals exact geometry.

mod naive;
mod strict;

use fixel::depth::NoDepth;
use fixel::draw;
use fixel::num::Word;
use fixel::screen::{Position, SubPx};
use fixel::span::{doubled_area, scan};
use fixel::window::Window;
use naive::Point;
use proptest::prelude::*;
use strict::{Mark, StrictTarget};

/// The covered samples of `window`, one bit each, row after row.
fn scanned<W: Word>(triangle: [Point; 3], window: Window) -> Vec<bool> {
    let mut covered = vec![false; window.width() * window.height()];
    let area = doubled_area(&triangle);
    if area != 0 {
        scan::<W>(&triangle, area > 0, window, |span| {
            assert!(span.left < span.right && span.left >= window.left && span.right <= window.right);
            assert!(span.row >= window.top && span.row < window.bottom);
            for x in span.left..span.right {
                let i = (span.row - window.top) as usize * window.width() + (x - window.left) as usize;
                assert!(
                    !std::mem::replace(&mut covered[i], true),
                    "sample ({x}, {}) covered twice",
                    span.row
                );
            }
        });
    }
    covered
}

fn expected(triangle: [Point; 3], window: Window) -> Vec<bool> {
    (window.top..window.bottom)
        .flat_map(|y| (window.left..window.right).map(move |x| naive::covers(triangle, x, y)))
        .collect()
}

/// Every triangle whose corners lie on a grid of 2 subpixel bits over 3×3 pixels: 4,651,032 with an area.
#[test]
fn every_triangle_on_a_small_grid() {
    let points: Vec<Point> = (0..13 * 13).map(|i| (i % 13 * 64, i / 13 * 64)).collect();
    let window = Window::new(0, 0, 4, 4);
    let mut with_area = 0u32;
    for &a in &points {
        for &b in &points {
            for &c in &points {
                let triangle = [a, b, c];
                with_area += (doubled_area(&triangle) != 0) as u32;
                assert_eq!(
                    scanned::<i32>(triangle, window),
                    expected(triangle, window),
                    "{triangle:?}"
                );
            }
        }
    }
    assert_eq!(with_area, 4_651_032);
}

/// A small generator, so that a million cases do not cost a million allocations; its seed is the case's name.
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

    fn within(&mut self, limit: i32) -> i32 {
        self.below(2 * limit + 1) - limit
    }
}

/// Thin, huge, tiny, degenerate, and on whole samples; all within the guard band.
fn random_triangle(random: &mut Random) -> [Point; 3] {
    const G: i32 = 4096 * 256;
    let a = (random.within(G), random.within(G));
    let near = |random: &mut Random, p: Point, reach: i32| {
        (
            (p.0 + random.within(reach)).clamp(-G, G),
            (p.1 + random.within(reach)).clamp(-G, G),
        )
    };
    match random.below(6) {
        0 => [
            a,
            (random.within(G), random.within(G)),
            (random.within(G), random.within(G)),
        ],
        1 => {
            // A sliver: the third corner within a pixel of the line through the others.
            let b = (random.within(G), random.within(G));
            let t = random.below(1000) as i64;
            let on = |u: i32, v: i32| u + ((v - u) as i64 * t / 1000) as i32;
            let c = near(random, (on(a.0, b.0), on(a.1, b.1)), 256);
            [a, b, c]
        }
        2 => [a, near(random, a, 2000), near(random, a, 2000)],
        3 => [a, near(random, a, 300), (random.within(G), random.within(G))],
        4 => {
            let whole = |p: Point| (p.0 & !255, p.1 & !255);
            [whole(a), whole(near(random, a, 4000)), whole(near(random, a, 4000))]
        }
        _ => [a, (a.0, random.within(G)), (random.within(G), a.1)],
    }
}

/// A window of 16×16 pixels at random on, or a few pixels from, an edge or a corner.
fn window_near(random: &mut Random, triangle: [Point; 3]) -> Window {
    let i = random.below(3) as usize;
    let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
    let t = random.below(1025) as i64;
    let on = |u: i32, v: i32| (u + ((v - u) as i64 * t / 1024) as i32) >> 8;
    let (x, y) = (on(a.0, b.0) - 8 + random.within(6), on(a.1, b.1) - 8 + random.within(6));
    Window::new(x, y, x + 16, y + 16)
}

#[test]
fn a_million_random_triangles() {
    let mut random = Random(1);
    for case in 0..1_000_000 {
        let triangle = random_triangle(&mut random);
        let window = window_near(&mut random, triangle);
        let covered = scanned::<i32>(triangle, window);
        assert_eq!(
            covered,
            expected(triangle, window),
            "case {case}: {triangle:?} in {window:?}"
        );
    }
}

/// Words of 64 bits give the same spans where words of 32 do, and exact ones up to ±32768 px.
#[test]
fn wide_words_agree_and_reach_farther() {
    let mut random = Random(2);
    for case in 0..200_000 {
        let triangle = random_triangle(&mut random);
        let window = window_near(&mut random, triangle);
        assert_eq!(
            scanned::<i64>(triangle, window),
            scanned::<i32>(triangle, window),
            "case {case}: {triangle:?}"
        );
        let far = triangle.map(|(x, y)| (x * 8, y * 8));
        let window = window_near(&mut random, far);
        assert_eq!(
            scanned::<i64>(far, window),
            expected(far, window),
            "case {case}: {far:?} in {window:?}"
        );
    }
}

proptest! {
    /// A small failing triangle is easier to look at than a random one: proptest shrinks.
    #[test]
    fn any_triangle(xs in prop::array::uniform3(-2000..2000i32), ys in prop::array::uniform3(-2000..2000i32)) {
        let triangle = [(xs[0], ys[0]), (xs[1], ys[1]), (xs[2], ys[2])];
        let window = Window::new(-8, -8, 8, 8);
        prop_assert_eq!(scanned::<i32>(triangle, window), expected(triangle, window));
    }

    /// Any window of a picture gets the very spans of the whole one.
    #[test]
    fn any_window(
        xs in prop::array::uniform3(-9000..9000i32), ys in prop::array::uniform3(-9000..9000i32),
        left in -20..20i32, top in -20..20i32, width in 1..30i32, height in 1..30i32,
    ) {
        let triangle = [(xs[0], ys[0]), (xs[1], ys[1]), (xs[2], ys[2])];
        let part = Window::new(left, top, left + width, top + height);
        prop_assert_eq!(scanned::<i32>(triangle, part), expected(triangle, part));
    }

    /// A grid with random inner corners tiles its rectangle: every pixel exactly once, whatever the diagonals.
    #[test]
    fn a_mesh_covers_every_pixel_once(
        jitter in prop::collection::vec((-700..700i32, -700..700i32), 25),
        diagonals in prop::collection::vec(any::<bool>(), 36),
    ) {
        const CELL: i32 = 2560 + 77;
        let mut target = StrictTarget::new(Window::new(0, 0, 62, 62), false);
        let corner = |i: usize, j: usize| {
            let inner = (1..6).contains(&i) && (1..6).contains(&j);
            let (dx, dy) = if inner { jitter[(j - 1) * 5 + i - 1] } else { (0, 0) };
            (i as i32 * CELL + dx, j as i32 * CELL + dy)
        };
        let mut triangles = Vec::new();
        for j in 0..6 {
            for i in 0..6 {
                let quad = [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)];
                let split = if diagonals[j * 6 + i] { [[0, 1, 2], [0, 2, 3]] } else { [[1, 2, 3], [1, 3, 0]] };
                triangles.extend(split.map(|t| t.map(|k| quad[k])));
            }
        }
        // A turned-over triangle overlaps its neighbours in exact geometry, too.
        prop_assume!(triangles.iter().all(|t| doubled_area(t) > 0));
        for corners in triangles {
            let corners = corners.map(|(x, y)| Position::nearest(SubPx::from_bits(x), SubPx::from_bits(y)).flat());
            draw::triangle(&mut target, &mut NoDepth, corners, &Mark(b'#'));
        }
        let census = target.census();
        prop_assert_eq!(census.get(&'#'), Some(&(62 * 62)));
    }
}

/// Pictures as strings: what the rule means on a few pixels.
#[test]
fn the_top_left_rule_in_pictures() {
    let draw = |triangles: &[([(i16, i16); 3], u8)]| {
        let mut target = StrictTarget::new(Window::new(0, 0, 8, 5), false);
        for (corners, mark) in triangles {
            let corners = corners.map(|(x, y)| Position::from_pixels(x, y).flat());
            draw::triangle(&mut target, &mut NoDepth, corners, &Mark(*mark));
        }
        target.picture()
    };
    // The diagonal belongs to the triangle on its right: there it is a left edge.
    assert_eq!(
        draw(&[([(0, 0), (0, 4), (4, 0)], b'a'), ([(4, 0), (0, 4), (4, 4)], b'b')]),
        ["aaaa....", "aaab....", "aabb....", "abbb....", "........"]
    );
    // Left and top edges are in, right and bottom edges out, whichever way the corners run.
    assert_eq!(
        draw(&[([(1, 1), (6, 1), (6, 4)], b'c'), ([(6, 4), (1, 4), (1, 1)], b'd')]),
        ["........", ".ccccc..", ".ddccc..", ".ddddc..", "........"]
    );
    // No area, no pixel.
    assert_eq!(
        draw(&[([(1, 1), (3, 3), (5, 5)], b'e')]).concat().matches('e').count(),
        0
    );
}
