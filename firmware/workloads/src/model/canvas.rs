//! The picture that a model is drawn into: any size that fits the memory, RGB565, with 16-bit depth.

use fixel::depth::{DepthBuffer, FAR, LessOrFar};
use fixel::error::Error;
use fixel::target::Buffer;

use crate::frame::crc32;

/// Pixels that there is memory for: 640×480, or another shape.
pub const PIXELS: usize = 640 * 480;

/// The depth of `.iv`: nearer wins.
pub type Depths<'a> = DepthBuffer<Buffer<'a, u16>, LessOrFar>;

/// Colour and depth.
pub struct Canvas {
    color: [u16; PIXELS],
    depth: [u16; PIXELS],
}

impl Canvas {
    /// All zero; [`clear`](Self::clear) before drawing.
    pub const fn new() -> Self {
        Canvas {
            color: [0; PIXELS],
            depth: [0; PIXELS],
        }
    }

    /// Black, and as far away as can be.
    pub fn clear(&mut self) {
        self.color.fill(0);
        self.depth.fill(FAR);
    }

    /// Both buffers, for a picture of this size.
    ///
    /// # Errors
    /// More than [`PIXELS`], or a side beyond 32768.
    pub fn buffers(&mut self, width: u16, height: u16) -> Result<(Buffer<'_, u16>, Depths<'_>), Error> {
        let color = Buffer::new(&mut self.color, width, height)?;
        let depth = DepthBuffer::new(Buffer::new(&mut self.depth, width, height)?);
        Ok((color, depth))
    }

    /// The colours, row by row; what lies behind the picture's is black.
    pub fn color(&self) -> &[u16] {
        &self.color
    }

    /// CRC-32 of colour and of depth, of all the memory.
    pub fn checksums(&self) -> (u32, u32) {
        (crc32(&self.color), crc32(&self.depth))
    }
}

impl Default for Canvas {
    fn default() -> Self {
        Self::new()
    }
}
