//! The core on the poorest target it is for.

use crate::board::M0;
use crate::failure::Failure;
use crate::image::{root, run, target_dir};
use crate::toolchain::Toolchain;

/// Builds the core with all features and with none where there are no atomics, no divider and no floating point. With the
/// features that firmware uses, the images are built of it for every target.
pub fn run_all() -> Result<(), Failure> {
    let toolchain = Toolchain::find(M0.target)?;
    for features in ["--all-features", "--no-default-features"] {
        let mut cargo = toolchain.cargo_build(&target_dir());
        cargo
            .args(["--package", "fixel", "--lib", features])
            .current_dir(root());
        run(
            &mut cargo,
            &format!("building the core for {} with {features}", M0.target),
        )?;
        println!("{} {features}: builds with rustc {}", M0.target, toolchain.version());
    }
    Ok(())
}
