//! What lights add up to, at either width.

use core::marker::PhantomData;

use super::{accumulate, times};
use crate::num::Precision;

/// Σ color · share for the three channels, of diffuse light or of highlights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sums<P> {
    /// Where [`Precision::LONG`]: in units of 2^-30 of full. A light adds less than 2^45.1, so that 2^16 of them stay below
    /// 2^61.1.
    long: [i64; 3],
    /// Else: parts of colours of 15 bits times shares of 15 bits.
    short: [i32; 3],
    precision: PhantomData<P>,
}

impl<P> Default for Sums<P> {
    #[inline(always)]
    fn default() -> Self {
        Sums {
            long: [0; 3],
            short: [0; 3],
            precision: PhantomData,
        }
    }
}

impl<P: Precision> Sums<P> {
    /// A light's part: `color` in units of 2^-16 of full, `share` in units of 2^-30. What short sums cut colours by is `cut`.
    #[inline(always)]
    pub(super) fn add(&mut self, color: [i32; 3], share: i32, cut: u32) {
        if P::LONG {
            accumulate(&mut self.long, color, share);
            return;
        }
        let share = share_15(share);
        for (sum, c) in self.short.iter_mut().zip(color) {
            *sum = sum.saturating_add((c >> cut) * share);
        }
    }

    /// The light on what has this colour, any, in the unit of that.
    #[inline(always)]
    pub(super) fn on(&self, color: [i32; 3], cut: u32) -> [i64; 3] {
        let mut lit = [0; 3];
        if P::LONG {
            for (lit, (&sum, color)) in lit.iter_mut().zip(self.long.iter().zip(color)) {
                *lit = times(sum, color);
            }
        } else {
            for (lit, (&sum, color)) in lit.iter_mut().zip(self.short.iter().zip(color)) {
                *lit = i64::from(part_16(color, light_15(sum))) << cut;
            }
        }
        lit
    }

    /// Short sums as [`on`](Self::on) has them, but for the `cut` that is to be undone: at most 2^30.
    #[inline(always)]
    pub(super) fn parts_on(&self, color: [i32; 3]) -> [i32; 3] {
        let mut parts = [0; 3];
        for (part, (&sum, color)) in parts.iter_mut().zip(self.short.iter().zip(color)) {
            *part = part_16(color, light_15(sum));
        }
        parts
    }
}

/// `part` · 2^`cut`, saturated.
#[inline(always)]
pub(super) fn uncut(part: i32, cut: u32) -> i32 {
    let shifted = part << cut;
    if shifted >> cut == part {
        shifted
    } else {
        (part >> 31) ^ i32::MAX
    }
}

/// How much the colours of lights of this brightness altogether, in units of 2^-16 of full, are to be cut by, so that they fit 15
/// bits and their sign.
pub(super) fn cut(brightness: u64) -> u32 {
    (49 - brightness.leading_zeros().min(49)).min(31)
}

/// Units of 2^-30 to units of 2^-15, rounded down: −2^16 is left out, so that no product with 15 bits is 2^31.
#[inline(always)]
pub(super) fn share_15(share: i32) -> i32 {
    share.max(-0x7fff_8000) >> 15
}

/// A sum of products of 15 bits with 15 bits as a number of 15 bits; what is brighter, as all the lights.
#[inline(always)]
pub(super) fn light_15(sum: i32) -> i32 {
    (((sum >> 14) + 1) >> 1).clamp(-1 << 15, 1 << 15)
}

/// color · light · 2^-16 for |light| ≤ 2^15, rounded down, in two halves: the first below 2^30, the second below 2^31.
#[inline(always)]
pub(super) fn part_16(color: i32, light: i32) -> i32 {
    (color >> 16) * light + (((color & 0xffff) * light) >> 16)
}
