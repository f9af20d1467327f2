//! The triangles of a fan: no sample is drawn by two of them.

use crate::clip::DepthRange;
use crate::num::{Block, Word};
use crate::span::doubled_area;
use crate::viewport::Viewport;

/// A polygon that is drawn as the fan from its first corner, each triangle with values of its own.
///
/// Where a cut falls within 1/256 px of a corner, or corners lie in a line, rounding may turn a triangle over. It lies on the ones
/// beside it then, where samples would be drawn twice, and is left out.
pub(crate) struct Fan<'v, W, P> {
    viewport: &'v Viewport<W>,
    /// The corners.
    position: P,
    /// Of the whole polygon, doubled; `None` where a corner has no place of its own, behind the camera or off the guard band.
    area: Option<i64>,
    /// The last corner of what is drawn.
    reached: usize,
}

impl<'v, T: Word, W: Word, P: Fn(usize) -> Option<Block<T, 4>>> Fan<'v, W, P> {
    /// Of `count` corners, whose w have one sign.
    pub(crate) fn new(viewport: &'v Viewport<W>, count: usize, position: P) -> Self {
        let mut fan = Fan {
            viewport,
            position,
            area: None,
            reached: 1,
        };
        fan.area = (2..count).map(|i| fan.part(i.wrapping_sub(1), i)).sum();
        fan
    }

    /// Where the triangle that ends at corner `i` begins, if it is drawn: at the one before, or where that is left out and within a
    /// subpixel of it, at the one that is reached, since what is drawn already may lie between them.
    pub(crate) fn start(&mut self, i: usize) -> Option<usize> {
        let before = i.wrapping_sub(1);
        let Some(area) = self.area else {
            return Some(before);
        };
        let start = if before != self.reached && self.is_near(before) {
            self.reached
        } else {
            before
        };
        let part = self.part(start, i).unwrap_or(0);
        if part != 0 && (part < 0) != (area < 0) {
            return None;
        }
        self.reached = i;
        Some(start)
    }

    /// Whether a corner is one subpixel from the one that is reached, at most.
    fn is_near(&self, i: usize) -> bool {
        let Some((a, b)) = self.place(self.reached).zip(self.place(i)) else {
            return false;
        };
        (a.0 - b.0).abs() <= 1 && (a.1 - b.1).abs() <= 1
    }

    /// The doubled area of a triangle.
    fn part(&self, start: usize, end: usize) -> Option<i64> {
        Some(doubled_area(&[self.place(0)?, self.place(start)?, self.place(end)?]))
    }

    /// Within the guard band: below 2^24 subpixels.
    #[inline(never)]
    fn place(&self, i: usize) -> Option<(i32, i32)> {
        let (x, y, _) = self.viewport.place((self.position)(i)?, DepthRange::Unlimited)?;
        self.viewport.is_inside((x, y)).then_some((x, y))
    }
}
