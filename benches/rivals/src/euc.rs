//! [euc](https://docs.rs/euc): vertex and fragment programs, a depth buffer, everything in perspective, in `f32`.
//!
//! Can: all workloads. Walks a triangle's bounding box and divides at every pixel. Pixels on an edge belong to both sides:
//! there is no fill rule. No indices, no clipping: vertices of a mesh are transformed once by the caller, who hands them
//! over by number.

use alloc::vec::Vec;
use core::array;

use euc::buffer::Buffer2d;
use euc::rasterizer::BackfaceCullingEnabled;
use euc::{DepthStrategy, Interpolate, Pipeline, rasterizer::Triangles};

use crate::scene::{Corner, Triangle};
use crate::texture::{SIDE, TEXELS};
use crate::{HEIGHT, Kind, Rival, WIDTH};

/// The crate.
pub struct Euc;

/// Colour and depth.
pub struct Frame {
    color: Buffer2d<u16>,
    depth: Buffer2d<f32>,
}

/// Triangles of a kind, with positions in clip space.
pub enum Prepared {
    /// With their colours.
    Flat(Vec<([[f32; 4]; 3], u16)>),
    /// With colours in units of RGB565's levels.
    Gouraud(Vec<([f32; 4], Numbers<3>)>),
    /// With texels.
    Textured(Vec<([f32; 4], Numbers<2>)>),
}

/// One triangle of one colour.
struct Flat(u16);

/// What a flat triangle interpolates.
#[derive(Clone)]
struct Nothing;

struct Gouraud;

struct Textured;

/// Numbers that are interpolated with products and sums of their own: the crate's own fuse them, which on a
/// microcontroller, without the standard library, is a routine in software. Its depth is fused all the same.
#[derive(Clone, Copy)]
pub struct Numbers<const N: usize>([f32; N]);

impl<const N: usize> Interpolate for Numbers<N> {
    #[inline(always)]
    fn lerp2(Numbers(a): Self, Numbers(b): Self, x: f32, y: f32) -> Self {
        Numbers(array::from_fn(|i| a[i] * x + b[i] * y))
    }

    #[inline(always)]
    fn lerp3(Numbers(a): Self, Numbers(b): Self, Numbers(c): Self, x: f32, y: f32, z: f32) -> Self {
        Numbers(array::from_fn(|i| a[i] * x + b[i] * y + c[i] * z))
    }
}

impl Interpolate for Nothing {
    fn lerp2(_: Self, _: Self, _: f32, _: f32) -> Self {
        Nothing
    }

    fn lerp3(_: Self, _: Self, _: Self, _: f32, _: f32, _: f32) -> Self {
        Nothing
    }
}

impl Pipeline for Flat {
    type Vertex = [f32; 4];
    type VsOut = Nothing;
    type Pixel = u16;

    #[inline(always)]
    fn vert(&self, &position: &[f32; 4]) -> ([f32; 4], Nothing) {
        (position, Nothing)
    }

    #[inline(always)]
    fn frag(&self, _: &Nothing) -> u16 {
        self.0
    }

    #[inline(always)]
    fn get_depth_strategy(&self) -> DepthStrategy {
        DepthStrategy::None
    }
}

impl Pipeline for Gouraud {
    type Vertex = ([f32; 4], Numbers<3>);
    type VsOut = Numbers<3>;
    type Pixel = u16;

    #[inline(always)]
    fn vert(&self, &vertex: &Self::Vertex) -> Self::Vertex {
        vertex
    }

    #[inline(always)]
    fn frag(&self, &Numbers([red, green, blue]): &Numbers<3>) -> u16 {
        (red as u16) << 11 | (green as u16) << 5 | blue as u16
    }
}

impl Pipeline for Textured {
    type Vertex = ([f32; 4], Numbers<2>);
    type VsOut = Numbers<2>;
    type Pixel = u16;

    #[inline(always)]
    fn vert(&self, &vertex: &Self::Vertex) -> Self::Vertex {
        vertex
    }

    #[inline(always)]
    fn frag(&self, &Numbers([u, v]): &Numbers<2>) -> u16 {
        let (column, row) = (u as usize % SIDE, v as usize % SIDE);
        TEXELS[row * SIDE + column]
    }
}

impl Rival for Euc {
    const NAME: &'static str = "euc";

    type Frame = Frame;
    type Prepared = Prepared;

    fn frame() -> Frame {
        Frame {
            color: Buffer2d::new([WIDTH, HEIGHT], 0),
            depth: Buffer2d::new([WIDTH, HEIGHT], f32::INFINITY),
        }
    }

    fn colors(frame: &Frame) -> &[u16] {
        frame.color.as_ref()
    }

    fn prepare(kind: Kind, triangles: &[Triangle]) -> Option<Prepared> {
        let corners = || triangles.iter().flatten();
        Some(match kind {
            Kind::Flat => Prepared::Flat(
                triangles
                    .iter()
                    .map(|t| (t.each_ref().map(clip), t[0].rgb565()))
                    .collect(),
            ),
            Kind::Gouraud => Prepared::Gouraud(corners().map(|c| (clip(c), levels(c))).collect()),
            Kind::Textured => Prepared::Textured(
                corners()
                    .map(|c| (clip(c), Numbers(c.uv.map(|v| v * SIDE as f32))))
                    .collect(),
            ),
        })
    }

    #[inline(never)]
    fn draw(prepared: &Prepared, Frame { color, depth }: &mut Frame) {
        match prepared {
            Prepared::Flat(triangles) => {
                for (corners, pixel) in triangles {
                    Flat(*pixel).draw::<Triangles<Buffer2d<f32>, BackfaceCullingEnabled>, _>(corners, color, None);
                }
            }
            Prepared::Gouraud(corners) => with_depth(&Gouraud, corners, color, depth),
            Prepared::Textured(corners) => with_depth(&Textured, corners, color, depth),
        }
    }
}

fn with_depth<P: Pipeline<Pixel = u16>>(
    program: &P,
    corners: &[P::Vertex],
    color: &mut Buffer2d<u16>,
    depth: &mut Buffer2d<f32>,
) {
    program.draw::<Triangles<Buffer2d<f32>, BackfaceCullingEnabled>, _>(corners, color, Some(depth));
}

/// From the screen back to clip space.
fn clip(&Corner { x, y, z, w, .. }: &Corner) -> [f32; 4] {
    let (x, y) = (x / WIDTH as f32 * 2.0 - 1.0, 1.0 - y / HEIGHT as f32 * 2.0);
    [x * w, y * w, z * w, w]
}

/// Half a level more, since the program cuts off.
fn levels(corner: &Corner) -> Numbers<3> {
    let [red, green, blue] = corner.color.map(|v| v / 255.0);
    Numbers([red * 31.0, green * 63.0, blue * 31.0].map(|v| v + 0.5))
}
