//! Cutting lines at the borders of the screen (chapter 02), Cohen-Sutherland.

/// Left of the rectangle.
pub const LEFT: u8 = 1;
/// Right of it.
pub const RIGHT: u8 = 2;
/// Above it.
pub const TOP: u8 = 4;
/// Below it.
pub const BOTTOM: u8 = 8;

/// Columns and rows, first and last, that belong to the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// First and last column.
    pub x: [f64; 2],
    /// First and last row.
    pub y: [f64; 2],
}

impl Rectangle {
    /// Where a point lies; 0 is inside, borders included.
    pub fn code(&self, [x, y]: [f64; 2]) -> u8 {
        let column = if x < self.x[0] {
            LEFT
        } else if x > self.x[1] {
            RIGHT
        } else {
            0
        };
        let row = if y < self.y[0] {
            BOTTOM
        } else if y > self.y[1] {
            TOP
        } else {
            0
        };
        column | row
    }

    /// The part of a line in the rectangle, in its direction.
    pub fn cut(&self, mut ends: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
        loop {
            match self.step(ends) {
                Step::Accept => return Some(ends),
                Step::Reject => return None,
                Step::Cut(shorter) => ends = shorter,
            }
        }
    }

    /// One round: both inside, or both on the outer side of one border, or the end with the greater code is moved to a
    /// border, where its code loses that bit for good.
    fn step(&self, [a, b]: [[f64; 2]; 2]) -> Step {
        let [code_a, code_b] = [self.code(a), self.code(b)];
        if code_a | code_b == 0 {
            Step::Accept
        } else if code_a & code_b != 0 {
            Step::Reject
        } else if code_a > code_b {
            Step::Cut([self.moved(a, b, code_a), b])
        } else {
            Step::Cut([a, self.moved(b, a, code_b)])
        }
    }

    /// The outer end, moved along the line to the first border that its code names.
    fn moved(&self, [x, y]: [f64; 2], [to_x, to_y]: [f64; 2], code: u8) -> [f64; 2] {
        let on_row = |row: f64| [x + (to_x - x) * (row - y) / (to_y - y), row];
        let on_column = |column: f64| [column, y + (to_y - y) * (column - x) / (to_x - x)];
        if code & TOP != 0 {
            on_row(self.y[1])
        } else if code & BOTTOM != 0 {
            on_row(self.y[0])
        } else if code & RIGHT != 0 {
            on_column(self.x[1])
        } else {
            on_column(self.x[0])
        }
    }
}

#[derive(Debug, PartialEq)]
enum Step {
    Accept,
    Reject,
    Cut([[f64; 2]; 2]),
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCREEN: Rectangle = Rectangle {
        x: [0.0, 299.0],
        y: [0.0, 299.0],
    };

    #[test]
    fn i02_1_nine_regions() {
        let rectangle = Rectangle {
            x: [60.0, 240.0],
            y: [60.0, 240.0],
        };
        assert_eq!(rectangle.code([59.0, 59.0]), LEFT | BOTTOM);
        assert_eq!(rectangle.code([60.0, 240.0]), 0);
        assert_eq!(rectangle.code([241.0, 100.0]), RIGHT);
        assert_eq!(rectangle.code([150.0, 241.0]), TOP);
        let places = [0.0, 100.0, 300.0];
        let codes = places.iter().flat_map(|&y| places.map(|x| rectangle.code([x, y])));
        let mut codes: Vec<u8> = codes.collect();
        codes.sort_unstable();
        codes.dedup();
        assert_eq!(codes.len(), 9);
    }

    #[test]
    fn i02_2_cut_lines() {
        let near = |ends, expected: [[f64; 2]; 2]| {
            let found = SCREEN.cut(ends).expect("a part");
            let pairs = found.iter().flatten().zip(expected.iter().flatten());
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
        };
        near([[-100.0, 50.0], [400.0, 200.0]], [[0.0, 80.0], [299.0, 169.7]]);
        near([[-50.0, 150.0], [150.0, 350.0]], [[0.0, 200.0], [99.0, 299.0]]);
        near([[150.0, -20.0], [150.0, 500.0]], [[150.0, 0.0], [150.0, 299.0]]);
        near([[150.0, 500.0], [150.0, -20.0]], [[150.0, 299.0], [150.0, 0.0]]);
    }

    #[test]
    fn i02_2_rejected_lines() {
        assert_eq!(SCREEN.step([[-10.0, -10.0], [-5.0, 400.0]]), Step::Reject);
        let Step::Cut(ends) = SCREEN.step([[-100.0, 200.0], [-100.0 + 200.0, 400.0]]) else {
            panic!("the ends are left of and above the screen");
        };
        assert_eq!(SCREEN.step(ends), Step::Reject);
    }
}
