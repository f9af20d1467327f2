//! The boards whose emulation runs the images.

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
    /// The emulator's program, and the package that holds it.
    pub emulator: &'static str,
    /// The board's name there.
    pub machine: &'static str,
}

/// The reference.
pub const M4: Board = Board {
    key: "m4",
    core: "Cortex-M4F",
    target: "thumbv7em-none-eabihf",
    package: "fixel-cortex-m",
    emulator: "qemu-system-arm",
    machine: "mps2-an386",
};

/// All that are run.
pub const BOARDS: [Board; 1] = [M4];
