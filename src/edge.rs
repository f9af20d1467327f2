//! One edge, walked exactly from row to row: the mathematical heart.
//!
//! A row's span runs from the first column at or right of the left edge up to, and without, the first column at or
//! right of the right edge: *ceil, half-open*, which is the top-left rule. The first column at or right of an edge is
//! therefore all that is ever asked, by either neighbour, so that both get the same answer: no gap and no double hit.
//!
//! **The walk.** Let the edge run down from A to B in subpixels (1/256 px), dx = B.x − A.x, dy = B.y − A.y > 0. Its
//! x at row y, in pixels, is n/d with d = 256·dy and n = A.x·dy + dx·(256·y − A.y). Keep q = ceil(n/d), which is the column
//! itself, and r = q·d − n; a row further n grows by 256·dx, that is q by floor(dx/dy) and −r by 256·(dx mod dy), with a
//! carry when r falls below 0. Then 0 ≤ r < d and q·d − r = n hold at every row, exactly: no drift, ever.
//!
//! **The budget.** With |coordinates| ≤ G pixels: |dx|, dy ≤ 2·256·G. The first row lies p < 256 subpixels below A. With
//! dx = s·dy + m, 0 ≤ m < dy, and A.x + s·p = 256·i + f, 0 ≤ f < 256, its n is i·d + f·dy + m·p: one division does for
//! start and step, |s·p| < 2·256·256·G, and f·dy + m·p < 2·d ≤ 2·256·(512·G). For `i32` and G = 4096 that is 2^30; for
//! `i64` and G = 32768 there is room to spare. Rows above the window are skipped by doubling the step, a row for each bit.

use crate::num::Word;

/// Fraction bits of a screen position.
pub const SUBPIXEL_BITS: u32 = 8;
/// Subpixels in a pixel.
pub const SUBPIXELS: i32 = 1 << SUBPIXEL_BITS;

const _: () = {
    let extent = 2 * SUBPIXELS as i64 * <i32 as Word>::GUARD as i64;
    assert!(2 * SUBPIXELS as i64 * extent <= 1 << 30, "the first remainder fits i32");
    assert!(SUBPIXELS as i64 * extent <= 1 << 29, "twice the denominator fits i32");
};

/// The first row whose samples lie at or below `y` (in subpixels, up to 2^31 − 256; beyond it wraps): ceil.
#[inline(always)]
pub fn first_row(y: i32) -> i32 {
    y.wrapping_add(SUBPIXELS - 1) >> SUBPIXEL_BITS
}

/// An edge at one row; see the [module](self).
#[derive(Debug, Clone, Copy, Default)]
pub struct Edge<W> {
    column: W,
    /// −1 − r: a row further it passes 0 where the column has to go one on, which is the carry of the addition.
    complement: W,
    step: W,
    remainder_step: W,
    denominator: W,
}

impl<W: Word> Edge<W> {
    /// The edge from `from` down to `to` at `row`, a row that it crosses: from.y ≤ 256·row < to.y.
    ///
    /// Positions are (x, y) in subpixels within ±[`Word::GUARD`] pixels.
    ///
    /// ```
    /// use fixel::edge::Edge;
    /// // From (0, 0) to (2, 4) px: x is 0, ½, 1, 1½ at rows 0 to 3.
    /// let mut edge = Edge::<i32>::new((0, 0), (512, 1024), 0);
    /// let columns = [(); 4].map(|()| {
    ///     let column = edge.column();
    ///     edge.descend();
    ///     column
    /// });
    /// assert_eq!(columns, [0, 1, 1, 2]);
    /// ```
    #[inline]
    pub fn new(from: (i32, i32), to: (i32, i32), row: i32) -> Self {
        let dx = W::from_i32(to.0 - from.0);
        let dy = W::from_i32(to.1 - from.1);
        let first = first_row(from.1);
        let prestep = W::from_i32((first << SUBPIXEL_BITS) - from.1);
        let denominator = dy << SUBPIXEL_BITS;
        let (step, rest) = dx.div_rem_floor(dy);
        let start = W::from_i32(from.0) + step * prestep;
        let whole = start >> SUBPIXEL_BITS;
        // In 0…2d−1 right of `whole`: its ceil is 0, 1 or 2 columns on.
        let fraction = start - (whole << SUBPIXEL_BITS);
        let (mut column, mut remainder) = (whole, -(fraction * dy + rest * prestep));
        for _ in 0..2 {
            // By masks: fewer instructions than by conditions.
            let below = remainder.sign();
            column = column - below;
            remainder = remainder + (denominator & below);
        }
        let mut edge = Edge {
            column,
            complement: -W::ONE - remainder,
            step,
            remainder_step: rest << SUBPIXEL_BITS,
            denominator,
        };
        if row > first {
            edge.skip(row - first);
        }
        edge
    }

    /// Any edge, to be replaced: words that are all the same, which costs a store each and no call.
    #[inline(always)]
    pub(crate) fn placeholder(word: i32) -> Self {
        let word = W::from_i32(word);
        Edge {
            column: word,
            complement: word,
            step: word,
            remainder_step: word,
            denominator: word,
        }
    }

    /// First column at or right of the edge in this row.
    #[inline(always)]
    pub fn column(&self) -> i32 {
        self.column.low_i32()
    }

    /// The column that the edge is in or at the left side of in this row: floor.
    #[inline(always)]
    pub(crate) fn column_before(&self) -> i32 {
        self.column.low_i32() - (self.complement < -W::ONE) as i32
    }

    /// How far right of [`column_before`](Self::column_before), in 1/(256·dy) px: exact, 0 up to and without a pixel.
    #[inline(always)]
    pub(crate) fn remainder(&self) -> W {
        if self.complement < -W::ONE {
            self.denominator + self.complement + W::ONE
        } else {
            W::ZERO
        }
    }

    /// One row down.
    #[inline(always)]
    pub fn descend(&mut self) {
        let (complement, carry) = self.complement.carrying_add(self.remainder_step);
        self.column = self.column + self.step + W::from_i32(carry as i32);
        // The carry's condition: asked of the sum, so that the addend needs no register.
        self.complement = if complement >= W::ZERO {
            complement - self.denominator
        } else {
            complement
        };
    }

    /// `rows` rows down at once, 1 or more: the bits of their number say of which steps of 1, 2, 4, … rows they are made.
    #[cold]
    #[inline(never)]
    fn skip(&mut self, mut rows: i32) {
        let (step, remainder_step) = (self.step, self.remainder_step);
        loop {
            if rows & 1 != 0 {
                self.descend();
            }
            rows >>= 1;
            if rows == 0 {
                break;
            }
            // No more rows at a step than there are: the step is within the budget as the columns are.
            let rest = self.remainder_step + self.remainder_step - self.denominator;
            self.step = self.step + self.step + W::from_i32((rest >= W::ZERO) as i32);
            self.remainder_step = if rest < W::ZERO { rest + self.denominator } else { rest };
        }
        (self.step, self.remainder_step) = (step, remainder_step);
    }
}
