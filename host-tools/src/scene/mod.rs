//! Scenes: what a text says, typed, each command with its place in the text.
//!
//! ```text
//! bytes -> lex (lines, tokens) -> arguments (numbers, indices, names) -> hw2, mp1 (the grammars) -> Scene
//! ```
//!
//! A [`Scene`] is valid by construction: whoever holds one need not check a range, an index or a file name again.

use std::fmt;

pub mod arguments;
pub mod format;
pub mod hw2;
pub mod lex;
pub mod mp1;
pub mod names;

/// The longest side of a picture or texture, in pixels.
pub const LONGEST_SIDE: u32 = 1 << 14;
/// The most pixels of a picture, and of all textures of a scene together.
pub const MOST_PIXELS: u64 = 1 << 26;

/// Where something stands in a text, both counted from 1; columns count characters, a tab is one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

/// What is wrong with a scene, and where. It prints as `line L, column C: message`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The offending token.
    pub place: Place,
    /// What is wrong and what was expected, one line.
    pub message: String,
}

impl Fault {
    /// A fault of the token at `place`.
    pub fn new(place: Place, message: impl Into<String>) -> Self {
        Self {
            place,
            message: message.into(),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

impl std::error::Error for Fault {}

/// A valid scene of any format.
#[derive(Debug, Clone, PartialEq)]
pub enum Scene {
    /// Points, matrices, lights, patches.
    Hw2(hw2::Scene),
}

impl Scene {
    /// Width and height of the picture in pixels, 1 to 16384 each; at most 2^26 pixels in all.
    pub fn size(&self) -> (u32, u32) {
        match self {
            Self::Hw2(scene) => (scene.width, scene.height),
        }
    }

    /// The picture's file name, as the scene suggests it; relative, inside the folder.
    pub fn output(&self) -> &str {
        match self {
            Self::Hw2(scene) => &scene.output,
        }
    }

    /// The texture files it names, relative to its folder.
    pub fn textures(&self) -> impl Iterator<Item = &str> {
        let textures = match self {
            Self::Hw2(scene) => &scene.textures,
        };
        textures.keys().map(String::as_str)
    }
}
