//! A lit sphere on a display of 128×64 black and white pixels, dithered; the file shows each of them four times as large.
//! `cargo run --release --example dithered [-- OUT.png]`

use fixel::matrix::Matrix;
use fixel::num::{Angle, Block, Scaled, SineTable, Trigonometry, dot, unit};
use fixel::pipeline::{self, Culling, Pixel, Program, State};
use fixel::{depth::NoDepth, target::Buffer, viewport::Viewport};
use fixel_host::{files, picture::Picture, png};

type Failure = Box<dyn std::error::Error>;

/// Columns of the display.
pub const WIDTH: u16 = 128;
/// Rows of the display.
pub const HEIGHT: u16 = 64;

/// Bayer's matrix: thresholds in 16ths, so that n of 16 pixels are white for a brightness of n/16.
const BAYER: [[i64; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// Diffuse light, then white or black. The unit sphere's points, in units of 2^-30, are its normals as well.
struct Dithered {
    to_clip: Matrix<i32>,
    /// Towards the light, a unit vector in units of 2^-30.
    light: [i32; 3],
}

impl Program for Dithered {
    type Vertex = [i32; 3];
    type Varying = [i32; 3];
    type At = Pixel;
    type Output = bool;

    fn vertex(&self, &[x, y, z]: &[i32; 3]) -> (Block<i32, 4>, [i32; 3]) {
        (self.to_clip.transform(Block::new([x, y, z, 1 << 30], -30)), [x, y, z])
    }
    fn fragment(&self, at: Pixel, normal: [i32; 3]) -> Option<bool> {
        // In units of 2^-60; thresholds in the middle of their 16th.
        let brightness = dot(unit(normal)?, self.light);
        let threshold = BAYER[at.y as usize % 4][at.x as usize % 4];
        Some(brightness > (2 * threshold + 1) << 55)
    }
}

/// A point of the sphere: `step` of 32 from the south pole to the north, and of 32 around.
fn point(to_north: i32, around: i32) -> [i32; 3] {
    let (height, radius) = SineTable::sin_cos::<i32>(Angle::from_degrees(to_north * 180 / 32 - 90));
    let (sin, cos) = SineTable::sin_cos::<i32>(Angle::from_degrees(around * 360 / 32));
    let times = |a: i32, b: i32| ((a as i64 * b as i64) >> 30) as i32;
    [times(radius, sin), height, times(radius, cos)]
}

fn sphere() -> impl Iterator<Item = [i32; 3]> {
    let fields = (0..32).flat_map(|i| (0..32).map(move |j| (i, j)));
    fields.flat_map(|(i, j)| {
        let [a, b, c, d] = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)];
        [a, b, c, a, c, d].map(|(i, j)| point(i, j))
    })
}

/// The display from the top, row after row.
pub fn draw() -> Result<Vec<bool>, Failure> {
    let view = Matrix::look_at(
        Block::from_integers([0, 1, 5]),
        Block::ZERO,
        Block::from_integers([0, 1, 0]),
    )?;
    let [aspect, near, far] = [2, 1, 9].map(Scaled::from_integer);
    let projection = Matrix::perspective::<SineTable>(Angle::from_degrees(45), aspect, near, far)?;
    let light = unit([3, 3, 2]).ok_or("no direction")?;
    let program = Dithered {
        to_clip: projection.product(&view),
        light,
    };

    let mut pixels = vec![false; WIDTH as usize * HEIGHT as usize];
    let mut state = State::new(Viewport::<i32>::new(0, 0, WIDTH, HEIGHT)?.y_up().samples_at_centers());
    // A convex body needs no depth buffer: its front hides its back.
    state.culling = Culling::Back;
    pipeline::triangles(
        &state,
        &mut Buffer::new(&mut pixels, WIDTH, HEIGHT)?,
        &mut NoDepth,
        &program,
        sphere(),
    );
    Ok(pixels)
}

fn main() -> Result<(), Failure> {
    let out = std::env::args_os().nth(1).unwrap_or("dithered.png".into());
    let display = draw()?;
    let (width, height) = (4 * WIDTH as usize, 4 * HEIGHT as usize);
    let lit = |i: usize| display[i / width / 4 * WIDTH as usize + i % width / 4];
    let pixels = (0..width * height)
        .map(|i| if lit(i) { [255; 4] } else { [0, 0, 0, 255] })
        .collect();
    let picture = Picture::new(width as u32, height as u32, pixels);
    Ok(files::stage(out.as_ref(), png::encode(&picture)?)?.commit()?)
}
