//! Bernstein's weights as whole numbers, and sums weighted by them.

use super::{ControlPoint, Level};
use crate::num::{Block, Wide, Word};

/// Mantissas at the scale of the largest point of a set, with guard bits below: |m| ≤ 2^(BITS + guard bits).
pub(super) struct Shared<T: Word, const P: usize, const K: usize> {
    pub positions: [[T::Wide; 4]; P],
    /// Of the last guard bit.
    pub exponent: i32,
    /// |v| ≤ 2^(30 + guard bits).
    pub colors: [[i64; K]; P],
}

/// Bits below the last place of the largest point: a sum with cubic weights then is at most 2^(2·BITS + 2), half of what
/// [`Wide`] holds.
fn guard_bits<T: Word>(level: Level) -> u32 {
    T::BITS + 2 - level.weight_bits()
}

const _: () = assert!(<i32 as Word>::BITS + 2 - Level(8).weight_bits() == 8);

impl<T: Word, const P: usize, const K: usize> Shared<T, P, K> {
    /// Points of different scales, each rounded once, by at most half of the last guard bit.
    pub fn new(points: [ControlPoint<T, K>; P], level: Level) -> Self {
        let guard = guard_bits::<T>(level);
        let exponents = points
            .iter()
            .filter(|p| !p.position.is_zero())
            .map(|p| p.position.exponent());
        let top = exponents.max().unwrap_or(0);
        let positions = points.map(|p| {
            let gap = top.saturating_sub(p.position.exponent()).max(0) as u32;
            p.position.mantissas().map(|m| match gap.checked_sub(guard) {
                Some(lost @ 1..) => shift_rounded::<T>(m.widen(), lost.min(T::BITS + 2)),
                _ => m.widen() << (guard - gap),
            })
        });
        let guard_of_colors = guard_bits::<i32>(level);
        let color = |v: i32| i64::from(v) << guard_of_colors;
        Shared {
            positions,
            exponent: top.saturating_sub(guard as i32),
            colors: points.map(|p| p.color.map(color)),
        }
    }
}

/// `v` / 2^`bits` rounded to nearest, for 1 or more bits.
pub(super) fn shift_rounded<T: Word>(v: T::Wide, bits: u32) -> T::Wide {
    (v + (T::ONE.widen() << (bits - 1))) >> bits
}

/// The point on the curve of four control points at `i` / 2^level, and its values: a function of these eight only, and the
/// same from either end. At the ends the control points themselves.
pub(super) fn on_curve<T: Word, const K: usize>(
    points: [ControlPoint<T, K>; 4],
    i: u32,
    level: Level,
) -> ControlPoint<T, K> {
    let [first, _, _, last] = points;
    if i == 0 {
        return first;
    }
    if i == level.pieces() {
        return last;
    }
    let shared = Shared::new(points, level);
    let weights = cubic(i, level);
    ControlPoint {
        position: position::<T>(mix(weights, shared.positions), shared.exponent, level),
        color: color(mix(weights, shared.colors)),
    }
}

/// A sum of positions by cubic weights, rounded once.
pub(super) fn position<T: Word>(sum: [T::Wide; 4], exponent: i32, level: Level) -> Block<T, 4> {
    Block::from_wide(sum, exponent.saturating_sub(level.weight_bits() as i32))
}

/// A sum of values by cubic weights, rounded once: guard bits and weights are 32 bits together.
pub(super) fn color<const K: usize>(sum: [i64; K]) -> [i32; K] {
    sum.map(|v| ((v + (1 << 31)) >> 32) as i32)
}

/// Σ weight · point.
#[inline]
pub(super) fn mix<W: Wide, const P: usize, const C: usize>(weights: [i32; P], points: [[W; C]; P]) -> [W; C] {
    let mut sums = [W::ZERO; C];
    for (weight, point) in weights.into_iter().zip(points) {
        for (sum, v) in sums.iter_mut().zip(point) {
            *sum = *sum + v.times_small(weight);
        }
    }
    sums
}

/// The cross product of two exact vectors of x, y, z (w is not looked at), each rounded once before.
pub(super) fn cross<T: Word>([a, b]: [[T::Wide; 4]; 2]) -> Block<T, 3> {
    // Directions: the scale of neither matters. Opposite ones are rounded to opposite ones, so that their product is 0.
    let vector = |[x, y, z, _]: [T::Wide; 4]| {
        let first = [x, y, z].into_iter().find(|&c| c != T::Wide::ZERO);
        if first.is_some_and(|c| c < T::Wide::ZERO) {
            Block::from_wide([-x, -y, -z], 0).negated()
        } else {
            Block::from_wide([x, y, z], 0)
        }
    };
    vector(a).cross(vector(b))
}

/// b − a.
#[inline]
pub(super) fn difference<W: Wide>([b, a]: [[W; 4]; 2]) -> [W; 4] {
    let mut from = a.into_iter();
    b.map(|v| v - from.next().unwrap_or(W::ZERO))
}

/// Cubic weights at s = `i` / N, times N³ for N = 2^level: non-negative, with sum N³ ≤ 2^24.
#[inline]
pub(super) fn cubic(i: u32, level: Level) -> [i32; 4] {
    let (s, u) = sides(i, level);
    [u * u * u, 3 * u * u * s, 3 * u * s * s, s * s * s]
}

/// Quadratic weights at s = `i` / N, times N²: non-negative, with sum N² ≤ 2^16.
#[inline]
pub(super) fn quadratic(i: u32, level: Level) -> [i32; 3] {
    let (s, u) = sides(i, level);
    [u * u, 2 * u * s, s * s]
}

/// `i` and N − `i`.
#[inline]
fn sides(i: u32, level: Level) -> (i32, i32) {
    (i as i32, level.pieces() as i32 - i as i32)
}
