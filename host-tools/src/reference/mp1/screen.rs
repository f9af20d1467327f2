//! From clip coordinates to samples of the picture (formats/mp1.md section 4).

use std::array;

use super::clip::Corner;
use crate::reference::raster::{self, Q, REST};
use crate::scene::mp1::Scene;

/// X and Y in samples, Z, and over w with `hyp`: 1, red, green, blue, alpha, s, t.
pub type Point = raster::Point<10>;

/// How large the picture is and how values are interpolated on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screen {
    /// Pixels in a row and in a column.
    pub size: [f64; 2],
    /// Samples per pixel in each direction.
    pub fsaa: f64,
    /// Whether values are interpolated in perspective.
    pub hyp: bool,
}

impl Screen {
    /// The screen that a scene asks for.
    pub fn new(scene: &Scene) -> Self {
        Self {
            size: [f64::from(scene.width), f64::from(scene.height)],
            fsaa: f64::from(scene.switches.fsaa),
            hyp: scene.switches.hyp,
        }
    }

    /// Where a corner lands; none if w is 0 or nothing finite comes of it.
    pub fn place(&self, corner: &Corner) -> Option<Point> {
        let [x, y, z, w, rest @ ..] = *corner;
        let place = |v: f64, size: f64| (v / w + 1.0) * self.fsaa * size / 2.0;
        // Without `hyp` values are divided by 1, here and at the pixel, which changes no bit of them.
        let divisor = if self.hyp { w } else { 1.0 };
        let [r, g, b, alpha, s, t] = rest.map(|value| value / divisor);
        let [px, py] = [place(x, self.size[0]), place(y, self.size[1])];
        let point = [px, py, z / w, 1.0 / divisor, r, g, b, alpha, s, t];
        (w != 0.0 && point.iter().all(|value| value.is_finite())).then_some(point)
    }
}

/// A sample's red, green, blue, alpha, s, t: freed from 1/w. None where the interpolation led to nothing finite, as it does
/// where 1/w is 0. Alpha is kept to 0…1, which it would leave where w has both signs: *over* has no meaning for it there.
pub fn values(point: &Point) -> Option<[f64; 6]> {
    let mut values: [f64; 6] = array::from_fn(|i| point[REST + i] / point[Q]);
    let finite = point.iter().chain(&values).all(|value| value.is_finite());
    let [_, _, _, alpha, _, _] = &mut values;
    *alpha = alpha.clamp(0.0, 1.0);
    finite.then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(position: [f64; 4]) -> Corner {
        let [x, y, z, w] = position;
        [x, y, z, w, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
    }

    #[test]
    fn the_example_of_the_format() {
        let screen = Screen {
            size: [20.0, 30.0],
            fsaa: 1.0,
            hyp: false,
        };
        for (position, expected) in [
            ([1.0, 3.5, 3.0, 4.0], [12.5, 28.125, 0.75]),
            ([-1.0, -2.0, -3.0, 4.0], [7.5, 7.5, -0.75]),
            ([2.0, 0.0, 0.0, 2.0], [20.0, 15.0, 0.0]),
        ] {
            let point = screen.place(&corner(position)).expect("a place");
            assert_eq!(point[..3], expected);
        }
        let fsaa = Screen { fsaa: 4.0, ..screen };
        let point = fsaa.place(&corner([1.0, 3.5, 3.0, -4.0])).expect("a place");
        assert_eq!(point[..3], [30.0, 7.5, -0.75]);
    }

    #[test]
    fn hyp_divides_the_values_and_not_the_depth() {
        let screen = |hyp| Screen {
            size: [8.0, 8.0],
            fsaa: 1.0,
            hyp,
        };
        let at = corner([0.0, 0.0, 1.0, 2.0]);
        let [plain, divided] = [false, true].map(|hyp| screen(hyp).place(&at).expect("a place"));
        assert_eq!(plain[2..5], [0.5, 1.0, 0.1]);
        assert_eq!(divided[2..5], [0.5, 0.5, 0.05]);
        assert_eq!(
            [plain, divided].map(|point| values(&point)),
            [Some([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]); 2]
        );
    }

    #[test]
    fn what_has_no_place_is_none() {
        let screen = Screen {
            size: [8.0, 8.0],
            fsaa: 16.0,
            hyp: false,
        };
        for position in [
            [1.0, 0.0, 0.0, 0.0],
            [0.0; 4],
            [1e308, 0.0, 0.0, 1e-10],
            [1e308, 0.0, 0.0, 1.0],
        ] {
            assert_eq!(screen.place(&corner(position)), None, "{position:?}");
        }
    }
}
