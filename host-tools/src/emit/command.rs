//! `host-render emit`: the scene as data and a draw function for firmware.

use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use clap::Parser;

use super::emit;
use super::mesh::{EmittedMesh, Mesh};
use crate::args::Args;
use crate::exit::{Exit, Failure};
use crate::files;
use crate::load::{Loaded, load};
use crate::scene::Scene;
use crate::scene::format::Format;
use crate::scene::iv::Shading;
use crate::scene::size::Size;

/// Writes a scene as Rust: its data, and a function that draws it with `fixel`, as few features as it takes.
#[derive(Debug, Clone, Parser)]
#[command(
    name = "host-render emit",
    bin_name = "host-render emit",
    version,
    after_help = "Exit codes: 0 written, 2 bad scene or bad usage, 3 file trouble, 4 internal error."
)]
pub struct Command {
    /// Scene file
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,

    /// The Rust file to write
    #[arg(short, long, value_name = "FILE.rs")]
    pub output: PathBuf,

    /// Format of the scene [default: told from the text]
    #[arg(long, value_enum)]
    pub format: Option<Format>,

    /// Size of the picture, of iv and OBJ scenes [default: 500x500]
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,

    /// How faces get their colours, of iv and OBJ scenes [default: gouraud]
    #[arg(long, value_enum)]
    pub shading: Option<Shading>,

    /// Add a dim light at the camera, to iv and OBJ scenes
    #[arg(long)]
    pub eyelight: bool,

    /// The mesh of an OBJ file instead of a picture of it: place and light are left to the firmware
    #[arg(long, conflicts_with = "eyelight")]
    pub mesh: bool,

    /// A mesh drawn by a sixth to two fifths less code, in up to a fifth more instructions
    #[arg(long, requires = "mesh")]
    pub compact: bool,
}

/// What was written: the lines that are told of it.
struct Written(Vec<String>);

impl Command {
    /// The words of this command line below `emit`, if it is one.
    pub fn asked() -> Option<Self> {
        let mut words = std::env::args_os();
        let program = words.next()?;
        if words.next()? != "emit" {
            return None;
        }
        Some(Self::parse_from(std::iter::once(program).chain(words)))
    }

    /// Does what it says and tells how it went.
    pub fn run(&self) -> Exit {
        let done = catch_unwind(AssertUnwindSafe(|| self.write()))
            .unwrap_or_else(|payload| Err(Failure::panic(&self.scene, payload.as_ref())));
        match done {
            Ok(written) => print(&written),
            Err(failure) => {
                // If standard error is gone, there is nobody to tell; the exit code still does.
                let _ = writeln!(io::stderr(), "{}", failure.message);
                failure.exit
            }
        }
    }

    fn write(&self) -> Result<Written, Failure> {
        let args = Args::of_scene(self.scene.clone(), self.format, self.size, self.shading, self.eyelight);
        let loaded = load(&self.scene, &args)?;
        let inputs = loaded.textures().chain(std::iter::once(self.scene.clone()));
        let output = files::identity(&self.output);
        if output.is_some() && inputs.into_iter().any(|input| files::identity(&input) == output) {
            return Err(Failure::bad(format!(
                "{}: its output {} would overwrite the scene or a texture",
                self.scene.display(),
                self.output.display()
            )));
        }
        let (text, lines) = self.emitted(&loaded)?;
        files::stage(&self.output, text.into_bytes())?.commit()?;
        Ok(Written(lines))
    }

    /// The file, and what is told of it.
    fn emitted(&self, loaded: &Loaded) -> Result<(String, Vec<String>), Failure> {
        let failure = |fault| Failure::scene(&self.scene, &fault);
        if self.mesh {
            let (Format::Obj, Scene::Iv(scene)) = (loaded.format, &loaded.scene) else {
                let message = format!(
                    "{}: --mesh is for OBJ files, this one is {}",
                    self.scene.display(),
                    loaded.format
                );
                return Err(Failure::bad(message));
            };
            if self.shading == Some(Shading::Phong) {
                let message = "--mesh takes --shading flat or gouraud: phong is for a fragment program of your own";
                return Err(Failure::bad(message));
            }
            let mut mesh = Mesh::new(&scene.model, scene.shading).map_err(failure)?;
            if self.compact {
                mesh = mesh.compact();
            }
            let EmittedMesh { text, lines, .. } = mesh.emit(&self.origin(), (scene.width, scene.height));
            return Ok((text, lines));
        }
        let emitted = emit(&loaded.scene, &self.origin()).map_err(failure)?;
        Ok((emitted.text, emitted.requirements.lines()))
    }

    /// The command as it would be typed in the scene's folder; whatever the names hold, one line.
    fn origin(&self) -> String {
        let name = |file: &Path| typed(&file.file_name().unwrap_or_default().to_string_lossy());
        let mut origin = format!("host-render emit {} -o {}", name(&self.scene), name(&self.output));
        if let Some(format) = self.format {
            origin += &format!(" --format {format}");
        }
        if let Some(size) = self.size {
            origin += &format!(" --size {}x{}", size.width(), size.height());
        }
        if let Some(shading) = self.shading {
            origin += &format!(" --shading {}", format!("{shading:?}").to_lowercase());
        }
        if self.eyelight {
            origin += " --eyelight";
        }
        if self.mesh {
            origin += " --mesh";
        }
        if self.compact {
            origin += " --compact";
        }
        origin
    }
}

/// A name as one would type it. What cannot be typed is escaped, so that it stays in the comment's line.
fn typed(name: &str) -> String {
    let plain = |c: char| matches!(c, '\\' | '\'' | '"') || c.escape_debug().len() == 1;
    let name = if name.chars().all(plain) {
        name.to_owned()
    } else {
        name.escape_debug().to_string()
    };
    // Only a zero byte cannot be quoted, and that is escaped.
    shlex::try_quote(&name)
        .map(|name| name.into_owned())
        .unwrap_or_default()
}

fn print(Written(lines): &Written) -> Exit {
    let mut out = io::stdout().lock();
    let printed = lines
        .iter()
        .try_for_each(|line| writeln!(out, "{line}"))
        .and_then(|()| out.flush());
    match printed {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            let _ = writeln!(io::stderr(), "cannot write to standard output: {error}");
            Exit::Files
        }
        _ => Exit::Within,
    }
}

#[cfg(test)]
mod tests {
    use super::typed;

    #[test]
    fn names_are_typed_as_a_shell_reads_them() {
        for (name, expected) in [
            ("scene.txt", "scene.txt"),
            ("my scene.txt", "'my scene.txt'"),
            ("it's.txt", "\"it's.txt\""),
            ("a\\b.txt", r#""a\\b.txt""#),
            ("a\nfn main() {}", r#""a\\nfn main() {}""#),
            ("a\u{202e}b", r#""a\\u{202e}b""#),
            ("a\0b", r#""a\\0b""#),
        ] {
            assert_eq!(typed(name), expected, "{name:?}");
        }
    }
}
