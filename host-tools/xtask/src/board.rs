//! The boards whose emulation runs the images.

use crate::failure::Failure;

/// A board, its core and the emulator that knows it.
#[derive(Debug, Clone, Copy)]
pub struct Board {
    /// Key of its figures in limits and JSON.
    pub key: &'static str,
    /// For people.
    pub core: &'static str,
    /// What the compiler builds for.
    pub target: &'static str,
    /// Firmware package with its images.
    pub package: &'static str,
    /// Features of that package that the board needs.
    pub features: &'static str,
    /// The program that emulates it.
    pub emulator: Emulator,
    /// The board's name there.
    pub machine: &'static str,
}

/// An emulator's program.
#[derive(Debug, Clone, Copy)]
pub struct Emulator {
    /// What it is called.
    pub program: &'static str,
    /// Debian's package that holds it.
    pub package: &'static str,
    /// Options that all of its boards here need.
    pub options: &'static [&'static str],
}

const ARM: Emulator = Emulator {
    program: "qemu-system-arm",
    package: "qemu-system-arm",
    // One instruction is one nanosecond of the emulated clock: what the counts rest on.
    options: &["-icount", "shift=0"],
};

const RISC_V: Emulator = Emulator {
    program: "qemu-system-riscv32",
    package: "qemu-system-misc",
    // Without firmware of its own, which `virt` looks for; `sleep=off`: the counter starts alike in every run.
    options: &["-icount", "shift=0,sleep=off", "-bios", "none"],
};

/// No divider, no 64-bit product. The emulator's Cortex-M3 executes the same instructions.
pub const M0: Board = Board {
    key: "m0",
    core: "Cortex-M0",
    target: "thumbv6m-none-eabi",
    machine: "mps2-an385",
    ..M4
};

/// The reference.
pub const M4: Board = Board {
    key: "m4",
    core: "Cortex-M4F",
    target: "thumbv7em-none-eabihf",
    package: "fixel-cortex-m",
    features: "",
    emulator: ARM,
    machine: "mps2-an386",
};

/// The images of the Cortex-M4F.
pub const M7: Board = Board {
    key: "m7",
    core: "Cortex-M7",
    machine: "mps2-an500",
    ..M4
};

/// With multiplication and compressed instructions, without floating point.
pub const RISCV: Board = Board {
    key: "riscv",
    core: "RV32IMC",
    target: "riscv32imc-unknown-none-elf",
    package: "fixel-riscv",
    features: "",
    emulator: RISC_V,
    machine: "virt",
};

/// A Cortex-M0 with 16 KiB of RAM.
pub const MICROBIT: Board = Board {
    key: "microbit",
    core: "micro:bit",
    features: "microbit",
    machine: "microbit",
    ..M0
};

/// All that every image runs on.
pub const BOARDS: [Board; 4] = [M0, M4, M7, RISCV];

/// A complaint that names every emulator that is not installed, before anything is built.
pub fn require_emulators(boards: &[Board]) -> Result<(), Failure> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let is_there = |program: &str| std::env::split_paths(&path).any(|dir| dir.join(program).is_file());
    let mut missing: Vec<_> = boards.iter().filter(|b| !is_there(b.emulator.program)).collect();
    missing.dedup_by_key(|board| board.emulator.program);
    let lines: Vec<_> = missing.into_iter().map(Board::without_emulator).collect();
    if lines.is_empty() {
        Ok(())
    } else {
        Err(Failure::Usage(lines.join("\n")))
    }
}

impl Board {
    /// What to do where the emulator is missing.
    pub fn without_emulator(&self) -> String {
        let Emulator { program, package, .. } = self.emulator;
        format!(
            "the emulator {program} for {} is not installed; on Debian: apt-get install --no-install-recommends {package}",
            self.core
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_emulator_is_named_once_with_its_package() {
        let missing = |board: Board| Board {
            emulator: Emulator {
                program: "no-such-emulator",
                ..board.emulator
            },
            ..board
        };
        let Err(Failure::Usage(message)) = require_emulators(&[missing(RISCV), missing(RISCV)]) else {
            panic!("found an emulator that does not exist");
        };
        assert_eq!(message.matches("no-such-emulator").count(), 1);
        assert!(message.contains("apt-get") && message.contains("qemu-system-misc"));
    }
}
