//! The float64 reference: draws a scene in exactly the evaluation order of formats/hw2.md, so that it reproduces the
//! official pictures byte for byte, and logs what the comparison needs. It shares no arithmetic with the core.

pub mod bound;
pub mod clip;
pub mod log;
pub mod matrix;
pub mod raster;

use crate::backend::{BackEnd, Surface, Vertex};
use bound::{Tracked, size};
use clip::{Corner, Plane, Side, clip};
use log::{Polygon, Primitive};
use matrix::{Matrix, Vector};
use raster::{Point, Q, X, Y, Z};

use crate::compare::stated::FIXED_PRODUCT;

/// One pixel of the reference, unrounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pixel {
    /// Red, green, blue, alpha; not clamped, 1 is full; alpha is 0 where nothing was drawn and 1 elsewhere.
    pub color: [f64; 4],
    /// z/w of the winner, 0 to 1; 1 where nothing was drawn.
    pub depth: f64,
    /// The primitive that won the pixel, from 1; 0 is the background.
    pub primitive: u32,
}

/// The reference's picture and its log.
#[derive(Debug, Clone)]
pub struct Rendered {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `width * height` pixels, row by row from the top.
    pub pixels: Vec<Pixel>,
    /// Every primitive's polygons, in drawing order.
    pub polygons: Vec<Polygon>,
}

impl Rendered {
    /// The picture in bytes, RGBA: floor(255 v), clamped to 0…255.
    pub fn bytes(&self) -> Vec<[u8; 4]> {
        (self.pixels.iter()).map(|pixel| pixel.color.map(byte)).collect()
    }
}

/// floor(255 v) clamped to 0…255 (formats/hw2.md section 9): cut off, not rounded. What is not a number counts as 0.
pub fn byte(v: f64) -> u8 {
    (255.0 * v).floor() as u8
}

/// The float64 back end.
pub struct Reference {
    width: u32,
    height: u32,
    pixels: Vec<Pixel>,
    polygons: Vec<Polygon>,
    model_view: Tracked,
    projection: Tracked,
    directions: Tracked,
    planes: Vec<Plane>,
    cull: bool,
}

impl Reference {
    /// An empty picture of `width` x `height` pixels, every pixel (0, 0, 0, 0) at depth 1.
    pub fn new(width: u32, height: u32) -> Self {
        let empty = Pixel {
            color: [0.0; 4],
            depth: 1.0,
            primitive: 0,
        };
        Self {
            width,
            height,
            pixels: vec![empty; width as usize * height as usize],
            polygons: Vec::new(),
            model_view: Tracked::identity(),
            projection: Tracked::identity(),
            directions: Tracked::new(Matrix::IDENTITY.linear_part(), 0.0),
            planes: Vec::new(),
            cull: false,
        }
    }

    /// The picture and the log.
    pub fn finish(self) -> Rendered {
        Rendered {
            width: self.width,
            height: self.height,
            pixels: self.pixels,
            polygons: self.polygons,
        }
    }

    fn add(&mut self, step: &Tracked) {
        self.model_view = self.model_view.times(step);
    }

    /// Directions' matrix times `step`.
    fn turn(&mut self, step: &Tracked) {
        self.directions = self.directions.times(step);
    }

    fn eye_corner(&self, vertex: &Vertex, color: [f64; 3]) -> Corner {
        let given = FIXED_PRODUCT * size(&vertex.position);
        let (eye, error) = self.model_view.apply(&vertex.position, given);
        Corner { eye, color, error }
    }

    /// X, Y, Z, 1/w and colour/w of a corner; none if w is 0 or nothing finite comes of it.
    fn on_screen(&self, corner: &Corner) -> Option<Point> {
        let [x, y, z, w] = self.projection.matrix.apply(&corner.eye);
        let half = [self.width, self.height].map(|s| f64::from(s) / 2.0);
        let [r, g, b] = corner.color.map(|c| c / w);
        let px = [x / w * half[0] + half[0], y / w * half[1] + half[1]];
        let point = [px[0], px[1], z / w, 1.0 / w, r, g, b];
        point.iter().all(|value| value.is_finite()).then_some(point)
    }

    fn draw(&mut self, primitive: u32, corners: &[Point; 3], surface: Surface) {
        let [a, b, c] = corners;
        let area = (b[X] - a[X]) * (c[Y] - a[Y]) - (b[Y] - a[Y]) * (c[X] - a[X]);
        if self.cull && area >= 0.0 {
            return;
        }
        let width = self.width as usize;
        let pixels = &mut self.pixels;
        raster::walk(corners, self.width, self.height, |x, y, point| {
            let pixel = &mut pixels[y * width + x];
            let depth = point[Z];
            if !(0.0..=1.0).contains(&depth) || depth > pixel.depth {
                return;
            }
            let [r, g, b] = match surface {
                Surface::Flat(color) => color,
                Surface::Gouraud => [4, 5, 6].map(|i| point[i] / point[Q]),
            };
            *pixel = Pixel {
                color: [r, g, b, 1.0],
                depth,
                primitive,
            };
        });
    }
}

/// How much more than a rounding the differences of paired planes (l and r, b and t, n and f) are off, at the worst.
fn cancellation(planes: &[f64; 6]) -> f64 {
    (planes.chunks(2))
        .map(|pair| 1.0 + 2.0 * (pair[0].abs() + pair[1].abs()) / (pair[1] - pair[0]).abs())
        .fold(1.0, f64::max)
}

impl BackEnd for Reference {
    fn load_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.model_view = Tracked::given(Matrix(*m));
        self.directions = self.model_view.for_directions();
        Ok(())
    }

    fn mult_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        let step = Tracked::given(Matrix(*m));
        self.add(&step);
        self.turn(&step.for_directions());
        Ok(())
    }

    fn load_p(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.projection = Tracked::given(Matrix(*m));
        Ok(())
    }

    fn translate(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.add(&Tracked::given(Matrix::translation(by)));
        Ok(())
    }

    fn rotate(&mut self, degrees: f64, axis: [f64; 3]) -> Result<(), String> {
        let step = Tracked::rotation(degrees, axis);
        self.add(&step);
        self.turn(&step);
        Ok(())
    }

    fn scale(&mut self, by: [f64; 3]) -> Result<(), String> {
        let step = Tracked::given(Matrix::scaling(by));
        self.add(&step);
        self.turn(&step.for_directions());
        Ok(())
    }

    fn look_at(&mut self, eye: [f64; 4], center: [f64; 4], up: [f64; 3]) -> Result<(), String> {
        let [eye, center] = [eye, center].map(|[x, y, z, w]| [x / w, y / w, z / w]);
        let turn = Tracked::looking(eye, center, up);
        self.model_view = turn.times(&Tracked::given(Matrix::translation(eye.map(|c| -c))));
        self.directions = Tracked::new(turn.matrix.linear_part(), turn.error);
        Ok(())
    }

    fn frustum(&mut self, planes: [f64; 6]) -> Result<(), String> {
        self.projection = Tracked::computed(Matrix::frustum(planes), cancellation(&planes));
        Ok(())
    }

    fn ortho(&mut self, planes: [f64; 6]) -> Result<(), String> {
        self.projection = Tracked::computed(Matrix::ortho(planes), cancellation(&planes));
        Ok(())
    }

    fn clip_plane(&mut self, plane: Vector) -> Result<(), String> {
        self.planes.push(Plane::new(plane, &self.directions));
        Ok(())
    }

    fn cull(&mut self) {
        self.cull = true;
    }

    fn triangle(&mut self, primitive: u32, corners: [Vertex; 3], surface: Surface) -> Result<(), String> {
        let triangle = corners.map(|vertex| match surface {
            Surface::Flat(color) => self.eye_corner(&vertex, color),
            Surface::Gouraud => self.eye_corner(&vertex, vertex.color),
        });
        let polygon = clip(&triangle, &self.planes, Side::Exact);
        let points: Vec<Option<Point>> = polygon.iter().map(|c| self.on_screen(c)).collect();
        for i in 2..points.len() {
            if let [Some(a), Some(b), Some(c)] = [points[0], points[i - 1], points[i]] {
                self.draw(primitive, &[a, b, c], surface);
            }
        }
        let logged = Primitive {
            number: primitive,
            gouraud: matches!(surface, Surface::Gouraud),
            triangle: &triangle,
            planes: &self.planes,
            projection: &self.projection,
            size: [f64::from(self.width), f64::from(self.height)],
            cull: self.cull,
        };
        self.polygons.extend(logged.polygons());
        Ok(())
    }
}

#[cfg(test)]
mod tests;
