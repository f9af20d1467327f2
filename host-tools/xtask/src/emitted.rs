//! `cargo xtask emitted`: emitted scenes on the board draw the bytes of `host-render`, and take what was estimated; so do
//! emitted meshes.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::{env, fs};

use fixel_host::args::Args;
use fixel_host::emit::harness::ShownMesh;
use fixel_host::emit::mesh::Mesh;
use fixel_host::emit::{Depth, Emitted, emit, harness};
use fixel_host::load::load;
use fixel_host::scene::iv::Shading;
use fixel_host::scene::obj;
use fixel_host::scene::size::Size;

use crate::board::{Board, M4};
use crate::failure::Failure;
use crate::outcome::{Outcome, find};
use crate::toolchain::Toolchain;
use crate::{emulator, flash, image};

/// Scenes in one image: as many as its flash holds.
const AT_ONCE: usize = 16;

/// What is executed may be so many times what is estimated, or as much less.
const WITHIN: u64 = 2;

/// Of which there is no file: a mesh that needs no depth buffer.
const OCTAHEDRON: &str = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
    f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";

/// The board with the package of the image.
const BOARD: Board = Board {
    package: "fixel-emitted",
    ..M4
};

/// Emits, builds, runs and compares.
pub fn run(scenes: Vec<PathBuf>, size: &str) -> Result<(), Failure> {
    let are_all = scenes.is_empty();
    let files = if are_all { all()? } else { scenes };
    let toolchain = Toolchain::find(BOARD.target)?;
    let (mut off, mut far) = (Vec::new(), Vec::new());
    println!(
        "{:<24}{:>10}{:>8}{:>8}{:>14}{:>14}{:>7}  bytes",
        "scene", "data", "code ~", "depth", "instructions", "estimated", "ratio"
    );
    for files in files.chunks(AT_ONCE) {
        let emitted = files
            .iter()
            .map(|file| Ok((file.display().to_string(), one(file, size)?)))
            .collect::<Result<Vec<_>, Failure>>()?;
        let named: Vec<_> = emitted
            .into_iter()
            .zip(0..)
            .map(|((file, e), i)| (file, (format!("s{i}"), e)))
            .collect();
        let (names, scenes): (Vec<String>, Vec<_>) = named.into_iter().unzip();
        let outcomes = draw(&toolchain, &scenes, &[])?;
        for (file, (name, emitted)) in names.iter().zip(&scenes) {
            let outcome = find(&outcomes, name);
            let needs = &emitted.requirements;
            let line = Checked::new(
                outcome,
                crc32(emitted.bytes.as_flattened()),
                needs.instructions_in_strips,
            );
            line.print(
                &Path::new(file).file_stem().unwrap_or_default().to_string_lossy(),
                needs.data,
                needs.code,
                needs.depth == Depth::Needed,
            );
            line.complain(file, &mut off, &mut far);
        }
    }
    let meshes = meshes(size)?;
    let outcomes = draw(&toolchain, &[], &meshes)?;
    for (name, _, mesh) in &meshes {
        let Some((frame, estimate)) = &mesh.frame else {
            return Err(Failure::Usage(format!("{size}: more than 4096 pixels a side")));
        };
        let bytes: Vec<_> = frame.pixels.iter().flat_map(|pixel| pixel.to_le_bytes()).collect();
        let line = Checked::new(find(&outcomes, name), crc32(&bytes), *estimate);
        line.print(name, mesh.data as u64, mesh.code as u64, mesh.depth);
        line.complain(name, &mut off, &mut far);
    }
    println!(
        "{} scenes and {} meshes on {}, {} differ, {} more than {WITHIN} times off the estimate",
        files.len(),
        meshes.len(),
        BOARD.core,
        off.len(),
        far.len()
    );
    off.extend(far);
    if are_all {
        off.extend(flash::check(&BOARD, &toolchain, meshes)?);
    }
    if off.is_empty() {
        Ok(())
    } else {
        Err(Failure::Off(off.join("\n")))
    }
}

/// Builds an image of these and runs it.
fn draw(toolchain: &Toolchain, scenes: &[(String, Emitted)], meshes: &[ShownMesh]) -> Result<Vec<Outcome>, Failure> {
    let text = harness::file(scenes) + &harness::meshes(meshes);
    let built = image::build(&BOARD, toolchain, image::EMITTED, text.as_bytes())?;
    Outcome::parse_all(&emulator::run(&BOARD, &built)?)
}

/// The project's mesh, and one that is convex, in both shadings, each compact too.
fn meshes(size: &str) -> Result<Vec<ShownMesh>, Failure> {
    let size: Size = size.parse().map_err(Failure::Usage)?;
    let sides = (size.width() as u16, size.height() as u16);
    let file = image::root().join("tests/scenes/vase.obj");
    let vase = fs::read_to_string(&file).map_err(|e| Failure::trouble(file.display(), e))?;
    let mut meshes = Vec::new();
    for (name, text) in [("octahedron", OCTAHEDRON), ("vase", vase.as_str())] {
        for shading in [Shading::Flat, Shading::Gouraud] {
            let trouble = |fault| Failure::trouble(name, fault);
            let mesh = Mesh::new(&obj::parse(text, size).map_err(trouble)?, shading).map_err(trouble)?;
            for (mesh, kind) in [(mesh.clone(), ""), (mesh.compact(), "_compact")] {
                let emitted = mesh.emit("cargo xtask emitted", (size.width(), size.height()));
                meshes.push((format!("{name}_{shading:?}{kind}").to_lowercase(), sides, emitted));
            }
        }
    }
    Ok(meshes)
}

/// One scene, emitted in this size if it has none of its own.
fn one(file: &Path, size: &str) -> Result<Emitted, Failure> {
    if file.extension().is_none_or(|ending| ending != "txt") {
        emitted(file, &["--size", size])
    } else {
        emitted(file, &[])
    }
}

/// One scene, emitted with further words on the command line.
pub fn emitted(file: &Path, further: &[&str]) -> Result<Emitted, Failure> {
    let mut words = vec!["host-render".into(), file.as_os_str().to_owned()];
    words.extend(further.iter().map(OsString::from));
    let args = Args::from(words).map_err(|e| Failure::Usage(e.to_string()))?;
    let loaded = load(file, &args).map_err(|refused| Failure::Trouble(refused.failure.message))?;
    emit(&loaded.scene, "cargo xtask emitted").map_err(|fault| Failure::trouble(file.display(), fault))
}

/// What a picture came to on the board, and what it should have.
struct Checked {
    same: bool,
    instructions: u64,
    estimate: u64,
}

impl Checked {
    fn new(outcome: Option<&Outcome>, wanted: u32, estimate: u64) -> Self {
        Checked {
            same: outcome.is_some_and(|outcome| outcome.color == wanted),
            instructions: outcome.map_or(0, |outcome| outcome.instructions.into()),
            estimate,
        }
    }

    /// Whether the estimate is no more than [`WITHIN`] times off.
    fn is_near(&self) -> bool {
        self.instructions <= WITHIN * self.estimate && self.estimate <= WITHIN * self.instructions
    }

    /// A line of the table.
    fn print(&self, name: &str, data: u64, code: u64, depth: bool) {
        println!(
            "{name:<24}{data:>10}{:>8}{:>8}{:>14}{:>14}{:>7.2}  {}{}",
            if code > 0 { code.to_string() } else { "-".into() },
            if depth { "yes" } else { "no" },
            self.instructions,
            self.estimate,
            self.estimate as f64 / self.instructions as f64,
            if self.same { "same" } else { "DIFFER" },
            if self.is_near() { "" } else { ", FAR OFF" }
        );
    }

    fn complain(&self, name: &str, off: &mut Vec<String>, far: &mut Vec<String>) {
        let Checked {
            instructions, estimate, ..
        } = self;
        if !self.same {
            off.push(format!("{name}: other bytes on the board than on the desktop"));
        }
        if !self.is_near() {
            far.push(format!(
                "{name}: {instructions} instructions, estimated {estimate}: more than {WITHIN} times off"
            ));
        }
    }
}

/// The project's own scenes and, where they are at hand, the official ones.
fn all() -> Result<Vec<PathBuf>, Failure> {
    let mut folders = vec![image::root().join("tests/scenes")];
    match env::var_os("FIXEL_CONFORMANCE") {
        Some(folder) => folders.extend(["hw2", "mp1"].map(|name| Path::new(&folder).join(name))),
        None => println!("FIXEL_CONFORMANCE names no folder: only the scenes of tests/scenes are drawn"),
    }
    let mut files = Vec::new();
    for folder in folders {
        let entries = fs::read_dir(&folder).map_err(|e| Failure::trouble(folder.display(), e))?;
        let mut found: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        found.retain(|file| file.extension().is_some_and(|e| e == "txt" || e == "iv" || e == "obj"));
        found.sort();
        files.extend(found);
    }
    Ok(files)
}

/// CRC-32.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg())
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_the_common_one() {
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
    }

    #[test]
    fn an_estimate_is_judged_in_both_directions() {
        let near = |instructions, estimate| {
            let checked = Checked {
                same: true,
                instructions,
                estimate,
            };
            checked.is_near()
        };
        assert!(near(100, 200) && near(100, 50) && near(100, 100));
        assert!(!near(100, 201) && !near(100, 49) && !near(0, 100));
    }
}
