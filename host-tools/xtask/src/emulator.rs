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
    let program = board.emulator.program;
    let mut child = Command::new(program)
        .args(["-M", board.machine, "-nographic", "-monitor", "none", "-serial", "null"])
        .args(["-semihosting-config", "enable=on,target=native"])
        .args(board.emulator.options)
        .arg("-kernel")
        .arg(image)
        .stdin(Stdio::null())
        .stdout(stdout)
        .spawn()
        .map_err(|e| match e.kind() {
            ErrorKind::NotFound => Failure::Usage(board.without_emulator()),
            _ => Failure::trouble(program, e),
        })?;
    let end = Instant::now() + TIMEOUT;
    loop {
        if let Some(status) = child.try_wait().map_err(|e| Failure::trouble(program, e))? {
            return Ok(status);
        }
        if Instant::now() > end {
            child
                .kill()
                .and_then(|()| child.wait())
                .map_err(|e| Failure::trouble(program, e))?;
            return Err(Failure::Off(format!(
                "the image on {} did not end within {TIMEOUT:?}",
                board.machine
            )));
        }
        sleep(Duration::from_millis(20));
    }
}
