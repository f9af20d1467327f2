//! Meshes that the planes, the depth range, the camera and the guard band cut through: every pixel exactly once where
//! the mesh is, none elsewhere. Triangles on the picture are several pixels thick: one thinner than a subpixel may be
//! turned over by rounding its corners, and overlaps its neighbour then.

mod exact;
mod strict;

use std::marker::PhantomData;

use exact::{block, scaled};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::{Compact, Fragment};
use fixel::matrix::Matrix;
use fixel::num::{Scaled, Word};
use fixel::varying::{Color565, Perspective, Varying};
use fixel::view::{Carried, Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;
use strict::{Mark, StrictTarget};

/// Pixels within this many of a border are not asked whether they are drawn: corners are snapped to half a subpixel,
/// 0.003 px on the diagonal, and cut with an error that is smaller; rounded up for corners that lie far outside.
const BORDER: f64 = 0.02;

const WIDTH: i32 = 64;
const HEIGHT: i32 = 48;

type Point = [f64; 4];

/// A mesh over the lines of a grid: the inner corners moved by up to a fifth of a cell, either diagonal.
#[derive(Debug, Clone)]
struct Grid {
    lines: Vec<f64>,
    jitter: Vec<(f64, f64)>,
    diagonals: Vec<bool>,
}

const LINES: usize = 10;

fn grid(reach: f64) -> impl Strategy<Value = Grid> {
    let cells = LINES * LINES;
    let jitter = prop::collection::vec((-0.2..0.2f64, -0.2..0.2f64), cells);
    // Some lines near the picture, and ever wider apart up to ±reach.
    let lines = [0.1, 0.7, 1.5]
        .iter()
        .map(|v| v * 1.0)
        .chain([reach.sqrt().max(4.0), reach])
        .collect::<Vec<_>>();
    let lines = lines
        .iter()
        .rev()
        .map(|v| -v)
        .chain(lines.iter().copied())
        .collect::<Vec<_>>();
    (Just(lines), jitter, prop::collection::vec(any::<bool>(), cells)).prop_map(|(lines, jitter, diagonals)| Grid {
        lines,
        jitter,
        diagonals,
    })
}

impl Grid {
    fn corner(&self, i: usize, j: usize) -> (f64, f64) {
        let inner = 0 < i && i + 1 < LINES && 0 < j && j + 1 < LINES;
        let (dx, dy) = if inner { self.jitter[j * LINES + i] } else { (0.0, 0.0) };
        // Of the smallest cell around: long cells stay parallel to themselves.
        let gap = |k: usize| {
            self.lines.get(k + 1).map_or(1e9, |v| v - self.lines[k]).min(if k > 0 {
                self.lines[k] - self.lines[k - 1]
            } else {
                1e9
            })
        };
        let cell = gap(i).min(gap(j));
        (self.lines[i] + dx * cell, self.lines[j] + dy * cell)
    }

    /// Every triangle, with its corners placed by `place`, which is told the corner's number, too.
    fn triangles(&self, place: impl Fn((f64, f64), usize) -> Point) -> Vec<[Point; 3]> {
        let at = |i: usize, j: usize| place(self.corner(i, j), j * LINES + i);
        let mut triangles = Vec::new();
        for j in 0..LINES - 1 {
            for i in 0..LINES - 1 {
                let quad = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
                let split = if self.diagonals[j * LINES + i] {
                    [[0, 1, 2], [0, 2, 3]]
                } else {
                    [[1, 2, 3], [3, 0, 1]]
                };
                triangles.extend(split.map(|t| t.map(|k| quad[k])));
            }
        }
        triangles
    }
}

fn view<T: Word, W: Word>(projection: Matrix<T>, depth_range: DepthRange, behind: Behind) -> View<T, W, 3> {
    let viewport = Viewport::new(0, 0, WIDTH as u16, HEIGHT as u16).unwrap();
    View {
        projection,
        planes: Planes::default(),
        viewport,
        depth_range,
        behind,
        cull: Cull::Nothing,
    }
}

/// Draws all, failing on a pixel drawn twice: by less code, with or without values, it is the same.
fn draw_mesh<T: Word, W: Word>(view: &View<T, W, 3>, mesh: &[[Point; 3]]) -> Vec<String> {
    let drawn = draw_with(view, mesh, (), &Mark(b'#'));
    assert_eq!(draw_with(view, mesh, (), &Compact(Mark(b'#'))), drawn, "compact");
    let fan = Compact(Marked::<Color565>(PhantomData));
    assert_eq!(draw_with(view, mesh, [0; 3], &fan), drawn, "as triangles");
    let polygons = Compact(Marked::<Perspective<1>>(PhantomData));
    assert_eq!(draw_with(view, mesh, [7], &polygons), drawn, "as polygons");
    drawn
}

fn draw_with<T: Word, W: Word, F>(
    view: &View<T, W, 3>,
    mesh: &[[Point; 3]],
    carried: <F::Varying as Carried>::Vertex,
    fragment: &F,
) -> Vec<String>
where
    F: Fragment<Varying: Carried, Pixel = u8>,
{
    let mut target = StrictTarget::new(Window::new(0, 0, WIDTH, HEIGHT), false);
    for triangle in mesh {
        let vertices = triangle.map(|p| Vertex {
            position: block(p),
            carried,
        });
        draw::primitive(view, &mut target, &mut NoDepth, &vertices, fragment);
    }
    target.picture()
}

/// As [`Mark`], with values that are not looked at.
struct Marked<V>(PhantomData<V>);

impl<V: Varying> Fragment for Marked<V> {
    type Varying = V;
    type Pixel = u8;
    fn shade(&self, _: V::Values, below: u8) -> Option<u8> {
        Mark(b'#').shade((), below)
    }
}

fn full(picture: &[String]) -> bool {
    picture.iter().all(|row| row.bytes().all(|p| p == b'#'))
}

/// A plane in eye space that fills the picture and goes on behind the camera: z = −distance − a·x − b·y.
#[derive(Debug, Clone)]
struct Floor {
    distance: f64,
    slope: (f64, f64),
}

fn floor() -> impl Strategy<Value = Floor> {
    (0.05..50.0f64, -0.8..0.8f64, 0.0..1.0f64, any::<bool>()).prop_map(|(distance, a, share, down)| {
        // |a| + |b| < 0.8: no ray of the picture is parallel to the plane.
        let b = (0.8 - a.abs()) * share;
        Floor {
            distance,
            slope: (a, if down { -b } else { b }),
        }
    })
}

impl Floor {
    fn point(&self, (x, y): (f64, f64)) -> Point {
        let (x, y) = (x * self.distance, y * self.distance);
        [x, y, -self.distance - self.slope.0 * x - self.slope.1 * y, 1.0]
    }

    /// The point of the plane that is seen at (x, y) px.
    fn seen_at(&self, x: f64, y: f64) -> Point {
        let (x, y) = (2.0 * x / WIDTH as f64 - 1.0, 2.0 * y / HEIGHT as f64 - 1.0);
        let t = self.distance / (1.0 - self.slope.0 * x - self.slope.1 * y);
        [t * x, t * y, -t, 1.0]
    }

    /// A symmetric frustum of 90°, near and far in units of the distance.
    fn projection<T: Word>(&self, near: f64, far: f64) -> Matrix<T> {
        let (n, f) = (near * self.distance, far * self.distance);
        Matrix::frustum([-n, n, -n, n, n, f].map(scaled)).unwrap()
    }
}

fn dot(a: Point, b: Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Whether the point is drawn by the rules of the view, with depth by the frustum.
fn is_drawn(point: Point, planes: &[Point], near: f64, far: f64, range: DepthRange) -> bool {
    let t = -point[2];
    let depth = ((far + near) * t - 2.0 * far * near) / ((far - near) * t);
    let in_range = match range {
        DepthRange::ZeroToOne => (0.0..=1.0).contains(&depth),
        DepthRange::MinusOneToOne => (-1.0..=1.0).contains(&depth),
        DepthRange::Unlimited => true,
    };
    in_range && planes.iter().all(|&p| dot(p, point) >= 0.0)
}

fn check_floor<T: Word, W: Word>(
    floor: &Floor,
    grid: &Grid,
    planes: &[Point],
    range: DepthRange,
) -> Result<(), TestCaseError> {
    let (near, far) = (0.9, 1.7);
    let mut view = view::<T, W>(floor.projection(near, far), range, Behind::Cut);
    planes.iter().for_each(|&p| view.planes.push(block(p)).unwrap());
    let picture = draw_mesh(&view, &grid.triangles(|p, _| floor.point(p)));
    for (y, row) in picture.iter().enumerate() {
        for (x, pixel) in row.bytes().enumerate() {
            let around = [(0.0, 0.0), (BORDER, 0.0), (-BORDER, 0.0), (0.0, BORDER), (0.0, -BORDER)];
            let drawn = around.map(|(dx, dy)| {
                let point = floor.seen_at(x as f64 + dx, y as f64 + dy);
                is_drawn(point, planes, near * floor.distance, far * floor.distance, range)
            });
            if drawn.iter().all(|&d| d == drawn[0]) {
                prop_assert_eq!(
                    pixel == b'#',
                    drawn[0],
                    "pixel ({}, {}) of\n{}",
                    x,
                    y,
                    picture.join("\n")
                );
            }
        }
    }
    Ok(())
}

fn frustum<T: Word>() -> Matrix<T> {
    Matrix::frustum([-1, 1, -1, 1, 1, 8].map(Scaled::from_integer)).unwrap()
}

fn depth_range() -> impl Strategy<Value = DepthRange> {
    prop::sample::select(&[DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited][..])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Corners up to 10⁸ px away, each with a w of its own, all positive or all negative.
    #[test]
    fn huge_meshes_cover_every_pixel_once(
        grid in prop_oneof![grid(8.0), grid(3e3), grid(3e6)], range in depth_range(), negative in any::<bool>(),
        depths in prop::collection::vec((-3.0..3.0f64, 0.0..1.0f64), LINES * LINES),
    ) {
        let mesh = grid.triangles(|(x, y), i| {
            let (w, z) = (depths[i].0.exp2() * if negative { -1.0 } else { 1.0 }, depths[i].1);
            [x * w, y * w, z * w, w]
        });
        let behind = if negative { Behind::Divide } else { Behind::Cut };
        prop_assert!(full(&draw_mesh(&view::<i32, i32>(Matrix::identity(), range, behind), &mesh)));
        prop_assert!(full(&draw_mesh(&view::<i64, i64>(Matrix::identity(), range, behind), &mesh)));
        prop_assert!(full(&draw_mesh(&view::<i64, i32>(Matrix::identity(), range, behind), &mesh)));
    }

    /// A plane that goes on behind the camera: every pixel of the picture once.
    #[test]
    fn meshes_behind_the_camera_cover_every_pixel_once(
        floor in floor(), grid in prop_oneof![grid(8.0), grid(1000.0)], range in depth_range(),
    ) {
        let mesh = grid.triangles(|p, _| floor.point(p));
        // Seen at 0.55 to 5 times the distance; ZeroToOne cuts at twice near.
        prop_assert!(full(&draw_mesh(&view::<i32, i32>(floor.projection(0.2, 9.0), range, Behind::Cut), &mesh)));
        prop_assert!(full(&draw_mesh(&view::<i64, i64>(floor.projection(0.2, 9.0), range, Behind::Cut), &mesh)));
        prop_assert!(full(&draw_mesh(&view::<i32, i64>(floor.projection(0.2, 9.0), range, Behind::Cut), &mesh)));
    }

    /// What planes and depth leave of it is exactly what they should, but for the pixels on their borders.
    #[test]
    fn cut_meshes_are_exact_away_from_the_cuts(
        floor in floor(), grid in prop_oneof![grid(8.0), grid(1000.0)], range in depth_range(),
        normals in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64), 0..4),
    ) {
        let planes: Vec<_> = normals.iter().map(|&(x, y, z, d)| [x, y, z, d * floor.distance]).collect();
        check_floor::<i32, i32>(&floor, &grid, &planes, range)?;
        check_floor::<i64, i64>(&floor, &grid, &planes, range)?;
    }
}

/// A floor that passes under the camera and ends behind it, cut by the near plane below the picture.
#[test]
fn a_floor_in_a_picture() {
    let view = view::<i32, i32>(frustum(), DepthRange::MinusOneToOne, Behind::Cut);
    let picture = draw_mesh(
        &view,
        &[[[-8.0, 1.0, -4.0, 1.0], [8.0, 1.0, -4.0, 1.0], [0.0, 1.0, 4.0, 1.0]]],
    );
    let filled = |row: &String| row.bytes().filter(|&p| p == b'#').count();
    // y/w is 1/4 at the far edge: three eighths of the rows, widening downwards from 64 px.
    assert_eq!(
        picture.iter().map(filled).collect::<Vec<_>>(),
        [[0; 30].to_vec(), [64; 18].to_vec()].concat()
    );
}
