//! Draws the workloads and the built-in shapes, and reports cost and checksums of each.

#![no_std]
#![no_main]

use fixel_workloads::{frame::Frame, program};
use riscv_rt::entry;
use static_cell::ConstStaticCell;

static FRAME: ConstStaticCell<Frame> = ConstStaticCell::new(Frame::new());

static WORKLOADS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/workloads.bin"));

#[entry]
fn main() -> ! {
    fixel_riscv::run(|board| {
        program::run(board, FRAME.take(), WORKLOADS);
        true
    })
}
