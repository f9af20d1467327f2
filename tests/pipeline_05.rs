//! Programs: chapter 05.

mod course;

use std::cell::{Cell, RefCell};

use course::{
    SIDE, Seen, all_near, at, block, buffer, deep, draw, floats, lit, near, picture, pixel, program, square, state,
};
use fixel::depth::{DepthBuffer, FAR, LessOrEqual, NoDepth};
use fixel::matrix::Matrix;
use fixel::num::{Angle, Block, SineTable};
use fixel::pipeline::{self, Pixel, Program, Shaded};

/// Written as a user would: own attributes, own uniforms, own varyings.
struct Lamp<'a> {
    model: Matrix<i32>,
    brightness: i32,
    calls: &'a RefCell<Vec<char>>,
}

struct Attributes {
    position: [i32; 2],
    glow: u8,
}

struct Glow(i32);

impl pipeline::Varyings for Glow {
    type Values = [i32; 1];
    fn pack(&self) -> [i32; 1] {
        [self.0]
    }
    fn unpack([glow]: [i32; 1]) -> Self {
        Glow(glow)
    }
}

impl Program for Lamp<'_> {
    type Vertex = Attributes;
    type Varying = Glow;
    type At = Pixel;
    type Output = u8;

    fn vertex(&self, vertex: &Attributes) -> (Block<i32, 4>, Glow) {
        self.calls.borrow_mut().push('v');
        let [x, y] = vertex.position;
        let position = self.model.transform(Block::from_integers([x, y, 0, 1]));
        (position, Glow(i32::from(vertex.glow) << 16))
    }
    fn fragment(&self, _at: Pixel, Glow(glow): Glow) -> Option<u8> {
        self.calls.borrow_mut().push('f');
        Some(((glow >> 16) * self.brightness) as u8)
    }
}

/// A square of two triangles, ±1.
fn attributes() -> [Attributes; 6] {
    [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]].map(|position| Attributes { position, glow: 7 })
}

fn quarter_at(x: f64, y: f64) -> Matrix<i32> {
    Matrix::model(block([x, y, 0.0]), &Matrix::identity(), block([0.25, 0.25, 0.25]))
}

#[test]
fn item_05_1_a_program_of_the_users_own() {
    let calls = RefCell::new(Vec::new());
    let lamp = Lamp {
        model: Matrix::identity(),
        brightness: 3,
        calls: &calls,
    };
    let mut pixels = picture(0u8);
    pipeline::triangles(&state(), &mut buffer(&mut pixels), &mut NoDepth, &lamp, &attributes());
    assert!(pixels.iter().all(|&p| p == 21));
}

#[test]
fn item_05_2_n_vertices_are_n_calls_before_any_fragment() {
    let calls = RefCell::new(Vec::new());
    let lamp = Lamp {
        model: Matrix::identity(),
        brightness: 3,
        calls: &calls,
    };
    let mut pixels = picture(0u8);
    // With a buffer: all vertices, then all fragments.
    let mut places = [const { Shaded::EMPTY }; 6];
    pipeline::triangles_buffered(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &lamp,
        attributes(),
        &mut places,
    );
    let order = calls.take();
    assert_eq!(order.iter().filter(|&&c| c == 'v').count(), 6);
    assert_eq!(order.iter().rposition(|&c| c == 'v'), Some(5));
    assert_eq!(order.len(), 6 + (SIDE * SIDE) as usize);
    // Without: once each as well, those of a primitive before its fragments.
    pipeline::triangles(&state(), &mut buffer(&mut pixels), &mut NoDepth, &lamp, attributes());
    let order = calls.take();
    assert_eq!(order.iter().filter(|&&c| c == 'v').count(), 6);
    assert_eq!(&order[..4], ['v', 'v', 'v', 'f']);
    // A small buffer goes in rounds of whole triangles, lines have buffers too.
    pipeline::triangles_buffered(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &lamp,
        attributes(),
        &mut places[..5],
    );
    assert_eq!(calls.take().iter().filter(|&&c| c == 'v').count(), 6);
    pipeline::lines_buffered(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &lamp,
        attributes(),
        &mut places,
    );
    let order = calls.take();
    assert_eq!(order.iter().rposition(|&c| c == 'v'), Some(5));
}

#[test]
fn item_05_3_uniforms_hold_for_one_draw() {
    let calls = RefCell::new(Vec::new());
    let mut pixels = picture(0u8);
    for (x, y, brightness) in [(-0.5, -0.5, 1), (0.5, 0.5, 2)] {
        let lamp = Lamp {
            model: quarter_at(x, y),
            brightness,
            calls: &calls,
        };
        pipeline::triangles(&state(), &mut buffer(&mut pixels), &mut NoDepth, &lamp, attributes());
    }
    assert_eq!(
        (
            pixel(&pixels, 75, 75),
            pixel(&pixels, 225, 225),
            pixel(&pixels, 225, 75)
        ),
        (7, 14, 0)
    );
    assert_eq!(lit(&pixels).len(), 75 * 75 * 2);
}

#[test]
fn item_05_4_several_color_buffers() {
    let (mut reds, mut greens) = (picture([0u8; 3]), picture(0u16));
    let both = program(|_, []: [i32; 0]| Some(([255u8, 0, 0], 0x07e0u16)));
    let mut targets = (buffer(&mut reds), buffer(&mut greens));
    draw(
        &state(),
        &mut targets,
        &mut NoDepth,
        &both,
        &square([0.0, 0.0, 9.0, 9.0], 0.0, []),
    );
    assert_eq!((pixel(&reds, 5, 5), pixel(&greens, 5, 5)), ([255, 0, 0], 0x07e0));
    assert_eq!((pixel(&reds, 9, 5), pixel(&greens, 9, 5)), ([0; 3], 0));
    // As an array, and four at once.
    let (mut a, mut b, mut c, mut d) = (picture(0u8), picture(0u8), picture(0u8), picture(0u8));
    let two = program(|_, []: [i32; 0]| Some([1u8, 2]));
    draw(
        &state(),
        &mut [buffer(&mut a), buffer(&mut b)],
        &mut NoDepth,
        &two,
        &square([0.0, 0.0, 9.0, 9.0], 0.0, []),
    );
    assert_eq!((pixel(&a, 5, 5), pixel(&b, 5, 5)), (1, 2));
    let four = program(|_, []: [i32; 0]| Some((3u8, 4u8, 5u8, 6u8)));
    let mut targets = (buffer(&mut a), buffer(&mut b), buffer(&mut c), buffer(&mut d));
    draw(
        &state(),
        &mut targets,
        &mut NoDepth,
        &four,
        &square([0.0, 0.0, 9.0, 9.0], 0.0, []),
    );
    assert_eq!([&a, &b, &c, &d].map(|p| pixel(p, 5, 5)), [3, 4, 5, 6]);
}

#[test]
fn item_05_5_discard_writes_neither_color_nor_depth() {
    let (mut pixels, mut depths) = (picture(0u8), picture(FAR));
    let holes = program(|at, [color]: [i32; 1]| ((at.x + at.y) % 2 == 0).then_some(color as u8));
    let whole = program(|_, [color]: [i32; 1]| Some(color as u8));
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(buffer(&mut depths));
    draw(
        &state(),
        &mut buffer(&mut pixels),
        &mut depth,
        &holes,
        &square([0.0, 0.0, 40.0, 40.0], 0.25, [1]),
    );
    draw(
        &state(),
        &mut buffer(&mut pixels),
        &mut depth,
        &whole,
        &square([10.0, 10.0, 30.0, 30.0], 0.5, [2]),
    );
    for y in 0..40 {
        for x in 0..40 {
            let behind = if (10..30).contains(&x) && (10..30).contains(&y) {
                2
            } else {
                0
            };
            assert_eq!(pixel(&pixels, x, y), if (x + y) % 2 == 0 { 1 } else { behind });
        }
    }
    assert_eq!(pixel(&depths, 0, 1), FAR);
}

#[test]
fn item_05_6_what_has_no_buffer_goes_nowhere_and_what_has_no_color_stays() {
    let (mut first, mut second) = (picture(9u8), picture(9u8));
    let left_half = program(|at, []: [i32; 0]| Some(((at.x < 5).then_some(1u8), 2u8, 3u8)));
    let mut targets = (buffer(&mut first), (), buffer(&mut second));
    draw(
        &state(),
        &mut targets,
        &mut NoDepth,
        &left_half,
        &square([0.0, 0.0, 10.0, 10.0], 0.0, []),
    );
    assert_eq!([0, 4, 5, 9, 10].map(|x| pixel(&first, x, 0)), [1, 1, 9, 9, 9]);
    assert_eq!([0, 4, 5, 9, 10].map(|x| pixel(&second, x, 0)), [3, 3, 3, 3, 9]);
    // Depth alone.
    let mut depths = picture(FAR);
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(buffer(&mut depths));
    let color = program(|_, []: [i32; 0]| Some(1u8));
    draw(
        &state(),
        &mut (),
        &mut depth,
        &color,
        &square([0.0, 0.0, 10.0, 10.0], 0.5, []),
    );
    draw(
        &state(),
        &mut (),
        &mut NoDepth,
        &color,
        &square([0.0, 0.0, 10.0, 10.0], 0.5, []),
    );
    assert_eq!([5, 15].map(|x| pixel(&depths, x, 5)), [32768, FAR]);
}

#[test]
fn item_05_7_the_fragment_knows_its_pixel_depth_and_inverse_w() {
    let (mut pixels, mut depths) = (picture(Seen::default()), picture(FAR));
    let look = program(|at, []: [i32; 0]| {
        let inverse = at.inverse_w().to_fixed(24) as i32;
        Some(Seen(at.x, at.y, inverse, at.z.to_bits()))
    });
    // w of 1, 2 and 4 at window depths 0, ½ and 1.
    let corner = |(x, y): (f64, f64), z: f64, w: f64| {
        let [x, y, _, s] = floats(at::<0>((x, y), []).0);
        (block([x / s * w, y / s * w, (2.0 * z - 1.0) * w, w]), [])
    };
    let corners = [
        ((10.0, 10.0), 0.0, 1.0),
        ((290.0, 10.0), 0.5, 2.0),
        ((20.0, 150.0), 1.0, 4.0),
    ];
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(buffer(&mut depths));
    draw(
        &state(),
        &mut buffer(&mut pixels),
        &mut depth,
        &look,
        &corners.map(|(p, z, w)| corner(p, z, w)),
    );
    let mut count = 0;
    for y in 0..SIDE {
        for x in 0..SIDE {
            let Seen(got_x, got_y, inverse, z) = pixel(&pixels, x, y);
            if z == 0 && inverse == 0 {
                continue;
            }
            count += 1;
            assert_eq!((got_x, got_y), (x, y));
            let weight = |i: usize| {
                let [a, b] = [corners[(i + 1) % 3].0, corners[(i + 2) % 3].0];
                let p = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                ((b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0)) / 39200.0
            };
            let sum = |f: fn(f64, f64) -> f64| (0..3).map(|i| weight(i) * f(corners[i].1, corners[i].2)).sum::<f64>();
            near(f64::from(inverse) / f64::from(1 << 24), sum(|_, w| 1.0 / w), 1e-6);
            // A unit per pixel of the row at most, of 2^-15 step.
            near(f64::from(z) / f64::from(65535u32 << 15), sum(|z, _| z), 2e-6);
            // The grey of z is the depth buffer's picture.
            assert_eq!(u32::from(pixel(&depths, x, y)), (z + (1 << 14)) >> 15);
        }
    }
    assert!(count > 19_000, "{count}");
}

#[test]
fn item_05_8_helpers_place_an_object() {
    let z = block([0.0, 0.0, 1.0]);
    let turn = Matrix::rotation::<SineTable>(Angle::from_degrees(37), z).unwrap();
    let object = Matrix::<i32>::model(block([225.0, 225.0, 0.0]), &turn, block([45.0, 60.0, 1.0]));
    let [x, y, _, w] = floats(object.transform(block([1.0, 1.0, 0.0, 1.0])));
    all_near([x / w, y / w], [224.83, 300.0], 0.005);
    let defaults = Matrix::<i32>::model(block([0.0; 3]), &Matrix::identity(), block([1.0; 3]));
    assert_eq!(defaults, Matrix::identity());
}

/// A program that keeps everything has its depth tested first, and the same picture.
#[test]
fn keeps_all_is_the_same_picture_with_fewer_calls() {
    struct Counting<const KEEPS: bool>(Cell<u32>);
    impl<const KEEPS: bool> Program for Counting<KEEPS> {
        type Vertex = course::Vertex<1>;
        type Varying = [i32; 1];
        type At = Pixel;
        type Output = u8;
        const KEEPS_ALL: bool = KEEPS;
        fn vertex(&self, &vertex: &course::Vertex<1>) -> course::Vertex<1> {
            vertex
        }
        fn fragment(&self, _: Pixel, [color]: [i32; 1]) -> Option<u8> {
            self.0.set(self.0.get() + 1);
            Some(color as u8)
        }
    }
    fn drawn<const KEEPS: bool>() -> (Vec<u8>, Vec<u16>, u32) {
        let (mut pixels, mut depths) = (picture(0u8), picture(FAR));
        let mut depth = DepthBuffer::<_, LessOrEqual>::new(buffer(&mut depths));
        let program = Counting::<KEEPS>(Cell::new(0));
        let tilted = [
            deep((0.0, 0.0), 0.0, [2]),
            deep((200.0, 0.0), 1.0, [2]),
            deep((0.0, 200.0), 0.7, [2]),
        ];
        draw(
            &state(),
            &mut buffer(&mut pixels),
            &mut depth,
            &program,
            &square([0.0, 0.0, 99.0, 99.0], 0.4, [1]),
        );
        draw(&state(), &mut buffer(&mut pixels), &mut depth, &program, &tilted);
        (pixels, depths, program.0.get())
    }
    let (early, late) = (drawn::<true>(), drawn::<false>());
    assert!((early.0, early.1) == (late.0, late.1));
    assert!(early.2 < late.2, "{} and {}", early.2, late.2);
}

/// The box as the course lists it: two triangles a face, signs of (x, y, z) and uv of every corner.
#[test]
fn the_box_is_the_courses() {
    use fixel::pipeline::shapes::{BOX, PLANE_XY, PLANE_XZ};
    let faces = [
        ([0, 0, 1], "--+00 +++11 -++01 +++11 --+00 +-+01"),
        ([1, 0, 0], "+-+00 +--10 +++01 +++01 +--10 ++-11"),
        ([-1, 0, 0], "+--00 ---10 ++-01 ++-01 ---10 -+-11"),
        ([-1, 0, 0], "---00 --+10 -+-01 -+-01 --+10 -++11"),
        ([0, 1, 0], "-++00 +++10 -+-01 -+-01 +++10 ++-11"),
        ([0, -1, 0], "---00 +--10 --+01 --+01 +--10 +-+11"),
    ];
    let listed: Vec<_> = faces
        .iter()
        .flat_map(|(normal, corners)| corners.split(' ').map(move |c| (*normal, c)))
        .collect();
    assert_eq!(listed.len(), BOX.len());
    for (corner, (normal, text)) in BOX.iter().zip(listed) {
        let signs = corner.position.map(|v| if v > 0 { '+' } else { '-' });
        let written: String = signs.into_iter().chain(corner.uv.map(|v| (b'0' + v) as char)).collect();
        assert_eq!((corner.normal, written.as_str()), (normal, text));
    }
    // Every triangle is counter-clockwise from outside: its normal points away from the middle.
    for triangle in BOX.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|i| triangle[i].position.map(i32::from));
        let [u, v] = [b, c].map(|p| [0, 1, 2].map(|i| p[i] - a[i]));
        let cross = [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ];
        assert!((0..3).map(|i| cross[i] * a[i]).sum::<i32>() > 0);
    }
    let xz: Vec<_> = PLANE_XZ.iter().map(|c| (c.position[0], c.position[2], c.uv)).collect();
    let (a, b) = (
        [(-1, -1, [1, 0]), (-1, 1, [0, 0]), (1, -1, [1, 1])],
        [(1, -1, [1, 1]), (-1, 1, [0, 0]), (1, 1, [1, 0])],
    );
    assert_eq!(xz, [a, b].concat());
    let xy: Vec<_> = PLANE_XY.iter().map(|c| (c.position[0], c.position[1])).collect();
    assert_eq!(xy, [(-1, -1), (1, -1), (-1, 1), (1, -1), (1, 1), (-1, 1)]);
    assert!(
        PLANE_XY
            .iter()
            .all(|c| [0, 1].map(|i| (c.position[i] + 1) as u8 / 2) == c.uv)
    );
}
