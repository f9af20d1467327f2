//! The measured program on this machine: same code, same lines, nothing counted.

use fixel_workloads::frame::Frame;
use fixel_workloads::machine::{Line, Machine};
use fixel_workloads::program;

use crate::outcome::Outcome;

struct Host {
    outcomes: Vec<Outcome>,
}

impl Machine for Host {
    fn count(&mut self, work: impl FnOnce()) -> u32 {
        work();
        0
    }

    fn report(&mut self, line: &Line<'_>) {
        self.outcomes.push(line.into());
    }
}

/// Draws the workloads in `bytes` and the built-in shapes.
pub fn run(bytes: &[u8]) -> Vec<Outcome> {
    let mut host = Host { outcomes: Vec::new() };
    program::run(&mut host, &mut Frame::new(), bytes);
    host.outcomes
}
