//! The only place where float64 becomes fixed point. What the core gets from here is what firmware would hold as
//! constants; all arithmetic after that is the core's own.

use fixel::num::{Angle, Block, Scaled};

/// Units of a channel: 2^-16 levels of 0…255.
const CHANNEL_BITS: i32 = 16;

/// The numbers at one shared scale: exact to 2^-62 of the largest.
pub fn block<const N: usize>(values: [f64; N]) -> Block<i64, N> {
    Block::gather(values.map(scaled))
}

/// Makes sure that a position's w is not lost: its four words share one exponent, so that a w beside something 2^62 times as large
/// becomes 0, and the place a direction, of which the core draws something else or nothing.
///
/// # Errors
/// One line that says so.
pub fn keeps_w(position: [f64; 4]) -> Result<(), String> {
    let [x, y, z, w] = position;
    let [.., lowered] = block(position).split();
    if w == 0.0 || !lowered.is_zero() {
        return Ok(());
    }
    let largest = x.abs().max(y.abs()).max(z.abs());
    Err(format!(
        "w = {w:e} is lost beside {largest:e}, which is more than 2^61 times as large"
    ))
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

/// A number within ±1 in units of 2^-15, to 2^-16 of [`whole`].
pub fn sixteen_bits(value: f64) -> i16 {
    (value * 32767.0).round() as i16
}

/// What 2^15 of [`sixteen_bits`]' units stand for if 32767 of them stand for `size`: −1 and 1 are as good as any between.
pub fn whole(size: f64) -> f64 {
    size * (32768.0 / 32767.0)
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

/// Radians as a fraction of a turn, rounded down to 2^-64 turn or, for large ones, to 2^-75 of themselves.
///
/// # Errors
/// From 2^60 radians on, where float64 has no angle left to speak of.
pub fn radians(radians: f64) -> Result<Angle, String> {
    if radians.abs() >= f64::from(60).exp2() {
        return Err(format!("a rotation by {radians} radians"));
    }
    // 1/2π in units of 2^-128.
    const INVERSE: u128 = 0x28be_60db_9391_054a_7f09_d5f4_7d4d_3770;
    let bits = radians.abs().to_bits();
    let exponent = (bits >> 52) as i32;
    let mantissa = u128::from((bits & ((1 << 52) - 1)) | if exponent == 0 { 0 } else { 1 << 52 });
    // mantissa · 2^(up) radians; turns in units of 2^-64 are mantissa · INVERSE · 2^(up − 64), of which only the last 64 bits count.
    let up = exponent.max(1) - 1075;
    let (high, low) = (mantissa * (INVERSE >> 64), mantissa * (INVERSE & u128::from(u64::MAX)));
    let whole = high + (low >> 64);
    let turns = if up <= 0 {
        whole.checked_shr(up.unsigned_abs()).unwrap_or(0)
    } else {
        (whole << up) | (u128::from(low as u64) >> (64 - up))
    };
    let turns = turns as u64;
    Ok(Angle::from_turns(if radians < 0.0 {
        turns.wrapping_neg()
    } else {
        turns
    }))
}

/// Colours of a primitive's corners: channels in units of 2^(shift − 16) levels.
pub struct Channels<const N: usize> {
    /// The corners' red, green and blue.
    pub corners: [[i32; 3]; N],
    /// How far the units are from 2^-16 levels.
    pub shift: i32,
}

/// The finest units of colours that are drawn as they are, or mixed with texels: 2^-16 levels, up to 64 times full.
pub const PLAIN: i32 = 0;
/// The finest units of colours that are lit: 2^-22 levels, up to full.
pub const LIT: i32 = -6;

/// Colours with the finest units, `finest` or larger, in which the largest of them fits the core's 2^30.
pub fn channels<const N: usize>(colors: [[f64; 3]; N], finest: i32) -> Channels<N> {
    let largest = colors.iter().flatten().fold(0.0f64, |most, c| most.max(c.abs()));
    let mut shift = finest;
    while 255.0 * largest / f64::from(shift).exp2() > f64::from(30 - CHANNEL_BITS).exp2() - 1.0 {
        shift += 1;
    }
    let unit = f64::from(CHANNEL_BITS - shift).exp2();
    // Halving before and doubling after keeps 255·c below the largest float64.
    let channel = |c: f64| (c * unit * 0.5 * 255.0 * 2.0).round() as i32;
    Channels {
        corners: colors.map(|c| c.map(channel)),
        shift,
    }
}

/// A channel in units of 2^(shift − 16) levels as a byte: cut off, clamped to 0…255.
pub fn byte(value: i64, shift: i32) -> u8 {
    let up = shift.saturating_sub(CHANNEL_BITS);
    let levels = match u32::try_from(up) {
        // From 2^8 up a single unit is more than 255 levels.
        Ok(up) => value.saturating_mul(1 << up.min(8)),
        Err(_) => value >> up.unsigned_abs().min(63),
    };
    levels.clamp(0, 255) as u8
}

/// A specular exponent in units of 2^-16, at least one of them; `None` for one that switches highlights off.
///
/// # Errors
/// From 65536 on.
pub fn shininess(exponent: f64) -> Result<Option<u32>, String> {
    let units = (exponent * 65536.0).round();
    if units > f64::from(u32::MAX) {
        return Err(format!(
            "a shininess of {exponent}: the core takes exponents below 65536"
        ));
    }
    Ok((exponent > 0.0).then_some((units as u32).max(1)))
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
    fn a_w_that_is_lost_is_told() {
        for good in [
            [5e18, 0.0, 0.5, 1.0],
            [1e300, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, -1e-300],
            [1e30, 0.0, 0.0, 1e12],
        ] {
            assert_eq!(keeps_w(good), Ok(()), "{good:?}");
        }
        for bad in [[1e19, 0.0, 0.5, 1.0], [0.0, -1e30, 0.5, 1.0], [0.9, 0.1, 0.5, -1e-30]] {
            assert!(keeps_w(bad).is_err(), "{bad:?}");
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
    fn radians_are_turns() {
        let near = |r: f64, turns: f64| {
            let wanted = angle(360.0 * turns);
            let off = radians(r).unwrap().turns().wrapping_sub(wanted.turns()) as i64;
            // Of 2^64: the last place of 100π is 2^-46.
            assert!(off.unsigned_abs() < 1 << 18, "{r}");
        };
        near(std::f64::consts::FRAC_PI_2, 0.25);
        near(-std::f64::consts::FRAC_PI_4, 0.875);
        near(0.6, 0.6 / std::f64::consts::TAU);
        near(1e-300, 0.0);
        near(100.0 * std::f64::consts::PI, 0.0);
        assert!(radians(1e300).is_err());
    }

    #[test]
    fn channels_cut_off_and_saturate() {
        let bytes = |c: f64| {
            let lowered = channels([[c; 3]], PLAIN);
            byte(i64::from(lowered.corners[0][0]), lowered.shift)
        };
        assert_eq!(
            [0.5, 1.0, 0.2, 0.6, 2.0, -1.0, 1e300, -1e300].map(bytes),
            [127, 255, 51, 153, 255, 0, 255, 0]
        );
    }
}
