//! Draws the playground of the rasterization course: walls, boxes and a frosted glass under three lights.
//!
//! ```text
//! cargo run --release --example playground -- OUT.png [--course] [--float]
//! ```
//!
//! `--course` puts random textures where the course has them, instead of the fixed ones; `--float` draws with the float64
//! reference. Floats are here only where the scene's numbers are read.

use std::process::ExitCode;

use fixel::blend::{Blend, ONE, Rgba};
use fixel::depth::{FAR, Switched};
use fixel::error::Error;
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Angle, Block, Scaled, SineTable, Word, dot, power, unit};
use fixel::pipeline::{self, Culling, Filtering, HeadRoom, Pixel, Program, Sampler, State, Surface, from_the_top};
use fixel::target::Buffer;
use fixel::viewport::Viewport;
use fixel_host::picture::Picture;
use fixel_host::playground::scene::{self, Object, Texture};
use fixel_host::playground::{command, shapes::Corner, texture::Textures};

const WIDTH: u16 = scene::WIDTH as u16;
const HEIGHT: u16 = scene::HEIGHT as u16;

/// Fraction bits of positions and normals in view space: room for ±16.
const SPACE_BITS: u32 = 26;
/// Fraction bits of texture coordinates.
const UV_BITS: u32 = 30;
/// What highlights are multiplied by, in units of 2^-30.
const SPECULAR: i32 = (scene::SPECULAR * (1 << 30) as f64) as i32;

fn main() -> ExitCode {
    // A desktop has words of 64 bits; with 32, one pixel of this picture is another by a level.
    command::main(|textures| Ok(draw::<i64>(textures)?.picture()))
}

/// Point lights on an object with or without a texture.
pub struct Lit<'a, T> {
    model_view: Matrix<T>,
    normals: Directions<T>,
    projection: Matrix<T>,
    lights: &'a [Light],
    color: Rgba,
    texture: Option<Sampler<pipeline::Picture<'a, HeadRoom>, Filtering>>,
}

/// A point light without falloff.
pub struct Light {
    /// In view space.
    position: [i32; 3],
    /// In units of 2^-30.
    color: [i32; 3],
}

impl<T: Word> Program<T> for Lit<'_, T> {
    type Vertex = Corner;
    /// u, v; position; normal, not of length 1.
    type Varying = [i32; 8];
    type At = Pixel;
    type Output = Rgba;
    const KEEPS_ALL: bool = true;

    fn vertex(&self, corner: &Corner) -> (Block<T, 4>, [i32; 8]) {
        let position = self.model_view.transform(point(corner));
        let normal = self.normals.turn(Block::from_integers(corner.normal.map(i32::from)));
        let ([x, y, z, _], [a, b, c]) = (fixed(position), fixed(normal));
        let [u, v] = corner.uv.map(|c| i32::from(c) << UV_BITS);
        (self.projection.transform(position), [u, v, x, y, z, a, b, c])
    }

    fn fragment(&self, _: Pixel, [u, v, x, y, z, a, b, c]: [i32; 8]) -> Option<Rgba> {
        let texel = self.texture.as_ref().map(|texture| texture.sample([u, v]));
        let surface = texel.map_or(self.color, |texel| product(self.color, texel));
        let (normal, to_eye) = (direction([a, b, c]), direction([-x, -y, -z]));
        let mut color = [0; 3];
        for light in self.lights {
            let to_light = direction([0, 1, 2].map(|i| light.position[i] - [x, y, z][i]));
            let diffuse = cosine(to_light, normal);
            if diffuse <= 0 {
                continue;
            }
            // 2 (L·n) n − L.
            let mirrored = [0, 1, 2].map(|i| 2 * part(normal[i], diffuse) - to_light[i]);
            let highlight = power(cosine(mirrored, to_eye), scene::SHININESS << 16);
            let shine = part(highlight, SPECULAR) >> 2;
            for (i, sum) in color.iter_mut().enumerate() {
                *sum += part(part(surface.color[i], diffuse) + shine, light.color[i]);
            }
        }
        Some(Rgba { color, ..surface })
    }
}

/// A unit vector in units of 2^-30; no vector of this scene has length 0.
fn direction(vector: [i32; 3]) -> [i32; 3] {
    unit(vector).unwrap_or_default()
}

/// The cosine between two directions, in units of 2^-30.
fn cosine(a: [i32; 3], b: [i32; 3]) -> i32 {
    (dot(a, b) >> 30) as i32
}

/// `whole` times a part in units of 2^-30.
fn part(whole: i32, part: i32) -> i32 {
    ((i64::from(whole) * i64::from(part) + (1 << 29)) >> 30) as i32
}

/// Two colours multiplied, alpha too.
fn product(a: Rgba, b: Rgba) -> Rgba {
    let color = [0, 1, 2].map(|i| part(a.color[i], b.color[i] << 2));
    let alpha = part(a.alpha, b.alpha << 2);
    Rgba { color, alpha }
}

fn point<T: Word>(corner: &Corner) -> Block<T, 4> {
    let [x, y, z] = corner.position.map(i32::from);
    Block::from_integers([x, y, z, 1])
}

/// In units of 2^-[`SPACE_BITS`].
fn fixed<T: Word, const N: usize>(numbers: Block<T, N>) -> [i32; N] {
    numbers.split().map(|number| number.to_fixed(SPACE_BITS) as i32)
}

/// Numbers of the scene: they are whole hundredths.
fn numbers<T: Word, const N: usize>(values: [f64; N]) -> Block<T, N> {
    let hundredths = Block::from_integers(values.map(|v| (100.0 * v).round() as i32));
    hundredths.over(Scaled::from_integer(100)).expect("100 is not 0")
}

fn rgba(color: [f64; 4]) -> Rgba {
    let [red, green, blue, alpha] = color.map(|v| (v * f64::from(ONE)).round() as i32);
    let color = [red, green, blue];
    Rgba { color, alpha }
}

/// A texture of the scene, row 0 at v = 0.
struct Texels {
    size: u16,
    colors: Vec<Rgba>,
    filter: Filtering,
}

impl Texels {
    fn new(texture: Texture, textures: &Textures) -> Self {
        let texels = textures.texels(texture);
        let filter = match texture {
            Texture::Board | Texture::Random => Filtering::Nearest,
            Texture::Frost => Filtering::Linear,
        };
        Texels {
            size: texels.size as u16,
            colors: texels.colors.into_iter().map(rgba).collect(),
            filter,
        }
    }

    fn sampler(&self) -> Result<Sampler<pipeline::Picture<'_, HeadRoom>, Filtering>, Error> {
        let image = pipeline::Picture::new(HeadRoom, &self.colors, self.size, self.size)?;
        Ok(Sampler::new(image, UV_BITS).filtered(self.filter))
    }
}

/// What has been drawn, the bottom row first.
pub struct Frame {
    /// With head-room.
    pub colors: Vec<Rgba>,
    /// 0 to 65535.
    pub depths: Vec<u16>,
}

impl Frame {
    /// Turned over, in eight bits.
    pub fn picture(&self) -> Picture {
        let rows = from_the_top(&self.colors, WIDTH.into());
        let opaque = |[red, green, blue]: [u8; 3]| [red, green, blue, 255];
        let pixels = rows.flatten().map(|color| opaque(color.to_bytes())).collect();
        Picture::new(WIDTH.into(), HEIGHT.into(), pixels)
    }
}

/// An object's place in view space.
fn model_view<T: Word>(view: &Matrix<T>, object: &Object) -> Result<Matrix<T>, Error> {
    let (degrees, axis) = object.turn;
    let turn = Matrix::rotation::<SineTable>(Angle::from_degrees(degrees as i32), numbers(axis))?;
    Ok(view.product(&Matrix::model(numbers(object.position), &turn, numbers(object.scale))))
}

/// Draws the scene, the transparent objects last and from back to front; `T` is the word of geometry.
pub fn draw<T: Word>(textures: &Textures) -> Result<Frame, Error> {
    let view = Matrix::<T>::look_at(numbers(scene::EYE), numbers(scene::CENTER), numbers(scene::UP))?;
    let aspect = numbers::<T, 1>([WIDTH.into()]).over(numbers([HEIGHT.into()]));
    let field_of_view = Angle::from_degrees(scene::FIELD_OF_VIEW as i32);
    let [near, far] = [scene::NEAR, scene::FAR].map(|distance| numbers([distance]));
    let projection = Matrix::perspective::<SineTable>(field_of_view, aspect.ok_or(Error::FlatView)?, near, far)?;
    let lights = scene::LIGHTS.map(|scene::Light([x, y, z], color)| {
        let [x, y, z, _] = fixed(view.transform(numbers([x, y, z, 1.0])));
        let color = color.map(|c| (c * f64::from(1 << 30)).round() as i32);
        let position = [x, y, z];
        Light { position, color }
    });

    let mut frame = Frame {
        colors: vec![rgba(scene::CLEAR); usize::from(WIDTH) * usize::from(HEIGHT)],
        depths: vec![FAR; usize::from(WIDTH) * usize::from(HEIGHT)],
    };
    let mut state = State::new(Viewport::<T>::new(0, 0, WIDTH, HEIGHT)?.samples_at_centers());
    state.culling = Culling::Back;
    let mut surface = Surface::new(Buffer::new(&mut frame.colors, WIDTH, HEIGHT)?, HeadRoom).blended(None);
    let mut depth = Switched::new(Buffer::new(&mut frame.depths, WIDTH, HEIGHT)?);
    for (object, model_view) in in_order(&view)? {
        (depth.options.stores, surface.blending) =
            (!object.transparent, object.transparent.then_some(Blend::TRANSLUCENT));
        let mut normals = Directions::identity();
        normals.load(&model_view);
        let texels = object.texture.map(|texture| Texels::new(texture, textures));
        let program = Lit {
            model_view,
            normals,
            projection,
            lights: &lights,
            color: rgba(object.color),
            texture: texels.as_ref().map(Texels::sampler).transpose()?,
        };
        pipeline::triangles(&state, &mut surface, &mut depth, &program, object.shape);
    }
    Ok(frame)
}

/// Opaque objects as they are listed, then transparent ones with the most distant centre first.
fn in_order<T: Word>(view: &Matrix<T>) -> Result<Vec<(Object, Matrix<T>)>, Error> {
    let placed = scene::OBJECTS.map(|object| Ok((object, model_view(view, &object)?)));
    let mut objects = placed.into_iter().collect::<Result<Vec<_>, Error>>()?;
    objects.sort_by_key(|(object, model_view)| {
        let z = |corner| i64::from(fixed(model_view.transform(point(corner)))[2]);
        let center = object.shape.iter().map(z).sum::<i64>() / object.shape.len() as i64;
        (object.transparent, if object.transparent { center } else { 0 })
    });
    Ok(objects)
}
