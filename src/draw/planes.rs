//! What any polygon's spans cover, with values from planes that hold however large or thin it is.

use core::hint::black_box;

use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::gradient::{Basis, Place, Plane, Ramp};
use crate::screen::Shape;
use crate::slope::Slopes;
use crate::span::Spans;
use crate::target::Target;
use crate::varying::Varying;

/// Draws what `spans` cover, with the values of `shape`, however large or thin or whatever lies outside of its corners.
#[inline(never)]
pub(super) fn paint<C, D, S, F>(
    color: &mut C,
    depth: &mut D,
    shape: &S,
    basis: &Option<Basis>,
    spans: &impl Spans,
    fragment: &F,
) where
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

pub(super) fn depth_plane(basis: &Basis, shape: &impl Shape) -> Plane {
    let mut plane = Plane::NONE;
    plane.empty();
    for i in 0..shape.count() {
        plane.hold(basis.place_of(i), shape.depth(i));
    }
    plane.settle(basis);
    plane
}
