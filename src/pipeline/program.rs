//! Programs: what a user writes for vertices and for fragments.

use crate::num::{Block, Scaled, Word};
use crate::screen::FineDepth;
use crate::varying::{LinearFan, Perspective, Varying};
use crate::view::Carried;

/// A vertex program and a fragment program that belong together; `T` is the word of positions.
///
/// Uniforms are the program's own fields: numbers, matrices, samplers, lists of lights. They do not change during a draw.
/// The example is the [module](super)'s.
pub trait Program<T: Word = i32> {
    /// The attributes of a vertex: any type.
    type Vertex;
    /// What the vertex program hands to the fragment program: `()`, an array, or an own type.
    type Varying: Varyings;
    /// What the fragment program wants to know of its place: [`Pixel`] or [`FragCoord`].
    type At: Coordinates;
    /// What the fragment program puts out: see [`Outputs`](super::Outputs).
    type Output;

    /// Whether every fragment is kept, [`fragment`](Self::fragment) never being `None`. Depth is then tested first, so that
    /// the program does not run for what is hidden: the same picture, sooner.
    const KEEPS_ALL: bool = false;

    /// Position in clip space (visible where −w ≤ x, y, z ≤ w), and what the fragments get.
    ///
    /// Called once for every vertex of a list whose primitive is whole; vertices do not see one another.
    fn vertex(&self, vertex: &Self::Vertex) -> (Block<T, 4>, Self::Varying);

    /// What becomes of a covered pixel: `None` discards it, and neither colour nor depth is written.
    fn fragment(&self, at: Self::At, varying: Self::Varying) -> Option<Self::Output>;
}

/// What a program carries from vertices to fragments, as numbers to interpolate.
///
/// ```
/// use fixel::pipeline::Varyings;
///
/// struct Surface {
///     uv: [i32; 2],
///     normal: [i32; 3],
/// }
///
/// impl Varyings for Surface {
///     type Values = [i32; 5];
///     fn pack(&self) -> [i32; 5] {
///         let ([u, v], [x, y, z]) = (self.uv, self.normal);
///         [u, v, x, y, z]
///     }
///     fn unpack([u, v, x, y, z]: [i32; 5]) -> Self {
///         Surface { uv: [u, v], normal: [x, y, z] }
///     }
/// }
/// ```
pub trait Varyings {
    /// `()` or `[i32; N]`.
    type Values: Values;
    /// As numbers: |v| ≤ 2^30, each in units of the user's choice.
    fn pack(&self) -> Self::Values;
    /// What a fragment gets.
    fn unpack(values: Self::Values) -> Self;
}

impl Varyings for () {
    type Values = ();
    #[inline(always)]
    fn pack(&self) {}
    #[inline(always)]
    fn unpack((): ()) {}
}

impl<const N: usize> Varyings for [i32; N] {
    type Values = [i32; N];
    #[inline(always)]
    fn pack(&self) -> [i32; N] {
        *self
    }
    #[inline(always)]
    fn unpack(values: [i32; N]) -> [i32; N] {
        values
    }
}

/// Packed varyings: `()` or `[i32; N]`. The example is [`Varyings`]'.
pub trait Values: Copy {
    /// Interpolated over the screen.
    type Linear: Carried<Vertex = Self> + Varying<Values = Self>;
    /// Interpolated in space.
    type Perspective: Carried<Vertex = Self> + Varying<Values = Self>;
    /// All 0.
    const ZERO: Self;
    /// The only value, where there is only one: nothing is interpolated.
    const ONLY: Option<Self>;
}

impl Values for () {
    type Linear = ();
    type Perspective = ();
    const ZERO: Self = ();
    const ONLY: Option<Self> = Some(());
}

impl<const N: usize> Values for [i32; N] {
    type Linear = LinearFan<N>;
    type Perspective = Perspective<N>;
    const ZERO: Self = [0; N];
    const ONLY: Option<Self> = None;
}

/// What the vertex program has made of a vertex; for [lists with a buffer](super::triangles_buffered) and single
/// [triangles](super::triangle).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shaded<T, A> {
    /// Position in clip space.
    pub position: Block<T, 4>,
    /// [Packed](Varyings::pack).
    pub values: A,
}

impl<T: Word, A: Values> Shaded<T, A> {
    /// To make a buffer of.
    ///
    /// ```
    /// use fixel::pipeline::Shaded;
    /// let buffer = [Shaded::<i32, [i32; 2]>::EMPTY; 64];
    /// ```
    pub const EMPTY: Self = Shaded {
        position: Block::ZERO,
        values: A::ZERO,
    };

    /// Runs the vertex program.
    #[inline]
    pub fn new<P>(program: &P, vertex: &P::Vertex) -> Self
    where
        P: Program<T, Varying: Varyings<Values = A>>,
    {
        let (position, varying) = program.vertex(vertex);
        Shaded {
            position,
            values: varying.pack(),
        }
    }
}

/// What a fragment can know of its place: [`Pixel`] or [`FragCoord`]. What is not asked for is not interpolated.
pub trait Coordinates {
    /// Whether window depth is wanted.
    const DEPTH: bool;
    /// Whether 1/w is wanted.
    const INVERSE_W: bool;
    /// Put together by the rasterizer.
    fn new(place: Place) -> Self;
}

/// All that [`Coordinates`] are made of.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    pub(super) x: i32,
    pub(super) y: i32,
    pub(super) depth: i32,
    pub(super) inverse: i32,
    pub(super) exponent: i32,
}

/// The pixel: column and row of the target. Its centre is half a pixel further.
///
/// Rows are numbered as the target numbers them, upwards unless the viewport is [`y_up`](crate::viewport::Viewport::y_up).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pixel {
    /// Column.
    pub x: i32,
    /// Row.
    pub y: i32,
}

impl Coordinates for Pixel {
    const DEPTH: bool = false;
    const INVERSE_W: bool = false;
    #[inline(always)]
    fn new(place: Place) -> Self {
        Pixel { x: place.x, y: place.y }
    }
}

/// The pixel, its window depth and 1/w there, interpolated also where there is no depth buffer.
///
/// ```
/// use fixel::{num::Block, pipeline::{FragCoord, Program}};
///
/// /// Depth as grey.
/// struct Depths;
///
/// impl Program for Depths {
///     type Vertex = [i32; 4];
///     type Varying = ();
///     type At = FragCoord;
///     type Output = u8;
///     fn vertex(&self, &position: &[i32; 4]) -> (Block<i32, 4>, ()) {
///         (Block::from_integers(position), ())
///     }
///     fn fragment(&self, at: FragCoord, (): ()) -> Option<u8> {
///         Some((at.z.to_num::<u32>() >> 8) as u8)
///     }
/// }
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FragCoord {
    /// Column.
    pub x: i32,
    /// Row, as [`Pixel`]'s.
    pub y: i32,
    /// Window depth, linear over the screen: 0 at z = −w to 65535 at z = w, and these where z lies beyond.
    pub z: FineDepth,
    inverse: i32,
    exponent: i32,
}

impl FragCoord {
    /// 1/w: within 2^-27 of the primitive's largest.
    #[inline]
    pub fn inverse_w(&self) -> Scaled<i32> {
        // Mantissas of 31 bits do not occur: the largest corner is at most 2^30.
        Scaled::from_wide([self.inverse as i64], self.exponent)
    }
}

impl Coordinates for FragCoord {
    const DEPTH: bool = true;
    const INVERSE_W: bool = true;
    #[inline(always)]
    fn new(place: Place) -> Self {
        FragCoord {
            x: place.x,
            y: place.y,
            z: FineDepth::from_bits(place.depth as u32),
            inverse: place.inverse,
            exponent: place.exponent,
        }
    }
}
