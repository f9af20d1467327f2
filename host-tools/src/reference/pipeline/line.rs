//! Lines (chapters 01 and 02, 06.3, 08.2): Bresenham between the ends' pixels, cut to the screen.

use super::clip;
use super::fragment::Canvas;
use super::interpolate::{mix, weights};
use super::program::Vertex;
use super::region::Rectangle;
use super::window::{Placed, place};

/// Clips a line, places its ends and draws it.
pub fn draw(canvas: &mut Canvas<'_>, ends: &[Vertex; 2]) {
    let viewport = canvas.state.viewport;
    let clipped = clip::line(ends, &canvas.state.clip_planes);
    let placed = clipped.map(|ends| ends.map(|end| place(&end, &viewport)));
    if let Some([Some(a), Some(b)]) = placed {
        fill(canvas, [&a, &b]);
    }
}

/// Draws the pixels of a line in the window.
pub fn fill(canvas: &mut Canvas<'_>, ends: [&Placed; 2]) {
    let [columns, rows] = canvas.pixels().map(|span| span.map(|c| c as f64));
    if columns[0] > columns[1] || rows[0] > rows[1] {
        return;
    }
    // The rectangle's borders are pixels, so the ends are made pixels before they are cut.
    let floored = ends.map(|end| [end.window[0].floor(), end.window[1].floor()]);
    let Some(cut) = (Rectangle { x: columns, y: rows }).cut(floored) else {
        return;
    };
    let [from, to] = cut.map(|end| end.map(|c| (c + 0.5).floor() as i64));
    for [x, y] in pixels(from, to) {
        fragment(canvas, ends, x, y);
    }
}

/// The pixels of a line, both ends included: one for each step along the longer axis, rightwards or upwards.
pub fn pixels(from: [i64; 2], to: [i64; 2]) -> Vec<[i64; 2]> {
    let steep = (to[1] - from[1]).abs() > (to[0] - from[0]).abs();
    let swapped = |[x, y]: [i64; 2]| if steep { [y, x] } else { [x, y] };
    let (from, to) = (swapped(from), swapped(to));
    let (from, to) = if from[0] > to[0] { (to, from) } else { (from, to) };
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let mut y = from[1];
    let mut d = 2 * dy.abs() - dx;
    let mut pixels = Vec::new();
    for x in from[0]..=to[0] {
        pixels.push(swapped([x, y]));
        if d > 0 {
            y += dy.signum();
            d -= 2 * dx;
        }
        d += 2 * dy.abs();
    }
    pixels
}

/// Where a pixel's centre falls on the line between two positions, from 0 at the first to 1 at the second.
pub fn along(a: [f64; 2], b: [f64; 2], center: [f64; 2]) -> f64 {
    let line = [b[0] - a[0], b[1] - a[1]];
    let length = line[0] * line[0] + line[1] * line[1];
    let share = (center[0] - a[0]) * line[0] + (center[1] - a[1]) * line[1];
    if length == 0.0 {
        0.0
    } else {
        (share / length).clamp(0.0, 1.0)
    }
}

fn fragment(canvas: &mut Canvas<'_>, [a, b]: [&Placed; 2], x: i64, y: i64) {
    let center = [x as f64 + 0.5, y as f64 + 0.5];
    let [from, to] = [a, b].map(|end| [end.window[0], end.window[1]]);
    let t = along(from, to, center);
    let [z, inverse_w] = [2, 3].map(|i| (1.0 - t) * a.window[i] + t * b.window[i]);
    let own = weights([1.0 - t, t], [a.window[3], b.window[3]], canvas.state.interpolation);
    let inputs = mix([&a.outputs, &b.outputs], own);
    canvas.fragment([x, y], [center[0], center[1], z, inverse_w], &inputs);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(mut pixels: Vec<[i64; 2]>) -> Vec<[i64; 2]> {
        pixels.sort_unstable();
        pixels
    }

    #[test]
    fn i01_1_flat_steep_and_backwards() {
        let flat = [[2, 3], [3, 3], [4, 4], [5, 4], [6, 5], [7, 5], [8, 6], [9, 6]];
        assert_eq!(pixels([2, 3], [9, 6]), flat);
        assert_eq!(pixels([9, 6], [2, 3]), flat);
        let steep = [[5, 1], [5, 2], [4, 3], [4, 4], [4, 5], [4, 6], [3, 7], [3, 8]];
        assert_eq!(pixels([5, 1], [3, 8]), steep);
    }

    #[test]
    fn i01_2_one_pixel_per_column_and_ties_below() {
        assert_eq!(pixels([0, 0], [4, 2]), [[0, 0], [1, 0], [2, 1], [3, 1], [4, 2]]);
        // The slope version, except on ties: the nearest row.
        for to in (0..40).flat_map(|x| (-x..=x).map(move |y| [x, y])) {
            let line = pixels([0, 0], to);
            assert_eq!(line.len() as i64, to[0] + 1);
            for (column, [x, y]) in (0..).zip(line) {
                assert_eq!(x, column);
                assert!(2 * (y * to[0] - x * to[1]).abs() <= to[0]);
            }
        }
    }

    #[test]
    fn i01_3_vertical_horizontal_and_one_pixel() {
        assert_eq!(pixels([7, 7], [7, 7]), [[7, 7]]);
        let vertical: Vec<_> = (2..=9).map(|y| [3, y]).collect();
        assert_eq!(pixels([3, 9], [3, 2]), vertical);
        let horizontal: Vec<_> = (2..=9).map(|x| [x, 3]).collect();
        assert_eq!(sorted(pixels([9, 3], [2, 3])), horizontal);
    }

    #[test]
    fn i06_3_by_the_pixels_centre_on_the_uncut_line() {
        let (a, b) = ([-100.5, 10.5], [100.5, 10.5]);
        assert!((along(a, b, [0.5, 10.5]) - 101.0 / 201.0).abs() < 1e-15);
        assert!((along(b, a, [0.5, 10.5]) - 100.0 / 201.0).abs() < 1e-15);
        assert_eq!(along(a, a, [0.5, 10.5]), 0.0);
        assert_eq!(along(a, b, [101.0, 10.5]), 1.0);
        assert_eq!(along(a, b, [-101.0, 10.5]), 0.0);
    }
}
