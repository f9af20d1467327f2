//! Draws every scene of the trade in every tier, and reports cost and checksums of each.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use fixel_workloads::tiers::{self, canvas::Canvas};
use panic_semihosting as _;

#[entry]
fn main() -> ! {
    static mut CANVAS: Canvas<u16> = Canvas::new();

    fixel_cortex_m::run(|board| {
        tiers::run(board, CANVAS);
        true
    })
}
