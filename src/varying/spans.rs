//! Values in perspective, by reciprocals from a table.

use core::hint::black_box;

use super::perspective32::sign;
use super::{Perspective, Perspective32, Perspective32Ramps, Varying, each, each_pixel};
use crate::fragment::Fragment;
use crate::gradient::{Basis, Place, Plane, Ramp};
use crate::slope::{Slope, Slopes, Weights};
use crate::span::Span;

/// As [`Perspective32`], to within an error that is accepted: `BOUND`, in units of 2^-8 texel where values are in units of
/// 2^-16 texel. For cores that do not divide.
///
/// A reciprocal from a table of 2 KiB at every pixel; but where all rows of a triangle are within the bound of linear, as those
/// of a floor are, two for a row. Where all of a triangle is within the bound without perspective nothing is divided: then this
/// is [`Linear32`](super::Linear32). That is so wherever w is the same at its corners.
///
/// **Where rows are linear.** Let value/w and Q = 1/w rise by U′ and Q′ from pixel to pixel. Between two places of a row S pixels
/// apart a linear value v is off by at most |Δv|·|√ρ − 1|/(√ρ + 1), with ρ = Q₁/Q₀; with |Δv| = K·S/(Q₀·Q₁), where
/// K = |U′·Q − U·Q′| does not change along a row, that is at most K·|Q′|·S²/(4·Q³) with the lesser Q. K is linear over the
/// triangle, so largest at a corner. S is the least power of two that no row is wider than, and Q the least of the corners less
/// what a row can reach beyond its end, an eighth of it at most: a row is drawn between its first pixel and the one that is the
/// least power of two of pixels beyond it that reaches its last. Over the whole triangle v is within |Δv|·(√ρ − 1)/(√ρ + 1) of
/// linear, with Δv and ρ over the corners. Rows are linear from the first pixel of the whole row on, so that a strip or tile has
/// the bits of the whole picture.
///
/// **Error**: `BOUND`, and with ρ the largest 1/w of the polygon over that of the pixel 2^-12·(1 + 3·ρ + ρ²/48) of the largest
/// value, or of what values differ by or of 64 texels where that is more, that of slopes as for [`Perspective32`], 64 units, and
/// one for each pixel of a row (`tests/subspans.rs`). Where a pixel has its own reciprocal 2½ and 64 are enough in place of 3 and
/// 48, but where a row is linear one end may have a w of 8/7 of the pixel's; and from the row's first pixel, of value −a, to its
/// last, of b, at t ≥ ½ of the way to that end, what is relative to the values there adds up to that of 2·(1 − t)·a + b ≤ a + b.
/// Triangles with a ρ of 16 or more or with values of 2^26 units and more, and clipped polygons, divide at every pixel.
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
    /// By [`at_pixel`]: `over_w` are in 2^-16 of what is left when value/w is cut, 1/w in 2^-31.
    Pixels(Cut),
    /// The same at the ends of rows, of which no two are more than 2^ the second number pixels apart.
    Rows(Cut, u32),
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
        // Some more than 1/16, so that its reciprocal in 2^-11 stays below 2^15.
        let cut = if least < (1 << 26) + (1 << 20) {
            None
        } else {
            Cut::of(corners)
        };
        let Some(cut) = cut else {
            return SpansSlopes {
                over_w: through(weights, [&a.over_w, &b.over_w, &c.over_w]),
                inverse: weights.slope(inverses),
                way: Way::Divided,
            };
        };
        let over_w = through(weights, [&a.over_w, &b.over_w, &c.over_w]);
        let mut inverse = weights.slope(inverses);
        // Below 1 at every pixel, roundings and all, for what looks up its first bits.
        inverse.value = inverse.value.wrapping_sub(1 << 12);
        let length = weights.widest_row();
        let are_linear = bound.allows_rows(
            length,
            bend(&over_w, inverse.x, corners),
            inverse.x.unsigned_abs(),
            least,
        );
        SpansSlopes {
            over_w: each(&over_w, |slope| cut.done(slope)),
            inverse: inverse.shifted(1),
            way: if are_linear {
                Way::Rows(cut, length)
            } else {
                Way::Pixels(cut)
            },
        }
    }

    /// A reciprocal at every pixel.
    #[inline(always)]
    fn at_pixels<F>(&self, span: &Span, cut: Cut, pixels: &mut [F::Pixel], fragment: &F)
    where
        F: Fragment<Varying: Varying<Values = [i32; N]>>,
    {
        match cut {
            Cut::Ten => self.each_by_table::<F, true>(span, pixels, fragment),
            Cut::Twelve => self.each_by_table::<F, false>(span, pixels, fragment),
        }
    }

    /// The same, of values that are cut by ten bits or by twelve.
    ///
    /// A function of its own: other loops beside this one would take its registers. 15 instructions a pixel on Cortex-M4.
    #[inline(never)]
    fn each_by_table<F, const TEN: bool>(&self, span: &Span, pixels: &mut [F::Pixel], fragment: &F)
    where
        F: Fragment<Varying: Varying<Values = [i32; N]>>,
    {
        let ramps = self.ramps((span.left, span.row));
        // Loaded rather than put together again at every pixel.
        let table = black_box(&RECIPROCALS);
        let cut = if TEN { Cut::Ten } else { Cut::Twelve };
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
            Way::Rows(cut, longest) => self.row(span, cut, longest, pixels, fragment),
        }
    }

    /// Linear between the first pixel of a row and the one that is the least power of two beyond it that reaches the last.
    #[inline(never)]
    fn row<F>(&self, span: &Span, cut: Cut, longest: u32, pixels: &mut [F::Pixel], fragment: &F)
    where
        F: Fragment<Varying: Varying<Values = [i32; N]>>,
    {
        // From the first pixel of the whole row on, so that a window has the bits of the whole picture.
        let start = self.ramps((span.whole_left, span.row));
        let from = at_pixel(&start, cut, &RECIPROCALS);
        let last = span.whole_right.wrapping_sub(span.whole_left).wrapping_sub(1).max(1);
        // Seldom more than once or twice, which is less than to count leading zeros where no instruction does.
        let (mut length, mut half) = (longest, 1 << longest >> 1);
        while last <= half {
            (length, half) = (length.wrapping_sub(1), half >> 1);
            black_box(());
        }
        let rises = rises(&start, cut, length);
        let mut ramps = [Ramp::default(); N];
        for (ramp, (&value, &step)) in ramps.iter_mut().zip(from.iter().zip(&rises)) {
            *ramp = Ramp { value, step }.after(span.left.wrapping_sub(span.whole_left));
        }
        linear(ramps, pixels, fragment);
    }

    #[inline(always)]
    fn ramps(&self, place: (i32, i32)) -> Perspective32Ramps<N> {
        Perspective32Ramps {
            over_w: each(&self.over_w, |slope| slope.ramp(place)),
            inverse: self.inverse.ramp(place),
        }
    }
}

/// K at the corner where it is largest: with v the value there Q·(U′ − v·Q′).
#[inline(always)]
fn bend<const N: usize>(over_w: &[Slope; N], inverse_step: i32, corners: &[Perspective<N>; 3]) -> u32 {
    let mut bend = 0;
    for corner in corners {
        for (slope, &value) in over_w.iter().zip(&corner.values) {
            let rise = (slope.x as i64 - product(value, inverse_step))
                .unsigned_abs()
                .min(i32::MAX as u64);
            let corner_bend = product(rise as i32, corner.inverse).clamp(0, u32::MAX as i64 - 2);
            bend = bend.max(corner_bend as u32 + 2);
        }
    }
    bend
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

/// w in 2^-11, below 2^15, for 1/w in 1/16…1 in units of 2^-31: of the middle of the 1024th that it lies in, so to 2^-11·w of
/// itself and half a unit.
#[inline(always)]
fn near(inverse: u32, reciprocals: &[i16; 1024]) -> i32 {
    reciprocals.get((inverse >> 21 & 1023) as usize).copied().unwrap_or(0) as i32
}

/// What [`near`] finds; 1/w below 1/16 is not looked at. Signed, so that a product with the upper half of a word is one
/// instruction.
static RECIPROCALS: [i16; 1024] = {
    let mut reciprocals = [i16::MAX; 1024];
    let mut i = 64;
    while i < 1024 {
        // w in 2^-12 is 2^23 over 1/w in 2^-11.
        reciprocals[i] = (((1 << 23) / (2 * i as u32 + 1) + 1) >> 1) as i16;
        i += 1;
    }
    reciprocals
};

/// Values at a pixel, from value/w in 2^-16 of what is left where `cut` is cut off, and 1/w in 2^-31. 14 bits by 15, and a sign.
///
/// Off by 2^-12·(1 + 2½·ρ + ρ²/64) of the largest value, or of 2^22 where that is more.
#[inline(always)]
fn at_pixel<const N: usize>(ramps: &Perspective32Ramps<N>, cut: Cut, reciprocals: &[i16; 1024]) -> [i32; N] {
    let near = near(ramps.inverse.value as u32, reciprocals);
    each(&ramps.over_w, |ramp| cut.undone(ramp.value >> 16, near))
}

/// What values rise by from pixel to pixel over 2^`length` pixels, less than twice of what the row has: value/w and values
/// are no more there than three times of what they are in the triangle, and 1/w is below 2.
#[inline(always)]
fn rises<const N: usize>(start: &Perspective32Ramps<N>, cut: Cut, length: u32) -> [i32; N] {
    let end = start.inverse.after(1 << length).value as u32;
    let half = end >> 31;
    let (near_start, near_end) = (
        near(start.inverse.value as u32, &RECIPROCALS),
        near(end >> half, &RECIPROCALS),
    );
    each(&start.over_w, |ramp| {
        // In 2^-14 of what is left, so that there is room: below 3·2^28.
        let last = (ramp.value >> 2).wrapping_add((ramp.step >> 2).wrapping_shl(length));
        // Both below 3·2^29, then half of that: the same cut at the start as that pixel has.
        let last = (last >> 14).wrapping_mul(near_end) >> 1 >> half;
        let first = (ramp.value >> 16).wrapping_mul(near_start) >> 1;
        cut.undone_rise(last.wrapping_sub(first), length)
    })
}

/// By how many bits value/w is cut, to 14 or less: two numbers only, so that each has a loop with the shift in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cut {
    /// Values below 2^24: textures of 64 texels and less, repeated up to four times, among them.
    Ten,
    /// Values below 2^26.
    Twelve,
}

impl Cut {
    /// `None` where values are too large.
    #[inline(always)]
    fn of<const N: usize>(corners: &[Perspective<N>; 3]) -> Option<Self> {
        let mut all = 0;
        for corner in corners {
            for &v in &corner.over_w {
                all |= v.unsigned_abs();
            }
        }
        match all {
            0..0x100_0000 => Some(Cut::Ten),
            0x100_0000..0x400_0000 => Some(Cut::Twelve),
            _ => None,
        }
    }

    /// value/w in 2^-16 of what is left, rounded to that where it is cut.
    #[inline(always)]
    fn done(self, slope: &Slope) -> Slope {
        let slope = slope.shifted(match self {
            Cut::Ten => 6,
            Cut::Twelve => 4,
        });
        Slope {
            value: slope.value.wrapping_add(1 << 15),
            ..slope
        }
    }

    /// Per pixel, what half the product of what is left and w in 2^-11 rises by over 2^`length` pixels.
    #[inline(always)]
    fn undone_rise(self, rise: i32, length: u32) -> i32 {
        match self {
            Cut::Ten => rise >> length,
            Cut::Twelve => rise >> length.saturating_sub(2) << 2u32.saturating_sub(length),
        }
    }

    /// A value of what is left of value/w, and w in 2^-11.
    #[inline(always)]
    fn undone(self, over_w: i32, near: i32) -> i32 {
        let product = over_w.wrapping_mul(near);
        match self {
            Cut::Ten => product >> 1,
            Cut::Twelve => product << 1,
        }
    }
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
}

impl Bound {
    const fn new(parts: u32) -> Self {
        assert!(parts > 0 && parts <= 1 << 22, "a bound of 1 to 2^22");
        Bound { parts }
    }

    /// Whether values that differ by up to `widest` at the corners, with 1/w of `least` to `most`, are within the bound of
    /// linear over the triangle.
    #[inline(always)]
    fn allows_linear(self, least: i32, most: i32, widest: u32) -> bool {
        // (√ρ − 1)/(√ρ + 1) = (ρ − 1)/(√ρ + 1)² ≤ (ρ − 1)/4 = (most − least)/(4·least); the bound is 2^8 units a part.
        let bend = most.abs_diff(least) as u64 * widest as u64;
        bend == 0 || least > 0 && bend <= (self.parts as u64 * least as u64) << 10
    }

    /// Whether values are within the bound of linear over 2^`length` pixels of any row, and 1/w is where [`near`] looks it up:
    /// whether (Q − |Q′|·S)³ ≥ K·|Q′|·S²/(4·bound). `bend` is K in units, `rise` |Q′| in 2^-30, `least` Q in 2^-30.
    #[inline(always)]
    fn allows_rows(self, length: u32, bend: u32, rise: u32, least: i32) -> bool {
        let reach = (rise as i64) << length;
        let beyond = (least as i64).wrapping_sub(reach);
        // No further from the camera than 8/7 of what the row is: the error there counts at its pixels.
        if beyond < 1 << 26 || reach > (least >> 3) as i64 {
            return false;
        }
        // In 2^-15, and its cube in 2^-30, rounded down.
        let end = (beyond >> 15) as u32;
        let cube = ((end * end) >> 15) * end;
        // The bound is 2^8 units a part. Below 2^62.
        bend as u64 * rise as u64 <= (self.parts as u64 * cube as u64) << 10 >> (2 * length)
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
        // The usual one by a comparison.
        match self.way {
            Way::Pixels(Cut::Ten) => self.each_by_table::<F, true>(span, pixels, fragment),
            Way::Rows(cut, longest) => self.row(span, cut, longest, pixels, fragment),
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
