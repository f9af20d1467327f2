//! Values that are linear over the screen: one plane per polygon, the same bits for every window of the picture.
//!
//! A corner's value is an integer of at most 2^30 either way, in units that its user chooses (a depth in 2^-15 steps, a
//! channel in 2^-16 levels). The plane through the corners of the polygon's largest triangle is kept as the value at one
//! pixel and two steps, in units of 2^-14 of that. Evaluating it is exact integer arithmetic on absolute positions.
//!
//! **Error.** Each step is the exact one cut towards zero, by 2^-14 unit and by 2^-29 of itself (normalised numerator,
//! reciprocal, product). At n_x columns and n_y rows from the anchor that is (n_x + n_y)·2^-14 unit and, in addition,
//! 2^-29·(|step_x|·n_x + |step_y|·n_y), at most 2^-24 of the values' range: where the polygon is so thin that it could be
//! more (its box more than 8 times its doubled area), or so small that a step overflows, the first value of every span is
//! computed from the exact numerator instead, to 2^-29 of the range. Along a span the cut steps add up to no more than
//! (n − 1)·2^-14 unit, or with 32-bit stepping (n − 1) units.
//!
//! **Range.** The first value of a span is clamped so that it *and* the last lie between the least and the largest corner
//! value. The steps being cut towards zero, such a start exists, and so every value of every pixel is one that the polygon
//! could have: nothing wraps, nothing overshoots, slivers included, whatever their gradient.

use crate::edge::{SUBPIXEL_BITS, SUBPIXELS};
use crate::num::reciprocal;
use crate::span::{Corners, Span};

/// Bits below a unit of a corner's value.
pub const EXTRA_BITS: u32 = 14;

/// |steps| are saturated here: a polygon that covers two samples of a row stays below (2^31 per pixel).
const STEP_LIMIT: i64 = 1 << (31 + EXTRA_BITS);

const _: () = {
    // From the anchor to any sample of the polygon are less than 2·GUARD columns and as many rows.
    let reach = 2 * <i64 as crate::num::Word>::GUARD as i64;
    assert!(reach.checked_mul(STEP_LIMIT).is_some() && reach * STEP_LIMIT <= 1 << 61);
};

/// The triangle of a polygon's corners through which its planes are laid: the one of largest area, corner 0 among them.
#[derive(Debug, Clone, Copy)]
pub struct Basis {
    corners: [usize; 3],
    /// Corner 0's pixel and its place in it, in subpixels.
    anchor: (i32, i32),
    fraction: (i32, i32),
    /// The other two corners relative to corner 0, in subpixels.
    first: (i32, i32),
    second: (i32, i32),
    /// Reciprocal of the doubled area: 1/area = reciprocal · 2^-(63 − shift), and the area's sign.
    reciprocal: u32,
    shift: i32,
    negative: bool,
    /// So thin that steps from the anchor would add up their errors: more than 8 boxes to the doubled area.
    thin: bool,
}

impl Basis {
    /// `None` for a polygon without area; corners lie within ±[`Word::GUARD`](crate::num::Word::GUARD) px of 64-bit words.
    #[inline(never)]
    pub fn new(corners: &impl Corners) -> Option<Self> {
        let origin = corners.position(0);
        let from_origin = |i| {
            let (x, y) = corners.position(i);
            (x - origin.0, y - origin.1)
        };
        let (mut area, mut best) = (0i64, 1);
        let mut previous = from_origin(1);
        let (mut first, mut second) = (previous, previous);
        let mut reach = (previous.0.abs(), previous.1.abs());
        for i in 2..corners.count() {
            let next = from_origin(i);
            reach = (reach.0.max(next.0.abs()), reach.1.max(next.1.abs()));
            let doubled = previous.0 as i64 * next.1 as i64 - previous.1 as i64 * next.0 as i64;
            if doubled.unsigned_abs() > area.unsigned_abs() {
                (area, best, first, second) = (doubled, i - 1, previous, next);
            }
            previous = next;
        }
        if area == 0 {
            return None;
        }
        Some(Self::of_triangle(origin, first, second, area, best, reach))
    }

    /// The same code for all kinds of corners.
    #[inline(never)]
    fn of_triangle(
        origin: (i32, i32),
        first: (i32, i32),
        second: (i32, i32),
        area: i64,
        corner: usize,
        reach: (i32, i32),
    ) -> Self {
        // Normalised to 32 bits and rounded up, so that its reciprocal, and with it every step, is never too large.
        let magnitude = area.unsigned_abs();
        let shift = 32 - magnitude.leading_zeros() as i32;
        let divisor = if shift > 0 {
            ((magnitude + ((1u64 << shift) - 1)) >> shift).min(u32::MAX as u64) as u32
        } else {
            (magnitude << -shift) as u32
        };
        // 2^63/divisor is 2^32 for the least divisor only; one less is an error of 2^-32.
        let reciprocal = reciprocal(divisor).min(u32::MAX as u64) as u32;
        Basis {
            corners: [0, corner, corner + 1],
            anchor: (origin.0 >> SUBPIXEL_BITS, origin.1 >> SUBPIXEL_BITS),
            fraction: (origin.0 & (SUBPIXELS - 1), origin.1 & (SUBPIXELS - 1)),
            first,
            second,
            reciprocal,
            shift,
            negative: area < 0,
            thin: reach.0 as i64 * reach.1 as i64 > 8 * magnitude as i64,
        }
    }

    /// Indices of the polygon's corners whose values [`plane`](Self::plane) wants.
    #[inline(always)]
    pub fn corners(&self) -> [usize; 3] {
        self.corners
    }

    /// Which of the three [`corners`](Self::corners) it is.
    #[inline(always)]
    pub(crate) fn place_of(&self, index: usize) -> Option<usize> {
        self.corners.iter().position(|&corner| corner == index)
    }

    /// The plane through `values` at the three [`corners`](Self::corners); `range` holds the least and the largest value
    /// of all corners of the polygon. |values| ≤ 2^30, or all in 0…2^31−1.
    #[inline]
    pub fn plane(&self, values: [i32; 3], range: (i32, i32)) -> Plane {
        let [origin, a, b] = values.map(i64::from);
        let (da, db) = (a - origin, b - origin);
        // |d| < 2^31, positions within 2^25 of each other: below 2^57.
        let numerator_x = da * self.second.1 as i64 - db * self.first.1 as i64;
        let numerator_y = db * self.first.0 as i64 - da * self.second.0 as i64;
        let (step_x, step_y) = (self.step(numerator_x), self.step(numerator_y));
        let value = origin << EXTRA_BITS;
        // Cut towards zero once more: a span of n pixels is off by less than n − 1 units at its end.
        let narrow_step = (step_x / (1 << EXTRA_BITS)).min(i32::MAX as i64) as i32;
        let exact = self.thin || step_x.abs() == STEP_LIMIT || step_y.abs() == STEP_LIMIT;
        let (value, x, y) = if exact {
            (value, numerator_x, numerator_y)
        } else {
            let offset = (step_x * self.fraction.0 as i64 + step_y * self.fraction.1 as i64) >> SUBPIXEL_BITS;
            (value - offset, step_x, step_y)
        };
        Plane {
            value,
            x,
            y,
            narrow_step,
            range,
            exact,
        }
    }

    /// `numerator` / area in units of 2^-14 per pixel, cut towards zero.
    #[inline(never)]
    fn step(&self, numerator: i64) -> i64 {
        let magnitude = numerator.unsigned_abs();
        if magnitude == 0 {
            return 0;
        }
        // numerator = top · 2^-up, 1/area = reciprocal · 2^(−63 − shift); times 256 subpixels, times 2^14.
        let up = magnitude.leading_zeros() as i32 - 32;
        let top = if up >= 0 { magnitude << up } else { magnitude >> -up };
        let product = top * self.reciprocal as u64;
        let down = 63 + self.shift + up - (SUBPIXEL_BITS + EXTRA_BITS) as i32;
        // product ≥ 2^62: with `down` at 16 or less the quotient is 2^46 or more, over the limit.
        let quotient = if down > 63 {
            0
        } else if down < 17 {
            STEP_LIMIT
        } else {
            ((product >> down) as i64).min(STEP_LIMIT)
        };
        if (numerator < 0) != self.negative {
            -quotient
        } else {
            quotient
        }
    }

    /// Where `span` lies to the planes of this basis.
    #[inline(always)]
    pub fn place<'b>(&'b self, span: &Span) -> Place<'b> {
        Place {
            basis: self,
            columns: span.whole_left - self.anchor.0,
            rows: span.row - self.anchor.1,
            steps: span.whole_right - span.whole_left - 1,
            skipped: span.left - span.whole_left,
        }
    }
}

/// A span as the planes of a [`Basis`] see it.
#[derive(Debug, Clone, Copy)]
pub struct Place<'b> {
    basis: &'b Basis,
    /// From the anchor to the first covered sample of the row, on the window or not.
    columns: i32,
    rows: i32,
    /// From there to the last covered one.
    steps: i32,
    /// From there to the first on the window.
    skipped: i32,
}

impl Place<'_> {
    /// The first covered sample of the row, on the window or not, and how many columns right of it the window's first is.
    #[inline(always)]
    pub(crate) fn whole(&self) -> (Self, i32) {
        (Place { skipped: 0, ..*self }, self.skipped)
    }
}

/// A value that is linear over the screen; see the [module](self).
#[derive(Debug, Clone, Copy, Default)]
pub struct Plane {
    /// At the anchor pixel; where `exact`, at corner 0.
    value: i64,
    /// Steps per pixel; where `exact`, steps per subpixel times the doubled area.
    x: i64,
    y: i64,
    /// Step per column in whole units.
    narrow_step: i32,
    range: (i32, i32),
    exact: bool,
}

/// A plane set up in place: [emptied](Self::empty), all corners [held](Self::hold), then [settled](Self::settle). What is held
/// of the basis lies where the plane's numbers come to lie.
impl Plane {
    /// Not set up: all 0.
    pub(crate) const NONE: Self = Plane {
        value: 0,
        x: 0,
        y: 0,
        narrow_step: 0,
        range: (0, 0),
        exact: false,
    };

    /// Of no corners.
    #[inline(always)]
    pub(crate) fn empty(&mut self) {
        self.range = (i32::MAX, i32::MIN);
    }

    /// Least and largest.
    #[inline(always)]
    pub(crate) fn range(&self) -> (i32, i32) {
        self.range
    }

    /// A corner has this value: one of the three of the basis, which [`Basis::place_of`] tells, or another.
    #[inline(always)]
    pub(crate) fn hold(&mut self, place: Option<usize>, value: i32) {
        self.range = (self.range.0.min(value), self.range.1.max(value));
        match place {
            Some(0) => self.value = value as i64,
            Some(1) => self.x = value as i64,
            Some(_) => self.y = value as i64,
            None => {}
        }
    }

    /// The negative of each value.
    #[inline(never)]
    pub(crate) fn negate(&mut self) {
        (self.value, self.x, self.y) = (self.value.wrapping_neg(), self.x.wrapping_neg(), self.y.wrapping_neg());
        self.narrow_step = self.narrow_step.wrapping_neg();
        self.range = (self.range.1.saturating_neg(), self.range.0.saturating_neg());
    }

    /// [`Basis::plane`] of these.
    #[inline(never)]
    pub(crate) fn settle(&mut self, basis: &Basis) {
        let values = [self.value, self.x, self.y].map(|held| held as i32);
        *self = basis.plane(values, self.range);
    }
}

/// A value along a span and its step per column, in the same units.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ramp<V> {
    /// The value at the current column.
    pub value: V,
    /// What the next column adds.
    pub step: V,
}

impl Ramp<i32> {
    /// One column on.
    #[inline(always)]
    pub fn advance(&mut self) {
        // Wrapping: the step after the last pixel may leave the range.
        self.value = self.value.wrapping_add(self.step);
    }

    /// `count` columns on.
    #[inline(always)]
    pub fn after(&self, count: i32) -> Self {
        Ramp {
            value: self.value.wrapping_add(self.step.wrapping_mul(count)),
            step: self.step,
        }
    }
}

impl Ramp<i64> {
    /// One column on.
    #[inline(always)]
    pub fn advance(&mut self) {
        self.value = self.value.wrapping_add(self.step);
    }

    /// `count` columns on.
    #[inline(always)]
    pub fn after(&self, count: i32) -> Self {
        Ramp {
            value: self.value.wrapping_add(self.step.wrapping_mul(count as i64)),
            step: self.step,
        }
    }
}

impl Plane {
    /// At the first column of a span, in units of the corners' values: 32-bit stepping.
    #[inline(never)]
    pub fn ramp(&self, place: &Place) -> Ramp<i32> {
        let (least, most) = self.range;
        let start = saturated(self.at(place) >> EXTRA_BITS);
        let mut step = self.narrow_step;
        let rise = step as i64 * place.steps as i64;
        let span = most.wrapping_sub(least) as u32;
        if rise as i32 as i64 != rise || (rise as i32).unsigned_abs() > span {
            step = steepest(step as i64, place.steps, (span as i64).min(i32::MAX as i64)) as i32;
        }
        // At most the range from here on: 32 bits hold all of it.
        let rise = step * place.steps;
        let start = start.min(most - rise.max(0)).max(least - rise.min(0));
        Ramp {
            value: start + step * place.skipped,
            step,
        }
    }

    /// At the first column of a span, in units of 2^-14 of the corners' values: 64-bit stepping.
    #[inline(never)]
    pub fn fine_ramp(&self, place: &Place) -> Ramp<i64> {
        let (least, most) = ((self.range.0 as i64) << EXTRA_BITS, (self.range.1 as i64) << EXTRA_BITS);
        let mut step = if self.exact { place.basis.step(self.x) } else { self.x };
        let steps = place.steps as i64;
        if (step * steps).abs() > most - least {
            step = steepest(step, place.steps, most - least);
        }
        let rise = step * steps;
        let start = self.at(place).min(most - rise.max(0)).max(least - rise.min(0));
        Ramp {
            value: start + step * place.skipped as i64,
            step,
        }
    }

    /// The plane at the first covered column of the row, on the window or not.
    #[inline(always)]
    fn at(&self, place: &Place) -> i64 {
        if self.exact {
            return self.exactly_at(place);
        }
        self.value + self.x * place.columns as i64 + self.y * place.rows as i64
    }

    #[cold]
    #[inline(never)]
    fn exactly_at(&self, place: &Place) -> i64 {
        let basis = place.basis;
        let dx = place.columns as i64 * SUBPIXELS as i64 - basis.fraction.0 as i64;
        let dy = place.rows as i64 * SUBPIXELS as i64 - basis.fraction.1 as i64;
        // Below 2^57·2^26·2, times 2^32: 116 bits.
        let product = (self.x as i128 * dx as i128 + self.y as i128 * dy as i128) * basis.reciprocal as i128;
        // 1/area = reciprocal·2^-(63 + shift), with the shift between −31 and 20.
        let change = product >> (63 + basis.shift - EXTRA_BITS as i32);
        // Samples of the polygon lie in the range or, by its rounding, next to it: nothing larger is meant.
        const MOST: i128 = 1 << 60;
        let change = change.clamp(-MOST, MOST) as i64;
        if basis.negative {
            self.value - change
        } else {
            self.value + change
        }
    }
}

/// The nearest 32-bit value; one comparison where it is the value itself, which it is but for rounding at the very ends.
#[inline(always)]
fn saturated(value: i64) -> i32 {
    let low = value as i32;
    if low as i64 == value {
        low
    } else if value < 0 {
        i32::MIN
    } else {
        i32::MAX
    }
}

/// Only where a polygon's other corners were rounded off the plane, so that it leaves their range by the rounding.
#[cold]
#[inline(never)]
fn steepest(step: i64, steps: i32, range: i64) -> i64 {
    // Digits of 15 bits, by hand: it would be the only division of 64 bits of a small program. What is left of a digit is less
    // than the steps, of which there are less than 2^17.
    let divisor = steps as u32;
    let (mut quotient, mut rest) = (0i64, 0u32);
    for down in [45, 30, 15, 0] {
        let part = rest << 15 | (range >> down) as u32 & 0x7fff;
        let digit = part.checked_div(divisor).unwrap_or(0);
        quotient = quotient << 15 | digit as i64;
        rest = part.wrapping_sub(digit.wrapping_mul(divisor));
    }
    quotient * step.signum()
}

#[cfg(test)]
mod tests {
    use super::steepest;

    #[test]
    fn the_steepest_step_is_the_quotient() {
        let ends = [
            0,
            1,
            2,
            32766,
            32767,
            32768,
            65535,
            (1 << 31) - 1,
            1 << 45,
            (1 << 46) - 1,
        ];
        for range in ends.into_iter().chain((0..46).map(|bits| (1 << bits) + 12345)) {
            for steps in (1..1 << 17)
                .step_by(997)
                .chain([2, 3, 4096, 65535, 65536, (1 << 17) - 1])
            {
                for step in [-7, 0, 1 << 40] {
                    let expected = range / steps as i64 * i64::signum(step);
                    assert_eq!(steepest(step, steps, range), expected, "{range} / {steps}");
                }
            }
        }
    }
}
