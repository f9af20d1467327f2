//! Triangular patches: ten control points.

use super::bernstein::{Shared, color, cross, difference, mix, on_curve, position};
use super::{ControlPoint, Level, PatchVertex};
use crate::num::{Block, Word};

/// A cubic patch over a triangle. K values are mixed besides the position: 3 for a colour, 0 for none.
///
/// ```
/// use fixel::{num::Block, patch::{ControlPoint, Level, TriangularPatch}};
///
/// // A flat triangle: control points at (x, y) with x + y at most 3.
/// let places = [(0, 0), (1, 0), (2, 0), (3, 0), (0, 1), (1, 1), (2, 1), (0, 2), (1, 2), (0, 3)];
/// let triangle = TriangularPatch::<i32, 0>::new(
///     places.map(|(x, y)| ControlPoint { position: Block::from_integers([x, y, 0, 1]), color: [] }),
/// );
/// let mut corners = Vec::new();
/// triangle.for_each_triangle::<false>(Level::new(1)?, &mut |t| corners.extend(t.map(|v| v.position)));
/// assert_eq!(corners.len(), 3 * 4);
/// // The first upright triangle, and the inverted one beside it.
/// let halves = |x, y| Block::from_integers([x, y, 0, 2]).scaled(-1);
/// let (a, b, c, d) = (halves(0, 0), halves(3, 0), halves(0, 3), halves(3, 3));
/// assert_eq!(corners[..6], [a, b, c, d, c, b]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct TriangularPatch<T, const K: usize> {
    /// Rows of four, three, two and one.
    points: [ControlPoint<T, K>; 10],
}

impl<T: Word, const K: usize> TriangularPatch<T, K> {
    /// Rows of four, three, two and one control points: s runs along a row, t from row to row.
    pub fn new(points: [ControlPoint<T, K>; 10]) -> Self {
        TriangularPatch {
            points: points.map(ControlPoint::clamped),
        }
    }

    /// Calls `draw` with every triangle of the grid of 2^level triangles a side: upright ones (i, j) (i+1, j) (i, j+1), each
    /// followed by the inverted one on its right, (i+1, j+1) (i, j+1) (i+1, j); along s first. Both turn like s, then t.
    ///
    /// With `NORMALS` false no normal is computed.
    pub fn for_each_triangle<const NORMALS: bool>(&self, level: Level, draw: &mut impl FnMut([PatchVertex<T, K>; 3])) {
        self.for_each_mapped::<NORMALS, _>(level, &mut |vertex| vertex, draw);
    }

    /// As [`for_each_triangle`](Self::for_each_triangle), with every vertex passed through `map` before: to transform it,
    /// and light it, for the six triangles that share it twice instead of six times.
    pub fn for_each_mapped<const NORMALS: bool, V: Copy>(
        &self,
        level: Level,
        map: &mut impl FnMut(PatchVertex<T, K>) -> V,
        draw: &mut impl FnMut([V; 3]),
    ) {
        let grid = Grid {
            patch: self,
            level,
            shared: Shared::new(self.points, level),
        };
        for j in 0..level.pieces() {
            let (mut a, mut c) = (map(grid.vertex::<NORMALS>(0, j)), map(grid.vertex::<NORMALS>(0, j + 1)));
            let end = level.pieces() - j;
            for i in 1..=end {
                let b = map(grid.vertex::<NORMALS>(i, j));
                draw([a, b, c]);
                if i < end {
                    let d = map(grid.vertex::<NORMALS>(i, j + 1));
                    draw([d, c, b]);
                    c = d;
                }
                a = b;
            }
        }
    }
}

/// A patch at one level.
struct Grid<'a, T: Word, const K: usize> {
    patch: &'a TriangularPatch<T, K>,
    level: Level,
    shared: Shared<T, 10, K>,
}

impl<T: Word, const K: usize> Grid<'_, T, K> {
    fn vertex<const NORMALS: bool>(&self, i: u32, j: u32) -> PatchVertex<T, K> {
        let [a, b, c, d, e, _, g, h, k, l] = self.patch.points;
        let last = self.level.pieces();
        let point = match (i, j) {
            (_, 0) => on_curve([a, b, c, d], i, self.level),
            (0, _) => on_curve([a, e, h, l], j, self.level),
            _ if i + j == last => on_curve([d, g, k, l], j, self.level),
            _ => {
                let weights = self.cubic(i, j);
                ControlPoint {
                    position: position::<T>(mix(weights, self.shared.positions), self.shared.exponent, self.level),
                    color: color(mix(weights, self.shared.colors)),
                }
            }
        };
        let normal = if NORMALS { self.normal(i, j) } else { Block::ZERO };
        PatchVertex::new(point, normal)
    }

    /// (B − A) × (C − A) of the last triangle, A its corner at s = t = 0.
    ///
    /// The corners are at most 2^(2·BITS + 2 − level), their differences twice that: no overflow.
    fn normal(&self, i: u32, j: u32) -> Block<T, 3> {
        let (u, s, t) = self.parts(i, j);
        let weights = [u * u, 2 * u * s, s * s, 2 * u * t, 2 * s * t, t * t];
        let [a, b, c, d, e, f, g, h, k, l] = self.shared.positions;
        let corner = |points: [_; 6]| mix(weights, points);
        let (origin, along_s, along_t) = (
            corner([a, b, c, e, f, h]),
            corner([b, c, d, f, g, k]),
            corner([e, f, g, h, k, l]),
        );
        cross::<T>([difference([along_s, origin]), difference([along_t, origin])])
    }

    /// Cubic weights in the order of the control points, times N³: non-negative, with sum N³ ≤ 2^24.
    fn cubic(&self, i: u32, j: u32) -> [i32; 10] {
        let (u, s, t) = self.parts(i, j);
        [
            u * u * u,
            3 * u * u * s,
            3 * u * s * s,
            s * s * s,
            3 * u * u * t,
            6 * u * s * t,
            3 * s * s * t,
            3 * u * t * t,
            3 * s * t * t,
            t * t * t,
        ]
    }

    /// Barycentric coordinates times N = 2^level: N − i − j, i, j.
    fn parts(&self, i: u32, j: u32) -> (i32, i32, i32) {
        (self.level.pieces() as i32 - i as i32 - j as i32, i as i32, j as i32)
    }
}
