//! By hand: the core's projection and spans, and a store for every pixel of a span.
//!
//! The projection is [`View`]'s, as the pipeline's is its own, with the same planes and the same guard band. The store is
//! `fill`: for 16-bit pixels the compiler makes no call of it but the loop `*pixel = color`, which it also makes of a program
//! that returns its colour. How far it unrolls them is its own affair: 3 instructions a pixel here, 1.75 in the pipeline
//! (rustc 1.96), so that the pipeline comes out ahead.

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::matrix::Matrix;
use fixel::num::Block;
use fixel::span::{doubled_area, scan};
use fixel::target::{Buffer, Target};
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;

use super::Triangle;

/// Draws the triangles.
#[inline(never)]
pub fn draw(color: &mut Buffer<'_, u16>, viewport: &Viewport<i32>, matrix: &Matrix<i32>, triangles: &[Triangle]) {
    let mut planes = Planes::<i32, 1>::default();
    if planes.push(Block::from_integers([0, 0, 1, 1])).is_err() {
        return;
    }
    let view = View {
        projection: *matrix,
        planes,
        viewport: *viewport,
        depth_range: DepthRange::Unlimited,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    };
    let window = viewport.window().intersect(color.window());
    for (corners, pixel) in triangles {
        let vertices = corners.map(|corner| Vertex {
            position: Block::from_integers(corner),
            carried: (),
        });
        view.project::<()>(&vertices, |polygon| {
            scan::<i32>(polygon, doubled_area(polygon) > 0, window, |span| {
                // The picture's first column is 0.
                let columns = span.left as usize..span.right as usize;
                if let Some(pixels) = color.row(span.row).get_mut(columns) {
                    pixels.fill(*pixel);
                }
            });
        });
    }
}
