//! The lit ring on a 1-bit panel, on the micro:bit. Reports every frame.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::hprintln;
use fixel_demos::crc::Crc;
use fixel_demos::dithered::{self, FRAMES, Memory};
use fixel_demos::oled::Oled;
use panic_semihosting as _;

/// Takes the pages' checksum in place of showing them.
#[derive(Default)]
struct Checked(Crc);

impl Oled for Checked {
    fn page(&mut self, _number: u8, columns: &[u8; 128]) {
        self.0.add(columns);
    }
}

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();

    let mut drawn = true;
    for number in 0..FRAMES {
        let mut oled = Checked::default();
        let passes = dithered::frame(MEMORY, &mut oled, number);
        drawn &= passes.is_ok();
        hprintln!("dithered {} {} {:08x}", number, passes.unwrap_or(0), oled.0.value());
    }
    loop {
        debug::exit(if drawn { EXIT_SUCCESS } else { EXIT_FAILURE });
    }
}
