//! A drawing as Rust: tables, programs, and the function that draws.

use std::collections::HashMap;
use std::fmt::Write;

use fixel::depth::FAR;

pub mod kinds;
mod lights;
mod program;
mod shapes;
pub(super) mod tables;
mod uses;

use super::drawing::{Drawing, Nearer, Paint, Pixels, Program, Varying};
use super::evaluate::sampled;
use crate::picture::Picture;
use kinds::{Batch, Form, Kind};

/// A drawing, sorted.
#[derive(Debug, Clone)]
pub struct Sorted<'d> {
    /// What is drawn.
    pub drawing: &'d Drawing,
    /// The code that it needs.
    pub kinds: Vec<Kind>,
    /// In order.
    pub batches: Vec<Batch>,
    /// Of its textures.
    pub palettes: Palettes,
}

/// Textures of few colours, whose texels are bytes.
#[derive(Debug, Clone)]
pub struct Palettes(Vec<Option<Vec<[u8; 4]>>>);

impl Palettes {
    fn new(drawing: &Drawing) -> Self {
        Palettes(drawing.textures.iter().map(|texture| palette(texture)).collect())
    }

    /// The colours of a texture, if they are few.
    pub fn of(&self, texture: usize) -> Option<&[[u8; 4]]> {
        self.0.get(texture)?.as_deref()
    }
}

/// The colours in the order of their first use: at most 256, and worth it.
fn palette(texture: &Picture) -> Option<Vec<[u8; 4]>> {
    let mut numbers = HashMap::new();
    let mut colors = Vec::new();
    for &texel in &texture.pixels {
        numbers.entry(texel).or_insert_with(|| colors.push(texel));
        if colors.len() > 256 {
            return None;
        }
    }
    (colors.len() * 4 + texture.pixels.len() < texture.pixels.len() * 4).then_some(colors)
}

impl<'d> Sorted<'d> {
    /// Sorts the draws by the code that they need.
    pub fn new(drawing: &'d Drawing) -> Self {
        let palettes = Palettes::new(drawing);
        let (kinds, batches) = kinds::sort(drawing, &palettes);
        Sorted {
            drawing,
            kinds,
            batches,
            palettes,
        }
    }

    /// The textures that are looked up.
    pub fn textures(&self) -> Vec<usize> {
        let mut used: Vec<_> = self
            .drawing
            .draws
            .iter()
            .filter_map(|draw| sampled(&draw.program).map(|s| s.texture))
            .collect();
        used.sort_unstable();
        used.dedup();
        used
    }

    /// The sets of lights that shine.
    pub fn lights(&self) -> Vec<usize> {
        let mut used: Vec<_> = self.kinds.iter().filter_map(|kind| kind.lights).collect();
        used.sort_unstable();
        used.dedup();
        used
    }

    /// Whether polygons of more than three corners, or beyond 4096 px, are drawn as such.
    pub fn is_general(&self, kind: &Kind) -> bool {
        let has_corners = matches!(kind.form, Form::Polygon | Form::Line | Form::SmoothLine);
        has_corners && (self.drawing.wide || kind.most_corners > 3)
    }

    /// The file, below a comment.
    pub fn text(&self, comment: &str) -> String {
        let mut code = String::new();
        self.push_constants(&mut code);
        self.push_draw(&mut code);
        self.push_finish(&mut code);
        for kind in &self.kinds {
            let program = program::text(self.drawing, kind);
            tables::push(self, kind, &mut code);
            code += &program.items;
            shapes::push(self, kind, &program.made, &mut code);
        }
        for set in self.lights() {
            code += &lights::text(set, &self.drawing.lights[set]);
        }
        self.push_helpers(&mut code);
        tables::push_textures(self, &mut code);
        let code = code.trim_end();
        let mut text = String::new();
        for line in comment.lines() {
            let _ = writeln!(text, "{}", format!("// {line}").trim_end());
        }
        text + "\n" + &uses::of(code) + "\n" + code + "\n"
    }

    fn push_constants(&self, code: &mut String) {
        let Drawing {
            width, height, level, ..
        } = self.drawing;
        let (pixel, empty) = match self.drawing.pixels {
            Pixels::Blended(_) => ("Rgba", "Rgba { color: [0; 3], alpha: 0 }"),
            Pixels::Bytes | Pixels::Opaque(_) => ("[u8; 4]", "[0; 4]"),
        };
        let _ = write!(
            code,
            "/// Pixels in a row.
pub const WIDTH: u16 = {width};

/// Rows.
pub const HEIGHT: u16 = {height};

"
        );
        if *level > 1 {
            let _ = write!(
                code,
                "/// Samples per pixel in each direction: targets are as many times as wide and as high.
pub const SAMPLES: u16 = {level};

"
            );
        }
        let what = match self.drawing.pixels {
            Pixels::Blended(_) => "What is drawn onto: linear colour and alpha, see [`finish`].",
            _ => "What is drawn onto: red, green, blue and alpha.",
        };
        let empty = if pixel == "Rgba" && empty.len() > 20 {
            "Rgba {\n    color: [0; 3],\n    alpha: 0,\n}"
        } else {
            empty
        };
        let _ = write!(
            code,
            "/// {what}
pub type Pixel = {pixel};

/// What targets are to be filled with first.
pub const EMPTY: Pixel = {empty};

"
        );
    }

    fn push_draw(&self, code: &mut String) {
        let depth = match self.drawing.depth {
            Some(Nearer::LessOrEqual) => "LessOrEqual",
            Some(Nearer::LessOrFar) => "LessOrFar",
            None => {
                *code += "/// Draws the rows that the target holds: all, or a strip.\n";
                let color = if self.batches.is_empty() { "_color" } else { "color" };
                let _ = writeln!(code, "pub fn draw<C: Target<Pixel = Pixel>>({color}: &mut C) {{");
                for (call, faces) in self.calls() {
                    let _ = writeln!(code, "    {call}(color, &{faces});");
                }
                *code += "}\n\n";
                return;
            }
        };
        let _ = write!(
            code,
            "/// Draws the rows that the targets hold: all, or a strip. Depths are to be filled with {FAR} first.
pub fn draw<C: Target<Pixel = Pixel>, D: Target<Pixel = u16>>(color: &mut C, depth: &mut D) {{
    let depth = &mut DepthBuffer::<_, {depth}>::new(depth);
"
        );
        for (call, faces) in self.calls() {
            let _ = writeln!(code, "    {call}(color, depth, &{faces});");
        }
        *code += "}\n\n";
    }

    /// Functions to be called, each with its table.
    fn calls(&self) -> impl Iterator<Item = (String, String)> {
        self.batches.iter().enumerate().map(|(number, batch)| {
            let kind = &self.kinds[batch.kind];
            (kind.snake(), self.table(number, kind))
        })
    }

    /// The table of a batch.
    pub fn table(&self, batch: usize, kind: &Kind) -> String {
        let of_kind = |b: &&Batch| self.kinds[b.kind].name == kind.name;
        if self.batches.iter().filter(of_kind).count() == 1 {
            format!("{}_FACES", kind.upper())
        } else {
            format!("{}_FACES_{batch}", kind.upper())
        }
    }

    /// How samples become bytes.
    fn push_finish(&self, code: &mut String) {
        let Pixels::Blended(_) = self.drawing.pixels else {
            return;
        };
        let color = "let [r, g, b] = color.map(byte)";
        if self.drawing.level == 1 {
            let _ = write!(
                code,
                "/// Makes bytes of pixels: red, green, blue and alpha.
pub fn finish(colors: &[Pixel], bytes: &mut [[u8; 4]]) {{
    for (bytes, &Rgba {{ color, alpha }}) in bytes.iter_mut().zip(colors) {{
        {color};
        *bytes = [r, g, b, alpha_byte(alpha)];
    }}
}}

"
            );
            return;
        }
        let level = self.drawing.level;
        let _ = write!(
            code,
            "const LEVEL: Level = match Level::new({level}) {{
    Ok(level) => level,
    Err(_) => panic!(\"not in 1 to 16\"),
}};

/// Makes a row of bytes, red, green, blue and alpha, of {level} rows of samples.
pub fn finish(samples: &[Pixel], bytes: &mut [[u8; 4]]) {{
    let stride = WIDTH as usize * SAMPLES as usize;
    LEVEL.resolve(samples, stride, |column, Rgba {{ color, alpha }}| {{
        if let Some(bytes) = bytes.get_mut(column) {{
            {color};
            *bytes = [r, g, b, alpha_byte(alpha)];
        }}
    }});
}}

"
        );
    }

    fn push_helpers(&self, code: &mut String) {
        let uses = |code: &str, name: &str| code.contains(name);
        if self.kinds.iter().any(|kind| self.is_general(kind)) {
            *code += shapes::POLYGON;
        }
        let is_simple =
            |kind: &Kind| !self.is_general(kind) && matches!(kind.form, Form::Polygon | Form::Line | Form::SmoothLine);
        if self.kinds.iter().any(is_simple) {
            *code += shapes::CORNER;
        }
        if uses(code, "Polished") {
            *code += POLISHED;
        }
        if uses(code, " levels(") || uses(code, "(levels(") {
            *code += LEVELS;
        }
        if uses(code, "wide_levels(") {
            *code += WIDE_LEVELS;
        }
        if uses(code, "fine([") {
            *code += FINE;
        }
        if let Pixels::Blended(units) | Pixels::Opaque(units) = self.drawing.pixels {
            let is_used = uses(code, "SHIFT") || uses(code, "bytes(color") || uses(code, "map(byte)");
            if is_used && (uses(code, "SHIFT") || units.shift > 0) {
                let _ = write!(
                    code,
                    "/// Colours are in units of 2^(SHIFT − 28) of full.
const SHIFT: u32 = {};

",
                    units.shift
                );
            }
            if uses(code, "(bytes(color") {
                *code += BYTES;
            }
            if uses(code, "map(byte)") {
                *code += match (units.srgb, units.shift) {
                    (true, 0) => ENCODED,
                    (true, _) => ENCODED_SHIFTED,
                    (false, 0) => BYTE,
                    (false, _) => BYTE_SHIFTED,
                };
            }
            if uses(code, "alpha_byte(") || uses(code, " linear_byte(") {
                *code += ALPHA_BYTE;
            }
        } else if uses(code, "(bytes(color") {
            *code += BYTES;
            *code += BYTE;
        }
    }

    /// Whether something asks for light with highlights, textures and so on: for the comment.
    pub fn has(&self, wanted: impl Fn(&Program) -> bool) -> bool {
        self.kinds.iter().any(|kind| wanted(&kind.program))
    }

    /// Whether values are divided by w.
    pub fn divides(&self) -> bool {
        self.kinds.iter().any(|kind| kind.varying == Varying::Perspective)
    }

    /// Whether something is blended.
    pub fn blends(&self) -> bool {
        let opaque = |program: &Program| match program {
            Program::Paint(Paint::Colors { opaque, .. } | Paint::Decal { opaque, .. }) => *opaque,
            _ => false,
        };
        matches!(self.drawing.pixels, Pixels::Blended(_)) && self.has(|program| !opaque(program))
    }
}

const POLISHED: &str = "/// Highlights: exponent in units of 2^-16, brightness in the unit of the surfaces' colours.
#[derive(Clone, Copy)]
struct Polished {
    exponent: u32,
    highlight: i32,
}

impl Finish for Polished {
    const SHINES: bool = true;

    #[inline]
    fn strength(&self, cosine: i32) -> i32 {
        fixel::num::power(cosine, self.exponent)
    }

    #[inline]
    fn highlight(&self) -> i32 {
        self.highlight
    }
}

";

const LEVELS: &str = "/// Channels in units of 2^(shift − 16) levels as bytes: cut off, clamped to 0…255.
#[inline]
fn levels(color: [i32; 3], shift: i32) -> Pixel {
    wide_levels(color.map(i64::from), shift)
}

";

const WIDE_LEVELS: &str = "/// Channels in units of 2^(shift − 16) levels as bytes: cut off, clamped to 0…255.
#[inline]
fn wide_levels(color: [i64; 3], shift: i32) -> Pixel {
    let up = shift.saturating_sub(16);
    let [r, g, b] = color.map(|c| {
        let levels = match u32::try_from(up) {
            // From 2^8 up a single unit is more than 255 levels.
            Ok(up) => c.saturating_mul(1 << up.min(8)),
            Err(_) => c >> up.unsigned_abs().min(63),
        };
        levels.clamp(0, 255) as u8
    });
    [r, g, b, 255]
}

";

const FINE: &str = "/// Values in units 2^headroom as large.
#[inline]
fn fine(values: [i32; 4], headroom: u32) -> Rgba {
    let [r, g, b, alpha] = values.map(|v| {
        let wide = i64::from(v) << headroom;
        wide.clamp(i32::MIN.into(), i32::MAX.into()) as i32
    });
    Rgba {
        color: [r, g, b],
        alpha,
    }
}

";

const BYTES: &str = "/// A linear colour as bytes.
#[inline]
fn bytes(color: [i32; 3]) -> Pixel {
    let [r, g, b] = color.map(byte);
    [r, g, b, 255]
}

";

const BYTE: &str = "/// A channel in units of 2^-28 of full as a byte: rounded to 2^-16 of a level, and cut off.
#[inline]
fn byte(channel: i32) -> u8 {
    let full = i64::from(channel.clamp(0, fixel::blend::ONE));
    (((full * 255 + (1 << 11)) >> 12) >> 16) as u8
}

";

const BYTE_SHIFTED: &str = "/// A channel as a byte: rounded to 2^-16 of a level, and cut off.
#[inline]
fn byte(channel: i32) -> u8 {
    let full = (i64::from(channel) << SHIFT).clamp(0, fixel::blend::ONE.into());
    (((full * 255 + (1 << 11)) >> 12) >> 16) as u8
}

";

const ENCODED: &str = "/// A linear channel in units of 2^-28 of full as a byte: encoded, and cut off.
#[inline]
fn byte(channel: i32) -> u8 {
    (srgb::encode(channel) >> 16) as u8
}

";

const ENCODED_SHIFTED: &str = "/// A linear channel as a byte: encoded, and cut off.
#[inline]
fn byte(channel: i32) -> u8 {
    let full = (i64::from(channel) << SHIFT).clamp(0, fixel::blend::ONE.into());
    (srgb::encode(full as i32) >> 16) as u8
}

";

const ALPHA_BYTE: &str = "/// Alpha in units of 2^-28 as a byte: rounded to 2^-16 of a level, and cut off.
#[inline]
fn alpha_byte(alpha: i32) -> u8 {
    (((i64::from(alpha) * 255 + (1 << 11)) >> 12) >> 16) as u8
}

";
