//! Scenes: what a text says, typed, each command with its place in the text.
//!
//! ```text
//! bytes -> lex (lines, tokens) -> arguments (numbers, indices, names) -> hw2, mp1 (the grammars) -> Scene
//!                                 header (png), textures
//! ```
//!
//! Inventor text knows no lines: `iv` has a lexer and a parser of its own. `obj` makes a mesh an Inventor scene. Neither
//! format says how large its picture is: that is the command line's [`size`].
//!
//! A [`Scene`] is valid by construction: whoever holds one need not check a range, an index or a file name again.

use std::fmt;

pub mod arguments;
pub mod format;
pub mod header;
pub mod hw2;
pub mod iv;
pub mod lex;
pub mod mp1;
pub mod names;
pub mod obj;
pub mod size;
pub mod textures;

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
    /// Whether it is the text as a whole that is wrong, for something it lacks; then `place` is its beginning, and not
    /// worth printing.
    pub whole: bool,
}

impl Fault {
    /// A fault of the token at `place`.
    pub fn new(place: Place, message: impl Into<String>) -> Self {
        Self {
            place,
            message: message.into(),
            whole: false,
        }
    }

    /// A fault of the text as a whole.
    pub fn of_whole(message: impl Into<String>) -> Self {
        Self {
            whole: true,
            ..Self::new(Place { line: 1, column: 1 }, message)
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
    /// Points in clip coordinates.
    Mp1(mp1::Scene),
    /// Convex faces, point lights, a camera; also what a Wavefront mesh becomes.
    Iv(iv::Scene),
}

impl Scene {
    /// Width and height of the picture in pixels, 1 to 16384 each; at most 2^26 pixels in all.
    pub fn size(&self) -> (u32, u32) {
        match self {
            Self::Hw2(scene) => (scene.width, scene.height),
            Self::Mp1(scene) => (scene.width, scene.height),
            Self::Iv(scene) => (scene.width, scene.height),
        }
    }

    /// Samples per pixel in each direction.
    pub fn fsaa(&self) -> u32 {
        match self {
            Self::Mp1(scene) => scene.switches.fsaa,
            Self::Hw2(_) | Self::Iv(_) => 1,
        }
    }

    /// The picture's file name, as the scene or its own name suggests it; relative, inside the folder.
    pub fn output(&self) -> &str {
        match self {
            Self::Hw2(scene) => &scene.output,
            Self::Mp1(scene) => &scene.output,
            Self::Iv(scene) => &scene.output,
        }
    }

    /// The texture files it names, relative to its folder.
    pub fn textures(&self) -> impl Iterator<Item = &str> {
        let textures = match self {
            Self::Hw2(scene) => Some(&scene.textures),
            Self::Mp1(scene) => Some(&scene.textures),
            Self::Iv(_) => None,
        };
        textures.into_iter().flatten().map(|(name, _)| name.as_str())
    }
}
