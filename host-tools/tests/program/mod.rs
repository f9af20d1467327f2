//! The real binary, run in a folder of its own.

use std::path::PathBuf;
use std::process::{Command, Output};

/// A temporary folder with scenes in it, and what the program did there.
pub struct Folder(tempfile::TempDir);

/// How a run ended.
#[derive(Debug)]
pub struct Run {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> &Self {
        std::fs::write(self.path(name), content).expect("a file in the temporary folder");
        self
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_default()
    }

    /// Runs the program in the folder, with arguments separated by spaces.
    pub fn run(&self, arguments: &str) -> Run {
        self.finish(Command::new(env!("CARGO_BIN_EXE_host-render")).args(arguments.split_whitespace()))
    }

    /// As [`run`](Self::run), with so many bytes of address space in all, where a shell can set that. One thread and one
    /// pool of memory, since every further one reserves 64 MiB of addresses that it may never use.
    #[allow(dead_code)]
    pub fn run_within(&self, bytes: usize, arguments: &str) -> Run {
        if !cfg!(target_os = "linux") {
            return self.run(arguments);
        }
        let limited = format!("ulimit -v {} && exec \"$0\" \"$@\"", bytes >> 10);
        self.finish(
            Command::new("sh")
                .args(["-c", &limited, env!("CARGO_BIN_EXE_host-render")])
                .args(arguments.split_whitespace())
                .env("RAYON_NUM_THREADS", "1")
                .env("MALLOC_ARENA_MAX", "1"),
        )
    }

    /// As [`run`](Self::run), where no other program is to be found.
    #[allow(dead_code)]
    pub fn run_alone(&self, arguments: &str) -> Run {
        self.finish(
            Command::new(env!("CARGO_BIN_EXE_host-render"))
                .args(arguments.split_whitespace())
                .env("PATH", ""),
        )
    }

    fn finish(&self, command: &mut Command) -> Run {
        let Output { status, stdout, stderr } =
            command.current_dir(self.0.path()).output().expect("the program starts");
        Run {
            code: status.code(),
            out: String::from_utf8(stdout).expect("UTF-8"),
            err: String::from_utf8(stderr).expect("UTF-8"),
        }
    }

    /// The names in the folder, in order.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<_> = std::fs::read_dir(self.0.path())
            .expect("a readable folder")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }
}
