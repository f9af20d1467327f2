//! The picture that the tiers draw: 160×120 pixels of any kind, with 16-bit depth.

use fixel::depth::{DepthBuffer, FAR, Less};
use fixel::error::Error;
use fixel::target::Buffer;

use super::color::Output;

/// Columns.
pub const WIDTH: u16 = 160;
/// Rows.
pub const HEIGHT: u16 = 120;

const PIXELS: usize = WIDTH as usize * HEIGHT as usize;

/// Colour and depth.
pub struct Canvas<P> {
    color: [P; PIXELS],
    depth: [u16; PIXELS],
}

impl<P: Output> Canvas<P> {
    /// Nothing drawn, as far away as can be.
    pub const fn new() -> Self {
        Canvas {
            color: [P::EMPTY; PIXELS],
            depth: [FAR; PIXELS],
        }
    }

    /// Nothing drawn, as far away as can be.
    pub fn clear(&mut self) {
        self.color.fill(P::EMPTY);
        self.depth.fill(FAR);
    }

    /// The two buffers to draw into.
    ///
    /// # Errors
    /// None: the sizes are constants.
    #[expect(clippy::type_complexity, reason = "the two buffers as the core names them")]
    pub fn buffers(&mut self) -> Result<(Buffer<'_, P>, DepthBuffer<Buffer<'_, u16>, Less>), Error> {
        let color = Buffer::new(&mut self.color, WIDTH, HEIGHT)?;
        let depth = DepthBuffer::new(Buffer::new(&mut self.depth, WIDTH, HEIGHT)?);
        Ok((color, depth))
    }

    /// The colours, row by row.
    pub fn colors_mut(&mut self) -> &mut [P] {
        &mut self.color
    }

    /// The colours, row by row.
    pub fn colors(&self) -> &[P] {
        &self.color
    }

    /// The depths, row by row.
    pub fn depths(&self) -> &[u16] {
        &self.depth
    }
}

impl<P: Output> Default for Canvas<P> {
    fn default() -> Self {
        Self::new()
    }
}
