//! How exact a draw is, chosen at compile time: three tiers, [`Fast`], [`Balanced`] and [`Exact`], each a set of dials.
//!
//! A tier is a type without values. Programs that are generic over [`Quality`] take their varyings and their arithmetic from
//! it, and the compiler leaves nothing of the tiers that a firmware does not name. Every dial is a type of its own, so that a
//! program may also turn one of them alone; `docs/dials.md` has their bounds and the test that shows each.
//!
//! What no dial changes: coverage, which is exact, and the positions of corners, which are rounded to 1/256 px.
//!
//! ```
//! use fixel::{depth::NoDepth, draw, error::Error, fragment::Gouraud565, quality::{Exact, Fast, Quality}};
//! use fixel::{screen::{Corner, FineDepth, Position}, target::Buffer};
//!
//! /// A triangle with a red, a green and a blue corner.
//! fn draw<Q: Quality>(picture: &mut [u16; 64]) -> Result<(), Error> {
//!     let corner = |x, y, [red, green, blue]: [u8; 3]| Corner {
//!         position: Position::from_pixels(x, y),
//!         depth: FineDepth::ZERO,
//!         varying: Q::Color::from(Gouraud565::corner(red, green, blue)),
//!     };
//!     let corners = [corner(0, 0, [255, 0, 0]), corner(0, 8, [0, 255, 0]), corner(8, 0, [0, 0, 255])];
//!     draw::triangle(&mut Buffer::new(picture, 8, 8)?, &mut NoDepth, corners, &Q::GOURAUD);
//!     Ok(())
//! }
//!
//! let (mut fast, mut exact) = ([0; 64], [0; 64]);
//! draw::<Fast>(&mut fast)?;
//! draw::<Exact>(&mut exact)?;
//! // A level of each channel at most.
//! let red = |pixel: u16| pixel >> 11;
//! assert!(fast.iter().zip(&exact).all(|(&a, &b)| red(a).abs_diff(red(b)) <= 1));
//! # Ok::<(), Error>(())
//! ```

use crate::fragment::{Fragment, Gouraud565};
use crate::num::{self, OneStep, ShortSine, SineTable, Table, TwoSteps};
use crate::varying::{self, Color565, Linear, Perspective32, PerspectiveSpans, Varying};
use crate::view::Carried;

/// A set of dials.
///
/// ```
/// use fixel::num::{Angle, Precision, Trigonometry};
/// use fixel::quality::{Balanced, Quality};
///
/// /// Half of a vector's direction, turned by an angle about z: at the precision of a tier.
/// fn turned<Q: Quality>(vector: [i32; 3], angle: Angle) -> Option<[i32; 3]> {
///     let (sin, cos) = Q::Trigonometry::sin_cos::<i32>(angle);
///     let [x, y, z] = Q::Precision::unit(vector)?.map(|c| c >> 1);
///     Some([Q::Precision::dot([x, y, 0], [cos, -sin, 0]), Q::Precision::dot([x, y, 0], [sin, cos, 0]), z])
/// }
/// let [x, y, z] = turned::<Balanced>([700, 0, 0], Angle::from_degrees(90)).unwrap();
/// assert!(x.abs() < 1 << 18 && (y - (1 << 29)).abs() < 1 << 18 && z == 0);
/// ```
pub trait Quality {
    /// Its name in lower case, as programs and reports call it.
    const NAME: &'static str;
    /// Values in perspective, such as texture coordinates.
    type Perspective<const N: usize>: Varying<Values = [i32; N]>
        + Carried<Vertex = [i32; N]>
        + From<varying::Perspective<N>>;
    /// Colours for RGB565 targets.
    type Color: Carried<Vertex = [i32; 3]> + From<Color565>;
    /// The fragment program that stores such a colour.
    type Gouraud: Fragment<Varying = Self::Color, Pixel = u16>;
    /// That program.
    const GOURAUD: Self::Gouraud;
    /// Reciprocals, roots, unit vectors and powers: of lights.
    type Precision: num::Precision;
    /// Sine and cosine.
    type Trigonometry: num::Trigonometry;
}

/// As cheap as it gets without showing: values in perspective by a reciprocal from a table of 1024, or linear where that is within an
/// eighth of a texel, colours two channels a word, lights from [`Table`], sines from [`ShortSine`].
///
/// For cores that neither divide nor multiply long (ARMv6-M). [`Linear32`](varying::Linear32), affine, is cheaper still, and
/// bends the texture of a large triangle.
#[derive(Debug, Clone, Copy)]
pub enum Fast {}

/// What an 8-bit picture hardly shows: values in perspective divided at every pixel in words of 32 bits, colours two channels a
/// word, lights with [`OneStep`].
#[derive(Debug, Clone, Copy)]
pub enum Balanced {}

/// Every number as near as the core computes it: values in perspective divided at every pixel in words of 64 bits, a word for each
/// channel of a colour, lights with [`TwoSteps`].
#[derive(Debug, Clone, Copy)]
pub enum Exact {}

/// The bound of [`PerspectiveSpans`] in units of 2^-8 texel.
const AN_EIGHTH: u32 = 32;

impl Quality for Fast {
    const NAME: &'static str = "fast";
    type Perspective<const N: usize> = PerspectiveSpans<N, AN_EIGHTH>;
    type Color = Color565;
    type Gouraud = Gouraud565;
    const GOURAUD: Gouraud565 = Gouraud565;
    type Precision = Table;
    type Trigonometry = ShortSine;
}

impl Quality for Balanced {
    const NAME: &'static str = "balanced";
    type Perspective<const N: usize> = Perspective32<N>;
    type Color = Color565;
    type Gouraud = Gouraud565;
    const GOURAUD: Gouraud565 = Gouraud565;
    type Precision = OneStep;
    type Trigonometry = SineTable;
}

impl Quality for Exact {
    const NAME: &'static str = "exact";
    type Perspective<const N: usize> = varying::Perspective<N>;
    type Color = Linear<3>;
    type Gouraud = FineGouraud565;
    const GOURAUD: FineGouraud565 = FineGouraud565;
    type Precision = TwoSteps;
    type Trigonometry = SineTable;
}

/// Interpolated colours as RGB565, each channel with 16 bits of fraction in a word of its own: as
/// [`Gouraud565`], but a channel is within 2^-16 level a pixel of the exact value before it is rounded.
///
/// ```
/// use fixel::{fragment::{Fragment, Gouraud565}, quality::FineGouraud565, varying::Linear};
/// let Linear(magenta) = Gouraud565::corner(255, 0, 255).into();
/// assert_eq!(FineGouraud565.shade(magenta, 0), Some(0xf81f));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FineGouraud565;

impl Fragment for FineGouraud565 {
    type Varying = Linear<3>;
    type Pixel = u16;

    #[inline(always)]
    fn shade(&self, [red, green, blue]: [i32; 3], _below: u16) -> Option<u16> {
        Some((red >> 16 << 11 | green >> 16 << 5 | blue >> 16) as u16)
    }
}

/// The same channels.
impl From<Color565> for Linear<3> {
    fn from(color: Color565) -> Self {
        Linear(color.0)
    }
}
