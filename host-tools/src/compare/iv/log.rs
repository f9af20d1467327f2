//! The primitives of a scene as float64 has them, with the bounds of the core's differences (formats/iv.md).

use std::sync::Arc;

use super::lighting::{Lighting, Place};
use super::look::Paint;
use crate::compare::direction::Direction;
use crate::compare::interval::Interval;
use crate::compare::stated::{FIXED_PRODUCT, FLOAT_PRODUCT, UNIT_VECTOR};
use crate::reference::attributes::{Attributes, Bounds, CARRIED};
use crate::reference::bound::{Tracked, cancellation, size};
use crate::reference::clip::{Corner as ClipCorner, Over, Plane};
use crate::reference::iv::lighting;
use crate::reference::log::{Corner, Outline, Polygon, Primitive};
use crate::reference::matrix::{Matrix, Vector, length, unit_or_zero};
use crate::scene::iv::{Camera, Face, Object, Rotation, Scene, Shading, Transform};

/// Every primitive's polygons, in drawing order.
pub fn polygons(scene: &Scene) -> Vec<Polygon<Paint>> {
    let mut log = Log {
        scene,
        screen: Screen::new(scene),
        primitives: 0,
        polygons: Vec::new(),
    };
    for object in &scene.model.objects {
        log.object(object);
    }
    log.polygons
}

struct Log<'s> {
    scene: &'s Scene,
    screen: Screen,
    primitives: u32,
    polygons: Vec<Polygon<Paint>>,
}

/// A corner of a face.
#[derive(Clone, Copy)]
struct Placed {
    /// In the world, and by how much the core's may be elsewhere.
    position: [f64; 3],
    position_error: f64,
    /// Of unit length, or 0.
    normal: [f64; 3],
    normal_error: f64,
    clip: Vector,
    clip_error: f64,
}

impl Log<'_> {
    fn object(&mut self, object: &Object) {
        let world = ToWorld::new(&object.transforms);
        let lighting = Arc::new(Lighting {
            material: object.material,
            lights: self.scene.lights(),
            eye: self.scene.model.camera.position,
        });
        let used = object.used();
        let places = used.iter().map(|&point| world.point(point).0);
        let extents = extents(places);
        // Places are counted from the middle, in units of 30 bits of the farthest; the lights are rounded to them.
        let unit = CARRIED * extents * 3f64.sqrt();
        for face in &object.faces {
            let corners = self.placed(face, object, &world);
            self.face(&corners, &lighting, unit);
        }
    }

    fn placed(&self, face: &Face, object: &Object, world: &ToWorld) -> Vec<Placed> {
        let corners = face.corners.iter().map(|corner| {
            let (position, position_error) = world.point(object.points[corner.point]);
            let (normal, normal_error) = world.normal(object.normals[corner.normal]);
            let [x, y, z] = position;
            let (clip, clip_error) = self.screen.to_clip.apply(&[x, y, z, 1.0], position_error);
            Placed {
                position,
                position_error,
                normal,
                normal_error,
                clip,
                clip_error,
            }
        });
        corners.collect()
    }

    fn face(&mut self, corners: &[Placed], lighting: &Arc<Lighting>, unit: f64) {
        let (paint, flat) = match self.scene.shading {
            Shading::Flat => {
                let (color, error) = mean_color(corners, lighting);
                (Paint::Flat { color, error }, color)
            }
            Shading::Gouraud => (Paint::Gouraud, [0.0; 3]),
            Shading::Phong => (
                Paint::Phong {
                    lighting: Arc::clone(lighting),
                    unit,
                },
                [0.0; 3],
            ),
        };
        let corners: Vec<ClipCorner> = corners
            .iter()
            .map(|placed| self.corner(placed, flat, lighting, unit))
            .collect();
        for i in 2..corners.len() {
            self.primitives += 1;
            let outlines = self.outlines(&[corners[0], corners[i - 1], corners[i]]);
            let polygon = |outline| Polygon {
                outline,
                material: paint.clone(),
            };
            self.polygons.extend(outlines.into_iter().map(polygon));
        }
    }

    fn corner(&self, placed: &Placed, flat: [f64; 3], lighting: &Lighting, unit: f64) -> ClipCorner {
        let (color, color_error) = match self.scene.shading {
            Shading::Flat | Shading::Phong => (flat, 0.0),
            Shading::Gouraud => lit(placed, lighting),
        };
        ClipCorner {
            eye: placed.clip,
            at: Attributes {
                color,
                normal: placed.normal,
                eye: placed.position,
                ..Attributes::default()
            },
            error: placed.clip_error,
            at_error: Bounds {
                color: color_error,
                normal: placed.normal_error,
                eye: placed.position_error + unit,
                ..Bounds::default()
            },
        }
    }

    fn outlines(&self, triangle: &[ClipCorner; 3]) -> Vec<Outline> {
        // Only what reaches behind the camera has to be cut; the depth range does the rest. But colours are those of the fan
        // of what both planes leave.
        let behind = triangle.iter().any(|corner| corner.eye[3] <= corner.error);
        let gouraud = self.scene.shading == Shading::Gouraud;
        let [near, _] = &self.screen.planes;
        let planes = match (behind, gouraud) {
            (false, _) => &[],
            (true, false) => std::slice::from_ref(near),
            (true, true) => &self.screen.planes[..],
        };
        let primitive = Primitive {
            number: self.primitives,
            mixed_headroom: 1.0,
            triangle,
            planes,
            projection: &self.screen.to_pixels,
            size: self.screen.size,
            cull: true,
            over: if gouraud { Over::Screen } else { Over::Space },
        };
        let mut outlines = primitive.outlines();
        if gouraud {
            outlines.iter_mut().for_each(over_the_screen);
        }
        outlines
    }
}

/// Values linear over the screen: w does not count; and where something was cut, each triangle of the fan has its own.
fn over_the_screen(outline: &mut Outline) {
    outline.fanned = outline.inner.is_some();
    let without_w = |corner: &mut Corner| {
        corner.w = 1.0;
        corner.weight_error = 0.0;
    };
    outline.outer.iter_mut().for_each(without_w);
    outline.inner.iter_mut().flatten().for_each(without_w);
}

/// The picture: clip space, and how its corners come to pixels.
struct Screen {
    /// World to clip space.
    to_clip: Tracked,
    /// Clip space with y down and samples at whole coordinates.
    to_pixels: Tracked,
    /// The near one and the far one.
    planes: [Plane; 2],
    size: [f64; 2],
}

impl Screen {
    fn new(scene: &Scene) -> Self {
        let Camera {
            position,
            orientation,
            near,
            far,
            left,
            right,
            bottom,
            top,
        } = scene.model.camera;
        let window = [left, right, bottom, top, near, far];
        let back = Tracked::given(Matrix::translation(position.map(|c| -c)));
        let view = rotation(&orientation).transposed().times(&back);
        let projection = Tracked::computed(Matrix::frustum(window), cancellation(&window));
        let size = [scene.width, scene.height].map(f64::from);
        let [half_x, half_y] = size.map(f64::recip);
        let to_pixels = Matrix([
            [1.0, 0.0, 0.0, -half_x],
            [0.0, -1.0, 0.0, -half_y],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]);
        Self {
            to_clip: projection.times(&view),
            to_pixels: Tracked::given(to_pixels),
            planes: [1.0, -1.0].map(|z| Plane::new([0.0, 0.0, z, 1.0], &Tracked::identity())),
            size,
        }
    }
}

fn rotation(rotation: &Rotation) -> Tracked {
    if rotation.angle == 0.0 {
        return Tracked::identity();
    }
    Tracked::turning(rotation.angle, unit_or_zero(rotation.axis))
}

/// Object space to the world.
struct ToWorld {
    points: Tracked,
    normals: Tracked,
}

impl ToWorld {
    fn new(transforms: &[Transform]) -> Self {
        let (mut points, mut normals) = (Tracked::identity(), Tracked::identity());
        for transform in transforms {
            let turn = rotation(&transform.rotation);
            let scale = transform.scale_factor;
            points = points
                .times(&Tracked::given(Matrix::translation(transform.translation)))
                .times(&turn)
                .times(&Tracked::given(Matrix::scaling(scale)));
            // Times the smallest, so that none overflows; a normal's length does not count.
            let smallest = scale.iter().fold(f64::MAX, |least, s| least.min(s.abs()));
            let reciprocals = Matrix::scaling(scale.map(|s| smallest / s));
            normals = normals.times(&turn).times(&Tracked::computed(reciprocals, 1.0));
        }
        Self { points, normals }
    }

    fn point(&self, [x, y, z]: [f64; 3]) -> ([f64; 3], f64) {
        let given = [x, y, z, 1.0];
        let ([x, y, z, _], error) = self.points.apply(&given, FIXED_PRODUCT * size(&given));
        ([x, y, z], error)
    }

    fn normal(&self, normal: [f64; 3]) -> ([f64; 3], f64) {
        let [x, y, z] = unit_or_zero(normal);
        if [x, y, z] == [0.0; 3] {
            return ([0.0; 3], 0.0);
        }
        let given = FIXED_PRODUCT + FLOAT_PRODUCT;
        let ([x, y, z, _], error) = self.normals.apply(&[x, y, z, 0.0], given);
        let turned = 2.0 * error / length([x, y, z]);
        let rounding = 2.0 * (FIXED_PRODUCT + FLOAT_PRODUCT) + UNIT_VECTOR;
        (unit_or_zero([x, y, z]), turned.min(2.0) + rounding)
    }
}

/// How far places are from their middle, at the most; twice as much for a margin.
fn extents(places: impl Iterator<Item = [f64; 3]>) -> f64 {
    let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
    for place in places {
        for (range, c) in ranges.iter_mut().zip(place) {
            *range = [range[0].min(c), range[1].max(c)];
        }
    }
    let sides = ranges.map(|[low, high]| (high - low).max(0.0));
    2.0 * length(sides)
}

/// The colour at a corner, and by how much the core's may differ.
fn lit(placed: &Placed, lighting: &Lighting) -> ([f64; 3], f64) {
    at(
        placed.position,
        placed.position_error,
        placed.normal,
        placed.normal_error,
        lighting,
    )
}

/// The colour of a flat face: at its corners' mean position with their mean normal.
fn mean_color(corners: &[Placed], lighting: &Lighting) -> ([f64; 3], f64) {
    let count = corners.len() as f64;
    let mean = |of: fn(&Placed) -> [f64; 3]| [0, 1, 2].map(|i| corners.iter().map(|c| of(c)[i]).sum::<f64>() / count);
    let most = |of: fn(&Placed) -> f64| corners.iter().map(of).fold(0.0, f64::max);
    let (position, normal) = (mean(|c| c.position), mean(|c| c.normal));
    // The mean normal may be short, and is turned the more.
    let turned = 2.0 * (most(|c| c.normal_error) + UNIT_VECTOR) / length(normal);
    let error = if turned.is_nan() { 2.0 } else { turned.min(2.0) };
    at(
        position,
        most(|c| c.position_error),
        unit_or_zero(normal),
        error,
        lighting,
    )
}

fn at(position: [f64; 3], position_error: f64, normal: [f64; 3], normal_error: f64, own: &Lighting) -> ([f64; 3], f64) {
    let reference = lighting::Lighting {
        material: &own.material,
        lights: &own.lights,
        eye: own.eye,
    };
    let color = reference.color(position, normal);
    let rounding = (FIXED_PRODUCT + FLOAT_PRODUCT) * length(position);
    let place = Place {
        normal: Direction::of(normal, normal_error),
        at: position.map(|c| Interval::around(c, position_error + rounding)),
        unit: rounding,
    };
    let range = own.color(&place, true);
    let off = |i: usize| (range[i].high - color[i]).max(color[i] - range[i].low);
    (color, off(0).max(off(1)).max(off(2)).max(0.0))
}
