//! Numbers of an MP1 scene as the core takes them.

use fixel::blend::ONE;
use fixel::num::Scaled;
use fixel::screen::SubPx;
use fixel::srgb;

use crate::fixed::dials::Dials;
use crate::lower;
use crate::scene::mp1::{Scene, Shape, Vertex};

/// The unit of a scene's colours: 2^(shift − 28) of full, so large that none of them leaves the 2^30 of a varying.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Units {
    /// How far the unit is from 2^-28.
    pub shift: u32,
    /// Whether colours are decoded and encoded.
    pub srgb: bool,
}

/// Vertices' colours may be this many times full.
const BRIGHTEST: f64 = 128.0;

impl Units {
    /// For all vertices of a scene.
    ///
    /// # Errors
    /// At the first primitive with a colour of 128 times full or more.
    pub fn of(scene: &Scene) -> Result<Self, crate::scene::Fault> {
        Self::with(scene, Dials::default())
    }

    /// The same with the dials set so.
    ///
    /// # Errors
    /// As [`of`](Self::of).
    pub fn with(scene: &Scene, dials: Dials) -> Result<Self, crate::scene::Fault> {
        let mut units = Self {
            shift: 0,
            srgb: scene.switches.srgb && !dials.stored_light,
        };
        for primitive in &scene.primitives {
            for vertex in vertices(&primitive.shape) {
                if let Some(rgb) = vertex.rgb.into_iter().find(|c| c.abs() >= 255.0 * BRIGHTEST) {
                    let message = format!("a colour of {rgb}: the core takes colours of less than 128 times 255");
                    return Err(crate::scene::Fault::new(primitive.place, message));
                }
                for linear in vertex.rgb.map(|c| units.linear(c)) {
                    let bits = i64::BITS - linear.unsigned_abs().leading_zeros();
                    units.shift = units.shift.max(bits.saturating_sub(30));
                }
            }
        }
        Ok(units)
    }

    /// A vertex' colour and alpha.
    pub fn channels(&self, vertex: &Vertex) -> [i32; 4] {
        let [r, g, b] = vertex.rgb.map(|c| {
            let half = (1 << self.shift) >> 1;
            ((self.linear(c) + half) >> self.shift) as i32
        });
        let alpha = (vertex.alpha * f64::from(ONE)).round() as i32;
        [r, g, b, alpha]
    }

    /// In units of 2^-28 of full.
    fn linear(&self, channel: f64) -> i64 {
        if self.srgb {
            let encoded = (channel / 255.0 * f64::from(1 << 24)).round();
            srgb::decode_wide(encoded as i32)
        } else {
            (channel / 255.0 * f64::from(ONE)).round() as i64
        }
    }

    /// A linear channel as a byte: encoded if need be, rounded to 2^-16 of a level, and cut off.
    pub fn byte(&self, channel: i32) -> u8 {
        let full = (i64::from(channel) << self.shift).clamp(0, i64::from(ONE)) as i32;
        if self.srgb {
            (srgb::encode(full) >> 16) as u8
        } else {
            byte(full)
        }
    }
}

/// A channel of 0…1 in units of 2^-28 as a byte: 255 times as much, rounded to 2^-16 of a level, so that a byte's own value comes
/// out as that byte, and cut off.
pub fn byte(channel: i32) -> u8 {
    let levels = (i64::from(channel) * 255 + (1 << 11)) >> 12;
    (levels >> 16) as u8
}

fn vertices(shape: &Shape) -> &[Vertex] {
    match shape {
        Shape::Triangle(vertices) | Shape::Textured(vertices, _) => vertices,
        Shape::Line(vertices) | Shape::WuLine(vertices) => vertices,
        Shape::Point(_, vertex) | Shape::Billboard(_, vertex, _) | Shape::Circle(_, vertex) => {
            std::slice::from_ref(vertex)
        }
    }
}

/// A size in samples.
///
/// # Errors
/// Beyond 2^22 samples, the largest of the core's squares and discs.
pub fn size(pixels: f64, fsaa: u32) -> Result<SubPx, String> {
    let samples = pixels * f64::from(fsaa);
    if samples > f64::from(1 << 22) {
        return Err(format!("a size of {samples} samples: the core draws up to 4194304"));
    }
    Ok(SubPx::from_bits((samples * 256.0).round() as i32))
}

/// A vertex' texture coordinate.
pub fn texcoord(vertex: &Vertex) -> [Scaled<i64>; 2] {
    vertex.texcoord.map(|c| lower::block([c]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_out_as_it_went_in() {
        for srgb in [false, true] {
            let units = Units { shift: 0, srgb };
            for level in 0..=255u8 {
                let vertex = Vertex {
                    position: [0.0; 4],
                    rgb: [f64::from(level); 3],
                    alpha: f64::from(level) / 255.0,
                    texcoord: [0.0; 2],
                };
                let [r, .., alpha] = units.channels(&vertex);
                assert_eq!((units.byte(r), byte(alpha)), (level, level), "sRGB: {srgb}");
            }
        }
    }
}
