//! Near and far clipping in clip space (formats/iv.md, Visibility).

use crate::reference::matrix::Vector;

/// How many numbers a corner carries: a colour, or a position and a normal.
pub const VALUES: usize = 6;

/// A corner in clip space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// x, y, z, w.
    pub clip: Vector,
    /// What is interpolated from here to the other corners.
    pub values: [f64; VALUES],
}

/// What the values are linear over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Linear {
    /// The picture: colours.
    Screen,
    /// The surface: positions and normals.
    Space,
}

impl Corner {
    /// The point between `self`, inside, and `other`, outside, whose distances to a plane are `own` and `others`.
    fn cut(&self, other: &Self, own: f64, others: f64, linear: Linear) -> Self {
        let t = own / (own - others);
        let (wa, wb) = (self.clip[3], other.clip[3]);
        let s = match linear {
            // Where the cut lies on the screen, between the ends.
            Linear::Screen if wa > 0.0 && wb > 0.0 => t * wb / ((1.0 - t) * wa + t * wb),
            _ => t,
        };
        Self {
            clip: [0, 1, 2, 3].map(|i| self.clip[i] + t * (other.clip[i] - self.clip[i])),
            values: [0, 1, 2, 3, 4, 5].map(|i| self.values[i] + s * (other.values[i] - self.values[i])),
        }
    }
}

/// What lies between the near and the far plane: a polygon, or nothing.
pub fn clip(triangle: &[Corner; 3], linear: Linear) -> Vec<Corner> {
    let near = |[_, _, z, w]: Vector| z + w;
    let far = |[_, _, z, w]: Vector| w - z;
    cut_off(&cut_off(triangle, near, linear), far, linear)
}

/// The part of a polygon whose distance is 0 or more.
fn cut_off(polygon: &[Corner], distance: impl Fn(Vector) -> f64, linear: Linear) -> Vec<Corner> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, corner) in polygon.iter().enumerate() {
        let next = &polygon[(i + 1) % polygon.len()];
        let (d, e) = (distance(corner.clip), distance(next.clip));
        if d >= 0.0 {
            kept.push(*corner);
        }
        // Always from the inside to the outside, so that both neighbours of an edge cut it at the same bits.
        if d >= 0.0 && e < 0.0 {
            kept.push(corner.cut(next, d, e, linear));
        } else if d < 0.0 && e >= 0.0 {
            kept.push(next.cut(corner, e, d, linear));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f64, z: f64, w: f64, value: f64) -> Corner {
        Corner {
            clip: [x, 0.0, z, w],
            values: [value; VALUES],
        }
    }

    fn clipped(triangle: [Corner; 3], linear: Linear) -> Vec<(Vector, f64)> {
        clip(&triangle, linear).iter().map(|c| (c.clip, c.values[5])).collect()
    }

    #[test]
    fn what_touches_the_planes_stays_whole() {
        let triangle = [
            corner(0.0, -1.0, 1.0, 0.0),
            corner(1.0, 1.0, 1.0, 0.0),
            corner(0.0, 0.0, 1.0, 0.0),
        ];
        assert_eq!(clip(&triangle, Linear::Space), triangle);
        let beyond = triangle.map(|c| corner(c.clip[0], c.clip[2] - 2.1, 1.0, 0.0));
        assert!(clip(&beyond, Linear::Space).is_empty());
        let beyond = triangle.map(|c| corner(c.clip[0], c.clip[2] + 2.1, 1.0, 0.0));
        assert!(clip(&beyond, Linear::Space).is_empty());
    }

    /// One corner before the near plane; its edges are cut half way in space.
    fn near_cut(w_outside: f64) -> [Corner; 3] {
        [
            corner(0.0, 0.0, 4.0, 0.0),
            corner(2.0, -4.0 - w_outside, w_outside, 1.0),
            corner(0.0, 0.0, 4.0, 0.0),
        ]
    }

    #[test]
    fn a_cut_is_linear_in_space_and_on_the_screen_nearer_the_far_end() {
        let ([x, y, z, w], _) = clipped(near_cut(1.0), Linear::Space)[1];
        assert_eq!([x, y, z, w], [1.0, 0.0, -2.5, 2.5]);
        let values = |linear, w| clipped(near_cut(w), linear).iter().map(|c| c.1).collect::<Vec<_>>();
        assert_eq!(values(Linear::Space, 1.0), [0.0, 0.5, 0.5, 0.0]);
        // 0.5 * 1 / (0.5 * 4 + 0.5 * 1)
        assert_eq!(values(Linear::Screen, 1.0), [0.0, 0.2, 0.2, 0.0]);
        // An end behind the camera has no place on the screen.
        for w in [0.0, -1.0] {
            assert_eq!(values(Linear::Screen, w), [0.0, 0.5, 0.5, 0.0], "{w}");
        }
    }

    #[test]
    fn what_is_left_lies_in_front_of_the_camera() {
        let triangle = [
            corner(0.0, 0.5, 3.0, 0.0),
            corner(1.0, -8.0, -5.0, 0.0),
            corner(2.0, 9.0, 8.0, 0.0),
        ];
        let left = clip(&triangle, Linear::Space);
        // Two cuts by the near plane, and two by the far one next to the corner beyond it.
        assert_eq!(left.len(), 5);
        for Corner { clip: [_, _, z, w], .. } in left {
            assert!(w > 0.0 && (-w - 1e-12..=w + 1e-12).contains(&z), "{z} {w}");
        }
    }

    #[test]
    fn neighbours_cut_their_edge_at_the_same_bits() {
        let (a, b) = (corner(0.1, 0.7, 1.3, 0.3), corner(3.3, -0.9, 0.1, 0.7));
        for linear in [Linear::Screen, Linear::Space] {
            let one = clip(&[a, b, corner(9.0, 0.0, 1.0, 0.0)], linear);
            let other = clip(&[b, a, corner(-5.0, 0.0, 2.0, 1.0)], linear);
            let on_edge = |c: &&Corner| **c != a && other.contains(c);
            assert_eq!(one.iter().filter(on_edge).count(), 1);
        }
    }
}
