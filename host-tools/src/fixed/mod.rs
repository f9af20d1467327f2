//! The fixed-point back end: the core, fed with lowered numbers. Nothing here that firmware could not do.

pub mod hw2;
pub mod iv;
pub mod mp1;
mod texcoord;

pub use crate::compare::picture::{FixedPicture, Pixel};
