//! fixel
#![no_std]
#![forbid(unsafe_code)]

#[cfg(test)]
extern crate std;

pub mod clip;
pub mod depth;
pub mod draw;
pub mod edge;
pub mod error;
pub mod fragment;
pub mod gradient;
pub mod matrix;
pub mod num;
pub mod screen;
pub mod span;
pub mod target;
pub mod varying;
pub mod view;
pub mod viewport;
pub mod window;
