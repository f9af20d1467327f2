//! A view: all that lies between vertices in eye space and a polygon on the screen.

mod carried;
mod line;
mod point;
mod ready;

use core::cmp::Ordering;

use crate::clip::{Behind, ClipCorner, DepthRange, Planes, Polygon, at_far, before_camera, is_beyond, to_view};
use crate::matrix::Matrix;
use crate::num::{Block, Scaled, Word};
use crate::screen::Shape;
use crate::span::{Corners, doubled_area};
use crate::varying::Varying;
use crate::viewport::Viewport;
pub use carried::{Carried, Wants, Weights};
pub(crate) use carried::{Weigh, in_clip_space};
use carried::{at_cut, whole};
pub use line::ProjectedLine;
pub use ready::{Assembled, ScreenVertex, Triangle};

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

/// A polygon on the screen and what its corners carry.
#[derive(Debug, Clone)]
pub struct Projected<V, const N: usize> {
    corners: Polygon<ProjectedCorner<V>, N>,
    first: ProjectedCorner<V>,
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

    /// A triangle, or an edge, whose vertices are these points in space.
    fn polygon<const K: usize, const N: usize>(corners: [&Self; K]) -> Polygon<ClipCorner<T>, N> {
        let mut polygon = Polygon::of_vertices(corners.map(|corner| corner.position));
        for (corner, made) in polygon.iter_mut().zip(corners) {
            corner.weights = corner.weights.times(made.size);
        }
        polygon
    }
}

#[derive(Debug, Clone, Copy)]
struct ProjectedCorner<V> {
    position: (i32, i32),
    depth: i32,
    varying: V,
}

impl<V: Copy, const N: usize> Projected<V, N> {
    #[inline]
    fn corner(&self, index: usize) -> &ProjectedCorner<V> {
        self.corners.get(index).unwrap_or(&self.first)
    }
}

impl<V: Copy, const N: usize> Corners for Projected<V, N> {
    #[inline]
    fn count(&self) -> usize {
        self.corners.len()
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.corner(index).position
    }
}

impl<V: Varying, const N: usize> Shape for Projected<V, N> {
    type Varying = V;
    #[inline]
    fn depth(&self, index: usize) -> i32 {
        self.corner(index).depth
    }
    #[inline]
    fn varying(&self, index: usize) -> V {
        self.corner(index).varying
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
        let Some(mut polygon) = self.planes.clip(vertices.each_ref().map(|v| v.position)) else {
            return;
        };
        for corner in polygon.iter_mut() {
            corner.position = self.projection.transform(corner.position);
        }
        let vertex_w = vertices.each_ref().map(|v| w_of(self.projection.transform(v.position)));
        let carried = vertices.each_ref().map(|v| v.carried);
        if V::WANTS.fan && !self.planes.is_empty() {
            self.fan::<V>(&polygon, carried, draw);
        } else {
            self.cut::<V>(polygon, vertex_w, carried, &mut draw);
        }
    }

    /// What user planes have left.
    fn cut<V: Carried>(
        &self,
        polygon: Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        carried: [V::Vertex; 3],
        draw: &mut impl FnMut(&Projected<V, N>),
    ) {
        if V::WANTS.screen && self.behind == Behind::Cut && !vertex_w.into_iter().all(in_front) {
            self.across::<V>(polygon, vertex_w, carried, draw);
            return;
        }
        let mut finish = |polygon| {
            if let Some(projected) = self.finish(polygon, vertex_w, carried) {
                draw(&projected);
            }
        };
        if self.behind == Behind::Divide && polygon.len() > 3 && changes_sign(&polygon) {
            for i in 2..polygon.len() {
                let corners = [0, i - 1, i].into_iter().filter_map(|i| polygon.get(i));
                finish(corners.copied().collect());
            }
        } else {
            finish(polygon);
        }
    }

    /// A triangle that reaches behind the camera: cut to what is before it, whose fan is of triangles like any other.
    #[cold]
    #[inline(never)]
    fn across<V: Carried>(
        &self,
        polygon: Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        carried: [V::Vertex; 3],
        draw: &mut impl FnMut(&Projected<V, N>),
    ) {
        let Some(before) = before_camera(polygon, &self.viewport, self.depth_range) else {
            return;
        };
        let made = |corner: &ClipCorner<T>| Made {
            position: corner.position,
            size: whole(corner.weights),
            carried: V::between(carried, &at_cut(corner, vertex_w)),
        };
        let kept = self.to_far::<V>(&before.iter().map(made).collect());
        for i in 2..kept.len() {
            let (Some(first), Some(second), Some(third)) = (kept.get(0), kept.get(i - 1), kept.get(i)) else {
                continue;
            };
            let corners = [first, second, third];
            let w = corners.map(Made::w);
            if let Some(projected) = self.finish(Made::polygon(corners), w, corners.map(|corner| corner.carried)) {
                draw(&projected);
            }
        }
    }

    /// Cuts off what is beyond the far plane, values being linear over the screen along each edge.
    fn to_far<V: Carried>(&self, before: &Polygon<Made<T, V::Vertex>, N>) -> Polygon<Made<T, V::Vertex>, N> {
        let mut kept = Polygon::default();
        let next = before.iter().skip(1).chain(before.get(0));
        for (a, b) in before.iter().zip(next) {
            let ends: Polygon<ClipCorner<T>, N> = Made::polygon([a, b]);
            let (Some(start), Some(end)) = (ends.get(0), ends.get(1)) else {
                continue;
            };
            let beyond = [start, end].map(|corner| is_beyond(corner, self.depth_range));
            if !beyond[0] {
                kept.push(*a);
            }
            let corner = match beyond {
                [false, true] => at_far(start, end),
                [true, false] => at_far(end, start),
                _ => continue,
            };
            kept.push(Made {
                position: corner.position,
                size: whole(corner.weights),
                carried: V::between(
                    [a.carried, b.carried, b.carried],
                    &at_cut(&corner, [a.w(), b.w(), b.w()]),
                ),
            });
        }
        kept
    }

    /// Every triangle of the fan as if it had been given: its corners' values are linear in clip space, and what is cut from
    /// here on is linear over the screen.
    fn fan<V: Carried>(
        &self,
        polygon: &Polygon<ClipCorner<T>, N>,
        carried: [V::Vertex; 3],
        mut draw: impl FnMut(&Projected<V, N>),
    ) {
        for i in 2..polygon.len() {
            let (Some(first), Some(second), Some(third)) = (polygon.get(0), polygon.get(i - 1), polygon.get(i)) else {
                continue;
            };
            let corners = [first, second, third];
            let values = corners.map(|corner| V::between(carried, &in_clip_space(corner)));
            let given = Polygon::of_vertices(corners.map(|corner| corner.position));
            let w = corners.map(|corner| w_of(corner.position));
            self.cut::<V>(given, w, values, &mut draw);
        }
    }

    /// From clip space to the screen.
    fn finish<V: Carried>(
        &self,
        polygon: Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        carried: [V::Vertex; 3],
    ) -> Option<Projected<V, N>> {
        let corners = self.place(polygon, vertex_w, carried)?;
        let projected = Projected {
            first: *corners.get(0)?,
            corners,
        };

        self.cull.keeps(doubled_area(&projected)).then_some(projected)
    }

    /// The corners on the screen of what is left of a polygon, or of a line, in clip space.
    fn place<V: Carried>(
        &self,
        polygon: Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        carried: [V::Vertex; 3],
    ) -> Option<Polygon<ProjectedCorner<V>, N>> {
        let polygon = to_view(polygon, &self.viewport, self.depth_range, self.behind)?;
        let weigh = Weigh::new(&polygon, vertex_w, V::WANTS);
        let place = |corner: &ClipCorner<T>| {
            let (x, y, depth) = self.viewport.place(corner.position, self.depth_range)?;
            let varying = V::mix(carried, &weigh.weights::<V>(corner));
            Some(ProjectedCorner {
                position: (x, y),
                depth,
                varying,
            })
        };
        Some(polygon.iter().filter_map(place).collect())
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
