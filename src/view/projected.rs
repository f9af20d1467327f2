//! What is left of a triangle on the screen: polygons, found one after the other.

use super::{Carried, Shares, Weights};
use crate::clip::{Held, Polygon, Slots};
use crate::screen::{Shape, of_corners, pick};
use crate::span::{Corners, doubled_area};
use crate::varying::Varying;

/// A polygon on the screen and what its corners carry, mixed anew whenever it is asked for.
#[derive(Debug, Clone)]
pub struct Projected<V: Carried, const N: usize> {
    carried: [V::Vertex; 3],
    corners: Polygon<PlacedCorner, N>,
    /// What each corner has of the three vertices; empty where each is the vertex of its index.
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

impl<V: Carried> Shown<'_, V> {
    /// With three corners, what they carry mixed once: a triangle's is looked at more often.
    #[inline(always)]
    pub(crate) fn triangle(&self) -> Option<ShownTriangle<V>> {
        if self.corners.len() != 3 {
            return None;
        }
        let (a, b, c) = (self.corners.get(0)?, self.corners.get(1)?, self.corners.get(2)?);
        let varyings = if self.shares.is_empty() {
            V::whole(*self.carried, || of_corners(Weights::of_vertex))
        } else {
            of_corners(|i| self.varying(i))
        };
        Some(ShownTriangle {
            corners: [*a, *b, *c],
            varyings,
        })
    }
}

/// A [`Shown`] with three corners.
pub(crate) struct ShownTriangle<V> {
    corners: [PlacedCorner; 3],
    varyings: [V; 3],
}

impl<V> Corners for ShownTriangle<V> {
    const TRIANGLE: bool = true;

    #[inline(always)]
    fn count(&self) -> usize {
        3
    }
    #[inline(always)]
    fn position(&self, index: usize) -> (i32, i32) {
        self.corners.position(index)
    }
}

impl<V: Varying> Shape for ShownTriangle<V> {
    type Varying = V;
    #[inline(always)]
    fn depth(&self, index: usize) -> i32 {
        pick(&self.corners, index).depth
    }
    #[inline(always)]
    fn varying(&self, index: usize) -> V {
        *pick(&self.varyings, index)
    }
}

/// A corner of a [`Projected`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlacedCorner {
    pub(crate) position: (i32, i32),
    pub(crate) depth: i32,
}

impl Corners for [PlacedCorner; 3] {
    const TRIANGLE: bool = true;

    #[inline(always)]
    fn count(&self) -> usize {
        3
    }
    #[inline(always)]
    fn position(&self, index: usize) -> (i32, i32) {
        pick(self, index).position
    }
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
        V::mix(*self.carried, &shares.unwrap_or_else(|| Weights::of_vertex(index)))
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
    pub(super) places: Places<'l, V::Shares>,
}

impl<V: Carried> Next<'_, V> {
    /// What is found from here on carries that, until the one is found.
    #[inline]
    pub(super) fn carry(&mut self, carried: &[V::Vertex; 3]) {
        if *self.places.found <= self.places.drawn {
            *self.carried = *carried;
        }
    }
}

/// The same without what the vertices carry.
pub(crate) struct Places<'l, S> {
    drawn: usize,
    found: &'l mut usize,
    pub(super) corners: Slots<'l, PlacedCorner>,
    pub(super) shares: Slots<'l, S>,
}

impl<S: Shares> Places<'_, S> {
    /// Nothing of any that was found before.
    #[inline]
    pub(super) fn clear(&mut self) {
        self.corners.clear();
        self.shares.clear();
    }

    /// Whether what is found next is the one.
    #[inline]
    pub(super) fn awaits(&self) -> bool {
        *self.found == self.drawn
    }

    /// Whether what is found now is the one.
    #[inline]
    pub(super) fn is_next(&mut self) -> bool {
        let next = self.awaits();
        *self.found = self.found.wrapping_add(1);
        next
    }
}
