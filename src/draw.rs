//! The walk: from corners on the screen to pixels in the target.

use core::borrow::Borrow;

use crate::barycentric;
use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::gradient::Basis;
use crate::line::Line;
use crate::num::Word;
use crate::screen::{Corner, Shape, of_corners};
use crate::slope::{Inverse, Slopes, Weights};
use crate::small;
use crate::span::{BLOCK, Corners, Scan, Span, Spans, TriangleRows, doubled_area};
use crate::target::Target;
use crate::varying::Varying;
use crate::view::{Carried, Shown, Vertex, View};

mod indexed;
mod inside;
mod planes;
mod segment;
mod square;

use indexed::Painter;
pub use indexed::{assembled, indexed};
pub(crate) use inside::Inside;
use planes::paint;
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
