//! Draws a triangle into a picture, and that picture onto four walls.
//! `cargo run --release --example render_to_texture [-- OUT.png [DEGREES]]`: the walls turned, by 30 degrees if not told.

use fixel::blend::{ONE, Rgba};
use fixel::depth::{DepthBuffer, FAR, LessOrEqual, NoDepth};
use fixel::matrix::Matrix;
use fixel::num::{Angle, Block, Scaled, SineTable};
use fixel::pipeline::shapes::{Corner, PLANE_XY};
use fixel::pipeline::{self, HeadRoom, LinearFilter, Pixel, Program, Sampler, State};
use fixel::{target::Buffer, viewport::Viewport};
use fixel_host::{files, picture::Picture, png};

type Failure = Box<dyn std::error::Error>;

/// A vertex has a place and a colour.
struct Colorful;

impl Program for Colorful {
    type Vertex = ([i32; 2], [i32; 3]);
    type Varying = [i32; 3];
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, &([x, y], color): &Self::Vertex) -> (Block<i32, 4>, [i32; 3]) {
        (Block::from_integers([x, y, 0, 1]), color)
    }
    fn fragment(&self, _: Pixel, color: [i32; 3]) -> Option<Rgba> {
        Some(Rgba { color, alpha: ONE })
    }
}

/// Its texture is what the other program has drawn.
struct Textured<'a> {
    to_clip: Matrix<i32>,
    texture: Sampler<pipeline::Picture<'a, HeadRoom>, LinearFilter>,
}

impl Program for Textured<'_> {
    type Vertex = Corner;
    type Varying = [i32; 2];
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, corner: &Corner) -> (Block<i32, 4>, [i32; 2]) {
        let uv = corner.uv.map(|c| (c as i32) << 16);
        (self.to_clip.transform(corner.point()), uv)
    }
    fn fragment(&self, _: Pixel, uv: [i32; 2]) -> Option<Rgba> {
        Some(self.texture.sample(uv))
    }
}

const SIDE: u16 = 240;
const AREA: usize = SIDE as usize * SIDE as usize;

/// The four walls, turned by `degrees` about the y axis.
pub fn draw(degrees: i32) -> Result<Picture, Failure> {
    // As a texture: the first row is the lowest one, so the viewport does not turn y over.
    let (color, alpha) = ([ONE / 4 * 3; 3], ONE);
    let mut texture = [Rgba { color, alpha }; 64 * 64];
    let state = State::new(Viewport::<i32>::new(0, 0, 64, 64)?.samples_at_centers());
    let corners = [([-1, -1], [ONE, 0, 0]), ([1, -1], [0, ONE, 0]), ([0, 1], [0, 0, ONE])];
    let mut target = Buffer::new(&mut texture, 64, 64)?;
    pipeline::triangles(&state, &mut target, &mut NoDepth, &Colorful, corners);
    let picture = pipeline::Picture::new(HeadRoom, &texture, 64, 64)?;
    let texture = Sampler::new(picture, 16).filtered(LinearFilter);

    let up = Block::from_integers([0, 1, 0]);
    let view = Matrix::look_at(Block::from_integers([0, 2, 4]), Block::ZERO, up)?;
    let [aspect, near, far] = [1, 1, 9].map(Scaled::from_integer);
    let projection = Matrix::perspective::<SineTable>(Angle::from_degrees(50), aspect, near, far)?;
    let (mut colors, mut depths) = (vec![Rgba::default(); AREA], vec![FAR; AREA]);
    let state = State::new(Viewport::<i32>::new(0, 0, SIDE, SIDE)?.y_up().samples_at_centers());
    let mut color = Buffer::new(&mut colors, SIDE, SIDE)?;
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Buffer::new(&mut depths, SIDE, SIDE)?);
    for quarter in 0..4 {
        let turn = Matrix::rotation::<SineTable>(Angle::from_degrees(degrees + 90 * quarter), up)?;
        let model = turn.product(&Matrix::translation(Block::from_integers([0, 0, 1])));
        let to_clip = projection.product(&view.product(&model));
        let program = Textured { to_clip, texture };
        pipeline::triangles(&state, &mut color, &mut depth, &program, PLANE_XY);
    }
    let opaque = |[red, green, blue]: [u8; 3]| [red, green, blue, 255];
    let pixels = colors.iter().map(|color| opaque(color.to_bytes())).collect();
    Ok(Picture::new(SIDE.into(), SIDE.into(), pixels))
}

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let out = arguments.next().unwrap_or("render_to_texture.png".into());
    let degrees = arguments.next().map_or(Ok(30), |text| text.parse())?;
    Ok(files::stage(out.as_ref(), png::encode(&draw(degrees)?)?)?.commit()?)
}
