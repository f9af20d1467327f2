//! The picture as the core sees it: its size, its guard band, its depths.

use super::interval::Interval;
use super::stated::{GUARD, WIDE_GUARD};

/// What all primitives of a picture share.
#[derive(Debug, Clone, Copy)]
pub struct Screen {
    /// Width and height in px.
    pub size: [f64; 2],
    /// The z/w that are drawn; all of them without a depth buffer.
    pub depths: Interval,
}

impl Screen {
    /// One of the core's 65535 steps of depth in z/w.
    pub fn depth_step(&self) -> f64 {
        let range = self.depths.high - self.depths.low;
        if range.is_finite() { range / 65535.0 } else { 0.0 }
    }
}

/// Half the side of the guard band of a picture of `size` px.
pub fn guard(size: [f64; 2]) -> f64 {
    if size[0].max(size[1]) <= GUARD {
        GUARD
    } else {
        WIDE_GUARD
    }
}
