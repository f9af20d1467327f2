//! Whether an image of everything calls everything: every public function of the core, as the compiler understands the calls.
//!
//! ```text
//! sources -> copy in which every public function is deprecated, by a note of where it is
//!         -> cargo check -> warnings of calls in the image's sources -> functions that no warning names
//! ```
//!
//! Names alone would not do: `new` is many functions.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::failure::Failure;
use crate::image::{root, target_dir, write_if_new};

/// What the copy is made of. Cargo looks for the examples that a manifest names.
const COPIED: [&str; 3] = ["src", "examples", "firmware"];
const FILES: [&str; 3] = ["Cargo.toml", "Cargo.lock", "README.md"];

/// The package that calls everything, and those of its sources that the image of everything runs.
const CALLER: &str = "fixel-workloads";
const CALLERS: [&str; 2] = ["workloads/src/everything.rs", "workloads/src/scenes/"];

/// For a feature that images of the core alone do not have.
const FEATURE: &str = "src/eg.rs";

/// Functions that a core has at least: by it one sees that they are found.
const FEWEST: usize = 200;

/// What calls and definitions came to.
#[derive(Debug, Default)]
struct Seen {
    /// Where functions are that something calls.
    called: BTreeSet<String>,
    /// Where functions are that are public in name only, in a module that is not.
    hidden: BTreeSet<String>,
}

/// Public functions of the core that the image of everything does not call; prints how many there are.
pub fn uncalled() -> Result<Vec<String>, Failure> {
    // Whole: cargo runs in a folder of the copy.
    let copy = std::path::absolute(target_dir().join("called")).map_err(|e| Failure::trouble("target directory", e))?;
    let functions = mark(&copy)?;
    let seen = look(&copy)?;
    let public: Vec<_> = functions
        .iter()
        .filter(|(place, _)| !seen.hidden.contains(*place))
        .collect();
    let mut off = complaints(&public, &seen.called);
    if public.len() < FEWEST {
        off.push(format!("{} public functions: too few to be all of them", public.len()));
    }
    println!(
        "{} public functions of the core, {} of them called by the image of everything",
        public.len(),
        public.iter().filter(|(place, _)| seen.called.contains(*place)).count()
    );
    Ok(off)
}

fn complaints(public: &[(&String, &String)], called: &BTreeSet<String>) -> Vec<String> {
    let missing = public.iter().filter(|(place, _)| !called.contains(*place));
    missing
        .map(|(place, name)| format!("{place}: {name} is called by no image"))
        .collect()
}

/// Writes the copy, its public functions marked; their names by where they are.
fn mark(copy: &Path) -> Result<BTreeMap<String, String>, Failure> {
    let mut functions = BTreeMap::new();
    for name in FILES {
        let from = root().join(name);
        write_if_new(
            &copy.join(name),
            &fs::read(&from).map_err(|e| Failure::trouble(from.display(), e))?,
        )?;
    }
    for folder in COPIED {
        let to = copy.join(folder);
        if to.is_dir() {
            // What is no more must not be there either; what stays keeps the build's own folder.
            remove_strays(&to, &root().join(folder))?;
        }
        for file in files(&root().join(folder))? {
            let place = file.strip_prefix(root()).unwrap_or(&file);
            let bytes = fs::read(&file).map_err(|e| Failure::trouble(file.display(), e))?;
            let name = place.to_string_lossy().replace('\\', "/");
            let bytes = match String::from_utf8(bytes) {
                Ok(text) if folder == "src" && name != FEATURE => deprecated(&name, &text, &mut functions).into_bytes(),
                Ok(text) => text.into_bytes(),
                Err(other) => other.into_bytes(),
            };
            write_if_new(&copy.join(place), &bytes)?;
        }
    }
    Ok(functions)
}

/// The text with a mark before every `pub fn` but those in comments, line by line as it was.
fn deprecated(file: &str, text: &str, functions: &mut BTreeMap<String, String>) -> String {
    let mut marked = String::with_capacity(text.len() * 2);
    for (line, number) in text.split_inclusive('\n').zip(1..) {
        if let Some(name) = public_function(line) {
            let place = format!("{file}:{number}");
            marked += &format!("#[deprecated(note = \"{place}\")] ");
            functions.insert(place, name.to_owned());
        }
        marked += line;
    }
    marked
}

/// The name of the `pub fn` that a line begins.
fn public_function(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix("pub ")?;
    let rest = rest.strip_prefix("const ").unwrap_or(rest).strip_prefix("fn ")?;
    rest.split(['(', '<']).next()
}

/// What the compiler says of the copy.
fn look(copy: &Path) -> Result<Seen, Failure> {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args([
        "check",
        "--quiet",
        "--locked",
        "--message-format=json",
        "--package",
        CALLER,
        "--target-dir",
    ]);
    cargo.arg(copy.join("target")).current_dir(copy.join("firmware"));
    cargo
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .env("RUSTFLAGS", "-Wdeprecated -Wunreachable_pub");
    let output = cargo.output().map_err(|e| Failure::trouble("cargo check", e))?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        return Err(Failure::Off(format!(
            "the image of everything does not compile:\n{errors}"
        )));
    }
    let mut seen = Seen::default();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        if let Ok(message) = serde_json::from_str(line) {
            seen.note(&message, copy)?;
        }
    }
    Ok(seen)
}

impl Seen {
    /// Takes in one message of the compiler.
    fn note(&mut self, message: &Value, copy: &Path) -> Result<(), Failure> {
        let message = &message["message"];
        let span = &message["spans"][0];
        let (Some(file), Some(line)) = (span["file_name"].as_str(), span["line_start"].as_u64()) else {
            return Ok(());
        };
        // As the compiler was told it: from the folder of a workspace, or whole.
        let file = copy.join("firmware").join(file);
        match message["code"]["code"].as_str() {
            Some("unreachable_pub") => {
                if let Ok(place) = file.strip_prefix(copy) {
                    self.hidden
                        .insert(format!("{}:{line}", place.to_string_lossy().replace('\\', "/")));
                }
            }
            Some("deprecated") => {
                let name = file.to_string_lossy().replace('\\', "/");
                let note = message["message"].as_str().and_then(|text| text.rsplit_once(": "));
                if let Some((_, place)) = note
                    && CALLERS.iter().any(|caller| name.contains(caller))
                    && !imports(&read(&file)?).contains(&line)
                {
                    self.called.insert(place.to_owned());
                }
            }
            _ => {}
        }
        Ok(())
    }
}

/// Numbers of the lines that import names: naming is not calling.
fn imports(text: &str) -> BTreeSet<u64> {
    let mut lines = BTreeSet::new();
    let mut is_import = false;
    for (line, number) in text.lines().zip(1..) {
        is_import |= ["use ", "pub use "]
            .iter()
            .any(|start| line.trim_start().starts_with(start));
        if is_import {
            lines.insert(number);
        }
        is_import &= !line.contains(';');
    }
    lines
}

fn read(file: &Path) -> Result<String, Failure> {
    fs::read_to_string(file).map_err(|e| Failure::trouble(file.display(), e))
}

/// Removes from a copy the files that the original has no more.
fn remove_strays(copy: &Path, original: &Path) -> Result<(), Failure> {
    for file in files(copy)? {
        let place = file.strip_prefix(copy).unwrap_or(&file);
        if !original.join(place).is_file() {
            fs::remove_file(&file).map_err(|e| Failure::trouble(file.display(), e))?;
        }
    }
    Ok(())
}

/// The files below a directory, but for those that builds left there.
fn files(directory: &Path) -> Result<Vec<PathBuf>, Failure> {
    let trouble = |e| Failure::trouble(directory.display(), e);
    let mut found = Vec::new();
    for entry in fs::read_dir(directory).map_err(trouble)? {
        let path = entry.map_err(trouble)?.path();
        if !path.is_dir() {
            found.push(path);
        } else if !path.ends_with("target") {
            found.extend(files(&path)?);
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn public_functions_are_marked_where_they_are() {
        let source = "/// pub fn no()\n    pub const fn one(x: i32) {}\npub fn two<T>() {}\npub(crate) fn three() {}\n";
        let mut functions = BTreeMap::new();
        let marked = deprecated("src/a.rs", source, &mut functions);
        assert_eq!(marked.lines().count(), source.lines().count());
        assert_eq!(
            marked
                .matches("#[deprecated(note = \"src/a.rs:2\")]     pub const fn one")
                .count(),
            1
        );
        let functions: Vec<_> = functions
            .iter()
            .map(|(place, name)| (place.as_str(), name.as_str()))
            .collect();
        assert_eq!(functions, [("src/a.rs:2", "one"), ("src/a.rs:3", "two")]);
    }

    #[test]
    fn an_uncalled_function_is_found() {
        let functions = [
            ("src/a.rs:2".to_owned(), "new".to_owned()),
            ("src/b.rs:2".to_owned(), "new".to_owned()),
        ];
        let public: Vec<_> = functions.iter().map(|(place, name)| (place, name)).collect();
        let called = BTreeSet::from(["src/a.rs:2".to_owned()]);
        assert_eq!(complaints(&public, &called), ["src/b.rs:2: new is called by no image"]);
    }

    #[test]
    fn imports_are_not_calls() {
        let text = "//! use of it\nuse a::{\n    b,\n};\nfn f() {\n    b();\n    pub use c;\n}\n";
        assert_eq!(imports(text), BTreeSet::from([2, 3, 4, 7]));
    }

    #[test]
    fn what_the_compiler_says_is_understood() {
        let copy = root().join("no-such-copy");
        let message = |code: &str, file: &str, text: &str| {
            serde_json::json!({"message": {
                "code": {"code": code}, "message": text, "spans": [{"file_name": file, "line_start": 7}],
            }})
        };
        let mut seen = Seen::default();
        let hidden = copy.join("src/small.rs");
        seen.note(
            &message("unreachable_pub", &hidden.to_string_lossy(), "unreachable `pub` item"),
            &copy,
        )
        .unwrap_or_else(|failure| panic!("{failure}"));
        assert_eq!(seen.hidden, BTreeSet::from(["src/small.rs:7".to_owned()]));
        // Another file of the same package: none of the image's.
        let elsewhere = message(
            "deprecated",
            "workloads/src/frame.rs",
            "use of deprecated function `f`: src/a.rs:2",
        );
        assert!(seen.note(&elsewhere, &copy).is_ok() && seen.called.is_empty());
    }
}
