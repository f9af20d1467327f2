//! `embedded-graphics`: into its framebuffers, and a finished strip to any display.
//!
//! A `Framebuffer` of embedded-graphics keeps raw bytes. [`bytes`] makes a target of them whose pixels are byte arrays, so
//! that fixel draws in place, in either byte order:
//!
//! ```
//! use embedded_graphics::{framebuffer::{Framebuffer, buffer_size}, image::GetPixel};
//! use embedded_graphics::pixelcolor::{Rgb565, raw::{BigEndian, RawU16, ToBytes}};
//! use embedded_graphics::prelude::*;
//! use fixel::{depth::NoDepth, draw, eg, fragment::Flat, screen::Position};
//!
//! let mut framebuffer = Framebuffer::<Rgb565, RawU16, BigEndian, 32, 8, { buffer_size::<Rgb565>(32, 8) }>::new();
//! let corners = [(0, 0), (0, 8), (32, 0)].map(|(x, y)| Position::from_pixels(x, y).flat());
//! let color = Flat(Rgb565::CSS_ORANGE.to_be_bytes());
//! draw::triangle(&mut eg::bytes(framebuffer.data_mut(), 32, 8)?, &mut NoDepth, corners, &color);
//! assert_eq!(framebuffer.pixel(Point::new(3, 2)), Some(Rgb565::CSS_ORANGE));
//! # Ok::<(), fixel::error::Error>(())
//! ```

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;

use crate::error::Error;
use crate::target::Buffer;
use crate::window::Window;

/// A target over raw bytes, N per pixel, row after row: what `Framebuffer::data_mut` of embedded-graphics lends.
///
/// # Errors
/// [`Error::BufferTooSmall`] where `data` holds fewer than `width`·`height` pixels.
pub fn bytes<const N: usize>(data: &mut [u8], width: u16, height: u16) -> Result<Buffer<'_, [u8; N]>, Error> {
    let (pixels, _) = data.as_chunks_mut();
    Buffer::new(pixels, width, height)
}

/// Sends the pixels of a finished strip or picture, row after row without gaps, to a display, in one bulk call of
/// [`fill_contiguous`](DrawTarget::fill_contiguous). `window` says which part of the display they are.
///
/// # Errors
/// The display's.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor};
/// use fixel::{eg, window::Window};
/// let mut display = MockDisplay::<BinaryColor>::new();
/// let strip = [BinaryColor::On, BinaryColor::Off, BinaryColor::Off, BinaryColor::On];
/// eg::send(&strip, Window::new(0, 1, 2, 3), &mut display).unwrap();
/// display.assert_pattern(&["  ", "#.", ".#"]);
/// ```
pub fn send<D, C>(pixels: &[C], window: Window, display: &mut D) -> Result<(), D::Error>
where
    C: Copy + Into<D::Color>,
    D: DrawTarget<Color: PixelColor>,
{
    let size = Size::new(window.width() as u32, window.height() as u32);
    let area = Rectangle::new(Point::new(window.left, window.top), size);
    display.fill_contiguous(&area, pixels.iter().map(|&pixel| pixel.into()))
}
