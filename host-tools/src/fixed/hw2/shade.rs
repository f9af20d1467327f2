//! Picks the fragment program for a triangle: the one that carries no more than it needs.

use std::sync::Arc;

use fixel::fragment::Flat;
use fixel::num::Word;
use fixel::texture::{Rgba8888, Texture};

use super::canvas::Canvas;
use super::corner::{self, Corner};
use super::lamps::{AtScale, Lamps, Lit};
use super::material::{
    Decal, Gouraud, InGivenLight, Interpolated, Plain, Polished, Same, Sampler, Surface, Textured, UnderLight, Unlit,
    Vector, pixel,
};
use crate::emit::drawing::{self, Lights, Program, Sampled};
use crate::emit::log::Log;
use crate::fixed::dials::{Lighting, Perspective, Sampling};
use crate::fixed::shader::{Canvas as _, Shader};
use crate::fixed::{Pixel, texcoord};
use crate::picture::Picture;

/// A triangle's surface.
#[derive(Clone, Copy)]
pub enum Paint<'t> {
    /// One colour.
    Plain([i32; 3]),
    /// The corners' colours.
    Gouraud,
    /// A texture.
    Textured(Texture<'t, Rgba8888>),
    /// A texture over the corners' colours.
    Decal(Texture<'t, Rgba8888>),
}

/// How triangles look, apart from their corners.
#[derive(Clone, Copy)]
pub struct Look<'a> {
    /// The surface.
    pub paint: Paint<'a>,
    /// Colours are in units of 2^(shift − 16) levels.
    pub shift: i32,
    /// Whether the triangle's own perpendicular is its normal, whatever its corners have.
    pub flat_normal: bool,
    /// Units of 2^-16; `None` without highlights.
    pub shininess: Option<u32>,
    /// The texture of the moment.
    pub picture: Option<&'a Arc<Picture>>,
}

/// A triangle in work.
struct Work<'a, W> {
    canvas: &'a mut Canvas<W>,
    look: Look<'a>,
    corners: &'a [Corner; 3],
    primitive: u32,
    /// `None` for a surface in its own colours.
    light: Option<Light<'a>>,
}

/// Bits that are left free above what the corners carry where w has both signs: values then leave the corners' range, and
/// beyond 2^31 they saturate, each by itself, which turns directions. A normal or a texel is right up to 2^11 of the range.
const HEADROOM: u32 = 10;

/// Bits that values are coarser by where values in perspective may be wrong by a certain number of units: by half a level of a lit colour, by
/// 2^-9 of a normal.
const SPANS_HEADROOM: u32 = 6;

/// What light needs to know of a triangle.
#[derive(Clone, Copy)]
struct Light<'a> {
    lit: &'a Lit<'a>,
    lamps: &'a Lamps,
    /// Of the unit of places.
    exponent: i32,
    /// `None` to interpolate the corners'.
    flat_normal: Option<[i32; 3]>,
    /// The corners', at the scale of `lit`.
    places: [[i32; 3]; 3],
}

impl<'a> Light<'a> {
    fn new(lights: &'a mut AtScale<'_>, flat_normal: bool, corners: &[Corner; 3], headroom: u32) -> Option<Self> {
        let lamps = lights.lamps();
        if lamps.is_empty() {
            return None;
        }
        let places = corners.map(|c| corner::place(c.eye));
        let own = flat_normal || corners.iter().any(|c| c.normal.is_none());
        let flat_normal = own.then(|| corner::perpendicular(places));
        let (places, exponent) = corner::in_own_unit(places, headroom);
        Some(Light {
            lit: lights.lit(exponent),
            lamps,
            exponent,
            flat_normal,
            places,
        })
    }
}

/// What corners may carry of their light: 2^10 times as much is left for what lies outside their range where w has both signs.
const LIGHT_BITS: u32 = 30 - HEADROOM;

impl Light<'_> {
    /// What is lit at the corners, in a unit 2^down times as large, and down.
    fn at_corners(
        &self,
        corners: &[Corner; 3],
        surface: [[i32; 3]; 3],
        polish: Option<&Polished>,
    ) -> ([[i32; 3]; 3], i32) {
        let lit: [_; 3] = std::array::from_fn(|i| {
            let normal = self.flat_normal.or(corners[i].normal).unwrap_or_default();
            self.lit.shade(normal, self.places[i], surface[i], polish)
        });
        let all_bits = lit.as_flattened().iter().fold(0, |bits, c| bits | c.unsigned_abs());
        let down = (u64::BITS - all_bits.leading_zeros()).saturating_sub(LIGHT_BITS);
        (lit.map(|color| color.map(|c| (c >> down) as i32)), down as i32)
    }
}

/// Draws one triangle.
///
/// # Errors
/// Where its texture coordinates do not fit.
pub fn triangle<W: Word>(
    canvas: &mut Canvas<W>,
    look: Look<'_>,
    lights: &mut AtScale<'_>,
    corners: &[Corner; 3],
    primitive: u32,
) -> Result<(), String> {
    let in_spans = canvas.dials.perspective == Perspective::Spans;
    let sampling = canvas.dials.sampling;
    let headroom = match (canvas.divides_by_both_signs(corners.map(|c| c.eye)), in_spans) {
        (true, _) => HEADROOM,
        (false, true) => SPANS_HEADROOM,
        (false, false) => 0,
    };
    let most_bits = if in_spans { texcoord::IN_SPANS } else { texcoord::FINE };
    // Colours that are not lit saturate beyond 64 times full, and full is where their bytes end.
    let interpolated = matches!(look.paint, Paint::Gouraud | Paint::Decal(_));
    let lit = interpolated && !lights.lamps().is_empty();
    let corners = &corners.map(|c| c.with_headroom(if lit { headroom } else { 0 }, headroom));
    let look = Look {
        shift: look.shift + if lit { headroom as i32 } else { 0 },
        ..look
    };
    let mut work = Work {
        canvas,
        look,
        corners,
        primitive,
        light: Light::new(lights, look.flat_normal, corners, headroom),
    };
    if work.canvas.dials.lighting == Lighting::Vertex
        && let Some(light) = work.light
    {
        return work.lit_at_corners(light, headroom);
    }
    let colors = corners.map(|c| c.color);
    match look.paint {
        Paint::Plain(color) => work.plain(color),
        Paint::Gouraud => {
            work.describe(|_| drawing::Surface::Gouraud);
            work.surface::<_, 3, 6, 9>(Gouraud, colors);
        }
        Paint::Textured(texture) => {
            let (st, sampler, fraction_bits) = sampler(texture, corners, headroom, most_bits, sampling)?;
            work.describe(|log| drawing::Surface::Textured(look.sampled(log, fraction_bits)));
            work.surface::<_, 2, 5, 8>(Textured(sampler), st);
        }
        Paint::Decal(texture) => {
            let (st, sampler, fraction_bits) = sampler(texture, corners, headroom, most_bits, sampling)?;
            let shift = look.shift.unsigned_abs();
            work.describe(|log| drawing::Surface::Decal(look.sampled(log, fraction_bits), shift));
            work.surface::<_, 5, 8, 11>(Decal { sampler, shift }, side_by_side(colors, st));
        }
    }
    Ok(())
}

/// The corners' coordinates in texels, and what looks them up.
fn sampler<'t>(
    texture: Texture<'t, Rgba8888>,
    corners: &[Corner; 3],
    headroom: u32,
    most_bits: i32,
    sampling: Sampling,
) -> Result<([[i32; 2]; 3], Sampler<'t>, u32), String> {
    let (st, fraction_bits) = texcoord::texels(
        corners.map(|corner| corner.texcoord),
        [texture.width(), texture.height()],
        headroom,
        most_bits,
        texcoord::Rounding::Down,
    )?;
    Ok((st, Sampler::new(texture, fraction_bits, sampling), fraction_bits))
}

impl Look<'_> {
    /// Of the surface's colours.
    fn polish(&self) -> Option<Polished> {
        self.shininess.map(|exponent| Polished::new(exponent, self.shift))
    }

    fn sampled(&self, log: &mut Log, fraction_bits: u32) -> Sampled {
        Sampled {
            texture: self.picture.map_or(0, |picture| log.texture(picture)),
            fraction_bits,
        }
    }
}

impl<W: Word> Work<'_, W> {
    /// Tells the log.
    fn describe(&mut self, surface: impl FnOnce(&mut Log) -> drawing::Surface) {
        let Work {
            canvas, look, light, ..
        } = self;
        canvas.describe(|log| {
            let lit = light.map(|light| drawing::Lit {
                lights: log.lights(Lights::Eye(light.lamps.all())),
                exponent: light.exponent,
                normal: light.flat_normal,
                places: look.shininess.is_some() || light.lamps.has_bulbs(),
                shiny: look.polish().map(|polished| (polished.exponent, polished.highlight)),
            });
            let lights_shift = light.map_or(0, |light| light.lamps.shift());
            Program::Surface {
                surface: surface(log),
                shift: look.shift.saturating_add(lights_shift),
                lit,
            }
        });
    }

    /// One colour. Unlit, or lit by suns only and flat, it is the same everywhere.
    fn plain(mut self, color: [i32; 3]) {
        self.describe(|_| drawing::Surface::Plain(color));
        match self.light {
            Some(light) => self.lit::<_, 0, 3, 6>(light, Plain(color), [[]; 3]),
            None => {
                let pixel = pixel(color.map(i64::from), self.look.shift, self.primitive);
                self.flat(pixel);
            }
        }
    }

    fn flat(self, pixel: Pixel) {
        self.canvas.describe(|_| Program::Flat(pixel.rgba));
        self.canvas.draw(self.corners.map(|c| c.eye), [(); 3], &Flat(pixel));
    }

    /// Light computed at the corners.
    fn lit_at_corners(self, light: Light<'_>, headroom: u32) -> Result<(), String> {
        let colors = self.corners.map(|c| c.color);
        let sampling = self.canvas.dials.sampling;
        match self.look.paint {
            Paint::Plain(color) => self.lit_colors(light, [color; 3]),
            Paint::Gouraud => self.lit_colors(light, colors),
            Paint::Textured(texture) => {
                let (st, sampler, _) = sampler(texture, self.corners, headroom, texcoord::FINE, sampling)?;
                self.in_given_light::<_, 2, 5>(light, Textured(sampler), st);
            }
            Paint::Decal(texture) => {
                let (st, sampler, _) = sampler(texture, self.corners, headroom, texcoord::FINE, sampling)?;
                let shift = self.look.shift.unsigned_abs();
                self.in_given_light::<_, 5, 8>(light, Decal { sampler, shift }, side_by_side(colors, st));
            }
        }
        Ok(())
    }

    /// The corners' colours are lit.
    fn lit_colors(self, light: Light<'_>, colors: [[i32; 3]; 3]) {
        let polish = self.look.polish();
        let (colors, down) = light.at_corners(self.corners, colors, polish.as_ref());
        let program = Unlit {
            surface: Gouraud,
            shift: self.look.shift.saturating_add(light.lamps.shift()) + down,
            primitive: self.primitive,
        };
        self.draw(colors, &program);
    }

    /// A surface whose corners carry A values, in the light at the corners; B are 3 more.
    fn in_given_light<S: Surface, const A: usize, const B: usize>(
        self,
        light: Light<'_>,
        surface: S,
        carried: [[i32; A]; 3],
    ) {
        let full = [[1 << 16; 3]; 3];
        let polish = self.look.shininess.map(Polished::white);
        let (lights, down) = light.at_corners(self.corners, full, polish.as_ref());
        let program = InGivenLight {
            surface,
            shift: self.look.shift.saturating_add(light.lamps.shift()) + down,
            primitive: self.primitive,
        };
        let values = std::array::from_fn(|i| joined([&carried[i], &lights[i], &[]]));
        self.draw::<_, B>(values, &program);
    }

    /// A surface whose corners carry A values; B are 3 more, C are 6 more.
    fn surface<S: Surface, const A: usize, const B: usize, const C: usize>(self, surface: S, carried: [[i32; A]; 3]) {
        if let Some(light) = self.light {
            return self.lit::<S, A, B, C>(light, surface, carried);
        }
        let program = Unlit {
            surface,
            shift: self.look.shift,
            primitive: self.primitive,
        };
        self.draw(carried, &program);
    }

    /// The same under lights.
    fn lit<S, const A: usize, const B: usize, const C: usize>(
        self,
        light: Light<'_>,
        surface: S,
        carried: [[i32; A]; 3],
    ) where
        S: Surface,
    {
        let (here, nowhere) = (Interpolated, Same([0; 3]));
        let in_place = self.look.shininess.is_some() || light.lamps.has_bulbs();
        match (light.flat_normal.map(Same), in_place) {
            (Some(own), true) => self.run::<_, _, _, A, B>(light, carried, surface, own, here),
            (None, true) => self.run::<_, _, _, A, C>(light, carried, surface, Interpolated, here),
            (Some(own), false) => self.run::<_, _, _, A, A>(light, carried, surface, own, nowhere),
            (None, false) => self.run::<_, _, _, A, B>(light, carried, surface, Interpolated, nowhere),
        }
    }

    /// Draws with one program: the corners carry the surface's A values and what else the program takes, K in all.
    fn run<S, N, P, const A: usize, const K: usize>(
        self,
        light: Light<'_>,
        carried: [[i32; A]; 3],
        surface: S,
        normal: N,
        place: P,
    ) where
        S: Surface,
        N: Vector,
        P: Vector,
    {
        let program = UnderLight {
            surface,
            normal,
            place,
            polish: self.look.polish(),
            lit: light.lit,
            shift: self.look.shift.saturating_add(light.lamps.shift()),
            primitive: self.primitive,
        };
        if K == 0 {
            let pixel = program.shaded([0; K]);
            return self.flat(pixel);
        }
        let values = std::array::from_fn(|i| {
            let normal: &[i32] = match (light.flat_normal, &self.corners[i].normal) {
                (None, Some(normal)) => normal,
                _ => &[],
            };
            joined([&carried[i], normal, &light.places[i]])
        });
        self.draw::<_, K>(values, &program);
    }

    fn draw<S: Shader<K>, const K: usize>(self, values: [[i32; K]; 3], shader: &S) {
        self.canvas.draw_shaded(self.corners.map(|c| c.eye), values, shader);
    }
}

/// Colours and texture coordinates of the corners.
fn side_by_side(colors: [[i32; 3]; 3], st: [[i32; 2]; 3]) -> [[i32; 5]; 3] {
    std::array::from_fn(|i| joined([&colors[i], &st[i], &[]]))
}

/// The first K of all the values.
fn joined<const K: usize>(parts: [&[i32]; 3]) -> [i32; K] {
    let mut values = parts.into_iter().flatten();
    std::array::from_fn(|_| values.next().copied().unwrap_or_default())
}
