//! What emitted scenes and meshes take in flash, each in an image of its own, beside what was estimated.

use std::fs;

use fixel_host::emit::harness::ShownMesh;
use fixel_host::emit::{Emitted, harness};

use crate::board::Board;
use crate::elf::Elf;
use crate::emitted::emitted;
use crate::failure::Failure;
use crate::image;
use crate::toolchain::Toolchain;

/// Scenes of `tests/scenes`, and further words of the command line: of every kind of shape, varying and program some.
const ALONE: [(&str, &[&str]); 9] = [
    ("tribezf.txt", &[]),
    ("drawn.txt", &[]),
    ("texture.txt", &[]),
    ("prisms.txt", &[]),
    ("flatnormals.txt", &[]),
    ("mp1-smooth.txt", &[]),
    ("mp1-cut.txt", &[]),
    ("nested.iv", &["--size", "60x40"]),
    ("nested.iv", &["--size", "60x40", "--shading", "phong"]),
];

/// What is there may be a quarter more or less than what is estimated: the numbers of the estimate are few, and kinds share code.
fn is_near(bytes: u64, estimate: u64) -> bool {
    bytes.abs_diff(estimate) * 4 <= bytes
}

/// Builds, prints and compares; what is too far off.
pub fn check(board: &Board, toolchain: &Toolchain, meshes: Vec<ShownMesh>) -> Result<Vec<String>, Failure> {
    let size = |scenes: &[_], meshes: &[_]| code_size(board, toolchain, scenes, meshes);
    let none = size(&[("nothing".to_owned(), nothing()?)], &[])?;
    let mut far = Vec::new();
    println!("{:<32}{:>10}{:>12}{:>7}", "flash", "bytes", "estimated", "ratio");
    let mut compare = |title: &str, bytes: u64, estimate: u64| {
        println!(
            "{title:<32}{bytes:>10}{estimate:>12}{:>7.2}",
            estimate as f64 / bytes as f64
        );
        if !is_near(bytes, estimate) {
            far.push(format!(
                "{title}: {bytes} bytes of flash, estimated {estimate}: more than a quarter off"
            ));
        }
    };
    for (name, words) in ALONE {
        let scene = emitted(&image::root().join("tests/scenes").join(name), words)?;
        let estimate = scene.requirements.data + scene.requirements.code;
        let bytes = size(&[("scene".to_owned(), scene)], &[])?.saturating_sub(none);
        let title: Vec<_> = [name].iter().chain(words.iter().skip(2)).copied().collect();
        compare(&title.join(" "), bytes, estimate);
    }
    for mesh in meshes {
        let (title, estimate) = (mesh.0.clone(), (mesh.2.data + mesh.2.code) as u64);
        let bytes = size(&[], &[mesh])?.saturating_sub(none);
        compare(&title, bytes, estimate);
    }
    Ok(far)
}

/// A scene that draws nothing.
fn nothing() -> Result<Emitted, Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::trouble("temporary folder", e))?;
    let file = folder.path().join("nothing.txt");
    fs::write(&file, "png 8 8 nothing.png\n").map_err(|e| Failure::trouble(file.display(), e))?;
    emitted(&file, &[])
}

/// Bytes in flash of an image that draws these.
fn code_size(
    board: &Board,
    toolchain: &Toolchain,
    scenes: &[(String, Emitted)],
    meshes: &[ShownMesh],
) -> Result<u64, Failure> {
    let text = harness::file(scenes) + &harness::meshes(meshes);
    let built = image::build(board, toolchain, image::EMITTED, text.as_bytes())?;
    let bytes = fs::read(&built).map_err(|e| Failure::trouble(built.display(), e))?;
    let elf = Elf::parse(&bytes).ok_or_else(|| Failure::Trouble(format!("{}: not an image", built.display())))?;
    Ok(elf.code_size() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_estimate_is_judged_in_both_directions() {
        assert!(is_near(100, 75) && is_near(100, 125));
        assert!(!is_near(100, 74) && !is_near(100, 126));
    }
}
