//! The core's pictures of Inventor scenes: near the oracle's and the course's, every difference explained, strips.

mod iv_pictures;

use fixel::window::Window;
use fixel_host::compare::{self, Class};
use fixel_host::fixed::{FixedPicture, iv};
use fixel_host::picture::Picture;
use fixel_host::reference;
use fixel_host::scene::iv::{Face, Scene, Shading, parse};
use iv_pictures::{Case, STEP, apart, cases, like_the_course, picture, scene};

/// What must not be missing.
const CASES: [&str; 21] = [
    "cube2-gouraud",
    "cubeClip-gouraud",
    "cube3-gouraud",
    "cube3-phong",
    "cube3-flat",
    "sphere-gouraud",
    "lion1-smooth",
    "sphere-flat",
    "cube2-phong",
    "lion1-flat",
    "sphere-eyelight",
    "defaults-gouraud",
    "defaults-phong",
    "behind-phong",
    "behind-flat",
    "normals-gouraud",
    "normals-phong",
    "clamps-phong",
    "pierce-flat",
    "nolight-flat",
    "nolight-eyelight",
];

/// The cases, unless they are not at hand.
fn official() -> Option<Vec<Case>> {
    let cases = cases();
    match &cases {
        None => eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, no picture is compared"),
        Some(cases) => {
            let missing = |name: &&str| !cases.iter().any(|case| case.name == **name);
            let missing: Vec<&str> = CASES.into_iter().filter(missing).collect();
            assert!(missing.is_empty(), "not in the manifest: {missing:?}");
        }
    }
    cases
}

fn drawn(scene: &Scene) -> FixedPicture {
    iv::draw(scene).unwrap_or_else(|fault| panic!("{fault}"))
}

fn bytes(fixed: &FixedPicture) -> Picture {
    Picture::new(fixed.width, fixed.height, fixed.pixels.iter().map(|p| p.rgba).collect())
}

#[test]
fn the_core_agrees_with_every_picture() {
    let Some(cases) = official() else { return };
    let mut wrong = Vec::new();
    for case in &cases {
        let scene = scene(case);
        let fixed = drawn(&scene);
        let (ours, theirs) = (bytes(&fixed), picture(&case.reference));
        assert_eq!(ours.size(), theirs.size(), "{}: the size", case.name);
        let verdict = match &*case.kind {
            "oracle" => like_the_oracle(&scene, &fixed, &theirs),
            "course" if case.name.starts_with("lion") => like_the_course(&ours, &theirs, STEP, 4.0),
            "course" => like_the_course(&ours, &theirs, STEP, 3.0),
            // No JPEG, but drawn with other edges: the colours inside are the very same.
            "course?" => like_the_course(&ours, &theirs, 0, 0.0),
            kind => panic!("{}: unknown kind {kind}", case.name),
        };
        println!("{}: {}", case.name, verdict.clone().unwrap_or_else(|figures| figures));
        wrong.extend(verdict.err().map(|figures| format!("{}: {figures}", case.name)));
    }
    println!("{} pictures compared", cases.len());
    assert!(wrong.is_empty(), "too far off: {wrong:?}");
}

#[test]
fn every_difference_is_explained() {
    let Some(cases) = official() else { return };
    let mut failures = Vec::new();
    for case in &cases {
        let scene = scene(case);
        let comparison = compare::iv::compare(&scene, &drawn(&scene), &reference::iv::draw(&scene));
        println!(
            "{}: drawn {}, {:?}, unexplained {}, beyond {}, max {}",
            case.name,
            comparison.pixels_drawn,
            comparison.explained,
            comparison.unexplained,
            comparison.beyond_gradient,
            comparison.max_channel_error
        );
        if comparison.unexplained > 0 {
            failures.push(&case.name);
        }
    }
    println!("{} pictures compared with float64", cases.len());
    assert!(failures.is_empty(), "unexplained differences in {failures:?}");
}

/// Strips of any height, and tiles, give the bytes of the whole frame: colour, winner and depth.
#[test]
fn strips_equal_whole_frames() {
    let Some(cases) = official() else { return };
    for case in &cases {
        let scene = scene(case);
        let (width, height) = (scene.width as i32, scene.height as i32);
        let whole = drawn(&scene);
        let part = |window| iv::draw_part(&scene, window).unwrap_or_else(|fault| panic!("{fault}"));
        for rows in [7, 16, 100] {
            let (mut pixels, mut depth) = (Vec::new(), Vec::new());
            for top in (0..height).step_by(rows as usize) {
                let strip = part(Window::new(0, top, width, (top + rows).min(height)));
                pixels.extend(strip.pixels);
                depth.extend(strip.depth);
            }
            assert!(
                pixels == whole.pixels && depth == whole.depth,
                "{} in strips of {rows}",
                case.name
            );
        }
        let tile = Window::new(width / 3, height / 4, width / 3 + 29, height / 4 + 31);
        let part = part(tile);
        for (i, pixel) in part.pixels.iter().enumerate() {
            let at = (tile.top as usize + i / 29) * scene.width as usize + tile.left as usize + i % 29;
            assert!(
                *pixel == whole.pixels[at] && part.depth[i] == whole.depth[at],
                "{} in a tile",
                case.name
            );
        }
    }
    println!("{} scenes drawn in strips", cases.len());
}

/// 64-bit edges give the bytes of 32-bit ones where nothing reaches the guard band.
/// A quad before the default camera that turns away from it, and another point.
fn quad_and(point: &str, shading: Shading) -> Scene {
    let model = format!(
        "PerspectiveCamera {{ position 0 0 4 }} PointLight {{ location 1 2 3 color 0.9 0.8 0.7 }}
         Separator {{ Material {{ diffuseColor 0.7 0.5 0.3 specularColor 0.6 0.6 0.6 shininess 0.1 }}
           Coordinate3 {{ point [ {point} -1 -1 0.3, 1 -1 -0.2, 1.1 1 0.1, -0.9 1.2 0 ] }}
           Normal {{ vector [ 0 0 1, 0.2 0 1, 0 0.3 1, -0.2 -0.1 1 ] }}
           IndexedFaceSet {{ coordIndex [ {}, -1 ] normalIndex [ 0, 1, 2, 3, -1 ] }} }}",
        if point.is_empty() { "0, 1, 2, 3" } else { "1, 2, 3, 4" },
    );
    Scene {
        width: 60,
        height: 60,
        output: "out.ppm".into(),
        shading,
        eyelight: false,
        model: parse(&model).expect("a model"),
    }
}

#[test]
fn a_point_of_no_face_changes_nothing() {
    for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
        let alone = drawn(&quad_and("", shading));
        assert!(alone.pixels.iter().filter(|p| p.primitive != 0).count() > 150);
        for point in ["1e12 -1e12 1e12,", "-3e9 0 0,", "1e300 0 0,"] {
            let scene = quad_and(point, shading);
            let fixed = drawn(&scene);
            assert!(fixed.pixels == alone.pixels, "{shading:?} {point}");
            let comparison = compare::iv::compare(&scene, &fixed, &reference::iv::draw(&scene));
            assert_eq!(comparison.unexplained, 0, "{shading:?} {point}");
        }
    }
}

#[test]
fn wide_edges_agree() {
    let Some(cases) = official() else { return };
    // Faces that reach behind the camera are cut at the guard band, which is eight times as wide with 64-bit edges.
    for case in cases.iter().filter(|case| !case.name.starts_with("behind")) {
        let scene = scene(case);
        let window = Window::new(0, 0, scene.width as i32, scene.height as i32);
        let narrow = iv::with_word::<i32>(&scene, window).unwrap_or_else(|fault| panic!("{fault}"));
        let wide = iv::with_word::<i64>(&scene, window).unwrap_or_else(|fault| panic!("{fault}"));
        assert!(narrow == wide, "{}", case.name);
    }
}

/// Within three levels, or eight where highlights of a shininess above 10 are interpolated or lit pixel by pixel, but for ties at
/// edges: one pixel in 2,000 at most, and each must be of class *edge*.
fn like_the_oracle(scene: &Scene, fixed: &FixedPicture, theirs: &Picture) -> Result<String, String> {
    let ours = bytes(fixed);
    let classes = compare::iv::compare(scene, fixed, &reference::iv::draw(scene)).classes;
    let most = most(scene);
    let (mut different, mut far, mut inside) = (0, 0, 0);
    for (i, (&a, &b)) in ours.pixels.iter().zip(&theirs.pixels).enumerate() {
        let apart = apart(a, b);
        different += usize::from(apart > 0);
        if apart > most[fixed.pixels[i].primitive as usize] {
            far += 1;
            inside += usize::from(classes[i] != Class::Edge);
        }
    }
    let figures = format!("{different} pixels differ, {far} too far, {inside} of them not at an edge");
    let good = inside == 0 && far * 2000 <= ours.pixels.len();
    if good { Ok(figures) } else { Err(figures) }
}

/// The levels that each primitive may be off; 0 is the background.
fn most(scene: &Scene) -> Vec<u8> {
    let mut most = vec![3];
    for object in &scene.model.objects {
        let shines = object.material.specular != [0.0; 3] && object.material.shininess > 10.0;
        let levels = if shines && scene.shading != Shading::Flat { 8 } else { 3 };
        let triangles = object.faces.iter().map(Face::triangles).sum::<usize>();
        most.extend(std::iter::repeat_n(levels, triangles));
    }
    most
}

#[test]
fn as_many_lights_as_there_may_be_and_that_of_the_eye() {
    let mut scene = quad_and("", Shading::Gouraud);
    scene.model.lights = vec![scene.model.lights[0]; 1024];
    scene.eyelight = true;
    assert!(drawn(&scene).pixels.iter().any(|pixel| pixel.primitive != 0));
}
