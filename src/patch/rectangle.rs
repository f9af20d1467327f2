//! Rectangular patches: sixteen control points.

use super::bernstein::{Shared, color, cross, cubic, difference, mix, on_curve, position, quadratic, shift_rounded};
use super::{ControlPoint, Level, PatchVertex};
use crate::num::{Block, Word};

/// A bicubic patch. K values are mixed besides the position: 3 for a colour, 0 for none.
///
/// ```
/// use fixel::{num::Block, patch::{ControlPoint, Level, PatchVertex, RectangularPatch}};
///
/// // A flat square of 3 by 3, blue growing to the right.
/// let square = RectangularPatch::<i32, 1>::new(core::array::from_fn(|k| {
///     let (x, y) = (k as i32 % 4, k as i32 / 4);
///     ControlPoint { position: Block::from_integers([x, y, 0, 1]), color: [85 * x] }
/// }));
/// let mut triangles = Vec::new();
/// square.for_each_triangle::<true>(Level::new(1)?, &mut |corners| triangles.push(corners));
/// assert_eq!(triangles.len(), 2 * 2 * 2);
/// let [a, b, c] = triangles[0].map(|v| v.position);
/// assert_eq!(a, Block::from_integers([0, 0, 0, 1]));
/// assert_eq!(b, Block::from_integers([3, 0, 0, 2]).scaled(-1)); // (1.5, 0, 0, 1)
/// assert_eq!(c, Block::from_integers([0, 3, 0, 2]).scaled(-1));
/// assert_eq!(triangles[0].map(|v| v.color), [[0], [128], [0]]); // 127.5 is rounded
/// let [x, y, z] = triangles[0][0].normal.mantissas();
/// assert!(x == 0 && y == 0 && z > 0);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct RectangularPatch<T, const K: usize> {
    /// Rows of four; s runs along a row, t from row to row.
    rows: [[ControlPoint<T, K>; 4]; 4],
}

impl<T: Word, const K: usize> RectangularPatch<T, K> {
    /// Four rows of four control points each: s runs along a row, t from row to row.
    pub fn new(points: [ControlPoint<T, K>; 16]) -> Self {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = points.map(ControlPoint::clamped);
        RectangularPatch {
            rows: [[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]],
        }
    }

    /// Calls `draw` with every triangle of the grid of 2^level × 2^level quads: of each quad with corners a (s, t),
    /// b (s+1, t), c (s, t+1), d (s+1, t+1) first a b c, then d c b; along s first. Both turn like s, then t.
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
        let grid = Grid::<T, K, NORMALS>::new(self, level);
        let mut near = grid.row(0);
        for j in 1..=level.pieces() {
            let far = grid.row(j);
            let (mut a, mut c) = (map(grid.vertex(&near, 0)), map(grid.vertex(&far, 0)));
            for i in 1..=level.pieces() {
                let (b, d) = (map(grid.vertex(&near, i)), map(grid.vertex(&far, i)));
                draw([a, b, c]);
                draw([d, c, b]);
                (a, c) = (b, d);
            }
            near = far;
        }
    }

    fn columns(&self) -> [[ControlPoint<T, K>; 4]; 4] {
        let [[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]] = self.rows;
        [[a, e, i, m], [b, f, j, n], [c, g, k, o], [d, h, l, p]]
    }
}

/// A patch at one level.
struct Grid<'a, T: Word, const K: usize, const NORMALS: bool> {
    patch: &'a RectangularPatch<T, K>,
    level: Level,
    exponent: i32,
    /// Column by column.
    positions: [[[T::Wide; 4]; 4]; 4],
    colors: [[[i64; K]; 4]; 4],
}

/// A row of the grid: the patch mixed along t, which leaves curves along s.
struct Row<T: Word, const K: usize> {
    j: u32,
    position: [[T::Wide; 4]; 4],
    color: [[i64; K]; 4],
    /// The patch mixed along t by de Casteljau up to the last pair.
    pair: [[[T::Wide; 4]; 4]; 2],
}

impl<'a, T: Word, const K: usize, const NORMALS: bool> Grid<'a, T, K, NORMALS> {
    fn new(patch: &'a RectangularPatch<T, K>, level: Level) -> Self {
        let [[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]] = patch.columns();
        let shared = Shared::new([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p], level);
        Grid {
            patch,
            level,
            exponent: shared.exponent,
            positions: by_column(shared.positions),
            colors: by_column(shared.colors),
        }
    }

    fn row(&self, j: u32) -> Row<T, K> {
        let weights = cubic(j, self.level);
        let bits = self.level.weight_bits();
        let position = self
            .positions
            .map(|column| mix(weights, column).map(|v| shift_rounded::<T>(v, bits)));
        let color = self
            .colors
            .map(|column| mix(weights, column).map(|v| shift_rounded::<i32>(v, bits)));
        let mut pair = [[[T::Wide::default(); 4]; 4]; 2];
        if NORMALS {
            let weights = quadratic(j, self.level);
            let mixed = |points| mix(weights, points).map(|v| shift_rounded::<T>(v, bits - bits / 3));
            pair = [
                self.positions.map(|[a, b, c, _]| mixed([a, b, c])),
                self.positions.map(|[_, b, c, d]| mixed([b, c, d])),
            ];
        }
        Row {
            j,
            position,
            color,
            pair,
        }
    }

    fn vertex(&self, row: &Row<T, K>, i: u32) -> PatchVertex<T, K> {
        let [top, .., bottom] = self.patch.rows;
        let [left, .., right] = self.patch.columns();
        let last = self.level.pieces();
        let point = match (i, row.j) {
            (_, 0) => on_curve(top, i, self.level),
            (_, j) if j == last => on_curve(bottom, i, self.level),
            (0, j) => on_curve(left, j, self.level),
            (_, j) if i == last => on_curve(right, j, self.level),
            _ => {
                let weights = cubic(i, self.level);
                ControlPoint {
                    position: position::<T>(mix(weights, row.position), self.exponent, self.level),
                    color: color(mix(weights, row.color)),
                }
            }
        };
        let normal = if NORMALS { self.normal(row, i) } else { Block::ZERO };
        PatchVertex::new(point, normal)
    }

    /// (Q11 − Q00) × (Q01 − Q10), of the last quad's corners Q(s, t).
    ///
    /// The corners are at most 2^(2·BITS + 2 − level), their differences twice that: no overflow.
    fn normal(&self, row: &Row<T, K>, i: u32) -> Block<T, 3> {
        let weights = quadratic(i, self.level);
        let [[q00, q10], [q01, q11]] = row
            .pair
            .map(|[a, b, c, d]| [mix(weights, [a, b, c]), mix(weights, [b, c, d])]);
        cross::<T>([difference([q11, q00]), difference([q01, q10])])
    }
}

fn by_column<P>([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p]: [P; 16]) -> [[P; 4]; 4] {
    [[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]]
}
