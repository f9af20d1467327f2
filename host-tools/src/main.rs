//! `host-render`: scenes in, pictures and an explained comparison out. See `fixel_host` for the rooms.

use std::panic::catch_unwind;
use std::process::ExitCode;

use fixel_host::args::Args;
use fixel_host::emit::command::Command as Emit;
use fixel_host::exit::Exit;
use fixel_host::extremes::command::Command as Extremes;
use fixel_host::run::run;
use fixel_host::sweep::command::Command as Sweep;

fn main() -> ExitCode {
    if let Some(command) = Extremes::asked() {
        return catch_unwind(|| command.run()).unwrap_or(Exit::Internal).into();
    }
    if let Some(command) = Emit::asked() {
        return command.run().into();
    }
    if let Some(command) = Sweep::asked() {
        return catch_unwind(|| command.run()).unwrap_or(Exit::Internal).into();
    }
    let args = Args::read();
    catch_unwind(|| run(&args)).unwrap_or(Exit::Internal).into()
}
