//! What a primitive carries from its corners to its pixels: nothing, values linear over the screen, or values in
//! perspective. Chosen by type, so that a draw pays only for what it carries.

use core::hint::black_box;

use crate::fragment::Fragment;
use crate::gradient::{Basis, Place, Plane};
use crate::slope::{Slopes, SmallWeights, Weights};

mod color565;
mod linear;
mod linear32;
mod perspective;
mod perspective32;
mod spans;

pub use color565::{Color565, Color565Ramps, Color565Slopes, Packed565};
pub use linear::{Linear, LinearFan};
pub use linear32::{Linear32, Linear32Slopes};
pub use perspective::{Perspective, PerspectivePlanes, PerspectiveRamps};
pub use perspective32::{Perspective32, Perspective32Ramps, Perspective32Slopes};
pub use spans::{PerspectiveSpans, SpansSlopes};

/// A kind of varying: `()`, [`Linear`], [`Perspective`], or a pair of them.
pub trait Varying: Copy + Sized {
    /// What a polygon keeps of it.
    type Planes;
    /// What a triangle keeps instead, or a piece of a large or thin one.
    type Slopes: Slopes<Self>;
    /// What a span keeps of it.
    type Ramps;
    /// What a pixel gets.
    type Values: Copy;

    /// Planes before they are [laid](Self::lay).
    const NO_PLANES: Self::Planes;

    /// Lays planes through the corners, once per polygon; `corner(i)` for i in 0…count. In place: returned, many of them would
    /// be on the stack twice.
    fn lay(planes: &mut Self::Planes, basis: &Basis, count: usize, corner: impl Fn(usize) -> Self);
    /// At the first pixel of a span.
    fn ramps(planes: &Self::Planes, place: &Place) -> Self::Ramps;
    /// At the current pixel.
    fn values(planes: &Self::Planes, ramps: &Self::Ramps) -> Self::Values;
    /// One pixel on.
    fn advance(ramps: &mut Self::Ramps);
    /// `count` pixels on: what as many calls of [`advance`](Self::advance) do.
    fn advance_by(ramps: &mut Self::Ramps, count: i32);
}

/// Nothing: a flat colour.
impl Varying for () {
    type Planes = ();
    type Slopes = ();
    type Ramps = ();
    type Values = ();

    const NO_PLANES: () = ();

    #[inline(always)]
    fn lay((): &mut (), _: &Basis, _: usize, _: impl Fn(usize) -> Self) {}
    #[inline(always)]
    fn ramps(_: &(), _: &Place) {}
    #[inline(always)]
    fn values(_: &(), _: &()) {}
    #[inline(always)]
    fn advance(_: &mut ()) {}
    #[inline(always)]
    fn advance_by((): &mut (), _: i32) {}
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

    const NO_PLANES: Self::Planes = (A::NO_PLANES, B::NO_PLANES);

    #[inline]
    fn lay((first, second): &mut Self::Planes, basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) {
        A::lay(first, basis, count, |i| corner(i).0);
        B::lay(second, basis, count, |i| corner(i).1);
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
    fn advance_by(ramps: &mut Self::Ramps, count: i32) {
        A::advance_by(&mut ramps.0, count);
        B::advance_by(&mut ramps.1, count);
    }
}

impl<A: Varying, B: Varying> Slopes<(A, B)> for (A::Slopes, B::Slopes) {
    const CARRIES: bool = A::Slopes::CARRIES || B::Slopes::CARRIES;
    const EXIST: bool = A::Slopes::EXIST && B::Slopes::EXIST;

    #[inline(always)]
    fn new(weights: &Weights, corners: [(A, B); 3]) -> Option<Self> {
        let first = A::Slopes::new(weights, corners.map(|corner| corner.0))?;
        Some((first, B::Slopes::new(weights, corners.map(|corner| corner.1))?))
    }
    #[inline(always)]
    fn small(weights: &SmallWeights, corners: [(A, B); 3]) -> Option<Self> {
        let first = A::Slopes::small(weights, corners.map(|corner| corner.0))?;
        Some((first, B::Slopes::small(weights, corners.map(|corner| corner.1))?))
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
/// The planes of N values each: corner by corner, one of which is on the stack at a time. Where clipping has left it, it is
/// mixed when it is asked for.
#[inline]
fn lay<const N: usize>(planes: &mut [Plane; N], basis: &Basis, count: usize, corner: impl Fn(usize) -> [i32; N]) {
    planes.iter_mut().for_each(Plane::empty);
    for i in 0..count {
        hold(planes, basis.place_of(i), &corner(i));
    }
    settle(planes, basis);
}

/// One corner, and which of the basis it is. The same code for any number of values.
#[inline(never)]
fn hold(planes: &mut [Plane], place: Option<usize>, values: &[i32]) {
    for (plane, &value) in planes.iter_mut().zip(values) {
        plane.hold(place, value);
    }
}

#[inline(never)]
fn settle(planes: &mut [Plane], basis: &Basis) {
    for plane in planes {
        plane.settle(basis);
    }
}

/// Least and largest, and one value more.
#[inline(always)]
fn widen((least, most): &mut (i32, i32), v: i32) {
    (*least, *most) = ((*least).min(v), (*most).max(v));
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

/// Draws `pixels`: `values` of the `ramps` at each, which then `advance`.
#[inline(always)]
fn each_pixel<F, R, const N: usize>(
    mut ramps: R,
    values: impl Fn(&R) -> [i32; N],
    advance: impl Fn(&mut R),
    pixels: &mut [F::Pixel],
    fragment: &F,
) where
    F: Fragment<Varying: Varying<Values = [i32; N]>>,
{
    for pixel in pixels {
        // Rolled: the state of several would not fit the registers.
        black_box(());
        if let Some(new) = fragment.shade(values(&ramps), *pixel) {
            *pixel = new;
        }
        advance(&mut ramps);
    }
}
