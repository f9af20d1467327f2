//! The README is true: its command draws its picture and prints its line.

use std::path::Path;
use std::process::Command;

#[test]
fn the_main_command_draws_the_picture_shown() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let readme = readme();
    let command = "    cargo run --release --bin host-render -- ";
    let scene = readme.lines().find_map(|line| line.strip_prefix(command)).unwrap();
    // As from the project's root, where pictures are ignored, but in a folder of its own.
    let folder = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_host-render"))
        .current_dir(&folder)
        .arg(std::path::absolute(root.join(scene)).unwrap())
        .output()
        .unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{printed}");

    let shown = readme
        .lines()
        .find_map(|line| line.trim().strip_prefix(&format!("{scene}: ")))
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

/// What the firmware's limits say a drawing took on a machine: instructions, and pixels covered; `None` where it is not counted.
fn stored(machine: &str, drawing: &str) -> Option<[f64; 2]> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let limits = std::fs::read_to_string(root.join("firmware/limits.json")).unwrap();
    let limits: serde_json::Value = serde_json::from_str(&limits).unwrap();
    let counts = limits[machine]["counts"].get(drawing)?;
    let count = |key: &str| counts[key].as_f64();
    Some([count("instructions")?, count("pixels")?])
}

fn readme() -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md")).unwrap()
}

/// The README's inner loops are those that the firmware's limits hold.
#[test]
fn the_inner_loops_are_the_stored_ones() {
    let rows = [
        ("flat", "flat"),
        ("flat, 16-bit depth", "flat_depth"),
        ("Gouraud", "gouraud"),
        ("Gouraud, 16-bit depth", "gouraud_depth"),
    ];
    let expected = rows.map(|(name, kind)| {
        // The same rows, twice as long.
        let [wide, more] = stored("m4", &format!("{kind}/wide")).unwrap();
        let [narrow, fewer] = stored("m4", &format!("{kind}/narrow")).unwrap();
        format!("| {name} | {:.1} |\n", (wide - narrow) / (more - fewer))
    });
    let expected = expected.concat();
    assert!(readme().contains(&expected), "README should show\n{expected}");
}

/// So are its workloads.
#[test]
fn the_workloads_are_the_stored_ones() {
    let per_pixel = |[instructions, pixels]: [f64; 2]| format!("{:.2}", instructions / pixels);
    let per_triangle = |[instructions, _]: [f64; 2]| format!("{:.0}", instructions / 2000.0);
    let per_frame = |[instructions, _]: [f64; 2]| format!("{:.2} M", instructions / 1e6);
    type Figure<'a> = &'a dyn Fn([f64; 2]) -> String;
    let rows: [(&str, &str, Figure<'_>); 9] = [
        ("W1", "one flat triangle, per pixel", &per_pixel),
        (
            "W2",
            "Gouraud with depth, half of it hidden, per covered pixel",
            &per_pixel,
        ),
        ("W2_compact", "the same in less flash (`fragment::Compact`)", &per_pixel),
        (
            "W3_exact",
            "textured in perspective with depth, a division per pixel",
            &per_pixel,
        ),
        (
            "W3_spans",
            "the same within half a texel, without a division",
            &per_pixel,
        ),
        ("W4", "triangles of 10 px, Gouraud with depth, each", &per_triangle),
        ("W4_compact", "the same in less flash", &per_triangle),
        (
            "W5",
            "a mesh of 5,804 triangles, transformed, lit, culled, drawn",
            &per_frame,
        ),
        ("W5_strips", "the same in 15 strips", &per_frame),
    ];
    let row = |(key, title, figure): (&str, &str, Figure<'_>)| {
        // Strips are counted on the boards only.
        let figures = ["m4", "m0", "riscv", "host"].map(|machine| stored(machine, key).map_or("–".into(), figure));
        format!("| {title} | {} |\n", figures.join(" | "))
    };
    let expected = rows.map(row).concat();
    assert!(readme().contains(&expected), "README should show\n{expected}");
}

/// So is its flash.
#[test]
fn the_flash_is_the_stored_one() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let stored = std::fs::read_to_string(root.join("firmware/sizes.json")).unwrap();
    let stored: serde_json::Value = serde_json::from_str(&stored).unwrap();
    let bytes = &stored["thumbv7em-none-eabihf"]["bytes"];
    let rows = [
        ("W2", "Gouraud with depth, from corners on the screen"),
        ("W2_compact", "the same, compact"),
        ("flat", "flat, transformed and clipped"),
        ("flat_compact", "the same, compact"),
        ("gouraud", "Gouraud with depth, transformed and clipped"),
        ("gouraud_compact", "the same, compact"),
        (
            "textured",
            "textured in perspective with depth, transformed and clipped",
        ),
        ("textured_compact", "the same, compact"),
        ("everything", "everything"),
    ];
    let expected = rows.map(|(set, title)| {
        let kib = |profile: &str| {
            let bytes = bytes[format!("{set}/{profile}")].as_f64();
            bytes.map_or("–".into(), |bytes| format!("{:.1}", bytes / 1024.0))
        };
        format!("| {title} | {} | {} |\n", kib("s"), kib("3"))
    });
    let expected = expected.concat();
    assert!(readme().contains(&expected), "README should show\n{expected}");
}

/// So is what the tiers trade.
#[test]
fn the_tiers_are_the_stored_ones() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let stored = std::fs::read_to_string(root.join("firmware/trade.json")).unwrap();
    let stored: serde_json::Value = serde_json::from_str(&stored).unwrap();
    let mut rows = 0;
    for sweep in stored["sweeps"].as_array().unwrap() {
        let points = sweep["points"].as_array().unwrap();
        if points.iter().all(|point| point["dial"] != "fast") {
            // Of single dials that no tier sets: `docs/trade.md` has them.
            continue;
        }
        let title = match sweep["scene"].as_str().unwrap() {
            "flat" => "flat mesh",
            "gouraud" => "Gouraud mesh",
            "textured" => "textured in perspective",
            "lit" => "lit per pixel",
            other => panic!("{other}: not in the README"),
        };
        for tier in ["fast", "balanced", "exact"] {
            let point = points.iter().find(|point| point["dial"] == tier).unwrap();
            let number = |key: &str| point[key].as_f64().unwrap();
            let costs = ["m4", "m0", "riscv"].map(|machine| number(machine) / sweep["pixels"].as_f64().unwrap());
            let expected = format!(
                "| {title} | {tier} | {} | {:.3} | {:.2} | {:.1} % |\n",
                costs.map(|cost| format!("{cost:.1}")).join(" | "),
                number("mean_error"),
                number("p999_error"),
                100.0 * number("differing_share")
            );
            assert!(readme().contains(&expected), "README should show\n{expected}");
            rows += 1;
        }
    }
    assert_eq!(rows, 12);
}
