//! A model drawn in stages: prepare, clear, draw counted, check, report.

use core::hint::black_box;

use super::canvas::Canvas;
use super::draw::{pixels, polygons, vertices, view};
use super::{Model, Object};
use crate::machine::{Line, Machine};

/// A stage: its instructions with those of the stages before it, and how many of something it came to.
#[derive(Default)]
struct Stage {
    instructions: u32,
    units: u32,
}

/// Draws the model in `words` and reports `vertices` (units: how many were made), `polygons` (units: how many triangles are
/// seen) and `frame` (units: 1), each with the instructions of those before it. Clearing is not counted, nor is what is done once
/// when a model is loaded: checking its mesh.
///
/// `None` where the words hold no model, or its picture is too large.
pub fn run(machine: &mut impl Machine, canvas: &mut Canvas, words: &[u16]) -> Option<()> {
    let model = Model::new(words)?;
    canvas.clear();
    let (mut made, mut seen, mut frame) = (Stage::default(), Stage::default(), 0);
    for object in model.objects() {
        let object = object?;
        let (object, view) = (black_box(&object), view(&model, &object).ok()?);
        made.instructions += machine.count(|| made.units += vertices(object));
        seen.instructions += machine.count(|| seen.units += polygons(object, black_box(&view)));
        frame += draw(machine, canvas, &model, object)?;
    }
    let (color, depth) = canvas.checksums();
    let frame = Stage {
        instructions: frame,
        units: 1,
    };
    for (name, stage) in [("vertices", made), ("polygons", seen), ("frame", frame)] {
        machine.report(&Line {
            name,
            instructions: stage.instructions,
            units: stage.units,
            color,
            depth,
        });
    }
    Some(())
}

/// What drawing the object took.
fn draw(machine: &mut impl Machine, canvas: &mut Canvas, model: &Model<'_>, object: &Object<'_>) -> Option<u32> {
    let view = view(model, object).ok()?;
    let (mut color, mut depth) = canvas.buffers(model.width, model.height).ok()?;
    Some(machine.count(|| pixels(object, black_box(&view), &mut color, &mut depth)))
}
