//! What the interpreter asks of a back end. Each keeps its own matrices, lights and switches, in its own numbers.

use std::sync::Arc;

use crate::picture::Picture;

/// A vertex as the scene gives it, untransformed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// x, y, z, w.
    pub position: [f64; 4],
    /// Red, green, blue; 1 is full; not clamped.
    pub color: [f64; 3],
    /// Any length but 0; none where none was given, or one of length 0.
    pub normal: Option<[f64; 3]>,
    /// s, t; 1 is the whole texture.
    pub texcoord: [f64; 2],
}

/// How a primitive gets its surface colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface {
    /// One colour.
    Flat([f64; 3]),
    /// The vertices' colours, perspective-correct.
    Gouraud,
    /// The texture of the moment; with `decals` over the vertices' colours.
    Textured,
}

/// The control points of a Bézier patch, in the order of the scene's indices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Patch<'a> {
    /// Four rows of four.
    Rectangular(&'a [Vertex; 16]),
    /// Rows of four, three, two and one.
    Triangular(&'a [Vertex; 10]),
}

impl Patch<'_> {
    /// How many triangles it becomes at a subdivision level.
    pub fn triangles(&self, level: u32) -> u32 {
        match self {
            Patch::Rectangular(_) => 2 << (2 * level),
            Patch::Triangular(_) => 1 << (2 * level),
        }
    }
}

/// One of the two renderers. An error is one line that says what did not fit; the interpreter adds the place.
pub trait BackEnd {
    /// MV = m.
    fn load_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String>;
    /// MV = MV m.
    fn mult_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String>;
    /// P = m.
    fn load_p(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String>;
    /// MV = MV T.
    fn translate(&mut self, by: [f64; 3]) -> Result<(), String>;
    /// MV = MV R.
    fn rotate(&mut self, degrees: f64, axis: [f64; 3]) -> Result<(), String>;
    /// MV = MV S.
    fn scale(&mut self, by: [f64; 3]) -> Result<(), String>;
    /// MV = the view from `eye` to `center`; both untransformed, to be divided by their w.
    fn look_at(&mut self, eye: [f64; 4], center: [f64; 4], up: [f64; 3]) -> Result<(), String>;
    /// P = perspective; l r b t n f.
    fn frustum(&mut self, planes: [f64; 6]) -> Result<(), String>;
    /// P = parallel projection; l r b t n f.
    fn ortho(&mut self, planes: [f64; 6]) -> Result<(), String>;
    /// One more clip plane, its normal turned by the directions' matrix of this moment.
    fn clip_plane(&mut self, plane: [f64; 4]) -> Result<(), String>;
    /// From now on only counter-clockwise triangles are drawn.
    fn cull(&mut self);
    /// From now on textures are blended over the interpolated vertex colours.
    fn decals(&mut self);
    /// From now on flat triangles and patches use the triangles' own perpendiculars.
    fn flat_normals(&mut self);
    /// The texture of what is drawn from now on.
    fn texture(&mut self, texture: &Arc<Picture>) -> Result<(), String>;
    /// One more light from a direction, turned by the directions' matrix of this moment.
    fn sun(&mut self, direction: [f64; 3], color: [f64; 3]) -> Result<(), String>;
    /// One more light at a vertex' position (x, y, z, w), transformed by MV of this moment and divided by w.
    fn bulb(&mut self, position: [f64; 4], color: [f64; 3]) -> Result<(), String>;
    /// The specular exponent from now on; off at 0 and below.
    fn shininess(&mut self, exponent: f64) -> Result<(), String>;
    /// Draws a triangle under the state of this moment. `primitive` counts from 1 through the scene and is stored
    /// with every pixel that this triangle wins, so that the comparison can tell who drew what.
    fn triangle(&mut self, primitive: u32, corners: [Vertex; 3], surface: Surface) -> Result<(), String>;
    /// Draws a Bézier patch; its triangles are the primitives from `first` on, in the order of formats/hw2.md section 8.
    fn patch(&mut self, first: u32, level: u32, patch: Patch<'_>, surface: Surface) -> Result<(), String>;
}
