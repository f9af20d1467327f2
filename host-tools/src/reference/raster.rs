//! The triangle walk in float64, in the order that the official pictures show (formats/hw2.md sections 5 and 11,
//! formats/mp1.md sections 4 and 8).
//!
//! An edge is walked from its upper end: step = (B - A) / (By - Ay), first point A + step (row0 - Ay) with row0 the first
//! row inside the picture, then the step is added per row. A row is walked the same way from its left crossing. So a
//! triangle costs what is on the screen, however far away its corners are. Samples lie at integer coordinates, and
//! "from ceil(first) to before the end" is the fill rule: left and top are in, right and bottom are out.

/// What is interpolated linearly on the screen: X and Y in pixels, Z, 1/w, and what else there is, over w.
pub type Point<const N: usize> = [f64; N];

/// Index of X in a [`Point`].
pub const X: usize = 0;
/// Index of Y in a [`Point`].
pub const Y: usize = 1;
/// Index of Z in a [`Point`].
pub const Z: usize = 2;
/// Index of 1/w in a [`Point`].
pub const Q: usize = 3;
/// Index of the first of the rest in a [`Point`].
pub const REST: usize = 4;

/// Visits every covered sample of the picture, row by row: column, row, and the interpolated point.
pub fn walk<const N: usize>(
    corners: &[Point<N>; 3],
    width: u32,
    height: u32,
    mut visit: impl FnMut(usize, usize, &Point<N>),
) {
    let mut sorted = *corners;
    sorted.sort_by(|a, b| a[Y].total_cmp(&b[Y]));
    let [top, middle, bottom] = sorted;
    let mut long = Walk::new(&top, &bottom, Y, height);
    for (from, to) in [(&top, &middle), (&middle, &bottom)] {
        let short = Walk::new(from, to, Y, height);
        // The short edge is asked first: when it ends, the long one must not have been advanced.
        for ((row, a), (_, b)) in short.zip(long.by_ref()) {
            let (left, right) = if a[X] <= b[X] { (a, b) } else { (b, a) };
            for (column, point) in Walk::new(&left, &right, X, width) {
                visit(column, row, &point);
            }
        }
    }
}

/// The whole coordinates from `from` up to before `to` along one axis, clipped to `0..limit`, and the point at each.
#[derive(Debug, Clone)]
pub struct Walk<const N: usize> {
    point: Point<N>,
    step: Point<N>,
    at: f64,
    end: f64,
}

impl<const N: usize> Walk<N> {
    /// A walk along `axis`, [`X`] or [`Y`].
    pub fn new(from: &Point<N>, to: &Point<N>, axis: usize, limit: u32) -> Self {
        let at = from[axis].ceil().max(0.0);
        let end = to[axis].min(f64::from(limit));
        let span = to[axis] - from[axis];
        let mut step = *from;
        let mut point = *from;
        for i in 0..N {
            step[i] = (to[i] - from[i]) / span;
            point[i] = from[i] + step[i] * (at - from[axis]);
        }
        Self { point, step, at, end }
    }
}

impl<const N: usize> Iterator for Walk<N> {
    type Item = (usize, Point<N>);

    fn next(&mut self) -> Option<Self::Item> {
        if self.at < self.end {
            let item = (self.at as usize, self.point);
            for (value, step) in self.point.iter_mut().zip(self.step) {
                *value += step;
            }
            self.at += 1.0;
            Some(item)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(corners: [[f64; 2]; 3]) -> String {
        let mut picture = vec![vec!['.'; 5]; 5];
        let corners = corners.map(|[x, y]| [x, y, 0.0, 1.0, 0.0, 0.0, 0.0]);
        walk(&corners, 5, 5, |x, y, _| {
            assert_eq!(picture[y][x], '.', "visited twice");
            picture[y][x] = '#';
        });
        let rows: Vec<String> = picture.iter().map(|row| row.iter().collect()).collect();
        rows.join(" ")
    }

    #[test]
    fn left_and_top_edges_are_in_right_and_bottom_out() {
        assert_eq!(
            covered([[1.0, 1.0], [4.0, 1.0], [1.0, 4.0]]),
            "..... .###. .##.. .#... ....."
        );
        assert_eq!(
            covered([[4.0, 1.0], [4.0, 4.0], [1.0, 4.0]]),
            "..... ..... ...#. ..##. ....."
        );
    }

    #[test]
    fn the_order_of_the_corners_does_not_matter() {
        let [a, b, c] = [[0.5, 0.25], [4.5, 1.75], [2.25, 4.5]];
        let expected = covered([a, b, c]);
        for corners in [[b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]] {
            assert_eq!(covered(corners), expected);
        }
    }

    #[test]
    fn enormous_triangles_cover_the_screen_and_end() {
        assert_eq!(
            covered([[-1e12, -1e12], [3e12, -1e12], [-1e12, 3e12]]),
            "##### ##### ##### ##### #####"
        );
        assert_eq!(
            covered([[1e12, 0.0], [2e12, 0.0], [1e12, 9e11]]),
            "..... ..... ..... ..... ....."
        );
    }

    #[test]
    fn no_area_covers_nothing() {
        assert_eq!(
            covered([[0.0, 0.0], [2.0, 2.0], [4.0, 4.0]]),
            "..... ..... ..... ..... ....."
        );
        assert_eq!(
            covered([[0.0, 2.0], [2.0, 2.0], [4.0, 2.0]]),
            "..... ..... ..... ..... ....."
        );
    }

    #[test]
    fn values_are_linear() {
        let corner = |x: f64, y: f64| [x, y, 2.0 * x - y, 1.0, x, y, 1.0];
        let corners = [corner(0.0, 0.0), corner(5.0, 1.0), corner(1.0, 5.0)];
        walk(&corners, 5, 5, |x, y, p| {
            let expected = corner(x as f64, y as f64);
            assert!(p.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{p:?}");
        });
    }
}
