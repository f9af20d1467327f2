//! `cargo xtask emitted`: emitted scenes on the board draw the bytes of `host-render`, and what that takes.

use std::path::{Path, PathBuf};
use std::{env, fs};

use fixel_host::args::Args;
use fixel_host::emit::{Emitted, emit, harness};
use fixel_host::load::load;

use crate::board::{Board, M4};
use crate::failure::Failure;
use crate::outcome::{Outcome, find};
use crate::toolchain::Toolchain;
use crate::{emulator, image};

/// Scenes in one image: as many as its flash holds.
const AT_ONCE: usize = 16;

/// The board with the package of the image.
const BOARD: Board = Board {
    package: "fixel-emitted",
    ..M4
};

/// Emits, builds, runs and compares.
pub fn run(scenes: Vec<PathBuf>, size: &str) -> Result<(), Failure> {
    let files = if scenes.is_empty() { all()? } else { scenes };
    let toolchain = Toolchain::find(BOARD.target)?;
    let mut differing = Vec::new();
    println!(
        "{:<24}{:>10}{:>8}{:>8}{:>14}{:>14}  bytes",
        "scene", "data", "code ~", "depth", "instructions", "estimated"
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
        let built = image::build(&BOARD, &toolchain, image::EMITTED, harness::file(&scenes).as_bytes())?;
        let outcomes = Outcome::parse_all(&emulator::run(&BOARD, &built)?)?;
        for (file, (name, emitted)) in names.iter().zip(&scenes) {
            let outcome = find(&outcomes, name);
            if !report(file, emitted, outcome) {
                differing.push(format!("{file}: other bytes on the board than on the desktop"));
            }
        }
    }
    println!("{} scenes on {}, {} differ", files.len(), BOARD.core, differing.len());
    if differing.is_empty() {
        Ok(())
    } else {
        Err(Failure::Off(differing.join("\n")))
    }
}

/// One scene, emitted.
fn one(file: &Path, size: &str) -> Result<Emitted, Failure> {
    let mut words = vec!["host-render".into(), file.as_os_str().to_owned()];
    if file.extension().is_none_or(|ending| ending != "txt") {
        words.extend(["--size".into(), size.into()]);
    }
    let args = Args::from(words).map_err(|e| Failure::Usage(e.to_string()))?;
    let loaded = load(file, &args).map_err(|failure| Failure::Trouble(failure.message))?;
    emit(&loaded.scene, "cargo xtask emitted").map_err(|fault| Failure::trouble(file.display(), fault))
}

/// A line of the table; whether the bytes are the same.
fn report(file: &str, emitted: &Emitted, outcome: Option<&Outcome>) -> bool {
    let wanted = crc32(emitted.bytes.as_flattened());
    let same = outcome.is_some_and(|outcome| outcome.color == wanted);
    let instructions = outcome.map_or(0, |outcome| outcome.instructions);
    let name = Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
    let needs = &emitted.requirements;
    println!(
        "{name:<24}{:>10}{:>8}{:>8}{instructions:>14}{:>14}  {}",
        needs.data,
        needs.code,
        if needs.depth == fixel_host::emit::Depth::Needed {
            "yes"
        } else {
            "no"
        },
        needs.instructions_in_strips,
        if same { "same" } else { "DIFFER" }
    );
    same
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
    use super::crc32;

    #[test]
    fn the_checksum_is_the_common_one() {
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
    }
}
