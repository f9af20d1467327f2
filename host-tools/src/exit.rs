//! How a run ends.

use std::path::Path;

use crate::files::Trouble;
use crate::scene::{Fault, Place};

/// The exit codes, in order of gravity: the worst of several scenes is the largest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// Every picture is within its limits.
    Within = 0,
    /// A picture differs beyond what is explained or allowed.
    Differs = 1,
    /// A scene is bad, or what was asked for makes no sense.
    Bad = 2,
    /// A file cannot be read or written.
    Files = 3,
    /// A bug of ours.
    Internal = 4,
}

impl From<Exit> for std::process::ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// Why a scene was not rendered, or its pictures not written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// The exit code that follows.
    pub exit: Exit,
    /// The line for the user; it names the file.
    pub message: String,
    /// Where in the scene, if it is the scene's fault.
    pub place: Option<Place>,
}

impl Failure {
    /// Something that was asked for and makes no sense.
    pub fn bad(message: impl Into<String>) -> Self {
        Self {
            exit: Exit::Bad,
            message: message.into(),
            place: None,
        }
    }

    /// A fault of the scene in `file`.
    pub fn scene(file: &Path, fault: &Fault) -> Self {
        Self {
            exit: Exit::Bad,
            message: format!("{}: {fault}", file.display()),
            place: Some(fault.place),
        }
    }

    /// The same, told of the scene in `file`.
    pub fn of(self, file: &Path) -> Self {
        Self {
            message: format!("{}: {}", file.display(), self.message),
            ..self
        }
    }

    /// A panic while working on `file`.
    pub fn panic(file: &Path, payload: &(dyn std::any::Any + Send)) -> Self {
        let what = payload
            .downcast_ref::<&str>()
            .copied()
            .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
            .unwrap_or("no message");
        Self {
            exit: Exit::Internal,
            message: format!("{}: internal error: {what}", file.display()),
            place: None,
        }
    }
}

impl From<Trouble> for Failure {
    fn from(trouble: Trouble) -> Self {
        Self {
            exit: Exit::Files,
            message: trouble.0,
            place: None,
        }
    }
}
