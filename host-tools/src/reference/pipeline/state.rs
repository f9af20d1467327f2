//! The pipeline's options.

use super::blend::Blend;

/// The part of the image that is drawn to; whole pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Viewport {
    /// The leftmost column.
    pub x: i32,
    /// The lowest row.
    pub y: i32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// What the depth buffer is used for (07.8, 07.9).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Depth {
    /// Whether a fragment behind the stored depth fails.
    pub test: bool,
    /// Whether a fragment that has not failed stores its depth.
    pub write: bool,
}

/// Which side of a triangle (11.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// Counter-clockwise on the screen, y up.
    Front,
    /// Clockwise, or of no area.
    Back,
    /// Both.
    FrontAndBack,
}

/// How outputs are interpolated (08.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear on the screen.
    Linear,
    /// Linear on the surface.
    PerspectiveCorrected,
}

/// A plane l: points p with l · p ≥ 0 are kept.
pub type Plane = [f64; 4];

/// z + w ≥ 0: nothing nearer than the near plane.
pub const NEAR: Plane = [0.0, 0.0, 1.0, 1.0];

/// All options of a draw.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Where to draw.
    pub viewport: Viewport,
    /// Planes in clip space; the near plane by default.
    pub clip_planes: Vec<Plane>,
    /// No test, but write, by default.
    pub depth: Depth,
    /// None by default: colours replace what was there.
    pub blend: Option<Blend>,
    /// The triangles to leave out; none by default.
    pub cull: Option<Face>,
    /// Perspective-corrected by default.
    pub interpolation: Interpolation,
}

impl Viewport {
    /// A viewport from the corner of the image.
    pub fn of(width: u32, height: u32) -> Self {
        let (x, y) = (0, 0);
        Self { x, y, width, height }
    }

    /// The columns and rows of an image of this size that may be drawn to: first and last; empty if last < first.
    pub fn within(&self, [width, height]: [u32; 2]) -> [[i64; 2]; 2] {
        let cut = |start: i32, length: u32, limit: u32| {
            let start = i64::from(start);
            [start.max(0), (start + i64::from(length)).min(i64::from(limit)) - 1]
        };
        [cut(self.x, self.width, width), cut(self.y, self.height, height)]
    }
}

impl State {
    /// The defaults for a viewport.
    pub fn new(viewport: Viewport) -> Self {
        Self {
            viewport,
            clip_planes: vec![NEAR],
            depth: Depth {
                test: false,
                write: true,
            },
            blend: None,
            cull: None,
            interpolation: Interpolation::PerspectiveCorrected,
        }
    }
}
