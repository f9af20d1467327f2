//! What the comparison needs to know of every primitive: its polygon on the screen, and how far the fixed-point core's corners
//! may be from it. All of it comes from the float64 scene, nothing from what the core drew.
//!
//! User planes: the core cuts with distances that are off by a known bound. So two polygons are kept: one with the planes
//! raised by their bound, which certainly holds whatever the core draws, and one with the planes lowered, which the core
//! certainly draws. The same two handle a plane almost parallel to an edge, or through the whole triangle.

use super::attributes::{Attributes, Bounds};
use super::bound::Tracked;
use super::clip::{Corner as EyeCorner, Over, Plane, Side, clip};
use super::matrix::Vector;
use crate::compare::stated::SNAP;

/// A corner on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Position in px; y points down.
    pub position: [f64; 2],
    /// z/w.
    pub z: f64,
    /// w with its sign.
    pub w: f64,
    /// Red, green, blue, not divided by w; the same as in `at`.
    pub color: [f64; 3],
    /// All that is interpolated, not divided by w.
    pub at: Attributes,
    /// Bounds of the differences of the core's attributes from these.
    pub at_error: Bounds,
    /// δ in px: bound of the distance of the core's corner from this one; infinite where w may be 0.
    pub reach: f64,
    /// The part of `reach` that is free in direction. The rest, an error of w, moves the corner towards or away from the
    /// centre of the picture, by `weight_error` of its distance: across a far corner's edges that is next to nothing.
    pub shift: f64,
    /// Bound of the difference of the core's z/w from this one.
    pub depth_error: f64,
    /// Bound of the relative difference of the core's 1/w from this one.
    pub weight_error: f64,
}

/// A convex polygon of a primitive. One primitive has several where w changes sign inside its clipped polygon: there each
/// triangle of the fan stands for itself, since the plain division gives no common convex outline.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// The primitive's number, from 1.
    pub primitive: u32,
    /// Everything that the core may draw lies in here, up to the corners' `reach`.
    pub outer: Vec<Corner>,
    /// What the core certainly draws, up to the corners' `reach`; none means the same as `outer`.
    pub inner: Option<Vec<Corner>>,
    /// Whether `cull` removed it.
    pub culled: bool,
    /// Whether the corners' w have both signs: values may then leave the corners' range, and 1/w passes 0 inside.
    pub mixed: bool,
    /// Whether some corner's w may be 0, or clipping may change the number of corners of a mixed polygon: then nothing
    /// is known of where it lies on the screen.
    pub wild: bool,
    /// Whether every triangle of the fan has values of its own, instead of all those of one plane.
    pub fanned: bool,
    /// In how many times larger units than usual the core carries the values.
    pub headroom: f64,
}

/// An outline and what it is painted with.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon<M> {
    /// Where it is.
    pub outline: Outline,
    /// What makes a colour of the values at a sample.
    pub material: M,
}

/// A primitive as the reference has it before the screen.
pub struct Primitive<'a> {
    /// Its number, from 1.
    pub number: u32,
    /// In how many times larger units than usual the core carries its values where w has both signs.
    pub mixed_headroom: f64,
    /// Its corners in eye space.
    pub triangle: &'a [EyeCorner; 3],
    /// The clip planes of the moment.
    pub planes: &'a [Plane],
    /// The projection of the moment.
    pub projection: &'a Tracked,
    /// Width and height of the picture in px.
    pub size: [f64; 2],
    /// Whether `cull` is on.
    pub cull: bool,
    /// What attributes are linear over where the planes cut.
    pub over: Over,
}

impl Primitive<'_> {
    /// The primitive's outlines, usually one; none if no side may see anything of it.
    pub fn outlines(&self) -> Vec<Outline> {
        if self.planes.is_empty() {
            return vec![self.outline(self.screen(self.triangle), None)];
        }
        let [exact, outer, inner] = [Side::Exact, Side::Generous, Side::Strict]
            .map(|side| self.screen(&clip(self.triangle, self.planes, side, self.over)));
        if outer.len() < 3 {
            return Vec::new();
        }
        if !mixed(&outer) {
            return vec![self.outline(outer, Some(inner))];
        }
        if exact.len() != outer.len() || exact.len() != inner.len() {
            let wild = self.outline(outer, Some(Vec::new()));
            return vec![Outline { wild: true, ..wild }];
        }
        let moved: Vec<Corner> = (exact.iter().zip(&outer).zip(&inner))
            .map(|((corner, a), b)| widened(corner, a, b))
            .collect();
        (1..moved.len() - 1)
            .map(|i| self.outline(vec![moved[0], moved[i], moved[i + 1]], None))
            .collect()
    }

    fn outline(&self, mut outer: Vec<Corner>, mut inner: Option<Vec<Corner>>) -> Outline {
        let known = |c: &Corner| c.reach.is_finite() && c.position.iter().all(|x| x.is_finite());
        for corners in std::iter::once(&mut outer).chain(&mut inner) {
            let walk = walk_error(corners, self.size[1]);
            for corner in corners {
                corner.reach += walk;
                corner.shift += walk;
            }
        }
        let mixed = mixed(&outer);
        Outline {
            primitive: self.number,
            culled: self.cull && doubled_area(&outer) >= 0.0,
            mixed,
            fanned: false,
            headroom: if mixed { self.mixed_headroom } else { 1.0 },
            wild: !outer.iter().chain(inner.iter().flatten()).all(known),
            outer,
            inner,
        }
    }

    fn screen(&self, polygon: &[EyeCorner]) -> Vec<Corner> {
        (polygon.iter())
            .map(|corner| {
                let (clip, error) = self.projection.apply(&corner.eye, corner.error);
                divided(clip, error, corner, self.size)
            })
            .collect()
    }
}

/// A corner on a screen of `size` px. A vertex off by E in clip space moves x/w by at most E / (|w| - E) and, its w being off,
/// by |x/w| times as much again towards or away from the centre.
pub fn divided([x, y, z, w]: Vector, error: f64, from: &EyeCorner, size: [f64; 2]) -> Corner {
    let margin = w.abs() - error;
    let relative = if margin > 0.0 { error / margin } else { f64::INFINITY };
    let half = size.map(|s| s / 2.0);
    let shift = SNAP + relative * half[0].hypot(half[1]);
    Corner {
        position: [x / w * half[0] + half[0], y / w * half[1] + half[1]],
        z: z / w,
        w,
        color: from.at.color,
        at: from.at,
        at_error: from.at_error,
        reach: shift + relative * (x / w * half[0]).hypot(y / w * half[1]),
        shift,
        depth_error: relative * (1.0 + (z / w).abs()) + f64::EPSILON * (z / w).abs(),
        weight_error: relative,
    }
}

/// A corner that may be anywhere between its generous and its strict cut.
pub fn widened(corner: &Corner, a: &Corner, b: &Corner) -> Corner {
    let mut moved = *corner;
    for other in [a, b] {
        let [dx, dy] = [0, 1].map(|i| corner.position[i] - other.position[i]);
        moved.reach = moved.reach.max(other.reach + dx.hypot(dy));
        moved.shift = moved.shift.max(other.shift + dx.hypot(dy));
        let dz = (corner.z - other.z).abs();
        moved.depth_error = moved.depth_error.max(other.depth_error + dz);
        let dw = (corner.w / other.w - 1.0).abs();
        moved.weight_error = moved.weight_error.max(other.weight_error + dw);
    }
    moved
}

fn mixed(corners: &[Corner]) -> bool {
    corners.iter().any(|c| c.w < 0.0) && corners.iter().any(|c| c.w > 0.0)
}

/// Twice the signed area; negative is counter-clockwise as the viewer sees it, y pointing down.
pub fn doubled_area(corners: &[Corner]) -> f64 {
    let Some(first) = corners.first() else {
        return 0.0;
    };
    (corners.windows(2))
        .map(|pair| {
            let [a, b] = [0, 1].map(|k| [0, 1].map(|i| pair[k].position[i] - first.position[i]));
            a[0] * b[1] - a[1] * b[0]
        })
        .sum()
}

/// How far the reference itself is off in walking the edges, in px: the first point is rounded against the far corner's
/// coordinates, and every further row against the crossings on the visited rows.
fn walk_error(corners: &[Corner], height: f64) -> f64 {
    let mut farthest: f64 = 0.0;
    let mut crossing: f64 = 0.0;
    for (i, a) in corners.iter().enumerate() {
        let (a, b) = (a.position, corners[(i + 1) % corners.len()].position);
        farthest = farthest.max(a[0].abs()).max(a[1].abs());
        let slope = (b[0] - a[0]) / (b[1] - a[1]);
        let [from, to] = [a[1].min(b[1]), a[1].max(b[1])].map(|y| y.clamp(0.0, height));
        if slope.is_finite() && from < to {
            for row in [from, to] {
                crossing = crossing.max((a[0] + slope * (row - a[1])).abs());
            }
        }
    }
    4.0 * f64::EPSILON * farthest + height * f64::EPSILON * crossing
}

#[cfg(test)]
mod tests {
    use super::*;

    fn eye(eye: Vector, error: f64) -> EyeCorner {
        EyeCorner {
            eye,
            at: Attributes::default(),
            error,
            at_error: Bounds::default(),
        }
    }

    fn outlines(triangle: &[EyeCorner; 3], planes: &[Plane]) -> Vec<Outline> {
        let primitive = Primitive {
            number: 7,
            mixed_headroom: 1.0,
            triangle,
            planes,
            projection: &Tracked::identity(),
            size: [120.0, 80.0],
            cull: false,
            over: Over::Space,
        };
        primitive.outlines()
    }

    #[test]
    fn a_plain_triangle_reaches_little_more_than_the_snapping() {
        let corners = [[-1.0, -1.0, 0.5, 1.0], [1.0, -1.0, 0.5, 1.0], [0.0, 1.0, 0.5, 1.0]];
        let all = outlines(&corners.map(|v| eye(v, 1e-15)), &[]);
        assert_eq!(all[0].outer[0].position, [0.0, 0.0]);
        assert_eq!(all[0].outer[2].position, [60.0, 80.0]);
        for corner in &all[0].outer {
            assert!((SNAP..SNAP + 1e-11).contains(&corner.reach), "{}", corner.reach);
        }
    }

    #[test]
    fn the_reach_grows_towards_w_0_and_is_infinite_there() {
        let near = |w: f64| {
            let corners = [[0.5, 0.0, 0.0, w], [1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]];
            outlines(&corners.map(|v| eye(v, 1e-9)), &[]).remove(0)
        };
        // E / w times half the diagonal and the distance from the centre, 0.5 / w times half the width.
        let expected = 1e-9 / 1e-3 * (60f64.hypot(40.0) + 60.0 * 500.0);
        assert!((near(1e-3).outer[0].reach / (SNAP + expected) - 1.0).abs() < 1e-3);
        assert!(!near(1e-3).wild);
        assert!(near(1e-10).wild && near(0.0).wild);
    }

    #[test]
    fn a_plane_through_the_triangle_may_take_all_of_it() {
        let corners = [[-1.0, -1.0, 0.5, 1.0], [1.0, -1.0, 0.5, 1.0], [0.0, 1.0, 0.5, 1.0]];
        let plane = Plane::new([0.0, 0.0, 1.0, -0.5], &Tracked::identity());
        let all = outlines(&corners.map(|v| eye(v, 1e-15)), &[plane]);
        assert_eq!(all[0].outer.len(), 3);
        assert_eq!(all[0].inner.as_deref(), Some(&[][..]));
    }

    #[test]
    fn a_cut_near_the_parallel_of_an_edge_is_wide() {
        // The distances from the plane are 1e-13 x: off by 1e-15 they cut up to a hundredth further.
        let corners = [[-1.0, 0.0, 0.5, 1.0], [1.0, 0.0, 0.5, 1.0], [0.0, 0.5, 0.5, 1.0]];
        let plane = Plane::new([1e-13, 1.0, 0.0, 0.0], &Tracked::identity());
        let all = outlines(&corners.map(|v| eye(v, 1e-15)), &[plane]);
        let left = |corners: &[Corner]| {
            let on_edge = corners.iter().filter(|c| c.position[1] == 40.0);
            on_edge.map(|c| c.position[0]).fold(f64::INFINITY, f64::min)
        };
        let width = left(all[0].inner.as_ref().unwrap()) - left(&all[0].outer);
        assert!((0.5..10.0).contains(&width), "{width}");
    }

    #[test]
    fn mixed_signs_fall_apart_into_a_fan() {
        let corners = [[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [-1.0, 1.0, 0.0, -0.5]];
        let plane = Plane::new([-1.0, 0.0, 0.0, 0.25], &Tracked::identity());
        let all = outlines(&corners.map(|v| eye(v, 1e-15)), &[plane]);
        assert!(all.len() == 2 && all.iter().all(|p| p.primitive == 7 && p.outer.len() == 3 && !p.wild));
        assert!(all.iter().any(|p| p.mixed));
    }
}
