//! [embedded-3dgfx](https://docs.rs/embedded-3dgfx): scanlines between whole pixels, in fixed point and `f32`.
//!
//! Can: W1 to W4. No subpixels: corners are moved to the nearest pixel. Triangles are handed to its rasterizer as the
//! primitives that its engine makes of meshes, with 16-bit depth.

use alloc::vec;
use alloc::vec::Vec;

use embedded_3dgfx::pipeline::assemble::primitive::DrawPrimitive;
use embedded_3dgfx::pipeline::rasterize::draw::{
    RasterState, draw_with_state, draw_zbuffered_with_state, draw_zbuffered_with_textures_state,
};
use embedded_3dgfx::pipeline::rasterize::texture::{Texture, TextureManager};
use embedded_3dgfx::{Z_MAX_VALUE, ZDepth};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::pixelcolor::raw::RawU16;
use nalgebra::Point2;

use crate::embedded_graphics::Canvas;
use crate::scene::{Corner, Triangle};
use crate::texture::{SIDE, TEXELS};
use crate::{HEIGHT, Kind, PIXELS, Rival, WIDTH};

/// The crate.
pub struct Embedded3dgfx;

/// Colour and depth.
pub struct Frame {
    color: Canvas,
    depth: Vec<ZDepth>,
}

/// Primitives, and how they are drawn.
pub struct Prepared {
    kind: Kind,
    primitives: Vec<DrawPrimitive>,
    textures: TextureManager<1>,
}

impl Rival for Embedded3dgfx {
    const NAME: &'static str = "embedded-3dgfx";

    type Frame = Frame;
    type Prepared = Prepared;

    fn frame() -> Frame {
        Frame {
            color: Canvas::black(),
            depth: vec![Z_MAX_VALUE; PIXELS],
        }
    }

    fn colors(frame: &Frame) -> &[u16] {
        frame.color.pixels()
    }

    fn prepare(kind: Kind, triangles: &[Triangle]) -> Option<Prepared> {
        let mut textures = TextureManager::new();
        let texture_id = if kind == Kind::Textured {
            let texels: Vec<Rgb565> = TEXELS.iter().map(|&texel| color(texel)).collect();
            textures.add_texture(Texture::new(texels.leak(), SIDE as u32, SIDE as u32))?
        } else {
            0
        };
        let primitives = triangles.iter().map(|t| primitive(kind, t, texture_id)).collect();
        Some(Prepared {
            kind,
            primitives,
            textures,
        })
    }

    #[inline(never)]
    fn draw(prepared: &Prepared, frame: &mut Frame) {
        let state = RasterState::new(WIDTH, HEIGHT);
        let Frame { color, depth } = frame;
        for primitive in prepared.primitives.iter().cloned() {
            match prepared.kind {
                Kind::Flat => draw_with_state(primitive, color, &state),
                Kind::Gouraud => draw_zbuffered_with_state(primitive, color, depth, &state),
                Kind::Textured => {
                    draw_zbuffered_with_textures_state(primitive, color, depth, &prepared.textures, &state);
                }
            }
        }
    }
}

fn primitive(kind: Kind, triangle: &Triangle, texture_id: u32) -> DrawPrimitive {
    let points = triangle.each_ref().map(|corner| Point2::from(corner.pixel()));
    // In its units of depth: 2^-16 of the range.
    let depths = triangle.map(|corner| corner.z * 65535.0);
    match kind {
        Kind::Flat => DrawPrimitive::ColoredTriangle(points, color(triangle[0].rgb565())),
        Kind::Gouraud => DrawPrimitive::GouraudTriangleWithDepth {
            points,
            depths,
            colors: triangle.each_ref().map(|corner| color(corner.rgb565())),
        },
        Kind::Textured => DrawPrimitive::TexturedTriangleWithDepth {
            points,
            depths,
            ws: triangle.map(|corner: Corner| corner.w),
            uvs: triangle.map(|corner| corner.uv),
            texture_id,
        },
    }
}

fn color(pixel: u16) -> Rgb565 {
    Rgb565::from(RawU16::new(pixel))
}
