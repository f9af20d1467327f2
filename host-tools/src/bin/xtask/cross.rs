//! The core on the targets it is for.

use crate::board::{M0, M4, RISCV};
use crate::failure::Failure;
use crate::image::{root, run, target_dir};
use crate::toolchain::Toolchain;

/// Without and with floating-point registers, without and with a divider.
const TARGETS: [&str; 3] = [M0.target, M4.target, RISCV.target];

/// Builds the core for each target, with all features and with none.
pub fn run_all() -> Result<(), Failure> {
    for target in TARGETS {
        let toolchain = Toolchain::find(target)?;
        for features in ["--all-features", "--no-default-features"] {
            let mut cargo = toolchain.cargo_build(&target_dir());
            cargo
                .args(["--package", "fixel", "--lib", features])
                .current_dir(root());
            run(&mut cargo, &format!("building the core for {target} with {features}"))?;
            println!("{target} {features}: builds with rustc {}", toolchain.version());
        }
    }
    Ok(())
}
