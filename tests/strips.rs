//! A picture drawn in strips or tiles has the colours and depths of the picture drawn whole, bit for bit.

mod exact;

use exact::{block, scaled};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::draw;
use fixel::fragment::{Antialiased, Flat, Fragment};
use fixel::matrix::Matrix;
use fixel::num::Word;
use fixel::screen::SubPx;
use fixel::target::Buffer;
use fixel::varying::{Linear, Perspective, Varying};
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;

const WIDTH: i32 = 61;
const HEIGHT: i32 = 47;
const PICTURE: Window = Window::new(0, 0, WIDTH, HEIGHT);

/// Mixes all bits of two values with what is below, so that order and every bit count.
struct Mix<V>(std::marker::PhantomData<V>);

impl<V: Varying<Values = [i32; 2]>> Fragment for Mix<V> {
    type Varying = V;
    type Pixel = u32;
    fn shade(&self, [a, b]: [i32; 2], below: u32) -> Option<u32> {
        (a & 15 != 3).then_some(below.rotate_left(7) ^ a as u32 ^ (b as u32).rotate_left(16))
    }
}

impl<V: Varying<Values = [i32; 2]>> Antialiased for Mix<V> {
    fn shade_part(&self, values: [i32; 2], part: i32, below: u32) -> Option<u32> {
        self.shade(values, below).map(|new| new ^ (part as u32).rotate_left(5))
    }
}

fn mix<V>() -> Mix<V> {
    Mix(std::marker::PhantomData)
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    Flat,
    Linear,
    Perspective,
    Segment,
    WuLine,
    Square,
    Billboard,
    Disc,
}

const KINDS: &[Kind] = &[
    Kind::Flat,
    Kind::Linear,
    Kind::Perspective,
    Kind::Segment,
    Kind::WuLine,
    Kind::Square,
    Kind::Billboard,
    Kind::Disc,
];

/// A triangle in eye space, or what begins at its first corners.
#[derive(Debug, Clone)]
struct Primitive {
    kind: Kind,
    corners: [[f64; 4]; 3],
    carried: [[i32; 2]; 3],
}

fn primitive() -> impl Strategy<Value = Primitive> {
    let kinds = prop::sample::select(KINDS);
    let corner = (-9.0..9.0f64, -9.0..9.0f64, -12.0..3.0f64).prop_map(|(x, y, z)| [x, y, z, 1.0]);
    let carried = prop::array::uniform3(prop::array::uniform2(-(1 << 30)..=1 << 30));
    (kinds, prop::array::uniform3(corner), carried).prop_map(|(kind, corners, carried)| Primitive {
        kind,
        corners,
        carried,
    })
}

/// Draws the scene into `window` of memory with the given stride, as one target of a larger picture would.
fn draw_part<T: Word, W: Word>(
    view: &View<T, W, 1>,
    scene: &[Primitive],
    (colors, depths): (&mut [u32], &mut [u16]),
    stride: usize,
    window: Window,
) {
    let mut target = Buffer::with_stride(colors, stride, window).unwrap();
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Buffer::with_stride(depths, stride, window).unwrap());
    for primitive in scene {
        let positions = primitive.corners.map(block);
        let vertices = [0, 1, 2].map(|i| Vertex {
            position: positions[i],
            carried: primitive.carried[i],
        });
        let [a, b, c] = vertices;
        let (position, size) = (
            a.position,
            SubPx::from_bits(primitive.carried[0][0].rem_euclid(30 << 8)),
        );
        let values = (primitive.carried[1], primitive.carried[2]);
        match primitive.kind {
            Kind::Flat => {
                let vertices = vertices.map(|v| Vertex {
                    position: v.position,
                    carried: (),
                });
                draw::primitive(
                    view,
                    &mut target,
                    &mut depth,
                    &vertices,
                    &Flat(primitive.carried[0][0] as u32),
                );
            }
            Kind::Linear => draw::primitive(view, &mut target, &mut depth, &vertices, &mix::<Linear<2>>()),
            Kind::Perspective => draw::primitive(view, &mut target, &mut depth, &vertices, &mix::<Perspective<2>>()),
            Kind::Segment => {
                draw::primitive_segment(view, &mut target, &mut depth, &[a, b], &mix::<Linear<2>>());
                draw::primitive_segment(view, &mut target, &mut depth, &[b, c], &mix::<Perspective<2>>());
            }
            Kind::WuLine => {
                draw::primitive_wu_line(view, &mut target, &mut depth, &[a, b], &mix::<Linear<2>>());
                draw::primitive_wu_line(view, &mut target, &mut depth, &[b, c], &mix::<Perspective<2>>());
            }
            Kind::Square => {
                let (constant, fragment) = (Linear(values.0), mix());
                draw::primitive_square(view, &mut target, &mut depth, position, size, constant, &fragment);
            }
            Kind::Billboard => {
                draw::primitive_billboard(view, &mut target, &mut depth, position, size, values, &mix());
            }
            Kind::Disc => {
                let (constant, fragment) = (Linear(values.0), mix());
                draw::primitive_disc(view, &mut target, &mut depth, position, size, constant, &fragment);
            }
        }
    }
}

type Picture = (Vec<u32>, Vec<u16>);

fn blank(pixels: i32) -> Picture {
    (vec![7; pixels as usize], vec![FAR; pixels as usize])
}

/// One strip after the other in the same memory, as a display with little of it is fed.
fn in_strips<T: Word, W: Word>(view: &View<T, W, 1>, scene: &[Primitive], rows: i32) -> Picture {
    let mut picture = (Vec::new(), Vec::new());
    for top in (0..HEIGHT).step_by(rows as usize) {
        let window = Window::new(0, top, WIDTH, (top + rows).min(HEIGHT));
        let (mut colors, mut depths) = blank(WIDTH * window.height() as i32);
        draw_part(view, scene, (&mut colors, &mut depths), WIDTH as usize, window);
        picture.0.extend(colors);
        picture.1.extend(depths);
    }
    picture
}

/// Tiles in the memory of the whole picture, its rows a stride apart.
fn in_tiles<T: Word, W: Word>(view: &View<T, W, 1>, scene: &[Primitive], width: i32, height: i32) -> Picture {
    let mut picture = blank(WIDTH * HEIGHT);
    for top in (0..HEIGHT).step_by(height as usize) {
        for left in (0..WIDTH).step_by(width as usize) {
            let window = Window::new(left, top, (left + width).min(WIDTH), (top + height).min(HEIGHT));
            let start = (top * WIDTH + left) as usize;
            let part = (&mut picture.0[start..], &mut picture.1[start..]);
            draw_part(view, scene, part, WIDTH as usize, window);
        }
    }
    picture
}

fn check<T: Word, W: Word>(
    scene: &[Primitive],
    (range, behind): (DepthRange, Behind),
    tile: (i32, i32),
) -> Result<(), TestCaseError> {
    let mut planes = Planes::default();
    planes.push(block([0.3, 1.0, 0.2, 5.0])).unwrap();
    let view = View::<T, W, 1> {
        projection: Matrix::frustum([-0.5, 0.5, -0.4, 0.4, 0.5, 30.0].map(scaled)).unwrap(),
        planes,
        viewport: Viewport::new(-3, 2, 70, 43).unwrap().y_up().samples_at_centers(),
        depth_range: range,
        behind,
        cull: Cull::Nothing,
    };
    let mut whole = blank(WIDTH * HEIGHT);
    draw_part(&view, scene, (&mut whole.0, &mut whole.1), WIDTH as usize, PICTURE);
    for rows in [1, 2, 3, 7, 16] {
        prop_assert!(in_strips(&view, scene, rows) == whole, "strips of {} rows", rows);
    }
    prop_assert!(in_tiles(&view, scene, tile.0, tile.1) == whole, "tiles");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn strips_and_tiles_have_the_same_bits(
        scene in prop::collection::vec(primitive(), 1..12),
        range in prop::sample::select(&[DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited][..]),
        behind in prop::sample::select(&[Behind::Cut, Behind::Divide][..]), tile in (1..30i32, 1..30i32),
    ) {
        check::<i32, i32>(&scene, (range, behind), tile)?;
        check::<i64, i64>(&scene, (range, behind), tile)?;
    }
}
