//! From vertices in eye space to triangles on the screen by less code: for [compact](crate::fragment::Compact) programs.
//!
//! What vertices carry is cut along with them, and mixed for the corner that a cut makes as soon as it is made. Nothing then has to
//! know what a corner is made of, where all else in [`view`](super) keeps its weights and mixes at the end: half of the code.
//! Positions are cut by the same arithmetic, to the same bits.
//!
//! **Error** of a value where a plane has cut: what it has of the two ends is rounded to 2^-30, which moves it by no more than 2^-28 of
//! what they differ by. It belongs to where the edge is cut before that is rounded to a subpixel, as a vertex's does
//! (`tests/compact_views.rs`).

use core::hint::black_box;
use core::mem;

use heapless::{Vec, VecView};

use super::carried::{Weights, share};
use super::lens::Lens;
use super::{Carried, ScreenVertex, Vertex, View, in_front, w_of};
use crate::clip::{Behind, Cut, ScreenPlanes, depth_plane, distance_of, is_in_volume};
use crate::num::{Block, Scaled, Wide, Word};
use crate::screen::Shape;
use crate::slope::Slopes;
use crate::span::{Corners, doubled_area};
use crate::varying::Varying;

/// What draws shapes, in one way for all of them.
pub(crate) trait Painting<V: Varying> {
    /// Draws one with this [`doubled_area`].
    fn paint<S: Shape<Varying = V>>(&mut self, shape: &S, area: i64);
}

/// A corner on its way to the screen.
#[derive(Debug, Clone, Copy)]
struct Point<T, A> {
    /// As many times the point in space as `size` says.
    position: Block<T, 4>,
    /// Not kept up to date where nothing is carried.
    size: Scaled<T>,
    carried: A,
}

/// A corner on the screen.
#[derive(Debug, Clone, Copy)]
struct Placed<V> {
    position: (i32, i32),
    depth: i32,
    varying: V,
}

/// Corners that a triangle can get from the depth range and the guard band, and one of them twice.
const FEW: usize = 3 + 2 + 4 + 1;
/// User planes that all count.
const MOST_PLANES: usize = 247;

impl<T: Word, W: Word, const N: usize> View<T, W, N> {
    /// Draws what is left of a triangle: nothing, one polygon, or triangles that tile it.
    #[inline]
    pub(crate) fn paint<V: Carried>(&self, vertices: &[Vertex<T, V::Vertex>; 3], painting: &mut impl Painting<V>) {
        // A number of corners that depends on N cannot be said.
        match N {
            0 => self.paint_within::<V, FEW>(vertices, painting),
            1..=7 => self.paint_within::<V, { FEW + 7 }>(vertices, painting),
            _ => self.paint_within::<V, { FEW + MOST_PLANES }>(vertices, painting),
        }
    }

    #[inline(always)]
    fn paint_within<V: Carried, const M: usize>(
        &self,
        vertices: &[Vertex<T, V::Vertex>; 3],
        painting: &mut impl Painting<V>,
    ) {
        let mut left = Vec::<_, M>::new();
        self.leave::<V, M>(vertices, &mut left);
        self.lens().show(&left, painting);
    }

    /// A function of its own, whose stack is free again when that is drawn.
    #[inline(never)]
    fn leave<V: Carried, const M: usize>(&self, vertices: &[Vertex<T, V::Vertex>; 3], left: &mut VecView<Placed<V>>) {
        let mut polygon = Vec::<_, M>::new();
        for &Vertex { position, carried } in vertices {
            let _ = polygon.push(Point::new(position, carried));
        }
        let [.., w_row] = self.projection.rows();
        for plane in self.planes.as_slice() {
            cut::<T, V>(&mut polygon, &plane.mantissas(), &w_row);
        }
        for point in &mut polygon {
            self.projection.transform_compact(&mut point.position);
        }
        self.lens().put(&mut polygon, left);
    }
}

impl<T: Word, W: Word> View<T, W, 0> {
    /// As [`paint`](Self::paint), of a triangle whose vertices are in clip space already.
    #[inline]
    pub(crate) fn paint_assembled<V: Carried>(
        &self,
        vertices: [&ScreenVertex<T, V::Vertex>; 3],
        painting: &mut impl Painting<V>,
    ) {
        let mut left = Vec::<_, FEW>::new();
        self.leave_assembled(vertices, &mut left);
        self.lens().show(&left, painting);
    }

    #[inline(never)]
    fn leave_assembled<V: Carried>(&self, vertices: [&ScreenVertex<T, V::Vertex>; 3], left: &mut VecView<Placed<V>>) {
        let mut polygon = Vec::<_, FEW>::new();
        for vertex in vertices {
            let _ = polygon.push(Point::new(vertex.position(), vertex.carried));
        }
        self.lens().put(&mut polygon, left);
    }
}

impl<T: Word, W: Word> Lens<'_, T, W> {
    /// From clip space to the screen.
    #[inline(never)]
    fn put<V: Carried>(&self, polygon: &mut VecView<Point<T, V::Vertex>>, left: &mut VecView<Placed<V>>) {
        let in_volume = |point: &Point<T, _>| is_in_volume(point.position.mantissas(), self.depth_range);
        if !self.viewport.is_in_guard() || !polygon.iter().all(in_volume) {
            if self.behind == Behind::Divide && !turn::<T, V>(polygon) {
                return;
            }
            let w_row = depth_plane(0, 1);
            for plane in ScreenPlanes::new(self.viewport, self.depth_range).iter() {
                cut::<T, V>(polygon, plane, &w_row);
            }
        }
        let (mut magnitude, mut affine) = (i32::MIN, false);
        if V::WANTS.space {
            affine = has_one_w(polygon);
            for point in polygon.iter_mut() {
                point.size = point.size.over(w_of(point.position)).unwrap_or(Scaled::ZERO);
                magnitude = magnitude.max(point.size.exponent().saturating_add(T::BITS as i32));
            }
        }
        for point in polygon.iter() {
            let Some((x, y, depth)) = self.viewport.place(point.position, self.depth_range) else {
                // At the camera, where only a triangle that it sees edge-on comes: none of it is seen.
                left.clear();
                return;
            };
            let part = if V::WANTS.space {
                share(point.size.scaled(magnitude.saturating_neg()))
            } else {
                0
            };
            let _ = left.push(Placed {
                position: (x, y),
                depth,
                varying: V::mix([point.carried; 3], &Weights::of_one(part, affine)),
            });
        }
    }

    /// Draws a polygon on the screen.
    #[inline]
    fn show<V: Carried>(&self, corners: &[Placed<V>], painting: &mut impl Painting<V>) {
        let Some(first) = corners.first() else {
            return;
        };
        let outline = Outline { corners, first };
        let area = outline.area();
        if !self.cull.keeps(area) {
            return;
        }
        // Of a triangle that reaches behind the camera what is linear over the screen is so in each triangle of a fan by itself.
        let is_fan = V::WANTS.screen || V::Slopes::EXIST && V::Slopes::CARRIES;
        if !is_fan {
            painting.paint(&outline, area);
            return;
        }
        let apex = outline.apex(area);
        for i in 2..corners.len() {
            let part = outline.part(apex, i);
            let part_area = part.area();
            if (part_area < 0) == (area < 0) {
                painting.paint(&part, part_area);
            }
        }
    }
}

impl<T: Word, A> Point<T, A> {
    #[inline(always)]
    fn new(position: Block<T, 4>, carried: A) -> Self {
        Point {
            position,
            size: Block::raw([T::ONE << (T::BITS - 1)], 1 - T::BITS as i32),
            carried,
        }
    }
}

/// Takes what is behind the camera to the same points before it, unless only cutting it off is right: of what is no triangle any more,
/// and of values that are divided by w, where both lie behind and before. Whether nothing has w = 0.
fn turn<T: Word, V: Carried>(polygon: &mut [Point<T, V::Vertex>]) -> bool {
    let keeps_values = polygon.len() == 3 && !V::WANTS.space;
    let is_before = |point: &Point<T, _>| w_mantissa(point) > T::ZERO;
    if !keeps_values && polygon.iter().any(is_before) {
        return true;
    }
    for point in polygon {
        if w_mantissa(point) == T::ZERO {
            return false;
        }
        if w_mantissa(point) < T::ZERO {
            point.position.negate();
            point.size.negate();
        }
    }
    true
}

#[inline(always)]
fn w_mantissa<T: Word, A>(point: &Point<T, A>) -> T {
    let [.., w] = point.position.mantissas();
    w
}

/// Whether w is the same everywhere: with nothing cut, all corners are of one size. Others, if their w is the same, are divided by it.
fn has_one_w<T: Word, A>(polygon: &[Point<T, A>]) -> bool {
    let w = |point: &Point<T, A>| (w_of(point.position), point.size);
    polygon.windows(2).all(|pair| matches!(pair, [a, b] if w(a) == w(b)))
}

/// Keeps the part of a convex polygon whose distance is at least 0, in place. `w_row` takes positions to their w in clip space.
///
/// A convex polygon leaves a plane once and comes back once, so that it grows by a corner at most. One that is so thin that it
/// leaves twice, by rounding, loses a corner.
#[inline(never)]
fn cut<T: Word, V: Carried>(polygon: &mut VecView<Point<T, V::Vertex>>, plane: &[T; 4], w_row: &[T; 4]) {
    let is_inside = |point: &Point<T, V::Vertex>| distance_of(plane, &point.position) >= T::Wide::ZERO;
    let Some(&(mut point)) = polygon.first() else {
        return;
    };
    // Once more behind the last, where the polygon may grow.
    let _ = polygon.push(point);
    let (mut inside, mut kept) = (is_inside(&point), 0);
    for i in 1..polygon.len() {
        // Read before its place is taken.
        let Some(&next) = polygon.get(i) else {
            return;
        };
        let next_inside = is_inside(&next);
        let read = polygon.get_mut(..i.wrapping_add(1)).unwrap_or_default();
        if inside {
            kept = keep(read, kept, &mut { point });
        }
        if inside != next_inside {
            let (inner, outer) = if inside { (&point, &next) } else { (&next, &point) };
            kept = keep(read, kept, &mut crossing::<T, V>(inner, outer, plane, w_row));
        }
        (point, inside) = (next, next_inside);
    }
    polygon.truncate(kept);
}

/// One more of the corners that are kept, if there is a place; how many are.
#[inline(never)]
fn keep<C>(places: &mut [C], kept: usize, corner: &mut C) -> usize {
    let Some(place) = places.get_mut(kept) else {
        return kept;
    };
    // Exchanged word by word: copied, it would be `memmove`, which nothing else in a program needs.
    mem::swap(place, black_box(corner));
    kept.wrapping_add(1)
}

/// Where the edge from `inner` to `outer` crosses the plane.
#[inline(never)]
fn crossing<T: Word, V: Carried>(
    inner: &Point<T, V::Vertex>,
    outer: &Point<T, V::Vertex>,
    plane: &[T; 4],
    w_row: &[T; 4],
) -> Point<T, V::Vertex> {
    let cut = Cut::new(&inner.position, &outer.position, plane);
    if !V::WANTS.screen && !V::WANTS.space {
        return Point {
            position: cut.position,
            ..*inner
        };
    }
    let parts = cut.parts();
    let (size, in_space) = mixed([inner.size, outer.size], parts);
    // But for the scale of the row, which is the same for both.
    let w = [inner, outer].map(|point| {
        let w = distance_of(w_row, &point.position);
        Block::from_wide([w], point.position.exponent())
    });
    let on_screen = if V::WANTS.screen && w.into_iter().all(in_front) {
        mixed(w, parts).1
    } else {
        in_space
    };
    // Only their ratio counts: back to a size of 1.
    let excess = size.exponent().saturating_add(T::BITS as i32).saturating_neg();
    Point {
        position: cut.position.scaled(excess),
        size: size.scaled(excess),
        carried: V::between(
            [inner.carried, outer.carried, outer.carried],
            &Weights::of_two(on_screen, in_space),
        ),
    }
}

/// a·x + b·y, and what b·y is of that, in units of 2^-30.
#[inline(never)]
fn mixed<T: Word>([a, b]: [Scaled<T>; 2], [x, y]: [Scaled<T>; 2]) -> (Scaled<T>, i32) {
    let (a, b) = (product(a, x), product(b, y));
    let exponent = a.1.max(b.1);
    let [a, b] = [a, b].map(|(wide, own)| wide >> (exponent.saturating_sub(own) as u32).min(2 * T::BITS + 1));
    // Normalised by the sum, which is the largest where the parts are of one sign.
    let block = Block::<T, 2>::from_wide([b, a + b], exponent);
    let [b, sum] = block.mantissas();
    let part = if sum < T::ZERO { (-b).ratio(-sum) } else { b.ratio(sum) };
    let part = (part >> (T::BITS - 30)).narrow().clamp(T::ZERO, T::ONE << 30);
    (Scaled::new([sum], block.exponent()), part.low_i32())
}

/// Of numbers that are normalised, and of 0 the least exponent there is.
#[inline(always)]
fn product<T: Word>(a: Scaled<T>, b: Scaled<T>) -> (T::Wide, i32) {
    let ([m], [n]) = (a.mantissas(), b.mantissas());
    let product = m.times(n);
    if product == T::Wide::ZERO {
        return (product, i32::MIN);
    }
    (product, a.exponent().saturating_add(b.exponent()))
}

/// All that is left of a triangle.
struct Outline<'p, V> {
    corners: &'p [Placed<V>],
    /// For any that there is not.
    first: &'p Placed<V>,
}

impl<'p, V> Outline<'p, V> {
    /// A corner around which no triangle of the fan runs against the `area`, since it would overlap with others. Rounding turns
    /// one seldom. A polygon without such a corner crosses over itself, being within a subpixel of a line: then the triangles of
    /// the first corner are as good as any.
    #[inline(always)]
    fn apex(&self, area: i64) -> usize {
        let is_turned = |apex, i| {
            let turn = self.part(apex, i).area();
            turn != 0 && (turn < 0) != (area < 0)
        };
        let count = self.corners.len();
        let around = |apex: &usize| !(2..count).any(|i| is_turned(*apex, i));
        (0..count).find(around).unwrap_or(0)
    }

    /// The triangle of the edge to the corner that is `i` on from the apex.
    #[inline(never)]
    fn part(&self, apex: usize, i: usize) -> Part<'p, V> {
        let (corners, first) = (self.corners, self.first);
        let from_apex = |i: usize| {
            let index = apex.wrapping_add(i);
            let beyond = index.checked_sub(corners.len());
            corners.get(beyond.unwrap_or(index)).unwrap_or(first)
        };
        Part([from_apex(0), from_apex(i.wrapping_sub(1)), from_apex(i)])
    }

    #[inline(never)]
    fn area(&self) -> i64 {
        doubled_area(self)
    }
}

impl<V> Outline<'_, V> {
    #[inline]
    fn corner(&self, index: usize) -> &Placed<V> {
        self.corners.get(index).unwrap_or(self.first)
    }
}

impl<V> Corners for Outline<'_, V> {
    #[inline]
    fn count(&self) -> usize {
        self.corners.len()
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.corner(index).position
    }
}

impl<V: Varying> Shape for Outline<'_, V> {
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

/// A triangle of these.
struct Part<'p, V>([&'p Placed<V>; 3]);

impl<V> Part<'_, V> {
    #[inline(never)]
    fn area(&self) -> i64 {
        doubled_area(self)
    }

    #[inline(always)]
    fn corner(&self, index: usize) -> &Placed<V> {
        let [a, b, c] = self.0;
        match index {
            0 => a,
            1 => b,
            _ => c,
        }
    }
}

impl<V> Corners for Part<'_, V> {
    const TRIANGLE: bool = true;

    #[inline]
    fn count(&self) -> usize {
        3
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.corner(index).position
    }
}

impl<V: Varying> Shape for Part<'_, V> {
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
