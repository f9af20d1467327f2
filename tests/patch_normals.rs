//! Normals of Bézier patches: within what the bound on positions leaves of them.

mod patch_grids;
mod patch_points;

use fixel::num::{Block, Word};
use fixel::patch::ControlPoint;
use patch_grids::{Control, Grid, Point, rectangle_grid, triangle_grid};
use patch_points::TRIANGLE;
use proptest::prelude::*;

type Vector = [f64; 3];

fn float<T: Word, const C: usize>(block: Block<T, C>) -> [f64; C] {
    let scale = f64::powi(2.0, block.exponent());
    block.mantissas().map(|m| m.to_i64() as f64 * scale)
}

fn mixed(points: &[(f64, Vector)]) -> Vector {
    [0, 1, 2].map(|k| points.iter().map(|(w, p)| w * p[k]).sum())
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn length(v: Vector) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// The two vectors whose product is the normal, by de Casteljau's algorithm as written in hw2.md.
fn rectangle_vectors(points: &[Vector], s: f64, t: f64) -> [Vector; 2] {
    let mut net: Vec<Vec<Vector>> = points.chunks(4).map(<[Vector]>::to_vec).collect();
    while net.len() > 2 {
        let size = net.len() - 1;
        let next = |i: usize, j: usize| {
            mixed(&[
                ((1.0 - s) * (1.0 - t), net[j][i]),
                (s * (1.0 - t), net[j][i + 1]),
                ((1.0 - s) * t, net[j + 1][i]),
                (s * t, net[j + 1][i + 1]),
            ])
        };
        net = (0..size).map(|j| (0..size).map(|i| next(i, j)).collect()).collect();
    }
    [minus(net[1][1], net[0][0]), minus(net[1][0], net[0][1])]
}

fn triangle_vectors(points: &[Vector], s: f64, t: f64) -> [Vector; 2] {
    let mut rows: Vec<Vec<Vector>> = [0..4, 4..7, 7..9, 9..10].map(|r| points[r].to_vec()).to_vec();
    while rows.len() > 2 {
        let next = |i: usize, j: usize| mixed(&[(1.0 - s - t, rows[j][i]), (s, rows[j][i + 1]), (t, rows[j + 1][i])]);
        let size = rows.len() - 1;
        rows = (0..size).map(|j| (0..size - j).map(|i| next(i, j)).collect()).collect();
    }
    [minus(rows[0][1], rows[0][0]), minus(rows[1][0], rows[0][0])]
}

/// The largest angle (as a chord) between normals and those of float64, as a share of what the bound on the two vectors
/// allows.
fn normals_share<T: Word>(
    points: &[Control<T>],
    grid: &Grid<T>,
    n: u32,
    vectors: fn(&[Vector], f64, f64) -> [Vector; 2],
) -> f64 {
    let positions: Vec<_> = points
        .iter()
        .map(|p| float(p.position))
        .map(|[x, y, z, _]| [x, y, z])
        .collect();
    let bits = <T as Word>::BITS as i32;
    let guard = bits + 2 - 3 * n as i32;
    let top = points.iter().map(|p| p.position.exponent()).max().unwrap();
    let last_guard = f64::powi(2.0, top + 1 - guard).max(f64::powi(2.0, top + bits - 50));
    let relative = f64::powi(2.0, -bits.min(48));
    let mut worst = 0f64;
    for (j, row) in grid.iter().enumerate() {
        for (i, found) in row.iter().enumerate() {
            let place = |k: usize| k as f64 / (1 << n) as f64;
            let [a, b] = vectors(&positions, place(i), place(j));
            let expected = cross(a, b);
            let found = float(found.normal);
            // Each component of each vector is off by this at most; √3 for the vector, its rounding and the product's.
            let error = |v: Vector| 3f64.sqrt() * (relative * length(v) + last_guard);
            let off = error(a) * length(b) + error(b) * length(a) + 3f64.sqrt() * relative * length(expected);
            let bound = 2.0 * off / length(expected);
            if bound < 0.1 {
                let unit = |v: Vector| v.map(|c| c / length(v));
                worst = worst.max(length(minus(unit(found), unit(expected))) / bound);
            }
        }
    }
    worst
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn normals_agree_with_float64(
        places in prop::collection::vec(prop::array::uniform3(-100_000..100_000i32), 16),
        far in prop_oneof![Just(0), -1_000_000..1_000_000i32], n in prop_oneof![3 => 1..=4u32, 1 => 5..=8u32],
    ) {
        fn share<T: Word>(places: &[[i32; 3]], far: i32, n: u32) -> f64 {
            let control = |&[x, y, z]: &[i32; 3]| ControlPoint {
                position: Block::<T, 4>::from_integers([x + far, y, z - far, 1000]),
                color: [0; 3],
            };
            let points: Vec<_> = places.iter().map(control).collect();
            let rectangle = rectangle_grid(points.clone().try_into().unwrap(), n);
            let triangle = triangle_grid(points[..10].to_vec().try_into().unwrap(), n);
            let shares = [
                normals_share(&points, &rectangle, n, rectangle_vectors),
                normals_share(&points[..10], &triangle, n, triangle_vectors),
            ];
            shares[0].max(shares[1])
        }
        prop_assert!(share::<i32>(&places, far, n) <= 1.0);
        prop_assert!(share::<i64>(&places, far, n) <= 1.0);
    }
}

/// Normals point along ∂s × ∂t, and vanish where a row collapses with its neighbour.
#[test]
fn normals_point_the_right_way_and_may_be_zero() {
    let flat = |x: i32, y: i32| ControlPoint {
        position: Block::<i32, 4>::from_integers([x, y, 5, 1]),
        color: [0; 3],
    };
    let upwards = |v: &Point<i32>| {
        let [x, y, z] = v.normal.mantissas();
        x == 0 && y == 0 && z > 0
    };
    let square = core::array::from_fn(|k| flat(k as i32 % 4, k as i32 / 4));
    assert!(rectangle_grid(square, 3).iter().flatten().all(upwards));
    let triangle = TRIANGLE.map(|(i, j)| flat(i as i32, j as i32));
    assert!(triangle_grid(triangle, 3).iter().flatten().all(upwards));
    // A pole: the first row is one point, the second lies on a line through it.
    let pole = core::array::from_fn(|k| match k / 4 {
        0 => flat(0, 0),
        1 => flat(k as i32 % 4, 0),
        row => flat(k as i32 % 4, row as i32),
    });
    let grid = rectangle_grid(pole, 8);
    assert!(grid[0].iter().all(|v| v.normal.is_zero()));
    assert!(grid[1].iter().all(upwards));
    // Everything in one point.
    let point = [flat(3, 3); 16];
    assert!(rectangle_grid(point, 4).iter().flatten().all(|v| v.normal.is_zero()));
}
