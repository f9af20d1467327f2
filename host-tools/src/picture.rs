//! A finished picture, as it goes to and comes from a file.

/// Eight bits of red, green, blue and alpha for each pixel, row by row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` pixels.
    pub pixels: Vec<[u8; 4]>,
}

impl Picture {
    /// A picture of pixels that somebody else laid out; `pixels` must be `width * height` long.
    pub fn new(width: u32, height: u32, pixels: Vec<[u8; 4]>) -> Self {
        debug_assert_eq!(pixels.len() as u64, u64::from(width) * u64::from(height));
        Self { width, height, pixels }
    }

    /// Width and height, for comparing and printing.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }
}
