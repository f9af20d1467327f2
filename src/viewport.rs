//! From clip space to the screen: one division, one rounding.

use core::marker::PhantomData;

use crate::clip::DepthRange;
use crate::edge::{SUBPIXELS, first_row};
use crate::error::Error;
use crate::num::product::{high, high_unsigned, product};
use crate::num::{Block, Word, near_reciprocal};
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
    /// Whether the view volume lies within the guard band. Only half a pixel can be missing.
    in_guard: bool,
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
            in_guard: true,
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
        let center = (self.center.0 - half, self.center.1 - half);
        let within = |center: i32, scale: i32| center.abs() + scale.abs() <= Self::LIMIT;
        Viewport {
            center,
            in_guard: within(center.0, self.scale.0) && within(center.1, self.scale.1),
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

    /// Whether the view volume lies within the guard band.
    #[inline]
    pub(crate) fn is_in_guard(&self) -> bool {
        self.in_guard
    }

    /// The planes of the guard band, right, below, left and above where y runs downwards: all distances of a point with w > 0
    /// are at least 0 where its position is within ±[`Word::GUARD`] px. Exact.
    pub(crate) fn guard_planes<T: Word>(&self) -> [[T; 4]; 4] {
        let ((x, y), (center_x, center_y)) = (self.scale, self.center);
        [
            [-x, 0, 0, Self::LIMIT - center_x],
            [0, -y, 0, Self::LIMIT - center_y],
            [x, 0, 0, Self::LIMIT + center_x],
            [0, y, 0, Self::LIMIT + center_y],
        ]
        .map(|plane| plane.map(T::from_i32))
    }

    /// Screen position in subpixels, rounded once to the nearest (a tie upwards), and depth in units of 2^-15 step of the
    /// 16-bit buffer, within 9 units with words of 32 bits and cut to a unit with 64. `None` unless w > 0. Positions are moved into the guard band and depths into their range, which the
    /// clipped ones leave by no more than rounding.
    pub fn place<T: Word>(&self, position: Block<T, 4>, range: DepthRange) -> Option<(i32, i32, i32)> {
        self.place_by(position, range, |v, w, twice_w, axis| {
            near_coordinate(v, w, twice_w, axis, Self::LIMIT)
        })
    }

    /// Whether a place lies inside the guard band, where [`place`](Self::place) has moved nothing.
    pub(crate) fn is_inside(&self, (x, y): (i32, i32)) -> bool {
        x.max(y) < Self::LIMIT && x.min(y) > -Self::LIMIT
    }

    /// As [`place`](Self::place), but positions are not moved into the guard band.
    pub(crate) fn place_anywhere<T: Word>(&self, position: Block<T, 4>, range: DepthRange) -> Option<(i32, i32, i32)> {
        self.place_by(position, range, coordinate)
    }

    #[inline(always)]
    fn place_by<T: Word>(
        &self,
        position: Block<T, 4>,
        range: DepthRange,
        coordinate: impl Fn(T, T, &T::Divisor, (i32, i32)) -> i32,
    ) -> Option<(i32, i32, i32)> {
        let [x, y, z, w] = position.mantissas();
        if w <= T::ZERO {
            return None;
        }
        let divisor = w.twice();
        let depth = match range {
            DepthRange::ZeroToOne => z.max(T::ZERO).min(w),
            DepthRange::MinusOneToOne => z.max(-w).min(w),
            DepthRange::Unlimited => T::ZERO,
        };
        Some((
            coordinate(x, w, &divisor, (self.scale.0, self.center.0)),
            coordinate(y, w, &divisor, (self.scale.1, self.center.1)),
            depth_of(depth, w, &divisor, range),
        ))
    }

    /// As [`place`](Self::place), for a position whose w is positive and that lies in the guard band and the range: nothing
    /// has to be moved.
    #[inline]
    pub(crate) fn place_inside<T: Word>(&self, position: Block<T, 4>, range: DepthRange) -> (i32, i32, i32) {
        let [x, y, z, w] = position.mantissas();
        let divisor = w.twice();
        let coordinate = |v, scale, center| T::quotient(rounded(v, scale, w), &divisor) + center;
        (
            coordinate(x, self.scale.0, self.center.0),
            coordinate(y, self.scale.1, self.center.1),
            depth_of(z, w, &divisor, range),
        )
    }

    /// As [`place`](Self::place), to the same bits, for a position in the view volume, where that lies in the guard band: by
    /// one reciprocal. `mantissas` are below 2^31 and share any scale.
    ///
    /// About 50 instructions on Cortex-M4.
    #[inline(always)]
    pub(crate) fn place_in_volume(&self, mantissas: [i32; 4], scale: DepthScale) -> (i32, i32, i32) {
        let [x, y, z, w] = mantissas;
        let ratio = Ratio::over(w);
        let (x_ratio, y_ratio) = (ratio.of(x), ratio.of(y));
        let depth = scale.depth(&ratio, z);
        if let (Some(x), Some(y)) = (
            nearest::<W>(x_ratio, self.scale.0, self.center.0),
            nearest::<W>(y_ratio, self.scale.1, self.center.1),
        ) {
            return (x, y, depth);
        }
        let (x, y) = self.between_subpixels(x, y, w);
        (x, y, depth)
    }

    /// Too near to the middle between two subpixels for a reciprocal to tell.
    #[cold]
    #[inline(never)]
    fn between_subpixels(&self, x: i32, y: i32, w: i32) -> (i32, i32) {
        let divisor = w.twice();
        let coordinate = |v, scale, center| i32::quotient(rounded(v, scale, w), &divisor) + center;
        (
            coordinate(x, self.scale.0, self.center.0),
            coordinate(y, self.scale.1, self.center.1),
        )
    }
}

/// What takes numbers v, |v| ≤ w, to v/w in units of 2^-29.
struct Ratio {
    reciprocal: i32,
    shift: u32,
}

impl Ratio {
    /// w in 1…2^31−1.
    #[inline(always)]
    fn over(w: i32) -> Self {
        let w = w as u32;
        let zeros = w.leading_zeros();
        Ratio {
            reciprocal: near_reciprocal(w.wrapping_shl(zeros)),
            // For a bit less, which is the sign's.
            shift: zeros.wrapping_sub(1),
        }
    }

    /// Within 2 1/8 units of the true ratio, and its magnitude no larger than 2^29: of what the reciprocal is too small
    /// 1 1/8 unit is left here (its test says so), and the product is rounded down.
    #[inline(always)]
    fn of(&self, v: i32) -> i32 {
        high(v.wrapping_shl(self.shift), self.reciprocal)
    }
}

/// The subpixel nearest to ratio · scale + center, unless another is as near but for the error of the ratio.
#[inline(always)]
fn nearest<W: Word>(ratio: i32, scale: i32, center: i32) -> Option<i32> {
    // In units of 2^-32 the ratio's error is 17 · scale at most.
    let error = 17 * (W::GUARD * SUBPIXELS) as u32;
    // Below 2^29 · 2^26.
    let wide = ((center as i64) << 32) + (1 << 31) + product(ratio, scale << 3);
    let from_middle = (wide as u32).wrapping_add(error);
    (from_middle >= 2 * error).then_some((wide >> 32) as i32)
}

/// A [`DepthRange`] as numbers, so that nothing is decided vertex by vertex.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DepthScale {
    /// All bits where depths count.
    counts: i32,
    /// All bits where they begin at −1.
    from_minus_one: i32,
    /// What takes a ratio in units of 2^-29, from the least on, to the whole of 32 bits.
    bits: u32,
}

impl DepthScale {
    #[inline(always)]
    pub(crate) fn new(range: DepthRange) -> Self {
        let (counts, from_minus_one, bits) = match range {
            DepthRange::ZeroToOne => (-1, 0, 2),
            DepthRange::MinusOneToOne => (-1, -1, 1),
            DepthRange::Unlimited => (0, 0, 0),
        };
        DepthScale {
            counts,
            from_minus_one,
            bits,
        }
    }

    /// Whether a point with coordinates below 2^30 lies in the view volume.
    #[inline(always)]
    pub(crate) fn is_in_volume(&self, [x, y, z, w]: [i32; 4]) -> bool {
        let least = w & self.from_minus_one;
        // Nothing negative is left above −w, and 0…2w is no more than 31 bits.
        let within = |v: i32, least: i32| v.wrapping_add(least) as u32 <= w.wrapping_add(least) as u32;
        w > 0 && within(x, w) && within(y, w) && within(z & self.counts, least)
    }

    /// Depth in units of 2^-15 step, of a z in the range: within 9 units.
    #[inline(always)]
    fn depth(&self, ratio: &Ratio, z: i32) -> i32 {
        let ratio = ratio.of(z & self.counts).wrapping_add(self.from_minus_one & 1 << 29);
        // 65535·2^15 per unit of z/w over 0…1.
        high_unsigned((ratio as u32).wrapping_shl(self.bits), 65535 << 16) as i32
    }
}

/// Subpixels beyond which nothing is divided; just short of 2^31.
const FARTHEST: i32 = i32::MAX - 16;

/// Twice a coordinate's distance from the center, times w, and the half that makes rounding down round to nearest.
#[inline(always)]
fn rounded<T: Word>(v: T, scale: i32, w: T) -> T::Wide {
    let distance = v.times(T::from_i32(scale));
    distance + distance + w.widen()
}

/// v/w in subpixels, to the nearest, within ±`limit`, which is at most 2^23.
///
/// A function of its own: it is called for both coordinates.
#[inline(never)]
fn near_coordinate<T: Word>(v: T, w: T, twice_w: &T::Divisor, (scale, center): (i32, i32), limit: i32) -> i32 {
    let numerator = rounded(v, scale, w);
    // A quotient of 2^26, beyond any limit from any center.
    let far = w.widen() << (FAR + 1);
    let from_center = if numerator >= far {
        1 << FAR
    } else if numerator < -far {
        -1 << FAR
    } else {
        T::quotient(numerator, twice_w)
    };
    (from_center + center).clamp(-limit, limit)
}

/// See [`near_coordinate`].
const FAR: u32 = 26;

/// v/w in subpixels, to the nearest, however far.
#[inline(never)]
fn coordinate<T: Word>(v: T, w: T, twice_w: &T::Divisor, (scale, center): (i32, i32)) -> i32 {
    let limit = i32::MAX;
    let from_center = rounded(v, scale, w);
    let numerator = from_center + T::from_i32(center).times(w) + T::from_i32(center).times(w);
    // So far out that the quotient might not fit.
    let far = T::from_i32(FARTHEST).times(w) + T::from_i32(FARTHEST).times(w);
    if numerator >= far {
        return limit;
    }
    if numerator < -far {
        return -limit;
    }
    T::large_quotient(numerator, twice_w).clamp(-limit, limit)
}

/// Depth in units of 2^-15 step, for a z in the range.
#[inline(always)]
fn depth_of<T: Word>(z: T, w: T, twice_w: &T::Divisor, range: DepthRange) -> i32 {
    if let Some((reciprocal, shift)) = T::reciprocal(twice_w) {
        return DepthScale::new(range).depth(&Ratio { reciprocal, shift }, z.low_i32());
    }
    // 65535·2^15 per unit of z/w over 0…1.
    let full = T::from_i32(65535 << 15);
    match range {
        DepthRange::ZeroToOne => {
            let depth = z.times(full);
            T::large_quotient(depth + depth, twice_w)
        }
        // Each of the two products is below 2^61.
        DepthRange::MinusOneToOne => T::large_quotient(z.times(full) + w.times(full), twice_w),
        DepthRange::Unlimited => 0,
    }
}
