//! What a primitive carries from its corners to its pixels: nothing, values linear over the screen, or values in
//! perspective. Chosen by type, so that a draw pays only for what it carries.

use core::convert::Infallible;
use core::num::NonZeroU32;

use crate::gradient::{Basis, EXTRA_BITS, Place, Plane, Ramp};
use crate::num::reciprocal;
use crate::slope::{Slope, Slopes, Weights};

/// A kind of varying: `()`, [`Linear`], [`Perspective`], or a pair of them.
pub trait Varying: Copy + Sized {
    /// What a polygon keeps of it.
    type Planes;
    /// What a triangle of a usual shape and size keeps instead.
    type Slopes: Slopes<Self>;
    /// What a span keeps of it.
    type Ramps;
    /// What a pixel gets.
    type Values: Copy;

    /// Set up once per polygon; `corner(i)` for i in 0…count.
    fn planes(basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) -> Self::Planes;
    /// At the first pixel of a span.
    fn ramps(planes: &Self::Planes, place: &Place) -> Self::Ramps;
    /// At the current pixel.
    fn values(planes: &Self::Planes, ramps: &Self::Ramps) -> Self::Values;
    /// One pixel on.
    fn advance(ramps: &mut Self::Ramps);
    /// `count` pixels on from `ramps`: what as many calls of [`advance`](Self::advance) make of them.
    fn after(ramps: &Self::Ramps, count: i32) -> Self::Ramps;
}

/// Nothing: a flat colour.
impl Varying for () {
    type Planes = ();
    type Slopes = ();
    type Ramps = ();
    type Values = ();

    #[inline(always)]
    fn planes(_: &Basis, _: usize, _: impl Fn(usize) -> Self) {}
    #[inline(always)]
    fn ramps(_: &(), _: &Place) {}
    #[inline(always)]
    fn values(_: &(), _: &()) {}
    #[inline(always)]
    fn advance(_: &mut ()) {}
    #[inline(always)]
    fn after(_: &(), _: i32) {}
}

impl Slopes<()> for () {
    const CARRIES: bool = false;

    #[inline(always)]
    fn new(_: &Weights, _: [(); 3]) -> Option<Self> {
        Some(())
    }
    #[inline(always)]
    fn ramps(&self, _: (i32, i32)) {}
    #[inline(always)]
    fn values(&self, _: &()) {}
}

/// Two kinds side by side, such as colours that are linear over the screen and texture coordinates in perspective.
///
/// ```
/// use fixel::{fragment::Fragment, varying::{Linear, Perspective}};
///
/// /// A grey per corner, darker on every other stripe of the surface.
/// struct Stripes;
///
/// impl Fragment for Stripes {
///     type Varying = (Linear<1>, Perspective<1>);
///     type Pixel = u8;
///     fn shade(&self, ([grey], [u]): ([i32; 1], [i32; 1]), _below: u8) -> Option<u8> {
///         Some((grey >> 16 >> (u >> 16 & 1)) as u8)
///     }
/// }
/// assert_eq!(Stripes.shade(([200 << 16], [3 << 16]), 0), Some(100));
/// ```
impl<A: Varying, B: Varying> Varying for (A, B) {
    type Planes = (A::Planes, B::Planes);
    type Slopes = (A::Slopes, B::Slopes);
    type Ramps = (A::Ramps, B::Ramps);
    type Values = (A::Values, B::Values);

    #[inline]
    fn planes(basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) -> Self::Planes {
        let first = A::planes(basis, count, |i| corner(i).0);
        (first, B::planes(basis, count, |i| corner(i).1))
    }
    #[inline(always)]
    fn ramps(planes: &Self::Planes, place: &Place) -> Self::Ramps {
        (A::ramps(&planes.0, place), B::ramps(&planes.1, place))
    }
    #[inline(always)]
    fn values(planes: &Self::Planes, ramps: &Self::Ramps) -> Self::Values {
        (A::values(&planes.0, &ramps.0), B::values(&planes.1, &ramps.1))
    }
    #[inline(always)]
    fn advance(ramps: &mut Self::Ramps) {
        A::advance(&mut ramps.0);
        B::advance(&mut ramps.1);
    }
    #[inline(always)]
    fn after(ramps: &Self::Ramps, count: i32) -> Self::Ramps {
        (A::after(&ramps.0, count), B::after(&ramps.1, count))
    }
}

impl<A: Varying, B: Varying> Slopes<(A, B)> for (A::Slopes, B::Slopes) {
    const CARRIES: bool = A::Slopes::CARRIES || B::Slopes::CARRIES;

    #[inline(always)]
    fn new(weights: &Weights, corners: [(A, B); 3]) -> Option<Self> {
        let first = A::Slopes::new(weights, corners.map(|corner| corner.0))?;
        Some((first, B::Slopes::new(weights, corners.map(|corner| corner.1))?))
    }
    #[inline(always)]
    fn ramps(&self, place: (i32, i32)) -> (A::Ramps, B::Ramps) {
        (self.0.ramps(place), self.1.ramps(place))
    }
    #[inline(always)]
    fn values(&self, ramps: &(A::Ramps, B::Ramps)) -> (A::Values, B::Values) {
        (self.0.values(&ramps.0), self.1.values(&ramps.1))
    }
}

/// N values linear over the screen, |v| ≤ 2^30 in units of the user's choice.
///
/// Error along a span: one unit per pixel at most (see [`gradient`](mod@crate::gradient)); every value lies in the range
/// of the corners' values.
///
/// ```
/// use fixel::varying::Linear;
/// // Red, green, blue in units of 2^-16 levels of 0…255.
/// let white = Linear([255 << 16; 3]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Linear<const N: usize>(pub [i32; N]);

impl<const N: usize> Varying for Linear<N> {
    type Planes = [Plane; N];
    type Slopes = Infallible;
    type Ramps = [Ramp<i32>; N];
    type Values = [i32; N];

    #[inline]
    fn planes(basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) -> [Plane; N] {
        planes(basis, count, |i| corner(i).0)
    }
    #[inline(always)]
    fn ramps(planes: &[Plane; N], place: &Place) -> [Ramp<i32>; N] {
        each(planes, |plane| plane.ramp(place))
    }
    #[inline(always)]
    fn values(_: &[Plane; N], ramps: &[Ramp<i32>; N]) -> [i32; N] {
        each(ramps, |ramp| ramp.value)
    }
    #[inline(always)]
    fn advance(ramps: &mut [Ramp<i32>; N]) {
        ramps.iter_mut().for_each(Ramp::<i32>::advance);
    }
    #[inline(always)]
    fn after(ramps: &[Ramp<i32>; N], count: i32) -> [Ramp<i32>; N] {
        each(ramps, |ramp| ramp.after(count))
    }
}

/// As [`Linear`], but where user planes cut a triangle in eye space its values are mixed as the position is, *before* the
/// division by w, and the polygon is drawn as a fan, each triangle with its own values (MP1 without `hyp`). Without user
/// planes, or where w is constant, it is the same as [`Linear`].
///
/// A fan's triangles share their diagonals exactly; only where a cut falls within 1/256 px of a corner can a diagonal be turned
/// over by rounding, and a sample on it be drawn twice.
///
/// ```
/// use fixel::varying::LinearFan;
/// let gray = LinearFan([128 << 16]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LinearFan<const N: usize>(pub [i32; N]);

impl<const N: usize> Varying for LinearFan<N> {
    type Planes = [Plane; N];
    type Slopes = Infallible;
    type Ramps = [Ramp<i32>; N];
    type Values = [i32; N];

    #[inline]
    fn planes(basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) -> [Plane; N] {
        planes(basis, count, |i| corner(i).0)
    }
    #[inline(always)]
    fn ramps(planes: &[Plane; N], place: &Place) -> [Ramp<i32>; N] {
        Linear::<N>::ramps(planes, place)
    }
    #[inline(always)]
    fn values(planes: &[Plane; N], ramps: &[Ramp<i32>; N]) -> [i32; N] {
        Linear::<N>::values(planes, ramps)
    }
    #[inline(always)]
    fn advance(ramps: &mut [Ramp<i32>; N]) {
        Linear::<N>::advance(ramps);
    }
    #[inline(always)]
    fn after(ramps: &[Ramp<i32>; N], count: i32) -> [Ramp<i32>; N] {
        Linear::<N>::after(ramps, count)
    }
}

/// A colour for RGB565 targets, linear over the screen: red and blue in units of 2^-16 of 0…31, green of 0…63, each with
/// the half that makes cutting off round to nearest, so within 0.5…31.5 and 0.5…63.5.
/// [`Gouraud565::corner`](crate::fragment::Gouraud565::corner) makes it.
///
/// Two words are stepped for the three channels, which do not touch each other as long as the colours are in range.
///
/// **Error**: at most half a level before rounding, so that a stored channel is within one level of the exact value, on
/// spans of up to 1024 px; on longer ones of polygons beyond the reach of [slopes](mod@crate::slope) 2^-11 level more for
/// every further pixel (`tests/color565.rs`).
///
/// ```
/// use fixel::{fragment::Gouraud565, varying::Color565};
/// assert_eq!(Gouraud565::corner(255, 0, 255), Color565([0x1f_8000, 0x8000, 0x1f_8000]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Color565(pub [i32; 3]);

/// Blue in the upper half, red in the lower, each 5 bits and 11 of fraction; `red` and `blue` in 2^-16.
#[inline(always)]
fn pair(red: i32, blue: i32) -> i32 {
    (blue << 16).wrapping_add(red)
}

/// The slopes of a [`Color565`], in packed words.
#[derive(Debug, Clone, Copy)]
pub struct Color565Slopes {
    pair: Slope,
    green: Slope,
}

/// The ramps of a [`Color565`].
#[derive(Debug, Clone, Copy)]
pub struct Color565Ramps {
    pair: Ramp<i32>,
    green: Ramp<i32>,
}

/// What a pixel gets of a [`Color565`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Packed565 {
    pair: u32,
    green: u32,
}

impl Packed565 {
    /// The nearest RGB565 colour.
    #[inline(always)]
    pub fn pixel(self) -> u16 {
        (self.pair & 0xf800 | self.pair >> 27 | self.green >> 16 << 5) as u16
    }
}

impl Color565Ramps {
    #[inline(always)]
    fn values(&self) -> Packed565 {
        Packed565 {
            pair: self.pair.value as u32,
            green: self.green.value as u32,
        }
    }
}

impl Slopes<Color565> for Color565Slopes {
    #[inline(always)]
    fn new(weights: &Weights, [Color565(a), Color565(b), Color565(c)]: [Color565; 3]) -> Option<Self> {
        let ([ra, ga, ba], [rb, gb, bb], [rc, gc, bc]) = (a, b, c);
        let (red, blue) = (weights.slope([ra, rb, rc]), weights.slope([ba, bb, bc]));
        // To the nearest 2^-11: over 1024 rows and columns a quarter of a level.
        let both = |red: i32, blue: i32| pair((red + 16) >> 5, (blue + 16) >> 5);
        Some(Color565Slopes {
            pair: Slope {
                value: both(red.value, blue.value),
                x: both(red.x, blue.x),
                y: both(red.y, blue.y),
            },
            green: weights.slope([ga, gb, gc]),
        })
    }
    #[inline(always)]
    fn ramps(&self, place: (i32, i32)) -> Color565Ramps {
        Color565Ramps {
            pair: self.pair.ramp(place),
            green: self.green.ramp(place),
        }
    }
    #[inline(always)]
    fn values(&self, ramps: &Color565Ramps) -> Packed565 {
        ramps.values()
    }
}

impl Varying for Color565 {
    type Planes = [Plane; 3];
    type Slopes = Color565Slopes;
    type Ramps = Color565Ramps;
    type Values = Packed565;

    #[inline]
    fn planes(basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) -> [Plane; 3] {
        planes(basis, count, |i| corner(i).0)
    }
    #[inline]
    fn ramps(planes: &[Plane; 3], place: &Place) -> Color565Ramps {
        let (place, skipped) = place.whole();
        // Cut towards zero as the planes' own steps are: the last pixel stays in range like the first.
        let [red, green, blue] = each(planes, |plane| plane.ramp(&place));
        let first = Color565Ramps {
            pair: Ramp {
                value: pair(red.value >> 5, blue.value >> 5),
                step: pair(red.step / 32, blue.step / 32),
            },
            green,
        };
        Self::after(&first, skipped)
    }
    #[inline(always)]
    fn values(_: &[Plane; 3], ramps: &Color565Ramps) -> Packed565 {
        ramps.values()
    }
    #[inline(always)]
    fn advance(ramps: &mut Color565Ramps) {
        ramps.pair.advance();
        ramps.green.advance();
    }
    #[inline(always)]
    fn after(ramps: &Color565Ramps, count: i32) -> Color565Ramps {
        Color565Ramps {
            pair: ramps.pair.after(count),
            green: ramps.green.after(count),
        }
    }
}

/// N values in perspective: each corner carries value/w and 1/w, which are linear over the screen; every pixel divides.
///
/// Where all corners have the same w nothing is divided. With w of one sign the pixel's value lies in the range of the
/// corners' values; with mixed signs 1/w passes through 0 inside the polygon, and the value saturates there.
///
/// **Error**: 1/w and value/w are within 2^-27 of their largest corner value, and value/w is rounded to a unit at the
/// corners. With ρ the largest 1/w of the polygon over that of the pixel, the value is within
/// ρ·(2^-26·largest + 1) + 3 units + 2^-30·|value| (`tests/interpolation.rs`).
///
/// ```
/// use fixel::varying::Perspective;
/// // u = 100 at w = 1 and u = 300 at w = 2; inverse is 1/w in units of 2^-30.
/// let near = Perspective::new([100], 1 << 30);
/// let far = Perspective::new([300], 1 << 29);
/// assert_eq!(far.over_w, [150]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Perspective<const N: usize> {
    /// value · inverse / 2^30.
    pub over_w: [i32; N],
    /// 1/w in units of 2^-30 of any number that makes every corner's |1/w| at most 1, best the polygon's largest.
    pub inverse: i32,
    /// The values themselves, |v| ≤ 2^30: the range of the polygon's pixels. Not looked at where signs of w are mixed.
    pub values: [i32; N],
}

impl<const N: usize> Perspective<N> {
    /// A corner with these values and this 1/w.
    #[inline]
    pub fn new(values: [i32; N], inverse: i32) -> Self {
        let over_w = values.map(|v| ((v as i64 * inverse as i64 + (1 << 29)) >> 30) as i32);
        Perspective {
            over_w,
            inverse,
            values,
        }
    }
}

/// The planes of a [`Perspective`].
#[derive(Debug)]
pub struct PerspectivePlanes<const N: usize> {
    over_w: [Plane; N],
    inverse: Plane,
    /// Least and largest of the corners' values.
    ranges: [(i32, i32); N],
    /// All corners have inverse 1: the values are linear.
    affine: bool,
}

/// The ramps of a [`Perspective`].
#[derive(Debug)]
pub struct PerspectiveRamps<const N: usize> {
    over_w: [Ramp<i64>; N],
    inverse: Ramp<i64>,
}

impl<const N: usize> Varying for Perspective<N> {
    type Planes = PerspectivePlanes<N>;
    type Slopes = Infallible;
    type Ramps = PerspectiveRamps<N>;
    type Values = [i32; N];

    #[inline]
    fn planes(basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) -> PerspectivePlanes<N> {
        let inverses = || (0..count).map(|i| corner(i).inverse);
        let mixed = inverses().any(|v| v > 0) && inverses().any(|v| v < 0);
        let ranges = if mixed {
            [(i32::MIN, i32::MAX); N]
        } else {
            ranges(count, |i| corner(i).values)
        };
        let [inverse] = planes(basis, count, |i| [corner(i).inverse]);
        PerspectivePlanes {
            over_w: planes(basis, count, |i| corner(i).over_w),
            inverse,
            ranges,
            affine: inverses().all(|v| v == 1 << 30),
        }
    }

    #[inline(always)]
    fn ramps(planes: &PerspectivePlanes<N>, place: &Place) -> PerspectiveRamps<N> {
        PerspectiveRamps {
            over_w: each(&planes.over_w, |plane| plane.fine_ramp(place)),
            inverse: planes.inverse.fine_ramp(place),
        }
    }

    #[inline(always)]
    fn values(planes: &PerspectivePlanes<N>, ramps: &PerspectiveRamps<N>) -> [i32; N] {
        if planes.affine {
            return each(&ramps.over_w, |ramp| (ramp.value >> EXTRA_BITS) as i32);
        }
        let divisor = Divisor::new(ramps.inverse.value);
        let mut values = each(&ramps.over_w, |ramp| divisor.divide(ramp.value));
        for (value, (least, most)) in values.iter_mut().zip(&planes.ranges) {
            *value = (*value).max(*least).min(*most);
        }
        values
    }

    #[inline(always)]
    fn advance(ramps: &mut PerspectiveRamps<N>) {
        ramps.over_w.iter_mut().for_each(Ramp::<i64>::advance);
        ramps.inverse.advance();
    }
    #[inline(always)]
    fn after(ramps: &PerspectiveRamps<N>, count: i32) -> PerspectiveRamps<N> {
        PerspectiveRamps {
            over_w: each(&ramps.over_w, |ramp| ramp.after(count)),
            inverse: ramps.inverse.after(count),
        }
    }
}

/// As [`Perspective`], in words of 32 bits: one 32-bit division for the reciprocal of 1/w at every pixel, and a product for
/// each value. For textures of up to some 512 texels a side, and cores that divide.
///
/// Values are not kept in the corners' range, which textures that repeat do not need; next to a pole of 1/w inside the polygon
/// they are anything.
///
/// **Error**, with ρ the largest 1/w of the polygon over that of the pixel: 2^-15·(1.5·ρ + 1) of the largest value, and ρ·2100
/// units where the whole reach of [slopes](mod@crate::slope) is used, ρ·4 for each row and column of smaller triangles
/// (`tests/narrow.rs`). So with values in 2^-16 texel, triangles of up to 100 rows and columns, textures of 64 texels and
/// ρ = 3 it is below 1/32 texel.
///
/// ```
/// use fixel::varying::{Perspective, Perspective32};
/// // u = 100 texels at w = 1, in units of 2^-16.
/// let near = Perspective32(Perspective::new([100 << 16], 1 << 30));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Perspective32<const N: usize>(pub Perspective<N>);

/// The slopes of a [`Perspective32`].
#[derive(Debug, Clone, Copy)]
pub struct Perspective32Slopes<const N: usize> {
    over_w: [Slope; N],
    inverse: Slope,
}

/// The ramps of a [`Perspective32`].
#[derive(Debug, Clone, Copy)]
pub struct Perspective32Ramps<const N: usize> {
    over_w: [Ramp<i32>; N],
    inverse: Ramp<i32>,
}

impl<const N: usize> Perspective32Ramps<N> {
    #[inline(always)]
    fn values(&self) -> [i32; N] {
        // 1/w in 2^-16, at most 1 and not 0; its reciprocal in 2^-16, 1 or more. The product is in 2^-16 of the units of
        // value/w, which are the values'.
        let inverse = NonZeroU32::MIN | (self.inverse.value >> 14) as u32;
        let reciprocal = u32::MAX / inverse;
        each(&self.over_w, |ramp| {
            ((ramp.value as i64 * reciprocal as i64) >> 16) as i32
        })
    }
}

impl<const N: usize> Slopes<Perspective32<N>> for Perspective32Slopes<N> {
    #[inline(always)]
    fn new(weights: &Weights, corners: [Perspective32<N>; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|corner| corner.0);
        let mut over_w = [Slope::default(); N];
        for (slope, ((&a, &b), &c)) in over_w.iter_mut().zip(a.over_w.iter().zip(&b.over_w).zip(&c.over_w)) {
            *slope = weights.slope([a, b, c]);
        }
        Some(Perspective32Slopes {
            over_w,
            inverse: weights.slope([a.inverse, b.inverse, c.inverse]),
        })
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
        ramps.values()
    }
}

impl<const N: usize> Varying for Perspective32<N> {
    type Planes = ([Plane; N], [Plane; 1]);
    type Slopes = Perspective32Slopes<N>;
    type Ramps = Perspective32Ramps<N>;
    type Values = [i32; N];

    #[inline]
    fn planes(basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) -> Self::Planes {
        let over_w = planes(basis, count, |i| corner(i).0.over_w);
        (over_w, planes(basis, count, |i| [corner(i).0.inverse]))
    }
    #[inline]
    fn ramps((over_w, [inverse]): &Self::Planes, place: &Place) -> Perspective32Ramps<N> {
        Perspective32Ramps {
            over_w: each(over_w, |plane| plane.ramp(place)),
            inverse: inverse.ramp(place),
        }
    }
    #[inline(always)]
    fn values(_: &Self::Planes, ramps: &Perspective32Ramps<N>) -> [i32; N] {
        ramps.values()
    }
    #[inline(always)]
    fn advance(ramps: &mut Perspective32Ramps<N>) {
        ramps.over_w.iter_mut().for_each(Ramp::<i32>::advance);
        ramps.inverse.advance();
    }
    #[inline(always)]
    fn after(ramps: &Perspective32Ramps<N>, count: i32) -> Perspective32Ramps<N> {
        Perspective32Ramps {
            over_w: each(&ramps.over_w, |ramp| ramp.after(count)),
            inverse: ramps.inverse.after(count),
        }
    }
}

/// 1/w of one pixel, ready to divide by: one reciprocal for all values.
struct Divisor {
    /// 2^63 / (|1/w| · 2^(shift − 29)).
    reciprocal: u64,
    /// Takes |1/w| into 2^60…2^61.
    shift: u32,
    negative: bool,
}

impl Divisor {
    #[inline(always)]
    fn new(inverse: i64) -> Self {
        let magnitude = inverse.unsigned_abs().max(1);
        let shift = magnitude.leading_zeros().saturating_sub(3);
        Divisor {
            reciprocal: reciprocal(((magnitude << shift) >> 29) as u32),
            shift,
            negative: inverse < 0,
        }
    }

    /// `over_w` / inverse, in units of the values (2^30 of `over_w`), saturating.
    #[inline(always)]
    fn divide(&self, over_w: i64) -> i32 {
        let over_w = if self.negative { -over_w } else { over_w };
        // A quotient of 2^31 or more: only next to the pole of mixed signs, or where 1/w is all rounding.
        if over_w.unsigned_abs().leading_zeros() < self.shift + 2 {
            return if over_w < 0 { i32::MIN } else { i32::MAX };
        }
        let quotient = (((over_w << self.shift) >> 31) * self.reciprocal as i64) >> 31;
        quotient.max(i32::MIN as i64).min(i32::MAX as i64) as i32
    }
}

#[inline]
fn planes<const N: usize>(basis: &Basis, count: usize, corner: impl Fn(usize) -> [i32; N]) -> [Plane; N] {
    let [a, b, c] = basis.corners().map(&corner);
    let mut planes = [Plane::default(); N];
    let values = a.iter().zip(&b).zip(&c);
    for ((plane, ((&a, &b), &c)), &range) in planes.iter_mut().zip(values).zip(&ranges(count, corner)) {
        *plane = basis.plane([a, b, c], range);
    }
    planes
}

/// Least and largest of each value over the corners.
#[inline]
fn ranges<const N: usize>(count: usize, corner: impl Fn(usize) -> [i32; N]) -> [(i32, i32); N] {
    let mut ranges = [(i32::MAX, i32::MIN); N];
    for i in 0..count {
        for (range, v) in ranges.iter_mut().zip(corner(i)) {
            *range = (range.0.min(v), range.1.max(v));
        }
    }
    ranges
}

/// What `f` makes of every item. `array::map` is outlined at some optimisation levels, and copies the array to do it.
#[inline(always)]
fn each<A, B: Copy + Default, const N: usize>(array: &[A; N], mut f: impl FnMut(&A) -> B) -> [B; N] {
    let mut results = [B::default(); N];
    for (result, item) in results.iter_mut().zip(array) {
        *result = f(item);
    }
    results
}
