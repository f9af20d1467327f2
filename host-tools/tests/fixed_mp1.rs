//! The fixed-point back end on MP1 scenes: official pictures, explained differences, strips, meshes of half-transparent layers.

use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};

use fixel::window::Window;
use fixel_host::compare::{Class, Comparison, mp1::compare};
use fixel_host::fixed::FixedPicture;
use fixel_host::fixed::mp1::{color_shift, draw, draw_part, with_word};
use fixel_host::picture::Picture;
use fixel_host::scene::mp1::{self, Scene};
use fixel_host::{png, reference};

/// The folder of the official MP1 scenes, unless it is not at hand.
fn official() -> Option<PathBuf> {
    match std::env::var_os("FIXEL_CONFORMANCE") {
        Some(folder) => Some(Path::new(&folder).join("mp1")),
        None => {
            eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, no official scene is compared");
            None
        }
    }
}

/// Every scene of `folder`, by name. One of them has only keywords that HW2 knows too, so the format is not told from the text.
fn scenes(folder: &Path) -> Vec<(String, Scene)> {
    let entries = fs::read_dir(folder).expect("the folder exists");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.sort();
    let texts = paths.iter().filter(|p| p.extension().is_some_and(|e| e == "txt"));
    let parsed = |path: &PathBuf| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let scene = mp1::parse(fs::read(path).unwrap(), folder).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        (name, scene)
    };
    let scenes: Vec<_> = texts.map(parsed).collect();
    assert_eq!(scenes.len(), 17);
    scenes
}

fn compared(scene: &Scene) -> Comparison {
    let picture = draw(scene).unwrap();
    compare(
        scene,
        color_shift(scene).unwrap(),
        &picture,
        &reference::mp1::draw(scene),
    )
}

#[test]
fn every_difference_is_explained() {
    let Some(folder) = official() else { return };
    let scenes = scenes(&folder);
    let mut failures = Vec::new();
    for (name, scene) in &scenes {
        let comparison = compared(scene);
        println!(
            "{name}: drawn {}, {:?}, unexplained {}, beyond {}",
            comparison.pixels_drawn, comparison.explained, comparison.unexplained, comparison.beyond_gradient
        );
        // Pixels of class *colour* further from what moving the corners by δ makes would have to be of another class.
        if comparison.unexplained > 0 || comparison.beyond_gradient > 1 {
            failures.push(name);
        }
    }
    println!("{} scenes compared with float64", scenes.len());
    assert!(failures.is_empty(), "unexplained differences in {failures:?}");
}

/// A pixel over 2 %: some channel differs by more than 5, unless both are transparent.
fn over_2_percent(a: [u8; 4], b: [u8; 4]) -> bool {
    (a[3] != 0 || b[3] != 0) && a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > 5)
}

fn picture(path: &Path) -> Picture {
    png::decode(BufReader::new(File::open(path).unwrap())).unwrap()
}

#[test]
fn official_pictures_within_two_percent_outside_the_ties() {
    let Some(folder) = official() else { return };
    let (mut compared, mut excused) = (0, 0);
    for (name, scene) in scenes(&folder) {
        let expected = picture(&folder.join(format!("{name}.png")));
        let ties = picture(&folder.join(format!("{name}.ties.png")));
        let ours = draw(&scene).unwrap();
        for (i, pixel) in ours.pixels.iter().enumerate() {
            if over_2_percent(pixel.rgba, expected.pixels[i]) {
                assert_ne!(ties.pixels[i][0], 0, "{name}: pixel {i} is off outside the ties");
                excused += 1;
            }
        }
        compared += 1;
    }
    println!("{compared} official pictures compared, {excused} pixels over 2 %, all of them ties");
    assert_eq!(compared, 17);
}

/// Strips of any height, and tiles, give the bytes of the whole picture: colour, winner and depth.
#[test]
fn strips_equal_whole_pictures() {
    let Some(folder) = official() else { return };
    let scenes = scenes(&folder);
    for (name, scene) in &scenes {
        let (width, height) = (scene.width as i32, scene.height as i32);
        let whole = draw(scene).unwrap();
        for rows in [1, 2, 3, 7, 16] {
            let (mut pixels, mut depth) = (Vec::new(), Vec::new());
            for top in (0..height).step_by(rows as usize) {
                let strip = draw_part(scene, Window::new(0, top, width, (top + rows).min(height))).unwrap();
                pixels.extend(strip.pixels);
                depth.extend(strip.depth);
            }
            assert!(
                pixels == whole.pixels && depth == whole.depth,
                "{name} in strips of {rows}"
            );
        }
        let tile = Window::new(width / 3, height / 4, width / 3 + 7, height / 4 + 9);
        let part = draw_part(scene, tile).unwrap();
        for (i, pixel) in part.pixels.iter().enumerate() {
            let at = (tile.top as usize + i / 7) * scene.width as usize + tile.left as usize + i % 7;
            assert!(
                *pixel == whole.pixels[at] && part.depth[i] == whole.depth[at],
                "{name} in a tile"
            );
        }
    }
    assert!(scenes.iter().any(|(_, scene)| scene.switches.fsaa > 1));
    println!("{} scenes drawn in strips", scenes.len());
}

/// 64-bit edges give the bytes of 32-bit ones.
#[test]
fn wide_edges_agree() {
    let Some(folder) = official() else { return };
    for (name, scene) in scenes(&folder) {
        let window = Window::new(0, 0, scene.width as i32, scene.height as i32);
        let narrow = with_word::<i32>(&scene, window).unwrap();
        let wide = with_word::<i64>(&scene, window).unwrap();
        assert!(narrow == wide, "{name}");
    }
}

/// A scene of 40×36 pixels after some switches.
fn scene(switches: &str, commands: &str) -> Scene {
    let text = format!("png 40 36 a.png\n{switches}\n{commands}");
    mp1::parse(text.clone(), Path::new(".")).unwrap_or_else(|fault| panic!("{fault} in\n{text}"))
}

fn drawn(switches: &str, commands: &str) -> FixedPicture {
    draw(&scene(switches, commands)).unwrap()
}

/// Switches under which a mesh must stay one layer.
const SWITCHES: [&str; 7] = [
    "",
    "hyp",
    "sRGB\nhyp\ndepth",
    "frustum",
    "frustum\nhyp",
    "clipplane 1 .3 0 .4\nclipplane -.2 -1 .1 .6",
    "clipplane 1 .3 0 .4\nclipplane -.7 .9 .2 .6\nfrustum\nhyp",
];

/// A w for a vertex, so that the mesh is flat on the screen and nothing else is.
fn w(i: usize) -> f64 {
    [1.0, 2.5, 0.75, 1.5][i * 7 % 4]
}

/// A vertex at x, y on the screen from −1 to 1.
fn vertex(i: usize, x: f64, y: f64) -> String {
    let w = w(i);
    format!("xyzw {} {} {} {w}\n", x * w, y * w, 0.25 * w)
}

/// An n×n grid of half-transparent triangles beyond the picture on all sides, its inner points shaken; `flip` turns diagonals.
fn grid(n: usize, shake: f64, flip: usize) -> String {
    let mut text = String::from("rgba 200 100 50 .5\n");
    let step = 3.0 / n as f64;
    for i in 0..=n {
        for j in 0..=n {
            let k = i * (n + 1) + j;
            let off = |salt: f64| shake * step * (12.9898 * k as f64 + salt).sin();
            text += &vertex(k, j as f64 * step - 1.5 + off(0.0), i as f64 * step - 1.5 + off(4.0));
        }
    }
    for i in 0..n {
        for j in 0..n {
            let a = i * (n + 1) + j + 1;
            let [b, c, d] = [a + 1, a + n + 2, a + n + 1];
            text += &if (i * n + j).is_multiple_of(flip) {
                format!("tri {a} {b} {c}\ntri {a} {c} {d}\n")
            } else {
                format!("tri {a} {b} {d}\ntri {c} {d} {b}\n")
            };
        }
    }
    text
}

/// A fan around a point.
fn fan(blades: usize) -> String {
    let mut text = format!("rgba 200 100 50 .5\n{}", vertex(0, 0.113, -0.071));
    for i in 0..blades {
        let (sin, cos) = (i as f64 * std::f64::consts::TAU / blades as f64).sin_cos();
        text += &vertex(i + 1, 3.0 * cos, 3.0 * sin);
    }
    for i in 0..blades {
        text += &format!("tri 1 {} {}\n", i + 2, (i + 1) % blades + 2);
    }
    text
}

/// What the planes leave of the screen, as the mesh would be if it were one polygon: two triangles that cover the picture, opaque.
fn covered(switches: &str) -> Vec<bool> {
    let corners = "xyzw -9 -9 0.25 1\nxyzw 9 -9 .25 1\nxyzw 9 9 .25 1\nxyzw -9 9 .25 1\n";
    let picture = drawn(switches, &format!("{corners}tri 1 2 3\ntri 1 3 4\n"));
    picture.pixels.iter().map(|pixel| pixel.rgba[3] == 255).collect()
}

#[test]
fn every_pixel_of_a_mesh_is_exactly_one_layer() {
    let mut meshes = vec![fan(3), fan(17), fan(100)];
    for (n, shake, flip) in [(2, 0.0, 1), (3, 0.3, 2), (7, 0.35, 3), (12, 0.3, 2), (40, 0.3, 5)] {
        meshes.push(grid(n, shake, flip));
    }
    for switches in SWITCHES {
        for fsaa in [1, 2, 3] {
            let switches = format!("fsaa {fsaa}\n{switches}");
            // A cut edge made of pieces is rounded piece by piece, so samples beside it may belong to either side.
            let whole = covered(&switches);
            for (number, mesh) in meshes.iter().enumerate() {
                let picture = drawn(&switches, mesh);
                let mut layers = 0;
                for (i, pixel) in picture.pixels.iter().enumerate() {
                    let alpha = pixel.rgba[3];
                    let near_a_cut = {
                        let (x, y) = (i as i32 % 40, i as i32 / 40);
                        let around = [
                            (0, 0),
                            (1, 0),
                            (-1, 0),
                            (0, 1),
                            (0, -1),
                            (1, 1),
                            (-1, -1),
                            (1, -1),
                            (-1, 1),
                        ];
                        let inside = |(dx, dy): (i32, i32)| {
                            let (x, y) = ((x + dx).clamp(0, 39), (y + dy).clamp(0, 35));
                            whole[(y * 40 + x) as usize]
                        };
                        let count = around.into_iter().filter(|&at| inside(at)).count();
                        count != 0 && count != around.len()
                    };
                    let at = format!("{switches:?}, mesh {number}, pixel {i}: alpha {alpha}");
                    // Half of 255, cut off: less where some samples are not covered, never more.
                    assert!(alpha <= 127, "{at}");
                    if !near_a_cut {
                        assert_eq!(alpha, if whole[i] { 127 } else { 0 }, "{at}");
                        layers += u32::from(whole[i]);
                    }
                    // No dark fringe, and no seam in the colour either.
                    if alpha > 0 {
                        let [r, g, b, _] = pixel.rgba;
                        assert_eq!([r, g, b], [200, 100, 50], "{at}");
                    }
                }
                assert!(layers > 300, "{switches:?}: {layers}");
            }
        }
    }
}

#[test]
fn partly_covered_pixels_keep_their_colour() {
    let shapes = "rgb 240 120 30\nxyzw -.8 -.9 0 1\nxyzw .9 -.3 0 1\nxyzw -.1 .95 0 1\ntri 1 2 3\n";
    let lines =
        "rgb 240 120 30\nxyzw -.8 -.9 0 1\nxyzw .9 -.3 0 1\nxyzw -.1 .95 0 1\nwuline 1 2\ncircle 9.3 3\npoint 5.5 2\n";
    for (switches, commands) in [
        ("fsaa 4", shapes),
        ("fsaa 3\nsRGB", shapes),
        ("fsaa 2\nsRGB\nhyp\ndepth", shapes),
        ("", lines),
        ("sRGB", lines),
        ("fsaa 2", lines),
    ] {
        let picture = drawn(switches, commands);
        let partly = picture.pixels.iter().filter(|p| (1..255).contains(&p.rgba[3]));
        let colors: Vec<[u8; 4]> = partly.map(|p| p.rgba).collect();
        assert!(colors.len() > 10, "{switches}: {}", colors.len());
        for [r, g, b, _] in colors {
            assert_eq!([r, g, b], [240, 120, 30], "{switches}");
        }
    }
}

#[test]
fn bright_and_negative_colours_are_clamped() {
    let commands = "rgb 30000 -30000 300\nxyzw -9 -9 0 1\nxyzw 9 -9 0 1\nxyzw 0 9 0 1\ntri 1 2 3\npoint 9 3\nline 1 3\nwuline 1 2\n\
        rgba 30000 -30000 30000 .5\nxyzw 0 0 0 1\ncircle 20 -1\n";
    for switches in ["", "sRGB", "hyp", "fsaa 3", "sRGB\nhyp\ndepth\nfsaa 2"] {
        let picture = drawn(switches, commands);
        for pixel in &picture.pixels {
            assert!(
                [[255, 0, 255, 255], [0; 4]].contains(&pixel.rgba),
                "{switches}: {pixel:?}"
            );
        }
        assert_eq!(compared(&scene(switches, commands)).unexplained, 0, "{switches}");
    }
}

#[test]
fn no_alpha_at_all_is_equal_whatever_the_colour() {
    // Over nothing a colour without alpha is none in either back end, and where alpha rounds to 0 it is in one of them.
    let tiny = scene("", "rgba 255 255 255 1e-10\nxyzw 0 0 0 1\npoint 20 1\n");
    let comparison = compared(&tiny);
    assert!(comparison.classes.iter().all(|class| *class == Class::Equal));
    assert_eq!((comparison.max_channel_error, comparison.psnr), (0, None));
    assert_eq!(comparison.coverage_differs, 0);
}

#[test]
fn a_vertex_whose_w_would_be_lost_is_refused() {
    for (draw_it, place) in [
        ("tri 1 2 3", Some((5, 1))),
        ("line 2 3", Some((5, 1))),
        ("point 5 2", Some((5, 1))),
        ("point 5 1", None),
    ] {
        let text = format!("png 9 9 a.png\nxyzw 0 -1 0 1\nxyzw 1e19 0 0 1\nxyzw 0 1 0 1\n{draw_it}\n");
        let scene = mp1::parse(text, Path::new(".")).unwrap_or_else(|fault| panic!("{fault}"));
        let fault = draw(&scene).err().map(|fault| (fault.place.line, fault.place.column));
        assert_eq!(fault, place, "{draw_it}");
    }
}
