//! Workloads as bytes: integers only, so that an image needs neither a parser nor floating point.
//!
//! ```text
//! file     = { section }
//! section  = name: 16 bytes, padded with 0 · corners: u32 · { corner }
//! corner   = x: i32 · y: i32 (2^-8 px) · depth: u32 (2^-15 step) · red, green, blue: u8 · 0
//!            · 1/w: i32 (2^-30, 1 the triangle's largest) · u: i32 · v: i32 (2^-16 texel)
//! ```
//!
//! All little-endian; every three corners are a triangle.

use fixel::fragment::Gouraud565;
use fixel::screen::{Corner, FineDepth, Position, SubPx};
use fixel::varying::{Color565, Perspective, Perspective32};

use crate::draw::HalfTexel;

/// Bytes of a section's name.
pub const NAME_BYTES: usize = 16;
/// Bytes of a corner.
pub const CORNER_BYTES: usize = 28;

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
    /// 1/w in 2^-30, the triangle's largest being 1.
    pub inverse_w: i32,
    /// Texture coordinates in 2^-16 texel.
    pub texel: [i32; 2],
}

impl Vertex {
    /// From the bytes of a corner.
    fn from_bytes(bytes: &[u8; CORNER_BYTES]) -> Self {
        let (words, _) = bytes.as_chunks::<4>();
        let word = |index: usize| words.get(index).copied().unwrap_or_default();
        let [red, green, blue, _] = word(3);
        Vertex {
            x: i32::from_le_bytes(word(0)),
            y: i32::from_le_bytes(word(1)),
            depth: u32::from_le_bytes(word(2)),
            color: [red, green, blue],
            inverse_w: i32::from_le_bytes(word(4)),
            texel: [i32::from_le_bytes(word(5)), i32::from_le_bytes(word(6))],
        }
    }

    /// The bytes of the corner.
    pub fn to_bytes(self) -> [u8; CORNER_BYTES] {
        let ([red, green, blue], [u, v]) = (self.color, self.texel);
        let words = [
            self.x.to_le_bytes(),
            self.y.to_le_bytes(),
            self.depth.to_le_bytes(),
            [red, green, blue, 0],
            self.inverse_w.to_le_bytes(),
            u.to_le_bytes(),
            v.to_le_bytes(),
        ];
        let mut bytes = [0; CORNER_BYTES];
        let (chunks, _) = bytes.as_chunks_mut::<4>();
        for (chunk, word) in chunks.iter_mut().zip(words) {
            *chunk = word;
        }
        bytes
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
    pub fn gouraud(self) -> Corner<Color565> {
        let [red, green, blue] = self.color;
        self.with(Gouraud565::corner(red, green, blue))
    }

    /// For the core, with its place on the texture.
    pub fn textured(self) -> Corner<Perspective32<2>> {
        self.with(Perspective32(Perspective::new(self.texel, self.inverse_w)))
    }

    /// As [`textured`](Self::textured), to within half a texel.
    pub fn spanned(self) -> Corner<HalfTexel> {
        self.with(Perspective::new(self.texel, self.inverse_w).into())
    }

    /// The colour in RGB565, rounded to nearest.
    pub fn rgb565(self) -> u16 {
        let [red, green, blue] = self.color.map(u16::from);
        let scale = |v: u16, most: u16| (v * most + 127) / 255;
        scale(red, 31) << 11 | scale(green, 63) << 5 | scale(blue, 31)
    }
}

/// The bytes of section `name`; `None` where there is no such section.
pub fn section<'a>(mut file: &'a [u8], name: &str) -> Option<&'a [u8]> {
    loop {
        let (title, rest) = file.split_first_chunk::<NAME_BYTES>()?;
        let (count, rest) = rest.split_first_chunk::<4>()?;
        let (corners, rest) = rest.split_at_checked(u32::from_le_bytes(*count) as usize * CORNER_BYTES)?;
        if title.starts_with(name.as_bytes()) && title.get(name.len()).is_none_or(|&next| next == 0) {
            return Some(corners);
        }
        file = rest;
    }
}

/// The triangles of section `name`; `None` where there is no such section.
pub fn triangles<'a>(file: &'a [u8], name: &str) -> Option<impl Iterator<Item = [Vertex; 3]> + use<'a>> {
    let (corners, _) = section(file, name)?.as_chunks::<CORNER_BYTES>();
    let (triangles, _) = corners.as_chunks::<3>();
    Some(triangles.iter().map(|t| t.each_ref().map(Vertex::from_bytes)))
}
