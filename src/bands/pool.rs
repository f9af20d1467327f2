//! Memory for a frame's polygons between the vertices and the bands: binned once, drawn band by band.
//!
//! A polygon is in one list at a time: that of the band it begins in, and from there on, as long as it goes on below, that
//! of the polygons under way. Both run in the order of submission, and so does what a band draws, being the two merged: equal
//! depths and blending come out as in the whole picture.

use heapless::{Vec, VecView};

use crate::depth::Depth;
use crate::draw;
use crate::edge::first_row;
use crate::fragment::Fragment;
use crate::screen::{Corner, FineDepth, Position, Shape};
use crate::span::Corners;
use crate::target::Target;
use crate::varying::Varying;
use crate::window::Window;

/// No polygon; larger than any that there is.
const NONE: u16 = u16::MAX;

/// Memory for the polygons of a pass: `CORNERS` of them, `POLYGONS`, and `BANDS`, each at most 65535. A frame that does not
/// fit is drawn in several passes; see [`Bands::render`](super::Bands::render).
///
/// A corner takes 12 bytes and what it carries, a polygon 8 and its fragment program, a band 4. With an opaque mesh about
/// half of its triangles are there.
///
/// ```
/// use fixel::{bands::Pool, fragment::Gouraud565};
/// // For a static of its own, as it is too large for a stack.
/// const POOL: Pool<Gouraud565, 3000, 1000, 15> = Pool::new();
/// assert!(size_of_val(&POOL) < 3000 * 24 + 1000 * 8 + 15 * 4 + 40);
/// ```
#[derive(Debug)]
pub struct Pool<F: Fragment, const CORNERS: usize, const POLYGONS: usize, const BANDS: usize> {
    corners: Vec<Corner<F::Varying>, CORNERS>,
    polygons: Vec<Polygon<F>, POLYGONS>,
    lists: [List; BANDS],
    /// Bands of a pass: what the last one has shown to fit, once there was one.
    reach: Option<u16>,
}

/// A polygon of the pool.
#[derive(Debug, Clone, Copy)]
struct Polygon<F> {
    /// Its first corner, and how many there are from there on.
    first: u16,
    count: u16,
    /// In the list.
    next: u16,
    /// The last band of the pass that it covers.
    last: u16,
    fragment: F,
}

/// Polygons in the order of submission: first and last.
#[derive(Debug, Clone, Copy)]
struct List {
    first: u16,
    last: u16,
}

const EMPTY: List = List {
    first: NONE,
    last: NONE,
};

impl<F: Fragment, const CORNERS: usize, const POLYGONS: usize, const BANDS: usize> Pool<F, CORNERS, POLYGONS, BANDS> {
    const FITS: () = assert!(CORNERS < 65536 && POLYGONS < 65536 && BANDS < 65536);

    /// Empty.
    pub const fn new() -> Self {
        let () = Self::FITS;
        Pool {
            corners: Vec::new(),
            polygons: Vec::new(),
            // Zeros, so that a pool takes no flash; emptied before it is used.
            lists: [List { first: 0, last: 0 }; BANDS],
            reach: None,
        }
    }

    /// Corners and polygons that the last pass has stored: how large the pool would have had to be, if that was the only one.
    ///
    /// The example is [`Bands`](super::Bands)'s.
    pub fn used(&self) -> (usize, usize) {
        (self.corners.len(), self.polygons.len())
    }

    /// The same for a pool of any size.
    pub(super) fn bins(&mut self) -> Bins<'_, F> {
        Bins {
            corners: &mut self.corners,
            polygons: &mut self.polygons,
            lists: &mut self.lists,
            reach: self.reach.get_or_insert(NONE),
            rows: Rows::new(0, 1),
            window: Window::new(0, 0, 0, 0),
            under_way: NONE,
            full: false,
        }
    }
}

impl<F: Fragment, const CORNERS: usize, const POLYGONS: usize, const BANDS: usize> Default
    for Pool<F, CORNERS, POLYGONS, BANDS>
{
    fn default() -> Self {
        Self::new()
    }
}

/// A [`Pool`] in use.
pub(super) struct Bins<'p, F: Fragment> {
    corners: &'p mut VecView<Corner<F::Varying>>,
    polygons: &'p mut VecView<Polygon<F>>,
    lists: &'p mut [List],
    reach: &'p mut u16,
    rows: Rows,
    /// What the pass draws.
    window: Window,
    /// The first polygon that goes on below the last band drawn.
    under_way: u16,
    full: bool,
}

impl<F: Fragment + Copy> Bins<'_, F> {
    /// How many bands the next pass may have; 0 where nothing can be stored.
    pub(super) fn reach(&self) -> u16 {
        if self.corners.capacity() < 3 || self.polygons.capacity() == 0 {
            return 0;
        }
        (*self.reach).min(self.lists.len().min(NONE as usize) as u16)
    }

    /// Takes half as many bands from now on as this pass had, which did not fit.
    pub(super) fn shorten(&mut self) {
        let bands = self.rows.band(self.window.bottom.wrapping_sub(1)).saturating_add(1);
        *self.reach = self.reach().min(bands) >> 1;
    }

    /// Tries again with a band at a time, where in the last frame not even one fitted.
    pub(super) fn retry(&mut self) {
        *self.reach = (*self.reach).max(1);
    }

    /// Takes twice as many bands from now on, if that will do.
    pub(super) fn lengthen(&mut self) {
        let half_empty =
            self.corners.len() <= self.corners.capacity() >> 1 && self.polygons.len() <= self.polygons.capacity() >> 1;
        if half_empty {
            *self.reach = self.reach.saturating_mul(2);
        }
    }

    /// Empties the pool for a pass over `window`, in bands of `rows` rows.
    pub(super) fn begin(&mut self, window: Window, rows: i32) {
        self.corners.clear();
        self.polygons.clear();
        self.lists.fill(EMPTY);
        (self.under_way, self.full) = (NONE, false);
        self.window = window;
        self.rows = Rows::new(window.top, rows);
    }

    /// Whether everything has been stored.
    pub(super) fn is_complete(&self) -> bool {
        !self.full
    }

    pub(super) fn window(&self) -> Window {
        self.window
    }

    /// Stores a polygon, unless it misses the rows of the pass. `place` makes positions of subpixels.
    #[inline(always)]
    pub(super) fn polygon<S>(&mut self, shape: &S, place: impl Fn((i32, i32)) -> Position, fragment: F)
    where
        S: Shape<Varying = F::Varying>,
    {
        let Some(bands) = self.bands(shape) else {
            return;
        };
        let (first, count) = (self.corners.len() as u16, shape.count());
        for i in 0..count {
            let corner = Corner {
                position: place(shape.position(i)),
                // In its range already.
                depth: FineDepth::from_bits(shape.depth(i) as u32),
                varying: shape.varying(i),
            };
            if self.corners.push(corner).is_err() {
                self.full = true;
                return;
            }
        }
        self.list(first, count as u16, bands, fragment);
    }

    /// First and last band of the pass whose rows a polygon covers.
    #[inline(always)]
    fn bands(&self, corners: &impl Corners) -> Option<(u16, u16)> {
        if self.full {
            return None;
        }
        let (top, bottom) = sample_rows(corners);
        let (top, bottom) = (top.max(self.window.top), bottom.min(self.window.bottom));
        (top < bottom).then(|| (self.rows.band(top), self.rows.band(bottom.wrapping_sub(1))))
    }

    #[inline(always)]
    fn list(&mut self, first: u16, count: u16, (band, last): (u16, u16), fragment: F) {
        let index = self.polygons.len() as u16;
        let polygon = Polygon {
            first,
            count,
            next: NONE,
            last,
            fragment,
        };
        if self.polygons.push(polygon).is_err() {
            self.full = true;
            return;
        }
        let Some(list) = self.lists.get_mut(band as usize) else {
            return;
        };
        let before = list.last;
        list.last = index;
        match self.polygons.get_mut(before as usize) {
            Some(before) => before.next = index,
            None => list.first = index,
        }
    }

    /// Draws a band of the pass; bands are drawn in turn, each once.
    pub(super) fn draw<C, D>(&mut self, band: u16, color: &mut C, depth: &mut D)
    where
        C: Target<Pixel = F::Pixel>,
        D: Depth,
    {
        let first = self.lists.get(band as usize).map_or(NONE, |list| list.first);
        // As words, which need not be cut to 16 bits again and again.
        let (mut going_on, mut beginning) = (self.under_way as usize, first as usize);
        let mut below = EMPTY;
        loop {
            let index = going_on.min(beginning);
            let Some(polygon) = self.polygons.get_mut(index) else {
                break;
            };
            let next = polygon.next as usize;
            if index == going_on {
                going_on = next;
            } else {
                beginning = next;
            }
            let index = index as u16;
            polygon.next = NONE;
            let Polygon {
                first,
                count,
                last,
                fragment,
                ..
            } = *polygon;
            let corners = self.corners.get(first as usize..).unwrap_or_default();
            paint(corners, count, color, depth, &fragment);
            if last > band {
                match self.polygons.get_mut(below.last as usize) {
                    Some(before) => before.next = index,
                    None => below.first = index,
                }
                below.last = index;
            }
        }
        self.under_way = below.first;
    }
}

/// Draws the polygon of the first `count` corners.
#[inline(always)]
fn paint<C, D, F>(corners: &[Corner<F::Varying>], count: u16, color: &mut C, depth: &mut D, fragment: &F)
where
    C: Target<Pixel = F::Pixel>,
    D: Depth,
    F: Fragment,
{
    if count != 3 {
        paint_run(
            corners.get(..count as usize).unwrap_or_default(),
            color,
            depth,
            fragment,
        );
    } else if let Some(corners) = corners.first_chunk() {
        draw::shape::<i32, _, _, [_; 3], _>(color, depth, corners, fragment);
    }
}

/// A polygon of more than three corners, as clipping leaves.
#[cold]
#[inline(never)]
fn paint_run<C, D, F>(run: &[Corner<F::Varying>], color: &mut C, depth: &mut D, fragment: &F)
where
    C: Target<Pixel = F::Pixel>,
    D: Depth,
    F: Fragment,
{
    let Some(first) = run.first() else {
        return;
    };
    draw::shape::<i32, _, _, _, _>(color, depth, &Run { run, first }, fragment);
}

/// The rows whose samples lie between a polygon's highest corner and its lowest: first, and the one after the last.
#[inline(always)]
pub(super) fn sample_rows(corners: &impl Corners) -> (i32, i32) {
    let (_, first) = corners.position(0);
    let (mut highest, mut lowest) = (first, first);
    for i in 1..corners.count() {
        let (_, y) = corners.position(i);
        (highest, lowest) = (highest.min(y), lowest.max(y));
    }
    (first_row(highest), first_row(lowest))
}

/// Corners of the pool that follow one another.
struct Run<'r, V> {
    run: &'r [Corner<V>],
    first: &'r Corner<V>,
}

impl<V> Run<'_, V> {
    fn corner(&self, index: usize) -> &Corner<V> {
        self.run.get(index).unwrap_or(self.first)
    }
}

impl<V> Corners for Run<'_, V> {
    fn count(&self) -> usize {
        self.run.len()
    }
    fn position(&self, index: usize) -> (i32, i32) {
        let position = self.corner(index).position;
        (position.x().to_bits(), position.y().to_bits())
    }
}

impl<V: Varying> Shape for Run<'_, V> {
    type Varying = V;
    fn depth(&self, index: usize) -> i32 {
        crate::screen::depth_bits(self.corner(index).depth)
    }
    fn varying(&self, index: usize) -> V {
        self.corner(index).varying
    }
}

/// From rows to bands, without a division: n/d = n·⌈2^k/d⌉ / 2^k, cut, for n < 2^12 and d ≤ 2^(k − 12), since the product is too
/// large by less than n·d.
#[derive(Clone, Copy)]
struct Rows {
    top: i32,
    reciprocal: u32,
    shift: u32,
}

impl Rows {
    /// Bands of `rows` rows from `top` on, within 4096 of it.
    fn new(top: i32, rows: i32) -> Self {
        let rows = rows.clamp(1, 4096) as u32;
        let shift = 12 + rows.next_power_of_two().trailing_zeros();
        Rows {
            top,
            // At most 2^13, so that a product is below 2^25.
            reciprocal: ((1u32 << shift) + (rows - 1)).checked_div(rows).unwrap_or(0),
            shift,
        }
    }

    #[inline(always)]
    fn band(&self, row: i32) -> u16 {
        ((row.wrapping_sub(self.top) as u32).wrapping_mul(self.reciprocal) >> self.shift) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::Rows;

    #[test]
    fn rows_are_divided_exactly() {
        for rows in 1..=4096 {
            let bands = Rows::new(5, rows);
            for row in 0..4096 {
                assert_eq!(bands.band(5 + row) as i32, row / rows, "{row} / {rows}");
            }
        }
    }
}
