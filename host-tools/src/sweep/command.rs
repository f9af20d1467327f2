//! `host-render sweep`.

use std::io::{self, IsTerminal, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use clap::Parser;
use indicatif::ProgressBar;

use super::table::CSV_HEADER;
use super::{Budget, Sweep, Unit, cost, recommended, sweep};
use crate::args::Args;
use crate::exit::{Exit, Failure};
use crate::load::load;
use crate::report;
use crate::scene::format::Format;
use crate::scene::iv::Shading;
use crate::scene::size::Size;

const NOTES: &str = "\
The cost is that of drawing the whole picture with the core, vertices and lights included: instructions of this machine \
where valgrind is installed, else seconds. A microcontroller's 64-bit arithmetic is dearer.

A pixel's error is the largest difference of its four bytes. Errors are over the pixels that either picture draws. 4x4 is the \
mean error of means over 4x4 pixels, for which dither is made; pictures of 1 bit are held against brightness.

Exit codes: 0 done, 1 nothing is within the budget, 2 bad scene or bad usage, 3 file trouble, 4 internal error; of several \
scenes the largest.";

/// Draws scenes with every tier and every dial that matters, and shows what speed costs in accuracy.
#[derive(Debug, Clone, Parser)]
#[command(name = "host-render sweep", bin_name = "host-render sweep", version, after_help = NOTES)]
pub struct Command {
    /// Scene files
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,

    /// Format of the scenes [default: told from the text]
    #[arg(long, value_enum)]
    format: Option<Format>,

    /// Size of the picture, of iv and OBJ scenes [default: 500x500]
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,

    /// How faces get their colours, of iv and OBJ scenes [default: gouraud]
    #[arg(long, value_enum)]
    shading: Option<Shading>,

    /// Add a dim light at the camera, to iv and OBJ scenes
    #[arg(long)]
    eyelight: bool,

    /// Recommend the cheapest whose error is at most E levels of 255 on 99.9 % of the pixels
    #[arg(long, value_name = "E", value_parser = levels)]
    max_error: Option<u8>,

    /// Recommend the nearest to float64 with at most I instructions per drawn pixel; needs valgrind
    #[arg(long, value_name = "I", value_parser = positive)]
    max_instructions: Option<f64>,

    /// One JSON object per scene
    #[arg(long, conflicts_with = "csv")]
    json: bool,

    /// Comma-separated values
    #[arg(long)]
    csv: bool,

    /// Only draws the one scene with this setting, for valgrind to count.
    #[arg(long, hide = true, value_name = "NAME")]
    draw: Option<String>,
}

fn levels(text: &str) -> Result<u8, String> {
    let number = text.parse();
    number.map_err(|_| "a whole number from 0 to 255 is wanted".to_owned())
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|n: &f64| n.is_finite() && *n > 0.0);
    number.ok_or_else(|| "a number above 0 is wanted".to_owned())
}

type Outcome = Result<Sweep, Failure>;

impl Command {
    /// The command, where the command line's first word asks for it; explains itself and ends the process where the rest
    /// makes no sense.
    pub fn asked() -> Option<Self> {
        let mut words = std::env::args_os();
        let program = words.next()?;
        let name = words.next()?;
        (name == "sweep").then(|| Self::parse_from(std::iter::once(program).chain(words)))
    }

    /// Does what it says and tells how it went.
    pub fn run(&self) -> Exit {
        if let (Some(name), Some(scene)) = (&self.draw, self.scenes.first()) {
            return match cost::draw(scene, &self.args(scene), name) {
                Ok(()) => Exit::Within,
                Err(failure) => told(&failure),
            };
        }
        let outcomes = self.all();
        let mut worst = outcomes.iter().map(|outcome| self.exit(outcome)).max();
        for failure in outcomes.iter().filter_map(|outcome| outcome.as_ref().err()) {
            worst = worst.max(Some(told(failure)));
        }
        let worst = worst.unwrap_or(Exit::Within);
        let mut out = io::stdout().lock();
        let printed = out
            .write_all(self.text(&outcomes).as_bytes())
            .and_then(|()| out.flush());
        match printed {
            // Nobody listens any more.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => worst,
            Err(error) => {
                let _ = writeln!(io::stderr(), "cannot write to standard output: {error}");
                worst.max(Exit::Files)
            }
            Ok(()) => worst,
        }
    }

    /// Sweeps the scenes one after the other: each keeps the machine busy.
    fn all(&self) -> Vec<Outcome> {
        let bar = if io::stderr().is_terminal() {
            ProgressBar::new(self.scenes.len() as u64)
        } else {
            ProgressBar::hidden()
        };
        let one = |scene: &PathBuf| {
            let swept = catch_unwind(AssertUnwindSafe(|| self.one(scene)));
            bar.inc(1);
            swept.unwrap_or_else(|payload| Err(Failure::panic(scene, payload.as_ref())))
        };
        let outcomes = self.scenes.iter().map(one).collect();
        bar.finish_and_clear();
        outcomes
    }

    fn one(&self, scene: &Path) -> Outcome {
        let args = self.args(scene);
        let loaded = load(scene, &args)?;
        if self.max_instructions.is_some() && cost::unit() != Unit::Instructions {
            return Err(Failure::bad(
                "--max-instructions needs valgrind, which is not installed",
            ));
        }
        sweep(&loaded, &args)
    }

    fn args(&self, scene: &Path) -> Args {
        Args::of_scene(scene.to_owned(), self.format, self.size, self.shading, self.eyelight)
    }

    fn budget(&self) -> Budget {
        Budget {
            max_error: self.max_error,
            max_instructions: self.max_instructions,
        }
    }

    fn exit(&self, outcome: &Outcome) -> Exit {
        match outcome {
            Ok(sweep) if recommended(sweep, &self.budget()).is_none() => Exit::Differs,
            Ok(_) => Exit::Within,
            Err(failure) => failure.exit,
        }
    }

    fn text(&self, outcomes: &[Outcome]) -> String {
        let budget = self.budget();
        let pairs = self.scenes.iter().zip(outcomes);
        if self.json {
            let object = |(scene, outcome): (&PathBuf, &Outcome)| match outcome {
                Ok(sweep) => sweep.json(&budget),
                Err(failure) => report::failure(scene, failure),
            };
            return pairs.map(|pair| object(pair).to_string() + "\n").collect();
        }
        let sweeps = outcomes.iter().filter_map(|outcome| outcome.as_ref().ok());
        if self.csv {
            let rows: String = sweeps.map(Sweep::csv).collect();
            return CSV_HEADER.to_owned() + &rows;
        }
        let tables: Vec<String> = sweeps.map(|sweep| sweep.table(&budget)).collect();
        tables.join("\n")
    }
}

/// Says what went wrong. If standard error is gone, there is nobody to tell; the exit code still does.
fn told(failure: &Failure) -> Exit {
    let _ = writeln!(io::stderr(), "{}", failure.message);
    failure.exit
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_definition_is_sound() {
        Command::command().debug_assert();
    }
}
