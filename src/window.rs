//! A rectangle of the picture.

/// The columns `left..right` and rows `top..bottom` of a picture: all of it, a strip, a tile.
///
/// ```
/// use fixel::window::Window;
/// let picture = Window::new(0, 0, 320, 240);
/// let strip = Window::new(0, 16, 320, 32);
/// assert_eq!(picture.intersect(strip), strip);
/// assert!(strip.intersect(Window::new(0, 0, 320, 16)).is_empty());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    /// First column.
    pub left: i32,
    /// First row.
    pub top: i32,
    /// The column after the last.
    pub right: i32,
    /// The row after the last.
    pub bottom: i32,
}

impl Window {
    /// Columns `left..right` and rows `top..bottom`.
    pub const fn new(left: i32, top: i32, right: i32, bottom: i32) -> Self {
        Window {
            left,
            top,
            right,
            bottom,
        }
    }

    /// What both hold.
    pub fn intersect(self, other: Self) -> Self {
        Window {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.min(other.right),
            bottom: self.bottom.min(other.bottom),
        }
    }

    /// Whether it holds the pixel (x, y).
    pub fn contains(self, (x, y): (i32, i32)) -> bool {
        (self.left..self.right).contains(&x) && (self.top..self.bottom).contains(&y)
    }

    /// Whether it holds no pixel.
    pub fn is_empty(self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }

    /// Columns, 0 where empty.
    pub fn width(self) -> usize {
        self.right.saturating_sub(self.left).max(0) as usize
    }

    /// Rows, 0 where empty.
    pub fn height(self) -> usize {
        self.bottom.saturating_sub(self.top).max(0) as usize
    }
}
