//! The README is true: its command draws its picture and prints its line.

use std::path::Path;
use std::process::Command;

#[test]
fn the_main_command_draws_the_picture_shown() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_host-render"))
        .current_dir(&root)
        .args(["tests/scenes/prisms.txt", "--out-dir"])
        .arg(folder.path())
        .output()
        .unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{printed}");

    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let shown = readme
        .lines()
        .find_map(|line| line.trim().strip_prefix("tests/scenes/prisms.txt: "))
        .unwrap();
    let shown = shown.trim_end_matches(" …").trim_end_matches(',');
    assert!(
        printed.contains(shown),
        "README shows: {shown}\nhost-render prints: {printed}"
    );

    let picture = std::fs::read(folder.path().join("prisms.png")).unwrap();
    assert!(
        picture == std::fs::read(root.join("docs/prisms.png")).unwrap(),
        "docs/prisms.png is stale"
    );
}

/// The README's example is the one of the crate's documentation, which runs.
#[test]
fn the_example_is_the_tested_one() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let [readme, lib] = ["README.md", "src/lib.rs"].map(|file| std::fs::read_to_string(root.join(file)).unwrap());
    for line in ["let mut picture", "let corners", "draw::triangle"] {
        let of = |text: &str| {
            let found = text.lines().find(|l| l.contains(line)).unwrap_or_default();
            found.trim_start_matches("//!").trim().to_owned()
        };
        assert_eq!(of(&readme), of(&lib));
    }
}

/// The README's instruction counts are those that the firmware's limits hold.
#[test]
fn the_figures_are_the_stored_ones() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let limits = std::fs::read_to_string(root.join("firmware/limits.json")).unwrap();
    let limits: serde_json::Value = serde_json::from_str(&limits).unwrap();
    let count = |shape: &str| {
        let counts = &limits["m4"]["counts"][shape];
        ["instructions", "pixels"].map(|key| counts[key].as_f64().unwrap_or_else(|| panic!("{shape}: no {key}")))
    };
    let rows = [
        ("flat", "flat"),
        ("flat, 16-bit depth", "flat_depth"),
        ("Gouraud", "gouraud"),
        ("Gouraud, 16-bit depth", "gouraud_depth"),
    ];
    for (name, kind) in rows {
        // The same rows, twice as long.
        let ([wide, more], [narrow, fewer]) = (count(&format!("{kind}/wide")), count(&format!("{kind}/narrow")));
        let row = format!("| {name} | {:.1} |", (wide - narrow) / (more - fewer));
        assert!(readme.contains(&row), "README should show {row}");
    }
}
