//! Tells the linker what memory each image has.

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

/// Images and their boards.
const IMAGES: [(&str, &str); 3] = [
    ("spinning", "mps2.x"),
    ("dithered", "microbit.x"),
    ("wireframe", "four_kib.x"),
];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-changed=boards");
    // The library alone, for the host.
    if env::var("CARGO_CFG_TARGET_OS")? != "none" {
        return Ok(());
    }
    for (image, board) in IMAGES {
        // The runtime's linker script includes a memory.x: a folder for each image, which has its own.
        let folder = PathBuf::from(env::var("OUT_DIR")?).join(image);
        fs::create_dir_all(&folder)?;
        fs::copy(PathBuf::from("boards").join(board), folder.join("memory.x"))?;
        println!("cargo:rustc-link-arg-bin={image}=-L{}", folder.display());
        println!("cargo:rustc-link-arg-bin={image}=-Tlink.x");
    }
    Ok(())
}
