//! Puts beside the image what it needs: the board's memory map for the linker, and the scenes as Rust.

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

/// Without the variable there is no scene.
const NONE: &str = "pub struct Memory<'a> {
    pub samples: &'a mut [fixel::blend::Rgba],
    pub bytes: &'a mut [[u8; 4]],
    pub depths: &'a mut [u16],
}

pub type Strip = fn(&mut Memory<'_>, u16, u16) -> Result<(), fixel::error::Error>;

pub static SCENES: [(&str, u16, u16, u16, Strip); 0] = [];

pub type Shown = fn(&mut [u16], &mut [u16]) -> Result<(), fixel::error::Error>;

pub static MESHES: [(&str, u16, u16, Shown); 0] = [];
";

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::copy("../cortex-m/mps2.x", out.join("memory.x"))?;
    println!("cargo:rerun-if-changed=../cortex-m/mps2.x");
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    println!("cargo:rerun-if-env-changed=FIXEL_EMITTED");
    let scenes = match env::var("FIXEL_EMITTED") {
        Ok(path) => {
            println!("cargo:rerun-if-changed={path}");
            fs::read_to_string(&path).map_err(|e| format!("{path}: {e}"))?
        }
        Err(_) => NONE.to_owned(),
    };
    fs::write(out.join("scenes.rs"), scenes)?;
    Ok(())
}
