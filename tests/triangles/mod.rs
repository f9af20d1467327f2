//! Triangles of every kind for property tests, a small window that each of them crosses, and what its pixels get.

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::marker::PhantomData;

use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::Fragment;
use fixel::num::Word;
use fixel::screen::{Corner, FineDepth, Position, Shape, SubPx};
use fixel::span::{Corners, doubled_area};
use fixel::target::Buffer;
use fixel::varying::Varying;
use fixel::window::Window;
use proptest::prelude::*;

/// A point in subpixels.
pub type Point = (i32, i32);

/// A triangle with an area, and a window of 24×12 px around a point in it.
#[derive(Debug, Clone)]
pub struct Case {
    pub corners: [Point; 3],
    pub window: Window,
}

/// Corners within ±`guard` px: small, large and huge triangles, slivers, tiny ones.
pub fn cases(guard: i32) -> impl Strategy<Value = Case> {
    let limit = guard * 256;
    let point = move |reach: i32| (-reach..=reach, -reach..=reach);
    let three = move |reach: i32| prop::array::uniform3(point(reach)).boxed();
    let sliver = (three(limit), 0.0..1.0f64, point(400)).prop_map(|([a, b, _], t, (dx, dy))| {
        let on = |u: i32, v: i32| u + ((v - u) as f64 * t) as i32;
        [a, b, (on(a.0, b.0) + dx, on(a.1, b.1) + dy)]
    });
    let tiny = (point(limit - 300), three(300)).prop_map(|((x, y), t)| t.map(|(dx, dy)| (x + dx, y + dy)));
    let kinds = prop_oneof![3 => three(9000), 3 => three(90_000), 3 => three(limit), 2 => sliver, 1 => tiny];
    (kinds, prop::array::uniform3(0.0..1.0f64)).prop_filter_map("no area", move |(corners, weights)| {
        let corners = corners.map(|(x, y)| (x.clamp(-limit, limit), y.clamp(-limit, limit)));
        let sum: f64 = weights.iter().sum();
        let mean = |v: [i32; 3]| (v.iter().zip(weights).map(|(&v, w)| v as f64 * w / sum).sum::<f64>() / 256.0) as i32;
        let (x, y) = (mean(corners.map(|c| c.0)), mean(corners.map(|c| c.1)));
        let window = Window::new(x - 12, y - 6, x + 12, y + 6);
        (doubled_area(&corners) != 0).then_some(Case { corners, window })
    })
}

/// A triangle on the screen for either word.
pub struct Triangle<V> {
    pub corners: [Point; 3],
    pub depths: [i32; 3],
    pub varyings: [V; 3],
}

impl<V> Corners for Triangle<V> {
    fn count(&self) -> usize {
        3
    }
    fn position(&self, index: usize) -> Point {
        self.corners[index.min(2)]
    }
}

impl<V: Varying> Shape for Triangle<V> {
    type Varying = V;
    fn depth(&self, index: usize) -> i32 {
        self.depths[index]
    }
    fn varying(&self, index: usize) -> V {
        self.varyings[index]
    }
}

/// The corners for [`draw::triangle`].
pub fn corners<V: Copy>(corners: [Point; 3], depths: [u32; 3], varyings: [V; 3]) -> [Corner<V>; 3] {
    [0, 1, 2].map(|i| Corner {
        position: Position::nearest(SubPx::from_bits(corners[i].0), SubPx::from_bits(corners[i].1)),
        depth: FineDepth::from_bits(depths[i]),
        varying: varyings[i],
    })
}

/// Stores what each pixel gets.
pub struct Keep<V>(pub PhantomData<V>);

impl<V: Varying> Fragment for Keep<V> {
    type Varying = V;
    type Pixel = Option<V::Values>;
    fn shade(&self, values: V::Values, _: Self::Pixel) -> Option<Self::Pixel> {
        Some(Some(values))
    }
}

/// The values of the covered pixels of `window`, by the walk of word `W`.
pub fn values<W: Word, V: Varying>(triangle: &Triangle<V>, window: Window) -> Vec<((i32, i32), V::Values)> {
    let mut pixels = vec![None; window.width() * window.height()];
    let mut target = Buffer::strip(&mut pixels, window).unwrap();
    let area = doubled_area(triangle);
    draw::polygon::<W, _, _, _, _>(&mut target, &mut NoDepth, triangle, area, &Keep(PhantomData));
    positions(window)
        .zip(pixels)
        .filter_map(|(at, v)| Some((at, v?)))
        .collect()
}

/// All pixels of the window in the order of a buffer.
pub fn positions(window: Window) -> impl Iterator<Item = (i32, i32)> {
    (window.top..window.bottom).flat_map(move |y| (window.left..window.right).map(move |x| (x, y)))
}

/// How far a value linear over the screen may be from the exact one at (x, y), in its own units, as `gradient` states
/// it: 2^-14 for each step from the anchor (corner 0's pixel), and 2^-24 of the range of the corners, slivers included.
pub fn fine_error(corners: [Point; 3], values: [i64; 3], (_, y): (i32, i32)) -> f64 {
    let range = (values.iter().max().unwrap() - values.iter().min().unwrap()) as f64;
    // To the span's start and along it; one more for the anchor's place in its pixel.
    let columns = 2.0 * width(corners) + 1.0;
    let rows = (y - (corners[0].1 >> 8)).abs() as f64 + 1.0;
    (columns + rows) * 2f64.powi(-14) + range * 2f64.powi(-24)
}

/// The same for 32-bit stepping: a unit for the start, and one more for each pixel along the span.
pub fn stated_error(corners: [Point; 3], values: [i64; 3], at: (i32, i32)) -> f64 {
    fine_error(corners, values, at) + width(corners) + 1.0
}

/// Columns that the triangle crosses, not counting the first.
fn width(corners: [Point; 3]) -> f64 {
    let columns = corners.map(|p| p.0 >> 8);
    (columns.iter().max().unwrap() - columns.iter().min().unwrap()) as f64
}
