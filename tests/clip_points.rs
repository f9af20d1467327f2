//! Where planes cut edges: near the true point, the same bits for both neighbours, never more corners than there is
//! room for.

mod exact;

use std::collections::BTreeSet;

use exact::{Exact, block, exacts};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::matrix::Matrix;
use fixel::num::{Block, Scaled, Word};
use fixel::screen::Shape;
use fixel::span::Corners;
use fixel::varying::Perspective;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use proptest::prelude::*;

/// A cut point lies within this many units of 2^-BITS of the true one, relative to the largest component of either end:
/// 4 as `clip` states it, and half a unit of rounding, twice because the scale of a homogeneous point is free.
const CUT_ERROR: i32 = 4;

type Point = [f64; 4];

/// The point where a→b meets the plane, up to scale, exactly: a·d_b − b·d_a.
fn true_cut<T: Word>(a: Block<T, 4>, b: Block<T, 4>, plane: Block<T, 4>) -> [Exact; 4] {
    let (d_a, d_b) = (distance(a, plane), distance(b, plane));
    let (a, b) = (exacts(a), exacts(b));
    std::array::from_fn(|i| &(&a[i] * &d_b) - &(&b[i] * &d_a))
}

fn distance<T: Word>(point: Block<T, 4>, plane: Block<T, 4>) -> Exact {
    let (point, plane) = (exacts(point), exacts(plane));
    point
        .iter()
        .zip(&plane)
        .fold(Exact::zero(), |sum, (p, n)| &sum + &(p * n))
}

/// Mantissas only: ends at the same scale, as the error is stated.
fn unscaled<T: Word>(point: Block<T, 4>) -> Block<T, 4> {
    point.scaled(-point.exponent())
}

fn largest(v: &[Exact; 4]) -> usize {
    (0..4)
        .reduce(|i, j| if v[i].clone().abs() < v[j].clone().abs() { j } else { i })
        .unwrap()
}

/// How far `found` is from the true cut of a→b, in units of 2^-BITS of the larger end: at the scale at which the true
/// cut is (a·d_b + b·d_a)/(d_a + d_b).
fn cut_error<T: Word>(found: Block<T, 4>, a: Block<T, 4>, b: Block<T, 4>, plane: Block<T, 4>) -> f64 {
    let (a, b) = (unscaled(a), unscaled(b));
    let truth = true_cut(a, b, plane);
    let weight = &distance(b, plane) - &distance(a, plane);
    let found = exacts(found);
    let k = largest(&found);
    // found · truth[k]/found[k] − truth, over weight: cross-multiplied.
    let worst = (0..4)
        .map(|i| (&(&found[i] * &truth[k]) - &(&truth[i] * &found[k])).abs())
        .reduce(Exact::max)
        .unwrap();
    worst.to_f64() / (found[k].to_f64() * weight.to_f64()).abs()
}

/// Clips to `planes` in eye space.
fn clip<T: Word, const N: usize>(
    points: [Block<T, 4>; 3],
    planes: &[Block<T, 4>],
) -> Vec<(Block<T, 4>, [Scaled<T>; 3])> {
    let mut list = Planes::<T, N>::default();
    planes.iter().for_each(|&p| list.push(p).unwrap());
    let polygon = list.clip(points);
    polygon
        .iter()
        .flat_map(|p| p.iter())
        .map(|c| (c.position, c.weights.split()))
        .collect()
}

/// What every clipped corner must be, whatever the word.
fn check_single_cut<T: Word>(points: [Point; 3], plane: Point) -> Result<f64, TestCaseError> {
    let (points, plane) = (points.map(block::<T, 4>), block::<T, 4>(plane));
    let outside = points.map(|p| distance(p, plane) < Exact::zero());
    let corners = clip::<T, 1>(points, &[plane]);
    let count = outside.iter().filter(|&&o| o).count();
    prop_assert_eq!(corners.len(), [3, 4, 3, 0][count]);
    let mut worst = 0f64;
    for (position, weights) in corners {
        if points.contains(&position) {
            continue;
        }
        // On the edge of the vertices that it is made of; a weight below the last place is 0.
        let edges = [(0, 1), (1, 2), (2, 0)]
            .into_iter()
            .filter(|&(i, j)| outside[i] != outside[j] && weights[3 - i - j].is_zero());
        worst = worst.max(
            edges
                .map(|(i, j)| cut_error(position, points[i], points[j], plane))
                .fold(f64::MAX, f64::min),
        );
        check_weights(position, weights, points)?;
    }
    prop_assert!(worst <= CUT_ERROR as f64, "off by {} units", worst);
    Ok(worst)
}

/// position = Σ weight · vertex, within `WEIGHTS` units of 2^-BITS of the largest weight times the largest vertex.
fn check_weights<T: Word>(
    position: Block<T, 4>,
    weights: [Scaled<T>; 3],
    points: [Block<T, 4>; 3],
) -> Result<(), TestCaseError> {
    // The distances' ratio is kept to BITS bits; each factor of a product, and the sum, are rounded to BITS bits.
    const WEIGHTS: i32 = 8;
    let (position, points) = (exacts(position), points.map(exacts));
    let size = |numbers: &[Exact]| numbers.iter().cloned().map(Exact::abs).reduce(Exact::max).unwrap();
    let weights = weights.map(Exact::of);
    let unit = &(&size(&weights) * &size(&points.concat())) * &Exact::new(WEIGHTS, -(T::BITS as i32));
    for i in 0..4 {
        let sum = (0..3).fold(Exact::zero(), |sum, k| &sum + &(&weights[k] * &points[k][i]));
        let error = (&sum - &position[i]).abs();
        prop_assert!(error <= unit, "off by {} of {}", error.to_f64(), unit.to_f64());
    }
    Ok(())
}

/// Coordinates of all sizes: mostly ordinary ones, some huge or tiny.
fn coordinate() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![4 => -10.0..10.0f64, 1 => -1e8..1e8f64, 1 => -1e-6..1e-6f64, 1 => (-9..9i32).prop_map(f64::from)]
}

fn point() -> impl Strategy<Value = Point> + Clone {
    prop::array::uniform4(coordinate()).prop_map(|[x, y, z, w]| {
        if [x, y, z, w] == [0.0; 4] {
            [0.0, 0.0, 0.0, 1.0]
        } else {
            [x, y, z, w]
        }
    })
}

/// Where the corners of what is drawn are that lie on the edge of the first two of `eye` (in any order), sorted; empty
/// where nothing is drawn. Vertices carry which one they are, so that a corner on the edge has nothing of the third.
fn on_the_edge<T: Word, W: Word>(
    view: &View<T, W, 3>,
    eye: [Block<T, 4>; 3],
    order: [usize; 3],
) -> BTreeSet<(i32, i32)> {
    let one = 1 << 30;
    let which = [[one, 0, 0], [0, one, 0], [0, 0, one]];
    let vertices = order.map(|i| Vertex {
        position: eye[i],
        carried: which[i],
    });
    let mut positions = BTreeSet::new();
    view.project::<Perspective<3>>(&vertices, |polygon| {
        let on_edge = (0..polygon.count()).filter(|&i| polygon.varying(i).over_w[2] == 0);
        positions.extend(on_edge.map(|i| polygon.position(i)));
    });
    positions
}

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]];

/// How a triangle is seen: the frustum's left and bottom, the user's planes, and the rules.
#[derive(Debug, Clone)]
struct Seen {
    corner: (f64, f64),
    planes: Vec<Point>,
    depth_range: DepthRange,
    behind: Behind,
}

fn seen() -> impl Strategy<Value = Seen> {
    let ranges = [DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited];
    let corner = (-2.0..-0.1f64, -2.0..-0.1f64);
    let planes = prop::collection::vec(prop::array::uniform4(-10.0..10.0f64), 0..4);
    let behind = prop::sample::select(&[Behind::Cut, Behind::Divide][..]);
    (corner, planes, prop::sample::select(ranges.to_vec()), behind).prop_map(|(corner, planes, depth_range, behind)| {
        Seen {
            corner,
            planes,
            depth_range,
            behind,
        }
    })
}

/// Two triangles on either side of the edge a–b, each with its corners in every order.
fn check_neighbours<T: Word, W: Word>(seen: &Seen, [a, b, c, d]: [Point; 4]) -> Result<(), TestCaseError> {
    let (left, bottom) = seen.corner;
    let mut planes = Planes::default();
    seen.planes.iter().for_each(|&p| planes.push(block(p)).unwrap());
    let view = View::<T, W, 3> {
        projection: Matrix::frustum([left, 1.0, bottom, 1.0, 0.5, 20.0].map(exact::scaled)).unwrap(),
        planes,
        viewport: Viewport::new(-7, 3, 640, 480).unwrap(),
        depth_range: seen.depth_range,
        behind: seen.behind,
        cull: Cull::Nothing,
    };
    let [a, b, c, d] = [a, b, c, d].map(block);
    let both = |&order: &[usize; 3]| [[a, b, c], [a, b, d]].map(|eye| on_the_edge(&view, eye, order));
    let mut found = ORDERS.iter().flat_map(both).filter(|positions| !positions.is_empty());
    if let Some(first) = found.next() {
        for other in found {
            // A part of what passes through infinity that has no area on the screen is left out, and its corners with it.
            let fewer = seen.behind == Behind::Divide && (other.is_subset(&first) || first.is_subset(&other));
            prop_assert!(
                other == first || fewer,
                "neighbours meet at different points: {:?}, {:?}",
                first,
                other
            );
        }
    }
    Ok(())
}

fn eye_point() -> impl Strategy<Value = Point> {
    (-10.0..10.0f64, -10.0..10.0f64, -15.0..5.0f64).prop_map(|(x, y, z)| [x, y, z, 1.0])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn cut_points_are_near_the_true_ones(points in prop::array::uniform3(point()), plane in point()) {
        check_single_cut::<i32>(points, plane)?;
        check_single_cut::<i64>(points, plane)?;
    }

    #[test]
    fn both_neighbours_of_an_edge_get_the_same_bits(seen in seen(), points in prop::array::uniform4(eye_point())) {
        check_neighbours::<i32, i32>(&seen, points)?;
        check_neighbours::<i64, i64>(&seen, points)?;
        check_neighbours::<i64, i32>(&seen, points)?;
    }

    /// Nearly the same plane 64 times, or 64 planes around: a corner more for each at most, and all of them kept.
    #[test]
    fn sixty_four_planes(
        points in prop::array::uniform3(eye_point()), plane in prop::array::uniform4(-10.0..10.0f64),
        spread in prop::sample::select(&[0.0, 1e-9, 1e-7, 1e-3, 1.0][..]), radius in 0.01..8.0f64,
    ) {
        let nearly = |i: usize| [0, 1, 2, 3].map(|k| plane[k] * (1.0 + spread * ((i * (k + 2) % 64) as f64 / 64.0 - 0.5)));
        let around = |i: usize| {
            let (sin, cos) = (i as f64 / 64.0 * std::f64::consts::TAU).sin_cos();
            [cos, sin, 0.0, radius]
        };
        for planes in [std::array::from_fn::<_, 64, _>(nearly), std::array::from_fn(around)] {
            let corners = clip::<i32, 64>(points.map(block), &planes.map(block));
            prop_assert!(corners.len() <= 3 + 64);
            let corners = clip::<i64, 64>(points.map(block), &planes.map(block));
            prop_assert!(corners.len() <= 3 + 64);
        }
    }
}

/// A triangle around a polygon of many sides keeps every side: the room for 3 + N corners is really needed, and there.
#[test]
fn every_plane_can_add_a_corner() {
    let corners = [
        [-100.0, -90.0, 0.0, 1.0],
        [100.0, -90.0, 0.0, 1.0],
        [0.0, 150.0, 0.0, 1.0],
    ];
    let side = |i: usize| {
        let (sin, cos) = (i as f64 / 61.0 * std::f64::consts::TAU).sin_cos();
        [cos, sin, 0.0, 10.0]
    };
    let planes: [Point; 61] = std::array::from_fn(side);
    assert_eq!(clip::<i64, 61>(corners.map(block), &planes.map(block)).len(), 61);
    // Cutting off the triangle's three corners only, a little more each time, adds one corner per plane.
    let tips = [[0.9, 0.436], [-0.9, 0.436], [0.0, -1.0]];
    let planes: [Point; 3] = std::array::from_fn(|i| [tips[i][0], tips[i][1], 0.0, 85.0]);
    assert_eq!(clip::<i32, 3>(corners.map(block), &planes.map(block)).len(), 6);
}

/// Nothing outside, nothing changed; nothing inside, nothing left.
#[test]
fn all_or_nothing() {
    let corners = [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]].map(Block::<i32, 4>::from_integers);
    let keeps = Block::from_integers([1, 1, 1, 0]);
    let kept = clip::<i32, 2>(corners, &[keeps, keeps]);
    assert_eq!(kept.iter().map(|c| c.0).collect::<Vec<_>>(), corners);
    assert!(clip::<i32, 1>(corners, &[keeps.negated()]).is_empty());
    // The plane through two corners: they are inside, and so is the edge between them.
    assert_eq!(clip::<i32, 1>(corners, &[Block::from_integers([0, 0, 1, 0])]).len(), 3);
}
