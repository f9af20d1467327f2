//! Triangles whose values are linear in each triangle of a fan: wherever planes cut them, and however rounding turns what is left, no
//! pixel is drawn twice, and each that lies well inside is drawn.

mod course;

use std::cell::Cell;

use course::{Random, block, program};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::Fragment;
use fixel::matrix::Matrix;
use fixel::num::{Block, Word};
use fixel::pipeline::{self, State};
use fixel::target::Buffer;
use fixel::varying::LinearFan;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;

const SIDE: u16 = 64;
const CASES: u32 = 20_000;

/// In px: corners are rounded by up to 0.003 px.
const BORDER: f64 = 0.01;

/// How often a pixel is drawn.
struct Count;

impl Fragment for Count {
    type Varying = LinearFan<1>;
    type Pixel = u8;

    fn shade(&self, _: [i32; 1], below: u8) -> Option<u8> {
        Some(below + 1)
    }
}

/// A triangle, some of them slivers, and planes of which most pass a corner within a pixel or by next to nothing.
struct Case {
    vertices: [[f64; 4]; 3],
    planes: Vec<[f64; 4]>,
}

impl Case {
    fn new(random: &mut Random) -> Self {
        let mut signed = |reach: f64| (2.0 * random.unit() - 1.0) * reach;
        let mut places = [(); 3].map(|()| [signed(1.2), signed(1.2)]);
        let thin = 10f64.powf(signed(2.5) - 2.5);
        if signed(1.0) > 0.0 {
            places[2] = [0, 1].map(|i| places[1][i] + signed(thin));
        }
        let w = [(); 3].map(|()| 1.75 + signed(1.25));
        let inner = [0, 1].map(|i| places.iter().map(|place| place[i]).sum::<f64>() / 3.0);
        let planes = (0..4)
            .map(|i| {
                let (a, b) = (signed(1.0), signed(1.0));
                let [x, y] = places[i % 3];
                // The inner is kept.
                let turn = (a * (inner[0] - x) + b * (inner[1] - y)).signum();
                let beyond = 10f64.powf(signed(3.0) - 4.0) * signed(1.0);
                [turn * a, turn * b, 0.0, -turn * (a * x + b * y) + beyond]
            })
            .collect();
        Case {
            vertices: [0, 1, 2].map(|i| [places[i][0] * w[i], places[i][1] * w[i], 0.0, w[i]]),
            planes,
        }
    }

    fn planes<T: Word>(&self) -> Planes<T, 4> {
        let mut planes = Planes::default();
        for plane in &self.planes {
            planes.push(widened(*plane)).unwrap();
        }
        planes
    }

    fn by_view<T: Word, W: Word>(&self) -> Vec<u8> {
        let view = View::<T, W, 4> {
            projection: Matrix::identity(),
            planes: self.planes(),
            viewport: Viewport::new(0, 0, SIDE, SIDE).unwrap(),
            depth_range: DepthRange::Unlimited,
            behind: Behind::Cut,
            cull: Cull::Nothing,
        };
        let vertices = self.vertices.map(|position| Vertex {
            position: widened(position),
            carried: [0],
        });
        counted(|target| draw::primitive(&view, target, &mut NoDepth, &vertices, &Count))
    }

    fn by_pipeline(&self) -> Vec<u8> {
        let viewport = Viewport::<i32>::new(0, 0, SIDE, SIDE).unwrap();
        let state = State::new(viewport).with_planes(self.planes()).linear();
        let vertices = self.vertices.map(|position| (block(position), [0]));
        let counts = vec![Cell::new(0); usize::from(SIDE) * usize::from(SIDE)];
        let mut pixels = vec![0; counts.len()];
        let count = program(|at, [_]: [i32; 1]| {
            let pixel = &counts[usize::from(SIDE) * at.y as usize + at.x as usize];
            pixel.set(pixel.get() + 1);
            Some(0u8)
        });
        let mut target = Buffer::new(&mut pixels, SIDE, SIDE).unwrap();
        pipeline::triangles(&state, &mut target, &mut NoDepth, &count, &vertices);
        counts.into_iter().map(Cell::into_inner).collect()
    }

    /// The least distance of a pixel's sample from what bounds the polygon, in px: positive inside.
    fn margin(&self, x: usize, y: usize) -> f64 {
        let half = f64::from(SIDE) / 2.0;
        let [x, y] = [x as f64 / half - 1.0, y as f64 / half - 1.0];
        let corners = self.vertices.map(|[x, y, _, w]| [x / w, y / w]);
        let side = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| {
            ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / (bx - ax).hypot(by - ay)
        };
        let [a, b, c] = corners;
        let sides = [side(a, b), side(b, c), side(c, a)];
        let turn = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).signum();
        let of_planes = self.planes.iter().map(|[a, b, _, d]| (a * x + b * y + d) / a.hypot(*b));
        let all = sides.into_iter().map(|side| side * turn).chain(of_planes);
        all.fold(f64::INFINITY, f64::min) * half
    }
}

fn widened<T: Word>(numbers: [f64; 4]) -> Block<T, 4> {
    let block = block(numbers);
    Block::new(block.mantissas().map(T::from_i32), block.exponent())
}

fn counted(draw: impl FnOnce(&mut Buffer<'_, u8>)) -> Vec<u8> {
    let mut pixels = vec![0; usize::from(SIDE) * usize::from(SIDE)];
    draw(&mut Buffer::new(&mut pixels, SIDE, SIDE).unwrap());
    pixels
}

/// Draws all cases. Ten times as many have none that is drawn twice, either; without `view/fan.rs` nine pixels are here.
fn once(draw: impl Fn(&Case) -> Vec<u8>) {
    let mut random = Random(3);
    let mut drawn = 0;
    for case in 0..CASES {
        let shape = Case::new(&mut random);
        for (i, count) in draw(&shape).into_iter().enumerate() {
            let (x, y) = (i % usize::from(SIDE), i / usize::from(SIDE));
            drawn += u32::from(count > 0);
            assert!(count < 2, "case {case}: ({x}, {y}) is drawn {count} times");
            assert!(
                count > 0 || shape.margin(x, y) < BORDER,
                "case {case}: ({x}, {y}) is not drawn"
            );
        }
    }
    assert!(drawn > 100 * CASES, "{drawn}");
}

#[test]
fn a_view_draws_each_pixel_once() {
    once(Case::by_view::<i32, i32>);
    once(Case::by_view::<i64, i64>);
}

#[test]
fn the_pipeline_draws_each_pixel_once() {
    once(Case::by_pipeline);
}
