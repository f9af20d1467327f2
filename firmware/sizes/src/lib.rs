//! What the images share: a triangle that the compiler cannot see through, and the end.
//!
//! No formatting is linked into those whose size counts: a panic just stops.

#![no_std]

use core::hint::black_box;
use core::panic::PanicInfo;

use cortex_m_semihosting::debug::{self, EXIT_SUCCESS};
use fixel_workloads::draw::{GouraudTriangle, prepare_gouraud};
use fixel_workloads::shapes::WIDE;

#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    loop {}
}

/// As W2's: converted before, which is not part of drawing.
#[inline(never)]
pub fn prepared() -> [GouraudTriangle; 1] {
    black_box([prepare_gouraud(black_box(WIDE.corners()))])
}

/// Ends the emulator with success.
pub fn end() -> ! {
    loop {
        debug::exit(EXIT_SUCCESS);
    }
}
