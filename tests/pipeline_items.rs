//! Every item of the course has a test of its name, and a row in `docs/pipeline.md`.

use std::fs;
use std::path::Path;

/// Items of the conventions, of chapters 00 to 11, and of the playground.
const CHAPTERS: [(&str, usize); 14] = [
    ("c", 5),
    ("00", 2),
    ("01", 4),
    ("02", 4),
    ("03", 6),
    ("04", 6),
    ("05", 8),
    ("06", 8),
    ("07", 10),
    ("08", 4),
    ("09", 4),
    ("10", 6),
    ("11", 4),
    ("pg", 13),
];

#[test]
fn every_item_has_a_test_and_a_row() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut tests = Vec::new();
    // The playground's are the host tools': `examples/playground.rs` is compiled there.
    let folders = ["tests", "host-tools/tests"].map(|folder| fs::read_dir(root.join(folder)).unwrap());
    for entry in folders.into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.file_name().unwrap().to_string_lossy().starts_with("pipeline_") {
            let text = fs::read_to_string(path).unwrap();
            let lines: Vec<_> = text.lines().collect();
            // Only what runs: the line before is the attribute.
            let run = lines.windows(2).filter(|two| two[0] == "#[test]");
            tests.extend(run.filter_map(|two| Some(two[1].strip_prefix("fn ")?.split('(').next()?.to_string())));
        }
    }
    let table = fs::read_to_string(root.join("docs/pipeline.md")).unwrap();
    for (chapter, items) in CHAPTERS {
        for item in 1..=items {
            let name = format!("item_{chapter}_{item}_");
            let named: Vec<_> = tests.iter().filter(|test| test.starts_with(&name)).collect();
            assert!(!named.is_empty(), "no test {name}…");
            for test in named {
                assert!(table.contains(&format!("`{test}`")), "docs/pipeline.md lacks {test}");
            }
        }
    }
    // And the table names no test that is none.
    for named in table.split('`').filter(|word| word.starts_with("item_")) {
        assert!(tests.iter().any(|test| test == named), "docs/pipeline.md names {named}");
    }
}
