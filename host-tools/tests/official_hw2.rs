//! The float64 reference against the official HW2 pictures: identical byte for byte.

mod official;

use fixel_host::interpret::interpret;
use fixel_host::reference::hw2::Reference;
use fixel_host::scene::hw2;

/// Every case that has an official picture.
const CASES: [&str; 13] = [
    "hw2cull",
    "hw2depth",
    "hw2frustum",
    "hw2lookat",
    "hw2multmv",
    "hw2ortho",
    "hw2pixelclip",
    "hw2rotate",
    "hw2rotatex",
    "hw2scale",
    "hw2trif",
    "hw2trig",
    "hw2xyzw",
];

#[test]
fn the_reference_reproduces_every_official_picture() {
    official::compare("hw2", &CASES, |text, folder| {
        let scene = hw2::parse(text, folder).expect("a good scene");
        let mut back_end = Reference::new(scene.width, scene.height);
        interpret(&scene, &mut back_end).expect("a scene that can be drawn");
        let picture = back_end.finish();
        ((picture.width, picture.height), picture.bytes())
    });
}
