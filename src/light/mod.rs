//! Light on one fragment: suns and bulbs, diffuse and Blinn-Phong, any brightness, either sign.
//!
//! This is the rule of HW2, in eye space; that of `.iv`, in world space and with ambient light, is [`world`].
//!
//! With surface colour o, unit normal n and eye position p of the fragment (the eye is the origin), every light whose
//! direction l has c = n·l > 0 adds
//!
//! c · light · o + light · max(0, n·h)^a, h = unit(l + unit(−p)),
//!
//! the second term only for a [`Shiny`] surface. A sun's l is fixed, a bulb's is unit(b − p), and unit(0) is 0. A
//! light with c ≤ 0 adds nothing at all. There is no ambient light, no fading with distance and no shadow.
//!
//! **Colours** are in units of 2^-16 of full, all of `i32`: ±2^15 of full. Nothing is clamped but the result, to that
//! range: the sums are kept in 64 bits. Addition of integers commutes, so the order of lights does not matter to a bit.
//! For still brighter lights give all light colours in a larger unit; the result is then in that unit too. So it is with
//! surfaces, but that what glints must say so ([`Finish::highlight`]); [`Lit::shade_wide`] does not clamp at all.
//!
//! **Error** against exact arithmetic, from the integers given: of c at most 6·2^-30, of k = n·h at most
//! (4 + 5/|l + unit(−p)|)·2^-30; of k^a what that makes of it and 3·2^-30 of its own; each times the light; and 1 unit
//! of the result (`tests/lighting.rs`). A hundred lights of colours −2…3 with a = 240 stay within 1/100 of a level of
//! 255. Where c or |l + unit(−p)| is 0 but for its error, a highlight is either there or not: it begins with a jump.
//!
//! **Precision** is the lights' last type parameter, [`TwoSteps`] unless another is named. For [`OneStep`](crate::num::OneStep)
//! and [`Table`](crate::num::Table), with the constants of [`Precision`], the error of c is 3·`UNIT_ERROR` + `DOT_ERROR`, of k
//! (3 + 4/|l + unit(−p)|)·`UNIT_ERROR` + `DOT_ERROR`, of k^a what that makes of it and `POWER_ERROR`; each and 2^-15 times the
//! light. Sums have 15 bits below the largest channels of all lights together, brought up to a power of two: each light may
//! be off by one such step, the sum by another, times the surface, and the result by one.
//!
//! **Cost**: without a [`Shiny`] surface there is no code for highlights, with room for 0 bulbs none for bulbs.
//!
//! ```
//! use fixel::light::{Light, Lights, Matte, Shiny};
//!
//! const FULL: i32 = 1 << 16;
//! let mut lights = Lights::<i32, 1, 0>::default();
//! // Along the view, orange.
//! lights.add(Light::sun([0, 0, 1], [FULL, FULL / 2, 0])?)?;
//! let scene = lights.at_scale(0);
//!
//! // A white surface half turned away: cos 60° = ½ of the light.
//! let (normal, position) = ([1732, 0, 1000], [0, 0, -5]);
//! let [red, green, blue] = scene.shade(normal, position, [FULL; 3], &Matte);
//! assert!(red.abs_diff(FULL / 2) < 10 && green.abs_diff(FULL / 4) < 10 && blue == 0);
//!
//! // Polished, it also shows a highlight: l = unit(−p) = h, so cos 60° to the 8th.
//! let [red, ..] = scene.shade(normal, position, [FULL; 3], &Shiny(8 << 16));
//! assert!(red.abs_diff(FULL / 2 + FULL / 256) < 10);
//! # Ok::<(), fixel::error::Error>(())
//! ```

mod sums;
mod sunlight;
pub mod world;

pub use sunlight::Sunlight;

use core::marker::PhantomData;

use heapless::Vec;

use self::sums::Sums;
use crate::error::Error;
use crate::num::{Block, Precision, TwoSteps, Word, power, unit};

/// A light in eye space. Colours in units of 2^-16 of full, any sign.
///
/// ```
/// use fixel::{light::Light, num::Block};
/// let lamp = Light::Bulb { position: Block::<i32, 3>::from_integers([0, 5, -2]), color: [3 << 16, 0, -2 << 16] };
/// let sun = Light::<i32>::sun([0, 0, -3], [1 << 16; 3])?;
/// assert_eq!(sun, Light::Sun { direction: [0, 0, -1 << 30], color: [1 << 16; 3] });
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Light<T> {
    /// Infinitely far away.
    Sun {
        /// Towards the light, length 1 in units of 2^-30 (see [`unit`](fn@unit)).
        direction: [i32; 3],
        /// Its colour.
        color: [i32; 3],
    },
    /// At a point.
    Bulb {
        /// The point.
        position: Block<T, 3>,
        /// Its colour.
        color: [i32; 3],
    },
}

impl<T> Light<T> {
    /// A sun in the direction of a vector of any length.
    ///
    /// # Errors
    /// [`Error::ZeroVector`] for length 0.
    pub fn sun(towards: [i32; 3], color: [i32; 3]) -> Result<Self, Error> {
        let direction = unit(towards).ok_or(Error::ZeroVector)?;
        Ok(Light::Sun { direction, color })
    }
}

/// Suns or bulbs at most; see [`Sum`].
const MOST: usize = 1 << 15;

/// The lights of a scene: at most `SUNS` and `BULBS` of them, at most 32768 of either kind, at the precision `P`.
///
/// ```
/// use fixel::{error::Error, light::{Light, Lights}};
/// let mut lights = Lights::<i32, 1, 0>::default();
/// let sun = Light::sun([1, 2, 3], [1 << 16; 3])?;
/// assert_eq!(lights.add(sun), Ok(()));
/// assert_eq!(lights.add(sun), Err(Error::TooManyLights));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Lights<T, const SUNS: usize, const BULBS: usize, P = TwoSteps> {
    suns: Vec<Lamp<i32>, SUNS>,
    bulbs: Vec<(Block<T, 3>, [i32; 3]), BULBS>,
    precision: PhantomData<P>,
}

/// A light as a fragment sees it: a sun's direction, or a bulb's position at the fragments' scale.
#[derive(Debug, Clone, Copy)]
struct Lamp<P> {
    place: [P; 3],
    color: [i32; 3],
}

impl<T, const SUNS: usize, const BULBS: usize, P> Default for Lights<T, SUNS, BULBS, P> {
    fn default() -> Self {
        const { assert!(SUNS <= MOST && BULBS <= MOST) };
        Lights {
            suns: Vec::new(),
            bulbs: Vec::new(),
            precision: PhantomData,
        }
    }
}

impl<T: Word, const SUNS: usize, const BULBS: usize, P: Precision> Lights<T, SUNS, BULBS, P> {
    /// One light more.
    ///
    /// # Errors
    /// [`Error::TooManyLights`] when there is no room for another of its kind.
    pub fn add(&mut self, light: Light<T>) -> Result<(), Error> {
        match light {
            Light::Sun { direction, color } => self
                .suns
                .push(Lamp {
                    place: direction,
                    color,
                })
                .ok(),
            Light::Bulb { position, color } => self.bulbs.push((position, color)).ok(),
        }
        .ok_or(Error::TooManyLights)
    }

    /// Whether there is none: then surfaces have their own colour (HW2), and nothing of this module is needed.
    pub fn is_empty(&self) -> bool {
        self.suns.is_empty() && self.bulbs.is_empty()
    }

    /// The lights for fragments whose positions are in units of 2^`exponent`: once per draw or primitive.
    ///
    /// Bulbs are rounded to that unit, as fragments are: from d units away the direction is within 1/d. However far a
    /// bulb, no more is lost than 2^-29 of the direction.
    pub fn at_scale(&self, exponent: i32) -> Lit<'_, BULBS, P> {
        let mut bulbs = Vec::new();
        for &(position, color) in &self.bulbs {
            // As many as here have room there; `collect` would carry a panic along.
            let _ = bulbs.push(Lamp {
                place: to_units(position, exponent),
                color,
            });
        }
        Lit {
            suns: &self.suns,
            bulbs,
            cut: if P::LONG { 0 } else { sums::cut(self.brightness()) },
            precision: PhantomData,
        }
    }

    /// The largest channels of all colours together, in units of 2^-16 of full.
    fn brightness(&self) -> u64 {
        let colors = self.suns.iter().map(|sun| sun.color);
        let colors = colors.chain(self.bulbs.iter().map(|&(_, color)| color));
        colors.fold(0, |sum, color| {
            sum + color.iter().fold(0, |most, c| c.unsigned_abs().max(most)) as u64
        })
    }
}

/// A position in units of 2^`exponent`, |c| ≤ 2^62. One too far for that is brought nearer on its line from the
/// origin, to 2^61 at least, where a fragment's |p| ≤ 2^31 turns the direction by no more than 2^-30.
fn to_units<T: Word>(position: Block<T, 3>, exponent: i32) -> [i64; 3] {
    let mantissas = position.mantissas().map(T::to_i64);
    let all_bits = mantissas.iter().fold(0, |bits, c| bits | c.unsigned_abs());
    let room = (all_bits.leading_zeros() as i32 - 2).max(0);
    let shift = position.exponent().saturating_sub(exponent);
    if shift >= 0 {
        let up = shift.min(room) as u32;
        return mantissas.map(|c| c << up.min(63));
    }
    let down = shift.unsigned_abs();
    if down > 62 {
        return [0; 3];
    }
    // |c| ≤ 2^62 leaves room for the half.
    mantissas.map(|c| (c + (1 << (down - 1))) >> down)
}

/// [`Lights`] as the fragments of one primitive need them; made by [`Lights::at_scale`].
///
/// ```
/// use fixel::{light::{Light, Lights, Matte}, num::Block};
/// let mut lights = Lights::<i32, 0, 1>::default();
/// lights.add(Light::Bulb { position: Block::from_integers([0, 0, 4]), color: [1 << 16; 3] })?;
/// // Fragments in 1/256: the bulb is at (0, 0, 1024) now, 512 before this one, and shines fully on it.
/// let scene = lights.at_scale(-8);
/// assert_eq!(scene.shade([0, 0, 9], [0, 0, 512], [1000, 0, -1000], &Matte), [1000, 0, -1000]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Lit<'a, const BULBS: usize, P = TwoSteps> {
    suns: &'a [Lamp<i32>],
    bulbs: Vec<Lamp<i64>, BULBS>,
    /// See [`Sums::add`].
    cut: u32,
    precision: PhantomData<P>,
}

impl<const BULBS: usize, P: Precision> Lit<'_, BULBS, P> {
    /// The colour of one fragment, in units of 2^-16 of full, saturated at ±2^15 of full and otherwise not clamped.
    ///
    /// `normal`: any length; interpolated ones need not be normalised. 0 is dark. `position`: the fragment's in eye
    /// space, in the units given to [`at_scale`](Lights::at_scale); not looked at with suns only on a [`Matte`]
    /// surface. `surface`: its colour without light, in units of 2^-16 of full.
    #[inline]
    pub fn shade<F: Finish>(&self, normal: [i32; 3], position: [i32; 3], surface: [i32; 3], finish: &F) -> [i32; 3] {
        let Some(sum) = self.sum(normal, position, finish) else {
            return [0; 3];
        };
        if !P::LONG {
            return sum.saturated_color(surface);
        }
        sum.color(surface)
            .map(|c| c.clamp(i32::MIN as i64, i32::MAX as i64) as i32)
    }

    /// As [`shade`](Self::shade), but not clamped: below 2^63.1, where only more than 60000 lights of full range reach 2^63,
    /// and saturate there. For colours in units so fine that what is full does not fit an `i32`.
    ///
    /// ```
    /// use fixel::light::{Light, Lights, Matte};
    /// let mut lights = Lights::<i32, 1, 0>::default();
    /// lights.add(Light::sun([0, 0, 1], [1 << 30; 3])?)?;
    /// let scene = lights.at_scale(0);
    /// // 2^14 of full on a surface of 2^14: 2^28 of full.
    /// assert_eq!(scene.shade_wide([0, 0, 1], [0; 3], [1 << 30; 3], &Matte), [1 << (28 + 16); 3]);
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    #[inline]
    pub fn shade_wide<F: Finish>(
        &self,
        normal: [i32; 3],
        position: [i32; 3],
        surface: [i32; 3],
        finish: &F,
    ) -> [i64; 3] {
        self.sum(normal, position, finish)
            .map_or([0; 3], |sum| sum.color(surface))
    }

    /// What the lights add up to; `None` without a normal.
    #[inline(always)]
    fn sum<'f, F: Finish>(&self, normal: [i32; 3], position: [i32; 3], finish: &'f F) -> Option<Sum<'f, F, P>> {
        let normal = P::unit(normal)?;
        let mut sum = Sum::<F, P> {
            normal,
            finish,
            to_eye: [0; 3],
            cut: self.cut,
            diffuse: Sums::default(),
            specular: Sums::default(),
        };
        if F::SHINES {
            sum.to_eye = P::unit(position).unwrap_or_default().map(|c| -c);
        }
        for sun in self.suns {
            sum.add(sun.place, sun.color);
        }
        // Without room for bulbs the compiler drops what follows.
        if BULBS > 0 {
            for bulb in &self.bulbs {
                if let Some(direction) = P::unit_wide(minus(bulb.place, position)) {
                    sum.add(direction, bulb.color);
                }
            }
        }
        Some(sum)
    }
}

/// What the lights so far add.
struct Sum<'a, F, P> {
    normal: [i32; 3],
    finish: &'a F,
    to_eye: [i32; 3],
    cut: u32,
    /// Σ c · light: the surface's colour is the same for all.
    diffuse: Sums<P>,
    specular: Sums<P>,
}

impl<F: Finish, P: Precision> Sum<'_, F, P> {
    #[inline(always)]
    fn add(&mut self, direction: [i32; 3], color: [i32; 3]) {
        let cosine = P::dot(self.normal, direction);
        if cosine <= 0 {
            return;
        }
        self.diffuse.add(color, cosine, self.cut);
        if F::SHINES {
            let half = P::unit(plus(direction, self.to_eye)).unwrap_or_default();
            let strength = self.finish.strength_at::<P>(P::dot(self.normal, half).max(0));
            self.specular.add(color, strength, self.cut);
        }
    }

    #[inline(always)]
    fn color(&self, surface: [i32; 3]) -> [i64; 3] {
        let mut color = self.diffuse.on(surface, self.cut);
        if F::SHINES {
            let specular = self.specular.on([self.finish.highlight(); 3], self.cut);
            for (color, specular) in color.iter_mut().zip(specular) {
                *color = color.saturating_add(specular);
            }
        }
        color
    }

    /// Short sums as [`color`](Self::color), saturated.
    #[inline(always)]
    fn saturated_color(&self, surface: [i32; 3]) -> [i32; 3] {
        let mut color = self.diffuse.parts_on(surface);
        if F::SHINES {
            let specular = self.specular.parts_on([self.finish.highlight(); 3]);
            for (color, specular) in color.iter_mut().zip(specular) {
                // Only where both are the largest there are is it a unit too much.
                *color = color.saturating_add(specular);
            }
        }
        color.map(|part| sums::uncut(part, self.cut))
    }
}

/// How a surface throws light back towards the eye: [`Matte`], [`Shiny`], or one's own.
///
/// ```
/// use fixel::{light::Finish, num::power};
///
/// /// A highlight in two steps, for a cartoon.
/// struct Cartoon;
///
/// impl Finish for Cartoon {
///     const SHINES: bool = true;
///     fn strength(&self, cosine: i32) -> i32 {
///         if cosine > (1 << 30) / 10 * 9 { 1 << 30 } else { 0 }
///     }
/// }
/// assert_eq!(Cartoon.strength(1 << 29), 0);
/// ```
pub trait Finish {
    /// Whether there is a highlight at all; without one there is no code for it.
    const SHINES: bool;
    /// Share of the light, best 0…1, for n·h in 0…1, both in units of 2^-30. The cosine may pass 1
    /// by twice the [`UNIT_ERROR`](Precision::UNIT_ERROR).
    fn strength(&self, cosine: i32) -> i32;
    /// The same at the precision of the lights; [`strength`](Self::strength) itself unless there is a cheaper way.
    #[inline(always)]
    fn strength_at<P: Precision>(&self, cosine: i32) -> i32 {
        self.strength(cosine)
    }
    /// How bright the highlight is, in the unit of surface colours: full is 2^16 unless the caller has chosen another one.
    #[inline(always)]
    fn highlight(&self) -> i32 {
        1 << 16
    }
}

/// No highlight.
///
/// ```
/// use fixel::light::{Finish, Matte};
/// assert!(!Matte::SHINES);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Matte;

impl Finish for Matte {
    const SHINES: bool = false;
    #[inline(always)]
    fn strength(&self, _: i32) -> i32 {
        0
    }
}

/// Blinn-Phong: (n·h)^a with a in units of 2^-16, see [`power`].
///
/// ```
/// use fixel::light::{Finish, Shiny};
/// assert_eq!(Shiny(2 << 16).strength(1 << 29), 1 << 28);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shiny(pub u32);

impl Finish for Shiny {
    const SHINES: bool = true;
    #[inline]
    fn strength(&self, cosine: i32) -> i32 {
        power(cosine, self.0)
    }
    #[inline]
    fn strength_at<P: Precision>(&self, cosine: i32) -> i32 {
        P::power(cosine, self.0)
    }
}

/// sums += color · share, from units of 2^-46 to 2^-30.
#[inline(always)]
fn accumulate(sums: &mut [i64; 3], color: [i32; 3], share: i32) {
    for (sum, color) in sums.iter_mut().zip(color) {
        *sum += (color as i64 * share as i64) >> 16;
    }
}

/// a·b·2^-30, rounded, in two halves, for |a| < 2^61.5: each product is below 2^63.
#[inline(always)]
fn times(a: i64, b: i32) -> i64 {
    (((a >> 32) * b as i64) << 2) + (((a & u32::MAX as i64) * b as i64 + (1 << 29)) >> 30)
}

#[inline(always)]
fn minus(a: [i64; 3], b: [i32; 3]) -> [i64; 3] {
    let mut difference = a;
    for (a, b) in difference.iter_mut().zip(b) {
        *a -= b as i64;
    }
    difference
}

#[inline(always)]
fn plus(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    let mut sum = a;
    for (a, b) in sum.iter_mut().zip(b) {
        // 1 + 1 is a unit too much for the word.
        *a = a.saturating_add(b);
    }
    sum
}
