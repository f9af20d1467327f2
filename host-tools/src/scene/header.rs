//! The first command of HW2 and MP1: the picture's size and name.

use super::arguments::{Arguments, quoted};
use super::lex::Line;
use super::{Fault, LONGEST_SIDE, MOST_PIXELS, Place};

/// What `png` says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Header {
    /// Width of the picture in pixels, 1 to 16384.
    pub width: u32,
    /// Height of the picture in pixels, 1 to 16384; at most 2^26 pixels in all.
    pub height: u32,
    /// The picture's file name, as the scene suggests it; relative, inside the folder.
    pub output: String,
}

/// Reads the first line of a scene, which must be `png`; `None` is a scene without a line.
pub fn header(line: Option<Line<'_>>) -> Result<Header, Fault> {
    let Some(line) = line else {
        let start = Place { line: 1, column: 1 };
        return Err(Fault::new(start, "the scene is empty: no png command"));
    };
    if line.keyword.text != "png" {
        let found = quoted(line.keyword.text);
        let message = format!("the first command must be png, found {found}");
        return Err(Fault::new(line.keyword.place, message));
    }
    let mut arguments = Arguments::new(line, 3)?;
    let width = arguments.integer("width", 1, LONGEST_SIDE)?;
    let height = arguments.integer("height", 1, LONGEST_SIDE)?;
    let pixels = u64::from(width) * u64::from(height);
    if pixels > MOST_PIXELS {
        let message = format!("{width} x {height} are more than {MOST_PIXELS} pixels");
        return Err(Fault::new(arguments.keyword(), message));
    }
    Ok(Header {
        width,
        height,
        output: arguments.file_name()?,
    })
}
