//! Exact arithmetic of any size on numbers ±digits · 2^exponent, and the way from floats to blocks and back. Slow and
//! plain: sums and products are exact, there is no division (a quotient is checked by multiplying back).

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use fixel::num::{Block, Scaled, Word};
use proptest::prelude::*;

/// ±digits · 2^exponent, digits in base 2^32 from the lowest on.
#[derive(Debug, Clone)]
pub struct Exact {
    negative: bool,
    digits: Vec<u32>,
    exponent: i64,
}

impl Exact {
    /// `value` · 2^exponent.
    pub fn new(value: impl Into<i128>, exponent: i32) -> Self {
        let value = value.into();
        let magnitude = value.unsigned_abs();
        let digits = (0..4).map(|i| (magnitude >> (32 * i)) as u32).collect();
        Exact {
            negative: value < 0,
            digits,
            exponent: exponent.into(),
        }
    }

    /// The very number.
    pub fn of<T: Word>(number: Scaled<T>) -> Self {
        let [m] = number.mantissas();
        Self::new(m.to_i64(), number.exponent())
    }

    pub fn zero() -> Self {
        Self::new(0, 0)
    }

    /// 2^power.
    pub fn power(power: i32) -> Self {
        Self::new(1, power)
    }

    pub fn abs(mut self) -> Self {
        self.negative = false;
        self
    }

    pub fn is_zero(&self) -> bool {
        self.digits.iter().all(|&d| d == 0)
    }

    /// The larger of two.
    pub fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    /// Cut towards zero to a multiple of 2^-bits, so that a long computation stays small.
    pub fn cut(mut self, bits: i64) -> Self {
        while self.exponent < -bits {
            if self.is_zero() {
                return Self::zero();
            }
            let drop = (-bits - self.exponent).min(31) as u32;
            let mut carry = 0u64;
            for digit in self.digits.iter_mut().rev() {
                let both = carry << 32 | *digit as u64;
                *digit = (both >> drop) as u32;
                carry = both & ((1 << drop) - 1);
            }
            self.exponent += drop as i64;
        }
        self
    }

    /// To the precision of a double; infinite or 0 beyond its range.
    pub fn to_f64(&self) -> f64 {
        let mut value = 0.0;
        for (i, &digit) in self.digits.iter().enumerate() {
            value += digit as f64 * power(self.exponent + 32 * i as i64);
        }
        if self.negative { -value } else { value }
    }

    /// The digits with `exponent` lowered to `to`.
    fn lowered(&self, to: i64) -> Vec<u32> {
        let shift = (self.exponent - to) as usize;
        assert!(shift < 100_000, "numbers too far apart for a test");
        let mut digits = vec![0; shift / 32];
        let mut carry = 0;
        for &digit in &self.digits {
            let both = (digit as u64) << (shift % 32) | carry;
            digits.push(both as u32);
            carry = both >> 32;
        }
        digits.push(carry as u32);
        digits
    }
}

fn power(exponent: i64) -> f64 {
    // In two steps: 2^exponent alone may leave the range.
    let half = exponent.clamp(-2000, 2000) as i32 / 2;
    2f64.powi(half) * 2f64.powi(exponent.clamp(-2000, 2000) as i32 - half)
}

/// |a| compared with |b|, both from the lowest digit on.
fn compare(a: &[u32], b: &[u32]) -> Ordering {
    let digit = |d: &[u32], i: usize| d.get(i).copied().unwrap_or(0);
    (0..a.len().max(b.len()))
        .rev()
        .map(|i| digit(a, i).cmp(&digit(b, i)))
        .find(|o| o.is_ne())
        .unwrap_or(Ordering::Equal)
}

impl Add for &Exact {
    type Output = Exact;
    fn add(self, other: &Exact) -> Exact {
        let exponent = self.exponent.min(other.exponent);
        let (mut a, mut b) = (
            (self.negative, self.lowered(exponent)),
            (other.negative, other.lowered(exponent)),
        );
        if compare(&a.1, &b.1).is_lt() {
            (a, b) = (b, a);
        }
        let sign = if a.0 == b.0 { 1 } else { -1 };
        a.1.resize(a.1.len().max(b.1.len()) + 1, 0);
        let mut carry = 0i64;
        for (i, digit) in a.1.iter_mut().enumerate() {
            let sum = *digit as i64 + sign * b.1.get(i).copied().unwrap_or(0) as i64 + carry;
            *digit = sum as u32;
            carry = sum >> 32;
        }
        while a.1.last() == Some(&0) {
            a.1.pop();
        }
        Exact {
            negative: a.0,
            digits: a.1,
            exponent,
        }
    }
}

impl Neg for &Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        Exact {
            negative: !self.negative,
            ..self.clone()
        }
    }
}

impl Sub for &Exact {
    type Output = Exact;
    fn sub(self, other: &Exact) -> Exact {
        self + &-other
    }
}

impl Mul for &Exact {
    type Output = Exact;
    fn mul(self, other: &Exact) -> Exact {
        let mut digits = vec![0u32; self.digits.len() + other.digits.len() + 1];
        for (i, &a) in self.digits.iter().enumerate() {
            let mut carry = 0u64;
            for (j, digit) in digits[i..].iter_mut().enumerate() {
                let sum = a as u64 * other.digits.get(j).copied().unwrap_or(0) as u64 + *digit as u64 + carry;
                *digit = sum as u32;
                carry = sum >> 32;
            }
        }
        while digits.last() == Some(&0) {
            digits.pop();
        }
        Exact {
            negative: self.negative != other.negative,
            digits,
            exponent: self.exponent + other.exponent,
        }
    }
}

impl PartialEq for Exact {
    fn eq(&self, other: &Self) -> bool {
        (self - other).is_zero()
    }
}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let difference = self - other;
        Some(match (difference.is_zero(), difference.negative) {
            (true, _) => Ordering::Equal,
            (false, true) => Ordering::Less,
            (false, false) => Ordering::Greater,
        })
    }
}

/// Each number of a block.
pub fn exacts<T: Word, const N: usize>(block: Block<T, N>) -> [Exact; N] {
    block.split().map(Exact::of)
}

/// A float as a number of the word, rounded to nearest.
pub fn scaled<T: Word>(value: f64) -> Scaled<T> {
    if value == 0.0 {
        return Scaled::ZERO;
    }
    let exponent = value.abs().log2().floor() as i32 - 52;
    let mantissa = (value / power(exponent.into())) as i64;
    // Two parts that fit 32 bits each.
    let high = Scaled::<T>::from_integer((mantissa >> 27) as i32).scaled(27);
    high.plus(Scaled::from_integer((mantissa & ((1 << 27) - 1)) as i32))
        .scaled(exponent)
}

/// Floats at the scale of the largest.
pub fn block<T: Word, const N: usize>(values: [f64; N]) -> Block<T, N> {
    Block::gather(values.map(scaled))
}

/// A number as a float.
pub fn float<T: Word>(number: Scaled<T>) -> f64 {
    Exact::of(number).to_f64()
}

/// A block as floats.
pub fn floats<T: Word, const N: usize>(block: Block<T, N>) -> [f64; N] {
    block.split().map(float)
}

/// `count` units of 2^-BITS.
pub fn units<T: Word>(count: i64) -> Exact {
    Exact::new(count, -(T::BITS as i32))
}

/// The largest magnitude.
pub fn largest<'a>(numbers: impl IntoIterator<Item = &'a Exact>) -> Exact {
    numbers
        .into_iter()
        .cloned()
        .map(Exact::abs)
        .fold(Exact::zero(), Exact::max)
}

/// Every number of `found` within `count` units of the largest of `truth`, and `slack`.
pub fn check_near<T: Word, const N: usize>(
    found: Block<T, N>,
    truth: &[Exact; N],
    count: i64,
    slack: &Exact,
) -> Result<(), TestCaseError> {
    let bound = &(&units::<T>(count) * &largest(truth)) + slack;
    for (found, truth) in exacts(found).iter().zip(truth) {
        let off = (found - truth).abs();
        prop_assert!(
            off <= bound,
            "{} is not {}: off by {}",
            found.to_f64(),
            truth.to_f64(),
            off.to_f64()
        );
    }
    Ok(())
}

pub fn dot(a: &[Exact], b: &[Exact]) -> Exact {
    a.iter().zip(b).fold(Exact::zero(), |sum, (a, b)| &sum + &(a * b))
}

pub fn cross(a: &[Exact; 3], b: &[Exact; 3]) -> [Exact; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &(&a[i] * &b[j]) - &(&a[j] * &b[i]))
}

/// The mantissas of both words and a scale: huge, tiny, ordinary.
#[derive(Debug, Clone, Copy)]
pub struct Number(i64, i32);

pub fn number() -> impl Strategy<Value = Number> + Clone {
    let mantissa = prop_oneof![4 => -(1i64 << 62)..1 << 62, 1 => Just(0), 2 => -9..9i64, 1 => Just(1 << 62)];
    let scale = prop_oneof![6 => -70..-50i32, 1 => -1000..1000i32];
    (mantissa, scale).prop_map(|(m, e)| Number(m, e))
}

/// Rounded to the word: an exact number from here on.
pub fn word<T: Word>(Number(m, e): Number) -> Scaled<T> {
    let part = |shift: u32, mask: i64| Scaled::<T>::from_integer((m >> shift & mask) as i32).scaled(shift as i32);
    Scaled::<T>::from_integer((m >> 60) as i32)
        .scaled(60)
        .plus(part(30, (1 << 30) - 1))
        .plus(part(0, (1 << 30) - 1))
        .scaled(e)
}

pub fn gathered<T: Word, const N: usize>(numbers: [Number; N]) -> Block<T, N> {
    Block::gather(numbers.map(word))
}
