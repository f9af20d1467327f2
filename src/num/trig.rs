//! Sine and cosine: from tables, or from `micromath`.

use super::word::{Wide, Word};

/// An angle as a fraction of a turn, in units of 2^-64 turn: whole turns vanish by themselves.
///
/// ```
/// use fixel::num::Angle;
/// assert_eq!(Angle::from_degrees(-90), Angle::from_degrees(270));
/// assert_eq!(Angle::from_degrees(180), Angle::from_turns(1 << 63));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Angle(u64);

impl Angle {
    /// `turns` in units of 2^-64 turn.
    ///
    /// ```
    /// use fixel::num::Angle;
    /// assert_eq!(Angle::from_turns(1 << 62), Angle::from_degrees(90));
    /// ```
    pub const fn from_turns(turns: u64) -> Self {
        Angle(turns)
    }

    /// Whole degrees, either sign, any number of turns; rounded down to 2^-64 turn.
    ///
    /// ```
    /// use fixel::num::Angle;
    /// assert_eq!(Angle::from_degrees(450), Angle::from_degrees(90));
    /// ```
    pub const fn from_degrees(degrees: i32) -> Self {
        // 2^64 = 360 · whole + rest.
        let (whole, rest) = (u64::MAX / 360, u64::MAX % 360 + 1);
        let degrees = degrees.rem_euclid(360) as u64;
        Angle(degrees * whole + ((degrees * rest) as u32 / 360) as u64)
    }

    /// Radians in units of 2^-32, any number of turns; within (1 + 2^-33·|radians|)·2^-64 turn.
    ///
    /// ```
    /// use fixel::num::Angle;
    /// let half = Angle::from_radians(13_493_037_705); // π
    /// assert!(half.turns().abs_diff(1 << 63) < 1 << 31);
    /// ```
    pub const fn from_radians(radians: i64) -> Self {
        // 2^32/2π in units of 2^-32, rounded: half a unit counts 2^-33 per unit of the radians.
        const TURNS_PER_UNIT: i128 = 2_935_890_503_282_001_226;
        Angle(((radians as i128 * TURNS_PER_UNIT) >> 32) as u64)
    }

    /// In units of 2^-64 turn.
    pub const fn turns(self) -> u64 {
        self.0
    }
}

/// A source of sine and cosine, chosen at compile time where a rotation is made.
pub trait Trigonometry {
    /// Sine and cosine in units of 2^-BITS (see [`Word::BITS`]), in −2^BITS…2^BITS.
    fn sin_cos<T: Word>(angle: Angle) -> (T, T);
}

/// The nearest of 65 table entries over a quarter turn, and a Taylor polynomial from there.
///
/// Error at most 2^-28 with 32-bit words and 2^-59 with 64-bit words (`tests/trigonometry.rs` measures both).
///
/// ```
/// use fixel::num::{Angle, SineTable, Trigonometry};
/// let (sin, cos) = SineTable::sin_cos::<i32>(Angle::from_degrees(30));
/// assert!((sin - (1 << 29)).abs() <= 4);
/// assert!((cos - 929_887_697).abs() <= 4);
/// ```
#[derive(Debug, Clone, Copy)]
pub enum SineTable {}

impl Trigonometry for SineTable {
    fn sin_cos<T: Word>(angle: Angle) -> (T, T) {
        // The quarter turn is in the top two bits; then the nearest of 64 steps of π/128; the rest is within ±π/256.
        let quarter = angle.0 >> 62;
        let within = angle.0 & (u64::MAX >> 2);
        let step = (within + (1 << 55)) >> 56;
        let rest = within as i64 - (step << 56) as i64;
        let entry = |i: u64| T::SINES.get(i as usize).copied().unwrap_or(T::ZERO);
        let (sin, cos) = (entry(step), entry(64 - step));

        // rest · 2^-64 turn = rest · (π/2) · 2^-62 rad.
        let radians = T::from_q62(((rest as i128 * HALF_PI as i128) >> 62) as i64);
        let (sin_rest, versine_rest) = small_angle(radians);
        let one = T::ONE << T::BITS;
        let turned_sin = (sin - fraction(sin, versine_rest) + fraction(cos, sin_rest)).clamp(-one, one);
        let turned_cos = (cos - fraction(cos, versine_rest) - fraction(sin, sin_rest)).clamp(-one, one);
        match quarter {
            0 => (turned_sin, turned_cos),
            1 => (turned_cos, -turned_sin),
            2 => (-turned_sin, -turned_cos),
            _ => (-turned_cos, turned_sin),
        }
    }
}

/// The two neighbours of 65 table entries of 16 bits over a quarter turn, and the straight line between them: two products of 32
/// bits and 130 bytes.
///
/// Error at most 10^-4 with either word (`tests/trigonometry.rs`): a point turned at 160 px from the axis is within 0.023 px. A
/// turn of a whole number of right angles is exact.
///
/// ```
/// use fixel::num::{Angle, ShortSine, Trigonometry};
/// let (sin, cos) = ShortSine::sin_cos::<i32>(Angle::from_degrees(30));
/// assert!((sin - (1 << 29)).abs() < 1 << 17 && (cos - 929_887_697).abs() < 1 << 17);
/// assert_eq!(ShortSine::sin_cos::<i32>(Angle::from_degrees(180)), (0, -1 << 30));
/// ```
#[derive(Debug, Clone, Copy)]
pub enum ShortSine {}

impl Trigonometry for ShortSine {
    fn sin_cos<T: Word>(angle: Angle) -> (T, T) {
        // In units of 2^-30 of a quarter turn; 6 bits pick the entry, the next 15 are the share of the one after it.
        let turns = (angle.0 >> 32) as u32;
        let within = turns & (u32::MAX >> 2);
        let line = |within: u32| {
            let (index, share) = ((within >> 24) as usize, (within >> 9) & 0x7fff);
            let entry = |i: usize| SINES_15.get(i).copied().unwrap_or(1 << 15) as u32;
            let (first, next) = (entry(index), entry(index + 1));
            // At most 2^30.
            let sine = (first << 15) + next.wrapping_sub(first) * share;
            T::from_q62((sine as i64) << 32)
        };
        let (sin, cos) = (line(within), line((1 << 30) - within));
        match turns >> 30 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }
}

/// sin(i·π/128) in units of 2^-15, rounded to nearest.
const SINES_15: [u16; 65] = {
    let mut sines = [0; 65];
    let mut i = 0;
    while i < 65 {
        sines[i] = ((SINES_30[i] + (1 << 14)) >> 15) as u16;
        i += 1;
    }
    sines
};

/// sin r and 1 − cos r for |r| ≤ π/256 in units of 2^-BITS: Taylor to r⁷ and r⁶ (r⁸/8! < 2^-66), with 32-bit words to
/// r³ and r² (r⁴/4! < 2^-29.9).
fn small_angle<T: Word>(r: T) -> (T, T) {
    let part = |numerator: T, over: i64| fraction(numerator, T::from_q62((1 << 62) / over));
    let square = fraction(r, r);
    let one = T::ONE << T::BITS;
    let (sine_series, versine_series) = if T::BITS > 32 {
        let sine = one - part(fraction(square, one - part(square, 42)), 20);
        let versine = one - part(fraction(square, one - part(square, 30)), 12);
        (sine, versine)
    } else {
        (one, one)
    };
    let sin = r - fraction(r, part(fraction(square, sine_series), 6));
    (sin, fraction(square, versine_series) >> 1)
}

/// Product of two numbers in units of 2^-BITS, rounded to nearest.
#[inline]
fn fraction<T: Word>(a: T, b: T) -> T {
    ((a.times(b) + (T::ONE.widen() << (T::BITS - 1))) >> T::BITS).narrow()
}

/// `micromath`'s f32 sine and cosine: error at most 1.2·10⁻³ (`tests/trigonometry.rs`). For firmware that links
/// micromath anyway and rotates by whole objects; [`SineTable`] is far more accurate and needs no float.
///
/// ```
/// use fixel::num::{Angle, Micromath, Trigonometry};
/// let (sin, _) = Micromath::sin_cos::<i32>(Angle::from_degrees(30));
/// assert!((sin - (1 << 29)).abs() < 1_300_000); // 1.2e-3 of 2^30
/// ```
#[cfg(feature = "micromath")]
#[derive(Debug, Clone, Copy)]
pub enum Micromath {}

#[cfg(feature = "micromath")]
impl Trigonometry for Micromath {
    fn sin_cos<T: Word>(angle: Angle) -> (T, T) {
        // The top 24 bits are what an f32 holds, as −½…½ turn.
        let radians = ((angle.0 as i64) >> 40) as f32 * (core::f32::consts::TAU / (1 << 24) as f32);
        let to_word = |v: f32| T::from_q62((v.clamp(-1.0, 1.0) * (1i64 << 62) as f32) as i64);
        // By full name: where std is linked, as in tests, f32 has a sine of its own.
        (
            to_word(micromath::F32Ext::sin(radians)),
            to_word(micromath::F32Ext::cos(radians)),
        )
    }
}

/// π/2 in units of 2^-62.
const HALF_PI: i64 = 0x6487_ed51_10b4_611a;

/// sin(i·π/128) in units of 2^-62, rounded to nearest; `tests/trigonometry.rs` computes it again.
pub(super) const SINES_62: [i64; 65] = [
    0x0,
    0x192155f7a3667e0,
    0x323ecbe21bb027d,
    0x4b54824b3867d73,
    0x645e9af0a6d0af8,
    0x7d59395aa5cc38d,
    0x964083747309d11,
    0xaf10a22459fe32a,
    0xc7c5c1e34d3055b,
    0xe05c1353f27b17e,
    0xf8cfcbd90af8d58,
    0x1111d262b1f67761,
    0x1294062ed59f05a9,
    0x14135c9417660143,
    0x158f9a75ab1fdcfe,
    0x17088530fa459eaf,
    0x187de2a6aea962d2,
    0x19ef7943a8ed8a2e,
    0x1b5d1009e15cc02b,
    0x1cc66e9931c45e17,
    0x1e2b5d3806f63b1e,
    0x1f8ba4dbf89ab9fb,
    0x20e70f3245ffdb2d,
    0x223d66a836964508,
    0x238e76735cd190d9,
    0x24da0a99ba25bd51,
    0x261feff9c2e069c2,
    0x275ff45240a17279,
    0x2899e64a123bac30,
    0x29cd9577c7cbd228,
    0x2afad26919d93f45,
    0x2c216eaa3a59bdb7,
    0x2d413cccfe779921,
    0x2e5a106fdfff2c87,
    0x2f6bbe44d55f5dbc,
    0x30761c17ff2edba4,
    0x317900d62a2e816a,
    0x3274449324c7f69f,
    0x3367c08fe70e8168,
    0x34534f408c4f03bb,
    0x3536cc521d434606,
    0x361214b02a03ff37,
    0x36e5068a32dc7b22,
    0x37af8158df2a533f,
    0x387165e3017b61a4,
    0x392a96426823e9ed,
    0x39daf5e8798ee5e2,
    0x3a8269a29b927359,
    0x3b20d79e651a8c51,
    0x3bb6276d998478c2,
    0x3c424209ed0dc97f,
    0x3cc511d891c223dd,
    0x3d3e82ad8c5bb4bb,
    0x3dae81ced092c67a,
    0x3e14fdf72461ae55,
    0x3e71e758c9cb118a,
    0x3ec52f9feeb96056,
    0x3f0ec9f4e297526b,
    0x3f4eaafe114a2d43,
    0x3f84c8e1c33fa68f,
    0x3fb11b47a24a4b3c,
    0x3fd39b5a0310742a,
    0x3fec43c6f2dafbc7,
    0x3ffb10c1099a1976,
    0x4000000000000000,
];

/// sin(i·π/128) in units of 2^-30, rounded to nearest; `tests/trigonometry.rs` computes it again.
pub(super) const SINES_30: [i32; 65] = [
    0x0, 0x192155f, 0x323ecbe, 0x4b54825, 0x645e9af, 0x7d59396, 0x9640837, 0xaf10a22, 0xc7c5c1e, 0xe05c135, 0xf8cfcbe,
    0x1111d263, 0x1294062f, 0x14135c94, 0x158f9a76, 0x17088531, 0x187de2a7, 0x19ef7944, 0x1b5d100a, 0x1cc66e99,
    0x1e2b5d38, 0x1f8ba4dc, 0x20e70f32, 0x223d66a8, 0x238e7673, 0x24da0a9a, 0x261feffa, 0x275ff452, 0x2899e64a,
    0x29cd9578, 0x2afad269, 0x2c216eaa, 0x2d413ccd, 0x2e5a1070, 0x2f6bbe45, 0x30761c18, 0x317900d6, 0x32744493,
    0x3367c090, 0x34534f41, 0x3536cc52, 0x361214b0, 0x36e5068a, 0x37af8159, 0x387165e3, 0x392a9642, 0x39daf5e8,
    0x3a8269a3, 0x3b20d79e, 0x3bb6276e, 0x3c42420a, 0x3cc511d9, 0x3d3e82ae, 0x3dae81cf, 0x3e14fdf7, 0x3e71e759,
    0x3ec52fa0, 0x3f0ec9f5, 0x3f4eaafe, 0x3f84c8e2, 0x3fb11b48, 0x3fd39b5a, 0x3fec43c7, 0x3ffb10c1, 0x40000000,
];
