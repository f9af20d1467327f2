//! A view: all that lies between vertices in eye space and a polygon on the screen.

use core::cmp::Ordering;

use crate::clip::{Behind, ClipCorner, DepthRange, Planes, Polygon, to_view};
use crate::matrix::Matrix;
use crate::num::{Block, Scaled, Word};
use crate::screen::Shape;
use crate::span::{Corners, doubled_area};
use crate::varying::{Linear, Perspective, Varying};
use crate::viewport::Viewport;

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

/// A varying that can be mixed from what three vertices carry.
pub trait Carried: Varying {
    /// What a vertex carries.
    type Vertex: Copy;
    /// Which weights [`mix`](Self::mix) wants.
    const KIND: Interpolation;
    /// At a corner of the polygon.
    fn mix(vertices: [Self::Vertex; 3], weights: Weights) -> Self;
}

/// How values run between corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// They do not.
    Flat,
    /// Linear over the screen.
    Linear,
    /// Linear in space.
    Perspective,
}

/// How much of each vertex a corner of the polygon is made of, in units of 2^-30.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Weights {
    /// Linear: they add up to 1. Perspective: over w, the largest sum of the polygon between a quarter and 1.
    shares: [i32; 3],
    /// The vertex that this corner is, unless a plane made it.
    vertex: Option<usize>,
    /// The shares are linear ones.
    linear: bool,
}

impl Carried for () {
    type Vertex = ();
    const KIND: Interpolation = Interpolation::Flat;
    #[inline(always)]
    fn mix(_: [(); 3], _: Weights) -> Self {}
}

impl<const N: usize> Carried for Linear<N> {
    type Vertex = [i32; N];
    const KIND: Interpolation = Interpolation::Linear;
    #[inline]
    fn mix(vertices: [[i32; N]; 3], weights: Weights) -> Self {
        Linear(weights.sum(vertices))
    }
}

impl<const N: usize> Carried for Perspective<N> {
    type Vertex = [i32; N];
    const KIND: Interpolation = Interpolation::Perspective;
    fn mix(vertices: [[i32; N]; 3], weights: Weights) -> Self {
        let over_w = weights.sum(vertices);
        if weights.linear {
            return Perspective {
                over_w,
                inverse: 1 << 30,
                values: over_w,
            };
        }
        // At most 1 but for the rounding of three: far from overflow.
        let [a, b, c] = weights.shares;
        let inverse = a.saturating_add(b).saturating_add(c);
        let values = match weights.pick(vertices) {
            Some(values) => values,
            None => over_w.map(|v| {
                let quotient = ((v as i64) << 30).checked_div(inverse as i64).unwrap_or(0);
                quotient.clamp(i32::MIN as i64, i32::MAX as i64) as i32
            }),
        };
        Perspective {
            over_w,
            inverse,
            values,
        }
    }
}

impl Weights {
    fn sum<const N: usize>(&self, vertices: [[i32; N]; 3]) -> [i32; N] {
        if let Some(values) = self.pick(vertices).filter(|_| self.linear) {
            return values;
        }
        let mut sums = [1i64 << 29; N];
        for (share, values) in self.shares.into_iter().zip(vertices) {
            for (sum, v) in sums.iter_mut().zip(values) {
                *sum += share as i64 * v as i64;
            }
        }
        // Three products of at most 2^30 and 2^31.
        sums.map(|s| (s >> 30).clamp(i32::MIN as i64, i32::MAX as i64) as i32)
    }

    fn pick<V>(&self, [a, b, c]: [V; 3]) -> Option<V> {
        match self.vertex? {
            0 => Some(a),
            1 => Some(b),
            _ => Some(c),
        }
    }
}

/// A polygon on the screen and what its corners carry.
#[derive(Debug)]
pub struct Projected<V, const N: usize> {
    corners: Polygon<ProjectedCorner<V>, N>,
    first: ProjectedCorner<V>,
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
    /// polygon, or, where user planes cut a triangle with w of both signs that is [divided by](Behind::Divide), the
    /// triangles of its fan from the first corner (through infinity, the polygon itself is not a convex one).
    pub fn project<V: Carried>(&self, vertices: &[Vertex<T, V::Vertex>; 3], mut draw: impl FnMut(&Projected<V, N>)) {
        let Some(mut polygon) = self.planes.clip(vertices.each_ref().map(|v| v.position)) else {
            return;
        };
        for corner in polygon.iter_mut() {
            corner.position = self.projection.transform(corner.position);
        }
        let vertex_w = vertices.each_ref().map(|v| w_of(self.projection.transform(v.position)));
        let carried = vertices.each_ref().map(|v| v.carried);
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

    /// From clip space to the screen.
    fn finish<V: Carried>(
        &self,
        polygon: Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        carried: [V::Vertex; 3],
    ) -> Option<Projected<V, N>> {
        let polygon = to_view(polygon, &self.viewport, self.depth_range, self.behind)?;
        let weigh = Weigh::new(&polygon, vertex_w, V::KIND, self.behind);
        let place = |corner: &ClipCorner<T>| {
            let (x, y, depth) = self.viewport.place(corner.position, self.depth_range)?;
            let varying = V::mix(carried, weigh.weights(corner));
            Some(ProjectedCorner {
                position: (x, y),
                depth,
                varying,
            })
        };
        let corners: Polygon<_, N> = polygon.iter().filter_map(place).collect();
        let projected = Projected {
            first: *corners.get(0)?,
            corners,
        };

        let area = doubled_area(&projected);
        let drawn = match self.cull {
            Cull::Nothing => area != 0,
            Cull::Clockwise => area > 0,
            Cull::CounterClockwise => area < 0,
        };
        drawn.then_some(projected)
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

/// How the weights of a polygon's corners become shares.
struct Weigh<T> {
    /// w of the three vertices.
    vertex_w: [Scaled<T>; 3],
    sharing: Sharing,
    /// Perspective: every corner's sum of |weight| over w is at most 2^magnitude, and the largest more than a quarter.
    magnitude: i32,
}

/// What the shares of a corner are in proportion to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sharing {
    /// Nothing is carried.
    Nothing,
    /// weight·w of the vertex: linear over the screen.
    Screen,
    /// The weights: linear in clip space, for what has no place on the screen (formats: `.iv`, clipping).
    ClipSpace,
    /// weight/w of the corner.
    Perspective,
}

impl<T: Word> Weigh<T> {
    fn new<const N: usize>(
        polygon: &Polygon<ClipCorner<T>, N>,
        vertex_w: [Scaled<T>; 3],
        interpolation: Interpolation,
        behind: Behind,
    ) -> Self {
        let [a, b, c] = vertex_w;
        let in_front = |w: Scaled<T>| w.mantissas() > [T::ZERO];
        let sharing = match interpolation {
            Interpolation::Flat => Sharing::Nothing,
            // With the same w everywhere, linear in space is linear over the screen.
            Interpolation::Perspective if a != b || b != c => Sharing::Perspective,
            _ if behind == Behind::Cut && !vertex_w.into_iter().all(in_front) => Sharing::ClipSpace,
            _ => Sharing::Screen,
        };
        let mut magnitude = i32::MIN;
        if sharing == Sharing::Perspective {
            for corner in polygon.iter() {
                if let Some(over_w) = corner.weights.over(w_of(corner.position)) {
                    let absolute = |s: Scaled<T>| if s.mantissas() < [T::ZERO] { s.negated() } else { s };
                    let [x, y, z] = over_w.split().map(absolute);
                    magnitude = magnitude.max(x.plus(y).plus(z).exponent().saturating_add(T::BITS as i32));
                }
            }
        }
        Weigh {
            vertex_w,
            sharing,
            magnitude,
        }
    }

    fn weights(&self, corner: &ClipCorner<T>) -> Weights {
        let zero = T::ZERO;
        let vertex = match corner.weights.mantissas() {
            [_, b, c] if b == zero && c == zero => Some(0),
            [a, _, c] if a == zero && c == zero => Some(1),
            [a, b, _] if a == zero && b == zero => Some(2),
            _ => None,
        };
        let [a, b, c] = corner.weights.split();
        let shares = match self.sharing {
            Sharing::Nothing => [0; 3],
            // Σ weight·w of the vertices is the corner's w: the shares add up to 1.
            Sharing::Screen => {
                let [a_w, b_w, _] = self.vertex_w;
                parts_of_one(a.times(a_w), b.times(b_w), w_of(corner.position))
            }
            Sharing::ClipSpace => parts_of_one(a, b, a.plus(b).plus(c)),
            Sharing::Perspective => {
                let over_w = corner.weights.over(w_of(corner.position)).unwrap_or(Block::ZERO);
                over_w.scaled(self.magnitude.saturating_neg()).split().map(share)
            }
        };
        let linear = matches!(self.sharing, Sharing::Screen | Sharing::ClipSpace);
        Weights { shares, vertex, linear }
    }
}

/// a/whole, b/whole and what they leave of 1, each at most 1 either way.
fn parts_of_one<T: Word>(a: Scaled<T>, b: Scaled<T>, whole: Scaled<T>) -> [i32; 3] {
    let [a, b] = [a, b].map(|part| part.over(whole).map_or(0, share));
    [
        a,
        b,
        ((1i64 << 30) - a as i64 - b as i64).clamp(-1 << 30, 1 << 30) as i32,
    ]
}

/// In units of 2^-30, within ±1.
fn share<T: Word>(part: Scaled<T>) -> i32 {
    part.to_fixed(30).clamp(-1 << 30, 1 << 30) as i32
}

fn w_of<T: Word>(position: Block<T, 4>) -> Scaled<T> {
    let [.., w] = position.split();
    w
}
