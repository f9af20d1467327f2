//! From clip space to the window (07.4, 07.5).

use super::program::{Values, Vertex};
use super::state::Viewport;

/// A vertex in the window.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// x and y in pixels, y up; depth, 0 to 1 between near and far; 1/w.
    pub window: [f64; 4],
    /// What is interpolated.
    pub outputs: Values,
}

/// The vertex in the window; none if a coordinate is not a finite number.
pub fn place(vertex: &Vertex, viewport: &Viewport) -> Option<Placed> {
    let [x, y, z, w] = vertex.position;
    let window = [
        (x / w / 2.0 + 0.5) * f64::from(viewport.width) + f64::from(viewport.x),
        (y / w / 2.0 + 0.5) * f64::from(viewport.height) + f64::from(viewport.y),
        (z / w + 1.0) / 2.0,
        1.0 / w,
    ];
    let outputs = vertex.outputs.clone();
    window
        .iter()
        .all(|c| c.is_finite())
        .then_some(Placed { window, outputs })
}
