//! The float64 reference against the official MP1 pictures: identical byte for byte.

mod official;

use fixel_host::reference::mp1::draw;
use fixel_host::scene::mp1;

/// Every case that has an official picture.
const CASES: [&str; 17] = [
    "mp1billboard",
    "mp1circle",
    "mp1clipplane",
    "mp1cull",
    "mp1decals",
    "mp1depth",
    "mp1frustum",
    "mp1fsaa2",
    "mp1fsaa4",
    "mp1hyp",
    "mp1indexing",
    "mp1line",
    "mp1req1",
    "mp1rgba",
    "mp1srgb",
    "mp1texture",
    "mp1wuline",
];

#[test]
fn the_reference_reproduces_every_official_picture() {
    official::compare("mp1", &CASES, |text, folder| {
        let scene = mp1::parse(text, folder).expect("a good scene");
        let picture = draw(&scene);
        ((picture.width, picture.height), picture.bytes())
    });
}
