//! A shaded triangle in the terminal: `cargo run --release --example hello_triangle`.

use fixel::pipeline::{self, Pixel, Program, State};
use fixel::{depth::NoDepth, error::Error, num::Block, target::Buffer, viewport::Viewport};

struct Hello;

impl Program for Hello {
    type Vertex = ([i32; 2], i32);
    type Varying = [i32; 1];
    type At = Pixel;
    type Output = u8;
    fn vertex(&self, &([x, y], shade): &([i32; 2], i32)) -> (Block<i32, 4>, [i32; 1]) {
        (Block::from_integers([x, y, 0, 1]), [shade << 16])
    }
    fn fragment(&self, _: Pixel, [shade]: [i32; 1]) -> Option<u8> {
        b".:-=+*#%@".get((shade >> 16) as usize).copied()
    }
}

/// The rows from the top.
pub fn draw() -> Result<String, Error> {
    let (mut picture, corners) = ([[b' '; 64]; 24], [([-1, -1], 0), ([1, -1], 4), ([0, 1], 8)]);
    let mut target = Buffer::new(picture.as_flattened_mut(), 64, 24)?;
    let state = State::new(Viewport::<i32>::new(0, 0, 64, 24)?.y_up().samples_at_centers());
    pipeline::triangles(&state, &mut target, &mut NoDepth, &Hello, corners);
    Ok(picture.map(|row| row.escape_ascii().to_string()).join("\n"))
}

fn main() -> Result<(), Error> {
    draw().map(|picture| println!("{picture}"))
}
