//! `cargo xtask measure`: what the standard workloads cost, and whether coverage is exact.

use std::path::PathBuf;

use fixel_workloads::shapes::{LOW, NARROW, REPEATS, WIDE};
use serde_json::{Map, Value, json};

use crate::board::M4;
use crate::checks::{differing, measure};
use crate::exactness::Exactness;
use crate::failure::Failure;
use crate::host;
use crate::outcome::{Outcome, find};
use crate::toolchain::Toolchain;
use crate::workloads::Workloads;

/// The kinds of drawing that the built-in shapes are drawn by.
const KINDS: [&str; 4] = ["flat", "flat_depth", "gouraud", "gouraud_depth"];

/// The standard workloads that are measured.
const STANDARD: [&str; 2] = ["W1", "W2"];

/// Measures and prints; a picture that differs from the host's, or coverage that is not exact, is a failure.
pub fn run(workloads: Option<PathBuf>, json: bool) -> Result<(), Failure> {
    let workloads = Workloads::require(workloads)?;
    let bytes = workloads.to_bytes()?;
    let toolchain = Toolchain::find(M4.target)?;
    let outcomes = measure(&M4, &toolchain, &bytes)?;
    let exactness = Exactness::of(&workloads)?;
    let parts = parts(&outcomes);
    if json {
        println!("{:#}", as_json(&outcomes, &parts, &exactness));
    } else {
        print_tables(toolchain.version(), &outcomes, &parts, &exactness);
    }
    let differing = differing(&M4, &outcomes, &host::run(&bytes));
    if !differing.is_empty() {
        return Err(Failure::Off(differing.join("\n")));
    }
    if exactness.holds() {
        Ok(())
    } else {
        Err(Failure::Off("coverage is not exact".into()))
    }
}

/// What one kind of drawing costs in instructions, every fragment passing.
struct Parts {
    kind: &'static str,
    pixel: f64,
    row: f64,
    triangle: f64,
}

/// Solves the shapes' costs for pixel, row and triangle.
fn parts(outcomes: &[Outcome]) -> Vec<Parts> {
    let of = |kind: &'static str| {
        let shape = |shape: &str| {
            let outcome = find(outcomes, &format!("{kind}/{shape}"))?;
            let once = |v: u32| f64::from(v) / f64::from(REPEATS);
            Some((once(outcome.instructions), once(outcome.units)))
        };
        let (wide, narrow, low) = (shape(WIDE.name)?, shape(NARROW.name)?, shape(LOW.name)?);
        let pixel = (wide.0 - narrow.0) / (wide.1 - narrow.1);
        let rest = |(instructions, pixels): (f64, f64)| instructions - pixels * pixel;
        let row = (rest(narrow) - rest(low)) / f64::from(NARROW.height - LOW.height);
        Some(Parts {
            kind,
            pixel,
            row,
            triangle: rest(low) - row * f64::from(LOW.height),
        })
    };
    KINDS.into_iter().filter_map(of).collect()
}

/// Rounded for people and files: the counter's resolution is coarser than the digits cut.
fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

fn as_json(outcomes: &[Outcome], parts: &[Parts], exactness: &Exactness) -> Value {
    let object = |pairs: Vec<(&str, Value)>| pairs.into_iter().map(|(k, v)| (k.to_owned(), v)).collect::<Map<_, _>>();
    let standard = STANDARD
        .iter()
        .filter_map(|name| Some((*name, json!(rounded(find(outcomes, name)?.per_unit())))));
    let part = |p: &Parts| {
        let figures = json!({"pixel": rounded(p.pixel), "row": rounded(p.row), "triangle": rounded(p.triangle)});
        (p.kind, figures)
    };
    json!({
        M4.key: object(standard.collect()),
        "parts": {M4.key: object(parts.iter().map(part).collect())},
        "exactness": object(exactness.figures.iter().map(|&(key, wrong)| (key, json!(wrong))).collect()),
    })
}

fn print_tables(compiler: &str, outcomes: &[Outcome], parts: &[Parts], exactness: &Exactness) {
    println!("{}, instructions, rustc {compiler}\n", M4.core);
    println!("{:<16}{:>12}{:>10}{:>10}", "workload", "total", "pixels", "per pixel");
    for outcome in STANDARD.iter().filter_map(|name| find(outcomes, name)) {
        let Outcome {
            name,
            instructions,
            units,
            ..
        } = outcome;
        println!("{name:<16}{instructions:>12}{units:>10}{:>10.2}", outcome.per_unit());
    }
    println!(
        "\n{:<16}{:>12}{:>10}{:>10}",
        "instructions per", "pixel", "row", "triangle"
    );
    for Parts {
        kind,
        pixel,
        row,
        triangle,
    } in parts
    {
        println!("{kind:<16}{pixel:>12.2}{row:>10.1}{triangle:>10.0}");
    }
    println!("\nwrong pixels");
    for (key, wrong) in exactness.figures {
        println!("{key:<16}{wrong:>12}");
    }
}
