//! From a file to a valid scene.

use std::path::{Path, PathBuf};

use crate::args::Args;
use crate::exit::Failure;
use crate::files;
use crate::scene::format::{self, Format};
use crate::scene::iv::{self, Model, Shading};
use crate::scene::size::Size;
use crate::scene::{Scene, hw2, mp1, obj, textures};

/// A scene and where it came from.
#[derive(Debug)]
pub struct Loaded {
    /// The file, as the user named it.
    pub file: PathBuf,
    /// Its format.
    pub format: Format,
    /// Its text.
    pub text: Vec<u8>,
    /// What it says.
    pub scene: Scene,
}

impl Loaded {
    /// The texture files it reads.
    pub fn textures(&self) -> impl Iterator<Item = PathBuf> {
        self.scene.textures().map(|name| folder(&self.file).join(name))
    }
}

/// A file that is no scene we can draw.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused {
    /// Why.
    pub failure: Failure,
    /// The texture files that its text names.
    pub textures: Vec<PathBuf>,
}

impl From<Failure> for Refused {
    /// What failed before there was a text.
    fn from(failure: Failure) -> Self {
        Self {
            failure,
            textures: Vec::new(),
        }
    }
}

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Self {
        refused.failure
    }
}

/// Reads and parses a scene, in the format that the command line or else its text tells.
pub fn load(file: &Path, args: &Args) -> Result<Loaded, Refused> {
    let text = files::read(file).map_err(Failure::from)?;
    match parse(file, &text, args) {
        Ok((format, scene)) => Ok(Loaded {
            file: file.to_owned(),
            format,
            text,
            scene,
        }),
        Err(failure) => {
            let names = textures::named(&text).into_iter();
            let textures = names.map(|name| folder(file).join(name)).collect();
            Err(Refused { failure, textures })
        }
    }
}

fn parse(file: &Path, text: &[u8], args: &Args) -> Result<(Format, Scene), Failure> {
    let format = args.format.unwrap_or_else(|| format::detect(file, text));
    if let (Format::Hw2 | Format::Mp1, Some(option)) = (format, args.view_option()) {
        let message = format!(
            "{}: {option} is for iv and obj scenes, this one is {format}",
            file.display()
        );
        return Err(Failure::bad(message));
    }
    let size = args.size.unwrap_or(Size::DEFAULT);
    let parsed = match format {
        Format::Hw2 => hw2::parse(text, folder(file)).map(Scene::Hw2),
        Format::Mp1 => mp1::parse(text, folder(file)).map(Scene::Mp1),
        Format::Iv => iv::parse(text).map(|model| viewed(model, size, file, args)),
        Format::Obj => obj::parse(text, size).map(|model| viewed(model, size, file, args)),
    };
    match parsed {
        Ok(scene) => Ok((format, scene)),
        Err(fault) => Err(Failure::scene(file, &fault)),
    }
}

/// A model with what only the command line says of its picture; the picture is called what the file is.
fn viewed(model: Model, size: Size, file: &Path, args: &Args) -> Scene {
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    Scene::Iv(iv::Scene {
        width: size.width(),
        height: size.height(),
        output: format!("{name}.png"),
        shading: args.shading.unwrap_or(Shading::Gouraud),
        eyelight: args.eyelight,
        model,
    })
}

/// The scene's folder, which its textures are relative to.
fn folder(file: &Path) -> &Path {
    file.parent().unwrap_or(Path::new(""))
}
