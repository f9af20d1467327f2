//! Building images.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use crate::board::{Board, M4};
use crate::failure::Failure;
use crate::toolchain::Toolchain;

/// The root of the project.
pub fn root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here)
}

/// Where bare-metal builds go: apart from the host's, which have another compiler's library.
pub fn target_dir() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| root().join("target"), PathBuf::from)
        .join("bare-metal")
}

/// An image, and the data in it.
#[derive(Debug, Clone, Copy)]
pub struct Image {
    /// What it is called.
    name: &'static str,
    /// What tells its build where the data is.
    variable: &'static str,
}

/// What an image is optimised for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Profile {
    /// Size.
    Small,
    /// Speed.
    Fast,
}

impl Profile {
    /// The compiler's `opt-level`.
    pub fn name(self) -> &'static str {
        match self {
            Profile::Small => "s",
            Profile::Fast => "3",
        }
    }

    /// Cargo's name of it.
    fn profile(self) -> &'static str {
        match self {
            Profile::Small => "small",
            Profile::Fast => "release",
        }
    }
}

/// Draws workloads.
pub const MEASURE: Image = Image {
    name: "measure",
    variable: "FIXEL_WORKLOADS",
};

/// Draws a model.
pub const MODEL: Image = Image {
    name: "model",
    variable: "FIXEL_MODEL",
};

/// Draws emitted scenes.
pub const EMITTED: Image = Image {
    name: "emitted",
    variable: "FIXEL_EMITTED",
};

/// Builds `image` for `board` with `data` in it; the file to run.
pub fn build(board: &Board, toolchain: &Toolchain, image: Image, data: &[u8]) -> Result<PathBuf, Failure> {
    let Image { name, variable } = image;
    let directory = std::path::absolute(target_dir()).map_err(|e| Failure::trouble("target directory", e))?;
    let file = directory.join(name).with_extension("bin");
    write_if_new(&file, data)?;
    compile(board, toolchain, name, &[(variable, &file)])
}

/// Builds the image `name` for `board`, which has no data in it; the file to run.
pub fn build_bare(board: &Board, toolchain: &Toolchain, name: &str) -> Result<PathBuf, Failure> {
    compile(board, toolchain, name, &[])
}

/// Where the image `name` for `board` is, once it is built.
pub fn built(board: &Board, name: &str) -> PathBuf {
    built_for(board, Profile::Fast, name)
}

/// The same of any profile.
pub fn built_for(board: &Board, profile: Profile, name: &str) -> PathBuf {
    target_dir().join(board.target).join(profile.profile()).join(name)
}

/// Builds images without data for `board`; the files, in order.
pub fn build_all(
    board: &Board,
    toolchain: &Toolchain,
    profile: Profile,
    names: &[String],
) -> Result<Vec<PathBuf>, Failure> {
    let directory = std::path::absolute(target_dir()).map_err(|e| Failure::trouble("target directory", e))?;
    let mut cargo = toolchain.cargo_build(&directory);
    cargo.args(["--profile", profile.profile(), "--package", board.package]);
    cargo.args(["--features", board.features]);
    cargo.args(names.iter().flat_map(|name| ["--bin", name]));
    cargo.current_dir(root().join("firmware"));
    run(
        &mut cargo,
        &format!("building {} for {}", names.join(", "), board.target),
    )?;
    let built = directory.join(board.target).join(profile.profile());
    Ok(names.iter().map(|name| built.join(name)).collect())
}

fn compile(board: &Board, toolchain: &Toolchain, name: &str, data: &[(&str, &Path)]) -> Result<PathBuf, Failure> {
    let directory = std::path::absolute(target_dir()).map_err(|e| Failure::trouble("target directory", e))?;
    let mut cargo = toolchain.cargo_build(&directory);
    cargo.args(["--release", "--package", board.package, "--bin", name]);
    cargo.args(["--features", board.features]);
    cargo.current_dir(root().join("firmware")).envs(data.iter().copied());
    run(&mut cargo, &format!("building {name} for {}", board.target))?;
    Ok(directory.join(board.target).join("release").join(name))
}

/// Profiles whose sizes are compared: opt-level 3 and s.
pub const PROFILES: [&str; 2] = ["release", "small"];

/// Builds an image whose size counts, for the Cortex-M4F; its file.
pub fn build_size(toolchain: &Toolchain, profile: &str, name: &str) -> Result<PathBuf, Failure> {
    let directory = std::path::absolute(target_dir()).map_err(|e| Failure::trouble("target directory", e))?;
    let mut cargo = toolchain.cargo_build(&directory);
    cargo.args(["--profile", profile, "--package", "fixel-sizes", "--bin", name]);
    cargo.current_dir(root().join("firmware"));
    run(&mut cargo, &format!("building {name}"))?;
    Ok(directory.join(M4.target).join(profile).join(name))
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
pub fn write_if_new(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if fs::read(file).is_ok_and(|there| there == bytes) {
        return Ok(());
    }
    let directory = file.parent().unwrap_or(file);
    fs::create_dir_all(directory).map_err(|e| Failure::trouble(directory.display(), e))?;
    fs::write(file, bytes).map_err(|e| Failure::trouble(file.display(), e))
}
