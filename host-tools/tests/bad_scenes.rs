//! Every bad scene of the conformance set gets its line and column, exit code 2, and no output.

mod bad_iv;
mod program;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;

use program::Folder;

#[test]
fn every_bad_scene_has_its_place() {
    let Some(conformance) = std::env::var_os("FIXEL_CONFORMANCE").map(PathBuf::from) else {
        say("SKIPPED: FIXEL_CONFORMANCE is not set, so no bad scene of the conformance set was compared");
        return;
    };
    let bad = conformance.join("bad");
    let table = std::fs::read_to_string(bad.join("EXPECT.tsv")).expect("EXPECT.tsv");
    let mut compared = BTreeMap::from([("hw2", 0), ("mp1", 0)]);
    for row in table.lines().skip(1) {
        let fields: Vec<_> = row.split('\t').collect();
        let [format, file, line, column, fault] = fields[..] else {
            panic!("not a row of EXPECT.tsv: {row}");
        };
        if let Some(count) = compared.get_mut(format) {
            let text = std::fs::read(bad.join(format).join(file)).expect(file);
            let place = format!("{file}: line {line}, column {column}: ");
            check(format, file, &text, &place, fault);
            *count += 1;
        }
    }
    for (format, count) in compared {
        assert!(count > 0, "EXPECT.tsv has no scene of format {format}");
        say(&format!("{count} bad {format} scenes compared"));
    }
}

/// The columns of the offending tokens; the manifest has lines only, so of scenes that are not in this list the column may
/// be any.
const COLUMNS: [(&str, usize); 13] = [
    ("bad-unclosed", 67),
    ("bad-unknown-block", 1),
    ("bad-unknown-field", 14),
    ("bad-not-a-number", 25),
    ("bad-index-range", 36),
    ("bad-normal-range", 61),
    ("bad-no-normals", 1),
    ("bad-open-face", 38),
    ("bad-two-corners", 36),
    ("bad-no-camera", 1),
    ("bad-near-zero", 34),
    ("bad-short-triple", 35),
    ("bad-empty", 1),
];

#[test]
fn every_bad_inventor_scene_has_its_place() {
    let Some(scenes) = bad_iv::bad_scenes() else {
        say("SKIPPED: FIXEL_CONFORMANCE is not set, so no bad Inventor scene of the conformance set was compared");
        return;
    };
    for scene in &scenes {
        let column = COLUMNS.iter().find(|(name, _)| *name == scene.name);
        let column = column.map_or(String::new(), |(_, column)| format!("{column}: "));
        let place = format!("{}: line {}, column {column}", scene.file, scene.line.unwrap_or(1));
        check("iv", &scene.file, &scene.text, &place, &scene.name);
    }
    let known = |name: &str| scenes.iter().any(|scene| scene.name == name);
    assert!(
        COLUMNS.iter().all(|(name, _)| known(name)),
        "the manifest lacks a scene"
    );
    say(&format!("{} bad iv scenes compared", scenes.len()));
}

/// Past the test harness, which swallows what `eprintln!` says in a test that passes.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

fn check(format: &str, file: &str, text: &[u8], start: &str, fault: &str) {
    let folder = Folder::new();
    folder.write(file, text);
    let arguments = format!("--format {format} {file}");
    let run = folder.run(&arguments);
    assert!(
        run.err.starts_with(start),
        "{fault}: expected {start}, found {}",
        run.err
    );
    assert_eq!(run.code, Some(2), "{fault}");
    assert_eq!(run.out, "", "{fault}");
    assert_eq!(folder.names(), [file], "{fault}: something was written");

    folder.write("out.png", "precious");
    let run = folder.run(&format!("{arguments} -o out.png"));
    assert_eq!(run.code, Some(2), "{fault}");
    assert_eq!(folder.read("out.png"), b"precious", "{fault}");
    assert_eq!(folder.names().len(), 2, "{fault}: something was left behind");
}
