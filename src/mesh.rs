//! Indexed meshes, read where they lie (in flash, for one), and a cache of transformed vertices.
//!
//! A corner of a face is an index into each of A attributes: with A = 1 corners with the same index are the same vertex,
//! with A = 2 a corner names a position and, say, a normal separately (as in `.iv` and OBJ files), and so on. The attributes
//! themselves stay with the caller, whose function makes a vertex of a corner: it transforms a position, lights it,
//! whatever the draw wants. A [`Cache`] keeps what it made of the last corners, so that a vertex which several triangles
//! share is made once as long as it stays there; what is drawn does not depend on it.
//!
//! ```
//! use fixel::{clip::{Behind, DepthRange, Planes}, matrix::Matrix, num::{Block, Scaled}};
//! use fixel::{depth::NoDepth, draw, fragment::Flat, target::Buffer, view::{Cull, Vertex, View}, viewport::Viewport};
//! use fixel::mesh::{Cache, Mesh, Normalized};
//!
//! // A house of one face, in a box of −1…1 (units of 2^-15).
//! static POSITIONS: [[i16; 3]; 5] =
//!     [[-32768, -32768, 0], [32767, -32768, 0], [32767, 0, 0], [0, 32767, 0], [-32768, 0, 0]];
//! static HOUSE: [u16; 6] = [0, 1, 2, 3, 4, u16::MAX];
//!
//! let view = View::<i32, i32, 0> {
//!     projection: Matrix::frustum([-1, 1, -1, 1, 1, 10].map(Scaled::from_integer))?,
//!     planes: Planes::default(),
//!     viewport: Viewport::new(0, 0, 12, 6)?.y_up(),
//!     depth_range: DepthRange::MinusOneToOne,
//!     behind: Behind::Cut,
//!     cull: Cull::Clockwise,
//! };
//! // 3 high and wide, 4 away.
//! let size = Matrix::scaling(Block::from_integers([3, 3, 3]));
//! let model = Matrix::translation(Block::from_integers([0, 0, -4])).product(&size);
//!
//! let mut picture = [b'.'; 12 * 6];
//! let mut target = Buffer::new(&mut picture, 12, 6)?;
//! let mesh = Mesh::new([&HOUSE], [POSITIONS.len()])?;
//! let transform = |[position]: [usize; 1]| Vertex {
//!     position: model.transform(POSITIONS.get(position).copied().unwrap_or_default().point()),
//!     carried: (),
//! };
//! mesh.triangles(&mut Cache::<_, 1, 8>::default(), transform, |corners| {
//!     draw::primitive(&view, &mut target, &mut NoDepth, &corners, &Flat(b'#'));
//! });
//! let rows: Vec<_> = picture.chunks(12).map(|row| str::from_utf8(row).unwrap()).collect();
//! assert_eq!(rows, [
//!     "............",
//!     "......#.....",
//!     "....#####...",
//!     "..#########.",
//!     "..#########.",
//!     "..#########.",
//! ]);
//! # Ok::<(), fixel::error::Error>(())
//! ```

use crate::error::Error;
use crate::matrix::Matrix;
use crate::num::{Block, Word};

/// The type of a mesh's indices: `u16`, or `u32` for more than 65535 vertices.
pub trait Index: Copy + Eq {
    /// Ends a face: the largest number, which no vertex has.
    const END: Self;
    /// The same number.
    fn to_usize(self) -> usize;
}

macro_rules! indices {
    ($($type:ty)*) => {$(
        impl Index for $type {
            const END: Self = Self::MAX;
            #[inline(always)]
            fn to_usize(self) -> usize {
                self as usize
            }
        }
    )*};
}

indices!(u16 u32);

/// Faces whose corners are indices into A attributes.
///
/// Faces are convex, of three or more corners, and drawn as the fan (0, 1, 2), (0, 2, 3)…
///
/// ```
/// use fixel::mesh::Mesh;
/// const END: u16 = u16::MAX;
/// // A pentagon and a triangle, of six positions and two normals.
/// let positions = [0, 1, 2, 3, 4, END, 0, 4, 5, END];
/// let normals = [0, 0, 0, 0, 0, END, 1, 1, 1, END];
/// let mesh = Mesh::new([&positions, &normals], [6, 2])?;
/// let corners: Vec<usize> = mesh.faces().map(|face| face.corners().count()).collect();
/// assert_eq!(corners, [5, 3]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Mesh<'a, I, const A: usize>([&'a [I]; A]);

impl<'a, I: Index, const A: usize> Mesh<'a, I, A> {
    /// Checks `indices`, one list per attribute, against the `counts` of what they refer to: each face's corners followed
    /// by [`Index::END`]. O(number of indices), once; nothing has to be checked later.
    ///
    /// # Errors
    /// [`Error::MeshIndex`] for an index not below its count. [`Error::MeshShape`] for a face of fewer than three corners,
    /// a last one without its end, or lists that do not have the same faces.
    ///
    /// ```
    /// use fixel::{error::Error, mesh::Mesh};
    /// const END: u32 = u32::MAX;
    /// assert_eq!(Mesh::new([&[0, 1, 2, END]], [2]).err(), Some(Error::MeshIndex));
    /// assert_eq!(Mesh::new([&[0, 1, END]], [2]).err(), Some(Error::MeshShape));
    /// assert_eq!(Mesh::new([&[0, 1, 2, END][..], &[0, 0, 0]], [3, 1]).err(), Some(Error::MeshShape));
    /// ```
    pub fn new(indices: [&'a [I]; A], counts: [usize; A]) -> Result<Self, Error> {
        let first = indices.first().copied().unwrap_or_default();
        let mut corners = 0;
        for &index in first {
            if index != I::END {
                corners += 1;
            } else if corners < 3 {
                return Err(Error::MeshShape);
            } else {
                corners = 0;
            }
        }
        if corners > 0 {
            return Err(Error::MeshShape);
        }
        for (list, count) in indices.into_iter().zip(counts) {
            let differs = |(a, b): (&I, &I)| (*a == I::END) != (*b == I::END);
            if list.len() != first.len() || list.iter().zip(first).any(differs) {
                return Err(Error::MeshShape);
            }
            if list.iter().any(|&i| i != I::END && i.to_usize() >= count) {
                return Err(Error::MeshIndex);
            }
        }
        Ok(Mesh(indices))
    }

    /// One face after the other.
    pub fn faces(&self) -> Faces<'a, I, A> {
        Faces(self.0)
    }

    /// Calls `draw` with every triangle, its corners made by `transform` unless `cache` still has them. The cache is emptied
    /// first, so that nothing in it comes from another transformation.
    pub fn triangles<V: Copy, const N: usize>(
        &self,
        cache: &mut Cache<V, A, N>,
        mut transform: impl FnMut([usize; A]) -> V,
        mut draw: impl FnMut([V; 3]),
    ) {
        cache.clear();
        for face in self.faces() {
            face.triangles(cache, &mut transform, &mut draw);
        }
    }
}

/// The faces of a [`Mesh`] that are left.
#[derive(Debug, Clone)]
pub struct Faces<'a, I, const A: usize>([&'a [I]; A]);

impl<'a, I: Index, const A: usize> Iterator for Faces<'a, I, A> {
    type Item = Face<'a, I, A>;

    fn next(&mut self) -> Option<Self::Item> {
        let corners = self.0.first()?.iter().position(|&i| i == I::END)?;
        let face = self.0.map(|list| list.get(..corners).unwrap_or_default());
        self.0 = self.0.map(|list| list.get(corners + 1..).unwrap_or_default());
        Some(Face(face))
    }
}

/// One face of a [`Mesh`].
#[derive(Debug, Clone, Copy)]
pub struct Face<'a, I, const A: usize>([&'a [I]; A]);

impl<'a, I: Index, const A: usize> Face<'a, I, A> {
    /// Its corners in order, three or more: what a face's own colour is computed from.
    pub fn corners(&self) -> impl Iterator<Item = [usize; A]> + use<'a, I, A> {
        let lists = self.0;
        let count = lists.first().map_or(0, |list| list.len());
        // All lists have as many.
        (0..count).map(move |i| lists.map(|list| list.get(i).map_or(0, |index| index.to_usize())))
    }

    /// Calls `draw` with every triangle of the fan; the cache keeps what it has.
    ///
    /// ```
    /// use fixel::mesh::{Cache, Mesh};
    /// let mesh = Mesh::new([&[0u16, 1, 2, 3, u16::MAX]], [4])?;
    /// let mut cache = Cache::<_, 1, 4>::default();
    /// let mut triangles = Vec::new();
    /// for face in mesh.faces() {
    ///     face.triangles(&mut cache, |[i]| 10 * i, |corners| triangles.push(corners));
    /// }
    /// assert_eq!(triangles, [[0, 10, 20], [0, 20, 30]]);
    /// assert_eq!(cache.transforms(), 4);
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    pub fn triangles<V: Copy, const N: usize>(
        &self,
        cache: &mut Cache<V, A, N>,
        mut transform: impl FnMut([usize; A]) -> V,
        mut draw: impl FnMut([V; 3]),
    ) {
        let mut corners = self.corners().map(|corner| cache.get(corner, &mut transform));
        let (Some(first), Some(mut previous)) = (corners.next(), corners.next()) else {
            return;
        };
        for next in corners {
            draw([first, previous, next]);
            previous = next;
        }
    }
}

/// The last vertices that were made of corners: at most N, none with N = 0.
///
/// Direct-mapped: a corner has one place where it can be, which costs a division by a constant to find. Of corners numbered
/// in the order of their first use, all of the last N are there (with several attributes, where their numbers run
/// together); that order is best for a mesh's vertices anyway.
///
/// Memory: N·(A words and a vertex), wherever the caller puts it.
#[derive(Debug, Clone)]
pub struct Cache<V, const A: usize, const N: usize> {
    slots: [Option<([usize; A], V)>; N],
    transforms: usize,
}

impl<V, const A: usize, const N: usize> Default for Cache<V, A, N> {
    fn default() -> Self {
        Cache {
            slots: [const { None }; N],
            transforms: 0,
        }
    }
}

impl<V: Copy, const A: usize, const N: usize> Cache<V, A, N> {
    /// What `transform` makes of `corner`, or has made of it.
    ///
    /// ```
    /// use fixel::mesh::Cache;
    /// let mut cache = Cache::<usize, 1, 2>::default();
    /// for index in [7, 7, 8, 7, 9, 7] {
    ///     assert_eq!(cache.get([index], |[i]| i * i), index * index);
    /// }
    /// // 9 takes the place of 7.
    /// assert_eq!(cache.transforms(), 4);
    /// ```
    #[inline]
    pub fn get(&mut self, corner: [usize; A], transform: impl FnOnce([usize; A]) -> V) -> V {
        // The factor keeps numbers that run together apart: with A = 2, by 31, with A = 3, by 931.
        let place = corner
            .iter()
            .fold(0usize, |sum, &i| sum.wrapping_mul(30).wrapping_add(i));
        let slot = place.checked_rem(N).and_then(|place| self.slots.get_mut(place));
        if let Some(Some((held, vertex))) = &slot
            && *held == corner
        {
            return *vertex;
        }
        self.transforms = self.transforms.wrapping_add(1);
        let vertex = transform(corner);
        if let Some(slot) = slot {
            *slot = Some((corner, vertex));
        }
        vertex
    }

    /// Forgets all vertices: before what is transformed changes. The count of [`transforms`](Self::transforms) goes on.
    pub fn clear(&mut self) {
        self.slots = [const { None }; N];
    }

    /// How many vertices were made so far.
    pub fn transforms(&self) -> usize {
        self.transforms
    }
}

/// Positions as fractions of a model's half-size, which is up to the caller's matrix ([`scaling`]): as precise for a model
/// of 10^-3 as for one of 10^6, and no more of flash than what its shape needs.
///
/// [`scaling`]: crate::matrix::Matrix::scaling
pub trait Normalized {
    /// The point (x, y, z, 1).
    fn point<T: Word>(self) -> Block<T, 4>;
    /// `matrix` · [`point`](Self::point), to the same bits, in the shortest way there is.
    #[inline]
    fn transformed<T: Word>(self, matrix: &Matrix<T>) -> Block<T, 4>
    where
        Self: Sized,
    {
        matrix.transform(self.point())
    }
}

/// Units of 2^-15: 6 bytes a vertex, rounded to 2^-16 of the half-size.
///
/// ```
/// use fixel::{mesh::Normalized, num::Block};
/// let point: Block<i32, 4> = [1i16 << 14, 0, -1 << 15].point();
/// assert_eq!(point, Block::new([1, 0, -2, 2], -1));
/// ```
impl Normalized for [i16; 3] {
    #[inline]
    fn point<T: Word>(self) -> Block<T, 4> {
        let [x, y, z] = self.map(|c| T::from_i32(c as i32));
        Block::new([x, y, z, T::ONE << 15], -15)
    }
    #[inline]
    fn transformed<T: Word>(self, matrix: &Matrix<T>) -> Block<T, 4> {
        matrix.transform_point(self)
    }
}

/// Units of 2^-30, −2…2.
///
/// ```
/// use fixel::{mesh::Normalized, num::Block};
/// let point: Block<i32, 4> = [1i32 << 29, 0, -1 << 30].point();
/// assert_eq!(point, Block::new([1, 0, -2, 2], -1));
/// ```
impl Normalized for [i32; 3] {
    #[inline]
    fn point<T: Word>(self) -> Block<T, 4> {
        let [x, y, z] = self.map(|c| T::from_i32(c).widen());
        Block::from_wide_here([x, y, z, T::ONE.widen() << 30], -30)
    }
}
