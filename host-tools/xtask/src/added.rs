//! What drawing as W2 does adds to a firmware: flash over an empty one, RAM beside the buffers.

use std::fs;

use fixel_workloads::frame::Frame;

use crate::board::M4;
use crate::elf::Elf;
use crate::emulator;
use crate::failure::Failure;
use crate::image::{PROFILES, build_size};
use crate::toolchain::Toolchain;

/// Most bytes of code that drawing may add, at opt-level 3 and at s.
pub const MOST_FLASH: [usize; 2] = [3 * 1024, 2_253];
/// Most bytes of RAM beside the buffers, stack and all.
pub const MOST_RAM: usize = 1024;

/// Bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sizes {
    /// Of code and constants over an empty firmware, at opt-level 3 and at s.
    pub flash: [usize; 2],
    /// The same of [compact](fixel::fragment::Compact) drawing.
    pub compact: [usize; 2],
    /// Of variables beside the buffers.
    pub variables: usize,
    /// Of stack while drawing.
    pub stack: usize,
}

impl Sizes {
    /// Of images built here for the Cortex-M4F.
    pub fn measure() -> Result<Self, Failure> {
        let toolchain = Toolchain::find(M4.target)?;
        let (mut flash, mut compact, mut variables) = ([0; 2], [0; 2], 0);
        for ((bytes, fewer), profile) in flash.iter_mut().zip(&mut compact).zip(PROFILES) {
            let size = |name| {
                let file = build_size(&toolchain, profile, name)?;
                let bytes = fs::read(&file).map_err(|e| Failure::trouble(file.display(), e))?;
                let elf = Elf::parse(&bytes).ok_or_else(|| Failure::Trouble(format!("{name}: not an image")))?;
                Ok((elf.code_size(), elf.ram_size()))
            };
            let ((empty, _), (w2, ram)) = (size("empty")?, size("w2")?);
            *bytes = w2.saturating_sub(empty);
            *fewer = size("w2_compact")?.0.saturating_sub(empty);
            variables = ram.saturating_sub(size_of::<Frame>());
        }
        let stack = emulator::run(&M4, &build_size(&toolchain, PROFILES[0], "stack")?)?;
        let stack = stack.trim().parse();
        Ok(Sizes {
            flash,
            compact,
            variables,
            stack: stack.map_err(|e| Failure::trouble("bytes of stack", e))?,
        })
    }

    /// All of RAM beside the buffers.
    pub fn ram(&self) -> usize {
        self.variables + self.stack
    }
}
