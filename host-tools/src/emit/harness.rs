//! Emitted scenes put together as one Rust file with one way to draw them all: for tests, and for images that check them
//! on a board.

use std::fmt::Write;

use super::{Emitted, Requirements};

/// Modules of their own for all scenes, and the table `SCENES` of their names, sizes, levels and functions that draw a strip.
pub fn file(scenes: &[(String, Emitted)]) -> String {
    let mut text = String::from(MEMORY);
    let mut table = String::new();
    for (number, (name, emitted)) in scenes.iter().enumerate() {
        let Requirements {
            width, height, level, ..
        } = emitted.requirements;
        let _ = write!(text, "pub mod scene_{number} {{\n{}}}\n\n", emitted.text);
        text += &strip(number, &emitted.requirements);
        let _ = writeln!(table, "    ({name:?}, {width}, {height}, {level}, strip_{number}),");
    }
    let count = scenes.len();
    let _ = write!(
        text,
        "/// Names, sizes, samples per pixel in each direction, and what draws the rows from the first number to the second.\n\
         pub static SCENES: [(&str, u16, u16, u16, Strip); {count}] = [\n{table}];\n"
    );
    text
}

const MEMORY: &str = "/// Where strips are drawn.
pub struct Memory<'a> {
    pub samples: &'a mut [fixel::blend::Rgba],
    pub bytes: &'a mut [[u8; 4]],
    pub depths: &'a mut [u16],
}

pub type Strip = fn(&mut Memory<'_>, u16, u16) -> Result<(), fixel::error::Error>;

";

/// The function that draws rows `top` to `bottom` of a scene into the first of the memory's bytes.
fn strip(number: usize, requirements: &Requirements) -> String {
    let level = requirements.level;
    let depth = requirements.depth == super::Depth::Needed;
    let pixels = if requirements.finished { "samples" } else { "bytes" };
    let mut body = format!(
        "    let samples = fixel::window::Window::new(0, i32::from(top) * {level}, \
         i32::from(scene::WIDTH) * {level}, i32::from(bottom) * {level});
    let count = samples.width() * samples.height();
    let too_small = fixel::error::Error::BufferTooSmall;
    let colors = memory.{pixels}.get_mut(..count).ok_or(too_small)?;
    colors.fill(scene::EMPTY);
    let mut color = fixel::target::Buffer::strip(colors, samples)?;
"
    );
    if depth {
        body += "    let depths = memory.depths.get_mut(..count).ok_or(too_small)?;
    depths.fill(fixel::depth::FAR);
    let mut depth = fixel::target::Buffer::strip(depths, samples)?;
    scene::draw(&mut color, &mut depth);
";
    } else {
        body += "    scene::draw(&mut color);\n";
    }
    if requirements.finished {
        let _ = write!(
            body,
            "    let width = usize::from(scene::WIDTH);
    let rows = memory.samples.chunks(width * {level} * {level});
    for (bytes, samples) in memory.bytes.chunks_mut(width).zip(rows).take(usize::from(bottom - top)) {{
        scene::finish(samples, bytes);
    }}
"
        );
    }
    format!(
        "fn strip_{number}(memory: &mut Memory<'_>, top: u16, bottom: u16) -> Result<(), fixel::error::Error> {{
    use scene_{number} as scene;
{body}    Ok(())
}}

"
    )
}
