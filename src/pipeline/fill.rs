//! From a polygon or a line on the screen to fragments, and what becomes of them.
//!
//! Per fragment, in this order: the program, discard, depth test, depth write, blending, colour write. A program that
//! carries nothing and does not ask where it is, without depth, is a loop that stores its colours.

use crate::depth::Depth;
use crate::gradient::{Basis, EXTRA_BITS, Plane, Ramp};
use crate::line::Line;
use crate::num::Word;
use crate::screen::Shape;
use crate::span::{Corners, Span, scan};
use crate::varying::Varying;
use crate::window::Window;

use super::program::{Coordinates, Place, Program, Values, Varyings};
use super::project::{FULL_DEPTH, Piece};
use super::targets::{Outputs, Targets};

type Packed<T, P> = <<P as Program<T>>::Varying as Varyings>::Values;

/// Draws a convex polygon on `window`, which all buffers hold.
#[inline]
pub(super) fn polygon<T, W, C, D, P, V, const N: usize>(
    colors: &mut C,
    depth: &mut D,
    window: Window,
    piece: &Piece<V, N>,
    program: &P,
) where
    T: Word,
    W: Word,
    C: Targets,
    D: Depth,
    P: Program<T, Output: Outputs<C>>,
    V: Varying<Values = Packed<T, P>>,
{
    let outline = piece.outline();
    let area = outline.area();
    if area == 0 {
        return;
    }
    if let Some(values) = constant::<T, D, P>() {
        scan::<W>(&outline, area > 0, window, |span| flat(colors, &span, values, program));
        return;
    }
    let Some(basis) = Basis::new(&outline) else {
        return;
    };
    let planes = Set::new::<T, D, P, _, N>(&basis, piece, piece);
    scan::<W>(&outline, area > 0, window, |span| {
        planes.shade::<T, C, D, P>(&basis, colors, depth, &span, program);
    });
}

/// Draws a line on `window`: the pixels of Bresenham's from that of one end to that of the other, both included.
///
/// The values of a pixel are those of its centre's projection on the line, from the first end's to the last's.
#[inline]
pub(super) fn line<T, C, D, P, V, const N: usize>(
    colors: &mut C,
    depth: &mut D,
    window: Window,
    rows_run_against_y: bool,
    piece: &Piece<V, N>,
    program: &P,
) where
    T: Word,
    C: Targets,
    D: Depth,
    P: Program<T, Output: Outputs<C>>,
    V: Varying<Values = Packed<T, P>>,
{
    let pixel = |i| {
        // The nearest sample. A tie is a point on the border between two pixels, which belongs to the upper one in y.
        let (x, y) = piece.position(i);
        let half = if rows_run_against_y { 127 } else { 128 };
        ((x + 128) >> 8, (y + half) >> 8)
    };
    let pixels = Line::closed(pixel(0), pixel(1), window);
    let dot = |(x, y): (i32, i32)| Span {
        row: y,
        left: x,
        right: x + 1,
        whole_left: x,
        whole_right: x + 1,
    };
    if let Some(values) = constant::<T, D, P>() {
        for at in pixels {
            flat(colors, &dot(at), values, program);
        }
        return;
    }
    let axis = Axis::new(piece);
    let Some(basis) = Basis::new(&axis) else {
        return;
    };
    let planes = Set::new::<T, D, P, _, N>(&basis, &axis, piece);
    for at in pixels {
        planes.shade::<T, C, D, P>(&basis, colors, depth, &dot(at), program);
    }
}

/// The varyings, where nothing at all is interpolated.
#[inline(always)]
fn constant<T: Word, D: Depth, P: Program<T>>() -> Option<Packed<T, P>> {
    if D::ENABLED || P::At::DEPTH || P::At::INVERSE_W {
        None
    } else {
        Packed::<T, P>::ONLY
    }
}

/// A span of a program for which nothing is interpolated.
#[inline(always)]
fn flat<T, C, P>(colors: &mut C, span: &Span, values: Packed<T, P>, program: &P)
where
    T: Word,
    C: Targets,
    P: Program<T, Output: Outputs<C>>,
{
    let mut x = span.left;
    for cell in colors.cells(span) {
        let at = Coordinates::new(Place {
            x,
            y: span.row,
            depth: 0,
            inverse: 0,
            exponent: 0,
        });
        if let Some(output) = program.fragment(at, P::Varying::unpack(values)) {
            output.put(cell);
        }
        x = x.wrapping_add(1);
    }
}

/// All that is interpolated over a primitive.
struct Set<V: Varying> {
    depth: Plane,
    /// Takes the plane's depths to units of 2^-15 step.
    depth_shift: u32,
    inverse: Plane,
    exponent: i32,
    varying: V::Planes,
}

impl<V: Varying> Set<V> {
    /// `shape` has three corners or more, for `basis`; its values are those of `piece`.
    #[inline(always)]
    fn new<T, D, P, S, const N: usize>(basis: &Basis, shape: &S, piece: &Piece<V, N>) -> Self
    where
        T: Word,
        D: Depth,
        P: Program<T>,
        S: Shape<Varying = V> + Inverses,
    {
        let count = shape.count();
        let plane = |value: &dyn Fn(usize) -> i32| plane(basis, count, value);
        let mut set = Set {
            depth: if D::ENABLED || P::At::DEPTH {
                plane(&|i| shape.depth(i))
            } else {
                Plane::default()
            },
            depth_shift: piece.depth_shift,
            inverse: if P::At::INVERSE_W {
                plane(&|i| shape.inverse_w(i))
            } else {
                Plane::default()
            },
            exponent: piece.exponent,
            varying: V::NO_PLANES,
        };
        V::lay(&mut set.varying, basis, count, |i| shape.varying(i));
        set
    }

    #[inline(always)]
    fn shade<T, C, D, P>(&self, basis: &Basis, colors: &mut C, depth: &mut D, span: &Span, program: &P)
    where
        T: Word,
        C: Targets,
        D: Depth,
        P: Program<T, Output: Outputs<C>>,
        V: Varying<Values = Packed<T, P>>,
    {
        let place = basis.place(span);
        let mut depth_ramp = Ramp::default();
        if D::ENABLED || P::At::DEPTH {
            depth_ramp = self.depth.ramp(&place);
            if self.depth_shift > 0 {
                // A pixel of a line that leaves the range.
                let fine = (depth_ramp.value as i64) << self.depth_shift;
                if fine > FULL_DEPTH && !depth.takes_beyond() && D::ENABLED {
                    return;
                }
                depth_ramp.value = fine.clamp(0, FULL_DEPTH) as i32;
            }
        }
        let inverse = if P::At::INVERSE_W {
            self.inverse.fine_ramp(&place)
        } else {
            Ramp::default()
        };
        let ramps = V::ramps(&self.varying, &place);
        let start = Start {
            x: span.left,
            y: span.row,
            depth: depth_ramp,
            inverse,
            exponent: self.exponent,
        };
        span_of::<T, C, D, P, V>(
            colors.cells(span),
            depth.cells(span),
            &start,
            &self.varying,
            ramps,
            program,
        );
    }
}

/// A span's first fragment.
struct Start {
    x: i32,
    y: i32,
    depth: Ramp<i32>,
    inverse: Ramp<i64>,
    exponent: i32,
}

/// One span. A function of its own for the reason that [`draw`](crate::draw)'s has one: registers.
#[inline(never)]
fn span_of<'c, T, C, D, P, V>(
    cells: C::Cells<'c>,
    depths: D::Cells<'_>,
    start: &Start,
    planes: &V::Planes,
    mut ramps: V::Ramps,
    program: &P,
) where
    T: Word,
    C: Targets + 'c,
    D: Depth,
    P: Program<T, Output: Outputs<C>>,
    V: Varying<Values = Packed<T, P>>,
{
    let Start {
        mut x,
        y,
        depth,
        mut inverse,
        exponent,
    } = *start;
    // With the half that rounds to the nearest step, as in `draw`: all values lie in 0…65535 steps.
    let mut fine = (depth.value as u32).wrapping_add(1 << 14);
    for (cell, depth_cell) in cells.zip(depths) {
        let run = || {
            let at = Coordinates::new(Place {
                x,
                y,
                depth: fine.wrapping_sub(1 << 14) as i32,
                inverse: (inverse.value >> EXTRA_BITS) as i32,
                exponent,
            });
            program.fragment(at, P::Varying::unpack(V::values(planes, &ramps)))
        };
        if P::KEEPS_ALL {
            if D::test(depth_cell, fine >> 15)
                && let Some(output) = run()
            {
                output.put(cell);
            }
        } else if let Some(output) = run()
            && D::test(depth_cell, fine >> 15)
        {
            output.put(cell);
        }
        x = x.wrapping_add(1);
        fine = fine.wrapping_add(depth.step as u32);
        inverse.advance();
        V::advance(&mut ramps);
    }
}

/// The plane through a value of every corner.
#[inline(never)]
fn plane(basis: &Basis, count: usize, value: &dyn Fn(usize) -> i32) -> Plane {
    let mut plane = Plane::NONE;
    plane.empty();
    for i in 0..count {
        plane.hold(basis.place_of(i), value(i));
    }
    plane.settle(basis);
    plane
}

/// Shapes that know 1/w of their corners.
trait Inverses {
    fn inverse_w(&self, index: usize) -> i32;
}

impl<V: Copy, const N: usize> Inverses for Piece<V, N> {
    #[inline]
    fn inverse_w(&self, index: usize) -> i32 {
        self.inverse(index)
    }
}

/// A line as a triangle: its ends, and a third corner beside the first one at a right angle, with the same values. Over
/// it, everything is linear in the projection on the line; beyond the ends it stays at theirs, being kept in the corners'
/// range. A line without length has the first end's values.
///
/// Ends lie within ±2^23 subpixels, so that the third corner is within 2^25 of the first, as [`Basis`] wants it.
struct Axis<'p, V, const N: usize> {
    ends: &'p Piece<V, N>,
    along: (i32, i32),
    /// The end whose values the second corner has.
    second: usize,
}

impl<'p, V: Copy, const N: usize> Axis<'p, V, N> {
    fn new(ends: &'p Piece<V, N>) -> Self {
        let (from, to) = (ends.position(0), ends.position(1));
        let along = (to.0 - from.0, to.1 - from.1);
        let (along, second) = if along == (0, 0) { ((256, 0), 0) } else { (along, 1) };
        Axis { ends, along, second }
    }

    fn end(&self, index: usize) -> usize {
        if index == 1 { self.second } else { 0 }
    }
}

impl<V: Copy, const N: usize> Corners for Axis<'_, V, N> {
    fn count(&self) -> usize {
        3
    }
    fn position(&self, index: usize) -> (i32, i32) {
        let (x, y) = self.ends.position(0);
        let (along_x, along_y) = self.along;
        match index {
            0 => (x, y),
            1 => (x + along_x, y + along_y),
            _ => (x - along_y, y + along_x),
        }
    }
}

impl<V: Varying, const N: usize> Shape for Axis<'_, V, N> {
    type Varying = V;
    fn depth(&self, index: usize) -> i32 {
        self.ends.depth(self.end(index))
    }
    fn varying(&self, index: usize) -> V {
        self.ends.varying(self.end(index))
    }
}

impl<V: Copy, const N: usize> Inverses for Axis<'_, V, N> {
    fn inverse_w(&self, index: usize) -> i32 {
        self.ends.inverse(self.end(index))
    }
}
