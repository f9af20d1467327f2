//! Where pixels go: rows in, slices out, any pixel type.

use core::hint::black_box;

use crate::error::Error;
use crate::window::Window;

/// A picture, or a rectangle of one, that lends its rows.
///
/// Positions are those of the whole picture: a target that holds rows 16 to 31 is asked for row 16 first. That is why a
/// picture drawn strip by strip has the same bits as one drawn whole.
///
/// A complete implementation by a user, for a panel whose upper and lower half are separate buffers:
///
/// ```
/// use fixel::{target::Target, window::Window};
///
/// struct SplitPanel {
///     upper: [u16; 16 * 8],
///     lower: [u16; 16 * 8],
/// }
///
/// impl Target for SplitPanel {
///     type Pixel = u16;
///
///     fn window(&self) -> Window {
///         Window::new(0, 0, 16, 16)
///     }
///
///     fn row(&mut self, row: i32) -> &mut [u16] {
///         let half = if row < 8 { &mut self.upper } else { &mut self.lower };
///         let start = (row as usize % 8) * 16;
///         half.get_mut(start..start + 16).unwrap_or_default()
///     }
/// }
///
/// use fixel::{depth::NoDepth, draw, fragment::Flat, screen::Position};
/// let mut panel = SplitPanel { upper: [0; 128], lower: [0; 128] };
/// let corners = [(2, 2), (2, 14), (14, 2)].map(|(x, y)| Position::from_pixels(x, y));
/// draw::triangle(&mut panel, &mut NoDepth, corners.map(|p| p.flat()), &Flat(7));
/// assert_eq!(panel.upper[2 * 16 + 2], 7);
/// assert_eq!(panel.lower[0 * 16 + 2], 7);
/// ```
pub trait Target {
    /// Anything that can be copied: RGB565 words, bytes, an own struct.
    type Pixel: Copy;

    /// The rows and columns of the picture that are here.
    fn window(&self) -> Window;

    /// The pixels of `row` from the window's left to its right; `row` is one of the window's. A shorter slice is allowed
    /// and loses what lies beyond its end.
    fn row(&mut self, row: i32) -> &mut [Self::Pixel];

    /// The pixels `left..right` of `row`, all of them the window's: what [`row`](Self::row) gives of them, unless a target
    /// knows a shorter way.
    #[inline(always)]
    fn span(&mut self, row: i32, left: i32, right: i32) -> &mut [Self::Pixel] {
        // Wrapping keeps windows of any size from overflowing.
        let skip = left.wrapping_sub(self.window().left) as u32 as usize;
        let count = right.wrapping_sub(left) as u32 as usize;
        self.row(row)
            .get_mut(skip..)
            .and_then(|rest| rest.get_mut(..count))
            .unwrap_or_default()
    }

    /// All pixels of the window, from its first to its last, with what lies between its rows, and how many there are from one
    /// row to the next. `None` where rows do not lie at one distance; what is drawn there is drawn faster where they do.
    #[inline(always)]
    fn block(&mut self) -> Option<(&mut [Self::Pixel], usize)> {
        None
    }
}

/// A borrowed target, where several are put together in a tuple.
impl<C: Target + ?Sized> Target for &mut C {
    type Pixel = C::Pixel;

    #[inline(always)]
    fn window(&self) -> Window {
        (**self).window()
    }
    #[inline(always)]
    fn row(&mut self, row: i32) -> &mut [C::Pixel] {
        (**self).row(row)
    }
    #[inline(always)]
    fn span(&mut self, row: i32, left: i32, right: i32) -> &mut [C::Pixel] {
        (**self).span(row, left, right)
    }
    #[inline(always)]
    fn block(&mut self) -> Option<(&mut [C::Pixel], usize)> {
        (**self).block()
    }
}

/// Rows in a slice, `stride` pixels apart: a whole picture, or a strip or tile of a larger one.
///
/// ```
/// use fixel::{target::{Buffer, Target}, window::Window};
/// let mut memory = [0u16; 320 * 16];
/// // The second of fifteen strips of a 320×240 picture.
/// let mut strip = Buffer::strip(&mut memory, Window::new(0, 16, 320, 32))?;
/// assert_eq!(strip.row(16).len(), 320);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Buffer<'a, P> {
    /// Those of the window and no more, so that two buffers of one window and stride are of one length.
    pixels: &'a mut [P],
    stride: usize,
    window: Window,
}

impl<'a, P: Copy> Buffer<'a, P> {
    /// A whole picture of `width` × `height` pixels, row after row.
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`] where `pixels` holds fewer; [`Error::TooLarge`] beyond 32768 pixels a side.
    #[inline]
    pub fn new(pixels: &'a mut [P], width: u16, height: u16) -> Result<Self, Error> {
        // As `with_stride` would find, by a comparison each: what most pictures are made by takes little flash.
        if width.max(height) > 32768 {
            return Err(Error::TooLarge);
        }
        let stride = width as usize;
        // At most 2^30.
        let pixels = pixels
            .get_mut(..stride * height as usize)
            .ok_or(Error::BufferTooSmall)?;
        let window = Window::new(0, 0, width as i32, height as i32);
        Ok(Buffer { pixels, stride, window })
    }

    /// The part `window` of a picture, row after row.
    ///
    /// # Errors
    /// As [`with_stride`](Self::with_stride).
    pub fn strip(pixels: &'a mut [P], window: Window) -> Result<Self, Error> {
        Self::with_stride(pixels, window.width(), window)
    }

    /// The part `window` of a picture, its rows `stride` pixels apart.
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`] where `pixels` is too short or `stride` less than the width, [`Error::TooLarge`] for a
    /// window with a side beyond ±32768.
    pub fn with_stride(pixels: &'a mut [P], stride: usize, window: Window) -> Result<Self, Error> {
        let Window {
            left,
            top,
            right,
            bottom,
        } = window;
        if [left, top, right, bottom]
            .iter()
            .any(|side| side.unsigned_abs() > 32768)
        {
            return Err(Error::TooLarge);
        }
        let rows_before_last = window.height().saturating_sub(1);
        let needed = stride
            .checked_mul(rows_before_last)
            .and_then(|n| n.checked_add(window.width()));
        if stride < window.width() {
            return Err(Error::BufferTooSmall);
        }
        let pixels = if window.is_empty() {
            &mut []
        } else {
            needed
                .and_then(|needed| pixels.get_mut(..needed))
                .ok_or(Error::BufferTooSmall)?
        };
        Ok(Buffer { pixels, stride, window })
    }
}

impl<P: Copy> Target for Buffer<'_, P> {
    type Pixel = P;

    #[inline(always)]
    fn window(&self) -> Window {
        self.window
    }

    #[inline(always)]
    fn row(&mut self, row: i32) -> &mut [P] {
        // Rows off the window wrap to a start that is past the end, or hold other pixels of the same buffer.
        let start = (row.wrapping_sub(self.window.top) as usize).wrapping_mul(self.stride);
        let width = self.window.right.wrapping_sub(self.window.left) as usize;
        self.pixels
            .get_mut(start..)
            .and_then(|rest| rest.get_mut(..width))
            .unwrap_or_default()
    }

    #[inline(always)]
    fn span(&mut self, row: i32, left: i32, right: i32) -> &mut [P] {
        // Two bounds instead of the four by way of the row.
        let start = (row.wrapping_sub(self.window.top) as usize).wrapping_mul(self.stride);
        let start = start.wrapping_add(left.wrapping_sub(self.window.left) as u32 as usize);
        let count = right.wrapping_sub(left) as u32 as usize;
        if start > self.pixels.len() {
            return nothing();
        }
        match self.pixels.get_mut(start..).and_then(|rest| rest.get_mut(..count)) {
            Some(pixels) => pixels,
            None => nothing(),
        }
    }

    #[inline(always)]
    fn block(&mut self) -> Option<(&mut [P], usize)> {
        Some((self.pixels, self.stride))
    }
}

/// Out of the way: what is there is a comparison and no selection, which a compiler that sees through this would make of it.
#[cold]
#[inline(never)]
fn nothing<'a, P>() -> &'a mut [P] {
    black_box(());
    &mut []
}
