//! Small triangles: less than 16 columns and rows, which is most triangles of a fine mesh.
//!
//! A shorter walk to the same bits: what is covered is that of exact geometry, values are the [slopes](mod@crate::slope) of
//! any other triangle, and whatever does not fit is left to [the walk](mod@crate::draw) of large ones. That is what crosses
//! the window's left or right side, what is too thin for slopes, and targets whose rows do not lie at one distance.
//!
//! All of coverage fits words of 32 bits: sides below 2^12 subpixels, edge functions below 2^24. One function, [`find`], the
//! same for all that is drawn, finds the rows' spans, and tells at once where there are none. An edge is followed by steps of
//! a column, not by division: over all rows it moves by hardly more columns than the triangle has.
//!
//! Both buffers are then looked at once for each triangle, as blocks of rows.
//!
//! **Cost** on Cortex-M4, with colours and depth: some 300 instructions for what is covered, 90 for the weights, 160 for the
//! values, 130 around them; then 14 for each row, 30 more for each that is drawn, and 19 for each pixel.
//!
//! **Error**: a step is off by 4·2^up units of a value of 31 bits, `up` as [slopes](mod@crate::slope) have it, which are there
//! for no more than 1024 >> up rows and columns: below 4096 units, an eighth of a step of depth.

use core::hint::black_box;

use crate::depth::Depth;
use crate::draw::Inside;
use crate::edge::{SUBPIXEL_BITS, SUBPIXELS, first_row};
use crate::fragment::Fragment;
use crate::screen::Shape;
use crate::slope::{Slopes, Weights};
use crate::target::Target;
use crate::varying::Varying;
use crate::window::Window;

/// Fewer columns and rows than that.
const REACH: i32 = 16;

/// A point in subpixels.
type Point = (i32, i32);

/// Draws a small triangle; `false`, and nothing drawn, where it is none or another walk has to draw it.
#[inline(always)]
pub(crate) fn triangle<C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, fragment: &F) -> bool
where
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    <F::Varying as Varying>::Slopes::EXIST
        && !<F::Varying as Varying>::Slopes::DRAWS
        && paint(color, depth, shape, fragment)
}

#[inline(never)]
fn paint<C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, fragment: &F) -> bool
where
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    let corners = [0, 1, 2].map(|i| shape.position(i));
    let mut spans = [0; REACH as usize];
    let found = if D::ENABLED || <F::Varying as Varying>::Slopes::CARRIES {
        find::<true>(&corners, &color.window(), &mut spans)
    } else {
        find::<false>(&corners, &color.window(), &mut spans)
    };
    match &found {
        Found::Nothing => true,
        Found::Large => false,
        Found::Rows { part, weights } => {
            // Looked at in place: taken out of its option, it would be copied.
            let inside = Inside::new::<D, _>(weights, shape);
            match &inside {
                Some(inside) => paint_spans(inside, color, depth, part, &spans, fragment),
                None => false,
            }
        }
    }
}

/// Draws the `spans` of `part`; whether the targets have blocks.
#[inline(always)]
fn paint_spans<C, D, F>(
    inside: &Inside<F::Varying>,
    color: &mut C,
    depth: &mut D,
    part: &Window,
    spans: &Spans,
    fragment: &F,
) -> bool
where
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    let Some((block, stride)) = color.block(part) else {
        return false;
    };
    let Some(mut cells) = depth.block(part, stride, block.len()) else {
        return false;
    };
    let Some(spans) = spans.get(..(part.bottom - part.top) as usize) else {
        return false;
    };
    // Read where it is, row by row: kept, it would take registers, or be stored a second time.
    let inside = black_box(inside);
    let mut start = 0;
    for (row, &span) in (part.top..).zip(spans) {
        let [from, count] = span.to_le_bytes().map(usize::from);
        if count != 0
            && let Some(pixels) = block.get_mut(start + from..).and_then(|rest| rest.get_mut(..count))
            && (D::ENABLED || !fragment.fill(pixels))
        {
            let place = (part.left + from as i32, row);
            let (mut ramps, depth_ramp) = (inside.slopes.ramps(place), inside.depth.ramp(place));
            let mut fine = depth_ramp.value as u32;
            let cells = D::block_cells(&mut cells, start + from, count);
            for (pixel, cell) in pixels.iter_mut().zip(cells) {
                if D::test(cell, fine >> 15)
                    && let Some(new) = fragment.shade(inside.slopes.values(&ramps), *pixel)
                {
                    *pixel = new;
                }
                fine = fine.wrapping_add(depth_ramp.step as u32);
                F::Varying::advance(&mut ramps);
                single(());
            }
        }
        start = start.wrapping_add(stride);
    }
    true
}

/// Keeps a loop from being unrolled or computed ahead: no instruction, but one that a compiler takes for a call.
#[inline(always)]
fn single(nothing: ()) {
    black_box(nothing);
}

/// Of each row, from the top, the first column of its span, counted from the box's left, in the lower byte, and in the upper
/// one how many there are.
type Spans = [u16; REACH as usize];

/// What there is to draw.
enum Found {
    /// No sample on the window.
    Nothing,
    /// A triangle that is not for this walk.
    Large,
    /// As much of the triangle's box as the window has rows.
    Rows { part: Window, weights: Weights },
}

/// Looks for what a triangle covers of `window`, with weights where it `CARRIES` values.
///
/// A function of its own: the same for all that is drawn.
#[inline(never)]
fn find<const CARRIES: bool>(corners: &[Point; 3], window: &Window, spans: &mut Spans) -> Found {
    let &[mut a, mut b, mut c] = corners;
    let (leftmost, rightmost) = (a.0.min(b.0).min(c.0), a.0.max(b.0).max(c.0));
    // From the top.
    if b.1 < a.1 {
        (a, b) = (b, a);
    }
    if c.1 < b.1 {
        (b, c) = (c, b);
        if b.1 < a.1 {
            (a, b) = (b, a);
        }
    }
    // Neither is negative: both are as small as their union.
    if (rightmost.wrapping_sub(leftmost) | c.1.wrapping_sub(a.1)) as u32 >= (REACH as u32) << SUBPIXEL_BITS {
        return Found::Large;
    }
    let (left, right) = (first_row(leftmost), first_row(rightmost));
    let (first, end) = (first_row(a.1), first_row(c.1));
    let (top, bottom) = (first.max(window.top), end.min(window.bottom));
    if left >= right || top >= bottom {
        return Found::Nothing;
    }
    if left < window.left || right > window.right {
        return Found::Large;
    }
    let middle = first_row(b.1);
    let mut long = Edge::new(a, c, left);
    let Some((above, below)) = spans.split_at_mut_checked((middle - first) as usize) else {
        return Found::Large;
    };
    let mut any = long.walk(Edge::new(a, b, left), above);
    if let Some(below) = below.get_mut(..(end - middle) as usize) {
        any |= long.walk(Edge::new(b, c, left), below);
    }
    if any == 0 {
        return Found::Nothing;
    }
    if top > first {
        skip(spans, (top - first) as usize, (end - top).max(0) as usize);
    }
    let mut weights = Weights::default();
    if CARRIES && !lay(&mut weights, corners) {
        return Found::Large;
    }
    Found::Rows {
        part: Window::new(left, top, right, bottom),
        weights,
    }
}

/// As [`Weights::lay`], to the same bits, of a triangle with an area whose sides fit half a word.
#[inline(always)]
fn lay(weights: &mut Weights, &[a, b, c]: &[Point; 3]) -> bool {
    let (first, second) = ((b.0 - a.0, b.1 - a.1), (c.0 - a.0, c.1 - a.1));
    let area = first.0 * second.1 - first.1 * second.0;
    let zeros = area.unsigned_abs().leading_zeros();
    let normalized = (area.unsigned_abs().wrapping_shl(zeros), -(zeros as i32));
    weights.lay_with_area(a, first, second, area < 0, normalized)
}

/// Takes off `count` rows above the window; `kept` are left.
#[cold]
#[inline(never)]
fn skip(spans: &mut Spans, count: usize, kept: usize) {
    for to in 0..kept {
        let Some(&span) = spans.get(count.wrapping_add(to)) else {
            return;
        };
        if let Some(above) = spans.get_mut(to) {
            *above = span;
        }
        single(());
    }
}

/// As [`Edge`](crate::edge::Edge), for sides that fit half a word, without rows to skip and without a division.
///
/// The remainder is kept in 2^-8 of what it is there, rounded down: all that is added to it are whole numbers of that, and the
/// sign of the floor is the sign.
struct Edge {
    column: i32,
    remainder: i32,
    dx: i32,
    dy: i32,
}

impl Edge {
    /// At the first row at or below `from`, columns counted from `origin`.
    #[inline(always)]
    fn new(from: Point, to: Point, origin: i32) -> Self {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let above = -from.1 & (SUBPIXELS - 1);
        Edge {
            column: (from.0 >> SUBPIXEL_BITS) - origin,
            remainder: -((from.0 & (SUBPIXELS - 1)) * dy + dx * above) >> SUBPIXEL_BITS,
            dx,
            dy,
        }
    }

    /// What lies between this edge and another, as far down as there are `spans`; whether that is anywhere something.
    #[inline(always)]
    fn walk(&mut self, mut other: Edge, spans: &mut [u16]) -> i32 {
        let mut any = 0;
        for span in spans {
            let (one, two) = (self.first_column(), other.first_column());
            let (from, count) = if two < one { (two, one - two) } else { (one, two - one) };
            *span = (from | count << 8) as u16;
            any |= count;
            self.remainder -= self.dx;
            other.remainder -= other.dx;
        }
        any
    }

    /// The first column at or right of the edge, of a row that it crosses: there `dy` is not 0.
    #[inline(always)]
    fn first_column(&mut self) -> i32 {
        while self.remainder < 0 {
            self.remainder += self.dy;
            self.column += 1;
            single(());
        }
        while self.remainder >= self.dy {
            self.remainder -= self.dy;
            self.column -= 1;
            single(());
        }
        self.column
    }
}
