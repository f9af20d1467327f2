//! A primitive from eye space to the picture and into the log (formats/hw2.md section 5).

use std::array;
use std::sync::Arc;

use super::Reference;
use super::vertex::{Placed, any_direction, may_vanish};
use crate::compare::stated::MIXED_HEADROOM;
use crate::reference::Pixel;
use crate::reference::attributes::{Attributes, Bounds, COUNT};
use crate::reference::clip::{Corner, Over, Side, clip};
use crate::reference::log::{Polygon, Primitive};
use crate::reference::material::{Fill, Material};
use crate::reference::raster::{self, Point, Q, REST, X, Y, Z};

/// Numbers of a point with a colour.
const COLORED: usize = REST + 3;
/// Numbers of a point with all attributes.
const WHOLE: usize = REST + COUNT;

impl Reference {
    /// Draws and logs a triangle.
    pub(super) fn primitive(&mut self, number: u32, placed: [Placed; 3], material: &Arc<Material>) {
        let mut triangle = placed.map(|p| p.corner);
        let material = &self.finished(&mut triangle, &placed, material);
        let w = triangle.each_ref().map(|c| self.projection.matrix.apply(&c.eye)[3]);
        let mixed = w.iter().any(|&w| w < 0.0) && w.iter().any(|&w| w > 0.0);
        let headroom = if mixed { MIXED_HEADROOM } else { 1.0 };
        let carrying = Bounds::of_carrying(triangle.iter().map(|c| &c.at), headroom);
        for corner in &mut triangle {
            corner.at_error.color *= if material.is_lit() { headroom } else { 1.0 };
            corner.at_error = corner.at_error.plus(&carrying);
        }
        let polygon = clip(&triangle, &self.planes, Side::Exact, Over::Space);
        match (&material.fill, material.is_lit()) {
            (Fill::Flat(color), false) => self.fan::<COLORED>(number, &polygon, |_| *color),
            (Fill::Gouraud, false) => self.fan::<COLORED>(number, &polygon, divided),
            _ => self.fan::<WHOLE>(number, &polygon, |point| {
                material.color(&Attributes::from_values(divided(point)))
            }),
        }
        let logged = Primitive {
            number,
            mixed_headroom: if material.is_lit() || material.texture().is_some() {
                MIXED_HEADROOM
            } else {
                1.0
            },
            triangle: &triangle,
            planes: &self.planes,
            projection: &self.projection,
            size: [f64::from(self.width), f64::from(self.height)],
            cull: self.cull,
            over: Over::Space,
        };
        let polygon = |outline| Polygon {
            outline,
            material: Arc::clone(material),
        };
        self.polygons.extend(logged.outlines().into_iter().map(polygon));
    }

    /// The material with the triangle's own normal where that counts: for flat surfaces after `flatnormals`, and for a
    /// triangle with a vertex that has no normal (section 7).
    fn finished(&self, triangle: &mut [Corner; 3], placed: &[Placed; 3], material: &Arc<Material>) -> Arc<Material> {
        if !material.is_lit() {
            return Arc::clone(material);
        }
        let wanted = self.flat_normals && matches!(material.fill, Fill::Flat(_));
        if wanted || placed.iter().any(|p| !p.has_normal) {
            let (normal, error) = Self::perpendicular(triangle);
            return Arc::new(Material {
                flat_normal: Some(normal),
                flat_normal_error: error,
                ..Material::clone(material)
            });
        }
        // A patch's normal that the core may find to be 0 makes it use the flat one at all corners.
        if triangle.iter().any(may_vanish) {
            triangle.iter_mut().for_each(any_direction);
        }
        Arc::clone(material)
    }

    /// Draws a polygon as a fan from its first corner; triangles with a corner that has no place are left out.
    fn fan<const N: usize>(&mut self, number: u32, polygon: &[Corner], shade: impl Fn(&Point<N>) -> [f64; 3]) {
        let points: Vec<Option<Point<N>>> = polygon.iter().map(|c| self.on_screen(c)).collect();
        for i in 2..points.len() {
            if let [Some(a), Some(b), Some(c)] = [points[0], points[i - 1], points[i]] {
                self.draw(number, &[a, b, c], &shade);
            }
        }
    }

    /// X, Y, Z, 1/w and attributes/w of a corner; none if w is 0 or its place is not finite.
    fn on_screen<const N: usize>(&self, corner: &Corner) -> Option<Point<N>> {
        let [x, y, z, w] = self.projection.matrix.apply(&corner.eye);
        let half = [self.width, self.height].map(|s| f64::from(s) / 2.0);
        let px = [x / w * half[0] + half[0], y / w * half[1] + half[1]];
        let mut point = [0.0; N];
        point[..REST].copy_from_slice(&[px[0], px[1], z / w, 1.0 / w]);
        for (slot, value) in point[REST..].iter_mut().zip(corner.at.values()) {
            *slot = value / w;
        }
        point[..REST].iter().all(|value| value.is_finite()).then_some(point)
    }

    fn draw<const N: usize>(
        &mut self,
        primitive: u32,
        corners: &[Point<N>; 3],
        shade: &impl Fn(&Point<N>) -> [f64; 3],
    ) {
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
            let [r, g, b] = shade(point);
            *pixel = Pixel {
                color: [r, g, b, 1.0],
                depth,
                primitive,
            };
        });
    }
}

/// The first of the interpolated values, freed from 1/w.
fn divided<const N: usize, const K: usize>(point: &Point<N>) -> [f64; K] {
    array::from_fn(|i| point[REST + i] / point[Q])
}
