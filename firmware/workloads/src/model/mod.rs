//! A lit model drawn from constants: what a frame of it costs.
//!
//! ```text
//! words -> Object (matrices, lights, mesh) -> draw (vertices, polygons, pixels) -> program (counted, reported)
//! ```
//!
//! A model is a list of 16-bit words, so that points and indices are read where they lie:
//!
//! ```text
//! model    = width · height · { object }
//! object   = projection: matrix · placement: matrix · ambient, diffuse, specular: color · shininess: number
//!            · eye: vector · lights: word · { position: vector · color: vector }
//!            · vertices: word · { point: 3 words } · { normal: 3 words } · indices: number · { index: word }
//! matrix   = 16 numbers, row by row · exponent: number
//! vector   = 3 numbers · exponent: number
//! color    = 3 numbers (2^-28 of full)
//! number   = 2 words, the lower first
//! ```
//!
//! Points and normals are in units of 2^-15. The placement takes points to a space whose origin lies amid the object;
//! positions of eye and lights are of that space, and the projection takes it to clip space.

pub mod canvas;
pub mod draw;
pub mod program;
mod words;

use fixel::light::world::{Glossy, Material, PointLight, PointLights};
use fixel::matrix::{Directions, Matrix};
use fixel::mesh::Mesh;
use words::Words;

/// Lights that a model may have.
pub const LIGHTS: usize = 16;

/// A model as it is stored.
pub struct Model<'a> {
    /// Columns of the picture.
    pub width: u16,
    /// Rows of the picture.
    pub height: u16,
    objects: Words<'a>,
}

impl<'a> Model<'a> {
    /// The model that `words` hold; `None` where they end too early.
    pub fn new(words: &'a [u16]) -> Option<Self> {
        let mut words = Words::new(words);
        Some(Model {
            width: words.word()?,
            height: words.word()?,
            objects: words,
        })
    }

    /// One object after the other; `None` for one that is not as it should be, and then no more.
    pub fn objects(&self) -> impl Iterator<Item = Option<Object<'a>>> + use<'a> {
        let mut left = Some(self.objects.clone());
        core::iter::from_fn(move || {
            let words = left.as_mut().filter(|words| !words.is_empty())?;
            let object = Object::read(words);
            if object.is_none() {
                left = None;
            }
            Some(object)
        })
    }
}

/// One object, ready to be drawn.
pub struct Object<'a> {
    projection: Matrix<i32>,
    placement: Matrix<i32>,
    directions: Directions<i32>,
    material: Material<Glossy>,
    lights: PointLights<i32, LIGHTS>,
    points: &'a [[u16; 3]],
    normals: &'a [[u16; 3]],
    mesh: Mesh<'a, u16, 1>,
}

impl<'a> Object<'a> {
    fn read(words: &mut Words<'a>) -> Option<Self> {
        let projection = Matrix::from_rows(words.block()?);
        let placement = Matrix::from_rows(words.block()?);
        let mut directions = Directions::identity();
        directions.load(&placement);
        let material = Material {
            ambient: words.numbers()?,
            diffuse: words.numbers()?,
            specular: Glossy {
                color: words.numbers()?,
                shininess: words.number()? as u32,
            },
        };
        let mut lights = PointLights::new(words.block()?);
        for _ in 0..words.word()? {
            let (position, color) = (words.block()?, words.block()?);
            lights.add(PointLight { position, color }).ok()?;
        }
        let vertices = words.word()? as usize;
        let (points, normals) = (words.triples(vertices)?, words.triples(vertices)?);
        let indices = words.number()? as usize;
        Some(Object {
            projection,
            placement,
            directions,
            material,
            lights,
            points,
            normals,
            mesh: Mesh::new([words.take(indices)?], [vertices]).ok()?,
        })
    }
}
