//! The core's shapes as they come out of its view, written down.

use std::sync::Arc;

use fixel::screen::{Center, Shape, SubPx};
use fixel::varying::{Linear, LinearFan, Perspective, Perspective32, PerspectiveSpans};

use super::drawing::{self, Corner, Draw, Drawing, Lights, ONE_W, Program, Varying};
use crate::picture::Picture;

/// A drawing that grows, and the state of the moment.
#[derive(Debug, Clone)]
pub struct Log {
    drawing: Drawing,
    /// Of the next shapes.
    program: Program,
}

impl Log {
    /// A drawing without shapes.
    pub fn new(drawing: Drawing) -> Self {
        Log {
            drawing,
            program: Program::Flat([0; 4]),
        }
    }

    /// The texture of what is drawn from now on; its number.
    pub fn texture(&mut self, texture: &Arc<Picture>) -> usize {
        let textures = &mut self.drawing.textures;
        let known = textures.iter().position(|t| Arc::ptr_eq(t, texture) || t == texture);
        known.unwrap_or_else(|| {
            textures.push(Arc::clone(texture));
            textures.len() - 1
        })
    }

    /// The number of these lights.
    pub fn lights(&mut self, lights: Lights) -> usize {
        let known = self.drawing.lights.iter().rposition(|l| *l == lights);
        known.unwrap_or_else(|| {
            self.drawing.lights.push(lights);
            self.drawing.lights.len() - 1
        })
    }

    /// What colours the shapes from now on.
    pub fn program(&mut self, program: Program) {
        self.program = program;
    }

    /// A convex polygon.
    pub fn polygon<S: Shape<Varying: Read>>(&mut self, shape: &S) {
        self.push(drawing::Shape::Polygon(corners(shape)), S::Varying::KIND);
    }

    /// A line.
    pub fn line<S: Shape<Varying: Read>>(&mut self, shape: &S, smooth: bool) {
        let ends = corners(shape);
        self.push(drawing::Shape::Line { smooth, ends }, S::Varying::KIND);
    }

    /// A square or disc.
    pub fn point(&mut self, center: Center, size: SubPx, round: bool) {
        self.push(drawing::Shape::Point { round, center, size }, Varying::Nothing);
    }

    /// A square with a texture.
    pub fn billboard(&mut self, center: Center, size: SubPx, far: [i32; 2]) {
        self.push(drawing::Shape::Billboard { center, size, far }, Varying::Linear);
    }

    fn push(&mut self, shape: drawing::Shape, varying: Varying) {
        let program = self.program.clone();
        self.drawing.draws.push(Draw {
            shape,
            varying,
            program,
        });
    }

    /// All of it.
    pub fn finish(self) -> Drawing {
        self.drawing
    }
}

fn corners<S: Shape<Varying: Read>>(shape: &S) -> Vec<Corner> {
    let corner = |i| {
        let (values, over_w, inverse) = shape.varying(i).read();
        Corner {
            position: shape.position(i),
            depth: shape.depth(i),
            values,
            over_w,
            inverse,
        }
    };
    (0..shape.count()).map(corner).collect()
}

/// A varying whose numbers can be had.
pub trait Read: Copy {
    /// Which it is.
    const KIND: Varying;
    /// Values, values over w, 1/w.
    fn read(self) -> (Vec<i32>, Vec<i32>, i32);
}

impl Read for () {
    const KIND: Varying = Varying::Nothing;
    fn read(self) -> (Vec<i32>, Vec<i32>, i32) {
        (Vec::new(), Vec::new(), ONE_W)
    }
}

impl<const N: usize> Read for Linear<N> {
    const KIND: Varying = Varying::Linear;
    fn read(self) -> (Vec<i32>, Vec<i32>, i32) {
        (self.0.to_vec(), self.0.to_vec(), ONE_W)
    }
}

impl<const N: usize> Read for LinearFan<N> {
    const KIND: Varying = Varying::Linear;
    fn read(self) -> (Vec<i32>, Vec<i32>, i32) {
        Linear(self.0).read()
    }
}

impl<const N: usize, const BOUND: u32> Read for PerspectiveSpans<N, BOUND> {
    const KIND: Varying = Varying::Perspective;
    fn read(self) -> (Vec<i32>, Vec<i32>, i32) {
        self.0.read()
    }
}

impl<const N: usize> Read for Perspective32<N> {
    const KIND: Varying = Varying::Perspective;
    fn read(self) -> (Vec<i32>, Vec<i32>, i32) {
        self.0.read()
    }
}

impl<const N: usize> Read for Perspective<N> {
    const KIND: Varying = Varying::Perspective;
    fn read(self) -> (Vec<i32>, Vec<i32>, i32) {
        (self.values.to_vec(), self.over_w.to_vec(), self.inverse)
    }
}
