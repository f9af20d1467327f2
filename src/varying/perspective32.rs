//! Values in perspective, divided at every pixel, in words of 32 bits.

use core::num::NonZeroU32;

use super::{Perspective, Varying, each, each_pixel, lay};
use crate::fragment::Fragment;
use crate::gradient::{Basis, Place, Plane, Ramp};
use crate::num::product::product;
use crate::num::quotient_of_ones;
use crate::slope::{Slope, Slopes, Weights};
use crate::span::Span;

/// As [`Perspective`], in words of 32 bits: one 32-bit division for the reciprocal of 1/w at every pixel, and a product for
/// each value. For textures of up to some 512 texels a side, and cores that divide.
///
/// Values are not kept in the corners' range, which textures that repeat do not need; next to a pole of 1/w inside the polygon
/// they are anything.
///
/// **Error**, with ρ the largest 1/w of the polygon over that of the pixel: 2^-15·(1.5·ρ + 1) of the largest value, and ρ·2100
/// units where the whole reach of [slopes](mod@crate::slope) is used, ρ·4·2^`up` for each row and column of smaller triangles: `up`
/// is 0 where they are 4 px high in every direction, one more for each halving of that, and 5 below 16 columns and rows
/// (`tests/narrow.rs`). So with values in 2^-16 texel, triangles of 16 to 100 rows and columns that are 4 px high in every
/// direction, textures of 64 texels and ρ = 3 it is below 1/32 texel.
///
/// ```
/// use fixel::varying::{Perspective, Perspective32};
/// // u = 100 texels at w = 1, in units of 2^-16.
/// let near = Perspective32(Perspective::new([100 << 16], 1 << 30));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Perspective32<const N: usize>(pub Perspective<N>);

impl<const N: usize> From<Perspective<N>> for Perspective32<N> {
    #[inline]
    fn from(corner: Perspective<N>) -> Self {
        Perspective32(corner)
    }
}

/// The slopes of a [`Perspective32`].
#[derive(Debug, Clone, Copy)]
pub struct Perspective32Slopes<const N: usize> {
    over_w: [Slope; N],
    inverse: Slope,
}

/// The ramps of a [`Perspective32`].
#[derive(Debug, Clone, Copy)]
pub struct Perspective32Ramps<const N: usize> {
    pub(super) over_w: [Ramp<i32>; N],
    pub(super) inverse: Ramp<i32>,
}

/// −1 where all of 1/w are negative, else 0: behind the camera a value is the quotient of two numbers that are both negative.
#[inline(always)]
pub(super) fn sign([a, b, c]: [i32; 3]) -> i32 {
    (a & b & c) >> 31
}

impl<const N: usize> Perspective<N> {
    /// The same quotients, of numbers of the other sign where `sign` is −1.
    #[inline(always)]
    pub(super) fn turned(&self, sign: i32) -> Self {
        let turned = |v: i32| (v ^ sign).wrapping_sub(sign);
        Perspective {
            over_w: each(&self.over_w, |&v| turned(v)),
            inverse: turned(self.inverse),
            values: self.values,
        }
    }
}

impl<const N: usize> Perspective32Ramps<N> {
    #[inline(always)]
    pub(super) fn values(&self) -> [i32; N] {
        // 1/w in 2^-16, at most 1 and not 0; its reciprocal in 2^-16, 1 or more, and so that it is a signed word: a product of
        // two of these is one instruction. The product is in 2^-16 of the units of value/w, which are the values'.
        let inverse = NonZeroU32::MIN | (self.inverse.value >> 14) as u32;
        let reciprocal = quotient_of_ones(inverse) as i32;
        each(&self.over_w, |ramp| (product(ramp.value, reciprocal) >> 16) as i32)
    }
}

impl<const N: usize> Perspective32Ramps<N> {
    #[inline(always)]
    pub(super) fn advance(&mut self) {
        self.over_w.iter_mut().for_each(Ramp::<i32>::advance);
        self.inverse.advance();
    }

    #[inline(always)]
    pub(super) fn after(&self, count: i32) -> Self {
        Perspective32Ramps {
            over_w: each(&self.over_w, |ramp| ramp.after(count)),
            inverse: self.inverse.after(count),
        }
    }
}

impl<const N: usize> Slopes<Perspective32<N>> for Perspective32Slopes<N> {
    const DRAWS: bool = true;

    #[inline(always)]
    fn new(weights: &Weights, corners: [Perspective32<N>; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|corner| corner.0);
        let sign = sign([a.inverse, b.inverse, c.inverse]);
        let [a, b, c] = [a, b, c].map(|corner| corner.turned(sign));
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
    /// A function of its own: inlined, what the rows need takes the registers.
    #[inline(never)]
    fn draw<F: Fragment<Varying = Perspective32<N>>>(&self, span: &Span, pixels: &mut [F::Pixel], fragment: &F) {
        let ramps = Slopes::<Perspective32<N>>::ramps(self, (span.left, span.row));
        each_pixel(
            ramps,
            Perspective32Ramps::values,
            Perspective32::advance,
            pixels,
            fragment,
        );
    }
}

impl<const N: usize> Varying for Perspective32<N> {
    type Planes = ([Plane; N], [Plane; 1]);
    type Slopes = Perspective32Slopes<N>;
    type Ramps = Perspective32Ramps<N>;
    type Values = [i32; N];

    const NO_PLANES: Self::Planes = ([Plane::NONE; N], [Plane::NONE]);

    #[inline]
    fn lay((over_w, inverse): &mut Self::Planes, basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) {
        lay(over_w, basis, count, |i| corner(i).0.over_w);
        lay(inverse, basis, count, |i| [corner(i).0.inverse]);
        if inverse.iter().all(|plane| plane.range().1 < 0) {
            over_w.iter_mut().chain(inverse).for_each(Plane::negate);
        }
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
        ramps.advance();
    }
    #[inline(always)]
    fn advance_by(ramps: &mut Perspective32Ramps<N>, count: i32) {
        *ramps = ramps.after(count);
    }
}
