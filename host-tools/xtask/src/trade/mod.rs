//! `cargo xtask trade`: what the tiers and dials cost on the boards, and how far they are from float64.

mod error;
mod page;
mod plain;
mod plot;
mod points;
mod promises;
mod reference;

use std::fs;
use std::path::PathBuf;

use error::Errors;
use fixel_workloads::tiers::canvas::Canvas;
use fixel_workloads::tiers::color::Fine;
use fixel_workloads::tiers::geometry::Models;
use fixel_workloads::tiers::{Case, cases, line_name};
use points::{MACHINES, Point, Sweep};
use reference::Picture;
use serde_json::{Value, json};

use crate::board::{BOARDS, require_emulators};
use crate::checks::differing;
use crate::failure::Failure;
use crate::image::root;
use crate::outcome::{Outcome, find};
use crate::toolchain::Toolchain;
use crate::{emulator, host, image};

/// How far around a pixel's middle everything must show the same triangle: more than the √2/512 px that a corner is moved by.
const REACH: f64 = 1.0 / 256.0;

/// What a run of all boards came to.
struct Measured {
    sweeps: Vec<Sweep>,
    /// Of each machine, the compiler.
    compilers: Vec<String>,
    /// Bits that are not the host's.
    differing: Vec<String>,
}

/// Measures and prints. With `update` stores the figures and writes what shows them; else what is stored must be fresh.
pub fn run(update: bool) -> Result<(), Failure> {
    require_emulators(&BOARDS)?;
    let measured = measure()?;
    print!("{}", page::details(&measured.sweeps));
    let mut off = measured.differing.clone();
    off.extend(promises::broken(&measured.sweeps));
    if update {
        write(&measured)?;
    } else {
        off.extend(stale(&measured)?);
    }
    if off.is_empty() {
        Ok(())
    } else {
        Err(Failure::Off(off.join("\n")))
    }
}

fn measure() -> Result<Measured, Failure> {
    let expected = host::draw_tiers();
    let (mut drawn, mut compilers) = (Vec::new(), Vec::new());
    let mut off = Vec::new();
    for board in &BOARDS {
        let toolchain = Toolchain::find(board.target)?;
        let image = image::build_bare(board, &toolchain, "tiers")?;
        let outcomes = Outcome::parse_all(&emulator::run(board, &image)?)?;
        off.extend(differing(board.key, &outcomes, &expected));
        drawn.push((board.key, outcomes));
        compilers.push((board.key, toolchain.version().to_owned()));
    }
    let of = |key: &str| {
        compilers
            .iter()
            .find(|(k, _)| *k == key)
            .map(|(_, version)| version.clone())
    };
    Ok(Measured {
        sweeps: sweeps(&drawn)?,
        compilers: MACHINES.iter().filter_map(|(key, _)| of(key)).collect(),
        differing: off,
    })
}

/// How a picture's errors are taken.
type Measure = fn(&[Fine], &Picture) -> Option<Errors>;

/// What is measured of a scene, and what that is called.
fn measures(scene: &'static str) -> Vec<(&'static str, Measure)> {
    match scene {
        "sky" => vec![("sky", Errors::of), ("sky by 4×4", Errors::of_means)],
        "two levels" => vec![("two levels", Errors::of), ("two levels by 4×4", Errors::of_means)],
        other => vec![(other, Errors::of)],
    }
}

/// Costs from the boards, errors from the same programs here.
fn sweeps(drawn: &[(&str, Vec<Outcome>)]) -> Result<Vec<Sweep>, Failure> {
    let models = Models::new();
    let all = cases::<Fine>();
    let scenes = all.chunk_by(|a, b| a.scene == b.scene);
    let mut sweeps = Vec::new();
    for cases in scenes {
        let [Case { scene, .. }, ..] = cases else { continue };
        let unknown = || Failure::Trouble(format!("{scene}: no such scene in float64"));
        let picture = Picture::named(scene, &models, REACH).ok_or_else(unknown)?;
        for (name, measure) in measures(scene) {
            let points = cases.iter().map(|case| point(case, &models, &picture, measure, drawn));
            sweeps.push(Sweep {
                scene: name.into(),
                pixels: picture.covered() as f64,
                points: points.collect::<Result<_, _>>()?,
            });
        }
    }
    Ok(sweeps)
}

fn point(
    case: &Case<Fine>,
    models: &Models,
    picture: &Picture,
    measure: Measure,
    drawn: &[(&str, Vec<Outcome>)],
) -> Result<Point, Failure> {
    let mut canvas = Box::new(Canvas::<Fine>::new());
    (case.draw)(&mut canvas, models).map_err(|e| Failure::trouble(case.scene, e))?;
    let errors = measure(canvas.colors(), picture);
    let nothing = || Failure::Off(format!("{}, {}: nothing drawn", case.scene, case.dial));
    Ok(Point {
        dial: case.dial.into(),
        instructions: MACHINES.map(|(key, _)| instructions(drawn, key, case)),
        errors: errors.ok_or_else(nothing)?,
    })
}

/// 0 where it was not drawn, which is complained of elsewhere.
fn instructions(drawn: &[(&str, Vec<Outcome>)], machine: &str, case: &Case<Fine>) -> f64 {
    let there = drawn.iter().find(|(key, _)| *key == machine);
    let line = there.and_then(|(_, outcomes)| find(outcomes, &line_name(case)));
    line.map_or(0.0, |line| line.instructions.into())
}

fn stored_file() -> PathBuf {
    root().join("firmware/trade.json")
}

fn read() -> Result<(Vec<Sweep>, Value), Failure> {
    let file = stored_file();
    let text = fs::read_to_string(&file).map_err(|e| Failure::trouble(file.display(), e))?;
    let stored: Value = serde_json::from_str(&text).map_err(|e| Failure::trouble(file.display(), e))?;
    let sweeps = stored["sweeps"]
        .as_array()
        .and_then(|all| all.iter().map(Sweep::from_json).collect());
    let sweeps = sweeps.ok_or_else(|| Failure::Trouble(format!("{}: not what is expected", file.display())))?;
    Ok((sweeps, stored["compilers"].clone()))
}

/// Stored figures that are not the measured ones, and pages that do not show the stored ones.
fn stale(measured: &Measured) -> Result<Vec<String>, Failure> {
    let (sweeps, compilers) = read()?;
    let comparable = std::array::from_fn(|machine| {
        let (key, name) = MACHINES[machine];
        let same = measured
            .compilers
            .get(machine)
            .is_some_and(|version| compilers[key] == *version);
        if !same {
            println!(
                "note: {name}: the stored counts are of rustc {}: not compared",
                compilers[key]
            );
        }
        same
    });
    let mut off = promises::stale(&sweeps, &measured.sweeps, comparable);
    for (file, expected) in pages(&sweeps)? {
        if !fs::read_to_string(&file).is_ok_and(|there| there == expected) {
            off.push(format!("{}: stale", file.display()));
        }
    }
    if !off.is_empty() {
        off.push("cargo xtask trade --update stores what was measured".into());
    }
    Ok(off)
}

fn write(measured: &Measured) -> Result<(), Failure> {
    let mut compilers = json!({});
    for ((key, _), version) in MACHINES.iter().zip(&measured.compilers) {
        compilers[*key] = version.as_str().into();
    }
    let sweeps: Vec<_> = measured.sweeps.iter().map(Sweep::to_json).collect();
    let stored = format!("{:#}\n", json!({ "compilers": compilers, "sweeps": sweeps }));
    let file = stored_file();
    fs::write(&file, stored).map_err(|e| Failure::trouble(file.display(), e))?;
    for (file, text) in pages(&read()?.0)? {
        fs::write(&file, text).map_err(|e| Failure::trouble(file.display(), e))?;
    }
    Ok(())
}

/// The files that show the figures, each as it should be.
fn pages(sweeps: &[Sweep]) -> Result<Vec<(PathBuf, String)>, Failure> {
    let mut pages = vec![(root().join("docs/trade.svg"), plot::draw(sweeps))];
    for (name, table) in [
        ("README.md", page::summary(sweeps)),
        ("docs/trade.md", page::details(sweeps)),
    ] {
        let file = root().join(name);
        let text = fs::read_to_string(&file).map_err(|e| Failure::trouble(file.display(), e))?;
        let marks = || Failure::Trouble(format!("{name}: no marks for the table of the trade"));
        pages.push((file, page::with_table(&text, &table).ok_or_else(marks)?));
    }
    Ok(pages)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The float64 scenes and the core's are the same ones; 1 level of 255 is what the exact tier promises.
    #[test]
    fn exact_is_within_a_level_of_float64() {
        let mut tiers = 0;
        for sweep in sweeps(&[]).unwrap() {
            assert!(sweep.pixels > 9_000.0);
            let Some(exact) = sweep.point("exact") else { continue };
            assert!(exact.errors.max < 1.0, "{}: {:?}", sweep.scene, exact.errors);
            tiers += 1;
        }
        assert_eq!(tiers, 4);
    }

    #[test]
    fn what_is_stored_is_shown() {
        for (file, expected) in pages(&read().unwrap().0).unwrap() {
            let there = fs::read_to_string(&file).unwrap();
            assert!(
                there == expected,
                "{}: stale; cargo xtask trade --update",
                file.display()
            );
        }
    }
}
