//! Comparison of MP1 pictures, in which a pixel is not one winner's but a stack of layers, some of them transparent, and the
//! mean of several samples.
//!
//! ```text
//! scene -> mark (what is drawn, its bounds) -> event (what it may do at a sample) -> layers (every way it may go)
//!       -> resolve (what the pixel may be) -> the class
//! ```
//!
//! A pixel with alpha 0 in both pictures is equal whatever its colours, and whoever drew there. A differing pixel is explained
//! if some way that the uncertain decisions may go leads to the core's bytes. If the same way also leads to the reference's
//! value, it is a difference of colour only; else the decisions give it its class.

mod event;
mod layers;
mod mark;
mod paint;
mod resolve;
#[cfg(test)]
mod tests;

use rayon::prelude::*;

use super::interval::Interval;
use super::picture::FixedPicture;
use super::screen::Screen;
use super::tiles::Tiles;
use super::{Class, Comparison};
use crate::reference::byte;
use crate::reference::mp1::Rendered;
use crate::scene::mp1::Scene;
use event::{Drawn, Event};
use layers::State;
use mark::{Maker, Mark};
use paint::Channels;
use resolve::{Outcome, outcomes};

/// Compares the two pictures of an MP1 scene. `shift` is by how many bits the core's unit of colours is larger than 2⁻²⁸.
///
/// # Panics
///
/// If the pictures differ in size: they are not of one scene then.
pub fn compare(scene: &Scene, shift: u32, fixed: &FixedPicture, reference: &Rendered) -> Comparison {
    let mut bytes = reference.bytes();
    assert_eq!(fixed.pixels.len(), bytes.len(), "pictures of one scene have one size");
    let mut invisible = vec![false; bytes.len()];
    for (i, (theirs, ours)) in bytes.iter_mut().zip(&fixed.pixels).enumerate() {
        let [.., alpha] = ours.rgba;
        if theirs[3] == 0 && alpha == 0 {
            *theirs = ours.rgba;
            invisible[i] = true;
        }
    }
    let judge = Judge {
        scene,
        fixed,
        reference,
        resolved: reference.resolved(),
    };
    let drawn = |i: usize| {
        let theirs = || judge.samples(i).any(|s| reference.samples[s].primitive != 0);
        if invisible[i] {
            fixed.pixels[i].primitive != 0
        } else {
            theirs()
        }
    };
    Comparison::new(fixed, &bytes, drawn, |differing| judge.classes(shift, differing))
}

/// A scene and its two pictures.
struct Judge<'a> {
    scene: &'a Scene,
    fixed: &'a FixedPicture,
    reference: &'a Rendered,
    /// The reference's pixels before they are cut off.
    resolved: Vec<[f64; 4]>,
}

impl Judge<'_> {
    /// The samples of a pixel, as the reference counts them.
    fn samples(&self, pixel: usize) -> impl Iterator<Item = usize> + use<> {
        let (width, n) = (self.scene.width as usize, self.scene.switches.fsaa as usize);
        let (x, y) = (pixel % width, pixel / width);
        (0..n * n).map(move |k| (y * n + k / n) * width * n + x * n + k % n)
    }

    fn classes(&self, shift: u32, differing: &[usize]) -> Vec<(Class, u8)> {
        if differing.is_empty() {
            return Vec::new();
        }
        let switches = &self.scene.switches;
        let maker = Maker::new(self.scene, shift);
        let marks: Vec<Mark> = (1..)
            .zip(&self.scene.primitives)
            .filter_map(|(number, primitive)| maker.mark(number, &primitive.shape))
            .collect();
        let (width, height) = (self.scene.width * switches.fsaa, self.scene.height * switches.fsaa);
        let screen = Screen {
            size: [f64::from(width), f64::from(height)],
            depths: if switches.depth {
                Interval { low: -1.0, high: 1.0 }
            } else {
                Interval::ALL
            },
        };
        let drawn: Vec<Drawn<'_>> = marks.iter().map(|mark| Drawn::new(mark, &screen)).collect();
        let contested: Vec<usize> = differing.iter().flat_map(|&i| self.samples(i)).collect();
        let tiles = Tiles::new(drawn.iter().map(Drawn::bounds), width, height, &contested);
        let states = |sample: usize| {
            let (x, y) = (sample % width as usize, sample / width as usize);
            let near = tiles.near(x, y).iter();
            let events: Vec<Event> = near.flat_map(|&i| drawn[i].events([x as f64, y as f64])).collect();
            layers::states(&events, switches.depth, maker.unit)
        };
        let class = |&pixel: &usize| {
            let all: Vec<_> = self.samples(pixel).map(states).collect();
            self.class(pixel, &outcomes(&all, self.middle(pixel), maker.unit, switches.srgb))
        };
        differing.par_iter().map(class).collect()
    }

    /// The reference's linear colour of a pixel.
    fn middle(&self, pixel: usize) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let mut alpha = 0.0;
        for sample in self.samples(pixel).map(|i| &self.reference.samples[i]) {
            alpha += sample.alpha;
            for (sum, c) in sum.iter_mut().zip(sample.color) {
                *sum += c * sample.alpha;
            }
        }
        if alpha > 0.0 { sum.map(|c| c / alpha) } else { sum }
    }

    fn class(&self, pixel: usize, outcomes: &[Outcome]) -> (Class, u8) {
        let (bytes, value) = (self.fixed.pixels[pixel].rgba, self.resolved[pixel]);
        let fits = |channels: &Channels| {
            let mut pairs = channels.iter().zip(bytes);
            pairs.all(|(c, level)| (level_of(c.low)..=level_of(c.high)).contains(&level))
        };
        let ours: Vec<&Outcome> = outcomes.iter().filter(|outcome| fits(&outcome.full)).collect();
        let holds = |outcome: &&&Outcome| {
            let mut pairs = outcome.full.iter().zip(value);
            pairs.all(|(c, v)| c.low <= v && v <= c.high)
        };
        // Several ways taken together tell nothing about one of them.
        let known = |outcome: &&&Outcome| {
            let d = outcome.decisions;
            !(d.pole || outcome.merged && d != State::EMPTY.decisions)
        };
        let beyond = |outcome: &&Outcome| {
            let each = outcome.moved.iter().zip(bytes).map(|(m, level)| {
                let below = level_of(m.low).saturating_sub(level);
                below.max(level.saturating_sub(level_of(m.high)))
            });
            each.max().unwrap_or(0)
        };
        if let Some(beyond) = ours.iter().filter(known).filter(holds).map(beyond).min() {
            return (Class::Colour, beyond);
        }
        let class = |outcome: &&Outcome| {
            let d = outcome.decisions;
            // In the order of the classes: the first that fits.
            [
                (d.pole, (6, Class::Pole)),
                (d.edge, (2, Class::Edge)),
                (d.depth, (3, Class::Depth)),
                (d.texel, (5, Class::Texel)),
            ]
            .into_iter()
            .find_map(|(decided, class)| decided.then_some(class))
            .unwrap_or((9, Class::Unexplained))
        };
        let best = ours.iter().map(class).min_by_key(|(rank, _)| *rank);
        (best.map_or(Class::Unexplained, |(_, class)| class), 0)
    }
}

/// The byte of a level; what is not a number counts as 0.
fn level_of(level: f64) -> u8 {
    byte(level / 255.0)
}
