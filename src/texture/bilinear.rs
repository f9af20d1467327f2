//! Linear filtering of RGB565 texels: the four whose centres are around a place, by their nearness.
//!
//! The place is rounded to the nearest 1/32 texel; all else is exact until a pixel is rounded, in words of 32 bits with five
//! products.

use core::marker::PhantomData;

use crate::fragment::Fragment;
use crate::pipeline::{Repeat, Wrap};
use crate::varying::Varying;

use super::{Rgb565, Texture, parts};

/// Linear sampling of a texture of any size, which repeats unless [`wrapped`](Self::wrapped) otherwise.
///
/// Texel (i, j) is centred at i + ½, j + ½, as in [`Sampler`](crate::pipeline::Sampler) and [`Tiled565`](super::Tiled565);
/// [`Nearest`](super::Nearest) has it at i, j instead.
///
/// **Error** of a channel: at most (h + v)/64 with h the larger difference of the two pairs of texels beside one another and v
/// that of the two pairs above one another, so 1 level of 31 and 2 of 63 at most; a stored pixel half a level more
/// (`tests/bilinear.rs`). For weights of 28 bits there is [`LinearFilter`](crate::pipeline::LinearFilter).
///
/// ```
/// use fixel::{pipeline::{ClampToEdge, Repeat}, texture::{Bilinear565, Rgb565, Texture}};
/// // Blue levels 0 and 16, beside one another.
/// let smooth = Bilinear565::new(Texture::new(Rgb565, &[0, 16], 2, 1)?, 16);
/// let at = |quarters: i32| smooth.stored([quarters << 14, 0]);
/// // The centres, half-way from one to the other, and half-way back to the first.
/// assert_eq!([2, 4, 6, 8].map(at), [0, 8, 16, 8]);
/// assert_eq!(smooth.wrapped(ClampToEdge, Repeat).stored([8 << 14, 0]), 16);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Bilinear565<'a, S = Repeat, T = Repeat> {
    texture: Texture<'a, Rgb565>,
    fraction_bits: u32,
    wrap_s: S,
    wrap_t: T,
}

impl<'a> Bilinear565<'a> {
    /// Samples `texture` at coordinates in units of 2^-`fraction_bits` texel, 5 to 31: the nearest of these for any other.
    pub const fn new(texture: Texture<'a, Rgb565>, fraction_bits: u32) -> Self {
        let fraction_bits = match fraction_bits {
            0..5 => 5,
            5..32 => fraction_bits,
            _ => 31,
        };
        Bilinear565 {
            texture,
            fraction_bits,
            wrap_s: Repeat,
            wrap_t: Repeat,
        }
    }
}

impl<'a, S, T> Bilinear565<'a, S, T> {
    /// The same wrapped otherwise, along s and along t.
    pub const fn wrapped<U: Wrap, V: Wrap>(&self, wrap_s: U, wrap_t: V) -> Bilinear565<'a, U, V> {
        Bilinear565 {
            texture: self.texture,
            fraction_bits: self.fraction_bits,
            wrap_s,
            wrap_t,
        }
    }
}

impl<S: Wrap, T: Wrap> Bilinear565<'_, S, T> {
    /// The colour at (s·width, t·height), rounded to nearest.
    ///
    /// The example is the type's.
    #[inline]
    pub fn stored(&self, st: [i32; 2]) -> u16 {
        self.mixed(st).pixel()
    }

    /// Red, green and blue there in units of 2^-16 of a level of 31, 63 and 31, as
    /// [`dither::rgb565_fine`](crate::dither::rgb565_fine) takes them.
    ///
    /// ```
    /// use fixel::texture::{Bilinear565, Rgb565, Texture};
    /// let smooth = Bilinear565::new(Texture::new(Rgb565, &[0, 1], 2, 1)?, 8);
    /// assert_eq!(smooth.levels([256 + 64, 0]), [0, 0, 3 << 14]);
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    #[inline]
    pub fn levels(&self, st: [i32; 2]) -> [i32; 3] {
        self.mixed(st).levels()
    }

    #[inline(always)]
    fn mixed(&self, st: [i32; 2]) -> Mixed {
        let [(i, s), (j, t)] = st.map(|c| corner(c, self.fraction_bits));
        let (width, height) = (self.texture.width, self.texture.height);
        let columns = [i, i + 1].map(|i| self.wrap_s.wrap(i, width).into());
        let rows = [j, j + 1].map(|j| self.wrap_t.wrap(j, height).into());
        Mixed::new(rows.map(|j| columns.map(|i| self.texture.stored(i, j))), [s, t])
    }
}

/// The texel whose centre is before a coordinate or at it, in −2^26…2^26, and how far beyond in 32nds of a texel, rounded to
/// nearest; `fraction_bits` in 5…31.
#[inline(always)]
fn corner(coordinate: i32, fraction_bits: u32) -> (i32, u32) {
    let (whole, fraction) = parts(coordinate, fraction_bits);
    let (fraction, borrowed) = fraction.overflowing_sub(HALF_BUT_A_64TH);
    (whole - borrowed as i32, fraction >> 27)
}

/// Of a texel in units of 2^-32: from a side to the centre, less what rounds 32nds to nearest.
const HALF_BUT_A_64TH: u32 = (1 << 31) - (1 << 26);

/// A colour of four texels, 1024 times as large: red from bit 16 on and blue, and green.
#[derive(Clone, Copy)]
struct Mixed {
    red_blue: u32,
    green: u32,
}

impl Mixed {
    /// Rows of two texels, by how near the second of a row and the second row are, in 32nds below 1.
    #[inline(always)]
    fn new(texels: [[u16; 2]; 2], [s, t]: [u32; 2]) -> Self {
        // a·(32 − weight) + b·weight of fields beside one another: what they borrow of each other on the way is given back.
        let mix = |a: u32, b: u32, weight: u32| (a << 5).wrapping_add(b.wrapping_sub(a).wrapping_mul(weight));
        // Blue in bits 0–4, red in 11–15, green in 21–26: room for five bits more of each.
        let spread = |texel: u16| (texel as u32 | (texel as u32) << 16) & 0x07e0_f81f;
        let [above, below] = texels.map(|[a, b]| mix(spread(a), spread(b), s));
        // At most 31·32 below bit 11 and from there on: red moves to 16, and both have room for five bits more.
        let red_blue = |row: u32| row & 0x3ff | (row & 0x1f_f800) << 5;
        Mixed {
            red_blue: mix(red_blue(above), red_blue(below), t),
            green: mix(above >> 21, below >> 21, t),
        }
    }

    #[inline(always)]
    fn pixel(self) -> u16 {
        // At most 31·1024 and 63·1024, with the half below a level more.
        let (red_blue, green) = (self.red_blue + 0x0200_0200, self.green + 0x200);
        (red_blue >> 26 << 11 | green >> 10 << 5 | red_blue >> 10 & 31) as u16
    }

    #[inline(always)]
    fn levels(self) -> [i32; 3] {
        [self.red_blue >> 16, self.green, self.red_blue & 0xffff].map(|channel| (channel << 6) as i32)
    }
}

/// A fragment program: RGB565 texels of a repeated texture, filtered linearly. [`Tiled565`](super::Tiled565) with the colours
/// of [`Bilinear565`].
///
/// ```
/// use fixel::{fragment::Fragment, texture::TiledBilinear565, varying::Perspective32};
/// static BOARD: [[u16; 2]; 2] = [[0, 8], [16, 24]];
/// let board = TiledBilinear565::<Perspective32<2>, 2, 2>::new(&BOARD);
/// assert_eq!(board.shade([0x1_8000, 0x8000], 0), Some(8));
/// assert_eq!(board.shade([0x1_0000, 0x1_0000], 0), Some(12));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct TiledBilinear565<'a, V, const WIDTH: usize, const HEIGHT: usize> {
    texels: &'a [[u16; WIDTH]; HEIGHT],
    varying: PhantomData<V>,
}

impl<'a, V, const WIDTH: usize, const HEIGHT: usize> TiledBilinear565<'a, V, WIDTH, HEIGHT> {
    /// Of rows of texels, from the top.
    pub const fn new(texels: &'a [[u16; WIDTH]; HEIGHT]) -> Self {
        const {
            assert!(WIDTH.is_power_of_two() && HEIGHT.is_power_of_two() && WIDTH <= 1 << 16 && HEIGHT <= 1 << 16);
        }
        TiledBilinear565 {
            texels,
            varying: PhantomData,
        }
    }

    /// Red, green and blue at a place in units of 2^-16 texel, in units of 2^-16 of a level of 31, 63 and 31.
    ///
    /// ```
    /// use fixel::{texture::TiledBilinear565, varying::Linear32};
    /// let dots = TiledBilinear565::<Linear32<2>, 2, 1>::new(&[[0, 1]]);
    /// assert_eq!(dots.levels([0x1_4000, 0]), [0, 0, 3 << 14]);
    /// ```
    #[inline(always)]
    pub fn levels(&self, place: [i32; 2]) -> [i32; 3] {
        self.mixed(place).levels()
    }

    #[inline(always)]
    fn mixed(&self, place: [i32; 2]) -> Mixed {
        // What wraps around is a multiple of either side.
        let [u, v] = place.map(|c| c.wrapping_sub((HALF_BUT_A_64TH >> 16) as i32));
        let columns = [u >> 16, (u >> 16) + 1].map(|i| i as usize & (WIDTH - 1));
        let rows = [v >> 16, (v >> 16) + 1].map(|j| j as usize & (HEIGHT - 1));
        // Always there: what the bounds are checked against are constants.
        let texel = |i: usize, j: usize| self.texels.get(j).and_then(|row| row.get(i)).copied().unwrap_or(0);
        let texels = rows.map(|j| columns.map(|i| texel(i, j)));
        Mixed::new(texels, [u, v].map(|c| (c >> 11) as u32 & 31))
    }
}

impl<V, const WIDTH: usize, const HEIGHT: usize> Fragment for TiledBilinear565<'_, V, WIDTH, HEIGHT>
where
    V: Varying<Values = [i32; 2]>,
{
    type Varying = V;
    type Pixel = u16;

    #[inline(always)]
    fn shade(&self, place: [i32; 2], _below: u16) -> Option<u16> {
        Some(self.mixed(place).pixel())
    }
}
