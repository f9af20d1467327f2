//! [retrofire-core](https://docs.rs/retrofire-core): scanlines in `f32`, with vertex and fragment programs.
//!
//! Can: all workloads. Triangles on the screen are handed to its filler of triangles and its target, without its vertex
//! stage and clipping. Its depth is 1/w, nearer is larger; where w is constant, the workload's depth takes its place, and
//! colours are interpolated without perspective.

use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;

use retrofire_core::geom::{Vertex, vertex};
use retrofire_core::math::color::{Color4, rgba};
use retrofire_core::math::vary::{Iter, ZDiv};
use retrofire_core::math::{Lerp, Vary, pt3};
use retrofire_core::render::raster::{ScreenPt, tri_fill};
use retrofire_core::render::target::{Colorbuf, Framebuf, Target};
use retrofire_core::render::{Context, Frag, FragmentShader};
use retrofire_core::util::MutSlice2;
use retrofire_core::util::dims::Dims;
use retrofire_core::util::pixfmt::Rgb565;

use crate::scene::{Corner, Triangle};
use crate::texture::{SIDE, TEXELS};
use crate::{HEIGHT, Kind, PIXELS, Rival, WIDTH};

/// The crate.
pub struct Retrofire;

/// Colour and depth.
pub struct Frame {
    color: Vec<u16>,
    depth: Vec<f32>,
}

/// Triangles of a kind, on the screen.
pub enum Prepared {
    /// With their colours.
    Flat(Vec<([Vertex<ScreenPt, ()>; 3], Color4)>),
    /// With colours.
    Gouraud(Vec<[Vertex<ScreenPt, Rgb>; 3]>),
    /// With texels over w.
    Textured(Vec<[Vertex<ScreenPt, (f32, f32)>; 3]>, Vec<Color4>),
}

/// A colour that is linear over the screen.
#[derive(Debug, Clone, Copy)]
pub struct Rgb([f32; 3]);

impl Rgb {
    #[inline]
    fn with(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        let ([r, g, b], [other_r, other_g, other_b]) = (self.0, other.0);
        Rgb([f(r, other_r), f(g, other_g), f(b, other_b)])
    }
}

impl Lerp for Rgb {
    #[inline]
    fn lerp(&self, other: &Self, t: f32) -> Self {
        self.with(*other, |a, b| a + (b - a) * t)
    }
}

impl ZDiv for Rgb {}

impl Vary for Rgb {
    type Iter = Iter<Self>;
    type Diff = Self;

    #[inline]
    fn vary(self, step: Self, n: Option<u32>) -> Iter<Self> {
        Iter { val: self, step, n }
    }

    #[inline]
    fn dv_dt(&self, other: &Self, recip_dt: f32) -> Self {
        self.with(*other, |a, b| (b - a) * recip_dt)
    }

    #[inline]
    fn step(&self, delta: &Self) -> Self {
        self.with(*delta, |a, d| a + d)
    }
}

impl Rival for Retrofire {
    const NAME: &'static str = "retrofire-core";

    type Frame = Frame;
    type Prepared = Prepared;

    fn frame() -> Frame {
        Frame {
            color: vec![0; PIXELS],
            depth: vec![0.0; PIXELS],
        }
    }

    fn colors(frame: &Frame) -> &[u16] {
        &frame.color
    }

    fn prepare(kind: Kind, triangles: &[Triangle]) -> Option<Prepared> {
        Some(match kind {
            Kind::Flat => Prepared::Flat(triangles.iter().map(flat).collect()),
            Kind::Gouraud => Prepared::Gouraud(triangles.iter().map(|t| t.each_ref().map(gouraud)).collect()),
            Kind::Textured => Prepared::Textured(
                triangles.iter().map(|t| t.each_ref().map(textured)).collect(),
                TEXELS.iter().map(|&texel| expanded(texel)).collect(),
            ),
        })
    }

    #[inline(never)]
    fn draw(prepared: &Prepared, frame: &mut Frame) {
        let size = Dims(WIDTH as u32, HEIGHT as u32);
        let context = Context {
            depth_test: Some(Ordering::Less),
            ..Context::default()
        };
        let mut color = Colorbuf {
            buf: MutSlice2::new(size, WIDTH as u32, &mut frame.color),
            fmt: Rgb565,
        };
        if let Prepared::Flat(triangles) = prepared {
            for &(corners, pixel) in triangles {
                fill(&mut color, corners, &|_: Frag<()>, ()| pixel, &context);
            }
            return;
        }
        let mut target = Framebuf {
            color_buf: color,
            depth_buf: MutSlice2::new(size, WIDTH as u32, &mut frame.depth),
        };
        match prepared {
            Prepared::Flat(_) => {}
            Prepared::Gouraud(triangles) => {
                let shade = |frag: Frag<Rgb>, ()| {
                    let [red, green, blue] = frag.var.0;
                    rgba(red as u8, green as u8, blue as u8, 255)
                };
                triangles
                    .iter()
                    .for_each(|&corners| fill(&mut target, corners, &shade, &context));
            }
            Prepared::Textured(triangles, texels) => {
                let shade = |frag: Frag<(f32, f32)>, ()| {
                    let (column, row) = (frag.var.0 as usize % SIDE, frag.var.1 as usize % SIDE);
                    texels[row * SIDE + column]
                };
                triangles
                    .iter()
                    .for_each(|&corners| fill(&mut target, corners, &shade, &context));
            }
        }
    }
}

#[inline]
fn fill<V: Vary>(
    target: &mut impl Target,
    corners: [Vertex<ScreenPt, V>; 3],
    program: &impl FragmentShader<V, ()>,
    context: &Context,
) {
    tri_fill(corners, |scanline| target.rasterize(scanline, program, (), context));
}

fn flat(triangle: &Triangle) -> ([Vertex<ScreenPt, ()>; 3], Color4) {
    let corners = triangle.map(|c| vertex(pt3(c.x, c.y, 1.0), ()));
    let [red, green, blue] = triangle[0].color.map(|v| v as u8);
    (corners, rgba(red, green, blue, 255))
}

fn gouraud(c: &Corner) -> Vertex<ScreenPt, Rgb> {
    vertex(pt3(c.x, c.y, 1.0 - c.z), Rgb(c.color))
}

fn textured(c: &Corner) -> Vertex<ScreenPt, (f32, f32)> {
    let [u, v] = c.uv.map(|v| v * SIDE as f32 / c.w);
    vertex(pt3(c.x, c.y, 1.0 / c.w), (u, v))
}

/// What its own conversion makes RGB565 of.
fn expanded(pixel: u16) -> Color4 {
    let channel = |down: u32, most: u16, up: u32| ((pixel >> down & most) << up) as u8;
    rgba(channel(11, 31, 3), channel(5, 63, 2), channel(0, 31, 3), 255)
}
