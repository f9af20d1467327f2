//! Textures in perspective by how far apart the corners' w are: from not at all to a factor of 2^15.

use core::marker::PhantomData;

use core::hint::black_box;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::LessOrEqual;
use fixel::draw;
use fixel::error::Error;
use fixel::matrix::Matrix;
use fixel::num::Block;
use fixel::quality::Quality;
use fixel::texture::Nearest;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;

use super::camera::Textured;
use super::part::{HEIGHT, Part, WIDTH};
use super::raster::TEXTURE;

/// How far a corner is away.
#[derive(Clone, Copy)]
enum Place {
    /// w = 1.
    Near,
    /// w is the root of the factor, or half of that.
    Between,
    /// w is the factor.
    Far,
}

use Place::{Between, Far, Near};

/// Where a corner is seen, x, y and z in eighths of the picture's half; how far; and its texel.
type Point = ([i32; 3], Place, [i32; 2]);

/// With one corner far, with two, with three different w, and small.
const TRIANGLES: [[Point; 3]; 5] = [
    [
        ([-7, -7, 5], Near, [0, 0]),
        ([8, -6, 5], Near, [21, 0]),
        ([-2, 7, 5], Far, [7, 60]),
    ],
    [
        ([-9, 6, 2], Far, [0, 33]),
        ([-6, -9, -7], Near, [1, 0]),
        ([-1, 8, 6], Far, [9, 31]),
    ],
    [
        ([7, 7, 7], Far, [2, 1]),
        ([-1, 2, 0], Between, [30, 3]),
        ([9, -11, -6], Near, [5, 29]),
    ],
    [
        ([0, 0, -7], Near, [0, 0]),
        ([2, 0, -7], Between, [9, 2]),
        ([1, 3, -7], Near, [1, 12]),
    ],
    [
        ([-5, -3, -7], Far, [0, 0]),
        ([-4, -2, -7], Far, [3, 2]),
        ([-5, -1, -7], Near, [1, 7]),
    ],
];

/// The triangles where w differs by a factor of 2^`BITS`.
pub fn ratio<Q: Quality, const BITS: u32>(part: &mut Part<'_>) -> Result<(), Error> {
    let view = View::<i32, i32, 0> {
        projection: black_box(Matrix::identity()),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    };
    let fragment = Textured::<Q>(Nearest::new(TEXTURE?, 16), PhantomData);
    let (mut color, mut depth) = part.compared::<LessOrEqual>()?;
    for triangle in black_box(&TRIANGLES) {
        let corners = triangle.map(|([x, y, z], place, texel)| {
            let w = match place {
                Near => 1,
                Between => 1 << (BITS / 2),
                Far => 1 << BITS,
            };
            Vertex {
                position: Block::from_integers([x, y, z, 8].map(|v| v * w)),
                carried: texel.map(|v| v << 16),
            }
        });
        draw::primitive(&view, &mut color, &mut depth, &corners, &fragment);
    }
    Ok(())
}
