//! Lines through a view.

use crate::num::Word;
use crate::screen::{Shape, end};
use crate::span::Corners;

use super::{Carried, PlacedCorner, Shares, Vertex, View, Weigh, in_clip_space, w_of};
use crate::clip::{Polygon, to_view};

/// The two ends of a line on the screen and what they carry.
#[derive(Debug)]
pub struct ProjectedLine<V: Carried> {
    carried: [V::Vertex; 3],
    ends: [(PlacedCorner, V::Shares); 2],
}

impl<V: Carried> Corners for ProjectedLine<V> {
    #[inline]
    fn count(&self) -> usize {
        2
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        end(&self.ends, index).0.position
    }
}

impl<V: Carried> Shape for ProjectedLine<V> {
    type Varying = V;
    #[inline]
    fn depth(&self, index: usize) -> i32 {
        end(&self.ends, index).0.depth
    }
    #[inline]
    fn varying(&self, index: usize) -> V {
        V::mix(self.carried, &end(&self.ends, index).1.weights())
    }
}

impl<T: Word, W: Word, const N: usize> View<T, W, N> {
    /// What is left of a line on the screen, clipped, projected and snapped; `None` for nothing. Lines are never culled.
    ///
    /// An end keeps its place unless it is cut off. Where the ends left by user planes have w of both signs and are
    /// [divided by](crate::clip::Behind::Divide), the line is the one between the two projected ends, not the one through
    /// infinity.
    ///
    /// **Error**: a cut end is snapped like any other, so that a line cut at the guard band lights another pixel than the
    /// true line only where that passes within 2^-7 px of the border between the two. To this a position far from the
    /// viewport adds its own rounding: G²/h·2^(1−BITS) px for a guard band of G px and a viewport 2·h px wide or high, which
    /// is 0.001 px for words of 32 bits, ±4096 px and h = 32 (`tests/line_views.rs`).
    ///
    /// The example is [`draw::primitive_segment`](crate::draw::primitive_segment)'s.
    pub fn project_line<V: Carried>(&self, ends: &[Vertex<T, V::Vertex>; 2]) -> Option<ProjectedLine<V>> {
        let mut line = self.planes.clip(ends.each_ref().map(|v| v.position))?;
        line.slots()
            .each(|corner| corner.position = self.projection.transform(corner.position));
        // A triangle whose third vertex has no weight: it may be the second once more.
        let [a, b] = ends;
        let mut vertex_w = [a, b, b].map(|v| w_of::<T>(self.projection.transform(v.position)));
        let mut carried = [a, b, b].map(|v| v.carried);
        if V::WANTS.fan && !self.planes.is_empty() {
            let (a, b) = (*line.get(0)?, *line.get(1)?);
            carried = [&a, &b, &b].map(|corner| V::between(carried, &in_clip_space(corner)));
            vertex_w = [&a, &b, &b].map(|corner| w_of(corner.position));
            line = Polygon::of_vertices([a.position, b.position]);
        }
        to_view(&mut line.slots(), &self.viewport, self.depth_range, self.behind)?;
        let weigh = Weigh::new(line.held(), vertex_w, V::WANTS);
        let end = |i| {
            let corner = line.get(i)?;
            let (x, y, depth) = self.viewport.place(corner.position, self.depth_range)?;
            let position = (x, y);
            Some((PlacedCorner { position, depth }, weigh.shares_of(corner)))
        };
        let ends = [end(0)?, end(1)?];
        Some(ProjectedLine { carried, ends })
    }
}
