//! Triangles and clip planes: chapters 03 and 04.

mod course;

use std::f64::consts::TAU;

use course::{
    SIDE, Vertex, all_near, at, block, buffer, draw, lit, near, picture, pixel, program, real, square, state,
};
use course::{triangles_hit, unit};
use fixel::clip::Planes;
use fixel::depth::NoDepth;
use fixel::num::Block;
use fixel::pipeline::{self, clip_line, clip_polygon, plane_distance};
use fixel::span::doubled_area;
use heapless::Vec as Room;

const CORNERS: [(f64, f64); 3] = [(10.0, 10.0), (290.0, 10.0), (20.0, 150.0)];

/// E in square pixels: the core's is in square subpixels, and positive where rows run the other way.
fn edge(a: (f64, f64), b: (f64, f64), p: (f64, f64)) -> f64 {
    let fine = |(x, y): (f64, f64)| ((x * 256.0).round() as i32, (y * 256.0).round() as i32);
    -doubled_area(&[fine(a), fine(b), fine(p)]) as f64 / 65536.0
}

#[test]
fn item_03_1_edge_function() {
    let [a, b, c] = CORNERS;
    assert_eq!(edge(a, b, c), 39200.0);
    assert_eq!(edge(a, c, b), -39200.0);
}

/// The weights arrive as what is 1 at one corner and 0 at the others, with either winding.
#[test]
fn item_03_2_weights_of_a_point() {
    for turned in [false, true] {
        let [a, b, c] = [0, 1, 2].map(|i| {
            let mut values = [0; 3];
            values[i] = unit(1.0);
            at(CORNERS[i], values)
        });
        let vertices = if turned { [a, c, b] } else { [a, b, c] };
        let mut seen = picture(course::Seen::default());
        let weights = program(|_, [u, v, w]: [i32; 3]| Some(course::Seen(u, v, w, 1)));
        draw(&state(), &mut buffer(&mut seen), &mut NoDepth, &weights, &vertices);
        let course::Seen(u, v, w, _) = pixel(&seen, 100, 50);
        all_near([u, v, w].map(real), [0.397832, 0.312883, 0.289286], 1e-5);
        near(real(u) + real(v) + real(w), 1.0, 1e-6);
        // (200.5, 100.5) is outside.
        assert_eq!(pixel(&seen, 200, 100).3, 0);
    }
    let [a, b, c] = CORNERS;
    near(edge(b, c, (200.5, 100.5)) / edge(a, b, c), -0.303699, 1e-6);
}

#[test]
fn item_03_3_samples_at_centers_within_the_bounding_box() {
    let corners = [(-10.0, -40.0), (100.0, 40.0), (120.0, 400.0)];
    let drawn = lit(&triangles_hit(&state(), &corners.map(|p| at(p, []))));
    assert!(drawn.iter().all(|&(x, _)| (0..120).contains(&x)));
    let inside = |(x, y): (i32, i32)| {
        let p = (f64::from(x) + 0.5, f64::from(y) + 0.5);
        let e = |a: (f64, f64), b: (f64, f64)| (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0);
        let [a, b, c] = corners;
        [e(a, b), e(b, c), e(c, a)].into_iter().fold(f64::INFINITY, f64::min)
    };
    // The corners lie on the grid of 1/256 px, so that coverage is exact; centres on an edge may go either way.
    for y in 0..SIDE {
        for x in 0..SIDE {
            let margin = inside((x, y));
            assert!(
                margin.abs() < 1e-9 || drawn.contains(&(x, y)) == (margin > 0.0),
                "({x}, {y})"
            );
        }
    }
    let outside = [(400.0, 10.0), (500.0, 10.0), (400.0, 90.0)].map(|p| at(p, []));
    assert!(lit(&triangles_hit(&state(), &outside)).is_empty());
}

#[test]
fn item_03_4_no_area_no_pixels() {
    for line in [
        [(10.0, 10.0), (50.0, 50.0), (90.0, 90.0)],
        [(10.0, 10.0), (10.0, 10.0), (90.0, 20.0)],
        [(7.0, 7.0); 3],
    ] {
        assert!(lit(&triangles_hit(&state(), &line.map(|p| at(p, [])))).is_empty());
    }
}

#[test]
fn item_03_5_every_pixel_of_a_square_once() {
    let hits = triangles_hit(&state(), &square([10.0, 10.0, 20.0, 20.0], 0.0, []));
    assert_eq!(lit(&hits).len(), 100);
    assert_eq!(hits.iter().map(|&n| u32::from(n)).sum::<u32>(), 100);
    // So that the diagonal goes through centres.
    let hits = triangles_hit(&state(), &square([10.5, 10.5, 20.5, 20.5], 0.0, []));
    assert_eq!(hits.iter().map(|&n| u32::from(n)).sum::<u32>(), 100);
    assert!(hits.iter().all(|&n| n <= 1));
}

#[test]
fn item_03_6_left_over_vertices_are_ignored() {
    let corners = [(10.0, 10.0), (50.0, 10.0), (10.0, 50.0), (200.0, 200.0)].map(|p| at(p, []));
    let mut pixels = picture(0u8);
    let white = program(|_, []: [i32; 0]| Some(1u8));
    draw(&state(), &mut buffer(&mut pixels), &mut NoDepth, &white, &corners);
    assert_eq!(pixels, triangles_hit(&state(), &corners[..3]));
}

fn point((x, y): (f64, f64)) -> Block<i64, 4> {
    let fine = |v: f64| (v * 65536.0).round() as i32;
    Block::from_integers([fine(x), fine(y), 0, 65536])
}

fn plane(plane: [i32; 4]) -> Block<i64, 4> {
    Block::from_integers(plane)
}

fn real_point(point: Block<i64, 4>) -> [f64; 2] {
    let [x, y, _, w] = point.mantissas().map(|m| m as f64);
    [x / w, y / w]
}

const PLANES: [[i32; 4]; 3] = [[-180, 300, 0, 0], [30, -300, 0, 63000], [300, 40, 0, -27000]];
const CUT: [(f64, f64); 3] = [(20.0, 20.0), (290.0, 40.0), (40.0, 280.0)];

#[test]
fn item_04_1_a_plane_is_a_vector_of_four() {
    // Inside is to the left of the line from (0, 0) to (300, 180).
    let left = plane(PLANES[0]);
    for (p, want) in [((20.0, 20.0), 2400), ((290.0, 40.0), -40200), ((300.0, 180.0), 0)] {
        let fine = plane_distance(left, point(p)).to_fixed(16);
        assert_eq!(fine, i64::from(want) << 32);
    }
    // No normalising: a plane times a number is the same plane.
    let triangle = CUT.map(point);
    let (mut once, mut again) = (Room::<_, 4>::new(), Room::<_, 4>::new());
    assert!(clip_polygon(&triangle, left, &mut once) && clip_polygon(&triangle, left.scaled(9), &mut again));
    assert_eq!(once, again);
}

fn clipped(planes: &[[i32; 4]]) -> Vec<[f64; 2]> {
    let mut polygon = Room::<_, 6>::from_slice(&CUT.map(point)).unwrap();
    for &p in planes {
        let whole = polygon.clone();
        assert!(clip_polygon(&whole, plane(p), &mut polygon));
    }
    polygon.into_iter().map(real_point).collect()
}

#[test]
fn item_04_2_polygons_are_cut_plane_by_plane() {
    let first = clipped(&PLANES[..1]);
    let want = [[20.0, 20.0], [35.211, 21.127], [204.103, 122.462], [40.0, 280.0]];
    assert_eq!(first.len(), 4);
    first
        .into_iter()
        .zip(want)
        .for_each(|(got, want)| all_near(got, want, 6e-4));
    let all = clipped(&PLANES);
    let want = [
        [61.184, 216.118],
        [83.333, 50.0],
        [204.103, 122.462],
        [102.264, 220.226],
    ];
    assert_eq!(all.len(), 4);
    all.into_iter()
        .zip(want)
        .for_each(|(got, want)| all_near(got, want, 6e-4));
}

#[test]
fn item_04_3_identity_inside_and_nothing_outside() {
    let triangle = CUT.map(point);
    let mut cut = Room::<_, 4>::new();
    assert!(clip_polygon(&triangle, plane([1, 0, 0, 0]), &mut cut));
    assert_eq!(cut.as_slice(), triangle);
    assert!(clip_polygon(&triangle, plane([-1, 0, 0, 0]), &mut cut));
    assert!(cut.is_empty());
    assert!(clip_polygon(&[], plane([1, 0, 0, 0]), &mut cut));
    // Without room it says so.
    let mut small = Room::<_, 3>::new();
    assert!(!clip_polygon(&triangle, plane(PLANES[0]), &mut small));
}

/// Planes on window positions of the 300×300 picture, as planes in clip space: x = 150·(xc + w).
fn in_clip_space([a, b, _, d]: [f64; 4]) -> Block<i32, 4> {
    block([150.0 * a, 150.0 * b, 0.0, 150.0 * (a + b) + d])
}

#[test]
fn item_04_4_any_number_of_planes_changed_between_draws() {
    let mut planes = Planes::<i32, 10>::default();
    let lines: Vec<_> = (0..10)
        .map(|i| {
            let angle = TAU * f64::from(i) / 10.0 + 0.1;
            // Inside is up to 100 px from (150, 150) in that direction.
            let (x, y) = (angle.cos(), angle.sin());
            [-x, -y, 0.0, 100.0 + 150.0 * (x + y)]
        })
        .collect();
    let triangle = [(-900.0, -300.0), (1200.0, -300.0), (150.0, 1500.0)].map(|p| at(p, []));
    let white = program(|_, []: [i32; 0]| Some(1u8));
    let mut state = state().with_planes(planes.clone());
    let mut pixels = picture(0u8);
    draw(&state, &mut buffer(&mut pixels), &mut NoDepth, &white, &triangle);
    assert_eq!(lit(&pixels).len(), 300 * 300, "no planes");
    for line in &lines {
        planes.push(in_clip_space(*line)).unwrap();
    }
    state.planes = planes;
    let mut pixels = picture(0u8);
    draw(&state, &mut buffer(&mut pixels), &mut NoDepth, &white, &triangle);
    for y in 0..SIDE {
        for x in 0..SIDE {
            let p = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            let margin = lines
                .iter()
                .map(|[a, b, _, d]| a * p.0 + b * p.1 + d)
                .fold(f64::INFINITY, f64::min);
            // Corners of the decagon are snapped to 1/256 px.
            assert!(
                margin.abs() < 0.01 || (pixel(&pixels, x, y) == 1) == (margin > 0.0),
                "({x}, {y})"
            );
        }
    }
}

/// The core scans the polygon whole, or as a fan where values are linear: the same pixels, each once.
#[test]
fn item_04_5_the_rest_is_the_fan_of_its_corners() {
    let corners = clipped(&PLANES);
    let triangles: Vec<_> = (1..corners.len() - 1)
        .map(|i| [corners[0], corners[i], corners[i + 1]])
        .collect();
    assert_eq!(triangles.len(), 2);
    let fan: Vec<Vertex<0>> = triangles.iter().flatten().map(|&[x, y]| at((x, y), [])).collect();
    let hits = triangles_hit(&state(), &fan);
    assert!(hits.iter().all(|&n| n <= 1));
    let mut planes = Planes::<i32, 3>::default();
    for plane in PLANES {
        planes.push(in_clip_space(plane.map(f64::from))).unwrap();
    }
    let state = state().with_planes(planes);
    let count = |_, _: [i32; 1]| Some(1u8);
    for linear in [false, true] {
        let mut pixels = picture(0u8);
        let vertices = CUT.map(|p| at(p, [5]));
        if linear {
            draw(
                &state.clone().linear(),
                &mut buffer(&mut pixels),
                &mut NoDepth,
                &program(count),
                &vertices,
            );
        } else {
            draw(
                &state,
                &mut buffer(&mut pixels),
                &mut NoDepth,
                &program(count),
                &vertices,
            );
        }
        let different = lit(&pixels).symmetric_difference(&lit(&hits)).count();
        // Both snap the cut points to 1/256 px, from positions that differ by less: centres that near an edge.
        assert!(different <= 2, "{different} of {}", lit(&hits).len());
    }
}

#[test]
fn item_04_6_lines_are_cut_and_keep_their_direction() {
    let upper = plane([0, 1, 0, 0]);
    let ends = |a, b| [point(a), point(b)];
    let cut = |a, b| clip_line(ends(a, b), upper).map(|ends| ends.map(real_point));
    assert_eq!(cut((0.0, -10.0), (0.0, 10.0)), Some([[0.0, 0.0], [0.0, 10.0]]));
    assert_eq!(cut((0.0, 10.0), (0.0, -10.0)), Some([[0.0, 10.0], [0.0, 0.0]]));
    assert_eq!(cut((3.0, 1.0), (4.0, 2.0)), Some([[3.0, 1.0], [4.0, 2.0]]));
    assert_eq!(cut((3.0, -1.0), (4.0, -2.0)), None);
    // In the pipeline: only y ≥ 150 of an upright line.
    let mut planes = Planes::<i32, 1>::default();
    planes.push(Block::from_integers([0, 1, 0, 0])).unwrap();
    let mut pixels = picture(0u8);
    let white = program(|_, []: [i32; 0]| Some(1u8));
    let line = [at((40.5, 100.5), []), at((40.5, 200.5), [])];
    pipeline::lines(
        &state().with_planes(planes),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &white,
        line,
    );
    assert_eq!(lit(&pixels), (150..=200).map(|y| (40, y)).collect());
}
