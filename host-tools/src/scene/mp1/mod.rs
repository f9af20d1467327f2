//! An MP1 scene: the full-scene switches and the primitives in drawing order, each with its place in the text and its
//! vertices.

use std::collections::BTreeMap;
use std::slice;
use std::sync::Arc;

use super::Place;
use crate::picture::Picture;

mod grammar;

pub use grammar::{parse, parse_with};

/// A valid scene: every argument in range, every index resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Width of the picture in pixels; times `fsaa` at most 16384.
    pub width: u32,
    /// Height of the picture in pixels; times `fsaa` at most 16384, and at most 2^26 samples in all.
    pub height: u32,
    /// The picture's file name, as the scene suggests it; relative, inside the folder.
    pub output: String,
    /// What holds for the whole scene.
    pub switches: Switches,
    /// What is drawn, in order.
    pub primitives: Vec<Primitive>,
    /// The textures it names, by name.
    pub textures: BTreeMap<String, Arc<Picture>>,
}

/// The most `clipplane` commands: what the core has room for beside the view volume's own.
pub const MOST_CLIP_PLANES: usize = 256;

/// The full-scene switches.
#[derive(Debug, Clone, PartialEq)]
pub struct Switches {
    /// `depth`: fragments are tested against a depth buffer.
    pub depth: bool,
    /// `sRGB`: colours are decoded, and encoded on output.
    pub srgb: bool,
    /// `hyp`: values are interpolated in perspective.
    pub hyp: bool,
    /// `fsaa`: samples per pixel in each direction, 1 to 16.
    pub fsaa: u32,
    /// `frustum`: primitives are clipped to the view volume.
    pub frustum: bool,
    /// `cull`: only counter-clockwise triangles are drawn.
    pub cull: bool,
    /// `decals`: textures are blended over the vertices' colours.
    pub decals: bool,
    /// `clipplane`, in file order.
    pub clip_planes: Vec<[f64; 4]>,
}

impl Default for Switches {
    fn default() -> Self {
        Self {
            depth: false,
            srgb: false,
            hyp: false,
            fsaa: 1,
            frustum: false,
            cull: false,
            decals: false,
            clip_planes: Vec::new(),
        }
    }
}

/// A vertex with the state that it was made in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// x, y, z, w in clip coordinates.
    pub position: [f64; 4],
    /// Red, green, blue as given; 255 is full; not decoded, not clamped.
    pub rgb: [f64; 3],
    /// 0 to 1.
    pub alpha: f64,
    /// s, t; 1 is the whole texture.
    pub texcoord: [f64; 2],
}

/// Something to draw and the place of its keyword.
#[derive(Debug, Clone, PartialEq)]
pub struct Primitive {
    /// The keyword's place.
    pub place: Place,
    /// What.
    pub shape: Shape,
}

/// What is drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// `tri`.
    Triangle([Vertex; 3]),
    /// `trit`, with the texture of the moment.
    Textured([Vertex; 3], Arc<Picture>),
    /// `point`: size in pixels, 0 or more, and centre.
    Point(f64, Vertex),
    /// `billboard`, with the texture of the moment.
    Billboard(f64, Vertex, Arc<Picture>),
    /// `circle`: diameter and centre.
    Circle(f64, Vertex),
    /// `line`.
    Line([Vertex; 2]),
    /// `wuline`.
    WuLine([Vertex; 2]),
}

impl Shape {
    /// Its corners, ends or centre.
    pub fn vertices(&self) -> &[Vertex] {
        match self {
            Self::Triangle(corners) | Self::Textured(corners, _) => corners,
            Self::Point(_, centre) | Self::Billboard(_, centre, _) | Self::Circle(_, centre) => slice::from_ref(centre),
            Self::Line(ends) | Self::WuLine(ends) => ends,
        }
    }
}
