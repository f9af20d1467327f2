//! `cargo xtask`: the developers' commands.

mod board;
mod callgrind;
mod checks;
mod cross;
mod elf;
mod emulator;
mod exactness;
mod failure;
mod flat;
mod host;
mod image;
mod limits;
mod measure;
mod model;
mod outcome;
mod times;
mod toolchain;
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
        /// Store the counts of this run as the limits.
        #[arg(long)]
        update_limits: bool,
    },
    /// Cost of the standard workloads in instructions, and exactness.
    Measure {
        /// A workloads file [default: the one that FIXEL_BENCH names].
        workloads: Option<PathBuf>,
        /// One JSON object instead of tables.
        #[arg(long)]
        json: bool,
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
    /// Build the core for the bare-metal targets, with all features and with none.
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
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Firmware { update_limits } => checks::run(update_limits),
        Command::Measure { workloads, json } => measure::run(workloads, json),
        Command::Model { scene, size, json, png } => model::run(&scene, size, json, png.as_deref()),
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
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            failure.exit_code()
        }
    }
}
