//! Numbers: machine words, block floating point, reciprocal, sine.
//!
//! Vertices and matrices are *block floating point*: a few integers that share one power-of-two scale. Projective
//! coordinates have no absolute scale, so nothing in a real scene is too large or too small; what is far below the
//! largest of its block is rounded, and the bound is always relative to that largest number.

mod block;
mod power;
mod quotient;
mod recip;
mod root;
mod trig;
mod word;

pub use block::{Block, Scaled};
pub use power::power;
pub use quotient::Divisor;
pub(crate) use recip::near_reciprocal;
pub use recip::reciprocal;
pub use root::{dot, reciprocal_square_root, square_root, unit, unit_wide};
#[cfg(feature = "micromath")]
pub use trig::Micromath;
pub use trig::{Angle, SineTable, Trigonometry};
pub use word::{Wide, Word};
