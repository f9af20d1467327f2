//! Weights of a triangle's corners at any sample that it covers, from its edge functions: the way for triangles that are too
//! large or too thin for one set of [slopes](mod@crate::slope).
//!
//! A span is drawn in pieces of up to [`PIECE`] pixels. At the first sample of a piece the weights are quotients of an exact
//! edge function by the exact area, in 0…1; from there they are stepped. Where a piece has two samples, both have weights in
//! 0…1, so that a step is at most 1, whatever the gradient. Pieces begin at the span's first column, on the window or not, so
//! that a strip or tile has the bits of the whole picture.
//!
//! **Error.** Weights and their step are cut to 2^-30 of 1, and what [slopes](mod@crate::slope) make of them is cut by
//! four units a pixel, of a value of 31 bits by as many for its two weights: on a piece of 256 below 2100 units, little more than
//! a sixteenth of a step of depth.
//!
//! **Budget.** Corners lie within ±2^23 subpixels and samples within the triangle: edge functions are below 2^50.

use crate::edge::SUBPIXEL_BITS;
use crate::num::{high_unsigned, product};
use crate::slope::{Inverse, Weights};
use crate::window::Window;

/// Pixels of a piece: 32-bit steps keep within the stated error that far, and the piece's divisions cost a pixel little.
const PIECE: i32 = 256;

/// Leaves the first piece of a row's `columns`, the first and the one after the last; what comes after it.
#[inline(always)]
pub(crate) fn cut_piece(columns: &mut (i32, i32)) -> Option<(i32, i32)> {
    let (left, right) = *columns;
    columns.1 = right.min(left + PIECE);
    (columns.1 < right).then_some((columns.1, right))
}

/// Whether a piece has pixels on `window`.
#[inline(always)]
pub(crate) fn is_on(window: Window, (left, right): (i32, i32)) -> bool {
    left.max(window.left) < right.min(window.right)
}

/// Lays weights for the samples right of the covered one at `column` and `row`, of a triangle on the screen with the inverse of
/// its area.
///
/// A function of its own: the same for all that is drawn.
#[cold]
#[inline(never)]
pub(crate) fn lay(weights: &mut Weights, &[a, b, c]: &[(i32, i32); 3], area: &Inverse, column: i32, row: i32) {
    let from_corner = |p: (i32, i32)| (p.0 - a.0, p.1 - a.1);
    let (first, second) = (from_corner(b), from_corner(c));
    let sample = from_corner((column << SUBPIXEL_BITS, row << SUBPIXEL_BITS));
    let cross = |p: (i32, i32), q: (i32, i32)| product(p.0, q.1) - product(p.1, q.0);
    // Of either sign: by the area's, and its own.
    let step = |side: i32| {
        let sign = area.sign ^ side >> 31;
        (part((side as i64) << SUBPIXEL_BITS, area) ^ sign).wrapping_sub(sign)
    };
    let at = (part(cross(sample, second), area), part(cross(first, sample), area));
    *weights = Weights::at_sample((column, row), at, (step(second.1), step(first.1).wrapping_neg()));
}

/// |`function`| over the area, in units of 2^-30, for at most the area: below 2^32, shifted as that was.
///
/// A function of its own: there are four, and 64-bit words are long to shift.
#[inline(never)]
fn part(function: i64, area: &Inverse) -> i32 {
    let function = function.unsigned_abs().rotate_right(area.shift as u32) as u32;
    high_unsigned(function, area.reciprocal as u32) as i32
}
