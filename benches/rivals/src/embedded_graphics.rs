//! [embedded-graphics](https://docs.rs/embedded-graphics): flat fill of triangles between whole pixels.
//!
//! Can: W1. No interpolation, no depth, no subpixels: corners are moved to the nearest pixel. The target is one that
//! fills the runs that the crate hands over at once.

use alloc::vec;
use alloc::vec::Vec;
use core::convert::Infallible;

use embedded_graphics::Drawable;
use embedded_graphics::Pixel;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::pixelcolor::raw::{RawData, RawU16};
use embedded_graphics::prelude::{DrawTarget, OriginDimensions, PixelColor, Point, Primitive, Size};
use embedded_graphics::primitives::{PrimitiveStyle, Rectangle, Triangle as Outline};

use crate::scene::Triangle;
use crate::{HEIGHT, Kind, PIXELS, Rival, WIDTH};

/// The crate.
pub struct EmbeddedGraphics;

/// A picture that the crate can draw into.
pub struct Canvas(Vec<u16>);

impl Canvas {
    /// All black.
    pub fn black() -> Self {
        Canvas(vec![0; PIXELS])
    }

    /// The pixels, row by row.
    pub fn pixels(&self) -> &[u16] {
        &self.0
    }
}

impl OriginDimensions for Canvas {
    fn size(&self) -> Size {
        Size::new(WIDTH as u32, HEIGHT as u32)
    }
}

impl DrawTarget for Canvas {
    type Color = Rgb565;
    type Error = Infallible;

    #[inline]
    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(Point { x, y }, color) in pixels {
            if (0..WIDTH as i32).contains(&x) && (0..HEIGHT as i32).contains(&y) {
                self.0[y as usize * WIDTH + x as usize] = word(color);
            }
        }
        Ok(())
    }

    #[inline]
    fn fill_solid(&mut self, area: &Rectangle, color: Rgb565) -> Result<(), Infallible> {
        let within = |start: i32, length: u32, most: usize| {
            let (start, end) = (
                start.max(0) as usize,
                (start + length as i32).clamp(0, most as i32) as usize,
            );
            start.min(end)..end
        };
        let columns = within(area.top_left.x, area.size.width, WIDTH);
        for row in within(area.top_left.y, area.size.height, HEIGHT) {
            self.0[row * WIDTH..][columns.clone()].fill(word(color));
        }
        Ok(())
    }
}

fn word(color: Rgb565) -> u16 {
    <Rgb565 as PixelColor>::Raw::from(color).into_inner()
}

impl Rival for EmbeddedGraphics {
    const NAME: &'static str = "embedded-graphics";

    type Frame = Canvas;
    type Prepared = Vec<(Outline, PrimitiveStyle<Rgb565>)>;

    fn frame() -> Canvas {
        Canvas::black()
    }

    fn colors(frame: &Canvas) -> &[u16] {
        frame.pixels()
    }

    fn prepare(kind: Kind, triangles: &[Triangle]) -> Option<Self::Prepared> {
        let outline = |triangle: &Triangle| {
            let [a, b, c] = triangle.each_ref().map(|corner| Point::from(corner.pixel()));
            let color = Rgb565::from(RawU16::new(triangle[0].rgb565()));
            (Outline::new(a, b, c), PrimitiveStyle::with_fill(color))
        };
        (kind == Kind::Flat).then(|| triangles.iter().map(outline).collect())
    }

    #[inline(never)]
    fn draw(prepared: &Self::Prepared, frame: &mut Canvas) {
        for (outline, style) in prepared {
            let Ok(()) = outline.into_styled(*style).draw(frame);
        }
    }
}
