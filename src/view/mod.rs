//! A view: all that lies between vertices in eye space and a polygon on the screen.

mod carried;
mod line;
mod point;
mod ready;
mod stored;

use core::cmp::Ordering;

use crate::clip::{Behind, ClipCorner, DepthRange, Planes, Polygon, at_far, before_camera, is_beyond, to_view};
use crate::matrix::Matrix;
use crate::num::{Block, Scaled, Word};
use crate::screen::Shape;
use crate::span::{Corners, doubled_area};
use crate::viewport::Viewport;
pub use carried::{Carried, InSpace, OnScreen, Shares, Wants, Weights};
pub(crate) use carried::{Weigh, in_clip_space};
use carried::{at_cut, whole};
pub use line::ProjectedLine;
pub(crate) use ready::Way;
pub use ready::{Assembled, ScreenVertex, Triangle};
pub use stored::StoredView;

/// Which triangles are drawn, by the way their corners run on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cull {
    /// All.
    Nothing,
    /// Only those that run counter-clockwise as seen.
    Clockwise,
    /// Only those that run clockwise as seen.
    CounterClockwise,
}

impl Cull {
    /// Whether what has this [`doubled_area`] is drawn.
    #[inline(always)]
    fn keeps(self, area: i64) -> bool {
        match self {
            Cull::Nothing => area != 0,
            Cull::Clockwise => area > 0,
            Cull::CounterClockwise => area < 0,
        }
    }

    /// The same for the words of [`Facing`].
    #[inline(always)]
    pub(crate) fn facing(self) -> Facing {
        let (flip, end) = match self {
            Cull::Nothing => (0, i32::MAX),
            Cull::Clockwise => (0, 0),
            Cull::CounterClockwise => (-1, 0),
        };
        Facing { flip, end }
    }
}

/// A [`Cull`] as numbers: triangle by triangle nothing is decided but by a comparison.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Facing {
    flip: i32,
    end: i32,
}

impl Facing {
    /// Whether a triangle is drawn, by a word with the sign of the doubled area, negated. Some without area are kept.
    #[inline(always)]
    fn keeps(self, negated: i32) -> bool {
        negated ^ self.flip < self.end
    }
}

/// How vertices in eye space become polygons on the screen. `T` is the word of positions, `W` of the edge walk, N the most
/// user planes.
///
/// ```
/// use fixel::{clip::{Behind, DepthRange, Planes}, matrix::Matrix, num::{Block, Scaled}};
/// use fixel::{depth::NoDepth, draw, fragment::Flat, target::Buffer, view::{Cull, Vertex, View}, viewport::Viewport};
///
/// let view = View::<i32, i32, 0> {
///     projection: Matrix::frustum([-1, 1, -1, 1, 1, 10].map(Scaled::from_integer))?,
///     planes: Planes::default(),
///     viewport: Viewport::new(0, 0, 8, 4)?.y_up(),
///     depth_range: DepthRange::MinusOneToOne,
///     behind: Behind::Cut,
///     cull: Cull::Nothing,
/// };
/// let floor = [[-2, -1, -2, 1], [2, -1, -2, 1], [0, -1, 2, 1]]; // one corner is behind the camera
/// let corners = floor.map(|p| Vertex { position: Block::from_integers(p), carried: () });
/// let mut picture = [b'.'; 8 * 4];
/// draw::primitive(&view, &mut Buffer::new(&mut picture, 8, 4)?, &mut NoDepth, &corners, &Flat(b'#'));
/// assert_eq!(&picture[24..], b"########");
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct View<T: Word, W, const N: usize> {
    /// Eye space to clip space.
    pub projection: Matrix<T>,
    /// Clip planes in eye space.
    pub planes: Planes<T, N>,
    /// Clip space to the screen.
    pub viewport: Viewport<W>,
    /// Which depths are drawn.
    pub depth_range: DepthRange,
    /// What w < 0 means.
    pub behind: Behind,
    /// Which triangles are drawn.
    pub cull: Cull,
}

/// A vertex in eye space and what it carries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Vertex<T, A> {
    /// Homogeneous position.
    pub position: Block<T, 4>,
    /// Values for the fragments.
    pub carried: A,
}

/// A polygon on the screen and what its corners carry, mixed anew whenever it is asked for.
#[derive(Debug, Clone)]
pub struct Projected<V: Carried, const N: usize> {
    carried: [V::Vertex; 3],
    first: ProjectedCorner<V::Shares>,
    others: Polygon<ProjectedCorner<V::Shares>, N>,
}

/// A corner that clipping has made, and what a vertex in its place would carry.
#[derive(Debug, Clone, Copy)]
struct Made<T, A> {
    /// As many times the point in space as `size` says.
    position: Block<T, 4>,
    size: Scaled<T>,
    carried: A,
}

impl<T: Word, A> Made<T, A> {
    fn w(&self) -> Scaled<T> {
        w_of(self.position).over(self.size).unwrap_or(Block::ZERO)
    }

    /// The corners of a triangle, or the ends of an edge, whose vertices are these points in space.
    fn corners<const K: usize>(made: [&Self; K]) -> [ClipCorner<T>; K] {
        let mut corners = ClipCorner::of_vertices(made.map(|corner| corner.position));
        for (corner, made) in corners.iter_mut().zip(made) {
            corner.weights = corner.weights.times(made.size);
        }
        corners
    }
}

/// What the far plane leaves of an edge: its start or not, and the corner that it makes there.
struct ToFar<T, A> {
    stays: bool,
    corner: Option<Made<T, A>>,
}

#[derive(Debug, Clone, Copy)]
struct ProjectedCorner<S> {
    position: (i32, i32),
    depth: i32,
    /// What it has of the three vertices.
    shares: S,
}

impl<S: Shares> ProjectedCorner<S> {
    /// A corner of a polygon, or of a line, that lies in the view.
    #[inline]
    fn new<V: Carried<Shares = S>, T: Word, W: Word>(
        viewport: &Viewport<W>,
        range: DepthRange,
        weigh: &Weigh<T>,
        corner: &ClipCorner<T>,
    ) -> Option<Self> {
        let (x, y, depth) = viewport.place(corner.position, range)?;
        Some(ProjectedCorner {
            position: (x, y),
            depth,
            shares: S::of(&weigh.weights::<V>(corner)),
        })
    }
}

impl<V: Carried, const N: usize> Projected<V, N> {
    #[inline]
    fn corner(&self, index: usize) -> &ProjectedCorner<V::Shares> {
        self.others.get(index.wrapping_sub(1)).unwrap_or(&self.first)
    }
}

impl<V: Carried, const N: usize> Corners for Projected<V, N> {
    #[inline]
    fn count(&self) -> usize {
        1 + self.others.len()
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.corner(index).position
    }
}

impl<V: Carried, const N: usize> Shape for Projected<V, N> {
    type Varying = V;
    #[inline]
    fn depth(&self, index: usize) -> i32 {
        self.corner(index).depth
    }
    #[inline(never)]
    fn varying(&self, index: usize) -> V {
        V::mix(self.carried, &self.corner(index).shares.weights())
    }
}

impl<T: Word, W: Word, const N: usize> View<T, W, N> {
    /// Calls `draw` with what is left of a triangle on the screen, clipped, projected, snapped and culled: nothing, or one
    /// polygon, or the triangles of its fan from the first corner. A fan is made where a polygon could not be drawn as one:
    ///
    /// * User planes cut a triangle that carries a [`LinearFan`](crate::varying::LinearFan).
    /// * User planes cut a triangle with w of both signs that is [divided by](Behind::Divide): through infinity, the polygon
    ///   itself is not a convex one.
    /// * A triangle that reaches [behind](Behind::Cut) the camera carries values that are linear over the screen (`.iv`).
    ///   A vertex there has no place on the screen, so that the values run linearly in clip space up to the near plane, and
    ///   over the screen only from there on: along the edges to the far plane, which is cut next, and then in each triangle
    ///   of the fan by itself. What else is cut away does not change what stays.
    pub fn project<V: Carried>(&self, vertices: &[Vertex<T, V::Vertex>; 3], mut draw: impl FnMut(&Projected<V, N>)) {
        let mut projected = None;
        if !self.project_one(vertices, &mut projected) {
            self.project_all::<V>(vertices, &mut draw);
        } else if let Some(projected) = &projected {
            draw(projected);
        }
    }

    /// What is left, where that is one polygon or nothing; whether it is. A function of its own, whose stack is free again when
    /// the polygon is drawn.
    #[inline(never)]
    fn project_one<V: Carried>(
        &self,
        vertices: &[Vertex<T, V::Vertex>; 3],
        projected: &mut Option<Projected<V, N>>,
    ) -> bool {
        if V::WANTS.fan && !self.planes.is_empty() {
            return false;
        }
        let mut polygon = Polygon::of_vertices(vertices.each_ref().map(|v| v.position));
        let vertex_w = self.clip(vertices, &mut polygon);
        if self.is_across::<V>(vertex_w) || self.is_through_infinity(&polygon) {
            return false;
        }
        let carried = vertices.each_ref().map(|v| v.carried);
        self.finish(&mut polygon, vertex_w, carried, projected);
        true
    }

    /// All that is left, one triangle of a fan after the other.
    #[cold]
    #[inline(never)]
    fn project_all<V: Carried>(&self, vertices: &[Vertex<T, V::Vertex>; 3], draw: &mut impl FnMut(&Projected<V, N>)) {
        let mut polygon = Polygon::of_vertices(vertices.each_ref().map(|v| v.position));
        let vertex_w = self.clip(vertices, &mut polygon);
        let carried = vertices.each_ref().map(|v| v.carried);
        if V::WANTS.fan && !self.planes.is_empty() {
            self.fan::<V>(&polygon, carried, draw);
        } else {
            self.cut::<V>(&mut polygon, vertex_w, carried, draw);
        }
    }

    /// Leaves of a triangle what user planes keep, and takes it to clip space; w of the vertices.
    #[inline(always)]
    fn clip<A>(&self, vertices: &[Vertex<T, A>; 3], polygon: &mut Polygon<ClipCorner<T>, N>) -> [Scaled<T>; 3] {
        self.planes.cut(polygon);
        for corner in polygon.iter_mut() {
            corner.position = self.projection.transform(corner.position);
        }
        vertices.each_ref().map(|v| w_of(self.projection.transform(v.position)))
    }

    /// Whether a triangle has to be cut [where it passes the camera](Self::across).
    #[inline]
    fn is_across<V: Carried>(&self, vertex_w: [Scaled<T>; 3]) -> bool {
        V::WANTS.screen && self.behind == Behind::Cut && !vertex_w.into_iter().all(in_front)
    }

    /// Whether a polygon is no convex one on the screen.
    #[inline]
    fn is_through_infinity(&self, polygon: &Polygon<ClipCorner<T>, N>) -> bool {
        self.behind == Behind::Divide && polygon.len() > 3 && changes_sign(polygon)
    }

    /// What user planes have left.
    fn cut<V: Carried>(
        &self,
        polygon: &mut Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        carried: [V::Vertex; 3],
        draw: &mut impl FnMut(&Projected<V, N>),
    ) {
        if self.is_across::<V>(vertex_w) {
            self.across::<V>(polygon, vertex_w, carried, draw);
        } else if self.is_through_infinity(polygon) {
            for i in 2..polygon.len() {
                let corners = [0, i - 1, i].into_iter().filter_map(|i| polygon.get(i));
                self.finished(&mut corners.copied().collect(), vertex_w, carried, draw);
            }
        } else {
            self.finished(polygon, vertex_w, carried, draw);
        }
    }

    /// A triangle that reaches behind the camera: cut to what is before it, whose fan is of triangles like any other.
    #[cold]
    #[inline(never)]
    fn across<V: Carried>(
        &self,
        polygon: &mut Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        carried: [V::Vertex; 3],
        draw: &mut impl FnMut(&Projected<V, N>),
    ) {
        if before_camera(polygon, &self.viewport, self.depth_range).is_none() {
            return;
        }
        let made = |corner: &ClipCorner<T>| Made {
            position: corner.position,
            size: whole(corner.weights),
            carried: V::between(carried, &at_cut(corner, vertex_w)),
        };
        let mut fan = None;
        let mut next = |corner| match &mut fan {
            None => fan = Some((corner, None)),
            Some((_, second @ None)) => *second = Some(corner),
            Some((first, Some(second))) => {
                self.part::<V>([first, second, &corner], draw);
                *second = corner;
            }
        };
        let ends = polygon.iter().skip(1).chain(polygon.get(0));
        for (a, b) in polygon.iter().zip(ends) {
            let (start, end) = (made(a), made(b));
            let crossing = self.to_far::<V>(&start, &end);
            if crossing.stays {
                next(start);
            }
            if let Some(corner) = crossing.corner {
                next(corner);
            }
        }
    }

    /// A triangle of corners that clipping has made.
    #[inline(never)]
    fn part<V: Carried>(&self, corners: [&Made<T, V::Vertex>; 3], draw: &mut impl FnMut(&Projected<V, N>)) {
        let mut polygon = Made::corners(corners).into_iter().collect();
        let w = corners.map(Made::w);
        self.finished(&mut polygon, w, corners.map(|corner| corner.carried), draw);
    }

    /// Cuts off what is beyond the far plane of an edge, values being linear over the screen along it.
    #[inline(never)]
    fn to_far<V: Carried>(&self, a: &Made<T, V::Vertex>, b: &Made<T, V::Vertex>) -> ToFar<T, V::Vertex> {
        let [start, end] = Made::corners([a, b]);
        let beyond = [&start, &end].map(|corner| is_beyond(corner, self.depth_range));
        let corner = match beyond {
            [false, true] => Some(at_far(&start, &end)),
            [true, false] => Some(at_far(&end, &start)),
            _ => None,
        };
        ToFar {
            stays: !beyond[0],
            corner: corner.map(|corner| Made {
                position: corner.position,
                size: whole(corner.weights),
                carried: V::between(
                    [a.carried, b.carried, b.carried],
                    &at_cut(&corner, [a.w(), b.w(), b.w()]),
                ),
            }),
        }
    }

    /// Every triangle of the fan as if it had been given: its corners' values are linear in clip space, and what is cut from
    /// here on is linear over the screen.
    fn fan<V: Carried>(
        &self,
        polygon: &Polygon<ClipCorner<T>, N>,
        carried: [V::Vertex; 3],
        draw: &mut impl FnMut(&Projected<V, N>),
    ) {
        for i in 2..polygon.len() {
            let (Some(first), Some(second), Some(third)) = (polygon.get(0), polygon.get(i - 1), polygon.get(i)) else {
                continue;
            };
            let corners = [first, second, third];
            let values = corners.map(|corner| V::between(carried, &in_clip_space(corner)));
            let mut given = Polygon::of_vertices(corners.map(|corner| corner.position));
            let w = corners.map(|corner| w_of(corner.position));
            self.cut::<V>(&mut given, w, values, draw);
        }
    }

    /// From clip space to the screen, and drawn.
    fn finished<V: Carried>(
        &self,
        polygon: &mut Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        carried: [V::Vertex; 3],
        draw: &mut impl FnMut(&Projected<V, N>),
    ) {
        let mut projected = None;
        self.finish(polygon, vertex_w, carried, &mut projected);
        if let Some(projected) = &projected {
            draw(projected);
        }
    }

    /// From clip space to the screen; nothing where it is not drawn.
    #[inline(never)]
    fn finish<V: Carried>(
        &self,
        polygon: &mut Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        carried: [V::Vertex; 3],
        projected: &mut Option<Projected<V, N>>,
    ) {
        let range = self.depth_range;
        if to_view(polygon, &self.viewport, range, self.behind).is_none() {
            return;
        }
        let weigh = Weigh::new(polygon, vertex_w, V::WANTS);
        let mut corners = polygon
            .iter()
            .filter_map(|corner| ProjectedCorner::new::<V, _, _>(&self.viewport, range, &weigh, corner));
        let Some(first) = corners.next() else {
            return;
        };
        let polygon = projected.insert(Projected {
            carried,
            first,
            others: Polygon::default(),
        });
        corners.for_each(|corner| polygon.others.push(corner));
        if !self.cull.keeps(doubled_area(polygon)) {
            *projected = None;
        }
    }
}

/// Whether some corners have w < 0 and some w > 0.
fn changes_sign<T: Word, const N: usize>(polygon: &Polygon<ClipCorner<T>, N>) -> bool {
    let any = |wanted: Ordering| {
        polygon.iter().any(|corner| {
            let [.., w] = corner.position.mantissas();
            w.cmp(&T::ZERO) == wanted
        })
    };
    any(Ordering::Less) && any(Ordering::Greater)
}

fn in_front<T: Word>(w: Scaled<T>) -> bool {
    w.mantissas() > [T::ZERO]
}

pub(crate) fn w_of<T: Word>(position: Block<T, 4>) -> Scaled<T> {
    let [.., w] = position.split();
    w
}
