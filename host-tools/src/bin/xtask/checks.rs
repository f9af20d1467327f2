//! `cargo xtask firmware`: every image on every board, bits against the host, counts against their limits.

use crate::board::{BOARDS, Board};
use crate::failure::Failure;
use crate::limits::Limits;
use crate::outcome::{Outcome, find};
use crate::toolchain::Toolchain;
use crate::workloads::Workloads;
use crate::{emulator, flat, host, image};

/// Checks everything; `update_limits` stores the counts instead of judging them.
pub fn run(update_limits: bool) -> Result<(), Failure> {
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
        let differing = differing(board, &outcomes, &expected);
        println!(
            "{} ({}, rustc {}): {} pictures, {} differ from the host's",
            board.core,
            board.machine,
            toolchain.version(),
            expected.len(),
            differing.len()
        );
        off.extend(differing);
        off.extend(flat::check(board, &toolchain)?);
        if update_limits {
            limits.update(board, toolchain.version(), &outcomes);
        } else {
            let verdict = limits.compare(board, toolchain.version(), &outcomes);
            verdict.notes.iter().for_each(|note| println!("note: {note}"));
            off.extend(verdict.over);
        }
    }
    if !off.is_empty() {
        return Err(Failure::Off(off.join("\n")));
    }
    if update_limits { limits.write() } else { Ok(()) }
}

/// Builds and runs the measuring image.
pub fn measure(board: &Board, toolchain: &Toolchain, workloads: &[u8]) -> Result<Vec<Outcome>, Failure> {
    let image = image::build(board, toolchain, image::MEASURE, workloads)?;
    Outcome::parse_all(&emulator::run(board, &image)?)
}

/// What the board drew otherwise than the host.
pub fn differing(board: &Board, outcomes: &[Outcome], expected: &[Outcome]) -> Vec<String> {
    let complaint = |host: &Outcome| match find(outcomes, &host.name) {
        Some(there) if there.same_bits(host) => None,
        Some(there) => Some(format!(
            "{} {}: {} px, colour {:08x}, depth {:08x}; the host: {} px, {:08x}, {:08x}",
            board.key, host.name, there.units, there.color, there.depth, host.units, host.color, host.depth
        )),
        None => Some(format!("{} {}: not drawn", board.key, host.name)),
    };
    expected.iter().filter_map(complaint).collect()
}
