//! Discs, exactly: the samples of a [square](mod@crate::square) at most half its size away from its center.
//!
//! Of the extreme points of the circle, where they are samples, the left and upper are covered, the right and lower are
//! not: those the square leaves out.
//!
//! In row y the samples with (x − X)² ≤ (S/2)² − (y − Y)² are a span whose half width is the integer square root of the
//! right side, in subpixels: all distances are whole ones, so that cutting it off, and S²/4 too, changes no answer.
//! Cost: one [root](crate::num::square_root) per row of the window, which is a reciprocal root and a few products.

use crate::edge::{SUBPIXEL_BITS, SUBPIXELS};
use crate::num::square_root;
use crate::screen::{Center, Shape, SubPx};
use crate::span::{Corners, Span, Spans};
use crate::square::Square;
use crate::varying::Varying;
use crate::window::Window;

/// A disc on the screen, with one depth and the same values everywhere; see the [module](self) and
/// [`draw::disc`](crate::draw::disc).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Disc<V> {
    square: Square<V>,
    x: i64,
    y: i64,
    diameter: i64,
}

impl<V: Copy> Disc<V> {
    /// A diameter below 0 counts as 0, and covers nothing.
    ///
    /// ```
    /// use fixel::{disc::Disc, screen::{Center, FineDepth, SubPx}};
    /// let center = Center { x: SubPx::lit("30"), y: SubPx::lit("20"), depth: FineDepth::ZERO };
    /// let disc = Disc::new(center, SubPx::lit("7.5"), ());
    /// ```
    pub fn new(center: Center, diameter: SubPx, varying: V) -> Self {
        Disc {
            square: Square::new(center, diameter, varying),
            x: center.x.to_bits() as i64,
            y: center.y.to_bits() as i64,
            diameter: diameter.to_bits().max(0) as i64,
        }
    }
}

/// Its values are those of its square.
impl<V> Corners for Disc<V> {
    #[inline]
    fn count(&self) -> usize {
        self.square.count()
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.square.position(index)
    }
}

impl<V: Varying> Shape for Disc<V> {
    type Varying = V;
    #[inline]
    fn depth(&self, index: usize) -> i32 {
        self.square.depth(index)
    }
    #[inline]
    fn varying(&self, index: usize) -> V {
        self.square.varying(index)
    }
}

impl<V> Spans for Disc<V> {
    #[inline]
    fn each(&self, window: Window, mut draw: impl FnMut(Span)) {
        // At most 2^31 across: 2^60.
        let square_of_radius = self.diameter * self.diameter / 4;
        for row in self.square.rows_on(window) {
            // A row of the square: |dy| is at most the radius.
            let dy = row as i64 * SUBPIXELS as i64 - self.y;
            let half = square_root((square_of_radius - dy * dy) as u64) as i64;
            // The square leaves its right side out, which only the widest row can reach.
            let reach = if 2 * half == self.diameter { half - 1 } else { half };
            let whole_left = ((self.x - half + SUBPIXELS as i64 - 1) >> SUBPIXEL_BITS) as i32;
            let whole_right = ((self.x + reach) >> SUBPIXEL_BITS) as i32 + 1;
            let span = Span {
                row,
                left: whole_left.max(window.left),
                right: whole_right.min(window.right),
                whole_left,
                whole_right,
            };
            if span.left < span.right {
                draw(span);
            }
        }
    }
}
