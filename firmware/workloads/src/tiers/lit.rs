//! One light, and a shiny sphere that is lit by it at every pixel.

use core::marker::PhantomData;

use fixel::draw::indexed;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::light::{Light, Lights, Lit, Shiny};
use fixel::num::Precision;
use fixel::quality::Quality;

use super::camera::{Camera, SPHERE};
use super::canvas::Canvas;
use super::color::{Levels, MOST, Output};
use super::geometry::{Models, Point};
use super::mesh::vertices;

/// Towards the sun, in eye space.
pub const SUN: [i32; 3] = [-3, 4, 5];
/// Its colour, in units of 2^-16 of full: with that of the surface, what is brightest stays below full.
pub const SUNLIGHT: [i32; 3] = [40_000, 36_000, 30_000];
/// The surface's.
pub const SURFACE: [i32; 3] = [16_000, 36_000, 50_000];
/// Of the highlight, in units of 2^-16.
pub const SHININESS: u32 = 20 << 16;

/// Positions and normals as fragments carry them, in units of 2^-22: what is a texel to `PerspectiveSpans` is 1/64 of the radius.
pub(super) const SCALE: i32 = 22;

/// Position in eye space and normal.
#[inline(always)]
pub(super) fn carried(point: &Point, camera: &Camera) -> [i32; 6] {
    let scaled = |v: [i16; 3]| v.map(|c| (c as i32) << (SCALE - 15));
    let ([x, y, z], [nx, ny, nz]) = (scaled(point.position), scaled(point.normal));
    [x, y, z - (camera.away << SCALE), nx, ny, nz]
}

/// The colour there.
#[inline(always)]
pub(super) fn shade<P: Precision>(lights: &Lit<'_, 0, P>, [x, y, z, nx, ny, nz]: [i32; 6]) -> Levels {
    let full = lights.shade([nx, ny, nz], [x, y, z], SURFACE, &Shiny(SHININESS));
    let mut levels = [0; 3];
    for ((level, full), most) in levels.iter_mut().zip(full).zip(MOST) {
        *level = full.clamp(0, 1 << 16) * most + 0x8000;
    }
    levels
}

struct PerPixel<'a, Q: Quality, P> {
    lights: Lit<'a, 0, Q::Precision>,
    kind: PhantomData<P>,
}

impl<Q: Quality, P: Output> Fragment for PerPixel<'_, Q, P> {
    type Varying = Q::Perspective<6>;
    type Pixel = P;

    #[inline(always)]
    fn shade(&self, values: [i32; 6], _below: P) -> Option<P> {
        Some(P::of(shade(&self.lights, values)))
    }
}

pub(super) fn lights<P: Precision>() -> Result<Lights<i32, 1, 0, P>, Error> {
    let mut lights = Lights::default();
    lights.add(Light::sun(SUN, SUNLIGHT)?)?;
    Ok(lights)
}

/// Light at every pixel.
pub fn per_pixel<Q: Quality, P: Output>(canvas: &mut Canvas<P>, models: &Models) -> Result<(), Error> {
    let (mut color, mut depth) = canvas.buffers()?;
    let (eye, lights) = (SPHERE.view()?, lights::<Q::Precision>()?);
    let fragment = PerPixel::<Q, P> {
        lights: lights.at_scale(-SCALE),
        kind: PhantomData,
    };
    let mesh = &models.sphere;
    let vertices = vertices(&eye, mesh, |point| carried(point, &SPHERE));
    indexed(
        &eye,
        &mut color,
        &mut depth,
        &vertices,
        mesh.triangles.iter().copied(),
        &fragment,
    );
    Ok(())
}
