//! Lighting as a program of the user's: chapter 09.

mod course;

use course::{all_near, block, buffer, floats, near, picture, pixel, reals, rgba, state};
use fixel::blend::{ONE, Rgba};
use fixel::depth::NoDepth;
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Angle, Block, SineTable, dot, power};
use fixel::pipeline::{self, HeadRoom, Picture, Pixel, Program, Sampler, Varyings};

/// What the fragments of a lit surface get: uv in units of 2^-16, position and normal in view space in units of 2^-16.
struct Lit {
    uv: [i32; 2],
    position: [i32; 3],
    normal: [i32; 3],
}

impl Varyings for Lit {
    type Values = [i32; 8];
    fn pack(&self) -> [i32; 8] {
        let ([u, v], [x, y, z], [a, b, c]) = (self.uv, self.position, self.normal);
        [u, v, x, y, z, a, b, c]
    }
    fn unpack([u, v, x, y, z, a, b, c]: [i32; 8]) -> Self {
        Lit {
            uv: [u, v],
            position: [x, y, z],
            normal: [a, b, c],
        }
    }
}

/// Colours are straight fractions in units of 2^-28.
struct Material<'a> {
    color: Rgba,
    specular: i32,
    shininess: u32,
    texture: Option<Sampler<Picture<'a, HeadRoom>>>,
}

impl Default for Material<'_> {
    fn default() -> Self {
        Material {
            color: rgba([1.0; 4]),
            specular: ONE,
            shininess: 16,
            texture: None,
        }
    }
}

/// Point lights in view space, and their colours.
struct Phong<'a> {
    lights: &'a [([i32; 3], Rgba)],
    material: Material<'a>,
}

fn times(a: i32, b: i32) -> i32 {
    ((i64::from(a) * i64::from(b) + (1 << 27)) >> 28) as i32
}

fn three(f: impl Fn(usize) -> i32) -> [i32; 3] {
    [f(0), f(1), f(2)]
}

impl Phong<'_> {
    fn diffuse(&self, uv: [i32; 2]) -> Rgba {
        let color = self.material.color;
        match &self.material.texture {
            None => color,
            Some(texture) => {
                let texel = texture.sample(uv);
                let channels = three(|i| times(color.color[i], texel.color[i]));
                Rgba {
                    color: channels,
                    alpha: times(color.alpha, texel.alpha),
                }
            }
        }
    }
}

impl Program for Phong<'_> {
    type Vertex = ([i32; 4], Block<i32, 3>, Block<i32, 3>, [i32; 2]);
    type Varying = Lit;
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, &(corner, position, normal, uv): &Self::Vertex) -> (Block<i32, 4>, Lit) {
        let fixed = |v: Block<i32, 3>| v.split().map(|c| c.to_fixed(16) as i32);
        (
            Block::from_integers(corner),
            Lit {
                uv,
                position: fixed(position),
                normal: fixed(normal),
            },
        )
    }

    fn fragment(&self, _: Pixel, Lit { uv, position, normal }: Lit) -> Option<Rgba> {
        let diffuse = self.diffuse(uv);
        let n = fixel::num::unit(normal)?;
        let v = fixel::num::unit(position.map(|c| -c))?;
        let mut sum = [0; 3];
        for &(light, brightness) in self.lights {
            let l = fixel::num::unit(three(|i| light[i] - position[i]))?;
            let cosine = (dot(l, n) >> 30) as i32;
            if cosine <= 0 {
                continue;
            }
            // 2 (L·n) n − L, in units of 2^-30.
            let r = three(|i| (((i64::from(cosine) * i64::from(n[i])) >> 29) - i64::from(l[i])) as i32);
            let highlight = power(((dot(r, v) >> 30) as i32).max(0), self.material.shininess << 16) >> 2;
            let channels = diffuse.color.into_iter().zip(brightness.color);
            for (sum, (surface, light)) in sum.iter_mut().zip(channels) {
                let lit = times(surface, cosine >> 2) + times(self.material.specular, highlight);
                *sum += times(lit, light);
            }
        }
        Some(Rgba {
            color: sum,
            alpha: diffuse.alpha,
        })
    }
}

/// The middle of a square that has this position and normal everywhere.
fn lit(position: [f64; 3], normal: [f64; 3], program: &Phong) -> [f64; 4] {
    let corner = |x, y| ([x, y, 0, 1], block(position), block(normal), [1 << 15; 2]);
    let square = [corner(-1, -1), corner(1, -1), corner(1, 1)];
    let mut pixels = picture(Rgba::default());
    pipeline::triangles(&state(), &mut buffer(&mut pixels), &mut NoDepth, program, &square);
    reals(pixel(&pixels, 200, 100))
}

fn lamp(position: [f64; 3], color: [f64; 3]) -> ([i32; 3], Rgba) {
    let [r, g, b] = color;
    (position.map(|v| (v * 65536.0).round() as i32), rgba([r, g, b, 1.0]))
}

/// A user's program gets uv, position and normal in view space. Normals go through the inverse transpose.
#[test]
fn item_09_1_normals_stay_at_right_angles() {
    let view = Matrix::<i32>::look_at(block([-2.5, 1.0, 0.0]), block([0.0; 3]), block([0.0, 1.0, 0.0])).unwrap();
    let turn = Matrix::rotation::<SineTable>(Angle::from_degrees(37), block([1.0, 2.0, 0.5])).unwrap();
    let model = Matrix::model(block([0.5, 2.0, 1.0]), &turn, block([1.0, 4.0, 1.0]));
    let both = view.product(&model);
    let mut directions = Directions::identity();
    directions.load(&both);
    // A plane with normal (1, 1, 0), scaled along y, and two edges in it.
    let normal = floats(directions.turn(block([1.0, 1.0, 0.0])));
    let mut wrong = 0.0;
    for edge in [[1.0, -1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] {
        let [x, y, z, _] = floats(both.transform(block(edge)));
        near(normal[0] * x + normal[1] * y + normal[2] * z, 0.0, 1e-6);
        let [a, b, c, _] = floats(both.transform(block([1.0, 1.0, 0.0, 0.0])));
        wrong += (a * x + b * y + c * z).abs();
    }
    assert!(wrong > 1.0, "the matrix itself does not do");
}

#[test]
fn item_09_2_phong_with_point_lights() {
    let lights = [lamp([0.0; 3], [0.5; 3])];
    let material = Material {
        color: rgba([0.8, 0.6, 0.4, 1.0]),
        ..Material::default()
    };
    let got = lit(
        [0.0, 0.0, -2.0],
        [0.0, 0.0, 1.0],
        &Phong {
            lights: &lights,
            material,
        },
    );
    all_near(got, [0.9, 0.8, 0.7, 1.0], 1e-5);
    let lights = [lamp([0.0, 2.0, -1.0], [1.0; 3])];
    let material = || Material {
        color: rgba([0.8, 0.8, 0.8, 1.0]),
        ..Material::default()
    };
    let got = lit(
        [0.0, 0.0, -3.0],
        [0.0, 0.6, 0.8],
        &Phong {
            lights: &lights,
            material: material(),
        },
    );
    all_near(got, [0.914001, 0.914001, 0.914001, 1.0], 1e-5);
    // A normal of another length is made 1; two lights add up; one from behind adds nothing.
    let got = lit(
        [0.0, 0.0, -3.0],
        [0.0, 3.0, 4.0],
        &Phong {
            lights: &lights,
            material: material(),
        },
    );
    all_near(got, [0.914001, 0.914001, 0.914001, 1.0], 1e-5);
    let more = [lights[0], lights[0], lamp([0.0, -9.0, -9.0], [1.0; 3])];
    let got = lit(
        [0.0, 0.0, -3.0],
        [0.0, 0.6, 0.8],
        &Phong {
            lights: &more,
            material: material(),
        },
    );
    all_near(got, [1.828002, 1.828002, 1.828002, 1.0], 2e-5);
}

#[test]
fn item_09_3_texture_times_material() {
    let texels = [rgba([0.5, 0.25, 1.0, 0.5])];
    let texture = Sampler::new(Picture::new(HeadRoom, &texels, 1, 1).unwrap(), 16);
    let defaults = Material::default();
    assert_eq!(
        (defaults.color, defaults.specular, defaults.shininess),
        (rgba([1.0; 4]), ONE, 16)
    );
    let material = Material {
        color: rgba([1.0, 1.0, 0.5, 0.8]),
        texture: Some(texture),
        specular: 0,
        ..defaults
    };
    let lights = [lamp([0.0; 3], [1.0; 3])];
    let got = lit(
        [0.0, 0.0, -2.0],
        [0.0, 0.0, 1.0],
        &Phong {
            lights: &lights,
            material,
        },
    );
    all_near(got, [0.5, 0.25, 0.5, 0.4], 1e-6);
}

/// A light in the world and the light of the test above in view space are one.
#[test]
fn item_09_4_lights_are_turned_into_view_space_once() {
    // The camera at (3, 0, 0), looking along −x.
    let view = Matrix::<i32>::look_at(block([3.0, 0.0, 0.0]), block([0.0; 3]), block([0.0, 1.0, 0.0])).unwrap();
    // (x, y, z) of view space is (3 + z, y, −x) in the world.
    let world = block([2.0, 2.0, 0.0, 1.0]);
    let [x, y, z, w] = floats(view.transform(world));
    all_near([x, y, z, w], [0.0, 2.0, -1.0, 1.0], 1e-6);
    let lights = [lamp([x, y, z], [1.0; 3])];
    let material = Material {
        color: rgba([0.8, 0.8, 0.8, 1.0]),
        ..Material::default()
    };
    let got = lit(
        [0.0, 0.0, -3.0],
        [0.0, 0.6, 0.8],
        &Phong {
            lights: &lights,
            material,
        },
    );
    all_near(got, [0.914001, 0.914001, 0.914001, 1.0], 1e-5);
}
