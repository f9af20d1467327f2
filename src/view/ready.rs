//! Vertices made once: on the screen before any triangle asks for them.

use super::carried::at_vertices;
use super::{Carried, Facing, Left, Projected, View, Weights, w_of};
use crate::clip::{Behind, Polygon, ScreenPlanes, is_in_volume};
use crate::edge::first_row;
use crate::mesh::Normalized;
use crate::num::product::sign_of_sum;
use crate::num::{Block, Word};
use crate::screen::{Shape, pick};
use crate::span::{Corners, doubled_area};
use crate::viewport::DepthScale;

/// A vertex in clip space and on the screen: all that the triangles around it share. Made by [`View::vertex`].
///
/// Memory: 36 bytes and what it carries, with words of 32 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScreenVertex<T, A> {
    /// Clip space, as the projection has made it: of a [stored](super::StoredView) position not normalised.
    clip: Block<T, 4>,
    /// Where nothing is [outside](Self::is_inside): in subpixels, and the depth.
    x: i32,
    y: i32,
    depth: i32,
    /// A bit for each plane of the screen that the vertex lies outside of, and [`ALONE`].
    outcode: u8,
    /// Values for the fragments.
    pub carried: A,
}

impl<T: Word, A> ScreenVertex<T, A> {
    /// One that is never drawn, to make a buffer of.
    pub const fn empty(carried: A) -> Self {
        ScreenVertex {
            clip: Block::ZERO,
            x: 0,
            y: 0,
            depth: 0,
            outcode: ALONE,
            carried,
        }
    }
}

/// No place on the screen of its own, though it may lie outside no plane: w ≤ 0.
const ALONE: u8 = 1 << 7;

impl<T: Word, A> ScreenVertex<T, A> {
    /// Whether the vertex lies within the depth range and the guard band: triangles of such vertices are not clipped.
    #[inline]
    pub fn is_inside(&self) -> bool {
        self.outcode == 0
    }

    /// The position in clip space.
    #[inline]
    pub fn position(&self) -> Block<T, 4> {
        self.clip.normalized()
    }
}

/// All of a vertex but what it carries.
pub(super) struct Placed<T> {
    pub(super) clip: Block<T, 4>,
    pub(super) place: (i32, i32, i32),
    pub(super) outcode: u8,
}

impl<T: Word> Placed<T> {
    #[inline]
    pub(super) fn new<W: Word>(view: &View<T, W, 0>, clip: Block<T, 4>) -> Self {
        let (viewport, range) = (&view.viewport, view.depth_range);
        let in_volume = viewport.is_in_guard() && is_in_volume(clip.mantissas(), range);
        if in_volume && T::BITS == <i32 as Word>::BITS {
            let mantissas = clip.mantissas().map(T::low_i32);
            let place = viewport.place_in_volume(mantissas, DepthScale::new(range));
            return Placed {
                clip,
                place,
                outcode: 0,
            };
        }
        let outcode = if in_volume { 0 } else { view.outcode(clip) };
        let place = if outcode == 0 {
            viewport.place_inside(clip, range)
        } else {
            (0, 0, 0)
        };
        Placed { clip, place, outcode }
    }

    #[inline(always)]
    pub(super) fn with<A>(self, carried: A) -> ScreenVertex<T, A> {
        let (x, y, depth) = self.place;
        ScreenVertex {
            clip: self.clip,
            x,
            y,
            depth,
            outcode: self.outcode,
            carried,
        }
    }
}

/// What [`View::assemble`] makes of a triangle.
#[derive(Debug)]
pub enum Assembled<'a, T, V: Carried> {
    /// All of it.
    Triangle(&'a Triangle<'a, T, V>),
    /// What clipping has left.
    Polygon(&'a Projected<V, 0>),
}

/// A triangle on the screen that lies within the guard band and has an area.
#[derive(Debug, Clone, Copy)]
pub struct Triangle<'v, T, V: Carried> {
    /// Read where they are.
    vertices: [&'v ScreenVertex<T, V::Vertex>; 3],
    /// What its corners carry, unless that is what the vertices do.
    varyings: Option<[V; 3]>,
}

/// What is to be done with a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
    /// Nothing: it is not seen.
    Nowhere,
    /// Drawing it as it is, if it has an area: of those without one some are said to be seen.
    Whole,
    /// [Clipping](View::clip_triangle) it.
    Across,
}

impl<'v, T: Word, V: Carried> Triangle<'v, T, V> {
    /// Of vertices none of which lies outside of anything.
    #[inline(always)]
    pub(crate) fn new(vertices: [&'v ScreenVertex<T, V::Vertex>; 3]) -> Self {
        let [a, b, c] = vertices;
        let varyings = V::given(&a.carried).is_none().then(|| {
            let weights = || at_vertices([w_of(a.clip), w_of(b.clip), w_of(c.clip)]);
            V::whole([a.carried, b.carried, c.carried], weights)
        });
        Triangle { vertices, varyings }
    }

    /// Its [`doubled_area`], never 0.
    #[inline(always)]
    pub fn area(&self) -> i64 {
        doubled_area(self)
    }

    /// Whether it passes between the samples, so small is it.
    fn is_between_samples(&self) -> bool {
        let [a, b, c] = self.vertices;
        fits_between(a.x, b.x, c.x) || fits_between(a.y, b.y, c.y)
    }
}

impl<T, V: Carried> Corners for Triangle<'_, T, V> {
    const TRIANGLE: bool = true;

    #[inline(always)]
    fn count(&self) -> usize {
        3
    }
    #[inline(always)]
    fn position(&self, index: usize) -> (i32, i32) {
        let vertex = pick(&self.vertices, index);
        (vertex.x, vertex.y)
    }
}

impl<T, V: Carried> Shape for Triangle<'_, T, V> {
    type Varying = V;
    #[inline(always)]
    fn depth(&self, index: usize) -> i32 {
        pick(&self.vertices, index).depth
    }
    #[inline(always)]
    fn varying(&self, index: usize) -> V {
        let carried = &pick(&self.vertices, index).carried;
        match (V::given(carried), &self.varyings) {
            (Some(varying), _) => varying,
            (None, Some(varyings)) => *pick(varyings, index),
            (None, None) => V::mix([*carried; 3], &Weights::of_vertex(index)),
        }
    }
}

impl<T: Word, W: Word> View<T, W, 0> {
    /// Projects a vertex: once, however many triangles it belongs to. What it gives is for this view alone.
    ///
    /// `position` is what the view's projection acts on: that of a vertex in eye space, or, with a projection that takes the
    /// model's space to clip space at once, of one as it is stored.
    ///
    /// The example is [`draw::indexed`](crate::draw::indexed)'s.
    #[inline]
    pub fn vertex<A>(&self, position: Block<T, 4>, carried: A) -> ScreenVertex<T, A> {
        self.clip_vertex(self.projection.transform(position), carried)
    }

    /// As [`vertex`](Self::vertex), of a position as it is stored.
    #[inline]
    pub fn stored_vertex<A>(&self, position: impl Normalized, carried: A) -> ScreenVertex<T, A> {
        self.clip_vertex(position.transformed(&self.projection), carried)
    }

    /// Puts a vertex on the screen that is in clip space already.
    #[inline]
    pub fn clip_vertex<A>(&self, clip: Block<T, 4>, carried: A) -> ScreenVertex<T, A> {
        Placed::new(self, clip).with(carried)
    }

    #[cold]
    #[inline(never)]
    fn outcode(&self, clip: Block<T, 4>) -> u8 {
        let [.., w] = clip.mantissas();
        let negated = w < T::ZERO && self.behind == Behind::Divide;
        let position = if negated { clip.negated() } else { clip };
        let code = ScreenPlanes::new(&self.viewport, self.depth_range).outcode(position.mantissas());
        if w <= T::ZERO { code | ALONE } else { code }
    }

    /// Calls `draw` with what is left of a triangle on the screen, as [`project`](Self::project) does, to the same bits.
    ///
    /// Vertices that all lie outside the same plane are rejected at once. Three that lie inside all are the triangle's
    /// corners as they are, and culling comes before anything else, with that of triangles so small that they pass between
    /// the samples; only what crosses a plane is clipped.
    #[inline]
    pub fn assemble<V: Carried>(
        &self,
        vertices: [&ScreenVertex<T, V::Vertex>; 3],
        mut draw: impl FnMut(Assembled<'_, T, V>),
    ) {
        match self.way(vertices, self.cull.facing()) {
            Way::Nowhere => {}
            Way::Whole => {
                let triangle = Triangle::new(vertices);
                if triangle.area() != 0 && !triangle.is_between_samples() {
                    draw(Assembled::Triangle(&triangle));
                }
            }
            Way::Across => self.clip_triangle::<V>(vertices, |polygon| draw(Assembled::Polygon(polygon))),
        }
    }

    /// By the vertices alone, without anything to draw with: what that takes is not laid out before it is certain.
    ///
    /// With the loop around it, a triangle that is culled costs 46 instructions on Cortex-M4.
    #[inline(always)]
    pub(crate) fn way<A>(&self, [a, b, c]: [&ScreenVertex<T, A>; 3], facing: Facing) -> Way {
        if a.outcode | b.outcode | c.outcode != 0 {
            return if self.is_any_left([a.outcode, b.outcode, c.outcode]) {
                Way::Across
            } else {
                Way::Nowhere
            };
        }
        // The doubled area, negated; differences of positions in the guard band fit a word.
        let (right, left) = ((b.x - a.x, c.x - a.x), (c.y - a.y, a.y - b.y));
        if facing.keeps(sign_of_sum(right, left)) {
            Way::Whole
        } else {
            Way::Nowhere
        }
    }

    /// Whether something can be left of a triangle with these outcodes; [`to_view`](crate::clip::to_view) decides alike.
    #[inline(always)]
    fn is_any_left(&self, [a, b, c]: [u8; 3]) -> bool {
        let common = a & b & c;
        let cut = match self.behind {
            Behind::Cut => common,
            Behind::Divide => common & !ALONE,
        };
        cut == 0
    }

    /// Calls `draw` with what is left of a triangle that has to be clipped.
    #[inline]
    pub(crate) fn clip_triangle<V: Carried>(
        &self,
        vertices: [&ScreenVertex<T, V::Vertex>; 3],
        mut draw: impl FnMut(&Projected<V, 0>),
    ) {
        let mut left = Left::new(vertices.map(|v| v.carried));
        loop {
            self.clip_next(vertices, &mut left);
            if let Some(projected) = left.projected() {
                draw(projected);
            }
            if !left.go_on() {
                return;
            }
        }
    }

    /// The next of that.
    #[cold]
    #[inline(never)]
    fn clip_next<V: Carried>(&self, vertices: [&ScreenVertex<T, V::Vertex>; 3], left: &mut Left<V, 0>) {
        let mut polygon = Polygon::<_, 0>::of_vertices(vertices.map(ScreenVertex::position));
        self.lens().cut::<V>(
            &mut polygon.slots(),
            vertices.map(|v| w_of(v.clip)),
            &vertices.map(|v| v.carried),
            &mut left.next(),
        );
    }
}

/// Whether a triangle's extent along one axis holds no sample: the first sample at or after each corner is the same.
#[inline(always)]
fn fits_between(a: i32, b: i32, c: i32) -> bool {
    let [a, b, c] = [first_row(a), first_row(b), first_row(c)];
    a == b && b == c
}
