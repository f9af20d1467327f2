//! The examples that write pictures: what they show, and that the documentation shows what they draw.

#[allow(dead_code)]
#[path = "../../examples/dithered.rs"]
mod dithered;

#[allow(dead_code)]
#[path = "../../examples/render_to_texture.rs"]
mod render_to_texture;

#[allow(dead_code)]
#[path = "../../examples/toon.rs"]
mod toon;

#[allow(dead_code)]
#[path = "../../examples/transparent.rs"]
mod transparent;

use std::collections::BTreeMap;
use std::path::Path;

use fixel_host::picture::Picture;
use fixel_host::{files, png};

fn at(picture: &Picture, x: u32, y: u32) -> [u8; 3] {
    let [red, green, blue, _] = picture.pixels[(y * picture.width + x) as usize];
    [red, green, blue]
}

/// How often every colour occurs.
fn histogram(picture: &Picture) -> BTreeMap<[u8; 3], usize> {
    let mut counts = BTreeMap::new();
    for &[red, green, blue, _] in &picture.pixels {
        *counts.entry([red, green, blue]).or_default() += 1;
    }
    counts
}

#[test]
fn transparent_is_sorted_whatever_the_order() {
    let picture = transparent::draw([0, 1, 2]).unwrap();
    for order in [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        assert!(transparent::draw(order).unwrap() == picture, "{order:?}");
    }
    let seen = histogram(&picture);
    let over = |layers: &[[f64; 3]], below: [f64; 3]| {
        let mix = |below: [f64; 3], pane: &[f64; 3]| [0, 1, 2].map(|i| (below[i] + pane[i]) / 2.0);
        let color = layers.iter().fold(below, mix);
        color.map(|v| (v * 255.0).round() as u8)
    };
    let [green, red, blue] = [[0.125, 0.75, 0.125], [1.0, 0.125, 0.125], [0.125, 0.25, 1.0]];
    let (wall, black) = ([0.875, 0.875, 0.75], [0.0; 3]);
    // Over the wall there are green and red, in this order, and never blue, which is behind it.
    for (layers, below) in [
        (&[green, red][..], wall),
        (&[green, red], black),
        (&[green], wall),
        (&[red], wall),
        (&[blue], black),
        (&[blue, green], black),
        (&[], wall),
    ] {
        let color = over(layers, below);
        assert!(
            seen.get(&color).is_some_and(|&count| count > 50),
            "{layers:?} over {below:?}: {color:?} in {seen:?}"
        );
    }
    for (layers, below) in [
        (&[red, green][..], wall),
        (&[red, green], black),
        (&[blue], wall),
        (&[green, blue], black),
    ] {
        let color = over(layers, below);
        assert!(!seen.contains_key(&color), "{layers:?} over {below:?}: {color:?}");
    }
}

#[test]
fn render_to_texture_shows_the_triangle_on_a_turning_wall() {
    let front = render_to_texture::draw(0).unwrap();
    // Upright on the wall in the middle: blue on top, red at the left, green at the right, all mirrored in no way.
    let strongest = |[red, green, blue]: [u8; 3]| {
        [(red, 'r'), (green, 'g'), (blue, 'b')]
            .into_iter()
            .max()
            .map(|(_, c)| c)
    };
    let rows: Vec<u32> = (0..240)
        .filter(|&y| at(&front, 120, y) != [191; 3] && at(&front, 120, y) != [0; 3])
        .collect();
    let (top, bottom) = (rows[0], rows[rows.len() - 1]);
    assert_eq!(strongest(at(&front, 120, top + 20)), Some('b'));
    let lowest: Vec<_> = (0..240)
        .map(|x| at(&front, x, bottom - 4))
        .filter(|&[r, g, b]| r.max(g).max(b) - r.min(g).min(b) > 99)
        .collect();
    assert_eq!(
        (strongest(lowest[0]), strongest(lowest[lowest.len() - 1])),
        (Some('r'), Some('g'))
    );
    // A quarter of a turn later the next wall is where this one was.
    assert!(render_to_texture::draw(360).unwrap() == front);
    assert!(render_to_texture::draw(30).unwrap() != front);
    let quarter = render_to_texture::draw(90).unwrap();
    let differing = quarter.pixels.iter().zip(&front.pixels).filter(|(a, b)| a != b).count();
    assert!(differing * 100 < front.pixels.len(), "{differing}");
}

/// As many white pixels as the light of a sphere asks for, half of it dark in every direction away from the light.
#[test]
fn dithered_is_as_bright_as_its_light() {
    let display = dithered::draw().unwrap();
    let (width, height) = (i32::from(dithered::WIDTH), i32::from(dithered::HEIGHT));
    let lit = |x: i32, y: i32| display[(y * width + x) as usize];
    // An oracle in floating point: every pixel's ray against the unit sphere, and Lambert's cosine where it hits.
    let unit = |v: [f64; 3]| v.map(|c| c / v.iter().map(|c| c * c).sum::<f64>().sqrt());
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (eye, light) = ([0.0, 1.0, 5.0], unit([3.0, 3.0, 2.0]));
    let (right, back) = ([1.0, 0.0, 0.0], unit(eye));
    let up = [0.0, back[2], -back[1]];
    let half = 22.5f64.to_radians().tan();
    let brightness = |x: i32, y: i32| {
        let (a, b) = (
            (f64::from(2 * x + 1) / f64::from(width) - 1.0) * half,
            (0.5 - (f64::from(y) + 0.5) / f64::from(height)) * half,
        );
        let ray = unit([0, 1, 2].map(|i| a * right[i] + b * up[i] - back[i]));
        let middle = -dot(ray, eye);
        let inside = 1.0 - (dot(eye, eye) - middle * middle);
        if inside <= 0.0 {
            return 0.0;
        }
        let t = middle - inside.sqrt();
        dot([0, 1, 2].map(|i| eye[i] + t * ray[i]), light).max(0.0)
    };
    let (mut white, mut wanted, mut worst) = (0, 0.0, 0.0f64);
    for (y, x) in (0..height / 4).flat_map(|y| (0..width / 4).map(move |x| (4 * y, 4 * x))) {
        let block = || (0..16).map(|i| (x + i % 4, y + i / 4));
        let count = block().filter(|&(x, y)| lit(x, y)).count();
        let sum: f64 = block().map(|(x, y)| brightness(x, y)).sum();
        white += count;
        wanted += sum;
        worst = worst.max((count as f64 - sum).abs());
    }
    println!("{white} white pixels for {wanted:.1}, at most {worst:.1} of 16 off in a block");
    // Dither is right in the mean only; the mesh has 32 sides, and its border pixels are the light of a whole pixel.
    assert!((white as f64 / wanted - 1.0).abs() < 0.01, "{white} for {wanted}");
    assert!(worst <= 2.0, "{worst}");
}

#[test]
fn toon_has_three_tones_and_an_outline() {
    let picture = toon::draw().unwrap();
    let seen = histogram(&picture);
    let count = |color: [u8; 3]| seen.get(&color).copied().unwrap_or(0);
    let [paper, light, middle, dark, line] = [
        [250, 244, 230],
        [255, 214, 122],
        [240, 138, 75],
        [168, 62, 84],
        [40, 26, 52],
    ];
    let tones: usize = [light, middle, dark].map(count).iter().sum();
    assert!(
        count(light) > 2000 && count(middle) > 10000 && count(dark) > 700 && count(line) > 100,
        "{seen:?}"
    );
    // What is none of these is a mix at a border: little beside the whole.
    assert!(picture.pixels.len() - tones - count(paper) - count(line) < picture.pixels.len() / 20);
    // No tone touches the paper: between them is the line.
    for y in 0..picture.height {
        for x in 1..picture.width {
            let pair = [at(&picture, x - 1, y), at(&picture, x, y)];
            assert!(
                !(pair.contains(&paper) && [light, middle, dark].iter().any(|t| pair.contains(t))),
                "{x}, {y}"
            );
        }
    }
}

#[test]
fn the_tutorial_shows_what_the_example_draws() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let stored = files::read(&docs.join("toon.png")).unwrap();
    assert!(
        png::encode(&toon::draw().unwrap()).unwrap() == stored,
        "docs/toon.png is stale"
    );
}

/// The tutorial's blocks of Rust, one after the other, are the example.
#[test]
fn the_tutorial_is_the_whole_example() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let [tutorial, example] =
        ["docs/toon-shader.md", "examples/toon.rs"].map(|file| std::fs::read_to_string(root.join(file)).unwrap());
    let code = |text: &str| -> Vec<String> {
        let is_code = |line: &&str| !line.trim().is_empty() && !line.starts_with("//!");
        text.lines().filter(is_code).map(str::to_owned).collect()
    };
    let blocks = tutorial
        .split("```")
        .skip(1)
        .step_by(2)
        .filter_map(|block| block.strip_prefix("rust\n"));
    assert_eq!(code(&blocks.collect::<String>()), code(&example));
}
