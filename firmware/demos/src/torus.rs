//! A ring to draw, computed from angles instead of stored.

use fixel::num::{Angle, SineTable, Trigonometry};

/// Distance of the tube's middle from the ring's, and the tube's radius, in units of 2^-15.
const RADII: (i32, i32) = (21000, 9500);

/// Position and normal, both in units of 2^-15, at `around` the ring and `across` the tube.
pub fn point(around: Angle, across: Angle) -> ([i16; 3], [i16; 3]) {
    let ((sin_a, cos_a), (sin_b, cos_b)) = (turn(around), turn(across));
    let times = |a: i32, b: i32| (a * b) >> 15;
    let reach = RADII.0 + times(RADII.1, cos_b);
    let position = [times(reach, cos_a), times(RADII.1, sin_b), times(reach, sin_a)];
    let normal = [times(cos_b, cos_a), sin_b, times(cos_b, sin_a)];
    (position.map(|c| c as i16), normal.map(|c| c as i16))
}

/// Step `i` of `steps` around a circle.
pub fn step(i: u32, steps: u32) -> Angle {
    Angle::from_degrees((i * 360 / steps) as i32)
}

/// Sine and cosine in units of 2^-15, ±32767.
fn turn(angle: Angle) -> (i32, i32) {
    let (sin, cos) = SineTable::sin_cos::<i32>(angle);
    let narrow = |v: i32| (v >> 15).clamp(-32767, 32767);
    (narrow(sin), narrow(cos))
}
