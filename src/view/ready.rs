//! Vertices made once: on the screen before any triangle asks for them.

use super::carried::at_vertices;
use super::{Carried, Projected, View, w_of};
use crate::clip::{Behind, Polygon, ScreenPlanes, is_in_volume};
use crate::edge::first_row;
use crate::mesh::Normalized;
use crate::num::{Block, Word};
use crate::screen::Shape;
use crate::span::{Corners, doubled_area};
use crate::varying::Varying;

/// A vertex in clip space and on the screen: all that the triangles around it share. Made by [`View::vertex`].
///
/// Memory: 36 bytes and what it carries, with words of 32 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScreenVertex<T, A> {
    /// Clip space, as the projection has made it.
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
        self.clip
    }
}

impl<T, A> ScreenVertex<T, A> {
    #[inline(always)]
    fn on_screen<V>(&self, varying: V) -> OnScreen<V> {
        OnScreen {
            position: (self.x, self.y),
            depth: self.depth,
            varying,
        }
    }
}

/// What [`View::assemble`] makes of a triangle.
#[derive(Debug)]
pub enum Assembled<'a, V> {
    /// All of it.
    Triangle(&'a Triangle<V>),
    /// What clipping has left.
    Polygon(&'a Projected<V, 0>),
}

/// A triangle on the screen that lies within the guard band and has an area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Triangle<V> {
    corners: [OnScreen<V>; 3],
    area: i64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct OnScreen<V> {
    position: (i32, i32),
    depth: i32,
    varying: V,
}

impl<V> Triangle<V> {
    /// Its [`doubled_area`], never 0.
    #[inline(always)]
    pub fn area(&self) -> i64 {
        self.area
    }

    /// Corner `index`, the last for any larger one: no bounds to check.
    #[inline(always)]
    fn corner(&self, index: usize) -> &OnScreen<V> {
        let [a, b, c] = &self.corners;
        match index {
            0 => a,
            1 => b,
            _ => c,
        }
    }
}

impl<V> Corners for Triangle<V> {
    const TRIANGLE: bool = true;

    #[inline(always)]
    fn count(&self) -> usize {
        3
    }
    #[inline(always)]
    fn position(&self, index: usize) -> (i32, i32) {
        self.corner(index).position
    }
}

impl<V: Varying> Shape for Triangle<V> {
    type Varying = V;
    #[inline(always)]
    fn depth(&self, index: usize) -> i32 {
        self.corner(index).depth
    }
    #[inline(always)]
    fn varying(&self, index: usize) -> V {
        self.corner(index).varying
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
        let mut vertex = ScreenVertex {
            clip,
            x: 0,
            y: 0,
            depth: 0,
            outcode: 0,
            carried,
        };
        if !(self.viewport.is_in_guard() && is_in_volume(clip.mantissas(), self.depth_range)) {
            vertex.outcode = self.outcode(clip);
        }
        if vertex.outcode == 0 {
            (vertex.x, vertex.y, vertex.depth) = self.viewport.place_inside(clip, self.depth_range);
        }
        vertex
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
        mut draw: impl FnMut(Assembled<'_, V>),
    ) {
        let [a, b, c] = vertices;
        if a.outcode | b.outcode | c.outcode != 0 {
            if self.is_any_left([a.outcode, b.outcode, c.outcode]) {
                self.clip_triangle::<V>(vertices, &mut |polygon| draw(Assembled::Polygon(polygon)));
            }
            return;
        }
        let area = doubled_area(&[(a.x, a.y), (b.x, b.y), (c.x, c.y)]);
        if !self.cull.keeps(area) || fits_between(a.x, b.x, c.x) || fits_between(a.y, b.y, c.y) {
            return;
        }
        let weights = || at_vertices([w_of(a.clip), w_of(b.clip), w_of(c.clip)]);
        let [first, second, third] = V::whole([a.carried, b.carried, c.carried], weights);
        draw(Assembled::Triangle(&Triangle {
            corners: [a.on_screen(first), b.on_screen(second), c.on_screen(third)],
            area,
        }));
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

    #[cold]
    #[inline(never)]
    fn clip_triangle<V: Carried>(
        &self,
        vertices: [&ScreenVertex<T, V::Vertex>; 3],
        draw: &mut impl FnMut(&Projected<V, 0>),
    ) {
        let polygon = Polygon::of_vertices(vertices.map(|v| v.clip));
        self.cut::<V>(
            polygon,
            vertices.map(|v| w_of(v.clip)),
            vertices.map(|v| v.carried),
            draw,
        );
    }
}

/// Whether a triangle's extent along one axis holds no sample: the first sample at or after each corner is the same.
#[inline(always)]
fn fits_between(a: i32, b: i32, c: i32) -> bool {
    let [a, b, c] = [first_row(a), first_row(b), first_row(c)];
    a == b && b == c
}
