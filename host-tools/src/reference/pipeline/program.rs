//! Programs (chapter 05): two functions that the user of the pipeline supplies.

use std::collections::BTreeMap;

/// The name of an attribute or an output. Any name will do; three are agreed on.
pub type Key = &'static str;

/// Position.
pub const VERTEX: Key = "vertex";
/// Normal.
pub const NORMAL: Key = "normal";
/// Texture coordinates.
pub const UV: Key = "uv";

/// Numbers (of one component) and vectors by key.
pub type Values = BTreeMap<Key, Vec<f64>>;

/// Colours by the number of the buffer that they are for.
pub type Colors = BTreeMap<usize, [f64; 4]>;

/// A vertex and a fragment shader.
pub trait Program {
    /// User data, constant during a draw.
    type Uniforms: ?Sized;

    /// Places one vertex in clip space and gives the values that are interpolated.
    fn vertex(&self, attributes: &Values, uniforms: &Self::Uniforms, outputs: &mut Values) -> [f64; 4];

    /// Colours one fragment at (x, y, window depth, 1/w), x and y being the pixel's centre. Whether to keep it; one that
    /// is not kept writes nothing.
    fn fragment(&self, at: [f64; 4], inputs: &Values, uniforms: &Self::Uniforms, colors: &mut Colors) -> bool;
}

/// What the vertex shader made of a vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct Vertex {
    /// In clip space.
    pub position: [f64; 4],
    /// What is interpolated.
    pub outputs: Values,
}

impl Vertex {
    /// Runs the vertex shader.
    pub fn shaded<P: Program>(program: &P, uniforms: &P::Uniforms, attributes: &Values) -> Self {
        let mut outputs = Values::new();
        let position = program.vertex(attributes, uniforms, &mut outputs);
        Self { position, outputs }
    }
}
