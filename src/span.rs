//! A convex polygon on the screen, row by row.
//!
//! Clipping makes polygons; they are scanned whole, not cut into triangles: a left chain and a right chain of edges from
//! the top corner to the bottom one. That is fewer edges to set up, and exact where a fan is not: cut points that fall
//! within 1/256 px of a corner can turn a fan's sliver around, and a turned sliver is a pixel drawn twice.

use core::hint::black_box;
use core::marker::PhantomData;
use core::mem;

use crate::edge::{Edge, first_row};
use crate::num::{Word, product};
use crate::screen::of_corners;
use crate::window::Window;

/// Corners of a polygon on the screen: (x, y) in subpixels, in order. Implemented for arrays and by closures.
pub trait Corners {
    /// Always three: a triangle needs no chains of edges.
    const TRIANGLE: bool = false;

    /// How many.
    fn count(&self) -> usize;
    /// Position of corner `index`, (0, 0) beyond the last.
    fn position(&self, index: usize) -> (i32, i32);
}

impl<const N: usize> Corners for [(i32, i32); N] {
    const TRIANGLE: bool = N == 3;

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

impl Span {
    /// What lies on the window of a row, between the first of its columns and the one after the last: perhaps nothing.
    #[inline(always)]
    pub(crate) fn new(row: i32, (whole_left, whole_right): (i32, i32), window: &Window) -> Self {
        Span {
            row,
            left: whole_left.max(window.left),
            right: whole_right.min(window.right),
            whole_left,
            whole_right,
        }
    }
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
/// screen whose rows run downwards. Of corners within ±2^28 subpixels, which is ±2^20 pixels.
///
/// ```
/// use fixel::span::doubled_area;
/// assert_eq!(doubled_area(&[(0, 0), (0, 256), (256, 0)]), 65536);
/// ```
#[inline]
pub fn doubled_area(corners: &impl Corners) -> i64 {
    let origin = corners.position(0);
    let from_origin = |p: (i32, i32)| (p.0.wrapping_sub(origin.0), p.1.wrapping_sub(origin.1));
    let mut sum = 0i64;
    let mut previous = from_origin(corners.position(1));
    for i in 2..corners.count() {
        let next = from_origin(corners.position(i));
        sum = sum.wrapping_add(product(previous.1, next.0).wrapping_sub(product(previous.0, next.1)));
        previous = next;
    }
    sum
}

/// Calls `draw` with every span of the polygon on `window`, from the top. `ccw` says which way the corners run
/// ([`doubled_area`] > 0). A sample is covered iff it lies inside, on a left edge or on a horizontal top edge.
///
/// Cost: two edges are set up per corner passed; a row above the window costs nothing, and nothing is walked of a polygon
/// that lies beside the window.
///
/// ```
/// use fixel::{span, window::Window};
/// let mut spans = Vec::new();
/// let triangle = [(0, 0), (0, 512), (512, 0)];
/// span::scan::<i32>(&triangle, true, Window::new(0, 0, 8, 8), |s| spans.push((s.row, s.left..s.right)));
/// assert_eq!(spans, [(0, 0..2), (1, 0..1)]);
/// ```
#[inline]
pub fn scan<W: Word>(corners: &impl Corners, ccw: bool, window: Window, draw: impl FnMut(Span)) {
    if is_triangle(corners) {
        scan_triangle::<W>(&of_corners(|i| corners.position(i)), ccw, window, draw);
    } else {
        scan_polygon::<W>(corners, ccw, window, draw);
    }
}

#[inline(always)]
fn is_triangle<S: Corners>(_: &S) -> bool {
    S::TRIANGLE
}

/// Three corners: two edges run down from the top one, and one of them turns once.
#[inline(always)]
fn scan_triangle<W: Word>(corners: &[(i32, i32); 3], ccw: bool, window: Window, mut draw: impl FnMut(Span)) {
    let mut rows = TriangleRows::<W>::new(corners, ccw, &window);
    let mut block = rows.room();
    while let Some((row, columns)) = rows.walk(&mut block, BLOCK, None) {
        for (row, &columns) in (row..).zip(&*columns) {
            let span = Span::new(row, columns, &window);
            if span.left < span.right {
                draw(span);
            }
        }
    }
}

/// Rows of a triangle that are walked at a time. The walk has ten words of state and the drawing of a row as many: apart from
/// each other, both stay in registers.
pub(crate) const BLOCK: usize = 16;

/// A triangle's rows on a window, walked from the top.
pub(crate) struct TriangleRows<W> {
    left: Side<W>,
    right: Side<W>,
    row: i32,
    /// Where the first of the present edges ends.
    stop: i32,
    /// The one after the last; none for a triangle beside the window.
    end: i32,
}

/// One side of a triangle: from the top corner by way of another to the last.
struct Side<W> {
    edge: Edge<W>,
    corners: [(i32, i32); 3],
    /// Where the present edge ends; above the first row before there is one.
    end: i32,
}

impl<W: Word> TriangleRows<W> {
    /// The same code for all that is drawn.
    #[inline(never)]
    pub(crate) fn new(&[a, b, c]: &[(i32, i32); 3], ccw: bool, window: &Window) -> Self {
        // Counter-clockwise on the screen, with the top one first: the left side is a-b-c, the right side a-c-b.
        let (b, c) = if ccw { (b, c) } else { (c, b) };
        let (a, b, c) = if b.1 < a.1 && b.1 <= c.1 {
            (b, c, a)
        } else if c.1 < a.1 {
            (c, a, b)
        } else {
            (a, b, c)
        };
        let top = first_row(a.1).max(window.top);
        let beside = is_beside(*window, a.0.min(b.0).min(c.0), a.0.max(b.0).max(c.0));
        TriangleRows {
            left: Side::new([a, b, c], top),
            right: Side::new([a, c, b], top),
            row: top,
            stop: i32::MIN,
            end: if beside {
                i32::MIN
            } else {
                first_row(b.1.max(c.1)).min(window.bottom)
            },
        }
    }

    /// Room for as many rows as are walked at a time: words that are the same, which costs a store each and no call.
    #[inline(always)]
    pub(crate) fn room(&self) -> [(i32, i32); BLOCK] {
        [(self.row, self.row); BLOCK]
    }

    /// What is left of the last row, if anything, else the next rows, at most `room` of them: the first, and of each the first
    /// column and the one after the last.
    #[inline(always)]
    pub(crate) fn walk<'a>(
        &mut self,
        block: &'a mut [(i32, i32); BLOCK],
        room: usize,
        rest: Option<(i32, i32)>,
    ) -> Option<(i32, &'a mut [(i32, i32)])> {
        if let Some(rest) = rest {
            let columns = block.first_chunk_mut::<1>()?;
            *columns = [rest];
            return Some((self.row.wrapping_sub(1), columns));
        }
        let row = self.row;
        let columns = block.get_mut(..room)?;
        let count = if row < self.end { self.fill(columns) } else { 0 };
        Some((row, columns.get_mut(..count)?)).filter(|_| count > 0)
    }

    /// How many are filled. The same code for all that is drawn.
    #[inline(never)]
    fn fill(&mut self, columns: &mut [(i32, i32)]) -> usize {
        let most = columns.len();
        let mut free = columns;
        while self.row < self.end && !free.is_empty() {
            if self.row >= self.stop {
                self.left.reach(self.row);
                self.right.reach(self.row);
                self.stop = self.left.end.min(self.right.end).min(self.end);
            }
            let count = (self.stop.wrapping_sub(self.row) as usize).min(free.len());
            let Some((block, rest)) = mem::take(&mut free).split_at_mut_checked(count) else {
                break;
            };
            let (mut left, mut right) = (self.left.edge, self.right.edge);
            for columns in block {
                // Four rows at a time would not fit the registers.
                black_box(());
                *columns = (left.column(), right.column());
                left.descend();
                right.descend();
            }
            (self.left.edge, self.right.edge) = (left, right);
            self.row += count as i32;
            free = rest;
        }
        most - free.len()
    }
}

impl<W: Word> Side<W> {
    #[inline(always)]
    fn new(corners: [(i32, i32); 3], word: i32) -> Self {
        Side {
            edge: Edge::placeholder(word),
            corners,
            end: i32::MIN,
        }
    }

    /// Goes on to the edge that crosses `row`, if it is not the present one.
    #[inline(never)]
    fn reach(&mut self, row: i32) {
        if row < self.end {
            return;
        }
        let [top, middle, last] = self.corners;
        let turn = first_row(middle.1);
        let (from, to, end) = if row < turn {
            (top, middle, turn)
        } else {
            (middle, last, i32::MAX)
        };
        self.edge = Edge::new(from, to, row);
        self.end = end;
    }
}

/// Whether all that lies between two columns, in subpixels, is left or right of the window: then no row is walked.
#[inline(always)]
fn is_beside(window: Window, leftmost: i32, rightmost: i32) -> bool {
    first_row(leftmost) >= window.right || first_row(rightmost) <= window.left
}

/// Any number of corners.
#[inline(always)]
fn scan_polygon<W: Word>(corners: &impl Corners, ccw: bool, window: Window, mut draw: impl FnMut(Span)) {
    let mut rows = PolygonRows::<W, _>::new(corners, ccw, window);
    while let Some(span) = rows.next() {
        draw(span);
    }
}

/// A polygon's rows on a window, walked from the top.
struct PolygonRows<'c, W, S> {
    corners: &'c S,
    window: Window,
    sides: [Chain<W>; 2],
    row: i32,
    /// Where the first of the present edges ends.
    stop: i32,
    /// The one after the last; none for a polygon beside the window.
    end: i32,
}

impl<'c, W: Word, S: Corners> PolygonRows<'c, W, S> {
    /// The same code for all that is drawn of one kind of corners, as [`next`](Self::next).
    #[inline(never)]
    fn new(corners: &'c S, ccw: bool, window: Window) -> Self {
        let (mut top, mut highest, mut lowest) = (0, i32::MAX, i32::MIN);
        let (mut leftmost, mut rightmost) = (i32::MAX, i32::MIN);
        for i in 0..corners.count() {
            let (x, y) = corners.position(i);
            lowest = lowest.max(y);
            (leftmost, rightmost) = (leftmost.min(x), rightmost.max(x));
            if y < highest {
                (top, highest) = (i, y);
            }
        }
        let (after, before) = (1, corners.count().wrapping_sub(1));
        let (left, right) = if ccw { (after, before) } else { (before, after) };
        PolygonRows {
            corners,
            window,
            // Counter-clockwise on the screen, the corners after the top one run down its left side.
            sides: [Chain::new(top, left), Chain::new(top, right)],
            row: first_row(highest).max(window.top),
            stop: i32::MIN,
            end: if is_beside(window, leftmost, rightmost) {
                i32::MIN
            } else {
                first_row(lowest).min(window.bottom)
            },
        }
    }

    #[inline(never)]
    fn next(&mut self) -> Option<Span> {
        while self.row < self.end {
            if self.row >= self.stop {
                self.stop = self.end;
                for side in &mut self.sides {
                    side.reach(self.corners, self.row);
                    self.stop = self.stop.min(side.end);
                }
                if self.stop <= self.row {
                    // Only a polygon whose chain turns back up gets here (cut points a unit out of order): nothing more is
                    // certain to lie inside it.
                    self.end = self.row;
                    return None;
                }
            }
            let [left, right] = &mut self.sides;
            let span = Span::new(self.row, (left.edge.column(), right.edge.column()), &self.window);
            left.edge.descend();
            right.edge.descend();
            self.row += 1;
            if span.left < span.right {
                return Some(span);
            }
        }
        None
    }
}

/// One side of the polygon: the edge that crosses the current row, and the row where it ends.
struct Chain<W> {
    edge: Edge<W>,
    end: i32,
    corner: usize,
    /// From a corner to the next of the side, around all of them.
    step: usize,
    remaining: usize,
}

impl<W: Word> Chain<W> {
    fn new(top: usize, step: usize) -> Self {
        Chain {
            edge: Edge::placeholder(0),
            end: i32::MIN,
            corner: top,
            step,
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
            let next = self.corner.wrapping_add(self.step);
            let next = if next < count { next } else { next.wrapping_sub(count) };
            let (from, to) = (corners.position(self.corner), corners.position(next));
            self.corner = next;
            self.end = first_row(to.1);
            if self.end > row {
                self.edge = Edge::new(from, to, row);
            }
        }
    }
}
