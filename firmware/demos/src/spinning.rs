//! A tiled ring that spins on a display of 160×128 behind SPI: bands of 16 rows, 5 KiB each, instead of a picture of 40 KiB.

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::pixelcolor::{Rgb565, raw::RawU16};
use fixel::bands::{Bands, Blocking, Pool};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::matrix::Matrix;
use fixel::mesh::Normalized;
use fixel::num::{Angle, Block, SineTable};
use fixel::target::Buffer;
use fixel::texture::{self, Floor, Nearest, Texture};
use fixel::varying::Perspective;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::{draw, eg};

use crate::spi::{HEIGHT, WIDTH};
use crate::torus;

/// Frames until it ends.
pub const FRAMES: u32 = 4;
/// Rows of a band.
const ROWS: usize = 16;
/// Fields around the ring and across the tube.
const RING: u32 = 20;
const TUBE: usize = 12;

const BACKGROUND: RawU16 = raw(0x10a4);

/// Four by four texels, in flash.
const TILES: Texture<texture::Rgb565> = match Texture::new(
    texture::Rgb565,
    &[
        0xffdf, 0xfe60, 0xfe60, 0xffdf, 0xfe60, 0xc000, 0xc000, 0xfe60, 0xfe60, 0xc000, 0xc000, 0xfe60, 0xffdf, 0xfe60,
        0xfe60, 0xffdf,
    ],
    4,
    4,
) {
    Ok(texture) => texture,
    Err(_) => panic!("a texture of another size"),
};

/// The texel that a pixel falls on.
#[derive(Clone, Copy)]
pub struct Tiled(Nearest<'static, texture::Rgb565, Floor>);

impl Fragment for Tiled {
    /// Texels, with 16 fraction bits.
    type Varying = Perspective<2>;
    type Pixel = RawU16;

    fn shade(&self, st: [i32; 2], _below: RawU16) -> Option<RawU16> {
        Some(raw(self.0.stored(st)))
    }
}

const fn raw(value: u16) -> RawU16 {
    RawU16::new(value)
}

/// What a frame needs, in a static: 43 KiB, of which the ring's triangles are 33. A picture and its depth would be 80.
pub struct Memory {
    band: [RawU16; WIDTH as usize * ROWS],
    depth: [u16; WIDTH as usize * ROWS],
    pool: Pool<Tiled, 840, 280, 8>,
}

impl Memory {
    /// Zeros.
    pub const fn new() -> Self {
        Memory {
            band: [raw(0); WIDTH as usize * ROWS],
            depth: [0; WIDTH as usize * ROWS],
            pool: Pool::new(),
        }
    }
}

impl Default for Memory {
    fn default() -> Self {
        Self::new()
    }
}

/// Draws the frame and sends it; how often the scene was submitted.
///
/// # Errors
/// None of the core's: sizes are constants. The display's are left out.
pub fn frame<D: DrawTarget<Color = Rgb565>>(memory: &mut Memory, display: &mut D, frame: u32) -> Result<u32, Error> {
    let Memory { band, depth, pool } = memory;
    // The driver sends while we wait, so that one buffer will do.
    let bands = Bands::single(WIDTH, HEIGHT, &mut band[..], BACKGROUND)?;
    let mut bands = bands.with_depth::<LessOrEqual>(depth)?;
    let mut sink = Blocking(|window, pixels: &[RawU16]| eg::send(pixels, window, display));
    let (view, model) = (view()?, model(frame)?);
    let sent = bands.render(pool, &mut sink, |frame| {
        ring(&model, |corners| frame.primitive(&view, &corners, tiled()));
    });
    Ok(sent.unwrap_or(0))
}

/// The same picture drawn whole, for comparison.
///
/// # Errors
/// Buffers of less than a picture.
pub fn whole(pixels: &mut [RawU16], depths: &mut [u16], frame: u32) -> Result<(), Error> {
    pixels.fill(BACKGROUND);
    depths.fill(FAR);
    let mut color = Buffer::new(pixels, WIDTH, HEIGHT)?;
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Buffer::new(depths, WIDTH, HEIGHT)?);
    let (view, model) = (view()?, model(frame)?);
    ring(&model, |corners| {
        draw::primitive(&view, &mut color, &mut depth, &corners, &tiled())
    });
    Ok(())
}

fn tiled() -> Tiled {
    Tiled(Nearest::new(TILES, 16))
}

fn view() -> Result<View<i32, i32, 0>, Error> {
    // 160:128 is 5:4; near and far as close to the ring as it allows.
    let [aspect, near, far] = [
        Block::new([5], -2),
        Block::from_integers([1]),
        Block::from_integers([5]),
    ];
    Ok(View {
        projection: Matrix::perspective::<SineTable>(Angle::from_degrees(40), aspect, near, far)?,
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up().samples_at_centers(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Clockwise,
    })
}

/// Where the ring is: 3 away, turned by 15° a frame and leant towards us.
fn model(frame: u32) -> Result<Matrix<i32>, Error> {
    let turn = |degrees, axis| Matrix::rotation::<SineTable>(Angle::from_degrees(degrees), Block::from_integers(axis));
    let lean = turn(40, [1, 0, 0])?.product(&turn(15 * frame as i32, [0, 1, 1])?);
    Ok(Matrix::translation(Block::from_integers([0, 0, -3])).product(&lean))
}

/// Calls `draw` with every triangle. Each vertex is made once, and two circles of them are kept.
fn ring(model: &Matrix<i32>, mut draw: impl FnMut([Vertex<i32, [i32; 2]>; 3])) {
    let circle = |i: u32| {
        core::array::from_fn::<_, { TUBE + 1 }, _>(|j| {
            let (position, _) = torus::point(torus::step(i, RING), torus::step(j as u32, TUBE as u32));
            Vertex {
                position: model.transform(position.point()),
                // A tile per field.
                carried: [4 * i as i32, 4 * j as i32].map(|texel| texel << 16),
            }
        })
    };
    let mut previous = circle(0);
    for i in 1..=RING {
        let next = circle(i);
        for (near, far) in previous.windows(2).zip(next.windows(2)) {
            if let ([a, b], [d, c]) = (near, far) {
                draw([*a, *b, *c]);
                draw([*a, *c, *d]);
            }
        }
        previous = next;
    }
}
