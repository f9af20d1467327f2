//! A lit ring on a panel of 128×64 pixels that are black or white: greys are drawn page by page, and dithered as they are sent.
//! With its stack it fits the 16 KiB of a micro:bit.

use core::convert::Infallible;

use fixel::bands::{Bands, Blocking, Pool};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::LessOrEqual;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::matrix::{Directions, Matrix};
use fixel::mesh::Normalized;
use fixel::num::{Angle, Block, SineTable, dot};
use fixel::varying::Linear;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;

use crate::oled::{HEIGHT, Oled, PAGE, WIDTH, pack};
use crate::torus;

/// Frames until it ends.
pub const FRAMES: u32 = 4;
/// Fields around the ring and across the tube.
const RING: u32 = 16;
const TUBE: usize = 10;

/// Thresholds in 16ths, so that n of 16 pixels are lit for a grey of n/16 (Bayer).
const BAYER: [[u8; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// A grey from the corners' greys.
#[derive(Clone, Copy)]
pub struct Grey;

impl Fragment for Grey {
    type Varying = Linear<1>;
    type Pixel = u8;

    fn shade(&self, [grey]: [i32; 1], _below: u8) -> Option<u8> {
        Some((grey >> 16) as u8)
    }
}

/// What a frame needs, in a static: 8.3 KiB. The pool is too small for all of the ring, which is therefore submitted several
/// times, for some of the pages each: the first frame finds out for how many.
pub struct Memory {
    page: [u8; PAGE],
    depth: [u16; PAGE],
    pool: Pool<Grey, 270, 90, 8>,
}

impl Memory {
    /// Zeros.
    pub const fn new() -> Self {
        Memory {
            page: [0; PAGE],
            depth: [0; PAGE],
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
/// None: sizes are constants.
pub fn frame(memory: &mut Memory, oled: &mut impl Oled, frame: u32) -> Result<u32, Error> {
    let Memory { page, depth, pool } = memory;
    let mut bands = Bands::single(WIDTH, HEIGHT, &mut page[..], 0)?.with_depth::<LessOrEqual>(depth)?;
    let mut sink = Blocking(|window: Window, greys: &[u8]| {
        let lit = |x: usize, y: usize, grey: u8| grey >> 4 > BAYER[y & 3][x & 3];
        oled.page((window.top >> 3) as u8, &pack(greys, window.top, lit));
        Ok::<(), Infallible>(())
    });
    let (view, model) = (view()?, model(frame)?);
    let Ok(passes) = bands.render(pool, &mut sink, |frame| {
        ring(&model, |corners| frame.primitive(&view, &corners, Grey));
    });
    Ok(passes)
}

fn view() -> Result<View<i32, i32, 0>, Error> {
    let [aspect, near, far] = [2, 1, 5].map(|v| Block::from_integers([v]));
    Ok(View {
        projection: Matrix::perspective::<SineTable>(Angle::from_degrees(68), aspect, near, far)?,
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up().samples_at_centers(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Clockwise,
    })
}

/// Where the ring is: 4 away, turned by 20° a frame.
fn model(frame: u32) -> Result<Matrix<i32>, Error> {
    let turn = |degrees, axis| Matrix::rotation::<SineTable>(Angle::from_degrees(degrees), Block::from_integers(axis));
    let lean = turn(50, [1, 0, 0])?.product(&turn(20 * frame as i32, [1, 0, 2])?);
    Ok(Matrix::translation(Block::from_integers([0, 0, -4])).product(&lean))
}

/// Calls `draw` with every triangle. Each vertex is made and lit once, and two circles of them are kept.
fn ring(model: &Matrix<i32>, mut draw: impl FnMut([Vertex<i32, [i32; 1]>; 3])) {
    let mut directions = Directions::identity();
    directions.load(model);
    let circle = |i: u32| {
        core::array::from_fn::<_, { TUBE + 1 }, _>(|j| {
            let (position, normal) = torus::point(torus::step(i, RING), torus::step(j as u32, TUBE as u32));
            let normal = directions.turn(Block::new(normal.map(i32::from), -15)).unit();
            Vertex {
                position: model.transform(position.point()),
                carried: [grey(normal.unwrap_or_default())],
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

/// Diffuse light from the upper left, and a little from everywhere, in units of 2^-16 of 0…255.
fn grey(normal: [i32; 3]) -> i32 {
    /// Towards the light, of length 1 in units of 2^-30: (−2, 3, 6) / 7.
    const LIGHT: [i32; 3] = [-306783378, 460175067, 920350134];
    // From 2^-60 to 2^-16.
    let cosine = (dot(normal, LIGHT) >> 44).max(0) as i32;
    20 * 65536 + 234 * cosine
}
