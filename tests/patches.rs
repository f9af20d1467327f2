//! Bézier patches: within their bound of exact, the same bits for everyone who shares a point, no cracks, no folds.

mod strict;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::matrix::Matrix;
use fixel::num::{Block, Scaled, Word};
use fixel::patch::{ControlPoint, Level, PatchVertex, RectangularPatch, TriangularPatch};
use fixel::target::Buffer;
use fixel::varying::Linear;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;
use strict::{Mark, StrictTarget};

type Control<T> = ControlPoint<T, 3>;
type Point<T> = PatchVertex<T, 3>;
/// `grid[j][i]`.
type Grid<T> = Vec<Vec<Point<T>>>;

/// Places of a triangular patch's control points.
const TRIANGLE: [(u32, u32); 10] = [
    (0, 0),
    (1, 0),
    (2, 0),
    (3, 0),
    (0, 1),
    (1, 1),
    (2, 1),
    (0, 2),
    (1, 2),
    (0, 3),
];

fn level(level: u32) -> Level {
    Level::new(level).unwrap()
}

/// Enters `found` at (i, j); every triangle must bring the same bits.
fn enter<T: Word>(grid: &mut [Vec<Option<Point<T>>>], (i, j): (u32, u32), found: Point<T>) {
    let place = &mut grid[j as usize][i as usize];
    assert!(place.is_none_or(|before| before == found), "({i}, {j})");
    *place = Some(found);
}

/// The grid of a patch from its triangles, whose order is checked with it.
fn rectangle_grid<T: Word>(points: [Control<T>; 16], n: u32) -> Grid<T> {
    let pieces = 1 << n;
    let mut grid = vec![vec![None; pieces as usize + 1]; pieces as usize + 1];
    let mut count = 0;
    RectangularPatch::new(points).for_each_triangle::<true>(level(n), &mut |triangle| {
        let (i, j) = (count / 2 % pieces, count / 2 / pieces);
        let places = match count % 2 {
            0 => [(i, j), (i + 1, j), (i, j + 1)],
            _ => [(i + 1, j + 1), (i, j + 1), (i + 1, j)],
        };
        places
            .into_iter()
            .zip(triangle)
            .for_each(|(place, vertex)| enter(&mut grid, place, vertex));
        count += 1;
    });
    assert_eq!(count, 2 * pieces * pieces);
    grid.into_iter()
        .map(|row| row.into_iter().collect::<Option<_>>().unwrap())
        .collect()
}

fn triangle_grid<T: Word>(points: [Control<T>; 10], n: u32) -> Grid<T> {
    let pieces = 1 << n;
    let mut grid = vec![vec![None; pieces as usize + 1]; pieces as usize + 1];
    let mut places = Vec::new();
    for j in 0..pieces {
        for i in 0..pieces - j {
            places.push([(i, j), (i + 1, j), (i, j + 1)]);
            if i + 1 < pieces - j {
                places.push([(i + 1, j + 1), (i, j + 1), (i + 1, j)]);
            }
        }
    }
    let mut expected = places.into_iter();
    TriangularPatch::new(points).for_each_triangle::<true>(level(n), &mut |triangle| {
        let places = expected.next().unwrap();
        places
            .into_iter()
            .zip(triangle)
            .for_each(|(place, vertex)| enter(&mut grid, place, vertex));
    });
    assert!(expected.next().is_none());
    grid.into_iter()
        .map(|row| row.into_iter().flatten().collect())
        .collect()
}

/// Bernstein's cubic weights times N³.
fn cubic(i: u32, pieces: u32) -> [i128; 4] {
    let (s, u) = (i128::from(i), i128::from(pieces - i));
    [u * u * u, 3 * u * u * s, 3 * u * s * s, s * s * s]
}

/// All weights at (i, j) in the order of the control points, times 2^(6·level) for both kinds.
fn rectangle_weights(i: u32, j: u32, pieces: u32) -> Vec<i128> {
    let (s, t) = (cubic(i, pieces), cubic(j, pieces));
    t.iter().flat_map(|t| s.map(|s| s * t)).collect()
}

fn triangle_weights(i: u32, j: u32, pieces: u32) -> Vec<i128> {
    let parts = [pieces - i - j, i, j].map(i128::from);
    let factorial = [1i128, 1, 2, 6];
    let weight = |&(a, b): &(u32, u32)| {
        let powers = [3 - a - b, a, b];
        let chosen = powers.iter().fold(6, |n, &p| n / factorial[p as usize]);
        let product: i128 = parts.iter().zip(powers).map(|(v, p)| v.pow(p)).product();
        product * chosen * i128::from(pieces).pow(3)
    };
    TRIANGLE.iter().map(weight).collect()
}

/// How far a grid is from exact, as shares of the stated bounds of positions and colours.
fn shares_of_bounds<T: Word>(
    points: &[Control<T>],
    grid: &Grid<T>,
    n: u32,
    weights: fn(u32, u32, u32) -> Vec<i128>,
) -> (f64, f64) {
    let pieces = 1 << n;
    let bits = <T as Word>::BITS as i32;
    let guard = bits + 2 - 3 * n as i32;
    let nonzero = || points.iter().map(|p| p.position).filter(|p| !p.is_zero());
    let top = nonzero().map(|p| p.exponent()).max().unwrap_or(0);
    let bottom = nonzero().map(|p| p.exponent()).min().unwrap_or(0);
    // Every number here is a multiple of 2^base, and below 2^(126 + base).
    let base = (bottom - 6 * n as i32).min(top - bits - 2);
    let shifted = |m: i64, exponent: i32| {
        let m = i128::from(m);
        match exponent - base {
            _ if m == 0 => 0,
            up @ 0.. => m << up,
            down => {
                assert_eq!(m & ((1 << -down) - 1), 0);
                m >> -down
            }
        }
    };
    let (mut worst, mut worst_color) = (0f64, 0f64);
    for (j, row) in grid.iter().enumerate() {
        for (i, found) in row.iter().enumerate() {
            let weights = weights(i as u32, j as u32, pieces);
            assert_eq!(weights.iter().sum::<i128>(), 1 << (6 * n));
            let place = found.position.exponent();
            let last_place = if found.position.is_zero() {
                0.0
            } else {
                f64::powi(2.0, place - base)
            };
            let bound = last_place / 2.0 + f64::powi(2.0, top - guard - base);
            for k in 0..4 {
                let exact: i128 = points
                    .iter()
                    .zip(&weights)
                    .map(|(p, w)| w * shifted(p.position.mantissas()[k].to_i64(), p.position.exponent() - 6 * n as i32))
                    .sum();
                let error = (shifted(found.position.mantissas()[k].to_i64(), place) - exact).abs() as f64;
                worst = worst.max(error / bound);
            }
            for k in 0..3 {
                let exact: i128 = points
                    .iter()
                    .zip(&weights)
                    .map(|(p, w)| w * i128::from(p.color[k]))
                    .sum();
                let error = ((i128::from(found.color[k]) << (6 * n)) - exact).abs() as f64;
                let bound = 0.5 + f64::powi(2.0, 3 * n as i32 - 32);
                worst_color = worst_color.max(error / f64::powi(2.0, 6 * n as i32) / bound);
                let colors = || points.iter().map(|p| p.color[k]);
                assert!(colors().min() <= Some(found.color[k]) && Some(found.color[k]) <= colors().max());
            }
        }
    }
    (worst, worst_color)
}

/// Any mantissas, small ones too, with scales up to 2^`gap` apart.
fn control<T: Word>(gap: i32) -> impl Strategy<Value = Control<T>> {
    let word = |shift: u32| any::<i64>().prop_map(move |m| T::from_q62((m >> 1).max(-(1 << 62))) >> shift);
    let position = (0..20u32).prop_flat_map(move |shift| prop::array::uniform4(word(shift)));
    let channel = -(1i32 << 30)..=1 << 30;
    (position, -gap / 2..=gap / 2, prop::array::uniform3(channel)).prop_map(|(m, exponent, color)| ControlPoint {
        // Not renormalised upwards: keep the scale where it was asked for.
        position: Block::new(m, exponent),
        color,
    })
}

/// The sixteen or ten control points of a patch; scales at most `gap` bits apart after normalising.
fn controls<T: Word, const N: usize>(gap: i32) -> impl Strategy<Value = [Control<T>; N]> {
    prop::collection::vec(control::<T>(gap), N)
        .prop_map(|v| v.try_into().unwrap())
        .prop_filter("scales too far apart for exact sums", |points: &[Control<T>; N]| {
            let exponents = points
                .iter()
                .filter(|p| !p.position.is_zero())
                .map(|p| p.position.exponent());
            let spread = exponents.clone().max().unwrap_or(0) - exponents.min().unwrap_or(0);
            spread <= 14 || <T as Word>::BITS == 30 && spread <= 40
        })
}

fn within_bounds<T: Word>(rectangle: [Control<T>; 16], triangle: [Control<T>; 10], n: u32) {
    let shares = [
        shares_of_bounds(&rectangle, &rectangle_grid(rectangle, n), n, rectangle_weights),
        shares_of_bounds(&triangle, &triangle_grid(triangle, n), n, triangle_weights),
    ];
    for (position, color) in shares {
        assert!(position <= 1.0, "{position} of the bound of a position");
        assert!(color <= 1.0, "{color} of the bound of a colour");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn narrow_patches_are_within_their_bound(r in controls::<i32, 16>(24), t in controls::<i32, 10>(24), n in 1..=5u32) {
        within_bounds(r, t, n);
    }

    #[test]
    fn wide_patches_are_within_their_bound(r in controls::<i64, 16>(4), t in controls::<i64, 10>(4), n in 1..=5u32) {
        within_bounds(r, t, n);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn deep_patches_are_within_their_bound(
        r in controls::<i32, 16>(24), t in controls::<i32, 10>(24),
        wide_r in controls::<i64, 16>(4), wide_t in controls::<i64, 10>(4), n in 6..=8u32,
    ) {
        within_bounds(r, t, n);
        within_bounds(wide_r, wide_t, n);
    }
}

/// A patch with decimal coordinates: the largest error found, in last places of the largest coordinate.
#[test]
fn measured_error() {
    fn worst<T: Word>(n: u32) -> (f64, f64) {
        let coordinate = |k: i32| Scaled::<T>::from_integer(k * 7919 % 2001 - 1000).over(Scaled::from_integer(700));
        let one = Some(Scaled::from_integer(1));
        let points: [Control<T>; 16] = core::array::from_fn(|k| {
            let k = k as i32;
            let position = [coordinate(3 * k + 1), coordinate(3 * k + 2), coordinate(3 * k + 3), one];
            ControlPoint {
                position: Block::gather(position.map(Option::unwrap)),
                color: [k << 20, -k << 22, k * k],
            }
        });
        let grid = rectangle_grid(points, n);
        let exact_points = points.map(|p| p.position);
        let top = exact_points.iter().map(|p| p.exponent()).max().unwrap();
        let mut worst = 0f64;
        for (j, row) in grid.iter().enumerate() {
            for (i, found) in row.iter().enumerate() {
                let weights = rectangle_weights(i as u32, j as u32, 1 << n);
                for k in 0..4 {
                    // In units of 2^(top − 2 − 48): mantissas of 62 bits, gaps of 2, weights of 48.
                    let base = top - 2 - 6 * n as i32;
                    let sum: i128 = exact_points
                        .iter()
                        .zip(&weights)
                        .map(|(p, w)| (w * i128::from(p.mantissas()[k].to_i64())) << (p.exponent() - (top - 2)))
                        .sum();
                    let found =
                        (i128::from(found.position.mantissas()[k].to_i64())) << (found.position.exponent() - base);
                    worst = worst.max((found - sum).abs() as f64 * f64::powi(2.0, base - top));
                }
            }
        }
        let (_, color) = shares_of_bounds(&points, &grid, n, rectangle_weights);
        (worst, color)
    }
    for n in [1, 5, 8] {
        let ((narrow, color), (wide, _)) = (worst::<i32>(n), worst::<i64>(n));
        println!("level {n}: {narrow:.4} last places (32 bit), {wide:.4} (64 bit), colours {color:.4} of their bound");
        assert!(narrow <= 0.5 + 1.0 / 256.0 && wide <= 0.5001);
    }
}

/// The four sides of a rectangular grid and the three of a triangular one, as places of their control points and of their
/// grid points.
fn sides_of_rectangle(last: usize) -> [Vec<(usize, usize)>; 4] {
    let along = |f: fn(usize, usize) -> (usize, usize)| (0..=last).map(|k| f(k, last)).collect();
    [
        along(|k, _| (k, 0)),
        along(|k, last| (k, last)),
        along(|k, _| (0, k)),
        along(|k, last| (last, k)),
    ]
}

fn sides_of_triangle(last: usize) -> [Vec<(usize, usize)>; 3] {
    let along = |f: fn(usize, usize) -> (usize, usize)| (0..=last).map(|k| f(k, last)).collect();
    [
        along(|k, _| (k, 0)),
        along(|k, _| (0, k)),
        along(|k, last| (last - k, k)),
    ]
}

/// Every side of both kinds of patch, in both directions, with the same four control points and others at scales far
/// away: the very same bits.
fn borders_agree<T: Word>(border: [Control<T>; 4], r: [Control<T>; 16], t: [Control<T>; 10], n: u32) {
    let last = 1usize << n;
    let mut found: Vec<Vec<(Block<T, 4>, [i32; 3])>> = Vec::new();
    let mut record = |grid: Grid<T>, side: &[(usize, usize)], backwards: bool| {
        let mut points: Vec<_> = side
            .iter()
            .map(|&(i, j)| (grid[j][i].position, grid[j][i].color))
            .collect();
        if backwards {
            points.reverse();
        }
        found.push(points);
    };
    for backwards in [false, true] {
        let mut shared = border;
        if backwards {
            shared.reverse();
        }
        for (ends, side) in sides_of_rectangle(3).iter().zip(sides_of_rectangle(last)) {
            let mut points = r;
            ends.iter().zip(shared).for_each(|(&(i, j), p)| points[4 * j + i] = p);
            record(rectangle_grid(points, n), &side, backwards);
        }
        for (ends, side) in sides_of_triangle(3).iter().zip(sides_of_triangle(last)) {
            let mut points = t;
            for (&(i, j), p) in ends.iter().zip(shared) {
                let index = TRIANGLE.iter().position(|&place| place == (i as u32, j as u32));
                points[index.unwrap()] = p;
            }
            record(triangle_grid(points, n), &side, backwards);
        }
    }
    assert_eq!(found.len(), 14);
    assert!(found.iter().all(|points| points == &found[0]));
    assert_eq!(found[0][0], (border[0].position, border[0].color));
    assert_eq!(found[0][last], (border[3].position, border[3].color));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn shared_borders_have_the_same_bits(
        border in prop::array::uniform4(control::<i32>(20)), n in 1..=5u32,
        r in prop::collection::vec(control::<i32>(60), 16), t in prop::collection::vec(control::<i32>(60), 10),
    ) {
        borders_agree(border, r.try_into().unwrap(), t.try_into().unwrap(), n);
    }

    #[test]
    fn shared_borders_of_wide_words_have_the_same_bits(
        border in prop::array::uniform4(control::<i64>(70)), n in 1..=4u32,
        r in prop::collection::vec(control::<i64>(200), 16), t in prop::collection::vec(control::<i64>(200), 10),
    ) {
        borders_agree(border, r.try_into().unwrap(), t.try_into().unwrap(), n);
    }

    /// Nothing overflows, whatever the scales; values beyond ±2^30 are taken as ±2^30.
    #[test]
    fn any_numbers(
        mantissas in prop::collection::vec(prop::array::uniform4(any::<i32>()), 16),
        exponents in prop::collection::vec(prop_oneof![any::<i32>(), Just(i32::MAX), Just(i32::MIN), -9..9i32], 16),
        colors in prop::collection::vec(prop::array::uniform3(prop_oneof![any::<i32>(), Just(i32::MIN)]), 16),
        n in prop_oneof![1..=3u32, 1..=8u32],
    ) {
        fn points<T: Word>(m: &[[i32; 4]], e: &[i32], c: &[[i32; 3]]) -> Vec<Control<T>> {
            let all = m.iter().zip(e).zip(c);
            all.map(|((m, &e), &color)| ControlPoint { position: Block::new(m.map(T::from_i32), e), color }).collect()
        }
        let narrow = points::<i32>(&mantissas, &exponents, &colors);
        let wide = points::<i64>(&mantissas, &exponents, &colors);
        let limit = 1 << 30;
        for row in rectangle_grid::<i32>(narrow.clone().try_into().unwrap(), n) {
            prop_assert!(row.iter().all(|p| p.color.iter().all(|&v| (-limit..=limit).contains(&v))));
        }
        triangle_grid::<i32>(narrow[..10].to_vec().try_into().unwrap(), n);
        rectangle_grid::<i64>(wide.clone().try_into().unwrap(), n);
        triangle_grid::<i64>(wide[..10].to_vec().try_into().unwrap(), n);
    }
}

/// Without normals and colours, and mapped, the positions stay the same.
#[test]
fn what_is_not_asked_for_changes_nothing() {
    let bump = |k: i32| ControlPoint {
        position: Block::<i32, 4>::from_integers([k % 4 * 9, k / 4 * 7 + k % 3, k * k, 1]),
        color: [k, k << 20, -k],
    };
    let bare = |p: Control<i32>| ControlPoint {
        position: p.position,
        color: [],
    };
    let square: [_; 16] = core::array::from_fn(|k| bump(k as i32));
    let triangle: [_; 10] = core::array::from_fn(|k| bump(k as i32));
    let (mut full, mut less, mut mapped) = (Vec::new(), Vec::new(), Vec::new());
    for n in 1..=3 {
        let (whole, plain) = (RectangularPatch::new(square), RectangularPatch::new(square.map(bare)));
        whole.for_each_triangle::<true>(level(n), &mut |t| full.push(t.map(|v| v.position)));
        plain.for_each_triangle::<false>(level(n), &mut |t| {
            assert!(t.iter().all(|v| v.normal.is_zero()));
            less.push(t.map(|v| v.position));
        });
        whole.for_each_mapped::<false, _>(level(n), &mut |v| v.position, &mut |t| mapped.push(t));
        let (whole, plain) = (TriangularPatch::new(triangle), TriangularPatch::new(triangle.map(bare)));
        whole.for_each_triangle::<true>(level(n), &mut |t| full.push(t.map(|v| v.position)));
        plain.for_each_triangle::<false>(level(n), &mut |t| {
            assert!(t.iter().all(|v| v.normal.is_zero()));
            less.push(t.map(|v| v.position));
        });
        whole.for_each_mapped::<false, _>(level(n), &mut |v| v.position, &mut |t| mapped.push(t));
    }
    assert_eq!(full, less);
    assert_eq!(full, mapped);
}

#[test]
fn levels_are_checked() {
    assert_eq!(Level::new(0), Err(Error::SubdivisionLevel));
    assert_eq!(Level::new(9), Err(Error::SubdivisionLevel));
    assert_eq!(Level::new(256 + 3), Err(Error::SubdivisionLevel));
    assert_eq!(
        (1..=8).map(|n| level(n).pieces()).collect::<Vec<_>>(),
        [2, 4, 8, 16, 32, 64, 128, 256]
    );
}

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

const SIZE: (u16, u16) = (100, 80);

/// x and y straight to the screen: −1…1 is the whole picture.
fn straight<T: Word>() -> View<T, i32, 0> {
    View {
        projection: Matrix::identity(),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, SIZE.0, SIZE.1).unwrap(),
        depth_range: DepthRange::Unlimited,
        behind: Behind::Divide,
        cull: Cull::Nothing,
    }
}

fn target() -> StrictTarget {
    StrictTarget::new(Window::new(0, 0, SIZE.0.into(), SIZE.1.into()), false)
}

/// Draws flat triangles, and gives the corners that come to it.
fn plot<'a, T: Word>(
    view: &'a View<T, i32, 0>,
    target: &'a mut StrictTarget,
    mark: u8,
) -> impl FnMut([PatchVertex<T, 0>; 3]) + 'a {
    move |triangle| {
        let corners = triangle.map(|v| Vertex {
            position: v.position,
            carried: (),
        });
        draw::primitive(view, target, &mut NoDepth, &corners, &Mark(mark));
    }
}

/// A control point at (x, y) thousandths, with any w.
fn on_plane<T: Word>(x: i32, y: i32, w: i32) -> ControlPoint<T, 0> {
    ControlPoint {
        position: Block::from_integers([x * w, y * w, 0, 1000 * w]),
        color: [],
    }
}

/// Two patches side by side with a curved border between them fill the picture: every pixel exactly once, at every level,
/// for rectangles and triangles, whatever w.
fn tiles_the_picture<T: Word>(wiggle: [i32; 4], weights: [i32; 5], n: u32) {
    // Columns −1000, −333, 333, 1000 of the left patch end at the border; the border's inner points wander.
    let middle = |row: usize| if row == 0 || row == 3 { 0 } else { wiggle[row - 1] };
    let rows = [-1000, -333, 333, 1000];
    let w = |i: usize, j: usize| weights[(i * 7 + j * 3) % 5];
    let left: [_; 16] = core::array::from_fn(|k| {
        let (i, j) = (k % 4, k / 4);
        let x = -1000 + (middle(j) + 1000) * i as i32 / 3;
        on_plane(x, rows[j], w(i, j))
    });
    // The right patch has t along x instead, from the border on, and s backwards.
    let right: [_; 16] = core::array::from_fn(|k| {
        let (i, j) = (k / 4, 3 - k % 4);
        let x = middle(j) + (1000 - middle(j)) * i as i32 / 3;
        on_plane(x, rows[j], w(3 + i, j))
    });
    let view = straight::<T>();
    let mut picture = target();
    RectangularPatch::new(left).for_each_triangle::<false>(level(n), &mut plot(&view, &mut picture, b'l'));
    RectangularPatch::new(right).for_each_triangle::<false>(level(n), &mut plot(&view, &mut picture, b'r'));
    let census = picture.census();
    assert_eq!(
        census.get(&'.'),
        None,
        "rectangles at level {n}, {wiggle:?}, {weights:?}"
    );

    // Two triangles with a wiggling diagonal: from the lower left to the upper right.
    let diagonal = |k: usize| {
        let along = -1000 + 2000 * k as i32 / 3;
        let off = if k == 0 || k == 3 { 0 } else { wiggle[k + 1] / 2 };
        (along + off, -along + off)
    };
    let place = |i: u32, j: u32, corner: i32| {
        let (i, j) = (i as usize, j as usize);
        if i + j == 3 {
            let (x, y) = diagonal(i);
            return on_plane(x, y, weights[i]);
        }
        let (x, y) = (-1000 + 2000 * i as i32 / 3, -1000 + 2000 * j as i32 / 3);
        on_plane(x * corner, y * corner, w(i, j))
    };
    let upper = TRIANGLE.map(|(i, j)| place(i, j, 1));
    // Turned by half a turn; its diagonal is the other's, from the other end.
    let lower = TRIANGLE.map(|(i, j)| if i + j == 3 { place(j, i, 1) } else { place(i, j, -1) });
    let mut picture = target();
    TriangularPatch::new(upper).for_each_triangle::<false>(level(n), &mut plot(&view, &mut picture, b'u'));
    TriangularPatch::new(lower).for_each_triangle::<false>(level(n), &mut plot(&view, &mut picture, b'v'));
    let census = picture.census();
    assert_eq!(
        census.get(&'.'),
        None,
        "triangles at level {n}, {wiggle:?}, {weights:?}"
    );
}

#[test]
fn patches_at_level_8_have_no_cracks() {
    for n in 1..=8 {
        tiles_the_picture::<i32>([200, -150, 180, -120], [10, 12, 9, 11, 13], n);
        tiles_the_picture::<i64>([200, -150, 180, -120], [10, 12, 9, 11, 13], n);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn neighbours_have_no_cracks(
        wiggle in prop::array::uniform4(-180..180i32), weights in prop::array::uniform5(20..24i32), n in 1..=8u32,
    ) {
        tiles_the_picture::<i32>(wiggle, weights, n);
    }
}

/// Pixels that nothing was drawn on and that cannot be reached from the picture's border.
fn holes(picture: &[String]) -> usize {
    let mut cells: Vec<Vec<u8>> = picture.iter().map(|row| row.bytes().collect()).collect();
    let (width, height) = (cells[0].len(), cells.len());
    let mut open: Vec<(usize, usize)> = (0..width)
        .flat_map(|x| [(x, 0), (x, height - 1)])
        .chain((0..height).flat_map(|y| [(0, y), (width - 1, y)]))
        .collect();
    while let Some((x, y)) = open.pop() {
        if cells[y][x] == b'.' {
            cells[y][x] = b' ';
            open.extend((x > 0).then(|| (x - 1, y)));
            open.extend((y > 0).then(|| (x, y - 1)));
            open.extend((x + 1 < width).then_some((x + 1, y)));
            open.extend((y + 1 < height).then_some((x, y + 1)));
        }
    }
    cells.iter().flatten().filter(|&&c| c == b'.').count()
}

/// Hills in perspective at level 8, seen so steeply that nothing folds: no pixel twice, no holes; cut by the near plane and
/// the picture's sides, too.
#[test]
fn hills_in_perspective() {
    fn draw<T: Word>(near: i32) -> Vec<String> {
        let view = View::<T, i32, 0> {
            projection: Matrix::frustum([-4, 4, -3, 3, near, 100].map(Scaled::from_integer)).unwrap(),
            depth_range: DepthRange::MinusOneToOne,
            behind: Behind::Cut,
            ..straight()
        };
        let hill = |i: u32, j: u32| ControlPoint {
            position: Block::from_integers([
                i as i32 * 4 - 6,
                j as i32 * 3 - 4,
                -9 + (i * j % 3) as i32 * 2 - j as i32,
                1,
            ]),
            color: [],
        };
        let mut picture = target();
        let square = RectangularPatch::new(core::array::from_fn(|k| hill(k as u32 % 4, k as u32 / 4)));
        square.for_each_triangle::<false>(level(8), &mut plot(&view, &mut picture, b'q'));
        let drawn = picture.picture();
        let mut picture = target();
        let triangle = TriangularPatch::new(TRIANGLE.map(|(i, j)| hill(i, j)));
        triangle.for_each_triangle::<false>(level(8), &mut plot(&view, &mut picture, b't'));
        drawn
            .into_iter()
            .chain([".".repeat(SIZE.0.into())])
            .chain(picture.picture())
            .collect()
    }
    for near in [5, 8, 9] {
        let (narrow, wide) = (draw::<i32>(near), draw::<i64>(near));
        let count = narrow.concat().bytes().filter(|&c| c != b'.').count();
        println!("near {near}: {count} pixels");
        assert!(count > 3000, "only {count} pixels");
        assert_eq!(holes(&narrow), 0, "{}", narrow.join("\n"));
        assert_eq!(holes(&wide), 0);
        let different = narrow
            .concat()
            .bytes()
            .zip(wide.concat().bytes())
            .filter(|(a, b)| a != b)
            .count();
        assert!(different <= 2, "{different}");
    }
}

/// Stores its colours.
struct Colors;

impl Fragment for Colors {
    type Varying = Linear<3>;
    type Pixel = Option<[i32; 3]>;
    fn shade(&self, values: [i32; 3], _: Self::Pixel) -> Option<Self::Pixel> {
        Some(Some(values))
    }
}

/// Gouraud patches far outside 0…255 levels: a square whose colours are linear in x and y has them at every pixel.
#[test]
fn colours_outside_the_range_are_kept() {
    let view = straight::<i32>();
    // Levels at (x, y) pixels: −300 + 9·x; 700 − 10·y; 20·x − 15·y.
    let exact = |x: f64, y: f64| [9.0 * x - 300.0, 700.0 - 10.0 * y, 20.0 * x - 15.0 * y];
    let control = |i: i32, j: i32| {
        let colors = exact(f64::from(i) * 100.0 / 3.0, f64::from(j) * 80.0 / 3.0);
        ControlPoint {
            position: Block::<i32, 4>::from_integers([2 * i - 3, 2 * j - 3, 0, 3]),
            color: colors.map(|c| (c * 65536.0).round() as i32),
        }
    };
    let mut picture = vec![None; 8000];
    let mut target = Buffer::new(&mut picture, SIZE.0, SIZE.1).unwrap();
    let mut draw = |triangle: [Point<i32>; 3]| {
        let corners = triangle.map(|v| Vertex {
            position: v.position,
            carried: v.color,
        });
        draw::primitive(&view, &mut target, &mut NoDepth, &corners, &Colors);
    };
    // The upper left half from a triangle, then the whole from a square at a coarser level.
    TriangularPatch::new(TRIANGLE.map(|(i, j)| control(i as i32, j as i32)))
        .for_each_triangle::<true>(level(8), &mut draw);
    let half: Vec<_> = target_pixels(&picture);
    assert!((3900..4200).contains(&half.len()));
    let mut target = Buffer::new(&mut picture, SIZE.0, SIZE.1).unwrap();
    let square = RectangularPatch::new(core::array::from_fn(|k| control(k as i32 % 4, k as i32 / 4)));
    square.for_each_triangle::<true>(level(5), &mut |triangle| {
        let corners = triangle.map(|v| Vertex {
            position: v.position,
            carried: v.color,
        });
        draw::primitive(&view, &mut target, &mut NoDepth, &corners, &Colors);
    });
    let whole: Vec<_> = target_pixels(&picture);
    assert_eq!(whole.len(), 8000);
    let mut worst = 0f64;
    for (x, y, found) in half.into_iter().chain(whole) {
        for (found, exact) in found.iter().zip(exact(x, y)) {
            worst = worst.max((f64::from(*found) / 65536.0 - exact).abs());
        }
    }
    // Grid points fall on subpixels here, so that snapping moves nothing.
    println!("largest error of a colour: {worst:.1e} levels");
    assert!(worst < 0.01);
}

fn target_pixels(picture: &[Option<[i32; 3]>]) -> Vec<(f64, f64, [i32; 3])> {
    let place = |k: usize| ((k % 100) as f64, (k / 100) as f64);
    let drawn = picture.iter().enumerate().filter_map(|(k, c)| c.map(|c| (k, c)));
    drawn.map(|(k, c)| (place(k).0, place(k).1, c)).collect()
}
