//! Puts what the image needs beside it: the board's memory map for the linker, and the geometry.

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let map = "../../../firmware/cortex-m/mps2.x";
    fs::copy(map, out.join("memory.x"))?;
    println!("cargo:rerun-if-changed={map}");
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rustc-link-arg-bins=-Tlink.x");

    // Without it the image draws nothing.
    println!("cargo:rerun-if-env-changed=FIXEL_RIVALS");
    let geometry = match env::var("FIXEL_RIVALS") {
        Ok(path) => {
            println!("cargo:rerun-if-changed={path}");
            fs::read(&path).map_err(|e| format!("{path}: {e}"))?
        }
        Err(_) => Vec::new(),
    };
    fs::write(out.join("geometry.bin"), geometry)?;
    Ok(())
}
