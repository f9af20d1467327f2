//! Values in perspective, by reciprocals from a table.

use core::hint::black_box;
use core::mem;

use super::perspective32::sign;
use super::{Perspective, Perspective32, Perspective32Ramps, Varying, each, each_pixel};
use crate::fragment::Fragment;
use crate::gradient::{Basis, Place, Plane, Ramp};
use crate::slope::{Slope, Slopes, Weights};
use crate::span::Span;

/// As [`Perspective32`], to within an error that is accepted: `BOUND`, in units of 2^-8 texel where values are in units of
/// 2^-16 texel. For cores that do not divide.
///
/// A reciprocal from a table of 2 KiB at every pixel; but where subspans of 32 pixels are within the bound, a row's values are
/// linear between their ends. Where all of a triangle is within the bound without perspective nothing is divided: then this is
/// [`Linear32`](super::Linear32). That is so wherever w is the same at its corners.
///
/// **Where there are subspans.** Let value/w and Q = 1/w rise by U′ and Q′ from pixel to pixel. Between two ends S pixels apart
/// a linear value v is off by at most |Δv|·|√ρ − 1|/(√ρ + 1), with ρ = Q₁/Q₀; with |Δv| = K·S/(Q₀·Q₁), where
/// K = |U′·Q − U·Q′| does not change along a row, that is at most K·|Q′|·S²/(4·Q³) with the lesser Q. K is linear over the
/// triangle, so largest at a corner. A row has subspans where for S = 32 that is below the bound at both of its ends and as far
/// beyond its right one as its last subspan reaches. Over the whole triangle v is within |Δv|·(√ρ − 1)/(√ρ + 1) of linear,
/// with Δv and ρ over the corners. Subspans are counted from the first pixel of the whole row, so that a strip or tile has the
/// bits of the whole picture.
///
/// **Error**: `BOUND`, and with ρ the largest 1/w of the polygon over that of the pixel 2^-12·(1 + 2½·ρ + ρ²/64) of the largest
/// value, that of slopes as for [`Perspective32`], and 64 units (`tests/subspans.rs`). Triangles with a ρ of 16 or more or
/// with values of 2^26 units and more, and clipped polygons, divide at every pixel.
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

/// Subspans are of 2^5 pixels.
const LENGTH: u32 = 5;
/// Rows of less pixels take reciprocals.
const WORTHWHILE: i32 = 16;

/// The slopes of a [`PerspectiveSpans`].
#[derive(Debug, Clone, Copy)]
pub struct SpansSlopes<const N: usize> {
    over_w: [Slope; N],
    inverse: Slope,
    way: Way,
}

/// How a triangle's spans are drawn.
#[derive(Debug, Clone, Copy)]
enum Way {
    /// Nothing is divided: `over_w` are the values.
    Linear,
    /// By [`at_pixel`], which tells what is cut off value/w: `over_w` are in 2^-16 of what is left, 1/w in 2^-31.
    Pixels(u32),
    /// The same, but in subspans where 1/w at both ends of a row is at least the second number.
    Rows(u32, u32),
    /// As [`Perspective32`] is: where 1/w varies by 16 or more, or not all of them have the same sign.
    Divided,
}

impl<const N: usize> SpansSlopes<N> {
    /// A function of its own: the same for all that is drawn.
    #[inline(never)]
    fn set_up(weights: &Weights, corners: &[Perspective<N>; 3], bound: Bound) -> Self {
        let [a, b, c] = corners;
        let sign = sign([a.inverse, b.inverse, c.inverse]);
        let turned;
        let corners = if sign == 0 {
            corners
        } else {
            turned = [a.turned(sign), b.turned(sign), c.turned(sign)];
            &turned
        };
        let [a, b, c] = corners;
        let inverses = [a.inverse, b.inverse, c.inverse];
        let (least, most) = inverses
            .iter()
            .fold((i32::MAX, i32::MIN), |(least, most), &v| (v.min(least), v.max(most)));
        if bound.allows_linear(least, most, widest(corners)) {
            return SpansSlopes {
                over_w: through(weights, [&a.values, &b.values, &c.values]),
                inverse: Slope::default(),
                way: Way::Linear,
            };
        }
        // Some more than 1/16, so that its reciprocal in 2^-12 stays below 2^16.
        let cut = if least < (1 << 26) + (1 << 20) {
            None
        } else {
            cut(corners)
        };
        let Some(cut) = cut else {
            return SpansSlopes {
                over_w: through(weights, [&a.over_w, &b.over_w, &c.over_w]),
                inverse: weights.slope(inverses),
                way: Way::Divided,
            };
        };
        let mut inverse = weights.slope(inverses);
        // Below 1 at every pixel, roundings and all, for what looks up its first bits.
        inverse.value = inverse.value.wrapping_sub(1 << 12);
        // At a corner of value v is K = Q·(U′ − v·Q′).
        let over_w = through(weights, [&a.over_w, &b.over_w, &c.over_w]);
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
        let enough = bound.least_inverse(bend, inverse.x.unsigned_abs());
        SpansSlopes {
            over_w: each(&over_w, |slope| slope.shifted(16 - cut)),
            inverse: inverse.shifted(1),
            way: if enough > most as u32 {
                Way::Pixels(cut)
            } else {
                Way::Rows(cut, enough << 1)
            },
        }
    }

    /// A reciprocal at every pixel.
    ///
    /// A function of its own: other loops beside this one would take its registers.
    #[inline(never)]
    fn at_pixels<F>(&self, span: &Span, cut: u32, pixels: &mut [F::Pixel], fragment: &F)
    where
        F: Fragment<Varying: Varying<Values = [i32; N]>>,
    {
        let ramps = self.ramps((span.left, span.row));
        // Loaded rather than put together again at every pixel.
        let table = black_box(&RECIPROCALS);
        let values = |ramps: &_| at_pixel(ramps, cut, table);
        each_pixel(ramps, values, Perspective32Ramps::advance, pixels, fragment);
    }

    /// In any way.
    #[inline(never)]
    fn draw_others<F>(&self, span: &Span, pixels: &mut [F::Pixel], fragment: &F)
    where
        F: Fragment<Varying: Varying<Values = [i32; N]>>,
    {
        match self.way {
            Way::Linear => linear(self.ramps((span.left, span.row)).over_w, pixels, fragment),
            Way::Divided => {
                let ramps = self.ramps((span.left, span.row));
                each_pixel(
                    ramps,
                    Perspective32Ramps::values,
                    Perspective32Ramps::advance,
                    pixels,
                    fragment,
                );
            }
            Way::Pixels(cut) => self.at_pixels(span, cut, pixels, fragment),
            Way::Rows(cut, enough) => {
                let width = span.whole_right.wrapping_sub(span.whole_left);
                let first = self.inverse.ramp((span.whole_left, span.row));
                // The last pixel: the last subspan reaches less than its length beyond it.
                let last = first.after(width.wrapping_sub(1));
                // Where a row is that wide, no step from pixel to pixel has left its word.
                if width < WORTHWHILE || (first.value as u32).min(last.value as u32) < enough {
                    self.at_pixels(span, cut, pixels, fragment);
                } else {
                    self.subspans(span, cut, pixels, fragment);
                }
            }
        }
    }

    /// In subspans.
    #[inline(never)]
    fn subspans<F>(&self, span: &Span, cut: u32, mut pixels: &mut [F::Pixel], fragment: &F)
    where
        F: Fragment<Varying: Varying<Values = [i32; N]>>,
    {
        // From the first pixel of the whole row on, so that a window has the bits of the whole picture.
        let skipped = span.left.wrapping_sub(span.whole_left);
        let first = skipped >> LENGTH << LENGTH;
        let mut ends = self.ramps((span.whole_left.wrapping_add(first), span.row));
        let mut before = skipped - first;
        let mut from = at_end(&ends, cut);
        while !pixels.is_empty() {
            ends = ends.after(1 << LENGTH);
            let to = at_end(&ends, cut);
            let mut ramps = [Ramp::default(); N];
            for (ramp, (&from, &to)) in ramps.iter_mut().zip(from.iter().zip(&to)) {
                let step = to.wrapping_sub(from) >> LENGTH;
                *ramp = Ramp { value: from, step }.after(before);
            }
            let count = pixels.len().min(((1 << LENGTH) - before) as usize);
            let Some((subspan, rest)) = mem::take(&mut pixels).split_at_mut_checked(count) else {
                return;
            };
            linear(ramps, subspan, fragment);
            (from, before, pixels) = (to, 0, rest);
        }
    }

    #[inline(always)]
    fn ramps(&self, place: (i32, i32)) -> Perspective32Ramps<N> {
        Perspective32Ramps {
            over_w: each(&self.over_w, |slope| slope.ramp(place)),
            inverse: self.inverse.ramp(place),
        }
    }
}

/// Without a division.
#[inline(always)]
fn linear<F, const N: usize>(ramps: [Ramp<i32>; N], pixels: &mut [F::Pixel], fragment: &F)
where
    F: Fragment<Varying: Varying<Values = [i32; N]>>,
{
    let advance = |ramps: &mut [Ramp<i32>; N]| ramps.iter_mut().for_each(Ramp::<i32>::advance);
    each_pixel(ramps, |ramps| each(ramps, |ramp| ramp.value), advance, pixels, fragment);
}

/// w in 2^-12, below 2^16, for 1/w in 1/16…1 in units of 2^-31: of the middle of the 1024th that it lies in, so to 2^-11·w of
/// itself and a unit.
#[inline(always)]
fn near(inverse: u32, reciprocals: &[u16; 1024]) -> i32 {
    reciprocals.get((inverse >> 21 & 1023) as usize).copied().unwrap_or(0) as i32
}

/// What [`near`] finds; 1/w below 1/16 is not looked at.
static RECIPROCALS: [u16; 1024] = {
    let mut reciprocals = [u16::MAX; 1024];
    let mut i = 64;
    while i < 1024 {
        // w in 2^-12 is 2^23 over 1/w in 2^-11.
        reciprocals[i] = ((1 << 23) / (2 * i as u32 + 1)) as u16;
        i += 1;
    }
    reciprocals
};

/// Values at a pixel, from value/w in 2^-16 of what is left where `cut` is cut off, and 1/w in 2^-31. 14 bits by 16, and a sign.
///
/// Off by 2^-12·(1 + 2½·ρ + ρ²/64) of the largest value.
#[inline(always)]
fn at_pixel<const N: usize>(ramps: &Perspective32Ramps<N>, cut: u32, reciprocals: &[u16; 1024]) -> [i32; N] {
    let near = near(ramps.inverse.value as u32, reciprocals);
    each(&ramps.over_w, |ramp| {
        (ramp.value >> 16).wrapping_mul(near) >> (12u32.wrapping_sub(cut) & 15)
    })
}

/// The same at the end of a subspan, which may lie where 1/w is up to 2.
#[inline(always)]
fn at_end<const N: usize>(ramps: &Perspective32Ramps<N>, cut: u32) -> [i32; N] {
    let inverse = ramps.inverse.value as u32;
    let half = inverse >> 31;
    let near = near(inverse >> half, &RECIPROCALS);
    each(&ramps.over_w, |ramp| {
        (ramp.value >> 16 >> half).wrapping_mul(near) >> (12u32.wrapping_sub(cut) & 15)
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

    /// The least Q at the ends of a span for which (Q − |Q′|·S)³ ≥ K·|Q′|·S²/(4·bound), in 2^-30: then the bound holds on a last
    /// subspan that reaches beyond the end, too. `bend` is K in units, `rise` |Q′| in 2^-30.
    #[inline(always)]
    fn least_inverse(self, bend: u32, rise: u32) -> u32 {
        let steepness = bend as u64 * rise as u64;
        if steepness >= (self.parts as u64) << 40 {
            // A root of 1 or more, without S.
            return i32::MAX as u32;
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
        const FACTOR: u32 = 10322;
        // In 2^-16: below 2^20 and 2^22. Beyond the end, too, there is a reciprocal.
        let inverse = (root * FACTOR).div_ceil(16).max(1 << 12) + (((rise >> 14) + 1) << LENGTH);
        inverse.min((1 << 17) - 1) << 14
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
        self.ramps(place)
    }
    #[inline(always)]
    fn values(&self, ramps: &Perspective32Ramps<N>) -> [i32; N] {
        match self.way {
            Way::Linear => each(&ramps.over_w, |ramp| ramp.value),
            Way::Pixels(cut) | Way::Rows(cut, _) => at_pixel(ramps, cut, &RECIPROCALS),
            Way::Divided => ramps.values(),
        }
    }
    #[inline(always)]
    fn draw<F>(&self, span: &Span, pixels: &mut [F::Pixel], fragment: &F)
    where
        F: Fragment<Varying = PerspectiveSpans<N, BOUND>>,
    {
        match self.way {
            Way::Pixels(cut) => self.at_pixels(span, cut, pixels, fragment),
            _ => self.draw_others(span, pixels, fragment),
        }
    }
}

impl<const N: usize, const BOUND: u32> Varying for PerspectiveSpans<N, BOUND> {
    type Planes = ([Plane; N], [Plane; 1]);
    type Slopes = SpansSlopes<N>;
    type Ramps = Perspective32Ramps<N>;
    type Values = [i32; N];
    const NO_PLANES: Self::Planes = Perspective32::NO_PLANES;

    #[inline]
    fn lay(planes: &mut Self::Planes, basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) {
        Perspective32::lay(planes, basis, count, |i| Perspective32(corner(i).0));
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
    fn advance_by(ramps: &mut Perspective32Ramps<N>, count: i32) {
        Perspective32::advance_by(ramps, count);
    }
}
