//! What all tests of patches name them by.

use fixel::patch::Level;

/// Places of a triangular patch's control points.
pub const TRIANGLE: [(u32, u32); 10] = [
    (0, 0),
    (1, 0),
    (2, 0),
    (3, 0),
    (0, 1),
    (1, 1),
    (2, 1),
    (0, 2),
    (1, 2),
    (0, 3),
];

/// A level from 1 to 8.
pub fn level(level: u32) -> Level {
    Level::new(level).unwrap()
}
