//! A frame in strips on a micro:bit, whose 16 KiB of RAM hold no more; reports cost and checksums of the whole frame.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use fixel_workloads::scenes::{self, STRIP, StripMemory};
use panic_semihosting as _;

#[entry]
fn main() -> ! {
    static mut MEMORY: StripMemory = StripMemory::new();

    fixel_cortex_m::run(|board| {
        scenes::run_strips(board, MEMORY, STRIP);
        true
    })
}
