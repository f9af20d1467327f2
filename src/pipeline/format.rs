//! Pixel formats, and whole pictures: reading, setting, writing out.

use crate::blend::{ONE, Rgba};
use crate::screen::SubPx;
use crate::target::Target;
use crate::texture::{Rgb565, Rgba8888, Texel};

/// How a [`Surface`](super::Surface) stores colours: encoded when written, decoded to blend and to sample.
///
/// ```
/// use fixel::{blend::{ONE, Rgba}, pipeline::PixelFormat};
///
/// /// Grey bytes.
/// struct Grey;
///
/// impl PixelFormat for Grey {
///     type Pixel = u8;
///     fn encode(&self, color: Rgba) -> u8 {
///         let [red, green, blue] = color.to_bytes();
///         ((red as u32 + 2 * green as u32 + blue as u32 + 2) / 4) as u8
///     }
///     fn decode(&self, pixel: u8) -> Rgba {
///         Rgba { color: [pixel as i32 * (ONE / 255); 3], alpha: ONE }
///     }
/// }
/// ```
pub trait PixelFormat {
    /// What is stored.
    type Pixel: Copy;
    /// The pixel nearest to a colour; what lies outside 0…1 is cut to it, unless the format has room for it.
    fn encode(&self, color: Rgba) -> Self::Pixel;
    /// The colour of a pixel.
    fn decode(&self, pixel: Self::Pixel) -> Rgba;
}

/// [`Rgba`] itself: values above 1 and below 0 stay what they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HeadRoom;

impl PixelFormat for HeadRoom {
    type Pixel = Rgba;
    #[inline(always)]
    fn encode(&self, color: Rgba) -> Rgba {
        color
    }
    #[inline(always)]
    fn decode(&self, pixel: Rgba) -> Rgba {
        pixel
    }
}

/// Opaque.
impl PixelFormat for Rgb565 {
    type Pixel = u16;
    #[inline(always)]
    fn encode(&self, color: Rgba) -> u16 {
        let [red, green, blue] = color.color;
        ((level(red, 31) << 6 | level(green, 63)) << 5 | level(blue, 31)) as u16
    }
    #[inline(always)]
    fn decode(&self, pixel: u16) -> Rgba {
        // v/31 and v/63 rounded down, with what is left of 2^28.
        let five = |v: u32| (v * (ONE as u32 / 31) + v * (ONE as u32 % 31) / 31) as i32;
        let six = |v: u32| (v * (ONE as u32 / 63) + v * (ONE as u32 % 63) / 63) as i32;
        let (red, green, blue) = ((pixel >> 11) as u32, (pixel >> 5 & 63) as u32, (pixel & 31) as u32);
        Rgba {
            color: [five(red), six(green), five(blue)],
            alpha: ONE,
        }
    }
}

impl PixelFormat for Rgba8888 {
    type Pixel = [u8; 4];
    #[inline(always)]
    fn encode(&self, color: Rgba) -> [u8; 4] {
        let [red, green, blue] = color.to_bytes();
        [red, green, blue, level(color.alpha, 255) as u8]
    }
    #[inline(always)]
    fn decode(&self, pixel: [u8; 4]) -> Rgba {
        Rgba::from_texel(Texel(pixel), 0)
    }
}

/// Black and white: the mean of the channels, from ½ on white.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OneBit;

impl PixelFormat for OneBit {
    type Pixel = bool;
    #[inline(always)]
    fn encode(&self, color: Rgba) -> bool {
        let [red, green, blue] = color.color.map(i64::from);
        2 * (red + green + blue) >= 3 * ONE as i64
    }
    #[inline(always)]
    fn decode(&self, pixel: bool) -> Rgba {
        Rgba {
            color: [if pixel { ONE } else { 0 }; 3],
            alpha: ONE,
        }
    }
}

impl Rgba {
    /// Written out: each channel cut to 0…1, times 255, rounded to nearest; alpha is dropped.
    ///
    /// ```
    /// use fixel::blend::{ONE, Rgba};
    /// let bright = Rgba { color: [3 * ONE, ONE / 2, -ONE], alpha: 0 };
    /// assert_eq!(bright.to_bytes(), [255, 128, 0]);
    /// ```
    #[inline]
    pub fn to_bytes(self) -> [u8; 3] {
        self.color.map(|v| level(v, 255) as u8)
    }
}

/// The pixel at (x, y); `None` off the picture.
///
/// ```
/// use fixel::{pipeline::get, target::Buffer};
/// let mut memory = [1, 2, 3, 4];
/// let mut picture = Buffer::new(&mut memory, 2, 2)?;
/// assert_eq!((get(&mut picture, (1, 1)), get(&mut picture, (2, 0))), (Some(4), None));
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn get<C: Target>(target: &mut C, at: (i32, i32)) -> Option<C::Pixel> {
    cell(target, at).copied()
}

/// Sets the pixel that holds the point (x, y), the one at their floors; `false` where that is off the picture.
///
/// ```
/// use fixel::{pipeline::{get, set}, screen::SubPx, target::Buffer};
/// let mut memory = [0; 12 * 4];
/// let mut picture = Buffer::new(&mut memory, 12, 4)?;
/// assert!(set(&mut picture, (SubPx::lit("10.99"), SubPx::lit("3.01")), 7));
/// assert!(!set(&mut picture, (SubPx::lit("-0.5"), SubPx::lit("0")), 7));
/// assert_eq!(get(&mut picture, (10, 3)), Some(7));
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn set<C: Target>(target: &mut C, (x, y): (SubPx, SubPx), pixel: C::Pixel) -> bool {
    match cell(target, (x.to_bits() >> 8, y.to_bits() >> 8)) {
        Some(cell) => {
            *cell = pixel;
            true
        }
        None => false,
    }
}

fn cell<C: Target>(target: &mut C, (x, y): (i32, i32)) -> Option<&mut C::Pixel> {
    let window = target.window();
    if !window.contains((x, y)) {
        return None;
    }
    target.row(y).get_mut(x.wrapping_sub(window.left) as u32 as usize)
}

/// The rows of a picture whose first row is the bottom one, from the top: how pictures are written out.
///
/// ```
/// let bottom_first = [1, 1, 2, 2];
/// let rows: Vec<_> = fixel::pipeline::from_the_top(&bottom_first, 2).collect();
/// assert_eq!(rows, [[2, 2], [1, 1]]);
/// ```
pub fn from_the_top<P>(pixels: &[P], width: usize) -> impl Iterator<Item = &[P]> {
    pixels.chunks(width.max(1)).rev()
}

/// A channel in levels of 0…most, to nearest; most ≤ 255.
#[inline(always)]
fn level(channel: i32, most: u32) -> u32 {
    ((channel.clamp(0, ONE) as u64 * most as u64 + (1 << 27)) >> 28) as u32
}
