//! Bresenham's line, clipped without moving its ends.
//!
//! A line from A to B steps along its longer axis (x where they are equal) and lights, at every step, the pixel nearest to
//! it; exactly between two, the one below or to the right, so that a line drawn backwards lights the same pixels. The last
//! end is left out: a chain of lines draws its joints once.
//!
//! With L the longer and m the shorter extent, the pixel of step n is floor((2·n·m + L)/(2·L)) beside A: an integer
//! quotient whose remainder is Bresenham's error term. A window is reached by computing the first step inside it and the
//! error term there, so that a clipped line lights exactly the pixels of the whole one.

use crate::window::Window;

/// The pixels of a line; see the [module](self).
///
/// ```
/// use fixel::{line::Line, window::Window};
/// let whole: Vec<_> = Line::new((0, 0), (5, 2), Window::new(0, 0, 8, 8)).collect();
/// assert_eq!(whole, [(0, 0), (1, 0), (2, 1), (3, 1), (4, 2)]);
/// let part: Vec<_> = Line::new((0, 0), (5, 2), Window::new(0, 1, 4, 8)).collect();
/// assert_eq!(part, [(2, 1), (3, 1)]);
/// ```
#[derive(Debug, Clone)]
pub struct Line {
    /// Current pixel: along the longer and along the shorter axis.
    major: i32,
    minor: i32,
    /// 2·n·m + L less whole quotients: 0…2L−1.
    error: i32,
    error_step: i32,
    denominator: i32,
    direction: i32,
    x_is_major: bool,
    remaining: i32,
}

impl Line {
    /// The part on `window` of the line from the pixel `from` to the pixel `to`, which is left out.
    pub fn new(from: (i16, i16), to: (i16, i16), window: Window) -> Self {
        let wide = |(x, y): (i16, i16)| (x as i32, y as i32);
        Self::with_last(wide(from), wide(to), 0, window)
    }

    /// The part on `window` of the line from the pixel `from` to the pixel `to`, both drawn; coordinates within ±2^15.
    ///
    /// ```
    /// use fixel::{line::Line, window::Window};
    /// let window = Window::new(0, 0, 8, 8);
    /// let both: Vec<_> = Line::closed((0, 0), (4, 3), window).collect();
    /// assert_eq!(both, [(0, 0), (1, 1), (2, 2), (3, 2), (4, 3)]);
    /// assert_eq!(Line::closed((7, 7), (7, 7), window).count(), 1);
    /// ```
    pub fn closed(from: (i32, i32), to: (i32, i32), window: Window) -> Self {
        const FAR: i32 = 1 << 15;
        let within = |(x, y): (i32, i32)| (x.clamp(-FAR, FAR), y.clamp(-FAR, FAR));
        Self::with_last(within(from), within(to), 1, window)
    }

    /// With the last pixel if `last` is 1.
    fn with_last(from: (i32, i32), to: (i32, i32), last: i64, window: Window) -> Self {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let x_is_major = dx.abs() >= dy.abs();
        let (along, across, length, rise) = if x_is_major {
            (
                (from.0, window.left, window.right),
                (from.1, window.top, window.bottom),
                dx,
                dy,
            )
        } else {
            (
                (from.1, window.top, window.bottom),
                (from.0, window.left, window.right),
                dy,
                dx,
            )
        };
        let (major, first_major, end_major) = (along.0 as i64, along.1 as i64, along.2 as i64);
        let (minor, first_minor, end_minor) = (across.0 as i64, across.1 as i64, across.2 as i64);
        let direction = length.signum();
        let (length, rise) = (length.unsigned_abs() as i64, rise as i64);
        let denominator = 2 * length;

        // Steps whose longer coordinate is on the window.
        let (mut first, mut end) = if direction >= 0 {
            (first_major - major, end_major - major)
        } else {
            (major - end_major + 1, major - first_major + 1)
        };
        // Steps whose shorter coordinate is: it reaches v at the first n with 2·n·rise + L ≥ 2·L·(v − minor).
        let threshold = |v: i64| denominator * (v - minor) - length;
        match rise.signum() {
            1 => {
                first = first.max(ceil_div(threshold(first_minor), 2 * rise));
                end = end.min(ceil_div(threshold(end_minor), 2 * rise));
            }
            -1 => {
                first = first.max(floor_div(-threshold(end_minor), -2 * rise) + 1);
                end = end.min(floor_div(-threshold(first_minor), -2 * rise) + 1);
            }
            _ if minor < first_minor || minor >= end_minor => end = 0,
            _ => {}
        }
        let (first, end) = (first.max(0), end.min(length + last));
        let numerator = 2 * first * rise + length;
        let quotient = floor_div(numerator, denominator);
        Line {
            major: (major + direction as i64 * first) as i32,
            minor: (minor + quotient) as i32,
            error: (numerator - quotient * denominator) as i32,
            error_step: 2 * rise as i32,
            denominator: denominator as i32,
            direction,
            x_is_major,
            remaining: (end - first).max(0) as i32,
        }
    }
}

impl Iterator for Line {
    type Item = (i32, i32);

    #[inline]
    fn next(&mut self) -> Option<(i32, i32)> {
        if self.remaining == 0 {
            return None;
        }
        let pixel = if self.x_is_major {
            (self.major, self.minor)
        } else {
            (self.minor, self.major)
        };
        self.remaining -= 1;
        self.major += self.direction;
        self.error += self.error_step;
        if self.error >= self.denominator {
            self.error -= self.denominator;
            self.minor += 1;
        } else if self.error < 0 {
            self.error += self.denominator;
            self.minor -= 1;
        }
        Some(pixel)
    }
}

/// For a positive divisor; 0 for any other.
fn floor_div(a: i64, b: i64) -> i64 {
    a.checked_div_euclid(b).unwrap_or(0)
}

fn ceil_div(a: i64, b: i64) -> i64 {
    -floor_div(-a, b)
}
