//! The command line of `examples/playground.rs`.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{SystemTime, UNIX_EPOCH};

use fixel::error::Error;

use super::draw_float;
use super::texture::Textures;
use crate::exit::{Exit, Failure};
use crate::picture::Picture;
use crate::{files, png};

const USAGE: &str = "usage: playground OUT.png [--course] [--float]";

/// What was asked for.
struct Wish {
    out: PathBuf,
    course: bool,
    float: bool,
}

/// Does what the command line says; `draw` is the fixed-point half.
pub fn main(draw: impl FnOnce(&Textures) -> Result<Picture, Error>) -> ExitCode {
    match wish(std::env::args_os().skip(1)).and_then(|wish| run(&wish, draw)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("playground: {}", failure.message);
            failure.exit.into()
        }
    }
}

fn wish(arguments: impl Iterator<Item = OsString>) -> Result<Wish, Failure> {
    let (mut out, mut course, mut float) = (None, false, false);
    for argument in arguments {
        match argument.to_str() {
            Some("--course") => course = true,
            Some("--float") => float = true,
            Some(option) if option.starts_with('-') => {
                return Err(Failure::bad(format!("unknown option {option}; {USAGE}")));
            }
            _ if out.is_some() => return Err(Failure::bad(format!("more than one file; {USAGE}"))),
            _ => out = Some(PathBuf::from(argument)),
        }
    }
    let out = out.ok_or_else(|| Failure::bad(USAGE))?;
    Ok(Wish { out, course, float })
}

fn run(wish: &Wish, draw: impl FnOnce(&Textures) -> Result<Picture, Error>) -> Result<(), Failure> {
    let textures = if wish.course {
        Textures::course(seed())
    } else {
        Textures::fixed()
    };
    let picture = if wish.float {
        draw_float(&textures)
    } else {
        draw(&textures).map_err(no_picture)?
    };
    write(&wish.out, &picture)
}

/// The scene is ours, so that it is our fault.
fn no_picture(error: Error) -> Failure {
    Failure {
        exit: Exit::Internal,
        message: error.to_string(),
        place: None,
    }
}

/// Another picture every time.
fn seed() -> u64 {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    now.map_or(0, |time| time.as_nanos() as u64)
}

fn write(out: &Path, picture: &Picture) -> Result<(), Failure> {
    let bytes = png::encode(picture).map_err(|error| Failure {
        exit: Exit::Files,
        message: format!("{}: cannot encode: {error}", out.display()),
        place: None,
    })?;
    files::stage(out, bytes)?.commit()?;
    Ok(())
}
