//! The walk: from corners on the screen to pixels in the target.

use core::borrow::Borrow;

use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::gradient::{Basis, Plane, Ramp};
use crate::line::Line;
use crate::num::Word;
use crate::screen::{Corner, Shape};
use crate::slope::{Slope, Slopes, Weights};
use crate::span::{Corners, Scan, Spans, doubled_area};
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
    let spans = Scan::<W, _>::new(shape, area > 0);
    if shape.count() == 3
        && let Some(weights) = weights::<D, F::Varying>(shape)
        && let Some(slopes) = <F::Varying as Varying>::Slopes::new(&weights, [0, 1, 2].map(|i| shape.varying(i)))
    {
        let depth_slope = if D::ENABLED {
            weights.slope([0, 1, 2].map(|i| shape.depth(i)))
        } else {
            Slope::default()
        };
        let inside = Inside {
            weights,
            depth: depth_slope,
            slopes,
        };
        inside.paint(color, depth, &spans, fragment);
    } else {
        paint(color, depth, shape, &spans, fragment);
    }
}

/// Of a triangle; any, where nothing is interpolated.
#[inline(always)]
fn weights<D: Depth, V: Varying>(corners: &impl Corners) -> Option<Weights> {
    if D::ENABLED || V::Slopes::CARRIES {
        Weights::new([0, 1, 2].map(|i| corners.position(i)))
    } else {
        Some(Weights::default())
    }
}

/// All that is interpolated over a triangle that has [`Weights`].
struct Inside<V: Varying> {
    weights: Weights,
    depth: Slope,
    slopes: V::Slopes,
}

impl<V: Varying> Inside<V> {
    #[inline(always)]
    fn paint<C, D, F>(&self, color: &mut C, depth: &mut D, spans: &impl Spans, fragment: &F)
    where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        spans.each(depth.limit(color.window()), |span| {
            let pixels = color.span(span.row, span.left, span.right);
            if pixels.is_empty() || !D::ENABLED && fragment.fill(pixels) {
                return;
            }
            let place = self.weights.place(span.left, span.row);
            let ramps = self.slopes.ramps(place);
            let values = |ramps: &V::Ramps| self.slopes.values(ramps);
            shade::<D, F>(
                pixels,
                depth.cells(&span),
                self.depth.ramp(place),
                ramps,
                values,
                fragment,
            );
        });
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
