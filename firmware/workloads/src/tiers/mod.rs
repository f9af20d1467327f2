//! What the tiers of [`fixel::quality`] cost and how near they come: scenes that are drawn by each, and by the exact one with
//! one dial turned.
//!
//! The boards count the instructions of a whole frame, from stored vertices to RGB565 pixels. The host draws the same by the
//! same functions, to the same bits, and once more into [`Fine`](color::Fine) pixels, which keep what RGB565 rounds off: those
//! are compared with float64.

pub mod camera;
pub mod canvas;
pub mod color;
mod dials;
mod edges;
pub mod geometry;
mod light;
pub mod lit;
mod mesh;
mod output;
pub mod sines;
pub mod textured;

use core::fmt::{self, Write};
use core::hint::black_box;

use canvas::Canvas;
use color::Output;
use fixel::error::Error;
use fixel::num::{Micromath, ShortSine, SineTable};
use fixel::quality::{Balanced, Exact, Fast};
use geometry::Models;
use heapless::String;

use crate::frame::crc32;
use crate::machine::{Line, Machine};

/// Draws a frame.
pub type Draw<P> = fn(&mut Canvas<P>, &Models) -> Result<(), Error>;

/// A scene in a way of computing.
pub struct Case<P> {
    /// Which scene.
    pub scene: &'static str,
    /// The tier, or what is turned of the exact one.
    pub dial: &'static str,
    /// One frame.
    pub draw: Draw<P>,
}

const fn case<P>(scene: &'static str, dial: &'static str, draw: Draw<P>) -> Case<P> {
    Case { scene, dial, draw }
}

/// The tiers' names, from the cheapest on.
pub const TIERS: [&str; 3] = ["fast", "balanced", "exact"];

/// Every scene in every tier, and with every dial that it has turned alone.
pub const fn cases<P: Output>() -> [Case<P>; 41] {
    [
        case("flat", "fast", mesh::flat::<Fast, P>),
        case("flat", "balanced", mesh::flat::<Balanced, P>),
        case("flat", "exact", mesh::flat::<Exact, P>),
        case("flat", "without depth", mesh::flat_without_depth::<Exact, P>),
        case("gouraud", "fast", mesh::gouraud::<Fast, P>),
        case("gouraud", "balanced", mesh::gouraud::<Balanced, P>),
        case("gouraud", "exact", mesh::gouraud::<Exact, P>),
        case("gouraud", "packed colours", mesh::gouraud::<dials::Packed, P>),
        case("gouraud", "one Newton step", mesh::gouraud::<dials::OneNewton, P>),
        case("gouraud", "tables", mesh::gouraud::<dials::Tables, P>),
        case("gouraud", "without depth", mesh::gouraud_without_depth::<Exact, P>),
        case("textured", "fast", textured::corridor::<Fast, P>),
        case("textured", "balanced", textured::corridor::<Balanced, P>),
        case("textured", "exact", textured::corridor::<Exact, P>),
        case("textured", "32-bit words", textured::corridor::<dials::Narrow, P>),
        case("textured", "1/8 texel", textured::corridor::<dials::EighthTexel, P>),
        case("textured", "affine", textured::corridor::<dials::Affine, P>),
        case("lit", "fast", lit::per_pixel::<Fast, P>),
        case("lit", "balanced", lit::per_pixel::<Balanced, P>),
        case("lit", "exact", lit::per_pixel::<Exact, P>),
        case("lit", "one Newton step", lit::per_pixel::<dials::OneNewton, P>),
        case("lit", "tables", lit::per_pixel::<dials::Tables, P>),
        case("lit", "32-bit words", lit::per_pixel::<dials::Narrow, P>),
        case("lit", "1/2 texel", lit::per_pixel::<dials::HalfTexel, P>),
        case("lit", "affine", lit::per_pixel::<dials::Affine, P>),
        case("lit", "per vertex", mesh::sphere::<Exact, P>),
        case("convex", "with depth", mesh::sphere::<Exact, P>),
        case("convex", "without depth", mesh::sphere_without_depth::<Exact, P>),
        case("filtered", "nearest", textured::unfiltered::<Exact, P>),
        case("filtered", "linear", textured::filtered::<Exact, P>),
        case("sky", "nearest", output::nearest),
        case("sky", "dithered", output::dithered),
        case("two levels", "nearest", output::nearest_of_two),
        case("two levels", "dithered", output::dithered_to_two),
        case("linear light", "at pixels", light::at_pixels),
        case("linear light", "at vertices", light::at_vertices),
        case("sines", "micromath", sines::draw::<Micromath, P>),
        case("sines", "short table", sines::draw::<ShortSine, P>),
        case("sines", "larger table", sines::draw::<SineTable, P>),
        case("edges", "1/16 px", edges::draw::<4, P>),
        case("edges", "1/256 px", edges::draw::<8, P>),
    ]
}

/// Draws every case, counted. A line is called `scene/dial`, blanks of the dial's name as underscores; its units are pixels
/// that are not black.
pub fn run(machine: &mut impl Machine, canvas: &mut Canvas<u16>) {
    let models = Models::new();
    for case in cases() {
        canvas.clear();
        let mut drawn = Ok(());
        let draw = black_box(case.draw);
        let instructions = machine.count(|| drawn = draw(black_box(&mut *canvas), black_box(&models)));
        // One that cannot be drawn has no line, and is missed.
        if drawn.is_ok() {
            report(machine, canvas, &case, instructions);
        }
    }
}

/// What the line of a case is called.
pub fn line_name<P>(case: &Case<P>) -> String<48> {
    let mut name = String::new();
    for letter in case.scene.chars().chain("/".chars()).chain(case.dial.chars()) {
        // Names are constants that fit.
        let _: fmt::Result = name.write_char(if letter == ' ' { '_' } else { letter });
    }
    name
}

fn report(machine: &mut impl Machine, canvas: &Canvas<u16>, case: &Case<u16>, instructions: u32) {
    machine.report(&Line {
        name: &line_name(case),
        instructions,
        units: canvas.colors().iter().filter(|&&pixel| pixel != u16::EMPTY).count() as u32,
        color: crc32(canvas.colors()),
        depth: crc32(canvas.depths()),
    });
}
