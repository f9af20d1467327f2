//! Our own scenes: one for every keyword and material, and some to look at. Every difference from float64 is explained, and
//! strips and tiles are parts of the whole frame.

use std::fs;
use std::path::{Path, PathBuf};

use fixel::window::Window;
use fixel_host::args::Args;
use fixel_host::compare::Comparison;
use fixel_host::fixed::dials::Dials;
use fixel_host::fixed::{self, FixedPicture};
use fixel_host::interpret::interpret;
use fixel_host::load::load;
use fixel_host::png;
use fixel_host::render::render;
use fixel_host::scene::iv::Shading;
use fixel_host::scene::{Fault, Scene};
use rayon::prelude::*;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/scenes")
}

/// Every scene of every format, by name; models in each shading.
fn scenes() -> Vec<(String, Scene)> {
    let entries = fs::read_dir(folder()).expect("the folder exists");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.sort();
    let mut scenes = Vec::new();
    for path in paths.iter().filter(|p| p.extension().is_some_and(|e| e != "png")) {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let args = Args::from(["host-render".as_ref(), path.as_os_str()]).expect("a command line");
        let loaded = load(path, &args).unwrap_or_else(|refused| panic!("{}", refused.failure.message));
        let Scene::Iv(scene) = loaded.scene else {
            scenes.push((name, loaded.scene));
            continue;
        };
        for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
            let mut scene = scene.clone();
            (scene.width, scene.height, scene.shading) = (200, 150, shading);
            scenes.push((format!("{name} {shading:?}"), Scene::Iv(scene)));
        }
    }
    scenes
}

/// The part `window` of the core's picture.
fn part(scene: &Scene, window: Window) -> Result<FixedPicture, Fault> {
    match scene {
        Scene::Hw2(scene) => {
            let mut fixed = fixed::hw2::Fixed::part(scene.width, scene.height, window);
            interpret(scene, &mut fixed)?;
            Ok(fixed.finish())
        }
        Scene::Mp1(scene) => fixed::mp1::draw_part(scene, window),
        Scene::Iv(scene) => fixed::iv::draw_part(scene, window),
    }
}

fn whole(name: &str, scene: &Scene) -> FixedPicture {
    let (width, height) = scene.size();
    let drawn = part(scene, Window::new(0, 0, width as i32, height as i32));
    drawn.unwrap_or_else(|fault| panic!("{name}: {fault}"))
}

fn compared(name: &str, scene: &Scene) -> Comparison {
    let rendered = render(scene, Dials::default()).unwrap_or_else(|fault| panic!("{name}: {fault}"));
    rendered.comparison
}

#[test]
fn every_difference_is_explained() {
    let scenes = scenes();
    let all: Vec<_> = scenes
        .par_iter()
        .map(|(name, scene)| (name, compared(name, scene)))
        .collect();
    let mut failures = Vec::new();
    for (name, comparison) in &all {
        let of = comparison.explained;
        let classes = [
            ("colour", of.colour),
            ("edge", of.edge),
            ("depth", of.depth),
            ("texel", of.texel),
            ("pole", of.pole),
            ("steep", of.steep),
        ];
        let share = |pixels: u64| 100.0 * pixels as f64 / comparison.pixels_drawn as f64;
        let shares = classes.iter().filter(|(_, pixels)| *pixels > 0);
        let shares: Vec<_> = shares
            .map(|(class, pixels)| format!("{class} {:.2} %", share(*pixels)))
            .collect();
        println!(
            "{name}: drawn {}, {}, unexplained {}, max {}",
            comparison.pixels_drawn,
            if shares.is_empty() {
                "equal".to_string()
            } else {
                shares.join(", ")
            },
            comparison.unexplained,
            comparison.max_channel_error
        );
        if comparison.unexplained > 0 || comparison.pixels_drawn == 0 {
            failures.push(name);
        }
    }
    assert!(failures.is_empty(), "unexplained differences in {failures:?}");
}

/// Holds a part against the whole frame: colour, winner and depth.
fn assert_part(name: &str, scene: &Scene, whole: &FixedPicture, window: Window) {
    let part = part(scene, window).unwrap_or_else(|fault| panic!("{name}: {fault}"));
    for row in 0..window.height() {
        let at = (window.top as usize + row) * whole.width as usize + window.left as usize;
        let (there, here) = (
            at..at + window.width(),
            row * window.width()..(row + 1) * window.width(),
        );
        assert!(
            part.pixels[here.clone()] == whole.pixels[there.clone()] && part.depth[here] == whole.depth[there],
            "{name}: row {row} of {window:?}"
        );
    }
}

#[test]
fn strips_and_tiles_are_parts_of_the_whole_frame() {
    scenes().par_iter().for_each(|(name, scene)| {
        let whole = whole(name, scene);
        let (width, height) = (whole.width as i32, whole.height as i32);
        for top in (0..height).step_by(24) {
            assert_part(name, scene, &whole, Window::new(0, top, width, (top + 24).min(height)));
        }
        assert_part(name, scene, &whole, Window::new(0, height / 2, width, height / 2 + 1));
        assert_part(
            name,
            scene,
            &whole,
            Window::new(width / 3, height / 4, width - 7, height - 5),
        );
    });
}

/// The texture of `texture-drawn.txt` is what this renderer makes of `drawn.txt`, transparent background and all.
#[test]
fn the_drawn_texture_is_up_to_date() {
    let (name, scene) = scenes()
        .into_iter()
        .find(|(name, _)| name == "drawn.txt")
        .expect("drawn.txt");
    let file = fs::File::open(folder().join("drawn.png")).unwrap();
    let texture = png::decode(std::io::BufReader::new(file)).unwrap();
    let picture = whole(&name, &scene);
    assert!(picture.pixels.iter().map(|p| p.rgba).eq(texture.pixels.iter().copied()));
    assert!(texture.pixels.contains(&[0; 4]));
}

/// A patch of the finest subdivision has no holes: in every row of its scene what is drawn is one run.
#[test]
fn the_finest_patches_have_no_cracks() {
    let (name, scene) = scenes()
        .into_iter()
        .find(|(name, _)| name == "patches-fine.txt")
        .expect("patches-fine.txt");
    let picture = whole(&name, &scene);
    for (y, row) in picture.pixels.chunks(picture.width as usize).enumerate() {
        let runs = row.chunk_by(|a, b| (a.primitive == 0) == (b.primitive == 0));
        let drawn = runs.filter(|run| run[0].primitive != 0).count();
        assert!(drawn <= 1, "row {y} has {drawn} runs");
    }
}
