//! Workloads as bytes: integers only, so that an image needs neither a parser nor floating point.
//!
//! ```text
//! file     = { section }
//! section  = name: 16 bytes, padded with 0 · corners: u32 · { corner }
//! corner   = x: i32 · y: i32 (2^-8 px) · depth: u32 (2^-15 step) · red, green, blue: u8 · 0
//! ```
//!
//! All little-endian; every three corners are a triangle.

use fixel::fragment::Gouraud565;
use fixel::screen::{Corner, FineDepth, Position, SubPx};
use fixel::varying::Linear;

/// Bytes of a section's name.
pub const NAME_BYTES: usize = 16;
/// Bytes of a corner.
pub const CORNER_BYTES: usize = 16;

/// A corner as it is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Vertex {
    /// To the right, in 2^-8 px; samples lie at whole pixels.
    pub x: i32,
    /// Downwards, in 2^-8 px.
    pub y: i32,
    /// In 2^-15 of a step of the depth buffer.
    pub depth: u32,
    /// Red, green, blue.
    pub color: [u8; 3],
}

impl Vertex {
    /// From the bytes of a corner.
    fn from_bytes(bytes: &[u8; CORNER_BYTES]) -> Self {
        let [x0, x1, x2, x3, y0, y1, y2, y3, d0, d1, d2, d3, red, green, blue, _] = *bytes;
        Vertex {
            x: i32::from_le_bytes([x0, x1, x2, x3]),
            y: i32::from_le_bytes([y0, y1, y2, y3]),
            depth: u32::from_le_bytes([d0, d1, d2, d3]),
            color: [red, green, blue],
        }
    }

    /// The bytes of the corner.
    pub fn to_bytes(self) -> [u8; CORNER_BYTES] {
        let ([x0, x1, x2, x3], [y0, y1, y2, y3]) = (self.x.to_le_bytes(), self.y.to_le_bytes());
        let ([d0, d1, d2, d3], [red, green, blue]) = (self.depth.to_le_bytes(), self.color);
        [x0, x1, x2, x3, y0, y1, y2, y3, d0, d1, d2, d3, red, green, blue, 0]
    }

    fn with<V>(self, varying: V) -> Corner<V> {
        Corner {
            position: Position::nearest(SubPx::from_bits(self.x), SubPx::from_bits(self.y)),
            depth: FineDepth::from_bits(self.depth),
            varying,
        }
    }

    /// For the core, without colour.
    pub fn flat(self) -> Corner<()> {
        self.with(())
    }

    /// For the core, with its colour.
    pub fn gouraud(self) -> Corner<Linear<3>> {
        let [red, green, blue] = self.color;
        self.with(Gouraud565::corner(red, green, blue))
    }

    /// The colour in RGB565, rounded to nearest.
    pub fn rgb565(self) -> u16 {
        let [red, green, blue] = self.color.map(u16::from);
        let scale = |v: u16, most: u16| (v * most + 127) / 255;
        scale(red, 31) << 11 | scale(green, 63) << 5 | scale(blue, 31)
    }
}

/// The triangles of section `name`; `None` where there is no such section.
pub fn triangles<'a>(mut file: &'a [u8], name: &str) -> Option<impl Iterator<Item = [Vertex; 3]> + use<'a>> {
    loop {
        let (title, rest) = file.split_first_chunk::<NAME_BYTES>()?;
        let (count, rest) = rest.split_first_chunk::<4>()?;
        let (corners, rest) = rest.split_at_checked(u32::from_le_bytes(*count) as usize * CORNER_BYTES)?;
        if title.starts_with(name.as_bytes()) && title.get(name.len()).is_none_or(|&next| next == 0) {
            let (corners, _) = corners.as_chunks::<CORNER_BYTES>();
            let (triangles, _) = corners.as_chunks::<3>();
            return Some(triangles.iter().map(|t| t.each_ref().map(Vertex::from_bytes)));
        }
        file = rest;
    }
}
