//! MP1 scenes in float64, in the evaluation order of formats/mp1.md section 8, which gives the official pictures byte
//! for byte.
//!
//! ```text
//! vertices -> clip (homogeneous) -> screen (pixels) -> triangle, square, line (coverage) -> fragment (depth, over) -> color (bytes)
//! ```
//!
//! What does not come out as a number takes no part: a primitive with a vertex that has no place is left out, and so is a
//! fragment with a value that is not finite. So all samples are finite.

pub mod clip;
pub mod color;
pub mod fragment;
pub mod line;
pub mod screen;
pub mod square;
pub mod triangle;

use crate::scene::mp1::{Scene, Shape};
use fragment::Canvas;

/// One sample of the picture, unrounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Red, green, blue; linear with `sRGB`, straight, not clamped; 1 is full.
    pub color: [f64; 3],
    /// 0 where nothing was drawn.
    pub alpha: f64,
    /// z/w stored last, -1 to 1; 1 where nothing was stored, and everywhere without `depth`.
    pub depth: f64,
    /// The primitive that drew here last, from 1; 0 is the background.
    pub primitive: u32,
}

/// The reference's picture in samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Rendered {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Samples per pixel in each direction.
    pub fsaa: u32,
    /// Whether colours are encoded on output.
    pub srgb: bool,
    /// `width * fsaa` by `height * fsaa` samples, row by row from the top.
    pub samples: Vec<Sample>,
}

/// The scene's picture in samples.
pub fn draw(scene: &Scene) -> Rendered {
    let mut canvas = Canvas::new(scene);
    for (number, primitive) in (1..).zip(&scene.primitives) {
        canvas.primitive = number;
        match &primitive.shape {
            Shape::Triangle(corners) => triangle::draw(&mut canvas, corners, None),
            Shape::Textured(corners, texture) => triangle::draw(&mut canvas, corners, Some(texture)),
            Shape::Point(size, center) => square::point(&mut canvas, *size, center),
            Shape::Billboard(size, center, texture) => square::billboard(&mut canvas, *size, center, texture),
            Shape::Circle(size, center) => square::circle(&mut canvas, *size, center),
            Shape::Line(ends) => line::line(&mut canvas, ends),
            Shape::WuLine(ends) => line::wu_line(&mut canvas, ends),
        }
    }
    canvas.finish()
}

impl Sample {
    /// Red, green, blue, alpha.
    pub fn rgba(&self) -> [f64; 4] {
        let [r, g, b] = self.color;
        [r, g, b, self.alpha]
    }
}

impl Rendered {
    /// The picture in bytes, RGBA: cut off, clamped to 0…255.
    pub fn bytes(&self) -> Vec<[u8; 4]> {
        let bytes = |pixel: [f64; 4]| pixel.map(|level| level.floor() as u8);
        self.pixels().map(bytes).collect()
    }

    /// The pixels before they are cut off, RGBA: averaged over their samples, encoded with `sRGB`; 255 is full; not clamped.
    pub fn resolved(&self) -> Vec<[f64; 4]> {
        self.pixels().collect()
    }

    fn pixels(&self) -> impl Iterator<Item = [f64; 4]> {
        let (width, height) = (self.width as usize, self.height as usize);
        let places = (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)));
        places.map(|(x, y)| self.pixel(x, y))
    }

    fn pixel(&self, x: usize, y: usize) -> [f64; 4] {
        let n = self.fsaa as usize;
        let row = |j: usize| (y * n + j) * self.width as usize * n + x * n;
        let mut block = (0..n).flat_map(|j| &self.samples[row(j)..row(j) + n]);
        let [r, g, b, alpha] = match self.fsaa {
            // A colour times its alpha and divided by it again would round.
            1 => block.next().map_or([0.0; 4], Sample::rgba),
            _ => color::average(block, n * n),
        };
        let encoded = [r, g, b].map(|c| if self.srgb { color::encode(c) } else { c });
        [encoded[0], encoded[1], encoded[2], alpha].map(|v| 255.0 * v)
    }
}

#[cfg(test)]
mod tests;
