//! Block floating point: numbers that share one power-of-two scale.

use super::word::{Wide, Word};

/// N numbers that share one scale: number i is `mantissas[i] · 2^exponent`.
///
/// The largest magnitude lies in 2^(BITS−1)…2^BITS (see [`Word::BITS`]) unless all are 0. Rounding is to nearest, at
/// most half a unit of the last place: 2^-BITS relative to the largest number.
///
/// ```
/// use fixel::num::Block;
/// let v = Block::<i32, 3>::from_integers([3, -4, 0]);
/// assert_eq!(v, Block::from_integers([6, -8, 0]).scaled(-1));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Block<T, const N: usize> {
    mantissas: [T; N],
    exponent: i32,
}

/// One number: `mantissa · 2^exponent`.
///
/// ```
/// use fixel::num::Scaled;
/// let third = Scaled::<i64>::from_integer(1).over(Scaled::from_integer(3)).unwrap();
/// assert_eq!(third.to_fixed(32), (1i64 << 32) / 3);
/// ```
pub type Scaled<T> = Block<T, 1>;

impl<T: Word, const N: usize> Block<T, N> {
    /// All 0.
    pub const ZERO: Self = Block {
        mantissas: [T::ZERO; N],
        exponent: 0,
    };

    /// The numbers `mantissas[i] · 2^exponent`, exactly: any mantissas of at most [`Word::BITS`] bits.
    ///
    /// A function of its own: constants are made of it in many places of a program.
    #[inline(never)]
    pub fn new(mantissas: [T; N], exponent: i32) -> Self {
        let mut block = Block::ZERO;
        // In place of what is given, callers would have to keep another.
        // Few numbers are what corners of polygons are made of, where a call costs a tenth of clipping on Cortex-M4.
        block.exponent = if N < 4 {
            fit(&mantissas, &mut block.mantissas, exponent)
        } else {
            fit_many(&mantissas, &mut block.mantissas, exponent)
        };
        block
    }

    /// Small integers, |v| ≤ 2^30.
    #[inline]
    pub fn from_integers(values: [i32; N]) -> Self {
        Self::new(values.map(T::from_i32), 0)
    }

    /// The numbers `values[i] · 2^exponent`, rounded to nearest at the shared scale.
    #[inline]
    pub fn from_wide(mut values: [T::Wide; N], exponent: i32) -> Self {
        let bits = T::Wide::normalize(&mut values);
        Self::of_normalized(values.map(T::Wide::narrow), bits, exponent)
    }

    /// As [`from_wide`](Self::from_wide), where a call would cost more than the code: of every vertex.
    #[inline]
    pub(crate) fn from_wide_here(values: [T::Wide; N], exponent: i32) -> Self {
        let (mantissas, bits) = T::Wide::normalized(values);
        Self::of_normalized(mantissas, bits, exponent)
    }

    /// As [`from_wide`](Self::from_wide), of numbers that are changed. A function of its own: nothing is copied.
    #[inline(never)]
    pub(crate) fn set_wide(&mut self, values: &mut [T::Wide; N], exponent: i32) {
        let bits = T::Wide::normalize(values);
        for (to, value) in self.mantissas.iter_mut().zip(values) {
            *to = value.narrow();
        }
        self.exponent = if bits == 0 {
            0
        } else {
            exponent.saturating_add(bits as i32 - T::BITS as i32)
        };
    }

    #[inline(always)]
    fn of_normalized(mantissas: [T; N], bits: u32, exponent: i32) -> Self {
        if bits == 0 {
            return Self::ZERO;
        }
        Block {
            mantissas,
            exponent: exponent.saturating_add(bits as i32 - T::BITS as i32),
        }
    }

    /// The numbers `mantissas[i] · 2^exponent`, of mantissas that may all be small; [`normalized`](Self::normalized) before anything else is done with it.
    #[inline(always)]
    pub(crate) const fn raw(mantissas: [T; N], exponent: i32) -> Self {
        Block { mantissas, exponent }
    }

    /// The same numbers with mantissas as they should be.
    #[inline]
    pub(crate) fn normalized(self) -> Self {
        let half = T::ONE << (T::BITS - 1);
        if self.mantissas.iter().any(|&m| m >= half || m <= -half) {
            self
        } else {
            Self::new(self.mantissas, self.exponent)
        }
    }

    /// Numbers of different scales, rounded to that of the largest.
    pub fn gather(numbers: [Scaled<T>; N]) -> Self {
        let top = |s: &Scaled<T>| if s.is_zero() { i32::MIN } else { s.exponent };
        let exponent = numbers.iter().map(top).fold(i32::MIN, i32::max);
        let wide = numbers.map(|s| {
            let [m] = s.mantissas;
            let gap = exponent.saturating_sub(s.exponent).clamp(0, 2 * T::BITS as i32) as u32;
            (m.widen() << T::BITS) >> gap
        });
        Self::from_wide(wide, exponent.saturating_sub(T::BITS as i32))
    }

    /// Every number by itself.
    #[inline]
    pub fn split(self) -> [Scaled<T>; N] {
        self.mantissas.map(|m| Scaled::new([m], self.exponent))
    }

    /// The integers; see [`exponent`](Self::exponent).
    #[inline]
    pub fn mantissas(&self) -> [T; N] {
        self.mantissas
    }

    /// The same where they are.
    #[inline(always)]
    pub(crate) fn as_mantissas(&self) -> &[T; N] {
        &self.mantissas
    }

    /// The shared power of two.
    #[inline]
    pub fn exponent(&self) -> i32 {
        self.exponent
    }

    /// All times 2^power.
    #[inline]
    pub fn scaled(self, power: i32) -> Self {
        if self.is_zero() {
            self
        } else {
            Block {
                exponent: self.exponent.saturating_add(power),
                ..self
            }
        }
    }

    /// Whether all are 0.
    #[inline]
    pub fn is_zero(&self) -> bool {
        self.mantissas.iter().all(|&m| m == T::ZERO)
    }

    /// All negated.
    #[inline]
    pub fn negated(self) -> Self {
        Block {
            mantissas: self.mantissas.map(|m| -m),
            ..self
        }
    }

    /// As [`negated`](Self::negated), in place.
    #[inline]
    pub(crate) fn negate(&mut self) {
        for mantissa in &mut self.mantissas {
            *mantissa = -*mantissa;
        }
    }

    /// Component by component sum; each term is cut to 2^-BITS of the last place of the larger one first.
    pub fn plus(self, other: Self) -> Self {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        let (big, small) = if self.exponent >= other.exponent {
            (self, other)
        } else {
            (other, self)
        };
        let gap = big.exponent.saturating_sub(small.exponent) as u32;
        // BITS guard bits below the larger block: exact for gaps up to BITS, and |sum| < 2^(2·BITS + 1).
        let mut sums = big.mantissas.map(|m| m.widen() << T::BITS);
        for (sum, m) in sums.iter_mut().zip(small.mantissas) {
            *sum = *sum + ((m.widen() << T::BITS) >> gap.min(2 * T::BITS + 1));
        }
        Self::from_wide(sums, big.exponent.saturating_sub(T::BITS as i32))
    }

    /// Component by component difference.
    #[inline]
    pub fn minus(self, other: Self) -> Self {
        self.plus(other.negated())
    }

    /// Every number times the same factor.
    pub fn times(self, factor: Scaled<T>) -> Self {
        let [f] = factor.mantissas;
        Self::from_wide(
            self.mantissas.map(|m| m.times(f)),
            self.exponent.saturating_add(factor.exponent),
        )
    }

    /// Every number over the same divisor; `None` where that is 0. Within 2^(1−BITS) of the largest quotient.
    pub fn over(self, divisor: Scaled<T>) -> Option<Self> {
        let [d] = divisor.mantissas;
        if d == T::ZERO {
            return None;
        }
        let (block, d) = if d < T::ZERO { (self.negated(), -d) } else { (self, d) };
        let quotients = block.mantissas.map(|m| m.ratio(d));
        let exponent = block
            .exponent
            .saturating_sub(divisor.exponent)
            .saturating_sub(T::BITS as i32);
        Some(Self::from_wide(quotients, exponent))
    }
}

/// As [`fit`]. A function of its own: the same for however many numbers.
#[inline(never)]
fn fit_many<T: Word>(mantissas: &[T], fitted: &mut [T], exponent: i32) -> i32 {
    fit(mantissas, fitted, exponent)
}

/// `mantissas · 2^exponent` as those of a [`Block`], unless all are 0; their exponent.
#[inline(always)]
fn fit<T: Word>(mantissas: &[T], fitted: &mut [T], exponent: i32) -> i32 {
    let bits = mantissas.iter().fold(0, |bits, m| m.bit_length().max(bits));
    if bits == 0 {
        return 0;
    }
    let up = T::BITS.wrapping_sub(bits) as i32;
    for (to, &m) in fitted.iter_mut().zip(mantissas) {
        *to = if up >= 0 {
            m << up as u32
        } else {
            // One bit too many: a half is rounded upwards.
            let half = m >> up.wrapping_neg().wrapping_sub(1) as u32;
            (half >> 1) + (half & T::ONE)
        };
    }
    exponent.saturating_sub(up)
}

impl<T: Word> Scaled<T> {
    /// A small integer, |v| ≤ 2^30.
    ///
    /// ```
    /// use fixel::num::Scaled;
    /// assert_eq!(Scaled::<i32>::from_integer(-5).to_fixed(8), -5 * 256);
    /// ```
    #[inline]
    pub fn from_integer(value: i32) -> Self {
        Self::from_integers([value])
    }

    /// The number in units of 2^-fraction_bits, rounded down and saturating.
    #[inline]
    pub fn to_fixed(self, fraction_bits: u32) -> i64 {
        let [m] = self.mantissas;
        let shift = self.exponent.saturating_add_unsigned(fraction_bits);
        if shift >= 0 {
            let room = (m.to_i64().unsigned_abs().leading_zeros() as i32) - 1;
            if shift <= room || m == T::ZERO {
                return m.to_i64() << shift.min(63);
            }
            return if m < T::ZERO { i64::MIN } else { i64::MAX };
        }
        m.to_i64() >> shift.unsigned_abs().min(63)
    }
}

impl<T: Word> Block<T, 3> {
    /// Exact cross product, rounded once to the shared scale.
    pub fn cross(self, other: Self) -> Self {
        let [a, b, c] = self.mantissas;
        let [x, y, z] = other.mantissas;
        let products = [
            b.times(z) - c.times(y),
            c.times(x) - a.times(z),
            a.times(y) - b.times(x),
        ];
        Self::from_wide(products, self.exponent.saturating_add(other.exponent))
    }

    /// Exact dot product, rounded once.
    pub fn dot(self, other: Self) -> Scaled<T> {
        let [a, b, c] = self.mantissas;
        let [x, y, z] = other.mantissas;
        Scaled::from_wide(
            [a.times(x) + b.times(y) + c.times(z)],
            self.exponent.saturating_add(other.exponent),
        )
    }

    /// The same direction with length 1, in units of 2^-BITS; `None` for the zero vector.
    ///
    /// Each component is within 2^(2−BITS) of the true one.
    pub fn unit(self) -> Option<[T; 3]> {
        let [x, y, z] = self.mantissas;
        // 2^(2·BITS−2) ≤ sum ≤ 3·2^(2·BITS): the root has BITS bits or one more.
        let length = (x.times(x) + y.times(y) + z.times(z)).isqrt();
        if length == T::Wide::ZERO {
            return None;
        }
        let one = T::ONE << T::BITS;
        // The root is rounded down, so that a quotient can pass 1 by a unit.
        Some(
            self.mantissas
                .map(|m| (m.widen() << T::BITS).div_floor(length).narrow().clamp(-one, one)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_normalised_as_wide_ones_are() {
        let ends = [0, 1, -1, 3, -5, 0x1fff_ffff, -0x2000_0000, 0x3fff_fffe, 0x3fff_ffff];
        for a in ends.into_iter().chain([1 << 30, -(1 << 30), i32::MAX, i32::MIN]) {
            for b in ends {
                let wide = Block::<i32, 2>::from_wide([a as i64, b as i64], 7);
                assert_eq!(Block::new([a, b], 7), wide, "{a} {b}");
                let (c, d) = ((a as i64) << 31 | 1, (b as i64) << 32 | 1);
                let wide = Block::<i64, 2>::from_wide([c as i128, d as i128], -9);
                assert_eq!(Block::new([c, d], -9), wide, "{c} {d}");
            }
        }
    }
}
