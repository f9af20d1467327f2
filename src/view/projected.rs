//! What is left of a triangle on the screen: polygons, found one after the other.

use super::{Carried, Shares, Weights};
use crate::clip::{Held, Polygon, Slots};
use crate::screen::Shape;
use crate::span::{Corners, doubled_area};

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
    /// Whether what is found now is the one.
    #[inline]
    pub(super) fn is_next(&mut self) -> bool {
        let next = *self.found == self.drawn;
        *self.found = self.found.wrapping_add(1);
        next
    }
}
