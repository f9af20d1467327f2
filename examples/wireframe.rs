//! The edges of a cube on a display of 128×64 black and white pixels, printed in the terminal, eight pixels a character:
//! `cargo run --release --example wireframe`.

use fixel::depth::NoDepth;
use fixel::error::Error;
use fixel::matrix::Matrix;
use fixel::num::{Angle, Block, Scaled, SineTable};
use fixel::pipeline::{self, Pixel, Program, State};
use fixel::target::Buffer;
use fixel::viewport::Viewport;

/// Columns of the display.
pub const WIDTH: usize = 128;
/// Rows of the display.
pub const HEIGHT: usize = 64;

/// One colour for everything; the uniform takes the world to clip space.
struct Wire(Matrix<i32>);

impl Program for Wire {
    type Vertex = [i32; 3];
    type Varying = ();
    type At = Pixel;
    type Output = bool;

    fn vertex(&self, &[x, y, z]: &[i32; 3]) -> (Block<i32, 4>, ()) {
        (self.0.transform(Block::from_integers([x, y, z, 1])), ())
    }
    fn fragment(&self, _: Pixel, (): ()) -> Option<bool> {
        Some(true)
    }
}

/// The twelve edges of the cube ±1, two vertices each: one along every axis at each of four places.
fn edges() -> Vec<[i32; 3]> {
    let at = |(a, b)| [[-1, a, b], [1, a, b], [a, -1, b], [a, 1, b], [a, b, -1], [a, b, 1]];
    [(-1, -1), (-1, 1), (1, -1), (1, 1)].map(at).concat()
}

/// The picture from the top, row after row.
pub fn draw() -> Result<Vec<bool>, Error> {
    let eye = Block::from_integers([3, 2, 4]);
    let view = Matrix::look_at(eye, Block::ZERO, Block::from_integers([0, 1, 0]))?;
    let [aspect, near, far] = [2, 1, 9].map(Scaled::from_integer);
    let projection = Matrix::perspective::<SineTable>(Angle::from_degrees(70), aspect, near, far)?;

    let mut picture = vec![false; WIDTH * HEIGHT];
    let viewport = Viewport::<i32>::new(0, 0, WIDTH as u16, HEIGHT as u16)?;
    let state = State::new(viewport.y_up().samples_at_centers());
    let mut display = Buffer::new(&mut picture, WIDTH as u16, HEIGHT as u16)?;
    pipeline::lines(
        &state,
        &mut display,
        &mut NoDepth,
        &Wire(projection.product(&view)),
        edges(),
    );
    Ok(picture)
}

/// Two columns of four dots are a Braille character; these are the bits of its dots, row by row.
const DOTS: [[u32; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];

fn character(picture: &[bool], column: usize, row: usize) -> char {
    let dots = (0..8).map(|i| (i / 2, i % 2));
    let lit = dots.filter(|(y, x)| picture[(4 * row + y) * WIDTH + 2 * column + x]);
    char::from_u32(lit.fold(0x2800, |bits, (y, x)| bits | DOTS[y][x])).unwrap_or(' ')
}

fn main() -> Result<(), Error> {
    let picture = draw()?;
    for row in 0..HEIGHT / 4 {
        println!(
            "{}",
            (0..WIDTH / 2)
                .map(|column| character(&picture, column, row))
                .collect::<String>()
        );
    }
    Ok(())
}
