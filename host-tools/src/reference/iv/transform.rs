//! From object to world to clip coordinates (formats/iv.md, Matrices).

use crate::reference::matrix::{Matrix, Vector, unit_or_zero};
use crate::scene::iv::{Camera, Rotation, Transform};

/// What an object's transforms do to it.
#[derive(Debug, Clone, Copy)]
pub struct ToWorld {
    /// M: positions.
    points: Matrix,
    /// N: directions that stay perpendicular, up to their length.
    normals: Matrix,
}

impl ToWorld {
    /// The product of all of them, the first outermost.
    pub fn new(transforms: &[Transform]) -> Self {
        let mut all = Self {
            points: Matrix::IDENTITY,
            normals: Matrix::IDENTITY,
        };
        for transform in transforms {
            let turned = rotation(&transform.rotation);
            let placed = Matrix::translation(transform.translation).times(&turned);
            all.points = all
                .points
                .times(&placed.times(&Matrix::scaling(transform.scale_factor)));
            // A rotation is its own inverse transpose, and a scaling's is the scaling by the reciprocals. They are taken
            // times the smallest factor's size, so that none overflows; a normal's length does not count.
            let smallest = transform
                .scale_factor
                .iter()
                .fold(f64::MAX, |least, s| least.min(s.abs()));
            let reciprocals = transform.scale_factor.map(|s| smallest / s);
            all.normals = all.normals.times(&turned.times(&Matrix::scaling(reciprocals)));
        }
        all
    }

    /// A point's position in the world.
    pub fn point(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [x, y, z, _] = self.points.apply(&[x, y, z, 1.0]);
        [x, y, z]
    }

    /// A normal in the world, of unit length; 0 stays 0.
    pub fn normal(&self, normal: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = unit_or_zero(normal);
        let [x, y, z, _] = self.normals.apply(&[x, y, z, 0.0]);
        unit_or_zero([x, y, z])
    }
}

/// R: of angle 0 it is the identity whatever the axis.
fn rotation(rotation: &Rotation) -> Matrix {
    if rotation.angle == 0.0 {
        return Matrix::IDENTITY;
    }
    Matrix::turning(rotation.angle, unit_or_zero(rotation.axis))
}

/// World to camera to clip coordinates.
#[derive(Debug, Clone, Copy)]
pub struct ToClip {
    view: Matrix,
    projection: Matrix,
}

impl ToClip {
    /// V and P.
    pub fn new(camera: &Camera) -> Self {
        let back = camera.position.map(|c| -c);
        Self {
            // The inverse of a rotation is its transpose.
            view: (rotation(&camera.orientation).transposed()).times(&Matrix::translation(back)),
            projection: Matrix::frustum([
                camera.left,
                camera.right,
                camera.bottom,
                camera.top,
                camera.near,
                camera.far,
            ]),
        }
    }

    /// x, y, z, w of a point of the world.
    pub fn point(&self, [x, y, z]: [f64; 3]) -> Vector {
        self.projection.apply(&self.view.apply(&[x, y, z, 1.0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::matrix::dot;

    fn near(a: impl IntoIterator<Item = f64>, b: impl IntoIterator<Item = f64>) -> bool {
        a.into_iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
    }

    fn turn(axis: [f64; 3], angle: f64) -> Transform {
        Transform {
            rotation: Rotation { axis, angle },
            ..Transform::default()
        }
    }

    /// The worked example of formats/iv.md.
    #[test]
    #[expect(
        clippy::approx_constant,
        reason = "the example's angle is this number and not a part of pi"
    )]
    fn the_worked_example() {
        let world = ToWorld::new(&[turn([1.0, 1.0, 0.0], 0.7853)]);
        let rows = [
            [0.853588, 0.146412, 0.499951],
            [0.146412, 0.853588, -0.499951],
            [-0.499951, 0.499951, 0.707176],
        ];
        for (row, expected) in world.points.0.iter().zip(rows) {
            assert!(near(row.iter().copied(), expected), "{row:?}");
        }
        let clip = ToClip::new(&Camera {
            position: [0.0, 0.0, 5.0],
            left: -0.5,
            right: 0.5,
            bottom: -0.5,
            top: 0.5,
            ..Camera::default()
        });
        let p = clip.projection.0;
        let expected = [
            [2.0, 0.0, 0.0, 0.0],
            [0.0, 2.0, 0.0, 0.0],
            [0.0, 0.0, -11.0 / 9.0, -20.0 / 9.0],
            [0.0, 0.0, -1.0, 0.0],
        ];
        assert!(near(p.into_iter().flatten(), expected.into_iter().flatten()), "{p:?}");
        let corner = world.point([-1.0, 1.0, 1.0]);
        assert!(near(corner, [-0.207225, 0.207225, 1.707078]), "{corner:?}");
        let corner = clip.point(corner);
        assert!(near(corner, [-0.414451, 0.414451, 1.802460, 3.292922]), "{corner:?}");
        let [x, y, z, w] = corner;
        assert!(near([x / w, y / w, z / w], [-0.125861, 0.125861, 0.547374]));
        assert!(near(world.normal([0.0, 0.0, 1.0]), [0.499951, -0.499951, 0.707176]));
    }

    #[test]
    fn the_first_transform_is_the_outermost_and_scales_first() {
        let moved = Transform {
            translation: [1.0, 2.0, 3.0],
            scale_factor: [2.0, 3.0, 4.0],
            ..turn([0.0, 0.0, 9.0], std::f64::consts::FRAC_PI_2)
        };
        let scaled = Transform {
            scale_factor: [10.0, 10.0, -1.0],
            ..Transform::default()
        };
        let both = ToWorld::new(&[moved, scaled]);
        // (1, 0, 1) -> (10, 0, -1) -> (20, 0, -4) -> (0, 20, -4) -> (1, 22, -1)
        assert!(near(both.point([1.0, 0.0, 1.0]), [1.0, 22.0, -1.0]));
    }

    #[test]
    fn normals_stay_perpendicular_and_know_no_translation() {
        let transforms = [
            Transform {
                translation: [5.0, -7.0, 100.0],
                scale_factor: [1.5, 0.25, -3.0],
                ..turn([1.0, 2.0, 3.0], 0.7)
            },
            Transform {
                translation: [1.0, 0.0, 0.0],
                scale_factor: [0.5, 8.0, 1.0],
                ..turn([-1.0, 0.0, 0.5], 2.0)
            },
        ];
        let world = ToWorld::new(&transforms);
        let (normal, tangent) = ([1.0, -2.0, 0.5], [1.0, 1.0, 2.0]);
        let (from, to) = (world.point([0.0; 3]), world.point(tangent));
        let turned = world.normal(normal);
        assert!(dot(turned, [0, 1, 2].map(|i| to[i] - from[i])).abs() < 1e-12);
        // The same as the inverse transpose of M's linear part, whose determinant is positive or negative as theirs.
        let (inverse, _) = world.points.inverse_transpose().unwrap();
        let [x, y, z, _] = inverse.apply(&[1.0, -2.0, 0.5, 0.0]);
        assert!(near(unit_or_zero([x, y, z]), turned));
        assert_eq!(world.normal([0.0; 3]), [0.0; 3]);
    }

    #[test]
    fn extreme_numbers_keep_their_direction() {
        let tiny = Transform {
            scale_factor: [5e-324, 5e-324, 1e-320],
            ..turn([0.0, 1e-300, 0.0], std::f64::consts::PI)
        };
        let normal = ToWorld::new(&[tiny]).normal([1e300, 0.0, 0.0]);
        assert!(near(normal, [-1.0, 0.0, 0.0]), "{normal:?}");
        let still = turn([0.0; 3], 0.0);
        assert_eq!(ToWorld::new(&[still]).point([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn the_camera_looks_along_its_own_minus_z() {
        let camera = Camera {
            position: [3.0, 0.0, 0.0],
            orientation: Rotation {
                axis: [0.0, 1.0, 0.0],
                angle: std::f64::consts::FRAC_PI_2,
            },
            ..Camera::default()
        };
        // Turned to the left it looks along -x; two in front of it and one to its right is (1, 0, -1).
        let [x, y, _, w] = ToClip::new(&camera).point([1.0, 0.5, -1.0]);
        assert!(near([x, y, w], [1.0, 0.5, 2.0]), "{x} {y} {w}");
    }
}
