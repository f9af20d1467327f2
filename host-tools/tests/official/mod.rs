//! Official pictures, which are not ours to ship: `FIXEL_CONFORMANCE` names the folder that holds FORMAT/NAME.txt and
//! FORMAT/NAME.png; where it is set, every file must be there.

use std::fs::File;
use std::io::{BufReader, Write};
use std::path::{Path, PathBuf};

/// Width, height and RGBA bytes.
pub type Pixels = ((u32, u32), Vec<[u8; 4]>);

/// Draws every case from the text and folder of its scene, and demands the official picture.
pub fn compare(format: &str, cases: &[&str], draw: impl Fn(Vec<u8>, &Path) -> Pixels) {
    let Some(folder) = std::env::var_os("FIXEL_CONFORMANCE") else {
        say("SKIPPED: FIXEL_CONFORMANCE is not set, no official picture was compared");
        return;
    };
    let folder = PathBuf::from(folder).join(format);
    let mut different = Vec::new();
    for case in cases {
        let (size, expected) = picture(&folder.join(format!("{case}.png")));
        let scene = folder.join(format!("{case}.txt"));
        let text = std::fs::read(&scene).unwrap_or_else(|e| panic!("{}: {e}", scene.display()));
        let (drawn_size, drawn) = draw(text, &folder);
        assert_eq!(drawn_size, size, "{case}: the size");
        let pairs = drawn.iter().zip(&expected);
        let pixels = pairs.filter(|(ours, official)| ours != official).count();
        if pixels > 0 {
            different.push(format!("{case}: {pixels} pixels"));
        }
    }
    let same = cases.len() - different.len();
    say(&format!(
        "{same} of {} official {format} pictures identical",
        cases.len()
    ));
    assert!(different.is_empty(), "not identical: {different:?}");
}

/// Size and RGBA bytes of an official picture.
fn picture(path: &Path) -> Pixels {
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

/// Past the test harness, which swallows what `println!` says in a test that passes.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
