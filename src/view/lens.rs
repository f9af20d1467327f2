//! From vertices in eye space to corners on the screen: clipped, projected, snapped and culled.

use core::cmp::Ordering;

use super::carried::{Shares, Wants, Weigh, at_cut, at_vertices, in_clip_space, whole};
use super::projected::{Left, Next, PlacedCorner, Places};
use super::{Carried, Cull, Fan, Vertex, View, in_front, w_of};
use crate::clip::{
    Behind, ClipCorner, DepthRange, Held, Polygon, ScreenPlanes, Slots, at_far, before_camera, cut_by, distance_of,
    is_beyond, is_in_volume, to_view,
};
use crate::matrix::Matrix;
use crate::num::{Block, Scaled, Wide, Word};
use crate::viewport::Viewport;

/// A [`View`] with any N: what works with this is in a program once.
pub(crate) struct Lens<'v, T: Word, W> {
    projection: &'v Matrix<T>,
    planes: &'v [Block<T, 4>],
    pub(super) viewport: &'v Viewport<W>,
    pub(super) depth_range: DepthRange,
    pub(super) behind: Behind,
    pub(super) cull: Cull,
}

impl<T: Word, W: Word, const N: usize> View<T, W, N> {
    /// The next of what is left. A function of its own, whose stack is free again when that is drawn.
    #[inline(never)]
    pub(super) fn project_next<V: Carried>(&self, vertices: &[Vertex<T, V::Vertex>; 3], left: &mut Left<V, N>) {
        let positions = vertices.each_ref().map(|v| v.position);
        let mut polygon = Polygon::<_, N>::default();
        let (lens, mut polygon, mut next) = (self.lens(), polygon.slots(), left.next());
        let Some(Taken { vertex_w, cuts }) = lens.take(&positions, V::WANTS, &mut polygon, &mut next.places) else {
            return;
        };
        if !V::WANTS.screen {
            // Values stay those of the vertices, whatever is cut: what follows is the same for any.
            lens.cut_at_infinity(&mut polygon, vertex_w, V::WANTS, &mut next.places);
            return;
        }
        let carried = vertices.each_ref().map(|v| v.carried);
        if V::WANTS.fan && cuts {
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
    /// Takes what user planes leave of a triangle to clip space; none where nothing is cut from it there either, as from most: then it
    /// is [put](Self::put_whole) on the screen, to the bits of what cuts.
    #[inline(never)]
    fn take<S: Shares>(
        &self,
        positions: &[Block<T, 4>; 3],
        wants: Wants,
        polygon: &mut Slots<'_, ClipCorner<T>>,
        places: &mut Places<'_, S>,
    ) -> Option<Taken<T>> {
        let mut clip = [Block::ZERO; 3];
        for (to, &position) in clip.iter_mut().zip(positions) {
            *to = self.projection.transform(position);
        }
        let is_cut = |plane: &Block<T, 4>| {
            let is_outside = |p| distance_of(plane.as_mantissas(), p) < T::Wide::ZERO;
            positions.iter().any(is_outside)
        };
        let cuts = self.planes.iter().any(is_cut);
        if !cuts && self.put_whole(&clip, wants, places) {
            return None;
        }
        for corner in ClipCorner::of_vertices(if cuts { *positions } else { clip }) {
            polygon.push(corner);
        }
        if cuts {
            cut_by(self.planes, polygon);
            polygon.each(|corner| corner.position = self.projection.transform(corner.position));
        }
        Some(Taken {
            vertex_w: clip.map(w_of),
            cuts,
        })
    }

    /// Puts a triangle in clip space on the screen if that takes no cut; whether it did.
    #[inline(never)]
    fn put_whole<S: Shares>(&self, clip: &[Block<T, 4>; 3], wants: Wants, places: &mut Places<'_, S>) -> bool {
        let is_next = places.awaits();
        if is_next {
            places.clear();
        }
        for &position in clip {
            let Some((x, y, depth)) = self.place_whole(position) else {
                if is_next {
                    places.clear();
                }
                return false;
            };
            if is_next {
                places.corners.push(PlacedCorner {
                    position: (x, y),
                    depth,
                });
            }
        }
        if !places.is_next() {
            return true;
        }
        if wants.space {
            for weights in &at_vertices(clip.map(w_of)) {
                places.shares.push(S::of(weights));
            }
        }
        self.cull(places);
        true
    }

    /// Leaves no corners of what is not drawn.
    #[inline(never)]
    fn cull<S: Shares>(&self, places: &mut Places<'_, S>) {
        if !self.cull.keeps(places.corners.held().area()) {
            places.corners.clear();
        }
    }

    /// Where a position lies on the screen, unless it lies outside of a plane.
    #[inline]
    fn place_whole(&self, position: Block<T, 4>) -> Option<(i32, i32, i32)> {
        let is_seen = || self.viewport.is_in_guard() && is_in_volume(position.mantissas(), self.depth_range);
        let planes = || ScreenPlanes::new(self.viewport, self.depth_range);
        if is_seen() || planes().outcode(position.mantissas()) == 0 {
            self.viewport.place(position, self.depth_range)
        } else {
            None
        }
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
        let corners = polygon.held();
        let Some(first) = corners.get(0) else {
            return;
        };
        let first = made(first);
        let mut start = first;
        for i in 1..=corners.len() {
            let end = corners.get(i).map_or(first, made);
            let crossing = self.to_far::<V>(&start, &end);
            if crossing.stays {
                next(start);
            }
            if let Some(corner) = crossing.corner {
                next(corner);
            }
            start = end;
        }
    }

    /// A triangle of corners that clipping has made.
    #[inline(never)]
    fn part<V: Carried>(&self, corners: [&Made<T, V::Vertex>; 3], next: &mut Next<'_, V>) {
        next.carry(&corners.map(|corner| corner.carried));
        if !V::WANTS.space && self.put_whole(&corners.map(|corner| corner.position), V::WANTS, &mut next.places) {
            return;
        }
        let mut polygon: Polygon<_, 0> = Made::corners(corners).into_iter().collect();
        let w = corners.map(Made::w);
        self.finish(&mut polygon.slots(), w, V::WANTS, &mut next.places);
    }

    /// Cuts off what is beyond the far plane of an edge, values being linear over the screen along it.
    #[inline(never)]
    fn to_far<V: Carried>(&self, a: &Made<T, V::Vertex>, b: &Made<T, V::Vertex>) -> ToFar<T, V::Vertex> {
        let beyond = [a, b].map(|corner| is_beyond(&corner.position, self.depth_range));
        let corner = (beyond[0] != beyond[1]).then(|| {
            let [start, end] = Made::corners([a, b]);
            if beyond[0] {
                at_far(&end, &start)
            } else {
                at_far(&start, &end)
            }
        });
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
        let corners = polygon.held();
        // Through infinity, the triangles are separate: which of them lie on one another is not for their corners to say.
        let is_separate = changes_sign(corners);
        let mut fan = Fan::new(self.viewport, corners.len(), |i| {
            let position = corners.get(i).filter(|_| !is_separate)?.position;
            Some(if in_front(w_of(position)) {
                position
            } else {
                position.negated()
            })
        });
        for i in 2..corners.len() {
            let Some(start) = fan.start(i) else {
                continue;
            };
            let (Some(first), Some(start), Some(second), Some(third)) = (
                corners.get(0),
                corners.get(start),
                corners.get(i.wrapping_sub(1)),
                corners.get(i),
            ) else {
                continue;
            };
            let positions = [first, start, third].map(|corner| corner.position);
            let values = [first, second, third].map(|corner| V::between(*carried, &in_clip_space(corner)));
            let mut given = Polygon::<_, 0>::of_vertices(positions);
            let w = positions.map(w_of);
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
        places.clear();
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

/// A triangle that has to be cut.
struct Taken<T> {
    /// w of its vertices.
    vertex_w: [Scaled<T>; 3],
    /// Whether user planes have cut it.
    cuts: bool,
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
