//! Ready-made fragment programs, and the trait for one's own.

use crate::varying::{Linear, Varying};

/// What colours the pixels of a primitive. Monomorphised: no call per pixel.
///
/// ```
/// use fixel::{fragment::Fragment, varying::Linear};
///
/// /// Bands of height, four levels each.
/// struct Contours;
///
/// impl Fragment for Contours {
///     type Varying = Linear<1>;
///     type Pixel = u8;
///     fn shade(&self, [height]: [i32; 1], _below: u8) -> Option<u8> {
///         Some((height >> 16) as u8 & !3)
///     }
/// }
/// assert_eq!(Contours.shade([7 << 16], 0), Some(4));
/// ```
pub trait Fragment {
    /// What it needs from the corners.
    type Varying: Varying;
    /// The target's pixel.
    type Pixel: Copy;

    /// The one pixel that [`shade`](Self::shade) always gives, if so: spans without depth are then filled at once.
    fn solid(&self) -> Option<Self::Pixel> {
        None
    }

    /// The new pixel over `below`, or `None` to leave the colour as it is (the depth has been stored by then).
    fn shade(&self, values: <Self::Varying as Varying>::Values, below: Self::Pixel) -> Option<Self::Pixel>;
}

/// A fragment program that can colour a part of a pixel, as [Wu lines](crate::draw::wu_line) want.
///
/// The example is [`draw::wu_line`](crate::draw::wu_line)'s.
pub trait Antialiased: Fragment {
    /// As [`shade`](Fragment::shade), for a fragment that covers `part` of the pixel, 0…2^28 in units of 2^-28. Where
    /// there is alpha, it is multiplied by that. A part of 0 comes too.
    fn shade_part(
        &self,
        values: <Self::Varying as Varying>::Values,
        part: i32,
        below: Self::Pixel,
    ) -> Option<Self::Pixel>;
}

/// One colour for the whole primitive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Flat<P>(pub P);

impl<P: Copy> Fragment for Flat<P> {
    type Varying = ();
    type Pixel = P;

    #[inline(always)]
    fn solid(&self) -> Option<P> {
        Some(self.0)
    }
    #[inline(always)]
    fn shade(&self, (): (), _below: P) -> Option<P> {
        Some(self.0)
    }
}

/// Interpolated colours as RGB565: red and blue in units of 2^-16 of 0…31, green of 0…63.
///
/// ```
/// use fixel::{fragment::{Fragment, Gouraud565}, varying::Linear};
/// assert_eq!(Gouraud565::corner(255, 0, 255), Linear([0x1f_8000, 0x8000, 0x1f_8000]));
/// assert_eq!(Gouraud565.shade([0x1f_8000, 0x8000, 0x1f_8000], 0), Some(0xf81f));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gouraud565;

impl Gouraud565 {
    /// A corner's colour from 8-bit channels, with the half that makes cutting off round to nearest.
    pub const fn corner(red: u8, green: u8, blue: u8) -> Linear<3> {
        const fn scale(v: u8, most: i32) -> i32 {
            (((v as i32 * most) << 16) + 127) / 255 + 0x8000
        }
        Linear([scale(red, 31), scale(green, 63), scale(blue, 31)])
    }
}

impl Fragment for Gouraud565 {
    type Varying = Linear<3>;
    type Pixel = u16;

    #[inline(always)]
    fn shade(&self, [red, green, blue]: [i32; 3], _below: u16) -> Option<u16> {
        // One mask for both shifts: two instructions fewer than by shifting each to its place.
        let [red, green, blue] = [red as u32 >> 16, green as u32 >> 16, blue as u32 >> 16];
        Some(((red << 6 | green) << 5 | blue) as u16)
    }
}
