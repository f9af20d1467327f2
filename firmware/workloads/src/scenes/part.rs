//! A picture of 96×64 pixels, RGB565, with 16-bit depth, whole or a strip of it.

use fixel::depth::{Comparison, DepthBuffer, FAR};
use fixel::error::Error;
use fixel::target::Buffer;
use fixel::window::Window;

/// Columns.
pub const WIDTH: u16 = 96;
/// Rows.
pub const HEIGHT: u16 = 64;

/// Memory for a picture of `PIXELS` pixels or fewer.
pub struct Memory<const PIXELS: usize = { WIDTH as usize * HEIGHT as usize }> {
    color: [u16; PIXELS],
    depth: [u16; PIXELS],
}

impl<const PIXELS: usize> Memory<PIXELS> {
    /// All zero; a strip is cleared when it is asked for.
    pub const fn new() -> Self {
        Memory {
            color: [0; PIXELS],
            depth: [0; PIXELS],
        }
    }

    /// The rows from `top` to before `bottom`, black and as far away as can be; none where there is no memory for them.
    pub fn cleared(&mut self, top: u16, bottom: u16) -> Part<'_> {
        let window = Window::new(0, top.into(), WIDTH.into(), bottom.into());
        let pixels = window.width() * window.height();
        let (color, depth) = (
            self.color.get_mut(..pixels).unwrap_or_default(),
            self.depth.get_mut(..pixels).unwrap_or_default(),
        );
        color.fill(0);
        depth.fill(FAR);
        Part { window, color, depth }
    }
}

impl<const PIXELS: usize> Default for Memory<PIXELS> {
    fn default() -> Self {
        Self::new()
    }
}

/// Rows of the picture.
pub struct Part<'a> {
    window: Window,
    color: &'a mut [u16],
    depth: &'a mut [u16],
}

impl Part<'_> {
    /// Which rows.
    pub fn window(&self) -> Window {
        self.window
    }

    /// Colour alone.
    ///
    /// # Errors
    /// Where the memory is too small.
    pub fn color(&mut self) -> Result<Buffer<'_, u16>, Error> {
        Buffer::strip(self.color, self.window)
    }

    /// Colour, and the depth memory for whatever it is good for.
    ///
    /// # Errors
    /// Where the memory is too small.
    pub fn both(&mut self) -> Result<(Buffer<'_, u16>, Buffer<'_, u16>), Error> {
        Ok((
            Buffer::strip(self.color, self.window)?,
            Buffer::strip(self.depth, self.window)?,
        ))
    }

    /// Colour and depth compared by `C`.
    ///
    /// # Errors
    /// Where the memory is too small.
    #[expect(clippy::type_complexity, reason = "the two buffers as the core names them")]
    pub fn compared<C: Comparison>(&mut self) -> Result<(Buffer<'_, u16>, DepthBuffer<Buffer<'_, u16>, C>), Error> {
        Ok((
            Buffer::strip(self.color, self.window)?,
            DepthBuffer::new(Buffer::strip(self.depth, self.window)?),
        ))
    }

    /// The colours, row by row.
    pub fn colors(&self) -> &[u16] {
        self.color
    }

    /// The colours, to be written without the core.
    pub fn colors_mut(&mut self) -> &mut [u16] {
        self.color
    }

    /// The depths, row by row.
    pub fn depths(&self) -> &[u16] {
        self.depth
    }
}
