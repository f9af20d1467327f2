//! How deep the stack gets.

use core::arch::asm;
use core::sync::atomic::{Ordering::SeqCst, compiler_fence};

/// No word of a program is likely to be this.
const PAINT: u32 = 0x5bad_c0de;

/// Words below the caller that are painted: 16 KiB.
const WORDS: u32 = 4096;

/// Runs `work`; the bytes of stack that it took, to a word.
#[inline(never)]
#[expect(
    unsafe_code,
    reason = "the memory below the stack pointer is no object of the language"
)]
pub fn depth_of(work: impl FnOnce()) -> u32 {
    let top: u32;
    // SAFETY: reads a register.
    unsafe { asm!("mov {}, sp", out(reg) top, options(nomem, nostack)) };
    let bottom = top - 4 * WORDS;
    // SAFETY: the boards' 4 MiB of RAM end with the stack, of which the images use a few KiB; nothing lies below the stack
    // pointer, and no interrupt is on. Volatile and in this function, which stores nothing below its own frame meanwhile.
    unsafe {
        asm!(
            "2: str {paint}, [{at}]",
            "adds {at}, #4",
            "cmp {at}, {top}",
            "bne 2b",
            at = inout(reg) bottom => _,
            top = in(reg) top,
            paint = in(reg) PAINT,
        );
    }
    compiler_fence(SeqCst);
    work();
    compiler_fence(SeqCst);
    let mut lowest = bottom;
    // SAFETY: as above; only read.
    while lowest < top && unsafe { (lowest as *const u32).read_volatile() } == PAINT {
        lowest += 4;
    }
    top - lowest
}
