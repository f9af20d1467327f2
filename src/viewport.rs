//! From clip space to the screen: one division, one rounding.

use core::marker::PhantomData;

use crate::clip::DepthRange;
use crate::edge::{SUBPIXELS, first_row};
use crate::error::Error;
use crate::num::{Block, Wide, Word};
use crate::window::Window;

/// Where on the picture the view volume's x and y of −1…1 go, and where the samples of the pixels lie.
///
/// `W` is the word of the edge walk: `i32` for pictures within ±4096 px, `i64` within ±32768 px.
///
/// ```
/// use fixel::{num::Block, viewport::Viewport, clip::DepthRange};
/// let viewport = Viewport::<i32>::new(0, 0, 320, 240)?;
/// // y = −1 is the top row unless `y_up` says otherwise.
/// let corner = Block::<i32, 4>::from_integers([-1, -1, 0, 1]);
/// assert_eq!(viewport.place(corner, DepthRange::ZeroToOne), Some((0, 0, 0)));
/// assert_eq!(viewport.y_up().place(corner, DepthRange::ZeroToOne), Some((0, 240 * 256, 0)));
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Viewport<W> {
    /// Subpixels per unit of x/w and y/w.
    scale: (i32, i32),
    /// Position of x = y = 0 in subpixels.
    center: (i32, i32),
    word: PhantomData<W>,
}

impl<W: Word> Viewport<W> {
    const LIMIT: i32 = W::GUARD * SUBPIXELS;

    /// The rectangle `width` × `height` at (`left`, `top`), y downwards, samples at whole coordinates (HW2, MP1).
    ///
    /// # Errors
    /// [`Error::TooLarge`] where it reaches beyond ±[`Word::GUARD`] px.
    pub fn new(left: i32, top: i32, width: u16, height: u16) -> Result<Self, Error> {
        let reach =
            |from: i32, size: u16| from.unsigned_abs() > W::GUARD as u32 || from.saturating_add(size as i32) > W::GUARD;
        if reach(left, width) || reach(top, height) {
            return Err(Error::TooLarge);
        }
        let half = |size: u16| size as i32 * (SUBPIXELS / 2);
        let scale = (half(width), half(height));
        let center = (left * SUBPIXELS + scale.0, top * SUBPIXELS + scale.1);
        Ok(Viewport {
            scale,
            center,
            word: PhantomData,
        })
    }

    /// The same rectangle with y upwards.
    pub fn y_up(self) -> Self {
        Viewport {
            scale: (self.scale.0, -self.scale.1),
            ..self
        }
    }

    /// Samples in the middle of the pixels (`.iv`, OpenGL) instead of at their upper left corners.
    pub fn samples_at_centers(self) -> Self {
        let half = SUBPIXELS / 2;
        Viewport {
            center: (self.center.0 - half, self.center.1 - half),
            ..self
        }
    }

    /// The pixels whose samples lie in the rectangle.
    ///
    /// ```
    /// use fixel::{viewport::Viewport, window::Window};
    /// let half = Viewport::<i32>::new(160, 0, 160, 240)?.y_up().samples_at_centers();
    /// assert_eq!(half.window(), Window::new(160, 0, 320, 240));
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    pub fn window(&self) -> Window {
        let (half_width, half_height) = (self.scale.0, self.scale.1.abs());
        Window {
            left: first_row(self.center.0 - half_width),
            top: first_row(self.center.1 - half_height),
            right: first_row(self.center.0 + half_width),
            bottom: first_row(self.center.1 + half_height),
        }
    }

    /// Whether rows run against y.
    #[inline]
    pub(crate) fn is_y_up(&self) -> bool {
        self.scale.1 < 0
    }

    /// The distances of a point with w > 0 to the four sides of the guard band, up to a common factor: all at least 0
    /// where its position is within ±[`Word::GUARD`] px. Exact.
    #[inline]
    pub(crate) fn guard_distance<T: Word>(&self, position: [T; 4], side: usize) -> T::Wide {
        let [x, y, _, w] = position.map(T::widen);
        let (coordinate, scale, center) = if side & 1 == 0 {
            (x, self.scale.0, self.center.0)
        } else {
            (y, self.scale.1, self.center.1)
        };
        if side & 2 == 0 {
            w.times_small(Self::LIMIT - center) - coordinate.times_small(scale)
        } else {
            w.times_small(Self::LIMIT + center) + coordinate.times_small(scale)
        }
    }

    /// Screen position in subpixels, rounded once to the nearest (a tie upwards), and depth in units of 2^-15 step of the
    /// 16-bit buffer. `None` unless w > 0. Positions are moved into the guard band and depths into their range, which the
    /// clipped ones leave by no more than rounding.
    #[inline]
    pub fn place<T: Word>(&self, position: Block<T, 4>, range: DepthRange) -> Option<(i32, i32, i32)> {
        self.place_within(position, range, Self::LIMIT)
    }

    /// As [`place`](Self::place), but positions are moved to within ±`limit` subpixels.
    #[inline]
    pub(crate) fn place_within<T: Word>(
        &self,
        position: Block<T, 4>,
        range: DepthRange,
        limit: i32,
    ) -> Option<(i32, i32, i32)> {
        let [x, y, z, w] = position.mantissas().map(T::widen);
        if w <= T::Wide::ZERO {
            return None;
        }
        let twice = w + w;
        let coordinate = |v: T::Wide, scale, center| {
            let numerator = v.times_small(scale) + w.times_small(center);
            let rounded = (numerator + numerator + w).div_floor(twice);
            let limit = T::from_i32(limit).widen();
            rounded.max(-limit).min(limit).narrow().low_i32()
        };
        // 65535·2^15 per unit of z/w over 0…1.
        const FULL: i32 = 65535 << 15;
        let depth = match range {
            DepthRange::ZeroToOne => z.times_small(FULL).div_floor(w),
            DepthRange::MinusOneToOne => (z + w).times_small(FULL).div_floor(twice),
            DepthRange::Unlimited => T::Wide::ZERO,
        };
        let depth = depth
            .max(T::Wide::ZERO)
            .min(T::from_i32(FULL).widen())
            .narrow()
            .low_i32();
        let (x, y) = (
            coordinate(x, self.scale.0, self.center.0),
            coordinate(y, self.scale.1, self.center.1),
        );
        Some((x, y, depth))
    }
}
