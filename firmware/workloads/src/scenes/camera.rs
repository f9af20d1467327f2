//! Through the view door: corners in eye space, clipped and projected.

use core::hint::black_box;
use core::marker::PhantomData;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{Less, LessOrEqual};
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Antialiased, Compact, Flat, Fragment, Gouraud565};
use fixel::matrix::Matrix;
use fixel::mesh::{Cache, Mesh, Normalized};
use fixel::num::{Angle, Block, Scaled, Word};
use fixel::patch::{ControlPoint, Level, PatchVertex, RectangularPatch, TriangularPatch};
use fixel::quality::Quality;
use fixel::texture::{Floor, Nearest, Rgb565};
use fixel::varying::Color565;
use fixel::view::{Carried, Cull, Vertex, View};
use fixel::viewport::Viewport;

use super::part::{HEIGHT, Part, WIDTH};
use super::raster::TEXTURE;

/// A position in eye space, its w, and two values.
type Point = ([i32; 4], [i32; 2]);

/// A view of the whole picture along −z, 60° high.
pub fn view<Q: Quality, T: Word, W: Word, const N: usize>(planes: &[[i32; 4]]) -> Result<View<T, W, N>, Error> {
    let mut own = Planes::default();
    for &plane in planes {
        own.push(Block::from_integers(plane))?;
    }
    Ok(View {
        projection: projection::<Q, T>()?,
        planes: own,
        viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    })
}

/// The matrix of that view.
pub fn projection<Q: Quality, T: Word>() -> Result<Matrix<T>, Error> {
    let aspect = Scaled::from_integer(3)
        .over(Scaled::from_integer(2))
        .ok_or(Error::ZeroVector)?;
    let [near, far] = black_box([1, 40]).map(Scaled::from_integer);
    Matrix::perspective::<Q::Trigonometry>(Angle::from_degrees(60), aspect, near, far)
}

/// The nearest texel, by texture coordinates of a tier.
pub struct Textured<Q>(pub Nearest<'static, Rgb565, Floor>, pub PhantomData<Q>);

impl<Q: Quality> Fragment for Textured<Q> {
    type Varying = Q::Perspective<2>;
    type Pixel = u16;
    fn shade(&self, st: [i32; 2], _below: u16) -> Option<u16> {
        Some(self.0.stored(st))
    }
}

/// The textured triangles of a floor, a wall, and one that crosses both.
const ROOM: [[Point; 3]; 4] = [
    [
        ([-4, -2, -3, 1], [0, 0]),
        ([4, -2, -3, 1], [8, 0]),
        ([4, -2, -30, 1], [8, 27]),
    ],
    [
        ([-4, -2, -3, 1], [0, 0]),
        ([4, -2, -30, 1], [8, 27]),
        ([-4, -2, -30, 1], [0, 27]),
    ],
    [
        ([-4, -2, -9, 1], [0, 0]),
        ([5, -2, -12, 1], [3, 0]),
        ([0, 5, -10, 1], [1, 4]),
    ],
    [
        ([-1, -3, -6, 1], [0, 1]),
        ([2, 1, -2, 1], [2, 2]),
        ([-1, 2, -20, 1], [9, 5]),
    ],
];

fn textured<Q: Quality, T: Word, W: Word, const N: usize>(
    part: &mut Part<'_>,
    view: &View<T, W, N>,
    triangles: &[[Point; 3]],
) -> Result<(), Error> {
    let fragment = Textured::<Q>(Nearest::new(TEXTURE?, 16), PhantomData);
    each(part, view, triangles, &fragment)
}

fn each<T: Word, W: Word, F, const N: usize>(
    part: &mut Part<'_>,
    view: &View<T, W, N>,
    triangles: &[[Point; 3]],
    fragment: &F,
) -> Result<(), Error>
where
    F: Fragment<Varying: Carried<Vertex = [i32; 2]>, Pixel = u16>,
{
    let (mut color, mut depth) = part.compared::<LessOrEqual>()?;
    for corners in black_box(triangles) {
        let corners = corners.map(|(position, st)| Vertex {
            position: Block::from_integers(position),
            carried: st.map(|v| v << 16),
        });
        draw::primitive(view, &mut color, &mut depth, &corners, fragment);
    }
    Ok(())
}

pub fn perspective_nearest<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    textured::<Q, _, _, _>(part, &view::<Q, i32, i32, 0>(&[])?, &ROOM)
}

/// Corners behind the camera.
const THROUGH: [[Point; 3]; 3] = [
    [
        ([-3, -1, 2, 1], [0, 0]),
        ([3, -1, 3, 1], [9, 0]),
        ([0, -1, -35, 1], [4, 40]),
    ],
    [
        ([-3, 3, -2, 1], [0, 0]),
        ([1, 2, -90, 1], [9, 0]),
        ([2, -1, 7, 1], [4, 4]),
    ],
    [([0, 0, 1, 1], [0, 0]), ([1, 0, 2, 1], [1, 0]), ([0, 1, 3, 1], [0, 1])],
];

pub fn near_plane<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    textured::<Q, _, _, _>(part, &view::<Q, i32, i32, 0>(&[])?, &THROUGH)
}

/// By less code, with triangles that are whole too.
pub fn near_plane_compact<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let fragment = Compact(Textured::<Q>(Nearest::new(TEXTURE?, 16), PhantomData));
    let view = view::<Q, i32, i32, 0>(&[])?;
    each(part, &view, &ROOM, &fragment)?;
    each(part, &view, &THROUGH, &fragment)
}

/// Cut by two planes of the user.
pub fn user_planes<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    textured::<Q, _, _, _>(part, &view::<Q, i32, i32, 2>(&[[1, 1, 0, 2], [-2, 1, -1, -3]])?, &ROOM)
}

/// Divided by w whatever its sign.
pub fn both_signs_of_w<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    const MIXED: [[Point; 3]; 3] = [
        [
            ([-3, -1, -4, 1], [0, 0]),
            ([3, 1, 5, -1], [9, 0]),
            ([0, 3, -6, 1], [4, 4]),
        ],
        [
            ([2, 1, 5, -1], [0, 0]),
            ([-2, 2, 6, -1], [3, 0]),
            ([0, -2, 4, -1], [3, 3]),
        ],
        [
            ([-3, -2, -4, 1], [0, 0]),
            ([-1, -2, -4, 1], [3, 0]),
            ([-2, 0, 8, 1], [3, 3]),
        ],
    ];
    let mut view = view::<Q, i32, i32, 0>(&[])?;
    view.behind = Behind::Divide;
    textured::<Q, _, _, _>(part, &view, &MIXED)
}

/// 64-bit positions far from the origin, 64-bit edges.
pub fn wide_words<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    const HUGE: i32 = 160_000_000;
    const FAR_OFF: [[Point; 3]; 2] = [
        [
            ([-HUGE, -HUGE, -HUGE * 2, 1], [0, 0]),
            ([HUGE, -HUGE, -40, 1], [9, 0]),
            ([0, 3, -6, 1], [4, 4]),
        ],
        [
            ([-3, -2, -4, 1], [0, 0]),
            ([-1, HUGE, -40, 1], [3, 0]),
            ([2, 0, -HUGE, HUGE / 20], [3, 3]),
        ],
    ];
    textured::<Q, _, _, _>(part, &view::<Q, i64, i64, 1>(&[[0, 1, 0, 2]])?, &FAR_OFF)
}

/// A cube's faces, counter-clockwise as seen from outside, turned; only those that face the eye.
pub fn culled_mesh<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    const CORNERS: [[i16; 3]; 8] = {
        const A: i16 = i16::MIN;
        const B: i16 = i16::MAX;
        [
            [A, A, A],
            [B, A, A],
            [B, B, A],
            [A, B, A],
            [A, A, B],
            [B, A, B],
            [B, B, B],
            [A, B, B],
        ]
    };
    const END: u16 = u16::MAX;
    const FACES: [u16; 30] = [
        0, 3, 2, 1, END, 4, 5, 6, 7, END, 0, 1, 5, 4, END, 2, 3, 7, 6, END, 1, 2, 6, 5, END, 0, 4, 7, 3, END,
    ];
    let mut view = view::<Q, i32, i32, 0>(&[])?;
    view.cull = Cull::Clockwise;
    let axis = Block::from_integers([1, 2, 3]);
    let turned = Matrix::rotation::<Q::Trigonometry>(Angle::from_degrees(40), axis)?;
    let position = Block::from_integers([0, 0, -5]);
    let model = Matrix::model(position, &turned, Block::from_integers([2, 1, 2]));
    let (mut color, mut depth) = part.compared::<Less>()?;
    let mesh = Mesh::new([black_box(&FACES[..])], [CORNERS.len()])?;
    let vertex = |[i]: [usize; 1]| {
        let [x, y, z] = CORNERS.get(i).copied().unwrap_or_default();
        let Color565(carried) = Gouraud565::corner((x >> 8) as u8 ^ 128, (y >> 8) as u8 ^ 128, (z >> 8) as u8 ^ 128);
        Vertex {
            position: model.transform([x, y, z].point()),
            carried,
        }
    };
    mesh.triangles(&mut Cache::<_, 1, 4>::default(), vertex, |corners| {
        draw::primitive(&view, &mut color, &mut depth, &corners, &Q::GOURAUD);
    });
    Ok(())
}

/// Lines, antialiased lines, squares and discs, clipped.
pub fn lines_in_space<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    /// Adds part of its colour.
    struct Glow;
    impl Fragment for Glow {
        type Varying = ();
        type Pixel = u16;
        fn shade(&self, (): (), below: u16) -> Option<u16> {
            Some(below | 0x07e0)
        }
    }
    impl Antialiased for Glow {
        fn shade_part(&self, (): (), part: i32, below: u16) -> Option<u16> {
            Some(below | (part >> 23) as u16)
        }
    }

    let view = view::<Q, i32, i32, 1>(&[[0, 1, 0, 3]])?;
    let (mut color, mut depth) = part.compared::<LessOrEqual>()?;
    for i in black_box(-6)..=6 {
        let ends = [
            ([i, -4, -2], 0),
            ([2 * i, 4, -20], 0),
            ([i, -2, 3], 0),
            ([-i, -1, -9], 0),
        ];
        let [a, b, c, d] = ends.map(|([x, y, z], _)| Vertex {
            position: Block::from_integers([x, y, z, 1]),
            carried: (),
        });
        draw::primitive_segment(&view, &mut color, &mut depth, &[a, b], &Flat(0xffff));
        draw::primitive_wu_line(&view, &mut color, &mut depth, &[c, d], &Glow);
        let size = fixel::screen::SubPx::from_num(3 + i.abs() / 2);
        draw::primitive_square(&view, &mut color, &mut depth, b.position, size, (), &Flat(0xf800));
        draw::primitive_disc(&view, &mut color, &mut depth, d.position, size, (), &Flat(0x001f));
    }
    Ok(())
}

/// Heights of the control points of a hilly sheet, row by row.
const HILLS: [i32; 16] = [0, 3, -2, 1, 2, -4, 5, 0, -1, 6, 1, -3, 0, 2, 0, 1];

fn control(i: i32, j: i32, height: i32) -> ControlPoint<i32, 3> {
    ControlPoint {
        position: Block::from_integers([2 * i - 3, 2 * j - 3, height - 8, 1]),
        color: [(i * 80) << 16, (j * 80) << 16, (height * 12 + 90) << 16],
    }
}

/// Levels of 255 in units of 2^-16, and a normal's tilt, as a colour.
fn carried(vertex: PatchVertex<i32, 3>) -> Vertex<i32, [i32; 3]> {
    let [red, green, blue] = vertex.color.map(|v| v.clamp(0, 255 << 16) >> 3);
    let tilt = (vertex.normal.mantissas()[0] >> 12) & 0xf_ffff;
    Vertex {
        position: vertex.position,
        carried: [red, green, blue ^ tilt],
    }
}

pub fn rectangular_patch<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let mut points = [control(0, 0, 0); 16];
    for (i, (point, height)) in (0..).zip(points.iter_mut().zip(black_box(HILLS))) {
        *point = control(i % 4, i / 4, height);
    }
    let view = view::<Q, i32, i32, 0>(&[])?;
    let (mut color, mut depth) = part.compared::<Less>()?;
    let mut draw = |corners| draw::primitive(&view, &mut color, &mut depth, &corners, &Q::GOURAUD);
    RectangularPatch::new(points).for_each_mapped::<true, _>(Level::new(3)?, &mut carried, &mut draw);
    Ok(())
}

pub fn triangular_patch<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let mut points = [control(0, 0, 0); 10];
    let grid = (0..4).flat_map(|j| (0..4 - j).map(move |i| (i, j)));
    for ((i, j), (point, height)) in grid.zip(points.iter_mut().zip(black_box(HILLS))) {
        *point = control(i, j, height);
    }
    let view = view::<Q, i32, i32, 0>(&[])?;
    let (mut color, mut depth) = part.compared::<Less>()?;
    let mut draw = |corners| draw::primitive(&view, &mut color, &mut depth, &corners, &Q::GOURAUD);
    TriangularPatch::new(points).for_each_mapped::<true, _>(Level::new(3)?, &mut carried, &mut draw);
    Ok(())
}
