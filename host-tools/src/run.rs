//! The walk of a run: load all scenes, decide who writes what, then render, compare and write each.

use std::io::{self, IsTerminal, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use rayon::prelude::*;

use crate::against::Against;
use crate::args::Args;
use crate::compare::Class;
use crate::exit::{Exit, Failure};
use crate::files::{self, Staged};
use crate::fixed::dials::Dials;
use crate::load::{Loaded, Refused, load};
use crate::maps;
use crate::outputs::{Outputs, plan};
use crate::page::{self, Section};
use crate::picture::Picture;
use crate::png;
use crate::render::{render, room};
use crate::report::{self, Report};
use crate::sweep::{self, Sweep};

/// Does what the command line says and tells how it went.
pub fn run(args: &Args) -> Exit {
    let (outcomes, common) = all(args);
    let own = outcomes.iter().map(exit);
    let worst = own.chain(common.iter().map(|failure| failure.exit)).max();
    let worst = worst.unwrap_or(Exit::Within);
    match print(args, &outcomes, common.as_ref()) {
        Ok(()) => worst,
        // Nobody listens any more; what was to be written has been.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => worst,
        Err(error) => {
            complain(format_args!("cannot write to standard output: {error}"));
            worst.max(Exit::Files)
        }
    }
}

type Outcome = Result<Told, Failure>;

/// What there is to say about a scene.
struct Told {
    report: Report,
    /// With `--report`.
    section: Option<Section>,
}

fn exit(outcome: &Outcome) -> Exit {
    match outcome {
        Ok(told) => told.report.exit(),
        Err(failure) => failure.exit,
    }
}

/// Loads and renders all scenes, and says what went wrong with them together: where outputs collide, that is all scenes'
/// failure, before anything is rendered or written; or the page cannot be written.
fn all(args: &Args) -> (Vec<Outcome>, Option<Failure>) {
    let load = |file: &PathBuf| guarded(file, || Ok(load(file, args))).unwrap_or_else(|failure| Err(failure.into()));
    let loaded: Vec<Result<Loaded, Refused>> = args.scenes.par_iter().map(load).collect();
    match plan(args, &loaded) {
        Ok(outputs) => {
            let outcomes = rendered(args, loaded, outputs);
            let page = args.report.as_deref().map(|file| write_page(file, args, &outcomes));
            (outcomes, page.and_then(Result::err))
        }
        Err(collision) => {
            let outcome =
                |loaded: Result<Loaded, Refused>| Err(loaded.map_or_else(Failure::from, |_| collision.clone()));
            (loaded.into_iter().map(outcome).collect(), Some(collision))
        }
    }
}

/// Renders the good scenes, each to its outputs.
fn rendered(args: &Args, loaded: Vec<Result<Loaded, Refused>>, outputs: Vec<Outputs>) -> Vec<Outcome> {
    let mut outputs = outputs.into_iter();
    let jobs: Vec<Result<(Loaded, Outputs), Failure>> = loaded
        .into_iter()
        .map(|loaded| {
            let loaded = loaded?;
            let outputs = outputs.next().unwrap_or_else(|| Outputs::new(args, &loaded));
            Ok((loaded, outputs))
        })
        .collect();
    let bar = progress(jobs.len());
    let outcomes = jobs
        .into_par_iter()
        .map(|job| {
            let outcome = job.and_then(|(loaded, outputs)| guarded(&loaded.file, || one(args, &loaded, &outputs)));
            bar.inc(1);
            outcome
        })
        .collect();
    bar.finish_and_clear();
    outcomes
}

/// A bar for people who wait for several scenes.
fn progress(scenes: usize) -> ProgressBar {
    if scenes > 1 && io::stderr().is_terminal() {
        ProgressBar::new(scenes as u64)
    } else {
        ProgressBar::hidden()
    }
}

/// One scene must not take the others down with it.
fn guarded<T>(file: &Path, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|payload| Err(Failure::panic(file, payload.as_ref())))
}

fn one(args: &Args, loaded: &Loaded, outputs: &Outputs) -> Outcome {
    let dials = Dials::of(args.quality);
    let fit = dials.fit(&loaded.scene, format_args!("--quality {}", args.quality));
    let fit = fit.and_then(|()| room(&loaded.scene));
    fit.map_err(|message| Failure::bad(message).of(&loaded.file))?;
    let against = Against::read(args, loaded)?;
    let rendered = render(&loaded.scene, dials).map_err(|fault| Failure::scene(&loaded.file, &fault))?;
    let (width, height) = loaded.scene.size();
    let report = Report {
        scene: loaded.file.display().to_string(),
        format: loaded.format,
        quality: args.quality,
        width,
        height,
        against: against.map(|against| [&rendered.fixed, &rendered.reference].map(|p| against.agreement(p))),
        seconds_fixed: rendered.seconds_fixed,
        seconds_reference: rendered.seconds_reference,
        ties: args.ties.is_some(),
        comparison: rendered.comparison,
    };
    let section = match args.report {
        Some(_) => {
            let sweep = args.sweep.then(|| swept(args, loaded, outputs)).transpose()?;
            let pictures = [&rendered.fixed, &rendered.reference];
            Some(page::section(loaded, pictures, &report, sweep.as_ref())?)
        }
        None => None,
    };
    // Last: an existing picture stays where anything of the scene fails.
    let classes = &report.comparison.classes;
    let written = write(
        outputs,
        [&rendered.fixed, &rendered.reference],
        &rendered.depth,
        classes,
    );
    written.map_err(|failure| failure.of(&loaded.file))?;
    Ok(Told { report, section })
}

/// The sweep for the report, or why the tiers cannot be compared: the scene's pictures are what they are without.
fn swept(args: &Args, loaded: &Loaded, outputs: &Outputs) -> Result<Result<Sweep, String>, Failure> {
    if let Err(why) = sweep::fits(&loaded.scene) {
        return Ok(Err(why));
    }
    // Before the work, of which a name mistyped would leave nothing.
    for file in outputs.files() {
        files::stage(file, Vec::new()).map_err(|trouble| Failure::from(trouble).of(&loaded.file))?;
    }
    sweep::sweep(loaded, args).map(Ok)
}

/// Writes the page that `--report` asks for.
fn write_page(file: &Path, args: &Args, outcomes: &[Outcome]) -> Result<(), Failure> {
    let sections: Vec<Result<&Section, &Failure>> = outcomes
        .iter()
        .filter_map(|outcome| match outcome {
            Ok(told) => told.section.as_ref().map(Ok),
            Err(failure) => Some(Err(failure)),
        })
        .collect();
    let page = page::page(&args.command, &sections);
    files::stage(file, page.into_bytes())?.commit()?;
    Ok(())
}

/// Writes a scene's pictures: all are made ready before the first takes its place.
fn write(
    outputs: &Outputs,
    [fixed, reference]: [&Picture; 2],
    depths: &[u16],
    classes: &[Class],
) -> Result<(), Failure> {
    let (width, height) = fixed.size();
    let mut staged = vec![stage(&outputs.picture, fixed)?];
    if let Some(file) = &outputs.reference {
        staged.push(stage(file, reference)?);
    }
    if let Some(file) = &outputs.diff {
        let diff = maps::classes(width, height, classes);
        staged.push(stage(file, &diff)?);
    }
    if let Some(file) = &outputs.depth {
        let depth = maps::depths(width, height, depths);
        staged.push(stage(file, &depth)?);
    }
    for file in staged {
        file.commit()?;
    }
    Ok(())
}

fn stage(file: &Path, picture: &Picture) -> Result<Staged, Failure> {
    let bytes = png::encode(picture).map_err(|error| Failure {
        exit: Exit::Internal,
        message: format!("{}: cannot be made into a PNG: {error}", file.display()),
        place: None,
    })?;
    Ok(files::stage(file, bytes)?)
}

/// Failures go to standard error, first, the scenes' own before the `common` one; the rest to standard output, one line per
/// scene, in the scenes' order.
fn print(args: &Args, outcomes: &[Outcome], common: Option<&Failure>) -> io::Result<()> {
    let failures = outcomes.iter().filter_map(|outcome| outcome.as_ref().err());
    let own = failures.filter(|failure| Some(*failure) != common);
    for failure in own.chain(common) {
        complain(format_args!("{}", failure.message));
    }
    let mut out = io::stdout().lock();
    for (file, outcome) in args.scenes.iter().zip(outcomes) {
        match outcome {
            Ok(told) if args.json => writeln!(out, "{}", told.report.json())?,
            Ok(told) => writeln!(out, "{}", told.report.line())?,
            Err(failure) if args.json => writeln!(out, "{}", report::failure(file, failure))?,
            Err(_) => {}
        }
    }
    out.flush()
}

fn complain(message: std::fmt::Arguments<'_>) {
    // If standard error is gone, there is nobody to tell; the exit code still does.
    let _ = writeln!(io::stderr(), "{message}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_one_scenes_failure() {
        let outcome: Result<(), _> = guarded(Path::new("a.txt"), || panic!("as this {} asks for", "test"));
        let failure = outcome.expect_err("it panicked");
        assert_eq!(failure.exit, Exit::Internal);
        assert_eq!(failure.message, "a.txt: internal error: as this test asks for");
    }

    #[test]
    fn the_worst_exit_is_the_largest() {
        let order = [Exit::Within, Exit::Differs, Exit::Bad, Exit::Files, Exit::Internal];
        assert!(order.is_sorted());
        assert_eq!(order.map(|exit| exit as u8), [0, 1, 2, 3, 4]);
    }
}
