//! A corridor of bricks in perspective.

use core::hint::black_box;
use core::marker::PhantomData;

use fixel::draw::indexed;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::num::Block;
use fixel::quality::Quality;
use fixel::texture::TiledBilinear565;
use fixel::varying::Varying;
use fixel::view::Carried;

use super::camera::CORRIDOR;
use super::canvas::Canvas;
use super::color::Output;
use super::geometry::{BRICKS, Models, ROOM, SIDE};

/// The nearest texel of a texture that repeats.
struct Tiled<'a, V, P> {
    texels: &'a [[u16; SIDE]; SIDE],
    kind: PhantomData<(V, P)>,
}

impl<V: Varying<Values = [i32; 2]>, P: Output> Fragment for Tiled<'_, V, P> {
    type Varying = V;
    type Pixel = P;

    #[inline(always)]
    fn shade(&self, coordinates: [i32; 2], _below: P) -> Option<P> {
        let [i, j] = coordinates.map(|c| (c >> 16) as usize & (SIDE - 1));
        // Always there: what the bounds are checked against are constants.
        self.texels
            .get(j)
            .and_then(|row| row.get(i))
            .map(|&texel| P::texel(texel))
    }
}

/// The texels around a place of a texture that repeats.
struct Smooth<'a, V, P> {
    texels: TiledBilinear565<'a, V, SIDE, SIDE>,
    kind: PhantomData<P>,
}

impl<V: Varying<Values = [i32; 2]>, P: Output> Fragment for Smooth<'_, V, P> {
    type Varying = V;
    type Pixel = P;

    #[inline(always)]
    fn shade(&self, coordinates: [i32; 2], _below: P) -> Option<P> {
        Some(P::filtered(&self.texels, coordinates))
    }
}

/// How many times the bricks are as large where they are [filtered](filtered), as a power of two.
pub const MAGNIFIED: u32 = 2;

/// The nearest texels, at coordinates that are values in perspective of the tier.
pub fn corridor<Q: Quality, P: Output>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error> {
    draw(canvas, nearest::<Q::Perspective<2>, P>(), 16)
}

/// The nearest texels, large.
pub fn unfiltered<Q: Quality, P: Output>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error> {
    draw(canvas, nearest::<Q::Perspective<2>, P>(), 16 - MAGNIFIED)
}

/// Large texels, filtered linearly.
pub fn filtered<Q: Quality, P: Output>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error> {
    let fragment = Smooth::<Q::Perspective<2>, P> {
        texels: TiledBilinear565::new(black_box(&BRICKS)),
        kind: PhantomData,
    };
    draw(canvas, fragment, 16 - MAGNIFIED)
}

fn nearest<V, P>() -> Tiled<'static, V, P> {
    Tiled {
        texels: black_box(&BRICKS),
        kind: PhantomData,
    }
}

/// A texel of the model is 2^`bits` units of the fragments'.
fn draw<F>(canvas: &mut Canvas<F::Pixel>, fragment: F, bits: u32) -> Result<(), Error>
where
    F: Fragment<Varying: Carried<Vertex = [i32; 2]>, Pixel: Output>,
{
    let (mut color, mut depth) = canvas.buffers()?;
    let view = CORRIDOR.view()?;
    for quad in black_box(&ROOM) {
        let vertices = quad.map(|corner| {
            let [x, y, z] = corner.position;
            view.vertex(Block::from_integers([x, y, z, 1]), corner.texel.map(|c| c << bits))
        });
        indexed(
            &view,
            &mut color,
            &mut depth,
            &vertices,
            [[0u16, 1, 2], [0, 2, 3]],
            &fragment,
        );
    }
    Ok(())
}
