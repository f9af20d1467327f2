//! Small triangles: less than 16 columns and rows, which is most triangles of a fine mesh.
//!
//! A shorter walk: what is covered is that of exact geometry, values are within the error of the [slopes](mod@crate::slope) of
//! any other triangle, and what is too thin is left to [the walk](mod@crate::draw) of large ones. Which walk draws a triangle
//! is for its corners alone to say, so that any window and any target has the same bits.
//!
//! All of coverage fits words of 32 bits: sides below 2^12 subpixels, edge functions below 2^24. One function, [`find`], the
//! same for all that is drawn, finds the rows' spans, and tells at once where there are none. A side is followed by a step per
//! row from two divisions where the core divides, else by steps of a column.
//!
//! Both buffers are then looked at once for each triangle, as blocks of rows: places are compared with their ends once for each
//! row. Where a triangle crosses the left or right side of the window, or the buffers are of different windows or their rows do
//! not lie at one distance, its spans are drawn one by one.
//!
//! **Cost** on Cortex-M4, with colours and depth: some 255 instructions for what is covered, 60 for the weights, 120 for the
//! values, 90 around them; then 22 for each row, of which 10 are for its span, 29 more for each that is drawn, and 19 for each
//! pixel, but 13 for the last of a row.
//!
//! **Error**: weights are in units of 2^-27 whatever the triangle's size, `up` 5 as [slopes](mod@crate::slope) have it: a step
//! is off by 128 units of a value of 31 bits. There are no more than 32 rows and columns, and half a step of each from the first
//! corner to the sample nearest to it: below 4096 units, an eighth of a step of depth. [Colours](crate::varying::Color565) are
//! cut to 2^-11 level in each step, and within a 64th of a level.

use core::cell::Cell;
use core::hint::black_box;

use crate::depth::Depth;
use crate::draw::Inside;
use crate::edge::{SUBPIXEL_BITS, SUBPIXELS, first_row};
use crate::fragment::Fragment;
use crate::num::{high, nearer_reciprocal};
use crate::screen::{Shape, of_corners};
use crate::slope::{SMALL_UP, Slope, Slopes, SmallWeights};
use crate::span::Span;
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
    !F::COMPACT && <F::Varying as Varying>::Slopes::EXIST && paint(color, depth, shape, fragment)
}

#[inline(never)]
fn paint<C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, fragment: &F) -> bool
where
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    let corners = of_corners(|i| shape.position(i));
    let mut spans = [0; REACH as usize];
    let carries = D::ENABLED || <F::Varying as Varying>::Slopes::CARRIES;
    let find = match (carries, DIVIDES) {
        (true, true) => find::<true, Divided>,
        (true, false) => find::<true, Stepped>,
        (false, true) => find::<false, Divided>,
        (false, false) => find::<false, Stepped>,
    };
    let found = find(&corners, &color.window(), &mut spans);
    let Found::Rows { weights, .. } = &found else {
        return matches!(found, Found::Nothing);
    };
    // Looked at in place: taken out of its option, it would be copied.
    let inside = values::<D, _>(weights, shape);
    let Some(inside) = &inside else {
        return false;
    };
    if !paint_block(inside, color, depth, &found, &spans, fragment) {
        paint_rows(inside, color, depth, &found, &spans, fragment);
    }
    true
}

/// All that is interpolated over a small triangle, from the weights' origin on.
#[inline(always)]
fn values<D: Depth, S: Shape>(weights: &SmallWeights, shape: &S) -> Option<Inside<S::Varying>> {
    let mut depth = Slope::default();
    if D::ENABLED {
        depth = weights.slope(of_corners(|i| shape.depth(i)));
        depth.value = depth.value.wrapping_add(1 << 14);
        // Nothing of the others is loaded before that is done, as if there were registers for all.
        black_box(());
    }
    Some(Inside {
        depth,
        slopes: <S::Varying as Varying>::Slopes::small(weights, of_corners(|i| shape.varying(i)))?,
    })
}

/// Draws the `spans` of what was found; whether that is all on the window and the targets have blocks of the same shape.
#[inline(always)]
fn paint_block<C, D, F>(
    inside: &Inside<F::Varying>,
    color: &mut C,
    depth: &mut D,
    found: &Found,
    spans: &Spans,
    fragment: &F,
) -> bool
where
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    let Found::Rows {
        top,
        bottom,
        whole: true,
        weights,
    } = *found
    else {
        return false;
    };
    let window = color.window();
    let Some((block, stride)) = color.block() else {
        return false;
    };
    let Some(mut cells) = depth.block(&window, stride, block.len()) else {
        return false;
    };
    let Some(spans) = spans.get(..(bottom - top) as usize) else {
        return false;
    };
    // Read where it is, row by row: kept, it would take registers, or be stored a second time.
    let inside = black_box(inside);
    let origin = weights.origin();
    // Wrapping: the origin's column may lie left of the window.
    let mut start = (top.wrapping_sub(window.top) as usize).wrapping_mul(stride);
    start = start.wrapping_add(origin.0.wrapping_sub(window.left) as usize);
    for (row, &span) in (top - origin.1..).zip(spans) {
        let (from, count) = columns(span);
        let first = start.wrapping_add(from as usize);
        let count = count as usize;
        if count != 0
            && let Some(rest) = block.get_mut(first..)
            && let Some(pixels) = rest.get_mut(..count)
            && (D::ENABLED || !fragment.fill(pixels))
        {
            let cells = D::block_cells(&mut cells, first, count);
            paint_row::<D, F>(inside, pixels, cells, (from, row), fragment);
        }
        start = start.wrapping_add(stride);
    }
    true
}

/// All of `pixels` from a place on: after the last of them nothing is stepped, since rows have but two or three.
#[inline(always)]
fn paint_row<D, F>(
    inside: &Inside<F::Varying>,
    pixels: &mut [F::Pixel],
    cells: D::Cells<'_>,
    place: (i32, i32),
    fragment: &F,
) where
    D: Depth,
    F: Fragment,
{
    let (mut ramps, depth_ramp) = (inside.slopes.ramps(place), inside.depth.ramp(place));
    let mut fine = depth_ramp.value as u32;
    let mut fragments = pixels.iter_mut().zip(cells);
    let mut next = fragments.next();
    while let Some((pixel, cell)) = next {
        if D::test(cell, fine >> 15)
            && let Some(new) = fragment.shade(inside.slopes.values(&ramps), *pixel)
        {
            *pixel = new;
        }
        next = fragments.next();
        if next.is_none() {
            return;
        }
        fine = fine.wrapping_add(depth_ramp.step as u32);
        F::Varying::advance(&mut ramps);
        single(());
    }
}

/// As [`paint_block`], row by row: the same bits on any window and target.
#[cold]
#[inline(never)]
fn paint_rows<C, D, F>(
    inside: &Inside<F::Varying>,
    color: &mut C,
    depth: &mut D,
    found: &Found,
    spans: &Spans,
    fragment: &F,
) where
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    let Found::Rows {
        top, bottom, weights, ..
    } = found
    else {
        return;
    };
    let window = depth.limit(color.window());
    let origin = weights.origin();
    for (row, &span) in (*top..*bottom).zip(spans) {
        let (from, count) = columns(span);
        let from = origin.0 + from;
        let span = Span::new(row, (from, from + count), &window);
        if span.left < span.right && (window.top..window.bottom).contains(&row) {
            let place = (span.left - origin.0, row - origin.1);
            inside.shade_others(color, depth, &span, place, fragment);
        }
    }
}

/// Keeps a loop from being unrolled or computed ahead: no instruction, but one that a compiler takes for a call.
#[inline(always)]
fn single(nothing: ()) {
    black_box(nothing);
}

/// Of each row, from the top, the first column of its span in six bits, with a sign, and in the upper byte how many there are.
/// Columns count from the [origin](SmallWeights::origin), which is at most 16 from any.
type Spans = [u16; REACH as usize];

/// The first column of a span and how many there are.
#[inline(always)]
fn columns(span: u16) -> (i32, i32) {
    ((span as i32) << FRACTION >> FRACTION, (span >> 8) as i32)
}

/// What there is to draw.
enum Found {
    /// No sample on the window.
    Nothing,
    /// A triangle that is not for this walk, whatever the window.
    Large,
    /// Those of the triangle that the window has; whether it has all of its columns.
    Rows {
        top: i32,
        bottom: i32,
        whole: bool,
        weights: SmallWeights,
    },
}

/// Looks for what a triangle covers of `window`, with weights where it `CARRIES` values.
///
/// A function of its own: the same for all that is drawn.
#[inline(never)]
fn find<const CARRIES: bool, E: Side>(corners: &[Point; 3], window: &Window, spans: &mut Spans) -> Found {
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
    let extent = (rightmost.wrapping_sub(leftmost) | c.1.wrapping_sub(a.1)) as u32;
    if extent >= (REACH as u32) << SUBPIXEL_BITS {
        return Found::Large;
    }
    let (left, right) = (first_row(leftmost), first_row(rightmost));
    let (first, end) = (first_row(a.1), first_row(c.1));
    let mut part = Window::new(left, first, right, end);
    let mut whole = true;
    if off(&part, window) {
        (part.top, part.bottom) = (first.max(window.top), end.min(window.bottom));
        if left.max(window.left) >= right.min(window.right) || part.top >= part.bottom {
            return Found::Nothing;
        }
        whole = left >= window.left && right <= window.right;
    }
    let middle = first_row(b.1);
    let origin = SmallWeights::nearest(corners[0].0);
    let (long, upper) = (E::new(a, c, origin), E::new(a, b, origin));
    let long_is_left = (b.0 - a.0) * (c.1 - a.1) > (c.0 - a.0) * (b.1 - a.1);
    let (mut one, mut two) = if long_is_left { (long, upper) } else { (upper, long) };
    let Some((above, below)) = spans.split_at_mut_checked((middle - first) as usize) else {
        return Found::Large;
    };
    let mut any = walk(&mut one, &mut two, above);
    if let Some(below) = below.get_mut(..(end - middle) as usize) {
        let lower = E::new(b, c, origin);
        if long_is_left {
            two = lower;
        } else {
            one = lower;
        }
        any |= walk(&mut one, &mut two, below);
    }
    if any == 0 {
        return Found::Nothing;
    }
    if part.top > first {
        skip(spans, (part.top - first) as usize, (end - part.top).max(0) as usize);
    }
    let mut weights = SmallWeights::new(corners[0], (0, 0), (0, 0));
    if CARRIES && !lay(&mut weights, corners, extent) {
        return Found::Large;
    }
    Found::Rows {
        top: part.top,
        bottom: part.bottom,
        whole,
        weights,
    }
}

/// Whether something of `part` is off `window`, or it is empty on one side.
#[inline(always)]
fn off(part: &Window, window: &Window) -> bool {
    // Wrapping: of windows that reach farther than corners may lie, anything may be drawn.
    let beyond = part.left.wrapping_sub(window.left)
        | part.top.wrapping_sub(window.top)
        | window.right.wrapping_sub(part.right)
        | window.bottom.wrapping_sub(part.bottom)
        | (part.right - part.left - 1);
    beyond < 0
}

/// The spans between two edges, as far down as there are `spans`; whether there is anywhere something.
#[inline(always)]
fn walk<E: Side>(left: &mut E, right: &mut E, spans: &mut [u16]) -> i32 {
    let mut any = 0;
    for span in spans {
        let (from, to) = (left.column(), right.column());
        let count = to - from;
        *span = (from as u16 & 63) | (count << 8) as u16;
        any |= count;
        // Both where they are, then both one row on: in between, there would be old ones to keep.
        single(());
        left.descend();
        right.descend();
    }
    any
}

/// Lays the weights of a triangle whose sides are no longer than `extent`; whether it is thick enough, and has an area.
///
/// With an area of 32 − `zeros` bits a weight is below 2^(4 + bits of a side + `zeros`) in units of 2^-(32 − up): within 2^30.
#[inline(always)]
fn lay(weights: &mut SmallWeights, &[a, b, c]: &[Point; 3], extent: u32) -> bool {
    let ((x1, y1), (x2, y2)) = ((b.0 - a.0, b.1 - a.1), (c.0 - a.0, c.1 - a.1));
    let area = x1 * y2 - y1 * x2;
    let sign = area >> 31;
    let magnitude = ((area ^ sign) - sign) as u32;
    let zeros = magnitude.leading_zeros();
    if zeros + 6 > extent.leading_zeros() {
        return false;
    }
    // 1/|area| = reciprocal · 2^-(62 − zeros).
    let reciprocal = nearer_reciprocal(magnitude.wrapping_shl(zeros));
    let reciprocal = (reciprocal ^ sign) - sign;
    let weight = |side: i32, reciprocal: i32| high(side.wrapping_shl(zeros + SMALL_UP), reciprocal);
    let x = (weight(y2, reciprocal), weight(y1, -reciprocal));
    let y = (weight(x2, -reciprocal), weight(x1, reciprocal));
    *weights = SmallWeights::new(a, x, y);
    true
}

/// Takes off `count` rows above the window; `kept` are left.
#[cold]
#[inline(never)]
fn skip(spans: &mut Spans, count: usize, kept: usize) {
    // Shared, so that what is read may overlap with what is written: four instructions a row.
    let spans = Cell::from_mut(spans.as_mut_slice()).as_slice_of_cells();
    let Some(from) = spans.get(count..).and_then(|below| below.get(..kept)) else {
        return;
    };
    for (to, from) in spans.iter().zip(from) {
        to.set(from.get());
        single(());
    }
}

/// A side of a small triangle, from row to row.
trait Side: Copy {
    /// At the first row at or below `from`, columns counted from `origin`; `to` is below `from`, or at its height.
    fn new(from: Point, to: Point, origin: i32) -> Self;
    /// The first column at or right of the side in the row, which it crosses.
    fn column(&mut self) -> i32;
    /// One row on.
    fn descend(&mut self);
}

/// With a division per side.
///
/// A place is a column in units of 2^-26. Of a side of `dy` subpixels a sample's distance, if any, is at least 1/(256·dy) of a column,
/// that is more than 64 units, and all that is cut off in up to 16 rows is less than 32: half of that up, and the floor is exact.
#[derive(Clone, Copy, Default)]
struct Divided {
    /// With all but 32 of what makes a floor of the next column.
    place: i32,
    step: i32,
}

/// Bits of a [`Divided`] side's column.
const FRACTION: u32 = 26;

impl Side for Divided {
    #[inline(always)]
    fn new(from: Point, to: Point, origin: i32) -> Self {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        // All of its bits, so that a division need not look for the one quotient that does not fit.
        let dy = dy & ((REACH << SUBPIXEL_BITS) - 1);
        let above = -from.1 & (SUBPIXELS - 1);
        // dx/dy = (coarse + fine·2^-7)·2^-19, below 2^31.
        let quotient = |v: i32| v.checked_div(dy).unwrap_or_default();
        let coarse = quotient(dx << 19);
        let fine = quotient(((dx << 19) - coarse.wrapping_mul(dy)) << 7);
        // A row that is crossed lies no farther below than `to`: the product is at most dx·2^19.
        let start = (coarse.wrapping_mul(above) >> 1) + (fine.wrapping_mul(above) >> 8);
        let column = (from.0 - (origin << SUBPIXEL_BITS)) << (FRACTION - SUBPIXEL_BITS);
        Divided {
            place: column.wrapping_add(start).wrapping_add((1 << FRACTION) - 32),
            step: (coarse << 7).wrapping_add(fine),
        }
    }

    #[inline(always)]
    fn column(&mut self) -> i32 {
        self.place >> FRACTION
    }
    #[inline(always)]
    fn descend(&mut self) {
        self.place = self.place.wrapping_add(self.step);
    }
}

/// Where division is a call: by steps of a column. Over all rows a side moves by hardly more columns than the triangle has.
///
/// As [`Edge`](crate::edge::Edge), for sides that fit half a word, without rows to skip. The remainder is kept in 2^-8 of what
/// it is there, rounded down: all that is added to it are whole numbers of that, and the sign of the floor is the sign.
#[derive(Clone, Copy)]
struct Stepped {
    column: i32,
    remainder: i32,
    dx: i32,
    dy: i32,
}

impl Side for Stepped {
    #[inline(always)]
    fn new(from: Point, to: Point, origin: i32) -> Self {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let above = -from.1 & (SUBPIXELS - 1);
        Stepped {
            column: (from.0 >> SUBPIXEL_BITS) - origin,
            remainder: -((from.0 & (SUBPIXELS - 1)) * dy + dx * above) >> SUBPIXEL_BITS,
            dx,
            dy,
        }
    }

    /// In a row that is crossed `dy` is not 0.
    #[inline(always)]
    fn column(&mut self) -> i32 {
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
    #[inline(always)]
    fn descend(&mut self) {
        self.remainder -= self.dx;
    }
}

/// Whether the core divides: all but ARMv6-M, which is the one of its family without compare-and-swap.
const DIVIDES: bool = cfg!(not(all(target_arch = "arm", not(target_has_atomic = "32"))));

#[cfg(test)]
mod tests {
    use super::*;

    /// The first column at or right of a side in a row, by a division of exact integers.
    fn exact(from: Point, to: Point, row: i32) -> i32 {
        let (dx, dy) = ((to.0 - from.0) as i64, (to.1 - from.1) as i64);
        let below = (row * SUBPIXELS - from.1) as i64;
        let (numerator, denominator) = (from.0 as i64 * dy + dx * below, dy * SUBPIXELS as i64);
        -(-numerator).div_euclid(denominator) as i32
    }

    fn follow<E: Side>(from: Point, to: Point) {
        let mut side = E::new(from, to, 0);
        for row in first_row(from.1)..first_row(to.1) {
            assert_eq!(side.column(), exact(from, to, row), "{from:?} {to:?} in row {row}");
            side.descend();
        }
    }

    /// Both ways on a million sides: any, and such as pass samples, where a side of many rows comes nearest to a column.
    #[test]
    fn sides_have_the_exact_columns() {
        let mut state = 1u64;
        let mut below = |limit: i32| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) % limit as u64) as i32
        };
        const LONGEST: i32 = (REACH << SUBPIXEL_BITS) - 1;
        for case in 0..1_000_000 {
            let dy = match case % 4 {
                0 => below(LONGEST) + 1,
                1 => LONGEST - below(300).min(LONGEST - 1),
                2 => below(300) + 1,
                _ => (below(15) + 1) << SUBPIXEL_BITS,
            };
            let from = match case % 3 {
                0 => (below(4096), below(256)),
                1 => (below(16) << SUBPIXEL_BITS, 0),
                _ => (below(4096), 256 - below(3)),
            };
            let to = (below(4096), from.1 + dy);
            follow::<Divided>(from, to);
            follow::<Stepped>(from, to);
        }
    }
}
