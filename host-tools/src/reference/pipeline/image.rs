//! Images (C1 to C3, 00.1): numbers with head-room until they are written out.

use crate::picture::Picture;

/// An image of `N` components per pixel, 1 for depth, 4 for colour; row 0 is the bottom row.
#[derive(Debug, Clone, PartialEq)]
pub struct Image<const N: usize> {
    width: u32,
    height: u32,
    pixels: Vec<[f64; N]>,
}

impl<const N: usize> Image<N> {
    /// An image of one value.
    pub fn new(width: u32, height: u32, value: [f64; N]) -> Self {
        Self::from_fn(width, height, |_, _| value)
    }

    /// An image of what `value` says of each column and row.
    pub fn from_fn(width: u32, height: u32, value: impl Fn(u32, u32) -> [f64; N]) -> Self {
        let value = &value;
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| value(x, y)));
        Self {
            width,
            height,
            pixels: pixels.collect(),
        }
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The value of pixel (x, y); none outside.
    pub fn get(&self, x: i64, y: i64) -> Option<[f64; N]> {
        self.index(x, y).map(|i| self.pixels[i])
    }

    /// Sets pixel (x, y) and tells whether there is one.
    pub fn set(&mut self, x: i64, y: i64, value: [f64; N]) -> bool {
        let index = self.index(x, y);
        if let Some(i) = index {
            self.pixels[i] = value;
        }
        index.is_some()
    }

    /// Sets the pixel that a position lies in, and tells whether there is one.
    pub fn set_at(&mut self, position: [f64; 2], value: [f64; N]) -> bool {
        let [x, y] = position.map(|c| c.floor() as i64);
        self.set(x, y, value)
    }

    /// Sets every pixel.
    pub fn fill(&mut self, value: [f64; N]) {
        self.pixels.fill(value);
    }

    fn index(&self, x: i64, y: i64) -> Option<usize> {
        let inside = (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y);
        inside.then(|| y as usize * self.width as usize + x as usize)
    }
}

impl Image<4> {
    /// The picture for a file: turned over, clamped, rounded to nearest, alpha dropped.
    pub fn picture(&self) -> Picture {
        let rows = self.pixels.chunks(self.width.max(1) as usize).rev();
        let pixels = rows.flatten().map(|&[r, g, b, _]| [byte(r), byte(g), byte(b), 255]);
        Picture::new(self.width, self.height, pixels.collect())
    }
}

/// The 8-bit level of a value: clamped to 0…1, times 255, rounded to nearest.
pub fn byte(value: f64) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn c2_outside_is_never_a_wrap() {
        let mut image = Image::new(3, 2, [0.5]);
        for (x, y) in [(3, 0), (-1, 1), (0, 2), (0, -1), (i64::MAX, i64::MIN)] {
            assert_eq!(image.get(x, y), None);
            assert!(!image.set(x, y, [1.0]));
        }
        assert_eq!(image, Image::new(3, 2, [0.5]));
        assert!(image.set(2, 1, [-3.0]));
        assert_eq!(image.get(2, 1), Some([-3.0]));
    }

    #[test]
    fn c1_c3_written_out_turned_over_clamped_and_rounded() {
        let mut image = Image::new(2, 2, [0.0; 4]);
        image.set(0, 0, [-1.0, 0.5, 7.0, 0.0]);
        image.set(1, 1, [127.4 / 255.0, 127.6 / 255.0, 1.0, 0.3]);
        let black = [0, 0, 0, 255];
        let expected = vec![black, [127, 128, 255, 255], [0, 128, 255, 255], black];
        assert_eq!(image.picture(), Picture::new(2, 2, expected));
    }

    #[test]
    fn i00_1_a_position_goes_to_the_pixel_it_lies_in() {
        let mut image = Image::new(20, 20, [0.0]);
        assert!(image.set_at([10.99, 3.01], [1.0]));
        assert_eq!(image.get(10, 3), Some([1.0]));
        assert!(!image.set_at([-0.5, 0.0], [1.0]));
        assert_eq!(image.get(0, 0), Some([0.0]));
    }

    #[test]
    fn i00_2_the_chaos_game_leaves_the_middle_free() {
        let corners = [[0.0, 0.0], [256.0, 0.0], [0.0, 256.0]];
        let mut random = crate::playground::texture::Random::new(1);
        let mut image = Image::new(300, 300, [0.0]);
        let mut p: [f64; 2] = corners[0];
        for step in 0..5000 {
            let q = corners[usize::from(random.byte()) % 3];
            p = [0, 1].map(|i| (p[i] + q[i]) / 2.0);
            if step >= 8 {
                assert!(image.set_at(p, [1.0]));
            }
        }
        let set = |x: i64, y: i64| image.get(x, y) == Some([1.0]);
        assert!((128..300).all(|x| (128..300).all(|y| !set(x, y))));
        assert!((64..128).all(|x| (64..128).all(|y| !set(x, y))));
        let count = (0..300)
            .flat_map(|x| (0..300).map(move |y| (x, y)))
            .filter(|&(x, y)| set(x, y));
        assert!(count.count() > 1000);
    }
}
