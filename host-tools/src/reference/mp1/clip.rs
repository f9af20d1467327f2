//! Clipping before the division (formats/mp1.md section 4): Sutherland-Hodgman plane by plane, all ten values mixed
//! linearly, the boundary kept.

use super::color::decode;
use crate::scene::mp1::{Switches, Vertex};

/// x, y, z, w, red, green, blue, alpha, s, t. Colours as they are mixed: 1 is full, linear with `sRGB`.
pub type Corner = [f64; 10];

/// Points with p · (x, y, z, w) ≥ 0 are kept.
pub type Plane = [f64; 4];

/// The view volume: -w ≤ x, y, z ≤ w.
pub const FRUSTUM: [Plane; 6] = [
    [1.0, 0.0, 0.0, 1.0],
    [-1.0, 0.0, 0.0, 1.0],
    [0.0, 1.0, 0.0, 1.0],
    [0.0, -1.0, 0.0, 1.0],
    [0.0, 0.0, 1.0, 1.0],
    [0.0, 0.0, -1.0, 1.0],
];

/// The planes of the view volume, if it is clipped to.
pub fn frustum(switches: &Switches) -> &'static [Plane] {
    if switches.frustum { &FRUSTUM } else { &[] }
}

/// A vertex with its colour ready for mixing: divided by 255, and decoded with `sRGB`.
pub fn corner(vertex: &Vertex, srgb: bool) -> Corner {
    let [x, y, z, w] = vertex.position;
    let [r, g, b] = vertex.rgb.map(|c| c / 255.0).map(|c| if srgb { decode(c) } else { c });
    let [s, t] = vertex.texcoord;
    [x, y, z, w, r, g, b, vertex.alpha, s, t]
}

/// How far a corner is on the kept side of a plane, in units of the plane's length.
pub fn distance(p: &Plane, c: &Corner) -> f64 {
    p[0] * c[0] + p[1] * c[1] + p[2] * c[2] + p[3] * c[3]
}

/// Whether all planes keep a point.
pub fn keep(planes: &[Plane], point: &Corner) -> bool {
    planes.iter().all(|plane| distance(plane, point) >= 0.0)
}

/// What the planes leave of a triangle: a polygon, or nothing at all.
pub fn triangle<'p>(corners: &[Corner; 3], planes: impl Iterator<Item = &'p Plane>) -> Vec<Corner> {
    let mut polygon = corners.to_vec();
    for plane in planes {
        if polygon.is_empty() {
            break;
        }
        polygon = half(&polygon, plane);
    }
    polygon
}

/// The part of a polygon on the kept side of one plane.
fn half(polygon: &[Corner], plane: &Plane) -> Vec<Corner> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    let following = polygon.iter().cycle().skip(1);
    for (a, b) in polygon.iter().zip(following) {
        let [da, db] = [a, b].map(|c| distance(plane, c));
        if da >= 0.0 {
            kept.push(*a);
        }
        if (da >= 0.0) != (db >= 0.0) {
            kept.push(crossing(a, b, da, db));
        }
    }
    kept
}

/// What the planes leave of a line, in the order of its ends.
pub fn line(ends: [Corner; 2], planes: &[Plane]) -> Option<[Corner; 2]> {
    let [mut a, mut b] = ends;
    for plane in planes {
        let [da, db] = [&a, &b].map(|c| distance(plane, c));
        match (da >= 0.0, db >= 0.0) {
            (true, true) => {}
            (true, false) => b = crossing(&a, &b, da, db),
            (false, true) => a = crossing(&a, &b, da, db),
            (false, false) => return None,
        }
    }
    Some([a, b])
}

/// (A·dB − B·dA)/(dB − dA). Exchanging A and B gives the same bits, so neighbours cut their edge at the same point.
fn crossing(a: &Corner, b: &Corner, da: f64, db: f64) -> Corner {
    std::array::from_fn(|i| (a[i] * db - b[i] * da) / (db - da))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f64, y: f64) -> Corner {
        [x, y, 0.5, 4.0, x, y, x + y, 1.0, 2.0 * x, -y]
    }

    #[test]
    fn a_crossing_mixes_all_ten_values() {
        // x ≤ 1, on a triangle to x = 4.
        let planes = [[-1.0, 0.0, 0.0, 0.25]];
        let polygon = triangle(
            &[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]].map(|[x, y]| corner(x, y)),
            planes.iter(),
        );
        let expected = [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0], [0.0, 4.0]];
        assert_eq!(polygon, expected.map(|[x, y]| corner(x, y)));
        assert_eq!(
            line([corner(4.0, 0.0), corner(0.0, 4.0)], &planes),
            Some([corner(1.0, 3.0), corner(0.0, 4.0)])
        );
        assert_eq!(line([corner(2.0, 0.0), corner(4.0, 4.0)], &planes), None);
    }

    #[test]
    fn the_boundary_is_kept() {
        let whole = [[-4.0, 0.0], [4.0, 0.0], [0.0, 4.0]].map(|[x, y]| corner(x, y));
        assert_eq!(triangle(&whole, FRUSTUM.iter()), whole);
        assert!(keep(&FRUSTUM, &whole[0]));
        assert!(!keep(&FRUSTUM, &corner(-4.001, 0.0)));
        assert_eq!(line([whole[0], whole[1]], &FRUSTUM), Some([whole[0], whole[1]]));
    }

    #[test]
    fn the_view_volume_has_six_sides() {
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let mut out = corner(0.0, 0.0);
                out[axis] = side * 4.5;
                let cut: Vec<_> = FRUSTUM.iter().filter(|plane| distance(plane, &out) < 0.0).collect();
                assert_eq!(cut.len(), 1, "{axis} {side}");
                assert_eq!(distance(cut[0], &out), -0.5);
            }
        }
        let behind = corner(0.0, 0.0).map(|v| -v);
        assert!(triangle(&[behind; 3], FRUSTUM.iter()).is_empty());
    }

    #[test]
    fn neighbours_cut_their_edge_at_the_same_bits() {
        let (a, b) = (corner(0.1, 0.7), corner(3.3, -0.9));
        let plane = [0.3, -0.7, 0.0, -0.05];
        let [da, db] = [&a, &b].map(|c| distance(&plane, c));
        assert!((da < 0.0) != (db < 0.0));
        assert_eq!(crossing(&a, &b, da, db), crossing(&b, &a, db, da));
    }
}
