//! `cargo xtask measure`: what the standard workloads cost, on every machine and beside other crates, and whether what was
//! drawn is right.

use std::path::PathBuf;

use serde_json::{Map, Value, json};

use crate::added::Sizes;
use crate::board::{BOARDS, Board, require_emulators};
use crate::checks::{differing, measure};
use crate::exactness::Exactness;
use crate::failure::Failure;
use crate::image::{target_dir, write_if_new};
use crate::limits::Limits;
use crate::outcome::{Outcome, find};
use crate::parts::Parts;
use crate::rivals::{self, Rival};
use crate::standard::{Units, WORKLOADS};
use crate::toolchain::Toolchain;
use crate::values::Figure;
use crate::workloads::Workloads;
use crate::{host, table, values};

/// The key of the machine that this runs on.
const HOST: &str = "host";

/// Boards whose figures are given; others execute the same instructions as one of these.
const MEASURED: [&str; 3] = ["m4", "m0", "riscv"];

/// What is asked for.
pub struct Options {
    /// A workloads file, other than the default one.
    pub workloads: Option<PathBuf>,
    /// JSON instead of tables.
    pub json: bool,
    /// Store the counts as the limits.
    pub update_limits: bool,
    /// Leave other crates out.
    pub without_rivals: bool,
}

/// Outcomes on one machine.
pub struct Machine {
    /// Its key in JSON and limits.
    pub key: &'static str,
    /// For people.
    pub name: String,
    /// The compiler that the counts belong to.
    pub compiler: String,
    /// What was drawn.
    pub outcomes: Vec<Outcome>,
}

/// All that is reported.
pub struct Report {
    pub machines: Vec<Machine>,
    pub units: Units,
    pub exactness: Exactness,
    pub values: Vec<Figure>,
    pub sizes: Sizes,
    pub rivals: Vec<Rival>,
}

/// Measures and prints; a picture that differs from the host's, anything inexact or a count over its limit is a failure.
pub fn run(options: Options) -> Result<(), Failure> {
    let workloads = Workloads::require(options.workloads)?;
    let boards: Vec<_> = BOARDS
        .into_iter()
        .filter(|board| MEASURED.contains(&board.key))
        .collect();
    require_emulators(&boards)?;
    let bytes = workloads.to_bytes()?;
    let expected = host::run(&bytes);
    let mut machines = Vec::new();
    for board in &boards {
        machines.push(on_board(board, &bytes)?);
    }
    // The reference first.
    machines.sort_by_key(|machine| MEASURED.iter().position(|key| *key == machine.key));
    machines.push(on_host(&bytes, &expected)?);
    let rivals = if options.without_rivals {
        Vec::new()
    } else {
        rivals::measure(&workloads)?
    };
    let report = Report {
        units: Units::of(&workloads, &expected)?,
        exactness: Exactness::of(&workloads)?,
        values: values::of(&workloads)?,
        sizes: Sizes::measure()?,
        machines,
        rivals,
    };
    if options.json {
        println!("{:#}", as_json(&report));
    } else {
        table::print(&report);
    }
    let mut off = what_is_off(&report, &expected);
    off.extend(gate(&report.machines, options.update_limits)?);
    if off.is_empty() {
        Ok(())
    } else {
        Err(Failure::Off(off.join("\n")))
    }
}

fn on_board(board: &Board, bytes: &[u8]) -> Result<Machine, Failure> {
    let toolchain = Toolchain::find(board.target)?;
    Ok(Machine {
        key: board.key,
        name: format!("{} ({})", board.core, board.machine),
        compiler: toolchain.version().to_owned(),
        outcomes: measure(board, &toolchain, bytes)?,
    })
}

fn on_host(bytes: &[u8], expected: &[Outcome]) -> Result<Machine, Failure> {
    let file = target_dir().join("measured-on-host.bin");
    write_if_new(&file, bytes)?;
    let is_standard = |name: &str| WORKLOADS.iter().any(|workload| workload.name == name);
    Ok(Machine {
        key: HOST,
        name: format!("this machine ({})", std::env::consts::ARCH),
        compiler: host::compiler()?,
        outcomes: host::counted(&file, expected, is_standard)?,
    })
}

fn what_is_off(report: &Report, expected: &[Outcome]) -> Vec<String> {
    let boards = report.machines.iter().filter(|machine| machine.key != HOST);
    let mut off: Vec<_> = boards.flat_map(|m| differing(m.key, &m.outcomes, expected)).collect();
    if !report.exactness.holds() {
        off.push("coverage is not exact".into());
    }
    let beyond = report.values.iter().filter(|figure| figure.off > 0);
    off.extend(beyond.map(|f| {
        format!(
            "{} {}: {} pixels are more than {} {} off",
            f.name, f.what, f.off, f.most, f.unit
        )
    }));
    off
}

/// Stores the counts as limits, or says which are over theirs.
fn gate(machines: &[Machine], update: bool) -> Result<Vec<String>, Failure> {
    let mut limits = Limits::read()?;
    if update {
        for machine in machines {
            limits.update(machine.key, &machine.compiler, &machine.outcomes);
        }
        limits.write()?;
        return Ok(Vec::new());
    }
    let mut over = Vec::new();
    for machine in machines {
        let verdict = limits.compare(machine.key, &machine.compiler, &machine.outcomes);
        verdict.notes.iter().for_each(|note| eprintln!("note: {note}"));
        if machine.key == HOST {
            // Here the count depends on the processor too, by which the C library chooses how to fill memory.
            verdict.over.iter().for_each(|over| eprintln!("note: {over}"));
        } else {
            over.extend(verdict.over);
        }
    }
    Ok(over)
}

/// Rounded for people and files: the counter's resolution is coarser than the digits cut.
fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

/// Figures of all workloads; null where there is none.
fn figures(units: &Units, instructions: impl Fn(&'static str, &'static str) -> Option<u64>) -> Value {
    let figure = |workload: &crate::standard::Workload| {
        let figure = instructions(workload.name, workload.key).and_then(|count| units.per_unit(workload, count));
        (workload.name.to_owned(), json!(figure.map(rounded)))
    };
    WORKLOADS.iter().map(figure).collect::<Map<_, _>>().into()
}

fn as_json(report: &Report) -> Value {
    let units = &report.units;
    let exactness = |exactness: &Exactness| -> Value {
        let figures = exactness.figures.iter();
        figures
            .map(|&(key, wrong)| (key.to_owned(), json!(wrong)))
            .collect::<Map<_, _>>()
            .into()
    };
    let mut object = Map::new();
    for machine in &report.machines {
        let instructions = |name: &str, _: &str| find(&machine.outcomes, name).map(|o| o.instructions.into());
        object.insert(machine.key.into(), figures(units, instructions));
    }
    object.insert("exactness".into(), exactness(&report.exactness));
    object.insert(
        "values".into(),
        report.values.iter().map(Figure::as_json).collect::<Map<_, _>>().into(),
    );
    let sizes = &report.sizes;
    let ([flash, flash_s], [compact, compact_s]) = (sizes.flash, sizes.compact);
    object.insert(
        "bytes".into(),
        json!({
            "W2_flash": flash,
            "W2_flash_s": flash_s,
            "W2_compact_flash": compact,
            "W2_compact_flash_s": compact_s,
            "W2_ram": sizes.ram(),
        }),
    );
    let rival = |rival: &Rival| {
        let mut about = Map::new();
        for machine in rivals::MACHINES {
            about.insert(
                machine.into(),
                figures(units, |_, key| rival.instructions(machine, key)),
            );
        }
        about.insert("exactness".into(), exactness(&rival.exactness));
        (rival.name.to_owned(), about.into())
    };
    object.insert(
        "rivals".into(),
        report.rivals.iter().map(rival).collect::<Map<_, Value>>().into(),
    );
    let parts = report.machines.iter().filter_map(|machine| {
        let parts = Parts::of(&machine.outcomes);
        let part = |p: &Parts| {
            let figures = json!({"pixel": rounded(p.pixel), "row": rounded(p.row), "triangle": rounded(p.triangle)});
            (p.kind.to_owned(), figures)
        };
        let parts: Map<_, _> = parts.iter().map(part).collect();
        (!parts.is_empty()).then(|| (machine.key.to_owned(), parts.into()))
    });
    object.insert("parts".into(), parts.collect::<Map<_, Value>>().into());
    object.into()
}
