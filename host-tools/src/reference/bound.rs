//! How far the fixed-point core's matrices may be from the reference's: one scalar per matrix, ‖ΔM‖ in the Frobenius norm.
//!
//! Of A' = A + ΔA and B' = B + ΔB, each rounded, the product is off by at most
//! ‖A‖₂ ‖ΔB‖ + ‖ΔA‖ ‖B‖₂ + ‖ΔA‖ ‖ΔB‖ + u ‖A‖ ‖B‖, with u the rounding of both sides. The spectral norms are bounded tightly, so
//! that a thousand rotations add up instead of doubling a thousand times.

use super::matrix::{Matrix, Vector, cross, length, unit};
use crate::compare::stated::{FIXED_PRODUCT, FIXED_TRIGONOMETRY, FLOAT_PRODUCT};

/// One rounding of both sides, against the product of the norms.
const ROUNDING: f64 = FIXED_PRODUCT + FLOAT_PRODUCT;

/// A matrix and the bound of its difference from the core's.
#[derive(Debug, Clone, Copy)]
pub struct Tracked {
    /// The reference's matrix.
    pub matrix: Matrix,
    /// Bound of ‖M_core - M‖ in the Frobenius norm.
    pub error: f64,
    /// Bound of ‖M‖₂.
    norm: f64,
}

impl Tracked {
    /// A matrix whose error is known.
    pub fn new(matrix: Matrix, error: f64) -> Self {
        let norm = spectral_bound(&matrix);
        Self { matrix, error, norm }
    }

    /// The identity: exact on both sides.
    pub fn identity() -> Self {
        Self::new(Matrix::IDENTITY, 0.0)
    }

    /// A matrix given by its numbers: the core rounds them to its shared exponent.
    pub fn given(matrix: Matrix) -> Self {
        Self::new(matrix, FIXED_PRODUCT * frobenius(&matrix))
    }

    /// A matrix each of whose entries is a handful of operations on given numbers (`frustum`, `ortho`): at most 8 roundings
    /// each, of quotients that do not cancel beyond the given numbers' own differences.
    pub fn computed(matrix: Matrix, cancellation: f64) -> Self {
        Self::new(matrix, 8.0 * cancellation * ROUNDING * frobenius(&matrix))
    }

    /// A rotation. The reference's angle |d| π/180 is rounded twice; each entry is a sum of two terms below 1 of at most
    /// 20 roundings, nine entries of which weigh three times that.
    pub fn rotation(degrees: f64, axis: [f64; 3]) -> Self {
        let angle = degrees.to_radians().abs() * f64::EPSILON;
        let entries = 60.0 * (f64::EPSILON + FIXED_TRIGONOMETRY);
        Self::new(
            Matrix::rotation(degrees, axis),
            std::f64::consts::SQRT_2 * angle + entries,
        )
    }

    /// A rotation by an angle in radians, which the core takes as a fraction of a turn, to 2⁻⁶⁴ of it.
    pub fn turning(radians: f64, axis: [f64; 3]) -> Self {
        Self::new(
            Matrix::turning(radians, axis),
            60.0 * (f64::EPSILON + FIXED_TRIGONOMETRY),
        )
    }

    /// The turning part of `lookat`. Differences cancel: relative errors grow by the ratios that are divided by.
    pub fn looking(eye: [f64; 3], center: [f64; 3], up: [f64; 3]) -> Self {
        let forward = [0, 1, 2].map(|i| center[i] - eye[i]);
        let u = 4.0 * (f64::EPSILON + FIXED_PRODUCT);
        let f = u * (1.0 + (length(eye) + length(center)) / length(forward));
        let s = (f + u) * 2.0 * length(up) / length(cross(unit(forward), up));
        let error = f + s + (f + s + u);
        Self::new(Matrix::looking(forward, up), error)
    }

    /// What directions see of this matrix, as a factor of their own: the inverse transpose of its 3x3 part; the identity
    /// if that is singular. Cofactors are off by u ‖M‖², the determinant by u ‖M‖³, and ΔM moves the inverse by ‖M⁻¹‖² ‖ΔM‖.
    pub fn for_directions(&self) -> Self {
        let Some((inverse, determinant)) = self.matrix.inverse_transpose() else {
            return Self::identity();
        };
        let m = frobenius(&self.matrix.linear_part());
        let i = frobenius(&inverse);
        let rounding = 8.0 * ROUNDING * m * m / determinant.abs() * (1.0 + i * m);
        Self::new(inverse, rounding + i * i * self.error)
    }

    /// The product, with the bound of its error.
    #[must_use]
    pub fn times(&self, right: &Self) -> Self {
        let rounding = ROUNDING * frobenius(&self.matrix) * frobenius(&right.matrix);
        let error = self.norm * right.error + self.error * right.norm + self.error * right.error + rounding;
        Self::new(self.matrix.times(&right.matrix), error)
    }

    /// The transposed matrix, which is as far off.
    #[must_use]
    pub fn transposed(&self) -> Self {
        Self::new(self.matrix.transposed(), self.error)
    }

    /// The vector transformed, and the bound of the length of its difference from the core's; `error` is that of `v`.
    pub fn apply(&self, v: &Vector, error: f64) -> (Vector, f64) {
        let size = size(v);
        let off = self.norm * error + self.error * (size + error) + ROUNDING * frobenius(&self.matrix) * size;
        (self.matrix.apply(v), off)
    }
}

/// How much more than a rounding the differences of paired planes (l and r, b and t, n and f) are off, at the worst.
pub fn cancellation(planes: &[f64; 6]) -> f64 {
    (planes.chunks(2))
        .map(|pair| 1.0 + 2.0 * (pair[0].abs() + pair[1].abs()) / (pair[1] - pair[0]).abs())
        .fold(1.0, f64::max)
}

/// The length of all four components.
pub fn size(v: &Vector) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

fn frobenius(m: &Matrix) -> f64 {
    m.0.iter().flatten().map(|e| e * e).sum::<f64>().sqrt()
}

/// An upper bound of the spectral norm, at most 3.3e-7 too large: σ₁^(2·2^k) ≤ ‖(MᵀM)^(2^k)‖ ≤ 2 σ₁^(2·2^k) with k = 20
/// squarings, so that the excess stays small over thousands of products. Each square is scaled to norm 1 and the scale's
/// logarithm carried, so that nothing overflows; a rounding's weight halves with every squaring that follows.
fn spectral_bound(m: &Matrix) -> f64 {
    const SQUARINGS: i32 = 20;
    let scaled = |m: &Matrix, by: f64| Matrix(m.0.map(|row| row.map(|e| e / by)));
    let whole = frobenius(m);
    if whole == 0.0 {
        return 0.0;
    }
    let one = scaled(m, whole);
    let mut power = one.transposed().times(&one);
    let mut logarithm = 0.0;
    for k in 0..=SQUARINGS {
        if k > 0 {
            power = power.times(&power);
            logarithm *= 2.0;
        }
        let n = frobenius(&power);
        logarithm += n.ln();
        power = scaled(&power, n);
    }
    // The last factor covers the rounding of all this.
    whole * (logarithm / f64::from(2 << SQUARINGS)).exp() * (1.0 + 1e-12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_counts_as_one() {
        let r = Tracked::rotation(37.0, [1.0, -2.0, 3.0]);
        assert!((1.0..1.000_001).contains(&r.norm), "{}", r.norm);
    }

    #[test]
    fn the_norm_of_a_scaling_is_its_largest_factor() {
        for s in [1e-150, 3.0, 1e150] {
            let m = Matrix::scaling([s, 0.5 * s, -0.1 * s]).linear_part();
            let ratio = spectral_bound(&m) / s;
            assert!((1.0..1.000_001).contains(&ratio), "{ratio}");
        }
        assert_eq!(spectral_bound(&Matrix([[0.0; 4]; 4])), 0.0);
    }

    #[test]
    fn a_thousand_rotations_add_up() {
        let step = Tracked::rotation(0.36, [0.3, 0.2, 1.0]);
        let mut all = Tracked::identity();
        for _ in 0..1000 {
            all = all.times(&step);
        }
        assert!(all.error < 1200.0 * step.error, "{} {}", all.error, step.error);
        let off = frobenius(&Matrix(std::array::from_fn(|i| {
            std::array::from_fn(|j| all.matrix.0[i][j] - Matrix::IDENTITY.0[i][j])
        })));
        assert!(off < all.error, "{off} {}", all.error);
    }

    #[test]
    fn scaling_there_and_back_keeps_the_bound() {
        let there = Tracked::given(Matrix::scaling([1e6, 1e6, 1e6]).linear_part());
        let back = Tracked::given(Matrix::scaling([1e-6, 1e-6, 1e-6]).linear_part());
        assert!(there.times(&back).error < 1e-14);
    }

    #[test]
    fn a_nearly_parallel_up_vector_is_uncertain() {
        let far = Tracked::looking([0.0; 3], [0.0, 0.0, -1.0], [0.0, 1e-9, 1.0]);
        let good = Tracked::looking([0.0; 3], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]);
        assert!(far.error > 1e8 * good.error);
    }
}
