//! What an image of the whole core does not have: a panic path, a float, a recursion; and that it has the whole core.

use std::fs;

use crate::board::{Board, M0, M4};
use crate::called::uncalled;
use crate::calls::Calls;
use crate::elf::Elf;
use crate::failure::Failure;
use crate::image::build_bare;
use crate::toolchain::Toolchain;

/// What is in the names of functions that panic. The image's own handler is called by nothing else, and so is not in an image
/// that cannot panic.
const PANICS: [&str; 6] = [
    "panicking",
    "panic_",
    "rust_begin_unwind",
    "unwrap_failed",
    "expect_failed",
    "slice_index_fail",
];

/// How the names of ARM's floating-point routines begin, behind `__aeabi_`; the others are of integers and memory.
const FLOAT_ROUTINES: [&str; 8] = ["f", "d", "i2", "ui2", "l2", "ul2", "cf", "cd"];

/// How the names of the compiler's floating-point routines end.
const FLOAT_ENDS: [&str; 12] = [
    "sf3", "df3", "sf2", "df2", "sfsi", "dfsi", "sfdi", "dfdi", "sisf", "sidf", "disf", "didf",
];

/// In the name of every function of the core; behind its hash, so that `15fixel_workloads` is another crate.
const CORE: &str = "_5fixel";

/// The core's functions that may call what a register holds. They hand one on, so that it is in the image once for all
/// shapes: a closure that reads a number of a corner, and calls nothing back.
const BY_REGISTER: [&str; 1] = ["8pipeline4fill5plane"];

/// Functions that an image of everything has at least: by it one sees that they are read.
const FEWEST: usize = 100;

/// Checks the image `everything` for a core without and with a divider, and that it calls all; what is off.
pub fn check() -> Result<Vec<String>, Failure> {
    let mut off = uncalled()?;
    for board in [&M0, &M4] {
        let file = build_bare(board, &Toolchain::find(board.target)?, "everything")?;
        let bytes = fs::read(&file).map_err(|e| Failure::trouble(file.display(), e))?;
        let image = Elf::parse(&bytes).ok_or_else(|| Failure::Trouble(format!("{}: not an image", file.display())))?;
        off.extend(check_image(board, &image));
    }
    Ok(off)
}

fn check_image(board: &Board, image: &Elf<'_>) -> Vec<String> {
    let symbols = image.symbols();
    let mut off = unwanted(&symbols);
    let calls = Calls::of(image);
    let count = calls.direct.keys().filter(|name| is_core(name)).count();
    if count < FEWEST {
        off.push(format!("{count} functions of the core: too few to be all of it"));
    }
    if let Some(way) = calls.recursion() {
        off.push(format!("recursion: {}", way.join(" -> ")));
    }
    let indirect: Vec<_> = calls.indirect.iter().copied().filter(|name| is_core(name)).collect();
    let unknown = indirect
        .iter()
        .filter(|name| !BY_REGISTER.iter().any(|known| name.ends_with(known)));
    off.extend(unknown.map(|name| format!("a call of what a register holds: {name}")));
    println!(
        "{}: {count} functions of the core, {} panic, {} float, {}; calls by register: {} in the core, {} in what calls it",
        board.core,
        symbols.iter().filter(|name| panics(name)).count(),
        symbols.iter().filter(|name| is_float(name)).count(),
        if calls.recursion().is_some() {
            "recursion"
        } else {
            "no recursion"
        },
        indirect.len(),
        calls.indirect.len() - indirect.len(),
    );
    off.iter()
        .map(|what| format!("{} everything: {what}", board.key))
        .collect()
}

/// Whether the core is the crate that a mangled name begins with; crates that it is compiled for come later in the name.
fn is_core(name: &str) -> bool {
    let workloads = name.find("fixel_workloads").unwrap_or(name.len());
    name.find(CORE).is_some_and(|at| at < workloads)
}

/// Symbols that have no business in an image of the core.
fn unwanted(symbols: &[&str]) -> Vec<String> {
    let panics = symbols.iter().filter(|name| panics(name));
    let floats = symbols.iter().filter(|name| is_float(name));
    let panics = panics.map(|name| format!("a panic path: {name}"));
    panics.chain(floats.map(|name| format!("a float: {name}"))).collect()
}

fn panics(name: &str) -> bool {
    PANICS.iter().any(|part| name.contains(part))
}

fn is_float(name: &str) -> bool {
    let is_routine = |rest: &str| FLOAT_ROUTINES.iter().any(|start| rest.starts_with(start));
    let is_ends = || name.starts_with("__") && FLOAT_ENDS.iter().any(|end| name.ends_with(end));
    name.strip_prefix("__aeabi_").is_some_and(is_routine) || is_ends() || name.contains("compiler_builtins5float")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_panics_and_floats_are_found() {
        let planted = [
            "_RNvNtCs1_4core9panicking9panic_fmt",
            "_ZN4core9panicking18panic_bounds_check17h0E",
            "_RNvNtCs1_4core6option13unwrap_failed",
            "rust_begin_unwind",
            "__aeabi_fadd",
            "__aeabi_dmul",
            "__aeabi_i2d",
            "__addsf3",
            "__fixdfsi",
        ];
        for name in planted {
            assert_eq!(unwanted(&[name]).len(), 1, "{name}");
        }
        let fine = [
            "__aeabi_idiv",
            "__aeabi_uldivmod",
            "__aeabi_memcpy",
            "__aeabi_llsl",
            "_RNv5fixel4draw5shade",
        ];
        assert!(unwanted(&fine).is_empty());
    }

    #[test]
    fn functions_belong_to_the_crate_that_they_are_of() {
        assert!(is_core("_RINvMNtCs7_5fixel6matrixE11perspectiveECsb_15fixel_workloads"));
        assert!(!is_core("_RINvNtCsb_15fixel_workloads5flatNtCs7_5fixel6target6BufferE"));
    }
}
