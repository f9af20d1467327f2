//! The float64 reference: draws a scene in exactly the evaluation order of its format, so that it reproduces the official
//! pictures byte for byte, and logs what the comparison needs. It shares no arithmetic with the core.

pub mod attributes;
pub mod bound;
pub mod clip;
pub mod hw2;
pub mod iv;
pub mod log;
pub mod material;
pub mod matrix;
pub mod mp1;
pub mod pipeline;
pub mod raster;

use log::Polygon;

/// One pixel of the reference, unrounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pixel {
    /// Red, green, blue, alpha; not clamped, 1 is full; alpha is 0 where nothing was drawn and 1 elsewhere.
    pub color: [f64; 4],
    /// z/w of the winner, of HW2 scenes from 0 to 1, of Inventor scenes from -1; 1 where nothing was drawn.
    pub depth: f64,
    /// The primitive that won the pixel, from 1; 0 is the background.
    pub primitive: u32,
}

/// The reference's picture and its log; `M` is what primitives are painted with.
#[derive(Debug, Clone)]
pub struct Rendered<M> {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width * height` pixels, row by row from the top.
    pub pixels: Vec<Pixel>,
    /// Which z/w are drawn; the core's 65535 steps of depth span them.
    pub depth_range: [f64; 2],
    /// Every primitive's polygons, in drawing order.
    pub polygons: Vec<Polygon<M>>,
}

impl<M> Rendered<M> {
    /// The picture in bytes, RGBA: floor(255 v), clamped to 0…255.
    pub fn bytes(&self) -> Vec<[u8; 4]> {
        (self.pixels.iter()).map(|pixel| pixel.color.map(byte)).collect()
    }
}

/// floor(255 v) clamped to 0…255 (formats/hw2.md section 9): cut off, not rounded. What is not a number counts as 0.
pub fn byte(v: f64) -> u8 {
    (255.0 * v).floor() as u8
}
