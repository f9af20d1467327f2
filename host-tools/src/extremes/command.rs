//! `host-render extremes`.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Parser;
use serde_json::{Value, json};

use super::{Curve, Outcome, curves, table};
use crate::exit::{Exit, Failure};
use crate::files;

/// Drives one number of a scene after the other to its limits, and says how far the stated bounds explain what differs from
/// float64 and what happens beyond.
#[derive(Debug, Parser)]
#[command(name = "host-render extremes", version)]
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
        let curves = curves();
        if let Err(failure) = self.write(&curves) {
            // If standard error is gone, there is nobody to tell; the exit code still does.
            let _ = writeln!(io::stderr(), "{}", failure.message);
            return failure.exit;
        }
        let text = if self.json {
            curves.iter().map(|curve| object(curve).to_string() + "\n").collect()
        } else {
            table(&curves)
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
            let file = folder.join(format!("{}.svg", curve.family.name));
            files::stage(&file, curve.chart().into_bytes())?.commit()?;
        }
        Ok(())
    }
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
