//! Running an image under the emulator.

use std::fs::File;
use std::io::{ErrorKind, Read, Seek};
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::board::Board;
use crate::failure::Failure;

/// An image that takes longer hangs.
const TIMEOUT: Duration = Duration::from_secs(120);

/// What the image prints until it ends with success.
pub fn run(board: &Board, image: &Path) -> Result<String, Failure> {
    // A file and no pipe: an image whose reader is slow or gone can hang.
    let mut output = tempfile::tempfile().map_err(|e| Failure::trouble("temporary file", e))?;
    let status = wait(board, image, &output)?;
    let mut text = String::new();
    output
        .rewind()
        .and_then(|()| output.read_to_string(&mut text))
        .map_err(|e| Failure::trouble("the image's output", e))?;
    if status.success() {
        Ok(text)
    } else {
        Err(Failure::Off(format!(
            "the image on {} ended with {status}:\n{text}",
            board.machine
        )))
    }
}

fn wait(board: &Board, image: &Path, output: &File) -> Result<ExitStatus, Failure> {
    let stdout = output.try_clone().map_err(|e| Failure::trouble("temporary file", e))?;
    let mut child = Command::new(board.emulator)
        .args(["-M", board.machine, "-nographic", "-monitor", "none", "-serial", "null"])
        // One instruction is one nanosecond of the emulated clock: what the counts rest on.
        .args([
            "-semihosting-config",
            "enable=on,target=native",
            "-icount",
            "shift=0",
            "-kernel",
        ])
        .arg(image)
        .stdin(Stdio::null())
        .stdout(stdout)
        .spawn()
        .map_err(|e| match e.kind() {
            ErrorKind::NotFound => Failure::Usage(missing(board)),
            _ => Failure::trouble(board.emulator, e),
        })?;
    let end = Instant::now() + TIMEOUT;
    loop {
        if let Some(status) = child.try_wait().map_err(|e| Failure::trouble(board.emulator, e))? {
            return Ok(status);
        }
        if Instant::now() > end {
            child
                .kill()
                .and_then(|()| child.wait())
                .map_err(|e| Failure::trouble(board.emulator, e))?;
            return Err(Failure::Off(format!(
                "the image on {} did not end within {TIMEOUT:?}",
                board.machine
            )));
        }
        sleep(Duration::from_millis(20));
    }
}

fn missing(board: &Board) -> String {
    format!(
        "the emulator {0} for {1} is not installed; on Debian: apt-get install --no-install-recommends {0}",
        board.emulator, board.core
    )
}
