//! From a file to a valid scene.

use std::path::{Path, PathBuf};

use crate::exit::Failure;
use crate::files;
use crate::scene::format::{self, Format};
use crate::scene::{Fault, Place, Scene, hw2};

/// A scene and where it came from.
#[derive(Debug)]
pub struct Loaded {
    /// The file, as the user named it.
    pub file: PathBuf,
    /// Its format.
    pub format: Format,
    /// What it says.
    pub scene: Scene,
}

impl Loaded {
    /// The texture files it reads.
    pub fn textures(&self) -> impl Iterator<Item = PathBuf> {
        self.scene.textures().map(|name| folder(&self.file).join(name))
    }
}

/// Reads and parses a scene, in the given format or the one its text tells.
pub fn load(file: &Path, given: Option<Format>) -> Result<Loaded, Failure> {
    let text = files::read(file)?;
    let (format, place) = match given {
        Some(format) => (format, Place { line: 1, column: 1 }),
        None => format::detect(file, &text),
    };
    let parsed = match format {
        Format::Hw2 => hw2::parse(&text, folder(file)).map(Scene::Hw2),
        other => Err(Fault::new(place, format!("format {other} is not supported yet"))),
    };
    match parsed {
        Ok(scene) => Ok(Loaded {
            file: file.to_owned(),
            format,
            scene,
        }),
        Err(fault) => Err(Failure::scene(file, &fault)),
    }
}

/// The scene's folder, which its textures are relative to.
fn folder(file: &Path) -> &Path {
    file.parent().unwrap_or(Path::new(""))
}
