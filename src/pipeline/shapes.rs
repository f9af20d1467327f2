//! Shapes to start with: planes and a box, as lists of triangles.

/// A corner of a shape. Signs and 0/1, so that all of them fit in flash.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner {
    /// x, y, z: −1, 0 or 1.
    pub position: [i8; 3],
    /// Outwards, length 1.
    pub normal: [i8; 3],
    /// Texture coordinates: 0 or 1.
    pub uv: [u8; 2],
}

/// A corner's vertex for a program of [`Corner`]s, with the w of a point.
///
/// ```
/// use fixel::{num::Block, pipeline::shapes::{BOX, PLANE_XZ}};
/// assert_eq!(PLANE_XZ[0].point::<i32>(), Block::from_integers([-1, 0, -1, 1]));
/// assert_eq!(BOX.len(), 36);
/// ```
impl Corner {
    /// The position, with w = 1.
    pub fn point<T: crate::num::Word>(&self) -> crate::num::Block<T, 4> {
        let [x, y, z] = self.position.map(i32::from);
        crate::num::Block::from_integers([x, y, z, 1])
    }
}

const fn corner(position: [i8; 3], normal: [i8; 3], u: u8, v: u8) -> Corner {
    Corner {
        position,
        normal,
        uv: [u, v],
    }
}

const fn floor(x: i8, z: i8, u: u8, v: u8) -> Corner {
    corner([x, 0, z], [0, 1, 0], u, v)
}

const fn wall(x: i8, y: i8) -> Corner {
    corner([x, y, 0], [0, 0, 1], (x > 0) as u8, (y > 0) as u8)
}

/// The square y = 0 with corners ±1, its normal upwards.
pub const PLANE_XZ: [Corner; 6] = [
    floor(-1, -1, 1, 0),
    floor(-1, 1, 0, 0),
    floor(1, -1, 1, 1),
    floor(1, -1, 1, 1),
    floor(-1, 1, 0, 0),
    floor(1, 1, 1, 0),
];

/// The square z = 0 with corners ±1, its normal towards the viewer; uv runs from 0 to 1 with x and y.
pub const PLANE_XY: [Corner; 6] = [
    wall(-1, -1),
    wall(1, -1),
    wall(-1, 1),
    wall(1, -1),
    wall(1, 1),
    wall(-1, 1),
];

/// The cube ±1, every face counter-clockwise as seen from outside: front, right, back, left, top, bottom.
///
/// As the course has it, with its two slips: the back face's normal is (−1, 0, 0), and the last corner of the front face
/// has uv (0, 1).
pub const BOX: [Corner; 36] = {
    const FRONT: [i8; 3] = [0, 0, 1];
    const RIGHT: [i8; 3] = [1, 0, 0];
    const BACK: [i8; 3] = [-1, 0, 0];
    const LEFT: [i8; 3] = [-1, 0, 0];
    const TOP: [i8; 3] = [0, 1, 0];
    const BOTTOM: [i8; 3] = [0, -1, 0];
    [
        corner([-1, -1, 1], FRONT, 0, 0),
        corner([1, 1, 1], FRONT, 1, 1),
        corner([-1, 1, 1], FRONT, 0, 1),
        corner([1, 1, 1], FRONT, 1, 1),
        corner([-1, -1, 1], FRONT, 0, 0),
        corner([1, -1, 1], FRONT, 0, 1),
        corner([1, -1, 1], RIGHT, 0, 0),
        corner([1, -1, -1], RIGHT, 1, 0),
        corner([1, 1, 1], RIGHT, 0, 1),
        corner([1, 1, 1], RIGHT, 0, 1),
        corner([1, -1, -1], RIGHT, 1, 0),
        corner([1, 1, -1], RIGHT, 1, 1),
        corner([1, -1, -1], BACK, 0, 0),
        corner([-1, -1, -1], BACK, 1, 0),
        corner([1, 1, -1], BACK, 0, 1),
        corner([1, 1, -1], BACK, 0, 1),
        corner([-1, -1, -1], BACK, 1, 0),
        corner([-1, 1, -1], BACK, 1, 1),
        corner([-1, -1, -1], LEFT, 0, 0),
        corner([-1, -1, 1], LEFT, 1, 0),
        corner([-1, 1, -1], LEFT, 0, 1),
        corner([-1, 1, -1], LEFT, 0, 1),
        corner([-1, -1, 1], LEFT, 1, 0),
        corner([-1, 1, 1], LEFT, 1, 1),
        corner([-1, 1, 1], TOP, 0, 0),
        corner([1, 1, 1], TOP, 1, 0),
        corner([-1, 1, -1], TOP, 0, 1),
        corner([-1, 1, -1], TOP, 0, 1),
        corner([1, 1, 1], TOP, 1, 0),
        corner([1, 1, -1], TOP, 1, 1),
        corner([-1, -1, -1], BOTTOM, 0, 0),
        corner([1, -1, -1], BOTTOM, 1, 0),
        corner([-1, -1, 1], BOTTOM, 0, 1),
        corner([-1, -1, 1], BOTTOM, 0, 1),
        corner([1, -1, -1], BOTTOM, 1, 0),
        corner([1, -1, 1], BOTTOM, 1, 1),
    ]
};
