//! Clipping against the user's planes in eye space (formats/hw2.md section 5): Sutherland-Hodgman, all values mixed
//! linearly, the boundary kept.

use super::attributes::{Attributes, Bounds};
use super::bound::{Tracked, size};
use super::matrix::Vector;
use crate::compare::stated::{FIXED_PRODUCT, FLOAT_PRODUCT};

/// A corner in eye space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// x, y, z, w after MV.
    pub eye: Vector,
    /// What is interpolated from here to the other corners.
    pub at: Attributes,
    /// Bound of the distance of the core's `eye` from this one.
    pub error: f64,
    /// Bounds of the differences of the core's attributes from these.
    pub at_error: Bounds,
}

impl Corner {
    /// The point between `self` and `other` where the distances `own` ≥ 0 and `others` < 0 mix to 0.
    fn cut(&self, other: &Self, own: f64, others: f64, over: Over) -> Self {
        let t = own / (own - others);
        let (a, b) = (self.eye[3], other.eye[3]);
        let at = match over {
            Over::Screen if a > 0.0 && b > 0.0 => t * b / ((1.0 - t) * a + t * b),
            _ => t,
        };
        let mix = |a: f64, b: f64| a + t * (b - a);
        let largest = size(&self.eye).max(size(&other.eye));
        let mut at_error =
            (self.at_error.max(&other.at_error)).plus(&Bounds::of_carrying([&self.at, &other.at].into_iter(), 1.0));
        if over == Over::Screen && (b.abs() <= other.error || a.abs() <= self.error) {
            // The core may take the other rule: the colour may be the inner end's, or that of the cut in space.
            let apart = [0, 1, 2].map(|i| (other.at.color[i] - self.at.color[i]).abs());
            at_error.color += t * apart.into_iter().fold(0.0, f64::max);
        }
        Self {
            eye: [0, 1, 2, 3].map(|i| mix(self.eye[i], other.eye[i])),
            at: self.at.mixed(&other.at, at),
            // A mean of the ends' errors, and the rounding of the mean on both sides.
            error: mix(self.error, other.error) + 2.0 * (FIXED_PRODUCT + FLOAT_PRODUCT) * largest,
            // The same for integers at the primitive's scale.
            at_error,
        }
    }
}

/// What attributes are linear over where an edge is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// The space of the positions.
    Space,
    /// The screen, where both ends have a place there (formats/iv.md, clipping of Gouraud colours).
    Screen,
}

/// A clip plane: points with p · (x, y, z, w) ≥ 0 are kept.
#[derive(Debug, Clone, Copy)]
pub struct Plane {
    p: Vector,
    error: f64,
}

/// Which polygon to cut out of a triangle: the reference's, or one that the core's is certainly inside of or around.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The distances as float64 gives them.
    Exact,
    /// Distances raised by their bound: nothing that the core may keep is cut off.
    Generous,
    /// Distances lowered by their bound: nothing that the core may cut off is kept.
    Strict,
}

impl Plane {
    /// A plane whose normal is turned by the directions' matrix of this moment.
    pub fn new(plane: Vector, directions: &Tracked) -> Self {
        let [a, b, c, d] = plane;
        let normal = [a, b, c, 0.0];
        let given = FIXED_PRODUCT * size(&plane);
        let ([a, b, c, _], error) = directions.apply(&normal, given);
        Self {
            p: [a, b, c, d],
            error: error + given,
        }
    }

    fn distance(&self, corner: &Corner, side: Side) -> f64 {
        let (p, v) = (&self.p, &corner.eye);
        let exact = p[0] * v[0] + p[1] * v[1] + p[2] * v[2] + p[3] * v[3];
        let rounding = (FIXED_PRODUCT + FLOAT_PRODUCT) * size(p) * size(v);
        let bound = (size(p) + self.error) * corner.error + self.error * size(v) + rounding;
        match side {
            Side::Exact => exact,
            Side::Generous => exact + bound,
            Side::Strict => exact - bound,
        }
    }
}

/// What the planes leave of a triangle: a polygon, or nothing at all.
pub fn clip(triangle: &[Corner; 3], planes: &[Plane], side: Side, over: Over) -> Vec<Corner> {
    let mut polygon = triangle.to_vec();
    for plane in planes {
        let distances: Vec<f64> = polygon.iter().map(|c| plane.distance(c, side)).collect();
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, corner) in polygon.iter().enumerate() {
            let j = (i + 1) % polygon.len();
            let (next, d, e) = (&polygon[j], distances[i], distances[j]);
            if d >= 0.0 {
                kept.push(*corner);
            }
            // Always from the inside to the outside, so that both neighbours of an edge cut it at the same bits.
            if d >= 0.0 && e < 0.0 {
                kept.push(corner.cut(next, d, e, over));
            } else if d < 0.0 && e >= 0.0 {
                kept.push(next.cut(corner, e, d, over));
            }
        }
        polygon = kept;
        if polygon.is_empty() {
            break;
        }
    }
    polygon
}

/// What the planes leave of a line, in its direction.
pub fn clip_line(ends: &[Corner; 2], planes: &[Plane], side: Side) -> Option<[Corner; 2]> {
    let [mut a, mut b] = *ends;
    for plane in planes {
        let (d, e) = (plane.distance(&a, side), plane.distance(&b, side));
        if d < 0.0 && e < 0.0 {
            return None;
        } else if d < 0.0 {
            a = b.cut(&a, e, d, Over::Space);
        } else if e < 0.0 {
            b = a.cut(&b, d, e, Over::Space);
        }
    }
    Some([a, b])
}

#[cfg(test)]
mod tests {
    use super::super::matrix::Matrix;
    use super::*;

    fn corner(x: f64, y: f64) -> Corner {
        Corner {
            eye: [x, y, 0.0, 1.0],
            at: Attributes {
                color: [x, 0.0, 0.0],
                texcoord: [y, x + y],
                ..Attributes::default()
            },
            error: 1e-15,
            at_error: Bounds::default(),
        }
    }

    fn plane(p: Vector) -> Plane {
        Plane::new(p, &Tracked::identity())
    }

    fn triangle() -> [Corner; 3] {
        [corner(0.0, 0.0), corner(4.0, 0.0), corner(0.0, 4.0)]
    }

    #[test]
    fn a_cut_mixes_all_values() {
        let polygon = clip(&triangle(), &[plane([-1.0, 0.0, 0.0, 1.0])], Side::Exact, Over::Space);
        let points: Vec<_> = polygon.iter().map(|c| (c.eye[0], c.eye[1], c.at.color[0])).collect();
        assert_eq!(
            points,
            [(0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (1.0, 3.0, 1.0), (0.0, 4.0, 0.0)]
        );
        assert!(polygon.iter().all(|c| c.at.texcoord == [c.eye[1], c.eye[0] + c.eye[1]]));
    }

    #[test]
    fn the_boundary_is_kept_and_the_outside_is_not() {
        let through_an_edge = plane([1.0, 0.0, 0.0, 0.0]);
        assert_eq!(
            clip(&triangle(), &[through_an_edge], Side::Exact, Over::Space),
            triangle()
        );
        assert!(clip(&triangle(), &[plane([-1.0, 0.0, 0.0, -1.0])], Side::Exact, Over::Space).is_empty());
    }

    #[test]
    fn neighbours_cut_their_edge_at_the_same_bits() {
        let (a, b) = (corner(0.1, 0.7), corner(3.3, -0.9));
        let p = [plane([0.3, -0.7, 0.0, 0.01])];
        let one = clip(&[a, b, corner(9.0, 9.0)], &p, Side::Exact, Over::Space);
        let other = clip(&[b, a, corner(-5.0, -7.0)], &p, Side::Exact, Over::Space);
        assert!(
            one.iter()
                .any(|c| c.eye[0] != 0.1 && c.eye[0] != 3.3 && other.iter().any(|d| d.eye == c.eye))
        );
    }

    #[test]
    fn a_plane_through_the_triangle_itself_is_undecided() {
        let p = [plane([0.0, 0.0, 1.0, 0.0])];
        assert_eq!(clip(&triangle(), &p, Side::Exact, Over::Space).len(), 3);
        assert_eq!(clip(&triangle(), &p, Side::Generous, Over::Space).len(), 3);
        assert!(clip(&triangle(), &p, Side::Strict, Over::Space).is_empty());
    }

    #[test]
    fn directions_turn_the_normal_and_leave_the_distance() {
        let half = Tracked::given(Matrix::scaling([0.5, 2.0, 1.0]).linear_part());
        assert_eq!(Plane::new([1.0, 1.0, 1.0, 3.0], &half).p, [0.5, 2.0, 1.0, 3.0]);
    }
}
