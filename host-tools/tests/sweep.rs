//! What speed costs in accuracy: tiers, dials, and the table of both.

mod program;

use std::any::type_name;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use fixel::quality::{Balanced, Exact, Fast, Quality};
use fixel_host::fixed::dials::{Colors, Dials, Perspective, Precision, Tier, Trigonometry};
use fixel_host::fixed::output::Output;
use fixel_host::fixed::{self, FixedPicture};
use fixel_host::picture::Picture;
use fixel_host::png;
use fixel_host::scene::iv::Shading;
use fixel_host::scene::{Scene, hw2, iv, mp1};
use fixel_host::sweep::settings;
use program::{Folder, Run};
use serde_json::Value;

/// A lit floor that runs away from the viewer, turned a little, with every colour of its own: all dials of HW2 matter, but that of
/// textures.
const SCENE: &str = "\
png 64 48 floor.png
frustum -1 1 -.75 .75 1 100
rotatez 20
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

/// Two textured triangles, the one that is drawn later behind the other.
const TEXTURED: &str = "\
png 40 30 out.png
frustum -1 1 -1 1 1 9
texture board.png
texcoord 0 0
xyz -2 -2 -2
texcoord 0 3
xyz -2 2 -3
texcoord 3 0
xyz 2 -2 -3
trit 1 2 3
texcoord 1 1
xyz -2 -2 -5
xyz -2 2 -5
xyz 2 -2 -5
trit 4 5 6
";

/// Two shiny faces, turned, under one light.
const MODEL: &str = "\
#Inventor V2.0 ascii
PerspectiveCamera { position 0 0 5 orientation 0 0 1 0 nearDistance 1 farDistance 10
  left -.5 right .5 top .5 bottom -.5 }
PointLight { location 1 2 3 color 1 .5 1 }
Separator {
  Transform { translation 0 0 0 rotation 1 1 0 .7 scaleFactor 1 1 1 }
  Material { ambientColor .2 .2 .2 diffuseColor .6 .6 .6 specularColor 1 1 1 shininess 5 }
  Coordinate3 { point [ -1 -1 0, 1 -1 0, 1 1 0, -1 1 0 ] }
  Normal { vector [ -1 -1 1, 1 -1 1, 1 1 1, -1 1 1 ] }
  IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 2, 3, -1 ] normalIndex [ 0, 1, 2, -1, 0, 2, 3, -1 ] }
}
";

/// Two triangles in sRGB and perspective, the one that is drawn later in front.
const BLENDED: &str = "\
png 20 30 out.png
sRGB
hyp
depth
rgb 255 0 0
xyzw -1 -1 .5 1
rgb 0 127 0
xyzw -1 1 1 2
rgb 0 0 255
xyzw 2 0 1 2
tri 1 2 3
rgb 119 0 153
xyzw 1 1 0 1
tri 1 2 4
";

/// Red and white, blue and black.
fn board() -> Vec<u8> {
    let pixels = vec![[255, 0, 0, 255], [255; 4], [0, 0, 255, 255], [0, 0, 0, 255]];
    png::encode(&Picture::new(2, 2, pixels)).expect("a picture")
}

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

/// The sweep of the scene, made once: counting takes its time.
static SWEPT: LazyLock<Value> = LazyLock::new(|| {
    let folder = Folder::new();
    let run = folder.write("a.txt", SCENE).run("sweep a.txt --json");
    assert_eq!(run.code, Some(0), "{run:?}");
    assert_eq!(folder.names(), ["a.txt"], "a sweep writes no pictures");
    object(&run)
});

#[test]
fn json_has_the_keys_that_stay_and_exact_is_the_plain_run() {
    let (folder, sweep) = (Folder::new(), &*SWEPT);
    folder.write("a.txt", SCENE);
    assert_eq!(sweep["scene"], "a.txt");
    for point in points(sweep) {
        for key in "max_error p999_error mean_error differing_share coverage_differs cost".split(' ') {
            assert!(number(point, key) >= 0.0, "{key} in {point}");
        }
        assert!(point["name"].is_string() && point["pareto"].is_boolean() && point["cost_unit"].is_string());
    }
    let names: Vec<_> = points(sweep)
        .iter()
        .filter_map(|point| point["name"].as_str())
        .collect();
    assert_eq!(names[..3], ["exact", "balanced", "fast"]);
    assert!(names.contains(&"exact+perspective=affine") && names.contains(&"exact+lighting=vertex"));

    let plain = object(&folder.run("a.txt --json"));
    let exact = point(sweep, "exact");
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
    let sweep = &*SWEPT;
    for p in points(sweep) {
        let beats = |q: &&Value| {
            let less = |key| number(q, key) < number(p, key);
            let more = |key| number(q, key) > number(p, key);
            (less("cost") || less("mean_error")) && !more("cost") && !more("mean_error")
        };
        let beaten = points(sweep).iter().find(beats);
        assert_eq!(p["pareto"], beaten.is_none(), "{p} is beaten by {beaten:?}");
    }
    assert!(points(sweep).iter().any(|point| point["pareto"] == true));
}

#[test]
fn tiers_are_cheaper_the_less_exact_they_are() {
    if !has_valgrind() {
        return;
    }
    let sweep = &*SWEPT;
    let [fast, balanced, exact] = ["fast", "balanced", "exact"].map(|name| point(sweep, name));
    assert_eq!(exact["cost_unit"], "instructions");
    let costs = [fast, balanced, exact].map(|point| number(point, "cost"));
    assert!(costs[0] < costs[1] && costs[1] < costs[2], "{costs:?}");
    let errors = [exact, balanced, fast].map(|point| number(point, "mean_error"));
    assert!(errors.is_sorted(), "{errors:?}");
}

/// Dials that change what is seen of every scene that they matter for; others may change the cost alone.
const VISIBLE: [&str; 5] = [
    "perspective=affine",
    "lighting=vertex",
    "colors=packed",
    "sampling=linear",
    "linear-light=off",
];

/// The names of the dials that a sweep turns; where costs are counted, each has changed something.
fn turned(folder: &Folder, arguments: &str, counted: bool) -> Vec<String> {
    let arguments = format!("sweep {arguments} --json");
    let run = if counted {
        folder.run(&arguments)
    } else {
        folder.run_alone(&arguments)
    };
    assert_eq!(run.code, Some(0), "{run:?}");
    let sweep = object(&run);
    let exact = point(&sweep, "exact");
    let differs = |point: &Value, key: &str| point[key] != exact[key];
    let dials = points(&sweep).iter().filter_map(|point| {
        let dial = point["name"].as_str()?.strip_prefix("exact+")?;
        let errors = differs(point, "mean_error") || differs(point, "max_error");
        let shows = VISIBLE.contains(&dial) || counted && !differs(point, "cost");
        assert!(errors || !shows, "{point} is {exact}");
        Some(dial.to_owned())
    });
    dials.collect()
}

#[test]
fn dials_that_do_something_are_shown_and_no_other() {
    let counted = has_valgrind();
    let folder = Folder::new();
    folder.write("floor.txt", SCENE).write("textured.txt", TEXTURED);
    folder.write("board.png", board()).write("model.iv", MODEL);
    folder.write("blended.txt", BLENDED).write(
        "flat.txt",
        "png 9 9 a.png\nxyz -1 -1 0\nxyz -1 1 0\nxyz 1 -1 0\ntrif 1 2 3\n",
    );
    let perspective = "perspective=32-bit perspective=spans perspective=affine ";
    let precision = "precision=one-step precision=table ";
    let output = "output=565 output=565-dither output=1-bit";
    for (arguments, dials) in [
        ("flat.txt", format!("depth=off {output}")),
        (
            "floor.txt",
            format!("{perspective}{precision}trigonometry=short lighting=vertex depth=off {output}"),
        ),
        ("textured.txt", format!("{perspective}sampling=linear {output}")),
        (
            "blended.txt",
            format!("{perspective}depth=off linear-light=off {output}"),
        ),
        (
            "model.iv --size 30x30 --shading flat",
            format!("{precision}trigonometry=short depth=off {output}"),
        ),
        (
            "model.iv --size 30x30 --shading gouraud",
            format!("{precision}trigonometry=short colors=32-bit colors=packed depth=off {output}"),
        ),
        (
            "model.iv --size 30x30 --shading phong",
            format!("{perspective}{precision}trigonometry=short lighting=vertex depth=off {output}"),
        ),
    ] {
        let wanted: Vec<_> = dials.split(' ').collect();
        // Counting takes its time: two scenes have all dials that may change nothing but the cost.
        let counted = counted && (arguments == "floor.txt" || arguments.ends_with("gouraud"));
        assert_eq!(turned(&folder, arguments, counted), wanted, "{arguments}");
    }
}

/// What the core calls a type, without the path and what follows it.
fn name<T>() -> &'static str {
    let name = type_name::<T>();
    let name = name.split('<').next().unwrap_or(name);
    name.rsplit("::").next().unwrap_or(name)
}

#[test]
fn the_tiers_are_those_of_the_core() {
    fn names<Q: Quality>() -> [&'static str; 3] {
        [
            name::<Q::Perspective<2>>(),
            name::<Q::Precision>(),
            name::<Q::Trigonometry>(),
        ]
    }
    for (tier, wanted) in [
        (Tier::Fast, names::<Fast>()),
        (Tier::Balanced, names::<Balanced>()),
        (Tier::Exact, names::<Exact>()),
    ] {
        let dials = Dials::of(tier);
        let perspective = match dials.perspective {
            Perspective::Exact => "Perspective",
            Perspective::Narrow => "Perspective32",
            Perspective::Spans => "PerspectiveSpans",
            Perspective::Affine => "Linear32",
        };
        let precision = match dials.precision {
            Precision::TwoSteps => "TwoSteps",
            Precision::OneStep => "OneStep",
            Precision::Table => "Table",
        };
        let trigonometry = match dials.trigonometry {
            Trigonometry::Long => "SineTable",
            Trigonometry::Short => "ShortSine",
        };
        assert_eq!([perspective, precision, trigonometry], wanted, "{tier}");
        let rest = Dials {
            perspective: Perspective::Exact,
            precision: Precision::TwoSteps,
            trigonometry: Trigonometry::Long,
            ..dials
        };
        assert_eq!(rest, Dials::default(), "{tier}: all else is the scene's choice");
    }
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
        "scene,name,max_error,p999_error,mean_error,differing_share,coverage_differs,cost,cost_unit,pareto,mean_error_4x4"
    );
    let sweep = object(&folder.run_alone("sweep a.txt --json"));
    assert_eq!(rows.len(), 1 + 2 * points(&sweep).len());
    for (row, p) in rows[1..].iter().zip(points(&sweep)) {
        let fields: Vec<_> = row.split(',').collect();
        assert_eq!(fields.len(), 11, "{row}");
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
        near(fields[10], number(p, "mean_error_4x4"));
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
        assert!(line.contains(&format!("{:.3}", number(p, "mean_error_4x4"))), "{line}");
    }
    assert!(table.lines().all(|line| line.len() <= 100), "{table}");
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
    folder.write("a.txt", TEXTURED).write("board.png", board());
    let default = folder.run("a.txt --json");
    let exact = folder.run("a.txt --quality exact --json -o e.png");
    assert_eq!((default.code, exact.code), (Some(0), Some(0)), "{exact:?}");
    assert_eq!(folder.read("out.png"), folder.read("e.png"));
    assert_eq!(object(&exact)["quality"], "exact");
    // What is beyond the bounds of exact is no less unexplained for having been asked for.
    let fast = folder.run("a.txt --quality fast -o f.png");
    assert_eq!(fast.code, Some(1), "{fast:?}");
    assert!(fast.out.starts_with("a.txt: 40x30, quality fast, "), "{}", fast.out);
    assert!(fast.out.contains("unexplained by the bounds of exact"), "{}", fast.out);
    assert_ne!(folder.read("out.png"), folder.read("f.png"));
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
    let exact = folder.read("out.png");
    for (arguments, what) in [("a.txt --quality fast", "--quality fast"), ("sweep a.txt", "a sweep")] {
        let run = folder.run(arguments);
        assert_eq!(run.code, Some(2), "{run:?}");
        // Of the options: no line of the scene is wrong.
        let told = format!("a.txt: 4097 samples a side are too many for {what}: it takes at most 4096\n");
        assert_eq!(run.err, told);
    }
    let run = folder.run_alone("sweep a.txt --max-instructions 30");
    assert!(
        run.err.contains("needs valgrind"),
        "asked before the sweep: {}",
        run.err
    );

    // A report shows what there is.
    folder.write("out.png", "");
    let run = folder.run("a.txt --report r.html --sweep");
    assert_eq!(run.code, Some(0), "{run:?}");
    assert!(folder.read("out.png") == exact);
    let page = String::from_utf8(folder.read("r.html")).expect("UTF-8");
    assert!(page.contains("No tiers to compare: 4097 samples a side are too many"));
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
fn no_dial_but_trigonometry_changes_what_is_covered() {
    let scenes = scenes();
    let mut drawn = 0;
    for (name, scene) in &scenes {
        let draw = |dials| fixed::draw(scene, dials).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        let exact = draw(Dials::default());
        for setting in settings(scene) {
            let turned = setting.dials.trigonometry != Trigonometry::default();
            let picture = draw(Dials {
                trigonometry: Trigonometry::default(),
                ..setting.dials
            });
            let name = format!("{name}, {}", setting.name);
            assert!(covered(&picture) == covered(&exact), "{name}");
            if setting.dials.no_depth {
                let bytes = |picture: &FixedPicture| picture.picture().pixels;
                assert!(
                    bytes(&picture) == bytes(&exact),
                    "{name}: nothing needs the depth buffer"
                );
            } else {
                let mut depths = picture.depth.iter().zip(&exact.depth);
                assert!(depths.all(|(a, b)| a.abs_diff(*b) <= 1), "{name}");
            }
            if turned {
                let turned = draw(setting.dials);
                assert!(
                    moved(&covered(&exact), &covered(&turned), exact.width as usize),
                    "{name}"
                );
            }
            drawn += 1;
        }
    }
    println!("{} scenes, {drawn} settings", scenes.len());
}

/// Whether what is covered differs by less than a pixel: where it does, a neighbour is as this one is not.
fn moved(exact: &[bool], turned: &[bool], width: usize) -> bool {
    let differing = (0..exact.len()).filter(|&i| exact[i] != turned[i]);
    differing.into_iter().all(|i| {
        let (x, y) = (i % width, i / width);
        let neighbours = (y.saturating_sub(1)..=y + 1).flat_map(|y| (x.saturating_sub(1)..=x + 1).map(move |x| (x, y)));
        let mut inside = neighbours.filter(|&(x, y)| x < width && y * width < exact.len());
        inside.any(|(x, y)| exact[y * width + x] == turned[i])
    })
}

#[test]
fn packed_colours_are_within_a_level_of_exact_ones() {
    let scenes = scenes().into_iter().filter_map(|(name, scene)| match scene {
        Scene::Iv(scene) => Some((
            name,
            Scene::Iv(iv::Scene {
                shading: Shading::Gouraud,
                ..scene
            }),
        )),
        _ => None,
    });
    let mut counts = [0; 2];
    for (name, scene) in scenes {
        let draw = |dials| fixed::draw(&scene, dials).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        let exact = Output::Rgb565.words(&draw(Dials::default()));
        let packed = Output::Rgb565.words(&draw(Dials {
            colors: Colors::Packed,
            ..Dials::default()
        }));
        for (exact, packed) in exact.into_iter().zip(packed) {
            let levels = |word: u16| [word >> 11, word >> 5 & 63, word & 31];
            let mut pairs = levels(exact).into_iter().zip(levels(packed));
            assert!(pairs.all(|(a, b)| a.abs_diff(b) <= 1), "{name}: {exact:#x} {packed:#x}");
            counts[0] += usize::from(exact != packed);
            counts[1] += 1;
        }
    }
    println!("{} of {} pixels differ by a level", counts[0], counts[1]);
}

fn covered(picture: &FixedPicture) -> Vec<bool> {
    picture.pixels.iter().map(|pixel| pixel.primitive != 0).collect()
}
