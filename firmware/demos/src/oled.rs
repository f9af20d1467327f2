//! A panel of 128×64 pixels, black and white, that is written in pages of eight rows (SSD1306 and many others).

/// Columns.
pub const WIDTH: u16 = 128;
/// Rows.
pub const HEIGHT: u16 = 64;
/// Rows of a page.
pub const ROWS: usize = 8;
/// Pixels of a page.
pub const PAGE: usize = WIDTH as usize * ROWS;

/// Where pages go: byte x has column x, its uppermost pixel in the lowest bit.
pub trait Oled {
    /// Page `number`, 0…7 from the top.
    fn page(&mut self, number: u8, columns: &[u8; WIDTH as usize]);
}

/// Packs eight rows of pixels, lit where `lit` says so of (x, y, pixel); rows are those of the picture from `top` on.
pub fn pack<P: Copy>(pixels: &[P], top: i32, lit: impl Fn(usize, usize, P) -> bool) -> [u8; WIDTH as usize] {
    let mut columns = [0; WIDTH as usize];
    for (row, pixels) in pixels.chunks(WIDTH.into()).enumerate() {
        for (x, (column, &pixel)) in columns.iter_mut().zip(pixels).enumerate() {
            *column |= (lit(x, top as usize + row, pixel) as u8) << (row & 7);
        }
    }
    columns
}
