//! A scene drawn twice and the two pictures held against each other.

use std::hint;
use std::time::Instant;

use crate::compare::{self, Comparison};
use crate::fixed::dials::Dials;
use crate::fixed::{self, FixedPicture};
use crate::interpret::interpret;
use crate::picture::Picture;
use crate::reference::{self, hw2, iv, mp1};
use crate::scene::{self, Fault, Scene};

/// Both pictures and what became of the comparison.
#[derive(Debug)]
pub struct Rendered {
    /// The fixed-point core's picture.
    pub fixed: Picture,
    /// The core's depth of each pixel; 65535 is 1.
    pub depth: Vec<u16>,
    /// The float64 reference's picture.
    pub reference: Picture,
    /// Where and why they differ.
    pub comparison: Comparison,
    /// Time to draw with the core.
    pub seconds_fixed: f64,
    /// Time to draw with the reference.
    pub seconds_reference: f64,
}

/// What a sample takes at least while a scene is drawn and compared, in bytes; measured, it is 67 and more.
const SAMPLE: u64 = 64;

/// Whether a scene has room in memory, as far as that is known beforehand: to run out of it later ends the whole run, all other
/// scenes included.
///
/// # Errors
/// What is wrong, without the scene's name.
pub fn room(scene: &Scene) -> Result<(), String> {
    let (width, height) = scene.size();
    let samples = u64::from(width) * u64::from(height) * u64::from(scene.fsaa()).pow(2);
    let bytes = samples * SAMPLE;
    let mut room: Vec<u8> = Vec::new();
    let reserved = usize::try_from(bytes).is_ok_and(|bytes| room.try_reserve_exact(bytes).is_ok());
    // Or else nothing would be asked for, as nothing is kept there.
    hint::black_box(&room);
    if reserved {
        return Ok(());
    }
    let most = bytes >> 20;
    Err(format!(
        "a picture of {width}x{height} takes {most} MiB of memory and more, which cannot be had"
    ))
}

/// Draws a scene with both back ends, at the same time where there are processors for it, the core's dials set as given.
///
/// # Errors
/// A fault at the keyword of a command whose values do not fit a back end.
pub fn render(scene: &Scene, dials: Dials) -> Result<Rendered, Fault> {
    let (fixed, reference) = rayon::join(
        || timed(|| fixed::draw(scene, dials)),
        || timed(|| Reference::draw(scene)),
    );
    let (fixed, seconds_fixed) = fixed?;
    let (reference, seconds_reference) = reference?;
    let comparison = reference.compare(&fixed)?;
    Ok(Rendered {
        fixed: fixed.picture(),
        reference: Picture::new(fixed.width, fixed.height, reference.bytes()),
        depth: fixed.depth,
        comparison,
        seconds_fixed,
        seconds_reference,
    })
}

/// The float64 reference's picture of a scene, and what it was drawn from.
pub enum Reference<'s> {
    /// Of an HW2 scene.
    Hw2(hw2::Drawn),
    /// Of an MP1 scene.
    Mp1(&'s scene::mp1::Scene, mp1::Rendered),
    /// Of an Inventor scene.
    Iv(&'s scene::iv::Scene, reference::Rendered<()>),
}

impl<'s> Reference<'s> {
    /// Draws a scene.
    ///
    /// # Errors
    /// A fault at the keyword of a command whose values do not fit.
    pub fn draw(scene: &'s Scene) -> Result<Self, Fault> {
        Ok(match scene {
            Scene::Hw2(scene) => {
                let mut back_end = hw2::Reference::new(scene.width, scene.height);
                interpret(scene, &mut back_end)?;
                Reference::Hw2(back_end.finish())
            }
            Scene::Mp1(scene) => Reference::Mp1(scene, mp1::draw(scene)),
            Scene::Iv(scene) => Reference::Iv(scene, iv::draw(scene)),
        })
    }

    /// Red, green, blue and alpha of the picture, row by row.
    pub fn bytes(&self) -> Vec<[u8; 4]> {
        match self {
            Reference::Hw2(drawn) => drawn.bytes(),
            Reference::Mp1(_, drawn) => drawn.bytes(),
            Reference::Iv(_, drawn) => drawn.bytes(),
        }
    }

    /// Where and why the core's picture of the scene differs.
    ///
    /// # Errors
    /// Where the scene's values do not fit the core, which has drawn it.
    pub fn compare(&self, fixed: &FixedPicture) -> Result<Comparison, Fault> {
        Ok(match self {
            Reference::Hw2(drawn) => compare::compare(fixed, drawn),
            Reference::Mp1(scene, drawn) => {
                let shift = fixed::mp1::color_shift(scene)?;
                compare::mp1::compare(scene, shift, fixed, drawn)
            }
            Reference::Iv(scene, drawn) => compare::iv::compare(scene, fixed, drawn),
        })
    }
}

fn timed<T>(draw: impl FnOnce() -> Result<T, Fault>) -> Result<(T, f64), Fault> {
    let start = Instant::now();
    let drawn = draw()?;
    Ok((drawn, start.elapsed().as_secs_f64()))
}
