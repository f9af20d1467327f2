//! The walk: from corners on the screen to pixels in the target.

use core::borrow::Borrow;
use core::hint::black_box;

use crate::barycentric::Barycentric;
use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::gradient::{Basis, Plane, Ramp};
use crate::line::Line;
use crate::num::Word;
use crate::screen::{Corner, Shape};
use crate::slope::{Slope, Slopes, Weights};
use crate::small;
use crate::span::{Scan, Span, Spans, doubled_area};
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
#[inline]
pub fn triangle<C, D, F>(color: &mut C, depth: &mut D, corners: impl Borrow<[Corner<F::Varying>; 3]>, fragment: &F)
where
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    let corners = corners.borrow();
    polygon::<i32, _, _, _, _>(color, depth, corners, doubled_area(corners), fragment);
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
        polygon::<W, _, _, _, _>(color, depth, shape, doubled_area(shape), fragment);
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
    if <F::Varying as Varying>::Slopes::EXIST
        && shape.count() == 3
        && small::is_small([0, 1, 2].map(|i| shape.position(i)))
        && small::paint(color, depth, shape, fragment)
    {
        return;
    }
    let spans = Scan::<W, _>::new(shape, area > 0);
    if <F::Varying as Varying>::Slopes::EXIST && shape.count() == 3 {
        triangle_spans(color, depth, shape, area, &spans, fragment);
    } else {
        paint(color, depth, shape, &spans, fragment);
    }
}

/// Draws what `spans` cover of a triangle whose varying has slopes: one set of them for all of it, or where it is too large or
/// too thin one for each piece of a span.
#[inline(always)]
fn triangle_spans<C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, area: i64, spans: &impl Spans, fragment: &F)
where
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    if area == 0 {
        return;
    }
    let positions = [0, 1, 2].map(|i| shape.position(i));
    let carries = D::ENABLED || <F::Varying as Varying>::Slopes::CARRIES;
    let weights = if carries {
        Weights::new(positions)
    } else {
        Some(Weights::default())
    };
    let pieces = if weights.is_none() {
        Some(Barycentric::new(positions))
    } else {
        None
    };
    let Some(inside) = Inside::new::<D, _>(&weights.unwrap_or_default(), shape) else {
        return;
    };
    spans.each(depth.limit(color.window()), |span| match &pieces {
        None => inside.span(color, depth, &span, fragment),
        Some(pieces) => draw_pieces(color, depth, shape, pieces, span, fragment),
    });
}

/// A span piece by piece.
#[cold]
#[inline(never)]
fn draw_pieces<C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, pieces: &Barycentric, span: Span, fragment: &F)
where
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    let mut left = span.left;
    while left < span.right {
        let (weights, piece) = pieces.piece(&span, left);
        let Some(inside) = Inside::new::<D, _>(&weights, shape) else {
            return;
        };
        inside.span(color, depth, &piece, fragment);
        left = piece.right;
    }
}

/// All that is interpolated over a triangle, or a piece of its spans.
struct Inside<V: Varying> {
    weights: Weights,
    depth: Slope,
    slopes: V::Slopes,
}

impl<V: Varying> Inside<V> {
    #[inline(never)]
    fn new<D: Depth, S: Shape<Varying = V>>(weights: &Weights, shape: &S) -> Option<Self> {
        Some(Inside {
            weights: *weights,
            depth: if D::ENABLED {
                weights.slope([0, 1, 2].map(|i| shape.depth(i)))
            } else {
                Slope::default()
            },
            slopes: V::Slopes::new(weights, [0, 1, 2].map(|i| shape.varying(i)))?,
        })
    }

    /// One span: what is hidden at its start costs the comparison and one addition for each pixel, and nothing else is looked
    /// at before the first visible one.
    #[inline(always)]
    fn span<C, D, F>(&self, color: &mut C, depth: &mut D, span: &Span, fragment: &F)
    where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let Span { row, left, right, .. } = *span;
        if V::Slopes::DRAWS {
            let pixels = color.span(row, left, right);
            if !pixels.is_empty() && (D::ENABLED || !fragment.fill(pixels)) {
                let mut ramp = self.depth.ramp(self.weights.place(left, row));
                ramp.value = ramp.value.wrapping_add(1 << 14);
                let cells = depth.cells(span);
                self.slopes
                    .draw::<D, F>(&self.weights, span, pixels, cells, ramp, fragment);
            }
            return;
        }
        if !D::ENABLED {
            let pixels = color.span(row, left, right);
            if !pixels.is_empty() && !fragment.fill(pixels) {
                self.shade(pixels, left, row, fragment);
            }
            return;
        }
        let step = self.depth.x as u32;
        let mut column = left;
        while column < right {
            let ramp = self.depth.ramp(self.weights.place(column, row));
            // With the half that rounds to the nearest step. All values lie in 0…65535 steps, so that the sum fits 32 bits.
            let mut fine = (ramp.value as u32).wrapping_add(1 << 14);
            let mut cells = depth.cells(&Span { left: column, ..*span });
            loop {
                // Rolled: four at a time would not fit the registers. Seven instructions on Cortex-M4, six by hand, which would
                // not keep the cell's address.
                black_box(());
                let Some(cell) = cells.next() else { return };
                if D::test(cell, fine >> 15) {
                    break;
                }
                fine = fine.wrapping_add(step);
            }
            let others = cells.size_hint().0 as i32;
            column = right.wrapping_sub(others).wrapping_sub(1);
            let pixels = color.span(row, column, right);
            if pixels.is_empty() {
                return;
            }
            let shaded = self.shade_visible::<D, F>(pixels, cells, fine, (column, row), fragment);
            column = column.wrapping_add(shaded).wrapping_add(1);
        }
    }

    /// All of `pixels`.
    #[inline(never)]
    fn shade<F>(&self, pixels: &mut [F::Pixel], left: i32, row: i32, fragment: &F)
    where
        F: Fragment<Varying = V>,
    {
        let mut ramps = self.slopes.ramps(self.weights.place(left, row));
        for pixel in pixels {
            self.shade_one(pixel, &ramps, fragment);
            V::advance(&mut ramps);
        }
    }

    /// The first of `pixels`, which is visible at depth `fine`, and those after it as long as they are; `cells` are theirs. How
    /// many were shaded.
    ///
    /// A function of its own: inlined, the rows' state takes its registers. On Cortex-M4 an RGB565 pixel of interpolated colour
    /// costs 17 instructions here (`cargo xtask measure`), of which one makes a mask again that has no register; 15 by hand.
    #[inline(never)]
    fn shade_visible<D, F>(
        &self,
        pixels: &mut [F::Pixel],
        cells: D::Cells<'_>,
        mut fine: u32,
        (left, row): (i32, i32),
        fragment: &F,
    ) -> i32
    where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        let Some((pixel, others)) = pixels.split_first_mut() else {
            return 0;
        };
        let mut ramps = self.slopes.ramps(self.weights.place(left, row));
        let step = self.depth.x as u32;
        self.shade_one(pixel, &ramps, fragment);
        let mut shaded = 1;
        for (pixel, cell) in others.iter_mut().zip(cells) {
            black_box(());
            fine = fine.wrapping_add(step);
            if !D::test(cell, fine >> 15) {
                break;
            }
            V::advance(&mut ramps);
            self.shade_one(pixel, &ramps, fragment);
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
