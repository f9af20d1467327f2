//! Emitted scenes put together as one Rust file with one way to draw them all: for tests, and for images that check them
//! on a board.

use std::fmt::Write;

use super::mesh::EmittedMesh;
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

/// Name, size of the picture, and the mesh.
pub type ShownMesh = (String, (u16, u16), EmittedMesh);

/// Modules of their own for all meshes, and the table `MESHES` of their names, sizes and functions that draw a frame, with what
/// [`shown`](fixel_workloads::shown) says of view and light.
pub fn meshes(meshes: &[ShownMesh]) -> String {
    let (mut text, mut table) = (String::new(), String::new());
    for (number, (name, (width, height), mesh)) in meshes.iter().enumerate() {
        let _ = write!(text, "pub mod mesh_{number} {{\n{}}}\n\n", mesh.text);
        text += &shown(number, (*width, *height), mesh.depth);
        let _ = writeln!(table, "    ({name:?}, {width}, {height}, shown_{number}),");
    }
    let count = meshes.len();
    let _ = write!(
        text,
        "pub type Shown = fn(&mut [u16], &mut [u16]) -> Result<(), fixel::error::Error>;

/// Names, sizes, and what draws a frame with these depths.
pub static MESHES: [(&str, u16, u16, Shown); {count}] = [\n{table}];\n"
    );
    text
}

/// The function that draws a frame of a mesh.
fn shown(number: usize, (width, height): (u16, u16), depth: bool) -> String {
    let (parameter, made, passed) = if depth {
        let made = "    depths.fill(fixel::depth::FAR);
    let mut depth = fixel::depth::DepthBuffer::<_, fixel::depth::LessOrEqual>::new(
        fixel::target::Buffer::new(depths, WIDTH, HEIGHT)?,
    );
";
        ("depths", made, ", &mut depth")
    } else {
        ("_", "", "")
    };
    format!(
        "fn shown_{number}(colors: &mut [u16], {parameter}: &mut [u16]) -> Result<(), fixel::error::Error> {{
    const WIDTH: u16 = {width};
    const HEIGHT: u16 = {height};
    let (view, sun) = (fixel_workloads::shown::view(WIDTH, HEIGHT)?, fixel_workloads::shown::sun()?);
    colors.fill(0);
{made}    let mut color = fixel::target::Buffer::new(colors, WIDTH, HEIGHT)?;
    mesh_{number}::draw(&view, &sun, &mut mesh_{number}::EMPTY.clone(), &mut color{passed});
    Ok(())
}}

"
    )
}
