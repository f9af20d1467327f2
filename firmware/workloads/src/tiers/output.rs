//! A grey sky, whose brightness hardly changes, on displays of few levels: each pixel the nearest of them, or dithered.

use fixel::bands::{Bands, Blocking};
use fixel::dither;
use fixel::draw::indexed;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::num::Block;
use fixel::quality::FineGouraud565;
use fixel::target::Target;
use fixel::varying::Linear;
use fixel::view::Carried;
use fixel::window::Window;

use super::camera::CORRIDOR;
use super::canvas::{Canvas, HEIGHT, WIDTH};
use super::color::{MOST, Output};
use super::geometry::{Models, SKY};

/// Rows that are drawn and then dithered at once.
const ROWS: usize = 8;
const BAND: usize = ROWS * WIDTH as usize;

/// Bytes of red, green and blue, from 255ths in units of 2^-16 with the half that rounds.
struct Bytes;

impl Fragment for Bytes {
    type Varying = Linear<3>;
    type Pixel = [u8; 3];

    #[inline(always)]
    fn shade(&self, channels: [i32; 3], _below: [u8; 3]) -> Option<[u8; 3]> {
        Some(channels.map(|c| (c >> 16) as u8))
    }
}

/// Bytes of grey.
struct Grey;

impl Fragment for Grey {
    type Varying = Linear<1>;
    type Pixel = u8;

    #[inline(always)]
    fn shade(&self, [grey]: [i32; 1], _below: u8) -> Option<u8> {
        Some((grey >> 16) as u8)
    }
}

/// 255ths in units of 2^-16, with the half that rounds.
fn byte(grey: i32) -> i32 {
    (grey << 16) + 0x8000
}

/// RGB565, nearest.
pub fn nearest<P: Output>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error> {
    let levels = |grey: i32| MOST.map(|most| ((grey * most) << 16).checked_div(255).unwrap_or(0) + 0x8000);
    in_bands(canvas, 0, &FineGouraud565, levels, |pixel, _| P::texel(pixel))
}

/// RGB565, dithered.
pub fn dithered<P: Output>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error> {
    let pixel = |channels, at| P::texel(dither::rgb565(channels, at));
    in_bands(canvas, [0; 3], &Bytes, |grey| [byte(grey); 3], pixel)
}

/// Black and white, the nearer.
pub fn nearest_of_two<P: Output>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error> {
    let pixel = |grey: u8, _| black_or_white(grey >= 128);
    in_bands(canvas, 0, &Grey, |grey| [byte(grey)], pixel)
}

/// Black and white, dithered.
pub fn dithered_to_two<P: Output>(canvas: &mut Canvas<P>, _: &Models) -> Result<(), Error> {
    let pixel = |grey, at| black_or_white(dither::one_bit(grey, at));
    in_bands(canvas, 0, &Grey, |grey| [byte(grey)], pixel)
}

#[inline(always)]
fn black_or_white<P: Output>(white: bool) -> P {
    P::texel(if white { u16::MAX } else { 0 })
}

/// Draws a few rows after another as `fragment` does, and shows `pixel` of each.
fn in_bands<P: Output, F: Fragment<Varying: Carried, Pixel: Default>>(
    canvas: &mut Canvas<P>,
    background: F::Pixel,
    fragment: &F,
    carried: impl Fn(i32) -> <F::Varying as Carried>::Vertex,
    pixel: impl Fn(F::Pixel, (i32, i32)) -> P,
) -> Result<(), Error> {
    let view = CORRIDOR.view()?;
    let vertices = SKY.map(|([x, y, z], grey)| view.vertex(Block::from_integers([x, y, z, 1]), carried(grey)));
    let (mut shown, _) = canvas.buffers()?;
    let mut memory = [F::Pixel::default(); BAND];
    let mut show = Blocking(|band: Window, pixels: &[F::Pixel]| {
        for (y, row) in (band.top..).zip(pixels.chunks(WIDTH.into())) {
            for ((x, &drawn), place) in (0..).zip(row).zip(shown.row(y)) {
                *place = pixel(drawn, (x, y));
            }
        }
        Ok::<(), Error>(())
    });
    Bands::single(WIDTH, HEIGHT, &mut memory[..], background)?.each(&mut show, |color, depth| {
        indexed(&view, color, depth, &vertices, [[0u16, 1, 2], [0, 2, 3]], fragment);
    })
}
