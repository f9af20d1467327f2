//! The measured programs: the standard workloads and the built-in shapes, drawn through the raster door, and models, drawn
//! from their vertices on.
//!
//! The images run them on an emulated board, the developers' commands run them on the host; both report the same lines but
//! for the instruction counts, checksums equal bit for bit.

#![no_std]

pub mod bytes;
pub mod draw;
pub mod everything;
pub mod flat;
pub mod frame;
pub mod machine;
pub mod mesh;
pub mod model;
pub mod program;
pub mod scenes;
pub mod shapes;
pub mod shown;
pub mod sizes;
pub mod stack;
pub mod tiers;
