//! Draws flat triangles by hand, and reports cost and checksums.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use fixel_workloads::{flat, frame::Frame};
use panic_semihosting as _;

#[entry]
fn main() -> ! {
    static mut FRAME: Frame = Frame::new();

    fixel_cortex_m::run(|board| flat::run(board, FRAME, flat::by_hand::draw).is_some())
}
