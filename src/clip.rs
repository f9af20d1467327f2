//! Clipping in homogeneous space: user planes, the depth range, the guard band.
//!
//! A corner is its position and its *weights*: how much of each of the triangle's three vertices it is made of. A plane
//! cuts an edge at (a·d_b + b·d_a), with d the distances of its ends, a the inner end: no division, since a homogeneous
//! point has no scale. The cut depends on the edge's two ends and the plane only, always taken from the inside out, so
//! that both triangles of an edge get the same bits. What vertices carry is mixed from the weights at the end; clipping
//! itself costs the same whatever they carry.
//!
//! **Error** of a cut: the distances are exact, then kept to [`Word::BITS`] bits of the larger; the position is rounded
//! once. The cut point lies within 2^(2−BITS) of the largest component of either end from the true one, and on the line
//! through the two.

use core::hint::black_box;

use heapless::{Vec, VecView};

use crate::error::Error;
use crate::num::{Block, Scaled, Wide, Word};
use crate::viewport::Viewport;

/// Corners that a triangle can get from the depth range (2 planes) and the guard band (4 planes).
const BUILT_IN: usize = 3 + 2 + 4;

/// Which depths z/w are drawn; both ends are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DepthRange {
    /// 0 to 1 (HW2).
    ZeroToOne,
    /// −1 to 1 (OpenGL, MP1 with `depth`).
    MinusOneToOne,
    /// All of them: without a depth buffer.
    Unlimited,
}

/// What w < 0 means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Behind {
    /// Behind the camera: cut off (`.iv`, OpenGL).
    Cut,
    /// Divided by like any other (HW2, and MP1 without `frustum`).
    Divide,
}

/// A polygon's corner on its way to the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClipCorner<T> {
    /// Homogeneous position.
    pub position: Block<T, 4>,
    /// position = Σ weight · vertex, over the three vertices of the triangle or the two of the line (the third weight is
    /// then 0); each within 2^(2−BITS) of the largest weight.
    pub weights: Block<T, 3>,
}

/// A line, or a convex polygon of up to 9 + N corners: three, two more for the depth range, four for the guard band, and one for
/// each of N user planes.
#[derive(Debug, Clone)]
pub struct Polygon<C, const N: usize> {
    built_in: Vec<C, BUILT_IN>,
    user: Vec<C, N>,
}

impl<C: Copy, const N: usize> Default for Polygon<C, N> {
    fn default() -> Self {
        Polygon {
            built_in: Vec::new(),
            user: Vec::new(),
        }
    }
}

impl<C: Copy, const N: usize> Polygon<C, N> {
    /// Corners.
    #[inline]
    pub fn len(&self) -> usize {
        self.held().len()
    }

    /// Whether nothing is left.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.built_in.is_empty()
    }

    /// Corner `index`.
    #[inline]
    pub fn get(&self, index: usize) -> Option<&C> {
        self.held().get(index)
    }

    /// All corners in order.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = &C> {
        self.held().iter()
    }

    /// Its corners, to read.
    #[inline(always)]
    pub(crate) fn held(&self) -> Held<'_, C> {
        Held {
            built_in: &self.built_in,
            user: &self.user,
        }
    }

    /// Its corners, to change.
    #[inline(always)]
    pub(crate) fn slots(&mut self) -> Slots<'_, C> {
        Slots {
            built_in: &mut self.built_in,
            user: self.user.as_mut_view(),
        }
    }
}

/// The corners of a [`Polygon`] with any N: what works on these is in a program once.
#[derive(Debug)]
pub(crate) struct Held<'p, C> {
    built_in: &'p [C],
    user: &'p [C],
}

impl<C> Clone for Held<'_, C> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<C> Copy for Held<'_, C> {}

impl<'p, C> Held<'p, C> {
    #[inline(always)]
    pub(crate) fn len(self) -> usize {
        self.built_in.len() + self.user.len()
    }

    #[inline(always)]
    pub(crate) fn is_empty(self) -> bool {
        self.built_in.is_empty()
    }

    /// Corner `index`.
    ///
    /// A function of its own: where the two parts meet is decided in many places of a small program otherwise.
    #[inline(never)]
    pub(crate) fn get(self, index: usize) -> Option<&'p C> {
        self.built_in
            .get(index)
            .or_else(|| self.user.get(index.wrapping_sub(BUILT_IN)))
    }

    #[inline]
    pub(crate) fn iter(self) -> impl Iterator<Item = &'p C> {
        (0..self.len()).filter_map(move |i| self.get(i))
    }
}

/// As [`Held`], to change.
#[derive(Debug)]
pub(crate) struct Slots<'p, C> {
    built_in: &'p mut Vec<C, BUILT_IN>,
    user: &'p mut VecView<C>,
}

impl<C: Copy> Slots<'_, C> {
    #[inline(always)]
    pub(crate) fn held(&self) -> Held<'_, C> {
        Held {
            built_in: self.built_in,
            user: self.user,
        }
    }

    #[inline]
    pub(crate) fn clear(&mut self) {
        self.built_in.clear();
        self.user.clear();
    }

    /// Calls `change` with all corners in order.
    #[inline]
    pub(crate) fn each(&mut self, mut change: impl FnMut(&mut C)) {
        for i in 0..self.held().len() {
            if let Some(corner) = self.get_mut(i) {
                change(corner);
            }
        }
    }

    #[inline(never)]
    fn get_mut(&mut self, index: usize) -> Option<&mut C> {
        match self.built_in.get_mut(index) {
            Some(corner) => Some(corner),
            None => self.user.get_mut(index.wrapping_sub(BUILT_IN)),
        }
    }

    /// Leaves the first `count` corners.
    #[inline]
    fn truncate(&mut self, count: usize) {
        self.built_in.truncate(count);
        self.user.truncate(count.saturating_sub(BUILT_IN));
    }

    /// Makes this corner `index`, of those there are or the one behind them.
    ///
    /// A function of its own, as all that looks for a place is.
    #[inline(never)]
    fn put(&mut self, index: usize, corner: &mut C) {
        match self.get_mut(index) {
            // Exchanged word by word: copied, it would be `memmove`, which nothing else in a program needs.
            Some(there) => core::mem::swap(there, black_box(corner)),
            None => self.push(*corner),
        }
    }

    /// One corner more; beyond 9 + N it is left out, which [`cut`] never needs.
    #[inline]
    pub(crate) fn push(&mut self, corner: C) {
        if let Err(corner) = self.built_in.push(corner) {
            let _ = self.user.push(corner);
        }
    }
}

impl<T: Word, const N: usize> Polygon<ClipCorner<T>, N> {
    /// A triangle whose corners are its vertices, or a line whose ends are, if K is 2.
    ///
    /// A function of its own: inlined, it has polygons to copy on the stack of what clips.
    #[inline(never)]
    pub(crate) fn of_vertices<const K: usize>(vertices: [Block<T, 4>; K]) -> Self {
        ClipCorner::of_vertices(vertices).into_iter().collect()
    }
}

impl<T: Word> ClipCorner<T> {
    /// Corners that are the vertices, three at most.
    pub(crate) fn of_vertices<const K: usize>(vertices: [Block<T, 4>; K]) -> [Self; K] {
        let one = T::ONE << (T::BITS - 1);
        let mut left = [one, T::ZERO, T::ZERO];
        vertices.map(|position| {
            let weights = Block::raw(left, 1 - T::BITS as i32);
            let [a, b, _] = left;
            left = [T::ZERO, a, b];
            ClipCorner { position, weights }
        })
    }
}

impl<C: Copy, const N: usize> FromIterator<C> for Polygon<C, N> {
    /// The first 9 + N corners.
    fn from_iter<I: IntoIterator<Item = C>>(corners: I) -> Self {
        let mut polygon = Polygon::default();
        corners.into_iter().for_each(|corner| polygon.slots().push(corner));
        polygon
    }
}

/// The user's clip planes, at most N.
///
/// ```
/// use fixel::{clip::Planes, error::Error, num::Block};
/// let mut planes = Planes::<i32, 1>::default();
/// let right_half = Block::from_integers([1, 0, 0, 0]);
/// assert_eq!(planes.push(right_half), Ok(()));
/// assert_eq!(planes.push(right_half), Err(Error::TooManyPlanes));
/// ```
#[derive(Debug, Clone, Default)]
pub struct Planes<T: Word, const N: usize>(Vec<Block<T, 4>, N>);

impl<T: Word, const N: usize> Planes<T, N> {
    /// Keeps only what has p·(x, y, z, w) ≥ 0 in eye space from now on.
    ///
    /// # Errors
    /// [`Error::TooManyPlanes`] where there are N already.
    pub fn push(&mut self, plane: Block<T, 4>) -> Result<(), Error> {
        self.0.push(plane).map_err(|_| Error::TooManyPlanes)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// What is left of a triangle, or of a line if K is 2: the first three vertices count. `None` for nothing.
    pub fn clip<const K: usize>(&self, vertices: [Block<T, 4>; K]) -> Option<Polygon<ClipCorner<T>, N>> {
        let mut polygon = Polygon::of_vertices(vertices);
        cut_by(self.as_slice(), &mut polygon.slots());
        (!polygon.is_empty()).then_some(polygon)
    }

    /// As [`clip`](Self::clip), of a triangle that goes on as the fan from its first corner: each plane begins with the edge from
    /// the last corner to the first, so that a cut there is the first corner of what is left.
    pub(crate) fn clip_to_fan(&self, vertices: [Block<T, 4>; 3]) -> Option<Polygon<ClipCorner<T>, N>> {
        let mut polygon = Polygon::of_vertices(vertices);
        for plane in self.as_slice() {
            let corners = &mut polygon.slots();
            let is_inside = |i| {
                let corner = corners.held().get(i)?;
                Some(distance_of(&plane.mantissas(), &corner.position) >= T::Wide::ZERO)
            };
            let crosses_last = is_inside(0) != is_inside(corners.held().len().wrapping_sub(1));
            cut(corners, plane.mantissas());
            if crosses_last && let Some(&(mut before)) = corners.held().get(corners.held().len().wrapping_sub(1)) {
                corners.each(|corner| core::mem::swap(corner, &mut before));
            }
        }
        (!polygon.is_empty()).then_some(polygon)
    }

    /// All of them.
    #[inline(always)]
    pub(crate) fn as_slice(&self) -> &[Block<T, 4>] {
        &self.0
    }

    /// Whether a point is on the kept side of all of them, exactly.
    pub(crate) fn hold(&self, point: Block<T, 4>) -> bool {
        self.0
            .iter()
            .all(|plane| distance(plane.mantissas(), point.mantissas()) >= T::Wide::ZERO)
    }
}

/// Leaves of a polygon what planes keep.
pub(crate) fn cut_by<T: Word>(planes: &[Block<T, 4>], polygon: &mut Slots<'_, ClipCorner<T>>) {
    for plane in planes {
        cut(polygon, plane.mantissas());
    }
}

/// p·(x, y, z, w), up to a positive factor: exact.
#[inline(always)]
pub(crate) fn distance<T: Word>([a, b, c, d]: [T; 4], [x, y, z, w]: [T; 4]) -> T::Wide {
    a.times(x) + b.times(y) + c.times(z) + d.times(w)
}

/// That of a corner. A function of its own: cutting asks for it in five places.
#[inline(never)]
pub(crate) fn distance_of<T: Word>(plane: &[T; 4], position: &Block<T, 4>) -> T::Wide {
    distance(*plane, position.mantissas())
}

/// A plane (0, 0, z, w).
pub(crate) fn depth_plane<T: Word>(z: i32, w: i32) -> [T; 4] {
    [0, 0, z, w].map(T::from_i32)
}

fn near_plane<T: Word>(range: DepthRange) -> [T; 4] {
    depth_plane(1, (range == DepthRange::MinusOneToOne) as i32)
}

fn far_plane<T: Word>() -> [T; 4] {
    depth_plane(-1, 1)
}

/// The planes that the screen needs, as data, so that one piece of code cuts by all of them.
pub(crate) struct ScreenPlanes<T> {
    /// Near, far, and the four sides of the guard band.
    planes: [[T; 4]; 6],
    /// How many of them, from the start, do not count.
    skipped: usize,
}

impl<T: Word> ScreenPlanes<T> {
    pub(crate) fn new<W: Word>(viewport: &Viewport<W>, range: DepthRange) -> Self {
        let [right, below, left, above] = viewport.guard_planes();
        ScreenPlanes {
            planes: [near_plane(range), far_plane(), right, below, left, above],
            skipped: if range == DepthRange::Unlimited { 2 } else { 0 },
        }
    }

    /// All of them.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[T; 4]> {
        self.planes.iter().skip(self.skipped)
    }

    /// One bit for each of them that a point lies outside of, exactly.
    ///
    /// A function of its own: the same for all that is drawn.
    #[inline(never)]
    pub(crate) fn outcode(&self, position: [T; 4]) -> u8 {
        let mut code = 0;
        for &plane in self.iter() {
            code = code << 1 | (distance(plane, position) < T::Wide::ZERO) as u8;
        }
        code
    }

    /// Cuts off what lies outside; `None` where all corners lie outside the same plane.
    fn cut(&self, polygon: &mut Slots<'_, ClipCorner<T>>) -> Option<()> {
        let (mut all, mut any) = (u8::MAX, 0);
        for corner in polygon.held().iter() {
            let code = self.outcode(corner.position.mantissas());
            (all, any) = (all & code, any | code);
        }
        if all != 0 {
            return None;
        }
        if any != 0 {
            for &plane in self.iter() {
                cut(polygon, plane);
            }
        }
        Some(())
    }
}

/// Whether a point certainly lies inside all planes of the screen: the view volume does, and is soon tested.
#[inline(always)]
pub(crate) fn is_in_volume<T: Word>([x, y, z, w]: [T; 4], range: DepthRange) -> bool {
    let z = if range == DepthRange::Unlimited { T::ZERO } else { z };
    let nearest = if range == DepthRange::ZeroToOne { T::ZERO } else { -w };
    w > T::ZERO && x >= -w && x <= w && y >= -w && y <= w && z >= nearest && z <= w
}

/// Cuts a polygon in clip space to what lies before the camera, all w > 0: by the near plane, and where that is not enough
/// (there is none, or it passes behind the camera) by all that [`to_view`] cuts by.
pub(crate) fn before_camera<T: Word, W: Word>(
    polygon: &mut Slots<'_, ClipCorner<T>>,
    viewport: &Viewport<W>,
    range: DepthRange,
) -> Option<()> {
    let planes = ScreenPlanes::new(viewport, range);
    let outside = |corner: &ClipCorner<T>| planes.outcode(corner.position.mantissas());
    if polygon.held().iter().map(outside).fold(u8::MAX, |all, code| all & code) != 0 {
        return None;
    }
    if range != DepthRange::Unlimited {
        cut(polygon, near_plane(range));
    }
    if polygon.held().iter().all(is_in_front) {
        return Some(());
    }
    to_view(polygon, viewport, range, Behind::Cut)
}

fn is_in_front<T: Word>(corner: &ClipCorner<T>) -> bool {
    w_of(corner) > T::ZERO
}

fn w_of<T: Word>(corner: &ClipCorner<T>) -> T {
    let [.., w] = corner.position.mantissas();
    w
}

/// Whether a position lies beyond the far plane.
pub(crate) fn is_beyond<T: Word>(position: &Block<T, 4>, range: DepthRange) -> bool {
    range != DepthRange::Unlimited && distance_of(&far_plane(), position) < T::Wide::ZERO
}

/// Where the edge from `inner` to `outer`, which [is beyond](is_beyond) the far plane, crosses that.
pub(crate) fn at_far<T: Word>(inner: &ClipCorner<T>, outer: &ClipCorner<T>) -> ClipCorner<T> {
    crossing(inner, outer, far_plane())
}

/// Cuts a polygon in clip space to the depth range and the guard band; every corner that is left has w > 0. `None` for
/// nothing left, and where a corner has w = 0 and `behind` would divide by it.
pub(crate) fn to_view<T: Word, W: Word>(
    polygon: &mut Slots<'_, ClipCorner<T>>,
    viewport: &Viewport<W>,
    range: DepthRange,
    behind: Behind,
) -> Option<()> {
    let in_volume = |corner: &ClipCorner<T>| is_in_volume(corner.position.mantissas(), range);
    if viewport.is_in_guard() && polygon.held().iter().all(in_volume) {
        return (!polygon.held().is_empty()).then_some(());
    }
    if behind == Behind::Divide {
        let mut at_infinity = false;
        polygon.each(|corner| {
            at_infinity |= w_of(corner) == T::ZERO;
            if w_of(corner) < T::ZERO {
                // The same point on the screen; the weights keep the sign for what is divided by w.
                *corner = ClipCorner {
                    position: corner.position.negated(),
                    weights: corner.weights.negated(),
                };
            }
        });
        if at_infinity {
            return None;
        }
    }
    ScreenPlanes::new(viewport, range).cut(polygon)?;
    (!polygon.held().is_empty() && polygon.held().iter().all(is_in_front)).then_some(())
}

/// Keeps the part of a convex polygon whose distance is at least 0; none of it where no corner's is. Two corners are a
/// line, and stay one: they have one edge, not one there and one back.
///
/// A convex polygon leaves a plane once and comes back once, so that it grows by at most one corner per plane. One that is so thin
/// that it leaves twice, by rounding, loses a corner.
///
/// One function for all planes, which are data: inlined for each, cutting is most of a small program's code. In place: a
/// second polygon is more stack than all else that clipping needs.
#[inline(never)]
pub(crate) fn cut<T: Word>(polygon: &mut Slots<'_, ClipCorner<T>>, plane: [T; 4]) {
    let is_inside = |corner: &ClipCorner<T>| distance_of(&plane, &corner.position) >= T::Wide::ZERO;
    let count = polygon.held().len();
    let Some(&first) = polygon.held().get(0) else {
        return;
    };
    let first_inside = is_inside(&first);
    // The corner that an edge runs from, whether it stays, and how many corners do before it.
    let (mut corner, mut inside, mut kept) = (first, first_inside, 0_usize);
    for i in 1..=count {
        // Read before its place is taken.
        let next = polygon.held().get(i).copied().unwrap_or(first);
        let is_edge = i < count || count > 2;
        let next_inside = if i < count { is_inside(&next) } else { first_inside };
        if inside {
            if kept.wrapping_add(1) != i {
                polygon.put(kept, &mut { corner });
            }
            kept = kept.wrapping_add(1);
        }
        if inside != next_inside && is_edge && kept <= i {
            let (inner, outer) = if inside { (&corner, &next) } else { (&next, &corner) };
            polygon.put(kept, &mut crossing(inner, outer, plane));
            kept = kept.wrapping_add(1);
        }
        (corner, inside) = (next, next_inside);
    }
    polygon.truncate(kept);
}

/// Where the edge from `inner` to `outer` crosses the plane.
fn crossing<T: Word>(inner: &ClipCorner<T>, outer: &ClipCorner<T>, plane: [T; 4]) -> ClipCorner<T> {
    let cut = Cut::new(&inner.position, &outer.position, &plane);
    let [of_inner, of_outer] = cut.parts();
    let weights = inner.weights.times(of_inner).plus(outer.weights.times(of_outer));
    // Only their ratio counts: back to weights of size 1.
    let excess = weights.exponent().saturating_add(T::BITS as i32);
    ClipCorner {
        position: cut.position.scaled(excess.saturating_neg()),
        weights: weights.scaled(excess.saturating_neg()),
    }
}

/// A plane's cut of an edge: a·d_b + b·d_a of its ends a and b.
pub(crate) struct Cut<T> {
    pub(crate) position: Block<T, 4>,
    /// d_b and d_a, to the scales of the ends they do not belong to: distances in true scale are d_a·2^a_scale and d_b·2^b_scale.
    /// Positions cancelled them, weights want those.
    parts: [(T, i32); 2],
}

impl<T: Word> Cut<T> {
    /// From the end that is kept to the one that is not.
    #[inline(always)]
    pub(crate) fn new(inner: &Block<T, 4>, outer: &Block<T, 4>, plane: &[T; 4]) -> Self {
        let d_in = distance_of(plane, inner);
        let d_out = -distance_of(plane, outer);
        // Neither is negative.
        let shift = d_in.max(d_out).bit_length().saturating_sub(T::BITS);
        // As words, which the compiler would look through and multiply twice as long ones.
        let (d_in, d_out) = black_box(((d_in >> shift).narrow(), (d_out >> shift).narrow()));
        let (a_scale, b_scale) = (inner.exponent(), outer.exponent());
        let mut mixed = [T::Wide::ZERO; 4];
        let ends = inner.as_mantissas().iter().zip(outer.as_mantissas());
        for (mixed, (&a, &b)) in mixed.iter_mut().zip(ends) {
            *mixed = a.times(d_out) + b.times(d_in);
        }
        let mut position = Block::ZERO;
        position.set_wide(&mut mixed, a_scale.saturating_add(b_scale));
        Cut {
            position,
            parts: [(d_out, b_scale), (d_in, a_scale)],
        }
    }

    /// How many times it has what belongs to either end.
    #[inline(always)]
    pub(crate) fn parts(&self) -> [Scaled<T>; 2] {
        let [(d_out, b_scale), (d_in, a_scale)] = self.parts;
        [Block::new([d_out], b_scale), Block::new([d_in], a_scale)]
    }
}
