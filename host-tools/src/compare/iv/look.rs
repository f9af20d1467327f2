//! What the core may show at one sample of a surface: a flat colour, interpolated ones, or what light makes of it there.

use std::cmp::Reverse;
use std::sync::Arc;

use super::lighting::{Lighting, Place};
use crate::compare::direction::Direction;
use crate::compare::interval::Interval;
use crate::compare::linear::Range;
use crate::compare::look::{Look, Sight, Verdict};
use crate::compare::piece::Piece;
use crate::compare::stated::{LIT_LEVELS, UNITS, WORLD_LEVEL, WORLD_PER_COLUMN};
use crate::reference::byte;

/// What a face is painted with.
#[derive(Clone)]
pub enum Paint {
    /// One colour, and by how much the core's may differ.
    Flat {
        /// Red, green, blue.
        color: [f64; 3],
        /// Of each.
        error: f64,
    },
    /// The corners' colours, linear over the screen.
    Gouraud,
    /// Light at every pixel.
    Phong {
        /// The rule.
        lighting: Arc<Lighting>,
        /// The unit in which the core carries positions.
        unit: f64,
    },
}

impl Look for Paint {
    fn varies(&self) -> bool {
        !matches!(self, Self::Flat { .. })
    }

    fn verdict(&self, piece: &Piece<'_>, sight: &Sight) -> Verdict {
        match self {
            Self::Flat { color, error } => judged(&Range::constant(*color, *error), sight),
            Self::Gouraud => {
                let vertices = piece.greatest(|c| [c.at_error.color]);
                // A unit for each column of a span, those off the picture included, up to four for the row, and four that are cut off.
                let stepping = WORLD_PER_COLUMN * (piece.columns() + 8.0);
                let values = piece.values(sight.sample, |c| c.color, sight.known, vertices + stepping);
                values.map_or(Verdict::Pole, |range| judged(&range, sight))
            }
            Self::Phong { lighting, unit } => {
                let phong = phong(lighting, *unit, piece, sight);
                phong.map_or(Verdict::Pole, |range| judged(&range, sight))
            }
        }
    }
}

/// None is a pole.
fn phong(lighting: &Lighting, unit: f64, piece: &Piece<'_>, sight: &Sight) -> Option<Range<3>> {
    let lowering = |error: f64| UNITS * error;
    let normal_error = lowering(piece.greatest(|c| [c.at_error.normal]));
    let place_error = lowering(piece.greatest(|c| [c.at_error.eye]));
    let normal = piece.values(sight.sample, |c| c.at.normal, None, normal_error)?;
    let at = piece.values(sight.sample, |c| c.at.eye, None, place_error)?;
    let place = |normal: [Interval; 3], at: [Interval; 3]| Place {
        normal: Direction::within(normal),
        at,
        unit,
    };
    Some(Range {
        value: sight.known.unwrap_or([f64::NAN; 3]),
        moved: lighting.color(&place(normal.moved, at.moved), false),
        full: lighting.color(&place(normal.full, at.full), true),
    })
}

/// The colours as bytes: *colour* within what moving the corners makes and two levels of arithmetic; *steep* within all that arithmetic may make.
fn judged(range: &Range<3>, sight: &Sight) -> Verdict {
    let fits = |colors: [Interval; 3]| {
        let mut pairs = colors.iter().zip(sight.fixed);
        pairs.all(|(c, level)| (byte(c.low)..=byte(c.high)).contains(&level))
    };
    let full = range.full.map(|f| f.widened(WORLD_LEVEL / 255.0));
    if !fits(full) {
        return Verdict::Differs;
    }
    let near = range.moved.map(|m| m.widened(LIT_LEVELS / 255.0));
    if !fits([0, 1, 2].map(|i| full[i].clamped(near[i]))) {
        return Verdict::Steep;
    }
    let beyond = range.moved.iter().zip(sight.fixed).map(|(m, level)| {
        let below = byte(m.low).saturating_sub(level);
        below.max(level.saturating_sub(byte(m.high)))
    });
    Verdict::Colour(Reverse(beyond.max().unwrap_or(0)))
}
