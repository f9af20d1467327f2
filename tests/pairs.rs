//! Two kinds of varyings in one primitive, and colours that are linear over the screen where planes cut their triangle:
//! against the rule of `.iv` for cut edges in float64.

mod exact;
mod naive;
mod triangles;

use exact::block;
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::matrix::Matrix;
use fixel::num::Word;
use fixel::target::Buffer;
use fixel::varying::{Linear, Perspective, Varying};
use fixel::view::{Carried, Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;
use triangles::{Keep, Triangle, cases, positions, values};

/// Pixels each way.
const SIZE: i32 = 32;
const NEAR: f64 = 0.5;
const FAR: f64 = 6.0;

type Both = (Linear<2>, Perspective<1>);

/// The pixels of a triangle in eye space, seen from the origin along −z with 90°.
fn seen<T: Word, V: Carried>(
    eye: [[f64; 3]; 3],
    carried: [V::Vertex; 3],
    depth_range: DepthRange,
) -> Vec<((i32, i32), V::Values)> {
    let view = View::<T, i32, 0> {
        projection: Matrix::frustum([-NEAR, NEAR, -NEAR, NEAR, NEAR, FAR].map(exact::scaled)).unwrap(),
        planes: Planes::default(),
        viewport: Viewport::<i32>::new(0, 0, SIZE as u16, SIZE as u16).unwrap(),
        depth_range,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    };
    let window = Window::new(0, 0, SIZE, SIZE);
    let mut pixels = vec![None; (SIZE * SIZE) as usize];
    let mut target = Buffer::strip(&mut pixels, window).unwrap();
    let vertices = [0, 1, 2].map(|i| {
        let [x, y, z] = eye[i];
        Vertex {
            position: block([x, y, z, 1.0]),
            carried: carried[i],
        }
    });
    draw::primitive(
        &view,
        &mut target,
        &mut NoDepth,
        &vertices,
        &Keep::<V>(std::marker::PhantomData),
    );
    let drawn = positions(window).zip(pixels);
    drawn.filter_map(|(at, values)| Some((at, values?))).collect()
}

/// A corner on its way to the screen: x, y, w, and a colour.
#[derive(Debug, Clone, Copy)]
struct Corner {
    x: f64,
    y: f64,
    w: f64,
    color: f64,
}

impl Corner {
    fn screen(&self) -> (f64, f64) {
        let half = SIZE as f64 / 2.0;
        ((self.x / self.w + 1.0) * half, (self.y / self.w + 1.0) * half)
    }
}

/// The edge's cut at t: s in place of t for the colour where both ends have w > 0.
fn crossing(a: Corner, b: Corner, t: f64) -> Corner {
    let mix = |a: f64, b: f64, t: f64| a + t * (b - a);
    let s = if a.w > 0.0 && b.w > 0.0 {
        t * b.w / ((1.0 - t) * a.w + t * b.w)
    } else {
        t
    };
    Corner {
        x: mix(a.x, b.x, t),
        y: mix(a.y, b.y, t),
        w: mix(a.w, b.w, t),
        color: mix(a.color, b.color, s),
    }
}

/// What the near plane and then the far plane leave, NEAR ≤ w ≤ FAR, as a fan.
fn fan(corners: [Corner; 3]) -> Vec<[Corner; 3]> {
    let kept = cut_off(&cut_off(&corners, |c| c.w - NEAR), |c| FAR - c.w);
    (2..kept.len()).map(|i| [kept[0], kept[i - 1], kept[i]]).collect()
}

fn cut_off(corners: &[Corner], distance: impl Fn(&Corner) -> f64) -> Vec<Corner> {
    let mut kept = Vec::new();
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (da, db) = (distance(&a), distance(&b));
        if da >= 0.0 {
            kept.push(a);
        }
        if (da < 0.0) != (db < 0.0) {
            kept.push(crossing(a, b, da / (da - db)));
        }
    }
    kept
}

/// A triangle on the screen: colour, gradient, and how deep (x, y) lies inside, in pixels.
struct Flat {
    value: f64,
    gradient: f64,
    inside: f64,
    altitude: f64,
}

fn flat(corners: [Corner; 3], (x, y): (f64, f64)) -> Flat {
    let at = corners.map(|c| c.screen());
    let doubled = |(ax, ay): (f64, f64), (bx, by): (f64, f64), (cx, cy): (f64, f64)| {
        (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    };
    let area = doubled(at[0], at[1], at[2]);
    let mut flat = Flat {
        value: 0.0,
        gradient: 0.0,
        inside: f64::INFINITY,
        altitude: f64::INFINITY,
    };
    let (mut gx, mut gy) = (0.0, 0.0);
    for i in 0..3 {
        let (b, c) = (at[(i + 1) % 3], at[(i + 2) % 3]);
        let share = doubled(b, c, (x, y)) / area;
        let altitude = area.abs() / (c.0 - b.0).hypot(c.1 - b.1);
        flat.value += share * corners[i].color;
        gx += corners[i].color * (b.1 - c.1) / area;
        gy += corners[i].color * (c.0 - b.0) / area;
        flat.inside = flat.inside.min(share * altitude);
        flat.altitude = flat.altitude.min(altitude);
    }
    flat.gradient = gx.abs() + gy.abs();
    flat
}

/// Corners are snapped to 1/512 px each way, those of the triangle and those of its cuts; a polygon's plane goes through
/// three of its corners, and up to four times their errors away from them. A row is off by a unit more at every column from
/// its first covered one on, wherever that lies left of the window.
fn stated(flat: &Flat, columns: f64, range: f64) -> f64 {
    4.0 * flat.gradient / 512.0 + columns + range * 2f64.powi(-22)
}

fn corners(eye: [[f64; 3]; 3], colors: [i32; 3]) -> [Corner; 3] {
    [0, 1, 2].map(|i| Corner {
        x: eye[i][0],
        y: eye[i][1],
        w: -eye[i][2],
        color: colors[i] as f64,
    })
}

/// All pixels of a triangle drawn with depth against the rule; how many there were.
fn check<T: Word>(eye: [[f64; 3]; 3], colors: [i32; 3], ranges: &[DepthRange]) -> Result<usize, TestCaseError> {
    let all = corners(eye, colors);
    let before = all.iter().all(|c| c.w > 0.0);
    let fan = if before { vec![all] } else { fan(all) };
    let thick = |t: &[Corner; 3]| flat(*t, (0.0, 0.0)).altitude > 0.25;
    prop_assume!(fan.iter().all(thick));
    let range = (colors.iter().max().unwrap() - colors.iter().min().unwrap()) as f64;
    let first = fan.iter().flatten().map(|c| c.screen().0).fold(f64::INFINITY, f64::min);
    let mut count = 0;
    for &depth_range in ranges {
        let pair = [0, 1, 2].map(|i| ([colors[i], 7], [colors[i]]));
        for (at, ([color, seven], _)) in seen::<T, Both>(eye, pair, depth_range) {
            let middle = (at.0 as f64, at.1 as f64);
            let Some(flat) = fan.iter().map(|t| flat(*t, middle)).find(|flat| flat.inside > 0.01) else {
                continue;
            };
            let off = (color as f64 - flat.value).abs();
            prop_assert!(
                off <= stated(&flat, middle.0 - first + 1.0, range),
                "{:?}: {} is not {}",
                at,
                color,
                flat.value
            );
            prop_assert!((seven - 7).abs() <= 1);
            count += 1;
        }
    }
    Ok(count)
}

/// Vertices in eye space with z from `nearest` to `farthest`.
fn eye(nearest: f64, farthest: f64) -> impl Strategy<Value = [[f64; 3]; 3]> {
    let vertex = (-6.0..6.0f64, -6.0..6.0f64, -farthest..-nearest).prop_map(|(x, y, z)| [x, y, z]);
    prop::array::uniform3(vertex)
}

fn colors() -> impl Strategy<Value = [i32; 3]> {
    prop::array::uniform3(0..=1 << 28)
}

/// What `both` carries, alone.
fn check_alone<T: Word>(eye: [[f64; 3]; 3], both: [([i32; 2], [i32; 1]); 3]) -> Result<(), TestCaseError> {
    for range in [DepthRange::MinusOneToOne, DepthRange::ZeroToOne, DepthRange::Unlimited] {
        let pair = seen::<T, Both>(eye, both, range);
        let linear = seen::<T, Linear<2>>(eye, both.map(|v| v.0), range);
        let perspective = seen::<T, Perspective<1>>(eye, both.map(|v| v.1), range);
        let zipped = linear
            .into_iter()
            .zip(&perspective)
            .map(|((at, a), (_, b))| (at, (a, *b)));
        prop_assert_eq!(perspective.len(), pair.len());
        prop_assert_eq!(pair, zipped.collect::<Vec<_>>());
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    /// To the bit, through a view and without one.
    #[test]
    fn a_pair_is_what_its_parts_are(
        eye in prop_oneof![eye(0.05, 12.0), eye(3.0, 3.001)],
        both in prop::array::uniform3((prop::array::uniform2(0..=1 << 28), prop::array::uniform1(0..=1 << 28))),
        case in cases(4096), inverses in prop::array::uniform3(1 << 20..=1i32 << 30),
    ) {
        check_alone::<i32>(eye, both)?;
        check_alone::<i64>(eye, both)?;

        let linear = [0, 1, 2].map(|i| Linear(both[i].0));
        let perspective = [0, 1, 2].map(|i| Perspective::new(both[i].1, inverses[i]));
        fn drawn<V: Varying>(corners: [(i32, i32); 3], varyings: [V; 3], window: Window) -> Vec<((i32, i32), V::Values)> {
            values::<i32, V>(&Triangle { corners, depths: [0; 3], varyings }, window)
        }
        let pair = drawn(case.corners, [0, 1, 2].map(|i| (linear[i], perspective[i])), case.window);
        let first = drawn(case.corners, linear, case.window);
        let second = drawn(case.corners, perspective, case.window);
        let zipped = first.into_iter().zip(second).map(|((at, a), (_, b))| (at, (a, b)));
        prop_assert_eq!(pair, zipped.collect::<Vec<_>>());
    }

    /// Near and far planes and the guard band change no colour of what they leave: it is that of the whole triangle.
    #[test]
    fn clipping_does_not_change_colors(eye in eye(0.02, 12.0), colors in colors()) {
        let ranges = [DepthRange::MinusOneToOne, DepthRange::ZeroToOne, DepthRange::Unlimited];
        check::<i32>(eye, colors, &ranges)?;
        check::<i64>(eye, colors, &ranges)?;
    }

    /// Vertices behind the camera: t instead of s on the edges that end there, each triangle of the fan by itself.
    #[test]
    fn colors_of_what_reaches_behind_the_camera(eye in eye(-6.0, 9.0), colors in colors()) {
        check::<i32>(eye, colors, &[DepthRange::MinusOneToOne])?;
        check::<i64>(eye, colors, &[DepthRange::MinusOneToOne])?;
    }
}

/// The cases of the two rules differ, and both kinds of edges are met: s on the one, t on the other.
#[test]
fn the_two_rules_side_by_side() {
    // Vertex 1 is nearer than the near plane but before the camera, vertex 2 behind it.
    let eye = [[0.0, 1.0, -4.0], [1.0, -0.2, -0.25], [-1.5, -0.4, 1.0]];
    let colors = [0, 1 << 28, 1 << 27];
    assert!(check::<i32>(eye, colors, &[DepthRange::MinusOneToOne]).unwrap() > 100);
    assert!(check::<i64>(eye, colors, &[DepthRange::MinusOneToOne]).unwrap() > 100);
}

/// Seen at the far end of rows that begin 2700 columns left of the window: found as a random case.
#[test]
fn rows_that_begin_far_outside() {
    let eye = [
        [0.0, -4.846933650108717, -0.02],
        [0.0, 0.0, -0.02],
        [-3.418574418189031, 0.0, -0.02],
    ];
    let colors = [53425179, 90611986, 4589720];
    assert!(check::<i32>(eye, colors, &[DepthRange::Unlimited]).unwrap() > 200);
    assert!(check::<i64>(eye, colors, &[DepthRange::Unlimited]).unwrap() > 200);
}

/// What is in perspective stays so behind the camera: value = x of a plane is found at every pixel.
#[test]
fn perspective_beside_colors_behind_the_camera() {
    let eye = [[-4.0, 1.0, -5.0], [4.0, 1.0, -5.0], [0.5, 1.0, 3.0]];
    // x + 8 in units of 2^-20.
    let carried = eye.map(|[x, ..]| ([0; 2], [((x + 8.0) * (1 << 20) as f64) as i32]));
    let pixels = seen::<i32, Both>(eye, carried, DepthRange::MinusOneToOne);
    assert!(pixels.len() > 200);
    for ((x, y), (_, [value])) in pixels {
        // The plane y = 1 is seen at w = 1/(y/w).
        let half = SIZE as f64 / 2.0;
        let w = half / (y as f64 - half);
        let wanted = (x as f64 - half) / half * w + 8.0;
        let off = (value as f64 / (1 << 20) as f64 - wanted).abs();
        // Snapped by 1/512 px: x changes by w/16 per pixel, and with w by (x/w)·w²/16.
        assert!(
            off <= 2.0 / 512.0 * (w / half + (wanted - 8.0).abs() * w / half) + 1e-4,
            "({x}, {y}): {off}"
        );
    }
}
