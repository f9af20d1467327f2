//! The walk: from corners on the screen to pixels in the target.

use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::gradient::{Basis, Plane, Ramp};
use crate::line::Line;
use crate::num::Word;
use crate::screen::{Corner, Shape};
use crate::span::{Scan, Spans, doubled_area};
use crate::target::{Target, pixels};
use crate::varying::Varying;
use crate::view::{Carried, Vertex, View};

mod segment;
mod square;

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
pub fn triangle<C, D, F>(color: &mut C, depth: &mut D, corners: [Corner<F::Varying>; 3], fragment: &F)
where
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    polygon::<i32, _, _, _, _>(color, depth, &corners, doubled_area(&corners), fragment);
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
    paint(color, depth, shape, &Scan::<W, _>::new(shape, area > 0), fragment);
}

/// Draws what `spans` cover, with the values of `shape`.
#[inline(always)]
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
    let count = shape.count();
    let depth_plane = if D::ENABLED {
        Some(depth_plane(&basis, shape))
    } else {
        None
    };
    let planes = F::Varying::planes(&basis, count, |i| shape.varying(i));
    let window = color.window();
    spans.each(depth.limit(window), |span| {
        let pixels = pixels(color, window, &span);
        if !D::ENABLED
            && let Some(pixel) = fragment.solid()
        {
            pixels.fill(pixel);
            return;
        }
        let place = basis.place(&span);
        let ramp = depth_plane.as_ref().map(|plane| plane.ramp(&place)).unwrap_or_default();
        let ramps = F::Varying::ramps(&planes, &place);
        shade::<D, F>(pixels, depth.cells(&span), ramp, &planes, ramps, fragment);
    });
}

/// One span. Depth is tested before anything else is looked at.
///
/// A function of its own: inlined, what the rows need takes the registers, and the loop fetches its state from the stack
/// (on Cortex-M4 14.3 instructions a pixel instead of 9.5 for flat with depth; `cargo xtask measure`).
#[inline(never)]
fn shade<D: Depth, F: Fragment>(
    pixels: &mut [F::Pixel],
    cells: D::Cells<'_>,
    depth: Ramp<i32>,
    planes: &<F::Varying as Varying>::Planes,
    mut ramps: <F::Varying as Varying>::Ramps,
    fragment: &F,
) {
    // With the half that rounds to the nearest step. All values lie in 0…65535 steps, so that the sum fits 32 bits.
    let mut fine = (depth.value as u32).wrapping_add(1 << 14);
    for (pixel, cell) in pixels.iter_mut().zip(cells) {
        if D::test(cell, fine >> 15)
            && let Some(new) = fragment.shade(F::Varying::values(planes, &ramps), *pixel)
        {
            *pixel = new;
        }
        fine = fine.wrapping_add(depth.step as u32);
        F::Varying::advance(&mut ramps);
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
