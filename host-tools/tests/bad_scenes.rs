//! Every bad scene of the conformance set gets its line and column, exit code 2, and no output.

mod program;

use std::io::Write;
use std::path::PathBuf;

use program::Folder;

#[test]
fn every_bad_hw2_scene_has_its_place() {
    let Some(conformance) = std::env::var_os("FIXEL_CONFORMANCE").map(PathBuf::from) else {
        say("SKIPPED: FIXEL_CONFORMANCE is not set, so no bad scene of the conformance set was compared");
        return;
    };
    let bad = conformance.join("bad");
    let table = std::fs::read_to_string(bad.join("EXPECT.tsv")).expect("EXPECT.tsv");
    let mut compared = 0;
    for row in table.lines().skip(1) {
        let fields: Vec<_> = row.split('\t').collect();
        let [format, file, line, column, fault] = fields[..] else {
            panic!("not a row of EXPECT.tsv: {row}");
        };
        if format == "hw2" {
            let text = std::fs::read(bad.join(format).join(file)).expect(file);
            check(file, &text, &format!("{file}: line {line}, column {column}: "), fault);
            compared += 1;
        }
    }
    assert!(compared > 0, "EXPECT.tsv has no HW2 scene");
    say(&format!("{compared} bad HW2 scenes compared"));
}

/// Past the test harness, which swallows what `eprintln!` says in a test that passes.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

fn check(file: &str, text: &[u8], start: &str, fault: &str) {
    let folder = Folder::new();
    folder.write(file, text);
    let arguments = format!("--format hw2 {file}");
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
