//! Cohen and Sutherland's cutting of lines to a rectangle of the screen.
//!
//! [`lines`](super::lines) are cut by advancing Bresenham's error term instead, which moves no pixel; this is for users.

/// A rectangle whose borders belong to it, in any unit: 1/65536 px, say.
///
/// ```
/// use fixel::pipeline::Region;
/// let region = Region { left: 60, bottom: 60, right: 240, top: 240 };
/// assert_eq!(region.code((59, 59)), Region::LEFT | Region::BOTTOM);
/// assert_eq!(region.code((60, 240)), 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    /// Least x.
    pub left: i32,
    /// Least y.
    pub bottom: i32,
    /// Largest x.
    pub right: i32,
    /// Largest y.
    pub top: i32,
}

impl Region {
    /// x below the left border.
    pub const LEFT: u8 = 1;
    /// x above the right border.
    pub const RIGHT: u8 = 2;
    /// y above the top border.
    pub const TOP: u8 = 4;
    /// y below the bottom border.
    pub const BOTTOM: u8 = 8;

    /// Where a point lies: 0 inside, or one or two of the four bits.
    pub const fn code(&self, (x, y): (i32, i32)) -> u8 {
        let across = if x < self.left {
            Self::LEFT
        } else if x > self.right {
            Self::RIGHT
        } else {
            0
        };
        let up = if y < self.bottom {
            Self::BOTTOM
        } else if y > self.top {
            Self::TOP
        } else {
            0
        };
        across | up
    }
}

/// The part of a line within a region; `None` for nothing. Cuts are rounded to nearest, once or twice per end.
///
/// ```
/// use fixel::pipeline::{Region, clip_to_region};
/// let screen = Region { left: 0, bottom: 0, right: 299, top: 299 };
/// assert_eq!(clip_to_region(&screen, [(-100, 50), (400, 200)]), Some([(0, 80), (299, 170)]));
/// assert_eq!(clip_to_region(&screen, [(-100, 200), (-100, 400)]), None);
/// ```
pub fn clip_to_region(region: &Region, [mut a, mut b]: [(i32, i32); 2]) -> Option<[(i32, i32); 2]> {
    // Every cut puts an end on a border, and rounding leaves it between the ends: four are enough.
    for _ in 0..=4 {
        let (code_a, code_b) = (region.code(a), region.code(b));
        if code_a | code_b == 0 {
            return Some([a, b]);
        }
        if code_a & code_b != 0 {
            return None;
        }
        if code_a > code_b {
            a = cut(region, code_a, a, b);
        } else {
            b = cut(region, code_b, a, b);
        }
    }
    None
}

/// Where the line crosses the border that `code` names, the first of top, bottom, right and left.
fn cut(region: &Region, code: u8, a: (i32, i32), b: (i32, i32)) -> (i32, i32) {
    let turned = |(x, y): (i32, i32)| (y, x);
    if code & Region::TOP != 0 {
        turned(at(turned(a), turned(b), region.top))
    } else if code & Region::BOTTOM != 0 {
        turned(at(turned(a), turned(b), region.bottom))
    } else if code & Region::RIGHT != 0 {
        at(a, b, region.right)
    } else {
        at(a, b, region.left)
    }
}

/// The point of the line at `x`, which lies between its ends.
fn at(a: (i32, i32), b: (i32, i32), x: i32) -> (i32, i32) {
    let (mut dx, mut dy) = (b.0 as i128 - a.0 as i128, b.1 as i128 - a.1 as i128);
    if dx < 0 {
        (dx, dy) = (-dx, -dy);
    }
    let numerator = 2 * (x as i128 - a.0 as i128) * dy + dx;
    let y = a.1 as i128 + numerator.checked_div_euclid(2 * dx).unwrap_or(0);
    (x, y as i32)
}
