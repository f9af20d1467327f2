//! A torus in three tones with a dark outline: `cargo run --release --example toon [-- OUT.png]`.
//!
//! `docs/toon-shader.md` explains it step by step.

use fixel::blend::{ONE, Rgba};
use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::matrix::Matrix;
use fixel::num::{Angle, Block, Scaled, SineTable, Trigonometry, dot, unit};
use fixel::pipeline::{self, Culling, Pixel, Program, State};
use fixel::supersample::Level;
use fixel::target::Buffer;
use fixel::viewport::Viewport;
use fixel_host::{files, picture::Picture, png};

type Failure = Box<dyn std::error::Error>;

/// Position and normal in the world, both in units of 2^-28.
struct Vertex {
    position: [i32; 3],
    normal: [i32; 3],
}

/// The torus: `STEPS` rings around the y axis of `STEPS` points each.
const STEPS: u64 = 96;

fn vertex(ring: u64, point: u64) -> Vertex {
    let angle = |step: u64| Angle::from_turns((step as u128 * (1 << 64) / STEPS as u128) as u64);
    // In units of 2^-30.
    let (ring_sin, ring_cos) = SineTable::sin_cos::<i32>(angle(ring));
    let (sin, cos) = SineTable::sin_cos::<i32>(angle(point));
    let times = |a: i32, b: i32| ((a as i64 * b as i64) >> 32) as i32;
    let normal = [times(cos, ring_cos), sin >> 2, times(cos, ring_sin)];
    let middle = [ring_cos >> 2, 0, ring_sin >> 2];
    // The tube's radius is 0.4.
    let position = [0, 1, 2].map(|i| middle[i] + normal[i] / 5 * 2);
    Vertex { position, normal }
}

fn torus() -> impl Iterator<Item = Vertex> {
    let quads = (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j)));
    quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)];
        [a, b, c, a, c, d].map(|(ring, point)| vertex(ring, point))
    })
}

/// Flat tones instead of a gradient.
struct Toon {
    world_to_clip: Matrix<i32>,
    /// Towards the light, a unit vector in units of 2^-30.
    light: [i32; 3],
}

impl Program for Toon {
    type Vertex = Vertex;
    type Varying = [i32; 3];
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, vertex: &Vertex) -> (Block<i32, 4>, [i32; 3]) {
        let [x, y, z] = vertex.position;
        (
            self.world_to_clip.transform(Block::new([x, y, z, 1 << 28], -28)),
            vertex.normal,
        )
    }

    fn fragment(&self, _: Pixel, normal: [i32; 3]) -> Option<Rgba> {
        // The cosine of the angle between the two, in units of 2^-60.
        let cosine = dot(unit(normal)?, self.light);
        Some(if cosine > 7 << 57 {
            rgb(255, 214, 122)
        } else if cosine > 1 << 58 {
            rgb(240, 138, 75)
        } else {
            rgb(168, 62, 84)
        })
    }
}

/// The same mesh a little thicker.
struct Outline {
    world_to_clip: Matrix<i32>,
}

impl Program for Outline {
    type Vertex = Vertex;
    type Varying = ();
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, &Vertex { position, normal }: &Vertex) -> (Block<i32, 4>, ()) {
        let [x, y, z] = [0, 1, 2].map(|i| position[i] + normal[i] / 32);
        (self.world_to_clip.transform(Block::new([x, y, z, 1 << 28], -28)), ())
    }

    fn fragment(&self, _: Pixel, (): ()) -> Option<Rgba> {
        Some(rgb(40, 26, 52))
    }
}

/// An opaque colour from 0…255.
fn rgb(red: i32, green: i32, blue: i32) -> Rgba {
    let color = [red, green, blue].map(|level| level * (ONE / 255));
    Rgba { color, alpha: ONE }
}

const WIDTH: usize = 320;
const HEIGHT: usize = 240;
/// Samples of a pixel in each direction.
const SIDE: usize = 4;

/// The picture from the top.
pub fn draw() -> Result<Picture, Failure> {
    let (width, height) = (SIDE * WIDTH, SIDE * HEIGHT);
    let mut colors = vec![rgb(250, 244, 230); width * height];
    let mut depths = vec![FAR; width * height];
    let (wide, high) = (width as u16, height as u16);

    let (eye, up) = (Block::from_integers([0, 3, 3]), Block::from_integers([0, 1, 0]));
    let view = Matrix::look_at(eye, Block::ZERO, up)?;
    let aspect = Scaled::from_integer(4)
        .over(Scaled::from_integer(3))
        .ok_or("no aspect")?;
    let [near, far] = [1, 9].map(Scaled::from_integer);
    let projection = Matrix::perspective::<SineTable>(Angle::from_degrees(54), aspect, near, far)?;
    let world_to_clip = projection.product(&view);

    let viewport = Viewport::<i32>::new(0, 0, wide, high)?.y_up().samples_at_centers();
    let mut state = State::new(viewport);
    let mut color = Buffer::new(&mut colors, wide, high)?;
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Buffer::new(&mut depths, wide, high)?);

    state.culling = Culling::Back;
    let light = unit([-3, 5, 2]).ok_or("no direction")?;
    pipeline::triangles(&state, &mut color, &mut depth, &Toon { world_to_clip, light }, torus());
    state.culling = Culling::Front;
    pipeline::triangles(&state, &mut color, &mut depth, &Outline { world_to_clip }, torus());

    let mut pixels = Vec::new();
    for row in colors.chunks(SIDE * width) {
        Level::new(SIDE as u32)?.resolve(row, width, |_, pixel| {
            let [red, green, blue] = pixel.to_bytes();
            pixels.push([red, green, blue, 255]);
        });
    }
    Ok(Picture::new(WIDTH as u32, HEIGHT as u32, pixels))
}

fn main() -> Result<(), Failure> {
    let out = std::env::args_os().nth(1).unwrap_or("toon.png".into());
    Ok(files::stage(out.as_ref(), png::encode(&draw()?)?)?.commit()?)
}
