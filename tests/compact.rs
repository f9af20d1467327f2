//! By less code: the same pixels as by more, values within the same bounds, the same bits in any strip.

mod naive;
mod triangles;

use std::cell::Cell;
use std::convert::Infallible;
use std::iter::{Repeat, Zip, repeat};
use std::slice::IterMut;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{Always, Depth, DepthBuffer, FAR, NoDepth};
use fixel::draw;
use fixel::fragment::{Compact, Flat, Fragment, Gouraud565};
use fixel::matrix::Matrix;
use fixel::num::{Block, Scaled};
use fixel::screen::{Corner, FineDepth, Position};
use fixel::span::{Span, doubled_area};
use fixel::target::{Buffer, Target};
use fixel::varying::Color565;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;
use triangles::{Case, Triangle, cases, corners, positions};

/// Colours and depths.
type Picture = (Vec<u16>, Vec<u16>);

/// What `draw` makes of a window with a colour that no test draws.
fn picture(window: Window, draw: impl FnOnce(&mut Buffer<u16>, &mut DepthBuffer<Buffer<u16>, Always>)) -> Picture {
    let size = window.width() * window.height();
    let (mut colors, mut depths) = (vec![0x0820; size], vec![FAR; size]);
    let mut depth = DepthBuffer::new(Buffer::strip(&mut depths, window).unwrap());
    draw(&mut Buffer::strip(&mut colors, window).unwrap(), &mut depth);
    (colors, depths)
}

fn by_corners<F>(case: &Case, window: Window, depths: [u32; 3], varyings: [F::Varying; 3], fragment: &F) -> Picture
where
    F: Fragment<Pixel = u16>,
{
    picture(window, |color, depth| {
        draw::triangle(color, depth, corners(case.corners, depths, varyings), fragment);
    })
}

fn by_shape<F>(case: &Case, window: Window, depths: [u32; 3], varyings: [F::Varying; 3], fragment: &F) -> Picture
where
    F: Fragment<Pixel = u16>,
{
    let triangle = Triangle {
        corners: case.corners,
        depths: depths.map(|depth| depth as i32),
        varyings,
    };
    picture(window, |color, depth| {
        draw::polygon::<i32, _, _, _, _>(color, depth, &triangle, doubled_area(&triangle), fragment);
    })
}

fn depth() -> impl Strategy<Value = u32> {
    prop_oneof![1 => 0..=65535u32 << 15, 1 => Just(0), 1 => Just(65535 << 15)]
}

fn gouraud(colors: [[u8; 3]; 3]) -> [Color565; 3] {
    colors.map(|[r, g, b]| Gouraud565::corner(r, g, b))
}

/// Depths within an eighth of a step before rounding, stored channels within a level.
fn check(case: &Case, depths: [u32; 3], colors: [[u8; 3]; 3], (pixels, stored): Picture) -> Result<(), TestCaseError> {
    const MOST: [i64; 3] = [31, 63, 31];
    for (((x, y), pixel), depth) in positions(case.window).zip(pixels).zip(stored) {
        if !naive::covers(case.corners, x, y) {
            prop_assert_eq!((pixel, depth), (0x0820, FAR), "({}, {}) is not covered", x, y);
            continue;
        }
        let exact = |values: [i64; 3]| {
            let (numerator, area) = naive::value(case.corners, values, x, y);
            numerator as f64 / area as f64
        };
        let error = (f64::from(depth) - exact(depths.map(i64::from)) / 32768.0).abs();
        prop_assert!(error <= 0.625, "({}, {}): depth {} off", x, y, error);
        let found = [pixel >> 11, pixel >> 5 & 63, pixel & 31].map(f64::from);
        for (channel, found) in found.into_iter().enumerate() {
            let exact = exact(colors.map(|color| i64::from(color[channel]) * MOST[channel])) / 255.0;
            prop_assert!((found - exact).abs() <= 1.0, "({}, {}): {}, not {}", x, y, found, exact);
        }
    }
    Ok(())
}

/// Draws a triangle before a frustum, which its near plane cuts more often than not.
fn seen<F>(points: [[i32; 4]; 3], carried: [[i32; 3]; 3], fragment: &F) -> Picture
where
    F: Fragment<Varying = Color565, Pixel = u16>,
{
    let vertices = [0, 1, 2].map(|i| Vertex {
        position: Block::from_integers(points[i]),
        carried: carried[i],
    });
    picture(Window::new(0, 0, 48, 32), |color, depth| {
        draw::primitive(&view(), color, depth, &vertices, fragment);
    })
}

/// Whether the triangle's plane passes through the camera: of its line, `Compact` may draw other samples.
fn is_edge_on(points: [[i32; 4]; 3]) -> bool {
    let [[a, b, c, _], [d, e, f, _], [g, h, i, _]] = points;
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) == 0
}

/// As [`seen`], in one colour.
fn outline<F: Fragment<Varying = (), Pixel = u16>>(points: [[i32; 4]; 3], fragment: &F) -> Vec<u16> {
    let mut pixels = vec![0; 48 * 32];
    let vertices = points.map(|point| Vertex {
        position: Block::from_integers(point),
        carried: (),
    });
    let mut target = Buffer::new(&mut pixels, 48, 32).unwrap();
    draw::primitive(&view(), &mut target, &mut NoDepth, &vertices, fragment);
    pixels
}

fn view() -> View<i32, i32, 0> {
    View {
        projection: Matrix::frustum([-1, 1, -1, 1, 1, 64].map(Scaled::from_integer)).unwrap(),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, 48, 32).unwrap(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    }
}

fn eye_point() -> impl Strategy<Value = [i32; 4]> {
    (-20..=20, -20..=20, -40..=10).prop_map(|(x, y, z)| [x, y, z, 1])
}

fn channels(pixel: u16) -> [u16; 3] {
    [pixel >> 11, pixel >> 5 & 63, pixel & 31]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn values_have_the_same_bounds(case in cases(300), depths in [depth(), depth(), depth()], colors: [[u8; 3]; 3]) {
        let (varyings, fragment) = (gouraud(colors), Compact(Gouraud565));
        check(&case, depths, colors, by_corners(&case, case.window, depths, varyings, &fragment))?;
        check(&case, depths, colors, by_shape(&case, case.window, depths, varyings, &fragment))?;
    }

    #[test]
    fn any_strip_has_the_same_bits(
        case in cases(300),
        depths in [depth(), depth(), depth()],
        colors: [[u8; 3]; 3],
        (row, column) in (1..11, 1..23),
    ) {
        let Window { left, top, right, bottom } = case.window;
        let part = Window::new(left + column, top + row, right, bottom);
        let (varyings, fragment) = (gouraud(colors), Compact(Gouraud565));
        let ways = [by_corners::<Compact<Gouraud565>>, by_shape];
        for way in ways {
            let (colors, depths_of_all) = way(&case, case.window, depths, varyings, &fragment);
            let whole = positions(case.window).zip(colors.into_iter().zip(depths_of_all));
            let expected: Vec<_> = whole.filter(|&(at, _)| part.contains(at)).map(|(_, pixel)| pixel).collect();
            let (colors, depths) = way(&case, part, depths, varyings, &fragment);
            prop_assert_eq!(colors.into_iter().zip(depths).collect::<Vec<_>>(), expected);
        }
    }

    /// Both are within a level and a step of the exact values: of each other, since less than half of that is not rounding.
    #[test]
    fn what_a_view_leaves_is_the_same(points in [eye_point(), eye_point(), eye_point()], colors: [[u8; 3]; 3]) {
        prop_assume!(!is_edge_on(points));
        let drawn = outline(points, &Flat(1));
        prop_assert_eq!(&outline(points, &Compact(Flat(1))), &drawn);
        let carried = gouraud(colors).map(|color| color.0);
        let (expected, found) = (seen(points, carried, &Gouraud565), seen(points, carried, &Compact(Gouraud565)));
        for (i, drawn) in drawn.into_iter().enumerate() {
            let ((expected, expected_depth), (found, found_depth)) =
                ((expected.0[i], expected.1[i]), (found.0[i], found.1[i]));
            if drawn == 0 {
                prop_assert_eq!((found, found_depth), (0x0820, FAR), "pixel {}", i);
            }
            for (expected, found) in channels(expected).into_iter().zip(channels(found)) {
                prop_assert!(expected.abs_diff(found) <= 1, "pixel {}: {}, not {}", i, found, expected);
            }
            prop_assert!(expected_depth.abs_diff(found_depth) <= 1, "pixel {}: {}, not {}", i, found_depth, expected_depth);
        }
    }
}

/// Every triangle whose corners lie on a grid of 1 subpixel bit over 3×3 pixels.
#[test]
fn every_triangle_on_a_small_grid() {
    let points: Vec<_> = (0..7 * 7).map(|i| (i % 7 * 128, i / 7 * 128)).collect();
    let window = Window::new(0, 0, 4, 4);
    for &a in &points {
        for &b in &points {
            for &c in &points {
                let case = Case {
                    corners: [a, b, c],
                    window,
                };
                let expected: Vec<_> = positions(window)
                    .map(|(x, y)| if naive::covers([a, b, c], x, y) { 7 } else { 0x0820 })
                    .collect();
                let fragment = Compact(Flat(7));
                assert_eq!(
                    by_corners(&case, window, [0; 3], [(); 3], &fragment).0,
                    expected,
                    "{case:?}"
                );
                assert_eq!(
                    by_shape(&case, window, [0; 3], [(); 3], &fragment).0,
                    expected,
                    "{case:?}"
                );
            }
        }
    }
}

/// A depth buffer of one's own, which has nothing but what a [`Depth`] must have, and counts the fragments that are tested.
struct Counted<'a> {
    depths: Buffer<'a, u16>,
    tested: &'a Cell<u32>,
}

impl<'d> Depth for Counted<'d> {
    type Cell<'a> = (&'a mut u16, &'d Cell<u32>);
    type Cells<'a>
        = Zip<IterMut<'a, u16>, Repeat<&'d Cell<u32>>>
    where
        Self: 'a;
    type Block<'a>
        = Infallible
    where
        Self: 'a;
    const ENABLED: bool = true;

    fn limit(&self, window: Window) -> Window {
        window
    }
    fn cells(&mut self, span: &Span) -> Self::Cells<'_> {
        let cells = self.depths.span(span.row, span.left, span.right).iter_mut();
        cells.zip(repeat(self.tested))
    }
    fn block(&mut self, _: &Window, _: usize, _: usize) -> Option<Infallible> {
        None
    }
    fn block_cells<'a, 'b: 'a>(block: &'a mut Infallible, _: usize, _: usize) -> Self::Cells<'a>
    where
        Self: 'b,
    {
        match *block {}
    }
    fn test((cell, tested): (&mut u16, &Cell<u32>), depth: u32) -> bool {
        tested.set(tested.get() + 1);
        let passes = depth < u32::from(*cell);
        if passes {
            *cell = depth as u16;
        }
        passes
    }
}

/// Of every second column something is nearer: each fragment is tested once, however it is drawn.
#[test]
fn each_fragment_is_tested_once() {
    fn drawn<F: Fragment<Varying = (), Pixel = u8>>(size: i16, fragment: &F) -> (Vec<u8>, u32) {
        let tested = Cell::new(0);
        let (mut pixels, mut depths) = (vec![0; 40 * 40], [FAR, 0].repeat(20 * 40));
        let mut depth = Counted {
            depths: Buffer::new(&mut depths, 40, 40).unwrap(),
            tested: &tested,
        };
        let corners = [(0, 0), (0, size), (size, 0)].map(|(x, y)| Corner {
            depth: FineDepth::from_bits(1000 << 15),
            ..Position::from_pixels(x, y).flat()
        });
        draw::triangle(
            &mut Buffer::new(&mut pixels, 40, 40).unwrap(),
            &mut depth,
            corners,
            fragment,
        );
        (pixels, tested.get())
    }
    for size in [4, 36] {
        let (pixels, tested) = drawn(size, &Flat(1));
        assert_eq!(tested as i16, size * (size + 1) / 2, "{size}");
        assert!(pixels.iter().enumerate().all(|(i, &pixel)| pixel == 0 || i % 2 == 0));
        assert_eq!(drawn(size, &Compact(Flat(1))), (pixels, tested), "{size}");
    }
}
