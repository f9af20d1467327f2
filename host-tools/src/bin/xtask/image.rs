//! Building images.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use crate::board::Board;
use crate::failure::Failure;
use crate::toolchain::Toolchain;

/// The root of the project.
pub fn root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here)
}

/// Where bare-metal builds go: apart from the host's, which have another compiler's library.
pub fn target_dir() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| root().join("target"), PathBuf::from)
        .join("bare-metal")
}

/// Builds the image `name` for `board` with `workloads` in it; the file to run.
pub fn build(board: &Board, toolchain: &Toolchain, name: &str, workloads: &[u8]) -> Result<PathBuf, Failure> {
    let directory = std::path::absolute(target_dir()).map_err(|e| Failure::trouble("target directory", e))?;
    let file = directory.join("workloads.bin");
    write_if_new(&file, workloads)?;
    let mut cargo = toolchain.cargo_build(&directory);
    cargo.args(["--release", "--package", board.package, "--bin", name]);
    cargo.current_dir(root().join("firmware")).env("FIXEL_WORKLOADS", &file);
    run(&mut cargo, &format!("building {name} for {}", board.target))?;
    Ok(directory.join(board.target).join("release").join(name))
}

/// Runs a build to its end.
pub fn run(command: &mut Command, what: &str) -> Result<(), Failure> {
    let status = command.status().map_err(|e| Failure::trouble(what, e))?;
    status
        .success()
        .then_some(())
        .ok_or_else(|| Failure::Off(format!("{what} failed")))
}

/// Leaves a file that is right untouched, so that cargo rebuilds nothing.
fn write_if_new(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if fs::read(file).is_ok_and(|there| there == bytes) {
        return Ok(());
    }
    let directory = file.parent().unwrap_or(file);
    fs::create_dir_all(directory).map_err(|e| Failure::trouble(directory.display(), e))?;
    fs::write(file, bytes).map_err(|e| Failure::trouble(file.display(), e))
}
