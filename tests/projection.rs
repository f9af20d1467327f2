//! From clip space to the screen: exactly the nearest subpixel, whatever the sign of w that is divided by.

mod exact;

use exact::{Exact, block, exacts};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::error::Error;
use fixel::matrix::Matrix;
use fixel::num::{Block, Word};
use fixel::span::Corners;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use proptest::prelude::*;

/// Subpixels of a position and units of a depth are integers next to the exact value: a position is exactly
/// floor(v + ½); a depth is less than this many units of 2^-15 step off.
fn depth_error<T: Word>() -> i32 {
    if T::BITS < 32 { 9 } else { 1 }
}

const FULL_DEPTH: i64 = 65535 << 15;

/// A viewport as numbers, for the words that it fits.
#[derive(Debug, Clone, Copy)]
struct Port {
    corner: [i32; 2],
    size: [u16; 2],
    up: bool,
    centers: bool,
}

impl Port {
    fn viewport<W: Word>(&self) -> Viewport<W> {
        let viewport = Viewport::new(self.corner[0], self.corner[1], self.size[0], self.size[1]).unwrap();
        let viewport = if self.up { viewport.y_up() } else { viewport };
        if self.centers {
            viewport.samples_at_centers()
        } else {
            viewport
        }
    }

    /// Twice the exact position of a point in subpixels, times w: (size·(±v + w) + 2·corner·w)·256, less w·256 for centres.
    fn doubled(&self, axis: usize, v: &Exact, w: &Exact) -> Exact {
        let v = if axis == 1 && self.up { -v } else { v.clone() };
        let whole = |n: i64| Exact::new(n, 0);
        let from_corner = &whole(self.size[axis].into()) * &(&v + w);
        let corner = &whole(2 * self.corner[axis] as i64 - self.centers as i64) * w;
        &(&from_corner + &corner) * &whole(256)
    }
}

fn ports() -> impl Strategy<Value = Port> {
    let corner = prop::array::uniform2(-3000..3000i32);
    (corner, prop::array::uniform2(0..1000u16), any::<bool>(), any::<bool>()).prop_map(|(corner, size, up, centers)| {
        Port {
            corner,
            size,
            up,
            centers,
        }
    })
}

/// position is floor(doubled/(2·w) + ½): 2·w·(position − ½) ≤ doubled < 2·w·(position + ½), moved into the guard band.
fn is_nearest(position: i32, doubled: &Exact, w: &Exact, limit: i32) -> bool {
    let twice = |n: i64| &Exact::new(n, 0) * w;
    let position = position as i64;
    let low = position == -limit as i64 || &twice(2 * position - 1) <= doubled;
    let high = position == limit as i64 || doubled < &twice(2 * position + 1);
    low && high && position.abs() <= limit as i64
}

fn check_place<T: Word, W: Word>(port: &Port, point: Block<T, 4>) -> Result<(), TestCaseError> {
    let [x, y, z, w] = exacts(point);
    let viewport = port.viewport::<W>();
    for range in [DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited] {
        let placed = viewport.place(point, range);
        prop_assert_eq!(placed.is_some(), w > Exact::zero());
        let Some((px, py, depth)) = placed else { continue };
        let limit = W::GUARD * 256;
        prop_assert!(is_nearest(px, &port.doubled(0, &x, &w), &w, limit), "x = {}", px);
        prop_assert!(is_nearest(py, &port.doubled(1, &y, &w), &w, limit), "y = {}", py);
        // Twice the depth in units, times w.
        let doubled = &Exact::new(FULL_DEPTH, 0)
            * &match range {
                DepthRange::ZeroToOne => &z + &z,
                DepthRange::MinusOneToOne => &z + &w,
                DepthRange::Unlimited => Exact::zero(),
            };
        let found = &(&Exact::new(depth, 1) * &w);
        let off = &doubled - found;
        let ends = depth_error::<T>();
        let saturated = (depth < ends && doubled <= Exact::zero())
            || (depth as i64 > FULL_DEPTH - ends as i64 && depth as i64 <= FULL_DEPTH && &doubled >= found);
        prop_assert!(
            saturated || off.abs() < &Exact::new(2 * depth_error::<T>(), 0) * &w,
            "depth {} for {:?}",
            depth,
            range
        );
    }
    Ok(())
}

/// A point with x/w and y/w mostly on or around the picture, exactly on ties now and then.
fn points() -> impl Strategy<Value = [f64; 4]> {
    let near = (prop::array::uniform3(-2.0..2.0f64), -8.0..8.0f64).prop_map(|([x, y, z], p)| {
        let w = p.exp2();
        [x * w, y * w, z * w, w]
    });
    let whole = prop::array::uniform4(-64..65i32).prop_map(|p| p.map(f64::from));
    let any = prop::array::uniform4(-1e6..1e6f64);
    prop_oneof![3 => near, 2 => whole, 1 => any].prop_filter("a point", |p| p.iter().any(|&v| v != 0.0))
}

fn view<T: Word>(port: &Port, depth_range: DepthRange, behind: Behind) -> View<T, i32, 0> {
    let (projection, planes, viewport) = (Matrix::identity(), Planes::default(), port.viewport());
    View {
        projection,
        planes,
        viewport,
        depth_range,
        behind,
        cull: Cull::Nothing,
    }
}

/// The corners of what is drawn of a triangle in clip space.
fn projected<T: Word>(view: &View<T, i32, 0>, points: [Block<T, 4>; 3]) -> Vec<Vec<(i32, i32)>> {
    let mut all = Vec::new();
    view.project::<()>(&points.map(|position| Vertex { position, carried: () }), |polygon| {
        all.push((0..polygon.count()).map(|i| polygon.position(i)).collect());
    });
    all
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn positions_are_the_nearest_subpixels(port in ports(), point in points()) {
        check_place::<i32, i32>(&port, block(point))?;
        check_place::<i64, i64>(&port, block(point))?;
        check_place::<i32, i64>(&port, block(point))?;
        check_place::<i64, i32>(&port, block(point))?;
    }

    #[test]
    fn whole_pixel_shifts_commute(port in ports(), point in points(), by in prop::array::uniform2(-90..90i32)) {
        let moved = Port { corner: [port.corner[0] + by[0], port.corner[1] + by[1]], ..port };
        let place = |port: &Port| port.viewport::<i64>().place(block::<i32, 4>(point), DepthRange::ZeroToOne);
        if let (Some((x, y, depth)), Some(shifted)) = (place(&port), place(&moved)) {
            let limit = 32768 * 256 - 90 * 256;
            if x.abs() < limit && y.abs() < limit {
                prop_assert_eq!(shifted, (x + by[0] * 256, y + by[1] * 256, depth));
            }
        }
    }

    /// A corner with w < 0 is divided by like any other: all negated, every bit is the same, and corners within the
    /// guard band are where `place` puts them, whatever the signs of the others.
    #[test]
    fn negative_w_divides(
        port in ports(), points in prop::array::uniform3((-1.0..1.0f64, -1.0..1.0f64, -3.0..3.0f64)),
        signs in prop::array::uniform3(any::<bool>()),
    ) {
        let view = view::<i32>(&port, DepthRange::Unlimited, Behind::Divide);
        let positive = points.map(|(x, y, w)| block::<i32, 4>([x * w.exp2(), y * w.exp2(), 0.0, w.exp2()]));
        let mixed = [0, 1, 2].map(|i| if signs[i] { positive[i].negated() } else { positive[i] });
        let expected = positive.map(|p| port.viewport::<i32>().place(p, DepthRange::Unlimited).unwrap());
        let expected: Vec<_> = expected.map(|(x, y, _)| (x, y)).to_vec();
        let drawn = fixel::span::doubled_area(&[expected[0], expected[1], expected[2]]) != 0;
        prop_assert_eq!(projected(&view, mixed), if drawn { vec![expected] } else { vec![] });
    }

    /// What `Behind::Cut` leaves lies in front: inside the shadow of the corners with w > 0, and nothing of a triangle
    /// that has none.
    #[test]
    fn behind_is_cut_off(port in ports(), points in prop::array::uniform3((-5.0..5.0f64, -5.0..5.0f64, 0.01..5.0f64)), behind in 0..8u8) {
        let sign = |i: usize| if behind >> i & 1 == 1 { -1.0 } else { 1.0 };
        let corners = [0, 1, 2].map(|i| block::<i64, 4>([points[i].0, points[i].1, 0.0, sign(i) * points[i].2]));
        let view = view::<i64>(&port, DepthRange::Unlimited, Behind::Cut);
        let drawn = projected(&view, corners);
        prop_assert!(behind != 7 || drawn.is_empty());
        for corner in drawn.iter().flatten() {
            prop_assert!(corner.0.abs() <= 4096 * 256 && corner.1.abs() <= 4096 * 256);
        }
    }
}

#[test]
fn w_of_zero_draws_nothing_where_it_would_be_divided_by() {
    let port = Port {
        corner: [0, 0],
        size: [64, 64],
        up: false,
        centers: false,
    };
    let points = [[0, 0, 0, 0], [1, 0, 0, 1], [0, 1, 0, 1]].map(Block::<i32, 4>::from_integers);
    assert!(projected(&view(&port, DepthRange::Unlimited, Behind::Divide), points).is_empty());
    let at_infinity = [[1, 0, 0, 0], [0, 0, 0, 1], [0, 1, 0, 1]].map(Block::<i32, 4>::from_integers);
    assert!(projected(&view(&port, DepthRange::Unlimited, Behind::Divide), at_infinity).is_empty());
    // Cut off at the guard band, a corner at infinity leaves a strip towards it.
    assert_eq!(
        projected(&view(&port, DepthRange::Unlimited, Behind::Cut), at_infinity).len(),
        1
    );
}

#[test]
fn viewports_beyond_the_guard_band_are_refused() {
    fn refused<W: Word>(left: i32, width: u16) -> bool {
        let both = [
            Viewport::<W>::new(left, 0, width, 5),
            Viewport::<W>::new(0, left, 5, width),
        ];
        assert!(both.iter().all(|v| v.is_ok()) || both.iter().all(|v| *v == Err(Error::TooLarge)));
        both[0].is_err()
    }
    assert!(!refused::<i32>(-4096, 8192) && !refused::<i32>(4096, 0) && !refused::<i32>(0, 4096));
    assert!(
        refused::<i32>(-4097, 9) && refused::<i32>(-4096, 8193) && refused::<i32>(1, 4096) && refused::<i32>(4097, 0)
    );
    assert!(
        !refused::<i64>(-32768, 65535)
            && !refused::<i64>(0, 32768)
            && refused::<i64>(1, 32768)
            && refused::<i64>(-32769, 0)
    );
    assert!(refused::<i32>(i32::MIN, 1) && refused::<i32>(i32::MAX, u16::MAX) && refused::<i64>(i32::MAX, u16::MAX));
}

/// Where one picture's corners go, by hand.
#[test]
fn the_corners_of_a_picture() {
    let viewport = Viewport::<i32>::new(10, 20, 100, 50).unwrap();
    let place = |v: Viewport<i32>, x, y| {
        v.place(Block::<i32, 4>::from_integers([x, y, 1, 2]), DepthRange::ZeroToOne)
            .unwrap()
    };
    let half = (65535 << 15) / 2;
    for (viewport, at, (x, y)) in [
        (viewport, -2, (10 * 256, 20 * 256)),
        (viewport, 2, (110 * 256, 70 * 256)),
        (viewport.y_up(), 2, (110 * 256, 20 * 256)),
        (viewport.samples_at_centers(), -2, (10 * 256 - 128, 20 * 256 - 128)),
    ] {
        let (found_x, found_y, depth) = place(viewport, at, at);
        assert_eq!((found_x, found_y), (x, y));
        assert!((depth - half).abs() < depth_error::<i32>(), "{depth}");
    }
}
