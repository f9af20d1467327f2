//! A display behind SPI: its driver, as one would get from a crate, and a panel that keeps what it is sent.

use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::pixelcolor::raw::ToBytes;
use embedded_graphics_core::prelude::PointsIter;
use embedded_graphics_core::primitives::Rectangle;

use crate::crc::Crc;

/// Columns of the panel.
pub const WIDTH: u16 = 160;
/// Rows of the panel.
pub const HEIGHT: u16 = 128;

/// Commands of the MIPI display command set: the columns to write, the rows, the pixels.
const SET_COLUMNS: u8 = 0x2a;
const SET_ROWS: u8 = 0x2b;
const WRITE: u8 = 0x2c;

/// The wires to a panel.
pub trait Wire {
    /// With the data/command line low.
    fn command(&mut self, code: u8);
    /// With the data/command line high.
    fn data(&mut self, bytes: &[u8]);
}

/// A driver for panels that take a window and then its pixels: what `mipidsi` and others are.
pub struct Driver<W>(pub W);

impl<W: Wire> Driver<W> {
    fn set_window(&mut self, area: &Rectangle) {
        let last = area.bottom_right().unwrap_or(area.top_left);
        for (code, from, to) in [
            (SET_COLUMNS, area.top_left.x, last.x),
            (SET_ROWS, area.top_left.y, last.y),
        ] {
            let ([a, b], [c, d]) = ((from as u16).to_be_bytes(), (to as u16).to_be_bytes());
            self.0.command(code);
            self.0.data(&[a, b, c, d]);
        }
        self.0.command(WRITE);
    }
}

impl<W> OriginDimensions for Driver<W> {
    fn size(&self) -> Size {
        Size::new(WIDTH.into(), HEIGHT.into())
    }
}

impl<W: Wire> DrawTarget for Driver<W> {
    type Color = Rgb565;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        for Pixel(at, color) in pixels {
            self.fill_contiguous(&Rectangle::new(at, Size::new(1, 1)), [color])?;
        }
        Ok(())
    }

    /// A window, then its pixels in chunks.
    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Self::Error> {
        let whole = Rectangle::new(Point::zero(), self.size());
        if area.intersection(&whole) != *area {
            // Pixel by pixel, without those outside.
            let pixels = area.points().zip(colors).map(|(at, color)| Pixel(at, color));
            return self.draw_iter(pixels.filter(|Pixel(at, _)| whole.contains_point(*at)));
        }
        self.set_window(area);
        let mut chunk = heapless::Vec::<u8, 64>::new();
        for color in colors {
            // Never full: it is sent at 64.
            let _ = chunk.extend_from_slice(&color.to_be_bytes());
            if chunk.is_full() {
                self.0.data(&chunk);
                chunk.clear();
            }
        }
        self.0.data(&chunk);
        Ok(())
    }
}

/// Whether a point lies on a rectangle.
trait Contains {
    fn contains_point(&self, point: Point) -> bool;
}

impl Contains for Rectangle {
    fn contains_point(&self, point: Point) -> bool {
        let end = self.top_left + self.size;
        (self.top_left.x..end.x).contains(&point.x) && (self.top_left.y..end.y).contains(&point.y)
    }
}

/// A panel with its own memory, as panels have; it counts what comes over the wires.
pub struct Panel {
    memory: [[u8; 2]; WIDTH as usize * HEIGHT as usize],
    /// Bytes, commands included.
    pub bytes: u32,
    code: u8,
    parameters: heapless::Vec<u8, 4>,
    columns: (u16, u16),
    rows: (u16, u16),
    at: (u16, u16),
    half: Option<u8>,
}

impl Panel {
    /// Black.
    pub const fn new() -> Self {
        Panel {
            memory: [[0; 2]; WIDTH as usize * HEIGHT as usize],
            bytes: 0,
            code: 0,
            parameters: heapless::Vec::new(),
            columns: (0, 0),
            rows: (0, 0),
            at: (0, 0),
            half: None,
        }
    }

    /// The picture: RGB565, the upper byte first, row by row from the top.
    pub fn picture(&self) -> &[[u8; 2]] {
        &self.memory
    }

    /// Of the picture.
    pub fn crc(&self) -> u32 {
        let mut crc = Crc::default();
        self.memory.iter().for_each(|pixel| crc.add(pixel));
        crc.value()
    }

    fn pixel(&mut self, pixel: [u8; 2]) {
        let (x, y) = self.at;
        let place = y as usize * WIDTH as usize + x as usize;
        if x < WIDTH
            && let Some(memory) = self.memory.get_mut(place)
        {
            *memory = pixel;
        }
        // To the right, then to the next row of the window.
        self.at = if x < self.columns.1 {
            (x + 1, y)
        } else {
            (self.columns.0, y.wrapping_add(1))
        };
    }

    fn parameter(&mut self, byte: u8) {
        let _ = self.parameters.push(byte);
        if let [a, b, c, d] = *self.parameters {
            let range = (u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d]));
            if self.code == SET_COLUMNS {
                self.columns = range;
            } else {
                self.rows = range;
            }
            self.at = (self.columns.0, self.rows.0);
        }
    }
}

impl Default for Panel {
    fn default() -> Self {
        Self::new()
    }
}

impl Wire for &mut Panel {
    fn command(&mut self, code: u8) {
        self.bytes += 1;
        self.code = code;
        self.parameters.clear();
        self.half = None;
    }

    fn data(&mut self, bytes: &[u8]) {
        self.bytes += bytes.len() as u32;
        for &byte in bytes {
            match (self.code, self.half.take()) {
                (WRITE, None) => self.half = Some(byte),
                (WRITE, Some(upper)) => self.pixel([upper, byte]),
                _ => self.parameter(byte),
            }
        }
    }
}
