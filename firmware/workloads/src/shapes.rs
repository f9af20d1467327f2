//! Built-in shapes from which the cost of a pixel, of a row and of a triangle are told apart.
//!
//! Right-angled triangles with their corner at the top left: *wide* and *narrow* have the same rows and differ in pixels,
//! *low* has half the rows of *narrow*.

use crate::bytes::Vertex;

/// How often each shape is drawn in one measurement, so that the counter's resolution does not show.
pub const REPEATS: u32 = 16;

/// A right-angled triangle.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    /// What it is called.
    pub name: &'static str,
    /// Pixels along its upper side.
    pub width: i32,
    /// Pixels along its left side.
    pub height: i32,
}

/// Long rows, many of them.
pub const WIDE: Shape = Shape {
    name: "wide",
    width: 320,
    height: 240,
};

/// Short rows, many of them.
pub const NARROW: Shape = Shape {
    name: "narrow",
    width: 160,
    height: 240,
};

/// Short rows, few of them.
pub const LOW: Shape = Shape {
    name: "low",
    width: 160,
    height: 120,
};

/// All of them.
pub const SHAPES: [Shape; 3] = [WIDE, NARROW, LOW];

impl Shape {
    /// Its corners, with depths and colours that vary in both directions.
    pub fn corners(self) -> [Vertex; 3] {
        let corner = |x: i32, y: i32, depth: u32, color| Vertex {
            x: x << 8,
            y: y << 8,
            depth: depth << 15,
            color,
            inverse_w: 1 << 30,
            texel: [0; 2],
        };
        [
            corner(0, 0, 20_000, [250, 10, 90]),
            corner(0, self.height, 30_000, [20, 240, 200]),
            corner(self.width, 0, 45_000, [128, 70, 5]),
        ]
    }
}
