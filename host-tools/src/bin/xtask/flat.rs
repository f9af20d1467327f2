//! A program that uses nothing costs nothing: flat triangles by the pipeline against a loop written by hand.
//!
//! Three images that differ in nothing else: by the pipeline, by hand, and without drawing, whose size is what the two have
//! in common.

use std::fs;

use fixel_workloads::flat;

use crate::board::Board;
use crate::checks::differing;
use crate::elf::Elf;
use crate::failure::Failure;
use crate::outcome::{Outcome, find};
use crate::toolchain::Toolchain;
use crate::{emulator, host, image};

/// What the pipeline may cost, in instructions and in bytes, for what the loop by hand does.
const LIMIT: f64 = 1.10;

/// Parts of the core that have no business in a flat program: interpolation and blending, as symbols name them. Depth leaves
/// no name, the tests being inlined where there are any.
const UNUSED: [&str; 2] = ["5fixel8gradient", "5fixel5blend"];

/// The measured region, by which one sees that symbols are read.
const DRAW: &str = "4flat8pipeline4draw";

/// What one of the images came to.
struct Measured {
    instructions: u32,
    bytes: usize,
}

/// Prints both figures of both; what is off.
pub fn check(board: &Board, toolchain: &Toolchain) -> Result<Vec<String>, Failure> {
    let expected = host::draw_flat(flat::by_hand::draw);
    let mut off = differing(board, &host::draw_flat(flat::pipeline::draw), &expected);
    let mut measure = |name: &str| {
        let file = image::build_bare(board, toolchain, name)?;
        let bytes = fs::read(&file).map_err(|e| Failure::trouble(file.display(), e))?;
        let elf = Elf::parse(&bytes).ok_or_else(|| Failure::Trouble(format!("{name}: not an image")))?;
        let outcomes = Outcome::parse_all(&emulator::run(board, &file)?)?;
        if name != "flat_empty" {
            off.extend(differing(board, &outcomes, &expected));
        }
        if name == "flat_pipeline" {
            let symbols = elf.symbols();
            if !symbols.iter().any(|symbol| symbol.contains(DRAW)) {
                off.push(format!("{name}: no symbol of its drawing"));
            }
            let unused = symbols.iter().filter(|s| UNUSED.iter().any(|u| s.contains(u)));
            off.extend(unused.map(|symbol| format!("{name}: has {symbol}")));
        }
        Ok(Measured {
            instructions: find(&outcomes, "flat").map_or(0, |outcome| outcome.instructions),
            bytes: elf.code_size(),
        })
    };
    let (empty, by_hand, pipeline) = (
        measure("flat_empty")?,
        measure("flat_by_hand")?,
        measure("flat_pipeline")?,
    );
    let size = |image: &Measured| image.bytes.saturating_sub(empty.bytes);
    println!(
        "flat by the pipeline: {} instructions ({} by hand), {} bytes ({} by hand)",
        pipeline.instructions,
        by_hand.instructions,
        size(&pipeline),
        size(&by_hand)
    );
    let instructions = (pipeline.instructions as usize, by_hand.instructions as usize);
    off.extend(over("instructions", instructions));
    off.extend(over("bytes", (size(&pipeline), size(&by_hand))));
    Ok(off)
}

/// A complaint where the pipeline's figure exceeds the limit, or where either is missing.
fn over(what: &str, (pipeline, by_hand): (usize, usize)) -> Option<String> {
    let within = pipeline > 0 && pipeline as f64 <= LIMIT * by_hand as f64;
    (!within).then(|| format!("flat by the pipeline: {pipeline} {what}, by hand {by_hand}: more than {LIMIT} times"))
}

#[cfg(test)]
mod tests {
    use super::over;

    #[test]
    fn a_tenth_more_passes_and_more_fails() {
        let fails = |pipeline| over("bytes", (pipeline, 1000)).is_some();
        assert_eq!(
            [fails(900), fails(1100), fails(1101), fails(0)],
            [false, false, true, true]
        );
        assert!(over("bytes", (1, 0)).is_some());
    }
}
