//! Ordered dither: more shades than a display has, as the mean of neighbouring pixels.
//!
//! A pixel's value lies between two levels of the display; a threshold that depends on the pixel's position alone decides which
//! of the two it gets. Positions are those of the whole picture, so that a picture dithered strip by strip has the same bits as
//! one dithered whole. Thresholds are Bayer's 4×4: over any 4×4 pixels every sixteenth of a level comes once.
//!
//! | to | from | a pixel | the mean of 4×4 equal ones |
//! |---|---|---|---|
//! | [`rgb565`] | 8 bits a channel | within a level | within 1/32 level |
//! | [`rgb565_fine`] | 2^-16 of a level of the display | within a level | within 1/32 level |
//! | [`one_bit`] | 8 bits | – | within 1/32 of white |
//!
//! Levels are those of the display, 31 or 63 of a channel. Without dither a pixel is within half a level, and so is the mean.
//! A value that is a level is that level at every pixel. (`tests/dither.rs`)
//!
//! ```
//! use fixel::dither::one_bit;
//! // A ramp from black to white.
//! let rows: Vec<String> = (0..4)
//!     .map(|y| (0..32).map(|x| if one_bit((x * 8 + 4) as u8, (x, y)) { '#' } else { '.' }).collect())
//!     .collect();
//! assert_eq!(rows, [
//!     "...........#...#.#.#.#.#.#.#.###",
//!     "......#.#.#.#.#.#.###.##########",
//!     ".........#...#.#.#.#.#.#.#.#####",
//!     "....#.#.#.#.#.#.###.############"
//! ]);
//! ```

/// Bayer's thresholds of the pixel at (x, y), any, in 16ths: each of 0…15 once over 4×4 pixels.
///
/// ```
/// use fixel::dither::sixteenth;
/// assert_eq!([(0, 0), (1, 1), (-1, 0), (4, 8)].map(sixteenth), [0, 4, 10, 0]);
/// ```
#[inline(always)]
pub fn sixteenth((x, y): (i32, i32)) -> u32 {
    // Four bits each, the first column lowest; a row's word stays where it is while a row is drawn.
    const BAYER: [u16; 4] = [0xa280, 0x6e4c, 0x91b3, 0x5d7f];
    // Always there: four rows.
    let row = BAYER.get((y & 3) as usize).copied().unwrap_or(0);
    (row as u32) >> ((x & 3) << 2) & 15
}

/// A colour of 8 bits a channel as RGB565 at the pixel (x, y).
///
/// ```
/// use fixel::dither::rgb565;
/// assert_eq!(rgb565([255, 0, 255], (3, 5)), 0xf81f);
/// // 132 is 16.047 of 31 levels: one pixel in sixteen is lighter.
/// let lighter = (0..16).filter(|i| rgb565([132, 0, 0], (i % 4, i / 4)) >> 11 == 17).count();
/// assert_eq!(lighter, 1);
/// ```
#[inline]
pub fn rgb565([red, green, blue]: [u8; 3], at: (i32, i32)) -> u16 {
    let threshold = sixteenth(at);
    let red = level(red, 31, threshold);
    let green = level(green, 63, threshold);
    (red << 11 | green << 5 | level(blue, 31, threshold)) as u16
}

/// The level of 0…`most` for a channel of 8 bits: floor(channel·most/255 + threshold).
#[inline(always)]
fn level(channel: u8, most: u32, threshold: u32) -> u32 {
    // In units of 1/255, with the threshold in the middle of its 16th; at most 63·255 + 247.
    let sum = channel as u32 * most + (((2 * threshold + 1) * 255) >> 5);
    // sum/255, exactly for all below 2^16.
    (sum + 1 + (sum >> 8)) >> 8
}

/// A colour for RGB565 as [`Color565`](crate::varying::Color565) and [`Linear`](crate::varying::Linear) carry it, in units of
/// 2^-16 of a level of 31, 63 and 31, at the pixel (x, y); *without* the half that
/// [`Gouraud565::corner`](crate::fragment::Gouraud565::corner) adds to round to nearest. What lies outside is taken as the
/// nearer end.
///
/// ```
/// use fixel::dither::rgb565_fine;
/// let quarter = [10 << 16, 20 << 16 | 0x4000, 0];
/// let greens: u32 = (0..16).map(|i| u32::from(rgb565_fine(quarter, (i % 4, i / 4)) >> 5 & 63)).sum();
/// assert_eq!(greens, 16 * 20 + 4);
/// ```
#[inline]
pub fn rgb565_fine([red, green, blue]: [i32; 3], at: (i32, i32)) -> u16 {
    let threshold = ((2 * sixteenth(at) + 1) << 11) as i32;
    let level = |channel: i32, most: i32| ((channel.clamp(0, most << 16) + threshold) >> 16) as u16;
    level(red, 31) << 11 | level(green, 63) << 5 | level(blue, 31)
}

/// A brightness of 0…255 as black or white at the pixel (x, y): n of 16 pixels are white for a brightness of n/16.
///
/// ```
/// use fixel::dither::one_bit;
/// assert!((0..16).all(|i| one_bit(255, (i, i)) && !one_bit(0, (i, i))));
/// assert_eq!((0..16).filter(|i| one_bit(128, (i % 4, i / 4))).count(), 8);
/// ```
#[inline]
pub fn one_bit(brightness: u8, at: (i32, i32)) -> bool {
    level(brightness, 1, sixteenth(at)) > 0
}
