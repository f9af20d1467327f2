//! Calls every public function of the core. Bare: no formatting and no output, and a panic handler that is in the image only
//! if something can panic.

#![no_std]
#![no_main]

use core::panic::PanicInfo;

use cortex_m_rt::entry;
use fixel_workloads::{everything, scenes::part::Memory};

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();

    everything::run(MEMORY);
    loop {
        cortex_m::asm::wfi();
    }
}
