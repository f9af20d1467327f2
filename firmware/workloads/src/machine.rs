//! What the program needs of the machine under it.

use core::fmt;

/// A machine that can count instructions and tell.
pub trait Machine {
    /// Runs `work`; the instructions that took, 0 on a machine that does not count.
    fn count(&mut self, work: impl FnOnce()) -> u32;
    /// Hands a line to whoever started the program.
    fn report(&mut self, line: &Line<'_>);
}

/// The outcome of one workload. As text: `name instructions units colour depth`, checksums in hexadecimal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line<'a> {
    /// Which workload.
    pub name: &'a str,
    /// What drawing it once took.
    pub instructions: u32,
    /// How many pixels it covers, hidden ones included; of a model, what its stage says.
    pub units: u32,
    /// CRC-32 of the colour buffer afterwards, little-endian.
    pub color: u32,
    /// CRC-32 of the depth buffer afterwards, little-endian.
    pub depth: u32,
}

impl fmt::Display for Line<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Line {
            name,
            instructions,
            units,
            color,
            depth,
        } = self;
        write!(f, "{name} {instructions} {units} {color:08x} {depth:08x}")
    }
}
