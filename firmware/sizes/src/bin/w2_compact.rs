//! Draws as W2 does, with less code, and nothing else.

#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use fixel_workloads::draw::gouraud_depth_compact;
use fixel_workloads::frame::Frame;

#[entry]
fn main() -> ! {
    static mut FRAME: Frame = Frame::new();

    gouraud_depth_compact(black_box(FRAME), &fixel_sizes::prepared());
    fixel_sizes::end()
}
