//! The contract of `shaded`: what goes to which stream, and how a run ends.

mod bad_iv;
mod program;

use std::fs::{self, File};
use std::io::{Cursor, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use fixel_host::picture::Picture;
use fixel_host::png;
use program::{Folder, Run};

const SCENE: &str = "PerspectiveCamera { }\n";

/// Runs the program with a file as its standard input.
fn shaded(arguments: &str, input: &Path, output: Stdio) -> Run {
    let child = Command::new(env!("CARGO_BIN_EXE_shaded"))
        .args(arguments.split_whitespace())
        .stdin(File::open(input).expect("an input"))
        .stdout(output)
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let output = child.wait_with_output().expect("it ends");
    Run {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).expect("UTF-8"),
        err: String::from_utf8(output.stderr).expect("UTF-8"),
    }
}

/// Exit code 1, nothing on standard output, and on standard error a line that begins with `start`.
fn refused(run: &Run, start: &str) {
    assert_eq!(run.code, Some(1), "{run:?}");
    assert_eq!(run.out, "", "{}", run.err);
    assert!(run.err.starts_with(start), "expected {start:?}, found {}", run.err);
    assert!(run.err.ends_with('\n') && run.err.lines().count() == 1, "{}", run.err);
}

/// Where `name` was written with `text` in it.
fn written(folder: &Folder, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
    folder.write(name, text).path(name)
}

#[test]
fn every_bad_scene_is_one_line() {
    let Some(scenes) = bad_iv::bad_scenes() else {
        let skipped = "SKIPPED: FIXEL_CONFORMANCE is not set, so shaded was given no bad scene of the conformance set";
        // Past the test harness, which swallows what `eprintln!` says in a test that passes.
        let _ = writeln!(std::io::stderr(), "{skipped}");
        return;
    };
    let folder = Folder::new();
    for scene in &scenes {
        let input = written(&folder, &scene.file, &scene.text);
        let start = scene.line.map(|line| format!("line {line}: "));
        for arguments in ["1 50 50", "0 3 4 -eyelight"] {
            println!("{}", scene.name);
            let run = shaded(arguments, &input, Stdio::piped());
            refused(&run, start.as_deref().unwrap_or("no PerspectiveCamera"));
        }
    }
    assert!(!scenes.is_empty());
    let _ = writeln!(std::io::stderr(), "{} bad iv scenes given to shaded", scenes.len());
}

#[test]
fn what_is_not_a_command_line_is_one_line() {
    let folder = Folder::new();
    let input = written(&folder, "s.iv", SCENE);
    for (arguments, start) in [
        ("", "usage: shaded n xRes yRes [-eyelight]"),
        ("1 50", "usage: "),
        ("1 50 50 50", "usage: "),
        ("1 50 50 -eyelight 1", "usage: "),
        ("-eyelight 1 50 50", "usage: "),
        ("--help", "usage: "),
        ("--version", "usage: "),
        ("3 50 50", "n must be 0 (flat), 1 (Gouraud) or 2 (Phong)"),
        ("1 0 50", "the width must be from 1 to 16384"),
        ("1 50 -1", "the height must be a whole number"),
        ("1 50 1e2", "the height must be a whole number"),
        ("1 50 99999999999", "the height must be from 1 to 16384"),
        ("1 16384 4097", "16384 x 4097 are more than 67108864 pixels"),
    ] {
        refused(&shaded(arguments, &input, Stdio::piped()), start);
    }
}

#[test]
fn faults_of_the_whole_text_have_no_line() {
    let folder = Folder::new();
    for text in ["", "# nothing\n", "Separator { }\n\n\n"] {
        let input = written(&folder, "s.iv", text);
        let run = shaded("1 5 5", &input, Stdio::piped());
        refused(&run, "no PerspectiveCamera\n");
    }
    let input = written(&folder, "s.iv", b"PerspectiveCamera {\n \xFF }");
    refused(
        &shaded("1 5 5", &input, Stdio::piped()),
        "line 2: the text is not UTF-8",
    );
    #[cfg(unix)]
    refused(
        &shaded("1 5 5", &folder.path("."), Stdio::piped()),
        "cannot read standard input: ",
    );
}

/// The numbers of a plain PPM file.
fn ppm(text: &str) -> Picture {
    let mut words = text.split_whitespace();
    assert_eq!(words.next(), Some("P3"));
    let mut number = || -> Option<u32> { words.next().map(|word| word.parse().expect("a number")) };
    let (width, height) = (number().expect("a width"), number().expect("a height"));
    assert_eq!(number(), Some(255));
    let numbers: Vec<u8> = std::iter::from_fn(number)
        .map(|n| n.try_into().expect("a byte"))
        .collect();
    let (pixels, rest) = numbers.as_chunks();
    assert_eq!((pixels.len(), rest.len()), ((width * height) as usize, 0));
    Picture::new(width, height, pixels.iter().map(|&[r, g, b]| [r, g, b, 255]).collect())
}

/// The picture is `host-render`'s, in every mode; what nothing covers is black.
#[test]
fn the_picture_is_that_of_host_render() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/scenes");
    let folder = Folder::new();
    for scene in ["lit-room", "tunnel", "nested"] {
        let input = scenes.join(scene).with_extension("iv");
        let text = fs::read(&input).expect("our own scene");
        folder.write("s.iv", text);
        for (n, shading) in ["flat", "gouraud", "phong"].into_iter().enumerate() {
            for (ours, theirs) in [("", ""), ("-eyelight", "--eyelight")] {
                let run = shaded(&format!("{n} 90 70 {ours}"), &input, Stdio::piped());
                assert_eq!((run.code, run.err.as_str()), (Some(0), ""), "{scene} {shading}");
                let rendered = folder.run(&format!("s.iv --size 90x70 --shading {shading} {theirs}"));
                assert_eq!(rendered.code, Some(0), "{rendered:?}");
                let theirs = png::decode(Cursor::new(folder.read("s.png"))).expect("a PNG file");
                assert_eq!(folder.names(), ["s.iv", "s.png"]);
                let ours = ppm(&run.out);
                assert_eq!(ours.size(), theirs.size());
                let differ = |(a, b): (&[u8; 4], &[u8; 4])| a[..3] != b[..3] || (b[3] == 0 && a[..3] != [0; 3]);
                let pairs = ours.pixels.iter().zip(&theirs.pixels);
                assert_eq!(pairs.filter(|&pair| differ(pair)).count(), 0, "{scene} {shading}");
                assert!(ours.pixels.iter().any(|pixel| pixel[0] > 0), "{scene} {shading}: black");
            }
        }
    }
}

#[test]
fn a_scene_without_anything_is_black() {
    let folder = Folder::new();
    let input = written(&folder, "s.iv", SCENE);
    let run = shaded("1 2 1", &input, Stdio::piped());
    assert_eq!((run.code, run.err.as_str()), (Some(0), ""));
    let words: Vec<_> = run.out.split_whitespace().collect();
    assert_eq!(words, ["P3", "2", "1", "255", "0", "0", "0", "0", "0", "0"]);
    assert!(run.out.starts_with("P3\n2 1\n255\n"), "{:?}", run.out);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_noticed() {
    let folder = Folder::new();
    let input = written(&folder, "s.iv", SCENE);
    for size in ["1 1", "900 700"] {
        let full = File::options().write(true).open("/dev/full").expect("a device");
        let run = shaded(&format!("1 {size}"), &input, full.into());
        refused(&run, "cannot write to standard output: ");
    }
}

#[test]
fn a_closed_pipe_is_noticed() {
    for size in ["1 1", "900 700"] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_shaded"))
            .args(format!("1 {size}").split(' '))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        // It waits for its scene until there is nobody to read the picture.
        drop(child.stdout.take());
        let mut input = child.stdin.take().expect("a pipe");
        input.write_all(SCENE.as_bytes()).expect("it listens");
        drop(input);
        let mut err = String::new();
        let mut stderr = child.stderr.take().expect("a pipe");
        stderr.read_to_string(&mut err).expect("UTF-8");
        let run = Run {
            code: child.wait().expect("it ends").code(),
            out: String::new(),
            err,
        };
        refused(&run, "cannot write to standard output: ");
    }
}
