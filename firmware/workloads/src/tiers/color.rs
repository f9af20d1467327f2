//! What becomes of a colour: an RGB565 pixel, which is counted, or what it was before it was rounded, which tells the error.

use fixel::fragment::Fragment;
use fixel::texture::TiledBilinear565;
use fixel::varying::{Color565, Linear, Packed565, Varying};
use fixel::view::Carried;

/// Red, green and blue in units of 2^-16 of 0…31, 0…63 and 0…31, each with the half that makes cutting off round.
pub type Levels = [i32; 3];

/// The largest value of each channel.
pub const MOST: [i32; 3] = [31, 63, 31];

/// A varying that is a colour.
pub trait Color: Carried<Vertex = Levels> {
    /// At one pixel.
    fn levels(values: <Self as Varying>::Values) -> Levels;
    /// As RGB565.
    fn pixel(values: <Self as Varying>::Values) -> u16;
}

impl Color for Linear<3> {
    #[inline(always)]
    fn levels(values: Levels) -> Levels {
        values
    }
    #[inline(always)]
    fn pixel(values: Levels) -> u16 {
        u16::of(values)
    }
}

impl Color for Color565 {
    #[inline(always)]
    fn levels(values: Packed565) -> Levels {
        values.levels()
    }
    #[inline(always)]
    fn pixel(values: Packed565) -> u16 {
        values.pixel()
    }
}

/// A kind of pixel.
pub trait Output: Copy + PartialEq + 'static {
    /// Nothing drawn.
    const EMPTY: Self;
    /// Of a colour.
    fn of(levels: Levels) -> Self;
    /// Of an interpolated colour.
    fn interpolated<C: Color>(values: C::Values) -> Self;
    /// Of a texel.
    fn texel(stored: u16) -> Self;
    /// Of the texels around a place.
    fn filtered<V, const N: usize>(texels: &TiledBilinear565<'_, V, N, N>, place: [i32; 2]) -> Self
    where
        V: Varying<Values = [i32; 2]>;
    /// White for black, and black for white.
    fn inverted(self) -> Self;
}

/// Black, which unlike [`Output::EMPTY`] has been drawn.
pub const BLACK: Levels = [0x8000; 3];

/// RGB565: what a firmware shows.
impl Output for u16 {
    const EMPTY: u16 = 0;

    #[inline(always)]
    fn of([red, green, blue]: Levels) -> u16 {
        ((red >> 16) << 11 | (green >> 16) << 5 | blue >> 16) as u16
    }
    #[inline(always)]
    fn interpolated<C: Color>(values: C::Values) -> u16 {
        C::pixel(values)
    }
    #[inline(always)]
    fn texel(stored: u16) -> u16 {
        stored
    }
    #[inline(always)]
    fn filtered<V, const N: usize>(texels: &TiledBilinear565<'_, V, N, N>, place: [i32; 2]) -> u16
    where
        V: Varying<Values = [i32; 2]>,
    {
        // Always a colour.
        texels.shade(place, 0).unwrap_or(0)
    }
    #[inline(always)]
    fn inverted(self) -> u16 {
        !self
    }
}

/// Red, green and blue in units of 2^-16 level of 0…255: the same colour before it is rounded to RGB565, which would hide what
/// the tiers differ in. May lie outside 0…255 by what a tier's error makes of black and white.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fine(pub [i32; 3]);

impl Output for Fine {
    const EMPTY: Fine = Fine([i32::MIN; 3]);

    fn of(levels: Levels) -> Fine {
        let mut fine = [0; 3];
        for ((fine, level), most) in fine.iter_mut().zip(levels).zip(MOST) {
            // Below 2^31 · 255, of which at least a 31st is left: levels are below 2^22.
            *fine = ((level as i64 - 0x8000) * 255).checked_div(most.into()).unwrap_or(0) as i32;
        }
        Fine(fine)
    }
    fn interpolated<C: Color>(values: C::Values) -> Fine {
        Self::of(C::levels(values))
    }
    fn texel(stored: u16) -> Fine {
        let channels = [stored >> 11, stored >> 5 & 63, stored & 31];
        Self::of(channels.map(|v| ((v as i32) << 16) + 0x8000))
    }
    fn filtered<V, const N: usize>(texels: &TiledBilinear565<'_, V, N, N>, place: [i32; 2]) -> Fine
    where
        V: Varying<Values = [i32; 2]>,
    {
        Self::of(texels.levels(place).map(|level| level + 0x8000))
    }
    fn inverted(self) -> Fine {
        let Fine(channels) = self;
        Fine(channels.map(|c| (255 << 16) - c))
    }
}
