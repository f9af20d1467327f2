//! Other crates on the same geometry: built from `benches/rivals`, counted on the host and on the Cortex-M4F, and their
//! coverage checked as the core's is.

use std::env;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::board::M4;
use crate::callgrind::count_in;
use crate::emulator;
use crate::exactness::{Exactness, PIXELS};
use crate::failure::Failure;
use crate::image::{root, run, target_dir, write_if_new};
use crate::outcome::Outcome;
use crate::toolchain::Toolchain;
use crate::workloads::Workloads;

/// All that are measured.
const NAMES: [&str; 4] = ["euc", "retrofire-core", "embedded-3dgfx", "embedded-graphics"];

/// Where they are counted.
pub const MACHINES: [&str; 2] = [M4.key, "host"];

/// What a crate came to.
pub struct Rival {
    /// What it is called.
    pub name: &'static str,
    /// Of each of [`MACHINES`]: what it drew, called as the workloads' keys.
    pub outcomes: [Vec<Outcome>; 2],
    /// Its coverage.
    pub exactness: Exactness,
}

impl Rival {
    /// Instructions for a workload on a machine, where it can draw that.
    pub fn instructions(&self, machine: &str, key: &str) -> Option<u64> {
        let of_machine = MACHINES
            .iter()
            .zip(&self.outcomes)
            .find(|(name, _)| **name == machine)?
            .1;
        let outcome = of_machine.iter().find(|outcome| outcome.name == key)?;
        Some(outcome.instructions.into())
    }
}

/// Measures all of them.
pub fn measure(workloads: &Workloads) -> Result<Vec<Rival>, Failure> {
    let file = directory()?.join("geometry.bin");
    write_if_new(&file, &workloads.to_floats()?)?;
    let on_board = on_board(&file)?;
    let program = build()?;
    let of = |name| {
        let of_board: Vec<_> = on_board.iter().filter_map(|outcome| named(outcome, name)).collect();
        let on_host = of_board.iter().map(|outcome| on_host(&program, &file, name, outcome));
        Ok(Rival {
            name,
            exactness: Exactness::of_drawn(workloads, |set| coverage(&program, &file, set, name))?,
            outcomes: [of_board.clone(), on_host.collect::<Result<_, Failure>>()?],
        })
    };
    NAMES.into_iter().map(of).collect()
}

fn directory() -> Result<PathBuf, Failure> {
    let directory = target_dir().join("rivals");
    std::path::absolute(directory).map_err(|e| Failure::trouble("target directory", e))
}

fn sources() -> PathBuf {
    root().join("benches/rivals")
}

/// The program that draws on the host.
fn build() -> Result<PathBuf, Failure> {
    let directory = directory()?;
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args([
        "build",
        "--quiet",
        "--locked",
        "--release",
        "--features",
        "std",
        "--target-dir",
    ]);
    cargo.arg(&directory).current_dir(sources());
    run(&mut cargo, "building other crates for the host")?;
    Ok(directory.join("release/rivals"))
}

/// What all of them did on the board.
fn on_board(file: &Path) -> Result<Vec<Outcome>, Failure> {
    let directory = directory()?;
    let toolchain = Toolchain::find(M4.target)?;
    let mut cargo = toolchain.cargo_build(&directory);
    cargo.args(["--release", "--package", "fixel-rivals-cortex-m"]);
    cargo.current_dir(sources()).env("FIXEL_RIVALS", file);
    run(&mut cargo, &format!("building other crates for {}", M4.target))?;
    let image = directory.join(M4.target).join("release/rivals");
    Outcome::parse_all(&emulator::run(&M4, &image)?)
}

/// An outcome of the rival `name`, called as its workload; `None` for another's.
fn named(outcome: &Outcome, name: &str) -> Option<Outcome> {
    let key = outcome.name.strip_prefix(name)?.strip_prefix('/')?;
    Some(Outcome {
        name: key.to_owned(),
        ..outcome.clone()
    })
}

/// The same on the host.
fn on_host(program: &Path, file: &Path, name: &str, outcome: &Outcome) -> Result<Outcome, Failure> {
    let line = format!("{name}/{}", outcome.name);
    let instructions = count_in(program, "counted_region", [file.as_os_str(), OsStr::new(&line)])?;
    Ok(Outcome {
        instructions: u32::try_from(instructions).map_err(|e| Failure::trouble(&line, e))?,
        ..outcome.clone()
    })
}

/// Which pixels each triangle of a set hits.
fn coverage(program: &Path, file: &Path, set: &str, name: &str) -> Result<Vec<Vec<u8>>, Failure> {
    let output = Command::new(program).arg(file).args([set, name]).output();
    let output = output.map_err(|e| Failure::trouble(program.display(), e))?;
    if !output.status.success() {
        return Err(Failure::Trouble(format!(
            "{name} on {set}: {}",
            String::from_utf8_lossy(&output.stderr)
        )));
    }
    Ok(output.stdout.chunks_exact(PIXELS).map(<[u8]>::to_vec).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rival_is_told_by_its_whole_name() {
        let outcome = Outcome {
            name: "euc/W2".into(),
            instructions: 5,
            units: 1,
            color: 0,
            depth: 0,
        };
        assert_eq!(named(&outcome, "euc").map(|o| o.name), Some("W2".into()));
        assert!(named(&outcome, "eu").is_none() && named(&outcome, "retrofire-core").is_none());
    }
}
