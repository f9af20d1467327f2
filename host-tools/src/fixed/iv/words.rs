//! A scene as firmware holds it: 16-bit words, in the form of `fixel_workloads::model`.
//!
//! Each object's points are fractions of its half-size, from its middle. There lights, eye and projection have their
//! origin too, and the object's size is brought near 1, so that 32-bit words do for an object of any size anywhere.

use std::collections::HashMap;

use fixel::light::world::{Glossy, Material};
use fixel::matrix::Matrix;
use fixel::mesh::Index;
use fixel::num::Block;
use fixel_workloads::model::LIGHTS;

use super::lamps::{self, Surface};
use super::object::{ToWorld, middle};
use super::to_clip;
use crate::fixed::dials::Trigonometry;
use crate::lower;
use crate::scene::iv::{Corner, Object, Scene};

/// The scene's words.
///
/// # Errors
/// One line that says what does not fit.
pub fn words(scene: &Scene) -> Result<Vec<u16>, String> {
    let mut words = Vec::new();
    for side in [scene.width, scene.height] {
        words.push(u16::try_from(side).map_err(|e| e.to_string())?);
    }
    for object in &scene.model.objects {
        push_object(&mut words, scene, object)?;
    }
    Ok(words)
}

fn push_object(words: &mut Vec<u16>, scene: &Scene, object: &Object) -> Result<(), String> {
    let used = object.used();
    let middle = middle(&used);
    let size = half_size(&used, middle);
    let to_world = ToWorld::new(&object.transforms, Trigonometry::default())?;
    let origin = to_world.place(middle);
    let from_origin = Matrix::translation(origin.negated())
        .product(&to_world.points)
        .product(&Matrix::translation(lower::block(middle)))
        .product(&Matrix::scaling(lower::block([lower::whole(size); 3])));
    let unit = largest(&from_origin);
    let scaling = |power: i32| Matrix::scaling(Block::from_integers([1; 3]).scaled(power));
    let projection = to_clip(&scene.model.camera, Trigonometry::default())?.product(&Matrix::translation(origin));
    push_block(words, projection.product(&scaling(unit)).entries());
    push_block(words, scaling(-unit).product(&from_origin).entries());
    push_material(words, &Surface::of(&object.material)?);
    push_lights(words, scene, origin, unit)?;
    push_mesh(words, object, middle, size)
}

/// Half the length of the longest side of the box around the points; not 0.
fn half_size(points: &[[f64; 3]], middle: [f64; 3]) -> f64 {
    let away = (points.iter()).flat_map(|p| [0, 1, 2].map(|i| (p[i] - middle[i]).abs()));
    let size = away.fold(0.0, f64::max);
    if size > 0.0 { size } else { 1.0 }
}

/// The exponent of the power of two from which the entries that turn and scale are at most 1 away.
fn largest(matrix: &Matrix<i64>) -> i32 {
    let [a, b, c, _, d, e, f, _, g, h, i, ..] = matrix.entries().split();
    let turns = Block::gather([a, b, c, d, e, f, g, h, i]);
    turns.exponent().saturating_add(62)
}

fn push_material(words: &mut Vec<u16>, surface: &Surface) {
    let Material {
        ambient,
        diffuse,
        specular: Glossy { color, shininess },
    } = surface.described();
    let numbers = [ambient, diffuse, color].into_iter().flatten();
    numbers.for_each(|number| push_number(words, number));
    push_number(words, shininess as i32);
}

/// The eye and the lights, from `origin` in units of 2^`unit`.
fn push_lights(words: &mut Vec<u16>, scene: &Scene, origin: Block<i64, 3>, unit: i32) -> Result<(), String> {
    let (eye, lights) = lamps::seen_from(scene, origin);
    let count = u16::try_from(lights.len()).ok().filter(|&n| usize::from(n) <= LIGHTS);
    push_block(words, eye.scaled(-unit));
    words.push(count.ok_or_else(|| format!("more than {LIGHTS} lights"))?);
    for light in lights {
        push_block(words, light.position.scaled(-unit));
        push_mantissas(words, light.color.mantissas(), light.color.exponent());
    }
    Ok(())
}

/// A vertex for each pair of point and normal, in the order of their first use: what a cache of vertices likes best.
fn push_mesh(words: &mut Vec<u16>, object: &Object, middle: [f64; 3], size: f64) -> Result<(), String> {
    let (mut numbers, mut vertices, mut indices) = (HashMap::new(), Vec::new(), Vec::new());
    for face in &object.faces {
        for Corner { point, normal } in &face.corners {
            let next = vertices.len();
            let number = *numbers.entry((point, normal)).or_insert(next);
            if number == next {
                vertices.push((object.points[*point], object.normals[*normal]));
            }
            let index = u16::try_from(number).ok().filter(|&index| index != u16::END);
            indices.push(index.ok_or("more than 65535 vertices")?);
        }
        indices.push(u16::END);
    }
    words.push(vertices.len() as u16);
    for (point, _) in &vertices {
        words.extend([0, 1, 2].map(|i| lower::sixteen_bits((point[i] - middle[i]) / size) as u16));
    }
    for (_, normal) in &vertices {
        let unit = lower::block(*normal).unit().unwrap_or_default();
        words.extend(unit.map(|c| (((c >> 46) + 1) >> 1).min(32767) as u16));
    }
    push_number(words, i32::try_from(indices.len()).map_err(|e| e.to_string())?);
    words.extend(indices);
    Ok(())
}

/// Rounded to 32-bit words.
fn push_block<const N: usize>(words: &mut Vec<u16>, block: Block<i64, N>) {
    let narrow = Block::<i32, N>::from_wide(block.mantissas(), block.exponent());
    push_mantissas(words, narrow.mantissas(), narrow.exponent());
}

fn push_mantissas<const N: usize>(words: &mut Vec<u16>, mantissas: [i32; N], exponent: i32) {
    mantissas.into_iter().for_each(|m| push_number(words, m));
    push_number(words, exponent);
}

/// The lower word first.
fn push_number(words: &mut Vec<u16>, number: i32) {
    words.extend([number as u16, (number >> 16) as u16]);
}
