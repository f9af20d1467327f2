//! All workloads in turn: prepare, clear, draw counted, check, report.

use core::fmt::{self, Write};
use core::hint::black_box;

use fixel::span::{doubled_area, scan};
use heapless::{String, Vec};

use crate::bytes::{Vertex, triangles};
use crate::draw::{
    flat, flat_depth, gouraud, gouraud_depth, gouraud_depth_compact, prepare_flat, prepare_gouraud, prepare_spanned,
    prepare_textured, spanned_depth, textured_depth,
};
use crate::frame::Frame;
use crate::machine::{Line, Machine};
use crate::mesh;
use crate::shapes::{REPEATS, SHAPES, Shape};

/// Triangles prepared at a time: a workload of more is measured in as many pieces.
const BATCH: usize = 64;

/// Runs every workload of `file` that is known, and the built-in shapes.
pub fn run(machine: &mut impl Machine, frame: &mut Frame, file: &[u8]) {
    if let Some(triangles) = triangles(file, "W1") {
        measure(machine, frame, "W1", triangles, prepare_flat, flat);
    }
    if let Some(triangles) = triangles(file, "W2") {
        measure(machine, frame, "W2", triangles, prepare_gouraud, gouraud_depth);
    }
    if let Some(triangles) = triangles(file, "W2") {
        measure(
            machine,
            frame,
            "W2_compact",
            triangles,
            prepare_gouraud,
            gouraud_depth_compact,
        );
    }
    if let Some(triangles) = triangles(file, "W3") {
        measure(machine, frame, "W3_exact", triangles, prepare_textured, textured_depth);
    }
    if let Some(triangles) = triangles(file, "W3") {
        measure(machine, frame, "W3_spans", triangles, prepare_spanned, spanned_depth);
    }
    if let Some(triangles) = triangles(file, "W4") {
        measure(machine, frame, "W4", triangles, prepare_gouraud, gouraud_depth);
    }
    if let Some(triangles) = triangles(file, "W4") {
        measure(
            machine,
            frame,
            "W4_compact",
            triangles,
            prepare_gouraud,
            gouraud_depth_compact,
        );
    }
    mesh::run(machine, frame, file);
    for shape in SHAPES {
        measure_shape(machine, frame, "flat", shape, prepare_flat, flat);
        measure_shape(machine, frame, "flat_depth", shape, prepare_flat, flat_depth);
        measure_shape(machine, frame, "gouraud", shape, prepare_gouraud, gouraud);
        measure_shape(machine, frame, "gouraud_depth", shape, prepare_gouraud, gouraud_depth);
    }
}

fn measure_shape<T>(
    machine: &mut impl Machine,
    frame: &mut Frame,
    kind: &str,
    shape: Shape,
    prepare: fn([Vertex; 3]) -> T,
    draw: fn(&mut Frame, &[T]),
) {
    let mut name = String::<32>::new();
    // Names are constants that fit.
    let _: fmt::Result = write!(name, "{kind}/{}", shape.name);
    let repeated = (0..REPEATS).map(|_| shape.corners());
    measure(machine, frame, &name, repeated, prepare, draw);
}

/// Only `draw` is counted.
fn measure<T>(
    machine: &mut impl Machine,
    frame: &mut Frame,
    name: &str,
    triangles: impl Iterator<Item = [Vertex; 3]>,
    prepare: fn([Vertex; 3]) -> T,
    draw: fn(&mut Frame, &[T]),
) {
    frame.clear();
    let (mut instructions, mut units) = (0, 0);
    let mut batch = Vec::<T, BATCH>::new();
    let mut triangles = triangles.peekable();
    while let Some(triangle) = triangles.next() {
        units += covered(triangle);
        // There is room: a full batch is drawn at once.
        let _full = batch.push(prepare(triangle));
        if batch.is_full() || triangles.peek().is_none() {
            instructions += machine.count(|| draw(black_box(&mut *frame), black_box(&batch)));
            batch.clear();
        }
    }
    let (color, depth) = frame.checksums();
    machine.report(&Line {
        name,
        instructions,
        units,
        color,
        depth,
    });
}

/// Pixels of the picture that the triangle covers.
fn covered(triangle: [Vertex; 3]) -> u32 {
    let corners = triangle.map(Vertex::flat);
    let mut pixels = 0;
    scan::<i32>(&corners, doubled_area(&corners) > 0, Frame::window(), |span| {
        pixels += (span.right - span.left) as u32;
    });
    pixels
}
