//! Draws the workloads and the built-in shapes, and reports cost and checksums of each.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use fixel_cortex_m::Board;
use fixel_workloads::{frame::Frame, program};
use panic_semihosting as _;

static WORKLOADS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/workloads.bin"));

#[entry]
fn main() -> ! {
    static mut FRAME: Frame = Frame::new();

    let status = match cortex_m::Peripherals::take() {
        Some(core) => {
            program::run(&mut Board::calibrated(core.SYST), FRAME, WORKLOADS);
            EXIT_SUCCESS
        }
        None => EXIT_FAILURE,
    };
    loop {
        debug::exit(status);
    }
}
