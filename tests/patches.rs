//! Bézier patches: within their bound of exact, the same bits for everyone who shares a point.

mod patch_grids;
mod patch_points;

use fixel::error::Error;
use fixel::num::{Block, Scaled, Word};
use fixel::patch::{ControlPoint, Level, RectangularPatch, TriangularPatch};
use patch_grids::{Control, Grid, rectangle_grid, triangle_grid};
use patch_points::{TRIANGLE, level};
use proptest::prelude::*;

/// Bernstein's cubic weights times N³.
fn cubic(i: u32, pieces: u32) -> [i128; 4] {
    let (s, u) = (i128::from(i), i128::from(pieces - i));
    [u * u * u, 3 * u * u * s, 3 * u * s * s, s * s * s]
}

/// All weights at (i, j) in the order of the control points, times 2^(6·level) for both kinds.
fn rectangle_weights(i: u32, j: u32, pieces: u32) -> Vec<i128> {
    let (s, t) = (cubic(i, pieces), cubic(j, pieces));
    t.iter().flat_map(|t| s.map(|s| s * t)).collect()
}

fn triangle_weights(i: u32, j: u32, pieces: u32) -> Vec<i128> {
    let parts = [pieces - i - j, i, j].map(i128::from);
    let factorial = [1i128, 1, 2, 6];
    let weight = |&(a, b): &(u32, u32)| {
        let powers = [3 - a - b, a, b];
        let chosen = powers.iter().fold(6, |n, &p| n / factorial[p as usize]);
        let product: i128 = parts.iter().zip(powers).map(|(v, p)| v.pow(p)).product();
        product * chosen * i128::from(pieces).pow(3)
    };
    TRIANGLE.iter().map(weight).collect()
}

/// How far a grid is from exact, as shares of the stated bounds of positions and colours.
fn shares_of_bounds<T: Word>(
    points: &[Control<T>],
    grid: &Grid<T>,
    n: u32,
    weights: fn(u32, u32, u32) -> Vec<i128>,
) -> (f64, f64) {
    let pieces = 1 << n;
    let bits = <T as Word>::BITS as i32;
    let guard = bits + 2 - 3 * n as i32;
    let nonzero = || points.iter().map(|p| p.position).filter(|p| !p.is_zero());
    let top = nonzero().map(|p| p.exponent()).max().unwrap_or(0);
    let bottom = nonzero().map(|p| p.exponent()).min().unwrap_or(0);
    // Every number here is a multiple of 2^base, and below 2^(126 + base).
    let base = (bottom - 6 * n as i32).min(top - bits - 2);
    let shifted = |m: i64, exponent: i32| {
        let m = i128::from(m);
        match exponent - base {
            _ if m == 0 => 0,
            up @ 0.. => m << up,
            down => {
                assert_eq!(m & ((1 << -down) - 1), 0);
                m >> -down
            }
        }
    };
    let (mut worst, mut worst_color) = (0f64, 0f64);
    for (j, row) in grid.iter().enumerate() {
        for (i, found) in row.iter().enumerate() {
            let weights = weights(i as u32, j as u32, pieces);
            assert_eq!(weights.iter().sum::<i128>(), 1 << (6 * n));
            let place = found.position.exponent();
            let last_place = if found.position.is_zero() {
                0.0
            } else {
                f64::powi(2.0, place - base)
            };
            let bound = last_place / 2.0 + f64::powi(2.0, top - guard - base);
            for k in 0..4 {
                let exact: i128 = points
                    .iter()
                    .zip(&weights)
                    .map(|(p, w)| w * shifted(p.position.mantissas()[k].to_i64(), p.position.exponent() - 6 * n as i32))
                    .sum();
                let error = (shifted(found.position.mantissas()[k].to_i64(), place) - exact).abs() as f64;
                worst = worst.max(error / bound);
            }
            for k in 0..3 {
                let exact: i128 = points
                    .iter()
                    .zip(&weights)
                    .map(|(p, w)| w * i128::from(p.color[k]))
                    .sum();
                let error = ((i128::from(found.color[k]) << (6 * n)) - exact).abs() as f64;
                let bound = 0.5 + f64::powi(2.0, 3 * n as i32 - 32);
                worst_color = worst_color.max(error / f64::powi(2.0, 6 * n as i32) / bound);
                let colors = || points.iter().map(|p| p.color[k]);
                assert!(colors().min() <= Some(found.color[k]) && Some(found.color[k]) <= colors().max());
            }
        }
    }
    (worst, worst_color)
}

/// Any mantissas, small ones too, with scales up to 2^`gap` apart.
fn control<T: Word>(gap: i32) -> impl Strategy<Value = Control<T>> {
    let word = |shift: u32| any::<i64>().prop_map(move |m| T::from_q62((m >> 1).max(-(1 << 62))) >> shift);
    let position = (0..20u32).prop_flat_map(move |shift| prop::array::uniform4(word(shift)));
    let channel = -(1i32 << 30)..=1 << 30;
    (position, -gap / 2..=gap / 2, prop::array::uniform3(channel)).prop_map(|(m, exponent, color)| ControlPoint {
        // Not renormalised upwards: keep the scale where it was asked for.
        position: Block::new(m, exponent),
        color,
    })
}

/// The sixteen or ten control points of a patch; scales at most `gap` bits apart after normalising.
fn controls<T: Word, const N: usize>(gap: i32) -> impl Strategy<Value = [Control<T>; N]> {
    prop::collection::vec(control::<T>(gap), N)
        .prop_map(|v| v.try_into().unwrap())
        .prop_filter("scales too far apart for exact sums", |points: &[Control<T>; N]| {
            let exponents = points
                .iter()
                .filter(|p| !p.position.is_zero())
                .map(|p| p.position.exponent());
            let spread = exponents.clone().max().unwrap_or(0) - exponents.min().unwrap_or(0);
            spread <= 14 || <T as Word>::BITS == 30 && spread <= 40
        })
}

fn within_bounds<T: Word>(rectangle: [Control<T>; 16], triangle: [Control<T>; 10], n: u32) {
    let shares = [
        shares_of_bounds(&rectangle, &rectangle_grid(rectangle, n), n, rectangle_weights),
        shares_of_bounds(&triangle, &triangle_grid(triangle, n), n, triangle_weights),
    ];
    for (position, color) in shares {
        assert!(position <= 1.0, "{position} of the bound of a position");
        assert!(color <= 1.0, "{color} of the bound of a colour");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn narrow_patches_are_within_their_bound(r in controls::<i32, 16>(24), t in controls::<i32, 10>(24), n in 1..=5u32) {
        within_bounds(r, t, n);
    }

    #[test]
    fn wide_patches_are_within_their_bound(r in controls::<i64, 16>(4), t in controls::<i64, 10>(4), n in 1..=5u32) {
        within_bounds(r, t, n);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn deep_patches_are_within_their_bound(
        r in controls::<i32, 16>(24), t in controls::<i32, 10>(24),
        wide_r in controls::<i64, 16>(4), wide_t in controls::<i64, 10>(4), n in 6..=8u32,
    ) {
        within_bounds(r, t, n);
        within_bounds(wide_r, wide_t, n);
    }
}

/// A patch with decimal coordinates: the largest error found, in last places of the largest coordinate.
#[test]
fn measured_error() {
    fn worst<T: Word>(n: u32) -> (f64, f64) {
        let coordinate = |k: i32| Scaled::<T>::from_integer(k * 7919 % 2001 - 1000).over(Scaled::from_integer(700));
        let one = Some(Scaled::from_integer(1));
        let points: [Control<T>; 16] = core::array::from_fn(|k| {
            let k = k as i32;
            let position = [coordinate(3 * k + 1), coordinate(3 * k + 2), coordinate(3 * k + 3), one];
            ControlPoint {
                position: Block::gather(position.map(Option::unwrap)),
                color: [k << 20, -k << 22, k * k],
            }
        });
        let grid = rectangle_grid(points, n);
        let exact_points = points.map(|p| p.position);
        let top = exact_points.iter().map(|p| p.exponent()).max().unwrap();
        let mut worst = 0f64;
        for (j, row) in grid.iter().enumerate() {
            for (i, found) in row.iter().enumerate() {
                let weights = rectangle_weights(i as u32, j as u32, 1 << n);
                for k in 0..4 {
                    // In units of 2^(top − 2 − 48): mantissas of 62 bits, gaps of 2, weights of 48.
                    let base = top - 2 - 6 * n as i32;
                    let sum: i128 = exact_points
                        .iter()
                        .zip(&weights)
                        .map(|(p, w)| (w * i128::from(p.mantissas()[k].to_i64())) << (p.exponent() - (top - 2)))
                        .sum();
                    let found =
                        (i128::from(found.position.mantissas()[k].to_i64())) << (found.position.exponent() - base);
                    worst = worst.max((found - sum).abs() as f64 * f64::powi(2.0, base - top));
                }
            }
        }
        let (_, color) = shares_of_bounds(&points, &grid, n, rectangle_weights);
        (worst, color)
    }
    for n in [1, 5, 8] {
        let ((narrow, color), (wide, _)) = (worst::<i32>(n), worst::<i64>(n));
        println!("level {n}: {narrow:.4} last places (32 bit), {wide:.4} (64 bit), colours {color:.4} of their bound");
        assert!(narrow <= 0.5 + 1.0 / 256.0 && wide <= 0.5001);
    }
}

/// The four sides of a rectangular grid and the three of a triangular one, as places of their control points and of their
/// grid points.
fn sides_of_rectangle(last: usize) -> [Vec<(usize, usize)>; 4] {
    let along = |f: fn(usize, usize) -> (usize, usize)| (0..=last).map(|k| f(k, last)).collect();
    [
        along(|k, _| (k, 0)),
        along(|k, last| (k, last)),
        along(|k, _| (0, k)),
        along(|k, last| (last, k)),
    ]
}

fn sides_of_triangle(last: usize) -> [Vec<(usize, usize)>; 3] {
    let along = |f: fn(usize, usize) -> (usize, usize)| (0..=last).map(|k| f(k, last)).collect();
    [
        along(|k, _| (k, 0)),
        along(|k, _| (0, k)),
        along(|k, last| (last - k, k)),
    ]
}

/// Every side of both kinds of patch, in both directions, with the same four control points and others at scales far
/// away: the very same bits.
fn borders_agree<T: Word>(border: [Control<T>; 4], r: [Control<T>; 16], t: [Control<T>; 10], n: u32) {
    let last = 1usize << n;
    let mut found: Vec<Vec<(Block<T, 4>, [i32; 3])>> = Vec::new();
    let mut record = |grid: Grid<T>, side: &[(usize, usize)], backwards: bool| {
        let mut points: Vec<_> = side
            .iter()
            .map(|&(i, j)| (grid[j][i].position, grid[j][i].color))
            .collect();
        if backwards {
            points.reverse();
        }
        found.push(points);
    };
    for backwards in [false, true] {
        let mut shared = border;
        if backwards {
            shared.reverse();
        }
        for (ends, side) in sides_of_rectangle(3).iter().zip(sides_of_rectangle(last)) {
            let mut points = r;
            ends.iter().zip(shared).for_each(|(&(i, j), p)| points[4 * j + i] = p);
            record(rectangle_grid(points, n), &side, backwards);
        }
        for (ends, side) in sides_of_triangle(3).iter().zip(sides_of_triangle(last)) {
            let mut points = t;
            for (&(i, j), p) in ends.iter().zip(shared) {
                let index = TRIANGLE.iter().position(|&place| place == (i as u32, j as u32));
                points[index.unwrap()] = p;
            }
            record(triangle_grid(points, n), &side, backwards);
        }
    }
    assert_eq!(found.len(), 14);
    assert!(found.iter().all(|points| points == &found[0]));
    assert_eq!(found[0][0], (border[0].position, border[0].color));
    assert_eq!(found[0][last], (border[3].position, border[3].color));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn shared_borders_have_the_same_bits(
        border in prop::array::uniform4(control::<i32>(20)), n in 1..=5u32,
        r in prop::collection::vec(control::<i32>(60), 16), t in prop::collection::vec(control::<i32>(60), 10),
    ) {
        borders_agree(border, r.try_into().unwrap(), t.try_into().unwrap(), n);
    }

    #[test]
    fn shared_borders_of_wide_words_have_the_same_bits(
        border in prop::array::uniform4(control::<i64>(70)), n in 1..=4u32,
        r in prop::collection::vec(control::<i64>(200), 16), t in prop::collection::vec(control::<i64>(200), 10),
    ) {
        borders_agree(border, r.try_into().unwrap(), t.try_into().unwrap(), n);
    }

    /// Nothing overflows, whatever the scales; values beyond ±2^30 are taken as ±2^30.
    #[test]
    fn any_numbers(
        mantissas in prop::collection::vec(prop::array::uniform4(any::<i32>()), 16),
        exponents in prop::collection::vec(prop_oneof![any::<i32>(), Just(i32::MAX), Just(i32::MIN), -9..9i32], 16),
        colors in prop::collection::vec(prop::array::uniform3(prop_oneof![any::<i32>(), Just(i32::MIN)]), 16),
        n in prop_oneof![1..=3u32, 1..=8u32],
    ) {
        fn points<T: Word>(m: &[[i32; 4]], e: &[i32], c: &[[i32; 3]]) -> Vec<Control<T>> {
            let all = m.iter().zip(e).zip(c);
            all.map(|((m, &e), &color)| ControlPoint { position: Block::new(m.map(T::from_i32), e), color }).collect()
        }
        let narrow = points::<i32>(&mantissas, &exponents, &colors);
        let wide = points::<i64>(&mantissas, &exponents, &colors);
        let limit = 1 << 30;
        for row in rectangle_grid::<i32>(narrow.clone().try_into().unwrap(), n) {
            prop_assert!(row.iter().all(|p| p.color.iter().all(|&v| (-limit..=limit).contains(&v))));
        }
        triangle_grid::<i32>(narrow[..10].to_vec().try_into().unwrap(), n);
        rectangle_grid::<i64>(wide.clone().try_into().unwrap(), n);
        triangle_grid::<i64>(wide[..10].to_vec().try_into().unwrap(), n);
    }
}

/// Without normals and colours, and mapped, the positions stay the same.
#[test]
fn what_is_not_asked_for_changes_nothing() {
    let bump = |k: i32| ControlPoint {
        position: Block::<i32, 4>::from_integers([k % 4 * 9, k / 4 * 7 + k % 3, k * k, 1]),
        color: [k, k << 20, -k],
    };
    let bare = |p: Control<i32>| ControlPoint {
        position: p.position,
        color: [],
    };
    let square: [_; 16] = core::array::from_fn(|k| bump(k as i32));
    let triangle: [_; 10] = core::array::from_fn(|k| bump(k as i32));
    let (mut full, mut less, mut mapped) = (Vec::new(), Vec::new(), Vec::new());
    for n in 1..=3 {
        let (whole, plain) = (RectangularPatch::new(square), RectangularPatch::new(square.map(bare)));
        whole.for_each_triangle::<true>(level(n), &mut |t| full.push(t.map(|v| v.position)));
        plain.for_each_triangle::<false>(level(n), &mut |t| {
            assert!(t.iter().all(|v| v.normal.is_zero()));
            less.push(t.map(|v| v.position));
        });
        whole.for_each_mapped::<false, _>(level(n), &mut |v| v.position, &mut |t| mapped.push(t));
        let (whole, plain) = (TriangularPatch::new(triangle), TriangularPatch::new(triangle.map(bare)));
        whole.for_each_triangle::<true>(level(n), &mut |t| full.push(t.map(|v| v.position)));
        plain.for_each_triangle::<false>(level(n), &mut |t| {
            assert!(t.iter().all(|v| v.normal.is_zero()));
            less.push(t.map(|v| v.position));
        });
        whole.for_each_mapped::<false, _>(level(n), &mut |v| v.position, &mut |t| mapped.push(t));
    }
    assert_eq!(full, less);
    assert_eq!(full, mapped);
}

#[test]
fn levels_are_checked() {
    assert_eq!(Level::new(0), Err(Error::SubdivisionLevel));
    assert_eq!(Level::new(9), Err(Error::SubdivisionLevel));
    assert_eq!(Level::new(256 + 3), Err(Error::SubdivisionLevel));
    assert_eq!(
        (1..=8).map(|n| level(n).pieces()).collect::<Vec<_>>(),
        [2, 4, 8, 16, 32, 64, 128, 256]
    );
}
