//! Triangles (chapter 03, 04.5, 11.1): edge functions at pixel centres.

use super::clip;
use super::fragment::Canvas;
use super::interpolate::{mix, weights};
use super::program::Vertex;
use super::state::Face;
use super::window::{Placed, place};

/// What a triangle of a smaller |A| is taken for: a line, which covers nothing.
const NO_AREA: f64 = 1e-8;

/// Clips a triangle, places its corners, culls the polygon and draws it as a fan.
pub fn draw(canvas: &mut Canvas<'_>, corners: &[Vertex; 3]) {
    let viewport = canvas.state.viewport;
    let polygon = clip::polygon(corners, &canvas.state.clip_planes);
    let placed: Option<Vec<Placed>> = polygon.iter().map(|corner| place(corner, &viewport)).collect();
    let Some(polygon) = placed else {
        return;
    };
    if canvas.state.cull.is_some_and(|face| culled(face, &polygon)) {
        return;
    }
    if let Some((first, rest)) = polygon.split_first() {
        for pair in rest.windows(2) {
            fill(canvas, [first, &pair[0], &pair[1]]);
        }
    }
}

fn culled(face: Face, polygon: &[Placed]) -> bool {
    match face {
        Face::FrontAndBack => true,
        Face::Front => doubled_area(polygon) > 0.0,
        Face::Back => doubled_area(polygon) <= 0.0,
    }
}

/// Twice the polygon's area, positive where it is counter-clockwise.
pub fn doubled_area(polygon: &[Placed]) -> f64 {
    let following = polygon.iter().cycle().skip(1);
    let crosses = polygon.iter().zip(following).map(|(a, b)| {
        let ([xa, ya, ..], [xb, yb, ..]) = (a.window, b.window);
        xa * yb - xb * ya
    });
    crosses.sum()
}

/// Twice the area of (a, b, p), positive where it is counter-clockwise.
///
/// Evaluated from the lesser end, so that two triangles see an edge they share with opposite signs, to the last bit.
pub fn edge(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    if a > b {
        return -edge(b, a, p);
    }
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// Whether centres on the edge from a to b belong to the triangle on its left: a left edge falls, a top edge runs left.
fn top_left(a: [f64; 2], b: [f64; 2]) -> bool {
    b[1] < a[1] || (b[1] == a[1] && b[0] < a[0])
}

/// The weights of a triangle's corners at p: u, v, w, of sum 1; none if p does not belong to it, or if it has no area.
pub fn inside([a, b, c]: [[f64; 2]; 3], p: [f64; 2]) -> Option<[f64; 3]> {
    let area = edge(a, b, c);
    if area.abs() < NO_AREA {
        return None;
    }
    let edges = [(b, c), (c, a), (a, b)];
    let belongs = edges.iter().all(|&(from, to)| {
        let (from, to) = if area > 0.0 { (from, to) } else { (to, from) };
        let side = edge(from, to, p);
        side > 0.0 || (side == 0.0 && top_left(from, to))
    });
    belongs.then(|| edges.map(|(from, to)| edge(from, to, p) / area))
}

/// Draws the pixels of a triangle in the window.
pub fn fill(canvas: &mut Canvas<'_>, corners: [&Placed; 3]) {
    let places = corners.map(|corner| [corner.window[0], corner.window[1]]);
    let span = |i: usize, [first, last]: [i64; 2]| {
        let least = places.iter().map(|p| p[i]).fold(f64::INFINITY, f64::min);
        let most = places.iter().map(|p| p[i]).fold(f64::NEG_INFINITY, f64::max);
        first.max(least.floor() as i64)..=last.min(most.ceil() as i64)
    };
    let [columns, rows] = canvas.pixels();
    for y in span(1, rows) {
        for x in span(0, columns) {
            let center = [x as f64 + 0.5, y as f64 + 0.5];
            if let Some(shares) = inside(places, center) {
                fragment(canvas, corners, shares, [x, y]);
            }
        }
    }
}

fn fragment(canvas: &mut Canvas<'_>, corners: [&Placed; 3], shares: [f64; 3], [x, y]: [i64; 2]) {
    let linear = |i: usize| -> f64 { corners.iter().zip(shares).map(|(c, share)| share * c.window[i]).sum() };
    let own = weights(shares, corners.map(|c| c.window[3]), canvas.state.interpolation);
    let inputs = mix(corners.map(|c| &c.outputs), own);
    let at = [x as f64 + 0.5, y as f64 + 0.5, linear(2), linear(3)];
    canvas.fragment([x, y], at, &inputs);
}

#[cfg(test)]
mod tests {
    use super::super::program::Values;
    use super::*;

    const CORNERS: [[f64; 2]; 3] = [[10.0, 10.0], [290.0, 10.0], [20.0, 150.0]];

    fn near(found: [f64; 3], expected: [f64; 3]) {
        assert!(
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6),
            "{found:?}"
        );
    }

    fn reversed([a, b, c]: [[f64; 2]; 3]) -> [[f64; 2]; 3] {
        [c, b, a]
    }

    #[test]
    fn i03_1_twice_the_signed_area() {
        let [a, b, c] = CORNERS;
        assert_eq!(edge(a, b, c), 39200.0);
        assert_eq!(edge(b, a, c), -39200.0);
    }

    #[test]
    fn i03_2_weights_in_both_windings() {
        let weights = inside(CORNERS, [100.5, 50.5]).expect("inside");
        near(weights, [0.397832, 0.312883, 0.289286]);
        let [w, v, u] = inside(reversed(CORNERS), [100.5, 50.5]).expect("inside");
        near([u, v, w], weights);
        assert_eq!(inside(CORNERS, [200.5, 100.5]), None);
        let [a, b, c] = CORNERS;
        assert!((edge(b, c, [200.5, 100.5]) / edge(a, b, c) + 0.303699).abs() < 1e-6);
    }

    #[test]
    fn i03_4_three_points_on_a_line_cover_nothing() {
        let line = [[1.5, 1.5], [5.5, 5.5], [9.5, 9.5]];
        assert!((0..12).all(|i| inside(line, [f64::from(i) + 0.5; 2]).is_none()));
        assert_eq!(inside([[3.5, 3.5]; 3], [3.5, 3.5]), None);
    }

    #[test]
    fn i03_5_centres_on_edges_belong_to_one_of_two_neighbours() {
        // Four triangles round a centre, on a square whose corners are centres: its left and top belong to it.
        let square = [[0.5, 0.5], [4.5, 0.5], [4.5, 4.5], [0.5, 4.5]];
        let middle = [2.5, 2.5];
        for turned in [false, true] {
            let owners = |p: [f64; 2]| {
                let fan = (0..4).map(|i| [square[i], square[(i + 1) % 4], middle]);
                let fan = fan.map(|t| if turned { reversed(t) } else { t });
                fan.filter(|&t| inside(t, p).is_some()).count()
            };
            for (x, y) in (0..6).flat_map(|y| (0..6).map(move |x| (x, y))) {
                let expected = usize::from((0..4).contains(&x) && (1..5).contains(&y));
                assert_eq!(owners([f64::from(x) + 0.5, f64::from(y) + 0.5]), expected, "{x} {y}");
            }
        }
    }

    #[test]
    fn i11_1_area_of_the_polygon() {
        let placed = |[x, y]: [f64; 2]| Placed {
            window: [x, y, 0.0, 1.0],
            outputs: Values::new(),
        };
        let triangle = [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]];
        let front = triangle.map(placed);
        let back = reversed(triangle).map(placed);
        let flat = [[0.0, 0.0], [5.0, 5.0], [10.0, 10.0]].map(placed);
        assert_eq!([&front, &back, &flat].map(|t| doubled_area(t)), [100.0, -100.0, 0.0]);
        assert_eq!(
            [&front, &back, &flat].map(|t| culled(Face::Back, t)),
            [false, true, true]
        );
        assert_eq!(
            [&front, &back, &flat].map(|t| culled(Face::Front, t)),
            [true, false, false]
        );
        assert!([&front, &back, &flat].iter().all(|t| culled(Face::FrontAndBack, *t)));
    }
}
