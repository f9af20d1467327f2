//! Cubic Bézier patches, rectangular and triangular, cut into triangles without allocation and without cracks.
//!
//! A patch is its control points: homogeneous positions in object space and K values each that are mixed the same way
//! (three for a colour, none for a flat patch). Points on it are weighted sums of the control points with Bernstein's
//! weights for parameters i/2^level, which are whole numbers over 2^(3·level): everything is exact but the roundings named
//! below. Normals cost nothing unless they are asked for.
//!
//! **No cracks.** A grid point is a function of its place in the grid, whichever triangle asks. A corner of the patch is
//! its control point, bit by bit; a point on a border curve is a function of that curve's four control points only, from
//! either end. So two patches of the same level that share the control points of a border share its points bit by bit,
//! whatever their other control points are and whichever sides of them (or kinds of patch) meet.
//!
//! **Error of a position.** With 2^e the last place of the largest control point and G = BITS + 2 − 3·level guard bits
//! ([`Word::BITS`]; G ≥ 8 with 32-bit words, ≥ 40 with 64-bit), each component is within half a last place of the
//! result's largest component, plus 2^(e−G): at most 2^-BITS·(1 + 2^(1−G)) of the largest control point. That is one
//! rounding; the second term are the control points of smaller scale brought to the shared one, and the curves across a
//! rectangular patch.
//!
//! **Error of a value**: ½ + 2^-G units with the G of 32-bit words, at most ½ + 2^-8. Values lie between the least and the
//! largest control value.
//!
//! **Error of a normal**: the two vectors that are multiplied are within 2^-BITS of themselves plus 2^(e+1−G) of exact,
//! their product within 2^-BITS of itself; see [`PatchVertex::normal`].

use crate::error::Error;
use crate::num::{Block, Word};

mod bernstein;
mod rectangle;
mod triangle;

pub use rectangle::RectangularPatch;
pub use triangle::TriangularPatch;

/// Into how many pieces a patch is cut: 2^level on each side.
///
/// ```
/// use fixel::{error::Error, patch::Level};
/// assert_eq!(Level::new(3)?.pieces(), 8);
/// assert_eq!(Level::new(9), Err(Error::SubdivisionLevel));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Level(u8);

impl Level {
    /// 1 to 8.
    ///
    /// # Errors
    /// [`Error::SubdivisionLevel`] for any other.
    pub const fn new(level: u32) -> Result<Self, Error> {
        match level {
            1..=8 => Ok(Level(level as u8)),
            _ => Err(Error::SubdivisionLevel),
        }
    }

    /// Pieces of each side: 2^level.
    pub const fn pieces(self) -> u32 {
        1 << self.0
    }

    /// log2 of the sum of the cubic weights.
    const fn weight_bits(self) -> u32 {
        3 * self.0 as u32
    }
}

/// A control point of a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ControlPoint<T, const K: usize> {
    /// x, y, z, w in object space. The control points of a patch may have different scales.
    pub position: Block<T, 4>,
    /// What is mixed like the position: a colour in units of the caller's choice, texture coordinates, nothing. Values
    /// beyond ±2^30 are taken as ±2^30.
    pub color: [i32; K],
}

/// A point of a patch's grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PatchVertex<T, const K: usize> {
    /// x, y, z, w in object space.
    pub position: Block<T, 4>,
    /// The mixed values, in the units of the control points'.
    pub color: [i32; K],
    /// Perpendicular to the patch in object space, of any length, from x, y and z alone: the cross product of the diagonals
    /// of de Casteljau's last quad (rectangular), or of two sides of its last triangle (triangular). Zero where those
    /// vanish or are parallel, and where no normals were asked for.
    pub normal: Block<T, 3>,
}

impl<T, const K: usize> ControlPoint<T, K> {
    /// With its values in range.
    fn clamped(self) -> Self {
        ControlPoint {
            color: self.color.map(|v| v.clamp(-(1 << 30), 1 << 30)),
            ..self
        }
    }
}

impl<T: Word, const K: usize> PatchVertex<T, K> {
    fn new(point: ControlPoint<T, K>, normal: Block<T, 3>) -> Self {
        PatchVertex {
            position: point.position,
            color: point.color,
            normal,
        }
    }
}
