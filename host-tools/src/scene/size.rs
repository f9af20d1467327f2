//! The size of a picture, where the command line and not the scene gives it.

use std::str::FromStr;

use super::{LONGEST_SIDE, MOST_PIXELS};

/// Width and height of a picture in pixels: 1 to 16384 each, at most 2^26 pixels in all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    width: u32,
    height: u32,
}

impl Size {
    /// What a picture has if nobody says otherwise.
    pub const DEFAULT: Self = Self {
        width: 500,
        height: 500,
    };

    /// The size that two words give.
    ///
    /// # Errors
    /// What is wrong with them, one line.
    pub fn of_words(width: &str, height: &str) -> Result<Self, String> {
        let (width, height) = (side("width", width)?, side("height", height)?);
        if u64::from(width) * u64::from(height) > MOST_PIXELS {
            return Err(format!("{width} x {height} are more than {MOST_PIXELS} pixels"));
        }
        Ok(Self { width, height })
    }

    /// Width in pixels.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(self) -> u32 {
        self.height
    }
}

fn side(name: &str, word: &str) -> Result<u32, String> {
    let digits = !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_digit());
    if !digits {
        return Err(format!("the {name} must be a whole number of pixels"));
    }
    // Digits that do not fit are too many.
    let value = word.parse().unwrap_or(u32::MAX);
    if (1..=LONGEST_SIDE).contains(&value) {
        return Ok(value);
    }
    Err(format!("the {name} must be from 1 to {LONGEST_SIDE}"))
}

impl FromStr for Size {
    type Err = String;

    /// `WxH`, as in `640x480`.
    fn from_str(text: &str) -> Result<Self, String> {
        let (width, height) = text.split_once('x').ok_or("expected WxH, as in 640x480")?;
        Self::of_words(width, height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_1_to_16384_and_2_to_the_26_pixels() {
        for (text, size) in [
            ("640x480", (640, 480)),
            ("1x1", (1, 1)),
            ("16384x4096", (16384, 4096)),
            ("007x8", (7, 8)),
        ] {
            let found: Result<Size, String> = text.parse();
            assert_eq!(found.map(|size| (size.width(), size.height())), Ok(size), "{text}");
        }
        for (text, what) in [
            ("", "expected WxH"),
            ("640", "expected WxH"),
            ("640X480", "expected WxH"),
            ("x480", "the width must be a whole number"),
            ("640x", "the height must be a whole number"),
            ("640x480x1", "the height must be a whole number"),
            ("-1x1", "the width must be a whole number"),
            ("+1x1", "the width must be a whole number"),
            ("1.0x1", "the width must be a whole number"),
            ("1 x1", "the width must be a whole number"),
            ("1x١", "the height must be a whole number"),
            ("0x1", "the width must be from 1 to 16384"),
            ("1x0", "the height must be from 1 to 16384"),
            ("16385x1", "the width must be from 1 to 16384"),
            ("99999999999999999999x1", "the width must be from 1 to 16384"),
            ("16384x4097", "16384 x 4097 are more than 67108864 pixels"),
        ] {
            let found: Result<Size, String> = text.parse();
            assert!(found.is_err_and(|found| found.starts_with(what)), "{text}");
        }
    }
}
