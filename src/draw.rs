//! The walk: from corners on the screen to pixels in the target.

use core::borrow::Borrow;
use core::hint::black_box;

use crate::barycentric;
use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::gradient::{Basis, Plane, Ramp};
use crate::line::Line;
use crate::num::Word;
use crate::screen::{Corner, Shape};
use crate::slope::{Slope, Slopes, Weights};
use crate::small;
use crate::span::{BLOCK, Scan, Span, Spans, TriangleRows, doubled_area};
use crate::target::Target;
use crate::varying::Varying;
use crate::view::{Carried, Vertex, View};

mod indexed;
mod segment;
mod square;

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
        large::<i32, _, _, _, _>(color, depth, corners, doubled_area(corners), fragment);
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
    view.project::<F::Varying>(vertices, |shape| {
        self::shape::<W, _, _, _, _>(color, depth, shape, fragment);
    });
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
        if let Some(pixel) = color.row(y).get_mut((x - window.left) as usize)
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
        any_size::<W, _, _, _, _>(color, depth, shape, area, fragment);
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
        any_size::<W, _, _, _, _>(color, depth, shape, doubled_area(shape), fragment);
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

/// As [`polygon`], by the walk that draws all there is.
///
/// A function of its own, whose stack and registers small triangles do not pay for.
#[inline(never)]
fn any_size<W, C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, area: i64, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    large::<W, _, _, _, _>(color, depth, shape, area, fragment);
}

#[inline(always)]
fn large<W, C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, area: i64, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    if <F::Varying as Varying>::Slopes::EXIST && shape.count() == 3 {
        if area != 0 {
            rows_of_triangle::<W, _, _, _, _>(color, depth, shape, area > 0, fragment);
        }
    } else {
        paint(color, depth, shape, &Scan::<W, _>::new(shape, area > 0), fragment);
    }
}

/// Draws a triangle whose varying has slopes: one set of them for all of it, or where it is too large or too thin one for each
/// piece of a span.
#[inline(always)]
fn rows_of_triangle<W, C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, ccw: bool, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    let corners = [0, 1, 2].map(|i| shape.position(i));
    let window = depth.limit(color.window());
    let carries = D::ENABLED || <F::Varying as Varying>::Slopes::CARRIES;
    let (mut weights, whole) = if carries {
        Weights::of(&corners)
    } else {
        (Weights::default(), true)
    };
    // Looked at in place: taken out of its option, it would be copied.
    let mut inside = Inside::new::<D, _>(&weights, shape);
    let Some(inside) = &mut inside else {
        return;
    };
    let mut rows = TriangleRows::<W>::new(&corners, ccw, &window);
    let mut block = rows.room();
    let room = if whole { BLOCK } else { 1 };
    while let Some((row, columns)) = block.get_mut(..room).and_then(|block| rows.walk(block)) {
        loop {
            let mut rest = None;
            if !whole && let Some(columns) = columns.first_mut() {
                rest = barycentric::cut_piece(columns);
                if barycentric::is_on(window, *columns) {
                    weights = barycentric::weights(&corners, columns.0, row);
                    let Some(new) = Inside::new::<D, _>(&weights, shape) else {
                        return;
                    };
                    *inside = new;
                }
            }
            for (row, &columns) in (row..).zip(&*columns) {
                let span = Span::new(row, columns, &window);
                if span.left < span.right {
                    inside.span(&weights, color, depth, &span, fragment);
                }
            }
            let (Some(rest), Some(columns)) = (rest, columns.first_mut()) else {
                break;
            };
            *columns = rest;
        }
    }
}

/// All that is interpolated over a triangle, or a piece of its spans.
pub(crate) struct Inside<V: Varying> {
    /// At the picture's origin, with the half that rounds to the nearest step: modulo 2^32, where it was 0…65535 steps.
    pub(crate) depth: Slope,
    pub(crate) slopes: V::Slopes,
}

impl<V: Varying> Inside<V> {
    #[inline(never)]
    pub(crate) fn new<D: Depth, S: Shape<Varying = V>>(weights: &Weights, shape: &S) -> Option<Self> {
        let mut depth = Slope::default();
        if D::ENABLED {
            depth = weights.slope([0, 1, 2].map(|i| shape.depth(i)));
            depth.value = depth.value.wrapping_add(1 << 14);
            // Nothing of the others is loaded before that is done, as if there were registers for all.
            black_box(());
        }
        Some(Inside {
            depth,
            slopes: V::Slopes::new(weights, [0, 1, 2].map(|i| shape.varying(i)))?,
        })
    }

    /// One span: what is hidden at its start costs the comparison and one addition for each pixel, and nothing else is looked
    /// at before the first visible one.
    #[inline(always)]
    fn span<C, D, F>(&self, weights: &Weights, color: &mut C, depth: &mut D, span: &Span, fragment: &F)
    where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let Span { row, left, right, .. } = *span;
        if V::Slopes::DRAWS || !D::ENABLED {
            let pixels = color.span(row, left, right);
            if pixels.is_empty() || !D::ENABLED && fragment.fill(pixels) {
                return;
            }
            if V::Slopes::DRAWS {
                let (cells, ramp) = (depth.cells(span), self.depth.ramp((left, row)));
                self.slopes.draw::<D, F>(weights, span, pixels, cells, ramp, fragment);
            } else {
                self.shade(pixels, weights.place(left, row), fragment);
            }
            return;
        }
        let Ramp { value, step } = self.depth.ramp((left, row));
        let Some((cells, fine)) = D::skip(depth.cells(span), value as u32, step as u32) else {
            return;
        };
        let column = right.wrapping_sub(cells.size_hint().0 as i32);
        let pixels = color.span(row, column, right);
        if pixels.is_empty() {
            return;
        }
        let shaded = self.shade_visible::<D, F>(pixels, cells, fine, weights.place(column, row), fragment);
        let others = column.wrapping_add(shaded);
        if others < right {
            self.shade_others(color, depth, &Span { left: others, ..*span }, weights, fragment);
        }
    }

    /// What is left of a span where something hides a pixel behind a visible one: pixel by pixel.
    #[cold]
    #[inline(never)]
    fn shade_others<C, D, F>(&self, color: &mut C, depth: &mut D, span: &Span, weights: &Weights, fragment: &F)
    where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let Span { row, left, right, .. } = *span;
        let mut ramps = self.slopes.ramps(weights.place(left, row));
        let Ramp { value, step } = self.depth.ramp((left, row));
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

    /// `pixels` from the first on, at depth `fine`, up to the first that is hidden, which `cells` tell; how many.
    ///
    /// A function of its own: inlined, the rows' state takes its registers. On Cortex-M4 an RGB565 pixel of interpolated colour
    /// costs 16 instructions here (`cargo xtask measure`); 15 by hand.
    #[inline(never)]
    fn shade_visible<D, F>(
        &self,
        pixels: &mut [F::Pixel],
        cells: D::Cells<'_>,
        mut fine: u32,
        place: (i32, i32),
        fragment: &F,
    ) -> i32
    where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        let mut ramps = self.slopes.ramps(place);
        let step = self.depth.x as u32;
        let mut shaded = 0;
        for (pixel, cell) in pixels.iter_mut().zip(cells) {
            black_box(());
            // With the half all values lie in 0…65536 steps, so that the sum fits 32 bits.
            if !D::test(cell, fine >> 15) {
                break;
            }
            self.shade_one(pixel, &ramps, fragment);
            V::advance(&mut ramps);
            fine = fine.wrapping_add(step);
            shaded += 1;
        }
        shaded
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
fn paint<C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, spans: &impl Spans, fragment: &F)
where
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    let Some(basis) = Basis::new(shape) else {
        return;
    };
    let depth_plane = if D::ENABLED {
        depth_plane(&basis, shape)
    } else {
        Plane::default()
    };
    let planes = F::Varying::planes(&basis, shape.count(), |i| shape.varying(i));
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
        let ramps = F::Varying::ramps(&planes, &place);
        let values = |ramps: &<F::Varying as Varying>::Ramps| F::Varying::values(&planes, ramps);
        shade::<D, F>(pixels, depth.cells(&span), ramp, ramps, values, fragment);
    });
}

/// One span, by runs: pixels behind what is there cost the comparison and one addition, and the varyings are looked at
/// only where a run of visible ones begins.
///
/// A function of its own: inlined, what the rows need takes the registers, and the loop fetches its state from the stack.
#[inline(never)]
fn shade<D: Depth, F: Fragment>(
    pixels: &mut [F::Pixel],
    cells: D::Cells<'_>,
    depth: Ramp<i32>,
    start: <F::Varying as Varying>::Ramps,
    values: impl Fn(&<F::Varying as Varying>::Ramps) -> <F::Varying as Varying>::Values,
    fragment: &F,
) {
    // With the half that rounds to the nearest step. All values lie in 0…65535 steps, so that the sum fits 32 bits.
    let mut fine = (depth.value as u32).wrapping_add(1 << 14);
    let step = depth.step as u32;
    let mut fragments = pixels.iter_mut().zip(cells);
    if !<F::Varying as Varying>::Slopes::CARRIES {
        // Nothing to look at where a run begins.
        for (pixel, cell) in fragments {
            if D::test(cell, fine >> 15)
                && let Some(new) = fragment.shade(values(&start), *pixel)
            {
                *pixel = new;
            }
            fine = fine.wrapping_add(step);
        }
        return;
    }
    let count = fragments.size_hint().0;
    while let Some((mut pixel, cell)) = fragments.next() {
        if D::test(cell, fine >> 15) {
            let column = count - fragments.size_hint().0 - 1;
            let mut ramps = F::Varying::after(&start, column as i32);
            loop {
                fine = fine.wrapping_add(step);
                if let Some(new) = fragment.shade(values(&ramps), *pixel) {
                    *pixel = new;
                }
                F::Varying::advance(&mut ramps);
                let Some((next, cell)) = fragments.next() else {
                    return;
                };
                if !D::test(cell, fine >> 15) {
                    break;
                }
                pixel = next;
            }
        }
        fine = fine.wrapping_add(step);
    }
}

fn depth_plane(basis: &Basis, shape: &impl Shape) -> Plane {
    let (mut least, mut most) = (i32::MAX, i32::MIN);
    for i in 0..shape.count() {
        let d = shape.depth(i);
        (least, most) = (least.min(d), most.max(d));
    }
    basis.plane(basis.corners().map(|i| shape.depth(i)), (least, most))
}
