//! An HW2 scene: typed commands, each with its place in the text.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::Place;
use crate::picture::Picture;

mod grammar;
mod view;

pub use grammar::{parse, parse_with};

/// A valid scene: every argument in range, every index resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Width of the picture in pixels, 1 to 16384.
    pub width: u32,
    /// Height of the picture in pixels, 1 to 16384; at most 2^26 pixels in all.
    pub height: u32,
    /// The picture's file name, as the scene suggests it; relative, inside the folder.
    pub output: String,
    /// The commands in file order, without `png`.
    pub commands: Vec<Command>,
    /// The textures it names, by name; empty where the text was parsed without its folder.
    pub textures: BTreeMap<String, Arc<Picture>>,
}

/// One command and the place of its keyword.
#[derive(Debug, Clone, PartialEq)]
pub struct Command {
    /// The keyword's place.
    pub place: Place,
    /// What it does.
    pub action: Action,
}

/// How a primitive gets its surface colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fill {
    /// One colour: the current one.
    Flat,
    /// The vertices' colours, interpolated.
    Gouraud,
    /// The current texture.
    Textured,
}

/// What a command does. Vertex indices are resolved: positions in the list of vertices made so far, from 0.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// `xyz`, `xyzw`: append a vertex.
    Vertex([f64; 4]),
    /// `color`.
    Color([f64; 3]),
    /// `normal`.
    Normal([f64; 3]),
    /// `texcoord`.
    TexCoord([f64; 2]),
    /// `texture`: the file's name, relative to the scene's folder.
    Texture(String),
    /// `trif`, `trig`, `trit`.
    Triangle(Fill, [usize; 3]),
    /// `rectbezf`, `rectbezg`.
    RectPatch(Fill, u32, [usize; 16]),
    /// `tribezf`, `tribezg`.
    TriPatch(Fill, u32, [usize; 10]),
    /// `loadmv`, row by row.
    LoadMv([[f64; 4]; 4]),
    /// `multmv`.
    MultMv([[f64; 4]; 4]),
    /// `loadp`.
    LoadP([[f64; 4]; 4]),
    /// `translate`.
    Translate([f64; 3]),
    /// `rotatex`, `rotatey`, `rotatez`, `rotate`: degrees about an axis of any length but 0.
    Rotate(f64, [f64; 3]),
    /// `scale`.
    Scale([f64; 3]),
    /// `lookat`: vertex of the eye, vertex of the center, up.
    LookAt(usize, usize, [f64; 3]),
    /// `frustum` l r b t n f.
    Frustum([f64; 6]),
    /// `ortho` l r b t n f.
    Ortho([f64; 6]),
    /// `clipplane`.
    ClipPlane([f64; 4]),
    /// `cull`.
    Cull,
    /// `decals`.
    Decals,
    /// `flatnormals`.
    FlatNormals,
    /// `sunlight`.
    Sun([f64; 3]),
    /// `bulb`.
    Bulb(usize),
    /// `shininess`.
    Shininess(f64),
}
