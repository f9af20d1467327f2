//! The rules that take a whole draw to see, by their numbers in formats/pipeline.md.

use std::cell::{Cell, RefCell};

use super::blend::Blend;
use super::camera::{Transform, look_at, perspective};
use super::order::{Object, draw_scene};
use super::program::{Colors, VERTEX, Values};
use super::state::{Depth, Face, Interpolation, Viewport};
use super::*;
use crate::picture::Picture;
use crate::reference::matrix::Matrix;

mod camera;
mod coverage;
mod scenes;
mod values;

type Color = [f64; 4];

const SIZE: u32 = 64;
const BLACK: Color = [0.0, 0.0, 0.0, 1.0];
const RED: Color = [1.0, 0.0, 0.0, 1.0];
const GREEN: Color = [0.0, 1.0, 0.0, 1.0];

/// Paints with a colour or what a function makes of a fragment; vertices are moved by a matrix.
struct Paint<F>(F);

impl<F: Fn(Color, &Values) -> Option<Color>> Program for Paint<F> {
    type Uniforms = Matrix;

    fn vertex(&self, attributes: &Values, matrix: &Matrix, outputs: &mut Values) -> [f64; 4] {
        outputs.extend(
            attributes
                .iter()
                .filter(|(key, _)| **key != VERTEX)
                .map(|(&key, v)| (key, v.clone())),
        );
        let p = &attributes[VERTEX];
        matrix.apply(&[p[0], p[1], p[2], 1.0])
    }

    fn fragment(&self, at: Color, inputs: &Values, _: &Matrix, colors: &mut Colors) -> bool {
        let color = (self.0)(at, inputs);
        colors.extend(color.map(|color| (0, color)));
        color.is_some()
    }
}

fn flat(color: Color) -> Paint<impl Fn(Color, &Values) -> Option<Color>> {
    Paint(move |_, _: &Values| Some(color))
}

/// From pixels and window depths to clip space; exact for whole pixels, as the size is a power of two.
fn pixels() -> Matrix {
    let half = f64::from(SIZE) / 2.0;
    Matrix::translation([-1.0, -1.0, -1.0]).times(&Matrix::scaling([1.0 / half, 1.0 / half, 2.0]))
}

fn state() -> State {
    State::new(Viewport::of(SIZE, SIZE))
}

fn buffer() -> Framebuffer {
    Framebuffer::new(SIZE, SIZE, BLACK)
}

fn triangles(places: &[[f64; 3]]) -> Geometry {
    Geometry::new(Topology::Triangles, places.to_vec())
}

fn line(a: [f64; 3], b: [f64; 3]) -> Geometry {
    Geometry::new(Topology::Lines, [a, b])
}

/// A square of two triangles, counter-clockwise.
fn square(x: f64, y: f64, side: f64, z: f64) -> Geometry {
    let [a, b, c, d] = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]].map(|[dx, dy]| [x + dx, y + dy, z]);
    triangles(&[a, b, c, a, c, d])
}

fn set(framebuffer: &Framebuffer) -> Vec<[i64; 2]> {
    let places = (0..i64::from(SIZE)).flat_map(|y| (0..i64::from(SIZE)).map(move |x| [x, y]));
    places.filter(|&[x, y]| color(framebuffer, x, y) != BLACK).collect()
}

fn color(framebuffer: &Framebuffer, x: i64, y: i64) -> Color {
    framebuffer.colors[&0].get(x, y).expect("inside")
}

fn depth(framebuffer: &Framebuffer, x: i64, y: i64) -> f64 {
    framebuffer.depth.as_ref().expect("attached").get(x, y).expect("inside")[0]
}

/// Draws in pixels.
fn drawn(state: &State, geometry: &Geometry) -> Framebuffer {
    let mut framebuffer = buffer();
    draw(&mut framebuffer, state, &flat(RED), &pixels(), geometry);
    framebuffer
}
