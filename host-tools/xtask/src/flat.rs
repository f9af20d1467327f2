//! A program that uses nothing costs nothing: flat triangles by the pipeline against a loop written by hand.
//!
//! Three images that differ in nothing else: by the pipeline, by hand, and without drawing, whose size is what the two have
//! in common.

use std::fs;
use std::path::Path;

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

/// Parts of the core that have no business in a flat program, as symbols name them: interpolation and blending. A depth test
/// leaves no name itself, being inlined, but the depths that it compares are interpolated: no interpolation, no depth.
const UNUSED: [&str; 3] = ["5fixel8gradient", "5fixel5slope", "5fixel5blend"];

/// An image that tests depth, where names of [`UNUSED`] are to be found: that the check can fail.
const WITH_DEPTH: &str = "measure";

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
    let mut off = differing(board.key, &host::draw_flat(flat::pipeline::draw), &expected);
    let mut measure = |name: &str| {
        let file = image::build_bare(board, toolchain, name)?;
        let bytes = fs::read(&file).map_err(|e| Failure::trouble(file.display(), e))?;
        let elf = parse(&file, &bytes)?;
        let outcomes = Outcome::parse_all(&emulator::run(board, &file)?)?;
        if name != "flat_empty" {
            off.extend(differing(board.key, &outcomes, &expected));
        }
        if name == "flat_pipeline" {
            let symbols: Vec<_> = elf.symbols().into_iter().map(str::to_owned).collect();
            if !symbols.iter().any(|symbol| symbol.contains(DRAW)) {
                off.push(format!("{name}: no symbol of its drawing"));
            }
            off.extend(unused(&symbols).map(|symbol| format!("{name}: has {symbol}")));
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
    if unused(&symbols_of(&image::built(board, WITH_DEPTH))?).next().is_none() {
        off.push(format!("{WITH_DEPTH}: depth is tested there, and no symbol says so"));
    }
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

fn parse<'a>(file: &Path, bytes: &'a [u8]) -> Result<Elf<'a>, Failure> {
    Elf::parse(bytes).ok_or_else(|| Failure::Trouble(format!("{}: not an image", file.display())))
}

fn symbols_of(file: &Path) -> Result<Vec<String>, Failure> {
    let bytes = fs::read(file).map_err(|e| Failure::trouble(file.display(), e))?;
    let symbols = parse(file, &bytes)?.symbols();
    Ok(symbols.into_iter().map(str::to_owned).collect())
}

/// Those that a flat program has no use for.
fn unused(symbols: &[String]) -> impl Iterator<Item = &String> {
    symbols
        .iter()
        .filter(|s| UNUSED.iter().any(|unused| s.contains(unused)))
}

/// A complaint where the pipeline's figure exceeds the limit, or where either is missing.
fn over(what: &str, (pipeline, by_hand): (usize, usize)) -> Option<String> {
    let within = pipeline > 0 && pipeline as f64 <= LIMIT * by_hand as f64;
    (!within).then(|| format!("flat by the pipeline: {pipeline} {what}, by hand {by_hand}: more than {LIMIT} times"))
}

#[cfg(test)]
mod tests {
    use super::{over, unused};

    #[test]
    fn interpolation_and_blending_are_found_and_the_rest_is_not() {
        let names = [
            "_RNvMs_NtCs5onQY5XpO6q_5fixel8gradientNtB4_5Basis4step",
            "_RNvMNtCs5onQY5XpO6q_5fixel5slopeNtB2_7Weights3new",
            "_RNvNtCs5onQY5XpO6q_5fixel5blend4over",
            "_RINvNtCs5onQY5XpO6q_5fixel4clip3cutlKj1_E",
        ];
        let names = names.map(str::to_owned);
        assert_eq!(unused(&names).count(), 3);
        assert_eq!(unused(&names[3..]).count(), 0);
    }

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
