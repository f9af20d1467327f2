//! 4x4 matrices in float64 (formats/hw2.md section 4): column vectors, rows in the order of the text.
//!
//! The order of every sum matters: the official pictures show the ties that IEEE doubles gave, so a dot product is
//! summed from left to right and nothing is fused or reassociated.

/// x, y, z, w.
pub type Vector = [f64; 4];

/// A 4x4 matrix, row by row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matrix(pub [[f64; 4]; 4]);

impl Matrix {
    /// Leaves every vector as it is.
    pub const IDENTITY: Self = Self([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]);

    /// `self` times a column vector.
    pub fn apply(&self, v: &Vector) -> Vector {
        self.0.map(|r| r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + r[3] * v[3])
    }

    /// `self` times `right`: what `right` does comes first.
    #[must_use]
    pub fn times(&self, right: &Self) -> Self {
        let columns = right.transposed().0;
        let mut product = [[0.0; 4]; 4];
        for (j, column) in columns.iter().enumerate() {
            for (i, entry) in self.apply(column).into_iter().enumerate() {
                product[i][j] = entry;
            }
        }
        Self(product)
    }

    /// Rows become columns.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let m = &self.0;
        Self([0, 1, 2, 3].map(|j| [m[0][j], m[1][j], m[2][j], m[3][j]]))
    }

    /// Moves points by `by`.
    pub fn translation(by: [f64; 3]) -> Self {
        let mut m = Self::IDENTITY;
        for (row, d) in m.0.iter_mut().zip(by) {
            row[3] = d;
        }
        m
    }

    /// Multiplies x, y, z by the factors.
    pub fn scaling(by: [f64; 3]) -> Self {
        let mut m = Self::IDENTITY;
        for (i, s) in by.into_iter().enumerate() {
            m.0[i][i] = s;
        }
        m
    }

    /// Turns by `degrees` about `axis`, which is normalised first; counter-clockwise in a right-handed frame.
    pub fn rotation(degrees: f64, axis: [f64; 3]) -> Self {
        Self::turning(degrees.to_radians(), axis)
    }

    /// As [`rotation`](Self::rotation), by an angle in radians.
    pub fn turning(radians: f64, axis: [f64; 3]) -> Self {
        let (s, c) = radians.sin_cos();
        let [x, y, z] = unit(axis);
        let d = 1.0 - c;
        Self([
            [x * x * d + c, x * y * d - z * s, x * z * d + y * s, 0.0],
            [y * x * d + z * s, y * y * d + c, y * z * d - x * s, 0.0],
            [x * z * d - y * s, y * z * d + x * s, z * z * d + c, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ])
    }

    /// The turning part of `lookat`: rows s, u', -f, for an eye at the origin that looks along `forward`.
    pub fn looking(forward: [f64; 3], up: [f64; 3]) -> Self {
        let f = unit(forward);
        let s = unit(cross(f, up));
        let u = cross(s, f);
        Self([
            [s[0], s[1], s[2], 0.0],
            [u[0], u[1], u[2], 0.0],
            [-f[0], -f[1], -f[2], 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ])
    }

    /// `frustum` l r b t n f.
    pub fn frustum([l, r, b, t, n, f]: [f64; 6]) -> Self {
        Self([
            [2.0 * n / (r - l), 0.0, (r + l) / (r - l), 0.0],
            [0.0, 2.0 * n / (t - b), (t + b) / (t - b), 0.0],
            [0.0, 0.0, -(f + n) / (f - n), -2.0 * f * n / (f - n)],
            [0.0, 0.0, -1.0, 0.0],
        ])
    }

    /// `ortho` l r b t n f, which takes -n to depth 0 and -f to depth 1.
    pub fn ortho([l, r, b, t, n, f]: [f64; 6]) -> Self {
        let n = 2.0 * n - f;
        Self([
            [2.0 / (r - l), 0.0, 0.0, -(r + l) / (r - l)],
            [0.0, 2.0 / (t - b), 0.0, -(t + b) / (t - b)],
            [0.0, 0.0, -2.0 / (f - n), -(f + n) / (f - n)],
            [0.0, 0.0, 0.0, 1.0],
        ])
    }

    /// The upper left 3x3 part, zeroes elsewhere: what directions see of a matrix.
    #[must_use]
    pub fn linear_part(&self) -> Self {
        let mut m = Self([[0.0; 4]; 4]);
        for (row, own) in m.0.iter_mut().zip(&self.0).take(3) {
            row[..3].copy_from_slice(&own[..3]);
        }
        m
    }

    /// The inverse transpose of the upper left 3x3 part and the determinant it was divided by; none if singular.
    pub fn inverse_transpose(&self) -> Option<(Self, f64)> {
        let row = |i: usize| [self.0[i][0], self.0[i][1], self.0[i][2]];
        let (a, b, c) = (row(0), row(1), row(2));
        let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = dot(a, cofactors[0]);
        if determinant == 0.0 || !determinant.is_finite() {
            return None;
        }
        let mut m = Self([[0.0; 4]; 4]);
        for (row, cofactor) in m.0.iter_mut().zip(cofactors) {
            for (entry, value) in row.iter_mut().zip(cofactor) {
                *entry = value / determinant;
            }
        }
        Some((m, determinant))
    }
}

/// The vector's length.
pub fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// The vector divided by its length.
pub fn unit(v: [f64; 3]) -> [f64; 3] {
    let l = length(v);
    v.map(|c| c / l)
}

/// The vector divided by its length, however long or short it is; 0 stays 0.
pub fn unit_or_zero(v: [f64; 3]) -> [f64; 3] {
    let largest = v.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    match largest {
        0.0 => v,
        // Squares that would leave the range of numbers.
        _ if !(1e-100..1e100).contains(&largest) => unit(v.map(|c| c / largest)),
        _ => unit(v),
    }
}

/// The cross product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The dot product.
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: &Matrix, b: [[f64; 4]; 4]) {
        for (x, y) in a.0.iter().flatten().zip(b.iter().flatten()) {
            assert!((x - y).abs() < 1e-12, "{a:?} is not {b:?}");
        }
    }

    #[test]
    fn what_was_added_last_acts_first() {
        let mv = Matrix::translation([1.0, 2.0, 3.0]).times(&Matrix::scaling([2.0, 3.0, 4.0]));
        assert_eq!(mv.apply(&[1.0, 1.0, 1.0, 1.0]), [3.0, 5.0, 7.0, 1.0]);
    }

    #[test]
    fn a_quarter_turn_about_each_axis() {
        let turned = |axis, v: Vector| Matrix::rotation(90.0, axis).apply(&v);
        let near = |a: Vector, b: Vector| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
        assert!(near(
            turned([2.0, 0.0, 0.0], [0.0, 1.0, 0.0, 1.0]),
            [0.0, 0.0, 1.0, 1.0]
        ));
        assert!(near(
            turned([0.0, 3.0, 0.0], [0.0, 0.0, 1.0, 1.0]),
            [1.0, 0.0, 0.0, 1.0]
        ));
        assert!(near(
            turned([0.0, 0.0, 0.1], [1.0, 0.0, 0.0, 1.0]),
            [0.0, 1.0, 0.0, 1.0]
        ));
    }

    #[test]
    fn a_third_of_a_turn_about_the_diagonal_permutes_the_axes() {
        near(
            &Matrix::rotation(120.0, [1.0, 1.0, 1.0]),
            [
                [0.0, 0.0, 1.0, 0.0],
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 0.0, 1.0],
            ],
        );
    }

    #[test]
    fn frustum_by_hand() {
        // The reference file's arguments: t < b and n, f < 0.
        near(
            &Matrix::frustum([-0.5, 0.5, 0.1, -0.5, -0.5, -10.0]),
            [
                [-1.0, 0.0, 0.0, 0.0],
                [0.0, 5.0 / 3.0, 2.0 / 3.0, 0.0],
                [0.0, 0.0, -10.5 / 9.5, 10.0 / 9.5],
                [0.0, 0.0, -1.0, 0.0],
            ],
        );
    }

    #[test]
    fn ortho_takes_minus_n_to_0_and_minus_f_to_1() {
        let p = Matrix::ortho([2.0, -2.5, -2.0, -0.5, -5.5, -2.5]);
        assert!(p.apply(&[0.0, 0.0, 5.5, 1.0])[2].abs() < 1e-15);
        assert!((p.apply(&[0.0, 0.0, 2.5, 1.0])[2] - 1.0).abs() < 1e-15);
        assert!((p.apply(&[2.0, -2.0, 0.0, 1.0])[0] + 1.0).abs() < 1e-15);
        assert!((p.apply(&[2.0, -0.5, 0.0, 1.0])[1] - 1.0).abs() < 1e-15);
    }

    #[test]
    fn looking_along_minus_z_with_y_up_changes_nothing() {
        near(&Matrix::looking([0.0, 0.0, -2.0], [0.0, 5.0, 1.0]), Matrix::IDENTITY.0);
    }

    #[test]
    fn inverse_transpose_of_a_scaling_is_the_reciprocal() {
        let (m, determinant) = Matrix::scaling([2.0, 4.0, 5.0]).inverse_transpose().unwrap();
        assert_eq!(determinant, 40.0);
        near(&m, Matrix::scaling([0.5, 0.25, 0.2]).linear_part().0);
        let shear = Matrix([
            [1.0, 2.0, 0.0, 9.0],
            [0.0, 1.0, 3.0, 9.0],
            [0.0, 0.0, 1.0, 9.0],
            [0.0; 4],
        ]);
        let (m, _) = shear.inverse_transpose().unwrap();
        near(
            &m.transposed().times(&shear.linear_part()),
            Matrix::IDENTITY.linear_part().0,
        );
        assert!(Matrix::scaling([1.0, 0.0, 1.0]).inverse_transpose().is_none());
    }
}
