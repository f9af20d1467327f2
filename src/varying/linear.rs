//! Values that are linear over the screen.

use core::convert::Infallible;

use super::{Perspective, Varying, each, lay};
use crate::gradient::{Basis, Place, Plane, Ramp};

/// N values linear over the screen, |v| ≤ 2^30 in units of the user's choice.
///
/// Error along a row: one unit per pixel at most from its first covered one on, on the window or not, so that every window has
/// the same bits, and at that one a unit and 2^-24 of the range (see [`gradient`](mod@crate::gradient)); every value
/// lies in the range of the corners' values.
///
/// ```
/// use fixel::varying::Linear;
/// // Red, green, blue in units of 2^-16 levels of 0…255.
/// let white = Linear([255 << 16; 3]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Linear<const N: usize>(pub [i32; N]);

impl<const N: usize> From<Perspective<N>> for Linear<N> {
    /// The values at the corner: what is affine instead.
    #[inline]
    fn from(corner: Perspective<N>) -> Self {
        Linear(corner.values)
    }
}

impl<const N: usize> Varying for Linear<N> {
    type Planes = [Plane; N];
    type Slopes = Infallible;
    type Ramps = [Ramp<i32>; N];
    type Values = [i32; N];

    const NO_PLANES: [Plane; N] = [Plane::NONE; N];

    #[inline]
    fn lay(planes: &mut [Plane; N], basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) {
        lay(planes, basis, count, |i| corner(i).0);
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
    fn advance_by(ramps: &mut [Ramp<i32>; N], count: i32) {
        ramps.iter_mut().for_each(|ramp| *ramp = ramp.after(count));
    }
}

/// As [`Linear`], but where user planes cut a triangle in eye space its values are mixed as the position is, *before* the
/// division by w, and the polygon is drawn as a fan, each triangle with its own values (MP1 without `hyp`). Without user
/// planes, or where w is constant, it is the same as [`Linear`].
///
/// A fan's triangles share their diagonals exactly, and no sample is drawn twice: where a cut falls within 1/256 px of a corner and
/// rounding turns a triangle of the fan over, that one is left out (`tests/fans.rs`).
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

    const NO_PLANES: [Plane; N] = [Plane::NONE; N];

    #[inline]
    fn lay(planes: &mut [Plane; N], basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) {
        lay(planes, basis, count, |i| corner(i).0);
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
    fn advance_by(ramps: &mut [Ramp<i32>; N], count: i32) {
        Linear::<N>::advance_by(ramps, count);
    }
}
