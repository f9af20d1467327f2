//! Draws every scene whole and in strips, and reports cost and checksums of each.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use fixel_workloads::scenes::{self, part::Memory};
use panic_semihosting as _;

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();

    fixel_cortex_m::run(|board| {
        scenes::run(board, MEMORY);
        true
    })
}
