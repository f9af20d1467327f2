//! The scenes of the trade in float64, by definition: every sample asks every triangle.
//!
//! Shares the stored integers with the core and no arithmetic.

use fixel_workloads::tiers::camera::{CORRIDOR, Camera, SPHERE, TORUS};
use fixel_workloads::tiers::canvas::{HEIGHT, WIDTH};
use fixel_workloads::tiers::color::{Levels, MOST};
use fixel_workloads::tiers::geometry::{BRICKS, Mesh, Models, Point, ROOM, SKY};
use fixel_workloads::tiers::lit;
use fixel_workloads::tiers::textured::MAGNIFIED;

use super::plain;

/// Three of anything.
pub type Vector = [f64; 3];

/// What a pixel shows.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    /// Which triangle.
    triangle: usize,
    /// In levels of 255.
    color: Vector,
}

/// How a triangle is coloured; a value for each corner.
enum Paint {
    /// The first corner's colour.
    Flat(Vector),
    /// Linear over the screen.
    Smooth([Vector; 3]),
    /// Linear light, linear over the screen, and encoded there.
    Light([Vector; 3]),
    /// Texels, linear in space.
    Bricks([[f64; 2]; 3]),
    /// Places among texels, linear in space, that are filtered linearly.
    Filtered([[f64; 2]; 3]),
    /// Place in eye space and normal, linear in space.
    Lit([Vector; 3], [Vector; 3]),
}

struct Triangle {
    /// Pixels to the right and downwards.
    at: [[f64; 2]; 3],
    depth: [f64; 3],
    w: [f64; 3],
    paint: Paint,
}

/// A scene.
struct Scene(Vec<Triangle>);

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn unit(v: Vector) -> Vector {
    v.map(|c| c / dot(v, v).sqrt())
}

fn mix<const N: usize>(weights: Vector, values: [[f64; N]; 3]) -> [f64; N] {
    std::array::from_fn(|i| (0..3).map(|corner| weights[corner] * values[corner][i]).sum())
}

fn stored(v: [i16; 3]) -> Vector {
    v.map(|c| f64::from(c) / 32768.0)
}

fn eye(point: &Point, camera: &Camera) -> Vector {
    let [x, y, z] = stored(point.position);
    [x, y, z - f64::from(camera.away)]
}

fn triangle(corners: [Vector; 3], camera: &Camera, paint: Paint) -> Triangle {
    let [left, right, bottom, top, near, far] = camera.frustum.map(|side| f64::from(side) / 8.0);
    // On the screen, −1 to 1.
    let x = |[x, _, z]: Vector| 2.0 * (near * x / -z - left) / (right - left) - 1.0;
    let y = |[_, y, z]: Vector| 2.0 * (near * y / -z - bottom) / (top - bottom) - 1.0;
    Triangle {
        at: corners.map(|c| {
            [
                (x(c) + 1.0) / 2.0 * f64::from(WIDTH),
                (1.0 - y(c)) / 2.0 * f64::from(HEIGHT),
            ]
        }),
        depth: corners.map(|[.., z]| (far + near + 2.0 * far * near / z) / (far - near)),
        w: corners.map(|[.., z]| -z),
        paint,
    }
}

/// In levels of 255.
fn levels(levels: Levels) -> Vector {
    std::array::from_fn(|i| f64::from(levels[i]) / 65536.0 / f64::from(MOST[i]) * 255.0)
}

/// A mesh whose triangles are painted by what their corners are, in eye space, and their normals.
fn mesh(mesh: &Mesh, camera: &Camera, paint: impl Fn([Vector; 3], [Vector; 3]) -> Paint) -> Vec<Triangle> {
    let faces = mesh.triangles.iter().map(|t| t.map(|i| mesh.points[usize::from(i)]));
    faces
        .map(|points| {
            let corners = points.each_ref().map(|point| eye(point, camera));
            triangle(
                corners,
                camera,
                paint(corners, points.map(|point| stored(point.normal))),
            )
        })
        .collect()
}

/// `paint` has the corners' texels.
fn corridor(paint: impl Fn([[f64; 2]; 3]) -> Paint) -> Vec<Triangle> {
    let halves = ROOM.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    halves
        .map(|corners| {
            let texels = corners.map(|corner| corner.texel.map(f64::from));
            let places = corners.map(|corner| corner.position.map(f64::from));
            triangle(places, &CORRIDOR, paint(texels))
        })
        .collect()
}

fn sky() -> Vec<Triangle> {
    let [a, b, c, d] = SKY;
    let half = |corners: [([i32; 3], i32); 3]| {
        let colors = corners.map(|(_, grey)| [f64::from(grey); 3]);
        triangle(
            corners.map(|(place, _)| place.map(f64::from)),
            &CORRIDOR,
            Paint::Smooth(colors),
        )
    };
    vec![half([a, b, c]), half([a, c, d])]
}

/// The sun, diffuse and Blinn-Phong.
fn shade(position: Vector, normal: Vector) -> Vector {
    let [sunlight, surface] = [lit::SUNLIGHT, lit::SURFACE].map(|color| color.map(|c| f64::from(c) / 65536.0));
    let (normal, to_eye, sun) = (unit(normal), unit(position.map(|c| -c)), unit(lit::SUN.map(f64::from)));
    let cosine = dot(normal, sun);
    if cosine <= 0.0 {
        return [0.0; 3];
    }
    let half = unit(std::array::from_fn(|i| sun[i] + to_eye[i]));
    let highlight = dot(normal, half).max(0.0).powf(f64::from(lit::SHININESS) / 65536.0);
    std::array::from_fn(|i| 255.0 * sunlight[i] * (cosine * surface[i] + highlight))
}

/// The level of 255 of linear light of 255.
fn encoded(light: f64) -> f64 {
    let light = light / 255.0;
    255.0
        * if light <= 0.003_130_8 {
            12.92 * light
        } else {
            1.055 * light.powf(1.0 / 2.4) - 0.055
        }
}

/// In levels of 255.
fn brick(i: f64, j: f64) -> Vector {
    let [i, j] = [i, j].map(|c| c.rem_euclid(64.0) as usize);
    let texel = BRICKS[j][i];
    let channels = [texel >> 11, texel >> 5 & 63, texel & 31];
    levels(channels.map(|c| i32::from(c) << 16))
}

impl Scene {
    /// The scene called `name`.
    fn named(name: &str, models: &Models) -> Option<Self> {
        let at_corners = |at: [Vector; 3], normals: [Vector; 3]| std::array::from_fn(|i| shade(at[i], normals[i]));
        Some(Scene(match name {
            "flat" => mesh(&models.torus, &TORUS, |at, normals| {
                Paint::Flat(shade(at[0], normals[0]))
            }),
            "gouraud" => mesh(&models.torus, &TORUS, |at, normals| {
                Paint::Smooth(at_corners(at, normals))
            }),
            "linear light" => mesh(&models.torus, &TORUS, |at, normals| {
                Paint::Light(at_corners(at, normals))
            }),
            "convex" => mesh(&models.sphere, &SPHERE, |at, normals| {
                Paint::Smooth(at_corners(at, normals))
            }),
            "textured" => corridor(Paint::Bricks),
            "filtered" => corridor(Paint::Filtered),
            "sky" | "two levels" => sky(),
            "lit" => mesh(&models.sphere, &SPHERE, Paint::Lit),
            _ => return None,
        }))
    }

    /// What a point of the screen shows, in pixels.
    fn sample(&self, point: [f64; 2]) -> Option<Sample> {
        let depth = |triangle: &Triangle, weights: Vector| dot(weights, triangle.depth);
        let all = self.0.iter().enumerate();
        let there = all.filter_map(|(number, triangle)| Some((number, triangle, triangle.weights(point)?)));
        let nearest = there.min_by(|(_, a, in_a), (_, b, in_b)| depth(a, *in_a).total_cmp(&depth(b, *in_b)));
        nearest.map(|(number, triangle, weights)| Sample {
            triangle: number,
            color: triangle.color(weights),
        })
    }

    /// Every pixel at its middle, and whether everything within `reach` pixels of it shows the same triangle.
    fn picture(&self, reach: f64) -> Picture {
        let pixels = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
        let around = [[-reach, -reach], [-reach, reach], [reach, -reach], [reach, reach]];
        let pixel = |(x, y)| {
            let [x, y] = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let sample = self.sample([x, y]);
            let triangle = |sample: Option<Sample>| sample.map(|sample| sample.triangle);
            let alike = |[dx, dy]: &[f64; 2]| triangle(self.sample([x + dx, y + dy])) == triangle(sample);
            (sample, around.iter().all(alike))
        };
        Picture(pixels.map(pixel).collect())
    }
}

/// A scene's pixels, row by row.
#[derive(Default)]
pub struct Picture(Vec<(Option<Sample>, bool)>);

impl Picture {
    /// What is called `name`. Pixels are sure where everything within `reach` pixels shows the same triangle.
    pub fn named(name: &str, models: &Models, reach: f64) -> Option<Self> {
        let of_colors = |colors: Vec<Vector>| {
            let sample = |color| (Some(Sample { triangle: 0, color }), true);
            Picture(colors.into_iter().map(sample).collect())
        };
        match name {
            "sines" => Some(of_colors(plain::sines())),
            "edges" => Some(of_colors(plain::edges())),
            scene => Some(Scene::named(scene, models)?.picture(reach)),
        }
    }

    /// How many pixels show something.
    pub fn covered(&self) -> usize {
        self.0.iter().filter(|(sample, _)| sample.is_some()).count()
    }

    /// The colours in levels of 255; `None` where nothing is seen, or next to a border of what is.
    pub fn sure(&self) -> impl Iterator<Item = Option<[f64; 3]>> {
        let color = |&(sample, sure): &(Option<Sample>, bool)| sample.filter(|_| sure).map(|sample| sample.color);
        self.0.iter().map(color)
    }
}

impl Triangle {
    /// How much of each corner a point is made of, if it lies inside of one that runs counter-clockwise as seen.
    fn weights(&self, [x, y]: [f64; 2]) -> Option<Vector> {
        let doubled_area = |[a, b, c]: [[f64; 2]; 3]| (c[0] - a[0]) * (b[1] - a[1]) - (b[0] - a[0]) * (c[1] - a[1]);
        let area = doubled_area(self.at);
        let weights = std::array::from_fn(|i| {
            let mut part = self.at;
            part[i] = [x, y];
            doubled_area(part) / area
        });
        (area > 0.0 && weights.iter().all(|&weight| weight >= 0.0)).then_some(weights)
    }

    fn color(&self, weights: Vector) -> Vector {
        // Linear in space: over w, divided.
        let over_w: Vector = std::array::from_fn(|i| weights[i] / self.w[i]);
        let in_space = over_w.map(|weight| weight / over_w.iter().sum::<f64>());
        match &self.paint {
            Paint::Flat(color) => *color,
            Paint::Smooth(colors) => mix(weights, *colors),
            Paint::Light(colors) => mix(weights, *colors).map(encoded),
            Paint::Bricks(texels) => {
                let [i, j] = mix(in_space, *texels).map(f64::floor);
                brick(i, j)
            }
            Paint::Filtered(texels) => {
                let magnified = f64::from(1 << MAGNIFIED);
                let place = mix(in_space, *texels).map(|c| c / magnified - 0.5);
                let [(i, s), (j, t)] = place.map(|c| (c.floor(), c - c.floor()));
                let row = |j: f64| mix([1.0 - s, s, 0.0], [brick(i, j), brick(i + 1.0, j), [0.0; 3]]);
                mix([1.0 - t, t, 0.0], [row(j), row(j + 1.0), [0.0; 3]])
            }
            Paint::Lit(places, normals) => shade(mix(in_space, *places), mix(in_space, *normals)),
        }
    }
}
