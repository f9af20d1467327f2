//! The fixed-point core's picture, as the comparison sees it.

use crate::picture::Picture;

/// One pixel of the fixed-point core.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Pixel {
    /// Red, green, blue, alpha; alpha is 0 where nothing was drawn and 255 elsewhere.
    pub rgba: [u8; 4],
    /// The primitive that won the pixel, from 1; 0 is the background.
    pub primitive: u32,
}

/// A picture of the fixed-point core, row by row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FixedPicture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width * height` pixels.
    pub pixels: Vec<Pixel>,
    /// `width * height` depths in steps of 1/65535; 65535 where nothing was drawn.
    pub depth: Vec<u16>,
}

impl FixedPicture {
    /// What is seen of it.
    pub fn picture(&self) -> Picture {
        let bytes = self.pixels.iter().map(|pixel| pixel.rgba).collect();
        Picture::new(self.width, self.height, bytes)
    }
}
