//! The float64 reference against the official HW2 pictures: identical byte for byte.
//!
//! The pictures are not ours to ship. `FIXEL_CONFORMANCE` names the folder that holds `hw2/NAME.txt` and `hw2/NAME.png`;
//! where it is set, every file must be there.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

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
    let Some(folder) = std::env::var_os("FIXEL_CONFORMANCE") else {
        eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, no official picture was compared");
        return;
    };
    let folder = PathBuf::from(folder).join("hw2");
    let mut different = Vec::new();
    for case in CASES {
        let (size, expected) = official(&folder.join(format!("{case}.png")));
        let (rendered_size, rendered) = reference(&folder.join(format!("{case}.txt")));
        assert_eq!(rendered_size, size, "{case}: the size");
        let pairs = rendered.iter().zip(&expected);
        let pixels = pairs.filter(|(ours, official)| ours != official).count();
        if pixels > 0 {
            different.push(format!("{case}: {pixels} pixels"));
        }
    }
    println!("{} official pictures compared", CASES.len());
    assert!(different.is_empty(), "not identical: {different:?}");
}

/// Size and RGBA bytes of an official picture.
fn official(path: &Path) -> ((u32, u32), Vec<[u8; 4]>) {
    let file = File::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut decoder = png::Decoder::new(BufReader::new(file));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().expect("a PNG file");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a small picture")];
    let frame = reader.next_frame(&mut bytes).expect("a whole PNG file");
    assert_eq!(frame.color_type, png::ColorType::Rgba, "{}", path.display());
    let (pixels, rest) = bytes.as_chunks();
    assert!(rest.is_empty());
    ((frame.width, frame.height), pixels.to_vec())
}

/// Size and RGBA bytes of the reference's picture of a scene.
fn reference(path: &Path) -> ((u32, u32), Vec<[u8; 4]>) {
    let text = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let folder = path.parent().expect("a file in a folder");
    let scene = hw2::parse(text, folder).unwrap_or_else(|e| panic!("{}: {e:?}", path.display()));
    let mut back_end = Reference::new(scene.width, scene.height);
    interpret(&scene, &mut back_end).unwrap_or_else(|e| panic!("{}: {e:?}", path.display()));
    let picture = back_end.finish();
    ((picture.width, picture.height), picture.bytes())
}
