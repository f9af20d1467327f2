//! Through the pipeline door: own programs for vertices and fragments.

use core::hint::black_box;

use fixel::blend::{Blend, Equation, Factor, ONE, Rgba, Translucent};
use fixel::depth::{LessOrEqual, NoDepth};
use fixel::error::Error;
use fixel::matrix::Matrix;
use fixel::num::{Angle, Block};
use fixel::pipeline::shapes::{BOX, Corner, PLANE_XY};
use fixel::pipeline::{
    self, Culling, FragCoord, LinearFilter, MirroredRepeat, Pixel, Program, Repeat, Sampler, State, Surface,
};
use fixel::quality::Quality;
use fixel::texture::{Rgb565, Texture};
use fixel::viewport::Viewport;

use super::camera::projection;
use super::part::{HEIGHT, Part, WIDTH};
use super::raster::TEXTURE;

fn viewport() -> Result<Viewport<i32>, Error> {
    Ok(Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up().samples_at_centers())
}

/// Shapes of [`Corner`]s at `position`, turned by `degrees`.
fn placed<Q: Quality>(position: [i32; 3], degrees: i32, scale: i32) -> Result<Matrix<i32>, Error> {
    let axis = Block::from_integers([2, 3, 1]);
    let turned = Matrix::rotation::<Q::Trigonometry>(Angle::from_degrees(black_box(degrees)), axis)?;
    let model = Matrix::model(
        Block::from_integers(position),
        &turned,
        Block::from_integers([scale; 3]),
    );
    Ok(projection::<Q, i32>()?.product(&model))
}

/// Colours between the corners.
struct Smooth(Matrix<i32>);

impl Program for Smooth {
    type Vertex = Corner;
    type Varying = [i32; 3];
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, corner: &Corner) -> (Block<i32, 4>, [i32; 3]) {
        let color = corner.position.map(|v| (i32::from(v) + 1) * (ONE / 2));
        (self.0.transform(corner.point()), color)
    }
    fn fragment(&self, _: Pixel, color: [i32; 3]) -> Option<Rgba> {
        Some(Rgba { color, alpha: ONE })
    }
}

pub fn smooth<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let mut state = State::new(viewport()?);
    state.culling = Culling::Back;
    let (color, mut depth) = part.compared::<LessOrEqual>()?;
    let mut color = Surface::new(color, Rgb565);
    let program = Smooth(placed::<Q>([1, 0, -4], 33, 1)?);
    pipeline::triangles(&state, &mut color, &mut depth, &program, BOX);
    let program = Smooth(placed::<Q>([-1, 0, -5], 120, 2)?);
    pipeline::triangles(&state.linear(), &mut color, &mut depth, &program, BOX);
    Ok(())
}

/// A sampled texture.
struct Sampled {
    to_clip: Matrix<i32>,
    sampler: Sampler<Texture<'static, Rgb565>, LinearFilter, Repeat, MirroredRepeat>,
}

impl Program for Sampled {
    type Vertex = Corner;
    type Varying = [i32; 2];
    type At = Pixel;
    type Output = Rgba;
    const KEEPS_ALL: bool = true;

    fn vertex(&self, corner: &Corner) -> (Block<i32, 4>, [i32; 2]) {
        let uv = corner.uv.map(|v| (i32::from(v) * 3 - 1) << 20);
        (self.to_clip.transform(corner.point()), uv)
    }
    fn fragment(&self, _: Pixel, uv: [i32; 2]) -> Option<Rgba> {
        Some(self.sampler.sample(uv))
    }
}

pub fn linear_filter<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let (color, mut depth) = part.compared::<LessOrEqual>()?;
    let mut color = Surface::new(color, Rgb565);
    let sampler = Sampler::new(TEXTURE?, 20)
        .filtered(LinearFilter)
        .wrapped(Repeat, MirroredRepeat);
    for (degrees, scale) in [(20, 3), (75, 2)] {
        let to_clip = placed::<Q>([0, 0, -4], degrees, scale)?;
        let program = Sampled { to_clip, sampler };
        pipeline::triangles(&State::new(viewport()?), &mut color, &mut depth, &program, PLANE_XY);
    }
    Ok(())
}

/// One colour, in places.
struct Pane {
    to_clip: Matrix<i32>,
    color: Rgba,
    /// Only where these bits of column and row differ.
    holes: i32,
}

impl Program for Pane {
    type Vertex = Corner;
    type Varying = ();
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, corner: &Corner) -> (Block<i32, 4>, ()) {
        (self.to_clip.transform(corner.point()), ())
    }
    fn fragment(&self, at: Pixel, (): ()) -> Option<Rgba> {
        (self.holes == 0 || (at.x ^ at.y) & self.holes != 0).then_some(self.color)
    }
}

pub fn blending<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    smooth::<Q>(part)?;
    let state = State::new(viewport()?);
    let color = |eighths: [i32; 3], alpha| Rgba {
        color: eighths.map(|v| v * (ONE / 8)),
        alpha: alpha * (ONE / 8),
    };
    let added = Blend {
        source: Factor::SourceAlpha,
        destination: Factor::One,
        equation: Equation::Add,
        ..Blend::default()
    };
    let darkest = Blend {
        equation: Equation::Min,
        ..added
    };
    let panes = [
        ([-2, 1, -5], [8, 1, 0]),
        ([1, -1, -4], [1, 8, 3]),
        ([1, 1, -6], [2, 3, 7]),
    ];
    for ((position, eighths), blending) in panes.into_iter().zip([None, Some(added), Some(darkest)]) {
        let pane = Pane {
            to_clip: placed::<Q>(position, 15, 2)?,
            color: color(eighths, 5),
            holes: 0,
        };
        let surface = Surface::new(part.color()?, Rgb565);
        match blending {
            Some(rule) => pipeline::triangles(&state, &mut surface.blended(rule), &mut NoDepth, &pane, PLANE_XY),
            None => pipeline::triangles(&state, &mut surface.blended(Translucent), &mut NoDepth, &pane, PLANE_XY),
        }
    }
    Ok(())
}

/// Puts out a colour and the fragment's depth.
struct Two(Matrix<i32>);

impl Program for Two {
    type Vertex = Corner;
    type Varying = [i32; 3];
    type At = FragCoord;
    type Output = (u16, Option<u16>);

    fn vertex(&self, corner: &Corner) -> (Block<i32, 4>, [i32; 3]) {
        (
            self.0.transform(corner.point()),
            corner.normal.map(|v| i32::from(v) << 14),
        )
    }
    fn fragment(&self, at: FragCoord, [x, y, z]: [i32; 3]) -> Option<Self::Output> {
        let color = (x ^ y << 3 ^ z << 6) as u16 ^ 0x8421;
        let depth = at.inverse_w().to_fixed(16) as u16;
        Some((color, (at.x & 3 != 0).then_some(depth)))
    }
}

pub fn two_targets<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let mut targets = part.both()?;
    let program = Two(placed::<Q>([0, 0, -3], 50, 1)?);
    pipeline::triangles(&State::new(viewport()?), &mut targets, &mut NoDepth, &program, BOX);
    Ok(())
}

pub fn discard<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let (color, mut depth) = part.compared::<LessOrEqual>()?;
    let mut color = Surface::new(color, Rgb565);
    for (position, holes) in [([-1, 0, -3], 4), ([1, 0, -4], 8), ([0, 0, -5], 0)] {
        let pane = Pane {
            to_clip: placed::<Q>(position, 10 * holes, 2)?,
            color: Rgba {
                color: [ONE / 16 * (holes + 1), ONE / 2, ONE],
                alpha: ONE,
            },
            holes,
        };
        pipeline::triangles(&State::new(viewport()?), &mut color, &mut depth, &pane, PLANE_XY);
    }
    Ok(())
}

pub fn lines<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let (color, mut depth) = part.compared::<LessOrEqual>()?;
    let mut color = Surface::new(color, Rgb565);
    for i in 0..5 {
        let program = Smooth(placed::<Q>([i - 2, 0, -4], 33 * i, 1)?);
        pipeline::lines(&State::new(viewport()?), &mut color, &mut depth, &program, BOX);
    }
    Ok(())
}
