//! Random Inventor scenes through the core and the reference: no difference may be unexplained, and the classes may not hide a
//! picture.
//!
//! Each kind of scene stresses one thing, in all three shading modes; the seeds are fixed, so a failure names a scene that can be
//! drawn again; `FIXEL_SEEDS=1000..6000` draws others.

mod random;

use fixel_host::compare::iv::compare;
use fixel_host::compare::{Class, Comparison};
use fixel_host::fixed;
use fixel_host::reference;
use fixel_host::scene::iv::{
    Camera, Corner, Face, Light, Material, Model, Object, Rotation, Scene, Shading, Transform,
};
use random::{Random, none_unexplained, seeds};

const SIZE: u32 = 64;
const SCENES: u64 = 120;

/// Scenes that had differences which nothing explained, of 90,000: colours of faces that end far off the picture.
const FORMER: [(&str, u64); 4] = [
    ("inside_the_model", 10_450),
    ("inside_the_model", 10_825),
    ("inside_the_model", 13_054),
    ("inside_the_model", 14_053),
];

impl Random {
    fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }

    /// Each component within ±`reach`.
    fn vector(&mut self, reach: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.within(-reach, reach))
    }

    fn color(&mut self) -> [f64; 3] {
        std::array::from_fn(|_| self.unit())
    }

    /// A number between two powers of ten.
    fn power(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.within(low, high))
    }

    fn turn(&mut self) -> Rotation {
        Rotation {
            axis: self.vector(2.0),
            angle: self.within(-10.0, 10.0),
        }
    }

    /// Matte in one of three, else with one of the shininesses.
    fn material(&mut self, shininess: &[f64]) -> Material {
        let specular = if self.one_in(3) { [0.0; 3] } else { self.color() };
        Material {
            ambient: self.color().map(|c| 0.3 * c),
            diffuse: self.color(),
            specular,
            shininess: self.of(shininess),
        }
    }

    fn lights(&mut self, count: usize, reach: f64) -> Vec<Light> {
        let light = |random: &mut Self| Light {
            location: random.vector(reach),
            color: random.color(),
        };
        (0..count).map(|_| light(self)).collect()
    }
}

/// A camera that looks from z = 5 at what lies around the origin.
const CAMERA: Camera = Camera {
    position: [0.0, 0.0, 5.0],
    orientation: Rotation {
        axis: [0.0, 0.0, 1.0],
        angle: 0.0,
    },
    near: 1.0,
    far: 10.0,
    left: -0.5,
    right: 0.5,
    bottom: -0.5,
    top: 0.5,
};

const SHININESS: [f64; 5] = [0.0, 0.2, 1.0, 30.0, 500.0];

/// A planar convex face of 3 to 6 corners around `center`, `radius` wide, with normals that bend over it.
fn face(random: &mut Random, object: &mut Object, center: [f64; 3], radius: f64) {
    let (a, b) = (random.vector(radius), random.vector(radius));
    let across = [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ];
    let count = 3 + random.below(4);
    let start = random.within(0.0, 6.0);
    // Most are turned to the default camera.
    let sign = if across[2] < 0.0 && !random.one_in(4) {
        -1.0
    } else {
        1.0
    };
    let mut corners = Vec::new();
    for k in 0..count {
        let (sin, cos) = (start + sign * std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
        corners.push(Corner {
            point: object.points.len(),
            normal: object.normals.len(),
        });
        let bend = random.vector(0.4 * radius * radius);
        object
            .points
            .push([0, 1, 2].map(|i| center[i] + cos * a[i] + sin * b[i]));
        object.normals.push([0, 1, 2].map(|i| sign * across[i] + bend[i]));
    }
    object.faces.push(Face { corners });
}

/// So many faces within `reach` of the origin.
fn object(random: &mut Random, material: Material, faces: usize, reach: f64, radius: f64) -> Object {
    let mut object = Object {
        material,
        ..Object::default()
    };
    for _ in 0..faces {
        let center = random.vector(reach);
        face(random, &mut object, center, radius);
    }
    object
}

/// Faces before the default camera, in several objects.
fn model(random: &mut Random) -> Model {
    let lights = random.lights(3, 8.0);
    let object = |random: &mut Random| {
        let material = random.material(&SHININESS);
        object(random, material, 5, 1.8, 1.6)
    };
    Model {
        camera: CAMERA,
        lights,
        objects: (0..3).map(|_| object(random)).collect(),
    }
}

/// Draws the scenes of a kind, a third in each mode, and compares them. Classes other than *colour* may hold one drawn pixel in
/// `excused`.
fn compared(kind: &str, excused: u64, model: impl Fn(&mut Random) -> Model) -> Vec<Comparison> {
    sized(kind, excused, |random| (SIZE, SIZE, model(random)))
}

fn sized(kind: &str, excused: u64, model: impl Fn(&mut Random) -> (u32, u32, Model)) -> Vec<Comparison> {
    let mut all = Vec::new();
    let mut bad = Vec::new();
    for seed in seeds(kind, SCENES, &FORMER) {
        let mut random = Random::new(kind, seed);
        let (width, height, model) = model(&mut random);
        let scene = Scene {
            width,
            height,
            output: "o.png".into(),
            shading: [Shading::Flat, Shading::Gouraud, Shading::Phong][seed as usize % 3],
            eyelight: random.one_in(4),
            model,
        };
        let (fixed, reference) = (fixed::iv::draw(&scene).unwrap(), reference::iv::draw(&scene));
        let comparison = compare(&scene, &fixed, &reference);
        if let Some(at) = comparison.classes.iter().position(|class| *class == Class::Unexplained) {
            let (x, y) = (at as u32 % width, at as u32 / width);
            let (ours, theirs) = (fixed.pixels[at], reference.pixels[at]);
            bad.push(format!(
                "{kind} {seed} {:?}: {} pixels, first ({x}, {y}): {ours:?} {theirs:?}",
                scene.shading, comparison.unexplained
            ));
        }
        all.push(comparison);
    }
    let sum = |of: &dyn Fn(&Comparison) -> u64| all.iter().map(of).sum::<u64>();
    let drawn = sum(&|c| c.pixels_drawn);
    let hidden = sum(&|c| c.explained.edge + c.explained.depth + c.explained.pole + c.explained.steep);
    println!(
        "{kind}: drawn {drawn}, colour {}, edge {}, depth {}, pole {}, steep {}",
        sum(&|c| c.explained.colour),
        sum(&|c| c.explained.edge),
        sum(&|c| c.explained.depth),
        sum(&|c| c.explained.pole),
        sum(&|c| c.explained.steep),
    );
    none_unexplained(&bad, all.len());
    assert!(
        drawn > 300 * all.len() as u64,
        "{kind}: {drawn} pixels are too few to tell"
    );
    assert!(hidden * excused < drawn, "{kind}: {hidden} of {drawn} pixels excused");
    all
}

#[test]
fn plain() {
    compared("plain", 1000, model);
}

/// Each shininess on faces whose normals bend widely, seen from near: highlights of every shape, and k near 0.
#[test]
fn highlights() {
    compared("highlights", 1000, |random| {
        let mut model = model(random);
        for object in &mut model.objects {
            object.material.specular = random.color();
            for normal in &mut object.normals {
                let bend = random.vector(1.0);
                *normal = [0, 1, 2].map(|i| normal[i] + bend[i]);
            }
        }
        model
    });
}

/// Some beyond full, some negative, some at vertices, and the eye at one.
#[test]
fn many_lights() {
    compared("many_lights", 1000, |random| {
        let mut model = model(random);
        model.lights = random.lights(40, 6.0);
        for i in 0..40 {
            let light = &mut model.lights[i];
            match random.below(5) {
                0 => light.color = light.color.map(|c| -c),
                1 => light.color = light.color.map(|c| 20.0 * c - 10.0),
                2 => light.color = light.color.map(|c| 0.05 * c),
                3 => light.location = random.of(&random_points(&model.objects)),
                _ => {}
            }
            // So that not all is white.
            model.lights[i].color = model.lights[i].color.map(|c| 0.1 * c);
        }
        if random.one_in(2) {
            let eye = random.below(model.objects.len());
            let corner = random.below(model.objects[eye].points.len());
            model.objects[eye].points[corner] = CAMERA.position;
        }
        model
    });
}

fn random_points(objects: &[Object]) -> Vec<[f64; 3]> {
    objects.iter().flat_map(|object| object.points.clone()).collect()
}

/// One inside the other, with mirrored and very unequal scales, which the inner ones undo in part.
#[test]
fn nested_transforms() {
    compared("nested_transforms", 1000, |random| {
        let mut model = model(random);
        for object in &mut model.objects {
            for _ in 0..2 {
                let mut scale: [f64; 3] = std::array::from_fn(|_| random.power(-0.3, 0.3));
                if random.one_in(2) {
                    scale[random.below(3)] *= -1.0;
                }
                object.transforms.push(Transform {
                    translation: random.vector(0.5),
                    rotation: random.turn(),
                    scale_factor: scale,
                });
            }
            let unequal: [f64; 3] = std::array::from_fn(|_| random.power(-4.0, 4.0));
            object.transforms.push(Transform {
                scale_factor: unequal,
                ..Transform::default()
            });
            for point in &mut object.points {
                *point = [0, 1, 2].map(|i| point[i] / unequal[i]);
            }
            for normal in &mut object.normals {
                *normal = [0, 1, 2].map(|i| normal[i] * unequal[i]);
            }
        }
        model
    });
}

/// The same at another size: camera, lights and models.
#[test]
fn tiny_and_huge_models() {
    compared("tiny_and_huge_models", 1000, |random| {
        let mut model = model(random);
        let size = random.power(-3.0, 6.0);
        let scaled = |v: &mut [f64; 3]| *v = v.map(|c| c * size);
        scaled(&mut model.camera.position);
        model.camera.near *= size;
        model.camera.far *= size;
        for side in [
            &mut model.camera.left,
            &mut model.camera.right,
            &mut model.camera.bottom,
            &mut model.camera.top,
        ] {
            *side *= size;
        }
        model.lights.iter_mut().for_each(|light| scaled(&mut light.location));
        for object in &mut model.objects {
            if random.one_in(2) {
                object.points.iter_mut().for_each(scaled);
            } else {
                object.transforms.push(Transform {
                    scale_factor: [size; 3],
                    ..Transform::default()
                });
            }
        }
        model
    });
}

/// Everything is moved, by the points themselves or by a Transform.
#[test]
fn far_from_the_origin() {
    compared("far_from_the_origin", 1000, |random| {
        let mut model = model(random);
        let by = random.vector(1e5);
        let moved = |v: &mut [f64; 3]| *v = [0, 1, 2].map(|i| v[i] + by[i]);
        moved(&mut model.camera.position);
        for light in &mut model.lights {
            moved(&mut light.location);
        }
        for object in &mut model.objects {
            if random.one_in(2) {
                object.points.iter_mut().for_each(moved);
            } else {
                object.transforms.push(Transform {
                    translation: by,
                    ..Transform::default()
                });
            }
        }
        model
    });
}

/// The camera stands amid the faces and looks anywhere: many reach behind it, and near and far planes cut.
#[test]
fn inside_the_model() {
    compared("inside_the_model", 1000, |random| {
        let mut model = model(random);
        model.camera = Camera {
            position: random.vector(1.0),
            orientation: random.turn(),
            near: random.power(-2.0, 0.0),
            far: random.within(1.5, 4.0),
            ..CAMERA
        };
        let near = model.camera.near;
        for side in [
            &mut model.camera.left,
            &mut model.camera.right,
            &mut model.camera.bottom,
            &mut model.camera.top,
        ] {
            *side *= 2.0 * near;
        }
        // Both sides of each.
        for object in &mut model.objects {
            let back = |face: &Face| Face {
                corners: face.corners.iter().rev().copied().collect(),
            };
            let backs: Vec<Face> = object.faces.iter().map(back).collect();
            object.faces.extend(backs);
        }
        model
    });
}

/// Long walls that begin behind the camera and end beyond the far plane.
#[test]
fn walls_from_behind_to_beyond() {
    compared("walls_from_behind_to_beyond", 1000, |random| {
        let mut model = model(random);
        for object in &mut model.objects {
            for point in &mut object.points {
                point[2] = if random.one_in(2) {
                    random.within(4.5, 9.0)
                } else {
                    random.within(-15.0, 0.0)
                };
                point[0] *= 1.5;
                point[1] *= 1.5;
            }
            let back = |face: &Face| Face {
                corners: face.corners.iter().rev().copied().collect(),
            };
            let backs: Vec<Face> = object.faces.iter().map(back).collect();
            object.faces.extend(backs);
        }
        model
    });
}

/// left > right, bottom > top, or both, and windows off the axis.
#[test]
fn reversed_windows() {
    compared("reversed_windows", 1000, |random| {
        let mut model = model(random);
        let camera = &mut model.camera;
        let [dx, dy] = [0; 2].map(|_| random.within(-0.3, 0.3));
        (camera.left, camera.right) = (camera.left + dx, camera.right + dx);
        (camera.bottom, camera.top) = (camera.bottom + dy, camera.top + dy);
        if random.one_in(2) {
            std::mem::swap(&mut camera.left, &mut camera.right);
        }
        if random.one_in(2) {
            std::mem::swap(&mut camera.bottom, &mut camera.top);
        }
        model
    });
}

/// Faces that are not planar, normals of length 0 or that point backwards, corners that coincide, faces without area.
#[test]
fn odd_faces() {
    compared("odd_faces", 1000, |random| {
        let mut model = model(random);
        for object in &mut model.objects {
            for point in &mut object.points {
                let bump = random.vector(0.3);
                *point = [0, 1, 2].map(|i| point[i] + bump[i]);
            }
            for i in 0..object.normals.len() {
                match random.below(6) {
                    0 => object.normals[i] = [0.0; 3],
                    1 => object.normals[i] = object.normals[i].map(|c| -c),
                    2 => object.normals[i] = object.normals[i].map(|c| 1e200 * c),
                    _ => {}
                }
            }
            let face = object.faces[0].clone();
            object.faces[1].corners[0] = face.corners[0];
            object.faces[2].corners[1] = object.faces[2].corners[0];
        }
        model
    });
}

/// The same faces twice, or cut in other triangles: float64 and the core may each take either, pixel for pixel, so that much of
/// a picture may be of class depth.
#[test]
fn coplanar_faces() {
    let all = compared("coplanar_faces", 4, |random| {
        let mut model = model(random);
        let mut again = model.objects[0].clone();
        again.material = random.material(&SHININESS);
        for face in &mut again.faces {
            face.corners.rotate_left(1);
        }
        model.objects.push(again);
        model
    });
    assert!(all.iter().map(|c| c.explained.depth).sum::<u64>() > 0);
}

/// Pictures of one pixel, one row or one column, and such as need wider edges.
#[test]
fn sizes_of_pictures() {
    sized("sizes_of_pictures", 1000, |random| {
        let model = model(random);
        let sizes = [
            (1, 1),
            (1, 300),
            (300, 1),
            (7, 500),
            (333, 40),
            (5000, 20),
            (30, 4500),
            (9000, 3),
        ];
        let (width, height) = random.of(&sizes);
        (width, height, model)
    });
}

/// The same face again, as it is: depth by depth the same, and the earlier stays.
#[test]
fn the_same_faces_twice() {
    compared("the_same_faces_twice", 1000, |random| {
        let mut model = model(random);
        let mut again = model.objects[0].clone();
        again.material = random.material(&SHININESS);
        model.objects.push(again);
        model
    });
}

/// Near, or at the very camera, a face has a corner, which is seen from any side: w is 0 there, or rounding.
#[test]
fn the_eye_at_a_vertex() {
    compared("the_eye_at_a_vertex", 1000, |random| {
        let mut model = model(random);
        model.camera.orientation = Rotation {
            angle: random.within(-0.5, 0.5),
            ..random.turn()
        };
        for object in &mut model.objects {
            let corner = object.faces[0].corners[random.below(3)];
            object.points[corner.point] = CAMERA.position;
        }
        model
    });
}

/// Corners beside the camera: their w is 0, or rounding of either sign, so that two rules may give the colour at the cut. That is of
/// class steep, and a wall fills the picture.
#[test]
fn beside_the_camera() {
    let all = compared("beside_the_camera", 3, |random| {
        let mut model = model(random);
        let quarter = std::f64::consts::FRAC_PI_2;
        let angle = [0.0, quarter, 2.0 * quarter, -quarter, random.within(-3.0, 3.0)][random.below(5)];
        model.camera.orientation = Rotation {
            axis: [0.0, 1.0, 0.0],
            angle,
        };
        let (sin, cos) = angle.sin_cos();
        // From the camera's own axes.
        let place = |[x, y, z]: [f64; 3]| [x * cos + z * sin, y, z * cos - x * sin + CAMERA.position[2]];
        for object in &mut model.objects {
            for face in &object.faces {
                for corner in &face.corners {
                    let [x, y, _] = random.vector(6.0);
                    let z = if random.one_in(2) {
                        0.0
                    } else {
                        random.within(-9.0, -1.0)
                    };
                    object.points[corner.point] = place([x, y, z]);
                }
            }
            let back = |face: &Face| Face {
                corners: face.corners.iter().rev().copied().collect(),
            };
            let backs: Vec<Face> = object.faces.iter().map(back).collect();
            object.faces.extend(backs);
        }
        model
    });
    assert!(all.iter().map(|c| c.explained.colour).sum::<u64>() > 0);
}

/// A wall exactly on the far plane, behind everything else: its depth is 1, which is drawn where there is nothing yet.
#[test]
fn on_the_far_plane() {
    compared("on_the_far_plane", 1000, |random| {
        let mut model = model(random);
        // 12/8 and 40/8 are exact, and so is the depth.
        model.camera = Camera {
            near: 2.0,
            left: -1.0,
            right: 1.0,
            bottom: -1.0,
            top: 1.0,
            ..CAMERA
        };
        let [wall, ..] = &mut model.objects[..] else {
            unreachable!()
        };
        wall.faces.truncate(1);
        for point in &mut wall.points {
            point[2] = -5.0;
        }
        model
    });
}

/// Normals exactly across the direction half way between eye and light, and exponents of next to nothing: roots of rounding, so
/// that a flat face, or a corner, may have any brightness between none and a fifth.
#[test]
fn roots_of_nothing() {
    let all = compared("roots_of_nothing", 4, |random| {
        let mut model = model(random);
        model.lights.truncate(1);
        for object in &mut model.objects {
            object.material.specular = random.color();
            object.material.shininess = random.of(&[0.05, 0.1, 0.2]);
            if !random.one_in(3) {
                continue;
            }
            for face in &object.faces {
                let mean = [0, 1, 2].map(|i| {
                    let sum: f64 = face.corners.iter().map(|corner| object.points[corner.point][i]).sum();
                    sum / face.corners.len() as f64
                });
                let unit = |to: [f64; 3]| {
                    let v = [0, 1, 2].map(|i| to[i] - mean[i]);
                    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
                    v.map(|c| c / length)
                };
                let (eye, light) = (unit(CAMERA.position), unit(model.lights[0].location));
                let across = [0, 1, 2].map(|i| eye[i] - light[i]);
                for corner in &face.corners {
                    object.normals[corner.normal] = across;
                }
            }
        }
        model
    });
    assert!(all.iter().map(|c| c.explained.steep).sum::<u64>() > 0);
}

/// A light, or the eye, so near above a surface that one px turns their directions by much, and exponents of every size.
#[test]
fn lights_and_eyes_at_the_surface() {
    compared("lights_and_eyes_at_the_surface", 1000, |random| {
        let mut model = model(random);
        model.lights.clear();
        for object in &mut model.objects {
            for face in &object.faces {
                let mut at = [0.0; 3];
                let mut rest = 1.0;
                for corner in &face.corners {
                    let share = rest * random.unit();
                    rest -= share;
                    let point = object.points[corner.point];
                    at = [0, 1, 2].map(|i| at[i] + share * point[i]);
                }
                let off = random.vector(1.0);
                let by = random.power(-8.0, 0.0);
                model.lights.push(Light {
                    location: [0, 1, 2].map(|i| at[i] + by * off[i]),
                    color: random.color().map(|c| 0.2 * c),
                });
            }
        }
        model
    });
}
