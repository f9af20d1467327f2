//! Sine and cosine as a picture: red and green of every pixel are those of an angle, from 0 for −1 to full for 1.

use fixel::error::Error;
use fixel::num::{Angle, Trigonometry};

use super::canvas::Canvas;
use super::color::{MOST, Output};
use super::geometry::Models;

/// From each pixel to the next, in units of 2^-64 turn: angles of all kinds.
pub const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// One angle after another.
pub fn draw<T: Trigonometry, P: Output>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error> {
    let mut turns = 0u64;
    let [reds, greens, blues] = MOST;
    // Of 0…2^31 the upper 26 bits: below 2^31 again.
    let level =
        |sine: i32, most: i32| ((((sine as u32).wrapping_add(1 << 30) >> 6) * most as u32) >> 9) as i32 + 0x8000;
    for pixel in canvas.colors_mut() {
        let (sin, cos) = T::sin_cos::<i32>(Angle::from_turns(turns));
        *pixel = P::of([level(sin, reds), level(cos, greens), (blues << 16) / 2 + 0x8000]);
        turns = turns.wrapping_add(STEP);
    }
    Ok(())
}
