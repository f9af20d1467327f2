//! Weights of a triangle's corners at any sample that it covers, from its edge functions: the way for triangles that are too
//! large or too thin for one set of [slopes](mod@crate::slope).
//!
//! A span is drawn in pieces of up to [`PIECE`] pixels. At the first and the last sample of a piece the weights are quotients
//! of an exact edge function by the exact area, in 0…1; between them they are linear, and so every value of the piece lies
//! between those of its ends, slivers included, whatever their gradient. Pieces begin at the span's first column, on the
//! window or not, so that a strip or tile has the bits of the whole picture.
//!
//! **Error.** Weights are cut to 2^-28 of 1 and their step to 2^-30, and what [slopes](mod@crate::slope) make of them is cut by
//! four units a pixel: on a piece of 256 below 2000 units for a value of 31 bits, a sixteenth of a step of depth.
//!
//! **Budget.** Corners lie within ±2^23 subpixels and samples within the triangle: edge functions are below 2^50.

use crate::edge::SUBPIXEL_BITS;
use crate::num::near_reciprocal;
use crate::slope::{Weights, normalized};
use crate::span::Span;

/// Pixels of a piece: 32-bit steps keep within the stated error that far, and the piece's divisions cost a pixel little.
const PIECE: i32 = 256;

/// A triangle as its weights see it.
pub(crate) struct Barycentric {
    corner: (i32, i32),
    /// The other corners from there, turned over where the area is negative.
    first: (i64, i64),
    second: (i64, i64),
    /// 1/|area| = reciprocal · 2^-(62 + shift).
    reciprocal: u32,
    shift: i32,
}

impl Barycentric {
    /// Of a triangle on the screen, in subpixels, that has an area.
    #[inline(never)]
    pub(crate) fn new([a, b, c]: [(i32, i32); 3]) -> Self {
        let from_corner = |p: (i32, i32)| ((p.0 - a.0) as i64, (p.1 - a.1) as i64);
        let (first, second) = (from_corner(b), from_corner(c));
        let area = first.0 * second.1 - first.1 * second.0;
        let (divisor, shift) = normalized(area.unsigned_abs());
        let side = |(x, y): (i64, i64)| if area < 0 { (-x, -y) } else { (x, y) };
        Barycentric {
            corner: a,
            first: side(first),
            second: side(second),
            reciprocal: near_reciprocal(divisor) as u32,
            shift,
        }
    }

    /// The piece of `span` that holds column `from`, from there on: weights for its pixels, and itself as a span.
    #[inline(never)]
    pub(crate) fn piece(&self, span: &Span, from: i32) -> (Weights, Span) {
        let start = from - ((from - span.whole_left) & (PIECE - 1));
        let end = (start + PIECE).min(span.whole_right);
        let (b, c) = self.at(start, span.row);
        let (last_b, last_c) = self.at(end - 1, span.row);
        // In units of 2^-30 per pixel, cut towards zero: no value leaves the range of those at the ends.
        let step = |change: i32| (change * 2).checked_div(end - 1 - start).unwrap_or(0);
        let x = (step(last_b - b), step(last_c - c));
        let piece = Span {
            row: span.row,
            left: from,
            right: end.min(span.right),
            whole_left: start,
            whole_right: end,
        };
        (Weights::at_sample((start, span.row), (-b, -c), x, (0, 0), 2), piece)
    }

    /// Weights of the second and third corner at a covered sample, in units of 2^-29.
    fn at(&self, x: i32, y: i32) -> (i32, i32) {
        let dx = ((x << SUBPIXEL_BITS) - self.corner.0) as i64;
        let dy = ((y << SUBPIXEL_BITS) - self.corner.1) as i64;
        let weight = |function: i64| {
            let function = if self.shift >= 0 {
                function >> self.shift
            } else {
                function << -self.shift
            };
            // At most the area, which is below 2^32 by now: the product is at most 2^62.
            ((function as u64 * self.reciprocal as u64) >> 33) as i32
        };
        (
            weight(dx * self.second.1 - dy * self.second.0),
            weight(self.first.0 * dy - self.first.1 * dx),
        )
    }
}
