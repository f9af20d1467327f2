//! Colours with alpha, and *over*: what a translucent surface leaves of the one below it.
//!
//! Colours are straight, not premultiplied: the colour of a pixel that is hardly covered is as exact as that of an opaque
//! one, and an edge blended over nothing keeps its colour instead of darkening. A target of [`Rgba`] pixels starts as
//! [`Rgba::default`], transparent black; [`over565`] and [`over888`] blend onto an opaque frame buffer as it is.
//!
//! No division: [`reciprocal`] of the alpha that comes out.
//!
//! A fragment program that blends, with colour and alpha interpolated:
//!
//! ```
//! use fixel::blend::{ONE, Rgba};
//! use fixel::{depth::NoDepth, draw, fragment::Fragment, screen::{Corner, FineDepth, Position}, target::Buffer};
//! use fixel::varying::Linear;
//!
//! struct Blended;
//!
//! impl Fragment for Blended {
//!     type Varying = Linear<4>;
//!     type Pixel = Rgba;
//!     fn shade(&self, [red, green, blue, alpha]: [i32; 4], below: Rgba) -> Option<Rgba> {
//!         Some(Rgba { color: [red, green, blue], alpha }.over(below))
//!     }
//! }
//!
//! let mut picture = [Rgba::default(); 4 * 4];
//! for color in [[ONE, 0, 0, ONE], [0, 0, ONE, ONE / 2]] {
//!     let corners = [(0, 0), (0, 4), (4, 0)].map(|(x, y)| Corner {
//!         position: Position::from_pixels(x, y),
//!         depth: FineDepth::ZERO,
//!         varying: Linear(color),
//!     });
//!     draw::triangle(&mut Buffer::new(&mut picture, 4, 4)?, &mut NoDepth, corners, &Blended);
//! }
//! assert_eq!(picture[0], Rgba { color: [ONE / 2, 0, ONE / 2], alpha: ONE });
//! assert_eq!(picture[15], Rgba::default());
//! # Ok::<(), fixel::error::Error>(())
//! ```

use crate::num::reciprocal;
use crate::texture::Texel;

mod equation;

pub use equation::{Blend, Blending, Equation, Factor, Replace, Translucent};

/// 1 in the units of [`Rgba`]: full brightness, and opaque.
pub const ONE: i32 = 1 << 28;

/// A colour and its alpha, which is not multiplied in. The default, transparent black, is an empty pixel.
///
/// ```
/// use fixel::blend::{ONE, Rgba};
/// let glass = Rgba { color: [0, ONE, 0], alpha: ONE / 4 };
/// let wall = Rgba { color: [ONE, ONE, 0], alpha: ONE };
/// assert_eq!(glass.over(wall), Rgba { color: [ONE / 4 * 3, ONE, 0], alpha: ONE });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rgba {
    /// Red, green and blue in units of 2^-28 of full: any `i32`, so that ±8 times full fit. [`over`](Self::over) does not
    /// look at the unit; brighter scenes may choose a larger one.
    pub color: [i32; 3],
    /// In units of 2^-28, 0…[`ONE`]; what lies outside is taken as the nearer end.
    pub alpha: i32,
}

impl Rgba {
    /// This over `below`: α = αt + αb·(1 − αt), and color = (ct·αt + cb·αb·(1 − αt))/α, or 0 where α = 0.
    ///
    /// Over an empty pixel it is this colour exactly, opaque it is this exactly; with alpha 0 it is `below` exactly.
    /// Every channel lies between the two.
    ///
    /// **Error**: alpha is the nearest to the true one. A channel is within ½ + d·2^-29 units for a distance of d units
    /// between the two colours: 1 unit where both are in 0…1 (`tests/blending.rs`).
    ///
    /// ```
    /// use fixel::blend::{ONE, Rgba};
    /// let white = Rgba { color: [ONE; 3], alpha: ONE / 2 };
    /// let black = Rgba { color: [0; 3], alpha: ONE / 2 };
    /// // The upper one has twice the weight of the lower one.
    /// let both = white.over(black);
    /// assert_eq!(both.alpha, ONE / 4 * 3);
    /// assert!(both.color[0].abs_diff(ONE / 3 * 2) <= 1);
    /// // No dark fringe.
    /// assert_eq!(white.over(Rgba::default()), white);
    /// ```
    #[inline]
    pub fn over(self, below: Rgba) -> Rgba {
        let (top, bottom) = (within(self.alpha), within(below.alpha));
        if top == 0 {
            let color = if bottom == 0 { [0; 3] } else { below.color };
            return Rgba {
                color,
                alpha: bottom as i32,
            };
        }
        // In units of 2^-56. The sum is at most 2^56, and at least 2^28 since top is not 0.
        let lower = bottom * (ONE as u64 - top);
        let alpha = (top << 28) + lower;
        let weight = share(lower, alpha);
        let mut lower_color = below.color.into_iter();
        // |distance| < 2^32 and weight ≤ 2^31: below 2^63 − 2^30. The result lies between the two, so in an i32.
        let color = self.color.map(|c| {
            let distance = lower_color.next().unwrap_or(0) as i64 - c as i64;
            (c as i64 + ((distance * weight as i64 + (1 << 30)) >> 31)) as i32
        });
        Rgba {
            color,
            alpha: ((alpha + (1 << 27)) >> 28) as i32,
        }
    }

    /// The same colour with alpha·`part`, rounded to nearest; `part` in units of 2^-28, and as alpha taken as the nearer
    /// end where it lies outside 0…[`ONE`].
    ///
    /// ```
    /// use fixel::blend::{ONE, Rgba};
    /// let ghost = Rgba { color: [ONE; 3], alpha: ONE / 2 };
    /// assert_eq!(ghost.faded(ONE / 2), Rgba { color: [ONE; 3], alpha: ONE / 4 });
    /// ```
    #[inline]
    pub fn faded(self, part: i32) -> Rgba {
        Rgba {
            alpha: ((within(self.alpha) * within(part) + (1 << 27)) >> 28) as i32,
            ..self
        }
    }

    /// A texel: channels in units of 2^(shift−28) of full and alpha in units of 2^-28, all rounded to nearest. `shift` is
    /// 0 unless the scene's unit is larger, at most 30.
    ///
    /// ```
    /// use fixel::blend::{ONE, Rgba};
    /// use fixel::texture::Texel;
    /// let texel = Rgba::from_texel(Texel([255, 51, 0, 255]), 0);
    /// assert_eq!(texel, Rgba { color: [ONE, (ONE + 2) / 5, 0], alpha: ONE });
    /// assert_eq!(Rgba::from_texel(Texel([255, 51, 0, 255]), 4).color, [ONE >> 4, 3355443, 0]);
    /// ```
    #[inline]
    pub fn from_texel(texel: Texel, shift: u32) -> Rgba {
        let shift = shift.min(30);
        let Texel([red, green, blue, alpha]) = texel;
        Rgba {
            color: [red, green, blue].map(|v| fraction(v, shift)),
            alpha: fraction(alpha, 0),
        }
    }
}

/// `top` over an opaque RGB565 pixel: each channel (31·color or 63·color, as 2^-28 of full) rounded to the nearest level
/// and cut to those there are.
///
/// **Error**: ½ + 2^-40 levels for any colour; `below` exactly where alpha is 0.
///
/// ```
/// use fixel::blend::{ONE, Rgba, over565};
/// let red = Rgba { color: [ONE, 0, 0], alpha: ONE / 2 };
/// assert_eq!(over565(red, 0x07e0), 16 << 11 | 32 << 5); // 15.5, 31.5
/// assert_eq!(over565(red.faded(0), 0x07e0), 0x07e0);
/// ```
#[inline]
pub fn over565(top: Rgba, below: u16) -> u16 {
    let [red, green, blue] = top.color;
    let upper = within(top.alpha);
    let red = level(red, upper, (below >> 11) as u32, 31);
    let green = level(green, upper, (below >> 5 & 63) as u32, 63);
    let blue = level(blue, upper, (below & 31) as u32, 31);
    ((red << 6 | green) << 5 | blue) as u16
}

/// `top` over an opaque pixel of red, green and blue bytes: each channel (255·color, as 2^-28 of full) rounded to the
/// nearest level and cut to 0…255.
///
/// **Error**: ½ + 2^-40 levels for any colour; `below` exactly where alpha is 0.
///
/// ```
/// use fixel::blend::{ONE, Rgba, over888};
/// let sun = Rgba { color: [8 * (ONE - 1), ONE, 0], alpha: ONE / 4 };
/// assert_eq!(over888(sun, [0, 100, 200]), [255, 139, 150]); // 510, 138.75, 150
/// ```
#[inline]
pub fn over888(top: Rgba, below: [u8; 3]) -> [u8; 3] {
    let upper = within(top.alpha);
    let mut color = top.color.into_iter();
    below.map(|v| level(color.next().unwrap_or(0), upper, v as u32, 255) as u8)
}

/// An alpha in 0…2^28.
#[inline(always)]
fn within(alpha: i32) -> u64 {
    alpha.clamp(0, ONE) as u64
}

/// `part`/`whole` in units of 2^-31, in 0…2^31, for part ≤ whole < 2^57 and whole not 0.
///
/// Cutting both to 32 bits moves it by less than 2^-31 down and up, the reciprocal's floor by 2^-31 down, the rounding
/// by 2^-32: in all −2.5·2^-31…1.5·2^-31.
#[inline(always)]
fn share(part: u64, whole: u64) -> u64 {
    let shift = whole.leading_zeros();
    let divisor = ((whole << shift) >> 32) as u32;
    // At most `divisor`, so that the product is at most 2^63.
    let part = (part << shift) >> 32;
    (part * reciprocal(divisor) + (1 << 31)) >> 32
}

/// v/255 in units of 2^(shift−28), rounded to nearest, `shift` ≤ 30.
#[inline(always)]
fn fraction(v: u8, shift: u32) -> i32 {
    // v·(2^56 − 1)/255 is the floor of v·2^56/255 for all v but 255, and none of those lies on a half.
    let fine = v as u64 * 0x01_0101_0101_0101 + (v == 255) as u64;
    ((fine + (1 << (27 + shift))) >> (28 + shift)) as i32
}

/// color·upper + below/most·(1 − upper) in levels of 0…most, rounded to nearest; below ≤ most ≤ 255.
#[inline(always)]
fn level(color: i32, upper: u64, below: u32, most: u32) -> u32 {
    // In units of 2^-56: beyond ±1 the other term, in 0…1, cannot bring the sum back between the ends. In units of 2^-48
    // it is multiplied: below 2^57 with the sum.
    let product = (color as i64 * upper as i64).clamp(-1 << 56, 1 << 56) >> 8;
    let lower = ((below as u64) << 20) * (ONE as u64 - upper);
    let level = (product * most as i64 + lower as i64 + (1 << 47)) >> 48;
    level.max(0).min(most as i64) as u32
}
