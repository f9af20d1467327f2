//! Other crates that draw triangles, on the same geometry as the core.
//!
//! ```text
//! scene (corners as floats) ──► one room per rival: prepare, draw ──► run: counted, reported
//! ```
//!
//! Each rival draws into RGB565, with depth where it has it, in the fastest configuration that does what the workload asks,
//! through its public interface, and so that what can be prepared before drawing is not measured. A rival's room says what
//! it can and cannot do.

#![no_std]

extern crate alloc;

pub mod embedded_3dgfx;
pub mod embedded_graphics;
pub mod euc;
pub mod retrofire;
pub mod run;
pub mod scene;
pub mod texture;

use scene::Triangle;

/// Columns of the picture.
pub const WIDTH: usize = 320;
/// Rows of the picture.
pub const HEIGHT: usize = 240;
/// Pixels of the picture.
pub const PIXELS: usize = WIDTH * HEIGHT;

/// What a workload asks of every pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The first corner's colour.
    Flat,
    /// Interpolated colour, depth tested and written.
    Gouraud,
    /// A 64×64 texture, nearest and in perspective, depth tested and written.
    Textured,
}

/// A crate that draws triangles.
pub trait Rival {
    /// What it is called.
    const NAME: &'static str;

    /// Colour and depth.
    type Frame;

    /// Triangles in its own form.
    type Prepared;

    /// A cleared frame: black, and as far away as can be.
    fn frame() -> Self::Frame;

    /// Its colours in RGB565, row by row.
    fn colors(frame: &Self::Frame) -> &[u16];

    /// `None` for what it cannot draw.
    fn prepare(kind: Kind, triangles: &[Triangle]) -> Option<Self::Prepared>;

    /// The measured region.
    fn draw(prepared: &Self::Prepared, frame: &mut Self::Frame);
}
