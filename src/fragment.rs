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
    /// Whether to be drawn by less code: see [`Compact`].
    const COMPACT: bool = false;

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

/// Another fragment program, drawn by less code: where flash is short, or few triangles are small.
///
/// Triangles below 16 columns and rows go the way of the others instead of [one of their own](crate::draw::triangle), and what
/// vertices carry is cut along with them, in less code. The same pixels are covered. What they get is within the bounds that
/// are stated for triangles and, where nothing is interpolated in 32 bits, for polygons, though not always the same to the last
/// bit; on any machine and in any strip it is.
///
/// What a view leaves of a triangle is one polygon. Values that are linear over the screen, and those with
/// [slopes](mod@crate::slope), are drawn over it as over the triangles around its first corner, or around another where rounding has
/// turned one of these; a triangle that is cut and seen edge-on, whose polygon rounding makes cross over itself, can draw samples of
/// its line that it does not draw otherwise, or leave them out. Where a plane cuts, values run linearly over the screen if both ends of the edge are before the camera, else
/// in clip space.
///
/// What it does without: up to 247 user planes count; [`LinearFan`](crate::varying::LinearFan) is as
/// [`Linear`](crate::varying::Linear); and where w < 0 is [divided by](crate::clip::Behind::Divide), a triangle with w of both signs
/// is cut off behind the camera all the same if user planes cut it, or if its values are in perspective.
///
/// ```
/// use fixel::depth::NoDepth;
/// use fixel::fragment::{Compact, Flat, Fragment};
/// use fixel::{draw, screen::Position, target::Buffer};
/// assert!(Compact::<Flat<u8>>::COMPACT);
/// let mut picture = [b'.'; 4 * 3];
/// let corners = [(0, 0), (0, 3), (3, 0)].map(|(x, y)| Position::from_pixels(x, y).flat());
/// draw::triangle(&mut Buffer::new(&mut picture, 4, 3)?, &mut NoDepth, corners, &Compact(Flat(b'#')));
/// assert_eq!(&picture, b"###.##..#...");
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Compact<F>(pub F);

impl<F: Fragment> Fragment for Compact<F> {
    type Varying = F::Varying;
    type Pixel = F::Pixel;
    const COMPACT: bool = true;

    #[inline(always)]
    fn solid(&self) -> Option<F::Pixel> {
        self.0.solid()
    }
    #[inline(always)]
    fn fill(&self, pixels: &mut [F::Pixel]) -> bool {
        self.0.fill(pixels)
    }
    #[inline(always)]
    fn shade(&self, values: <F::Varying as Varying>::Values, below: F::Pixel) -> Option<F::Pixel> {
        self.0.shade(values, below)
    }
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

/// One RGB565 colour for the whole primitive: as [`Flat`], and stored two pixels at a time.
///
/// ```
/// use fixel::fragment::{Flat565, Fragment};
/// let mut pixels = [0; 37];
/// assert!(Flat565::new(0xf81f).fill(&mut pixels));
/// assert_eq!(pixels, [0xf81f; 37]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Flat565([u32; LANES]);

/// Words that are the same, each in a register of its own where an instruction stores two that differ (ARMv7-M).
const LANES: usize = if cfg!(all(target_arch = "arm", target_has_atomic = "32")) {
    4
} else {
    1
};

impl Flat565 {
    /// This colour.
    #[inline(always)]
    pub fn new(pixel: u16) -> Self {
        // Twice in words that the compiler does not see through, which would make a call of a block of them.
        Flat565([(); LANES].map(|()| black_box(pixel as u32 * 0x1_0001)))
    }

    #[inline(always)]
    fn pixel(&self) -> u16 {
        self.0[0] as u16
    }
}

/// Words that are stored between two looks at how many are left: as many as an ARMv6-M store reaches from one address.
const BLOCK: usize = 32;

/// The first `N` of `words`, if there are so many; what is left.
#[inline(always)]
#[allow(clippy::modulo_one)] // There are more lanes on other cores.
fn store<const N: usize>(words: &mut &mut [u32], lanes: [u32; LANES]) {
    let all = mem::take(words);
    if all.len() < N {
        *words = all;
    } else if let Some((block, rest)) = all.split_first_chunk_mut::<N>() {
        for (i, word) in block.iter_mut().enumerate() {
            *word = lanes[i % LANES];
        }
        *words = rest;
    }
}

impl Fragment for Flat565 {
    type Varying = ();
    type Pixel = u16;

    #[inline(always)]
    fn solid(&self) -> Option<u16> {
        Some(self.pixel())
    }

    #[inline(always)]
    fn fill(&self, pixels: &mut [u16]) -> bool {
        let pixel = self.pixel();
        // One pixel before the first whole word, and one after the last, if any.
        let (before, mut words, after) = bytemuck::pod_align_to_mut::<u16, u32>(pixels);
        for other in before {
            *other = pixel;
        }
        // By hand: chunks would be counted from the row's start, which is computed once more.
        while words.len() >= BLOCK {
            store::<BLOCK>(&mut words, self.0);
        }
        store::<16>(&mut words, self.0);
        store::<8>(&mut words, self.0);
        store::<4>(&mut words, self.0);
        store::<2>(&mut words, self.0);
        store::<1>(&mut words, self.0);
        for other in after {
            *other = pixel;
        }
        true
    }

    #[inline(always)]
    fn shade(&self, (): (), _below: u16) -> Option<u16> {
        Some(self.pixel())
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
