//! `cargo xtask firmware`: every image on every board, bits against the host, counts against their limits.

use clap::ValueEnum;

use crate::board::{BOARDS, Board, M4, require_emulators};
use crate::failure::Failure;
use crate::limits::Limits;
use crate::outcome::{Outcome, find};
use crate::toolchain::Toolchain;
use crate::workloads::Workloads;
use crate::{demos, emulator, flat, host, image, proofs, scenes, sizes};

/// What can be asked for alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Part {
    /// Cost of the workloads, of a flat program, bits of both.
    Counts,
    /// Bits of the scenes.
    Scenes,
    /// No panic, no float, no recursion.
    Proofs,
    /// The demos' pictures.
    Demos,
    /// Flash per set of features, stack per kind of triangle.
    Sizes,
}

/// Checks everything, or a part; `update_limits` stores the counts instead of judging them.
pub fn run(update_limits: bool, only: Option<Part>) -> Result<(), Failure> {
    let wants = |part| only.is_none_or(|only| only == part);
    require_emulators(&BOARDS)?;
    let mut off = Vec::new();
    if wants(Part::Scenes) {
        off.extend(scenes::check()?);
    }
    if wants(Part::Proofs) {
        off.extend(proofs::check()?);
    }
    if wants(Part::Demos) {
        off.extend(demos::check(None)?);
    }
    if wants(Part::Sizes) {
        off.extend(sizes::check(update_limits)?);
    }
    if wants(Part::Counts) {
        off.extend(counts(update_limits)?);
    }
    if off.is_empty() {
        Ok(())
    } else {
        Err(Failure::Off(off.join("\n")))
    }
}

/// The measuring image and the flat ones; limits are stored if nothing else is off.
fn counts(update_limits: bool) -> Result<Vec<String>, Failure> {
    let bytes = match Workloads::find(None)? {
        Some(workloads) => workloads.to_bytes()?,
        None => {
            println!("FIXEL_BENCH names no workloads: only the built-in shapes are drawn");
            Vec::new()
        }
    };
    let expected = host::run(&bytes);
    let mut limits = Limits::read()?;
    let mut off = Vec::new();
    for board in &BOARDS {
        let toolchain = Toolchain::find(board.target)?;
        let outcomes = measure(board, &toolchain, &bytes)?;
        let differing = differing(board.key, &outcomes, &expected);
        println!(
            "{} ({}, rustc {}): {} pictures, {} differ from the host's",
            board.core,
            board.machine,
            toolchain.version(),
            expected.len(),
            differing.len()
        );
        off.extend(differing);
        if update_limits {
            limits.update(board.key, toolchain.version(), &outcomes);
        } else {
            let verdict = limits.compare(board.key, toolchain.version(), &outcomes);
            verdict.notes.iter().for_each(|note| println!("note: {note}"));
            off.extend(verdict.over);
        }
    }
    // After the measuring image is built, whose symbols it looks at.
    off.extend(flat::check(&M4, &Toolchain::find(M4.target)?)?);
    if update_limits && off.is_empty() {
        limits.write()?;
    }
    Ok(off)
}

/// Builds and runs the measuring image.
pub fn measure(board: &Board, toolchain: &Toolchain, workloads: &[u8]) -> Result<Vec<Outcome>, Failure> {
    let image = image::build(board, toolchain, image::MEASURE, workloads)?;
    Outcome::parse_all(&emulator::run(board, &image)?)
}

/// What the board drew otherwise than the host.
pub fn differing(board: &str, outcomes: &[Outcome], expected: &[Outcome]) -> Vec<String> {
    let complaint = |host: &Outcome| match find(outcomes, &host.name) {
        Some(there) if there.same_bits(host) => None,
        Some(there) => Some(format!(
            "{board} {}: {} px, colour {:08x}, depth {:08x}; the host: {} px, {:08x}, {:08x}",
            host.name, there.units, there.color, there.depth, host.units, host.color, host.depth
        )),
        None => Some(format!("{board} {}: not drawn", host.name)),
    };
    expected.iter().filter_map(complaint).collect()
}
