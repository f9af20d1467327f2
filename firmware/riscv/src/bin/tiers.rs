//! Draws every scene of the trade in every tier, and reports cost and checksums of each.

#![no_std]
#![no_main]

use fixel_workloads::tiers::{self, canvas::Canvas};
use riscv_rt::entry;
use static_cell::ConstStaticCell;

static CANVAS: ConstStaticCell<Canvas<u16>> = ConstStaticCell::new(Canvas::new());

#[entry]
fn main() -> ! {
    fixel_riscv::run(|board| {
        tiers::run(board, CANVAS.take());
        true
    })
}
