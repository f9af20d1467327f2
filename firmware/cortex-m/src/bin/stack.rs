//! Draws one triangle of each kind, and reports how much stack that took in place of the instructions.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use fixel_cortex_m::stack::depth_of;
use fixel_workloads::machine::{Line, Machine};
use fixel_workloads::scenes::part::Memory;
use fixel_workloads::stack;
use panic_semihosting as _;

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();

    fixel_cortex_m::run(|board| {
        let mut report = |name: &str, bytes: u32, pixels: u32| {
            board.report(&Line {
                name,
                instructions: bytes,
                units: pixels,
                color: 0,
                depth: 0,
            });
        };
        // That it counts: an array of 2000 bytes and little else.
        report("calibration", depth_of(|| stack::takes::<2000>()), 0);
        stack::run(MEMORY, |work: &mut dyn FnMut()| depth_of(work), report).is_ok()
    })
}
