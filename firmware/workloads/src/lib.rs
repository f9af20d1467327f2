//! The measured program: the standard workloads and the built-in shapes, drawn through the raster door.
//!
//! The images run it on an emulated board, the developers' command runs it on the host; both report the same lines but
//! for the instruction counts, checksums equal bit for bit.

#![no_std]

pub mod bytes;
pub mod draw;
pub mod frame;
pub mod machine;
pub mod program;
pub mod shapes;
