//! What the tests of the course's items share: its conventions, programs of one closure, and numbers in float64.

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::collections::BTreeSet;
use std::marker::PhantomData;

use fixel::blend::{ONE, Rgba};
use fixel::depth::{Depth, NoDepth};
use fixel::matrix::Matrix;
use fixel::num::{Block, Scaled};
use fixel::pipeline::{self, FragCoord, Interpolation, Outputs, PerspectiveCorrected, Program, State, Targets};
use fixel::target::Buffer;
use fixel::viewport::Viewport;

/// Pictures of the early chapters are 300×300.
pub const SIDE: i32 = 300;

/// A vertex and what it carries.
pub type Vertex<const N: usize> = (Block<i32, 4>, [i32; N]);

/// A program whose vertices are given in clip space, and whose fragments a closure colours.
pub struct Closure<F, O, const N: usize>(F, PhantomData<O>);

pub fn program<F, O, const N: usize>(fragment: F) -> Closure<F, O, N>
where
    F: Fn(FragCoord, [i32; N]) -> Option<O>,
{
    Closure(fragment, PhantomData)
}

impl<F, O, const N: usize> Program for Closure<F, O, N>
where
    F: Fn(FragCoord, [i32; N]) -> Option<O>,
{
    type Vertex = Vertex<N>;
    type Varying = [i32; N];
    type At = FragCoord;
    type Output = O;

    fn vertex(&self, &(position, values): &Vertex<N>) -> (Block<i32, 4>, [i32; N]) {
        (position, values)
    }
    fn fragment(&self, at: FragCoord, values: [i32; N]) -> Option<O> {
        (self.0)(at, values)
    }
}

/// y upwards with row 0 at the bottom, samples at pixel centres: the course's conventions.
pub fn state() -> State<PerspectiveCorrected, i32, i32, 1> {
    let side = SIDE as u16;
    State::new(Viewport::new(0, 0, side, side).unwrap().samples_at_centers())
}

/// Numbers with 29 bits of the largest.
pub fn block<const N: usize>(values: [f64; N]) -> Block<i32, N> {
    let largest = values.iter().fold(1e-300, |most: f64, v| most.max(v.abs()));
    let bits = 28 - largest.log2().floor() as i32;
    Block::from_integers(values.map(|v| (v * 2f64.powi(bits)).round() as i32)).scaled(-bits)
}

pub fn scaled(value: f64) -> Scaled<i32> {
    block([value])
}

pub fn floats<const N: usize>(block: Block<i32, N>) -> [f64; N] {
    block.mantissas().map(|m| f64::from(m) * 2f64.powi(block.exponent()))
}

/// A point of the 300×300 picture in pixels, as a vertex.
pub fn at<const N: usize>((x, y): (f64, f64), values: [i32; N]) -> Vertex<N> {
    deep((x, y), 0.0, values)
}

/// A point in pixels with window depth z.
pub fn deep<const N: usize>((x, y): (f64, f64), z: f64, values: [i32; N]) -> Vertex<N> {
    let side = f64::from(SIDE);
    let depth = if z == 0.0 { -side } else { (2.0 * z - 1.0) * side };
    (block([2.0 * x - side, 2.0 * y - side, depth, side]), values)
}

/// A matrix in float64.
pub fn matrix(matrix: &Matrix<i32>) -> [f64; 16] {
    floats(matrix.entries())
}

#[track_caller]
pub fn near(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "{got}, not {want}");
}

#[track_caller]
pub fn all_near<const N: usize>(got: [f64; N], want: [f64; N], tolerance: f64) {
    for (g, w) in got.into_iter().zip(want) {
        assert!((g - w).abs() <= tolerance, "{got:?}, not {want:?}");
    }
}

/// In units of 2^-28.
pub fn unit(value: f64) -> i32 {
    (value * f64::from(ONE)).round() as i32
}

pub fn real(value: i32) -> f64 {
    f64::from(value) / f64::from(ONE)
}

pub fn rgba([red, green, blue, alpha]: [f64; 4]) -> Rgba {
    Rgba {
        color: [red, green, blue].map(unit),
        alpha: unit(alpha),
    }
}

pub fn reals(color: Rgba) -> [f64; 4] {
    let [red, green, blue] = color.color;
    [red, green, blue, color.alpha].map(real)
}

/// A 300×300 picture.
pub fn picture<P: Copy>(pixel: P) -> Vec<P> {
    vec![pixel; (SIDE * SIDE) as usize]
}

pub fn buffer<P: Copy>(pixels: &mut [P]) -> Buffer<'_, P> {
    Buffer::new(pixels, SIDE as u16, SIDE as u16).unwrap()
}

pub fn pixel<P: Copy>(pixels: &[P], x: i32, y: i32) -> P {
    pixels[(y * SIDE + x) as usize]
}

/// The pixels that are not 0.
pub fn lit(pixels: &[u8]) -> BTreeSet<(i32, i32)> {
    let index = |i: usize| (i as i32 % SIDE, i as i32 / SIDE);
    (0..pixels.len()).filter(|&i| pixels[i] != 0).map(index).collect()
}

/// How often each pixel of a list of triangles is drawn.
pub fn triangles_hit(state: &State<impl Interpolation, i32, i32, 1>, vertices: &[Vertex<0>]) -> Vec<u8> {
    let mut pixels = picture(0u8);
    for three in vertices.chunks(3) {
        let mut once = picture(0u8);
        let white = program(|_, []: [i32; 0]| Some(1u8));
        pipeline::triangles(state, &mut buffer(&mut once), &mut NoDepth, &white, three);
        pixels.iter_mut().zip(once).for_each(|(sum, hit)| *sum += hit);
    }
    pixels
}

/// The pixels of a line in the 300×300 picture.
pub fn line(from: (f64, f64), to: (f64, f64)) -> BTreeSet<(i32, i32)> {
    let mut pixels = picture(0u8);
    let white = program(|_, []: [i32; 0]| Some(1u8));
    pipeline::lines(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &white,
        [at(from, []), at(to, [])],
    );
    lit(&pixels)
}

/// Draws triangles without bothering about types.
pub fn draw<C, D, P, const M: usize, const N: usize>(
    state: &State<impl Interpolation, i32, i32, M>,
    colors: &mut C,
    depth: &mut D,
    program: &P,
    vertices: &[Vertex<N>],
) where
    C: Targets,
    D: Depth,
    P: Program<Vertex = Vertex<N>, Output: Outputs<C>>,
{
    pipeline::triangles(state, colors, depth, program, vertices);
}

/// A square in pixels, two triangles, all at one depth.
pub fn square<const N: usize>([left, bottom, right, top]: [f64; 4], z: f64, values: [i32; N]) -> [Vertex<N>; 6] {
    let corner = |x, y| deep((x, y), z, values);
    [
        corner(left, bottom),
        corner(right, bottom),
        corner(right, top),
        corner(left, bottom),
        corner(right, top),
        corner(left, top),
    ]
}

/// Numbers that look random.
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, end: u32) -> u32 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (((self.0 >> 33) * u64::from(end)) >> 31) as u32
    }
    pub fn unit(&mut self) -> f64 {
        f64::from(self.below(1 << 24)) / f64::from(1 << 24)
    }
}

/// What a fragment has been given: column, row, value, depth bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Seen(pub i32, pub i32, pub i32, pub u32);

impl pipeline::Color for Seen {}
