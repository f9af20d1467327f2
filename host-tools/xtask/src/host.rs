//! The measured programs on this machine: same code, same lines; what is counted, valgrind counts.

use std::path::Path;
use std::process::Command;
use std::{env, fs};

use fixel_workloads::flat;
use fixel_workloads::frame::Frame;
use fixel_workloads::machine::{Line, Machine};
use fixel_workloads::model::{self, canvas::Canvas};
use fixel_workloads::program;
use fixel_workloads::scenes::{self, part::Memory};
use fixel_workloads::tiers::{self, canvas::Canvas as TierCanvas};

use crate::callgrind::count;
use crate::failure::Failure;
use crate::outcome::Outcome;

#[derive(Default)]
struct Host {
    outcomes: Vec<Outcome>,
    /// The line, by its number, whose regions valgrind counts.
    counted: Option<usize>,
}

impl Machine for Host {
    fn count(&mut self, work: impl FnOnce()) -> u32 {
        if self.counted == Some(self.outcomes.len()) {
            counted_region(work);
        } else {
            work();
        }
        0
    }

    fn report(&mut self, line: &Line<'_>) {
        self.outcomes.push(line.into());
    }
}

/// Draws the workloads in `bytes` and the built-in shapes.
pub fn run(bytes: &[u8]) -> Vec<Outcome> {
    let mut host = Host::default();
    program::run(&mut host, &mut Frame::new(), bytes);
    host.outcomes
}

/// Valgrind counts in here, by name.
#[inline(never)]
pub fn counted_region(work: impl FnOnce()) {
    work();
}

/// What valgrind runs: everything in the file `bytes`, the regions of line number `line` where they are counted.
pub fn draw_line(bytes: &Path, line: usize) -> Result<(), Failure> {
    let bytes = fs::read(bytes).map_err(|e| Failure::trouble(bytes.display(), e))?;
    let mut host = Host {
        counted: Some(line),
        ..Host::default()
    };
    program::run(&mut host, &mut Frame::new(), &bytes);
    Ok(())
}

/// The lines of the workloads in the file `bytes` that `wanted` names, counted by valgrind, one run each.
pub fn counted(bytes: &Path, expected: &[Outcome], wanted: impl Fn(&str) -> bool) -> Result<Vec<Outcome>, Failure> {
    let lines = expected.iter().enumerate().filter(|(_, outcome)| wanted(&outcome.name));
    let counted = |(line, outcome): (usize, &Outcome)| {
        let number = line.to_string();
        let arguments = ["draw-line".as_ref(), bytes.as_os_str(), number.as_ref()];
        let instructions = count("counted_region", arguments)?;
        let instructions = u32::try_from(instructions).map_err(|e| Failure::trouble(&outcome.name, e))?;
        Ok(Outcome {
            instructions,
            ..outcome.clone()
        })
    };
    lines.map(counted).collect()
}

/// The version of the compiler in use.
pub fn compiler() -> Result<String, Failure> {
    let program = env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let output = Command::new(&program).arg("--version").output();
    let output = output.map_err(|e| Failure::trouble(&program, e))?;
    let about = String::from_utf8_lossy(&output.stdout);
    let version = about.split_whitespace().nth(1).map(str::to_owned);
    version.ok_or_else(|| Failure::Trouble(format!("{program} --version printed: {about}")))
}

/// Draws the flat triangles; nothing where they cannot be drawn.
pub fn draw_flat(draw: flat::Draw) -> Vec<Outcome> {
    let mut host = Host::default();
    let _drawn = flat::run(&mut host, &mut Frame::new(), draw);
    host.outcomes
}

/// Draws all scenes.
pub fn draw_scenes() -> Vec<Outcome> {
    let mut host = Host::default();
    scenes::run(&mut host, &mut Memory::new());
    host.outcomes
}

/// Draws every scene of the trade in every tier.
pub fn draw_tiers() -> Vec<Outcome> {
    let mut host = Host::default();
    tiers::run(&mut host, &mut TierCanvas::new());
    host.outcomes
}

/// Draws a model; also the picture. `None` where `words` hold none.
pub fn draw_model(words: &[u16]) -> Option<(Vec<Outcome>, Box<Canvas>)> {
    let mut host = Host::default();
    let mut canvas = Box::new(Canvas::new());
    model::program::run(&mut host, &mut canvas, words)?;
    Some((host.outcomes, canvas))
}
