//! `point`, `billboard` and `circle`: squares of samples around a vertex, all at its depth (formats/mp1.md section 4).

use std::ops::Range;

use super::clip::{self, corner};
use super::fragment::{Canvas, texel};
use super::screen::Point;
use crate::picture::Picture;
use crate::reference::raster::{X, Y, Z};
use crate::scene::mp1::Vertex;

/// Draws a square of `size` pixels in the vertex' colour.
pub fn point(canvas: &mut Canvas<'_>, size: f64, center: &Vertex) {
    let Some((color, at, size)) = placed(canvas, center, size) else {
        return;
    };
    for (column, row) in samples(canvas, size, &at) {
        canvas.fragment(column, row, at[Z], color);
    }
}

/// Draws a square of `size` pixels with the whole texture on it.
pub fn billboard(canvas: &mut Canvas<'_>, size: f64, center: &Vertex, texture: &Picture) {
    let Some((_, at, size)) = placed(canvas, center, size) else {
        return;
    };
    // From the exact corner of the square, not the first sample.
    let coordinate = |sample: usize, center: f64| (sample as f64 - (center - size / 2.0)) / size;
    for (column, row) in samples(canvas, size, &at) {
        let coordinates = [coordinate(column, at[X]), coordinate(row, at[Y])];
        canvas.fragment(column, row, at[Z], texel(texture, coordinates));
    }
}

/// Draws a disc of diameter `size` pixels in the vertex' colour: of the square's samples those no farther than half of it.
pub fn circle(canvas: &mut Canvas<'_>, size: f64, center: &Vertex) {
    let Some((color, at, size)) = placed(canvas, center, size) else {
        return;
    };
    let square = |v: f64| v * v;
    for (column, row) in samples(canvas, size, &at) {
        if square(column as f64 - at[X]) + square(row as f64 - at[Y]) <= square(size / 2.0) {
            canvas.fragment(column, row, at[Z], color);
        }
    }
}

/// A centre's colour and place, and the size in samples; none if the view volume leaves it out, or where one is not finite.
fn placed(canvas: &Canvas<'_>, center: &Vertex, size: f64) -> Option<([f64; 4], Point, f64)> {
    let corner = corner(center, canvas.switches.srgb);
    let size = size * canvas.screen.fsaa;
    if !clip::keep(clip::frustum(canvas.switches), &corner) || !size.is_finite() {
        return None;
    }
    let [_, _, _, _, r, g, b, alpha, _, _] = corner;
    Some(([r, g, b, alpha], canvas.screen.place(&corner)?, size))
}

/// The samples on the picture of a square of `size` samples, row by row.
fn samples(canvas: &Canvas<'_>, size: f64, center: &Point) -> impl Iterator<Item = (usize, usize)> + use<> {
    let columns = span(center[X], size, canvas.width);
    let rows = span(center[Y], size, canvas.height);
    rows.flat_map(move |row| columns.clone().map(move |column| (column, row)))
}

/// The whole numbers from center − size/2 up to before center + size/2, clipped to `0..limit`.
pub fn span(center: f64, size: f64, limit: u32) -> Range<usize> {
    let bound = |v: f64| v.ceil().clamp(0.0, f64::from(limit)) as usize;
    bound(center - size / 2.0)..bound(center + size / 2.0)
}
