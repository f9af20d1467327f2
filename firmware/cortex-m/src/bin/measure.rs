//! Draws the workloads and the built-in shapes, and reports cost and checksums of each.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use fixel_workloads::{frame::Frame, program};
use panic_semihosting as _;

static WORKLOADS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/workloads.bin"));

#[entry]
fn main() -> ! {
    static mut FRAME: Frame = Frame::new();

    fixel_cortex_m::run(|board| {
        program::run(board, FRAME, WORKLOADS);
        true
    })
}
