//! Draws the workloads with every rival, and reports what each cost.

#![no_std]
#![no_main]

use core::mem::MaybeUninit;

use cortex_m_rt::entry;
use embedded_alloc::LlffHeap;
use panic_semihosting as _;

static GEOMETRY: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/geometry.bin"));

/// Bytes for frames and triangles: the emulated board has 4 MiB.
const HEAP_BYTES: usize = 3 << 20;

/// Rivals keep their triangles, and some their frames, in memory that is asked for.
#[global_allocator]
static HEAP: LlffHeap = LlffHeap::empty();

#[entry]
fn main() -> ! {
    static mut MEMORY: [MaybeUninit<u8>; HEAP_BYTES] = [MaybeUninit::uninit(); HEAP_BYTES];

    // SAFETY: called once, before anything is allocated; the memory is this function's alone.
    unsafe { HEAP.init(MEMORY.as_mut_ptr() as usize, HEAP_BYTES) }
    fixel_cortex_m::run(|board| {
        fixel_rivals::run::run(board, GEOMETRY, |_| true);
        true
    })
}
