//! `host-render extremes`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Parser;
use serde_json::{Value, json};

use super::{ALL, Curve, Family, Outcome, curves, table};
use crate::exit::{Exit, Failure};
use crate::files;

const EXIT_CODES: &str = "\
This takes a minute or more.

Exit codes: 0 every bound holds as far as is promised, 1 one does not, 2 bad usage, 3 file trouble, 4 internal error.";

/// Drives one number of a scene after the other to its limits, and says how far the stated bounds explain what differs from
/// float64 and what happens beyond.
#[derive(Debug, Parser)]
#[command(name = "host-render extremes", bin_name = "host-render extremes", version, after_help = EXIT_CODES)]
pub struct Command {
    /// Where a chart of each family goes, as SVG [default: nowhere]
    #[arg(long, value_name = "DIR")]
    out_dir: Option<PathBuf>,

    /// One JSON object per family instead of the table
    #[arg(long)]
    json: bool,
}

impl Command {
    /// The command, where the command line's first word asks for it; explains itself and ends the process where the rest
    /// makes no sense.
    pub fn asked() -> Option<Self> {
        let mut words = std::env::args_os();
        let program = words.next()?;
        let name = words.next()?;
        (name == "extremes").then(|| Self::parse_from(std::iter::once(program).chain(words)))
    }

    /// Draws everything, prints, and writes the charts. A bound that does not hold as far as is promised is a difference.
    pub fn run(&self) -> Exit {
        // Before the work, of which a name mistyped would leave nothing.
        if let Err(failure) = self.can_write() {
            return told(&failure);
        }
        let curves = curves();
        let printed = self.print(&curves);
        match self.write(&curves) {
            Ok(()) => printed,
            Err(failure) => printed.max(told(&failure)),
        }
    }

    fn print(&self, curves: &[Curve]) -> Exit {
        let text = if self.json {
            curves.iter().map(|curve| object(curve).to_string() + "\n").collect()
        } else {
            table(curves)
        };
        let mut out = io::stdout().lock();
        let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
        let kept = curves.iter().all(Curve::keeps_its_promise);
        match written {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                let _ = writeln!(io::stderr(), "cannot write to standard output: {error}");
                Exit::Files
            }
            _ if kept => Exit::Within,
            _ => Exit::Differs,
        }
    }

    fn write(&self, curves: &[Curve]) -> Result<(), Failure> {
        let Some(folder) = &self.out_dir else { return Ok(()) };
        for curve in curves {
            files::stage(&file(folder, curve.family), curve.chart().into_bytes())?.commit()?;
        }
        Ok(())
    }

    /// Makes the charts' files ready without changing any.
    fn can_write(&self) -> Result<(), Failure> {
        let Some(folder) = &self.out_dir else { return Ok(()) };
        for family in &ALL {
            files::stage(&file(folder, family), Vec::new())?;
        }
        Ok(())
    }
}

/// Where a family's chart goes.
fn file(folder: &Path, family: &Family) -> PathBuf {
    folder.join(format!("{}.svg", family.name))
}

/// Says what went wrong. If standard error is gone, there is nobody to tell; the exit code still does.
fn told(failure: &Failure) -> Exit {
    let _ = writeln!(io::stderr(), "{}", failure.message);
    failure.exit
}

fn object(curve: &Curve) -> Value {
    let point = |(value, outcome): &(f64, Outcome)| match outcome {
        Outcome::Drawn(errors) => json!({
            "value": value,
            "unexplained": errors.unexplained,
            "colour_error": errors.colour,
            "excused_percent": errors.excused,
        }),
        Outcome::Refused(message) => json!({ "value": value, "refused": message }),
    };
    json!({
        "name": curve.family.name,
        "parameter": curve.family.parameter,
        "promised_to": curve.family.promised,
        "explained_to": curve.holds_to(),
        "useful_to": curve.useful_to(),
        "points": curve.outcomes.iter().map(point).collect::<Vec<_>>(),
    })
}
