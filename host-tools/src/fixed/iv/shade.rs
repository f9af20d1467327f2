//! Fragment programs: flat, Gouraud, Phong.

use std::marker::PhantomData;

use fixel::fragment::Fragment;
use fixel::light::world::{FULL, Material, Specular};
use fixel::num::Block;
use fixel::varying::{Color565, Packed565, Varying};

use super::lamps::Lit;
use crate::fixed::Pixel;
use crate::fixed::shader::Shader;

/// Bits that interpolated colours are finer than the core's results.
pub const FINER: u32 = 2;

/// One colour for the face.
pub struct Flat(Pixel);

impl Flat {
    /// Of a colour in units of 2^-28.
    pub fn new(color: [i32; 3], primitive: u32) -> Self {
        Self(pixel(color, primitive))
    }
}

impl Fragment for Flat {
    type Varying = ();
    type Pixel = Pixel;

    fn shade(&self, (): (), _below: Pixel) -> Option<Pixel> {
        Some(self.0)
    }
}

/// The corners' colours, linear over the screen: [`Linear`](fixel::varying::Linear), or
/// [`Linear32`](fixel::varying::Linear32).
pub struct Gouraud<V> {
    /// Stored with every pixel.
    pub primitive: u32,
    /// How colours are interpolated.
    pub varying: PhantomData<V>,
}

/// What a corner carries of its colour.
pub fn carried(color: [i32; 3]) -> [i32; 3] {
    color.map(|c| c.clamp(0, FULL) << FINER)
}

impl<V: Varying<Values = [i32; 3]>> Fragment for Gouraud<V> {
    type Varying = V;
    type Pixel = Pixel;

    #[inline]
    fn shade(&self, color: [i32; 3], _below: Pixel) -> Option<Pixel> {
        Some(pixel(color.map(|c| c >> FINER), self.primitive))
    }
}

/// The corners' colours, linear over the screen, two channels a word: pixels are RGB565.
pub struct Gouraud565 {
    /// Stored with every pixel.
    pub primitive: u32,
}

impl Gouraud565 {
    /// What a corner carries, of what it would carry else.
    pub fn carried(color: [i32; 3]) -> [i32; 3] {
        let levels = |c: i32, most: i64| ((i64::from(c) * most) >> (28 + FINER - 16)) as i32 + (1 << 15);
        let [red, green, blue] = color;
        [levels(red, 31), levels(green, 63), levels(blue, 31)]
    }
}

impl Fragment for Gouraud565 {
    type Varying = Color565;
    type Pixel = Pixel;

    #[inline]
    fn shade(&self, color: Packed565, _below: Pixel) -> Option<Pixel> {
        Some(Pixel::packed(color.pixel(), self.primitive))
    }
}

/// The lighting function at every pixel.
pub struct Phong<'a, S> {
    /// The lights at the places' scale.
    pub lit: &'a Lit,
    /// The object's.
    pub material: &'a Material<S>,
    /// Stored with every pixel.
    pub primitive: u32,
}

impl<S> Phong<'_, S> {
    /// What a corner carries: its place in units of 2^`exponent`, and its normal.
    pub fn carried(place: Block<i64, 3>, exponent: i32, [nx, ny, nz]: [i32; 3]) -> [i32; 6] {
        let fixed = place.scaled(exponent.saturating_neg()).split();
        let [x, y, z] = fixed.map(|c| {
            let halves = c.scaled(1).to_fixed(0);
            ((halves >> 1) + (halves & 1)) as i32
        });
        [x, y, z, nx, ny, nz]
    }
}

impl<S: Specular> Shader<6> for Phong<'_, S> {
    #[inline]
    fn shaded(&self, [x, y, z, nx, ny, nz]: [i32; 6]) -> Pixel {
        let color = self.lit.shade([nx, ny, nz], [x, y, z], self.material);
        pixel(color, self.primitive)
    }
}

/// A pixel of a colour in units of 2^-28: rounded to 2^-16 of a level, so that a byte's own value comes out as that byte, and cut
/// off.
pub fn pixel(color: [i32; 3], primitive: u32) -> Pixel {
    let [r, g, b] = color.map(|c| {
        let levels = (i64::from(c.clamp(0, FULL)) * 255 + (1 << 11)) >> 12;
        (levels >> 16) as u8
    });
    Pixel {
        rgba: [r, g, b, 255],
        primitive,
    }
}
