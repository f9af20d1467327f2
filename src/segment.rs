//! Lines between subpixel ends, plain and antialiased, clipped without moving their ends.
//!
//! A line steps along x where |Δx| ≥ |Δy|, else along y. From the end a that is first on that axis to the other, b, it
//! visits every whole coordinate k with a ≤ k < b. With *other* the line's exact coordinate on the other axis at k:
//!
//! - a plain line ([`Nearest`]) lights floor(other + ½);
//! - a Wu line ([`Pairs`]) lights f = floor(other) with weight 1 − t and then f + 1 with weight t = other − f.
//!
//! The far end is left out, so that a chain along one axis draws its joints once. Coincident ends draw nothing.
//!
//! *other* is walked by quotient and remainder: the line is an [`Edge`] whose rows are the steps, exact
//! and without drift. A window is reached by computing the first step on it and the remainder there, so that a clipped line
//! lights exactly the pixels of the whole one, with the same weights.
//!
//! **Values** are linear along the stepping axis, or in perspective along it: they are those of a virtual triangle whose
//! third corner lies beside the first end, across the axis, and carries the same. They start at the line's first step, on
//! the window or not, and so have the same bits in any window. At step n of a line a [linear](crate::varying::Linear) value
//! is within n + 2 units, a depth within n + 2 of its units of 2^-15 step, and 1/w and value/w within (n + 2)·2^-14 unit;
//! each with 2^-28 of the range of its ends besides, and always within that range (`tests/segments.rs`).

use crate::edge::{Edge, SUBPIXEL_BITS, SUBPIXELS, first_row};
use crate::num::{Word, reciprocal};
use crate::screen::Shape;
use crate::span::{Corners, Span};
use crate::window::Window;

/// The weight of a whole pixel of a Wu line.
pub const WHOLE: i32 = 1 << 28;

/// The pixels of a plain line; see the [module](self).
///
/// ```
/// use fixel::{segment::Nearest, window::Window};
/// // From (0.5, 0.25) to (4.5, 2.25) px: y is ½, 1, 1½, 2 at x = 1 to 4.
/// let ends = [(128, 64), (1152, 576)];
/// let pixels: Vec<_> = Nearest::<i32>::new(&ends, Window::new(0, 0, 4, 4)).collect();
/// assert_eq!(pixels, [(1, 1), (2, 1), (3, 2)]);
/// ```
#[derive(Debug, Clone)]
pub struct Nearest<W>(Walk<W>);

/// The pairs of pixels of a Wu line, and the weight of the second in units of 2^-28; see the [module](self).
///
/// Either pixel of a pair may be off the window, across the stepping axis. The first one's weight is what the second
/// leaves of [`WHOLE`]. **Error** of a weight: cut off, less than 1.25 units. Cost: one reciprocal per line, a product per
/// step.
///
/// ```
/// use fixel::{segment::{Pairs, WHOLE}, window::Window};
/// // From (0.5, 0.25) to (4.5, 2.25) px: y is ½, 1, 1½, 2 at x = 1 to 4.
/// let ends = [(128, 64), (1152, 576)];
/// let pairs: Vec<_> = Pairs::<i32>::new(&ends, Window::new(0, 0, 3, 4)).collect();
/// assert_eq!((pairs[0].first, pairs[0].second), ((1, 0), (1, 1)));
/// assert!((pairs[0].weight - WHOLE / 2).abs() <= 1);
/// assert_eq!((pairs[1].first, pairs[1].weight), ((2, 1), 0));
/// ```
#[derive(Debug, Clone)]
pub struct Pairs<W> {
    walk: Walk<W>,
    /// 2^63 over the line's length along its axis in subpixels, normalised.
    reciprocal: u64,
    /// Takes remainder · reciprocal to units of 2^-28.
    shift: u32,
}

/// Two neighbouring pixels across a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair {
    /// The upper one, or the left one.
    pub first: (i32, i32),
    /// The lower one, or the right one.
    pub second: (i32, i32),
    /// How much of the line is in the second: 0…[`WHOLE`] − 1.
    pub weight: i32,
}

impl<W: Word> Nearest<W> {
    /// The pixels on `window` of the line between the two `ends`, which lie within ±[`Word::GUARD`] px.
    pub fn new(ends: &impl Corners, window: Window) -> Self {
        Nearest(Walk::new(&Axis::new(ends), window, SUBPIXELS / 2, 0))
    }

    #[inline(always)]
    pub(crate) fn walk(&self) -> &Walk<W> {
        &self.0
    }
}

impl<W: Word> Iterator for Nearest<W> {
    type Item = (i32, i32);

    #[inline(always)]
    fn next(&mut self) -> Option<(i32, i32)> {
        self.0.advance(|walk| walk.pixel(walk.edge.column_before()))
    }
}

impl<W: Word> Pairs<W> {
    /// The pairs with a pixel on `window` of the line between the two `ends`, which lie within ±[`Word::GUARD`] px.
    pub fn new(ends: &impl Corners, window: Window) -> Self {
        let axis = Axis::new(ends);
        // At most 2·GUARD px are 2^24 subpixels; a line that visits anything is 1 long at least.
        let length = (axis.to.1 - axis.from.1).max(1) as u32;
        let up = length.leading_zeros();
        Pairs {
            walk: Walk::new(&axis, window, 0, 1),
            reciprocal: reciprocal(length << up).min(u32::MAX as u64),
            // remainder/(256·length)·2^28, with 1/length = reciprocal·2^(up − 63).
            shift: 63 + SUBPIXEL_BITS - 28 - up,
        }
    }

    #[inline(always)]
    pub(crate) fn walk(&self) -> &Walk<W> {
        &self.walk
    }
}

impl<W: Word> Iterator for Pairs<W> {
    type Item = Pair;

    #[inline(always)]
    fn next(&mut self) -> Option<Pair> {
        let (reciprocal, shift) = (self.reciprocal, self.shift);
        self.walk.advance(|walk| {
            let across = walk.edge.column_before();
            // Below 256·2^24 times below 2^32.
            let weight = (walk.edge.remainder().to_i64() as u64 * reciprocal) >> shift;
            Pair {
                first: walk.pixel(across),
                second: walk.pixel(across + 1),
                weight: weight as i32,
            }
        })
    }
}

/// The steps of a line on a window.
#[derive(Debug, Clone)]
pub(crate) struct Walk<W> {
    edge: Edge<W>,
    x_is_major: bool,
    step: i32,
    end: i32,
    /// The line's first step and the one after the last, on the window or not.
    whole: (i32, i32),
}

impl<W: Word> Walk<W> {
    /// `offset` subpixels are added to the other coordinate; steps whose floor is up to `before` pixels before the window
    /// count as on it.
    fn new<S: Corners>(axis: &Axis<S>, window: Window, offset: i32, before: i32) -> Self {
        let (along, across) = axis.sides(window);
        let (from, to) = ((axis.from.0 + offset, axis.from.1), (axis.to.0 + offset, axis.to.1));
        let whole = (first_row(from.1), first_row(to.1));
        let range = (whole.0.max(along.0), whole.1.min(along.1));
        // No floor comes near 2^17: windows of any size keep the products below 2^51.
        const FAR: i32 = 1 << 17;
        let across = (across.0.clamp(-FAR, FAR) - before, across.1.clamp(-FAR, FAR));
        let (step, end) = if window.is_empty() {
            (0, 0)
        } else {
            steps_within(from, to, range, across)
        };
        let edge = if step < end {
            Edge::new(from, to, step)
        } else {
            Edge::default()
        };
        Walk {
            edge,
            x_is_major: axis.x_is_major,
            step,
            end,
            whole,
        }
    }

    /// The steps as a span along the axis, on the window from the current one on; `None` where none is left.
    #[inline(always)]
    pub(crate) fn span(&self) -> Option<Span> {
        (self.step < self.end).then_some(Span {
            row: 0,
            left: self.step,
            right: self.end,
            whole_left: self.whole.0,
            whole_right: self.whole.1,
        })
    }

    #[inline(always)]
    fn advance<R>(&mut self, at: impl FnOnce(&Self) -> R) -> Option<R> {
        if self.step >= self.end {
            return None;
        }
        let result = at(self);
        self.edge.descend();
        self.step += 1;
        Some(result)
    }

    /// The pixel `across` at the current step.
    #[inline(always)]
    fn pixel(&self, across: i32) -> (i32, i32) {
        if self.x_is_major {
            (self.step, across)
        } else {
            (across, self.step)
        }
    }
}

/// The steps in `range` at which the floor of the other coordinate lies in `across`; ends are (other, along) in subpixels.
///
/// Divides only where the line leaves `across` somewhere.
fn steps_within(from: (i32, i32), to: (i32, i32), range: (i32, i32), across: (i32, i32)) -> (i32, i32) {
    let whole = |v: i32| v >> SUBPIXEL_BITS;
    let least = whole(from.0.min(to.0));
    let most = whole(from.0.max(to.0));
    if least >= across.0 && most < across.1 {
        return range;
    }
    let (rise, length) = ((to.0 - from.0) as i64, (to.1 - from.1) as i64);
    let slope = rise.abs();
    // other ≥ v where slope·(256·k − from.1) ≥ (256·v − from.0)·length, for a line that rises; the mirror image else.
    let numerator = |v: i32| {
        let distance = v as i64 * SUBPIXELS as i64 - from.0 as i64;
        from.1 as i64 * slope + rise.signum() * distance * length
    };
    let divisor = slope * SUBPIXELS as i64;
    let floor = |v: i64| v.checked_div_euclid(divisor).unwrap_or(0);
    let (first, end) = match rise.signum() {
        1 => (-floor(-numerator(across.0)), -floor(-numerator(across.1))),
        -1 => (floor(numerator(across.1)) + 1, floor(numerator(across.0)) + 1),
        _ => return (0, 0),
    };
    let (first, end) = (first.max(range.0 as i64), end.min(range.1 as i64));
    if first < end {
        (first as i32, end as i32)
    } else {
        (0, 0)
    }
}

/// A line laid along its stepping axis: the virtual triangle of its values.
pub(crate) struct Axis<'s, S> {
    ends: &'s S,
    x_is_major: bool,
    /// The ends have changed places, to run forward.
    swapped: bool,
    /// Their (other, along) in subpixels.
    from: (i32, i32),
    to: (i32, i32),
}

impl<'s, S: Corners> Axis<'s, S> {
    pub(crate) fn new(ends: &'s S) -> Self {
        let (a, b) = (ends.position(0), ends.position(1));
        let x_is_major = (b.0 - a.0).abs() >= (b.1 - a.1).abs();
        let turned = |p: (i32, i32)| if x_is_major { (p.1, p.0) } else { p };
        let (a, b) = (turned(a), turned(b));
        let swapped = b.1 < a.1;
        let (from, to) = if swapped { (b, a) } else { (a, b) };
        Axis {
            ends,
            x_is_major,
            swapped,
            from,
            to,
        }
    }

    /// The window's sides along the axis and across it.
    fn sides(&self, window: Window) -> ((i32, i32), (i32, i32)) {
        let (columns, rows) = ((window.left, window.right), (window.top, window.bottom));
        if self.x_is_major {
            (columns, rows)
        } else {
            (rows, columns)
        }
    }

    /// The end whose values corner `index` of the triangle has.
    fn end(&self, index: usize) -> usize {
        ((index == 1) != self.swapped) as usize
    }
}

impl<S> Corners for Axis<'_, S> {
    #[inline]
    fn count(&self) -> usize {
        3
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        match index {
            0 => (self.from.1, 0),
            1 => (self.to.1, 0),
            // A pixel beside the first end: a power of two costs the steps no bits.
            _ => (self.from.1, SUBPIXELS),
        }
    }
}

impl<S: Shape> Shape for Axis<'_, S> {
    type Varying = S::Varying;
    #[inline]
    fn depth(&self, index: usize) -> i32 {
        self.ends.depth(self.end(index))
    }
    #[inline]
    fn varying(&self, index: usize) -> S::Varying {
        self.ends.varying(self.end(index))
    }
}
