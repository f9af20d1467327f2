//! Which format a text is in.

use std::fmt;
use std::path::Path;

use super::{Place, lex};

/// A scene format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// Points, matrices, lights, patches; one picture.
    Hw2,
    /// Points in clip coordinates.
    Mp1,
    /// A subset of Inventor text files.
    Iv,
    /// Wavefront meshes.
    Obj,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Hw2 => "hw2",
            Self::Mp1 => "mp1",
            Self::Iv => "iv",
            Self::Obj => "obj",
        })
    }
}

/// Keywords that HW2 has and MP1 has not.
const ONLY_HW2: [&str; 24] = [
    "xyz",
    "color",
    "normal",
    "trif",
    "trig",
    "rectbezf",
    "rectbezg",
    "tribezf",
    "tribezg",
    "loadmv",
    "multmv",
    "translate",
    "rotatex",
    "rotatey",
    "rotatez",
    "rotate",
    "scale",
    "lookat",
    "loadp",
    "ortho",
    "flatnormals",
    "sunlight",
    "bulb",
    "shininess",
];

/// Keywords that MP1 has and HW2 has not.
const ONLY_MP1: [&str; 12] = [
    "depth",
    "sRGB",
    "hyp",
    "fsaa",
    "rgb",
    "rgba",
    "tri",
    "point",
    "billboard",
    "circle",
    "line",
    "wuline",
];

/// Keywords of both.
const SHARED: [&str; 9] = [
    "png",
    "xyzw",
    "texcoord",
    "texture",
    "trit",
    "cull",
    "decals",
    "clipplane",
    "frustum",
];

/// Tells the format from the file's ending and its text, and where it shows. The first line that only one format
/// could have decides; a text without one is HW2.
pub fn detect(file: &Path, text: &[u8]) -> (Format, Place) {
    let start = Place { line: 1, column: 1 };
    let ending = file.extension().and_then(|ending| ending.to_str());
    if ending.is_some_and(|ending| ending.eq_ignore_ascii_case("obj")) {
        return (Format::Obj, start);
    }
    let unmarked = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
    if unmarked.starts_with(b"#Inventor") {
        return (Format::Iv, start);
    }
    for line in lex::lines(text) {
        // A text that is not UTF-8 gets its fault from a parser.
        let Ok(line) = line else { break };
        let word = line.keyword.text;
        if ONLY_HW2.contains(&word) {
            return (Format::Hw2, line.keyword.place);
        }
        if ONLY_MP1.contains(&word) {
            return (Format::Mp1, line.keyword.place);
        }
        let mut words = std::iter::once(line.keyword).chain(line.arguments);
        let brace = words.find(|token| token.text.contains('{'));
        if let Some(token) = brace.filter(|_| !SHARED.contains(&word)) {
            return (Format::Iv, token.place);
        }
    }
    (Format::Hw2, start)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(file: &str, text: &str) -> Format {
        detect(Path::new(file), text.as_bytes()).0
    }

    #[test]
    fn the_first_telling_keyword_decides() {
        assert_eq!(told("a.txt", ""), Format::Hw2);
        assert_eq!(told("a.txt", "png 1 1 a\ncull\n"), Format::Hw2);
        assert_eq!(told("a.txt", "png 1 1 a\nxyz 1 2 3\ntri 1 2 3\n"), Format::Hw2);
        assert_eq!(told("a.txt", "png 1 1 a\r\nsRGB\r\n"), Format::Mp1);
        assert_eq!(
            told("a.txt", "png 1 1 a\nxyzw 1 2 3 4\n tri 1 2 3\nxyz 1 2 3\n"),
            Format::Mp1
        );
        assert_eq!(told("a.txt", "png 1 1 a{b}.png\nhyp"), Format::Mp1);
        assert_eq!(told("a.txt", "#Inventor V2.0 ascii\n"), Format::Iv);
        assert_eq!(told("a.txt", "# a\nSeparator{\n"), Format::Iv);
        assert_eq!(told("a.txt", "Separator\n{\n"), Format::Iv);
        assert_eq!(told("a.txt", "what is this\nxyz"), Format::Hw2);
        assert_eq!(told("cube.OBJ", "v 1 2 3"), Format::Obj);
    }

    #[test]
    fn the_lists_are_the_grammars() {
        let known = |keyword: &str| {
            let text = format!("png 1 1 a.png\n{keyword} x x x x x x x");
            let fault = crate::scene::hw2::parse_with(text.as_bytes(), &mut |_| Ok(()));
            !fault.is_err_and(|fault| fault.message.contains("not an HW2 keyword"))
        };
        assert!(ONLY_HW2.into_iter().chain(SHARED).all(known));
        assert!(!ONLY_MP1.into_iter().any(known));
    }
}
