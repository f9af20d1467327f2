//! What is drawn into (07.7): numbered colour buffers and perhaps a depth buffer.

use std::collections::BTreeMap;

use super::image::Image;

/// Images that fragments are written to; each may be left out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Framebuffer {
    /// The colour buffers by their numbers.
    pub colors: BTreeMap<usize, Image<4>>,
    /// Window depths; the caller clears it to 1.
    pub depth: Option<Image<1>>,
}

impl Framebuffer {
    /// One colour buffer, number 0, of one colour, and a depth buffer of 1.
    pub fn new(width: u32, height: u32, clear: [f64; 4]) -> Self {
        Self {
            colors: BTreeMap::from([(0, Image::new(width, height, clear))]),
            depth: Some(Image::new(width, height, [1.0])),
        }
    }

    /// Width and height that all attached images have; 0 by 0 if there are none.
    pub fn size(&self) -> [u32; 2] {
        let colors = self.colors.values().map(|image| [image.width(), image.height()]);
        let depth = self.depth.iter().map(|image| [image.width(), image.height()]);
        let common = colors.chain(depth).reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1])]);
        common.unwrap_or_default()
    }
}
