//! Light, per pixel and per vertex.

use core::hint::black_box;

use fixel::depth::Less;
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::light::world::{FULL, Glossy, Material, PointLight, PointLights, PointLit};
use fixel::light::{Finish, Light, Lights, Lit, Matte, Shiny};
use fixel::num::{Block, Precision, unit};
use fixel::quality::Quality;
use fixel::view::{Vertex, View};

use super::camera::view;
use super::part::Part;

/// Position in eye space and normal.
type Point = ([i32; 3], [i32; 3]);

/// A bent strip before the eye, and a floor.
const SHAPES: [[Point; 3]; 4] = [
    [
        ([-4, -3, -7], [-2, 0, 1]),
        ([0, -3, -5], [0, 0, 1]),
        ([-4, 3, -7], [-2, 1, 1]),
    ],
    [
        ([0, -3, -5], [0, 0, 1]),
        ([1, 4, -5], [0, 1, 2]),
        ([-4, 3, -7], [-2, 1, 1]),
    ],
    [
        ([0, -3, -5], [0, 0, 1]),
        ([4, -2, -8], [3, 0, 1]),
        ([1, 4, -5], [0, 1, 2]),
    ],
    [
        ([-6, -2, -3], [0, 1, 0]),
        ([6, -2, -3], [0, 1, 0]),
        ([0, -2, -25], [0, 1, 0]),
    ],
];

/// Positions as fragments carry them: units of 2^-16.
const SCALE: i32 = 16;

fn corners(shape: [Point; 3]) -> [Vertex<i32, [i32; 6]>; 3] {
    shape.map(|([x, y, z], normal)| {
        let [nx, ny, nz] = unit(normal).unwrap_or_default();
        Vertex {
            position: Block::from_integers([x, y, z, 1]),
            carried: [x << SCALE, y << SCALE, z << SCALE, nx, ny, nz],
        }
    })
}

fn shapes() -> impl Iterator<Item = [Point; 3]> {
    black_box(SHAPES).into_iter()
}

/// Colour in units of 2^-`bits` of full, cut off at full.
fn rgb565(color: [i32; 3], bits: u32) -> u16 {
    let [red, green, blue] = color.map(|c| c.clamp(0, (1 << bits) - 1) as u32);
    ((red >> (bits - 5)) << 11 | (green >> (bits - 6)) << 5 | blue >> (bits - 5)) as u16
}

/// The rule of HW2.
struct PerPixel<'a, Q: Quality, F> {
    lights: Lit<'a, 1, Q::Precision>,
    finish: F,
}

impl<Q: Quality, F: Finish> Fragment for PerPixel<'_, Q, F> {
    type Varying = Q::Perspective<6>;
    type Pixel = u16;
    fn shade(&self, [x, y, z, nx, ny, nz]: [i32; 6], _below: u16) -> Option<u16> {
        let normal = Q::Precision::unit([nx, ny, nz]).unwrap_or_default();
        let surface = [52_000, 60_000, 30_000];
        Some(rgb565(self.lights.shade(normal, [x, y, z], surface, &self.finish), 16))
    }
}

fn per_pixel<Q: Quality, F: Finish>(part: &mut Part<'_>, finish: F) -> Result<(), Error> {
    let mut lights = Lights::<i32, 1, 1, Q::Precision>::default();
    lights.add(Light::sun([-3, 5, 4], [40_000, 30_000, 20_000])?)?;
    lights.add(Light::Bulb {
        position: Block::from_integers([2, 1, -1]),
        color: [20_000, 50_000, 90_000],
    })?;
    let fragment = PerPixel::<Q, F> {
        lights: lights.at_scale(-SCALE),
        finish,
    };
    drawn::<Q, 0>(part, &view::<Q, i32, i32, 0>(&[])?, &fragment)
}

fn drawn<Q: Quality, const N: usize>(
    part: &mut Part<'_>,
    view: &View<i32, i32, N>,
    fragment: &impl Fragment<Varying = Q::Perspective<6>, Pixel = u16>,
) -> Result<(), Error> {
    let (mut color, mut depth) = part.compared::<Less>()?;
    for shape in shapes() {
        draw::primitive(view, &mut color, &mut depth, &corners(shape), fragment);
    }
    Ok(())
}

pub fn lambert_per_pixel<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    per_pixel::<Q, _>(part, Matte)
}

pub fn blinn_phong_per_pixel<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    per_pixel::<Q, _>(part, Shiny(black_box(21 << 15)))
}

/// The rule of `.iv`.
struct World<Q: Quality> {
    lights: PointLit<2, Q::Precision>,
    material: Material<Glossy>,
}

impl<Q: Quality> Fragment for World<Q> {
    type Varying = Q::Perspective<6>;
    type Pixel = u16;
    fn shade(&self, [x, y, z, nx, ny, nz]: [i32; 6], _below: u16) -> Option<u16> {
        let normal = Q::Precision::unit([nx, ny, nz]).unwrap_or_default();
        Some(rgb565(self.lights.shade(normal, [x, y, z], &self.material), 28))
    }
}

const MATERIAL: Material<Glossy> = Material {
    ambient: [FULL / 9; 3],
    diffuse: [FULL / 2, FULL / 3, FULL / 5],
    specular: Glossy {
        color: [FULL / 2; 3],
        shininess: 9 << 16,
    },
};

fn point_lights<P: Precision>() -> Result<PointLights<i32, 2, P>, Error> {
    let mut lights = PointLights::new(Block::ZERO);
    for (position, color) in black_box([([5, 6, 1], [3, 3, 2]), ([-7, -1, -2], [1, 2, 4])]) {
        lights.add(PointLight {
            position: Block::from_integers(position),
            color: Block::new(color, -2),
        })?;
    }
    Ok(lights)
}

pub fn phong_in_world<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let fragment = World::<Q> {
        lights: point_lights()?.at_scale(-SCALE),
        material: MATERIAL,
    };
    drawn::<Q, 0>(part, &view::<Q, i32, i32, 0>(&[])?, &fragment)
}

pub fn gouraud_in_world<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let (view, lights) = (view::<Q, i32, i32, 0>(&[])?, point_lights::<Q::Precision>()?);
    let (mut color, mut depth) = part.compared::<Less>()?;
    for shape in shapes() {
        let corners = shape.map(|([x, y, z], normal)| {
            let normal = Q::Precision::unit(normal).unwrap_or_default();
            let [red, green, blue] = lights.shade(normal, Block::from_integers([x, y, z]), &MATERIAL);
            // From 2^-28 of full to 2^-16 of a level of the pixel.
            let levels = |c: i32, most: i32| (c.clamp(0, FULL) >> 12) * most;
            Vertex {
                position: Block::from_integers([x, y, z, 1]),
                carried: [levels(red, 31), levels(green, 63), levels(blue, 31)],
            }
        });
        draw::primitive(&view, &mut color, &mut depth, &corners, &Q::GOURAUD);
    }
    Ok(())
}
