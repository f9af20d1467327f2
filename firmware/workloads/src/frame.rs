//! The picture that everything is drawn into: 320×240, RGB565, with 16-bit depth.

use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::error::Error;
use fixel::target::Buffer;
use fixel::window::Window;

/// Columns.
pub const WIDTH: u16 = 320;
/// Rows.
pub const HEIGHT: u16 = 240;

const PIXELS: usize = WIDTH as usize * HEIGHT as usize;

/// The standard workloads' depth: nearer or equal wins.
pub type Depths<'a> = DepthBuffer<Buffer<'a, u16>, LessOrEqual>;

/// Colour and depth.
pub struct Frame {
    color: [u16; PIXELS],
    depth: [u16; PIXELS],
}

impl Frame {
    /// All zero; [`clear`](Self::clear) before drawing.
    pub const fn new() -> Self {
        Frame {
            color: [0; PIXELS],
            depth: [0; PIXELS],
        }
    }

    /// The whole picture.
    pub fn window() -> Window {
        Window::new(0, 0, WIDTH as i32, HEIGHT as i32)
    }

    /// Black, and as far away as can be.
    pub fn clear(&mut self) {
        self.color.fill(0);
        self.depth.fill(FAR);
    }

    /// The colour buffer.
    ///
    /// # Errors
    /// None: the sizes are constants.
    pub fn color(&mut self) -> Result<Buffer<'_, u16>, Error> {
        Buffer::new(&mut self.color, WIDTH, HEIGHT)
    }

    /// Both buffers.
    ///
    /// # Errors
    /// None: the sizes are constants.
    pub fn with_depth(&mut self) -> Result<(Buffer<'_, u16>, Depths<'_>), Error> {
        let color = Buffer::new(&mut self.color, WIDTH, HEIGHT)?;
        let depth = DepthBuffer::new(Buffer::new(&mut self.depth, WIDTH, HEIGHT)?);
        Ok((color, depth))
    }

    /// Colours and depths, row by row.
    pub fn words(&self) -> (&[u16], &[u16]) {
        (&self.color, &self.depth)
    }

    /// The colours, row by row.
    pub fn pixels(&mut self) -> &mut [u16] {
        &mut self.color
    }

    /// CRC-32 of colour and of depth.
    pub fn checksums(&self) -> (u32, u32) {
        (crc32(&self.color), crc32(&self.depth))
    }
}

impl Default for Frame {
    fn default() -> Self {
        Self::new()
    }
}

/// The CRC-32 of zip and PNG over the little-endian bytes of `words`.
pub(crate) fn crc32(words: &[u16]) -> u32 {
    let mut crc = Crc32::default();
    crc.update(words);
    crc.value()
}

/// The CRC-32 of zip and PNG over the little-endian bytes of words that come piece by piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Crc32(u32);

impl Default for Crc32 {
    fn default() -> Self {
        Crc32(!0)
    }
}

impl Crc32 {
    /// More words.
    pub fn update(&mut self, words: &[u16]) {
        const REVERSED_POLYNOMIAL: u32 = 0xedb8_8320;
        let bytes = words.iter().flat_map(|word| word.to_le_bytes());
        self.0 = bytes.fold(self.0, |crc, byte| {
            (0..8).fold(crc ^ byte as u32, |crc, _| {
                (crc >> 1) ^ if crc & 1 != 0 { REVERSED_POLYNOMIAL } else { 0 }
            })
        });
    }

    /// Of all words so far.
    pub fn value(self) -> u32 {
        !self.0
    }
}

#[cfg(test)]
mod tests {
    use super::crc32;

    #[test]
    fn checksum_is_the_well_known_one() {
        // CRC-32 of "12345678".
        assert_eq!(crc32(&[0x3231, 0x3433, 0x3635, 0x3837]), 0x9ae0_daaf);
    }
}
