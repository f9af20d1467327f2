//! Lines and points through a view: cut ends leave the line where it was, w of either sign, planes, the depth range.

mod exact;

use exact::{Exact, block, exacts, floats};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::{Flat, Fragment};
use fixel::matrix::Matrix;
use fixel::num::{Block, Word};
use fixel::screen::SubPx;
use fixel::segment::Nearest;
use fixel::target::Buffer;
use fixel::varying::{Linear, Perspective, Varying};
use fixel::view::{Carried, Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;

const SIZE: i32 = 64;
const PICTURE: Window = Window::new(0, 0, SIZE, SIZE);

/// Clip space to 64×64 px.
fn view<T: Word, W: Word>(depth_range: DepthRange, behind: Behind) -> View<T, W, 2> {
    View {
        projection: Matrix::identity(),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, SIZE as u16, SIZE as u16).unwrap(),
        depth_range,
        behind,
        cull: Cull::CounterClockwise, // says nothing about lines
    }
}

fn vertices<T: Word>(ends: [Block<T, 4>; 2]) -> [Vertex<T, ()>; 2] {
    ends.map(|position| Vertex { position, carried: () })
}

/// The pixels that a line lights.
fn lit<T: Word, W: Word>(view: &View<T, W, 2>, ends: [Block<T, 4>; 2]) -> Vec<(i32, i32)> {
    let mut pixels = [false; (SIZE * SIZE) as usize];
    let mut target = Buffer::strip(&mut pixels, PICTURE).unwrap();
    draw::primitive_segment(view, &mut target, &mut NoDepth, &vertices(ends), &Flat(true));
    let at = |i: usize| (i as i32 % SIZE, i as i32 / SIZE);
    (0..pixels.len()).filter(|&i| pixels[i]).map(at).collect()
}

/// X, Y in px, in doubles: 10^8 px to 10^-8.
fn on_screen<T: Word>(position: Block<T, 4>) -> [f64; 2] {
    let [x, y, _, w] = floats(position);
    [x, y].map(|v| (v / w + 1.0) * SIZE as f64 / 2.0)
}

/// How near the true line may pass to the border between two pixels, and its ends to a step, for a cut end's rounding to
/// decide: 2^-7 px for snapping, and G²/h·2^(1−BITS) px for w, which is G/h times smaller than the largest component at
/// the guard band (G px out, h half the viewport).
fn border<T: Word, W: Word>() -> f64 {
    let guard = W::GUARD as f64;
    1.0 / 128.0 + guard * guard / (SIZE / 2) as f64 * 2f64.powi(1 - T::BITS as i32)
}

fn check_far<T: Word, W: Word>(ends: [[f64; 4]; 2]) -> Result<(), TestCaseError> {
    let ends = ends.map(block::<T, 4>);
    let mut found = lit::<T, W>(&view(DepthRange::Unlimited, Behind::Cut), ends);
    let [a, b] = ends.map(on_screen);
    let (dx, dy) = ((b[0] - a[0]).abs(), (b[1] - a[1]).abs());
    // Nearly diagonal: the snapped ends may step along the other axis. Nearly coincident: nothing to compare.
    prop_assume!((dx - dy).abs() > 0.01 + 0.01 * dx.max(dy));
    let major = if dx > dy { 0 } else { 1 };
    let (a, b) = if a[major] < b[major] { (a, b) } else { (b, a) };
    let border = border::<T, W>();
    for k in 0..SIZE {
        let on = k as f64 - a[major];
        let other = a[1 - major] + (b[1 - major] - a[1 - major]) * (on / (b[major] - a[major]));
        let visited = on >= 0.0 && (k as f64) < b[major];
        let lit = |across: f64| {
            let across = (across + 0.5).floor() as i32;
            let pixel = if major == 0 { (k, across) } else { (across, k) };
            PICTURE.contains(pixel).then_some(pixel)
        };
        // What the line lights here, and what it may light if rounding moves it.
        let near_end = on.abs() < border || (b[major] - k as f64).abs() < border;
        let mut allowed = vec![if visited { lit(other) } else { None }];
        if visited || near_end {
            allowed.extend([lit(other - border), lit(other + border)]);
        }
        if near_end {
            allowed.push(None);
        }
        let here: Vec<_> = found
            .iter()
            .copied()
            .filter(|&(x, y)| if major == 0 { x == k } else { y == k })
            .collect();
        found.retain(|at| !here.contains(at));
        prop_assert!(here.len() <= 1, "two at step {}", k);
        prop_assert!(
            allowed.contains(&here.first().copied()),
            "{:?}, not {:?}, at {}",
            here,
            allowed,
            other
        );
    }
    prop_assert!(found.is_empty());
    Ok(())
}

/// Two ends on either side of a point of the picture, up to 10^8 px away, at any scale.
fn far_ends() -> impl Strategy<Value = [[f64; 4]; 2]> {
    let far = || (-1.0..8.0f64, -3.0..3.0f64);
    (
        0.0..64.0f64,
        0.0..64.0f64,
        0.0..std::f64::consts::TAU,
        far(),
        far(),
        any::<bool>(),
    )
        .prop_map(|(x, y, angle, a, b, level)| {
            let angle = if level { (angle - 3.0) * 1e-6 } else { angle };
            [(1.0, a), (-1.0, b)].map(|(sign, (distance, scale))| {
                let (distance, w) = (sign * 10f64.powf(distance), 10f64.powf(scale));
                let clip = |v: f64| (v / 32.0 - 1.0) * w;
                [
                    clip(x + distance * angle.cos()),
                    clip(y + distance * angle.sin()),
                    0.0,
                    w,
                ]
            })
        })
}

/// Ends whose projections lie on the picture or near it, w from 1/4 to 4 with the given signs.
fn near_ends() -> impl Strategy<Value = [[f64; 4]; 2]> {
    let end = (
        -20.0..84.0f64,
        -20.0..84.0f64,
        -1.0..1.0f64,
        -2.0..2.0f64,
        any::<bool>(),
    );
    prop::array::uniform2(end).prop_map(|ends| {
        ends.map(|(x, y, z, w, negative)| {
            let w = w.exp2() * if negative { -1.0 } else { 1.0 };
            [(x / 32.0 - 1.0) * w, (y / 32.0 - 1.0) * w, z * w, w]
        })
    })
}

/// The true position in subpixels, rounded half up, and how far from the tie.
fn snapped<T: Word>(position: Block<T, 4>) -> ((i32, i32), f64) {
    let exact = on_screen(position).map(|v| v * 256.0 + 0.5);
    let [x, y] = exact.map(|v| v.floor() as i32);
    (
        (x, y),
        exact.map(|v| (v - v.round()).abs()).into_iter().fold(1.0, f64::min),
    )
}

/// Where nothing is cut, the view's line is the one between the snapped ends, and its values are those of its ends.
fn check_near<T: Word, W: Word>(ends: [[f64; 4]; 2]) -> Result<(), TestCaseError> {
    let ends = ends.map(block::<T, 4>);
    let places = ends.map(snapped);
    prop_assume!(places.iter().all(|p| p.1 > 1e-6));
    let found = lit::<T, W>(&view(DepthRange::MinusOneToOne, Behind::Divide), ends);
    let mut wanted: Vec<_> = Nearest::<W>::new(&places.map(|p| p.0), PICTURE).collect();
    wanted.sort_by_key(|&(x, y)| (y, x));
    prop_assert_eq!(found, wanted);
    Ok(())
}

/// Keeps the one value.
struct Keep<V>(std::marker::PhantomData<V>);

impl<V: Varying<Values = [i32; 1]>> Fragment for Keep<V> {
    type Varying = V;
    type Pixel = Option<i32>;
    fn shade(&self, [value]: [i32; 1], _: Option<i32>) -> Option<Option<i32>> {
        Some(Some(value))
    }
}

fn kept<T: Word, V: Carried<Vertex = [i32; 1]> + Varying<Values = [i32; 1]>>(
    view: &View<T, i32, 2>,
    ends: [Vertex<T, [i32; 1]>; 2],
) -> Vec<((i32, i32), i32)> {
    let mut pixels = [None; (SIZE * SIZE) as usize];
    let mut target = Buffer::strip(&mut pixels, PICTURE).unwrap();
    draw::primitive_segment(
        view,
        &mut target,
        &mut NoDepth,
        &ends,
        &Keep::<V>(std::marker::PhantomData),
    );
    let at = |i: usize| (i as i32 % SIZE, i as i32 / SIZE);
    pixels
        .into_iter()
        .enumerate()
        .filter_map(|(i, v)| Some((at(i), v?)))
        .collect()
}

/// Values of a line from the picture to beyond a plane and behind the camera: those of the whole line. In perspective
/// they are linear in space, so that at a pixel's sample the value says where in space its point lies.
fn check_values<T: Word>(x: f64, y: f64, depth: f64, turn: f64) -> Result<(), TestCaseError> {
    let mut view = view::<T, i32>(DepthRange::Unlimited, Behind::Cut);
    // The far end, at w = −1, is cut off twice: at w = 0, and half way, where z = 0.
    view.planes.push(block([0.0, 0.0, 0.0, 1.0])).unwrap();
    view.planes.push(block([0.0, 0.0, 1.0, 0.0])).unwrap();
    let ends = [
        [(x / 32.0 - 1.0) * depth, (y / 32.0 - 1.0) * depth, 1.0, depth],
        [turn, 1.0, -1.0, -1.0],
    ];
    let carried = [0, 1 << 28];
    let vertices = [0, 1].map(|i| Vertex {
        position: block::<T, 4>(ends[i]),
        carried: [carried[i]],
    });
    let ends = vertices.map(|v| floats(v.position));
    for (at, value) in kept::<T, Perspective<1>>(&view, vertices) {
        let t = value as f64 / carried[1] as f64;
        prop_assert!((-1e-9..=0.5 + 1e-6).contains(&t), "{} is beyond the plane", t);
        let [px, py, _, w] = [0, 1, 2, 3].map(|i| ends[0][i] + (ends[1][i] - ends[0][i]) * t);
        let [px, py] = [px, py].map(|v| (v / w + 1.0) * 32.0);
        // Along its stepping axis the point is at the sample: to half a subpixel at either end, and 2^-10 px.
        let off = (px - at.0 as f64).abs().min((py - at.1 as f64).abs());
        prop_assert!(off <= 3.0 / 512.0, "{:?}: the value is that of ({}, {})", at, px, py);
    }
    Ok(())
}

fn point() -> impl Strategy<Value = [f64; 4]> {
    let one = || prop_oneof![2 => -3.0..3.0f64, 1 => (-3..4i32).prop_map(f64::from), 1 => -1e6..1e6f64];
    (one(), one(), one(), one()).prop_map(|(x, y, z, w)| [x, y, z, w])
}

fn check_point<T: Word>(
    point: [f64; 4],
    plane: [f64; 4],
    range: DepthRange,
    behind: Behind,
) -> Result<(), TestCaseError> {
    let mut view = view::<T, i32>(range, behind);
    let (point, plane) = (block::<T, 4>(point), block::<T, 4>(plane));
    view.planes.push(plane).unwrap();
    let [_, _, z, w] = exacts(point);
    let zero = Exact::zero();
    let (z, w) = if behind == Behind::Divide && w < zero {
        (-&z, -&w)
    } else {
        (z, w)
    };
    let in_range = match range {
        DepthRange::ZeroToOne => z >= zero && z <= w,
        DepthRange::MinusOneToOne => z >= -&w && z <= w,
        DepthRange::Unlimited => true,
    };
    let kept = exact::dot(&exacts(point), &exacts(plane)) >= zero && w > zero && in_range;
    let found = view.project_point(point);
    prop_assert_eq!(found.is_some(), kept);
    let Some(center) = found else { return Ok(()) };
    let ((x, y), _) = snapped(point);
    // Doubles decide the last digit differently near a tie, and less exactly far out.
    let near = |found: SubPx, truth: i32| {
        let off = (found.to_bits() as f64 - truth as f64).abs();
        off <= 1.0 + (truth as f64).abs() * 1e-9
    };
    prop_assert!(
        near(center.x, x) && near(center.y, y),
        "{:?} is not ({}, {})",
        center,
        x,
        y
    );
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn ends_far_away_light_what_the_true_line_lights(ends in far_ends()) {
        check_far::<i32, i32>(ends)?;
        check_far::<i64, i32>(ends)?;
        check_far::<i32, i64>(ends)?;
        check_far::<i64, i64>(ends)?;
    }

    #[test]
    fn whatever_the_signs_of_w_the_line_joins_the_projected_ends(ends in near_ends()) {
        check_near::<i32, i32>(ends)?;
        check_near::<i64, i64>(ends)?;
    }

    #[test]
    fn values_in_perspective_survive_cuts(x in 0.0..64.0f64, y in 0.0..64.0f64, depth in 1.5..5.0f64, turn in -2.0..2.0f64) {
        check_values::<i32>(x, y, depth, turn)?;
        check_values::<i64>(x, y, depth, turn)?;
    }

    #[test]
    fn points_are_dropped_exactly_and_placed_to_half_a_subpixel(
        point in point(), plane in point(),
        range in prop::sample::select(&[DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited][..]),
        behind in prop::sample::select(&[Behind::Cut, Behind::Divide][..]),
    ) {
        check_point::<i32>(point, plane, range, behind)?;
        check_point::<i64>(point, plane, range, behind)?;
    }
}

/// Without a w that can be divided by there is nothing: w = 0 at an end, w < 0 cut off, all beyond a plane or the range.
#[test]
fn nothing_to_draw() {
    let ends = |a: [i32; 4], b: [i32; 4]| [a, b].map(Block::<i32, 4>::from_integers);
    let divided = view::<i32, i32>(DepthRange::MinusOneToOne, Behind::Divide);
    let cut = view::<i32, i32>(DepthRange::MinusOneToOne, Behind::Cut);
    assert!(lit(&divided, ends([-1, 0, 0, 1], [1, 0, 0, 0])).is_empty());
    assert!(!lit(&divided, ends([-1, 0, 0, 1], [-1, 0, 0, -1])).is_empty());
    assert!(lit(&cut, ends([-1, 0, 0, -1], [1, 0, 0, -1])).is_empty());
    assert!(lit(&cut, ends([-1, 0, 2, 1], [1, 0, 2, 1])).is_empty());
    assert!(
        !lit(&cut, ends([-1, 0, 1, 1], [1, 0, 1, 1])).is_empty(),
        "the end of the range is in it"
    );
    let mut planes = cut;
    planes.planes.push(Block::from_integers([0, 1, 0, 0])).unwrap();
    assert!(lit(&planes, ends([-1, -1, 0, 1], [1, -1, 0, 1])).is_empty());
    assert!(
        !lit(&planes, ends([-1, 0, 0, 1], [1, 0, 0, 1])).is_empty(),
        "on the plane is inside"
    );
}

/// A plane through the middle, the depth range at three quarters: the rest of the line is where it was.
#[test]
fn planes_and_the_depth_range_cut_where_they_are() {
    let mut view = view::<i32, i32>(DepthRange::MinusOneToOne, Behind::Cut);
    view.planes.push(Block::from_integers([1, 0, 0, 0])).unwrap();
    // x from 0 to 64 px, depth −1 to 5/3: 1 at x = 48.
    let ends = [[-3, -1, -3, 3], [3, 1, 5, 3]].map(Block::<i32, 4>::from_integers);
    let found = lit(&view, ends);
    let columns: std::collections::BTreeSet<_> = found.iter().map(|p| p.0).collect();
    assert_eq!(columns.first(), Some(&32));
    assert_eq!(columns.last(), Some(&47));
    assert_eq!(columns.len(), 16);
    // y goes from 64/3 to 128/3 px.
    for (x, y) in found {
        let truth = 64.0 / 3.0 + x as f64 / 3.0 + 0.5;
        assert!(
            (y as f64 - truth.floor()).abs() <= 1.0 && (y as f64 <= truth + 0.01 && truth - 1.01 <= y as f64),
            "({x}, {y})"
        );
    }
}

/// Linear values are linear over the screen.
#[test]
fn linear_values_are_linear_over_the_screen() {
    let view = view::<i32, i32>(DepthRange::Unlimited, Behind::Cut);
    let ends = [([-1, 0, 0, 1], 0), ([4, 0, 0, 4], 64 << 20)];
    let vertices = ends.map(|(p, v)| Vertex {
        position: Block::<i32, 4>::from_integers(p),
        carried: [v],
    });
    for ((x, _), value) in kept::<_, Linear<1>>(&view, vertices) {
        assert!((value - (x << 20)).abs() <= x + 2, "{value} at {x}");
    }
}

/// Cut by planes on both sides, a line keeps two corners: the cut points.
#[test]
fn a_cut_line_is_a_line() {
    let mut planes = Planes::<i32, 2>::default();
    planes.push(Block::from_integers([1, 0, 0, 0])).unwrap();
    planes.push(Block::from_integers([-1, 0, 0, 1])).unwrap();
    for ends in [[[-3, 0, 0, 1], [5, 8, 0, 1]], [[5, 8, 0, 1], [-3, 0, 0, 1]]] {
        let line = planes.clip(ends.map(Block::from_integers)).unwrap();
        let mut points: Vec<_> = line
            .iter()
            .map(|c| floats(c.position))
            .map(|[x, y, _, w]| (x / w, y / w))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(points, [(0.0, 3.0), (1.0, 4.0)]);
    }
}
