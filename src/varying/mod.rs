//! What a primitive carries from its corners to its pixels: nothing, values linear over the screen, or values in
//! perspective. Chosen by type, so that a draw pays only for what it carries.

use crate::gradient::{Basis, Place, Plane};
use crate::slope::{Slopes, Weights};

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
    const EXIST: bool = A::Slopes::EXIST && B::Slopes::EXIST;

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
            widen(range, v);
        }
    }
    ranges
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
