//! Camera, viewport, depth, and perspective-correct interpolation: chapters 07 and 08.

mod course;

use course::{
    SIDE, Seen, all_near, at, block, buffer, deep, draw, floats, lit, matrix, near, picture, pixel, program, real,
    scaled, square, state, unit,
};
use fixel::clip::DepthRange;
use fixel::depth::{Always, DepthBuffer, FAR, Greater, Keep, LessOrEqual, NoDepth, Options, Relation, Switched};
use fixel::matrix::Matrix;
use fixel::num::{Angle, Block, SineTable};
use fixel::pipeline::{self, State, clip_line};
use fixel::target::Buffer;
use fixel::viewport::Viewport;

fn camera() -> Matrix<i32> {
    Matrix::look_at(block([-2.5, 1.0, 0.0]), block([0.0; 3]), block([0.0, 1.0, 0.0])).unwrap()
}

fn perspective(degrees: i32, aspect: f64, near: f64, far: f64) -> Matrix<i32> {
    let angle = Angle::from_degrees(degrees);
    Matrix::perspective::<SineTable>(angle, scaled(aspect), scaled(near), scaled(far)).unwrap()
}

#[test]
fn item_07_1_look_at() {
    let want = [
        0.0, 0.0, 1.0, 0.0, 0.371391, 0.928477, 0.0, 0.0, -0.928477, 0.371391, 0.0, -2.692582, 0.0, 0.0, 0.0, 1.0,
    ];
    all_near(matrix(&camera()), want, 1e-6);
}

#[test]
fn item_07_2_perspective_by_the_horizontal_angle() {
    let got = matrix(&perspective(120, 4.0 / 3.0, 0.1, 100.0));
    let (x, y) = (0.57735, 0.769800);
    let want = [
        x, 0.0, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, -1.002002, -0.200200, 0.0, 0.0, -1.0, 0.0,
    ];
    all_near(got, want, 1e-6);
    // The corners of the visible volume go to ±1.
    let project = |p: [f64; 4]| {
        let [x, y, z, w] = floats(perspective(90, 2.0, 1.0, 3.0).transform(block(p)));
        [x / w, y / w, z / w]
    };
    all_near(project([1.0, 0.5, -1.0, 1.0]), [1.0, 1.0, -1.0], 1e-7);
    all_near(project([-3.0, 1.5, -3.0, 1.0]), [-1.0, 1.0, 1.0], 1e-7);
    let flat = |angle, far| Matrix::<i32>::perspective::<SineTable>(angle, scaled(1.0), scaled(1.0), scaled(far));
    assert!(flat(Angle::from_degrees(0), 2.0).is_err() && flat(Angle::from_degrees(90), 1.0).is_err());
}

#[test]
fn item_07_3_clipped_in_clip_space_by_the_near_plane() {
    let projection = perspective(90, 1.0, 1.0, 3.0);
    let ends = [[0.0, 0.0, -2.0, 1.0], [1.0, 0.0, 1.0, 1.0]].map(|p| projection.transform(block(p)));
    all_near(floats(ends[0]), [0.0, 0.0, 1.0, 2.0], 1e-7);
    all_near(floats(ends[1]), [1.0, 0.0, -5.0, -1.0], 1e-7);
    let [_, cut] = clip_line(ends, Block::from_integers([0, 0, 1, 1])).unwrap();
    all_near(floats(cut), [1.0 / 3.0, 0.0, -1.0, 1.0], 1e-6);
    // That line in the pipeline: from the middle to the right third, where it is cut.
    let mut pixels = picture(0u8);
    let white = program(|_, []: [i32; 0]| Some(1u8));
    pipeline::lines(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &white,
        ends.map(|p| (p, [])),
    );
    assert_eq!(lit(&pixels), (150..=200).map(|x| (x, 150)).collect());
    // Behind the camera nothing shows.
    let behind = [[-1.0, -1.0, 2.0, 1.0], [1.0, -1.0, 2.0, 1.0], [0.0, 1.0, 5.0, 1.0]];
    let mut pixels = picture(0u8);
    draw(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &white,
        &behind.map(|p| (projection.transform(block(p)), [])),
    );
    assert!(lit(&pixels).is_empty());
    // Beyond the far end: drawn without depth, never with it.
    let beyond = square([10.0, 10.0, 20.0, 20.0], 1.5, []);
    draw(&state(), &mut buffer(&mut pixels), &mut NoDepth, &white, &beyond);
    assert_eq!(lit(&pixels).len(), 100);
    let (mut pixels, mut depths) = (picture(0u8), picture(FAR));
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(buffer(&mut depths));
    draw(&state(), &mut buffer(&mut pixels), &mut depth, &white, &beyond);
    pipeline::lines(&state(), &mut buffer(&mut pixels), &mut depth, &white, &beyond[..2]);
    assert!(lit(&pixels).is_empty());
}

/// Through the far end: the part within the range passes, with the depths that the whole has.
#[test]
fn item_07_3_a_polygon_through_the_far_end_keeps_its_depths() {
    let corners = [
        deep((0.0, 0.0), 0.5, []),
        deep((200.0, 0.0), 1.5, []),
        deep((0.0, 200.0), 0.5, []),
    ];
    let white = program(|_, []: [i32; 0]| Some(1u8));
    let (mut pixels, mut depths) = (picture(0u8), picture(FAR));
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(buffer(&mut depths));
    draw(&state(), &mut buffer(&mut pixels), &mut depth, &white, &corners);
    let line = [deep((0.5, 250.5), 0.5, []), deep((200.5, 250.5), 1.5, [])];
    pipeline::lines(&state(), &mut buffer(&mut pixels), &mut depth, &white, line);
    for y in 0..SIDE {
        for x in 0..SIDE {
            let z = 0.5 + (f64::from(x) + 0.5) / 200.0;
            let drawn = pixel(&pixels, x, y) == 1;
            if y == 250 {
                assert_eq!(drawn, x <= 100, "line at {x}");
                continue;
            }
            let inside = f64::from(x) + f64::from(y) + 1.0 < 200.0;
            // The cut at x = 100 and the edge go through no centre but on the diagonal.
            assert!(
                f64::from(x) + f64::from(y) + 1.0 == 200.0 || drawn == (inside && x < 100),
                "({x}, {y})"
            );
            if drawn {
                near(f64::from(pixel(&depths, x, y)), z * 65535.0, 1.0);
            }
        }
    }
    // What passes there counts as the end of the range.
    let (mut pixels, mut depths) = (picture(0u8), picture(0u16));
    let mut depth = DepthBuffer::<_, Greater>::new(buffer(&mut depths));
    draw(&state(), &mut buffer(&mut pixels), &mut depth, &white, &corners);
    assert_eq!((pixel(&pixels, 150, 10), pixel(&depths, 150, 10)), (1, FAR));
    assert!(lit(&pixels) == lit(&course::triangles_hit(&state(), &corners)));
    // Before it, without a near plane: 0.
    let front = [
        deep((0.0, 0.0), -0.5, []),
        deep((200.0, 0.0), 0.5, []),
        deep((0.0, 200.0), -0.5, []),
    ];
    let open = state().with_planes(fixel::clip::Planes::<i32, 0>::default());
    let (mut pixels, mut depths) = (picture(0u8), picture(FAR));
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(buffer(&mut depths));
    draw(&open, &mut buffer(&mut pixels), &mut depth, &white, &front);
    assert_eq!((pixel(&pixels, 10, 10), pixel(&depths, 10, 10)), (1, 0));
    near(f64::from(pixel(&depths, 149, 10)), 65535.0 * (149.5 / 200.0 - 0.5), 1.0);
}

/// 1/w is what is left of w after the division.
#[test]
fn item_07_4_the_division_keeps_inverse_w() {
    let mut pixels = picture(Seen::default());
    let look = program(|at, []: [i32; 0]| Some(Seen(at.inverse_w().to_fixed(24) as i32, 1, 0, 0)));
    let flat = [[-1, -1, 0, 4], [4, -4, 0, 4], [-4, 4, 0, 4]].map(|p| (Block::from_integers(p), []));
    draw(&state(), &mut buffer(&mut pixels), &mut NoDepth, &look, &flat);
    assert_eq!(pixel(&pixels, 120, 120).0, 1 << 22);
}

#[test]
fn item_07_5_viewport_and_depth_range() {
    let world = block([-1.75, 0.5, -1.0, 1.0]);
    let clip = perspective(120, 4.0 / 3.0, 0.1, 100.0).transform(camera().transform(world));
    all_near(floats(clip), [-0.57735, -0.142948, 0.683619, 0.882053], 2e-6);
    let viewport = Viewport::<i32>::new(0, 0, 400, 300).unwrap();
    let (x, y, z) = viewport.place(clip, DepthRange::MinusOneToOne).unwrap();
    // Snapped to 1/256 px; the drawn pixel's own values are looked at in 05.7.
    all_near(
        [x, y].map(|v| f64::from(v) / 256.0),
        [69.0894, 125.6905],
        0.5 / 256.0 + 1e-4,
    );
    near(f64::from(z) / f64::from(65535u32 << 15), 0.887516, 1e-5);
    let [.., w] = floats(clip);
    near(1.0 / w, 1.133719, 1e-5);
}

#[test]
fn item_07_6_a_viewport_is_a_part_of_the_image() {
    let mut pixels = vec![0u8; 300 * 200];
    let white = program(|_, []: [i32; 0]| Some(1u8));
    let scene = [[-3, -1, 0, 1], [1, -2, 0, 1], [0, 3, 0, 1]].map(|p| (Block::from_integers(p), []));
    let rays = [[-2, -2, 0, 1], [3, 2, 0, 1]].map(|p| (Block::from_integers(p), []));
    let half = |left| State::<_, i32, i32, 1>::new(Viewport::new(left, 0, 150, 200).unwrap().samples_at_centers());
    let mut drawn = Vec::new();
    for left in [0, 150] {
        let mut alone = vec![0u8; 300 * 200];
        for image in [&mut alone, &mut pixels] {
            let mut target = Buffer::new(image, 300, 200).unwrap();
            draw(&half(left), &mut target, &mut NoDepth, &white, &scene);
            pipeline::lines(&half(left), &mut target, &mut NoDepth, &white, rays);
        }
        let outside = |i: &usize| (i % 300 < 150) != (left == 0);
        assert!((0..alone.len()).filter(outside).all(|i| alone[i] == 0));
        drawn.push(alone);
    }
    assert!(pixels.chunks(300).all(|row| row[..150] == row[150..]));
    assert!(drawn[0].iter().filter(|&&p| p == 1).count() > 5000);
}

#[test]
fn item_07_7_a_depth_buffer_is_optional() {
    let mut pixels = picture(0u8);
    let white = program(|_, []: [i32; 0]| Some(1u8));
    draw(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &white,
        &square([0.0, 0.0, 9.0, 9.0], 0.5, []),
    );
    assert_eq!(lit(&pixels).len(), 81);
}

/// The colour and the depth of a pixel after a square of colour 1 at depth ½ and a second one of colour 2 at depth `z`,
/// which is drawn by the closure.
fn after_two(z: f64, second: impl FnOnce(&mut Buffer<u8>, Buffer<u16>, &[course::Vertex<1>])) -> (u8, u16) {
    let (mut pixels, mut depths) = (picture(0u8), picture(FAR));
    let area = [0.0, 0.0, 9.0, 9.0];
    let mut first = DepthBuffer::<_, LessOrEqual>::new(buffer(&mut depths));
    draw(
        &state(),
        &mut buffer(&mut pixels),
        &mut first,
        &colored(),
        &square(area, 0.5, [1]),
    );
    second(&mut buffer(&mut pixels), buffer(&mut depths), &square(area, z, [2]));
    (pixel(&pixels, 5, 5), pixel(&depths, 5, 5))
}

fn colored()
-> impl pipeline::Program<Vertex = course::Vertex<1>, Varying = [i32; 1], At = pipeline::FragCoord, Output = u8> {
    program(|_, [c]: [i32; 1]| Some(c as u8))
}

const HALF: u16 = 32768;
const NEAR: u16 = 16384;
const BACK: u16 = 49151;

#[test]
fn item_07_8_depth_test() {
    let tested = |z| {
        after_two(z, |color, depths, vertices| {
            let mut depth = DepthBuffer::<_, LessOrEqual>::new(depths);
            draw(&state(), color, &mut depth, &colored(), vertices);
        })
    };
    // Equal passes.
    assert_eq!(tested(0.5), (2, HALF));
    assert_eq!(tested(0.25), (2, NEAR));
    assert_eq!(tested(0.75), (1, HALF));
    // Without a buffer, or with the test off: the last one wins.
    let off = |z| {
        after_two(z, |color, _, vertices| {
            draw(&state(), color, &mut NoDepth, &colored(), vertices)
        })
    };
    assert_eq!(off(0.75), (2, HALF));
    // Chosen when drawing: all of them.
    let relations = [
        (Relation::Less, [2, 1, 1]),
        (Relation::LessOrEqual, [2, 2, 1]),
        (Relation::Equal, [1, 2, 1]),
        (Relation::NotEqual, [2, 1, 2]),
        (Relation::Greater, [1, 1, 2]),
        (Relation::GreaterOrEqual, [1, 2, 2]),
        (Relation::Always, [2, 2, 2]),
    ];
    for (passes, want) in relations {
        let got = [0.25, 0.5, 0.75].map(|z| switched(z, Options { passes, stores: true }).0);
        assert_eq!(got, want, "{passes:?}");
    }
}

fn switched(z: f64, options: Options) -> (u8, u16) {
    after_two(z, |color, depths, vertices| {
        let mut depth = Switched::new(depths);
        depth.options = options;
        draw(&state(), color, &mut depth, &colored(), vertices);
    })
}

#[test]
fn item_07_9_depth_write() {
    // Test off, write on.
    let stores = after_two(0.75, |color, depths, vertices| {
        let mut depth = DepthBuffer::<_, Always>::new(depths);
        draw(&state(), color, &mut depth, &colored(), vertices);
    });
    assert_eq!(stores, (2, BACK));
    // Write off: the colour alone.
    let keeps = after_two(0.25, |color, depths, vertices| {
        let mut depth = DepthBuffer::<_, Keep<LessOrEqual>>::new(depths);
        draw(&state(), color, &mut depth, &colored(), vertices);
    });
    assert_eq!(keeps, (2, HALF));
    let options = |passes, stores| Options { passes, stores };
    assert_eq!(switched(0.25, options(Relation::LessOrEqual, false)), (2, HALF));
    assert_eq!(switched(0.75, options(Relation::LessOrEqual, false)), (1, HALF));
    assert_eq!(switched(0.75, options(Relation::Always, true)), (2, BACK));
    assert_eq!(switched(0.75, options(Relation::Always, false)), (2, HALF));
}

#[test]
fn item_07_10_window_depth_is_linear_over_the_window() {
    let projection = perspective(90, 1.0, 1.0, 3.0);
    for (z, want) in [(-1.0, 0.0), (-1.5, 0.5), (-2.0, 0.75), (-3.0, 1.0)] {
        let [_, _, z, w] = floats(projection.transform(block([0.0, 0.0, z, 1.0])));
        near((z / w + 1.0) / 2.0, want, 1e-6);
    }
    // From z = −1 at the left border to z = −3 at the right one: halfway over the window, depth is halfway.
    let corner = |x: f64, y: f64, z: f64| (projection.transform(block([x * -z, y * -z, z, 1.0])), []);
    let quad = [
        corner(-1.0, -1.0, -1.0),
        corner(1.0, -1.0, -3.0),
        corner(-1.0, 1.0, -1.0),
    ];
    let look = program(|at, []: [i32; 0]| Some(Seen(1, 0, 0, at.z.to_bits())));
    let mut pixels = picture(Seen::default());
    draw(&state(), &mut buffer(&mut pixels), &mut NoDepth, &look, &quad);
    let mut line = picture(Seen::default());
    pipeline::lines(
        &state(),
        &mut buffer(&mut line),
        &mut NoDepth,
        &look,
        [corner(-1.0, 0.01, -1.0), corner(1.0, 0.01, -3.0)],
    );
    for x in 0..SIDE {
        let want = (f64::from(x) + 0.5) / 300.0;
        let row = if x < 290 { Some(pixel(&pixels, x, 2)) } else { None };
        for seen in row.into_iter().chain([pixel(&line, x, 151)]) {
            assert_eq!(seen.0, 1);
            // A unit of 2^-15 step per pixel of the row.
            near(f64::from(seen.3) / f64::from(65535u32 << 15), want, 1e-6);
        }
    }
}

/// A point in pixels with any w.
fn with_w<const N: usize>(p: (f64, f64), w: f64, values: [i32; N]) -> course::Vertex<N> {
    let [x, y, z, s] = floats(at::<0>(p, []).0);
    (block([x / s * w, y / s * w, z / s * w, w]), values)
}

#[test]
fn item_08_1_corrected_weights_of_a_triangle() {
    let identity = |i: usize| [0, 1, 2].map(|k| if i == k { unit(1.0) } else { 0 });
    // The centre of pixel (100, 100) has weights ⅓ each.
    let corners = [((40.5, 70.5), 1.0), ((190.5, 70.5), 2.0), ((70.5, 160.5), 4.0)];
    let vertices = [0, 1, 2].map(|i| with_w(corners[i].0, corners[i].1, identity(i)));
    let mut seen = picture(Seen::default());
    let look = program(|_, [u, v, w]: [i32; 3]| Some(Seen(u, v, w, 1)));
    draw(&state(), &mut buffer(&mut seen), &mut NoDepth, &look, &vertices);
    let Seen(u, v, w, _) = pixel(&seen, 100, 100);
    all_near([u, v, w].map(real), [4.0 / 7.0, 2.0 / 7.0, 1.0 / 7.0], 1e-6);
}

#[test]
fn item_08_2_corrected_on_a_line() {
    let ends = [
        with_w((50.5, 80.5), 1.0, [unit(1.0)]),
        with_w((250.5, 80.5), 3.0, [unit(-1.0)]),
    ];
    let look = program(|_, [v]: [i32; 1]| Some(Seen(v, 1, 0, 0)));
    let mut pixels = picture(Seen::default());
    pipeline::lines(&state(), &mut buffer(&mut pixels), &mut NoDepth, &look, ends);
    near(real(pixel(&pixels, 150, 80).0), 0.75 - 0.25, 1e-6);
    for x in 50..=250 {
        let t = f64::from(x - 50) / 200.0;
        let (a, b) = ((1.0 - t) / 1.0, t / 3.0);
        near(real(pixel(&pixels, x, 80).0), (a - b) / (a + b), 1e-6);
    }
    let mut linear = picture(Seen::default());
    pipeline::lines(&state().linear(), &mut buffer(&mut linear), &mut NoDepth, &look, ends);
    near(real(pixel(&linear, 150, 80).0), 0.0, 1e-6);
}

/// A floor in perspective: its coordinates are those of the ray through the pixel only where they are corrected.
#[test]
fn item_08_3_linear_or_perspective_corrected() {
    let projection = perspective(90, 1.0, 1.0, 10.0);
    let corner = |x: f64, z: f64| {
        (
            projection.transform(block([x, -1.0, z, 1.0])),
            [unit(x / 4.0), unit(z / 8.0)],
        )
    };
    let [a, b, c, d] = [
        corner(-4.0, -1.0),
        corner(4.0, -1.0),
        corner(4.0, -8.0),
        corner(-4.0, -8.0),
    ];
    let floor = [a, b, c, a, c, d];
    let look = program(|_, [x, z]: [i32; 2]| Some(Seen(x, z, 1, 0)));
    let (mut corrected, mut linear) = (picture(Seen::default()), picture(Seen::default()));
    draw(&state(), &mut buffer(&mut corrected), &mut NoDepth, &look, &floor);
    draw(&state().linear(), &mut buffer(&mut linear), &mut NoDepth, &look, &floor);
    let (mut count, mut different) = (0, 0);
    for y in 0..130 {
        for x in 0..SIDE {
            let (ray_x, ray_y) = ((f64::from(x) + 0.5) / 150.0 - 1.0, (f64::from(y) + 0.5) / 150.0 - 1.0);
            let want = (-ray_x / ray_y, 1.0 / ray_y);
            let (got, flat) = (pixel(&corrected, x, y), pixel(&linear, x, y));
            assert_eq!(got.2, flat.2);
            if got.2 == 1 {
                count += 1;
                // 1/512 px of snapping at depth 8 is 8·8/150/512 units of z, an eighth of that here.
                near(real(got.0), want.0 / 4.0, 2e-3);
                near(real(got.1), want.1 / 8.0, 2e-3);
                // The boards of the two, 32 fields each way.
                let field = |seen: Seen| (real(seen.0) * 16.0).floor() as i32 + (real(seen.1) * 32.0).floor() as i32;
                different += usize::from(field(got) % 2 != field(flat) % 2);
            }
        }
    }
    assert!(count > 30_000 && different > count / 10, "{different} of {count}");
}

#[test]
fn item_08_4_with_equal_w_both_are_the_same() {
    let corners = [((10.0, 10.0), 0.0), ((290.0, 10.0), 0.5), ((20.0, 250.0), 1.0)];
    let vertices = corners.map(|(p, v)| with_w(p, 3.0, [unit(v)]));
    let look = program(|_, [v]: [i32; 1]| Some(Seen(v, 1, 0, 0)));
    let (mut corrected, mut linear) = (picture(Seen::default()), picture(Seen::default()));
    draw(&state(), &mut buffer(&mut corrected), &mut NoDepth, &look, &vertices);
    draw(
        &state().linear(),
        &mut buffer(&mut linear),
        &mut NoDepth,
        &look,
        &vertices,
    );
    for (a, b) in corrected.iter().zip(&linear) {
        assert_eq!(a.1, b.1);
        // A unit per pixel along a row, of 2^-28: far below a level.
        near(real(a.0), real(b.0), 300.0 / f64::from(1 << 28) * 2.0);
    }
}
