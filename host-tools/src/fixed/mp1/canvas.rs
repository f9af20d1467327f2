//! The picture that grows, and the views that bring primitives onto it.

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{Depth, DepthBuffer, FAR, LessOrEqual, NoDepth};
use fixel::matrix::Matrix;
use fixel::num::{Block, Word};
use fixel::target::Buffer;
use fixel::view::{Cull, View};
use fixel::viewport::Viewport;
use fixel::window::Window;

use super::program::Sample;
use crate::emit::log::Log;
use crate::lower;
use crate::scene::mp1::{MOST_CLIP_PLANES, Switches};

/// Clip planes that a scene may set, and the six of the frustum.
pub const PLANES: usize = MOST_CLIP_PLANES + 6;

/// The view volume: w ± x, w ± y, w ± z at least 0.
const FRUSTUM: [[i32; 4]; 6] = [
    [1, 0, 0, 1],
    [-1, 0, 0, 1],
    [0, 1, 0, 1],
    [0, -1, 0, 1],
    [0, 0, 1, 1],
    [0, 0, -1, 1],
];

/// How clip space comes to the screen.
pub struct Views<W> {
    /// For triangles: all planes.
    pub triangles: View<i64, W, PLANES>,
    /// For points and lines: the frustum.
    pub others: View<i64, W, 6>,
}

impl<W: Word> Views<W> {
    /// As the switches say.
    ///
    /// # Errors
    /// More clip planes than there is room for.
    pub fn new(switches: &Switches, viewport: Viewport<W>) -> Result<Self, String> {
        let mut all = Planes::<i64, PLANES>::default();
        let mut frustum = Planes::<i64, 6>::default();
        let too_many = |e| format!("{e} ({})", PLANES - 6);
        if switches.clip_planes.len() > PLANES - 6 {
            return Err(too_many(fixel::error::Error::TooManyPlanes));
        }
        for plane in &switches.clip_planes {
            all.push(lower::block(*plane)).map_err(too_many)?;
        }
        if switches.frustum {
            for plane in FRUSTUM.map(Block::from_integers) {
                all.push(plane).map_err(too_many)?;
                frustum.push(plane).map_err(too_many)?;
            }
        }
        let depth_range = if switches.depth {
            DepthRange::MinusOneToOne
        } else {
            DepthRange::Unlimited
        };
        let cull = if switches.cull { Cull::Clockwise } else { Cull::Nothing };
        Ok(Self {
            triangles: View {
                projection: Matrix::identity(),
                planes: all,
                viewport,
                depth_range,
                behind: Behind::Divide,
                cull,
            },
            others: View {
                projection: Matrix::identity(),
                planes: frustum,
                viewport,
                depth_range,
                behind: Behind::Divide,
                cull: Cull::Nothing,
            },
        })
    }
}

/// Samples and depths of the part `window` of the picture in samples.
pub struct Canvas {
    window: Window,
    /// Row by row.
    pub samples: Vec<Sample>,
    /// Row by row; without a depth test nothing is stored.
    pub depths: Vec<u16>,
    tested: bool,
    /// What is drawn is written down, if somebody wants it.
    pub log: Option<Log>,
}

impl Canvas {
    /// Empty.
    pub fn new(window: Window, tested: bool) -> Self {
        let size = window.width() * window.height();
        Self {
            window,
            samples: vec![Sample::default(); size],
            depths: vec![FAR; if tested { size } else { 0 }],
            tested,
            log: None,
        }
    }

    /// Draws with or without a depth test.
    pub fn draw(&mut self, drawing: &impl Draw) {
        if let Some(log) = &mut self.log {
            drawing.record(log);
        }
        let Ok(mut color) = Buffer::strip(&mut self.samples, self.window) else {
            return;
        };
        if !self.tested {
            drawing.draw(&mut color, &mut NoDepth);
        } else if let Ok(depth) = Buffer::strip(&mut self.depths, self.window) {
            drawing.draw(&mut color, &mut DepthBuffer::<_, LessOrEqual>::new(depth));
        }
    }
}

/// Something that can be drawn, whatever is done about depth.
pub trait Draw {
    /// Draws it.
    fn draw(&self, color: &mut Buffer<'_, Sample>, depth: &mut impl Depth);
    /// Writes it down.
    fn record(&self, log: &mut Log);
}
