//! A wall behind three panes of coloured glass: opaque things first, then the transparent ones from back to front.
//! `cargo run --release --example transparent [-- OUT.png]`

use fixel::blend::{ONE, Rgba, Translucent};
use fixel::depth::{DepthBuffer, FAR, Keep, LessOrEqual};
use fixel::matrix::Matrix;
use fixel::num::{Angle, Block, Scaled, SineTable};
use fixel::pipeline::shapes::{Corner, PLANE_XY};
use fixel::pipeline::{self, HeadRoom, Pixel, Program, State, Surface};
use fixel::{target::Buffer, viewport::Viewport};
use fixel_host::{files, picture::Picture, png};

type Failure = Box<dyn std::error::Error>;

const WIDTH: u16 = 320;
const HEIGHT: u16 = 240;

/// A rectangle of one colour.
struct Pane {
    to_view: Matrix<i32>,
    to_clip: Matrix<i32>,
    color: Rgba,
}

impl Pane {
    /// The view-space z of its middle in units of 2^-16: the further away, the less.
    fn depth(&self) -> i64 {
        let [_, _, z, _] = self.to_view.transform(Block::from_integers([0, 0, 0, 1])).split();
        z.to_fixed(16)
    }
}

impl Program for Pane {
    type Vertex = Corner;
    type Varying = ();
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, corner: &Corner) -> (Block<i32, 4>, ()) {
        (self.to_clip.transform(corner.point()), ())
    }
    fn fragment(&self, _: Pixel, (): ()) -> Option<Rgba> {
        Some(self.color)
    }
}

/// Position, red, green and blue in eighths: a green pane in the middle, a red one in front and a blue one behind the wall.
const GLASS: [([i32; 3], [i32; 3]); 3] = [([0, 0, 1], [1, 6, 1]), ([-1, 0, 2], [8, 1, 1]), ([1, 1, -2], [1, 2, 8])];

/// The scene with its panes listed in the given order, which makes no difference.
pub fn draw(order: [usize; 3]) -> Result<Picture, Failure> {
    let point = Block::<i32, 3>::from_integers;
    let view = Matrix::look_at(point([2, 2, 9]), point([0, 0, 0]), point([0, 1, 0]))?;
    let aspect = Scaled::from_integer(4)
        .over(Scaled::from_integer(3))
        .ok_or("no aspect")?;
    let [near, far] = [1, 20].map(Scaled::from_integer);
    let projection = Matrix::perspective::<SineTable>(Angle::from_degrees(40), aspect, near, far)?;
    let pane = |(position, color): ([i32; 3], [i32; 3]), scale, alpha| {
        let to_view = view.product(&Matrix::model(point(position), &Matrix::identity(), point(scale)));
        let (to_clip, color) = (projection.product(&to_view), color.map(|eighths| eighths * (ONE / 8)));
        Pane {
            to_view,
            to_clip,
            color: Rgba { color, alpha },
        }
    };
    let mut panes = order.map(|i| pane(GLASS[i], [1, 1, 1], ONE / 2));
    let wall = pane(([0, -1, 0], [7, 7, 6]), [3, 1, 1], ONE);

    let mut colors = vec![Rgba::default(); WIDTH as usize * HEIGHT as usize];
    let mut depths = vec![FAR; colors.len()];
    let state = State::new(Viewport::<i32>::new(0, 0, WIDTH, HEIGHT)?.y_up().samples_at_centers());
    let mut color = Buffer::new(&mut colors, WIDTH, HEIGHT)?;
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Buffer::new(&mut depths, WIDTH, HEIGHT)?);
    pipeline::triangles(&state, &mut color, &mut depth, &wall, PLANE_XY);

    // From back to front, blended, and without storing depths.
    panes.sort_by_key(Pane::depth);
    let mut color = Surface::new(color, HeadRoom).blended(Translucent);
    let mut depth = DepthBuffer::<_, Keep<LessOrEqual>>::new(Buffer::new(&mut depths, WIDTH, HEIGHT)?);
    for pane in &panes {
        pipeline::triangles(&state, &mut color, &mut depth, pane, PLANE_XY);
    }
    let opaque = |[red, green, blue]: [u8; 3]| [red, green, blue, 255];
    let pixels = colors.iter().map(|color| opaque(color.to_bytes())).collect();
    Ok(Picture::new(WIDTH.into(), HEIGHT.into(), pixels))
}

fn main() -> Result<(), Failure> {
    let out = std::env::args_os().nth(1).unwrap_or("transparent.png".into());
    Ok(files::stage(out.as_ref(), png::encode(&draw([0, 1, 2])?)?)?.commit()?)
}
