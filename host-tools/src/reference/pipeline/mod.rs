//! The programmable pipeline of formats/pipeline.md in float64: points, lines, triangles, clip planes, two shaders, textures,
//! depth, blending and culling, in the plainest form that its rules allow.
//!
//! ```text
//! geometry -> program.vertex -> clip (homogeneous) -> window (pixels) -+-> line (region, Bresenham) -+-> interpolate
//!                                                                      +-> triangle (edge functions) +
//! interpolate -> program.fragment -> fragment (depth, blend) -> framebuffer
//! ```
//!
//! **y points up**: row 0 is the bottom row of an image, and pictures are turned over when they are written out.
//! What has no place on the screen, because a coordinate is not a finite number, is not drawn.

pub mod blend;
pub mod camera;
pub mod clip;
pub mod fragment;
pub mod framebuffer;
pub mod geometry;
pub mod image;
pub mod interpolate;
pub mod light;
pub mod line;
pub mod order;
pub mod program;
pub mod region;
pub mod sample;
pub mod state;
pub mod triangle;
pub mod window;

pub use framebuffer::Framebuffer;
pub use geometry::{Geometry, Topology};
pub use image::Image;
pub use program::Program;
pub use state::State;

use fragment::Canvas;
use program::Vertex;

/// Draws a geometry with a program: every vertex is shaded once, in order, before the first fragment.
///
/// Vertices that are left over when the last line or triangle is whole are ignored.
pub fn draw<P: Program>(
    framebuffer: &mut Framebuffer,
    state: &State,
    program: &P,
    uniforms: &P::Uniforms,
    geometry: &Geometry,
) {
    let shaded = geometry
        .vertices()
        .map(|attributes| Vertex::shaded(program, uniforms, &attributes));
    let vertices: Vec<Vertex> = shaded.collect();
    let mut canvas = Canvas {
        framebuffer,
        state,
        shade: &|at, inputs, colors| program.fragment(at, inputs, uniforms, colors),
    };
    match geometry.topology {
        Topology::Lines => {
            for ends in vertices.as_chunks().0 {
                line::draw(&mut canvas, ends);
            }
        }
        Topology::Triangles => {
            for corners in vertices.as_chunks().0 {
                triangle::draw(&mut canvas, corners);
            }
        }
    }
}

#[cfg(test)]
mod tests;
