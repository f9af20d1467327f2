//! Small triangles: corners within 16 columns and 8 rows of the first, which is most triangles of a fine mesh.
//!
//! All of it fits words of 32 bits: sides below 2^12 subpixels, edge functions and the doubled area below 2^26. One function
//! ([`Small::new`]), the same for all that is drawn, finds what is covered, row by row, and tells at once where that is
//! nothing. Then values are set up from a sample that is covered, where all weights lie in 0…1, and stepped from there as
//! [slopes](mod@crate::slope) are.
//!
//! **Thin triangles**, whose values change so fast that steps would add up their errors, get every sample's value from its
//! own edge functions. They cover few samples; nothing is clamped, nothing is wider than 32 bits.
//!
//! Which way is taken depends on the corners alone, and steps are added modulo 2^32, so that any window has the same bits.
//!
//! **Cost** on Cortex-M4, with colours and depth: some 350 instructions for what is covered and the weights, 22 for each row
//! of that, 144 for the values, 100 around them; then 70 for each row drawn and 17 for each pixel. By hand the rows would be
//! some 45, half of which is where they lie in their two buffers, and the rest about 350 in all.
//!
//! **Error.** At a sample whose weights come from edge functions: weights are cut to 2^-28 of 1, which with the products'
//! cut makes less than 32 units of a value of 31 bits. A step is off by 4·2^up units, `up` at most [`MOST_UP`] as
//! [`Weights`] have it, and no sample is more than 46 steps away: below 3000 units, a tenth of a step of depth.

use core::hint::black_box;

use crate::depth::Depth;
use crate::edge::{SUBPIXEL_BITS, SUBPIXELS, first_row};
use crate::fragment::Fragment;
use crate::num::{Word, high, near_reciprocal};
use crate::screen::Shape;
use crate::slope::{Slope, Slopes, Weights};
use crate::span::Span;
use crate::target::Target;
use crate::varying::Varying;
use crate::window::Window;

/// From the first corner to the others, in either direction, less than this many subpixels: 16 columns.
const REACH_X: i32 = 16 << SUBPIXEL_BITS;
/// 8 rows.
const REACH_Y: i32 = 8 << SUBPIXEL_BITS;
/// The most rows that such a triangle crosses.
const ROWS: usize = 16;
/// Steps are taken where a weight changes by less than 2^(MOST_UP − 2) per pixel: down to ¼ px high.
const MOST_UP: u32 = 4;

/// A point in subpixels.
type Point = (i32, i32);

/// Of each row the first columns at or right of its two edges, whichever is the left one, counted from the leftmost corner's
/// pixel: the lesser and the larger are the span.
type Rows = [[u8; 2]; ROWS];

/// Whether corners are so near each other.
#[inline(always)]
pub(crate) fn is_small([a, b, c]: [Point; 3]) -> bool {
    let x = |from: Point, to: Point| to.0.wrapping_sub(from.0).wrapping_add(REACH_X) as u32;
    let y = |from: Point, to: Point| to.1.wrapping_sub(from.1).wrapping_add(REACH_Y) as u32;
    (x(a, b) | x(a, c)) < 2 * REACH_X as u32 && (y(a, b) | y(a, c)) < 2 * REACH_Y as u32
}

/// Draws a triangle that [is small](is_small); `false`, and nothing drawn, where its varying has no use for weights.
#[inline(never)]
pub(crate) fn paint<C, D, S, F>(color: &mut C, depth: &mut D, shape: &S, fragment: &F) -> bool
where
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    let corners = [0, 1, 2].map(|i| shape.position(i));
    let window = depth.limit(color.window());
    let mut rows = [[0; 2]; ROWS];
    // Looked at in place: taken out of its option, it would be copied.
    let mut small = if D::ENABLED || <F::Varying as Varying>::Slopes::CARRIES {
        Small::new::<true>(&corners, &window, &mut rows)
    } else {
        Small::new::<false>(&corners, &window, &mut rows)
    };
    let Some(small) = &mut small else {
        return true;
    };
    if small.thin && !small.aim(&corners, &mut rows) {
        return true;
    }
    loop {
        let Some(values) = Values::new::<D>(&small.weights, shape) else {
            return false;
        };
        values.paint(color, depth, small, &rows, fragment);
        if !small.thin || !small.next(&corners, &mut rows) {
            return true;
        }
    }
}

/// All that is interpolated over a triangle.
struct Values<V: Varying> {
    depth: Slope,
    slopes: V::Slopes,
}

impl<V: Varying> Values<V> {
    /// Set up once; for every sample of a thin triangle.
    ///
    /// A function of its own: inlined, the weights take the registers of the rows.
    #[inline(never)]
    fn new<D: Depth>(weights: &Weights, shape: &impl Shape<Varying = V>) -> Option<Self> {
        Some(Values {
            depth: if D::ENABLED {
                weights.slope([0, 1, 2].map(|i| shape.depth(i)))
            } else {
                Slope::default()
            },
            slopes: V::Slopes::new(weights, [0, 1, 2].map(|i| shape.varying(i)))?,
        })
    }

    #[inline(never)]
    fn paint<C, D, F>(&self, color: &mut C, depth: &mut D, small: &Small, rows: &Rows, fragment: &F)
    where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let rows = rows.get(small.first..small.end).unwrap_or_default();
        for (row, &[a, b]) in (small.top + small.first as i32..).zip(rows) {
            let (left, right) = (small.left + a.min(b) as i32, small.left + a.max(b) as i32);
            let span = Span {
                row,
                left,
                right,
                whole_left: left,
                whole_right: right,
            };
            if left >= right {
                continue;
            }
            let pixels = color.span(span.row, left, right);
            if pixels.is_empty() || !D::ENABLED && fragment.fill(pixels) {
                continue;
            }
            let place = small.weights.place(left, span.row);
            let (mut ramps, depth_ramp) = (self.slopes.ramps(place), self.depth.ramp(place));
            // With the half that rounds to the nearest step, as in larger triangles.
            let mut fine = (depth_ramp.value as u32).wrapping_add(1 << 14);
            for (pixel, cell) in pixels.iter_mut().zip(depth.cells(&span)) {
                if D::test(cell, fine >> 15)
                    && let Some(new) = fragment.shade(self.slopes.values(&ramps), *pixel)
                {
                    *pixel = new;
                }
                fine = fine.wrapping_add(depth_ramp.step as u32);
                V::advance(&mut ramps);
                single(());
            }
        }
    }
}

/// Keeps a loop from being unrolled: no instruction, but one that a compiler takes for a call. Rows have two or three pixels.
#[inline(always)]
fn single(nothing: ()) {
    black_box(nothing);
}

/// A small triangle that covers a sample.
struct Small {
    /// At a sample that is covered: the first, or that of a thin triangle to be drawn.
    weights: Weights,
    /// The row of the first of [`Rows`], and the column that they count from.
    top: i32,
    left: i32,
    /// Which of [`Rows`] to draw.
    first: usize,
    end: usize,
    /// Where the span of a thin triangle's row ends, of which [`Rows`] have one sample.
    right: u8,
    /// Values are set up at every sample.
    thin: bool,
}

impl Small {
    /// `None` where nothing is covered, or the window has nothing of the box; weights only where it `CARRIES` values. Leaves
    /// in `rows` what is covered.
    ///
    /// A function of its own, with what it calls: the same for all that is drawn.
    #[inline(never)]
    fn new<const CARRIES: bool>(corners: &[Point; 3], window: &Window, rows: &mut Rows) -> Option<Self> {
        let [mut a, mut b, mut c] = *corners;
        let (leftmost, rightmost) = (a.0.min(b.0).min(c.0), a.0.max(b.0).max(c.0));
        // From the top.
        if b.1 < a.1 {
            (a, b) = (b, a);
        }
        if c.1 < b.1 {
            (b, c) = (c, b);
            if b.1 < a.1 {
                (a, b) = (b, a);
            }
        }
        let bounds = Window::new(
            leftmost >> SUBPIXEL_BITS,
            first_row(a.1),
            first_row(rightmost),
            first_row(c.1),
        );
        if bounds.top >= bounds.bottom || first_row(leftmost) >= bounds.right {
            return None;
        }
        let middle = first_row(b.1) - bounds.top;
        let mut long = Edge::new(a, c, bounds.left);
        let (upper, lower) = rows.split_at_mut_checked(middle as usize)?;
        long.walk(Edge::new(a, b, bounds.left), upper);
        let lower = lower.get_mut(..(bounds.bottom - bounds.top - middle) as usize)?;
        long.walk(Edge::new(b, c, bounds.left), lower);
        let (first, &[a, b]) = rows.iter().enumerate().find(|(_, [a, b])| a != b)?;
        if bounds.left < window.left
            || bounds.right > window.right
            || bounds.top < window.top
            || bounds.bottom > window.bottom
        {
            let crossed = rows.get_mut(..(bounds.bottom - bounds.top) as usize)?;
            if !cut(crossed, &bounds, window) {
                return None;
            }
        }
        let sample = (bounds.left + a.min(b) as i32, bounds.top + first as i32);
        let weights = if CARRIES {
            Basis::new(corners).weights(sample)
        } else {
            Weights::default()
        };
        Some(Small {
            thin: weights.up() > MOST_UP,
            weights,
            top: bounds.top,
            left: bounds.left,
            first,
            end: (bounds.bottom - bounds.top) as usize,
            right: 0,
        })
    }

    /// To the first sample of a thin triangle, of those that are left; whether there is one.
    #[cold]
    #[inline(never)]
    fn aim(&mut self, corners: &[Point; 3], rows: &mut Rows) -> bool {
        for (row, span) in rows.iter_mut().enumerate().skip(self.first) {
            let [a, b] = *span;
            let (left, right) = (a.min(b), a.max(b));
            if left < right {
                (self.first, self.end) = (row, row + 1);
                self.right = right;
                *span = [left, left + 1];
                let sample = (self.left + left as i32, self.top + row as i32);
                self.weights.move_to(sample, Basis::new(corners).at(sample));
                return true;
            }
        }
        false
    }

    /// To the next sample of a thin triangle; whether there is one.
    #[cold]
    #[inline(never)]
    fn next(&mut self, corners: &[Point; 3], rows: &mut Rows) -> bool {
        if let Some([left, right]) = rows.get_mut(self.first) {
            (*left, *right) = (*right, self.right);
        }
        self.aim(corners, rows)
    }
}

/// Leaves what is on the window; whether there is anything.
#[cold]
#[inline(never)]
fn cut(rows: &mut [[u8; 2]], bounds: &Window, window: &Window) -> bool {
    let mut any = false;
    let column = |column: i32| column.saturating_sub(bounds.left).clamp(0, 255) as u8;
    let (least, most) = (column(window.left), column(window.right));
    for (row, span) in (bounds.top..).zip(rows) {
        let [a, b] = *span;
        let (left, right) = (a.min(b).max(least), a.max(b).min(most));
        let inside = left < right && window.top <= row && row < window.bottom;
        *span = if inside { [left, right] } else { [0; 2] };
        any |= inside;
        single(());
    }
    any
}

/// What makes weights of edge functions.
struct Basis {
    corner: Point,
    /// The other two corners relative to that.
    first: Point,
    second: Point,
    /// 2^61 over the doubled area << `shift`, with the area's sign.
    reciprocal: i32,
    shift: u32,
}

impl Basis {
    /// Of a triangle with an area.
    #[inline(always)]
    fn new(&[a, b, c]: &[Point; 3]) -> Self {
        let (first, second) = ((b.0 - a.0, b.1 - a.1), (c.0 - a.0, c.1 - a.1));
        let area = first.0 * second.1 - first.1 * second.0;
        let zeros = area.unsigned_abs().leading_zeros();
        let reciprocal = near_reciprocal(area.unsigned_abs() << zeros);
        Basis {
            corner: a,
            first,
            second,
            reciprocal: if area < 0 { -reciprocal } else { reciprocal },
            shift: zeros - 1,
        }
    }

    /// The weights of the second and third corner at a covered sample, negated, in units of 2^-29.
    #[inline(always)]
    fn at(&self, (x, y): (i32, i32)) -> (i32, i32) {
        let x = (x << SUBPIXEL_BITS) - self.corner.0;
        let y = (y << SUBPIXEL_BITS) - self.corner.1;
        // At most the area, as the sample is covered: shifted at most 2^31 − 1.
        let weight = |edge: i32| high(edge << self.shift, self.reciprocal);
        (
            weight(y * self.second.0 - x * self.second.1),
            weight(x * self.first.1 - y * self.first.0),
        )
    }

    /// At a covered sample, with their steps.
    #[inline(always)]
    fn weights(&self, sample: (i32, i32)) -> Weights {
        let Basis { first, second, .. } = self;
        // Bits of the longest side, its sign among them: what is set in x ^ x >> 31 are the bits of x or of its complement.
        let bits = |side: i32| side ^ side >> 31;
        let sides = bits(first.0) | bits(first.1) | bits(second.0) | bits(second.1);
        // Weights per pixel are 2^(8 + 32 − up) · side / area = (side << shift) · reciprocal >> 32, with the largest shift
        // that leaves 31 bits.
        let shift = (self.shift + 11).min(sides.leading_zeros() - 1);
        let weight = |side: i32| high(side << shift, self.reciprocal);
        Weights::at_sample(
            sample,
            self.at(sample),
            (weight(second.1), -weight(first.1)),
            (-weight(second.0), weight(first.0)),
            self.shift + 11 - shift,
        )
    }
}

/// As [`Edge`](crate::edge::Edge), for sides that fit half a word, without rows to skip.
struct Edge {
    column: i32,
    remainder: i32,
    step: i32,
    remainder_step: i32,
    dy: i32,
}

impl Edge {
    /// At the first row at or below `from`, columns counted from `origin`.
    ///
    /// Remainders are kept in 2^-8 of what they are there, rounded down: all that is added to them are whole numbers of that,
    /// and the sign of the floor is the sign.
    #[inline(always)]
    fn new(from: Point, to: Point, origin: i32) -> Self {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let above = -from.1 & (SUBPIXELS - 1);
        let (step, rest) = dx.div_rem_floor(dy);
        let start = from.0 + step * above;
        let mut edge = Edge {
            column: (start >> SUBPIXEL_BITS) - origin,
            remainder: -((start & (SUBPIXELS - 1)) * dy + rest * above) >> SUBPIXEL_BITS,
            step,
            remainder_step: rest,
            dy,
        };
        edge.carry();
        edge.carry();
        edge
    }

    #[inline(always)]
    fn carry(&mut self) {
        let below = self.remainder >> 31;
        self.column -= below;
        self.remainder += self.dy & below;
    }

    /// First columns at or right of this edge and of another, as far down as there are `rows`.
    #[inline(always)]
    fn walk(&mut self, mut other: Edge, rows: &mut [[u8; 2]]) {
        for row in rows {
            *row = [self.column as u8, other.column as u8];
            self.descend();
            other.descend();
            single(());
        }
    }

    /// One row down.
    #[inline(always)]
    fn descend(&mut self) {
        self.column += self.step;
        self.remainder -= self.remainder_step;
        self.carry();
    }
}
