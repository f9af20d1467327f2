//! Light in world space: an ambient part, point lights, the eye anywhere (the rule of `.iv`).
//!
//! For a point v with unit normal n, an eye e, a material (ambient a, diffuse d, specular s, shininess x) and lights at L
//! of colour c:
//!
//! D = Σ max(0, c · (n·unit(L − v))), S = Σ max(0, c · max(0, n·h)^x), h = unit(unit(e − v) + unit(L − v)),
//!
//! color = min(1, a + min(1, D)·d + S·s), component by component,
//!
//! with unit(0) = 0 and 0^0 = 1. A highlight is not switched off where the light is behind the surface, and a negative
//! colour takes nothing away (behind the surface it shines: the product counts). There is no fading with distance and no
//! shadow. `S·s` is there for a [`Glossy`] material only: for a [`Matte`] one there is no code.
//!
//! **Colours** of lights are blocks of any size; what passes 2^28 of full counts as 2^28. Colours of materials and results
//! are in units of 2^-28 of full: [`FULL`]. Sums are kept in units of 2^-30; they saturate at 2^31 of full.
//!
//! **Positions** are blocks ([`PointLights::shade`], once per vertex or face), or integers at a scale that all fragments
//! share ([`PointLights::at_scale`], once per pixel). Blocks are rounded once, as a difference; integers are exact, lights
//! and eye being rounded to their unit: from d units away the direction is then within 1/d.
//!
//! **Error** against exact arithmetic, from the numbers given: of n·l at most 6·2^-30, of k = n·h at most
//! (5 + 6/|unit(e − v) + unit(L − v)|)·2^-30 and over 1 by no more; of k^x what that makes of it and 3·2^-30 of its own; each
//! times the light's |c|, and 2^-31 for each light; D's error times |d|, S's times |s|; and one unit of the result
//! (`tests/phong.rs`; the directions' own errors are those of `docs/functions.md`). A hundred
//! lights that add up to full on a matte surface are within 2^-25 of full.
//!
//! **Precision** is the lights' last type parameter, as in [`light`](mod@crate::light). For those below [`TwoSteps`], with the
//! constants of [`Precision`], the error of n·l is 3·`UNIT_ERROR` + `DOT_ERROR`, of k (3 + 4/|unit(e − v) + unit(L − v)|)·
//! `UNIT_ERROR` + `DOT_ERROR`, of k^x what that makes of it and `POWER_ERROR`; each and 2^-15 times the light. Each light may be
//! off by a step of 2^-15 of all lights together, brought up to a power of two and at least full, the sum by
//! another two.
//!
//! ```
//! use fixel::light::world::{FULL, Glossy, Material, PointLight, PointLights};
//! use fixel::num::Block;
//!
//! // The eye in front of a wall at z = 0, a lamp 45° above it.
//! let mut lights = PointLights::<i32, 1>::new(Block::from_integers([0, 0, 5]));
//! let lamp = PointLight { position: Block::from_integers([0, 7, 7]), color: Block::from_integers([1, 1, 1]) };
//! lights.add(lamp)?;
//!
//! let material = Material {
//!     ambient: [FULL / 8; 3],
//!     diffuse: [FULL / 2, 0, 0],
//!     specular: Glossy { color: [0, 0, FULL], shininess: 4 << 16 },
//! };
//! let [red, green, blue] = lights.shade([0, 0, 1], Block::ZERO, &material);
//! // cos 45° = 0.7071, (cos 22.5°)^4 = 0.7286.
//! let near = |color: i32, wanted: f64| (color as f64 / FULL as f64 - wanted).abs() < 1e-4;
//! assert!(near(red, 0.125 + 0.7071 / 2.0) && green == FULL / 8 && near(blue, 0.125 + 0.7286));
//! # Ok::<(), fixel::error::Error>(())
//! ```

use core::marker::PhantomData;

use heapless::Vec;

use super::sums::{light_15, part_16, share_15};
use super::{Finish, MOST, Matte, minus, plus, times, to_units};
use crate::error::Error;
use crate::num::{Block, Precision, TwoSteps, Word, power};

/// Full in the units of materials and results, 2^-28.
pub const FULL: i32 = 1 << 28;

/// A light at a point of world space.
///
/// ```
/// use fixel::{light::world::PointLight, num::Block};
/// // Orange, and twice as bright as full: mantissas · 2^-1.
/// let lamp = PointLight { position: Block::<i32, 3>::from_integers([0, 5, -2]), color: Block::new([4, 2, 0], -1) };
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PointLight<T> {
    /// The point.
    pub position: Block<T, 3>,
    /// Its colour, any size, any sign; 1 is full.
    pub color: Block<i32, 3>,
}

/// The eye and the lights of a scene, at most `N` of them, at most 32768, at the precision `P`.
///
/// ```
/// use fixel::{error::Error, light::world::{PointLight, PointLights}, num::Block};
/// let mut lights = PointLights::<i64, 1>::new(Block::ZERO);
/// let lamp = PointLight { position: Block::from_integers([1, 2, 3]), color: Block::from_integers([1; 3]) };
/// assert_eq!(lights.add(lamp), Ok(()));
/// assert_eq!(lights.add(lamp), Err(Error::TooManyLights));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct PointLights<T, const N: usize, P = TwoSteps> {
    eye: Block<T, 3>,
    lights: Vec<(Block<T, 3>, Color), N>,
    /// Of all lights together, in units of 2^-15 of full.
    brightness: u64,
    precision: PhantomData<P>,
}

/// A light's colour: `mantissas` · 2^(30 − `shift`) in units of 2^-30 of full.
#[derive(Debug, Clone, Copy)]
struct Color {
    mantissas: [i32; 3],
    shift: u32,
}

impl Color {
    fn new(color: Block<i32, 3>) -> Self {
        // Mantissas are at most 2^30: at exponent −2 the largest is 2^28 of full.
        let exponent = color.exponent().min(-2);
        Color {
            mantissas: color.mantissas(),
            shift: exponent.unsigned_abs().min(63),
        }
    }

    /// No less than its largest channel, in units of 2^-15 of full; below 2^45.
    fn brightness(&self) -> u64 {
        let most = self.mantissas.iter().fold(0, |most, c| c.unsigned_abs().max(most));
        (((most as u64) << 15) >> self.shift) + 1
    }
}

/// Bits of fraction of the colours of lights that make `brightness` together, so that they fit 15 bits; at least −14, from where
/// on sums saturate.
fn fraction_bits(brightness: u64) -> i32 {
    15 - (49 - brightness.leading_zeros() as i32).clamp(0, 29)
}

impl<T: Word, const N: usize, P: Precision> PointLights<T, N, P> {
    /// No light yet, seen from `eye`.
    pub fn new(eye: Block<T, 3>) -> Self {
        const { assert!(N <= MOST) };
        PointLights {
            eye,
            lights: Vec::new(),
            brightness: 0,
            precision: PhantomData,
        }
    }

    /// One light more.
    ///
    /// # Errors
    /// [`Error::TooManyLights`] when there is no room for another.
    pub fn add(&mut self, light: PointLight<T>) -> Result<(), Error> {
        let PointLight { position, color } = light;
        let color = Color::new(color);
        let added = self.lights.push((position, color));
        added.map_err(|_| Error::TooManyLights)?;
        self.brightness += color.brightness();
        Ok(())
    }

    /// The colour at a point in units of 2^-28 of full, at most [`FULL`]: for vertices and faces.
    ///
    /// `normal`: any length; 0 has no direction, which leaves the ambient part, and with shininess 0 the highlight.
    #[inline]
    pub fn shade<S: Specular>(&self, normal: [i32; 3], position: Block<T, 3>, material: &Material<S>) -> [i32; 3] {
        clamped(self.shade_wide(normal, position, material))
    }

    /// As [`shade`](Self::shade), but before the last min(1, ·): at most 2^34 of full.
    ///
    /// ```
    /// use fixel::light::{Matte, world::{FULL, Material, PointLights}};
    /// use fixel::num::Block;
    /// let lights = PointLights::<i32, 0>::new(Block::ZERO);
    /// let glowing = Material { ambient: [2 * FULL, FULL, 0], diffuse: [FULL; 3], specular: Matte };
    /// assert_eq!(lights.shade([0, 0, 1], Block::ZERO, &glowing), [FULL, FULL, 0]);
    /// assert_eq!(lights.shade_wide([0, 0, 1], Block::ZERO, &glowing), [2 << 28, 1 << 28, 0]);
    /// ```
    pub fn shade_wide<S: Specular>(&self, normal: [i32; 3], position: Block<T, 3>, material: &Material<S>) -> [i64; 3] {
        let direction =
            |to: Block<T, 3>| P::unit_wide(to.minus(position).mantissas().map(T::to_i64)).unwrap_or_default();
        let mut sum = Sum::<S, P>::new(normal, material, fraction_bits(self.brightness));
        if S::SHINES {
            sum.to_eye = direction(self.eye);
        }
        for (light, color) in &self.lights {
            sum.add(direction(*light), color);
        }
        sum.color()
    }

    /// The lights for fragments whose positions are in units of 2^`exponent`: once per draw.
    pub fn at_scale(&self, exponent: i32) -> PointLit<N, P> {
        let mut lamps = Vec::new();
        for (light, color) in &self.lights {
            // As many as here have room there.
            let _ = lamps.push((to_units(*light, exponent), *color));
        }
        PointLit {
            eye: to_units(self.eye, exponent),
            lamps,
            fraction_bits: fraction_bits(self.brightness),
            precision: PhantomData,
        }
    }
}

/// [`PointLights`] at the scale of the fragments; made by [`PointLights::at_scale`].
///
/// ```
/// use fixel::light::{Matte, world::{FULL, Material, PointLight, PointLights}};
/// use fixel::num::Block;
/// let mut lights = PointLights::<i32, 1>::new(Block::from_integers([0, 0, 9]));
/// lights.add(PointLight { position: Block::from_integers([0, 0, 4]), color: Block::from_integers([1, 1, 0]) })?;
/// // Fragments in 1/256: the light is at (0, 0, 1024) now, 512 before this one, and shines fully on it.
/// let lit = lights.at_scale(-8);
/// let material = Material { ambient: [0; 3], diffuse: [FULL / 4, FULL, FULL], specular: Matte };
/// assert_eq!(lit.shade([0, 0, 3], [0, 0, 512], &material), [FULL / 4, FULL, 0]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct PointLit<const N: usize, P = TwoSteps> {
    eye: [i64; 3],
    lamps: Vec<([i64; 3], Color), N>,
    fraction_bits: i32,
    precision: PhantomData<P>,
}

impl<const N: usize, P: Precision> PointLit<N, P> {
    /// The colour of one fragment in units of 2^-28 of full, at most [`FULL`].
    ///
    /// `normal`: as interpolated, any length. `position`: in the units given to [`at_scale`](PointLights::at_scale).
    #[inline]
    pub fn shade<S: Specular>(&self, normal: [i32; 3], position: [i32; 3], material: &Material<S>) -> [i32; 3] {
        clamped(self.shade_wide(normal, position, material))
    }

    /// As [`shade`](Self::shade), but before the last min(1, ·): at most 2^34 of full.
    #[inline]
    pub fn shade_wide<S: Specular>(&self, normal: [i32; 3], position: [i32; 3], material: &Material<S>) -> [i64; 3] {
        let direction = |to: [i64; 3]| P::unit_wide(minus(to, position)).unwrap_or_default();
        let mut sum = Sum::<S, P>::new(normal, material, self.fraction_bits);
        if S::SHINES {
            sum.to_eye = direction(self.eye);
        }
        for (light, color) in &self.lamps {
            sum.add(direction(*light), color);
        }
        sum.color()
    }
}

/// What a surface does with light: colours in units of 2^-28 of full, best in 0…[`FULL`].
///
/// ```
/// use fixel::light::{Matte, world::{FULL, Material}};
/// let chalk = Material { ambient: [FULL / 5; 3], diffuse: [FULL / 5 * 4; 3], specular: Matte };
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Material<S> {
    /// Its colour without any light.
    pub ambient: [i32; 3],
    /// What it adds to that in full light.
    pub diffuse: [i32; 3],
    /// Its highlights: [`Matte`], [`Glossy`] or one's own.
    pub specular: S,
}

/// Highlights with a colour of their own.
pub trait Specular: Finish {
    /// In units of 2^-28 of full.
    fn color(&self) -> [i32; 3];
}

impl Specular for Matte {
    #[inline(always)]
    fn color(&self) -> [i32; 3] {
        [0; 3]
    }
}

/// Blinn-Phong highlights: (n·h)^shininess.
///
/// ```
/// use fixel::light::{Finish, world::{FULL, Glossy}};
/// let polish = Glossy { color: [FULL; 3], shininess: 2 << 16 };
/// assert_eq!(polish.strength(1 << 29), 1 << 28);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Glossy {
    /// In units of 2^-28 of full.
    pub color: [i32; 3],
    /// In units of 2^-16, see [`power`].
    pub shininess: u32,
}

impl Finish for Glossy {
    const SHINES: bool = true;
    #[inline]
    fn strength(&self, cosine: i32) -> i32 {
        power(cosine, self.shininess)
    }
    #[inline]
    fn strength_at<P: Precision>(&self, cosine: i32) -> i32 {
        P::power(cosine, self.shininess)
    }
}

impl Specular for Glossy {
    #[inline(always)]
    fn color(&self) -> [i32; 3] {
        self.color
    }
}

/// What the lights so far add.
struct Sum<'a, S, P> {
    normal: [i32; 3],
    to_eye: [i32; 3],
    material: &'a Material<S>,
    fraction_bits: i32,
    diffuse: Sums<P>,
    specular: Sums<P>,
}

impl<'a, S: Specular, P: Precision> Sum<'a, S, P> {
    #[inline(always)]
    fn new(normal: [i32; 3], material: &'a Material<S>, fraction_bits: i32) -> Self {
        Sum {
            normal: P::unit(normal).unwrap_or_default(),
            to_eye: [0; 3],
            material,
            fraction_bits,
            diffuse: Sums::default(),
            specular: Sums::default(),
        }
    }

    #[inline(always)]
    fn add(&mut self, direction: [i32; 3], color: &Color) {
        let cosine = P::dot(self.normal, direction);
        self.diffuse.add(color, cosine, self.fraction_bits);
        if S::SHINES {
            let half = P::unit(plus(direction, self.to_eye)).unwrap_or_default();
            let cosine = P::dot(self.normal, half).max(0);
            let strength = self.material.specular.strength_at::<P>(cosine);
            self.specular.add(color, strength, self.fraction_bits);
        }
    }

    /// In units of 2^-28 of full.
    #[inline(always)]
    fn color(&self) -> [i64; 3] {
        let Material {
            ambient,
            diffuse,
            specular,
        } = self.material;
        let mut color = ambient.map(i64::from);
        for (color, lit) in color
            .iter_mut()
            .zip(self.diffuse.at_most_full(*diffuse, self.fraction_bits))
        {
            *color += lit;
        }
        if S::SHINES {
            for (color, lit) in color
                .iter_mut()
                .zip(self.specular.all(specular.color(), self.fraction_bits))
            {
                // Below 2^62 and 2^33.
                *color += lit;
            }
        }
        color
    }
}

/// Σ max(0, color · share) for the three channels.
#[derive(Debug, Clone, Copy)]
struct Sums<P> {
    /// Where [`Precision::LONG`]: in units of 2^-30 of full, at most [`BRIGHTEST`].
    long: [i64; 3],
    /// Else: colours with [`fraction_bits`] times shares of 15 bits.
    short: [i32; 3],
    precision: PhantomData<P>,
}

/// Where sums saturate: a light adds at most 2^58, and [`times`] wants less than 2^61.5.
const BRIGHTEST: i64 = 1 << 61;

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
    /// |`share`| ≤ 2^30 + 8, or of a finish of someone's own any.
    #[inline(always)]
    fn add(&mut self, color: &Color, share: i32, fraction_bits: i32) {
        if P::LONG {
            accumulate(&mut self.long, color, share);
            return;
        }
        let share = share_15(share);
        // Not negative: `fraction_bits` are those of all lights together.
        let cut = (color.shift as i32 - fraction_bits).clamp(0, 31) as u32;
        for (sum, c) in self.short.iter_mut().zip(color.mantissas) {
            *sum = sum.saturating_add(((c >> cut) * share).max(0));
        }
    }

    /// min(1, sum) · `color`.
    #[inline(always)]
    fn at_most_full(&self, color: [i32; 3], fraction_bits: i32) -> [i64; 3] {
        let mut lit = [0; 3];
        if P::LONG {
            for (lit, (&sum, color)) in lit.iter_mut().zip(self.long.iter().zip(color)) {
                *lit = times(sum.min(1 << 30), color);
            }
            return lit;
        }
        let full = (fraction_bits + 15).clamp(0, 30) as u32;
        for (lit, (&sum, color)) in lit.iter_mut().zip(self.short.iter().zip(color)) {
            // In units of 2^-15, 1 at most: the first product is below 2^30.
            let light = ((sum.min(1 << full) << (30 - full)) + (1 << 14)) >> 15;
            *lit = i64::from((((color >> 16) * light) << 1) + (((color & 0xffff) * light) >> 15));
        }
        lit
    }

    /// sum · `color`.
    #[inline(always)]
    fn all(&self, color: [i32; 3], fraction_bits: i32) -> [i64; 3] {
        let mut lit = [0; 3];
        if P::LONG {
            for (lit, (&sum, color)) in lit.iter_mut().zip(self.long.iter().zip(color)) {
                *lit = times(sum, color);
            }
            return lit;
        }
        for (lit, (&sum, color)) in lit.iter_mut().zip(self.short.iter().zip(color)) {
            *lit = i64::from(part_16(color, light_15(sum))) << (16 - fraction_bits).clamp(0, 31);
        }
        lit
    }
}

/// sums += max(0, color · share), rounded to 2^-30 of full.
#[inline(always)]
fn accumulate(sums: &mut [i64; 3], color: &Color, share: i32) {
    for (sum, c) in sums.iter_mut().zip(color.mantissas) {
        // At most 2^61; the shift is 2 or more.
        let added = (c as i64 * share as i64 + (1 << (color.shift - 1))) >> color.shift;
        *sum = (*sum + added.max(0)).min(BRIGHTEST);
    }
}

#[inline(always)]
fn clamped(color: [i64; 3]) -> [i32; 3] {
    color.map(|c| c.clamp(i32::MIN as i64, FULL as i64) as i32)
}
