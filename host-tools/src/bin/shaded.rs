//! `shaded n xRes yRes [-eyelight] < scene.iv > picture.ppm`: see `fixel_host::shaded`.

use std::io::{self, Write};
use std::panic::{catch_unwind, set_hook};
use std::process::ExitCode;

use fixel_host::shaded;

fn main() -> ExitCode {
    // Whatever goes wrong is one line, also what is our own fault.
    set_hook(Box::new(|panic| match panic.location() {
        Some(place) => complain(&format!("internal error at {place}")),
        None => complain("internal error"),
    }));
    let run = || shaded::run(std::env::args_os().skip(1), io::stdin().lock(), io::stdout().lock());
    match catch_unwind(run) {
        Ok(Ok(())) => return ExitCode::SUCCESS,
        Ok(Err(message)) => complain(&message),
        // The hook has told.
        Err(_) => {}
    }
    ExitCode::FAILURE
}

fn complain(message: &str) {
    // If standard error is gone, there is nobody to tell; the exit code still does.
    let _ = writeln!(io::stderr(), "{message}");
}
