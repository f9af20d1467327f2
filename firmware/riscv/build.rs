//! Puts what the images need beside them: the board's memory map for the linker, and the workloads as bytes.

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::copy("virt.x", out.join("memory.x"))?;
    println!("cargo:rerun-if-changed=virt.x");
    println!("cargo:rustc-link-search={}", out.display());
    // Here and not in a cargo configuration, which RUSTFLAGS and another working directory would do away with.
    println!("cargo:rustc-link-arg-bins=-Tmemory.x");
    println!("cargo:rustc-link-arg-bins=-Tlink.x");

    // Without them the images know no workloads but the built-in shapes.
    println!("cargo:rerun-if-env-changed=FIXEL_WORKLOADS");
    let workloads = match env::var("FIXEL_WORKLOADS") {
        Ok(path) => {
            println!("cargo:rerun-if-changed={path}");
            fs::read(&path).map_err(|e| format!("{path}: {e}"))?
        }
        Err(_) => Vec::new(),
    };
    fs::write(out.join("workloads.bin"), workloads)?;
    Ok(())
}
