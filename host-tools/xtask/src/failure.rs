//! How a command fails.

use std::fmt;
use std::process::ExitCode;

/// Why a command did not succeed; the message is for its user.
#[derive(Debug)]
pub enum Failure {
    /// A check found something.
    Off(String),
    /// What was asked for makes no sense, or something that is needed is not installed.
    Usage(String),
    /// A file or a process made trouble.
    Trouble(String),
}

impl Failure {
    /// Trouble with `what`.
    pub fn trouble(what: impl fmt::Display, error: impl fmt::Display) -> Self {
        Failure::Trouble(format!("{what}: {error}"))
    }

    /// 1 for what a check found, 2 for usage, 3 for trouble.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Failure::Off(_) => 1,
            Failure::Usage(_) => 2,
            Failure::Trouble(_) => 3,
        })
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Failure::Off(message) | Failure::Usage(message) | Failure::Trouble(message)) = self;
        f.write_str(message)
    }
}
