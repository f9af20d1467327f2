//! What the RISC-V images share: counting instructions and reporting lines.
//!
//! Under `-icount shift=0` the emulator's `minstret` counts the instructions executed, exactly, whatever the host: the read
//! itself ends the emulator's block of translated code.

#![no_std]

use core::sync::atomic::{Ordering::SeqCst, compiler_fence};

use fixel_workloads::machine::{Line, Machine};
use riscv::interrupt::Exception;
use riscv::register::{mcause, mepc, minstret};
use semihosting::{eprintln, println, process};

/// Passes of the calibration's loop.
const PASSES: u32 = 1_000_000;

/// A board that counts by `minstret` and reports by semihosting.
pub struct Board(());

impl Board {
    /// The board, checked.
    ///
    /// # Panics
    /// When the emulator does not count as it should: without `-icount shift=0`, or one that counts otherwise.
    pub fn calibrated() -> Self {
        let mut board = Board(());
        let nothing = board.count(|| {});
        // Two instructions a pass, and a few around the loop.
        let counted = board.count(|| riscv::asm::delay(2 * PASSES));
        assert!(
            nothing == 0 && counted.wrapping_sub(2 * PASSES) <= 16,
            "calibration: 0 and {} instructions counted as {nothing} and {counted}; the emulator needs -icount shift=0",
            2 * PASSES
        );
        board
    }
}

impl Machine for Board {
    #[inline(never)]
    fn count(&mut self, work: impl FnOnce()) -> u32 {
        compiler_fence(SeqCst);
        let start = minstret::read() as u32;
        work();
        let end = minstret::read() as u32;
        compiler_fence(SeqCst);
        // The second read counts itself.
        end.wrapping_sub(start).wrapping_sub(1)
    }

    fn report(&mut self, line: &Line<'_>) {
        println!("{line}");
    }
}

/// Runs an image's program on the board and ends the emulator; with success if the program says so.
pub fn run(program: impl FnOnce(&mut Board) -> bool) -> ! {
    let done = program(&mut Board::calibrated());
    process::exit(i32::from(!done))
}

/// Without it a fault would loop until the timeout.
macro_rules! ends_the_image {
    ($($name:ident: $exception:ident),*) => {$(
        #[riscv_rt::exception(Exception::$exception)]
        fn $name(_: &riscv_rt::TrapFrame) -> ! {
            eprintln!("{:?} at {:#x}", mcause::read().cause(), mepc::read());
            process::exit(2)
        }
    )*};
}

ends_the_image! {
    on_instruction_fault: InstructionFault,
    on_illegal_instruction: IllegalInstruction,
    on_load_misaligned: LoadMisaligned,
    on_load_fault: LoadFault,
    on_store_misaligned: StoreMisaligned,
    on_store_fault: StoreFault
}

/// The whole of an image that draws by a function of `fixel_workloads::sizes` and does nothing else.
#[macro_export]
macro_rules! bare_image {
    ($draw:path) => {
        static MEMORY: $crate::ConstStaticCell<fixel_workloads::scenes::StripMemory> =
            $crate::ConstStaticCell::new(fixel_workloads::scenes::StripMemory::new());

        #[$crate::entry]
        fn main() -> ! {
            // Where a firmware has its own: nothing that the compiler could know.
            let matrix = core::hint::black_box([1; 16]);
            let points = core::hint::black_box([([1; 4], [2; 3]); 6]);
            let texels = core::hint::black_box([3; 256]);
            let input = fixel_workloads::sizes::Input {
                matrix,
                points: &points,
                texels: &texels,
            };
            let memory = MEMORY.take();
            let mut part = memory.cleared(0, fixel_workloads::scenes::STRIP);
            let _ = core::hint::black_box($draw(&mut part, &input));
            loop {
                $crate::wait();
            }
        }
    };
}

pub use riscv::asm::wfi as wait;
pub use riscv_rt::entry;
pub use static_cell::ConstStaticCell;
