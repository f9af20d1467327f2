//! What the core may show at one sample of an HW2 surface: interpolated colours, texels, decals, lights.

use std::cmp::Reverse;
use std::sync::Arc;

use super::direction::Direction;
use super::interval::Interval;
use super::lighting::{Errors, Place, Sum, brightest, sums};
use super::linear::Range;
use super::look::{Look, Sight, Verdict};
use super::piece::Piece;
use super::stated::{COLOR_LEVELS, LIT, LIT_LEVELS, LIT_SURFACE, UNIT_VECTOR, UNITS};
use super::texels::{Texels, blended};
use crate::reference::attributes::Bounds;
use crate::reference::byte;
use crate::reference::log::Corner;
use crate::reference::material::{Fill, Material, Source};

/// A surface at a sample.
struct Seen<'a> {
    sight: &'a Sight,
    /// The interpolated colour, or the one of a flat surface.
    color: Range<3>,
    /// The core's arithmetic with colours, counted in `color` and to be counted again for texels.
    rounding: f64,
    /// Rounding of a lit colour.
    unit: f64,
    /// The light without the core's errors and with them; none if the surface is not lit.
    light: Option<(Sum, Vec<Sum>)>,
}

/// Whether anything of the material changes from fragment to fragment.
fn varies(material: &Material) -> bool {
    !matches!(material.fill, Fill::Flat(_)) || material.is_lit() && (turns(material) || has_place(material))
}

impl Look for Arc<Material> {
    fn varies(&self) -> bool {
        varies(self)
    }

    fn verdict(&self, piece: &Piece<'_>, sight: &Sight) -> Verdict {
        verdict(self, piece, sight)
    }
}

/// Judges a colour.
fn verdict(material: &Material, piece: &Piece<'_>, sight: &Sight) -> Verdict {
    look(material, piece, sight).unwrap_or(Verdict::Pole)
}

/// None is a pole.
fn look(material: &Material, piece: &Piece<'_>, sight: &Sight) -> Option<Verdict> {
    let rounding = rounding(material, piece);
    let seen = Seen {
        sight,
        color: color(material, piece, sight, rounding)?,
        rounding,
        unit: unit(material, piece),
        light: if material.is_lit() {
            Some(light(material, piece, sight)?)
        } else {
            None
        },
    };
    let Some(texture) = material.texture() else {
        return Some(seen.judged(&seen.color, true));
    };
    let coordinates = piece.values(sight.sample, |c| c.at.texcoord, None, 0.0)?;
    let errors = [
        lowering(piece, |e| e.texcoord),
        piece.noise(sight.sample, |c| c.at.texcoord),
    ];
    let texels = Texels::new(texture, &coordinates, errors, f64::floor);
    let candidate = |(texel, own): ([u8; 4], bool)| {
        let [r, g, b, alpha] = texel;
        let mut surface = blended([r, g, b, if material.decals { alpha } else { 255 }], &seen.color);
        surface.full = surface.full.map(|f| f.widened(seen.rounding));
        seen.judged(&surface, own)
    };
    texels.all().map(candidate).max()
}

fn turns(material: &Material) -> bool {
    material.flat_normal.is_none()
}

/// Whether the eye position counts.
fn has_place(material: &Material) -> bool {
    let bulb = material
        .lights
        .iter()
        .any(|light| matches!(light.source, Source::Bulb(_)));
    bulb || material.shininess > 0.0
}

/// The largest error that some value has before it is interpolated.
fn lowering(piece: &Piece<'_>, of: fn(&Bounds) -> f64) -> f64 {
    UNITS * piece.greatest(|c| [of(&c.at_error)])
}

/// What the core rounds colours to, in proportion to the largest, or to full if that is less.
fn rounding(material: &Material, piece: &Piece<'_>) -> f64 {
    let levels = if material.is_lit() {
        LIT_SURFACE * coarser(material, piece)
    } else {
        COLOR_LEVELS
    };
    levels / 255.0 * piece.greatest(|c| c.color).max(1.0)
}

/// In how many times larger units than those of 2⁻¹⁶ levels the core carries a lit surface's colours, where w has both signs. Those
/// without a texture are 64 times finer; one colour, and a texture's own, are always what they are.
fn coarser(material: &Material, piece: &Piece<'_>) -> f64 {
    match material.fill {
        Fill::Textured(_) if material.decals => piece.headroom(),
        Fill::Gouraud => (piece.headroom() / 64.0).max(1.0),
        Fill::Textured(_) | Fill::Flat(_) => 1.0,
    }
}

/// What a lit colour is rounded to: of a patch, whose unit is that of its brightest control point, at least to that.
fn unit(material: &Material, piece: &Piece<'_>) -> f64 {
    let full = piece.greatest(|c| c.color).max(1.0);
    let carried = piece.greatest(|c| [c.at_error.color]);
    brightest(&material.lights) * (LIT / 255.0 * coarser(material, piece) * full).max(carried)
}

/// The surface's colour before textures and lights.
fn color(material: &Material, piece: &Piece<'_>, sight: &Sight, rounding: f64) -> Option<Range<3>> {
    let of = |c: &Corner| c.color;
    let lowering = rounding + lowering(piece, |e| e.color);
    match material.fill {
        Fill::Flat(color) => Some(Range::constant(color, lowering)),
        Fill::Textured(_) if !material.decals => Some(Range::constant([0.0; 3], 0.0)),
        Fill::Gouraud if !material.is_lit() => piece.values(sight.sample, of, sight.known, lowering),
        Fill::Gouraud | Fill::Textured(_) => piece.values(sight.sample, of, None, lowering),
    }
}

/// The light without the core's errors, switched as it is, and all that it may be with them.
fn light(material: &Material, piece: &Piece<'_>, sight: &Sight) -> Option<(Sum, Vec<Sum>)> {
    let normal = match material.flat_normal {
        Some(normal) => Range::constant(normal, material.flat_normal_error + UNIT_VECTOR),
        None => piece.values(sight.sample, |c| c.at.normal, None, lowering(piece, |e| e.normal))?,
    };
    let unit = lowering(piece, |e| e.eye);
    // A corner at infinity has no place to interpolate from.
    if has_place(material) && !unit.is_finite() {
        return None;
    }
    let eye = if has_place(material) {
        piece.values(sight.sample, |c| c.at.eye, None, unit)?
    } else {
        Range::constant([0.0; 3], 0.0)
    };
    let place = |normal: Direction, eye: [Interval; 3]| Place {
        normal,
        eye,
        unit,
        shininess: material.shininess,
    };
    let exact = sums(
        &material.lights,
        &place(Direction::within(normal.moved), eye.moved),
        Errors::None,
    );
    let core = sums(
        &material.lights,
        &place(Direction::within(normal.full), eye.full),
        Errors::Core,
    );
    Some((*exact.first()?, core))
}

impl Seen<'_> {
    /// Judges the colour for one surface colour; `own` is whether that is certainly the reference's texel.
    fn judged(&self, surface: &Range<3>, own: bool) -> Verdict {
        let Some((exact, core)) = &self.light else {
            return self.found(surface.moved, surface.full, own).unwrap_or(Verdict::Differs);
        };
        let moved = exact.color(surface.moved);
        let near = moved.map(|m| m.widened(LIT_LEVELS / 255.0));
        let mut verdict = Verdict::Differs;
        for (i, sum) in core.iter().enumerate() {
            let full = sum.color(surface.full).map(|f| f.widened(self.unit));
            if !self.fits(full) {
                continue;
            }
            // The first sum has every light on or off as it is.
            let both = [0, 1, 2].map(|c| full[c].clamped(near[c]));
            let calm = if i == 0 { self.found(moved, both, own) } else { None };
            verdict = verdict.max(calm.unwrap_or(Verdict::Steep));
        }
        verdict
    }

    /// *Colour* or *texel*, if the colour lies in `all`. The reference's must too, or it chose another texel.
    fn found(&self, moved: [Interval; 3], all: [Interval; 3], own: bool) -> Option<Verdict> {
        if !self.fits(all) {
            return None;
        }
        let holds = |known: [f64; 3]| (all.iter().zip(known)).all(|(a, k)| a.low <= k && k <= a.high);
        // On a texel's border it is not known which one the reference chose, but its colour tells.
        let reference_too = self.sight.known.map_or(own, holds);
        let beyond = moved.iter().zip(self.sight.fixed).map(|(m, level)| {
            let below = byte(m.low).saturating_sub(level);
            below.max(level.saturating_sub(byte(m.high)))
        });
        let beyond = beyond.max().unwrap_or(0);
        Some(if reference_too {
            Verdict::Colour(Reverse(beyond))
        } else {
            Verdict::Texel
        })
    }

    fn fits(&self, colors: [Interval; 3]) -> bool {
        let mut pairs = colors.iter().zip(self.sight.fixed);
        pairs.all(|(c, level)| (byte(c.low)..=byte(c.high)).contains(&level))
    }
}
