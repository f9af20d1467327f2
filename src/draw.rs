//! The walk: from corners on the screen to pixels in the target.

use core::borrow::Borrow;
use core::hint::black_box;
use core::mem;

use crate::barycentric;
use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::gradient::{Basis, Place, Plane, Ramp};
use crate::line::Line;
use crate::num::Word;
use crate::screen::{Corner, Shape, of_corners};
use crate::slope::{Inverse, Slope, Slopes, Weights};
use crate::small;
use crate::span::{BLOCK, Corners, Scan, Span, Spans, TriangleRows, doubled_area};
use crate::target::Target;
use crate::varying::Varying;
use crate::view::{Carried, Shown, Vertex, View};
use crate::window::Window;

mod indexed;
mod segment;
mod square;

use indexed::Painter;
pub use indexed::{assembled, indexed};
pub use segment::{primitive_segment, primitive_wu_line, segment, stroke, wu_line, wu_stroke};
pub use square::{disc, primitive_billboard, primitive_disc, primitive_square, square};

/// Draws a triangle with corners within ±4096 px, whichever way they run, onto a target within 0…4096 px.
///
/// Coverage is that of exact geometry under the top-left rule, so that triangles which share an edge share no pixel and
/// leave none out. A triangle without area draws nothing.
///
/// ```
/// use fixel::{depth::NoDepth, draw, fragment::Flat, screen::Position, target::Buffer};
/// let mut picture = [b'.'; 8 * 4];
/// let corners = [(0, 0), (0, 4), (8, 0)].map(|(x, y)| Position::from_pixels(x, y).flat());
/// draw::triangle(&mut Buffer::new(&mut picture, 8, 4)?, &mut NoDepth, corners, &Flat(b'#'));
/// let rows: Vec<_> = picture.chunks(8).map(|row| str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, ["########", "######..", "####....", "##......"]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[inline(always)]
pub fn triangle<C, D, F>(color: &mut C, depth: &mut D, corners: impl Borrow<[Corner<F::Varying>; 3]>, fragment: &F)
where
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    let corners = corners.borrow();
    if !small_polygon(color, depth, corners, fragment) {
        // In the caller, where its window may be a constant: 9 % fewer instructions on Cortex-M4 (W2 of `cargo xtask measure`).
        large::<i32, _, _, _, _, _>(color, depth, corners, corners, doubled_area(corners), fragment);
    }
}

/// Draws a triangle given in eye space: clips, projects and draws what is left of it.
///
/// The example is [`View`]'s.
pub fn primitive<T, W, C, D, F, const N: usize>(
    view: &View<T, W, N>,
    color: &mut C,
    depth: &mut D,
    vertices: &[Vertex<T, <F::Varying as Carried>::Vertex>; 3],
    fragment: &F,
) where
    T: Word,
    W: Word,
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel, Varying: Carried>,
{
    if F::COMPACT {
        view.paint(vertices, &mut Painter::<W, _, _, _>::new(color, depth, fragment));
        return;
    }
    view.project::<F::Varying>(vertices, |shape| {
        projected::<W, _, _, _, _>(color, depth, &shape.shown(), fragment);
    });
}

/// As [`shape`], of what a view has left.
#[inline(never)]
fn projected<W, C, D, V, F>(color: &mut C, depth: &mut D, shown: &Shown<'_, V>, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    V: Carried,
    F: Fragment<Pixel = C::Pixel, Varying = V>,
{
    if <F::Varying as Varying>::Slopes::EXIST
        && let Some(triangle) = shown.triangle()
    {
        shape::<W, _, _, _, _>(color, depth, &triangle, fragment);
    } else {
        convex::<W, _, _, _, _, _>(color, depth, shown, &shown.corners, shown.corners.area(), fragment);
    }
}

/// Draws the line from one pixel to another, the last left out; see [`line`](mod@crate::line).
///
/// ```
/// use fixel::{draw, fragment::Flat, target::Buffer};
/// let mut picture = [b'.'; 6 * 3];
/// draw::line(&mut Buffer::new(&mut picture, 6, 3)?, (0, 2), (6, 0), &Flat(b'#'));
/// let rows: Vec<_> = picture.chunks(6).map(|row| str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, [".....#", "..###.", "##...."]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn line<C, F>(color: &mut C, from: (i16, i16), to: (i16, i16), fragment: &F)
where
    C: Target,
    F: Fragment<Pixel = C::Pixel, Varying = ()>,
{
    let window = color.window();
    for (x, y) in Line::new(from, to, window) {
        if let Some(pixel) = color.row(y).get_mut(x.wrapping_sub(window.left) as u32 as usize)
            && let Some(new) = fragment.shade((), *pixel)
        {
            *pixel = new;
        }
    }
}

/// Draws a convex polygon whose corners lie within ±[`Word::GUARD`] px; `area` is its [`doubled_area`].
///
/// Corners may repeat, and may be a subpixel off convexity, as rounding leaves them.
#[inline]
pub fn polygon<W, C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, area: i64, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    if !small_polygon(color, depth, shape, fragment) {
        any_size::<W, _, _, _, _>(color, depth, shape, shape, area, fragment);
    }
}

/// As [`polygon`], of what has an area that nobody needs to know where it is a small triangle.
#[inline(always)]
pub(crate) fn shape<W, C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    if !small_polygon(color, depth, shape, fragment) {
        any_size::<W, _, _, _, _>(color, depth, shape, shape, doubled_area(shape), fragment);
    }
}

/// Draws it if it is a small triangle; whether it was.
#[inline(always)]
fn small_polygon<C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, fragment: &F) -> bool
where
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    shape.count() == 3 && small::triangle(color, depth, shape, fragment)
}

/// As [`polygon`], by the walk that draws all there is; `outline` has the corners of `shape`, alone.
///
/// A function of its own, whose stack and registers small triangles do not pay for.
#[inline(never)]
fn any_size<W, C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, outline: &impl Corners, area: i64, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    large::<W, _, _, _, _, _>(color, depth, shape, outline, area, fragment);
}

#[inline(always)]
fn large<W, C, D, S, O, F>(color: &mut C, depth: &mut D, shape: &S, outline: &O, area: i64, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    O: Corners,
    F: Fragment<Pixel = C::Pixel>,
{
    // Where any polygon can come, the code for those does for triangles.
    let is_apart = O::TRIANGLE || !F::COMPACT;
    if is_apart && <F::Varying as Varying>::Slopes::EXIST && shape.count() == 3 {
        if area != 0 {
            rows_of_triangle::<W, _, _, _, _>(color, depth, shape, area, fragment);
        }
        return;
    }
    convex::<W, _, _, _, _, _>(color, depth, shape, outline, area, fragment);
}

/// As [`large`], of any polygon.
#[inline(always)]
fn convex<W, C, D, S, O, F>(color: &mut C, depth: &mut D, shape: &S, outline: &O, area: i64, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    O: Corners,
    F: Fragment<Pixel = C::Pixel>,
{
    let spans = Scan::<W, _>::new(outline, area > 0);
    if D::ENABLED || <F::Varying as Varying>::Slopes::CARRIES {
        paint(color, depth, shape, &Basis::new(outline), &spans, fragment);
    } else {
        // Nothing is interpolated: no plane, and no basis of any.
        let mut inside = None;
        Inside::<F::Varying>::lay::<D, _>(&mut inside, &Weights::default(), shape);
        if let Some(inside) = &inside {
            spans.each(depth.limit(color.window()), |span| {
                inside.span(color, depth, &span, fragment);
            });
        }
    }
}

/// Draws a triangle with an `area` whose varying has slopes: one set of them for all of it, or where it is too large or too thin
/// one for each piece of a span.
#[inline(always)]
fn rows_of_triangle<W, C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, area: i64, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    let corners = of_corners(|i| shape.position(i));
    let window = depth.limit(color.window());
    let carries = D::ENABLED || <F::Varying as Varying>::Slopes::CARRIES;
    let area = Inverse::of(area);
    let mut weights = Weights::placeholder(area.shift);
    let whole = !carries || weights.lay(&corners, &area);
    let mut inside = None;
    Inside::lay::<D, _>(&mut inside, &weights, shape);
    let mut rows = TriangleRows::<W>::new(&corners, area.sign != 0, &window);
    let mut block = rows.room();
    let room = if whole { BLOCK } else { 1 };
    // What is left of a row after a piece of it.
    let mut rest = None;
    while let Some((row, columns)) = rows.walk(&mut block, room, rest.take()) {
        if !whole && let Some(columns) = columns.first_mut() {
            rest = barycentric::cut_piece(columns);
            if barycentric::is_on(window, *columns) {
                barycentric::lay(&mut weights, &corners, &area, columns.0, row);
                Inside::lay::<D, _>(&mut inside, &weights, shape);
            }
        }
        // Looked at in place: taken out of its option, it would be copied.
        let Some(inside) = &inside else {
            return;
        };
        if <F::Varying as Varying>::Slopes::DRAWS && inside.draw_rows(color, depth, row, columns, &window, fragment) {
            continue;
        }
        for (row, columns) in (row..).zip(&*columns) {
            let mut span = Span::new(row, *columns, &window);
            while span.left < span.right {
                let left_over = inside.span(color, depth, &span, fragment);
                if left_over == 0 {
                    break;
                }
                // Looked up once more: kept, it would take registers.
                span = Span::new(row, *columns, &window);
                span.left = span.right.wrapping_sub(left_over as i32).wrapping_add(1);
                if !F::COMPACT {
                    inside.shade_others(color, depth, &span, (span.left, row), fragment);
                    break;
                }
            }
        }
    }
}

/// All that is interpolated over a triangle, or a piece of its spans.
pub(crate) struct Inside<V: Varying> {
    /// At the place that all count from, with the half that rounds to the nearest step: modulo 2^32, where it was 0…65535 steps.
    pub(crate) depth: Slope,
    pub(crate) slopes: V::Slopes,
}

impl<V: Varying> Inside<V> {
    /// Becomes what `shape` carries; none where its varying has no use for weights. In place: returned, it would be copied.
    #[inline(never)]
    fn lay<D: Depth, S: Shape<Varying = V>>(inside: &mut Option<Self>, weights: &Weights, shape: &S) {
        let mut depth = Slope::default();
        if D::ENABLED {
            depth = weights.slope(of_corners(|i| shape.depth(i)));
            depth.value = depth.value.wrapping_add(1 << 14);
            // Nothing of the others is loaded before that is done, as if there were registers for all.
            black_box(());
        }
        let slopes = V::Slopes::new(weights, of_corners(|i| shape.varying(i)));
        *inside = slopes.map(|slopes| Inside { depth, slopes });
    }

    /// One span: what is hidden at its start costs the comparison and one addition for each pixel, and nothing else is looked
    /// at before the first visible one. How many pixels are left from a hidden one on that comes
    /// behind a visible one, or first where a [`Depth`] of one's own skips none; that one is done with.
    #[inline(always)]
    fn span<C, D, F>(&self, color: &mut C, depth: &mut D, span: &Span, fragment: &F) -> usize
    where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let Span { row, left, right, .. } = *span;
        if V::Slopes::DRAWS || !D::ENABLED {
            let pixels = color.span(row, left, right);
            if pixels.is_empty() || !D::ENABLED && fragment.fill(pixels) {
                return 0;
            }
            if !V::Slopes::DRAWS {
                self.shade(pixels, (left, row), fragment);
            } else if D::ENABLED {
                self.draw_visible::<D, F>(span, pixels, depth.cells(span), fragment);
            } else {
                self.slopes.draw(span, pixels, fragment);
            }
            return 0;
        }
        let Ramp { value, step } = self.depth.ramp((left, row));
        let Some((cells, fine)) = D::skip(depth.cells(span), value as u32, step as u32) else {
            return 0;
        };
        let column = right.wrapping_sub(cells.size_hint().0 as i32);
        let pixels = color.span(row, column, right);
        self.shade_visible::<D, F>(pixels, cells, fine, (column, row), fragment)
    }

    /// Spans of `columns` from row `top` on; whether the targets have blocks.
    #[inline(never)]
    fn draw_rows<C, D, F>(
        &self,
        color: &mut C,
        depth: &mut D,
        top: i32,
        columns: &[(i32, i32)],
        window: &Window,
        fragment: &F,
    ) -> bool
    where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let whole = color.window();
        let Some((block, stride)) = color.block() else {
            return false;
        };
        let Some(mut cells) = depth.block(&whole, stride, block.len()) else {
            return false;
        };
        let mut start = (top.wrapping_sub(whole.top) as u32 as usize).wrapping_mul(stride);
        for (row, &columns) in (top..).zip(columns) {
            let span = Span::new(row, columns, window);
            if span.left < span.right {
                let first = start.wrapping_add(span.left.wrapping_sub(window.left) as u32 as usize);
                let count = span.right.wrapping_sub(span.left) as u32 as usize;
                if let Some(pixels) = block.get_mut(first..).and_then(|rest| rest.get_mut(..count)) {
                    self.draw_runs::<D, F>(&span, pixels, D::block_cells(&mut cells, first, count), fragment);
                }
            }
            start = start.wrapping_add(stride);
        }
        true
    }

    /// As [`draw_runs`](Self::draw_runs), in a function of its own for targets without blocks.
    #[cold]
    #[inline(never)]
    fn draw_visible<D, F>(&self, span: &Span, pixels: &mut [F::Pixel], cells: D::Cells<'_>, fragment: &F)
    where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        self.draw_runs::<D, F>(span, pixels, cells, fragment);
    }

    /// The visible runs of a span, each after its depths: most spans are one.
    #[inline(always)]
    fn draw_runs<D, F>(&self, span: &Span, pixels: &mut [F::Pixel], cells: D::Cells<'_>, fragment: &F)
    where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        let Ramp { value, step } = self.depth.ramp((span.left, span.row));
        let (fine, step) = (value as u32, step as u32);
        let (passed, others, next) = D::pass(cells, fine, step);
        if passed == pixels.len() {
            self.slopes.draw(span, pixels, fragment);
        } else {
            self.draw_others::<D, F>(span, pixels, passed, (others, next), fragment);
        }
    }

    /// As [`draw_runs`](Self::draw_runs), of a span with hidden pixels: `passed` is how many are visible at its front, what is
    /// left behind them is to be looked at.
    #[inline(never)]
    fn draw_others<D, F>(
        &self,
        span: &Span,
        pixels: &mut [F::Pixel],
        passed: usize,
        left: (D::Cells<'_>, u32),
        fragment: &F,
    ) where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        let step = self.depth.x as u32;
        let (mut passed, (mut others, mut next)) = (passed, left);
        let mut run = *span;
        let mut rest = pixels;
        loop {
            let Some((visible, hidden)) = mem::take(&mut rest).split_at_mut_checked(passed) else {
                return;
            };
            if !visible.is_empty() {
                self.slopes.draw(&run, visible, fragment);
            }
            if hidden.is_empty() {
                return;
            }
            let Some((cells, fine)) = D::skip(others, next, step) else {
                return;
            };
            let skipped = hidden.len().wrapping_sub(cells.size_hint().0);
            run.left = run.left.wrapping_add(passed.wrapping_add(skipped) as i32);
            rest = hidden.get_mut(skipped..).unwrap_or_default();
            (passed, others, next) = D::pass(cells, fine, step);
        }
    }

    /// What is left of a span where something hides a pixel behind a visible one: pixel by pixel. `place` is where it begins.
    #[cold]
    #[inline(never)]
    pub(crate) fn shade_others<C, D, F>(
        &self,
        color: &mut C,
        depth: &mut D,
        span: &Span,
        place: (i32, i32),
        fragment: &F,
    ) where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let Span { row, left, right, .. } = *span;
        let mut ramps = self.slopes.ramps(place);
        let Ramp { value, step } = self.depth.ramp(place);
        let mut fine = value as u32;
        for (pixel, cell) in color.span(row, left, right).iter_mut().zip(depth.cells(span)) {
            black_box(());
            if D::test(cell, fine >> 15) {
                self.shade_one(pixel, &ramps, fragment);
            }
            fine = fine.wrapping_add(step as u32);
            V::advance(&mut ramps);
        }
    }

    /// All of `pixels`.
    #[inline(never)]
    fn shade<F>(&self, pixels: &mut [F::Pixel], place: (i32, i32), fragment: &F)
    where
        F: Fragment<Varying = V>,
    {
        let mut ramps = self.slopes.ramps(place);
        for pixel in pixels {
            self.shade_one(pixel, &ramps, fragment);
            V::advance(&mut ramps);
        }
    }

    /// `pixels` from the first on, at depth `fine`, up to the first that is hidden, which `cells` tell; how many are left
    /// from that one on.
    ///
    /// A function of its own: inlined, the rows' state takes its registers. On Cortex-M4 an RGB565 pixel of interpolated colour
    /// costs 15 instructions here (`cargo xtask measure`), as by hand, on ARMv6-M, which keeps five of its words in memory, 27.
    #[inline(never)]
    fn shade_visible<D, F>(
        &self,
        pixels: &mut [F::Pixel],
        cells: D::Cells<'_>,
        fine: u32,
        place: (i32, i32),
        fragment: &F,
    ) -> usize
    where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        let mut ramps = self.slopes.ramps(place);
        // With the half all values lie in 0…65536 steps, so that the sum fits 32 bits.
        D::pass_first(cells, pixels, fine, self.depth.x as u32, |pixel| {
            self.shade_one(pixel, &ramps, fragment);
            V::advance(&mut ramps);
        })
    }

    #[inline(always)]
    fn shade_one<F: Fragment<Varying = V>>(&self, pixel: &mut F::Pixel, ramps: &V::Ramps, fragment: &F) {
        if let Some(new) = fragment.shade(self.slopes.values(ramps), *pixel) {
            *pixel = new;
        }
    }
}

/// Draws what `spans` cover, with the values of `shape`, however large or thin or whatever lies outside of its corners.
#[inline(never)]
fn paint<C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, basis: &Option<Basis>, spans: &impl Spans, fragment: &F)
where
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    let Some(basis) = basis else {
        return;
    };
    let depth_plane = if D::ENABLED {
        depth_plane(basis, shape)
    } else {
        Plane::default()
    };
    let mut planes = F::Varying::NO_PLANES;
    F::Varying::lay(&mut planes, basis, shape.count(), |i| shape.varying(i));
    spans.each(depth.limit(color.window()), |span| {
        let pixels = color.span(span.row, span.left, span.right);
        if pixels.is_empty() || !D::ENABLED && fragment.fill(pixels) {
            return;
        }
        let place = basis.place(&span);
        let ramp = if D::ENABLED {
            depth_plane.ramp(&place)
        } else {
            Ramp::default()
        };
        shade::<D, F>(pixels, depth.cells(&span), ramp, &planes, &place, fragment);
    });
}

/// Bytes of ramps that registers, or little more, can hold.
const MOST_RAMPS: usize = 64;

/// One span, by runs: pixels behind what is there cost the comparison and one addition, and the varyings are looked at
/// only where a run of visible ones begins.
///
/// A function of its own: inlined, what the rows need takes the registers, and the loop fetches its state from the stack.
#[inline(never)]
fn shade<D: Depth, F: Fragment>(
    pixels: &mut [F::Pixel],
    cells: D::Cells<'_>,
    depth: Ramp<i32>,
    planes: &<F::Varying as Varying>::Planes,
    place: &Place,
    fragment: &F,
) {
    let mut ramps = F::Varying::ramps(planes, place);
    let (mut ramps, mut planes) = (&mut ramps, planes);
    if size_of_val(ramps) > MOST_RAMPS {
        // Left where they are: taken apart, they would be on the stack a second time, number by number.
        (ramps, planes) = (black_box(ramps), black_box(planes));
    }
    // With the half that rounds to the nearest step. All values lie in 0…65535 steps, so that the sum fits 32 bits.
    let mut fine = (depth.value as u32).wrapping_add(1 << 14);
    let step = depth.step as u32;
    let mut fragments = pixels.iter_mut().zip(cells);
    if !<F::Varying as Varying>::Slopes::CARRIES {
        // Nothing to look at where a run begins.
        for (pixel, cell) in fragments {
            if D::test(cell, fine >> 15)
                && let Some(new) = fragment.shade(F::Varying::values(planes, ramps), *pixel)
            {
                *pixel = new;
            }
            fine = fine.wrapping_add(step);
        }
        return;
    }
    // Pixels that are left where the ramps are.
    let mut left = fragments.size_hint().0;
    while let Some((mut pixel, cell)) = fragments.next() {
        if D::test(cell, fine >> 15) {
            let skipped = left.wrapping_sub(fragments.size_hint().0).wrapping_sub(1);
            F::Varying::advance_by(ramps, skipped as i32);
            loop {
                fine = fine.wrapping_add(step);
                if let Some(new) = fragment.shade(F::Varying::values(planes, ramps), *pixel) {
                    *pixel = new;
                }
                F::Varying::advance(ramps);
                let Some((next, cell)) = fragments.next() else {
                    return;
                };
                if !D::test(cell, fine >> 15) {
                    // This one is passed as well, and the ramps are at it.
                    left = fragments.size_hint().0.wrapping_add(1);
                    break;
                }
                pixel = next;
            }
        }
        fine = fine.wrapping_add(step);
    }
}

fn depth_plane(basis: &Basis, shape: &impl Shape) -> Plane {
    let mut plane = Plane::NONE;
    plane.empty();
    for i in 0..shape.count() {
        plane.hold(basis.place_of(i), shape.depth(i));
    }
    plane.settle(basis);
    plane
}
