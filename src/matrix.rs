//! Matrices: model/view, projection, and the matrix of directions.
//!
//! Column vectors: a vertex v becomes P·MV·v, and what is multiplied last acts on the point first. Every function here
//! rounds once per entry of its result, relative to the largest entry ([`Block`]): 2^-BITS for a product. Angles go
//! through [`Trigonometry`], unit vectors through [`Block::unit`].

use crate::clip::distance_of;
use crate::error::Error;
use crate::num::{Angle, Block, Scaled, Trigonometry, Wide, Word};

/// A 4×4 matrix, row by row, with one shared scale.
///
/// ```
/// use fixel::matrix::Matrix;
/// use fixel::num::Block;
/// let move_right = Matrix::<i32>::translation(Block::from_integers([5, 0, 0]));
/// let point = Block::from_integers([1, 2, 3, 1]);
/// assert_eq!(move_right.transform(point), Block::from_integers([6, 2, 3, 1]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Matrix<T>(Block<T, 16>);

impl<T: Word> Matrix<T> {
    /// The matrix whose entries, row by row, share the scale of `entries`.
    ///
    /// ```
    /// use fixel::{matrix::Matrix, num::Block};
    /// let m = Block::from_integers([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    /// assert_eq!(Matrix::<i64>::from_rows(m), Matrix::identity());
    /// ```
    pub fn from_rows(entries: Block<T, 16>) -> Self {
        Matrix(entries)
    }

    /// Entries of different scales, rounded to that of the largest.
    pub fn from_scaled(entries: [Scaled<T>; 16]) -> Self {
        Matrix(Block::gather(entries))
    }

    /// 1 on the diagonal.
    pub fn identity() -> Self {
        Matrix(Block::from_integers([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]))
    }

    /// `self` · `other`: `other` acts on the point first.
    ///
    /// Each entry is the exact sum of four products, rounded once: 2^-BITS of the largest entry of the result.
    ///
    /// ```
    /// use fixel::{matrix::Matrix, num::{Angle, Block, SineTable}};
    /// let z = Block::from_integers([0, 0, 1]);
    /// let quarter = Matrix::<i64>::rotation::<SineTable>(Angle::from_degrees(90), z).unwrap();
    /// let half = Matrix::rotation::<SineTable>(Angle::from_degrees(180), z).unwrap();
    /// assert_eq!(quarter.product(&quarter), half);
    /// ```
    pub fn product(&self, other: &Self) -> Self {
        let [a, b, c, d] = self.rows();
        let [x, y, z, w] = other.columns();
        let row = |r: [T; 4]| [dot(r, x), dot(r, y), dot(r, z), dot(r, w)];
        let [[a0, a1, a2, a3], [b0, b1, b2, b3], [c0, c1, c2, c3], [d0, d1, d2, d3]] = [row(a), row(b), row(c), row(d)];
        let entries = [a0, a1, a2, a3, b0, b1, b2, b3, c0, c1, c2, c3, d0, d1, d2, d3];
        Matrix(Block::from_wide(
            entries,
            self.0.exponent().saturating_add(other.0.exponent()),
        ))
    }

    /// The point M·v, rounded once: 2^-BITS of its largest component.
    pub fn transform(&self, v: Block<T, 4>) -> Block<T, 4> {
        let m = v.mantissas();
        Block::from_wide_here(
            self.rows().map(|r| dot(r, m)),
            self.0.exponent().saturating_add(v.exponent()),
        )
    }

    /// As [`transform`](Self::transform), to the same bits, by less code and more instructions.
    pub(crate) fn transform_compact(&self, v: &mut Block<T, 4>) {
        let mut sums = [T::Wide::ZERO; 4];
        for (sum, row) in sums.iter_mut().zip(self.0.as_mantissas().as_chunks::<4>().0) {
            *sum = distance_of(row, v);
        }
        v.set_wide(&mut sums, self.0.exponent().saturating_add(v.exponent()));
    }

    /// As [`transform`](Self::transform) of the point (x, y, z, 1) with x, y, z in units of 2^-15, to the same bits: sixteen
    /// multiplications and one rounding, without making a block of the point first.
    #[inline]
    pub fn transform_point(&self, [x, y, z]: [i16; 3]) -> Block<T, 4> {
        let point = [x as i32, y as i32, z as i32, 1 << 15].map(T::from_i32);
        let [a, b, c, d] = self.rows();
        Block::from_wide_here(
            [dot(a, point), dot(b, point), dot(c, point), dot(d, point)],
            self.0.exponent().saturating_sub(15),
        )
    }

    /// Moves by `by`.
    pub fn translation(by: Block<T, 3>) -> Self {
        let [x, y, z] = by.split();
        let (i, o) = (Scaled::from_integer(1), Scaled::ZERO);
        Self::from_scaled([i, o, o, x, o, i, o, y, o, o, i, z, o, o, o, i])
    }

    /// Scales along the axes.
    pub fn scaling(by: Block<T, 3>) -> Self {
        let [x, y, z] = by.split();
        let (i, o) = (Scaled::from_integer(1), Scaled::ZERO);
        Self::from_scaled([x, o, o, o, o, y, o, o, o, o, z, o, o, o, o, i])
    }

    /// Turns by `angle` about `axis`, counter-clockwise in a right-handed frame with y up.
    ///
    /// # Errors
    /// [`Error::ZeroVector`] for an axis of length 0.
    pub fn rotation<S: Trigonometry>(angle: Angle, axis: Block<T, 3>) -> Result<Self, Error> {
        Ok(Self::from_linear(
            rotation_rows::<T, S>(angle, axis)?,
            -(T::BITS as i32),
        ))
    }

    /// The view from `eye` towards `center`, with `up` upwards on the screen: rows (s, u, −f) · translation(−eye).
    ///
    /// # Errors
    /// [`Error::ZeroVector`] where eye and center coincide or up is parallel to the view.
    pub fn look_at(eye: Block<T, 3>, center: Block<T, 3>, up: Block<T, 3>) -> Result<Self, Error> {
        let turn = Self::from_linear(look_at_rows(eye, center, up)?, -(T::BITS as i32));
        Ok(turn.product(&Self::translation(eye.negated())))
    }

    /// World space to eye space for a camera at `position`, turned by `angle` about `axis` from looking along −z with y up:
    /// the inverse of translation(position) · rotation(angle, axis), which is that rotation transposed · translation(−position).
    ///
    /// With angle 0 the axis does not matter, not even one of length 0.
    ///
    /// Entries share one scale: far from the origin the turn keeps 2^-BITS of the position. With 32-bit words and a camera
    /// thousands of lengths away from the origin, move the scene there first.
    ///
    /// # Errors
    /// [`Error::ZeroVector`] for an axis of length 0 with any other angle.
    ///
    /// ```
    /// use fixel::{matrix::Matrix, num::{Angle, Block, SineTable}};
    /// // At (5, 0, 0), turned to the left by 90°: looking along −x, with the world's −z to the right.
    /// let (position, axis) = (Block::from_integers([5, 0, 0]), Block::from_integers([0, 1, 0]));
    /// let camera = Matrix::<i32>::camera::<SineTable>(position, axis, Angle::from_degrees(90))?;
    /// let seen = camera.transform(Block::from_integers([2, 0, -1, 1]));
    /// assert_eq!(seen, Block::from_integers([1, 0, -3, 1]));
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    pub fn camera<S: Trigonometry>(position: Block<T, 3>, axis: Block<T, 3>, angle: Angle) -> Result<Self, Error> {
        let back = Self::translation(position.negated());
        if angle == Angle::default() {
            return Ok(back);
        }
        let [[a, b, c], [d, e, f], [g, h, i]] = rotation_rows::<T, S>(angle, axis)?;
        let turn = Self::from_linear([[a, d, g], [b, e, h], [c, f, i]], -(T::BITS as i32));
        Ok(turn.product(&back))
    }

    /// The perspective projection of `glFrustum`: left, right, bottom, top, near, far; they may be negative or reversed.
    ///
    /// # Errors
    /// [`Error::FlatView`] where left = right, bottom = top or near = far.
    pub fn frustum([l, r, b, t, n, f]: [Scaled<T>; 6]) -> Result<Self, Error> {
        let (width, height, depth) = (r.minus(l), t.minus(b), f.minus(n));
        let over = |a: Scaled<T>, d| a.over(d).ok_or(Error::FlatView);
        let o = Scaled::ZERO;
        Ok(Self::from_scaled([
            over(n.scaled(1), width)?,
            o,
            over(r.plus(l), width)?,
            o,
            o,
            over(n.scaled(1), height)?,
            over(t.plus(b), height)?,
            o,
            o,
            o,
            over(f.plus(n), depth)?.negated(),
            over(f.times(n).scaled(1), depth)?.negated(),
            o,
            o,
            Scaled::from_integer(-1),
            o,
        ]))
    }

    /// The perspective projection with the full *horizontal* angle `fov`, and `aspect` times as wide as high: entries
    /// 1/tan(fov/2), aspect/tan(fov/2), −(f+n)/(f−n), −2fn/(f−n), and −1 for w = −z.
    ///
    /// # Errors
    /// [`Error::FlatView`] for an angle of 0 or where near = far.
    ///
    /// ```
    /// use fixel::{matrix::Matrix, num::{Angle, Scaled, SineTable}};
    /// let [near, far] = [1, 3].map(Scaled::from_integer);
    /// let square = Scaled::from_integer(1);
    /// let wide = Matrix::<i64>::perspective::<SineTable>(Angle::from_degrees(90), square, near, far)?;
    /// let frustum = Matrix::frustum([-1, 1, -1, 1, 1, 3].map(Scaled::from_integer))?;
    /// assert_eq!(wide.entries().split()[10], frustum.entries().split()[10]);
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    pub fn perspective<S: Trigonometry>(
        fov: Angle,
        aspect: Scaled<T>,
        near: Scaled<T>,
        far: Scaled<T>,
    ) -> Result<Self, Error> {
        let (sin, cos) = S::sin_cos::<T>(Angle::from_turns(fov.turns() / 2));
        let unit = |m: T| Scaled::new([m], -(T::BITS as i32));
        let x = unit(cos).over(unit(sin)).ok_or(Error::FlatView)?;
        let depth = far.minus(near);
        let over = |a: Scaled<T>| a.over(depth).ok_or(Error::FlatView);
        let (z, zw) = (
            over(far.plus(near))?.negated(),
            over(far.times(near).scaled(1))?.negated(),
        );
        let (o, y) = (Scaled::ZERO, x.times(aspect));
        let w = Scaled::from_integer(-1);
        Ok(Self::from_scaled([x, o, o, o, o, y, o, o, o, o, z, zw, o, o, w, o]))
    }

    /// An object in the world: `translation(position)` · `rotation` · `scaling(scale)`.
    ///
    /// ```
    /// use fixel::{matrix::Matrix, num::Block};
    /// let (position, scale) = (Block::from_integers([5, 0, 0]), Block::from_integers([2, 2, 2]));
    /// let object = Matrix::<i32>::model(position, &Matrix::identity(), scale);
    /// assert_eq!(object.transform(Block::from_integers([1, 1, 1, 1])), Block::from_integers([7, 2, 2, 1]));
    /// ```
    pub fn model(position: Block<T, 3>, rotation: &Self, scale: Block<T, 3>) -> Self {
        Self::translation(position).product(&rotation.product(&Self::scaling(scale)))
    }

    /// The parallel projection of `glOrtho`, taking −near to depth −1 and −far to 1.
    ///
    /// # Errors
    /// [`Error::FlatView`] where left = right, bottom = top or near = far.
    pub fn ortho([l, r, b, t, n, f]: [Scaled<T>; 6]) -> Result<Self, Error> {
        let (width, height, depth) = (r.minus(l), t.minus(b), f.minus(n));
        let over = |a: Scaled<T>, d| a.over(d).ok_or(Error::FlatView);
        let (two, o) = (Scaled::from_integer(2), Scaled::ZERO);
        Ok(Self::from_scaled([
            over(two, width)?,
            o,
            o,
            over(r.plus(l), width)?.negated(),
            o,
            over(two, height)?,
            o,
            over(t.plus(b), height)?.negated(),
            o,
            o,
            over(two, depth)?.negated(),
            over(f.plus(n), depth)?.negated(),
            o,
            o,
            o,
            Scaled::from_integer(1),
        ]))
    }

    /// The entries, row by row.
    pub fn entries(&self) -> Block<T, 16> {
        self.0
    }

    /// A matrix that only turns, its upper left 3×3 in units of 2^exponent.
    fn from_linear([a, b, c]: [[T; 3]; 3], exponent: i32) -> Self {
        let rows = [a, b, c].map(|r| r.map(|m| Scaled::new([m], exponent)));
        let [[a, b, c], [d, e, f], [g, h, i]] = rows;
        let (one, o) = (Scaled::from_integer(1), Scaled::ZERO);
        Self::from_scaled([a, b, c, o, d, e, f, o, g, h, i, o, o, o, o, one])
    }

    pub(crate) fn rows(&self) -> [[T; 4]; 4] {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = self.0.mantissas();
        [[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]]
    }

    fn columns(&self) -> [[T; 4]; 4] {
        let [[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]] = self.rows();
        [[a, e, i, m], [b, f, j, n], [c, g, k, o], [d, h, l, p]]
    }
}

/// The 3×3 matrix of directions (normals, lights, clip planes): the inverse transpose of model/view's, kept step by step.
///
/// ```
/// use fixel::{matrix::Directions, num::Block};
/// let mut d = Directions::<i64>::identity();
/// d.scale(Block::from_integers([2, 1, 1]));
/// // A plane's normal shrinks where the points stretch.
/// assert_eq!(d.turn(Block::from_integers([2, 0, 0])), Block::from_integers([1, 0, 0]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Directions<T>([Block<T, 3>; 3]);

impl<T: Word> Directions<T> {
    /// Nothing turned.
    pub fn identity() -> Self {
        let (one, zero) = (T::ONE << (T::BITS - 1), T::ZERO);
        let rows = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        Directions(rows.map(|row| Block::raw(row, 1 - T::BITS as i32)))
    }

    /// D·v.
    pub fn turn(&self, v: Block<T, 3>) -> Block<T, 3> {
        Block::gather(self.0.map(|row| row.dot(v)))
    }

    /// Dᵀ·v: v·(D·n) = (Dᵀ·v)·n.
    pub fn turn_back(&self, v: Block<T, 3>) -> Block<T, 3> {
        let [a, b, c] = self.0.map(Block::split);
        let column = |i: [Scaled<T>; 3]| Block::gather(i).dot(v);
        let ([a, d, g], [b, e, h], [c, f, i]) = (a, b, c);
        Block::gather([column([a, b, c]), column([d, e, f]), column([g, h, i])])
    }

    /// D = D·R.
    ///
    /// # Errors
    /// [`Error::ZeroVector`] for an axis of length 0.
    pub fn rotate<S: Trigonometry>(&mut self, angle: Angle, axis: Block<T, 3>) -> Result<(), Error> {
        let rows = rotation_rows::<T, S>(angle, axis)?;
        self.multiply(rows.map(|row| Block::new(row, -(T::BITS as i32))));
        Ok(())
    }

    /// D = D·diag(1/x, 1/y, 1/z); unchanged where one of them is 0.
    pub fn scale(&mut self, by: Block<T, 3>) {
        let [x, y, z] = by.split();
        let one = Scaled::from_integer(1);
        if let (Some(x), Some(y), Some(z)) = (one.over(x), one.over(y), one.over(z)) {
            let o = Scaled::ZERO;
            self.multiply([[x, o, o], [o, y, o], [o, o, z]].map(Block::gather));
        }
    }

    /// D = the rotation of [`Matrix::look_at`].
    ///
    /// # Errors
    /// [`Error::ZeroVector`] where eye and center coincide or up is parallel to the view.
    pub fn look_at(&mut self, eye: Block<T, 3>, center: Block<T, 3>, up: Block<T, 3>) -> Result<(), Error> {
        self.0 = look_at_rows(eye, center, up)?.map(|row| Block::new(row, -(T::BITS as i32)));
        Ok(())
    }

    /// D = the inverse transpose of the upper left 3×3 of `matrix`; the identity where that is singular.
    pub fn load(&mut self, matrix: &Matrix<T>) {
        self.0 = inverse_transpose(matrix).unwrap_or(Self::identity().0);
    }

    /// D = D · the inverse transpose of the upper left 3×3 of `matrix`; unchanged where that is singular.
    pub fn load_product(&mut self, matrix: &Matrix<T>) {
        if let Some(rows) = inverse_transpose(matrix) {
            self.multiply(rows);
        }
    }

    fn multiply(&mut self, other: [Block<T, 3>; 3]) {
        let [[a, b, c], [d, e, f], [g, h, i]] = other.map(Block::split);
        let columns = [[a, d, g], [b, e, h], [c, f, i]].map(Block::gather);
        self.0 = self.0.map(|row| Block::gather(columns.map(|column| row.dot(column))));
    }
}

/// The rows of a rotation in units of 2^-BITS: x² + c(1−x²), xy − c·xy − z·s and so on, with unit axis (x, y, z).
fn rotation_rows<T: Word, S: Trigonometry>(angle: Angle, axis: Block<T, 3>) -> Result<[[T; 3]; 3], Error> {
    let [x, y, z] = axis.unit().ok_or(Error::ZeroVector)?;
    let (sin, cos) = S::sin_cos::<T>(angle);
    let one = T::ONE << T::BITS;
    let round = |wide: T::Wide| ((wide + (T::ONE.widen() << (T::BITS - 1))) >> T::BITS).narrow();
    let product = |a: T, b: T| round(a.times(b));
    let diagonal = |square: T| square + product(cos, one - square);
    // xy − c·xy ∓ z·s: at most 2·2^(2·BITS) before the shift.
    let other = |p: T, s: T| round((p.widen() << T::BITS) - cos.times(p) + s.times(sin));
    let (xx, yy, zz) = (product(x, x), product(y, y), product(z, z));
    let (xy, xz, yz) = (product(x, y), product(x, z), product(y, z));
    Ok([
        [diagonal(xx), other(xy, -z), other(xz, y)],
        [other(xy, z), diagonal(yy), other(yz, -x)],
        [other(xz, -y), other(yz, x), diagonal(zz)],
    ])
}

/// The rows (s, u, −f) of a view, unit vectors in units of 2^-BITS.
fn look_at_rows<T: Word>(eye: Block<T, 3>, center: Block<T, 3>, up: Block<T, 3>) -> Result<[[T; 3]; 3], Error> {
    let vector = |unit: [T; 3]| Block::new(unit, -(T::BITS as i32));
    let f = center.minus(eye).unit().ok_or(Error::ZeroVector)?;
    let s = vector(f).cross(up).unit().ok_or(Error::ZeroVector)?;
    let u = vector(s).cross(vector(f)).unit().ok_or(Error::ZeroVector)?;
    Ok([s, u, f.map(|m| -m)])
}

/// Cofactors over the determinant.
fn inverse_transpose<T: Word>(matrix: &Matrix<T>) -> Option<[Block<T, 3>; 3]> {
    let exponent = matrix.0.exponent();
    let [[a, b, c, _], [d, e, f, _], [g, h, i, _], _] = matrix.rows();
    let [r0, r1, r2] = [[a, b, c], [d, e, f], [g, h, i]].map(|row| Block::new(row, exponent));
    let cofactors = [r1.cross(r2), r2.cross(r0), r0.cross(r1)];
    let [first, second, third] = cofactors;
    let determinant = r0.dot(first);
    Some([
        first.over(determinant)?,
        second.over(determinant)?,
        third.over(determinant)?,
    ])
}

fn dot<T: Word>([a, b, c, d]: [T; 4], [x, y, z, w]: [T; 4]) -> T::Wide {
    a.times(x) + b.times(y) + c.times(z) + d.times(w)
}
