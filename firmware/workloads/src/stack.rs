//! One triangle of each kind, to see how much stack it takes.

use core::hint::black_box;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{Less, NoDepth};
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Flat, Fragment, Gouraud565};
use fixel::light::{Light, Lights, Lit, Shiny};
use fixel::matrix::Matrix;
use fixel::num::{Block, Scaled, unit};
use fixel::screen::{Corner, FineDepth, Position};
use fixel::texture::{Floor, Nearest, Rgb565};
use fixel::varying::Perspective;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;

use crate::scenes::TEXTURE;
use crate::scenes::part::{HEIGHT, Memory, Part, WIDTH};

/// Takes `BYTES` of stack and little else.
#[inline(never)]
pub fn takes<const BYTES: usize>() {
    black_box([1u8; BYTES]);
}

/// A texture, lit by a sun and a lamp with highlights.
struct LitTexture<'a> {
    texture: Nearest<'static, Rgb565, Floor>,
    lights: Lit<'a, 1>,
}

impl Fragment for LitTexture<'_> {
    type Varying = Perspective<8>;
    type Pixel = u16;
    fn shade(&self, [s, t, nx, ny, nz, x, y, z]: [i32; 8], _below: u16) -> Option<u16> {
        let texel = i32::from(self.texture.stored([s, t]));
        let surface = [(texel >> 11) << 11, (texel >> 5 & 63) << 10, (texel & 31) << 11];
        let normal = unit([nx, ny, nz])?;
        let color = self.lights.shade(normal, [x, y, z], surface, &Shiny(20 << 16));
        let [red, green, blue] = color.map(|c| c.clamp(0, 0xffff) as u32);
        Some((red >> 11 << 11 | green >> 10 << 5 | blue >> 11) as u16)
    }
}

/// Measures each; `report` gets its name, what `depth_of` says of drawing it, and how many pixels it covered.
///
/// # Errors
/// None: all sizes are constants.
pub fn run(
    memory: &mut Memory,
    mut depth_of: impl FnMut(&mut dyn FnMut()) -> u32,
    mut report: impl FnMut(&str, u32, u32),
) -> Result<(), Error> {
    type Draw = fn(&mut Part<'_>, &mut dyn FnMut(&mut dyn FnMut())) -> Result<(), Error>;
    let kinds: [(&str, Draw); 6] = [
        ("flat", flat),
        ("gouraud_depth", gouraud_depth),
        ("view_flat", view_flat),
        ("view_textured", view_textured),
        ("view_lit_textured", view_lit_textured::<0>),
        ("view_lit_textured_two_planes", view_lit_textured::<2>),
    ];
    for (name, draw) in kinds {
        let mut part = memory.cleared(0, HEIGHT);
        let mut bytes = 0;
        black_box(draw)(&mut part, &mut |work| bytes = depth_of(work))?;
        let pixels = part.colors().iter().filter(|&&pixel| pixel != 0).count();
        report(name, bytes, pixels as u32);
    }
    Ok(())
}

fn corners<V: Copy>(varying: V) -> [Corner<V>; 3] {
    black_box([(3, 2, 9), (70, 60, 60_000), (90, 5, 30_000)]).map(|(x, y, depth)| Corner {
        position: Position::from_pixels(x, y),
        depth: FineDepth::from_num(depth),
        varying,
    })
}

fn flat(part: &mut Part<'_>, measured: &mut dyn FnMut(&mut dyn FnMut())) -> Result<(), Error> {
    let mut color = part.color()?;
    let corners = corners(());
    measured(&mut || draw::triangle(&mut color, &mut NoDepth, corners, &Flat(7)));
    Ok(())
}

fn gouraud_depth(part: &mut Part<'_>, measured: &mut dyn FnMut(&mut dyn FnMut())) -> Result<(), Error> {
    let (mut color, mut depth) = part.compared::<Less>()?;
    let corners = corners(Gouraud565::corner(90, 120, 200));
    measured(&mut || draw::triangle(&mut color, &mut depth, corners, &Gouraud565));
    Ok(())
}

/// One corner behind the camera.
const CORNERS: [[i32; 4]; 3] = [[-4, -2, -5, 1], [5, -1, -7, 1], [0, 4, 2, 1]];

fn view<const N: usize>() -> Result<View<i32, i32, N>, Error> {
    let mut planes = Planes::default();
    for plane in black_box([[1, 1, 0, 2], [-2, 1, -1, -1]]).into_iter().take(N) {
        planes.push(Block::from_integers(plane))?;
    }
    Ok(View {
        projection: Matrix::frustum(black_box([-3, 3, -2, 2, 3, 40]).map(Scaled::from_integer))?,
        planes,
        viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    })
}

fn view_flat(part: &mut Part<'_>, measured: &mut dyn FnMut(&mut dyn FnMut())) -> Result<(), Error> {
    let (mut color, view) = (part.color()?, view::<0>()?);
    let vertices = black_box(CORNERS).map(|corner| Vertex {
        position: Block::from_integers(corner),
        carried: (),
    });
    measured(&mut || draw::primitive(&view, &mut color, &mut NoDepth, &vertices, &Flat(7)));
    Ok(())
}

struct Textured(Nearest<'static, Rgb565, Floor>);

impl Fragment for Textured {
    type Varying = Perspective<2>;
    type Pixel = u16;
    fn shade(&self, st: [i32; 2], _below: u16) -> Option<u16> {
        Some(self.0.stored(st))
    }
}

fn view_textured(part: &mut Part<'_>, measured: &mut dyn FnMut(&mut dyn FnMut())) -> Result<(), Error> {
    let view = view::<0>()?;
    let (mut color, mut depth) = part.compared::<Less>()?;
    let fragment = Textured(Nearest::new(TEXTURE?, 16));
    let vertices = black_box(CORNERS).map(|corner| Vertex {
        position: Block::from_integers(corner),
        carried: [corner[0] << 17, corner[1] << 17],
    });
    measured(&mut || draw::primitive(&view, &mut color, &mut depth, &vertices, &fragment));
    Ok(())
}

fn view_lit_textured<const N: usize>(
    part: &mut Part<'_>,
    measured: &mut dyn FnMut(&mut dyn FnMut()),
) -> Result<(), Error> {
    let view = view::<N>()?;
    let (mut color, mut depth) = part.compared::<Less>()?;
    let mut lights = Lights::<i32, 1, 1>::default();
    lights.add(Light::sun([0, 1, 2], [50_000; 3])?)?;
    lights.add(Light::Bulb {
        position: Block::from_integers([2, 1, -1]),
        color: [20_000, 50_000, 90_000],
    })?;
    let fragment = LitTexture {
        texture: Nearest::new(TEXTURE?, 16),
        lights: lights.at_scale(-16),
    };
    let vertices = black_box(CORNERS).map(|[x, y, z, w]| Vertex {
        position: Block::from_integers([x, y, z, w]),
        carried: [x << 17, y << 17, 0, 0, 1 << 30, x << 16, y << 16, z << 16],
    });
    measured(&mut || draw::primitive(&view, &mut color, &mut depth, &vertices, &fragment));
    Ok(())
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;

    #[test]
    fn every_kind_draws() {
        let mut kinds = 0;
        let counted = |work: &mut dyn FnMut()| {
            work();
            1
        };
        let done = run(
            &mut std::boxed::Box::new(Memory::new()),
            counted,
            |name, bytes, pixels| {
                assert!(bytes == 1 && pixels > 90, "{name}: {pixels} pixels");
                kinds += 1;
            },
        );
        assert_eq!((done, kinds), (Ok(()), 6));
    }
}
