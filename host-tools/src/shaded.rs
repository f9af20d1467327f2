//! `shaded`: an Inventor scene from standard input, drawn by the fixed-point core, to standard output as plain PPM.
//!
//! Its command line is an old one and has no options but its own, so it is read by hand.

use std::ffi::OsString;
use std::io::{self, BufWriter, Read, Write};

use crate::fixed::{self, FixedPicture};
use crate::ppm;
use crate::scene::Fault;
use crate::scene::iv::{self, Scene, Shading};
use crate::scene::size::Size;

const USAGE: &str = "usage: shaded n xRes yRes [-eyelight] < scene.iv > picture.ppm";

/// What the command line says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Request {
    shading: Shading,
    size: Size,
    eyelight: bool,
}

/// Does what `words` say, the program's own name not among them.
///
/// # Errors
/// What went wrong, one line. Nothing has been written then, unless it is the writing that went wrong.
pub fn run(words: impl IntoIterator<Item = OsString>, mut input: impl Read, output: impl Write) -> Result<(), String> {
    let request = request(words)?;
    let mut text = Vec::new();
    let read = input.read_to_end(&mut text);
    read.map_err(|error| format!("cannot read standard input: {error}"))?;
    let picture = draw(&text, request).map_err(|fault| line(&fault))?;
    write(&picture, output).map_err(|error| format!("cannot write to standard output: {error}"))
}

fn request(words: impl IntoIterator<Item = OsString>) -> Result<Request, String> {
    let words: Vec<OsString> = words.into_iter().collect();
    let words: Vec<_> = words.iter().map(|word| word.to_string_lossy()).collect();
    let words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
    let (n, width, height, eyelight) = match words[..] {
        [n, width, height] => (n, width, height, false),
        [n, width, height, "-eyelight"] => (n, width, height, true),
        _ => return Err(USAGE.to_owned()),
    };
    let shading = match n {
        "0" => Shading::Flat,
        "1" => Shading::Gouraud,
        "2" => Shading::Phong,
        _ => return Err(format!("n must be 0 (flat), 1 (Gouraud) or 2 (Phong); {USAGE}")),
    };
    let size = Size::of_words(width, height).map_err(|message| format!("{message}; {USAGE}"))?;
    Ok(Request {
        shading,
        size,
        eyelight,
    })
}

fn draw(text: &[u8], request: Request) -> Result<FixedPicture, Fault> {
    fixed::iv::draw(&Scene {
        width: request.size.width(),
        height: request.size.height(),
        output: String::new(),
        shading: request.shading,
        eyelight: request.eyelight,
        model: iv::parse(text)?,
    })
}

/// A fault of the scene as `line L: message`; of what the whole text lacks, the message alone.
fn line(fault: &Fault) -> String {
    if fault.whole {
        return fault.message.clone();
    }
    format!("line {}: {}", fault.place.line, fault.message)
}

fn write(picture: &FixedPicture, output: impl Write) -> io::Result<()> {
    let size = [picture.width, picture.height];
    let pixels = picture.pixels.iter().map(|pixel| pixel.rgba);
    ppm::write(BufWriter::new(output), size, pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(line: &str) -> Result<Request, String> {
        request(line.split_whitespace().map(OsString::from))
    }

    #[test]
    fn the_command_line() {
        let size = |words| -> Size { str::parse(words).expect("a size") };
        for (line, shading, words, eyelight) in [
            ("0 1 1", Shading::Flat, "1x1", false),
            ("1 500 400", Shading::Gouraud, "500x400", false),
            ("2 16384 4096 -eyelight", Shading::Phong, "16384x4096", true),
        ] {
            let expected = Request {
                shading,
                size: size(words),
                eyelight,
            };
            assert_eq!(asked(line), Ok(expected), "{line}");
        }
    }

    #[test]
    fn any_other_command_line_is_one_line_of_complaint() {
        for (line, what) in [
            ("", "usage: "),
            ("1 5", "usage: "),
            ("1 5 5 eyelight", "usage: "),
            ("1 5 5 --eyelight", "usage: "),
            ("1 5 5 -eyelight -eyelight", "usage: "),
            ("-eyelight 1 5 5", "usage: "),
            ("--help", "usage: "),
            ("3 5 5", "n must be "),
            ("01 5 5", "n must be "),
            ("flat 5 5", "n must be "),
            ("1 0 5", "the width must be from 1 to 16384; usage: "),
            ("1 -5 5", "the width must be a whole number"),
            ("1 5 5.5", "the height must be a whole number"),
            ("1 5 20000", "the height must be from 1 to 16384; usage: "),
            ("1 16384 16384", "16384 x 16384 are more than "),
        ] {
            let complaint = asked(line).expect_err(line);
            assert!(complaint.starts_with(what), "{line}: {complaint}");
            assert!(complaint.contains(USAGE) && !complaint.contains('\n'), "{complaint}");
        }
    }
}
