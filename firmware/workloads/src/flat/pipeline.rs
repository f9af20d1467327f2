//! By the pipeline.

use fixel::depth::NoDepth;
use fixel::matrix::Matrix;
use fixel::num::Block;
use fixel::pipeline::{self, Pixel, Program, State};
use fixel::target::Buffer;
use fixel::viewport::Viewport;

use super::Triangle;

/// One colour: nothing is carried, and nothing asked.
struct Flat<'m> {
    matrix: &'m Matrix<i32>,
    color: u16,
}

impl Program for Flat<'_> {
    type Vertex = [i32; 4];
    type Varying = ();
    type At = Pixel;
    type Output = u16;

    fn vertex(&self, &position: &[i32; 4]) -> (Block<i32, 4>, ()) {
        (self.matrix.transform(Block::from_integers(position)), ())
    }

    fn fragment(&self, _at: Pixel, (): ()) -> Option<u16> {
        Some(self.color)
    }
}

/// Draws the triangles.
#[inline(never)]
pub fn draw(color: &mut Buffer<'_, u16>, viewport: &Viewport<i32>, matrix: &Matrix<i32>, triangles: &[Triangle]) {
    let state = State::new(*viewport);
    for (corners, pixel) in triangles {
        let program = Flat { matrix, color: *pixel };
        pipeline::triangles(&state, color, &mut NoDepth, &program, corners);
    }
}
