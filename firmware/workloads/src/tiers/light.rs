//! A torus lit at every vertex, whose colours are linear light, or taken for it.

use core::marker::PhantomData;

use fixel::draw::indexed;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::num::TwoSteps;
use fixel::srgb::encode;
use fixel::varying::Linear;

use super::camera::TORUS;
use super::canvas::Canvas;
use super::color::{Levels, MOST, Output};
use super::geometry::Models;
use super::lit::{self, SCALE};
use super::mesh::vertices;

/// Interpolates linear light in units of 2^-28, and encodes it at every pixel.
struct AtPixels<P>(PhantomData<P>);

impl<P: Output> Fragment for AtPixels<P> {
    type Varying = Linear<3>;
    type Pixel = P;

    #[inline(always)]
    fn shade(&self, light: [i32; 3], _below: P) -> Option<P> {
        Some(P::of(encoded(light)))
    }
}

/// Interpolates what was encoded before.
struct AtVertices<P>(PhantomData<P>);

impl<P: Output> Fragment for AtVertices<P> {
    type Varying = Linear<3>;
    type Pixel = P;

    #[inline(always)]
    fn shade(&self, levels: Levels, _below: P) -> Option<P> {
        Some(P::of(levels))
    }
}

/// As sRGB.
#[inline(always)]
fn encoded(light: [i32; 3]) -> Levels {
    let mut levels = [0; 3];
    for ((level, light), most) in levels.iter_mut().zip(light).zip(MOST) {
        // Of 255·2^16: below 2^30. 1/255 is 1/256 + 1/256² + 1/256³ but for 2^-32.
        let of_255 = encode(light) * most as u32;
        *level = ((of_255 + (of_255 >> 8) + (of_255 >> 16)) >> 8) as i32 + 0x8000;
    }
    levels
}

/// What a light makes of a point, in units of 2^-28.
fn light([red, green, blue]: Levels) -> [i32; 3] {
    let [most_red, most_green, most_blue] = MOST;
    let of = |level: i32, most: i32| {
        let full = ((level - 0x8000) as i64) << 12;
        // Never `None`: there is no channel without levels.
        full.checked_div(most.into()).unwrap_or(0) as i32
    };
    [of(red, most_red), of(green, most_green), of(blue, most_blue)]
}

/// Encoded at every pixel.
pub fn at_pixels<P: Output>(canvas: &mut Canvas<P>, models: &Models) -> Result<(), Error> {
    draw(canvas, models, &AtPixels(PhantomData), |light| light)
}

/// Encoded at every vertex.
pub fn at_vertices<P: Output>(canvas: &mut Canvas<P>, models: &Models) -> Result<(), Error> {
    draw(canvas, models, &AtVertices(PhantomData), encoded)
}

fn draw<P: Output>(
    canvas: &mut Canvas<P>,
    models: &Models,
    fragment: &impl Fragment<Varying = Linear<3>, Pixel = P>,
    carried: impl Fn([i32; 3]) -> [i32; 3],
) -> Result<(), Error> {
    let (mut color, mut depth) = canvas.buffers()?;
    let (eye, lights) = (TORUS.view()?, lit::lights::<TwoSteps>()?);
    let (lights, mesh) = (lights.at_scale(-SCALE), &models.torus);
    let vertices = vertices(&eye, mesh, |point| {
        carried(light(lit::shade(&lights, lit::carried(point, &TORUS))))
    });
    indexed(
        &eye,
        &mut color,
        &mut depth,
        &vertices,
        mesh.triangles.iter().copied(),
        fragment,
    );
    Ok(())
}
