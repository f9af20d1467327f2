//! `cargo xtask`: the developers' commands.

mod board;
mod callgrind;
mod checks;
mod cross;
mod emulator;
mod exactness;
mod failure;
mod host;
mod image;
mod limits;
mod measure;
mod outcome;
mod toolchain;
mod workloads;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

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
    /// Build the core for the bare-metal targets, with all features and with none.
    Cross,
    /// Geometry far beyond the screen against the same picture from triangles that fit it, counted by valgrind.
    Callgrind,
    #[command(hide = true)]
    DrawCase { case: String },
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Firmware { update_limits } => checks::run(update_limits),
        Command::Measure { workloads, json } => measure::run(workloads, json),
        Command::Cross => cross::run_all(),
        Command::Callgrind => callgrind::run(),
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
