//! `host-render extremes`: what becomes of the bounds when one number of a scene is driven to its limits.
//!
//! A bound holds where every pixel that differs from float64 is explained by it; beyond, the tool says what happens.

mod chart;
pub mod command;
mod families;

use std::fmt::Write as _;
use std::sync::Arc;

use rayon::prelude::*;

use crate::compare::{Class, Comparison};
use crate::fixed::dials::Dials;
use crate::picture::Picture;
use crate::render::render;
use crate::scene::{Scene, hw2};
pub use families::{EXPONENTS, FAMILIES, Family, SIZE};

/// What became of one scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// It was drawn, and compared with float64.
    Drawn(Errors),
    /// It was refused, with this message.
    Refused(String),
}

/// How a picture differs from float64's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// The largest error of a pixel of class *colour*, in levels of 255.
    pub colour: u8,
    /// Pixels of other classes that explain a difference, of 100 in the picture.
    pub excused: f64,
    /// Pixels that nothing explains.
    pub unexplained: u64,
}

/// A family's outcomes, in the order of its values.
pub struct Curve {
    /// The family.
    pub family: &'static Family,
    /// What became of each value.
    pub outcomes: Vec<(f64, Outcome)>,
}

/// Every family there is a curve of.
static ALL: [Family; 11] = {
    let [a, b, c, d, e, f, g, h, i, j] = FAMILIES;
    [a, b, c, d, e, f, g, h, i, j, EXPONENTS]
};

/// Draws every scene of every family.
pub fn curves() -> Vec<Curve> {
    let curve = |family: &'static Family| Curve {
        family,
        outcomes: family
            .values
            .par_iter()
            .map(|&value| (value, outcome(&(family.scene)(value))))
            .collect(),
    };
    ALL.par_iter().map(curve).collect()
}

/// Draws one scene, whose texture, if any, is a small picture of ours.
pub fn outcome(text: &str) -> Outcome {
    let texture = Arc::new(tile());
    let parsed = hw2::parse_with(text.as_bytes(), &mut |_| Ok(()));
    let drawn = parsed.and_then(|mut scene| {
        scene.textures.insert("tile.png".to_owned(), texture);
        render(&Scene::Hw2(scene), Dials::default())
    });
    match drawn {
        Ok(rendered) => Outcome::Drawn(errors(&rendered.fixed, &rendered.reference, &rendered.comparison)),
        Err(fault) => Outcome::Refused(fault.message),
    }
}

/// Eight by eight texels, no two of one colour.
fn tile() -> Picture {
    let texel = |i: u8| [i * 4, 255 - i * 3, i % 8 * 36, 255];
    Picture::new(8, 8, (0..64).map(texel).collect())
}

fn errors(fixed: &Picture, reference: &Picture, found: &Comparison) -> Errors {
    let pixels = fixed.pixels.iter().zip(&reference.pixels).zip(&found.classes);
    let of_colour = pixels.filter(|(_, class)| **class == Class::Colour);
    let error = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    let colour = of_colour.map(|(pair, _)| error(pair)).max().unwrap_or(0);
    let other = found.explained;
    let excused = other.edge + other.depth + other.texel + other.pole + other.steep;
    Errors {
        colour,
        excused: 100.0 * excused as f64 / found.classes.len().max(1) as f64,
        unexplained: found.unexplained,
    }
}

/// More than this share of a picture excused, in percent, and the bounds say nothing of use about it any more.
const USEFUL: f64 = 5.0;

impl Curve {
    /// The last value up to which every difference is explained.
    pub fn holds_to(&self) -> Option<f64> {
        self.last(|errors| errors.unexplained == 0)
    }

    /// The last value up to which, in addition, hardly any pixel has to be excused: beyond, the bounds hold, but they are so
    /// wide that they allow another picture.
    pub fn useful_to(&self) -> Option<f64> {
        self.last(|errors| errors.unexplained == 0 && errors.excused <= USEFUL)
    }

    fn last(&self, good: impl Fn(&Errors) -> bool) -> Option<f64> {
        let good = |outcome: &Outcome| matches!(outcome, Outcome::Drawn(errors) if good(errors));
        let last = self.outcomes.iter().take_while(|(_, outcome)| good(outcome)).last();
        last.map(|(value, _)| *value)
    }

    /// Whether the bound holds as far as is promised.
    pub fn keeps_its_promise(&self) -> bool {
        self.holds_to().is_some_and(|value| value >= self.family.promised)
    }

    /// What happens at the first value beyond [`holds_to`](Self::holds_to).
    pub fn beyond(&self) -> String {
        let held = self.holds_to();
        let beyond = self
            .outcomes
            .iter()
            .find(|(value, _)| held.is_none_or(|held| *value > held));
        match beyond {
            None => "holds in the whole range tried".to_owned(),
            Some((value, Outcome::Refused(message))) => format!("at {value:e} refused: {message}"),
            Some((value, Outcome::Drawn(errors))) => format!("at {value:e} {} pixels unexplained", errors.unexplained),
        }
    }

    /// The chart as SVG.
    pub fn chart(&self) -> String {
        chart::chart(self)
    }
}

/// The page of all curves, as Markdown.
pub fn table(curves: &[Curve]) -> String {
    let mut table = String::from(
        "| what grows | promised to | every difference explained to | and at most 5 % of the picture excused to | \
         largest colour error, levels | beyond |\n|---|---|---|---|---|---|\n",
    );
    for curve in curves {
        let drawn = || {
            curve.outcomes.iter().filter_map(|(value, outcome)| match outcome {
                Outcome::Drawn(errors) if *value <= curve.family.promised => Some(errors),
                _ => None,
            })
        };
        let colour = drawn().map(|errors| errors.colour).max().unwrap_or(0);
        let name = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:e}"));
        let (held, useful) = (name(curve.holds_to()), name(curve.useful_to()));
        // Writing into a string cannot fail.
        let _ = writeln!(
            table,
            "| [{}](extremes/{}.svg) | {:e} | {held} | {useful} | {colour} | {} |",
            curve.family.parameter,
            curve.family.name,
            curve.family.promised,
            curve.beyond()
        );
    }
    table
}
