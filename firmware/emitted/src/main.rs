//! Draws emitted scenes, and reports cost and checksums.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use fixel_emitted::{Room, draw_all};
use panic_semihosting as _;

#[entry]
fn main() -> ! {
    static mut ROOM: Room = Room::new();

    fixel_cortex_m::run(|board| draw_all(board, ROOM))
}
