//! What is done with pixels beyond drawing them: averaging, encoding, reducing to one bit.

use core::hint::black_box;

use fixel::blend::{ONE, Rgba, over565};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Flat, Fragment};
use fixel::pipeline::{OneBit, PixelFormat};
use fixel::screen::{Corner, FineDepth, Position, SubPx};
use fixel::srgb::{decode, encode};
use fixel::supersample::Level;
use fixel::target::Buffer;
use fixel::varying::Linear;
use fixel::window::Window;

use super::part::{Part, WIDTH};

/// In units of 2^-8 px.
const TRIANGLES: [[(i32, i32); 3]; 3] = [
    [(300, 200), (23_000, 1_111), (9_001, 15_777)],
    [(-4_000, 9_000), (15_000, -3_000), (20_001, 20_003)],
    [(17_000, 8_000), (6_000, 14_000), (24_000, 16_500)],
];

fn corners<V>(triangle: [(i32, i32); 3], scale: i32, varying: impl Fn(usize) -> V) -> [Corner<V>; 3] {
    let mut index = 0;
    triangle.map(|(x, y)| {
        index += 1;
        Corner {
            position: Position::nearest(SubPx::from_bits(x * scale), SubPx::from_bits(y * scale)),
            depth: FineDepth::ZERO,
            varying: varying(index - 1),
        }
    })
}

/// 2×2 samples a pixel, row by row.
pub fn supersampled(part: &mut Part<'_>) -> Result<(), Error> {
    const SIDE: usize = 2;
    let level = Level::new(SIDE as u32)?;
    let window = part.window();
    let mut samples = [Rgba::default(); SIDE * SIDE * WIDTH as usize];
    for (y, row) in (window.top..).zip(part.colors_mut().chunks_mut(WIDTH.into())) {
        samples.fill(Rgba::default());
        let (side, width) = (SIDE as i32, i32::from(WIDTH));
        let mut strip = Buffer::strip(&mut samples, Window::new(0, side * y, side * width, side * (y + 1)))?;
        for (i, triangle) in black_box(TRIANGLES).into_iter().enumerate() {
            let mut color = [ONE / 5; 3];
            if let Some(channel) = color.get_mut(i) {
                *channel = ONE;
            }
            let paint = Flat(Rgba {
                color,
                alpha: ONE / 4 * 3,
            });
            draw::triangle(&mut strip, &mut NoDepth, corners(triangle, side, |_| ()), &paint);
        }
        level.resolve(&samples, SIDE * usize::from(WIDTH), |x, pixel| {
            if let Some(there) = row.get_mut(x) {
                *there = over565(pixel, *there);
            }
        });
    }
    Ok(())
}

/// Two values between the corners, through tables, to both bytes of a pixel.
struct Encoded;

impl Fragment for Encoded {
    type Varying = Linear<2>;
    type Pixel = u16;
    fn shade(&self, [linear, level]: [i32; 2], _below: u16) -> Option<u16> {
        let encoded = encode(linear) >> 16;
        let decoded = decode((level >> 16) as u8) >> 21;
        Some((encoded << 8) as u16 ^ decoded as u16)
    }
}

pub fn srgb(part: &mut Part<'_>) -> Result<(), Error> {
    let mut color = part.color()?;
    for triangle in black_box(TRIANGLES) {
        let corners = corners(triangle, 1, |i| {
            Linear([[0, ONE / 7, ONE], [255 << 16, 0, 99 << 16]].map(|v| v[i]))
        });
        draw::triangle(&mut color, &mut NoDepth, corners, &Encoded);
    }
    Ok(())
}

/// Grey, dithered to black or white.
struct Dithered;

impl Fragment for Dithered {
    type Varying = Linear<3>;
    type Pixel = u16;
    fn shade(&self, [grey, x, y]: [i32; 3], _below: u16) -> Option<u16> {
        // Bayer's 2×2 matrix, by where on the primitive the pixel is.
        let threshold = [-3, 1, 3, -1][((x >> 16 & 1) << 1 | y >> 16 & 1) as usize];
        let color = Rgba {
            color: [grey + threshold * (ONE / 8); 3],
            alpha: ONE,
        };
        Some(if OneBit.encode(color) { 0xffff } else { 0 })
    }
}

pub fn one_bit(part: &mut Part<'_>) -> Result<(), Error> {
    let mut color = part.color()?;
    for triangle in black_box(TRIANGLES) {
        let corners = corners(triangle, 1, |i| {
            let ((x, y), grey) = (triangle[i], [0, ONE, ONE / 2][i]);
            Linear([grey, x << 8, y << 8])
        });
        draw::triangle(&mut color, &mut NoDepth, corners, &Dithered);
    }
    Ok(())
}
