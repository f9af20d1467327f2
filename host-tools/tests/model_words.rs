//! A model as firmware holds it, in 16-bit words, makes the picture that the host's own back end makes of the scene.

use fixel_host::fixed::iv;
use fixel_host::scene::iv::{Scene, Shading, parse};
use fixel_workloads::machine::{Line, Machine};
use fixel_workloads::model::{canvas::Canvas, program};

const SIDE: u32 = 64;

/// Two octahedra, one matte and one glossy, far from the world's origin, turned and stretched.
fn text() -> String {
    let octahedron = "Coordinate3 { point [1 0 0, -1 0 0, 0 1 0, 0 -1 0, 0 0 1, 0 0 -1] }
        Normal { vector [1 0 0, -1 0 0, 0 1 0, 0 -1 0, 0 0 1, 0 0 -1] }
        IndexedFaceSet {
            coordIndex [0, 2, 4, -1, 2, 1, 4, -1, 1, 3, 4, -1, 3, 0, 4, -1, 2, 0, 5, -1, 1, 2, 5, -1, 3, 1, 5, -1, 0, 3, 5, -1]
            normalIndex [0, 2, 4, -1, 2, 1, 4, -1, 1, 3, 4, -1, 3, 0, 4, -1, 2, 0, 5, -1, 1, 2, 5, -1, 3, 1, 5, -1, 0, 3, 5, -1]
        }";
    format!(
        "#Inventor V2.1 ascii
        PerspectiveCamera {{ position 1000 0 2 nearDistance 1 farDistance 10 left -.5 right .5 top .5 bottom -.5 }}
        PointLight {{ location 1001 1 2 color 1 .9 .8 }}
        PointLight {{ location 998 -2 1 color .2 .2 .5 }}
        Separator {{
            Transform {{ translation 999.5 0 -1 rotation 1 2 3 1 scaleFactor .5 .8 .6 }}
            Material {{ ambientColor .1 .1 .1 diffuseColor .8 .6 .1 specularColor 0 0 0 }}
            {octahedron}
        }}
        Separator {{
            Transform {{ translation 1000.3 -.3 .7 rotation 1 2 3 2 scaleFactor .2 .1 .15 }}
            Material {{ diffuseColor .2 .7 .3 specularColor .5 .5 .5 shininess 4 }}
            {octahedron}
        }}"
    )
}

struct Host(Vec<(String, u32)>);

impl Machine for Host {
    fn count(&mut self, work: impl FnOnce()) -> u32 {
        work();
        0
    }
    fn report(&mut self, line: &Line<'_>) {
        self.0.push((line.name.to_owned(), line.units));
    }
}

#[test]
fn the_picture_is_the_back_ends() {
    let scene = Scene {
        width: SIDE,
        height: SIDE,
        output: "out.png".into(),
        shading: Shading::Gouraud,
        eyelight: false,
        model: parse(text()).expect("a scene"),
    };
    let words = iv::words(&scene).expect("words");
    let (mut host, mut canvas) = (Host(Vec::new()), Box::new(Canvas::new()));
    program::run(&mut host, &mut canvas, &words).expect("a model");
    let wanted = iv::draw(&scene).expect("a picture");
    let (mut edges, mut covered, mut worst) = (0, [0; 2], 0.0f64);
    for (&pixel, wanted) in canvas.color().iter().zip(&wanted.pixels) {
        let Some(object) = wanted.primitive.checked_sub(1).map(|i| i as usize / 8) else {
            edges += usize::from(pixel != 0);
            continue;
        };
        covered[object] += 1;
        if pixel == 0 {
            edges += 1;
            continue;
        }
        let [r, g, b, _] = wanted.rgba.map(f64::from);
        let level = |v: u16, most: f64, wanted: f64| (f64::from(v) / most * 255.0 - wanted).abs() * most / 255.0;
        let [r, g, b] = [
            level(pixel >> 11, 31.0, r),
            level(pixel >> 5 & 63, 63.0, g),
            level(pixel & 31, 31.0, b),
        ];
        worst = worst.max(r).max(g).max(b);
    }
    println!(
        "covered {covered:?}, edges {edges}, at most {worst:.2} levels of RGB565, {:?}",
        host.0
    );
    assert!(covered.iter().all(|&pixels| pixels > 100), "{covered:?}");
    // Points are rounded to 2^-16 of the size: a pixel on an edge may fall on either side.
    assert!(edges <= 4, "{edges} pixels are not the same shape");
    // Half a level of rounding here, a level of 255 cut off there, and a pixel inside that shows the neighbouring triangle.
    assert!(worst < 0.9, "{worst} levels of RGB565 apart");
}

#[test]
fn words_that_are_no_model_are_refused() {
    let run = |words: &[u16]| program::run(&mut Host(Vec::new()), &mut Box::new(Canvas::new()), words);
    assert_eq!([run(&[]), run(&[9]), run(&[9, 9, 1])], [None; 3]);
    // No object: an empty picture.
    assert_eq!(run(&[9, 9]), Some(()));
}
