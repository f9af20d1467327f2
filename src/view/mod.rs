//! A view: all that lies between vertices in eye space and a polygon on the screen.

mod carried;
mod line;
mod point;
mod ready;
mod stored;

use core::cmp::Ordering;

use crate::clip::{
    Behind, ClipCorner, DepthRange, Held, Planes, Polygon, Slots, at_far, before_camera, cut_by, is_beyond, to_view,
};
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
    corners: Polygon<PlacedCorner, N>,
    /// What each corner has of the three vertices.
    shares: Polygon<V::Shares, N>,
}

impl<V: Carried, const N: usize> Projected<V, N> {
    /// No corners yet.
    #[inline(always)]
    fn nothing(carried: [V::Vertex; 3]) -> Self {
        Projected {
            carried,
            corners: Polygon::default(),
            shares: Polygon::default(),
        }
    }

    /// The same to draw, whatever N is.
    #[inline(always)]
    pub(crate) fn shown(&self) -> Shown<'_, V> {
        Shown {
            carried: &self.carried,
            corners: self.corners.held(),
            shares: self.shares.held(),
        }
    }
}

/// A [`Projected`] with any N: what draws this is in a program once.
#[derive(Debug)]
pub(crate) struct Shown<'p, V: Carried> {
    carried: &'p [V::Vertex; 3],
    /// By themselves, what walks them is there once for all that is carried.
    pub(crate) corners: Held<'p, PlacedCorner>,
    shares: Held<'p, V::Shares>,
}

/// A corner of a [`Projected`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlacedCorner {
    pub(crate) position: (i32, i32),
    pub(crate) depth: i32,
}

impl Held<'_, PlacedCorner> {
    /// Its [`doubled_area`].
    #[inline(never)]
    pub(crate) fn area(self) -> i64 {
        doubled_area(&self)
    }
}

impl Corners for Held<'_, PlacedCorner> {
    #[inline]
    fn count(&self) -> usize {
        self.len()
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.get(index).map_or((0, 0), |corner| corner.position)
    }
}

impl<V: Carried> Corners for Shown<'_, V> {
    #[inline]
    fn count(&self) -> usize {
        self.corners.len()
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.corners.position(index)
    }
}

impl<V: Carried> Shape for Shown<'_, V> {
    type Varying = V;
    #[inline]
    fn depth(&self, index: usize) -> i32 {
        self.corners.get(index).map_or(0, |corner| corner.depth)
    }
    #[inline(never)]
    fn varying(&self, index: usize) -> V {
        let shares = self.shares.get(index).map(Shares::weights);
        V::mix(*self.carried, &shares.unwrap_or_else(|| Weights::of_vertex(0)))
    }
}

impl<V: Carried, const N: usize> Corners for Projected<V, N> {
    #[inline]
    fn count(&self) -> usize {
        self.shown().count()
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.shown().position(index)
    }
}

impl<V: Carried, const N: usize> Shape for Projected<V, N> {
    type Varying = V;
    #[inline]
    fn depth(&self, index: usize) -> i32 {
        self.shown().depth(index)
    }
    #[inline]
    fn varying(&self, index: usize) -> V {
        self.shown().varying(index)
    }
}

/// What is left of a triangle, one polygon after the other: where there are several, which is seldom, all before the next are
/// found again and passed over, so that nothing is kept while one is drawn.
pub(crate) struct Left<V: Carried, const N: usize> {
    /// How many have been drawn.
    drawn: usize,
    /// How many have been found, counted from the first again each time.
    found: usize,
    /// The next of them; without corners, where it is not drawn.
    projected: Projected<V, N>,
}

impl<V: Carried, const N: usize> Left<V, N> {
    /// Nothing drawn, of a triangle whose vertices carry that.
    #[inline(always)]
    pub(crate) fn new(carried: [V::Vertex; 3]) -> Self {
        Left {
            drawn: 0,
            found: 0,
            projected: Projected::nothing(carried),
        }
    }

    /// To look for the next, from the first on.
    #[inline(always)]
    pub(crate) fn next(&mut self) -> Next<'_, V> {
        let Projected {
            carried,
            corners,
            shares,
        } = &mut self.projected;
        Next {
            carried,
            places: Places {
                drawn: self.drawn,
                found: &mut self.found,
                corners: corners.slots(),
                shares: shares.slots(),
            },
        }
    }

    /// The next, unless it is not drawn.
    #[inline(always)]
    pub(crate) fn projected(&self) -> Option<&Projected<V, N>> {
        (!self.projected.corners.is_empty()).then_some(&self.projected)
    }

    /// Whether there is another.
    #[inline(always)]
    pub(crate) fn go_on(&mut self) -> bool {
        self.drawn = self.drawn.wrapping_add(1);
        let more = self.drawn < self.found;
        self.found = 0;
        more
    }
}

/// A [`Left`] with any N, while the next is looked for.
pub(crate) struct Next<'l, V: Carried> {
    carried: &'l mut [V::Vertex; 3],
    places: Places<'l, V::Shares>,
}

impl<V: Carried> Next<'_, V> {
    /// What is found from here on carries that, until the one is found.
    #[inline]
    fn carry(&mut self, carried: &[V::Vertex; 3]) {
        if *self.places.found <= self.places.drawn {
            *self.carried = *carried;
        }
    }
}

/// The same without what the vertices carry.
pub(crate) struct Places<'l, S> {
    drawn: usize,
    found: &'l mut usize,
    corners: Slots<'l, PlacedCorner>,
    shares: Slots<'l, S>,
}

impl<S: Shares> Places<'_, S> {
    /// Whether what is found now is the one.
    #[inline]
    fn is_next(&mut self) -> bool {
        let next = *self.found == self.drawn;
        *self.found = self.found.wrapping_add(1);
        next
    }
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

/// A [`View`] with any N: what works with this is in a program once.
pub(crate) struct Lens<'v, T: Word, W> {
    projection: &'v Matrix<T>,
    planes: &'v [Block<T, 4>],
    viewport: &'v Viewport<W>,
    depth_range: DepthRange,
    behind: Behind,
    cull: Cull,
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
        let mut left = Left::new(vertices.each_ref().map(|v| v.carried));
        loop {
            self.project_next(vertices, &mut left);
            if let Some(projected) = left.projected() {
                draw(projected);
            }
            if !left.go_on() {
                return;
            }
        }
    }

    /// The next of what is left. A function of its own, whose stack is free again when that is drawn.
    #[inline(never)]
    fn project_next<V: Carried>(&self, vertices: &[Vertex<T, V::Vertex>; 3], left: &mut Left<V, N>) {
        let positions = vertices.each_ref().map(|v| v.position);
        let mut polygon = Polygon::<_, N>::default();
        let (lens, mut polygon, mut next) = (self.lens(), polygon.slots(), left.next());
        if !V::WANTS.screen {
            // Values stay those of the vertices, whatever is cut: what follows is the same for any.
            lens.next(&positions, V::WANTS, &mut polygon, &mut next.places);
            return;
        }
        let vertex_w = lens.clip(&positions, &mut polygon);
        let carried = vertices.each_ref().map(|v| v.carried);
        if V::WANTS.fan && !self.planes.is_empty() {
            lens.fan::<V>(&polygon, &carried, &mut next);
        } else {
            lens.cut::<V>(&mut polygon, vertex_w, &carried, &mut next);
        }
    }

    #[inline(always)]
    pub(crate) fn lens(&self) -> Lens<'_, T, W> {
        Lens {
            projection: &self.projection,
            planes: self.planes.as_slice(),
            viewport: &self.viewport,
            depth_range: self.depth_range,
            behind: self.behind,
            cull: self.cull,
        }
    }
}

impl<T: Word, W: Word> Lens<'_, T, W> {
    /// The next of what is left of a triangle with values that are linear in space, or none.
    #[inline(never)]
    fn next<S: Shares>(
        &self,
        positions: &[Block<T, 4>; 3],
        wants: Wants,
        polygon: &mut Slots<'_, ClipCorner<T>>,
        places: &mut Places<'_, S>,
    ) {
        let vertex_w = self.clip(positions, polygon);
        self.cut_at_infinity(polygon, vertex_w, wants, places);
    }

    /// Leaves of a triangle what user planes keep, and takes it to clip space; w of the vertices.
    #[inline(never)]
    fn clip(&self, positions: &[Block<T, 4>; 3], polygon: &mut Slots<'_, ClipCorner<T>>) -> [Scaled<T>; 3] {
        for corner in ClipCorner::of_vertices(*positions) {
            polygon.push(corner);
        }
        cut_by(self.planes, polygon);
        polygon.each(|corner| corner.position = self.projection.transform(corner.position));
        let mut vertex_w = [Scaled::ZERO; 3];
        for (i, (w, &position)) in vertex_w.iter_mut().zip(positions).enumerate() {
            // Without planes its corners are the vertices.
            *w = match polygon.held().get(i) {
                Some(corner) if self.planes.is_empty() => w_of(corner.position),
                _ => w_of(self.projection.transform(position)),
            };
        }
        vertex_w
    }

    /// Whether a triangle has to be cut [where it passes the camera](Self::across).
    #[inline]
    fn is_across<V: Carried>(&self, vertex_w: [Scaled<T>; 3]) -> bool {
        V::WANTS.screen && self.behind == Behind::Cut && !vertex_w.into_iter().all(in_front)
    }

    /// Whether a polygon is no convex one on the screen.
    #[inline]
    fn is_through_infinity(&self, polygon: &Slots<'_, ClipCorner<T>>) -> bool {
        self.behind == Behind::Divide && polygon.held().len() > 3 && changes_sign(polygon.held())
    }

    /// What user planes have left.
    pub(crate) fn cut<V: Carried>(
        &self,
        polygon: &mut Slots<'_, ClipCorner<T>>,
        vertex_w: [Scaled<T>; 3],
        carried: &[V::Vertex; 3],
        next: &mut Next<'_, V>,
    ) {
        if self.is_across::<V>(vertex_w) {
            self.across::<V>(polygon, vertex_w, carried, next);
        } else {
            next.carry(carried);
            self.cut_at_infinity(polygon, vertex_w, V::WANTS, &mut next.places);
        }
    }

    /// The same, by a fan if need be.
    #[inline(never)]
    fn cut_at_infinity<S: Shares>(
        &self,
        polygon: &mut Slots<'_, ClipCorner<T>>,
        vertex_w: [Scaled<T>; 3],
        wants: Wants,
        places: &mut Places<'_, S>,
    ) {
        if !self.is_through_infinity(polygon) {
            self.finish(polygon, vertex_w, wants, places);
            return;
        }
        for i in 2..polygon.held().len() {
            let corners = [0, i - 1, i].into_iter().filter_map(|i| polygon.held().get(i));
            let mut part: Polygon<_, 0> = corners.copied().collect();
            self.finish(&mut part.slots(), vertex_w, wants, places);
        }
    }

    /// A triangle that reaches behind the camera: cut to what is before it, whose fan is of triangles like any other.
    #[cold]
    #[inline(never)]
    fn across<V: Carried>(
        &self,
        polygon: &mut Slots<'_, ClipCorner<T>>,
        vertex_w: [Scaled<T>; 3],
        carried: &[V::Vertex; 3],
        next: &mut Next<'_, V>,
    ) {
        if before_camera(polygon, self.viewport, self.depth_range).is_none() {
            return;
        }
        let made = |corner: &ClipCorner<T>| Made {
            position: corner.position,
            size: whole(corner.weights),
            carried: V::between(*carried, &at_cut(corner, vertex_w)),
        };
        let mut fan = None;
        let mut next = |corner| match &mut fan {
            None => fan = Some((corner, None)),
            Some((_, second @ None)) => *second = Some(corner),
            Some((first, Some(second))) => {
                self.part::<V>([first, second, &corner], next);
                *second = corner;
            }
        };
        let ends = polygon.held().iter().skip(1).chain(polygon.held().get(0));
        for (a, b) in polygon.held().iter().zip(ends) {
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
    fn part<V: Carried>(&self, corners: [&Made<T, V::Vertex>; 3], next: &mut Next<'_, V>) {
        let mut polygon: Polygon<_, 0> = Made::corners(corners).into_iter().collect();
        let w = corners.map(Made::w);
        next.carry(&corners.map(|corner| corner.carried));
        self.finish(&mut polygon.slots(), w, V::WANTS, &mut next.places);
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
    fn fan<V: Carried>(&self, polygon: &Slots<'_, ClipCorner<T>>, carried: &[V::Vertex; 3], next: &mut Next<'_, V>) {
        for i in 2..polygon.held().len() {
            let (Some(first), Some(second), Some(third)) =
                (polygon.held().get(0), polygon.held().get(i - 1), polygon.held().get(i))
            else {
                continue;
            };
            let corners = [first, second, third];
            let values = corners.map(|corner| V::between(*carried, &in_clip_space(corner)));
            let mut given = Polygon::<_, 0>::of_vertices(corners.map(|corner| corner.position));
            let w = corners.map(|corner| w_of(corner.position));
            self.cut::<V>(&mut given.slots(), w, &values, next);
        }
    }

    /// From clip space to the screen, if it is the next; without corners where it is not drawn.
    #[inline(never)]
    fn finish<S: Shares>(
        &self,
        polygon: &mut Slots<'_, ClipCorner<T>>,
        vertex_w: [Scaled<T>; 3],
        wants: Wants,
        places: &mut Places<'_, S>,
    ) {
        if !places.is_next() {
            return;
        }
        places.corners.clear();
        places.shares.clear();
        if to_view(polygon, self.viewport, self.depth_range, self.behind).is_some() {
            self.place(polygon.held(), vertex_w, wants, places);
        }
    }

    /// On the screen, what lies in the view. A function of its own, whose stack clipping does not add to.
    #[inline(never)]
    fn place<S: Shares>(
        &self,
        polygon: Held<'_, ClipCorner<T>>,
        vertex_w: [Scaled<T>; 3],
        wants: Wants,
        Places { corners, shares, .. }: &mut Places<'_, S>,
    ) {
        let range = self.depth_range;
        let weigh = Weigh::new(polygon, vertex_w, wants);
        for corner in polygon.iter() {
            let Some((x, y, depth)) = self.viewport.place(corner.position, range) else {
                continue;
            };
            corners.push(PlacedCorner {
                position: (x, y),
                depth,
            });
            shares.push(weigh.shares_of(corner));
        }
        if !self.cull.keeps(corners.held().area()) {
            corners.clear();
        }
    }
}

/// Whether some corners have w < 0 and some w > 0.
fn changes_sign<T: Word>(polygon: Held<'_, ClipCorner<T>>) -> bool {
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
