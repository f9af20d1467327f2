//! Pictures in float64 that show no scene: sines, and what triangles on the screen invert.

use fixel_workloads::tiers::canvas::{HEIGHT, WIDTH};
use fixel_workloads::tiers::geometry::PIECES;
use fixel_workloads::tiers::sines::STEP;

use super::reference::Vector;

/// Sine and cosine of one angle after another, −1 as black and 1 as 255.
pub fn sines() -> Vec<Vector> {
    let pixels = u64::from(WIDTH) * u64::from(HEIGHT);
    let turns = (0..pixels).map(|pixel| pixel.wrapping_mul(STEP) as f64 / 2f64.powi(64));
    turns
        .map(|turns| {
            let (sin, cos) = (turns * std::f64::consts::TAU).sin_cos();
            [sin, cos, 0.0].map(|v| 127.5 * (1.0 + v))
        })
        .collect()
}

/// White where an odd number of triangles covers the sample at a pixel's upper left, their corners where they are.
pub fn edges() -> Vec<Vector> {
    let pieces: Vec<_> = PIECES
        .iter()
        .map(|piece| piece.map(|at| at.map(|c| f64::from(c) / 65536.0)))
        .collect();
    let samples = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| [x, y].map(f64::from)));
    let inverted = |sample: [f64; 2]| pieces.iter().filter(|piece| covers(piece, sample)).count() % 2 == 1;
    samples
        .map(|sample| [if inverted(sample) { 255.0 } else { 0.0 }; 3])
        .collect()
}

/// Whether a point is on the same side of all three edges. None lies on one: that would be a coincidence of 2^-16 px.
fn covers(&[a, b, c]: &[[f64; 2]; 3], p: [f64; 2]) -> bool {
    let left = |from: [f64; 2], to: [f64; 2]| {
        (to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]) > 0.0
    };
    let sides = [left(a, b), left(b, c), left(c, a)];
    sides == [true; 3] || sides == [false; 3]
}
