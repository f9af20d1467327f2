//! `cargo xtask`: the developers' commands.

mod added;
mod board;
mod called;
mod callgrind;
mod calls;
mod chart;
mod checks;
mod cross;
mod demos;
mod elf;
mod emitted;
mod emulator;
mod exactness;
mod failure;
mod first_hour;
mod flash;
mod flat;
mod generate;
mod host;
mod image;
mod limits;
mod measure;
mod mesh;
mod model;
mod outcome;
mod parts;
mod proofs;
mod rivals;
mod rooms;
mod scale;
mod scenes;
mod sizes;
mod standard;
mod table;
mod times;
mod toolchain;
mod trade;
mod values;
mod workloads;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use model::Size;

/// Developers' commands.
#[derive(Parser)]
#[command(bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Build the images, run them under the emulator and check bits and costs; exit 1 if anything is off.
    ///
    /// The workloads are those of the file that FIXEL_BENCH names; without it only the built-in shapes are drawn.
    Firmware {
        /// Store the counts and sizes of this run as the limits.
        #[arg(long)]
        update_limits: bool,
        /// Only some of it.
        #[arg(long, value_enum)]
        only: Option<checks::Part>,
    },
    /// Cost of the standard workloads in instructions, exactness, sizes, and other crates beside them; exit 1 if anything is
    /// inexact or costs more than its limit.
    Measure {
        /// A workloads file [default: the one that FIXEL_BENCH names].
        workloads: Option<PathBuf>,
        /// One JSON object instead of tables.
        #[arg(long)]
        json: bool,
        /// Store the counts of this run as the limits.
        #[arg(long)]
        update_limits: bool,
        /// Leave other crates out.
        #[arg(long)]
        without_rivals: bool,
    },
    /// Cost of a frame of an Inventor model with Gouraud shading in instructions, and its bits against the host's.
    Model {
        /// A `.iv` file.
        scene: PathBuf,
        /// Columns and rows of the picture, such as 320x240: at most 307200 pixels, 4096 a side.
        size: Size,
        /// One JSON object instead of a table.
        #[arg(long)]
        json: bool,
        /// Where to write the picture.
        #[arg(long)]
        png: Option<PathBuf>,
    },
    /// The demo programs under the emulator, frame by frame against the same programs run here.
    Demos {
        /// Where to write the frames as pictures.
        #[arg(long)]
        png: Option<PathBuf>,
    },
    /// What docs/first-hour.md says, done word for word in an empty folder; takes minutes.
    FirstHour {
        /// Write the picture that the page shows.
        #[arg(long)]
        update_picture: bool,
    },
    /// Emit scenes, draw them on the Cortex-M4 and compare their bytes with those of `host-render`, and what they take with what was estimated.
    Emitted {
        /// Scene files [default: those of tests/scenes, and of the folder that FIXEL_CONFORMANCE names].
        scenes: Vec<PathBuf>,
        /// Size of the pictures of iv and OBJ scenes.
        #[arg(long, default_value = "120x80")]
        size: String,
    },
    /// Build the core for ARMv6-M, with all features and with none.
    Cross,
    /// Geometry far beyond the screen against the same picture from triangles that fit it, counted by valgrind.
    Callgrind,
    /// Time and instructions on this machine to draw an Inventor model with the core and in float64, for each shading.
    Times {
        /// A `.iv` file.
        scene: PathBuf,
        /// Columns and rows of the picture.
        size: Size,
    },
    #[command(hide = true)]
    DrawScene {
        scene: PathBuf,
        size: Size,
        shading: String,
        back_end: String,
    },
    #[command(hide = true)]
    DrawCase { case: String },
    /// How cost grows with pixels and with triangles, counted by valgrind, and a chart of it.
    Scale {
        /// Where to write the chart [default: docs/scale.svg of the project].
        #[arg(long)]
        svg: Option<PathBuf>,
    },
    /// Write a workloads file of the standard shape, made from a seed, to standard output.
    Workloads {
        /// Any number.
        seed: u64,
    },
    /// What the tiers and dials cost on the boards and how far they are from float64; exit 1 if the stored figures are stale.
    Trade {
        /// Store the figures, and write the pages that show them.
        #[arg(long)]
        update: bool,
    },
    #[command(hide = true)]
    DrawScale { case: scale::Case, n: u32 },
    #[command(hide = true)]
    DrawLine { bytes: PathBuf, line: usize },
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Measure {
            workloads,
            json,
            update_limits,
            without_rivals,
        } => measure::run(measure::Options {
            workloads,
            json,
            update_limits,
            without_rivals,
        }),
        Command::Firmware { update_limits, only } => checks::run(update_limits, only),
        Command::Model { scene, size, json, png } => model::run(&scene, size, json, png.as_deref()),
        Command::Demos { png } => demos::run(png.as_deref()),
        Command::FirstHour { update_picture } => first_hour::run(update_picture),
        Command::Emitted { scenes, size } => emitted::run(scenes, &size),
        Command::Cross => cross::run_all(),
        Command::Callgrind => callgrind::run(),
        Command::Times { scene, size } => times::run(&scene, size),
        Command::DrawScene {
            scene,
            size,
            shading,
            back_end,
        } => times::draw_scene(&scene, size, &shading, &back_end),
        Command::DrawCase { case } => callgrind::draw_case(&case),
        Command::Scale { svg } => scale::run(&svg.unwrap_or_else(|| image::root().join("docs/scale.svg"))),
        Command::Workloads { seed } => {
            println!("{}", generate::from_seed(seed));
            Ok(())
        }
        Command::Trade { update } => trade::run(update),
        Command::DrawScale { case, n } => scale::draw(case, n),
        Command::DrawLine { bytes, line } => host::draw_line(&bytes, line),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            failure.exit_code()
        }
    }
}
