//! The spinning ring on a panel behind SPI. Reports every frame, and writes the last one out as a picture file (PPM).

#![no_std]
#![no_main]

use core::fmt::Write;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::{hprint, hprintln};
use fixel_demos::spi::{Driver, HEIGHT, Panel, WIDTH};
use fixel_demos::spinning::{self, FRAMES, Memory};
use panic_semihosting as _;

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();
    // Not the microcontroller's, but the panel's.
    static mut PANEL: Panel = Panel::new();

    let mut drawn = true;
    for number in 0..FRAMES {
        PANEL.bytes = 0;
        drawn &= spinning::frame(MEMORY, &mut Driver(&mut *PANEL), number) == Ok(1);
        hprintln!("spinning {} {} {:08x}", number, PANEL.bytes, PANEL.crc());
    }
    write_out(PANEL);
    loop {
        debug::exit(if drawn { EXIT_SUCCESS } else { EXIT_FAILURE });
    }
}

/// As numbers, a row of them at a time: every call halts the processor.
fn write_out(panel: &Panel) {
    hprintln!("P3 {} {} 255", WIDTH, HEIGHT);
    for row in panel.picture().chunks(WIDTH.into()) {
        let mut line = heapless::String::<2048>::new();
        for pixel in row.iter().map(|&pixel| u16::from_be_bytes(pixel)) {
            let [red, green, blue] = [
                (pixel >> 11) * 255 / 31,
                (pixel >> 5 & 63) * 255 / 63,
                (pixel & 31) * 255 / 31,
            ];
            // At most twelve characters a pixel.
            let _ = write!(line, "{red} {green} {blue} ");
        }
        hprint!("{}\n", line);
    }
}
