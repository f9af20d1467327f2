//! Inventor scenes in float64, in the plainest evaluation order of formats/iv.md.

mod clip;
pub mod lighting;
mod transform;

use clip::{Corner, Linear, VALUES, clip};
use lighting::Lighting;
use transform::{ToClip, ToWorld};

use super::matrix::{Vector, cross, dot, unit_or_zero};
use super::raster::{self, Point, Q, REST, X, Y, Z};
use super::{Pixel, Rendered};
use crate::scene::iv::{Face, Object, Scene, Shading};

/// Numbers of a point on the screen.
const WHOLE: usize = REST + VALUES;

/// The picture of a scene. Primitives are the triangles of the faces' fans, numbered from 1 in file order, also those
/// that are culled or clipped away.
pub fn draw(scene: &Scene) -> Rendered<()> {
    let empty = Pixel {
        color: [0.0; 4],
        depth: 1.0,
        primitive: 0,
    };
    let (width, height) = (scene.width, scene.height);
    let mut canvas = Canvas {
        shading: scene.shading,
        picture: Rendered {
            width,
            height,
            pixels: vec![empty; width as usize * height as usize],
            depth_range: [-1.0, 1.0],
            polygons: Vec::new(),
        },
        to_clip: ToClip::new(&scene.model.camera),
        primitives: 0,
    };
    let lights = &scene.lights();
    for object in &scene.model.objects {
        let lighting = Lighting {
            material: &object.material,
            lights,
            eye: scene.model.camera.position,
        };
        let to_world = ToWorld::new(&object.transforms);
        for face in &object.faces {
            canvas.face(&placed(face, object, &to_world), &lighting);
        }
    }
    canvas.picture
}

/// A corner of a face in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Placed {
    position: [f64; 3],
    /// Of unit length, or 0.
    normal: [f64; 3],
}

fn placed(face: &Face, object: &Object, to_world: &ToWorld) -> Vec<Placed> {
    let corners = face.corners.iter().map(|corner| Placed {
        position: to_world.point(object.points[corner.point]),
        normal: to_world.normal(object.normals[corner.normal]),
    });
    corners.collect()
}

/// The picture so far, and what its triangles have in common.
struct Canvas {
    shading: Shading,
    picture: Rendered<()>,
    to_clip: ToClip,
    /// How many there were.
    primitives: u32,
}

impl Canvas {
    fn face(&mut self, corners: &[Placed], lighting: &Lighting<'_>) {
        let flat = match self.shading {
            Shading::Flat => mean_color(corners, lighting),
            Shading::Gouraud | Shading::Phong => [0.0; 3],
        };
        let corners: Vec<Corner> = corners
            .iter()
            .map(|corner| self.corner(corner, flat, lighting))
            .collect();
        for i in 2..corners.len() {
            self.primitives += 1;
            self.triangle(&[corners[0], corners[i - 1], corners[i]], lighting);
        }
    }

    /// What is interpolated: for flat and Gouraud shading a colour, for Phong shading position and normal.
    fn corner(&self, at: &Placed, flat: [f64; 3], lighting: &Lighting<'_>) -> Corner {
        let (a, b) = match self.shading {
            Shading::Flat => (flat, [0.0; 3]),
            Shading::Gouraud => (lighting.color(at.position, at.normal), [0.0; 3]),
            Shading::Phong => (at.position, at.normal),
        };
        Corner {
            clip: self.to_clip.point(at.position),
            values: [a[0], a[1], a[2], b[0], b[1], b[2]],
        }
    }

    fn triangle(&mut self, corners: &[Corner; 3], lighting: &Lighting<'_>) {
        if !faces_camera(corners.map(|corner| corner.clip)) {
            return;
        }
        let linear = match self.shading {
            Shading::Flat | Shading::Gouraud => Linear::Screen,
            Shading::Phong => Linear::Space,
        };
        let polygon = clip(corners, linear);
        let points: Vec<Point<WHOLE>> = polygon.iter().map(|corner| self.on_screen(corner, linear)).collect();
        for i in 2..points.len() {
            let triangle = [points[0], points[i - 1], points[i]];
            // Nothing is known of where a corner lies whose numbers overflow.
            if triangle.as_flattened().iter().all(|value| value.is_finite()) {
                self.fill(&triangle, lighting);
            }
        }
    }

    /// The point in px, y down, moved by half a pixel since [`raster::walk`] samples at whole coordinates and pixels are
    /// sampled in the middle.
    fn on_screen(&self, corner: &Corner, linear: Linear) -> Point<WHOLE> {
        let [x, y, z, w] = corner.clip;
        let [width, height] = [self.picture.width, self.picture.height].map(f64::from);
        let mut point = [0.0; WHOLE];
        point[X] = (x / w + 1.0) / 2.0 * width - 0.5;
        point[Y] = (1.0 - y / w) / 2.0 * height - 0.5;
        point[Z] = z / w;
        point[Q] = 1.0 / w;
        for (slot, value) in point[REST..].iter_mut().zip(corner.values) {
            *slot = match linear {
                Linear::Screen => value,
                Linear::Space => value / w,
            };
        }
        point
    }

    fn fill(&mut self, triangle: &[Point<WHOLE>; 3], lighting: &Lighting<'_>) {
        let (shading, primitive) = (self.shading, self.primitives);
        let Rendered {
            width, height, pixels, ..
        } = &mut self.picture;
        let row = *width as usize;
        raster::walk(triangle, *width, *height, |x, y, point| {
            let pixel = &mut pixels[y * row + x];
            let depth = point[Z];
            // The background is infinitely far away.
            if pixel.primitive != 0 && depth >= pixel.depth {
                return;
            }
            let [r, g, b] = color(point, shading, lighting);
            *pixel = Pixel {
                color: [r, g, b, 1.0],
                depth,
                primitive,
            };
        });
    }
}

/// The colour of an interpolated point.
fn color(point: &Point<WHOLE>, shading: Shading, lighting: &Lighting<'_>) -> [f64; 3] {
    let value = |i: usize| point[REST + i];
    match shading {
        Shading::Flat | Shading::Gouraud => [value(0), value(1), value(2)],
        Shading::Phong => {
            let position = [0, 1, 2].map(|i| value(i) / point[Q]);
            // Dividing by w does not turn it.
            let normal = unit_or_zero([value(3), value(4), value(5)]);
            lighting.color(position, normal)
        }
    }
}

/// The one colour of a flat face: at its corners' mean position with their mean normal.
fn mean_color(corners: &[Placed], lighting: &Lighting<'_>) -> [f64; 3] {
    let count = corners.len() as f64;
    let mean = |of: fn(&Placed) -> [f64; 3]| [0, 1, 2].map(|i| corners.iter().map(|c| of(c)[i]).sum::<f64>() / count);
    lighting.color(mean(|c| c.position), unit_or_zero(mean(|c| c.normal)))
}

/// Whether a triangle is counter-clockwise on the screen with y up: by the sign of the determinant of x, y, w, which is that of
/// the area on the screen where all corners have a place there. Of differences, so that small triangles do not cancel, from the
/// corner nearest to the origin: from one far away the others would not differ. And without a division, which corners beside the
/// camera would not survive.
fn faces_camera(corners: [Vector; 3]) -> bool {
    let mut corners = corners.map(|[x, y, _, w]| [x, y, w]);
    let farthest = |v: [f64; 3]| v.into_iter().map(f64::abs).fold(0.0, f64::max);
    let nearest = (0..3).min_by(|&i, &j| farthest(corners[i]).total_cmp(&farthest(corners[j])));
    corners.rotate_left(nearest.unwrap_or(0));
    let [a, b, c] = corners;
    let from_a = |v: [f64; 3]| [0, 1, 2].map(|i| v[i] - a[i]);
    dot(a, cross(from_a(b), from_a(c))) > 0.0
}

#[cfg(test)]
mod tests;
