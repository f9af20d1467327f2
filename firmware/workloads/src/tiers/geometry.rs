//! What the scenes show, as stored integers: the same for the core, on every machine, and for the float64 reference.

use fixel::num::{Angle, SineTable, Trigonometry};
use heapless::Vec;

/// A point of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Point {
    /// In units of 2^-15.
    pub position: [i16; 3],
    /// Length 1 in units of 2^-15.
    pub normal: [i16; 3],
}

/// A mesh, its triangles counter-clockwise as seen from outside.
#[derive(Debug)]
pub struct Mesh {
    /// Its points.
    pub points: Vec<Point, 300>,
    /// Indices of points.
    pub triangles: Vec<[u16; 3], 600>,
}

/// All meshes.
#[derive(Debug)]
pub struct Models {
    /// 288 points, 576 triangles.
    pub torus: Mesh,
    /// 260 points, 440 triangles.
    pub sphere: Mesh,
}

/// Sine and cosine of `part` of `parts` of a turn, in units of 2^-30.
fn turn(part: u16, parts: u16) -> (i64, i64) {
    let (sin, cos) = SineTable::sin_cos::<i32>(Angle::from_degrees(part as i32 * 360 / parts as i32));
    (sin.into(), cos.into())
}

/// From units of 2^-60 to units of 2^-15.
fn stored(value: i64) -> i16 {
    ((value + (1 << 44)) >> 45).clamp(-32767, 32767) as i16
}

/// Indices of a grid's quads, each two triangles; columns wrap, rows only if so wished.
fn grid(rows: u16, columns: u16, all_rows: u16) -> impl Iterator<Item = [u16; 3]> {
    let cells = (0..rows).flat_map(move |row| (0..columns).map(move |column| (row, column)));
    cells.flat_map(move |(row, column)| {
        let at = |row: u16, column: u16| (row % all_rows) * columns + column % columns;
        let [a, b] = [at(row, column), at(row, column + 1)];
        let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
        [[a, c, b], [b, c, d]]
    })
}

/// Turned by 28° about x, and by 18° about z; in units of 2^-30, the result in units of 2^-60.
fn tilted([x, y, z]: [i64; 3]) -> [i64; 3] {
    let ((sin_x, cos_x), (sin_z, cos_z)) = (turn(28, 360), turn(18, 360));
    let (y, z) = ((y * cos_x - z * sin_x) >> 30, y * sin_x + z * cos_x);
    [x * cos_z - y * sin_z, x * sin_z + y * cos_z, z]
}

fn torus() -> Mesh {
    const AROUND: u16 = 24;
    const TUBE: u16 = 12;
    // 0.68 and 0.3 in units of 2^-30.
    const RADIUS: i64 = 730_144_440;
    const THICKNESS: i64 = 322_122_547;
    let mut points = Vec::new();
    for (tube, around) in (0..TUBE).flat_map(|tube| (0..AROUND).map(move |around| (tube, around))) {
        let ((sin, cos), (up, out)) = (turn(around, AROUND), turn(tube, TUBE));
        let ring = RADIUS + ((THICKNESS * out) >> 30);
        let scaled = |v: [i64; 3]| v.map(|c| c >> 30);
        // There is room: 288 of 300.
        let _full = points.push(Point {
            position: tilted(scaled([ring * cos, THICKNESS * up, ring * sin])).map(stored),
            normal: tilted(scaled([out * cos, up << 30, out * sin])).map(stored),
        });
    }
    Mesh {
        points,
        triangles: grid(TUBE, AROUND, TUBE).collect(),
    }
}

fn sphere() -> Mesh {
    const AROUND: u16 = 20;
    const ROWS: u16 = 12;
    let mut points = Vec::new();
    for (row, around) in (0..=ROWS).flat_map(|row| (0..AROUND).map(move |around| (row, around))) {
        let ((sin, cos), (out, down)) = (turn(around, AROUND), turn(row, 2 * ROWS));
        let position = [out * cos, -(down << 30), out * sin].map(stored);
        // There is room: 260 of 300.
        let _full = points.push(Point {
            position,
            normal: position,
        });
    }
    let distinct = |[a, b, c]: &[u16; 3]| {
        let position = |i: u16| points.get(i as usize).map(|p: &Point| p.position);
        position(*a) != position(*b) && position(*b) != position(*c) && position(*c) != position(*a)
    };
    let triangles = grid(ROWS, AROUND, ROWS + 1).filter(distinct).collect();
    Mesh { points, triangles }
}

impl Models {
    /// Makes them.
    pub fn new() -> Self {
        Models {
            torus: torus(),
            sphere: sphere(),
        }
    }
}

impl Default for Models {
    fn default() -> Self {
        Self::new()
    }
}

/// A corner of the room: where, in eye space, and which texel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner {
    /// In units of 1.
    pub position: [i32; 3],
    /// In texels.
    pub texel: [i32; 2],
}

const fn corner(position: [i32; 3], texel: [i32; 2]) -> Corner {
    Corner { position, texel }
}

/// A corridor ten times as far away at its end as at its beginning, closed by a wall, and a board that stands in it aslant.
pub const ROOM: [[Corner; 4]; 6] = [
    // Floor, ceiling.
    [
        corner([-6, -4, -5], [0, 0]),
        corner([6, -4, -5], [128, 0]),
        corner([6, -4, -50], [128, 480]),
        corner([-6, -4, -50], [0, 480]),
    ],
    [
        corner([-6, 4, -5], [0, 0]),
        corner([-6, 4, -50], [0, 480]),
        corner([6, 4, -50], [128, 480]),
        corner([6, 4, -5], [128, 0]),
    ],
    // Left, right.
    [
        corner([-6, -4, -5], [0, 0]),
        corner([-6, -4, -50], [480, 0]),
        corner([-6, 4, -50], [480, 86]),
        corner([-6, 4, -5], [0, 86]),
    ],
    [
        corner([6, -4, -5], [0, 0]),
        corner([6, 4, -5], [0, 86]),
        corner([6, 4, -50], [480, 86]),
        corner([6, -4, -50], [480, 0]),
    ],
    // The end.
    [
        corner([-6, -4, -50], [0, 0]),
        corner([6, -4, -50], [128, 0]),
        corner([6, 4, -50], [128, 86]),
        corner([-6, 4, -50], [0, 86]),
    ],
    // The board.
    [
        corner([-4, -3, -9], [0, 0]),
        corner([3, -2, -18], [64, 0]),
        corner([3, 4, -18], [64, 64]),
        corner([-4, 2, -9], [0, 64]),
    ],
];

/// Texels of a side of [`BRICKS`].
pub const SIDE: usize = 64;

/// Bricks with joints, RGB565: neighbouring texels differ little but at a joint.
pub static BRICKS: [[u16; SIDE]; SIDE] = {
    let mut texels = [[0; SIDE]; SIDE];
    let mut place = 0;
    while place < SIDE * SIDE {
        let (i, j) = (place % SIDE, place / SIDE);
        let (row, shifted) = (j / 16, i + j / 16 % 2 * 16);
        let brick = (shifted / 32 % 2 * 5 + row * 3) % 4;
        let joint = j % 16 == 0 || shifted % 32 == 0;
        // Lighter to the lower right, brick by brick.
        let shade = shifted % 32 / 4 + j % 16 / 4;
        let (red, green, blue) = if joint {
            (20, 40, 20)
        } else {
            (14 + brick + shade / 2, 12 + 2 * brick + shade, 4 + brick + shade / 4)
        };
        texels[j][i] = (red << 11 | green << 5 | blue) as u16;
        place += 1;
    }
    texels
};

/// A wall that fills the view of the corridor's camera: where, in eye space, and how bright of 255. Linear over the wall.
pub const SKY: [([i32; 3], i32); 4] = [
    ([-9, -7, -8], 40),
    ([9, -7, -8], 60),
    ([9, 7, -8], 110),
    ([-9, 7, -8], 90),
];

/// Triangles on the screen, either way round: columns and rows in units of 2^-16 px.
pub static PIECES: [[[i32; 2]; 3]; 400] = {
    let mut pieces = [[[0; 2]; 3]; 400];
    let (mut piece, mut state) = (0, 1);
    while piece < pieces.len() {
        let (middle_x, next) = random(state, 160 << 16);
        let (middle_y, next) = random(next, 120 << 16);
        state = next;
        let mut corner = 0;
        while corner < 3 {
            let (x, next) = random(state, 60 << 16);
            let (y, next) = random(next, 60 << 16);
            state = next;
            pieces[piece][corner] = [middle_x + x - (30 << 16), middle_y + y - (30 << 16)];
            corner += 1;
        }
        piece += 1;
    }
    pieces
};

/// A number below `limit`, and the next state (Knuth's MMIX).
const fn random(state: u64, limit: i32) -> (i32, u64) {
    let state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    ((((state >> 32) * limit as u64) >> 32) as i32, state)
}
