//! A scene drawn twice and the two pictures held against each other.

use std::time::Instant;

use crate::compare::{Comparison, compare};
use crate::fixed::hw2::Fixed;
use crate::interpret::interpret;
use crate::picture::Picture;
use crate::reference::hw2::Reference;
use crate::scene::{Fault, Scene, hw2};

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
pub fn render(scene: &Scene) -> Result<Rendered, Fault> {
    match scene {
        Scene::Hw2(scene) => render_hw2(scene),
    }
}

fn render_hw2(scene: &hw2::Scene) -> Result<Rendered, Fault> {
    let (width, height) = (scene.width, scene.height);
    let (fixed, reference) = rayon::join(
        || {
            timed(|| {
                let mut back_end = Fixed::new(width, height);
                interpret(scene, &mut back_end)?;
                Ok(back_end.finish())
            })
        },
        || {
            timed(|| {
                let mut back_end = Reference::new(width, height);
                interpret(scene, &mut back_end)?;
                Ok(back_end.finish())
            })
        },
    );
    let (fixed, seconds_fixed) = fixed?;
    let (reference, seconds_reference) = reference?;
    let comparison = compare(&fixed, &reference);
    let bytes = fixed.pixels.iter().map(|pixel| pixel.rgba).collect();
    Ok(Rendered {
        fixed: Picture::new(width, height, bytes),
        depth: fixed.depth,
        reference: Picture::new(width, height, reference.bytes()),
        comparison,
        seconds_fixed,
        seconds_reference,
    })
}

fn timed<T>(draw: impl FnOnce() -> Result<T, Fault>) -> Result<(T, f64), Fault> {
    let start = Instant::now();
    let drawn = draw()?;
    Ok((drawn, start.elapsed().as_secs_f64()))
}
