//! Values that are linear over the screen, in words of 32 bits.

use super::{Linear, Perspective, Varying, each, lay};
use crate::gradient::{Basis, Place, Plane, Ramp};
use crate::slope::{Slope, Slopes, Weights};

/// As [`Linear`], by [slopes](mod@crate::slope): set up in fewer instructions, and not kept in the range of the corners' values.
/// For texture coordinates that are *affine*, the fast end of the choice between this, [`PerspectiveSpans`](super::PerspectiveSpans)
/// and [`Perspective32`](super::Perspective32).
///
/// **Error**: that of [slopes](mod@crate::slope), 2200 units for textures of up to 512 texels (`tests/narrow.rs`); of clipped
/// polygons that of [`Linear`]. To a texture in perspective it is wrong by as much as perspective bends it.
///
/// ```
/// use fixel::varying::{Linear32, Perspective};
/// // A corner at u = 7 texels; its w is of no consequence.
/// assert_eq!(Linear32::from(Perspective::new([7 << 16], 1 << 29)), Linear32([7 << 16]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Linear32<const N: usize>(pub [i32; N]);

impl<const N: usize> From<Perspective<N>> for Linear32<N> {
    #[inline]
    fn from(corner: Perspective<N>) -> Self {
        Linear32(corner.values)
    }
}

/// The slopes of a [`Linear32`].
#[derive(Debug, Clone, Copy)]
pub struct Linear32Slopes<const N: usize>([Slope; N]);

impl<const N: usize> Slopes<Linear32<N>> for Linear32Slopes<N> {
    #[inline(always)]
    fn new(weights: &Weights, [Linear32(a), Linear32(b), Linear32(c)]: [Linear32<N>; 3]) -> Option<Self> {
        let mut slopes = [Slope::default(); N];
        for (slope, ((&a, &b), &c)) in slopes.iter_mut().zip(a.iter().zip(&b).zip(&c)) {
            *slope = weights.slope([a, b, c]);
        }
        Some(Linear32Slopes(slopes))
    }
    #[inline(always)]
    fn ramps(&self, place: (i32, i32)) -> [Ramp<i32>; N] {
        each(&self.0, |slope| slope.ramp(place))
    }
    #[inline(always)]
    fn values(&self, ramps: &[Ramp<i32>; N]) -> [i32; N] {
        each(ramps, |ramp| ramp.value)
    }
}

impl<const N: usize> Varying for Linear32<N> {
    type Planes = [Plane; N];
    type Slopes = Linear32Slopes<N>;
    type Ramps = [Ramp<i32>; N];
    type Values = [i32; N];

    const NO_PLANES: [Plane; N] = [Plane::NONE; N];

    #[inline]
    fn lay(planes: &mut [Plane; N], basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) {
        lay(planes, basis, count, |i| corner(i).0);
    }
    #[inline]
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
    fn advance_by(ramps: &mut [Ramp<i32>; N], count: i32) {
        Linear::<N>::advance_by(ramps, count);
    }
}
