//! For each class: a difference within its allowance is explained, one just beyond it is not. δ is [`SNAP`] here, the vertex
//! path of these scenes being exact but for 10⁻¹⁴ px.

mod coverage;
mod lit;
mod textured;
mod values;
mod whole;

use super::picture::{FixedPicture, Pixel};
use super::stated::SNAP;
use super::{Class, Comparison, compare};
use crate::backend::{BackEnd, Surface, Vertex};
use crate::reference::hw2::Reference;
use crate::reference::material::Material;
use std::sync::Arc;

type Rendered = crate::reference::Rendered<Arc<Material>>;

/// Width and height of the pictures: a power of two, so that positions in px come through exactly.
const SIZE: u32 = 32;
const RED: Surface = Surface::Flat([1.0, 0.0, 0.0]);
const GREEN: Surface = Surface::Flat([0.0, 1.0, 0.0]);
const RED_BYTES: [u8; 4] = [255, 0, 0, 255];
const GREEN_BYTES: [u8; 4] = [0, 255, 0, 255];

/// A white vertex at x, y in px and depth z.
fn at(x: f64, y: f64, z: f64) -> Vertex {
    projective(x, y, z, 1.0)
}

/// The same with some w.
fn projective(x: f64, y: f64, z: f64, w: f64) -> Vertex {
    let half = f64::from(SIZE) / 2.0;
    let position = [(x / half - 1.0) * w, (y / half - 1.0) * w, z * w, w];
    Vertex {
        position,
        color: [1.0; 3],
        normal: None,
        texcoord: [0.0; 2],
    }
}

fn colored(vertex: Vertex, level: f64) -> Vertex {
    Vertex {
        color: [level / 255.0; 3],
        ..vertex
    }
}

/// A triangle that covers every pixel right of the vertical line at x, at depth z.
fn right_of(x: f64, z: f64) -> [Vertex; 3] {
    [at(x, -40.0, z), at(x + 99.0, 16.0, z), at(x, 72.0, z)]
}

/// The reference's picture of triangles in order.
fn rendered(triangles: &[([Vertex; 3], Surface)]) -> Rendered {
    prepared(|_| {}, triangles)
}

/// The same after other commands.
fn prepared(prepare: impl Fn(&mut Reference), triangles: &[([Vertex; 3], Surface)]) -> Rendered {
    let mut reference = Reference::new(SIZE, SIZE);
    prepare(&mut reference);
    for (number, (corners, surface)) in (1..).zip(triangles) {
        reference.triangle(number, *corners, *surface).unwrap();
    }
    reference.finish()
}

/// What the core would have drawn if it were the reference.
fn as_fixed(rendered: &Rendered) -> FixedPicture {
    let winners = rendered.pixels.iter().map(|pixel| pixel.primitive);
    let pixels = rendered.bytes().into_iter().zip(winners);
    FixedPicture {
        width: rendered.width,
        height: rendered.height,
        pixels: pixels.map(|(rgba, primitive)| Pixel { rgba, primitive }).collect(),
        depth: rendered
            .pixels
            .iter()
            .map(|pixel| (65535.0 * pixel.depth).round() as u16)
            .collect(),
    }
}

/// The class of pixel (10, 16) if the core had drawn it like this, and everything else like the reference.
fn class(reference: &Rendered, rgba: [u8; 4], primitive: u32) -> Class {
    let mut fixed = as_fixed(reference);
    let index = 16 * SIZE as usize + 10;
    fixed.pixels[index] = Pixel { rgba, primitive };
    let comparison = compare(&fixed, reference);
    assert_eq!(
        comparison.unexplained,
        u64::from(comparison.classes[index] == Class::Unexplained)
    );
    comparison.classes[index]
}

/// The class if the core had left the pixel out.
fn class_if_missing(reference: &Rendered) -> Class {
    class(reference, [0; 4], 0)
}
