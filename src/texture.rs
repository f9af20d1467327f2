//! Textures over the caller's slice: a format, a size, nearest and linear sampling, and decals.
//!
//! Everything here can be a constant, so that a texture and its texels stay in flash. A texture coordinate arrives as it
//! was interpolated: s·width and t·height, *in texels*, as an integer with a number of fraction bits that is chosen per
//! primitive; 16 hold ±16384 texels within the 2^30 of a [`Linear`](crate::varying::Linear) or
//! [`Perspective`](crate::varying::Perspective) value. The texel picked from it is exact for every coordinate and size.
//!
//! **Error** of a coordinate is that of its varying. The whole texture on a quad in perspective, largest error found in
//! units of 2^-8 texel by the ratio of w over the quad (`tests/textures.rs` prints and checks it):
//!
//! | texels | fraction bits | 1 | 2 | 10 | 100 | 1000 |
//! |---|---|---|---|---|---|---|
//! | 64² | 16 | 0.004 | 0.02 | 0.03 | 0.03 | 1.1 |
//! | 1024² | 16 | 0.004 | 0.02 | 0.03 | 0.2 | 0.7 |
//! | 64² to 1024² | as many as fit | 0.001 | 0.001 | 0.001 | 0.02 | 0.05 |
//!
//! So as many fraction bits as fit are best: 30 − log2 of the largest coordinate of the primitive.
//!
//! ```
//! use fixel::{depth::NoDepth, draw, fragment::Fragment, screen::{Corner, FineDepth, Position}, target::Buffer};
//! use fixel::{texture::{Floor, Nearest, Rgb565, Texture}, varying::Linear};
//!
//! // Two by two texels, in flash; a wrong size is a compile error.
//! const BOARD: Texture<Rgb565> = match Texture::new(Rgb565, &[1, 0, 0, 1], 2, 2) {
//!     Ok(texture) => texture,
//!     Err(_) => panic!("a texture of another size"),
//! };
//!
//! struct Textured(Nearest<'static, Rgb565, Floor>);
//!
//! impl Fragment for Textured {
//!     type Varying = Linear<2>;
//!     type Pixel = u16;
//!     fn shade(&self, st: [i32; 2], _below: u16) -> Option<u16> {
//!         Some(self.0.stored(st))
//!     }
//! }
//!
//! // One texel per pixel.
//! let corners = [(0, 0), (0, 4), (4, 0)].map(|(x, y)| Corner {
//!     position: Position::from_pixels(x, y),
//!     depth: FineDepth::ZERO,
//!     varying: Linear([(x as i32) << 16, (y as i32) << 16]),
//! });
//! let mut picture = [9; 4 * 3];
//! draw::triangle(&mut Buffer::new(&mut picture, 4, 3)?, &mut NoDepth, corners, &Textured(Nearest::new(BOARD, 16)));
//! assert_eq!(picture, [1, 0, 1, 0, 0, 1, 0, 9, 1, 0, 9, 9]);
//! # Ok::<(), fixel::error::Error>(())
//! ```

mod bilinear;

use core::fmt::Debug;
use core::marker::PhantomData;

use crate::error::Error;
use crate::fragment::Fragment;
use crate::varying::Varying;

pub use bilinear::{Bilinear565, TiledBilinear565};

/// A colour of a texture: red, green, blue and alpha in 0…255. Alpha is not multiplied in; 255 is opaque.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Texel(pub [u8; 4]);

impl Texel {
    /// Red, green and blue as fragments carry them: in units of 2^(shift−16) levels of 0…255, rounded to nearest. `shift`
    /// is 0 unless other colours of the primitive are too bright for that.
    ///
    /// ```
    /// use fixel::texture::Texel;
    /// assert_eq!(Texel([1, 2, 255, 0]).channels(0), [1 << 16, 2 << 16, 255 << 16]);
    /// assert_eq!(Texel([1, 2, 255, 0]).channels(16), [1, 2, 255]);
    /// ```
    #[inline]
    pub fn channels(self, shift: u32) -> [i32; 3] {
        let Texel([red, green, blue, _]) = self;
        let shift = shift.min(30);
        [red, green, blue].map(|v| (((v as i32) << 16) + ((1 << shift) >> 1)) >> shift)
    }

    /// The decal rule of HW2 and MP1: rgb·α + color·(1 − α), channel by channel, in units of 2^(shift−16) levels (see
    /// [`channels`](Self::channels)). `color` may lie outside 0…255 levels; any `i32` will do.
    ///
    /// The result lies between texel and colour, and is exactly one of them for α = 255 and α = 0. **Error**: at most
    /// ½ + d·2^-25 units for a distance of d units between the two, so 1 unit where both are in 0…255 levels; with a
    /// `shift` another ½ from [`channels`](Self::channels).
    ///
    /// ```
    /// use fixel::texture::Texel;
    /// let half_red = Texel([255, 0, 0, 128]);
    /// let [red, green, blue] = half_red.over([0, 300 << 16, -(100 << 16)], 0).map(|v| v >> 16);
    /// assert_eq!([red, green, blue], [128, 149, -50]); // 128, 149.4, −49.8
    /// ```
    #[inline]
    pub fn over(self, color: [i32; 3], shift: u32) -> [i32; 3] {
        let Texel([.., alpha]) = self;
        // α/255 in units of 2^-24, rounded to nearest: 2^24 = 255·65793 + 1.
        let weight = alpha as i64 * 65793 + (alpha >> 7) as i64;
        let mut texel = self.channels(shift).into_iter();
        // |texel − color| < 2^31 + 2^24 and weight ≤ 2^24: below 2^56. The result lies between the two, so in an i32.
        color.map(|c| {
            let distance = texel.next().unwrap_or(0) as i64 - c as i64;
            (c as i64 + ((distance * weight + (1 << 23)) >> 24)) as i32
        })
    }
}

/// How texels are stored: [`Rgba8888`], [`Rgb565`], [`Palette`], or one's own.
///
/// ```
/// use fixel::texture::{Format, Texel, Texture};
///
/// /// Grey bytes.
/// #[derive(Debug, Clone, Copy)]
/// struct Luma8;
///
/// impl Format for Luma8 {
///     type Stored = u8;
///     fn texel(&self, stored: u8) -> Texel {
///         Texel([stored, stored, stored, 255])
///     }
/// }
/// assert_eq!(Texture::new(Luma8, &[7], 1, 1)?.texel(0, 0), Texel([7, 7, 7, 255]));
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub trait Format: Copy + Debug {
    /// What the slice holds.
    type Stored: Copy + Default + Debug + 'static;
    /// The colour that it stands for.
    fn texel(&self, stored: Self::Stored) -> Texel;
}

/// Four bytes: red, green, blue, alpha.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rgba8888;

impl Format for Rgba8888 {
    type Stored = [u8; 4];

    #[inline(always)]
    fn texel(&self, stored: [u8; 4]) -> Texel {
        Texel(stored)
    }
}

/// Words of five bits of red, six of green, five of blue, from the top; opaque.
///
/// A channel of n bits with value v becomes the byte nearest to 255·v / (2^n − 1); no channel is halfway between two.
///
/// ```
/// use fixel::texture::{Format, Rgb565, Texel};
/// assert_eq!(Rgb565.texel(0xf81f), Texel([255, 0, 255, 255]));
/// assert_eq!(Rgb565.texel(0x0401), Texel([0, 130, 8, 255]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rgb565;

impl Format for Rgb565 {
    type Stored = u16;

    #[inline(always)]
    fn texel(&self, stored: u16) -> Texel {
        let (red, green, blue) = ((stored >> 11) as u32, (stored >> 5 & 63) as u32, (stored & 31) as u32);
        // 527/64 and 259/64 instead of 255/31 and 255/63: equal after rounding for every value.
        let five = |v: u32| ((v * 527 + 23) >> 6) as u8;
        let six = |v: u32| ((v * 259 + 33) >> 6) as u8;
        Texel([five(red), six(green), five(blue), 255])
    }
}

/// Bytes that are indices into this slice of up to 256 colours, each red, green, blue, alpha. An index beyond its end is
/// transparent black.
///
/// ```
/// use fixel::texture::{Palette, Texel, Texture};
/// let flag = Texture::new(Palette(&[[0, 0, 255, 255], [255, 255, 0, 255]]), &[0, 1, 0], 3, 1)?;
/// assert_eq!(flag.texel(1, 0), Texel([255, 255, 0, 255]));
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Palette<'a>(pub &'a [[u8; 4]]);

impl Format for Palette<'_> {
    type Stored = u8;

    #[inline(always)]
    fn texel(&self, stored: u8) -> Texel {
        Texel(self.0.get(stored as usize).copied().unwrap_or_default())
    }
}

/// A picture of `width` × `height` texels in the caller's slice, row after row from the top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Texture<'a, F: Format> {
    format: F,
    texels: &'a [F::Stored],
    width: u16,
    height: u16,
}

impl<'a, F: Format> Texture<'a, F> {
    /// The first `width` · `height` of `texels`; any size from 1×1, powers of two or not.
    ///
    /// # Errors
    /// [`Error::EmptyTexture`] without width or height, [`Error::BufferTooSmall`] where `texels` holds fewer.
    ///
    /// ```
    /// use fixel::{error::Error, texture::{Rgb565, Texture}};
    /// assert!(Texture::new(Rgb565, &[0; 15], 5, 3).is_ok());
    /// assert_eq!(Texture::new(Rgb565, &[0; 15], 4, 4), Err(Error::BufferTooSmall));
    /// assert_eq!(Texture::new(Rgb565, &[], 0, 4), Err(Error::EmptyTexture));
    /// ```
    pub const fn new(format: F, texels: &'a [F::Stored], width: u16, height: u16) -> Result<Self, Error> {
        if width == 0 || height == 0 {
            return Err(Error::EmptyTexture);
        }
        if (texels.len() as u64) < width as u64 * height as u64 {
            return Err(Error::BufferTooSmall);
        }
        Ok(Texture {
            format,
            texels,
            width,
            height,
        })
    }

    /// Texels in a row, 1 or more.
    pub const fn width(&self) -> u16 {
        self.width
    }

    /// Rows, 1 or more.
    pub const fn height(&self) -> u16 {
        self.height
    }

    /// The colour in column `i` of row `j`; transparent black off the texture.
    #[inline]
    pub fn texel(&self, i: u16, j: u16) -> Texel {
        if i < self.width && j < self.height {
            self.format.texel(self.stored(i as u32, j as u32))
        } else {
            Texel::default()
        }
    }

    /// Column `i` of row `j`, both on the texture.
    #[inline(always)]
    fn stored(&self, i: u32, j: u32) -> F::Stored {
        // At most 65534·65535 + 65534 < 2^32, and within the slice by construction.
        let index = (j * self.width as u32 + i) as usize;
        self.texels.get(index).copied().unwrap_or_default()
    }
}

/// From a texture coordinate to a whole index, before wrapping: [`Floor`] (HW2) or [`TowardsZero`] (MP1).
pub trait Rounding {
    /// The index for `coordinate` in units of 2^-`fraction_bits` texel, `fraction_bits` in 0…31.
    fn index(coordinate: i32, fraction_bits: u32) -> i32;
}

/// floor(x + ½): the nearest whole texel, a tie upwards (HW2).
///
/// ```
/// use fixel::texture::{Floor, Rounding};
/// assert_eq!([-24, -9, -8, 7, 8].map(|x| Floor::index(x, 4)), [-1, -1, 0, 0, 1]);
/// ```
#[derive(Debug, Clone, Copy)]
pub enum Floor {}

impl Rounding for Floor {
    #[inline(always)]
    fn index(coordinate: i32, fraction_bits: u32) -> i32 {
        let (whole, fraction) = parts(coordinate, fraction_bits);
        whole + (fraction >> 31) as i32
    }
}

/// x + ½ cut towards zero (MP1): one texel to the right of [`Floor`] where x + ½ is negative and not whole.
///
/// ```
/// use fixel::texture::{Rounding, TowardsZero};
/// assert_eq!([-24, -9, -8, 7, 8].map(|x| TowardsZero::index(x, 4)), [-1, 0, 0, 0, 1]);
/// ```
#[derive(Debug, Clone, Copy)]
pub enum TowardsZero {}

impl Rounding for TowardsZero {
    #[inline(always)]
    fn index(coordinate: i32, fraction_bits: u32) -> i32 {
        let (whole, fraction) = parts(coordinate, fraction_bits);
        let floor = whole + (fraction >> 31) as i32;
        // x + ½ is whole where the fraction is exactly a half.
        floor + (floor < 0 && fraction != 1 << 31) as i32
    }
}

/// The whole texels below a coordinate, and the rest in units of 2^-32 texel: exact. With fraction bits |whole| ≤ 2^30,
/// without them the rest is 0, so that one more always fits.
#[inline(always)]
fn parts(coordinate: i32, fraction_bits: u32) -> (i32, u32) {
    let bits = fraction_bits.min(31);
    (coordinate >> bits, (coordinate as u32) << (31 - bits) << 1)
}

/// Nearest sampling with wrapping: texel i = round(s·width) mod width, j = round(t·height) mod height, with mod in
/// 0…size−1 and rounding as `R` says. No filtering. Exact for every coordinate and every size.
///
/// A coordinate on the texture costs no division, and neither does one off it where the size is a power of two.
///
/// ```
/// use fixel::texture::{Floor, Nearest, Palette, Texture, TowardsZero};
/// let colors = [[10, 0, 0, 255], [20, 0, 0, 255], [30, 0, 0, 255]];
/// let stripes = Texture::new(Palette(&colors), &[0, 1, 2], 3, 1)?;
/// let floor = Nearest::<_, Floor>::new(stripes, 16);
/// let cut = Nearest::<_, TowardsZero>::new(stripes, 16);
/// // s = −0.3 at width 3 is −0.9 texels; −0.9 + ½ goes down to −1, which is the last texel, or is cut to 0.
/// let st = [-9 * 65536 / 10, 0];
/// assert_eq!((floor.stored(st), cut.stored(st)), (2, 0));
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Nearest<'a, F: Format, R> {
    texture: Texture<'a, F>,
    fraction_bits: u32,
    rounding: PhantomData<R>,
}

impl<'a, F: Format, R: Rounding> Nearest<'a, F, R> {
    /// Samples `texture` at coordinates in units of 2^-`fraction_bits` texel; more than 31 are taken as 31.
    pub const fn new(texture: Texture<'a, F>, fraction_bits: u32) -> Self {
        let fraction_bits = if fraction_bits < 31 { fraction_bits } else { 31 };
        Nearest {
            texture,
            fraction_bits,
            rounding: PhantomData,
        }
    }

    /// The colour at (s·width, t·height).
    #[inline(always)]
    pub fn texel(&self, st: [i32; 2]) -> Texel {
        self.texture.format.texel(self.stored(st))
    }

    /// What is stored at (s·width, t·height): for targets in the texture's own format.
    #[inline(always)]
    pub fn stored(&self, [s, t]: [i32; 2]) -> F::Stored {
        let i = wrapped(R::index(s, self.fraction_bits), self.texture.width);
        let j = wrapped(R::index(t, self.fraction_bits), self.texture.height);
        self.texture.stored(i, j)
    }
}

/// `index` mod `size`, in 0…size−1.
#[inline(always)]
fn wrapped(index: i32, size: u16) -> u32 {
    let size = size as u32;
    if size.is_power_of_two() {
        index as u32 & (size - 1)
    } else if (index as u32) < size {
        index as u32
    } else {
        // Never `None`: a texture has no size 0.
        index.checked_rem_euclid(size as i32).unwrap_or(0) as u32
    }
}

/// A fragment program: RGB565 texels of a repeated texture, the one that each pixel's sample lies in.
///
/// Texel (i, j) is `texels[j][i]` and holds i ≤ u < i + 1, j ≤ v < j + 1, with u and v in units of 2^-16 texel, from
/// [`Perspective32`](crate::varying::Perspective32), [`Perspective`](crate::varying::Perspective) or
/// [`Linear`](crate::varying::Linear). The sides are powers of two, so that a mask is all it takes to stay on the texture;
/// others do not compile.
///
/// ```
/// use fixel::{fragment::Fragment, texture::Tiled565, varying::Perspective32};
/// static BOARD: [[u16; 2]; 2] = [[1, 2], [3, 4]];
/// let board = Tiled565::<Perspective32<2>, 2, 2>::new(&BOARD);
/// assert_eq!(board.shade([0x1_8000, 0], 0), Some(2));
/// assert_eq!(board.shade([-1, 0x7_0000], 0), Some(4));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Tiled565<'a, V, const WIDTH: usize, const HEIGHT: usize> {
    texels: &'a [[u16; WIDTH]; HEIGHT],
    varying: PhantomData<V>,
}

impl<'a, V, const WIDTH: usize, const HEIGHT: usize> Tiled565<'a, V, WIDTH, HEIGHT> {
    /// Of rows of texels, from the top.
    pub const fn new(texels: &'a [[u16; WIDTH]; HEIGHT]) -> Self {
        const {
            assert!(WIDTH.is_power_of_two() && HEIGHT.is_power_of_two());
        }
        Tiled565 {
            texels,
            varying: PhantomData,
        }
    }
}

impl<V, const WIDTH: usize, const HEIGHT: usize> Fragment for Tiled565<'_, V, WIDTH, HEIGHT>
where
    V: Varying<Values = [i32; 2]>,
{
    type Varying = V;
    type Pixel = u16;

    #[inline(always)]
    fn shade(&self, [u, v]: [i32; 2], _below: u16) -> Option<u16> {
        let (i, j) = ((u >> 16) as usize & (WIDTH - 1), (v >> 16) as usize & (HEIGHT - 1));
        // Always there: what the bounds are checked against are constants.
        self.texels.get(j).and_then(|row| row.get(i)).copied()
    }
}
