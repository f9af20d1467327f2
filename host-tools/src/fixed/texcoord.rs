//! Texture coordinates of a primitive, in texels and in units of its own.

use fixel::num::{Block, Scaled};

/// How a texel is found from a coordinate in texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    /// The floor.
    Down,
    /// What is behind the point is cut off.
    TowardsZero,
}

impl Rounding {
    /// How many whole textures may be taken off coordinates without changing what they pick; none where next to a pole they
    /// are mixed with weights of both signs.
    fn periods(self, coordinates: Block<i64, 3>, pole: bool) -> i64 {
        match self {
            Rounding::Down => middle(coordinates),
            Rounding::TowardsZero if pole => 0,
            Rounding::TowardsZero => towards_zero(coordinates),
        }
    }

    /// What is added, in texels of 2^`fraction_bits`: away from where it is cut off to.
    fn nudge(self, coordinates: Block<i64, 3>, fraction_bits: i32) -> i32 {
        let nudge = nudge(fraction_bits);
        if self == Rounding::TowardsZero && ends(coordinates).1 < 0 {
            -nudge
        } else {
            nudge
        }
    }
}

/// 2^-12 texel: so a coordinate that lies on a border of texels, as with pictures enlarged by a whole number, picks the texel that
/// exact arithmetic does, though it is interpolated to a few units of less than 2^-16 texel. Far below the 2^-8 texel that a
/// difference is explained by.
pub fn nudge(fraction_bits: i32) -> i32 {
    1 << fraction_bits >> 12
}

/// Corners' texture coordinates in texels, and the number of fraction bits: as many as fit, at most `most_bits`, less the headroom. A whole number of textures,
/// common to the corners, is taken off first.
///
/// # Errors
/// Where they are more than 2^31 texels apart.
pub fn texels(
    corners: [[Scaled<i64>; 2]; 3],
    size: [u16; 2],
    headroom: u32,
    most_bits: i32,
    rounding: Rounding,
) -> Result<([[i32; 2]; 3], u32), String> {
    let [[sa, ta], [sb, tb], [sc, tc]] = corners;
    let axes = [
        (Block::gather([sa, sb, sc]), size[0]),
        (Block::gather([ta, tb, tc]), size[1]),
    ];
    let [s, t] = axes.map(|(coordinates, size)| {
        let [periods] = Scaled::new([rounding.periods(coordinates, headroom > 0)], 0).split();
        let near = coordinates.minus(Block::gather([periods; 3]));
        near.times(Scaled::from_integer(size.into()))
    });
    // A block's numbers are at most 2^(62 + exponent).
    let fitting = |axis: &Block<i64, 3>| if axis.is_zero() { 30 } else { -32 - axis.exponent() };
    let fraction_bits = fitting(&s).min(fitting(&t)).min(30);
    if fraction_bits < 0 {
        return Err("texture coordinates of one triangle that are more than 2^31 texels apart".into());
    }
    let fraction_bits = (fraction_bits - headroom as i32).max(0).min(most_bits);
    let [[sa, sb, sc], [ta, tb, tc]] = [s, t].map(|axis| {
        let nudge = rounding.nudge(axis, fraction_bits);
        axis.split()
            .map(|c| (nearest(c, fraction_bits) + nudge).clamp(-MOST, MOST))
    });
    Ok(([[sa, ta], [sb, tb], [sc, tc]], fraction_bits as u32))
}

/// The largest coordinate.
const MOST: i32 = 1 << 30;

/// The most fraction bits that there are.
pub const FINE: i32 = 30;
/// The most for `PerspectiveSpans`, which takes a texel to be 2^16 units: its bound is in parts of that.
pub const IN_SPANS: i32 = 16;

/// The whole number that is nearest to the middle between the least and the largest: where rounding is the same everywhere.
fn middle(coordinates: Block<i64, 3>) -> i64 {
    let (least, most) = ends(coordinates);
    let middle = Scaled::new([(least >> 1) + (most >> 1)], coordinates.exponent());
    nearest_wide(middle, 0)
}

/// The whole number that takes the coordinates nearest to 0 without taking any across it or, from below, nearer than one texture:
/// where rounding is towards 0.
fn towards_zero(coordinates: Block<i64, 3>) -> i64 {
    let (least, most) = ends(coordinates);
    let whole = |mantissa: i64| Scaled::new([mantissa], coordinates.exponent()).to_fixed(0);
    if least >= 0 {
        whole(least)
    } else if most < 0 {
        // Rounded down, so that −1 to −2 is left for whole numbers too.
        whole(most).saturating_add(2).min(0)
    } else {
        0
    }
}

/// The least and the largest mantissa.
fn ends(coordinates: Block<i64, 3>) -> (i64, i64) {
    let [a, b, c] = coordinates.mantissas();
    (a.min(b).min(c), a.max(b).max(c))
}

/// In units of 2^-`fraction_bits`, rounded to nearest.
pub fn nearest_wide(number: Scaled<i64>, fraction_bits: i32) -> i64 {
    let halves = number.scaled(fraction_bits + 1).to_fixed(0);
    (halves >> 1) + (halves & 1)
}

/// [`nearest_wide`] where the caller has shown that it fits.
pub fn nearest(number: Scaled<i64>, fraction_bits: i32) -> i32 {
    nearest_wide(number, fraction_bits) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower;

    fn corners(s: [f64; 3], t: [f64; 3]) -> [[Scaled<i64>; 2]; 3] {
        std::array::from_fn(|i| [lower::block([s[i]]), lower::block([t[i]])])
    }

    #[test]
    fn whole_textures_are_taken_off() {
        let (near, bits) = texels(
            corners([0.0, 1.0, 0.5], [0.0, 0.25, 1.0]),
            [8, 5],
            0,
            FINE,
            Rounding::Down,
        )
        .unwrap();
        let far = corners([1e6, 1e6 + 1.0, 1e6 + 0.5], [-7.0, -6.75, -6.0]);
        let (far, same) = texels(far, [8, 5], 0, FINE, Rounding::Down).unwrap();
        // 8 texels are 2^61 · 2^-58: taken for less than 2^4, they get 26 bits of 30.
        assert_eq!((bits, same), (26, 26));
        for (near, far) in near.into_iter().zip(far) {
            let period = [8 << bits, 5 << bits];
            for axis in 0..2 {
                assert_eq!((near[axis] - far[axis]) % period[axis], 0);
            }
        }
    }

    #[test]
    fn what_is_cut_towards_zero_keeps_its_side_of_it() {
        for (s, taken) in [
            ([0.25, 0.5, 0.75], 0),
            ([7.0, 8.5, 9.0], 7),
            ([-0.25, 0.5, 9.0], 0),
            ([-0.25, -0.5, -0.75], 0),
            ([-5.25, -7.0, -9.0], -4),
            ([-5.0, -7.0, -9.0], -3),
        ] {
            assert_eq!(towards_zero(lower::block(s)), taken, "{s:?}");
        }
    }

    #[test]
    fn coordinates_that_do_not_fit_are_refused() {
        assert!(texels(corners([0.0, 1e12, 0.0], [0.0; 3]), [8, 8], 0, FINE, Rounding::Down).is_err());
        assert!(texels(corners([1e300; 3], [0.0; 3]), [8, 8], 0, FINE, Rounding::Down).is_err());
    }
}
