//! What a display is sent of a picture: fewer levels than the bytes in which it was drawn.

use fixel::dither;
use fixel::texture::{Format, Rgb565, Texel};

use super::{FixedPicture, Pixel};

/// What a picture is shown on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Output {
    /// What takes bytes.
    #[default]
    Bytes,
    /// RGB565, each channel the nearest level.
    Rgb565,
    /// RGB565 by [`dither::rgb565`].
    Dithered565,
    /// Black and white by [`dither::one_bit`] of the brightness.
    OneBit,
}

impl Output {
    /// A word for every pixel, row by row: RGB565, or 1 for white. None where bytes are taken as they are.
    pub fn words(self, picture: &FixedPicture) -> Vec<u16> {
        match self {
            Output::Bytes => Vec::new(),
            Output::Rgb565 => words(picture, |rgb, _| nearest(rgb)),
            Output::Dithered565 => words(picture, dither::rgb565),
            Output::OneBit => words(picture, |rgb, at| dither::one_bit(brightness(rgb), at).into()),
        }
    }

    /// The picture in bytes that the display's levels stand for.
    pub fn shown(self, mut picture: FixedPicture) -> FixedPicture {
        let words = self.words(&picture);
        for (pixel, word) in picture.pixels.iter_mut().zip(words) {
            let bytes = match self {
                Output::OneBit => [255 * word as u8; 3],
                _ => levels(word),
            };
            pixel.rgba = with_alpha(bytes, *pixel);
        }
        picture
    }
}

fn words(picture: &FixedPicture, word: impl Fn([u8; 3], (i32, i32)) -> u16) -> Vec<u16> {
    let mut words = Vec::with_capacity(picture.pixels.len());
    for (y, row) in (0..).zip(picture.pixels.chunks(picture.width.max(1) as usize)) {
        words.extend((0..).zip(row).map(|(x, pixel)| {
            let [red, green, blue, _] = pixel.rgba;
            word([red, green, blue], (x, y))
        }));
    }
    words
}

/// The nearest RGB565 colour.
fn nearest([red, green, blue]: [u8; 3]) -> u16 {
    let level = |channel: u8, most: u32| (u32::from(channel) * most + 127) / 255;
    (level(red, 31) << 11 | level(green, 63) << 5 | level(blue, 31)) as u16
}

/// Brightness by the weights of Rec. 601, in 256ths.
fn brightness([red, green, blue]: [u8; 3]) -> u8 {
    ((77 * u32::from(red) + 150 * u32::from(green) + 29 * u32::from(blue) + 128) >> 8) as u8
}

/// The nearest bytes to an RGB565 colour.
fn levels(word: u16) -> [u8; 3] {
    let Texel([red, green, blue, _]) = Rgb565.texel(word);
    [red, green, blue]
}

fn with_alpha([red, green, blue]: [u8; 3], pixel: Pixel) -> [u8; 4] {
    let [.., alpha] = pixel.rgba;
    [red, green, blue, alpha]
}

impl Pixel {
    /// A pixel that holds an RGB565 word until the picture is done: [`unpacked`].
    pub(super) fn packed(word: u16, primitive: u32) -> Self {
        let [low, high] = word.to_le_bytes();
        Pixel {
            rgba: [low, high, 0, 255],
            primitive,
        }
    }
}

/// A picture of [`Pixel::packed`] in bytes.
pub(super) fn unpacked(mut picture: FixedPicture) -> FixedPicture {
    for pixel in picture.pixels.iter_mut().filter(|pixel| pixel.primitive != 0) {
        let [low, high, ..] = pixel.rgba;
        pixel.rgba = with_alpha(levels(u16::from_le_bytes([low, high])), *pixel);
    }
    picture
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: Vec<Pixel>) -> FixedPicture {
        FixedPicture {
            width: 4,
            height: pixels.len() as u32 / 4,
            depth: vec![0; pixels.len()],
            pixels,
        }
    }

    fn gray(level: u8) -> FixedPicture {
        let pixel = Pixel {
            rgba: [level, level, level, 255],
            primitive: 1,
        };
        picture(vec![pixel; 16])
    }

    fn reds(picture: &FixedPicture) -> impl Iterator<Item = u8> {
        picture.pixels.iter().map(|pixel| pixel.rgba[0])
    }

    #[test]
    fn levels_are_the_nearest_or_in_the_mean() {
        for level in 0..=255 {
            let near = |output: Output, most: f64| {
                let shown = output.shown(gray(level));
                let mean = reds(&shown).map(f64::from).sum::<f64>() / 16.0;
                let worst = reds(&shown).map(|byte| byte.abs_diff(level)).max().unwrap();
                // Half a byte for what a level of the display is not in bytes.
                assert!(
                    (mean - f64::from(level)).abs() <= most + 0.5,
                    "{output:?} {level}: {mean}"
                );
                worst
            };
            // A level of 31 is 8.23 of 255: half of it, all of it, and a 32nd in the mean.
            assert!(near(Output::Rgb565, 255.0 / 62.0) <= 4);
            assert!(near(Output::Dithered565, 255.0 / 31.0 / 32.0) <= 9);
            near(Output::OneBit, 255.0 / 32.0);
        }
    }

    #[test]
    fn packed_words_come_back() {
        for word in 0..=u16::MAX {
            let shown = unpacked(picture(vec![Pixel::packed(word, 1); 4]));
            assert_eq!(nearest(levels(word)), word);
            assert_eq!(shown.pixels[0].rgba[..3], levels(word));
        }
        let empty = picture(vec![Pixel::default(); 4]);
        assert_eq!(unpacked(empty.clone()), empty);
    }
}
