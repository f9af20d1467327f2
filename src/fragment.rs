//! Ready-made fragment programs, and the trait for one's own.

use core::hint::black_box;
use core::mem;

use crate::varying::{Color565, Packed565, Varying};

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

    /// Stores [`solid`](Self::solid) in all of `pixels`; whether there is such a pixel.
    #[inline(always)]
    fn fill(&self, pixels: &mut [Self::Pixel]) -> bool {
        let solid = self.solid();
        if let Some(pixel) = solid {
            pixels.fill(pixel);
        }
        solid.is_some()
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

/// One RGB565 colour for the whole primitive: as [`Flat`], and stored two pixels at a time where the core can store words
/// anywhere (ARMv7-M, not ARMv6-M).
///
/// ```
/// use fixel::fragment::{Flat565, Fragment};
/// let mut pixels = [0; 37];
/// assert!(Flat565::new(0xf81f).fill(&mut pixels));
/// assert_eq!(pixels, [0xf81f; 37]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Flat565(u32);

impl Flat565 {
    /// This colour.
    #[inline(always)]
    pub fn new(pixel: u16) -> Self {
        // Twice in a word that the compiler does not see through: neighbouring stores of its halves become one.
        Flat565(black_box(pixel as u32 * 0x1_0001))
    }
}

/// Pairs that are stored between two looks at how many are left. On ARMv6-M (the one of its family without compare-and-swap)
/// as many halfwords as a store reaches from one address: with 64 a large triangle takes 2.3 instructions a pixel, so 1.7.
const BLOCK: usize = if cfg!(all(target_arch = "arm", not(target_has_atomic = "32"))) {
    16
} else {
    64
};

/// The first `N` of `pairs`, if there are so many; what is left.
#[inline(always)]
fn store<const N: usize>(pairs: &mut &mut [[u16; 2]], pair: [u16; 2]) {
    let all = mem::take(pairs);
    if all.len() < N {
        *pairs = all;
    } else if let Some((block, rest)) = all.split_first_chunk_mut::<N>() {
        *block = [pair; N];
        *pairs = rest;
    }
}

impl Fragment for Flat565 {
    type Varying = ();
    type Pixel = u16;

    #[inline(always)]
    fn solid(&self) -> Option<u16> {
        Some(self.0 as u16)
    }

    #[inline(always)]
    fn fill(&self, pixels: &mut [u16]) -> bool {
        let pair = [self.0 as u16, (self.0 >> 16) as u16];
        let (mut pairs, last) = pixels.as_chunks_mut::<2>();
        // By hand: chunks would be counted from the row's start, which is computed once more.
        while pairs.len() >= BLOCK {
            store::<BLOCK>(&mut pairs, pair);
        }
        store::<32>(&mut pairs, pair);
        store::<16>(&mut pairs, pair);
        store::<8>(&mut pairs, pair);
        store::<4>(&mut pairs, pair);
        store::<2>(&mut pairs, pair);
        store::<1>(&mut pairs, pair);
        for pixel in last {
            *pixel = self.0 as u16;
        }
        true
    }

    #[inline(always)]
    fn shade(&self, (): (), _below: u16) -> Option<u16> {
        Some(self.0 as u16)
    }
}

/// Interpolated colours as RGB565.
///
/// ```
/// use fixel::{fragment::Gouraud565, varying::Color565};
/// assert_eq!(Gouraud565::corner(255, 0, 255), Color565([0x1f_8000, 0x8000, 0x1f_8000]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gouraud565;

impl Gouraud565 {
    /// A corner's colour from 8-bit channels, with the half that makes cutting off round to nearest.
    pub const fn corner(red: u8, green: u8, blue: u8) -> Color565 {
        const fn scale(v: u8, most: i32) -> i32 {
            (((v as i32 * most) << 16) + 127) / 255 + 0x8000
        }
        Color565([scale(red, 31), scale(green, 63), scale(blue, 31)])
    }
}

impl Fragment for Gouraud565 {
    type Varying = Color565;
    type Pixel = u16;

    #[inline(always)]
    fn shade(&self, color: Packed565, _below: u16) -> Option<u16> {
        Some(color.pixel())
    }
}
