//! `cargo xtask model`: what a frame of a real model costs on a microcontroller, drawn from its vertices on.

use std::collections::HashSet;
use std::fmt;
use std::fs;
use std::path::Path;
use std::str::FromStr;

use fixel_host::fixed::iv::words;
use fixel_host::picture::Picture;
use fixel_host::scene::iv::{self, Model, Object, Scene, Shading};
use fixel_host::{files, png};
use fixel_workloads::model::canvas::{Canvas, PIXELS};
use serde_json::{Value, json};

use crate::board::M4;
use crate::checks::differing;
use crate::failure::Failure;
use crate::outcome::{Outcome, find};
use crate::toolchain::Toolchain;
use crate::{emulator, host, image};

/// Columns and rows of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    width: u16,
    height: u16,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let side = |text: &str| text.parse().ok().filter(|side| (1..=4096).contains(side));
        let size = text.split_once('x').and_then(|(width, height)| {
            Some(Size {
                width: side(width)?,
                height: side(height)?,
            })
        });
        let fits = |size: &Size| usize::from(size.width) * usize::from(size.height) <= PIXELS;
        size.filter(fits)
            .ok_or_else(|| format!("expected a size such as 320x240, of at most {PIXELS} pixels"))
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// Measures and prints; a picture that differs from the host's is a failure.
pub fn run(file: &Path, size: Size, json: bool, png: Option<&Path>) -> Result<(), Failure> {
    let scene = read(file, size, Shading::Gouraud)?;
    let words = words(&scene).map_err(|e| Failure::trouble(file.display(), e))?;
    let toolchain = Toolchain::find(M4.target)?;
    let data: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let image = image::build(&M4, &toolchain, image::MODEL, &data)?;
    let outcomes = Outcome::parse_all(&emulator::run(&M4, &image)?)?;
    let none = || Failure::Trouble(format!("{}: cannot be drawn on the host", file.display()));
    let (expected, canvas) = host::draw_model(&words).ok_or_else(none)?;
    if let Some(png) = png {
        write(png, size, &canvas)?;
    }
    let report = Report::new(&scene.model, data.len(), &outcomes)
        .ok_or_else(|| Failure::Off("the image did not report every stage".into()))?;
    if json {
        println!("{:#}", report.as_json(toolchain.version()));
    } else {
        println!("{}, {size}, Gouraud", file.display());
        report.print(toolchain.version());
    }
    let differing = differing(M4.key, &outcomes, &expected);
    if differing.is_empty() {
        Ok(())
    } else {
        Err(Failure::Off(differing.join("\n")))
    }
}

/// The scene that a file holds, in a window of a size.
pub fn read(file: &Path, size: Size, shading: Shading) -> Result<Scene, Failure> {
    let text = fs::read(file).map_err(|e| Failure::trouble(file.display(), e))?;
    let model = iv::parse(text).map_err(|e| Failure::trouble(file.display(), e))?;
    Ok(Scene {
        width: size.width.into(),
        height: size.height.into(),
        output: String::new(),
        shading,
        eyelight: false,
        model,
    })
}

/// RGB565 as a PNG file, each channel's largest value at 255.
fn write(file: &Path, size: Size, canvas: &Canvas) -> Result<(), Failure> {
    let channel = |pixel: u16, down: u32, most: u16| ((pixel >> down & most) * 255 / most) as u8;
    let rgba = |&pixel: &u16| {
        [
            channel(pixel, 11, 31),
            channel(pixel, 5, 63),
            channel(pixel, 0, 31),
            255,
        ]
    };
    let area = usize::from(size.width) * usize::from(size.height);
    let pixels = canvas.color().iter().take(area).map(rgba).collect();
    let picture = Picture::new(size.width.into(), size.height.into(), pixels);
    let bytes = png::encode(&picture).map_err(|e| Failure::trouble(file.display(), e))?;
    let written = files::stage(file, bytes).and_then(|staged| staged.commit());
    written.map_err(|e| Failure::Trouble(e.to_string()))
}

/// What the stages came to: each alone, the frame in all.
struct Report {
    /// Of the model's faces as fans.
    triangles: usize,
    /// Pairs of point and normal.
    vertices: usize,
    /// Bytes of the model.
    flash: usize,
    /// Instructions; how many vertices the cache had made.
    transforms: Stage,
    /// Instructions; how many of them are seen.
    polygons: Stage,
    /// Setting up and drawing what is seen.
    pixels: u32,
    /// In all.
    frame: Outcome,
}

struct Stage {
    instructions: u32,
    units: u32,
}

impl Report {
    /// `None` where a stage is missing.
    fn new(model: &Model, flash: usize, outcomes: &[Outcome]) -> Option<Self> {
        let [made, seen, frame] = ["vertices", "polygons", "frame"].map(|name| find(outcomes, name));
        let (made, seen, frame) = (made?, seen?, frame?);
        Some(Report {
            triangles: model.objects.iter().flat_map(|o| &o.faces).map(|f| f.triangles()).sum(),
            vertices: model.objects.iter().map(vertices).sum(),
            flash,
            transforms: Stage {
                instructions: made.instructions,
                units: made.units,
            },
            polygons: Stage {
                instructions: seen.instructions.saturating_sub(made.instructions),
                units: seen.units,
            },
            pixels: frame.instructions.saturating_sub(seen.instructions),
            frame: frame.clone(),
        })
    }

    /// The frame's instructions over a count.
    fn per(&self, count: usize) -> f64 {
        f64::from(self.frame.instructions) / count.max(1) as f64
    }

    fn print(&self, compiler: &str) {
        let Report {
            triangles, vertices, ..
        } = *self;
        let kilobytes = self.flash as f64 / 1024.0;
        println!("{vertices} vertices, {triangles} triangles, {kilobytes:.1} KiB of constants");
        println!("{}, instructions, rustc {compiler}\n", M4.core);
        println!("{:<28}{:>12}{:>10}{:>10}", "stage", "total", "units", "per unit");
        let row = |name: &str, instructions: u32, units: usize| {
            let each = f64::from(instructions) / units.max(1) as f64;
            println!("{name:<28}{instructions:>12}{units:>10}{each:>10.0}");
        };
        row(
            "vertices transformed and lit",
            self.transforms.instructions,
            self.transforms.units as usize,
        );
        row("triangles projected", self.polygons.instructions, triangles);
        row("polygons drawn", self.pixels, self.polygons.units as usize);
        println!("{:<28}{:>12}", "frame", self.frame.instructions);
        println!("{:<28}{:>32.0}", "frame per triangle", self.per(triangles));
        println!("{:<28}{:>32.0}", "frame per vertex", self.per(vertices));
        println!("\ncolour {:08x}, depth {:08x}", self.frame.color, self.frame.depth);
    }

    fn as_json(&self, compiler: &str) -> Value {
        let rounded = |count| self.per(count).round();
        json!({
            "compiler": compiler,
            "triangles": self.triangles,
            "vertices": self.vertices,
            "constants_bytes": self.flash,
            "transforms": self.transforms.units,
            "polygons": self.polygons.units,
            M4.key: {
                "frame": self.frame.instructions,
                "per_triangle": rounded(self.triangles),
                "per_vertex": rounded(self.vertices),
                "transforming": self.transforms.instructions,
                "projecting": self.polygons.instructions,
                "drawing": self.pixels,
            },
            "color": format!("{:08x}", self.frame.color),
            "depth": format!("{:08x}", self.frame.depth),
        })
    }
}

/// Its pairs of point and normal.
fn vertices(object: &Object) -> usize {
    let corners = object.faces.iter().flat_map(|face| &face.corners);
    let pairs: HashSet<_> = corners.map(|corner| (corner.point, corner.normal)).collect();
    pairs.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_and_bounded() {
        let size = |text: &str| text.parse::<Size>().ok().map(|s| (s.width, s.height));
        assert_eq!(size("320x240"), Some((320, 240)));
        assert_eq!(
            [size("640x481"), size("0x5"), size("320"), size("axb"), size("4097x1")],
            [None; 5]
        );
    }
}
