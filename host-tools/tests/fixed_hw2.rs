//! The fixed-point back end on real scenes: official pictures, explained differences, strips.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use fixel::window::Window;
use fixel_host::backend::{BackEnd, Surface, Vertex};
use fixel_host::compare::{Class, Comparison, compare};
use fixel_host::fixed::FixedPicture;
use fixel_host::fixed::hw2::Fixed;
use fixel_host::interpret::interpret;
use fixel_host::picture::Picture;
use fixel_host::png;
use fixel_host::reference::Rendered;
use fixel_host::reference::hw2::Reference;
use fixel_host::reference::material::Material;
use fixel_host::scene::hw2::{self, Action, Fill, Scene};

/// The folder of the official HW2 scenes, unless it is not at hand.
fn official() -> Option<PathBuf> {
    match std::env::var_os("FIXEL_CONFORMANCE") {
        Some(folder) => Some(Path::new(&folder).join("hw2")),
        None => {
            eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, no official scene is compared");
            None
        }
    }
}

/// Every scene of `folder`, by name.
fn scenes(folder: &Path) -> Vec<(String, Scene)> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder exists")
        .map(|e| e.unwrap().path())
        .collect();
    paths.sort();
    let texts = paths.iter().filter(|p| p.extension().is_some_and(|e| e == "txt"));
    let parsed = |path: &PathBuf| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let scene = hw2::parse(fs::read(path).unwrap(), folder).unwrap_or_else(|fault| panic!("{name}: {fault:?}"));
        (name, scene)
    };
    let scenes: Vec<_> = texts.map(parsed).collect();
    assert_eq!(scenes.len(), 31);
    scenes
}

fn drawn(scene: &Scene, mut fixed: Fixed) -> FixedPicture {
    interpret(scene, &mut fixed as &mut dyn BackEnd).unwrap();
    fixed.finish()
}

/// Compares the core's picture of a scene with the reference's.
fn compared(scene: &Scene) -> Comparison {
    let picture = drawn(scene, Fixed::new(scene.width, scene.height));
    compare(&picture, &referenced(scene))
}

fn referenced(scene: &Scene) -> Rendered<Arc<Material>> {
    let mut reference = Reference::new(scene.width, scene.height);
    interpret(scene, &mut reference).unwrap();
    reference.finish()
}

/// A scene of our own, a command a line after `png`.
fn own(commands: &str) -> Comparison {
    let text = format!("png 64 64 o.png\n{commands}");
    compared(&hw2::parse(text, Path::new(".")).unwrap_or_else(|fault| panic!("{fault:?}")))
}

#[test]
fn a_vertex_without_a_place_in_eye_space_is_lit_from_the_eye() {
    let triangle = "frustum -1 1 -1 1 1 10\nnormal 0 0 1\nxyz -1 -1 -2\nxyz 1 -1 -2\nxyz 0 0 1\nLIGHT\nxyzw 0 1 -1 0\ntrif 1 2 4\n";
    for (light, has_place) in [
        ("sunlight 0 0 1", false),
        ("sunlight 0 0 1\nflatnormals", false),
        ("bulb 3", true),
        ("sunlight 0 0 1\nshininess 3", true),
    ] {
        let comparison = own(&triangle.replace("LIGHT", light));
        assert!(comparison.pixels_drawn > 600, "{light}: {}", comparison.pixels_drawn);
        assert_eq!(comparison.unexplained, 0, "{light}: {:?}", comparison.explained);
        // Along its edges.
        assert!(
            comparison.coverage_differs < 30,
            "{light}: {}",
            comparison.coverage_differs
        );
        // Where the eye's place counts, nothing is known.
        let pole = comparison.explained.pole;
        assert!(has_place || pole == 0, "{light}: {pole}");
    }
}

#[test]
fn a_vertex_whose_w_would_be_lost_is_refused_where_it_stands() {
    let drawn = |vertices: &str, draw: &str| {
        let text = format!("png 64 64 o.png\nxyz 0 -1 .5\n {vertices}\nxyz 0 1 .5\n{draw}\n");
        let scene = hw2::parse(text, Path::new(".")).unwrap_or_else(|fault| panic!("{fault}"));
        let mut fixed = Fixed::new(64, 64);
        interpret(&scene, &mut fixed).map_err(|fault| (fault.place.line, fault.place.column))?;
        Ok(fixed
            .finish()
            .pixels
            .iter()
            .filter(|pixel| pixel.primitive != 0)
            .count())
    };
    for vertex in ["xyz 1e19 0 .5", "xyzw .3 1e-9 .5 -1e-20", "xyz 0 0 -1e300"] {
        assert_eq!(drawn(vertex, "trif 1 2 3"), Err((3, 2)), "{vertex}");
        assert_eq!(drawn(vertex, "tribezf 1 1 1 1 1 1 1 1 1 1 2"), Err((3, 2)), "{vertex}");
        // Those that nothing draws do not matter, nor does a w of 0.
        assert_eq!(drawn(vertex, ""), Ok(0), "{vertex}");
        assert_eq!(drawn("xyzw 1e19 0 .5 0", "trif 1 2 3"), Ok(0));
    }
    assert!(drawn("xyz 5e18 0 .5", "trif 1 2 3").is_ok_and(|pixels| pixels > 1000));
}

#[test]
fn lit_decals_are_coarser_where_w_has_both_signs() {
    let half = Arc::new(Picture::new(1, 1, vec![[10, 20, 30, 51]]));
    let vertex = |position, color| Vertex {
        position,
        color,
        normal: None,
        texcoord: [0.0; 2],
    };
    let corners = [
        vertex([0.484, -0.805, 0.445, 1.0], [0.241, 0.840, 0.047]),
        vertex([-0.799, -0.872, 0.194, 1.0], [0.408, 0.598, 0.863]),
        vertex([-0.006, -0.627, -0.063, -1.0], [0.588, 0.721, 0.278]),
    ];
    let draw = |back_end: &mut dyn BackEnd| -> Result<(), String> {
        back_end.decals();
        back_end.texture(&half)?;
        back_end.sun([-0.218, 0.086, -1.0], [1.0; 3])?;
        back_end.triangle(1, corners, Surface::Textured)
    };
    let (mut fixed, mut reference) = (Fixed::new(64, 64), Reference::new(64, 64));
    draw(&mut fixed).unwrap();
    draw(&mut reference).unwrap();
    let comparison = compare(&fixed.finish(), &reference.finish());
    assert!(comparison.pixels_drawn > 100 && comparison.max_channel_error > 0);
    assert_eq!(comparison.unexplained, 0, "{:?}", comparison.explained);
}

#[test]
fn a_bright_control_point_makes_all_of_its_patch_coarser() {
    for (bright, light) in [
        ("1e6", ""),
        ("1e7", ""),
        ("1e8", ""),
        ("1e6", "sunlight 0 0 1\n"),
        ("1e7", "sunlight 0 0.5 1\nshininess 5\n"),
    ] {
        let comparison = own(&format!(
            "color 1 1 1\nxyz -0.9 -0.9 0.5\nxyz 0.9 -0.9 0.5\nxyz -0.9 0.9 0.5\n\
             color 0.2 0.5 0.8\nxyz 0.9 0.9 0.5\ncolor {bright} 0 0\nxyz 0 0 0.5\ncolor 1 1 1\n{light}\
             rectbezg 2  1 1 2 2  1 5 2 2  3 3 4 4  3 3 4 4\n"
        ));
        assert!(comparison.pixels_drawn > 2000, "{bright}: {}", comparison.pixels_drawn);
        assert_eq!(
            comparison.unexplained, 0,
            "{bright} {light}: {:?}",
            comparison.explained
        );
    }
}

#[test]
fn every_difference_is_explained() {
    let Some(folder) = official() else { return };
    let scenes = scenes(&folder);
    let mut failures = Vec::new();
    for (name, scene) in &scenes {
        let comparison = compared(scene);
        println!(
            "{name}: drawn {}, {:?}, unexplained {}, max {}",
            comparison.pixels_drawn, comparison.explained, comparison.unexplained, comparison.max_channel_error
        );
        if comparison.unexplained > 0 {
            failures.push(name);
        }
    }
    println!("{} scenes compared with float64", scenes.len());
    assert!(failures.is_empty(), "unexplained differences in {failures:?}");
}

/// A scene's actions of one kind.
fn uses(scene: &Scene, kind: impl Fn(&Action) -> bool) -> bool {
    scene.commands.iter().any(|command| kind(&command.action))
}

#[test]
fn lit_and_textured_colours_are_within_two_levels_of_what_moving_by_delta_makes() {
    let Some(folder) = official() else { return };
    let lit = |action: &Action| matches!(action, Action::Sun(_) | Action::Bulb(_));
    let textured = |action: &Action| matches!(action, Action::Triangle(Fill::Textured, _));
    let mut checked = 0;
    for (name, scene) in scenes(&folder) {
        if !uses(&scene, lit) && !uses(&scene, textured) {
            continue;
        }
        let comparison = compared(&scene);
        println!("{name}: {} levels", comparison.beyond_gradient);
        // Pixels beyond that would have to be of another class, or unexplained.
        assert!(comparison.beyond_gradient <= 2, "{name}");
        assert_eq!(comparison.unexplained, 0, "{name}");
        checked += 1;
    }
    assert!(checked >= 10, "{checked}");
}

#[test]
fn no_more_than_one_texel_in_a_thousand_differs() {
    let Some(folder) = official() else { return };
    let textured = |action: &Action| matches!(action, Action::Triangle(Fill::Textured, _));
    let mut checked = 0;
    for (name, scene) in scenes(&folder).iter().filter(|(_, scene)| uses(scene, textured)) {
        let comparison = compared(scene);
        println!("{name}: {} of {}", comparison.explained.texel, comparison.pixels_drawn);
        assert!(comparison.explained.texel * 1000 <= comparison.pixels_drawn, "{name}");
        checked += 1;
    }
    assert!(checked >= 2, "{checked}");
}

/// A pixel over 2 %: some channel differs by more than 5, unless both are transparent.
fn over_2_percent(a: [u8; 4], b: [u8; 4]) -> bool {
    (a[3] != 0 || b[3] != 0) && a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > 5)
}

#[test]
fn official_pictures_within_two_percent_outside_the_ties() {
    let Some(folder) = official() else { return };
    let (mut compared, mut strays) = (0, 0);
    for (name, scene) in scenes(&folder) {
        let official = folder.join(format!("{name}.png"));
        if !official.exists() {
            continue;
        }
        let expected = png::decode(Cursor::new(fs::read(official).unwrap())).unwrap();
        let ties = png::decode(Cursor::new(fs::read(folder.join(format!("{name}.ties.png"))).unwrap())).unwrap();
        let picture = drawn(&scene, Fixed::new(scene.width, scene.height));
        let off = |i: &usize| over_2_percent(picture.pixels[*i].rgba, expected.pixels[*i]) && ties.pixels[*i][0] == 0;
        for stray in (0..picture.pixels.len()).filter(off) {
            let class = compare(&picture, &referenced(&scene)).classes[stray];
            println!("{name}: pixel {stray} is off outside the ties, class {class:?}");
            assert_ne!(class, Class::Unexplained);
            strays += 1;
        }
        compared += 1;
    }
    println!("{compared} official pictures compared, {strays} pixels off outside the ties");
    assert_eq!(compared, 13);
    // hw2.md, section 12: vertices rounded to 1/256 px put one pixel of all these pictures on the other side.
    assert!(strays <= 1);
}

/// Strips of any height, and tiles, give the bytes of the whole frame: colour, winner and depth.
#[test]
fn strips_equal_whole_frames() {
    let Some(folder) = official() else { return };
    let scenes = scenes(&folder);
    for (name, scene) in &scenes {
        let (width, height) = (scene.width as i32, scene.height as i32);
        let whole = drawn(scene, Fixed::new(scene.width, scene.height));
        for rows in [1, 2, 3, 7, 16, height] {
            let (mut pixels, mut depth) = (Vec::new(), Vec::new());
            for top in (0..height).step_by(rows as usize) {
                let window = Window::new(0, top, width, (top + rows).min(height));
                let strip = drawn(scene, Fixed::part(scene.width, scene.height, window));
                pixels.extend(strip.pixels);
                depth.extend(strip.depth);
            }
            assert!(
                pixels == whole.pixels && depth == whole.depth,
                "{name} in strips of {rows}"
            );
        }
        let tile = Window::new(width / 3, height / 4, width / 3 + 29, height / 4 + 31);
        let part = drawn(scene, Fixed::part(scene.width, scene.height, tile));
        for (i, pixel) in part.pixels.iter().enumerate() {
            let at = (tile.top as usize + i / 29) * scene.width as usize + tile.left as usize + i % 29;
            assert!(
                *pixel == whole.pixels[at] && part.depth[i] == whole.depth[at],
                "{name} in a tile"
            );
        }
    }
    println!("{} scenes drawn in strips", scenes.len());
}

/// 64-bit edges give the bytes of 32-bit ones where nothing reaches the guard band.
#[test]
fn wide_edges_agree() {
    let Some(folder) = official() else { return };
    for (name, scene) in scenes(&folder) {
        if name == "hw2screenclip" {
            continue; // Its corners lie beyond the guard band, which is eight times as wide with 64-bit edges.
        }
        let window = Window::new(0, 0, scene.width as i32, scene.height as i32);
        let narrow = drawn(&scene, Fixed::with_word::<i32>(scene.width, scene.height, window));
        let wide = drawn(&scene, Fixed::with_word::<i64>(scene.width, scene.height, window));
        assert!(narrow == wide, "{name}");
    }
}
