//! The same triangles of one colour each, drawn by the pipeline and by hand: what a program that uses nothing costs.
//!
//! Everything but the measured region is shared, so that two images differ in it alone.

pub mod by_hand;
pub mod pipeline;

use core::hint::black_box;

use fixel::error::Error;
use fixel::matrix::Matrix;
use fixel::num::Block;
use fixel::target::Buffer;
use fixel::viewport::Viewport;

use crate::frame::{Frame, HEIGHT, WIDTH};
use crate::machine::{Line, Machine};

/// Three corners in eye space, and an RGB565 colour.
pub type Triangle = ([[i32; 4]; 3], u16);

/// A measured region: draws triangles, transformed by a matrix, clipped at the near plane, none culled.
pub type Draw = fn(&mut Buffer<'_, u16>, &Viewport<i32>, &Matrix<i32>, &[Triangle]);

/// Large ones: one on the picture, one whose corner is behind the near plane, one that reaches beyond the picture.
const TRIANGLES: [Triangle; 3] = [
    ([[-9, -8, 0, 10], [9, -7, 0, 10], [1, 9, 0, 10]], 0xf800),
    ([[-8, 3, -1, 8], [7, 5, 2, 9], [2, -9, -7, 6]], 0x07e0),
    ([[-30, 2, 3, 10], [5, -25, 3, 10], [14, 19, 3, 10]], 0x001f),
];

/// About z, which leaves the near plane where it is, before the matrix or after it; exact.
const QUARTER_TURN: [i32; 16] = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/// Draws, and reports one line called `flat` (units: triangles). Depth is the buffer's from before, which nothing touches.
///
/// `None` for none: the sizes are constants.
pub fn run(machine: &mut impl Machine, frame: &mut Frame, draw: Draw) -> Option<()> {
    frame.clear();
    let viewport = viewport().ok()?;
    let turned = Matrix::from_rows(Block::from_integers(QUARTER_TURN));
    let mut color = frame.color().ok()?;
    let triangles = black_box(&TRIANGLES);
    let instructions = machine.count(|| draw(&mut color, black_box(&viewport), black_box(&turned), triangles));
    let (color, depth) = frame.checksums();
    machine.report(&Line {
        name: "flat",
        instructions,
        units: TRIANGLES.len() as u32,
        color,
        depth,
    });
    Some(())
}

fn viewport() -> Result<Viewport<i32>, Error> {
    Ok(Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up().samples_at_centers())
}

/// Draws nothing: what the images have in common.
#[inline(never)]
pub fn nothing(color: &mut Buffer<'_, u16>, viewport: &Viewport<i32>, matrix: &Matrix<i32>, triangles: &[Triangle]) {
    black_box((color, viewport, matrix, triangles));
}
