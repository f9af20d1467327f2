//! Bézier patches on the screen: no cracks, no folds, colours at every pixel.

mod patch_points;
mod strict;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::Fragment;
use fixel::matrix::Matrix;
use fixel::num::{Block, Scaled, Word};
use fixel::patch::{ControlPoint, PatchVertex, RectangularPatch, TriangularPatch};
use fixel::target::Buffer;
use fixel::varying::Linear;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use patch_points::{TRIANGLE, level};
use proptest::prelude::*;
use strict::{Mark, StrictTarget};

const SIZE: (u16, u16) = (100, 80);

/// x and y straight to the screen: −1…1 is the whole picture.
fn straight<T: Word>() -> View<T, i32, 0> {
    View {
        projection: Matrix::identity(),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, SIZE.0, SIZE.1).unwrap(),
        depth_range: DepthRange::Unlimited,
        behind: Behind::Divide,
        cull: Cull::Nothing,
    }
}

fn target() -> StrictTarget {
    StrictTarget::new(Window::new(0, 0, SIZE.0.into(), SIZE.1.into()), false)
}

/// Draws flat triangles, and gives the corners that come to it.
fn plot<'a, T: Word>(
    view: &'a View<T, i32, 0>,
    target: &'a mut StrictTarget,
    mark: u8,
) -> impl FnMut([PatchVertex<T, 0>; 3]) + 'a {
    move |triangle| {
        let corners = triangle.map(|v| Vertex {
            position: v.position,
            carried: (),
        });
        draw::primitive(view, target, &mut NoDepth, &corners, &Mark(mark));
    }
}

/// A control point at (x, y) thousandths, with any w.
fn on_plane<T: Word>(x: i32, y: i32, w: i32) -> ControlPoint<T, 0> {
    ControlPoint {
        position: Block::from_integers([x * w, y * w, 0, 1000 * w]),
        color: [],
    }
}

/// Two patches side by side with a curved border between them fill the picture: every pixel exactly once, at every level,
/// for rectangles and triangles, whatever w.
fn tiles_the_picture<T: Word>(wiggle: [i32; 4], weights: [i32; 5], n: u32) {
    // Columns −1000, −333, 333, 1000 of the left patch end at the border; the border's inner points wander.
    let middle = |row: usize| if row == 0 || row == 3 { 0 } else { wiggle[row - 1] };
    let rows = [-1000, -333, 333, 1000];
    let w = |i: usize, j: usize| weights[(i * 7 + j * 3) % 5];
    let left: [_; 16] = core::array::from_fn(|k| {
        let (i, j) = (k % 4, k / 4);
        let x = -1000 + (middle(j) + 1000) * i as i32 / 3;
        on_plane(x, rows[j], w(i, j))
    });
    // The right patch has t along x instead, from the border on, and s backwards.
    let right: [_; 16] = core::array::from_fn(|k| {
        let (i, j) = (k / 4, 3 - k % 4);
        let x = middle(j) + (1000 - middle(j)) * i as i32 / 3;
        on_plane(x, rows[j], w(3 + i, j))
    });
    let view = straight::<T>();
    let mut picture = target();
    RectangularPatch::new(left).for_each_triangle::<false>(level(n), &mut plot(&view, &mut picture, b'l'));
    RectangularPatch::new(right).for_each_triangle::<false>(level(n), &mut plot(&view, &mut picture, b'r'));
    let census = picture.census();
    assert_eq!(
        census.get(&'.'),
        None,
        "rectangles at level {n}, {wiggle:?}, {weights:?}"
    );

    // Two triangles with a wiggling diagonal: from the lower left to the upper right.
    let diagonal = |k: usize| {
        let along = -1000 + 2000 * k as i32 / 3;
        let off = if k == 0 || k == 3 { 0 } else { wiggle[k + 1] / 2 };
        (along + off, -along + off)
    };
    let place = |i: u32, j: u32, corner: i32| {
        let (i, j) = (i as usize, j as usize);
        if i + j == 3 {
            let (x, y) = diagonal(i);
            return on_plane(x, y, weights[i]);
        }
        let (x, y) = (-1000 + 2000 * i as i32 / 3, -1000 + 2000 * j as i32 / 3);
        on_plane(x * corner, y * corner, w(i, j))
    };
    let upper = TRIANGLE.map(|(i, j)| place(i, j, 1));
    // Turned by half a turn; its diagonal is the other's, from the other end.
    let lower = TRIANGLE.map(|(i, j)| if i + j == 3 { place(j, i, 1) } else { place(i, j, -1) });
    let mut picture = target();
    TriangularPatch::new(upper).for_each_triangle::<false>(level(n), &mut plot(&view, &mut picture, b'u'));
    TriangularPatch::new(lower).for_each_triangle::<false>(level(n), &mut plot(&view, &mut picture, b'v'));
    let census = picture.census();
    assert_eq!(
        census.get(&'.'),
        None,
        "triangles at level {n}, {wiggle:?}, {weights:?}"
    );
}

#[test]
fn patches_at_level_8_have_no_cracks() {
    for n in 1..=8 {
        tiles_the_picture::<i32>([200, -150, 180, -120], [10, 12, 9, 11, 13], n);
        tiles_the_picture::<i64>([200, -150, 180, -120], [10, 12, 9, 11, 13], n);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn neighbours_have_no_cracks(
        wiggle in prop::array::uniform4(-180..180i32), weights in prop::array::uniform5(20..24i32), n in 1..=8u32,
    ) {
        tiles_the_picture::<i32>(wiggle, weights, n);
    }
}

/// Pixels that nothing was drawn on and that cannot be reached from the picture's border.
fn holes(picture: &[String]) -> usize {
    let mut cells: Vec<Vec<u8>> = picture.iter().map(|row| row.bytes().collect()).collect();
    let (width, height) = (cells[0].len(), cells.len());
    let mut open: Vec<(usize, usize)> = (0..width)
        .flat_map(|x| [(x, 0), (x, height - 1)])
        .chain((0..height).flat_map(|y| [(0, y), (width - 1, y)]))
        .collect();
    while let Some((x, y)) = open.pop() {
        if cells[y][x] == b'.' {
            cells[y][x] = b' ';
            open.extend((x > 0).then(|| (x - 1, y)));
            open.extend((y > 0).then(|| (x, y - 1)));
            open.extend((x + 1 < width).then_some((x + 1, y)));
            open.extend((y + 1 < height).then_some((x, y + 1)));
        }
    }
    cells.iter().flatten().filter(|&&c| c == b'.').count()
}

/// Hills in perspective at level 8, seen so steeply that nothing folds: no pixel twice, no holes; cut by the near plane and
/// the picture's sides, too.
#[test]
fn hills_in_perspective() {
    fn draw<T: Word>(near: i32) -> Vec<String> {
        let view = View::<T, i32, 0> {
            projection: Matrix::frustum([-4, 4, -3, 3, near, 100].map(Scaled::from_integer)).unwrap(),
            depth_range: DepthRange::MinusOneToOne,
            behind: Behind::Cut,
            ..straight()
        };
        let hill = |i: u32, j: u32| ControlPoint {
            position: Block::from_integers([
                i as i32 * 4 - 6,
                j as i32 * 3 - 4,
                -9 + (i * j % 3) as i32 * 2 - j as i32,
                1,
            ]),
            color: [],
        };
        let mut picture = target();
        let square = RectangularPatch::new(core::array::from_fn(|k| hill(k as u32 % 4, k as u32 / 4)));
        square.for_each_triangle::<false>(level(8), &mut plot(&view, &mut picture, b'q'));
        let drawn = picture.picture();
        let mut picture = target();
        let triangle = TriangularPatch::new(TRIANGLE.map(|(i, j)| hill(i, j)));
        triangle.for_each_triangle::<false>(level(8), &mut plot(&view, &mut picture, b't'));
        drawn
            .into_iter()
            .chain([".".repeat(SIZE.0.into())])
            .chain(picture.picture())
            .collect()
    }
    for near in [5, 8, 9] {
        let (narrow, wide) = (draw::<i32>(near), draw::<i64>(near));
        let count = narrow.concat().bytes().filter(|&c| c != b'.').count();
        println!("near {near}: {count} pixels");
        assert!(count > 3000, "only {count} pixels");
        assert_eq!(holes(&narrow), 0, "{}", narrow.join("\n"));
        assert_eq!(holes(&wide), 0);
        let different = narrow
            .concat()
            .bytes()
            .zip(wide.concat().bytes())
            .filter(|(a, b)| a != b)
            .count();
        assert!(different <= 2, "{different}");
    }
}

/// Stores its colours.
struct Colors;

impl Fragment for Colors {
    type Varying = Linear<3>;
    type Pixel = Option<[i32; 3]>;
    fn shade(&self, values: [i32; 3], _: Self::Pixel) -> Option<Self::Pixel> {
        Some(Some(values))
    }
}

/// Gouraud patches far outside 0…255 levels: a square whose colours are linear in x and y has them at every pixel.
#[test]
fn colours_outside_the_range_are_kept() {
    let view = straight::<i32>();
    // Levels at (x, y) pixels: −300 + 9·x; 700 − 10·y; 20·x − 15·y.
    let exact = |x: f64, y: f64| [9.0 * x - 300.0, 700.0 - 10.0 * y, 20.0 * x - 15.0 * y];
    let control = |i: i32, j: i32| {
        let colors = exact(f64::from(i) * 100.0 / 3.0, f64::from(j) * 80.0 / 3.0);
        ControlPoint {
            position: Block::<i32, 4>::from_integers([2 * i - 3, 2 * j - 3, 0, 3]),
            color: colors.map(|c| (c * 65536.0).round() as i32),
        }
    };
    let mut picture = vec![None; 8000];
    let mut target = Buffer::new(&mut picture, SIZE.0, SIZE.1).unwrap();
    let mut draw = |triangle: [PatchVertex<i32, 3>; 3]| {
        let corners = triangle.map(|v| Vertex {
            position: v.position,
            carried: v.color,
        });
        draw::primitive(&view, &mut target, &mut NoDepth, &corners, &Colors);
    };
    // The upper left half from a triangle, then the whole from a square at a coarser level.
    TriangularPatch::new(TRIANGLE.map(|(i, j)| control(i as i32, j as i32)))
        .for_each_triangle::<true>(level(8), &mut draw);
    let half: Vec<_> = target_pixels(&picture);
    assert!((3900..4200).contains(&half.len()));
    let mut target = Buffer::new(&mut picture, SIZE.0, SIZE.1).unwrap();
    let square = RectangularPatch::new(core::array::from_fn(|k| control(k as i32 % 4, k as i32 / 4)));
    square.for_each_triangle::<true>(level(5), &mut |triangle| {
        let corners = triangle.map(|v| Vertex {
            position: v.position,
            carried: v.color,
        });
        draw::primitive(&view, &mut target, &mut NoDepth, &corners, &Colors);
    });
    let whole: Vec<_> = target_pixels(&picture);
    assert_eq!(whole.len(), 8000);
    let mut worst = 0f64;
    for (x, y, found) in half.into_iter().chain(whole) {
        for (found, exact) in found.iter().zip(exact(x, y)) {
            worst = worst.max((f64::from(*found) / 65536.0 - exact).abs());
        }
    }
    // Grid points fall on subpixels here, so that snapping moves nothing.
    println!("largest error of a colour: {worst:.1e} levels");
    assert!(worst < 0.01);
}

fn target_pixels(picture: &[Option<[i32; 3]>]) -> Vec<(f64, f64, [i32; 3])> {
    let place = |k: usize| ((k % 100) as f64, (k / 100) as f64);
    let drawn = picture.iter().enumerate().filter_map(|(k, c)| c.map(|c| (k, c)));
    drawn.map(|(k, c)| (place(k).0, place(k).1, c)).collect()
}
