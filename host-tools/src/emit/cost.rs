//! What an emitted scene requires, and what that costs.

use std::fmt::Write;

use fixel::light::Light;

use super::analyse::{Analysed, Depth};
use super::drawing::{Drawing, Lights, Paint, Pixels, Program, Surface, Varying};
use super::replay::Work;
use super::write::Sorted;
use super::write::kinds::{Form, Kind, Place};
use crate::words::counted;

/// Rows of the strips for which RAM is told.
const STRIP: u64 = 16;

/// What an emitted scene requires.
#[derive(Debug, Clone, PartialEq)]
pub struct Requirements {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples per pixel in each direction.
    pub level: u32,
    /// Why there is or is no depth buffer.
    pub depth: Depth,
    /// Whether pixels are linear colours that `finish` makes bytes of.
    pub finished: bool,
    /// One line for each function.
    pub kinds: Vec<String>,
    /// One line for each further feature.
    pub features: Vec<String>,
    /// Shapes that cover no sample and are left out.
    pub unseen: usize,
    /// Bytes of tables and textures: exact.
    pub data: u64,
    /// Bytes of code on a Cortex-M4 at opt-level 3: an estimate.
    pub code: u64,
    /// Bytes of a frame.
    pub frame: u64,
    /// Bytes of a strip of 16 rows.
    pub strip: u64,
    /// Instructions on a Cortex-M4 for a frame drawn whole: an estimate.
    pub instructions: u64,
    /// The same in strips of 16 rows.
    pub instructions_in_strips: u64,
}

impl Requirements {
    /// Of an analysed drawing.
    pub fn new(analysed: &Analysed, sorted: &Sorted<'_>) -> Self {
        let drawing = &analysed.drawing;
        let finished = matches!(drawing.pixels, Pixels::Blended(_));
        let sample = if finished { 16 } else { 4 } + if drawing.depth.is_some() { 2 } else { 0 };
        let level = u64::from(drawing.level).pow(2);
        let row = u64::from(drawing.width) * level * sample;
        let rows = u64::from(drawing.height);
        Requirements {
            width: drawing.width,
            height: drawing.height,
            level: drawing.level,
            depth: analysed.depth,
            finished,
            kinds: sorted.kinds.iter().map(|kind| described(drawing, kind)).collect(),
            features: features(drawing, sorted),
            unseen: analysed.unseen,
            data: data(sorted),
            code: code(sorted),
            frame: row * rows,
            strip: row * rows.min(STRIP),
            instructions: instructions(analysed, sorted, 1),
            instructions_in_strips: instructions(analysed, sorted, rows.div_ceil(STRIP)),
        }
    }

    /// For people: a line each.
    pub fn lines(&self) -> Vec<String> {
        let Requirements { width, height, .. } = self;
        let mut lines = vec![format!("picture: {width} x {height}")];
        if self.level > 1 {
            lines.push(format!("samples: {0} x {0} per pixel", self.level));
        }
        lines.extend(self.kinds.iter().map(|kind| format!("draws: {kind}")));
        lines.push(format!(
            "depth buffer: {}",
            match self.depth {
                Depth::Unasked => "none, the scene asks for none",
                Depth::NoOverlap => "none, nothing overlaps",
                Depth::InOrder => "none, what is drawn later is nearer",
                Depth::Needed => "16 bits a sample",
            }
        ));
        lines.extend(self.features.iter().cloned());
        if self.unseen > 0 {
            lines.push(format!("left out: {} triangles that cover no sample", self.unseen));
        }
        lines.push(format!(
            "flash: {} bytes of data, about {} of code (Cortex-M4, opt-level 3)",
            self.data, self.code
        ));
        lines.push(format!(
            "RAM: {} bytes for a frame, {} for a strip of {STRIP} rows, and the stack",
            self.frame, self.strip
        ));
        lines.push(format!(
            "instructions: about {} for a frame, {} in strips (estimated, Cortex-M4)",
            self.instructions, self.instructions_in_strips
        ));
        lines
    }

    /// The file's first lines.
    pub fn comment(&self, origin: &str) -> String {
        let mut text = format!("Made by: {origin}\n\n");
        for line in self.lines() {
            let _ = writeln!(text, "{line}");
        }
        text
    }
}

fn described(drawing: &Drawing, kind: &Kind) -> String {
    let what = match kind.form {
        Form::Polygon if kind.most_corners > 3 => format!("polygons of up to {} corners", kind.most_corners),
        Form::Polygon => "triangles".into(),
        Form::Line => "lines".into(),
        Form::SmoothLine => "antialiased lines".into(),
        Form::Square => "squares".into(),
        Form::Disc => "discs".into(),
        Form::Billboard => "billboards".into(),
    };
    let values = match (kind.varying, kind.values) {
        (Varying::Nothing, _) => "no varyings".to_owned(),
        (Varying::Linear, n) => format!("{n} values, linear"),
        (Varying::Perspective, n) => format!("{n} values, in perspective (a division per pixel where w varies)"),
    };
    let lights = kind.lights.map_or(String::new(), |set| {
        let (suns, bulbs) = counts(&drawing.lights[set]);
        let (suns, bulbs) = (counted(suns, "distant light"), counted(bulbs, "point light"));
        format!(", {suns} and {bulbs}")
    });
    format!("{what}, {}: {values}{lights}", program(&kind.program))
}

/// Lights far away and at points.
fn counts(lights: &Lights) -> (usize, usize) {
    match lights {
        Lights::Eye(lights) => {
            let suns = lights.iter().filter(|l| matches!(l, Light::Sun { .. })).count();
            (suns, lights.len() - suns)
        }
        Lights::World(_, lights) => (0, lights.len()),
    }
}

fn program(program: &Program) -> &'static str {
    match program {
        Program::Flat(_) => "flat",
        Program::Surface { surface, lit, .. } => match (surface, lit.is_some()) {
            (Surface::Plain(_), _) => "one colour, lit",
            (Surface::Gouraud, false) => "Gouraud",
            (Surface::Gouraud, true) => "Gouraud, lit",
            (Surface::Textured(_), false) => "textured",
            (Surface::Textured(_), true) => "textured, lit",
            (Surface::Decal(..), false) => "decals",
            (Surface::Decal(..), true) => "decals, lit",
        },
        Program::Paint(Paint::Plain(_)) => "one colour, blended",
        Program::Paint(Paint::Colors { opaque: true, .. }) => "Gouraud",
        Program::Paint(Paint::Colors { .. }) => "Gouraud with alpha",
        Program::Paint(Paint::Texels(_)) => "textured",
        Program::Paint(Paint::Decal { .. }) => "decals",
        Program::Corners => "Gouraud",
        Program::Phong { .. } => "Phong",
    }
}

fn features(drawing: &Drawing, sorted: &Sorted<'_>) -> Vec<String> {
    let mut features = Vec::new();
    if sorted.blends() {
        features.push("blending: colours with alpha, 16 bytes a sample".to_owned());
    }
    if let Pixels::Blended(units) | Pixels::Opaque(units) = drawing.pixels
        && units.srgb
    {
        features.push("sRGB: encoded, a table of 1224 bytes".to_owned());
    }
    let textures = sorted.textures();
    if !textures.is_empty() {
        features.push(format!("textures: {}", textures.len()));
    }
    let bits = if drawing.wide { 64 } else { 32 };
    features.push(format!("edges: {bits}-bit words"));
    features
}

/// Bytes of all tables.
fn data(sorted: &Sorted<'_>) -> u64 {
    let drawing = sorted.drawing;
    let depth = drawing.depth.is_some();
    let words = |kind: &Kind| match kind.corners.first() {
        Some(Place::Center(_)) => 3 + usize::from(depth),
        Some(Place::Billboard(_)) => 5 + usize::from(depth),
        _ => {
            let own = match kind.varying {
                Varying::Nothing => 0,
                Varying::Linear => kind.values,
                Varying::Perspective => 1 + kind.values * if kind.stores_over_w() { 2 } else { 1 },
            };
            2 + usize::from(depth) + own
        }
    };
    let mut bytes = 0;
    for kind in &sorted.kinds {
        bytes += kind.corners.len() * words(kind) * 4;
        let varied = kind.parameters.iter().filter(|p| p.constant.is_none());
        let look: usize = varied.map(|p| size(&p.of)).sum();
        bytes += kind.looks.len() * look;
    }
    for batch in &sorted.batches {
        let kind = &sorted.kinds[batch.kind];
        let index = if kind.corners.len() < 65535 { 2 } else { 4 };
        let ends = usize::from(sorted.is_general(kind));
        let looks = usize::from(kind.has_looks());
        let numbers: usize = batch.draws.iter().map(|(_, c)| c.len() + looks + ends).sum();
        bytes += numbers.saturating_sub(ends) * index;
    }
    for set in sorted.lights() {
        bytes += match &drawing.lights[set] {
            lights @ Lights::Eye(_) => {
                let (suns, bulbs) = counts(lights);
                suns * 24 + bulbs * 40
            }
            // The eye, and of each light a power more.
            Lights::World(_, lights) => 32 + lights.len() * 48,
        };
    }
    for texture in sorted.textures() {
        let count = drawing.textures[texture].pixels.len();
        bytes += match sorted.palettes.of(texture) {
            Some(colors) => count + colors.len() * 4,
            None => count * 4,
        };
    }
    bytes as u64
}

/// Bytes of a parameter's type.
fn size(of: &str) -> usize {
    match of {
        "i32" | "u32" | "Pixel" => 4,
        "[i32; 3]" => 12,
        "Polished" => 8,
        "Rgba" => 16,
        "Material<Glossy>" => 40,
        _ if of.starts_with("Material") => 24,
        // A texture: two slices, two sides, and the bits.
        _ if of.contains("Palette") => 24,
        _ => 16,
    }
}

/// What the compiler makes of all functions: what kinds share, and what each has for itself. The numbers are rounded from images
/// of one scene each, less one of none; `cargo xtask emitted` measures some again.
fn code(sorted: &Sorted<'_>) -> u64 {
    let (drawing, kinds) = (sorted.drawing, &sorted.kinds);
    let any = |is: &dyn Fn(&Kind) -> bool| kinds.iter().any(is);
    let varies = |varying: Varying| any(&|kind| kind.varying == varying);
    let has = |form: Form| any(&|kind| kind.form == form);
    let bulbs = |kind: &Kind| kind.lights.is_some_and(|set| counts(&drawing.lights[set]).1 > 0);
    let surface = |kind: &Kind| matches!(kind.program, Program::Surface { .. });
    let shiny = |kind: &Kind| matches!(&kind.program, Program::Surface { lit: Some(lit), .. } if lit.shiny.is_some());
    let is_flat = |kind: &Kind| kind.form == Form::Polygon && kind.varying == Varying::Nothing;
    let srgb = matches!(drawing.pixels, Pixels::Blended(units) | Pixels::Opaque(units) if units.srgb);
    let shared = [
        (450, !kinds.is_empty()),
        (850, any(&|kind| is_flat(kind) && !sorted.is_general(kind))),
        (3400, any(&|kind| sorted.is_general(kind))),
        (
            1500,
            drawing.depth.is_some() || any(&|kind| kind.varying != Varying::Nothing),
        ),
        (600, varies(Varying::Linear)),
        (1800, varies(Varying::Perspective)),
        (6200, any(&|kind| matches!(kind.program, Program::Phong { .. }))),
        (3250, any(&|kind| surface(kind) && bulbs(kind))),
        (2100, any(&shiny)),
        (900, any(&|kind| matches!(kind.program, Program::Paint(_)))),
        (550, any(&|kind| matches!(kind.program, Program::Corners))),
        (1150, srgb),
        (1800, drawing.level > 1),
        (1900, has(Form::SmoothLine)),
        (950, has(Form::Disc)),
    ];
    let shared: u64 = shared.into_iter().filter(|(_, is)| *is).map(|(bytes, _)| bytes).sum();
    let own: u64 = kinds.iter().map(|kind| own_code(kind, drawing.depth.is_some())).sum();
    shared + own
}

/// Of the function that draws a kind.
fn own_code(kind: &Kind, depth: bool) -> u64 {
    let values = kind.values as u64;
    let form = match kind.form {
        Form::Polygon => 1400,
        Form::Line | Form::SmoothLine => 1350,
        _ => 1100,
    };
    let varying = match kind.varying {
        Varying::Nothing => 0,
        Varying::Linear => 200 * values,
        Varying::Perspective => 500 + 500 * values,
    };
    let lit = matches!(kind.program, Program::Surface { lit: Some(_), .. });
    form + varying + if depth { 1300 } else { 0 } + if lit { 1250 } else { 0 }
}

/// The model: so much to clear and finish the samples; so much for a shape in each strip, for each of its rows, for each
/// sample covered, and for each coloured. The numbers are rounded from what `cargo xtask emitted` measures.
fn instructions(analysed: &Analysed, sorted: &Sorted<'_>, strips: u64) -> u64 {
    let drawing = sorted.drawing;
    let samples = f64::from(drawing.width) * f64::from(drawing.height) * f64::from(drawing.level.pow(2));
    let clear = match drawing.pixels {
        Pixels::Blended(_) => 60.0,
        Pixels::Bytes | Pixels::Opaque(_) => 2.0,
    };
    let depth = if drawing.depth.is_some() { 1.0 } else { 0.0 };
    let mut sum = samples * (clear + depth);
    let mut work = analysed.work.iter();
    for batch in &sorted.batches {
        let kind = &sorted.kinds[batch.kind];
        for work in batch.draws.iter().map_while(|_| work.next()) {
            sum += of_shape(sorted, kind, work, strips as f64);
        }
    }
    sum as u64
}

fn of_shape(sorted: &Sorted<'_>, kind: &Kind, work: &Work, strips: f64) -> f64 {
    let values = kind.values as f64;
    let depth = if sorted.drawing.depth.is_some() { 1.0 } else { 0.0 };
    let (per_strip, per_span, per_sample) = match kind.varying {
        Varying::Nothing => (500.0 + 300.0 * depth, 80.0, 1.0 + 8.0 * depth),
        Varying::Linear => (
            430.0 + 430.0 * (values + depth),
            100.0 + 60.0 * values,
            9.0 + 5.0 * values,
        ),
        Varying::Perspective => (
            800.0 + 600.0 * (values + depth),
            90.0 + 50.0 * values,
            // Nothing is divided where w is the same everywhere.
            if kind.has_one_w() {
                20.0 + 25.0 * values
            } else {
                120.0 + 40.0 * values
            },
        ),
    };
    let shines = match &kind.program {
        Program::Surface { lit: Some(lit), .. } => lit.shiny.is_some(),
        Program::Phong { shines, .. } => *shines,
        _ => false,
    };
    let lights = kind.lights.map_or(0.0, |set| {
        let (suns, bulbs) = counts(&sorted.drawing.lights[set]);
        let highlights = if shines { 300.0 * (suns + bulbs) as f64 } else { 0.0 };
        200.0 + 50.0 * suns as f64 + 190.0 * bulbs as f64 + highlights
    });
    let blend = match &kind.program {
        Program::Paint(Paint::Decal { .. }) => 300.0,
        Program::Paint(_) if sorted.blends() => 130.0,
        _ => 0.0,
    };
    let fetch = match &kind.program {
        Program::Surface { surface, .. } => matches!(surface, Surface::Textured(_) | Surface::Decal(..)),
        Program::Paint(paint) => matches!(paint, Paint::Texels(_) | Paint::Decal { .. }),
        _ => false,
    };
    let fetch = if fetch { 20.0 } else { 0.0 };
    // Encoded where a pixel is stored, or where all samples are finished.
    let encode = match sorted.drawing.pixels {
        Pixels::Blended(units) if units.srgb => 90.0,
        Pixels::Opaque(units) if units.srgb => 240.0,
        _ => 0.0,
    };
    per_strip * strips
        + per_span * work.spans as f64
        + per_sample * work.covered as f64
        + (lights + blend + fetch + encode) * work.shaded as f64
}
