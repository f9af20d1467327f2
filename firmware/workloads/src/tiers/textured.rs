//! A corridor of bricks in perspective.

use core::hint::black_box;
use core::marker::PhantomData;

use fixel::draw::indexed;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::num::Block;
use fixel::quality::Quality;
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

/// Coordinates that are values in perspective of the tier.
pub fn corridor<Q: Quality, P: Output>(canvas: &mut Canvas<P>, models: &Models) -> Result<(), Error> {
    with::<Q::Perspective<2>, P>(canvas, models)
}

/// Coordinates of any kind.
pub fn with<V, P>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error>
where
    V: Varying<Values = [i32; 2]> + Carried<Vertex = [i32; 2]>,
    P: Output,
{
    let (mut color, mut depth) = canvas.buffers()?;
    let view = CORRIDOR.view()?;
    let fragment = Tiled::<V, P> {
        texels: black_box(&BRICKS),
        kind: PhantomData,
    };
    for quad in black_box(&ROOM) {
        let vertices = quad.map(|corner| {
            let [x, y, z] = corner.position;
            view.vertex(Block::from_integers([x, y, z, 1]), corner.texel.map(|c| c << 16))
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
