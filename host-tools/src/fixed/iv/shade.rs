//! Fragment programs: flat, Gouraud, Phong.

use fixel::fragment::Fragment;
use fixel::light::world::{FULL, Material, PointLit, Specular};
use fixel::num::Block;
use fixel::varying::Linear;

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

/// The corners' colours, linear over the screen.
pub struct Gouraud {
    /// Stored with every pixel.
    pub primitive: u32,
}

impl Gouraud {
    /// What a corner carries of its colour.
    pub fn carried(color: [i32; 3]) -> [i32; 3] {
        color.map(|c| c.clamp(0, FULL) << FINER)
    }
}

impl Fragment for Gouraud {
    type Varying = Linear<3>;
    type Pixel = Pixel;

    #[inline]
    fn shade(&self, color: [i32; 3], _below: Pixel) -> Option<Pixel> {
        Some(pixel(color.map(|c| c >> FINER), self.primitive))
    }
}

/// The lighting function at every pixel.
pub struct Phong<'a, S, const N: usize> {
    /// The lights at the places' scale.
    pub lit: &'a PointLit<N>,
    /// The object's.
    pub material: &'a Material<S>,
    /// Stored with every pixel.
    pub primitive: u32,
}

impl<S, const N: usize> Phong<'_, S, N> {
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

impl<S: Specular, const N: usize> Shader<6> for Phong<'_, S, N> {
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
