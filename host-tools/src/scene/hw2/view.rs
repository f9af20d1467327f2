//! What the parser must know of the transformations to tell a fault: whether a position has a place at all, and
//! whether a view has a direction. In float64 and of its own, as no back end exists yet when a scene is read.

/// The last row of the model/view matrix. It alone decides the w of a transformed vertex, and it is the product of
/// last rows only: (row of A·B) = (row of A)·B.
#[derive(Debug, Clone, Copy)]
pub struct WRow([f64; 4]);

impl WRow {
    /// The row of the identity, and of every `lookat`.
    pub const IDENTITY: Self = Self([0.0, 0.0, 0.0, 1.0]);

    /// The row of a matrix.
    pub fn load(matrix: &[[f64; 4]; 4]) -> Self {
        Self(matrix[3])
    }

    /// The row after MV = MV·matrix.
    pub fn times(self, matrix: &[[f64; 4]; 4]) -> Self {
        let column = |j: usize| self.0.iter().zip(matrix).map(|(a, row)| a * row[j]).sum();
        Self([column(0), column(1), column(2), column(3)])
    }

    /// The row after a translation.
    pub fn translate(self, by: [f64; 3]) -> Self {
        let [a, b, c, d] = self.0;
        Self([a, b, c, a * by[0] + b * by[1] + c * by[2] + d])
    }

    /// The row after scaling.
    pub fn scale(self, by: [f64; 3]) -> Self {
        let [a, b, c, d] = self.0;
        Self([a * by[0], b * by[1], c * by[2], d])
    }

    /// The row after a rotation about an axis that is not 0 (Rodrigues' formula on the row's first three).
    pub fn rotate(self, degrees: f64, axis: [f64; 3]) -> Self {
        let [a, b, c, d] = self.0;
        if [a, b, c] == [0.0; 3] {
            return self;
        }
        let axis = unit(axis);
        let (sin, cos) = degrees.to_radians().sin_cos();
        let along = dot([a, b, c], axis) * (1.0 - cos);
        let side = cross([a, b, c], axis);
        let turned = |i: usize, part: f64| part * cos + side[i] * sin + axis[i] * along;
        Self([turned(0, a), turned(1, b), turned(2, c), d])
    }

    /// Whether the transformed position has w = 0, as far as float64 can tell.
    pub fn vanishes_at(self, position: [f64; 4]) -> bool {
        let mut terms = self.0;
        for (term, value) in terms.iter_mut().zip(position) {
            *term *= value;
        }
        cancels(&terms)
    }
}

/// xyz/w of a position, or nothing where that is no point.
pub fn point([x, y, z, w]: [f64; 4]) -> Option<[f64; 3]> {
    let point = [x / w, y / w, z / w];
    point.iter().all(|value| value.is_finite()).then_some(point)
}

/// Whether two directions are parallel, or one of them 0, as far as float64 can tell.
pub fn parallel(a: [f64; 3], b: [f64; 3]) -> bool {
    // Neither may vanish or overflow in the products, so only their directions go in.
    let (a, b) = (largest_one(a), largest_one(b));
    let component = |i: usize, j: usize| cancels(&[a[i] * b[j], -a[j] * b[i]]);
    component(1, 2) && component(2, 0) && component(0, 1)
}

/// Whether a sum is 0, or so small beside its terms that only rounding keeps it from 0.
fn cancels(terms: &[f64]) -> bool {
    let sum: f64 = terms.iter().sum();
    let size: f64 = terms.iter().map(|term| term.abs()).sum();
    sum.abs() <= 4.0 * f64::EPSILON * size
}

fn largest_one(v: [f64; 3]) -> [f64; 3] {
    let largest = v.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    if largest == 0.0 {
        return v;
    }
    v.map(|value| value / largest)
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let v = largest_one(v);
    let length = dot(v, v).sqrt();
    v.map(|value| value / length)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix of `rotate`, written out as formats describe it.
    fn rotation(degrees: f64, axis: [f64; 3]) -> [[f64; 4]; 4] {
        let [x, y, z] = unit(axis);
        let (s, c) = degrees.to_radians().sin_cos();
        let t = 1.0 - c;
        [
            [x * x * t + c, x * y * t - z * s, x * z * t + y * s, 0.0],
            [y * x * t + z * s, y * y * t + c, y * z * t - x * s, 0.0],
            [x * z * t - y * s, y * z * t + x * s, z * z * t + c, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]
    }

    #[test]
    fn rows_agree_with_matrices() {
        let row = WRow([0.3, -0.7, 0.2, 0.5]);
        let axis = [1.0, -2.0, 0.5];
        let near = |a: WRow, b: WRow| a.0.iter().zip(b.0).all(|(a, b)| (a - b).abs() < 1e-15);
        assert!(near(row.rotate(33.0, axis), row.times(&rotation(33.0, axis))));
        let translation = [
            [1.0, 0.0, 0.0, 2.0],
            [0.0, 1.0, 0.0, 3.0],
            [0.0, 0.0, 1.0, 4.0],
            [0.0, 0.0, 0.0, 1.0],
        ];
        assert!(near(row.translate([2.0, 3.0, 4.0]), row.times(&translation)));
        let scaling = [
            [2.0, 0.0, 0.0, 0.0],
            [0.0, 3.0, 0.0, 0.0],
            [0.0, 0.0, 4.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ];
        assert!(near(row.scale([2.0, 3.0, 4.0]), row.times(&scaling)));
    }

    #[test]
    fn parallel_means_the_direction_only() {
        let f = [0.1, 0.2, 0.3];
        assert!(parallel(f, [1.0, 2.0, 3.0]), "only rounding keeps these apart");
        assert!(parallel(f, [-1e-300, -2e-300, -3e-300]));
        assert!(parallel(f, [0.0; 3]));
        assert!(!parallel([1e-200, 0.0, 0.0], [0.0, 1e-200, 0.0]));
        assert!(!parallel([1e200, 0.0, 0.0], [1e200, 1e190, 0.0]));
        assert!(!parallel([1.0, 0.0, 0.0], [1.0, 1e-16, 0.0]));
    }
}
