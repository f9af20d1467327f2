//! One Separator: its mesh, brought into the world and shaded.

use std::marker::PhantomData;

use fixel::light::world::{Material, Specular};
use fixel::matrix::{Directions, Matrix};
use fixel::mesh::{Cache, Face, Index, Mesh};
use fixel::num::{Block, Scaled, Word};
use fixel::varying::{Linear, Linear32};

use super::Canvas;
use super::lamps::{self, AllLights, Surface};
use super::shade::{self, Flat, Gouraud, Gouraud565, Phong};
use crate::emit::drawing::{Lights, Program};
use crate::fixed::dials::{Colors, Lighting, Trigonometry};
use crate::fixed::shader::Canvas as _;
use crate::lower;
use crate::scene::iv::{Object, Scene, Shading, Transform};

/// Vertices that are kept.
const CACHE: usize = 64;

/// A corner in the world.
#[derive(Debug, Clone, Copy)]
struct Corner {
    /// x, y, z, 1.
    world: Block<i64, 4>,
    /// From the origin of the lights.
    place: Block<i64, 3>,
    /// Length 1 in units of 2^-30, or 0.
    normal: [i32; 3],
    /// What its program carries of it.
    color: [i32; 3],
}

/// Draws an object.
///
/// # Errors
/// One line that says what does not fit the core.
pub fn draw<W: Word>(canvas: &mut Canvas<W>, scene: &Scene, object: &Object) -> Result<(), String> {
    match Surface::of(&object.material)? {
        Surface::Matte(material) => shaded(canvas, scene, object, &material),
        Surface::Glossy(material) => shaded(canvas, scene, object, &material),
    }
}

fn shaded<W: Word, S: Specular>(
    canvas: &mut Canvas<W>,
    scene: &Scene,
    object: &Object,
    material: &Material<S>,
) -> Result<(), String> {
    let shading = match (scene.shading, canvas.dials.lighting) {
        (Shading::Phong, Lighting::Vertex) => Shading::Gouraud,
        (shading, _) => shading,
    };
    let (points, normals) = indices(object)?;
    let counts = [object.points.len(), object.normals.len()];
    let mesh = Mesh::<u32, 2>::new([&points, &normals], counts).map_err(|e| e.to_string())?;
    let to_world = ToWorld::new(&object.transforms, canvas.dials.trigonometry)?;
    let used = object.used();
    let origin = to_world.place(middle(&used));
    let lights = AllLights::new(scene, origin, canvas.dials.precision)?;
    let lit = |place, normal| lights.shade(normal, place, material);
    let corner = |[point, normal]: [usize; 2]| {
        let world = to_world.points.transform(homogeneous(object.points[point]));
        let corner = Corner {
            world,
            place: xyz(world).minus(origin),
            normal: to_world.normal(object.normals[normal]),
            color: [0; 3],
        };
        let color = if shading == Shading::Gouraud {
            shade::carried(lit(corner.place, corner.normal))
        } else {
            corner.color
        };
        Corner { color, ..corner }
    };
    let mut cache = Cache::<Corner, 2, CACHE>::default();
    match shading {
        Shading::Flat => mesh.faces().for_each(|face| {
            let color = flat(&face, &mut cache, corner, &lights, material);
            canvas.describe(|_| Program::Flat(shade::pixel(color, 0).rgba));
            each(canvas, &face, &mut cache, corner, |canvas, corners, primitive| {
                canvas.draw(corners.map(|c| c.world), [(); 3], &Flat::new(color, primitive));
            });
        }),
        Shading::Gouraud => {
            canvas.describe(|_| Program::Corners);
            mesh.faces().for_each(|face| {
                each(canvas, &face, &mut cache, corner, |canvas, corners, primitive| {
                    gouraud(canvas, corners, primitive);
                });
            });
        }
        Shading::Phong => {
            let exponent = to_world.unit(&used, origin);
            let lit = lights.at_scale(exponent);
            let (eye, all) = lamps::seen_from(scene, origin);
            let described = Surface::of(&object.material)?.described();
            canvas.describe(|log| Program::Phong {
                lights: log.lights(Lights::World(eye, all)),
                exponent,
                material: described,
                shines: S::SHINES,
            });
            mesh.faces().for_each(|face| {
                each(canvas, &face, &mut cache, corner, |canvas, corners, primitive| {
                    let carried = corners.map(|c| Phong::<S>::carried(c.place, exponent, c.normal));
                    let program = Phong {
                        lit: &lit,
                        material,
                        primitive,
                    };
                    canvas.draw_shaded(corners.map(|c| c.world), carried, &program);
                });
            });
        }
    }
    Ok(())
}

/// Draws a triangle in its corners' colours, interpolated as the dial says.
fn gouraud<W: Word>(canvas: &mut Canvas<W>, corners: [Corner; 3], primitive: u32) {
    let (world, colors) = (corners.map(|c| c.world), corners.map(|c| c.color));
    match (canvas.dials.colors, canvas.narrow()) {
        (Colors::Narrow, Some(canvas)) => {
            let varying = PhantomData::<Linear32<3>>;
            canvas.paint::<_, true>(world, colors, &Gouraud { primitive, varying });
        }
        (Colors::Packed, Some(canvas)) => {
            let colors = colors.map(Gouraud565::carried);
            canvas.paint::<_, true>(world, colors, &Gouraud565 { primitive });
        }
        _ => {
            let varying = PhantomData::<Linear<3>>;
            canvas.draw(world, colors, &Gouraud { primitive, varying });
        }
    }
}

/// Draws the triangles of a face, numbered.
fn each<W: Word>(
    canvas: &mut Canvas<W>,
    face: &Face<'_, u32, 2>,
    cache: &mut Cache<Corner, 2, CACHE>,
    corner: impl FnMut([usize; 2]) -> Corner,
    draw: impl Fn(&mut Canvas<W>, [Corner; 3], u32),
) {
    face.triangles(cache, corner, |corners| {
        canvas.primitives += 1;
        let primitive = canvas.primitives;
        draw(canvas, corners, primitive);
    });
}

/// The colour of a flat face: at its corners' mean place with their mean normal.
fn flat<S: Specular>(
    face: &Face<'_, u32, 2>,
    cache: &mut Cache<Corner, 2, CACHE>,
    mut corner: impl FnMut([usize; 2]) -> Corner,
    lights: &AllLights,
    material: &Material<S>,
) -> [i32; 3] {
    let mut count = 0;
    let (mut place, mut normal) = (Block::ZERO, [0i64; 3]);
    for indices in face.corners() {
        let corner = cache.get(indices, &mut corner);
        count += 1;
        place = place.plus(corner.place);
        for (sum, n) in normal.iter_mut().zip(corner.normal) {
            *sum += i64::from(n);
        }
    }
    let mean = place.over(Scaled::from_integer(count)).unwrap_or(Block::ZERO);
    // A direction: its length does not count, and what is lost is 2^-30 of it.
    let largest = normal.iter().fold(0, |most, n| most.max(n.unsigned_abs()));
    let down = (i64::BITS - largest.leading_zeros()).saturating_sub(30);
    lights.shade(normal.map(|n| (n >> down) as i32), mean, material)
}

/// The faces' points and normals as the core's meshes want them.
fn indices(object: &Object) -> Result<(Vec<u32>, Vec<u32>), String> {
    let narrow = |index: usize| u32::try_from(index).ok().filter(|&i| i != u32::END);
    let (mut points, mut normals) = (Vec::new(), Vec::new());
    for face in &object.faces {
        for corner in &face.corners {
            points.push(narrow(corner.point).ok_or("more than 2^32 - 1 points")?);
            normals.push(narrow(corner.normal).ok_or("more than 2^32 - 1 normals")?);
        }
        points.push(u32::END);
        normals.push(u32::END);
    }
    Ok((points, normals))
}

/// Object space to the world.
pub(super) struct ToWorld {
    pub(super) points: Matrix<i64>,
    normals: Directions<i64>,
}

impl ToWorld {
    pub(super) fn new(transforms: &[Transform], trigonometry: Trigonometry) -> Result<Self, String> {
        let mut all = Self {
            points: Matrix::identity(),
            normals: Directions::identity(),
        };
        for transform in transforms {
            let (moved, scale) = (
                lower::block(transform.translation),
                lower::block(transform.scale_factor),
            );
            all.points = all.points.product(&Matrix::translation(moved));
            // With angle 0 the axis may be 0.
            if transform.rotation.angle != 0.0 {
                let (angle, axis) = (
                    lower::radians(transform.rotation.angle)?,
                    lower::block(transform.rotation.axis),
                );
                let turn = trigonometry.rotation(angle, axis).map_err(|e| e.to_string())?;
                all.points = all.points.product(&turn);
                trigonometry
                    .rotate(&mut all.normals, angle, axis)
                    .map_err(|e| e.to_string())?;
            }
            all.points = all.points.product(&Matrix::scaling(scale));
            all.normals.scale(scale);
        }
        Ok(all)
    }

    fn normal(&self, normal: [f64; 3]) -> [i32; 3] {
        let unit = self.normals.turn(lower::block(normal)).unit().unwrap_or_default();
        unit.map(|c| ((c + (1 << 31)) >> 32) as i32)
    }

    pub(super) fn place(&self, point: [f64; 3]) -> Block<i64, 3> {
        xyz(self.points.transform(homogeneous(point)))
    }

    /// The unit of places from the origin in which those of the points fill 30 bits.
    fn unit(&self, points: &[[f64; 3]], origin: Block<i64, 3>) -> i32 {
        let places = points.iter().map(|&point| self.place(point).minus(origin));
        let exponents = places.filter(|place| !place.is_zero()).map(|place| place.exponent());
        exponents.max().unwrap_or(0).saturating_add(32)
    }
}

/// A point amid others, before the transforms.
pub(super) fn middle(points: &[[f64; 3]]) -> [f64; 3] {
    if points.is_empty() {
        return [0.0; 3];
    }
    [0, 1, 2].map(|i| {
        let of = points.iter().map(|p| p[i]);
        let least = of.clone().fold(f64::INFINITY, f64::min);
        let most = of.fold(f64::NEG_INFINITY, f64::max);
        least + (most / 2.0 - least / 2.0)
    })
}

fn homogeneous([x, y, z]: [f64; 3]) -> Block<i64, 4> {
    lower::block([x, y, z, 1.0])
}

/// Affine matrices leave w = 1.
fn xyz(world: Block<i64, 4>) -> Block<i64, 3> {
    let [x, y, z, _] = world.split();
    Block::gather([x, y, z])
}
