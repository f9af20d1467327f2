//! `cargo xtask first-hour`: does what `docs/first-hour.md` says, word for word, in an empty folder.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use fixel_host::picture::Picture;
use fixel_host::png;

use crate::failure::Failure;
use crate::image::root;

/// What the page says to do.
#[derive(Debug, PartialEq)]
enum Step<'p> {
    /// Write a file, named as seen from the new program's folder.
    File { name: &'p str, text: String },
    /// Run commands.
    Shell(String),
    /// What the commands before have printed.
    Output(String),
}

/// Follows the page with the compiler in use, if that has the target's library, else with Debian's.
pub fn run(update_picture: bool) -> Result<(), Failure> {
    let page = read(&root().join("docs/first-hour.md"))?;
    let way = if has_library("thumbv7em-none-eabihf") {
        "rustup"
    } else {
        "debian"
    };
    println!("docs/first-hour.md, with what it says of {way}");
    let steps = steps(&page, way);
    let folder = tempfile::tempdir().map_err(|e| Failure::trouble("temporary folder", e))?;
    let there = folder.path();
    link(root(), &there.join("fixel"))?;
    let script = script(&steps, there)?;
    shell(&script, there)?;
    compare(&steps, there)?;

    let drawn = ppm(&fs::read(there.join("cube/cube.ppm")).map_err(|e| Failure::trouble("cube.ppm", e))?)?;
    let picture = root().join("docs/first-hour.png");
    if update_picture {
        let bytes = png::encode(&drawn).map_err(|e| Failure::trouble("the picture", e))?;
        return fs::write(&picture, bytes).map_err(|e| Failure::trouble(picture.display(), e));
    }
    let bytes = fs::read(&picture).map_err(|e| Failure::trouble(picture.display(), e))?;
    let shown = png::decode(Cursor::new(bytes)).map_err(|e| Failure::trouble(picture.display(), e))?;
    if shown == drawn {
        println!("every file and command, and the picture: as the page says");
        Ok(())
    } else {
        Err(Failure::Off(format!(
            "{} is not what the program draws",
            picture.display()
        )))
    }
}

/// The page's blocks that are to be followed: ```` ```sh ````, ```` ```… file=NAME ```` and ```` ```text output ````. What has to
/// be installed is taken to be there.
fn steps<'p>(page: &'p str, way: &str) -> Vec<Step<'p>> {
    let mut steps = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        let Some(info) = line.strip_prefix("```") else { continue };
        let text: String = lines
            .by_ref()
            .take_while(|line| *line != "```")
            .flat_map(|line| [line, "\n"])
            .collect();
        let words: Vec<_> = info.split_whitespace().collect();
        match words.as_slice() {
            ["sh"] => steps.push(Step::Shell(text)),
            ["sh", of] if *of == way => steps.push(Step::Shell(text)),
            ["text", "output"] => steps.push(Step::Output(text)),
            [_, name] => {
                if let Some(name) = name.strip_prefix("file=") {
                    steps.push(Step::File { name, text });
                }
            }
            _ => {}
        }
    }
    steps
}

/// One script for all steps, since what is exported and where one is holds for those after. It stops at what fails.
fn script(steps: &[Step<'_>], there: &Path) -> Result<String, Failure> {
    let mut script = "set -e\n".to_owned();
    for (i, step) in steps.iter().enumerate() {
        match step {
            Step::Shell(text) => script += &format!("{{\n{text}}} > '{}'\n", printed(there, i).display()),
            Step::Output(_) => {}
            Step::File { name, text } => {
                let file = there.join(format!("file-{i}"));
                fs::write(&file, text).map_err(|e| Failure::trouble(file.display(), e))?;
                if *name == "Cargo.toml" {
                    script += &format!("cp Cargo.toml '{}'\n", there.join("made-by-cargo").display());
                }
                script += &format!("mkdir -p \"$(dirname '{name}')\"\ncp '{}' '{name}'\n", file.display());
            }
        }
    }
    Ok(script)
}

/// Where step `index` prints to.
fn printed(there: &Path, index: usize) -> PathBuf {
    there.join(format!("printed-{index}"))
}

/// What was printed and what cargo has written, against the page.
fn compare(steps: &[Step<'_>], there: &Path) -> Result<(), Failure> {
    for (i, step) in steps.iter().enumerate() {
        let (expected, found) = match step {
            Step::Output(text) => (text.as_str(), read(&printed(there, i.saturating_sub(1)))?),
            Step::File {
                name: "Cargo.toml",
                text,
            } => {
                let made = read(&there.join("made-by-cargo"))?;
                if text.starts_with(&made) {
                    continue;
                }
                (text.as_str(), made)
            }
            _ => continue,
        };
        if expected != found {
            return Err(Failure::Off(format!("the page says\n{expected}but there was\n{found}")));
        }
    }
    Ok(())
}

/// Runs the script as a user's shell would: nothing of the cargo that runs this.
fn shell(script: &str, there: &Path) -> Result<(), Failure> {
    let mut shell = Command::new("sh");
    shell.arg("-c").arg(script).current_dir(there).stdin(Stdio::null());
    let ours = |name: &str| name.starts_with("CARGO") && name != "CARGO_HOME" || name.starts_with("RUSTC");
    for (name, _) in std::env::vars_os() {
        if ours(&name.to_string_lossy()) || name == "RUSTFLAGS" || name == "LD_LIBRARY_PATH" {
            shell.env_remove(name);
        }
    }
    let status = shell.status().map_err(|e| Failure::trouble("sh", e))?;
    if status.success() {
        Ok(())
    } else {
        Err(Failure::Off(format!("a command of the page failed: {status}")))
    }
}

/// Whether the compiler in use can build for `target` as it is.
fn has_library(target: &str) -> bool {
    let asked = Command::new("rustc").args(["--print", "sysroot"]).output();
    let sysroot = asked.ok().and_then(|output| String::from_utf8(output.stdout).ok());
    sysroot.is_some_and(|path| {
        Path::new(path.trim())
            .join("lib/rustlib")
            .join(target)
            .join("lib")
            .is_dir()
    })
}

/// A binary PPM file.
fn ppm(bytes: &[u8]) -> Result<Picture, Failure> {
    let fault = || Failure::Off("cube.ppm is no picture".to_owned());
    let end = bytes.iter().position(|&byte| byte == b'\n').ok_or_else(fault)?;
    let (header, pixels) = bytes.split_at(end + 1);
    let header = String::from_utf8_lossy(header);
    let numbers: Vec<u32> = header
        .split_whitespace()
        .skip(1)
        .filter_map(|word| word.parse().ok())
        .collect();
    let [width, height, 255] = *numbers else {
        return Err(fault());
    };
    let (pixels, []) = pixels.as_chunks::<3>() else {
        return Err(fault());
    };
    if pixels.len() != (width * height) as usize {
        return Err(fault());
    }
    Ok(Picture::new(
        width,
        height,
        pixels.iter().map(|&[r, g, b]| [r, g, b, 255]).collect(),
    ))
}

fn read(file: &Path) -> Result<String, Failure> {
    fs::read_to_string(file).map_err(|e| Failure::trouble(file.display(), e))
}

#[cfg(unix)]
fn link(from: &Path, to: &Path) -> Result<(), Failure> {
    let from = std::path::absolute(from).map_err(|e| Failure::trouble(from.display(), e))?;
    std::os::unix::fs::symlink(from, to).map_err(|e| Failure::trouble(to.display(), e))
}

#[cfg(not(unix))]
fn link(_: &Path, _: &Path) -> Result<(), Failure> {
    Err(Failure::Usage("the page is for Unix shells".to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_become_steps() {
        let page = "```sh install rustup\nno\n```\n```sh debian\na\n```\n```sh rustup\nno\n```\n```toml file=a/b.toml\nx\n\ny\n```\n\
                    ```sh\nb\nc\n```\n```text output\nd\n```\n    no\n```rust\nno\n```\n";
        let expected = [
            Step::Shell("a\n".into()),
            Step::File {
                name: "a/b.toml",
                text: "x\n\ny\n".into(),
            },
            Step::Shell("b\nc\n".into()),
            Step::Output("d\n".into()),
        ];
        assert_eq!(steps(page, "debian"), expected);
    }
}
