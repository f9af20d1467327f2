//! Clipping by planes before the division (chapter 04), Sutherland-Hodgman.

use super::interpolate::mix;
use super::program::Vertex;
use super::state::Plane;

/// l · p: on the inside where it is not negative.
pub fn distance(plane: &Plane, p: &[f64; 4]) -> f64 {
    plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3]
}

/// What the planes leave of a polygon.
pub fn polygon(corners: &[Vertex], planes: &[Plane]) -> Vec<Vertex> {
    planes
        .iter()
        .fold(corners.to_vec(), |polygon, plane| half(&polygon, plane))
}

/// What one plane leaves: every edge from its start to its end, the edge from the last corner to the first one first.
fn half(polygon: &[Vertex], plane: &Plane) -> Vec<Vertex> {
    let mut kept = Vec::new();
    let starts = polygon.iter().cycle().skip(polygon.len().saturating_sub(1));
    for (start, end) in starts.zip(polygon) {
        let [from, to] = [start, end].map(|vertex| distance(plane, &vertex.position) >= 0.0);
        if from != to {
            kept.push(cut(start, end, plane));
        }
        if to {
            kept.push(end.clone());
        }
    }
    kept
}

/// What the planes leave of a line, in its direction.
pub fn line(ends: &[Vertex; 2], planes: &[Plane]) -> Option<[Vertex; 2]> {
    let [mut start, mut end] = ends.clone();
    for plane in planes {
        match [&start, &end].map(|vertex| distance(plane, &vertex.position) >= 0.0) {
            [false, false] => return None,
            [true, true] => {}
            [true, false] => end = cut(&start, &end, plane),
            [false, true] => start = cut(&start, &end, plane),
        }
    }
    Some([start, end])
}

/// The point of an edge on the plane, with the outputs there.
fn cut(start: &Vertex, end: &Vertex, plane: &Plane) -> Vertex {
    let [from, to] = [start, end].map(|vertex| distance(plane, &vertex.position));
    let t = from / (from - to);
    Vertex {
        position: std::array::from_fn(|i| (1.0 - t) * start.position[i] + t * end.position[i]),
        outputs: mix([&start.outputs, &end.outputs], [1.0 - t, t]),
    }
}

#[cfg(test)]
mod tests {
    use super::super::program::Values;
    use super::*;

    fn vertex(x: f64, y: f64) -> Vertex {
        Vertex {
            position: [x, y, 0.0, 1.0],
            outputs: Values::from([("x", vec![x]), ("xy", vec![x, y])]),
        }
    }

    fn places(polygon: &[Vertex]) -> Vec<[f64; 2]> {
        polygon.iter().map(|v| [v.position[0], v.position[1]]).collect()
    }

    fn near(found: &[Vertex], expected: &[[f64; 2]]) {
        let found = places(found);
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (a, b) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((a - b).abs() < 1e-3, "{found:?} is not {expected:?}");
        }
    }

    const PLANES: [Plane; 3] = [
        [-180.0, 300.0, 0.0, 0.0],
        [30.0, -300.0, 0.0, 63000.0],
        [300.0, 40.0, 0.0, -27000.0],
    ];

    fn triangle() -> [Vertex; 3] {
        [vertex(20.0, 20.0), vertex(290.0, 40.0), vertex(40.0, 280.0)]
    }

    #[test]
    fn i04_1_the_left_of_a_line_is_inside() {
        assert!(distance(&PLANES[0], &[0.0, 1.0, 0.0, 1.0]) > 0.0);
        assert!(distance(&PLANES[0], &[1.0, 0.0, 0.0, 1.0]) < 0.0);
        assert_eq!(distance(&PLANES[0], &[150.0, 90.0, 0.0, 1.0]), 0.0);
    }

    #[test]
    fn i04_2_three_planes() {
        let first = [[20.0, 20.0], [35.211, 21.127], [204.103, 122.462], [40.0, 280.0]];
        near(&polygon(&triangle(), &PLANES[..1]), &first);
        let all = [
            [61.184, 216.118],
            [83.333, 50.0],
            [204.103, 122.462],
            [102.264, 220.226],
        ];
        near(&polygon(&triangle(), &PLANES), &all);
    }

    #[test]
    fn i04_3_nothing_cut_and_all_cut() {
        assert_eq!(polygon(&triangle(), &[[1.0, 0.0, 0.0, 0.0]]), triangle());
        assert_eq!(polygon(&triangle(), &[[-1.0, 0.0, 0.0, 0.0]]), []);
        assert_eq!(polygon(&triangle(), &[[-1.0, 0.0, 0.0, 0.0]; 2]), []);
    }

    #[test]
    fn i04_4_ten_planes_leave_a_decagon() {
        let planes: Vec<Plane> = (0..10)
            .map(|i| f64::from(i) * std::f64::consts::TAU / 10.0)
            .map(|angle| [-angle.cos(), -angle.sin(), 0.0, 50.0])
            .collect();
        let large = [vertex(-500.0, -300.0), vertex(500.0, -300.0), vertex(0.0, 700.0)];
        let decagon = polygon(&large, &planes);
        assert_eq!(decagon.len(), 10);
        let radius = 50.0 / (std::f64::consts::PI / 10.0).cos();
        for [x, y] in places(&decagon) {
            assert!((x.hypot(y) - radius).abs() < 1e-9);
        }
        assert_eq!(polygon(&large, &[]), large);
    }

    #[test]
    fn i04_6_lines_keep_their_direction() {
        let plane = [[0.0, 1.0, 0.0, 0.0]];
        let (below, above) = (vertex(0.0, -10.0), vertex(0.0, 10.0));
        let clipped = |ends: [&Vertex; 2]| line(&ends.map(Clone::clone), &plane);
        near(&clipped([&below, &above]).expect("a part"), &[[0.0, 0.0], [0.0, 10.0]]);
        near(&clipped([&above, &below]).expect("a part"), &[[0.0, 10.0], [0.0, 0.0]]);
        assert_eq!(clipped([&above, &above]), Some([above.clone(), above.clone()]));
        assert_eq!(clipped([&below, &below]), None);
    }

    #[test]
    fn i06_5_outputs_are_cut_with_the_position() {
        let corners = [vertex(-3.0, -2.0), vertex(7.0, 1.0), vertex(1.0, 6.0)];
        for v in polygon(&corners, &[[1.0, 0.0, 0.0, 0.0]]) {
            let [x, y, ..] = v.position;
            assert!(x >= -1e-12 && (v.outputs["x"][0] - x).abs() < 1e-12);
            assert!((v.outputs["xy"][1] - y).abs() < 1e-12);
        }
    }

    #[test]
    fn i07_3_clipped_before_the_division() {
        // 90 degrees, square, near 1, far 3: from in front to behind the camera.
        let end = |position| Vertex {
            position,
            outputs: Values::new(),
        };
        let ends = [end([0.0, 0.0, 1.0, 2.0]), end([1.0, 0.0, -5.0, -1.0])];
        let [start, cut] = line(&ends, &[super::super::state::NEAR]).expect("a part");
        assert_eq!(start, ends[0]);
        for (found, expected) in cut.position.iter().zip([1.0 / 3.0, 0.0, -1.0, 1.0]) {
            assert!((found - expected).abs() < 1e-12, "{cut:?}");
        }
    }
}
