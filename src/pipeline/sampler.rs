//! Images and samplers: nearest and linear, four ways to wrap.

use crate::blend::Rgba;
use crate::error::Error;
use crate::texture::{Format, Texture};

use super::format::PixelFormat;

/// What can be sampled: a [`Texture`], a [`Picture`], or something that is computed.
///
/// ```
/// use fixel::{blend::{ONE, Rgba}, pipeline::{Image, Sampler}};
///
/// /// A board of 8×8 fields that needs no memory.
/// struct Board;
///
/// impl Image for Board {
///     fn size(&self) -> (u16, u16) {
///         (8, 8)
///     }
///     fn color(&self, i: u16, j: u16) -> Rgba {
///         Rgba { color: [if (i + j) % 2 == 0 { ONE } else { 0 }; 3], alpha: ONE }
///     }
/// }
/// assert_eq!(Sampler::new(Board, 16).sample([0, 0]).color, [ONE; 3]);
/// ```
pub trait Image {
    /// Columns and rows, each 1 or more.
    fn size(&self) -> (u16, u16);
    /// The colour in column `i` of row `j`, both on the image.
    fn color(&self, i: u16, j: u16) -> Rgba;
}

impl<F: Format> Image for Texture<'_, F> {
    #[inline(always)]
    fn size(&self) -> (u16, u16) {
        (self.width(), self.height())
    }
    #[inline(always)]
    fn color(&self, i: u16, j: u16) -> Rgba {
        Rgba::from_texel(self.texel(i, j), 0)
    }
}

/// Pixels as an image, row after row: what has been drawn can be sampled.
///
/// ```
/// use fixel::{blend::{ONE, Rgba}, pipeline::{HeadRoom, Picture, Sampler}};
/// let glowing = Rgba { color: [2 * ONE; 3], alpha: ONE };
/// let pixels = [Rgba::default(), glowing];
/// let sampler = Sampler::new(Picture::new(HeadRoom, &pixels, 2, 1)?, 16);
/// assert_eq!(sampler.sample([3 << 14, 0]), glowing);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Picture<'a, F: PixelFormat> {
    format: F,
    pixels: &'a [F::Pixel],
    width: u16,
    height: u16,
}

impl<'a, F: PixelFormat> Picture<'a, F> {
    /// `width` × `height` pixels.
    ///
    /// # Errors
    /// [`Error::EmptyTexture`] without width or height, [`Error::BufferTooSmall`] where `pixels` holds fewer.
    pub fn new(format: F, pixels: &'a [F::Pixel], width: u16, height: u16) -> Result<Self, Error> {
        if width == 0 || height == 0 {
            return Err(Error::EmptyTexture);
        }
        if (pixels.len() as u64) < width as u64 * height as u64 {
            return Err(Error::BufferTooSmall);
        }
        Ok(Picture {
            format,
            pixels,
            width,
            height,
        })
    }
}

impl<F: PixelFormat> Image for Picture<'_, F> {
    #[inline(always)]
    fn size(&self) -> (u16, u16) {
        (self.width, self.height)
    }
    #[inline(always)]
    fn color(&self, i: u16, j: u16) -> Rgba {
        let index = j as usize * self.width as usize + i as usize;
        match self.pixels.get(index) {
            Some(&pixel) => self.format.decode(pixel),
            None => Rgba::default(),
        }
    }
}

/// Which texel stands for a whole index beside the image. A type that is chosen when compiled, or a [`Wrapping`].
///
/// ```
/// use fixel::pipeline::{ClampToEdge, Repeat, Wrap};
/// assert_eq!((ClampToEdge.wrap(-1, 4), Repeat.wrap(-1, 4)), (0, 3));
/// ```
pub trait Wrap {
    /// The index of 0…size−1 for any `index`; `size` is at least 1.
    fn wrap(&self, index: i32, size: u16) -> u16;
}

/// The nearest texel of the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ClampToEdge;

/// The image again and again: index mod size.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Repeat;

/// The image and its mirror image in turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MirroredRepeat;

/// The mirror image before the image, and the nearest texel beyond both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MirroredClampToEdge;

impl Wrap for ClampToEdge {
    #[inline(always)]
    fn wrap(&self, index: i32, size: u16) -> u16 {
        index.clamp(0, (size as i32 - 1).max(0)) as u16
    }
}

impl Wrap for Repeat {
    #[inline(always)]
    fn wrap(&self, index: i32, size: u16) -> u16 {
        remainder(index, size as u32) as u16
    }
}

impl Wrap for MirroredRepeat {
    #[inline(always)]
    fn wrap(&self, index: i32, size: u16) -> u16 {
        let size = size as i32;
        let turned = mirror(remainder(index, 2 * size as u32) - size);
        (size - 1 - turned) as u16
    }
}

impl Wrap for MirroredClampToEdge {
    #[inline(always)]
    fn wrap(&self, index: i32, size: u16) -> u16 {
        ClampToEdge.wrap(mirror(index), size)
    }
}

/// A [`Wrap`] chosen when drawing.
///
/// ```
/// use fixel::pipeline::{Wrap, Wrapping};
/// let wrap = |wrapping: Wrapping| [-5, -1, 4, 8].map(|i| wrapping.wrap(i, 4));
/// assert_eq!(wrap(Wrapping::ClampToEdge), [0, 0, 3, 3]);
/// assert_eq!(wrap(Wrapping::Repeat), [3, 3, 0, 0]);
/// assert_eq!(wrap(Wrapping::MirroredRepeat), [3, 0, 3, 0]);
/// assert_eq!(wrap(Wrapping::MirroredClampToEdge), [3, 0, 3, 3]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wrapping {
    /// As [`ClampToEdge`].
    #[default]
    ClampToEdge,
    /// As [`Repeat`].
    Repeat,
    /// As [`MirroredRepeat`].
    MirroredRepeat,
    /// As [`MirroredClampToEdge`].
    MirroredClampToEdge,
}

impl Wrap for Wrapping {
    #[inline]
    fn wrap(&self, index: i32, size: u16) -> u16 {
        match self {
            Wrapping::ClampToEdge => ClampToEdge.wrap(index, size),
            Wrapping::Repeat => Repeat.wrap(index, size),
            Wrapping::MirroredRepeat => MirroredRepeat.wrap(index, size),
            Wrapping::MirroredClampToEdge => MirroredClampToEdge.wrap(index, size),
        }
    }
}

/// How texels make a colour. A type that is chosen when compiled, or a [`Filtering`]. The example is [`Sampler`]'s.
pub trait Filter {
    /// The colour at a place of 2^-`fraction_bits` texel, with wrapped texels from `texel`.
    fn sample(&self, place: [i64; 2], fraction_bits: u32, texel: impl Fn(i32, i32) -> Rgba) -> Rgba;
}

/// The texel in which the place lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Nearest;

/// The four texels whose centres are around the place, by their nearness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Linear;

impl Filter for Nearest {
    #[inline(always)]
    fn sample(&self, place: [i64; 2], fraction_bits: u32, texel: impl Fn(i32, i32) -> Rgba) -> Rgba {
        let [i, j] = place.map(|p| (p >> fraction_bits) as i32);
        texel(i, j)
    }
}

impl Filter for Linear {
    #[inline]
    fn sample(&self, place: [i64; 2], fraction_bits: u32, texel: impl Fn(i32, i32) -> Rgba) -> Rgba {
        // Texel centres lie at halves; with a bit more everything stays whole.
        let bits = fraction_bits + 1;
        let [(i, s), (j, t)] = place.map(|p| {
            let p = 2 * p - (1 << fraction_bits);
            let fraction = p & ((1 << bits) - 1);
            ((p >> bits) as i32, (fraction << (31 - bits)) >> 3)
        });
        let row = |j| mix(texel(i, j), texel(i + 1, j), s);
        mix(row(j), row(j + 1), t)
    }
}

/// A [`Filter`] chosen when drawing.
///
/// ```
/// use fixel::{blend::ONE, pipeline::{Filtering, Sampler}, texture::{Rgba8888, Texture}};
/// let texels = [[0; 4], [255; 4]];
/// let mut sampler = Sampler::new(Texture::new(Rgba8888, &texels, 2, 1)?, 16).filtered(Filtering::Nearest);
/// assert_eq!(sampler.sample([1 << 15, 0]).alpha, ONE);
/// sampler.filter = Filtering::Linear;
/// assert_eq!(sampler.sample([1 << 15, 0]).alpha, ONE / 2);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Filtering {
    /// As [`Nearest`].
    #[default]
    Nearest,
    /// As [`Linear`].
    Linear,
}

impl Filter for Filtering {
    #[inline]
    fn sample(&self, place: [i64; 2], fraction_bits: u32, texel: impl Fn(i32, i32) -> Rgba) -> Rgba {
        match self {
            Filtering::Nearest => Nearest.sample(place, fraction_bits, texel),
            Filtering::Linear => Linear.sample(place, fraction_bits, texel),
        }
    }
}

/// An image, and how it is looked up. At first nearest, and clamped to its edges.
///
/// A coordinate is an integer with 16 to 30 fraction bits of the *whole* image: u = 1 is its right side, v = 1 its upper
/// one where row 0 is the lowest. From there on all indices are exact: u·width is not rounded before its floor is taken,
/// for any coordinate and any size.
///
/// **Error.** Nearest: none. Linear: weights are cut to 2^-28, and each mix of two is rounded once: with d the largest
/// distance of the four texels, 1½ units of 2^-28 and 2^-27·d (`tests/pipeline_06.rs`). A coordinate itself is as good as
/// its varying: one unit of 2^-16 is 1/64 texel of an image of 1024.
///
/// ```
/// use fixel::{blend::ONE, pipeline::{LinearFilter, Repeat, Sampler}, texture::{Rgba8888, Texture}};
/// let texels = [[0; 4], [255; 4]];
/// let sampler = Sampler::new(Texture::new(Rgba8888, &texels, 2, 1)?, 16);
/// assert_eq!(sampler.sample([1 << 15, 0]).alpha, ONE);
/// // A quarter of the way from the last texel's centre to the first's, repeated.
/// let smooth = sampler.filtered(LinearFilter).wrapped(Repeat, Repeat);
/// assert_eq!(smooth.sample([7 << 13, 0]).alpha, ONE / 4 * 3);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Sampler<I, F = Nearest, S = ClampToEdge, T = ClampToEdge> {
    /// What is sampled.
    pub image: I,
    /// How texels make a colour.
    pub filter: F,
    /// Along u.
    pub wrap_s: S,
    /// Along v.
    pub wrap_t: T,
    fraction_bits: u32,
}

impl<I: Image> Sampler<I> {
    /// Samples `image` at coordinates of `fraction_bits`, 16 to 30: the nearest of these for any other.
    pub const fn new(image: I, fraction_bits: u32) -> Self {
        let fraction_bits = if fraction_bits < 16 {
            16
        } else if fraction_bits > 30 {
            30
        } else {
            fraction_bits
        };
        Sampler {
            image,
            filter: Nearest,
            wrap_s: ClampToEdge,
            wrap_t: ClampToEdge,
            fraction_bits,
        }
    }
}

impl<I, F, S, T> Sampler<I, F, S, T> {
    /// The same with another filter.
    pub fn filtered<G: Filter>(self, filter: G) -> Sampler<I, G, S, T> {
        Sampler {
            image: self.image,
            filter,
            wrap_s: self.wrap_s,
            wrap_t: self.wrap_t,
            fraction_bits: self.fraction_bits,
        }
    }

    /// The same wrapped otherwise, along u and along v.
    pub fn wrapped<U: Wrap, V: Wrap>(self, wrap_s: U, wrap_t: V) -> Sampler<I, F, U, V> {
        Sampler {
            image: self.image,
            filter: self.filter,
            wrap_s,
            wrap_t,
            fraction_bits: self.fraction_bits,
        }
    }
}

impl<I: Image, F: Filter, S: Wrap, T: Wrap> Sampler<I, F, S, T> {
    /// The colour at (u, v), v towards higher rows.
    #[inline]
    pub fn sample(&self, [u, v]: [i32; 2]) -> Rgba {
        let (width, height) = self.image.size();
        // Below 2^31·2^16: after the shift by 16 bits or more an index fits an i32, and so does the next.
        let place = [u as i64 * width as i64, v as i64 * height as i64];
        self.filter.sample(place, self.fraction_bits, |i, j| {
            self.image
                .color(self.wrap_s.wrap(i, width), self.wrap_t.wrap(j, height))
        })
    }
}

/// index mod size, in 0…size−1; 0 for size 0.
#[inline(always)]
fn remainder(index: i32, size: u32) -> i32 {
    if size.is_power_of_two() {
        (index as u32 & (size - 1)) as i32
    } else if (index as u32) < size {
        index
    } else {
        index.checked_rem_euclid(size as i32).unwrap_or(0)
    }
}

/// a, or for a negative one its mirror image −1 − a.
#[inline(always)]
fn mirror(a: i32) -> i32 {
    if a >= 0 { a } else { !a }
}

/// a + (b − a)·weight, the weight in units of 2^-28 below 1.
#[inline(always)]
fn mix(a: Rgba, b: Rgba, weight: i64) -> Rgba {
    // Below 2^32·2^28; between the two.
    let channel = |a: i32, b: i32| (a as i64 + (((b as i64 - a as i64) * weight + (1 << 27)) >> 28)) as i32;
    let ([ar, ag, ab], [br, bg, bb]) = (a.color, b.color);
    Rgba {
        color: [channel(ar, br), channel(ag, bg), channel(ab, bb)],
        alpha: channel(a.alpha, b.alpha),
    }
}
