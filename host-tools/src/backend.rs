//! What the interpreter asks of a back end. Each keeps its own matrices, in its own numbers.

/// A vertex as the scene gives it, untransformed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// x, y, z, w.
    pub position: [f64; 4],
    /// Red, green, blue; 1 is full; not clamped.
    pub color: [f64; 3],
}

/// How a triangle gets its colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface {
    /// One colour.
    Flat([f64; 3]),
    /// The vertices' colours, perspective-correct.
    Gouraud,
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
    /// Draws a triangle under the matrices of this moment. `primitive` counts from 1 through the scene and is stored
    /// with every pixel that this triangle wins, so that the comparison can tell who drew what.
    fn triangle(&mut self, primitive: u32, corners: [Vertex; 3], surface: Surface) -> Result<(), String>;
}
