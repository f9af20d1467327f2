//! Puts what the images need beside them: the board's memory map for the linker, the workloads as bytes and the model as
//! words.

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let memory = if env::var_os("CARGO_FEATURE_MICROBIT").is_some() {
        "microbit.x"
    } else {
        "mps2.x"
    };
    fs::copy(memory, out.join("memory.x"))?;
    println!("cargo:rerun-if-changed={memory}");
    println!("cargo:rustc-link-search={}", out.display());
    // Here and not in a cargo configuration, which RUSTFLAGS and another working directory would do away with.
    println!("cargo:rustc-link-arg-bins=-Tlink.x");

    // Without them the images know no workloads but the built-in shapes, and no model.
    fs::write(out.join("workloads.bin"), data("FIXEL_WORKLOADS")?)?;
    // An array of words, aligned as such: indices are read where they lie.
    let bytes = data("FIXEL_MODEL")?;
    let words: Vec<u16> = bytes
        .as_chunks()
        .0
        .iter()
        .map(|&word| u16::from_le_bytes(word))
        .collect();
    fs::write(out.join("model.rs"), format!("{words:?}"))?;
    Ok(())
}

/// The bytes of the file that `variable` names, written by `cargo xtask`; none without it.
fn data(variable: &str) -> Result<Vec<u8>, Box<dyn Error>> {
    println!("cargo:rerun-if-env-changed={variable}");
    let Ok(path) = env::var(variable) else {
        return Ok(Vec::new());
    };
    println!("cargo:rerun-if-changed={path}");
    Ok(fs::read(&path).map_err(|e| format!("{path}: {e}"))?)
}
