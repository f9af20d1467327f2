//! Draws nothing: what every firmware has.

#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use fixel_workloads::frame::Frame;

#[entry]
fn main() -> ! {
    static mut FRAME: Frame = Frame::new();

    black_box((FRAME, &fixel_sizes::prepared()));
    fixel_sizes::end()
}
