//! What the Cortex-M images share: counting instructions and reporting lines.
//!
//! Under `-icount shift=0` the emulator's clock advances by 1 ns an instruction, and SysTick derives from that clock: one
//! tick is exactly 40 instructions at the 25 MHz of the MPS2 boards and 62.5 at the 16 MHz of the micro:bit, whatever the
//! host.

#![no_std]

pub mod stack;

use core::sync::atomic::{Ordering::SeqCst, compiler_fence};

use cortex_m::peripheral::{SYST, syst::SystClkSource};
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::hprintln;
use fixel_workloads::machine::{Line, Machine};

/// Instructions in two ticks of SysTick: 1 ns each.
const PER_TWO_TICKS: u64 = if cfg!(feature = "microbit") { 125 } else { 80 };

/// SysTick has 24 bits.
const TICKS: u32 = 0x00ff_ffff;

/// A board that counts by SysTick and reports by semihosting.
pub struct Board {
    systick: SYST,
}

impl Board {
    /// The board, checked.
    ///
    /// # Panics
    /// When the emulator does not count as it should: without `-icount shift=0`, or one that counts otherwise.
    pub fn calibrated(systick: SYST) -> Self {
        let mut board = Board { systick };
        // The delay loop is two instructions, passed once more than asked for.
        let counted = board.count(|| cortex_m::asm::delay(1_499_999));
        assert!(
            counted.abs_diff(3_000_000) as u64 <= 2 * PER_TWO_TICKS,
            "calibration: 3000000 instructions counted as {counted}; the emulator needs -icount shift=0"
        );
        board
    }
}

impl Machine for Board {
    #[inline(never)]
    fn count(&mut self, work: impl FnOnce()) -> u32 {
        self.systick.disable_counter();
        self.systick.set_clock_source(SystClkSource::Core);
        self.systick.set_reload(TICKS);
        self.systick.clear_current();
        self.systick.enable_counter();
        compiler_fence(SeqCst);
        let start = SYST::get_current();
        work();
        let end = SYST::get_current();
        compiler_fence(SeqCst);
        assert!(
            !self.systick.has_wrapped(),
            "a region longer than one period of SysTick"
        );
        self.systick.disable_counter();
        let ticks = start.wrapping_sub(end) & TICKS;
        // Below 2^24 · 63.
        (u64::from(ticks) * PER_TWO_TICKS / 2) as u32
    }

    fn report(&mut self, line: &Line<'_>) {
        hprintln!("{}", line);
    }
}

/// Runs an image's program on the board and ends the emulator; with success if the program says so.
pub fn run(program: impl FnOnce(&mut Board) -> bool) -> ! {
    let core = cortex_m::Peripherals::take();
    let done = core.is_some_and(|core| program(&mut Board::calibrated(core.SYST)));
    loop {
        debug::exit(if done { EXIT_SUCCESS } else { EXIT_FAILURE });
    }
}

/// The whole of an image that draws by a function of `fixel_workloads::sizes` and does nothing else. Its panic handler is in
/// the image only if something can panic.
#[macro_export]
macro_rules! bare_image {
    ($draw:path) => {
        #[panic_handler]
        fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
            loop {}
        }

        #[$crate::entry]
        fn main() -> ! {
            static mut MEMORY: fixel_workloads::scenes::StripMemory = fixel_workloads::scenes::StripMemory::new();

            // Where a firmware has its own: nothing that the compiler could know.
            let matrix = core::hint::black_box([1; 16]);
            let points = core::hint::black_box([([1; 4], [2; 3]); 6]);
            let texels = core::hint::black_box([3; 256]);
            let input = fixel_workloads::sizes::Input {
                matrix,
                points: &points,
                texels: &texels,
            };
            let mut part = MEMORY.cleared(0, fixel_workloads::scenes::STRIP);
            let _ = core::hint::black_box($draw(&mut part, &input));
            loop {
                $crate::wait();
            }
        }
    };
}

pub use cortex_m::asm::wfi as wait;
pub use cortex_m_rt::entry;
