//! The cases of `MANIFEST-iv.tsv` and their pictures.

use std::fs;
use std::path::{Path, PathBuf};

use fixel_host::files;
use fixel_host::picture::Picture;
use fixel_host::scene::iv::{self, Scene, Shading};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// A line of the manifest that has a picture of a scene.
pub struct Case {
    pub name: String,
    pub kind: String,
    pub scene: PathBuf,
    pub arguments: String,
    pub reference: PathBuf,
}

/// The manifest's cases; none if there is no manifest to be had.
pub fn cases() -> Option<Vec<Case>> {
    let folder = PathBuf::from(std::env::var_os("FIXEL_CONFORMANCE")?);
    let manifest = fs::read_to_string(folder.join("MANIFEST-iv.tsv")).expect("MANIFEST-iv.tsv");
    let case = |line: &str| {
        let fields: Vec<&str> = line.split('\t').collect();
        let [_, name, _, kind, _, scene, arguments, reference] = fields[..] else {
            panic!("not a line of eight fields: {line}");
        };
        Case {
            name: name.into(),
            kind: kind.into(),
            scene: folder.join(scene),
            arguments: arguments.into(),
            reference: folder.join(reference),
        }
    };
    let cases = manifest.lines().skip(1).map(case);
    Some(
        cases
            .filter(|case| !matches!(&*case.kind, "error" | "known wrong"))
            .collect(),
    )
}

/// The scene with what the case's command line says.
pub fn scene(case: &Case) -> Scene {
    let text = fs::read(&case.scene).unwrap_or_else(|e| panic!("{}: {e}", case.scene.display()));
    let model = iv::parse(text).unwrap_or_else(|e| panic!("{}: {e}", case.scene.display()));
    let words: Vec<&str> = case.arguments.split_whitespace().collect();
    let [mode, width, height, rest @ ..] = &words[..] else {
        panic!("{}: {}", case.name, case.arguments);
    };
    Scene {
        width: width.parse().expect("a width"),
        height: height.parse().expect("a height"),
        output: "out.ppm".into(),
        shading: match *mode {
            "0" => Shading::Flat,
            "1" => Shading::Gouraud,
            "2" => Shading::Phong,
            other => panic!("{}: mode {other}", case.name),
        },
        eyelight: rest == ["-eyelight"],
        model,
    }
}

/// A PNG or JPEG file.
pub fn picture(path: &Path) -> Picture {
    if path.extension().is_some_and(|extension| extension == "png") {
        return files::read_picture(path).unwrap_or_else(|e| panic!("{e}"));
    }
    let file = fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGBA);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(file), options);
    let bytes = decoder.decode().expect("a JPEG file");
    let (width, height) = decoder.dimensions().expect("a size");
    let (pixels, rest) = bytes.as_chunks();
    assert!(rest.is_empty());
    let [width, height] = [width, height].map(|side| u32::try_from(side).expect("a small picture"));
    Picture::new(width, height, pixels.to_vec())
}

/// The largest difference of a component.
pub fn apart(a: [u8; 4], b: [u8; 4]) -> u8 {
    [0, 1, 2].map(|i| a[i].abs_diff(b[i])).into_iter().max().unwrap_or(0)
}

/// Neighbours that differ by more than this have an edge between them.
pub const STEP: u8 = 24;

/// The interior's root mean square difference at most `most`, and the covered pixels 98 % the same. The interior is what
/// both cover further than three pixels from any step.
pub fn like_the_course(ours: &Picture, theirs: &Picture, step: u8, most: f64) -> Result<String, String> {
    let (near_ours, near_theirs) = (near_steps(ours, step), near_steps(theirs, step));
    let (mut either, mut both, mut interior, mut squares) = (0.0, 0.0, 0.0, 0.0);
    for (i, (&a, &b)) in ours.pixels.iter().zip(&theirs.pixels).enumerate() {
        either += f64::from(covered(a) || covered(b));
        both += f64::from(covered(a) && covered(b));
        if covered(a) && covered(b) && !near_ours[i] && !near_theirs[i] {
            interior += 1.0;
            squares += (0..3).map(|c| f64::from(a[c].abs_diff(b[c])).powi(2)).sum::<f64>();
        }
    }
    let rms = (squares / (3.0 * interior)).sqrt();
    let overlap = both / either;
    let figures = format!("interior rms {rms:.3} of {interior} pixels, coverage {overlap:.4}");
    let good = rms <= most && overlap >= 0.98 && interior > 0.25 * both;
    if good { Ok(figures) } else { Err(figures) }
}

fn covered([r, g, b, _]: [u8; 4]) -> bool {
    r.max(g).max(b) > 16
}

/// Which pixels are within three pixels of neighbours that differ by more than `step`.
fn near_steps(picture: &Picture, step: u8) -> Vec<bool> {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let at = |x: usize, y: usize| picture.pixels[y * width + x];
    let mut near = vec![false; width * height];
    for y in 0..height {
        for x in 0..width {
            let right = x + 1 < width && apart(at(x, y), at(x + 1, y)) > step;
            let down = y + 1 < height && apart(at(x, y), at(x, y + 1)) > step;
            if !right && !down {
                continue;
            }
            // Both pixels of the step count.
            let (to_x, to_y) = (x + 3 + usize::from(right), y + 3 + usize::from(down));
            for row in y.saturating_sub(3)..=to_y.min(height - 1) {
                near[row * width..][x.saturating_sub(3)..=to_x.min(width - 1)].fill(true);
            }
        }
    }
    near
}
