//! Every workload that a rival can draw: prepared, drawn counted, reported.

use alloc::format;
use core::hint::black_box;

use fixel_workloads::machine::{Line, Machine};

use crate::embedded_3dgfx::Embedded3dgfx;
use crate::embedded_graphics::EmbeddedGraphics;
use crate::euc::Euc;
use crate::retrofire::Retrofire;
use crate::scene::triangles;
use crate::{Kind, Rival};

/// The workloads of triangles on the screen.
const WORKLOADS: [(&str, Kind); 4] = [
    ("W1", Kind::Flat),
    ("W2", Kind::Gouraud),
    ("W3", Kind::Textured),
    ("W4", Kind::Gouraud),
];

/// Runs every rival on the workloads of `file`, of which `wanted` says that it is wanted. Lines are called
/// `rival/workload`.
pub fn run(machine: &mut impl Machine, file: &[u8], wanted: impl Fn(&str) -> bool) {
    run_one::<Euc>(machine, file, &wanted);
    run_one::<Retrofire>(machine, file, &wanted);
    run_one::<Embedded3dgfx>(machine, file, &wanted);
    run_one::<EmbeddedGraphics>(machine, file, &wanted);
}

fn run_one<R: Rival>(machine: &mut impl Machine, file: &[u8], wanted: &impl Fn(&str) -> bool) {
    for (workload, kind) in WORKLOADS {
        let name = format!("{}/{workload}", R::NAME);
        if !wanted(&name) {
            continue;
        }
        let Some(prepared) = R::prepare(kind, &triangles(file, workload)) else {
            continue;
        };
        let mut frame = R::frame();
        let instructions = machine.count(|| R::draw(black_box(&prepared), black_box(&mut frame)));
        let colors = R::colors(&frame);
        machine.report(&Line {
            name: &name,
            instructions,
            units: colors.iter().filter(|&&color| color != 0).count() as u32,
            color: checksum(colors),
            depth: 0,
        });
    }
}

/// Of no standard: so that one sees whether two machines drew the same.
fn checksum(colors: &[u16]) -> u32 {
    colors
        .iter()
        .fold(0, |sum: u32, &color| sum.rotate_left(5) ^ u32::from(color))
}
