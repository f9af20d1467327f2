//! Emitted scenes, compiled: they draw the bytes of `host-render`, whole and strip by strip.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use fixel_host::args::Args;
use fixel_host::emit::{Emitted, emit, harness};
use fixel_host::load::load;

/// The root of the project.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the project")
}

/// Scenes of a folder in the formats with these endings.
fn scenes(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| {
        endings
            .iter()
            .any(|ending| file.extension().is_some_and(|e| e == *ending))
    });
    files.sort();
    files
}

fn emitted(file: &Path) -> (String, Emitted) {
    match file.extension().and_then(|e| e.to_str()) {
        Some("txt") => emitted_with(file, &[]),
        _ => emitted_with(file, &["--size", "60x40"]),
    }
}

/// With these words on the command line.
fn emitted_with(file: &Path, words: &[&str]) -> (String, Emitted) {
    let name = file.file_stem().unwrap().to_string_lossy().into_owned();
    let all = ["host-render", file.to_str().unwrap()];
    let args = Args::from(all.iter().chain(words)).unwrap();
    let loaded = load(file, &args).unwrap_or_else(|failure| panic!("{name}: {}", failure.failure.message));
    let emitted = emit(&loaded.scene, "a test").unwrap_or_else(|fault| panic!("{name}: {fault}"));
    (name, emitted)
}

const MAIN: &str = r#"
#![deny(warnings)]
#![forbid(unsafe_code)]

use std::io::Write;

fn main() {
    let rows: u16 = std::env::args().nth(1).and_then(|rows| rows.parse().ok()).expect("rows");
    let mut out = std::io::stdout().lock();
    for (_, width, height, level, strip) in emitted::SCENES {
        let mut top = 0;
        while top < height {
            let bottom = height.min(top.saturating_add(rows));
            let count = usize::from(width) * usize::from(bottom - top);
            let samples = count * usize::from(level) * usize::from(level);
            let mut memory = emitted::Memory {
                samples: &mut vec![fixel::blend::Rgba::default(); samples],
                bytes: &mut vec![[1; 4]; count],
                depths: &mut vec![0; samples],
            };
            strip(&mut memory, top, bottom).expect("the memory is large enough");
            out.write_all(memory.bytes.as_flattened()).expect("written");
            top = bottom;
        }
    }
}
"#;

/// A crate of all the scenes.
fn build(name: &str, scenes: &[(String, Emitted)]) -> PathBuf {
    let lib = format!(
        "#![no_std]\n#![deny(warnings)]\n#![forbid(unsafe_code)]\n\n{}",
        harness::file(scenes)
    );
    build_crate(name, &[("lib.rs", &lib), ("main.rs", MAIN)])
}

/// A crate of these sources, in a folder of its own; its program.
fn build_crate(name: &str, sources: &[(&str, &str)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(folder.join("src")).unwrap();
    let library = match sources.iter().any(|(file, _)| *file == "lib.rs") {
        true => "[lib]\nname = \"emitted\"\n\n",
        false => "",
    };
    let manifest = format!(
        "[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n{library}\
         [dependencies]\nfixel = {{ path = {:?} }}\n\n[profile.dev]\nopt-level = 1\ndebug = false\n\n[workspace]\n",
        root()
    );
    fs::write(folder.join("Cargo.toml"), manifest).unwrap();
    fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    for (file, text) in sources {
        fs::write(folder.join("src").join(file), text).unwrap();
    }
    // One for all, so that the core is compiled once.
    let target = folder.with_file_name("emitted-target");
    let built = Command::new(env!("CARGO"))
        .args(["build", "--offline", "--quiet", "--target-dir"])
        .arg(&target)
        .current_dir(&folder)
        .output()
        .expect("cargo runs");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    target.join("debug").join(name)
}

/// Compares the bytes of all scenes, drawn in strips of so many rows.
fn compare(program: &Path, rows: u16, scenes: &[(String, Emitted)]) {
    let output = Command::new(program).arg(rows.to_string()).output().expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut drawn = output.stdout.as_slice();
    let mut differing = Vec::new();
    for (name, emitted) in scenes {
        let wanted = emitted.bytes.as_flattened();
        let (bytes, rest) = drawn.split_at_checked(wanted.len()).expect("as many bytes as pixels");
        drawn = rest;
        let differ = wanted.chunks(4).zip(bytes.chunks(4)).filter(|(a, b)| a != b).count();
        if differ > 0 {
            differing.push(format!("{name}: {differ} pixels"));
        }
    }
    assert!(drawn.is_empty());
    assert!(differing.is_empty(), "in strips of {rows} rows differ {differing:#?}");
}

/// As rustfmt would have written it, on lines of its default length.
fn check_format(texts: &[(String, String)]) {
    let folder = tempfile::tempdir().unwrap();
    let write = |(name, text): &(String, String)| {
        let file = folder.path().join(format!("{name}.rs"));
        fs::write(&file, text).unwrap();
        file
    };
    let files: Vec<_> = texts.iter().map(write).collect();
    let checked = Command::new("rustfmt")
        .args(["--check", "--edition", "2024", "--config", "max_width=100"])
        .args(files)
        .output();
    match checked {
        Ok(output) => assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout)),
        Err(error) => eprintln!("SKIPPED: rustfmt does not run, no file's format is checked: {error}"),
    }
}

fn check(name: &str, files: &[PathBuf]) {
    let scenes: Vec<_> = files.iter().map(|file| emitted(file)).collect();
    check_emitted(name, &scenes);
}

fn check_emitted(name: &str, scenes: &[(String, Emitted)]) {
    let program = build(name, scenes);
    for rows in [u16::MAX, 16, 7] {
        compare(&program, rows, scenes);
    }
    let unneeded = scenes.iter().filter(|(_, e)| e.text.contains("NoDepth")).count();
    println!(
        "{name}: {} scenes compared, {unneeded} of them without depth buffer",
        scenes.len()
    );
}

#[test]
fn own_scenes_draw_the_same_bytes() {
    let mut files = scenes(&root().join("tests/scenes"), &["txt", "iv", "obj"]);
    // Fine patches and many lights: minutes to analyse without optimisation.
    let slow = ["hundred-lights.txt", "patches-fine.txt"];
    files.retain(|file| !slow.iter().any(|name| file.ends_with(name)));
    eprintln!("SKIPPED: {} take minutes", slow.join(", "));
    assert!(files.len() > 30);
    let folder = tempfile::tempdir().unwrap();
    let nothing = folder.path().join("nothing.txt");
    fs::write(&nothing, "png 8 8 nothing.png\n").unwrap();
    files.push(nothing);
    check("emitted-own", &files);
}

#[test]
fn conformance_scenes_draw_the_same_bytes() {
    let Some(folder) = std::env::var_os("FIXEL_CONFORMANCE") else {
        eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, no official scene is emitted");
        return;
    };
    let folder = Path::new(&folder);
    let mut files = scenes(&folder.join("hw2"), &["txt"]);
    files.extend(scenes(&folder.join("mp1"), &["txt"]));
    assert_eq!(files.len(), 48);
    let emitted: Vec<_> = files.iter().map(|file| emitted(file)).collect();
    let texts: Vec<_> = emitted.iter().map(|(name, e)| (name.clone(), e.text.clone())).collect();
    check_format(&texts);
    check("emitted-conformance", &files);
}

/// With Gouraud shading, the default, they are among the others.
#[test]
fn models_draw_the_same_bytes_with_any_shading() {
    let mut files = scenes(&root().join("tests/scenes"), &["iv", "obj"]);
    assert!(files.len() > 3);
    match std::env::var_os("FIXEL_CONFORMANCE") {
        Some(folder) => {
            let folder = Path::new(&folder).join("iv");
            files.extend(scenes(&folder, &["iv"]));
            files.extend(scenes(&folder.join("made"), &["iv"]));
            // Thousands of faces: most of a minute to compile.
            let slow = ["lion1.iv", "sphere.iv"];
            files.retain(|file| !slow.iter().any(|name| file.ends_with(name)));
            eprintln!("SKIPPED: {} take most of a minute", slow.join(", "));
        }
        None => eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, no official model is emitted"),
    }
    let cases = files
        .iter()
        .flat_map(|file| ["flat", "phong"].map(|shading| (file, shading)));
    let all: Vec<_> = cases
        .map(|(file, shading)| {
            let (name, emitted) = emitted_with(file, &["--size", "60x40", "--shading", shading]);
            (format!("{name}_{shading}"), emitted)
        })
        .collect();
    let programs = |of: &str| all.iter().filter(|(_, e)| e.text.contains(of)).count();
    assert!(
        programs("Glossy {") > 1 && programs("light::Matte") > 1,
        "both kinds of light at pixels"
    );
    let texts: Vec<_> = all.iter().map(|(name, e)| (name.clone(), e.text.clone())).collect();
    check_format(&texts);
    check_emitted("emitted-models", &all);
}

/// Draws an emitted mesh turned in some ways, as it says and triangle by triangle with a depth buffer.
const MESH_MAIN: &str = r#"
#![deny(warnings)]
#![forbid(unsafe_code)]

mod mesh;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::light::Sunlight;
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Angle, Block, Scaled, SineTable};
use fixel::target::Buffer;
use fixel::view::{Cull, View};
use fixel::viewport::Viewport;

const SIZE: u16 = 90;

fn main() {
    for frame in 0..24 {
        let turn = Matrix::rotation::<SineTable>(Angle::from_degrees(15 * frame), Block::from_integers([3, 5, 1]));
        let model = Matrix::translation(Block::from_integers([0, 0, -3])).product(&turn.unwrap());
        let camera = Matrix::frustum([-1, 1, -1, 1, 2, 5].map(Scaled::from_integer)).unwrap();
        let view = View::<i32, i32, 0> {
            projection: camera.product(&model),
            planes: Planes::default(),
            viewport: Viewport::new(0, 0, SIZE, SIZE).unwrap().y_up().samples_at_centers(),
            depth_range: DepthRange::MinusOneToOne,
            behind: Behind::Cut,
            cull: Cull::Clockwise,
        };
        let mut directions = Directions::identity();
        directions.load(&model);
        let light = Sunlight::new([1, 2, 3], &directions, [6 << 16; 3], [24 << 16; 3]).unwrap();
        let pictures = [mesh::as_emitted, mesh::one_by_one].map(|draw| {
            let (mut pixels, mut depths) = ([0; SIZE as usize * SIZE as usize], [FAR; SIZE as usize * SIZE as usize]);
            let mut color = Buffer::new(&mut pixels, SIZE, SIZE).unwrap();
            let depth = Buffer::new(&mut depths, SIZE, SIZE).unwrap();
            draw(&view, &light, &mut color, &mut DepthBuffer::<_, LessOrEqual>::new(depth));
            pixels
        });
        let [emitted, wanted] = pictures;
        assert!(emitted.iter().filter(|&&pixel| pixel != 0).count() > 500, "next to nothing in frame {frame}");
        assert!(emitted == wanted, "frame {frame} differs");
    }
    println!("24 frames");
}
"#;

/// What the module of a mesh gets besides: both ways to draw with the same parameters.
fn two_ways(flat: bool, depth: bool, compact: bool) -> String {
    let depth = if depth { ", depth" } else { "" };
    let one = if flat {
        "let [r, g, b] = light.shade(*normal).map(|c| c >> 16);
            let color_of = fixel::fragment::Flat(((r << 11) | (g << 5) | b) as u16);
            let carried = [(); 3];"
    } else {
        "let color_of = fixel::fragment::Gouraud565;
            let carried = triangle.map(|i| light.shade(NORMALS[usize::from(i)]));"
    };
    let drawn = if compact {
        "fixel::fragment::Compact(color_of)"
    } else {
        "color_of"
    };
    let zipped = if flat {
        "(triangle, normal) in TRIANGLES.iter().zip(&NORMALS)"
    } else {
        "triangle in &TRIANGLES"
    };
    format!(
        "
type Pixels<'a> = fixel::target::Buffer<'a, u16>;
type Depths<'a> = fixel::depth::DepthBuffer<fixel::target::Buffer<'a, u16>, fixel::depth::LessOrEqual>;

pub fn as_emitted(view: &View<i32, i32, 0>, light: &Sunlight, color: &mut Pixels, depth: &mut Depths) {{
    let _ = &depth;
    draw(view, light, &mut EMPTY.clone(), color{depth});
}}

pub fn one_by_one(view: &View<i32, i32, 0>, light: &Sunlight, color: &mut Pixels, depth: &mut Depths) {{
    use fixel::mesh::Normalized;
    for {zipped} {{
        {one}
        let mut carried = carried.into_iter();
        let corners = triangle.map(|i| fixel::view::Vertex {{
            position: POSITIONS[usize::from(i)].point(),
            carried: carried.next().unwrap(),
        }});
        fixel::draw::primitive(view, color, depth, &corners, &{drawn});
    }}
}}
"
    )
}

#[test]
fn meshes_draw_as_their_triangles_do() {
    let octahedron = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
        f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
    let folder = tempfile::tempdir().unwrap();
    let octahedron_file = folder.path().join("octahedron.obj");
    fs::write(&octahedron_file, octahedron).unwrap();
    let vase = root().join("tests/scenes/vase.obj");
    let cases = [
        (octahedron_file.to_str().unwrap(), "flat", false, false),
        (octahedron_file.to_str().unwrap(), "gouraud", false, true),
        (vase.to_str().unwrap(), "flat", true, true),
        (vase.to_str().unwrap(), "gouraud", true, false),
        (vase.to_str().unwrap(), "gouraud", true, true),
    ];
    for (file, shading, depth, compact) in cases {
        let out = folder.path().join("mesh.rs");
        let mut words = vec![file, "--mesh", "--shading", shading, "-o", out.to_str().unwrap()];
        if compact {
            words.push("--compact");
        }
        let (code, told) = command(&words);
        assert_eq!(code, Some(0), "{told}");
        assert_eq!(told.contains("compact code"), compact, "{told}");
        assert_eq!(told.contains("depth buffer: none"), !depth, "{told}");
        let text = fs::read_to_string(&out).unwrap();
        check_format(&[("mesh".to_owned(), text.clone())]);
        let module = text + &two_ways(shading == "flat", depth, compact);
        let program = build_crate("emitted-mesh", &[("mesh.rs", &module), ("main.rs", MESH_MAIN)]);
        let output = Command::new(program).output().expect("it runs");
        assert!(
            output.status.success(),
            "{file} {shading} {compact}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
}

#[test]
fn only_meshes_are_compact() {
    let scene = root().join("tests/scenes/prisms.txt");
    let (code, text) = command(&[scene.to_str().unwrap(), "--compact", "-o", "never.rs"]);
    assert!(code == Some(2) && text.contains("--mesh"), "{text}");
}

#[test]
fn only_obj_files_are_meshes() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("mesh.rs");
    let out = out.to_str().unwrap();
    let scene = |name: &str| root().join("tests/scenes").join(name).to_str().unwrap().to_owned();
    let (code, text) = command(&[&scene("prisms.txt"), "--mesh", "-o", out]);
    assert!(code == Some(2) && text.contains("--mesh is for OBJ files"), "{text}");
    let (code, text) = command(&[&scene("vase.obj"), "--mesh", "--shading", "phong", "-o", out]);
    assert!(code == Some(2) && text.contains("flat or gouraud"), "{text}");
    assert!(!Path::new(out).exists());
}

fn command(arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_host-render"))
        .arg("emit")
        .args(arguments)
        .output()
        .expect("it runs");
    let text = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8_lossy(&text).into_owned())
}

#[test]
fn the_command_writes_the_file_or_leaves_it() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (scene, out) = (at("scene.txt"), at("scene.rs"));
    fs::write(
        &scene,
        "png 8 8 a.png\nxyz -1 -1 0\nxyz 1 -1 0\nxyz 1 1 0\ntrif 1 2 3\n",
    )
    .unwrap();
    let (code, text) = command(&[&scene, "-o", &out]);
    assert_eq!(code, Some(0), "{text}");
    for told in ["flash: ", "RAM: ", "instructions: ", "depth buffer: none"] {
        assert!(text.contains(told), "{text}");
    }
    let written = fs::read_to_string(&out).unwrap();
    assert!(written.starts_with("// Made by: host-render emit scene.txt -o scene.rs\n"));

    fs::write(&scene, "png 8 8 a.png\ntrif 1 2 3\n").unwrap();
    let (code, text) = command(&[&scene, "-o", &out]);
    assert_eq!(code, Some(2));
    assert!(text.contains("line 2, column 6"), "{text}");
    assert_eq!(fs::read_to_string(&out).unwrap(), written);

    assert_eq!(command(&[&scene]).0, Some(2), "without --output");
    assert_eq!(command(&[&at("nosuch.txt"), "-o", &out]).0, Some(3));
    fs::write(&scene, "png 8 8 a.png\n").unwrap();
    assert_eq!(command(&[&scene, "-o", &scene]).0, Some(2), "over the scene");
    assert_eq!(command(&[&scene, "-o", &at("no/such/folder.rs")]).0, Some(3));
    assert_eq!(fs::read_to_string(&scene).unwrap(), "png 8 8 a.png\n");
}
