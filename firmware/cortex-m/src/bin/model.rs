//! Draws a model from constants, and reports cost and checksums.

#![no_std]
#![no_main]

use cortex_m_rt::entry;
use fixel_workloads::model::{canvas::Canvas, program};
use panic_semihosting as _;

static MODEL: &[u16] = &include!(concat!(env!("OUT_DIR"), "/model.rs"));

#[entry]
fn main() -> ! {
    static mut CANVAS: Canvas = Canvas::new();

    fixel_cortex_m::run(|board| program::run(board, CANVAS, MODEL).is_some())
}
