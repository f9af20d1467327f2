//! What a program makes of a fragment's values, on this machine: by the very parts that the fixed back ends are made of.

use std::cell::RefCell;

use fixel::blend::Rgba;
use fixel::light::world::{Glossy, Material, PointLights, PointLit};
use fixel::light::{self, Matte};
use fixel::texture::{Rgba8888, Rounding, Texture};

use super::drawing::{Drawing, Lights, Lit, Paint, Pixels, Program, Sampled, Surface, Units};
use super::replay::blended;
use crate::fixed::dials::Sampling;
use crate::fixed::hw2::lamps::{BULBS, SUNS};
use crate::fixed::hw2::material::{self, Interpolated, Polished, Same, Surface as _, Vector as _};
use crate::fixed::iv::lamps::LIGHTS;
use crate::fixed::iv::shade;
use crate::fixed::mp1::program::{self, Colors, Paint as _};
use crate::fixed::sampling::Sampler;
use crate::picture::Picture;

/// Programs of a drawing.
pub struct Evaluator<'d> {
    drawing: &'d Drawing,
    lights: Vec<Core>,
    /// At the scale that was asked for last: lights, exponent.
    world: RefCell<Option<(usize, i32, Box<PointLit<LIGHTS>>)>>,
}

/// The core's lights.
enum Core {
    Eye(Box<light::Lights<i64, SUNS, BULBS>>),
    World(Box<PointLights<i64, LIGHTS>>),
}

/// A program, ready to run.
pub struct Ready<'a> {
    program: &'a Program,
    pixels: Pixels,
    texture: Option<&'a Picture>,
    eye: Option<&'a light::Lit<'a, BULBS>>,
    world: Option<&'a PointLit<LIGHTS>>,
}

impl<'d> Evaluator<'d> {
    /// For all programs of the drawing.
    pub fn new(drawing: &'d Drawing) -> Self {
        let core = |lights: &Lights| match lights {
            Lights::Eye(lights) => {
                let mut all = Box::<light::Lights<i64, SUNS, BULBS>>::default();
                // As many as there are have been there before.
                for light in lights {
                    let _ = all.add(*light);
                }
                Core::Eye(all)
            }
            Lights::World(eye, lights) => {
                let mut all = Box::new(PointLights::new(*eye));
                for light in lights {
                    let _ = all.add(*light);
                }
                Core::World(all)
            }
        };
        Evaluator {
            drawing,
            lights: drawing.lights.iter().map(core).collect(),
            world: RefCell::new(None),
        }
    }

    /// Calls `run` with the program.
    pub fn ready(&self, program: &Program, run: &mut dyn FnMut(&Ready<'_>)) {
        let mut ready = Ready {
            program,
            pixels: self.drawing.pixels,
            texture: sampled(program).and_then(|s| self.drawing.textures.get(s.texture).map(|t| &**t)),
            eye: None,
            world: None,
        };
        match program {
            Program::Surface { lit: Some(lit), .. } => {
                if let Some(Core::Eye(lights)) = self.lights.get(lit.lights) {
                    let at = lights.at_scale(lit.exponent);
                    ready.eye = Some(&at);
                    run(&Ready {
                        eye: Some(&at),
                        ..ready
                    });
                }
            }
            Program::Phong { lights, exponent, .. } => {
                if let Some(Core::World(all)) = self.lights.get(*lights) {
                    let mut world = self.world.borrow_mut();
                    if world.as_ref().is_some_and(|(l, e, _)| (l, e) != (lights, exponent)) {
                        *world = None;
                    }
                    let fresh = || (*lights, *exponent, Box::new(all.at_scale(*exponent)));
                    let (.., at) = world.get_or_insert_with(fresh);
                    run(&Ready {
                        world: Some(at),
                        ..ready
                    });
                }
            }
            _ => run(&ready),
        }
    }
}

/// The texture of a program.
pub fn sampled(program: &Program) -> Option<Sampled> {
    match program {
        Program::Surface {
            surface: Surface::Textured(sampled) | Surface::Decal(sampled, _),
            ..
        }
        | Program::Paint(Paint::Texels(sampled) | Paint::Decal { sampled, .. }) => Some(*sampled),
        _ => None,
    }
}

impl Ready<'_> {
    /// The new pixel; `part` of it for antialiased lines.
    pub fn shade(&self, values: &[i32], part: Option<i32>, below: Rgba) -> Rgba {
        match self.program {
            Program::Paint(paint) => {
                let color = self.paint(paint, values);
                let color = part.map_or(color, |part| color.faded(part));
                match self.pixels {
                    Pixels::Blended(_) => color.over(below),
                    Pixels::Opaque(units) => widened(blended(units, color)),
                    Pixels::Bytes => color,
                }
            }
            _ => widened(self.bytes(values)),
        }
    }

    /// The colour and alpha of a paint.
    pub fn paint(&self, paint: &Paint, values: &[i32]) -> Rgba {
        let opaque_alpha = |opaque: bool, [r, g, b]: [i32; 3], rest: &[i32]| {
            let alpha = if opaque { fixel::blend::ONE } else { rest[0] };
            [r, g, b, alpha]
        };
        let shift = match self.pixels {
            Pixels::Blended(Units { shift, .. }) | Pixels::Opaque(Units { shift, .. }) => shift,
            Pixels::Bytes => 0,
        };
        match paint {
            Paint::Plain(color) => *color,
            Paint::Colors { headroom, opaque } => {
                let (color, rest) = first(values);
                let colors = Colors { headroom: *headroom };
                colors.color(opaque_alpha(*opaque, color, rest))
            }
            Paint::Texels(sampled) => {
                let (st, _) = first(values);
                self.texels(*sampled, shift, st)
            }
            Paint::Decal {
                sampled,
                headroom,
                opaque,
            } => {
                let (color, rest) = first(values);
                let below = Colors { headroom: *headroom }.color(opaque_alpha(*opaque, color, rest));
                let (st, _) = first(&rest[usize::from(!opaque)..]);
                self.texels(*sampled, shift, st).over(below)
            }
        }
    }

    fn texels(&self, sampled: Sampled, shift: u32, st: [i32; 2]) -> Rgba {
        self.sampler(sampled).map_or(Rgba::default(), |sampler| {
            program::Texels {
                sampler,
                sampled,
                shift,
            }
            .color(st)
        })
    }

    fn sampler<R: Rounding>(&self, sampled: Sampled) -> Option<Sampler<'_, R>> {
        let picture = self.texture?;
        let [width, height] = [picture.width, picture.height].map(|side| u16::try_from(side).unwrap_or(0));
        let texture = Texture::new(Rgba8888, &picture.pixels, width, height).ok()?;
        Some(Sampler::new(texture, sampled.fraction_bits, Sampling::Nearest))
    }

    /// What a program that writes bytes writes.
    pub fn bytes(&self, values: &[i32]) -> [u8; 4] {
        match self.program {
            Program::Flat(bytes) => *bytes,
            Program::Surface { surface, shift, lit } => {
                let (color, rest) = self.surface(surface, values);
                let channels = match (lit, self.eye) {
                    (Some(lit), Some(lights)) => under(lights, lit, color, rest),
                    _ => color.map(i64::from),
                };
                material::pixel(channels, *shift, 0).rgba
            }
            Program::Paint(_) => [0; 4],
            Program::Corners => {
                let (color, _) = first::<3>(values);
                shade::pixel(color.map(|c| c >> shade::FINER), 0).rgba
            }
            Program::Phong { material, shines, .. } => {
                let (place, rest) = first(values);
                let (normal, _) = first(rest);
                let color = self.world.map_or([0; 3], |lights| {
                    let Material {
                        ambient,
                        diffuse,
                        specular: Glossy { .. },
                    } = *material;
                    if *shines {
                        return lights.shade(normal, place, material);
                    }
                    let matte = Material {
                        ambient,
                        diffuse,
                        specular: Matte,
                    };
                    lights.shade(normal, place, &matte)
                });
                shade::pixel(color, 0).rgba
            }
        }
    }

    fn surface<'v>(&self, surface: &Surface, values: &'v [i32]) -> ([i32; 3], &'v [i32]) {
        match surface {
            Surface::Plain(color) => material::Plain(*color).color(values),
            Surface::Gouraud => material::Gouraud.color(values),
            Surface::Textured(sampled) => match self.sampler(*sampled) {
                Some(sampler) => material::Textured(sampler).color(values),
                None => ([0; 3], values),
            },
            Surface::Decal(sampled, shift) => match self.sampler(*sampled) {
                Some(sampler) => material::Decal { sampler, shift: *shift }.color(values),
                None => ([0; 3], values),
            },
        }
    }
}

fn under(lights: &light::Lit<'_, BULBS>, lit: &Lit, color: [i32; 3], rest: &[i32]) -> [i64; 3] {
    let (normal, rest) = match lit.normal {
        Some(normal) => Same(normal).vector(rest),
        None => Interpolated.vector(rest),
    };
    let (place, _) = if lit.places {
        Interpolated.vector(rest)
    } else {
        Same([0; 3]).vector(rest)
    };
    match lit.shiny {
        Some((exponent, highlight)) => lights.shade_wide(normal, place, color, &Polished { exponent, highlight }),
        None => lights.shade_wide(normal, place, color, &Matte),
    }
}

fn first<const N: usize>(values: &[i32]) -> ([i32; N], &[i32]) {
    let (taken, rest) = values.split_first_chunk().unwrap_or((&[0; N], &[]));
    (*taken, rest)
}

fn widened([r, g, b, alpha]: [u8; 4]) -> Rgba {
    Rgba {
        color: [r, g, b].map(i32::from),
        alpha: alpha.into(),
    }
}
