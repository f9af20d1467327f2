//! Positions on the screen, snapped once.

use fixed::types::extra::{U8, U15};
use fixed::{FixedI32, FixedU32};

use crate::edge::SUBPIXEL_BITS;
use crate::error::Error;
use crate::num::Word;
use crate::span::Corners;
use crate::varying::Varying;

/// A screen coordinate in pixels with 8 fraction bits. Within ±4096 px for 32-bit drawing, ±32768 px for 64-bit.
pub type SubPx = FixedI32<U8>;

/// A depth in steps of the 16-bit buffer, 0…65535, with 15 fraction bits.
pub type FineDepth = FixedU32<U15>;

/// A snapped position within ±4096 px, which is what 32-bit drawing is proved for; geometry that reaches farther goes
/// through the clipper. The sample of pixel (x, y) is the point (x, y); whoever wants samples at pixel centres takes half a
/// pixel off first ([`Viewport`](crate::viewport::Viewport) does).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Position {
    x: SubPx,
    y: SubPx,
}

impl Position {
    /// `x` to the right, `y` downwards.
    ///
    /// # Errors
    /// [`Error::TooLarge`] beyond ±4096 px.
    ///
    /// ```
    /// use fixel::screen::{Position, SubPx};
    /// assert!(Position::new(SubPx::lit("12.5"), SubPx::lit("-3.25")).is_ok());
    /// assert!(Position::new(SubPx::lit("4096.5"), SubPx::lit("0")).is_err());
    /// ```
    pub const fn new(x: SubPx, y: SubPx) -> Result<Self, Error> {
        const LIMIT: i32 = <i32 as Word>::GUARD << SUBPIXEL_BITS;
        if x.to_bits().unsigned_abs() > LIMIT as u32 || y.to_bits().unsigned_abs() > LIMIT as u32 {
            return Err(Error::TooLarge);
        }
        Ok(Position { x, y })
    }

    /// On the sample of pixel (x, y); beyond ±4096 px, on the nearest that is within.
    ///
    /// ```
    /// use fixel::screen::Position;
    /// assert_eq!(Position::from_pixels(3, -1).x().to_bits(), 768);
    /// ```
    pub const fn from_pixels(x: i16, y: i16) -> Self {
        Self::nearest(SubPx::from_bits((x as i32) << 8), SubPx::from_bits((y as i32) << 8))
    }

    /// (x, y), each moved to the nearest coordinate within ±4096 px.
    pub const fn nearest(x: SubPx, y: SubPx) -> Self {
        const fn within(v: SubPx) -> SubPx {
            const LIMIT: i32 = <i32 as Word>::GUARD << SUBPIXEL_BITS;
            let bits = v.to_bits();
            SubPx::from_bits(if bits > LIMIT {
                LIMIT
            } else if bits < -LIMIT {
                -LIMIT
            } else {
                bits
            })
        }
        Position {
            x: within(x),
            y: within(y),
        }
    }

    /// Where a viewport of 32-bit words has placed something: within ±4096 px already.
    #[inline(always)]
    pub(crate) const fn placed((x, y): (i32, i32)) -> Self {
        Position {
            x: SubPx::from_bits(x),
            y: SubPx::from_bits(y),
        }
    }

    /// To the right.
    pub const fn x(self) -> SubPx {
        self.x
    }

    /// Downwards.
    pub const fn y(self) -> SubPx {
        self.y
    }

    /// A corner that carries nothing else, at depth 0.
    pub const fn flat(self) -> Corner<()> {
        Corner {
            position: self,
            depth: FineDepth::ZERO,
            varying: (),
        }
    }
}

/// A corner of a primitive on the screen: the raster door's vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner<V> {
    /// Where.
    pub position: Position,
    /// How far; not looked at without a depth buffer.
    pub depth: FineDepth,
    /// What it carries.
    pub varying: V,
}

/// What squares and discs lie around: a snapped position anywhere, for they are cut to the picture, not clipped.
///
/// ```
/// use fixel::screen::{Center, FineDepth, SubPx};
/// let center = Center { x: SubPx::lit("12.5"), y: SubPx::lit("-90000"), depth: FineDepth::ZERO };
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Center {
    /// To the right.
    pub x: SubPx,
    /// Downwards.
    pub y: SubPx,
    /// How far; not looked at without a depth buffer.
    pub depth: FineDepth,
}

/// What `f` makes of the numbers of a triangle's corners. `array::map` is a loop over the numbers where a compiler saves code.
#[inline(always)]
pub(crate) fn of_corners<T>(f: impl Fn(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}

/// The corners of a polygon, or the two ends of a line, as the rooms from setup on want them.
pub trait Shape: Corners {
    /// What each corner carries.
    type Varying: Varying;
    /// Depth of corner `index` in units of 2^-15 step.
    fn depth(&self, index: usize) -> i32;
    /// What corner `index` carries.
    fn varying(&self, index: usize) -> Self::Varying;
}

impl<V> Corners for [Corner<V>; 3] {
    const TRIANGLE: bool = true;

    #[inline(always)]
    fn count(&self) -> usize {
        3
    }
    #[inline(always)]
    fn position(&self, index: usize) -> (i32, i32) {
        bits(pick(self, index).position)
    }
}

impl<V: Varying> Shape for [Corner<V>; 3] {
    type Varying = V;

    #[inline(always)]
    fn depth(&self, index: usize) -> i32 {
        depth_bits(pick(self, index).depth)
    }
    #[inline(always)]
    fn varying(&self, index: usize) -> V {
        pick(self, index).varying
    }
}

impl<V> Corners for [Corner<V>; 2] {
    #[inline(always)]
    fn count(&self) -> usize {
        2
    }
    #[inline(always)]
    fn position(&self, index: usize) -> (i32, i32) {
        bits(end(self, index).position)
    }
}

impl<V: Varying> Shape for [Corner<V>; 2] {
    type Varying = V;

    #[inline(always)]
    fn depth(&self, index: usize) -> i32 {
        depth_bits(end(self, index).depth)
    }
    #[inline(always)]
    fn varying(&self, index: usize) -> V {
        end(self, index).varying
    }
}

#[inline(always)]
fn bits(Position { x, y }: Position) -> (i32, i32) {
    (x.to_bits(), y.to_bits())
}

/// In units of 2^-15 step. The top bit is free: 65535 steps are the end of the range.
#[inline(always)]
pub(crate) fn depth_bits(depth: FineDepth) -> i32 {
    depth.to_bits().min(65535 << 15) as i32
}

/// End `index` of two, the last for any larger index.
#[inline(always)]
pub(crate) fn end<E>([a, b]: &[E; 2], index: usize) -> &E {
    if index == 0 { a } else { b }
}

/// Item `index` of three, the last for any larger index: no bounds to check.
#[inline(always)]
pub(crate) fn pick<C>([a, b, c]: &[C; 3], index: usize) -> &C {
    match index {
        0 => a,
        1 => b,
        _ => c,
    }
}
