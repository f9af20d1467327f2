//! Transformations of objects and the camera (05.8, 07.1, 07.2), on the matrices of the reference.

use crate::reference::matrix::{Matrix, cross, dot, unit};

/// Where an object is: scaled first, then turned, then moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// The place of its origin.
    pub position: [f64; 3],
    /// Factors along its own axes.
    pub scale: [f64; 3],
    /// Degrees and axis, counter-clockwise for who looks against the axis.
    pub turn: (f64, [f64; 3]),
}

impl Default for Transform {
    fn default() -> Self {
        Self {
            position: [0.0; 3],
            scale: [1.0; 3],
            turn: (0.0, [0.0, 0.0, 1.0]),
        }
    }
}

impl Transform {
    /// T R S.
    pub fn matrix(&self) -> Matrix {
        let (degrees, axis) = self.turn;
        Matrix::translation(self.position)
            .times(&Matrix::rotation(degrees, axis))
            .times(&Matrix::scaling(self.scale))
    }
}

/// World to view, for an eye that looks at a point: right-handed, along −z.
pub fn look_at(eye: [f64; 3], center: [f64; 3], up: [f64; 3]) -> Matrix {
    let z = unit([0, 1, 2].map(|i| eye[i] - center[i]));
    let x = unit(cross(up, z));
    let y = cross(z, x);
    let row = |axis: [f64; 3]| [axis[0], axis[1], axis[2], -dot(axis, eye)];
    Matrix([row(x), row(y), row(z), [0.0, 0.0, 0.0, 1.0]])
}

/// View to clip space. `degrees` is the full **horizontal** angle, `aspect` width over height.
pub fn perspective(degrees: f64, aspect: f64, near: f64, far: f64) -> Matrix {
    let xs = near * (degrees.to_radians() / 2.0).tan();
    let ys = xs / aspect;
    Matrix([
        [near / xs, 0.0, 0.0, 0.0],
        [0.0, near / ys, 0.0, 0.0],
        [0.0, 0.0, -(far + near) / (far - near), -2.0 * far * near / (far - near)],
        [0.0, 0.0, -1.0, 0.0],
    ])
}

#[cfg(test)]
mod tests {
    use super::super::program::{Values, Vertex};
    use super::super::state::Viewport;
    use super::super::window::place;
    use super::*;

    fn near(found: &[f64], expected: &[f64]) {
        assert_eq!(found.len(), expected.len());
        let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-5 * b.abs().max(0.1);
        assert!(found.iter().zip(expected).all(close), "{found:?} is not {expected:?}");
    }

    fn view() -> Matrix {
        look_at([-2.5, 1.0, 0.0], [0.0; 3], [0.0, 1.0, 0.0])
    }

    #[test]
    fn i05_8_scaled_then_turned_then_moved() {
        let square = Transform {
            position: [225.0, 225.0, 0.0],
            scale: [45.0, 60.0, 1.0],
            turn: (37.0, [0.0, 0.0, 2.0]),
        };
        near(&square.matrix().apply(&[1.0, 1.0, 0.0, 1.0])[..2], &[224.83, 300.00]);
        assert_eq!(Transform::default().matrix(), Matrix::IDENTITY);
    }

    #[test]
    fn i07_1_the_view_of_the_playground() {
        let expected = [
            [0.0, 0.0, 1.0, 0.0],
            [0.371391, 0.928477, 0.0, 0.0],
            [-0.928477, 0.371391, 0.0, -2.692582],
            [0.0, 0.0, 0.0, 1.0],
        ];
        near(view().0.as_flattened(), expected.as_flattened());
    }

    #[test]
    fn i07_2_the_angle_is_horizontal() {
        let m = perspective(120.0, 4.0 / 3.0, 0.1, 100.0).0;
        near(
            &[m[0][0], m[1][1], m[2][2], m[2][3], m[3][2]],
            &[0.57735, 0.769800, -1.002002, -0.200200, -1.0],
        );
    }

    #[test]
    fn i07_5_a_point_of_the_playground_in_the_window() {
        let projection = perspective(120.0, 4.0 / 3.0, 0.1, 100.0);
        let position = projection.times(&view()).apply(&[-1.75, 0.5, -1.0, 1.0]);
        near(&position, &[-0.57735, -0.142948, 0.683619, 0.882053]);
        let outputs = Values::new();
        let placed = place(&Vertex { position, outputs }, &Viewport::of(400, 300)).expect("in front");
        near(&placed.window, &[69.0894, 125.6905, 0.887516, 1.133719]);
    }

    #[test]
    fn i07_10_window_depth_of_view_depths() {
        let projection = perspective(90.0, 1.0, 1.0, 3.0);
        for (z, expected) in [(-1.0, 0.0), (-1.5, 0.5), (-2.0, 0.75), (-3.0, 1.0)] {
            let position = projection.apply(&[0.0, 0.0, z, 1.0]);
            let outputs = Values::new();
            let placed = place(&Vertex { position, outputs }, &Viewport::of(10, 10)).expect("in front");
            assert!((placed.window[2] - expected).abs() < 1e-12, "{z}");
        }
    }
}
