//! Antialiasing by drawing N times larger in each direction and averaging blocks of N×N samples.
//!
//! A sample is a pixel of the larger picture, N·width × N·height; its positions are the ones to draw with. N·width and
//! N·height stay within the guard band, 4096 for 32-bit words. Strip by strip it takes no more memory than N rows of
//! samples: 640×2 for a picture of 320 columns at N = 2, or as many more output rows as there is room for.
//!
//! A triangle at N = 2 in strips of one output row, over a grey RGB565 background:
//!
//! ```
//! use fixel::blend::{ONE, Rgba, over565};
//! use fixel::supersample::Level;
//! use fixel::{depth::NoDepth, draw, fragment::Flat, screen::Position, target::Buffer, window::Window};
//!
//! const WIDTH: usize = 6;
//! const HEIGHT: usize = 3;
//! const N: usize = 2;
//!
//! let level = Level::new(N as u32)?;
//! let red = Rgba { color: [ONE, 0, 0], alpha: ONE };
//! let corners = [(0, 0), (0, 6), (12, 0)].map(|(x, y)| Position::from_pixels(x, y).flat());
//! let mut picture = [0x8410u16; WIDTH * HEIGHT];
//! let mut samples = [Rgba::default(); N * WIDTH * N];
//!
//! for (y, row) in picture.chunks_mut(WIDTH).enumerate() {
//!     samples.fill(Rgba::default());
//!     let window = Window::new(0, (N * y) as i32, (N * WIDTH) as i32, (N * (y + 1)) as i32);
//!     let mut strip = Buffer::strip(&mut samples, window)?;
//!     draw::triangle(&mut strip, &mut NoDepth, corners, &Flat(red));
//!     level.resolve(&samples, N * WIDTH, |x, pixel| row[x] = over565(pixel, row[x]));
//! }
//!
//! let reds = picture.map(|pixel| pixel >> 11);
//! assert_eq!(reds, [
//!     31, 31, 31, 31, 31, 24, // of the last block's samples two are red
//!     31, 31, 31, 24, 16, 16,
//!     31, 24, 16, 16, 16, 16,
//! ]);
//! # Ok::<(), fixel::error::Error>(())
//! ```

use crate::blend::{ONE, Rgba};
use crate::error::Error;
use crate::num::reciprocal;

/// How many samples a pixel has in each direction: N in 1…16.
///
/// ```
/// use fixel::{error::Error, supersample::Level};
/// assert_eq!(Level::new(4)?.side(), 4);
/// assert_eq!(Level::new(0), Err(Error::SupersamplingLevel));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Level(u8);

impl Level {
    /// N samples in each direction.
    ///
    /// # Errors
    /// [`Error::SupersamplingLevel`] outside 1…16.
    pub const fn new(side: u32) -> Result<Self, Error> {
        if side >= 1 && side <= 16 {
            Ok(Level(side as u8))
        } else {
            Err(Error::SupersamplingLevel)
        }
    }

    /// N.
    pub const fn side(self) -> usize {
        self.0 as usize
    }

    /// The pixels of one output row, from the left, each with its column: alpha is Σα/N², color Σ(c·α)/Σα, and 0 where
    /// Σα is 0. `samples` starts with the row's N rows of samples, `stride` apart; there are `stride`/N pixels, fewer
    /// where `samples` ends before their last sample.
    ///
    /// A sample with alpha 0 has no part in the colour, so that an edge does not darken. Every channel lies in the range
    /// of the samples that have one; alpha outside 0…[`ONE`] is taken as the nearer end.
    ///
    /// **Error**: alpha is the nearest to the true one. A channel is within ½ unit + 2^-22 of the block's range of it
    /// (`tests/supersampling.rs`).
    ///
    /// ```
    /// use fixel::blend::{ONE, Rgba};
    /// use fixel::supersample::Level;
    /// let (red, empty) = (Rgba { color: [ONE, 0, 0], alpha: ONE }, Rgba::default());
    /// let samples = [
    ///     red, red, red, empty, //
    ///     red, red, empty, empty,
    /// ];
    /// let mut row = [empty; 2];
    /// Level::new(2)?.resolve(&samples, 4, |column, pixel| row[column] = pixel);
    /// assert_eq!(row, [red, Rgba { alpha: ONE / 4, ..red }]);
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    pub fn resolve(self, samples: &[Rgba], stride: usize, mut out: impl FnMut(usize, Rgba)) {
        let count = Divisor::new(self.count());
        self.blocks(samples, stride, |column, block| out(column, average(&block, &count)));
    }

    /// The same for opaque RGB565 samples: each channel is the plain average, exactly rounded to nearest, a half upwards.
    ///
    /// ```
    /// use fixel::supersample::Level;
    /// let samples = [
    ///     0xffff, 0x0000, 0x001f, 0x001f, //
    ///     0xffff, 0xffff, 0x001f, 0x001e,
    /// ];
    /// let mut row = [0; 2];
    /// Level::new(2)?.resolve565(&samples, 4, |column, pixel| row[column] = pixel);
    /// assert_eq!(row, [23 << 11 | 47 << 5 | 23, 31]); // 23.25, 47.25, 23.25; 30.75
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    pub fn resolve565(self, samples: &[u16], stride: usize, mut out: impl FnMut(usize, u16)) {
        let count = self.count();
        // 1/count rounded up in units of 2^-24: less than a unit too much. A sum with its half is below 2^14, so that the
        // product is too large by less than 2^14 units, a quarter of a 256th, and passes no whole number; it is below 2^30.1.
        let inverse = (1u32 << 24).wrapping_add(count - 1).checked_div(count).unwrap_or(0);
        let nearest = |sum: u32| ((sum + count / 2) * inverse) >> 24;
        self.blocks(samples, stride, |column, block| {
            let (mut red, mut green, mut blue) = (0, 0, 0);
            for &sample in block.iter() {
                red += (sample >> 11) as u32;
                green += (sample >> 5 & 63) as u32;
                blue += (sample & 31) as u32;
            }
            let pixel = (nearest(red) << 6 | nearest(green)) << 5 | nearest(blue);
            out(column, pixel as u16);
        });
    }

    /// Samples of a block, 1…256.
    fn count(self) -> u32 {
        self.0 as u32 * self.0 as u32
    }

    /// The columns and samples of the blocks of one output row, as far as they are whole.
    #[inline(always)]
    fn blocks<'s, S>(self, samples: &'s [S], stride: usize, mut each: impl FnMut(usize, Block<'s, S>)) {
        let side = self.side();
        let mut left = 0usize;
        // There are no more pixels than samples.
        for column in 0..samples.len() {
            let right = left.saturating_add(side);
            let last = stride.saturating_mul(side - 1).saturating_add(right);
            if right > stride || last > samples.len() {
                return;
            }
            each(
                column,
                Block {
                    samples: samples.get(left..last).unwrap_or_default(),
                    side,
                    stride,
                },
            );
            left = right;
        }
    }
}

/// `side` rows of `side` samples, `stride` apart.
struct Block<'s, S> {
    samples: &'s [S],
    side: usize,
    stride: usize,
}

impl<'s, S> Block<'s, S> {
    #[inline(always)]
    fn iter(&self) -> impl Iterator<Item = &'s S> {
        let side = self.side;
        self.samples
            .chunks(self.stride.max(1))
            .flat_map(move |row| row.iter().take(side))
    }
}

impl Block<'_, Rgba> {
    /// Alpha in 1…2^28 and colour of every sample that has alpha.
    #[inline(always)]
    fn visible(&self) -> impl Iterator<Item = (u64, [i32; 3])> {
        self.iter().filter_map(|&Rgba { color, alpha }| {
            let alpha = alpha.clamp(0, ONE) as u64;
            (alpha > 0).then_some((alpha, color))
        })
    }
}

/// One pixel of a block of `count` samples.
fn average(block: &Block<'_, Rgba>, count: &Divisor) -> Rgba {
    let mut total = 0;
    let mut least = [i32::MAX; 3];
    for (alpha, color) in block.visible() {
        total += alpha;
        for (least, c) in least.iter_mut().zip(color) {
            *least = c.min(*least);
        }
    }
    if total == 0 {
        return Rgba::default();
    }
    // At most 256 alphas of 2^28. As weights they are cut so that their sum fits 32 bits and the sums below 64: a distance
    // is less than 2^32. Where the sum had more bits it keeps 2^31 − 256, and each weight loses less than 1.
    let cut = 32u32.saturating_sub(total.leading_zeros()) & 31;
    let (mut weights, mut sums) = (0, [0; 3]);
    for (alpha, color) in block.visible() {
        let weight = alpha >> cut;
        weights += weight as u32;
        for ((sum, c), least) in sums.iter_mut().zip(color).zip(least) {
            *sum += c.wrapping_sub(least) as u32 as u64 * weight;
        }
    }
    let weights = Divisor::new(weights);
    let mut sums = sums.into_iter();
    Rgba {
        // Never above the largest colour, and so within an i32.
        color: least.map(|c| c.wrapping_add(weights.nearest(sums.next().unwrap_or(0)) as i32)),
        alpha: count.nearest(total) as i32,
    }
}

/// A number to divide by, more than once.
struct Divisor {
    /// 2^63 / (divisor · 2^shift), rounded down.
    reciprocal: u64,
    /// Takes the divisor into 2^31…2^32.
    shift: u32,
    divisor: u64,
}

impl Divisor {
    /// `divisor` is not 0.
    #[inline]
    fn new(divisor: u32) -> Self {
        let shift = divisor.leading_zeros() & 31;
        Divisor {
            reciprocal: reciprocal(divisor << shift),
            shift,
            divisor: divisor as u64,
        }
    }

    /// `dividend`/divisor rounded to nearest, exactly, a half upwards, for a quotient below 2^32.
    #[inline]
    fn nearest(&self, dividend: u64) -> u32 {
        // Shifted, the dividend is below 2^64 and the product of its upper half below 2^63. Cutting both makes the quotient
        // up to 4 too small, never too large.
        let mut quotient = (((dividend << self.shift) >> 32) * self.reciprocal) >> 31;
        let mut rest = (dividend + self.divisor / 2).wrapping_sub(quotient * self.divisor);
        // Counted, and one step more for the half: of a plain `while` the compiler makes a division.
        for _ in 0..5 {
            if rest >= self.divisor {
                rest -= self.divisor;
                quotient += 1;
            }
        }
        quotient as u32
    }
}
