//! The only place where float64 becomes fixed point. What the core gets from here is what firmware would hold as
//! constants; all arithmetic after that is the core's own.

use fixel::num::{Angle, Block, Scaled};

/// Units of a channel: 2^-16 levels of 0…255.
const CHANNEL_BITS: i32 = 16;

/// The numbers at one shared scale: exact to 2^-62 of the largest.
pub fn block<const N: usize>(values: [f64; N]) -> Block<i64, N> {
    Block::gather(values.map(scaled))
}

/// The number, exactly.
fn scaled(value: f64) -> Scaled<i64> {
    let bits = value.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let magnitude = if exponent == 0 { fraction } else { fraction | 1 << 52 };
    let mantissa = if value < 0.0 { -magnitude } else { magnitude };
    Scaled::new([mantissa], exponent.max(1) - 1075)
}

/// Degrees as a fraction of a turn, rounded down to 2^-64 turn.
pub fn angle(degrees: f64) -> Angle {
    // The remainder is exact, and below 360 it has 44 or more bits after the point.
    let within = degrees.rem_euclid(360.0);
    let within = if within < 360.0 { within } else { 0.0 };
    let bits = within.to_bits();
    let exponent = (bits >> 52) as i32;
    let mantissa = (bits & ((1 << 52) - 1)) | if exponent == 0 { 0 } else { 1 << 52 };
    let down = (1075 - exponent.max(1)) as u32;
    let turns = ((u128::from(mantissa) << 64) / 360).checked_shr(down).unwrap_or(0);
    Angle::from_turns(turns as u64)
}

/// Colours of a primitive's corners: channels in units of 2^(shift − 16) levels.
pub struct Channels<const N: usize> {
    /// The corners' red, green and blue.
    pub corners: [[i32; 3]; N],
    /// How far the units are from 2^-16 levels; 0 for colours up to 64 times full.
    pub shift: u32,
}

/// Colours with the finest units in which the largest of them fits the core's 2^30.
pub fn channels<const N: usize>(colors: [[f64; 3]; N]) -> Channels<N> {
    let largest = colors.iter().flatten().fold(0.0f64, |most, c| most.max(c.abs()));
    let mut shift = 0u32;
    while 255.0 * largest / f64::from(shift).exp2() > f64::from(30 - CHANNEL_BITS).exp2() - 1.0 {
        shift += 1;
    }
    let unit = f64::from(CHANNEL_BITS - shift as i32).exp2();
    // Halving before and doubling after keeps 255·c below the largest float64.
    let channel = |c: f64| (c * unit * 0.5 * 255.0 * 2.0).round() as i32;
    Channels {
        corners: colors.map(|c| c.map(channel)),
        shift,
    }
}

/// A channel of a [`Channels`] as a byte: cut off, clamped to 0…255.
pub fn byte(value: i32, shift: u32) -> u8 {
    // From 2^40 units up a single unit is more than 255 levels.
    let levels = (i64::from(value) << shift.min(32)) >> CHANNEL_BITS;
    levels.clamp(0, 255) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_arrive_exactly() {
        for value in [0.0, 1.0, -1.0, 0.1, -1.6e8, f64::MIN_POSITIVE, 5e-324, f64::MAX] {
            let [m] = scaled(value).mantissas();
            let exponent = scaled(value).exponent();
            let half = (exponent / 2, exponent - exponent / 2);
            assert_eq!(m as f64 * 2f64.powi(half.0) * 2f64.powi(half.1), value);
        }
    }

    #[test]
    fn degrees_wrap_and_hit_the_quarters() {
        assert_eq!(angle(90.0), Angle::from_degrees(90));
        assert_eq!(angle(-45.0), Angle::from_degrees(315));
        assert_eq!(angle(720.0 + 180.0), Angle::from_degrees(180));
        assert_eq!(angle(-1e-300), Angle::from_degrees(0));
        assert_eq!(angle(1e300), angle(1e300 % 360.0));
    }

    #[test]
    fn channels_cut_off_and_saturate() {
        let bytes = |c: f64| byte(channels([[c; 3]]).corners[0][0], channels([[c; 3]]).shift);
        assert_eq!(
            [0.5, 1.0, 0.2, 0.6, 2.0, -1.0, 1e300, -1e300].map(bytes),
            [127, 255, 51, 153, 255, 0, 255, 0]
        );
    }
}
