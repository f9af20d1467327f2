//! For each class and shading mode: a difference within its allowance is explained, one just beyond it is not; and no wrong
//! picture is explained away. δ is [`SNAP`] here, the vertex path of these scenes being exact but for 10⁻¹⁴ px.
//!
//! The camera stands at the origin and looks along -z; a px is w/16 of space at the distance w, and z/w = 2 - 3/w.

use super::*;
use crate::compare::Class;
use crate::compare::picture::Pixel;
use crate::compare::stated::{SNAP, WORLD_LEVEL, WORLD_UNIT};
use crate::reference::iv::draw;
use crate::scene::iv::{Camera, Corner, Face, Light, Material, Model, Object, Shading};

/// What is wrong, and the scene made so.
type Wrong = (&'static str, fn(&mut Scene));

const SIZE: u32 = 32;
/// The pixel that is changed, and its sample in px.
const AT: usize = 16 * SIZE as usize + 10;
const X: f64 = 10.5;
const MODES: [Shading; 3] = [Shading::Flat, Shading::Gouraud, Shading::Phong];
/// How far one step of depth is in z/w.
const STEP: f64 = 2.0 / 65535.0;

const BLACK: Material = Material {
    ambient: [0.0; 3],
    diffuse: [0.0; 3],
    specular: [0.0; 3],
    shininess: 1.0,
};

/// Where x, y in px lies at the distance w.
fn at(x: f64, y: f64, w: f64) -> [f64; 3] {
    let half = f64::from(SIZE) / 2.0;
    [(x / half - 1.0) * w, (1.0 - y / half) * w, -w]
}

/// The distance of a depth z/w.
fn depth(z: f64) -> f64 {
    3.0 / (2.0 - z)
}

/// A face of these corners and normals.
fn face<const N: usize>(points: [[f64; 3]; N], normals: [[f64; 3]; N], material: Material) -> Object {
    let corners = (0..N).map(|i| Corner { point: i, normal: i }).collect();
    Object {
        material,
        points: points.to_vec(),
        normals: normals.to_vec(),
        faces: vec![Face { corners }],
        ..Object::default()
    }
}

/// A triangle that covers every pixel right of the vertical line at x, at the distance w.
fn right_of(x: f64, w: f64) -> [[f64; 3]; 3] {
    [at(x, -40.0, w), at(x, 72.0, w), at(x + 99.0, 16.0, w)]
}

/// The same, showing one colour without any light.
fn plain(points: [[f64; 3]; 3], ambient: [f64; 3]) -> Object {
    face(points, [[0.0, 0.0, 1.0]; 3], Material { ambient, ..BLACK })
}

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const GREEN: [f64; 3] = [0.0, 1.0, 0.0];
const RED_BYTES: [u8; 4] = [255, 0, 0, 255];
const GREEN_BYTES: [u8; 4] = [0, 255, 0, 255];

fn grey(level: u8) -> [u8; 4] {
    [level, level, level, 255]
}

fn scene(shading: Shading, lights: &[Light], objects: Vec<Object>) -> Scene {
    Scene {
        width: SIZE,
        height: SIZE,
        output: "o.png".into(),
        shading,
        eyelight: false,
        model: Model {
            camera: Camera {
                position: [0.0; 3],
                near: 1.0,
                far: 3.0,
                ..Camera::default()
            },
            lights: lights.to_vec(),
            objects,
        },
    }
}

/// What the core would have drawn if it were the reference.
fn as_fixed(scene: &Scene) -> FixedPicture {
    let rendered = draw(scene);
    let winners = rendered.pixels.iter().map(|pixel| pixel.primitive);
    let pixels = rendered.bytes().into_iter().zip(winners);
    FixedPicture {
        width: rendered.width,
        height: rendered.height,
        pixels: pixels.map(|(rgba, primitive)| Pixel { rgba, primitive }).collect(),
        depth: (rendered.pixels.iter())
            .map(|pixel| (65535.0 * (pixel.depth + 1.0) / 2.0).round() as u16)
            .collect(),
    }
}

/// The class of the pixel if the core had drawn it like this, and everything else like the reference.
fn class(scene: &Scene, rgba: [u8; 4], primitive: u32) -> Class {
    let mut fixed = as_fixed(scene);
    fixed.pixels[AT] = Pixel { rgba, primitive };
    let comparison = compare(scene, &fixed, &draw(scene));
    let unexplained = u64::from(comparison.classes[AT] == Class::Unexplained);
    assert_eq!(comparison.unexplained, unexplained);
    comparison.classes[AT]
}

/// The class if the core had left the pixel out.
fn class_if_missing(scene: &Scene) -> Class {
    class(scene, [0; 4], 0)
}

/// The reference's unrounded red at the pixel, in levels.
fn level(scene: &Scene, i: usize) -> f64 {
    255.0 * draw(scene).pixels[i].color[0]
}

mod colour {
    use super::*;

    #[test]
    fn without_light_a_colour_may_be_off_by_its_rounding_only() {
        // Rounding of the material, of the sum, and before the byte is cut off.
        let bound = 2.0 * 255.0 * WORLD_UNIT + WORLD_LEVEL;
        for mode in [Shading::Flat, Shading::Phong] {
            let flat = |level: f64| scene(mode, &[], vec![plain(right_of(-20.0, 2.0), [level / 255.0; 3])]);
            for (off, expected) in [(0.9, Class::Colour), (1.1, Class::Unexplained)] {
                assert_eq!(
                    class(&flat(127.0 + off * bound), grey(126), 1),
                    expected,
                    "{mode:?} {off}"
                );
                assert_eq!(
                    class(&flat(128.0 - off * bound), grey(128), 1),
                    expected,
                    "{mode:?} {off}"
                );
            }
            assert_eq!(class(&flat(127.0 + 0.5 * bound), grey(125), 1), Class::Unexplained);
        }
    }

    #[test]
    fn interpolation_may_lose_a_unit_for_each_column() {
        let flat = |level: f64| {
            let object = plain(right_of(-20.0, 2.0), [level / 255.0; 3]);
            scene(Shading::Gouraud, &[], vec![object])
        };
        // 100 columns, most of them off the picture, and 8 make 108 units of 2⁻³⁰; and 2⁻²⁶ of the values.
        let bound = 255.0 * (27.0 * WORLD_UNIT + 4.0 * WORLD_UNIT) + WORLD_LEVEL;
        assert_eq!(class(&flat(127.0 + 0.5 * bound), grey(126), 1), Class::Colour);
        assert_eq!(class(&flat(127.0 + 1.1 * bound), grey(126), 1), Class::Unexplained);
        assert_eq!(class(&flat(128.0 - 0.5 * bound), grey(128), 1), Class::Colour);
        assert_eq!(class(&flat(128.0 - 1.1 * bound), grey(128), 1), Class::Unexplained);
    }

    /// A light at the eye, on white.
    const EYE: Light = Light {
        location: [0.0; 3],
        color: [1.0; 3],
    };

    /// A normal that has this cosine with the direction to the eye.
    pub fn facing(point: [f64; 3], cosine: f64) -> [f64; 3] {
        let length = point.iter().map(|c| c * c).sum::<f64>().sqrt();
        let [x, y, z] = point.map(|c| -c / length);
        let across = (x * x + z * z).sqrt();
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        [
            cosine * x + sine * z / across,
            cosine * y,
            cosine * z - sine * x / across,
        ]
    }

    /// Gouraud, levels rising by 50 per px, where δ is 0.14 level, with `level` at the pixel. The right corner is at `far`.
    fn rising(level: f64, far: f64) -> Scene {
        let corners = [(8.5, 0.5, 2.0), (8.5, 32.5, 2.0), (12.5, 16.5, far)];
        let points = corners.map(|(x, y, w)| at(x, y, w));
        let cosine = |x: f64| (level + 50.0 * (x - X)) / 255.0;
        let normals = [0, 1, 2].map(|i| facing(points[i], cosine(corners[i].0)));
        let white = Material {
            diffuse: [1.0; 3],
            ..BLACK
        };
        scene(Shading::Gouraud, &[EYE], vec![face(points, normals, white)])
    }

    #[test]
    fn gouraud_may_be_off_by_gradient_times_delta() {
        let moved = 50.0 * SNAP;
        for (off, expected) in [(0.5, Class::Colour), (0.99, Class::Colour), (1.01, Class::Unexplained)] {
            assert_eq!(
                class(&rising(101.0 - off * moved, 2.0), grey(101), 1),
                expected,
                "{off}"
            );
            assert_eq!(class(&rising(100.0 + off * moved, 2.0), grey(99), 1), expected, "{off}");
        }
        assert_eq!(class(&rising(100.01, 2.0), grey(98), 1), Class::Unexplained);
    }

    #[test]
    fn a_polygon_that_the_far_plane_cut_continues_the_plane_of_a_part_of_it() {
        // Of the four corners that are left, three carry the plane: up to 3 δ, and 4 more where a row is moved to end within their range.
        for (off, expected) in [(6.9, Class::Colour), (7.1, Class::Unexplained)] {
            let moved = off * 50.0 * SNAP;
            assert_eq!(class(&rising(101.0 - moved, 4.0), grey(101), 1), expected, "{off}");
        }
    }

    /// Phong: a wall under a light half a unit before it, 4 px beside the pixel, which `level` comes out at.
    fn wall(level: f64) -> Scene {
        let lit = |ambient: f64| {
            let [x, y, _] = at(X + 4.0, 16.5, 2.0);
            let light = Light {
                location: [x, y, -1.5],
                color: [0.5; 3],
            };
            let white = Material {
                ambient: [ambient; 3],
                diffuse: [1.0; 3],
                ..BLACK
            };
            scene(
                Shading::Phong,
                &[light],
                vec![face(right_of(-20.0, 2.0), [[0.0, 0.0, 1.0]; 3], white)],
            )
        };
        lit((level - super::level(&lit(0.0), AT)) / 255.0)
    }

    #[test]
    fn phong_may_be_off_by_gradient_times_delta() {
        let around = wall(140.0);
        let moved = (level(&around, AT + 1) - level(&around, AT - 1)) / 2.0 * SNAP;
        assert!((0.02..0.04).contains(&moved), "{moved}");
        // The bound takes the position's displacement in x and y for one across the direction to the light: √2 and √2 times.
        for (off, expected) in [(0.5, Class::Colour), (0.9, Class::Colour), (2.2, Class::Unexplained)] {
            assert_eq!(class(&wall(141.0 - off * moved), grey(141), 1), expected, "{off}");
            assert_eq!(class(&wall(140.0 + off * moved), grey(139), 1), expected, "{off}");
        }
    }
}

mod edge {
    use super::*;

    #[test]
    fn coverage_may_differ_within_delta_of_an_edge() {
        for mode in MODES {
            let red = |x: f64| scene(mode, &[], vec![plain(right_of(x, 2.0), RED)]);
            for (off, expected) in [(0.5, Class::Edge), (0.99, Class::Edge), (1.01, Class::Unexplained)] {
                assert_eq!(
                    class_if_missing(&red(X - off * SNAP)),
                    expected,
                    "{mode:?} {off} left out"
                );
                let outside = red(X + off * SNAP);
                assert_eq!(class(&outside, RED_BYTES, 1), expected, "{mode:?} {off} drawn");
                assert_eq!(class(&outside, GREEN_BYTES, 1), Class::Unexplained, "of another colour");
            }
        }
    }

    /// A wall that recedes to the right, and passes the far plane at a column.
    fn receding(mode: Shading, column: f64) -> Scene {
        let q = |x: f64| 1.0 / 3.0 - (x - column) * 0.002;
        let corners = [(-20.0, -40.0), (-20.0, 72.0), (79.0, 16.0)];
        let points = corners.map(|(x, y)| at(x, y, 1.0 / q(x)));
        scene(mode, &[], vec![plain(points, RED)])
    }

    /// The same for the near plane: it comes nearer to the left, and ends behind the camera.
    fn approaching(mode: Shading, column: f64) -> Scene {
        // The floor y = -1 is seen at w = 16 / (y - 16) px; turned on its side, x = -1 at w = 16 / (16 - x).
        let x = at(column, 16.0, 1.0)[0];
        let points = [[x, 9.0, 3.0], [x, -9.0, 3.0], [x, 0.0, -9.0]];
        scene(mode, &[], vec![plain(points, RED)])
    }

    #[test]
    fn coverage_may_differ_within_delta_of_a_cut() {
        for mode in MODES {
            for (off, expected) in [(0.5, Class::Edge), (0.99, Class::Edge), (1.01, Class::Unexplained)] {
                let far = |side: f64| receding(mode, X + side * off * SNAP);
                assert_eq!(class_if_missing(&far(1.0)), expected, "{mode:?} {off} far");
                assert_eq!(class(&far(-1.0), RED_BYTES, 1), expected, "{mode:?} {off} far");
                let near = |side: f64| approaching(mode, X + side * off * SNAP);
                assert_eq!(class_if_missing(&near(-1.0)), expected, "{mode:?} {off} near");
                assert_eq!(class(&near(1.0), RED_BYTES, 1), expected, "{mode:?} {off} near");
            }
        }
    }

    #[test]
    fn a_face_turned_away_may_appear_where_it_has_next_to_no_area_only() {
        for mode in MODES {
            let [a, b, c] = right_of(-20.0, 2.0);
            let away = scene(mode, &[], vec![plain([b, a, c], RED)]);
            assert_eq!(class(&away, RED_BYTES, 1), Class::Unexplained, "{mode:?}");
        }
    }
}

mod depth {
    use super::*;

    #[test]
    fn depths_one_step_apart_may_change_places() {
        for mode in MODES {
            let two = |steps: f64| {
                let [red, green] = [0.0, -steps * STEP].map(|z| right_of(-20.0, depth(z)));
                scene(mode, &[], vec![plain(red, RED), plain(green, GREEN)])
            };
            for (steps, expected) in [(0.5, Class::Depth), (1.0, Class::Depth), (1.01, Class::Unexplained)] {
                assert_eq!(class(&two(steps), RED_BYTES, 1), expected, "{mode:?} {steps}");
            }
            assert_eq!(
                class_if_missing(&two(0.5)),
                Class::Unexplained,
                "{mode:?}: neither may vanish"
            );
        }
    }

    #[test]
    fn depths_may_differ_by_gradient_times_delta() {
        // The red one's depth falls by 1/60 per px, 1.5 steps in δ; the green one is that much nearer at the pixel.
        for mode in MODES {
            let two = |off: f64| {
                let z = |x: f64| -(x - X) / 60.0;
                let corners = [(-9.0, -40.0), (-9.0, 72.0), (30.0, 16.0)];
                let red = corners.map(|(x, y)| at(x, y, depth(z(x))));
                let green = right_of(-20.0, depth(-STEP - off * SNAP / 60.0));
                scene(mode, &[], vec![plain(red, RED), plain(green, GREEN)])
            };
            for (off, expected) in [(0.5, Class::Depth), (0.99, Class::Depth), (1.02, Class::Unexplained)] {
                assert_eq!(class(&two(off), RED_BYTES, 1), expected, "{mode:?} {off}");
            }
        }
    }
}

mod pole {
    use super::*;

    /// Seen from so far off the origin that the distance of what lies before the camera is lost in rounding.
    fn lost(mode: Shading, away: f64) -> Scene {
        let points = right_of(-20.0, 2.0).map(|[x, y, z]| [x + away, y, z]);
        let mut scene = scene(mode, &[], vec![plain(points, RED)]);
        scene.model.camera.position = [away, 0.0, 0.0];
        scene
    }

    #[test]
    fn where_w_may_be_0_any_colour_goes_that_varies() {
        let away = f64::from(30).exp2();
        for (mode, expected) in [
            (Shading::Flat, Class::Unexplained),
            (Shading::Gouraud, Class::Pole),
            (Shading::Phong, Class::Pole),
        ] {
            assert_eq!(class(&lost(mode, away), RED_BYTES, 1), Class::Equal);
            assert_eq!(class(&lost(mode, away), grey(7), 1), expected, "{mode:?}");
            assert_eq!(class(&lost(mode, 1024.0), grey(7), 1), Class::Unexplained, "{mode:?}");
            assert_eq!(
                class(&lost(mode, away), RED_BYTES, 2),
                Class::Equal,
                "the picture counts"
            );
            assert_eq!(
                class(&lost(mode, away), grey(7), 2),
                Class::Unexplained,
                "there is no other"
            );
        }
    }
}

mod steep {
    use super::*;

    /// A root of k = n·h, which is so many 2⁻³⁰: eye and light are at a right angle as seen from the surface. The picture is so
    /// small that moving the corners turns next to nothing.
    fn root(mode: Shading, units: f64) -> Scene {
        let small = units / f64::from(1 << 30);
        let side = (0.5f64).sqrt();
        // h = (side, 0, side); the normal is across it, and leans towards it by the small angle.
        let normal = [side * (small - 1.0), 0.0, side * (small + 1.0)];
        let light = Light {
            location: [1e3, 0.0, -2.0],
            color: [1.0; 3],
        };
        let polished = Material {
            specular: [1.0; 3],
            shininess: 0.1,
            ..BLACK
        };
        // Corners 50 px away must be lit the same; but the smaller the window, the less is known of w, which only Phong shading uses.
        let scale = if mode == Shading::Phong { 1e-5 } else { 1e-9 };
        let points = right_of(-20.0, 2.0).map(|[x, y, z]| [x * scale, y * scale, z]);
        // Seen straight from the pixel.
        let [x, y, _] = at(X, 16.5, 2.0).map(|c| c * scale);
        let points = points.map(|[px, py, z]| [px - x, py - y, z]);
        let mut scene = scene(mode, &[light], vec![face(points, [normal; 3], polished)]);
        let camera = &mut scene.model.camera;
        (camera.left, camera.right) = (-scale - x / 2.0, scale - x / 2.0);
        (camera.bottom, camera.top) = (-scale - y / 2.0, scale - y / 2.0);
        scene
    }

    #[test]
    fn a_root_of_next_to_nothing_is_steep() {
        for (mode, known) in [(Shading::Flat, 16.0), (Shading::Gouraud, 16.0), (Shading::Phong, 200.0)] {
            let shown = level(&root(mode, 10.0), AT);
            assert!((20.0..80.0).contains(&shown), "{mode:?}: {shown}");
            assert_eq!(class(&root(mode, 4.0), grey(0), 1), Class::Steep, "{mode:?}");
            assert_eq!(class(&root(mode, known), grey(0), 1), Class::Unexplained, "{mode:?}");
        }
    }
}

mod whole {
    use super::colour::facing;
    use super::*;

    /// A polished hill of a quad and two triangles, its back turned away, and a wall through the far plane.
    fn hill() -> Scene {
        let tip = at(15.2, 14.1, 1.4);
        let foot = [
            at(2.3, 3.1, 2.6),
            at(3.9, 29.4, 2.2),
            at(29.7, 27.3, 2.9),
            at(27.4, 4.8, 2.4),
        ];
        let material = Material {
            ambient: [0.1, 0.05, 0.15],
            diffuse: [0.7, 0.5, 0.3],
            specular: [0.3, 0.4, 0.5],
            shininess: 20.0,
        };
        let mut hill = face(
            [tip, foot[0], foot[1], foot[2], foot[3]],
            [
                [0.1, 0.2, 1.0],
                [-0.6, 0.5, 0.7],
                [-0.5, -0.6, 0.6],
                [0.7, -0.5, 0.8],
                [0.4, 0.7, 0.5],
            ],
            material,
        );
        let triangle = |corners: [usize; 3]| Face {
            corners: corners.map(|i| Corner { point: i, normal: i }).to_vec(),
        };
        hill.faces = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]].map(triangle).to_vec();
        let wall = [
            at(0.3, 31.4, 1.2),
            at(31.5, 31.9, 1.3),
            at(30.2, 1.4, 6.5),
            at(1.7, 0.6, 5.9),
        ];
        let normals = wall.map(|point| facing(point, 0.8));
        let light = |location: [f64; 3], color: [f64; 3]| Light { location, color };
        let lights = [
            light([1.0, 2.0, 0.5], [0.9, 0.8, 0.7]),
            light([-2.0, 0.5, -1.0], [0.3, 0.4, 0.6]),
        ];
        scene(
            Shading::Flat,
            &lights,
            vec![
                hill,
                face(
                    wall,
                    normals,
                    Material {
                        ambient: RED,
                        ..material
                    },
                ),
            ],
        )
    }

    fn of(mode: Shading, change: impl Fn(&mut Scene)) -> Scene {
        let mut scene = hill();
        scene.shading = mode;
        change(&mut scene);
        scene
    }

    /// Pixels that are not equal, and how many of them are unexplained.
    fn judged(mode: Shading, fixed: &FixedPicture) -> (usize, u64) {
        let own = of(mode, |_| {});
        let comparison = compare(&own, fixed, &draw(&own));
        let differing = comparison.classes.iter().filter(|class| **class != Class::Equal);
        (differing.count(), comparison.unexplained)
    }

    #[test]
    fn the_same_picture_is_equal_everywhere() {
        for mode in MODES {
            let fixed = as_fixed(&of(mode, |_| {}));
            assert_eq!(judged(mode, &fixed), (0, 0));
            assert!(fixed.pixels.iter().filter(|pixel| pixel.primitive != 0).count() > 600);
        }
    }

    /// Without lights, which shine on another place then.
    #[test]
    fn corners_moved_by_less_than_delta_are_explained_and_by_more_are_not() {
        for mode in MODES {
            let dark = |by: f64| {
                of(mode, |scene| {
                    scene.model.lights.clear();
                    let points = scene.model.objects.iter_mut().flat_map(|object| &mut object.points);
                    for (i, point) in points.enumerate() {
                        let (sin, cos) = (1.0 + 2.4 * i as f64).sin_cos();
                        let px = -point[2] / 16.0;
                        point[0] += by * cos * px;
                        point[1] += by * sin * px;
                    }
                })
            };
            let moved = |by: f64| compare(&dark(0.0), &as_fixed(&dark(by)), &draw(&dark(0.0)));
            assert_eq!(moved(0.95 * SNAP).unexplained, 0, "{mode:?}");
            let far = moved(100.0 * SNAP);
            assert!(far.unexplained > 20 && far.explained.edge < 5, "{mode:?}: {far:?}");
        }
    }

    #[test]
    fn wrong_pictures_are_unexplained() {
        let wrong: [Wrong; 8] = [
            ("a triangle is missing", |s| {
                s.model.objects[0].faces[1].corners = [0, 0, 0].map(|i| Corner { point: i, normal: i }).to_vec();
            }),
            ("a light moved", |s| s.model.lights[0].location[0] -= 0.3),
            ("a brighter light", |s| s.model.lights[1].color[2] += 0.2),
            ("culling reversed", |s| {
                let faces = s.model.objects.iter_mut().flat_map(|object| &mut object.faces);
                faces.for_each(|face| face.corners.reverse());
            }),
            ("the far plane ignored", |s| s.model.camera.far = 1e6),
            ("the near plane elsewhere", |s| {
                s.model.camera.near *= 1.6;
                for side in [
                    &mut s.model.camera.left,
                    &mut s.model.camera.right,
                    &mut s.model.camera.bottom,
                    &mut s.model.camera.top,
                ] {
                    *side *= 1.6;
                }
            }),
            ("another shininess", |s| s.model.objects[0].material.shininess = 10.0),
            ("mirrored", |s| {
                (s.model.camera.left, s.model.camera.right) = (s.model.camera.right, s.model.camera.left);
            }),
        ];
        for mode in MODES {
            for (what, change) in wrong {
                let fixed = as_fixed(&of(mode, change));
                let (differing, unexplained) = judged(mode, &fixed);
                assert!(differing > 30, "{mode:?}, {what}: {differing}");
                // Some pixels of one colour differ only at edges.
                let most = unexplained as usize * 10 > differing * 9;
                assert!(most, "{mode:?}, {what}: {unexplained} of {differing}");
            }
        }
    }

    #[test]
    fn colours_three_levels_off_are_unexplained() {
        for mode in MODES {
            let mut fixed = as_fixed(&of(mode, |_| {}));
            let mut changed = 0;
            for pixel in fixed.pixels.iter_mut().filter(|pixel| pixel.primitive != 0) {
                pixel.rgba[1] = pixel.rgba[1].checked_sub(3).unwrap_or(3);
                changed += 1;
            }
            assert_eq!(judged(mode, &fixed).1, changed, "{mode:?}");
        }
    }

    #[test]
    fn a_picture_shifted_by_a_pixel_is_unexplained() {
        for mode in MODES {
            let mut fixed = as_fixed(&of(mode, |_| {}));
            fixed.pixels.rotate_right(1);
            let (differing, unexplained) = judged(mode, &fixed);
            assert!(
                unexplained as usize * 10 > differing * 9,
                "{mode:?}: {unexplained} of {differing}"
            );
        }
    }

    /// A wall whose right end is three times as far, dark at the left and bright at the right: in one piece, and in strips, each
    /// linear over the screen, which together are linear in space.
    #[test]
    fn colours_in_perspective_are_unexplained() {
        let light = Light {
            location: [0.0; 3],
            color: [1.0; 3],
        };
        let wall = |strips: u32| {
            let white = Material {
                diffuse: [1.0; 3],
                ..BLACK
            };
            let strip = |i: u32| {
                let ends = [i, i + 1].map(|k| f64::from(k) / f64::from(strips));
                let [left, right] = ends.map(|t| [-0.9 + 3.6 * t, 0.8, -1.0 - 1.9 * t]);
                let low = |[x, y, z]: [f64; 3]| [x, -y, z];
                let points = [left, low(left), low(right), right];
                let normals = [0, 0, 1, 1].map(|k| ends[k]);
                face(points, [0, 1, 2, 3].map(|k| facing(points[k], normals[k])), white)
            };
            scene(Shading::Gouraud, &[light], (0..strips).map(strip).collect())
        };
        let own = wall(1);
        let mut fixed = as_fixed(&wall(64));
        let winners = as_fixed(&own);
        for (pixel, own) in fixed.pixels.iter_mut().zip(&winners.pixels) {
            pixel.primitive = own.primitive;
        }
        let comparison = compare(&own, &fixed, &draw(&own));
        assert!(comparison.pixels_drawn > 400, "{}", comparison.pixels_drawn);
        let share = comparison.unexplained as f64 / comparison.pixels_drawn as f64;
        assert!(share > 0.9, "{share}, {:?}", comparison.explained);
    }
}
