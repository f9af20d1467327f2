//! A convex polygon on the screen, row by row.
//!
//! Clipping makes polygons; they are scanned whole, not cut into triangles: a left chain and a right chain of edges from
//! the top corner to the bottom one. That is fewer edges to set up, and exact where a fan is not: cut points that fall
//! within 1/256 px of a corner can turn a fan's sliver around, and a turned sliver is a pixel drawn twice.

use core::marker::PhantomData;

use crate::edge::{Edge, first_row};
use crate::num::Word;
use crate::window::Window;

/// Corners of a polygon on the screen: (x, y) in subpixels, in order. Implemented for arrays and by closures.
pub trait Corners {
    /// How many.
    fn count(&self) -> usize;
    /// Position of corner `index`, (0, 0) beyond the last.
    fn position(&self, index: usize) -> (i32, i32);
}

impl<const N: usize> Corners for [(i32, i32); N] {
    #[inline(always)]
    fn count(&self) -> usize {
        N
    }
    #[inline(always)]
    fn position(&self, index: usize) -> (i32, i32) {
        self.get(index).copied().unwrap_or((0, 0))
    }
}

/// The covered samples of one row: never empty, and within the window that it was scanned for.
///
/// `whole_left..whole_right` is the span before it was cut to the window's columns. Whatever is computed once per span
/// starts from there, so that a strip or tile gets the same bits as the whole picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span {
    /// The row.
    pub row: i32,
    /// First column on the window.
    pub left: i32,
    /// The column after the last on the window.
    pub right: i32,
    /// First column covered, on the window or not.
    pub whole_left: i32,
    /// The column after the last covered, on the window or not.
    pub whole_right: i32,
}

/// What covers samples row by row.
pub(crate) trait Spans {
    /// Calls `draw` with every span on `window`, from the top.
    fn each(&self, window: Window, draw: impl FnMut(Span));
}

/// A convex polygon as its [`scan`] covers it.
pub(crate) struct Scan<'s, W, S> {
    corners: &'s S,
    ccw: bool,
    word: PhantomData<W>,
}

impl<'s, W, S> Scan<'s, W, S> {
    #[inline(always)]
    pub(crate) fn new(corners: &'s S, ccw: bool) -> Self {
        Scan {
            corners,
            ccw,
            word: PhantomData,
        }
    }
}

impl<W: Word, S: Corners> Spans for Scan<'_, W, S> {
    #[inline(always)]
    fn each(&self, window: Window, draw: impl FnMut(Span)) {
        scan::<W>(self.corners, self.ccw, window, draw);
    }
}

/// Twice the signed area in square subpixels, exactly: positive where the corners run counter-clockwise as seen on a
/// screen whose rows run downwards.
///
/// ```
/// use fixel::span::doubled_area;
/// assert_eq!(doubled_area(&[(0, 0), (0, 256), (256, 0)]), 65536);
/// ```
#[inline]
pub fn doubled_area(corners: &impl Corners) -> i64 {
    let origin = corners.position(0);
    let from_origin = |p: (i32, i32)| ((p.0 - origin.0) as i64, (p.1 - origin.1) as i64);
    let mut sum = 0;
    let mut previous = from_origin(corners.position(1));
    for i in 2..corners.count() {
        let next = from_origin(corners.position(i));
        sum += previous.1 * next.0 - previous.0 * next.1;
        previous = next;
    }
    sum
}

/// Calls `draw` with every span of the polygon on `window`, from the top. `ccw` says which way the corners run
/// ([`doubled_area`] > 0). A sample is covered iff it lies inside, on a left edge or on a horizontal top edge.
///
/// Cost: two edges are set up per corner passed; a row above the window or beside it costs nothing.
///
/// ```
/// use fixel::{span, window::Window};
/// let mut spans = Vec::new();
/// let triangle = [(0, 0), (0, 512), (512, 0)];
/// span::scan::<i32>(&triangle, true, Window::new(0, 0, 8, 8), |s| spans.push((s.row, s.left..s.right)));
/// assert_eq!(spans, [(0, 0..2), (1, 0..1)]);
/// ```
#[inline]
pub fn scan<W: Word>(corners: &impl Corners, ccw: bool, window: Window, mut draw: impl FnMut(Span)) {
    let count = corners.count();
    let mut top = 0;
    let mut lowest = i32::MIN;
    for i in 0..count {
        let (_, y) = corners.position(i);
        lowest = lowest.max(y);
        if y < corners.position(top).1 {
            top = i;
        }
    }
    let end = first_row(lowest).min(window.bottom);
    let mut row = first_row(corners.position(top).1).max(window.top);

    // Counter-clockwise on the screen, the corners after the top one run down its left side.
    let mut left = Chain::<W>::new(top, ccw);
    let mut right = Chain::<W>::new(top, !ccw);
    while row < end {
        left.reach(corners, row);
        right.reach(corners, row);
        let stop = end.min(left.end).min(right.end);
        if stop <= row {
            // Only a polygon whose chain turns back up gets here (cut points a unit out of order): nothing more is
            // certain to lie inside it.
            return;
        }
        while row < stop {
            let (whole_left, whole_right) = (left.edge.column(), right.edge.column());
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
            left.edge.descend();
            right.edge.descend();
            row += 1;
        }
    }
}

/// One side of the polygon: the edge that crosses the current row, and the row where it ends.
struct Chain<W> {
    edge: Edge<W>,
    end: i32,
    corner: usize,
    forward: bool,
    remaining: usize,
}

impl<W: Word> Chain<W> {
    fn new(top: usize, forward: bool) -> Self {
        Chain {
            edge: Edge::default(),
            end: i32::MIN,
            corner: top,
            forward,
            remaining: usize::MAX,
        }
    }

    /// Goes on to the edge that crosses `row`; `end` stays at or above `row` when there is none.
    #[inline(always)]
    fn reach(&mut self, corners: &impl Corners, row: i32) {
        let count = corners.count();
        self.remaining = self.remaining.min(count);
        while self.end <= row && self.remaining > 0 {
            self.remaining -= 1;
            let next = match (self.forward, self.corner) {
                (true, c) => {
                    if c + 1 < count {
                        c + 1
                    } else {
                        0
                    }
                }
                (false, 0) => count - 1,
                (false, c) => c - 1,
            };
            let (from, to) = (corners.position(self.corner), corners.position(next));
            self.corner = next;
            self.end = first_row(to.1);
            if self.end > row {
                self.edge = Edge::new(from, to, row);
            }
        }
    }
}
