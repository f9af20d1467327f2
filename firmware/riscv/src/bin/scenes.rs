//! Draws every scene whole and in strips, and reports cost and checksums of each.

#![no_std]
#![no_main]

use fixel_workloads::scenes::{self, part::Memory};
use riscv_rt::entry;
use static_cell::ConstStaticCell;

static MEMORY: ConstStaticCell<Memory> = ConstStaticCell::new(Memory::new());

#[entry]
fn main() -> ! {
    fixel_riscv::run(|board| {
        scenes::run(board, MEMORY.take());
        true
    })
}
