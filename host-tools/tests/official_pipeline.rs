//! The float64 pipeline against the official pictures of formats/pipeline.md. `FIXEL_CONFORMANCE` names the folder that
//! holds pipeline/NAME.png; where it is set, every file must be there.

use std::io::Write;
use std::path::PathBuf;

use fixel_host::files::read_picture;
use fixel_host::picture::Picture;
use fixel_host::playground::{draw_float, texture::Textures};
use fixel_host::reference::pipeline::blend::Blend;
use fixel_host::reference::pipeline::program::{Colors, Program, VERTEX, Values};
use fixel_host::reference::pipeline::state::Viewport;
use fixel_host::reference::pipeline::{Framebuffer, Geometry, State, Topology, draw};

const SIZE: u32 = 300;
const BLACK: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

/// One colour on vertices that are given in pixels of a picture of 300 x 300.
struct Flat;

impl Program for Flat {
    type Uniforms = [f64; 4];

    fn vertex(&self, attributes: &Values, _: &[f64; 4], _: &mut Values) -> [f64; 4] {
        let half = f64::from(SIZE) / 2.0;
        [attributes[VERTEX][0] - half, attributes[VERTEX][1] - half, 0.0, half]
    }

    fn fragment(&self, _: [f64; 4], _: &Values, color: &[f64; 4], colors: &mut Colors) -> bool {
        colors.insert(0, *color);
        true
    }
}

/// An official picture, or nothing where there are none.
fn official(name: &str) -> Option<Picture> {
    let Some(folder) = std::env::var_os("FIXEL_CONFORMANCE") else {
        say(&format!(
            "SKIPPED: FIXEL_CONFORMANCE is not set, pipeline/{name} was not compared"
        ));
        return None;
    };
    let file = PathBuf::from(folder).join("pipeline").join(name);
    Some(read_picture(&file).unwrap_or_else(|trouble| panic!("{trouble}")))
}

/// How far each pixel's worst component is off, in levels.
fn apart(ours: &Picture, official: &Picture) -> Vec<u8> {
    assert_eq!(ours.size(), official.size());
    let worst = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    ours.pixels.iter().zip(&official.pixels).map(worst).collect()
}

/// Says how many of the levels are how large, and demands that none is above 1.
fn within_one_level(name: &str, apart: &[u8]) {
    let count = |least: u8| apart.iter().filter(|&&levels| levels >= least).count();
    let (all, one, more) = (apart.len(), count(1), count(2));
    say(&format!(
        "pipeline/{name}: {all} pixels compared, {} by 1 level, {more} by more",
        one - more
    ));
    assert_eq!(more, 0, "{name}: pixels that are off by more than 1 level");
}

/// Past the test harness, which swallows what `println!` says in a test that passes.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

#[test]
fn i01_4_beginning() {
    let Some(expected) = official("beginning.png") else {
        return;
    };
    // 150 + 105 cos 270° is 150, but a hair less from a sine in doubles, which would be the pixel 149: the course's
    // vertices are single-precision.
    let single = |v: f64| f64::from((150.0 + 105.0 * v) as f32);
    let ends = (0..20).map(|i| (f64::from(i) * std::f64::consts::TAU / 20.0).sin_cos());
    let lines = ends.flat_map(|(sin, cos)| [[150.0, 150.0], [single(cos), single(sin)]]);
    let geometry = Geometry::new(Topology::Lines, lines);
    let mut framebuffer = Framebuffer::new(SIZE, SIZE, BLACK);
    let state = State::new(Viewport::of(SIZE, SIZE));
    draw(&mut framebuffer, &state, &Flat, &[1.0, 0.0, 0.0, 1.0], &geometry);
    let picture = framebuffer.colors[&0].picture();

    let red = |picture: &Picture, [x, y]: [usize; 2]| picture.pixels[y * SIZE as usize + x] == [255, 0, 0, 255];
    let places = || (1..299).flat_map(|y| (1..299).map(move |x| [x, y]));
    let beside = |[x, y]: [usize; 2]| [[x + 1, y], [x - 1, y], [x, y + 1], [x, y - 1]];
    // Official pixels that are not ours; ours is then beside them.
    let missing: Vec<_> = places().filter(|&p| red(&expected, p) && !red(&picture, p)).collect();
    let extra: Vec<_> = places().filter(|&p| !red(&expected, p) && red(&picture, p)).collect();
    let total = places().filter(|&p| red(&expected, p)).count();
    say(&format!(
        "pipeline/beginning.png: {total} pixels compared, {} aside",
        missing.len().max(extra.len())
    ));
    assert_eq!(total, 1873);
    assert!(
        missing.len() <= 8 && extra.len() <= 8,
        "missing {missing:?}, extra {extra:?}"
    );
    assert!(missing.iter().all(|&p| beside(p).iter().any(|&q| red(&picture, q))));
    assert!(extra.iter().all(|&p| beside(p).iter().any(|&q| red(&expected, q))));
}

/// x, y, width, height, colour.
type Rectangle = ([f64; 4], [f64; 4]);

const RECTANGLES: [Rectangle; 8] = [
    ([10.0, 10.0, 100.0, 100.0], [1.0, 0.0, 0.0, 0.5]),
    ([80.0, 20.0, 100.0, 100.0], [0.0, 1.0, 0.0, 0.5]),
    ([70.0, 60.0, 40.0, 200.0], [0.0, 0.0, 1.0, 0.75]),
    ([20.0, 240.0, 200.0, 20.0], [1.0, 1.0, 1.0, 1.0]),
    ([20.0, 200.0, 200.0, 20.0], [1.0, 1.0, 1.0, 0.75]),
    ([20.0, 160.0, 200.0, 20.0], [1.0, 1.0, 1.0, 0.5]),
    ([20.0, 120.0, 200.0, 20.0], [1.0, 1.0, 1.0, 0.25]),
    ([20.0, 80.0, 200.0, 20.0], [1.0, 1.0, 1.0, 0.15]),
];

fn blended_rectangles() -> Framebuffer {
    let mut framebuffer = Framebuffer::new(SIZE, SIZE, BLACK);
    let mut state = State::new(Viewport::of(SIZE, SIZE));
    state.blend = Some(Blend::transparency());
    for ([x, y, width, height], color) in RECTANGLES {
        let [a, b, c, d] = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
        let corners = [a, b, c, a, c, d].map(|[dx, dy]| [x + dx, y + dy]);
        let geometry = Geometry::new(Topology::Triangles, corners);
        draw(&mut framebuffer, &state, &Flat, &color, &geometry);
    }
    framebuffer
}

#[test]
fn i10_4_single_pixels_of_the_blended_rectangles() {
    let framebuffer = blended_rectangles();
    let expected: [(i64, i64, &[f64]); 5] = [
        (15, 15, &[0.5, 0.0, 0.0, 0.75]),
        (90, 30, &[0.25, 0.5, 0.0, 0.625]),
        (90, 90, &[0.203125, 0.25625, 0.7875]),
        (90, 170, &[0.5, 0.5, 0.875]),
        (30, 90, &[0.575, 0.15, 0.15]),
    ];
    for (x, y, color) in expected {
        let found = framebuffer.colors[&0].get(x, y).expect("inside");
        assert!(
            found.iter().zip(color).all(|(a, b)| (a - b).abs() < 1e-12),
            "{x} {y}: {found:?}"
        );
    }
}

#[test]
fn i10_4_blended_rectangles() {
    if let Some(expected) = official("blend-rects.png") {
        let picture = blended_rectangles().colors[&0].picture();
        within_one_level("blend-rects.png", &apart(&picture, &expected));
    }
}

#[test]
fn pg_with_fixed_textures() {
    if let Some(expected) = official("playground-fixed.png") {
        let picture = draw_float(&Textures::fixed());
        within_one_level("playground-fixed.png", &apart(&picture, &expected));
    }
}

#[test]
fn pg_of_the_course() {
    let (Some(expected), Some(mask)) = (official("playground.png"), official("playground-mask.png")) else {
        return;
    };
    // Whatever the random textures are, they show outside the mask only.
    for textures in [Textures::fixed(), Textures::course(1)] {
        let apart = apart(&draw_float(&textures), &expected);
        let masked = apart.into_iter().zip(&mask.pixels).filter(|(_, mask)| mask[0] == 255);
        let masked: Vec<u8> = masked.map(|(levels, _)| levels).collect();
        assert_eq!(masked.len(), 86690);
        within_one_level("playground.png", &masked);
    }
}
