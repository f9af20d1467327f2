//! Fragment programs, put together from parts: a surface, where its normal comes from, whether it knows its place, and how
//! it shines. A program carries the values of its parts and nothing else: the surface's first, then normal and place.

use fixel::light::Finish;
use fixel::num::{Precision, power};
use fixel::texture::Floor;

use super::lamps::Lit;
use crate::fixed::shader::Shader;
use crate::fixed::{Pixel, sampling};
use crate::lower;

/// Values that are still to be taken.
type Rest<'v> = &'v [i32];

/// Texels as HW2 rounds.
pub type Sampler<'t> = sampling::Sampler<'t, Floor>;

/// What gives a surface its colour before light.
pub trait Surface {
    /// The colour, and the values that belong to others.
    fn color<'v>(&self, values: Rest<'v>) -> ([i32; 3], Rest<'v>);
}

/// One colour.
pub struct Plain(pub [i32; 3]);

/// The vertices' colours.
pub struct Gouraud;

/// A texture's colours, in units of 2^-16 levels.
pub struct Textured<'t>(pub Sampler<'t>);

/// A texture over the vertices' colours, which are in units of 2^(shift − 16) levels.
pub struct Decal<'t> {
    /// The texture.
    pub sampler: Sampler<'t>,
    /// 0 or more.
    pub shift: u32,
}

impl Surface for Plain {
    #[inline(always)]
    fn color<'v>(&self, values: Rest<'v>) -> ([i32; 3], Rest<'v>) {
        (self.0, values)
    }
}

impl Surface for Gouraud {
    #[inline(always)]
    fn color<'v>(&self, values: Rest<'v>) -> ([i32; 3], Rest<'v>) {
        take(values)
    }
}

impl Surface for Textured<'_> {
    #[inline(always)]
    fn color<'v>(&self, values: Rest<'v>) -> ([i32; 3], Rest<'v>) {
        let (st, rest) = take(values);
        (self.0.texel(st).channels(0), rest)
    }
}

impl Surface for Decal<'_> {
    #[inline(always)]
    fn color<'v>(&self, values: Rest<'v>) -> ([i32; 3], Rest<'v>) {
        let (color, rest) = take(values);
        let (st, rest) = take(rest);
        (self.sampler.texel(st).over(color, self.shift), rest)
    }
}

/// Where a fragment's vector comes from: its normal, its place.
pub trait Vector {
    /// The vector, and the values that belong to others.
    fn vector<'v>(&self, values: Rest<'v>) -> ([i32; 3], Rest<'v>);
}

/// The same for the whole triangle.
pub struct Same(pub [i32; 3]);

/// The vertices', interpolated.
pub struct Interpolated;

impl Vector for Same {
    #[inline(always)]
    fn vector<'v>(&self, values: Rest<'v>) -> ([i32; 3], Rest<'v>) {
        (self.0, values)
    }
}

impl Vector for Interpolated {
    #[inline(always)]
    fn vector<'v>(&self, values: Rest<'v>) -> ([i32; 3], Rest<'v>) {
        take(values)
    }
}

/// The first N values and the rest.
#[inline(always)]
fn take<const N: usize>(values: Rest<'_>) -> ([i32; N], Rest<'_>) {
    let (taken, rest) = values.split_first_chunk().unwrap_or((&[0; N], &[]));
    (*taken, rest)
}

/// A surface in its own colours, in units of 2^(shift − 16) levels.
pub struct Unlit<S> {
    /// The surface.
    pub surface: S,
    /// Of the colours' unit.
    pub shift: i32,
    /// Stored with every pixel.
    pub primitive: u32,
}

impl<S: Surface, const K: usize> Shader<K> for Unlit<S> {
    #[inline]
    fn shaded(&self, values: [i32; K]) -> Pixel {
        let (color, _) = self.surface.color(&values);
        pixel(color.map(i64::from), self.shift, self.primitive)
    }
}

/// A surface in light that was computed at the corners: the surface's values first, then the light's, where 2^16 is full.
pub struct InGivenLight<S> {
    /// The surface.
    pub surface: S,
    /// What is lit is in units of 2^(shift − 16) levels.
    pub shift: i32,
    /// Stored with every pixel.
    pub primitive: u32,
}

impl<S: Surface, const K: usize> Shader<K> for InGivenLight<S> {
    #[inline]
    fn shaded(&self, values: [i32; K]) -> Pixel {
        let (color, rest) = self.surface.color(&values);
        let (light, _) = take::<3>(rest);
        let mut lit = [0; 3];
        for ((lit, color), light) in lit.iter_mut().zip(color).zip(light) {
            *lit = (i64::from(color) * i64::from(light)) >> 16;
        }
        pixel(lit, self.shift, self.primitive)
    }
}

/// A surface under lights, with normals from `N` and places from `P`.
pub struct UnderLight<'a, S, N, P> {
    /// The surface.
    pub surface: S,
    /// Where normals come from.
    pub normal: N,
    /// Where places come from.
    pub place: P,
    /// How it shines, if it does.
    pub polish: Option<Polished>,
    /// The lights at the places' scale.
    pub lit: &'a Lit<'a>,
    /// What is lit is in units of 2^(shift − 16) levels.
    pub shift: i32,
    /// Stored with every pixel.
    pub primitive: u32,
}

impl<S: Surface, N: Vector, P: Vector, const K: usize> Shader<K> for UnderLight<'_, S, N, P> {
    #[inline]
    fn shaded(&self, values: [i32; K]) -> Pixel {
        let (color, rest) = self.surface.color(&values);
        let (normal, rest) = self.normal.vector(rest);
        let (place, _) = self.place.vector(rest);
        let lit = self.lit.shade(normal, place, color, self.polish.as_ref());
        pixel(lit, self.shift, self.primitive)
    }
}

/// Blinn-Phong on surfaces whose colours are in other units than 2^-16 of full.
pub struct Polished {
    /// In units of 2^-16.
    pub exponent: u32,
    /// See [`Finish::highlight`].
    pub highlight: i32,
}

impl Polished {
    /// With an exponent in units of 2^-16, on surface colours in units of 2^(shift − 16) levels.
    pub fn new(exponent: u32, shift: i32) -> Self {
        // From lower::LIT on, so at most 255·2^22; from 2^24 levels on a highlight is nothing.
        let down = (shift - lower::LIT).clamp(0, 31);
        Polished {
            exponent,
            highlight: (255 << (16 - lower::LIT)) >> down,
        }
    }

    /// On white, where 2^16 is full.
    pub fn white(exponent: u32) -> Self {
        Polished {
            exponent,
            highlight: 1 << 16,
        }
    }
}

impl Finish for Polished {
    const SHINES: bool = true;
    #[inline]
    fn strength(&self, cosine: i32) -> i32 {
        power(cosine, self.exponent)
    }
    #[inline]
    fn strength_at<P: Precision>(&self, cosine: i32) -> i32 {
        P::power(cosine, self.exponent)
    }
    #[inline(always)]
    fn highlight(&self) -> i32 {
        self.highlight
    }
}

/// A pixel from channels in units of 2^(shift − 16) levels.
#[inline]
pub fn pixel(channels: [i64; 3], shift: i32, primitive: u32) -> Pixel {
    let [red, green, blue] = channels.map(|v| lower::byte(v, shift));
    Pixel {
        rgba: [red, green, blue, 255],
        primitive,
    }
}
