//! Bézier patches, cut into triangles by the core.

use fixel::num::Block;
use fixel::patch::{ControlPoint, Level, PatchVertex, RectangularPatch, TriangularPatch};

use crate::backend::{Patch, Vertex};
use crate::lower;

/// A point of a patch in object space.
type Point = PatchVertex<i64, 3>;

/// A patch of either kind, its colours lowered.
pub enum Lowered {
    /// Sixteen control points.
    Rectangular(Box<RectangularPatch<i64, 3>>),
    /// Ten control points.
    Triangular(Box<TriangularPatch<i64, 3>>),
}

impl Lowered {
    /// A patch, and the shift of its colours' unit.
    pub fn new(patch: Patch<'_>, finest: i32) -> (Self, i32) {
        match patch {
            Patch::Rectangular(points) => {
                let (points, shift) = control_points(points, finest);
                (Lowered::Rectangular(Box::new(RectangularPatch::new(points))), shift)
            }
            Patch::Triangular(points) => {
                let (points, shift) = control_points(points, finest);
                (Lowered::Triangular(Box::new(TriangularPatch::new(points))), shift)
            }
        }
    }

    /// Every triangle in order, its points passed through `map`; with normals only where they are asked for.
    pub fn for_each<V: Copy>(
        &self,
        level: Level,
        normals: bool,
        map: &mut impl FnMut(Point) -> V,
        draw: &mut impl FnMut([V; 3]),
    ) {
        match (self, normals) {
            (Lowered::Rectangular(patch), true) => patch.for_each_mapped::<true, V>(level, map, draw),
            (Lowered::Rectangular(patch), false) => patch.for_each_mapped::<false, V>(level, map, draw),
            (Lowered::Triangular(patch), true) => patch.for_each_mapped::<true, V>(level, map, draw),
            (Lowered::Triangular(patch), false) => patch.for_each_mapped::<false, V>(level, map, draw),
        }
    }
}

fn control_points<const N: usize>(points: &[Vertex; N], finest: i32) -> ([ControlPoint<i64, 3>; N], i32) {
    let lower::Channels { corners, shift } = lower::channels(points.map(|p| p.color), finest);
    let points = std::array::from_fn(|i| ControlPoint {
        position: position(&points[i]),
        color: corners[i],
    });
    (points, shift)
}

fn position(vertex: &Vertex) -> Block<i64, 4> {
    lower::block(vertex.position)
}
