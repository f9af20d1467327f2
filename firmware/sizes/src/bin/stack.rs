//! Draws as W2 does, and reports the bytes of stack that this took.

#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m::register::msp;
use cortex_m_rt::entry;
use cortex_m_semihosting::hprintln;
use fixel_workloads::draw::gouraud_depth;
use fixel_workloads::frame::Frame;

/// More than drawing takes.
const WORDS: u32 = 4096;
const PATTERN: u32 = 0x5afe_57ac;

#[entry]
fn main() -> ! {
    static mut FRAME: Frame = Frame::new();

    let triangles = fixel_sizes::prepared();
    let top = msp::read();
    let bottom = top - WORDS * 4;
    for address in (bottom..top).step_by(4) {
        // SAFETY: below the stack pointer, where nothing lives and nothing but the stack ever does.
        unsafe { (address as *mut u32).write_volatile(PATTERN) }
    }
    gouraud_depth(black_box(FRAME), black_box(&triangles));
    // SAFETY: as above; the words were written.
    let untouched = (bottom..top)
        .step_by(4)
        .take_while(|&at| unsafe { (at as *const u32).read_volatile() } == PATTERN);
    hprintln!("{}", top - bottom - 4 * untouched.count() as u32);
    fixel_sizes::end()
}
