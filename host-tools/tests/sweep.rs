//! What speed costs in accuracy: tiers, dials, and the table of both.

mod program;

use std::path::{Path, PathBuf};

use fixel_host::fixed::dials::{CHANGES, Dials, Tier};
use fixel_host::fixed::{self, FixedPicture};
use fixel_host::scene::iv::Shading;
use fixel_host::scene::{Scene, hw2, iv, mp1};
use program::{Folder, Run};
use serde_json::Value;

/// A lit floor that runs away from the viewer, with every colour of its own: all dials of HW2 matter.
const SCENE: &str = "\
png 64 48 floor.png
frustum -1 1 -.75 .75 1 100
normal 0 1 .2
color 1 .2 .2
xyz -3 -1 -2
color .2 1 .2
normal .5 1 0
xyz 3 -1 -2
color .2 .2 1
normal -.5 1 0
xyz 0 0 -20
color 1 1 1
xyz 0 2 -4
bulb 4
shininess 8
trig 1 2 3
";

/// Whether costs are instructions here.
fn has_valgrind() -> bool {
    let version = std::process::Command::new("valgrind").arg("--version").output();
    let found = version.is_ok_and(|output| output.status.success());
    if !found {
        println!("SKIPPED: valgrind is not installed, so that no instructions were counted");
    }
    found
}

fn object(run: &Run) -> Value {
    serde_json::from_str(&run.out).unwrap_or_else(|error| panic!("{error}: {run:?}"))
}

fn points(sweep: &Value) -> &Vec<Value> {
    sweep["points"].as_array().expect("points")
}

fn point<'s>(sweep: &'s Value, name: &str) -> &'s Value {
    let found = points(sweep).iter().find(|point| point["name"] == name);
    found.unwrap_or_else(|| panic!("no {name} in {sweep}"))
}

fn number(point: &Value, key: &str) -> f64 {
    point[key].as_f64().unwrap_or_else(|| panic!("{key} in {point}"))
}

#[test]
fn json_has_the_keys_that_stay_and_exact_is_the_plain_run() {
    let folder = Folder::new();
    let run = folder.write("a.txt", SCENE).run("sweep a.txt --json");
    assert_eq!(run.code, Some(0), "{run:?}");
    let sweep = object(&run);
    assert_eq!(sweep["scene"], "a.txt");
    assert_eq!(folder.names(), ["a.txt"], "a sweep writes no pictures");
    for point in points(&sweep) {
        for key in "max_error p999_error mean_error differing_share coverage_differs cost".split(' ') {
            assert!(number(point, key) >= 0.0, "{key} in {point}");
        }
        assert!(point["name"].is_string() && point["pareto"].is_boolean() && point["cost_unit"].is_string());
    }
    let names: Vec<_> = points(&sweep)
        .iter()
        .filter_map(|point| point["name"].as_str())
        .collect();
    assert_eq!(names[..3], ["exact", "balanced", "fast"]);
    assert!(names.contains(&"exact+perspective=affine") && names.contains(&"exact+lighting=vertex"));

    let plain = object(&folder.run("a.txt --json"));
    let exact = point(&sweep, "exact");
    assert_eq!(exact["max_error"], plain["max_channel_error"]);
    assert_eq!(exact["coverage_differs"], plain["coverage_differs"]);
    assert_eq!(sweep["pixels_drawn"], plain["pixels_drawn"]);
    let classes = plain["explained"].as_object().expect("classes").values();
    let differing: f64 = classes.filter_map(Value::as_f64).sum();
    // The two pictures cover the same pixels, so that the share is of these.
    assert_eq!(plain["coverage_differs"], 0);
    assert_eq!(
        number(exact, "differing_share"),
        differing / number(&plain, "pixels_drawn")
    );
}

#[test]
fn the_front_is_what_nothing_beats() {
    let folder = Folder::new();
    let sweep = object(&folder.write("a.txt", SCENE).run("sweep a.txt --json"));
    for p in points(&sweep) {
        let beats = |q: &&Value| {
            let less = |key| number(q, key) < number(p, key);
            let more = |key| number(q, key) > number(p, key);
            (less("cost") || less("mean_error")) && !more("cost") && !more("mean_error")
        };
        let beaten = points(&sweep).iter().find(beats);
        assert_eq!(p["pareto"], beaten.is_none(), "{p} is beaten by {beaten:?}");
    }
    assert!(points(&sweep).iter().any(|point| point["pareto"] == true));
}

#[test]
fn tiers_are_cheaper_the_less_exact_they_are() {
    if !has_valgrind() {
        return;
    }
    let folder = Folder::new();
    let sweep = object(&folder.write("a.txt", SCENE).run("sweep a.txt --json"));
    let [fast, balanced, exact] = ["fast", "balanced", "exact"].map(|name| point(&sweep, name));
    assert_eq!(exact["cost_unit"], "instructions");
    let costs = [fast, balanced, exact].map(|point| number(point, "cost"));
    assert!(costs.is_sorted() && costs[0] * 2.0 < costs[2], "{costs:?}");
    let errors = [exact, balanced, fast].map(|point| number(point, "mean_error"));
    assert!(errors.is_sorted(), "{errors:?}");
}

#[test]
fn without_valgrind_costs_are_seconds() {
    let folder = Folder::new();
    let run = folder.write("a.txt", SCENE).run_alone("sweep a.txt --json");
    assert_eq!(run.code, Some(0), "{run:?}");
    let sweep = object(&run);
    for point in points(&sweep) {
        assert_eq!(point["cost_unit"], "seconds");
        assert!(number(point, "cost") > 0.0, "{point}");
    }
    let run = folder.run_alone("sweep a.txt --max-instructions 30");
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(run.err.contains("needs valgrind"), "{}", run.err);
}

#[test]
fn the_table_and_the_rows_say_the_same() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE).write("b,.txt", SCENE);
    let run = folder.run_alone("sweep a.txt b,.txt --csv");
    assert_eq!(run.code, Some(0), "{run:?}");
    let rows: Vec<_> = run.out.lines().collect();
    assert_eq!(
        rows[0],
        "scene,name,max_error,p999_error,mean_error,differing_share,coverage_differs,cost,cost_unit,pareto"
    );
    let sweep = object(&folder.run_alone("sweep a.txt --json"));
    assert_eq!(rows.len(), 1 + 2 * points(&sweep).len());
    for (row, p) in rows[1..].iter().zip(points(&sweep)) {
        let fields: Vec<_> = row.split(',').collect();
        assert_eq!(fields.len(), 10, "{row}");
        assert_eq!([fields[0], fields[1]], ["a.txt", p["name"].as_str().expect("a name")]);
        let near = |field: &str, wanted: f64| {
            let number: f64 = field.parse().expect("a number");
            // JSON's reader may be a unit in the last place off.
            assert!((number - wanted).abs() <= 1e-15 * wanted, "{number} {wanted} in {row}");
        };
        for (field, key) in fields[2..]
            .iter()
            .zip(["max_error", "p999_error", "mean_error", "differing_share"])
        {
            near(field, number(p, key));
        }
    }
    assert!(
        rows.last().is_some_and(|row| row.starts_with("\"b,.txt\",")),
        "{rows:?}"
    );

    let table = folder.run_alone("sweep a.txt").out;
    for p in points(&sweep) {
        let name = p["name"].as_str().expect("a name");
        let line = table
            .lines()
            .find(|line| line[1..].trim_start().starts_with(&format!("{name} ")));
        let line = line.unwrap_or_else(|| panic!("no {name} in {table}"));
        assert!(line.contains(&format!("{:.3}", number(p, "mean_error"))), "{line}");
    }
}

#[test]
fn a_budget_is_answered() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE);
    let run = folder.run_alone("sweep a.txt --max-error 255");
    assert_eq!(run.code, Some(0), "{run:?}");
    let last = run.out.lines().last().expect("lines");
    assert!(
        last.starts_with("at most 255 levels on 99.9 % of the pixels: "),
        "{last}"
    );
    let sweep = object(&folder.run_alone("sweep a.txt --max-error 1 --json"));
    let best = sweep["recommended"].as_str().expect("exact at least");
    assert!(number(point(&sweep, best), "p999_error") <= 1.0);
    if has_valgrind() {
        let run = folder.run("sweep a.txt --max-error 1 --max-instructions 0.5");
        assert_eq!(run.code, Some(1), "{run:?}");
        assert!(run.out.ends_with("instructions per pixel: nothing\n"), "{}", run.out);
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE).write("bad.txt", "png 1 1 c.png\nxyz");
    for (arguments, code) in [
        ("sweep", 2),
        ("sweep a.txt --json --csv", 2),
        ("sweep a.txt --max-error 256", 2),
        ("sweep a.txt --max-error -1", 2),
        ("sweep a.txt --max-instructions 0", 2),
        ("sweep a.txt --max-instructions nan", 2),
        ("sweep a.txt --size 9x9", 2),
        ("sweep a.txt --draw superb", 2),
        ("sweep bad.txt", 2),
        ("sweep none.txt", 3),
        ("a.txt --quality superb", 2),
        ("a.txt --quality", 2),
    ] {
        let run = folder.run_alone(arguments);
        assert_eq!(run.code, Some(code), "{arguments}: {run:?}");
        assert!(!run.err.is_empty() && run.out.is_empty(), "{arguments}: {run:?}");
    }
    let run = folder.run_alone("sweep bad.txt a.txt --json");
    assert_eq!(run.code, Some(2), "{run:?}");
    let objects: Vec<Value> = run
        .out
        .lines()
        .filter_map(|line| serde_json::from_str(line).ok())
        .collect();
    assert!(
        objects[0]["error"].is_string() && objects[1]["points"].is_array(),
        "{run:?}"
    );
}

#[test]
fn a_tier_that_is_not_exact_says_so() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE);
    let default = folder.run("a.txt --json");
    let exact = folder.run("a.txt --quality exact --json -o e.png");
    assert_eq!((default.code, exact.code), (Some(0), Some(0)), "{exact:?}");
    assert_eq!(folder.read("floor.png"), folder.read("e.png"));
    assert_eq!(object(&exact)["quality"], "exact");
    // What is beyond the bounds of exact is no less unexplained for having been asked for.
    let fast = folder.run("a.txt --quality fast -o f.png");
    assert_eq!(fast.code, Some(1), "{fast:?}");
    assert!(fast.out.starts_with("a.txt: 64x48, quality fast, "), "{}", fast.out);
    assert!(fast.out.contains("unexplained by the bounds of exact"), "{}", fast.out);
    assert_ne!(folder.read("floor.png"), folder.read("f.png"));
    assert_eq!(
        object(&folder.run("a.txt --quality balanced --json"))["quality"],
        "balanced"
    );
}

#[test]
fn pictures_with_wide_edges_are_exact_only() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE.replace("64 48", "4097 2"));
    assert_eq!(folder.run("a.txt").code, Some(0));
    for arguments in ["a.txt --quality fast", "sweep a.txt"] {
        let run = folder.run(arguments);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(run.err.contains("4097 samples a side"), "{}", run.err);
    }
}

/// Every scene at hand, by name; faces small and lit at every pixel.
fn scenes() -> Vec<(String, Scene)> {
    let Some(folder) = std::env::var_os("FIXEL_CONFORMANCE").map(PathBuf::from) else {
        println!("SKIPPED: FIXEL_CONFORMANCE is not set, so that no official scene was drawn");
        return Vec::new();
    };
    let mut scenes = Vec::new();
    for format in ["hw2", "mp1", "iv"] {
        let folder = folder.join(format);
        let files = std::fs::read_dir(&folder).expect("the folder exists");
        for file in files.map(|file| file.expect("a file").path()) {
            if let Some(scene) = scene(&file, &folder) {
                scenes.push((file.display().to_string(), scene));
            }
        }
    }
    scenes
}

fn scene(file: &Path, folder: &Path) -> Option<Scene> {
    let text = || std::fs::read(file).expect("readable");
    let name = file.display();
    let kind = file.extension()?.to_str()?;
    Some(match (folder.file_name()?.to_str()?, kind) {
        ("hw2", "txt") => Scene::Hw2(hw2::parse(text(), folder).unwrap_or_else(|fault| panic!("{name}: {fault}"))),
        ("mp1", "txt") => Scene::Mp1(mp1::parse(text(), folder).unwrap_or_else(|fault| panic!("{name}: {fault}"))),
        ("iv", "iv") => Scene::Iv(iv::Scene {
            width: 120,
            height: 90,
            output: String::new(),
            shading: Shading::Phong,
            eyelight: true,
            model: iv::parse(text()).unwrap_or_else(|fault| panic!("{name}: {fault}")),
        }),
        _ => return None,
    })
}

#[test]
fn no_dial_changes_what_is_covered() {
    let scenes = scenes();
    for (name, scene) in &scenes {
        let exact = fixed::draw(scene, Dials::default()).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        let tiers = [Tier::Fast, Tier::Balanced].map(Dials::of);
        let changes = CHANGES.iter().map(|change| change.of(Dials::default()));
        for dials in tiers.into_iter().chain(changes) {
            let picture = fixed::draw(scene, dials).unwrap_or_else(|fault| panic!("{name}: {fault}"));
            assert!(covered(&picture) == covered(&exact), "{name}, {dials:?}");
            let mut depths = picture.depth.iter().zip(&exact.depth);
            assert!(depths.all(|(a, b)| a.abs_diff(*b) <= 1), "{name}, {dials:?}");
        }
    }
    println!("{} scenes, {} settings each", scenes.len(), 3 + CHANGES.len());
}

fn covered(picture: &FixedPicture) -> Vec<bool> {
    picture.pixels.iter().map(|pixel| pixel.primitive != 0).collect()
}
