//! A turning icosahedron in lines, on a panel of 128×64 pixels, in less than 4 KiB of RAM with the stack: a page of eight rows
//! and twelve corners are all that is kept.

use core::convert::Infallible;

use fixel::bands::{Bands, Blocking};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::Flat;
use fixel::matrix::Matrix;
use fixel::mesh::Normalized;
use fixel::num::{Angle, Block, SineTable};
use fixel::screen::{Corner, Position};
use fixel::view::{Cull, View};
use fixel::viewport::Viewport;
use fixel::window::Window;

use crate::oled::{HEIGHT, Oled, PAGE, WIDTH, pack};

/// Frames until it ends.
pub const FRAMES: u32 = 8;

/// 1 and the golden ratio, in units of 2^-15, together of length 0.97.
const A: i16 = 16700;
const B: i16 = 27021;

/// In flash.
static CORNERS: [[i16; 3]; 12] = [
    [-A, B, 0],
    [A, B, 0],
    [-A, -B, 0],
    [A, -B, 0],
    [0, -A, B],
    [0, A, B],
    [0, -A, -B],
    [0, A, -B],
    [B, 0, -A],
    [B, 0, A],
    [-B, 0, -A],
    [-B, 0, A],
];

/// Pairs of corners.
static EDGES: [[u8; 2]; 30] = [
    [0, 1],
    [0, 5],
    [0, 7],
    [0, 10],
    [0, 11],
    [1, 5],
    [1, 7],
    [1, 8],
    [1, 9],
    [2, 3],
    [2, 4],
    [2, 6],
    [2, 10],
    [2, 11],
    [3, 4],
    [3, 6],
    [3, 8],
    [3, 9],
    [4, 5],
    [4, 9],
    [4, 11],
    [5, 9],
    [5, 11],
    [6, 7],
    [6, 8],
    [6, 10],
    [7, 8],
    [7, 10],
    [8, 9],
    [10, 11],
];

/// A page, in a static: 1 KiB.
pub type Memory = [u8; PAGE];

/// Draws the frame and sends it.
///
/// # Errors
/// None: sizes are constants.
pub fn frame(page: &mut Memory, oled: &mut impl Oled, frame: u32) -> Result<(), Error> {
    let corners = corners(frame)?;
    let mut bands = Bands::single(WIDTH, HEIGHT, &mut page[..], 0)?;
    let mut sink = Blocking(|window: Window, pixels: &[u8]| {
        oled.page(
            (window.top >> 3) as u8,
            &pack(pixels, window.top, |_, _, pixel| pixel > 0),
        );
        Ok::<(), Infallible>(())
    });
    let Ok(()) = bands.each(&mut sink, |page, _| {
        for edge in EDGES {
            if let [Some(from), Some(to)] = edge.map(|i| *corners.get(i as usize)?) {
                draw::segment(page, &mut NoDepth, [from, to], &Flat(1));
            }
        }
    });
    Ok(())
}

/// On the screen, once for all pages.
fn corners(frame: u32) -> Result<[Option<Corner<()>>; 12], Error> {
    let [aspect, near, far] = [2, 1, 5].map(|v| Block::from_integers([v]));
    let view = View::<i32, i32, 0> {
        projection: Matrix::perspective::<SineTable>(Angle::from_degrees(68), aspect, near, far)?,
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up().samples_at_centers(),
        depth_range: DepthRange::Unlimited,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    };
    let turn = Matrix::rotation::<SineTable>(Angle::from_degrees(9 * frame as i32), Block::from_integers([1, 3, 2]))?;
    let model = Matrix::translation(Block::from_integers([0, 0, -4])).product(&turn);
    Ok(CORNERS.map(|corner| {
        let center = view.project_point(model.transform(corner.point()))?;
        Some(Position::nearest(center.x, center.y).flat())
    }))
}
