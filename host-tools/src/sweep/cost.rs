//! What drawing a picture costs: instructions of this machine, counted by valgrind, or else time.
//!
//! What is counted is the whole draw, from the scene's numbers to the last pixel, vertices and lights included, and what makes the
//! words for another output than bytes of it. It is the host that counts: 64-bit words are cheap here, and a microcontroller saves more by a cheaper dial.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;
use std::{env, hint, io};

use rayon::prelude::*;

use super::{Setting, setting};
use crate::args::Args;
use crate::exit::{Exit, Failure};
use crate::fixed::dials::Dials;
use crate::fixed::{self, FixedPicture};
use crate::load::{Loaded, load};
use crate::scene::{Fault, Scene};

/// What costs are counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Of the host.
    Instructions,
    /// Of this machine, the median of several draws.
    Seconds,
}

impl Unit {
    /// As reports call it.
    pub fn name(self) -> &'static str {
        match self {
            Unit::Instructions => "instructions",
            Unit::Seconds => "seconds",
        }
    }
}

/// Draws whose median is the time.
const DRAWS: usize = 5;

/// The cost of every setting.
///
/// # Errors
/// A valgrind that does not count, or a scene that the core cannot draw.
pub fn costs(loaded: &Loaded, args: &Args, settings: &[Setting]) -> Result<(Unit, Vec<f64>), Failure> {
    if unit() == Unit::Instructions {
        let count = |setting: &Setting| instructions(&loaded.file, args, setting);
        let counts: Result<_, _> = settings.par_iter().map(count).collect();
        return Ok((Unit::Instructions, counts?));
    }
    let seconds = |setting: &Setting| seconds(&loaded.scene, setting.dials);
    let times: Result<_, Fault> = settings.iter().map(seconds).collect();
    let times = times.map_err(|fault| Failure::scene(&loaded.file, &fault))?;
    Ok((Unit::Seconds, times))
}

/// What costs are counted in on this machine.
pub fn unit() -> Unit {
    let version = Command::new("valgrind").arg("--version").output();
    if version.is_ok_and(|output| output.status.success()) {
        Unit::Instructions
    } else {
        Unit::Seconds
    }
}

/// The name of the function that valgrind counts in.
const COUNTED: &str = "sweep_counts_in_here";

/// Draws the picture; valgrind finds it by its name.
#[inline(never)]
fn sweep_counts_in_here(scene: &Scene, dials: Dials) -> Result<(FixedPicture, Vec<u16>), Fault> {
    fixed::draw_out(scene, dials)
}

/// What valgrind runs: one setting of a scene, drawn once.
///
/// # Errors
/// A scene or setting that there is not.
pub fn draw(file: &Path, args: &Args, name: &str) -> Result<(), Failure> {
    let loaded = load(file, args)?;
    let setting = setting(name).ok_or_else(|| Failure::bad(format!("no setting {name:?}")))?;
    let drawn = sweep_counts_in_here(&loaded.scene, setting.dials);
    hint::black_box(drawn.map_err(|fault| Failure::scene(file, &fault))?);
    Ok(())
}

/// Instructions that this program spends in drawing, run again under valgrind.
fn instructions(file: &Path, args: &Args, setting: &Setting) -> Result<f64, Failure> {
    let output = env::current_exe().and_then(|program| {
        Command::new("valgrind")
            .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
            .arg(format!("--toggle-collect=*{COUNTED}*"))
            .arg(program)
            .args(["sweep", "--draw", &setting.name])
            .args(args.scene_options())
            .arg("--")
            .arg(file)
            .stdin(Stdio::null())
            .output()
    });
    let report = output.map_err(|error: io::Error| internal(file, &error.to_string()))?;
    let report = String::from_utf8_lossy(&report.stderr);
    let count = collected(&report);
    count.ok_or_else(|| internal(file, &format!("nothing was counted:\n{report}")))
}

fn internal(file: &Path, what: &str) -> Failure {
    Failure {
        exit: Exit::Internal,
        message: format!("{}: valgrind: {what}", file.display()),
        place: None,
    }
}

/// The count in valgrind's report; `None` where nothing was counted.
fn collected(report: &str) -> Option<f64> {
    let count = |line: &str| line.split_once("Collected : ")?.1.trim().parse().ok();
    report.lines().find_map(count).filter(|&count| count > 0.0)
}

/// The median time of some draws.
fn seconds(scene: &Scene, dials: Dials) -> Result<f64, Fault> {
    let mut times = [0.0; DRAWS];
    for time in &mut times {
        let start = Instant::now();
        hint::black_box(sweep_counts_in_here(scene, dials)?);
        *time = start.elapsed().as_secs_f64();
    }
    times.sort_by(f64::total_cmp);
    Ok(times[DRAWS / 2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_counted_is_no_count() {
        assert_eq!(collected("==1== Events    : Ir\n==1== Collected : 123\n"), Some(123.0));
        assert_eq!(collected("==1== Collected : 0\n"), None);
        assert_eq!(collected("no such program\n"), None);
    }
}
