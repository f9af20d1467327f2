//! Random scenes through both back ends: no difference may be unexplained, and the classes may not hide a picture.
//!
//! Each kind of scene stresses one thing; the seeds are fixed, so a failure names a scene that can be drawn again;
//! `FIXEL_SEEDS=1000..6000` draws others.

mod random;

use std::sync::Arc;

use fixel_host::backend::{BackEnd, Patch, Surface, Vertex};
use fixel_host::compare::{Class, Comparison, compare};
use fixel_host::fixed::hw2::Fixed;
use fixel_host::picture::Picture;
use fixel_host::reference::hw2::Reference;
use random::{Random, none_unexplained, seeds};

/// A vertex without a normal or a place on a texture.
const BARE: Vertex = Vertex {
    position: [0.0; 4],
    color: [1.0; 3],
    normal: None,
    texcoord: [0.0; 2],
};

const SIZE: u32 = 64;
const SCENES: u64 = 150;
const TRIANGLES: u32 = 12;

impl Random {
    fn color(&mut self, most: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.within(1.0 - most, most))
    }

    fn surface(&mut self) -> Surface {
        if self.one_in(2) {
            Surface::Gouraud
        } else {
            Surface::Flat(self.color(1.0))
        }
    }

    /// A vertex somewhere in a box around the screen.
    fn vertex(&mut self, reach: f64, w: f64) -> Vertex {
        let [x, y] = [0, 1].map(|_| self.within(-reach, reach));
        let z = self.within(-0.1, 1.1);
        Vertex {
            position: [x * w, y * w, z * w, w],
            color: self.color(1.0),
            ..BARE
        }
    }
}

/// Draws the scenes of a kind and compares them. Classes other than *colour* may hold one drawn pixel in `excused`.
fn compared(
    kind: &str,
    excused: u64,
    draw: impl Fn(&mut Random, &mut dyn BackEnd) -> Result<(), String>,
) -> Vec<Comparison> {
    let mut all = Vec::new();
    let mut bad = Vec::new();
    for seed in seeds(kind, SCENES, &[]) {
        let mut fixed = Fixed::new(SIZE, SIZE);
        let mut reference = Reference::new(SIZE, SIZE);
        draw(&mut Random::new(kind, seed), &mut fixed).unwrap();
        draw(&mut Random::new(kind, seed), &mut reference).unwrap();
        let (fixed, reference) = (fixed.finish(), reference.finish());
        let comparison = compare(&fixed, &reference);
        if let Some(at) = comparison.classes.iter().position(|class| *class == Class::Unexplained) {
            let (x, y) = (at as u32 % SIZE, at as u32 / SIZE);
            let (ours, theirs) = (fixed.pixels[at], reference.pixels[at]);
            bad.push(format!(
                "{kind} {seed}: {} pixels, first ({x}, {y}): {ours:?} {theirs:?}",
                comparison.unexplained
            ));
        }
        all.push(comparison);
    }
    let sum = |of: &dyn Fn(&Comparison) -> u64| all.iter().map(of).sum::<u64>();
    let drawn = sum(&|c| c.pixels_drawn);
    let hidden = sum(&|c| {
        let e = c.explained;
        e.edge + e.depth + e.texel + e.pole + e.steep
    });
    println!(
        "{kind}: drawn {drawn}, colour {}, edge {}, depth {}, texel {}, pole {}, steep {}",
        sum(&|c| c.explained.colour),
        sum(&|c| c.explained.edge),
        sum(&|c| c.explained.depth),
        sum(&|c| c.explained.texel),
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

fn triangles(
    random: &mut Random,
    back_end: &mut dyn BackEnd,
    mut corners: impl FnMut(&mut Random) -> [Vertex; 3],
) -> Result<(), String> {
    for number in 1..=TRIANGLES {
        let corners = corners(random);
        let surface = random.surface();
        back_end.triangle(number, corners, surface)?;
    }
    Ok(())
}

#[test]
fn plain() {
    compared("plain", 1000, |random, back_end| {
        triangles(random, back_end, |random| {
            std::array::from_fn(|_| random.vertex(1.3, 1.0))
        })
    });
}

#[test]
fn slivers() {
    compared("slivers", 1000, |random, back_end| {
        let ground = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]];
        let ground = ground.map(|[x, y]| Vertex {
            position: [x, y, 0.9, 1.0],
            color: random.color(1.0),
            ..BARE
        });
        triangles(random, back_end, |random| {
            if random.one_in(8) {
                return ground;
            }
            let (a, mut b) = (random.vertex(1.3, 1.0), random.vertex(1.3, 1.0));
            let mut c = b;
            let width = 10f64.powf(random.within(-5.0, -1.0));
            for i in 0..2 {
                c.position[i] += random.within(-width, width);
                b.position[i] += random.within(-width, width);
            }
            c.color = random.color(1.0);
            [a, b, c]
        })
    });
}

#[test]
fn almost_the_same_depth() {
    let all = compared("almost_the_same_depth", 8, |random, back_end| {
        let [z, dx, dy] = [0.5, random.within(-0.2, 0.2), random.within(-0.2, 0.2)];
        triangles(random, back_end, |random| {
            let off = 3.0 / 65535.0;
            std::array::from_fn(|_| {
                let mut vertex = random.vertex(1.3, 1.0);
                let [x, y, ..] = vertex.position;
                vertex.position[2] = z + dx * x + dy * y + random.within(-off, off);
                vertex
            })
        })
    });
    assert!(all.iter().map(|c| c.explained.depth).sum::<u64>() > 0);
}

#[test]
fn perspective() {
    compared("perspective", 1000, |random, back_end| {
        triangles(random, back_end, |random| {
            std::array::from_fn(|_| {
                let w = 10f64.powf(random.within(-1.0, 1.0));
                random.vertex(1.3, w)
            })
        })
    });
}

#[test]
fn bright_colours() {
    compared("bright_colours", 1000, |random, back_end| {
        triangles(random, back_end, |random| {
            let most = 10f64.powf(random.within(0.0, 3.0));
            std::array::from_fn(|_| {
                let w = random.within(0.5, 2.0);
                Vertex {
                    color: random.color(most),
                    ..random.vertex(1.3, w)
                }
            })
        })
    });
}

#[test]
fn enormous() {
    compared("enormous", 1000, |random, back_end| {
        triangles(random, back_end, |random| {
            std::array::from_fn(|_| {
                let far = random.one_in(2);
                let reach = if far { 10f64.powf(random.within(0.0, 8.0)) } else { 1.3 };
                random.vertex(reach, 1.0)
            })
        })
    });
}

#[test]
fn signs_of_w_mixed() {
    compared("signs_of_w_mixed", 1000, |random, back_end| {
        triangles(random, back_end, |random| {
            std::array::from_fn(|_| {
                let w = random.within(0.3, 3.0);
                let w = if random.one_in(2) { -w } else { w };
                random.vertex(1.3, w)
            })
        })
    });
}

#[test]
fn cameras_and_clip_planes() {
    compared("cameras_and_clip_planes", 1000, |random, back_end| {
        back_end.frustum([-1.0, 1.0, -1.0, 1.0, 0.5, random.within(5.0, 50.0)])?;
        // What is behind the eye is cut off; two more planes come with the turned directions.
        back_end.clip_plane([0.0, 0.0, -1.0, -0.1])?;
        back_end.translate([0.0, 0.0, -3.0])?;
        for _ in 0..3 {
            let axis = std::array::from_fn(|_| random.within(-1.0, 1.0));
            back_end.rotate(random.within(-400.0, 400.0), axis)?;
            back_end.scale(std::array::from_fn(|_| random.within(0.7, 1.4)))?;
        }
        for distance in [2.5, 3.2] {
            let [a, b, c] = std::array::from_fn(|_| random.within(-1.0, 1.0));
            back_end.clip_plane([a, b, c, distance])?;
        }
        triangles(random, back_end, |random| {
            std::array::from_fn(|_| {
                let [x, y, z] = std::array::from_fn(|_| random.within(-2.0, 2.0));
                Vertex {
                    position: [x, y, z, 1.0],
                    color: random.color(1.0),
                    ..BARE
                }
            })
        })
    });
}

/// hw2.md, section 5: what the planes leave is drawn as a fan from its first vertex, which matters where w has both signs.
#[test]
fn signs_of_w_mixed_and_clip_planes() {
    compared("signs_of_w_mixed_and_clip_planes", 1000, |random, back_end| {
        for _ in 0..2 {
            let [a, b, c] = std::array::from_fn(|_| random.within(-1.0, 1.0));
            back_end.clip_plane([a, b, c, random.within(-0.5, 0.5)])?;
        }
        triangles(random, back_end, |random| {
            std::array::from_fn(|_| {
                let w = random.within(0.3, 3.0);
                let w = if random.one_in(2) { -w } else { w };
                random.vertex(1.3, w)
            })
        })
    });
}

#[test]
fn meshes_of_shared_edges() {
    compared("meshes_of_shared_edges", 1000, |random, back_end| {
        let grid: Vec<Vertex> = (0..16)
            .map(|i| {
                let [x, y] = [i % 4, i / 4].map(|k| f64::from(k) * 0.6 - 0.9 + random.within(-0.2, 0.2));
                let w = random.within(0.5, 2.0);
                Vertex {
                    position: [x * w, y * w, random.within(0.2, 0.8) * w, w],
                    color: random.color(1.0),
                    ..BARE
                }
            })
            .collect();
        let mut number = 0;
        for cell in (0..12).filter(|cell| cell % 4 != 3) {
            for corners in [[cell, cell + 1, cell + 4], [cell + 5, cell + 4, cell + 1]] {
                number += 1;
                back_end.triangle(number, corners.map(|i| grid[i]), Surface::Gouraud)?;
            }
        }
        Ok(())
    });
}

/// A texture of random texels, alpha included.
fn texture(random: &mut Random) -> Arc<Picture> {
    let (width, height) = [(8, 8), (7, 5), (1, 1), (64, 3)][(random.unit() * 4.0) as usize];
    let texel = |random: &mut Random| std::array::from_fn(|_| (random.unit() * 256.0) as u8);
    let texels = (0..width * height).map(|_| texel(random)).collect();
    Arc::new(Picture::new(width, height, texels))
}

/// Lights, some bright or negative, highlights, textures, decals.
fn furnish(random: &mut Random, back_end: &mut dyn BackEnd) -> Result<(), String> {
    back_end.texture(&texture(random))?;
    if random.one_in(3) {
        back_end.decals();
    }
    if random.one_in(4) {
        back_end.flat_normals();
    }
    if random.one_in(2) {
        back_end.shininess(10f64.powf(random.within(-1.0, 2.4)))?;
    }
    for _ in 0..3 {
        let [x, y, z] = [0; 3].map(|_| random.within(-1.5, 1.5));
        let color = random.color(1.6);
        match (random.unit() * 3.0) as u32 {
            0 => back_end.sun([x, y, z], color)?,
            1 => back_end.bulb([x, y, z, 1.0], color)?,
            _ => {}
        }
    }
    Ok(())
}

/// A vertex that has everything, or no normal.
fn rich(random: &mut Random, w: f64) -> Vertex {
    let normal = [0; 3].map(|_| random.within(-1.5, 1.5));
    Vertex {
        normal: (!random.one_in(5)).then_some(normal),
        texcoord: [0; 2].map(|_| random.within(-3.0, 3.0)),
        ..random.vertex(1.3, w)
    }
}

/// Draws triangles and patches of every surface; `w` gives each vertex its own.
fn furnished(random: &mut Random, back_end: &mut dyn BackEnd, w: impl Fn(&mut Random) -> f64) -> Result<(), String> {
    furnish(random, back_end)?;
    let vertex = |random: &mut Random| {
        let w = w(random);
        rich(random, w)
    };
    let mut number = 1;
    for _ in 0..TRIANGLES {
        let corners = std::array::from_fn(|_| vertex(random));
        let surface = if random.one_in(2) {
            Surface::Textured
        } else {
            random.surface()
        };
        back_end.triangle(number, corners, surface)?;
        number += 1;
    }
    let level = 1 + (random.unit() * 3.0) as u32;
    let (four_rows, three_sides) = (
        std::array::from_fn(|_| vertex(random)),
        std::array::from_fn(|_| vertex(random)),
    );
    let patch = if random.one_in(2) {
        Patch::Rectangular(&four_rows)
    } else {
        Patch::Triangular(&three_sides)
    };
    let surface = random.surface();
    back_end.patch(number, level, patch, surface)
}

#[test]
fn lights_textures_and_patches() {
    compared("lights_textures_and_patches", 1000, |random, back_end| {
        furnished(random, back_end, |_| 1.0)
    });
}

#[test]
fn lights_textures_and_patches_in_perspective() {
    compared(
        "lights_textures_and_patches_in_perspective",
        1000,
        |random, back_end| furnished(random, back_end, |random| random.within(0.2, 2.0)),
    );
}
