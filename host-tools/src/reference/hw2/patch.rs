//! Points of Bézier patches by de Casteljau in float64 (formats/hw2.md section 8), and the triangles between them.

use crate::backend::{Patch, Vertex};
use crate::compare::stated::FIXED_PRODUCT;
use crate::reference::bound::size;
use crate::reference::matrix::{Vector, cross, length};

/// A point of a patch, before MV.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// x, y, z, w.
    pub position: Vector,
    /// Red, green, blue.
    pub color: [f64; 3],
    /// Perpendicular to the patch, of any length; none where that is 0.
    pub normal: Option<[f64; 3]>,
    /// The largest channel of all control points.
    pub brightest: f64,
    /// Bound of the distance of the core's position from this one.
    pub error: f64,
    /// Bound of the length of the difference of the core's normal from this one.
    pub normal_error: f64,
}

/// All points of a patch's grid.
pub struct Grid {
    triangular: bool,
    pieces: usize,
    /// Row by row; a triangular patch leaves one point more out of each.
    rows: Vec<Vec<Sample>>,
}

impl Grid {
    /// The patch cut into 2^level pieces on each side.
    pub fn new(patch: &Patch<'_>, level: u32) -> Self {
        let pieces = 1_usize << level;
        let (net, triangular) = match patch {
            Patch::Rectangular(points) => (Net::rectangular(points), false),
            Patch::Triangular(points) => (Net::triangular(points), true),
        };
        let parameter = |i: usize| i as f64 / pieces as f64;
        let row = |j: usize| {
            let last = if triangular { pieces - j } else { pieces };
            let sample = |i: usize| net.sample(triangular, parameter(i), parameter(j));
            (0..=last).map(sample).collect()
        };
        Self {
            triangular,
            pieces,
            rows: (0..=pieces).map(row).collect(),
        }
    }

    /// The grid with something made of every point, so that it is done once for the six triangles that share it.
    pub fn triangles<T: Copy>(&self, mut make: impl FnMut(&Sample) -> T, mut draw: impl FnMut([T; 3])) {
        let made: Vec<Vec<T>> = (self.rows.iter().map(|row| row.iter().map(&mut make).collect())).collect();
        for (near, far) in made.iter().zip(&made[1..]) {
            let last = if self.triangular { near.len() - 1 } else { self.pieces };
            for i in 0..last {
                draw([near[i], near[i + 1], far[i]]);
                if let Some(&opposite) = far.get(i + 1) {
                    draw([opposite, far[i], near[i + 1]]);
                }
            }
        }
    }
}

/// A position and a colour, which are mixed alike.
type Value = [f64; 7];

/// Columns of the widest net; row r of a net starts at r times this.
const STRIDE: usize = 4;

/// Rounding of de Casteljau in float64, against the largest control point: at most 6 mixes, each of (1 − s) a + s b costing
/// 2 · 2⁻⁵³ (three terms: 3 · 2⁻⁵³) of every component, twice that for the length; rounded up to 2⁻⁴⁸.
const CASTELJAU: f64 = 1.0 / (1u64 << 48) as f64;

/// Control points.
struct Net {
    values: [Value; 16],
    /// The length of the longest position.
    largest: f64,
    /// The largest channel.
    brightest: f64,
}

impl Net {
    fn rectangular(points: &[Vertex; 16]) -> Self {
        Self::new(points.iter().enumerate())
    }

    fn triangular(points: &[Vertex; 10]) -> Self {
        const PLACES: [usize; 10] = [0, 1, 2, 3, 4, 5, 6, 8, 9, 12];
        Self::new(PLACES.into_iter().zip(points))
    }

    fn new<'a>(points: impl Iterator<Item = (usize, &'a Vertex)>) -> Self {
        let mut net = Self {
            values: [[0.0; 7]; 16],
            largest: 0.0,
            brightest: 0.0,
        };
        for (place, vertex) in points {
            let ([x, y, z, w], [r, g, b]) = (vertex.position, vertex.color);
            net.values[place] = [x, y, z, w, r, g, b];
            net.largest = net.largest.max(size(&vertex.position));
            net.brightest = (vertex.color.iter()).fold(net.brightest, |most, c| most.max(c.abs()));
        }
        net
    }

    fn sample(&self, triangular: bool, s: f64, t: f64) -> Sample {
        let mut values = self.values;
        for side in [3, 2] {
            step(&mut values, triangular, side, s, t);
        }
        let corner = |place: usize| [values[place][0], values[place][1], values[place][2]];
        let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| a[i] - b[i]);
        // Q00, Q10 (one further along s), Q01 and Q11: the last quad; or A, B, C.
        let (q00, q10, q01, q11) = (corner(0), corner(1), corner(STRIDE), corner(STRIDE + 1));
        let (a, b) = if triangular {
            (minus(q10, q00), minus(q01, q00))
        } else {
            (minus(q11, q00), minus(q01, q10))
        };
        let normal = cross(a, b);
        step(&mut values, triangular, 1, s, t);
        let [x, y, z, w, r, g, blue] = values[0];
        let error = (CASTELJAU + FIXED_PRODUCT) * self.largest;
        let product = 4.0 * (f64::EPSILON + FIXED_PRODUCT) * length(a) * length(b);
        Sample {
            position: [x, y, z, w],
            color: [r, g, blue],
            normal: (normal != [0.0; 3]).then_some(normal),
            brightest: self.brightest,
            error,
            normal_error: 2.0 * error * (length(a) + length(b) + 2.0 * error) + product,
        }
    }
}

/// One round of de Casteljau: `side` quads (or upright triangles) a side, each mixed into its first corner.
fn step(values: &mut [Value; 16], triangular: bool, side: usize, s: f64, t: f64) {
    for row in 0..side {
        let last = if triangular { side - row } else { side };
        for at in row * STRIDE..row * STRIDE + last {
            let (a, b, c) = (values[at], values[at + 1], values[at + STRIDE]);
            // Sums of shares, which are the same from either end: patches that share a border share its points.
            values[at] = if triangular {
                std::array::from_fn(|i| (1.0 - s - t) * a[i] + s * b[i] + t * c[i])
            } else {
                let d = values[at + STRIDE + 1];
                let across = |a: f64, b: f64| (1.0 - s) * a + s * b;
                std::array::from_fn(|i| (1.0 - t) * across(a[i], b[i]) + t * across(c[i], d[i]))
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The control points at (column, row, height, 1), the colour the same.
    fn vertex(column: usize, row: usize, height: f64) -> Vertex {
        let (x, y) = (column as f64, row as f64);
        Vertex {
            position: [x, y, height, 1.0],
            color: [x, y, height],
            normal: None,
            texcoord: [0.0; 2],
        }
    }

    fn square(height: impl Fn(usize, usize) -> f64) -> [Vertex; 16] {
        std::array::from_fn(|k| vertex(k % 4, k / 4, height(k % 4, k / 4)))
    }

    fn triangle(height: impl Fn(usize, usize) -> f64) -> [Vertex; 10] {
        const ROWS: [usize; 10] = [0, 0, 0, 0, 1, 1, 1, 2, 2, 3];
        const COLUMNS: [usize; 10] = [0, 1, 2, 3, 0, 1, 2, 0, 1, 0];
        std::array::from_fn(|k| vertex(COLUMNS[k], ROWS[k], height(COLUMNS[k], ROWS[k])))
    }

    fn drawn(patch: &Patch<'_>, level: u32) -> Vec<[Sample; 3]> {
        let mut triangles = Vec::new();
        Grid::new(patch, level).triangles(|sample| *sample, |triangle| triangles.push(triangle));
        triangles
    }

    #[test]
    fn corners_are_control_points() {
        let bumpy = |x: usize, y: usize| (7 * x + 3 * y) as f64 * 0.1;
        let points = square(bumpy);
        let rows = Grid::new(&Patch::Rectangular(&points), 3).rows;
        for (row, column, point) in [(0, 0, 0), (0, 8, 3), (8, 0, 12), (8, 8, 15)] {
            assert_eq!(rows[row][column].position, points[point].position);
            assert_eq!(rows[row][column].color, points[point].color);
        }
        let points = triangle(bumpy);
        let rows = Grid::new(&Patch::Triangular(&points), 3).rows;
        for (row, column, point) in [(0, 0, 0), (0, 8, 3), (8, 0, 9)] {
            assert_eq!(rows[row][column].position, points[point].position);
        }
    }

    #[test]
    fn the_middle_by_hand() {
        // Bernstein's weights at ½ are 1, 3, 3, 1 over 8: only the inner four points are raised, by 16, so 16 · 36/64.
        let inner = |x: usize, y: usize| {
            if (1..3).contains(&x) && (1..3).contains(&y) {
                16.0
            } else {
                0.0
            }
        };
        let rows = Grid::new(&Patch::Rectangular(&square(inner)), 1).rows;
        let middle = rows[1][1];
        assert_eq!(middle.position, [1.5, 1.5, 9.0, 1.0]);
        assert_eq!(middle.color, [1.5, 1.5, 9.0]);
        let [x, y, z] = middle.normal.unwrap();
        assert!(x == 0.0 && y == 0.0 && z > 0.0, "along ∂s × ∂t");
        // At s = t = ¼ of a triangle the weight of its middle point is 6 · ½ · ¼ · ¼.
        let only = |x: usize, y: usize| if (x, y) == (1, 1) { 16.0 } else { 0.0 };
        let rows = Grid::new(&Patch::Triangular(&triangle(only)), 2).rows;
        assert_eq!(rows[1][1].position, [0.75, 0.75, 3.0, 1.0]);
    }

    #[test]
    fn a_symmetric_patch_gives_symmetric_points() {
        let hill = |x: usize, y: usize| [0.1, 0.7, 0.7, 0.1][x] * [0.3, 1.0, 1.0, 0.3][y];
        let rows = Grid::new(&Patch::Rectangular(&square(hill)), 4).rows;
        for (j, row) in rows.iter().enumerate() {
            for (i, sample) in row.iter().enumerate() {
                for mirrored in [&rows[j][16 - i], &rows[16 - j][i]] {
                    assert!((sample.position[2] - mirrored.position[2]).abs() < 1e-15);
                }
            }
        }
    }

    #[test]
    fn a_shared_border_is_shared_bit_by_bit() {
        let curve = [0.1, 0.7, -0.3, 1.0 / 3.0];
        let one = square(|x, y| if y == 0 { curve[x] } else { 2.0 });
        let other = triangle(|x, y| if y == 0 { curve[3 - x] } else { -1.0 });
        let last = 1 << 5;
        let one = Grid::new(&Patch::Rectangular(&one), 5).rows;
        let other = Grid::new(&Patch::Triangular(&other), 5).rows;
        for i in 0..=last {
            assert_eq!(
                one[0][i].position[2].to_bits(),
                other[0][last - i].position[2].to_bits(),
                "{i}"
            );
        }
    }

    #[test]
    fn triangles_turn_like_s_then_t_and_come_row_by_row() {
        let (square, triangle) = (square(|_, _| 0.0), triangle(|_, _| 0.0));
        for (patch, area) in [(Patch::Rectangular(&square), 9.0), (Patch::Triangular(&triangle), 4.5)] {
            let triangles = drawn(&patch, 2);
            assert_eq!(triangles.len() as u32, patch.triangles(2));
            let mut sum = 0.0;
            for [a, b, c] in &triangles {
                let side = |p: &Sample| [p.position[0] - a.position[0], p.position[1] - a.position[1], 0.0];
                let doubled = cross(side(b), side(c))[2];
                assert!(doubled > 0.0);
                sum += doubled / 2.0;
            }
            assert!((sum - area).abs() < 1e-12, "{sum}");
            let place = |k: usize, corner: usize| [0, 1].map(|i| triangles[k][corner].position[i] / 0.75);
            assert_eq!(
                [0, 1, 2].map(|corner| place(0, corner)),
                [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
            );
            assert_eq!(
                [0, 1, 2].map(|corner| place(1, corner)),
                [[1.0, 1.0], [0.0, 1.0], [1.0, 0.0]]
            );
            assert_eq!(place(2, 0), [1.0, 0.0]);
        }
    }

    #[test]
    fn a_normal_is_missing_only_where_it_is_0() {
        let line = std::array::from_fn(|k| vertex(k % 4, 0, 0.0));
        let samples = drawn(&Patch::Rectangular(&line), 1);
        assert!(samples.iter().flatten().all(|sample| sample.normal.is_none()));
        // A border drawn together to a point still has normals.
        let fan = std::array::from_fn(|k| {
            if k < 4 {
                vertex(0, 0, 1.0)
            } else {
                vertex(k % 4, k / 4, 0.0)
            }
        });
        let samples = drawn(&Patch::Rectangular(&fan), 1);
        assert!(samples.iter().flatten().all(|sample| sample.normal.is_some()));
    }
}
