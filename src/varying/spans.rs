//! Values in perspective, divided at the ends of subspans.

use core::mem;
use core::num::NonZeroU32;

use super::{Perspective, Perspective32, Perspective32Ramps, Varying, each};
use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::gradient::{Basis, Place, Plane, Ramp};
use crate::num::short_reciprocal;
use crate::slope::{Slope, Slopes, Weights};
use crate::span::Span;

/// As [`Perspective32`], to within an error that is accepted: `BOUND`, in units of 2^-8 texel where values are in units of
/// 2^-16 texel. For cores that do not divide, and for textures whose texels may be half a texel off.
///
/// A row's values are linear between the ends of subspans, whose length, a power of two, follows from the bound. Where
/// subspans would be shorter than 8 px, a reciprocal from a table, with one Newton step, costs less at every pixel. Where all of
/// a triangle is within the bound without perspective nothing is divided: then this is [`Linear32`](super::Linear32). That
/// is so wherever w is the same at its corners.
///
/// **How long subspans are.** Let value/w and Q = 1/w rise by U′ and Q′ from pixel to pixel. Between two ends S pixels apart a
/// linear value v is off by at most |Δv|·|√ρ − 1|/(√ρ + 1), with ρ = Q₁/Q₀; with |Δv| = K·S/(Q₀·Q₁), where
/// K = |U′·Q − U·Q′| does not change along a row, that is at most K·|Q′|·S²/(4·Q³) with the lesser Q. K is linear over the
/// triangle, so largest at a corner. A row takes the largest S up to 32 for which that is below the bound at both of its
/// ends and as far beyond its right one as its last subspan reaches. Over the whole triangle v is within
/// |Δv|·(√ρ − 1)/(√ρ + 1) of linear, with Δv and ρ over the corners. Subspans are counted from the first pixel of the whole
/// row, so that a strip or tile has the bits of the whole picture.
///
/// **Error**: `BOUND`, and with ρ the largest 1/w of the polygon over that of the pixel 2^-12·(½ + ¾·ρ + ρ²/64) of the largest
/// value, that of slopes as for [`Perspective32`], and 64 units (`tests/subspans.rs`: 100,000 triangles, of which the worst is
/// 0.42 texel off where half a texel is the bound). So half a texel in all wants a bound of 116 for 64 texels and ρ = 3.
/// Triangles with a ρ of 16 or more, clipped polygons, and pairs with another varying divide at every pixel.
///
/// ```
/// use fixel::varying::{Perspective, PerspectiveSpans};
/// // Within half a texel; u = 100 texels at w = 1.
/// let near = PerspectiveSpans::<1, 128>(Perspective::new([100 << 16], 1 << 30));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PerspectiveSpans<const N: usize, const BOUND: u32>(pub Perspective<N>);

impl<const N: usize, const BOUND: u32> From<Perspective<N>> for PerspectiveSpans<N, BOUND> {
    #[inline]
    fn from(corner: Perspective<N>) -> Self {
        PerspectiveSpans(corner)
    }
}

/// Subspans are of 2^0…2^5 pixels.
const LENGTHS: usize = 5;

/// The slopes of a [`PerspectiveSpans`].
#[derive(Debug, Clone, Copy)]
pub struct SpansSlopes<const N: usize> {
    over_w: [Slope; N],
    inverse: Slope,
    /// The least 1/w, in units of 2^-30, at both ends of spans that are divided into subspans of 2, 4, … 32 pixels.
    least: [i32; LENGTHS],
    way: Way,
}

/// How a triangle's spans are drawn.
#[derive(Debug, Clone, Copy)]
enum Way {
    /// Nothing is divided: `over_w` are the values, and `inverse` is 1.
    Linear,
    /// In subspans, and where they would be short by [`at_pixel`], with what that cuts of value/w.
    Short(u32),
    /// In subspans.
    Long,
    /// As [`Perspective32`] is: where 1/w varies by 16 or more, or not all of them have the same sign.
    EveryPixel,
}

impl<const N: usize> SpansSlopes<N> {
    /// A function of its own: the same for all that is drawn.
    #[inline(never)]
    fn set_up(weights: &Weights, corners: &[Perspective<N>; 3], bound: Bound) -> Self {
        let [a, b, c] = corners;
        let inverses = [a.inverse, b.inverse, c.inverse];
        let (least, most) = inverses
            .iter()
            .fold((i32::MAX, i32::MIN), |(least, most), &v| (v.min(least), v.max(most)));
        if bound.allows_linear(least, most, widest(corners)) {
            return SpansSlopes {
                over_w: through(weights, [&a.values, &b.values, &c.values]),
                inverse: Slope {
                    value: 1 << 30,
                    x: 0,
                    y: 0,
                },
                least: [0; LENGTHS],
                way: Way::Linear,
            };
        }
        let over_w = through(weights, [&a.over_w, &b.over_w, &c.over_w]);
        let mut inverse = weights.slope(inverses);
        // Below 1 at every pixel, roundings and all, for what looks up its first bits.
        inverse.value = inverse.value.wrapping_sub(1 << 12);
        // Some more than 1/16, so that its reciprocal in 2^-12 stays below 2^16.
        if least < (1 << 26) + (1 << 20) {
            return SpansSlopes {
                over_w,
                inverse,
                least: [0; LENGTHS],
                way: Way::EveryPixel,
            };
        }
        // At a corner of value v is K = Q·(U′ − v·Q′).
        let mut bend = 0;
        for corner in corners {
            for (slope, &value) in over_w.iter().zip(&corner.values) {
                let rise = (slope.x as i64 - product(value, inverse.x))
                    .unsigned_abs()
                    .min(i32::MAX as u64);
                let corner_bend = product(rise as i32, corner.inverse).clamp(0, u32::MAX as i64 - 2);
                bend = bend.max(corner_bend as u32 + 2);
            }
        }
        SpansSlopes {
            over_w,
            inverse,
            least: bound.least_inverses(bend, inverse.x.unsigned_abs()),
            way: cut(corners).map_or(Way::Long, Way::Short),
        }
    }

    /// The largest length, as a power of two, for a span of `width` pixels whose 1/w at both ends is at least `low`.
    #[inline(always)]
    fn length(&self, low: i32, width: i32) -> u32 {
        let mut k = 0;
        for &least in &self.least {
            if low < least || (1 << k) >= width {
                break;
            }
            k += 1;
        }
        k
    }

    #[inline(never)]
    #[allow(clippy::too_many_arguments, reason = "state of one loop")]
    fn subspans<D, F>(
        &self,
        place: (i32, i32),
        skipped: i32,
        k: u32,
        cut: Option<u32>,
        mut pixels: &mut [F::Pixel],
        mut cells: D::Cells<'_>,
        depth: Ramp<i32>,
        fragment: &F,
    ) where
        D: Depth,
        F: Fragment<Varying: Varying<Values = [i32; N]>>,
    {
        // From the first pixel of the whole row on, so that a window has the bits of the whole picture.
        let mut inverse = self.inverse.ramp(place);
        let first = skipped >> k << k;
        let mut over_w = each(&self.over_w, |slope| slope.ramp(place).after(first));
        inverse = inverse.after(first);
        let mut before = skipped - first;
        let end = |over_w: &[Ramp<i32>; N], inverse| match cut {
            Some(cut) => at_end(over_w, inverse, cut),
            None => divided(over_w, inverse),
        };
        let mut from = end(&over_w, inverse);
        let mut fine = depth.value as u32;
        while !pixels.is_empty() {
            over_w = each(&over_w, |ramp| ramp.after(1 << k));
            inverse = inverse.after(1 << k);
            let to = end(&over_w, inverse);
            let mut ramps = [Ramp::default(); N];
            for (ramp, (&from, &to)) in ramps.iter_mut().zip(from.iter().zip(&to)) {
                let step = to.wrapping_sub(from) >> k;
                *ramp = Ramp { value: from, step }.after(before);
            }
            let count = pixels.len().min(((1 << k) - before) as usize);
            let Some((subspan, rest)) = mem::take(&mut pixels).split_at_mut_checked(count) else {
                return;
            };
            fine = D::pass(&mut cells, subspan, fine, depth.step as u32, |pixel, passes| {
                if passes && let Some(new) = fragment.shade(each(&ramps, |ramp| ramp.value), *pixel) {
                    *pixel = new;
                }
                ramps.iter_mut().for_each(Ramp::<i32>::advance);
            });
            (from, before, pixels) = (to, 0, rest);
        }
    }

    /// From ramps and what a pixel gets of them.
    #[inline(always)]
    fn each_pixel<D, F, R>(
        mut ramps: R,
        values: impl Fn(&R) -> [i32; N],
        advance: impl Fn(&mut R),
        pixels: &mut [F::Pixel],
        mut cells: D::Cells<'_>,
        depth: Ramp<i32>,
        fragment: &F,
    ) where
        D: Depth,
        F: Fragment<Varying: Varying<Values = [i32; N]>>,
    {
        D::pass(
            &mut cells,
            pixels,
            depth.value as u32,
            depth.step as u32,
            |pixel, passes| {
                if passes && let Some(new) = fragment.shade(values(&ramps), *pixel) {
                    *pixel = new;
                }
                advance(&mut ramps);
            },
        );
    }
}

/// Values at one pixel, modulo 2^32, for 1/w in 1/16…2.
#[inline(always)]
fn divided<const N: usize>(over_w: &[Ramp<i32>; N], inverse: Ramp<i32>) -> [i32; N] {
    // 1/w in 2^-15, its reciprocal in 2^-16, below 2^20. In words of 32 bits: products of 64 are 52 instructions on ARMv6-M.
    let reciprocal = short_reciprocal(NonZeroU32::MIN | (inverse.value as u32) >> 15);
    each(over_w, |ramp| {
        let (high, low) = ((ramp.value >> 16) as u32, ramp.value as u32 >> 4 & 0xfff);
        let low = low.wrapping_mul(reciprocal) >> 12;
        high.wrapping_mul(reciprocal).wrapping_add(low) as i32
    })
}

/// w in 2^-12 for 1/w in 1/16…1, in units of 2^-32, without a division: a seed to 2^-9·ρ of itself, and a Newton step.
#[inline(always)]
fn near(inverse: u32) -> i32 {
    let seed = SEEDS.get((inverse >> 24) as usize).copied().unwrap_or(0) as u32;
    // 2 − seed/w in 2^-27, and as much more as cutting the result takes from it in the middle: 2^-13 of itself.
    let rest = ((1u32 << 28) + (1 << 14)).wrapping_sub((inverse >> 17).wrapping_mul(seed));
    (seed.wrapping_mul(rest >> 12) >> 15) as i32
}

/// Values at a pixel, from value/w in 2^-16 of what is left where `cut` is cut off, and 1/w in 2^-32. 14 bits by 16, and a sign.
///
/// Off by 2^-12·(½ + ¾·ρ + ρ²/64) of the largest value.
#[inline(always)]
fn at_pixel<const N: usize>(ramps: &Perspective32Ramps<N>, cut: u32) -> [i32; N] {
    let near = near(ramps.inverse.value as u32);
    each(&ramps.over_w, |ramp| {
        (ramp.value >> 16).wrapping_mul(near) >> (12u32.wrapping_sub(cut) & 15)
    })
}

/// The same at the end of a subspan, which may lie where 1/w is up to 2, from value/w itself and 1/w in 2^-30.
#[inline(always)]
fn at_end<const N: usize>(over_w: &[Ramp<i32>; N], inverse: Ramp<i32>, cut: u32) -> [i32; N] {
    let half = inverse.value as u32 >> 30 & 1;
    let near = near((inverse.value >> half << 2) as u32);
    each(over_w, |ramp| {
        (ramp.value >> (cut + half)).wrapping_mul(near) >> (12u32.wrapping_sub(cut) & 15)
    })
}

/// By how much value/w is cut to 14 bits; `None` where that is more than 12.
#[inline(always)]
fn cut<const N: usize>(corners: &[Perspective<N>; 3]) -> Option<u32> {
    let mut all = 0;
    for corner in corners {
        for &v in &corner.over_w {
            all |= v.unsigned_abs();
        }
    }
    let bits = 32 - all.leading_zeros();
    (bits <= 26).then(|| bits.saturating_sub(14))
}

/// 1/w in 2^-8 (the middle of each) to w in 2^-12; below 1/16 it is not looked at.
const SEEDS: [u16; 256] = {
    let mut seeds = [u16::MAX; 256];
    let mut i = 16;
    while i < 256 {
        seeds[i] = ((1 << 21) / (2 * i as u32 + 1)) as u16;
        i += 1;
    }
    seeds
};

/// Subspans of 2^3 pixels are cheaper than a reciprocal at every one.
const WORTHWHILE: u32 = 3;

/// The product in units of 2^-30, rounded down.
#[inline(always)]
fn product(a: i32, b: i32) -> i64 {
    (a as i64 * b as i64) >> 30
}

#[inline(always)]
fn through<const N: usize>(weights: &Weights, [a, b, c]: [&[i32; N]; 3]) -> [Slope; N] {
    let mut slopes = [Slope::default(); N];
    for (slope, ((&a, &b), &c)) in slopes.iter_mut().zip(a.iter().zip(b).zip(c)) {
        *slope = weights.slope([a, b, c]);
    }
    slopes
}

/// By how much values differ at the corners, that which does most.
#[inline(always)]
fn widest<const N: usize>(corners: &[Perspective<N>; 3]) -> u32 {
    let [a, b, c] = corners;
    let mut widest = 0;
    for ((&a, &b), &c) in a.values.iter().zip(&b.values).zip(&c.values) {
        widest = widest.max(a.max(b).max(c).abs_diff(a.min(b).min(c)));
    }
    widest
}

/// The accepted error.
#[derive(Debug, Clone, Copy)]
struct Bound {
    /// In 2^-8 texel.
    parts: u32,
    /// 2^24 / `parts`, rounded up.
    reciprocal: u32,
}

impl Bound {
    const fn new(parts: u32) -> Self {
        assert!(parts > 0 && parts <= 1 << 22, "a bound of 1 to 2^22");
        Bound {
            parts,
            reciprocal: (1u32 << 24).div_ceil(parts),
        }
    }

    /// Whether values that differ by up to `widest` at the corners, with 1/w of `least` to `most`, are within the bound of
    /// linear over the triangle.
    #[inline(always)]
    fn allows_linear(self, least: i32, most: i32, widest: u32) -> bool {
        // (√ρ − 1)/(√ρ + 1) = (ρ − 1)/(√ρ + 1)² ≤ (ρ − 1)/4 = (most − least)/(4·least); the bound is 2^8 units a part.
        let bend = most.abs_diff(least) as u64 * widest as u64;
        bend == 0 || least > 0 && bend <= (self.parts as u64 * least as u64) << 10
    }

    /// For each length S the least Q at the ends of a span for which (Q − |Q′|·S)³ ≥ K·|Q′|·S²/(4·bound): then the bound holds
    /// on a last subspan that reaches beyond the end, too. `bend` is K in units, `rise` |Q′| in 2^-30.
    #[inline(always)]
    fn least_inverses(self, bend: u32, rise: u32) -> [i32; LENGTHS] {
        let steepness = bend as u64 * rise as u64;
        if steepness >= (self.parts as u64) << 40 {
            // A root of 1 or more for the shortest.
            return [i32::MAX; LENGTHS];
        }
        // In 2^-30: below 2^32 · 2^8, times 2^24, over 2^26.
        let cube = (((steepness >> 8) * self.reciprocal as u64) >> 26) as u32 + 2;
        // In 2^-10, from above.
        let mut root = 0;
        for bit in (0..10).rev() {
            let larger = root | 1 << bit;
            if larger * larger * larger < cube {
                root = larger;
            }
        }
        root += 1;
        // S^(2/3) in 2^-10, rounded up.
        const FACTORS: [u32; LENGTHS] = [1626, 2581, 4096, 6503, 10322];
        let mut least = [0; LENGTHS];
        for (k, (least, factor)) in (1..).zip(least.iter_mut().zip(FACTORS)) {
            // In 2^-16: below 2^20 and 2^22.
            let inverse = (root * factor).div_ceil(16) + (((rise >> 14) + 1) << k);
            *least = (inverse.min((1 << 17) - 1) << 14) as i32;
        }
        least
    }
}

impl<const N: usize, const BOUND: u32> Slopes<PerspectiveSpans<N, BOUND>> for SpansSlopes<N> {
    const DRAWS: bool = true;

    #[inline(always)]
    fn new(weights: &Weights, corners: [PerspectiveSpans<N, BOUND>; 3]) -> Option<Self> {
        let corners = corners.map(|corner| corner.0);
        Some(Self::set_up(weights, &corners, const { Bound::new(BOUND) }))
    }
    #[inline(always)]
    fn ramps(&self, place: (i32, i32)) -> Perspective32Ramps<N> {
        Perspective32Ramps {
            over_w: each(&self.over_w, |slope| slope.ramp(place)),
            inverse: self.inverse.ramp(place),
        }
    }
    #[inline(always)]
    fn values(&self, ramps: &Perspective32Ramps<N>) -> [i32; N] {
        match self.way {
            Way::Linear => each(&ramps.over_w, |ramp| ramp.value),
            _ => ramps.values(),
        }
    }
    /// A function of its own: inlined, what the rows need takes the registers.
    #[inline(never)]
    fn draw<D, F>(
        &self,
        weights: &Weights,
        span: &Span,
        pixels: &mut [F::Pixel],
        cells: D::Cells<'_>,
        depth: Ramp<i32>,
        fragment: &F,
    ) where
        D: Depth,
        F: Fragment<Varying = PerspectiveSpans<N, BOUND>>,
    {
        let place = weights.place(span.left, span.row);
        let ramps = Slopes::<PerspectiveSpans<N, BOUND>>::ramps(self, place);
        let advance = PerspectiveSpans::<N, BOUND>::advance;
        let cut = match self.way {
            Way::Linear => {
                let values = |ramps: &Perspective32Ramps<N>| each(&ramps.over_w, |ramp| ramp.value);
                return Self::each_pixel::<D, F, _>(ramps, values, advance, pixels, cells, depth, fragment);
            }
            Way::EveryPixel => {
                return Self::each_pixel::<D, F, _>(
                    ramps,
                    Perspective32Ramps::values,
                    advance,
                    pixels,
                    cells,
                    depth,
                    fragment,
                );
            }
            Way::Short(cut) => Some(cut),
            Way::Long => None,
        };
        let whole = weights.place(span.whole_left, span.row);
        let width = span.whole_right - span.whole_left;
        let inverse = self.inverse.ramp(whole);
        // At the last pixel: the last subspan reaches less than its length beyond it.
        let last = inverse.after(width - 1).value;
        let k = self.length(inverse.value.min(last), width);
        if let Some(cut) = cut
            && k < WORTHWHILE
        {
            let scaled = |ramp: &Ramp<i32>, up: u32| Ramp {
                value: ramp.value.wrapping_shl(up),
                step: ramp.step.wrapping_shl(up),
            };
            let ramps = Perspective32Ramps {
                over_w: each(&ramps.over_w, |ramp| scaled(ramp, 16 - cut)),
                inverse: scaled(&ramps.inverse, 2),
            };
            let values = |ramps: &Perspective32Ramps<N>| at_pixel(ramps, cut);
            return Self::each_pixel::<D, F, _>(ramps, values, advance, pixels, cells, depth, fragment);
        }
        let skipped = span.left - span.whole_left;
        self.subspans::<D, F>(whole, skipped, k, cut, pixels, cells, depth, fragment);
    }
}

impl<const N: usize, const BOUND: u32> Varying for PerspectiveSpans<N, BOUND> {
    type Planes = ([Plane; N], [Plane; 1]);
    type Slopes = SpansSlopes<N>;
    type Ramps = Perspective32Ramps<N>;
    type Values = [i32; N];

    #[inline]
    fn planes(basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) -> Self::Planes {
        Perspective32::planes(basis, count, |i| Perspective32(corner(i).0))
    }
    #[inline]
    fn ramps(planes: &Self::Planes, place: &Place) -> Perspective32Ramps<N> {
        Perspective32::ramps(planes, place)
    }
    #[inline(always)]
    fn values(planes: &Self::Planes, ramps: &Perspective32Ramps<N>) -> [i32; N] {
        Perspective32::values(planes, ramps)
    }
    #[inline(always)]
    fn advance(ramps: &mut Perspective32Ramps<N>) {
        Perspective32::advance(ramps);
    }
    #[inline(always)]
    fn after(ramps: &Perspective32Ramps<N>, count: i32) -> Perspective32Ramps<N> {
        Perspective32::after(ramps, count)
    }
}
