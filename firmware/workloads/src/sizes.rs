//! A drawing of each set of features, for its size: with transform and clipping, and nothing that it does not need.
//!
//! Every image hands its function what the others have too: memory, a matrix, vertices; the empty one does nothing with them.

mod everything;

pub use everything::everything;
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{Less, NoDepth};
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Compact, Flat, Fragment, Gouraud565};
use fixel::matrix::Matrix;
use fixel::num::Block;
use fixel::texture::{Floor, Nearest, Rgb565, Texture};
use fixel::varying::{Color565, Perspective};
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;

use crate::scenes::part::{HEIGHT, Part, WIDTH};

/// A position and a colour, or texture coordinates in texels.
pub type Point = ([i32; 4], [u8; 3]);

/// What a firmware would compute or have in flash.
pub struct Input<'a> {
    /// To clip space.
    pub matrix: [i32; 16],
    /// Every three are a triangle.
    pub points: &'a [Point],
    /// 16×16 of them.
    pub texels: &'a [u16],
}

/// Draws the input in one way.
pub type Draw = fn(&mut Part<'_>, &Input<'_>) -> Result<(), Error>;

/// What all images have: no drawing.
pub fn empty(part: &mut Part<'_>, input: &Input<'_>) -> Result<(), Error> {
    core::hint::black_box((part, input));
    Ok(())
}

fn view(input: &Input<'_>, depth_range: DepthRange) -> Result<View<i32, i32, 0>, Error> {
    Ok(View {
        projection: Matrix::from_rows(Block::from_integers(input.matrix)),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up(),
        depth_range,
        behind: Behind::Cut,
        cull: Cull::Clockwise,
    })
}

fn vertex<A>((position, values): Point, carried: impl FnOnce([u8; 3]) -> A) -> Vertex<i32, A> {
    Vertex {
        position: Block::from_integers(position),
        carried: carried(values),
    }
}

/// One colour a triangle, no depth.
pub fn flat(part: &mut Part<'_>, input: &Input<'_>) -> Result<(), Error> {
    each_flat(part, input, Flat)
}

/// As [`flat`], by less code.
pub fn flat_compact(part: &mut Part<'_>, input: &Input<'_>) -> Result<(), Error> {
    each_flat(part, input, |pixel| Compact(Flat(pixel)))
}

fn each_flat<F>(part: &mut Part<'_>, input: &Input<'_>, of: impl Fn(u16) -> F) -> Result<(), Error>
where
    F: Fragment<Varying = (), Pixel = u16>,
{
    let (view, mut color) = (view(input, DepthRange::Unlimited)?, part.color()?);
    for points in input.points.as_chunks::<3>().0 {
        let [(_, [red, green, _]), ..] = *points;
        let fragment = of(u16::from_le_bytes([red, green]));
        let vertices = points.map(|point| vertex(point, |_| ()));
        draw::primitive(&view, &mut color, &mut NoDepth, &vertices, &fragment);
    }
    Ok(())
}

/// Colours between the corners, with depth.
pub fn gouraud(part: &mut Part<'_>, input: &Input<'_>) -> Result<(), Error> {
    each_gouraud(part, input, &Gouraud565)
}

/// As [`gouraud`], by less code.
pub fn gouraud_compact(part: &mut Part<'_>, input: &Input<'_>) -> Result<(), Error> {
    each_gouraud(part, input, &Compact(Gouraud565))
}

fn each_gouraud<F>(part: &mut Part<'_>, input: &Input<'_>, fragment: &F) -> Result<(), Error>
where
    F: Fragment<Varying = Color565, Pixel = u16>,
{
    let view = view(input, DepthRange::MinusOneToOne)?;
    let (mut color, mut depth) = part.compared::<Less>()?;
    for points in input.points.as_chunks::<3>().0 {
        let vertices = points.map(|point| vertex(point, |[r, g, b]| Gouraud565::corner(r, g, b).0));
        draw::primitive(&view, &mut color, &mut depth, &vertices, fragment);
    }
    Ok(())
}

struct Textured<'a>(Nearest<'a, Rgb565, Floor>);

impl Fragment for Textured<'_> {
    type Varying = Perspective<2>;
    type Pixel = u16;
    fn shade(&self, st: [i32; 2], _below: u16) -> Option<u16> {
        Some(self.0.stored(st))
    }
}

/// Texture in perspective, with depth.
pub fn textured(part: &mut Part<'_>, input: &Input<'_>) -> Result<(), Error> {
    each_textured(part, input, |fragment| fragment)
}

/// As [`textured`], by less code.
pub fn textured_compact(part: &mut Part<'_>, input: &Input<'_>) -> Result<(), Error> {
    each_textured(part, input, Compact)
}

fn each_textured<'a, F>(part: &mut Part<'_>, input: &Input<'a>, of: impl Fn(Textured<'a>) -> F) -> Result<(), Error>
where
    F: Fragment<Varying = Perspective<2>, Pixel = u16>,
{
    let view = view(input, DepthRange::MinusOneToOne)?;
    let fragment = of(Textured(Nearest::new(Texture::new(Rgb565, input.texels, 16, 16)?, 16)));
    let (mut color, mut depth) = part.compared::<Less>()?;
    for points in input.points.as_chunks::<3>().0 {
        let vertices = points.map(|point| vertex(point, |[s, t, _]| [s, t].map(|v| i32::from(v) << 16)));
        draw::primitive(&view, &mut color, &mut depth, &vertices, &fragment);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::scenes::part::Memory;

    #[test]
    fn every_set_draws() {
        let input = Input {
            matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
            points: &[
                ([-1, -1, 0, 1], [255, 7, 0]),
                ([1, -1, 0, 1], [9, 90, 200]),
                ([0, 1, 0, 1], [3, 9, 1]),
            ],
            texels: &[0xffff; 256],
        };
        let mut memory = std::boxed::Box::new(<Memory>::new());
        let pixels = [
            empty,
            flat,
            flat_compact,
            gouraud,
            gouraud_compact,
            textured,
            textured_compact,
            everything,
        ]
        .map(|draw: Draw| {
            let mut part = memory.cleared(0, HEIGHT);
            assert_eq!(draw(&mut part, &input), Ok(()));
            part.colors().iter().filter(|&&pixel| pixel != 0).count()
        });
        assert_eq!(pixels[0], 0);
        assert!(pixels[1..].iter().all(|&count| count > 1000), "{pixels:?}");
    }
}
