//! Numbers: machine words, block floating point, reciprocal, sine.
//!
//! Vertices and matrices are *block floating point*: a few integers that share one power-of-two scale. Projective
//! coordinates have no absolute scale, so nothing in a real scene is too large or too small; what is far below the
//! largest of its block is rounded, and the bound is always relative to that largest number.

mod block;
mod one_step;
mod power;
mod precision;
pub(crate) mod product;
mod quotient;
mod recip;
mod root;
mod table;
mod trig;
mod word;

pub use block::{Block, Scaled};
pub use one_step::OneStep;
pub use power::power;
pub use precision::{Precision, TwoSteps};
pub(crate) use product::{high, high_sum, high_unsigned, product, short_sum, sum_of_signed_parts};
pub use quotient::Divisor;
pub use recip::reciprocal;
pub(crate) use recip::{near_reciprocal, nearer_reciprocal, quotient_of_ones};
pub use root::{dot, reciprocal_square_root, square_root, unit, unit_wide};
pub use table::Table;
#[cfg(feature = "micromath")]
pub use trig::Micromath;
pub use trig::{Angle, ShortSine, SineTable, Trigonometry};
pub use word::{Wide, Word};
