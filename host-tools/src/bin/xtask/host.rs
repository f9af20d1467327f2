//! The measured programs on this machine: same code, same lines, nothing counted.

use fixel_workloads::flat;
use fixel_workloads::frame::Frame;
use fixel_workloads::machine::{Line, Machine};
use fixel_workloads::model::{self, canvas::Canvas};
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

/// Draws the flat triangles; nothing where they cannot be drawn.
pub fn draw_flat(draw: flat::Draw) -> Vec<Outcome> {
    let mut host = Host { outcomes: Vec::new() };
    let _drawn = flat::run(&mut host, &mut Frame::new(), draw);
    host.outcomes
}

/// Draws a model; also the picture. `None` where `words` hold none.
pub fn draw_model(words: &[u16]) -> Option<(Vec<Outcome>, Box<Canvas>)> {
    let mut host = Host { outcomes: Vec::new() };
    let mut canvas = Box::new(Canvas::new());
    model::program::run(&mut host, &mut canvas, words)?;
    Some((host.outcomes, canvas))
}
