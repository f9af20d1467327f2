//! By hand: clip planes in one loop, the division, the core's spans, and a store for every pixel of a span.
//!
//! What someone writes who needs flat triangles and nothing else: the core's matrix, clipper, viewport and spans, put
//! together for this picture alone. The store is `fill`, the shortest way to write the loop `*pixel = color`: for 16-bit
//! pixels the compiler makes no call of it but that loop, unrolled, which is also what it makes of a program that returns its
//! colour for every pixel.

use fixel::clip::{DepthRange, Planes};
use fixel::edge::SUBPIXELS;
use fixel::matrix::Matrix;
use fixel::num::{Block, Word};
use fixel::span::{Corners, doubled_area, scan};
use fixel::target::{Buffer, Target};
use fixel::viewport::Viewport;
use heapless::Vec;

use crate::frame::{HEIGHT, WIDTH};

use super::Triangle;

/// Clip planes: near, and the four sides of the guard band.
const PLANES: usize = 5;

/// Corners on the screen: three, and one for each plane.
struct Polygon(Vec<(i32, i32), { 3 + PLANES }>);

impl Corners for Polygon {
    fn count(&self) -> usize {
        self.0.len()
    }
    fn position(&self, index: usize) -> (i32, i32) {
        self.0.get(index).copied().unwrap_or_default()
    }
}

/// Draws the triangles.
#[inline(never)]
pub fn draw(color: &mut Buffer<'_, u16>, viewport: &Viewport<i32>, matrix: &Matrix<i32>, triangles: &[Triangle]) {
    let Some(planes) = planes() else { return };
    let window = viewport.window().intersect(color.window());
    for (corners, pixel) in triangles {
        let Some(clipped) = planes.clip(corners.map(|corner| matrix.transform(Block::from_integers(corner)))) else {
            continue;
        };
        let mut polygon = Polygon(Vec::new());
        for corner in clipped.iter() {
            if let Some((x, y, _)) = viewport.place(corner.position, DepthRange::Unlimited) {
                // There is room.
                let _full = polygon.0.push((x, y));
            }
        }
        scan::<i32>(&polygon, doubled_area(&polygon) > 0, window, |span| {
            color.span(span.row, span.left, span.right).fill(*pixel);
        });
    }
}

/// The planes of this picture, y upwards and samples at pixel centres.
fn planes() -> Option<Planes<i32, PLANES>> {
    const LIMIT: i32 = <i32 as Word>::GUARD * SUBPIXELS;
    const X: i32 = WIDTH as i32 * SUBPIXELS / 2;
    const Y: i32 = HEIGHT as i32 * SUBPIXELS / 2;
    const CENTER: (i32, i32) = (X - SUBPIXELS / 2, Y - SUBPIXELS / 2);
    let mut planes = Planes::default();
    for plane in [
        [0, 0, 1, 1],
        [-X, 0, 0, LIMIT - CENTER.0],
        [0, Y, 0, LIMIT - CENTER.1],
        [X, 0, 0, LIMIT + CENTER.0],
        [0, -Y, 0, LIMIT + CENTER.1],
    ] {
        planes.push(Block::from_integers(plane)).ok()?;
    }
    Some(planes)
}
