//! Which format a text is in.

use std::fmt;
use std::path::Path;

use super::lex;

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

/// Tells the format from the file's ending and its text. The first line that only one format could have decides; a text
/// without one is HW2, or Inventor if its file's ending says so and no word of HW2 is in it.
pub fn detect(file: &Path, text: &[u8]) -> Format {
    let ends_in = |what: &str| file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(what));
    if ends_in("obj") {
        return Format::Obj;
    }
    let mut otherwise = if ends_in("iv") { Format::Iv } else { Format::Hw2 };
    let unmarked = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
    if unmarked.starts_with(b"#Inventor") {
        return Format::Iv;
    }
    for line in lex::lines(text) {
        // A text that is not UTF-8 gets its fault from a parser.
        let Ok(line) = line else { break };
        let word = line.keyword.text;
        if ONLY_HW2.contains(&word) {
            return Format::Hw2;
        }
        if ONLY_MP1.contains(&word) {
            return Format::Mp1;
        }
        let mut words = std::iter::once(line.keyword).chain(line.arguments);
        if SHARED.contains(&word) {
            otherwise = Format::Hw2;
        } else if words.any(|token| token.text.contains('{')) {
            return Format::Iv;
        }
    }
    otherwise
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(file: &str, text: &str) -> Format {
        detect(Path::new(file), text.as_bytes())
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
        assert_eq!(told("a.iv", "# nothing\n"), Format::Iv);
        assert_eq!(told("a.iv", "Separator\n"), Format::Iv);
        assert_eq!(told("a.iv", "png 1 1 a\n# nothing\n"), Format::Hw2);
        assert_eq!(told("a.iv", "png 1 1 a\nsRGB\n"), Format::Mp1);
        assert_eq!(told("a.txt", "what is this\nxyz"), Format::Hw2);
        assert_eq!(told("cube.OBJ", "v 1 2 3"), Format::Obj);
    }

    #[test]
    fn the_lists_are_the_grammars() {
        let text = |keyword: &str| format!("png 1 1 a.png\n{keyword} x x x x x x x");
        let hw2 = |keyword: &str| {
            let fault = crate::scene::hw2::parse_with(text(keyword).as_bytes(), &mut |_| Ok(()));
            !fault.is_err_and(|fault| fault.message.contains("not an HW2 keyword"))
        };
        let mp1 = |keyword: &str| {
            let fault = crate::scene::mp1::parse_with(text(keyword).as_bytes(), &mut |_| Err(String::new()));
            !fault.is_err_and(|fault| fault.message.contains("not an MP1 keyword"))
        };
        assert!(ONLY_HW2.into_iter().chain(SHARED).all(hw2));
        assert!(!ONLY_MP1.into_iter().any(hw2));
        assert!(ONLY_MP1.into_iter().chain(SHARED).all(mp1));
        assert!(!ONLY_HW2.into_iter().any(mp1));
    }
}
