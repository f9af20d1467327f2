//! A scene drawn twice and the two pictures held against each other.

use std::time::Instant;

use crate::compare::{self, Comparison};
use crate::fixed::{self, FixedPicture};
use crate::interpret::interpret;
use crate::picture::Picture;
use crate::reference;
use crate::scene::{Fault, Scene, hw2, mp1};

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

/// Draws a scene with both back ends, at the same time where there are processors for it.
///
/// # Errors
/// A fault at the keyword of a command whose values do not fit a back end.
pub fn render(scene: &Scene) -> Result<Rendered, Fault> {
    match scene {
        Scene::Hw2(scene) => {
            let drawn = both(|| fixed_hw2(scene), || reference_hw2(scene))?;
            let comparison = compare::compare(&drawn.fixed, &drawn.reference);
            Ok(drawn.rendered(|reference| reference.bytes(), comparison))
        }
        Scene::Mp1(scene) => {
            let drawn = both(|| fixed::mp1::draw(scene), || Ok(reference::mp1::draw(scene)))?;
            let comparison = compare_mp1(scene, &drawn)?;
            Ok(drawn.rendered(|reference| reference.bytes(), comparison))
        }
        Scene::Iv(scene) => {
            let drawn = both(|| fixed::iv::draw(scene), || Ok(reference::iv::draw(scene)))?;
            let comparison = compare::iv::compare(scene, &drawn.fixed, &drawn.reference);
            Ok(drawn.rendered(|reference| reference.bytes(), comparison))
        }
    }
}

fn fixed_hw2(scene: &hw2::Scene) -> Result<FixedPicture, Fault> {
    let mut back_end = fixed::hw2::Fixed::new(scene.width, scene.height);
    interpret(scene, &mut back_end)?;
    Ok(back_end.finish())
}

fn reference_hw2(scene: &hw2::Scene) -> Result<reference::hw2::Drawn, Fault> {
    let mut back_end = reference::hw2::Reference::new(scene.width, scene.height);
    interpret(scene, &mut back_end)?;
    Ok(back_end.finish())
}

fn compare_mp1(scene: &mp1::Scene, drawn: &Both<reference::mp1::Rendered>) -> Result<Comparison, Fault> {
    let shift = fixed::mp1::color_shift(scene)?;
    Ok(compare::mp1::compare(scene, shift, &drawn.fixed, &drawn.reference))
}

/// Both pictures, each with the time that it took.
struct Both<R> {
    fixed: FixedPicture,
    seconds_fixed: f64,
    reference: R,
    seconds_reference: f64,
}

fn both<R: Send>(
    fixed: impl FnOnce() -> Result<FixedPicture, Fault> + Send,
    reference: impl FnOnce() -> Result<R, Fault> + Send,
) -> Result<Both<R>, Fault> {
    let (fixed, reference) = rayon::join(|| timed(fixed), || timed(reference));
    let (fixed, seconds_fixed) = fixed?;
    let (reference, seconds_reference) = reference?;
    Ok(Both {
        fixed,
        seconds_fixed,
        reference,
        seconds_reference,
    })
}

impl<R> Both<R> {
    fn rendered(self, bytes: impl FnOnce(&R) -> Vec<[u8; 4]>, comparison: Comparison) -> Rendered {
        let (width, height) = (self.fixed.width, self.fixed.height);
        let pixels = self.fixed.pixels.iter().map(|pixel| pixel.rgba).collect();
        Rendered {
            fixed: Picture::new(width, height, pixels),
            depth: self.fixed.depth,
            reference: Picture::new(width, height, bytes(&self.reference)),
            comparison,
            seconds_fixed: self.seconds_fixed,
            seconds_reference: self.seconds_reference,
        }
    }
}

fn timed<T>(draw: impl FnOnce() -> Result<T, Fault>) -> Result<(T, f64), Fault> {
    let start = Instant::now();
    let drawn = draw()?;
    Ok((drawn, start.elapsed().as_secs_f64()))
}
