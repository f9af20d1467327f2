//! Comparison of pictures of Inventor scenes: one primitive wins each pixel, as in HW2, but is lit by another rule.
//!
//! ```text
//! scene -> log (outlines, their bounds) -> look (what a colour may be) -> lighting (the rule in interval arithmetic)
//! ```

mod lighting;
mod log;
mod look;

use super::picture::FixedPicture;
use super::{Comparison, Differing};
use crate::reference::Rendered;
use crate::scene::iv::Scene;

/// Compares the two pictures of a scene.
///
/// # Panics
///
/// If the pictures differ in size: they are not of one scene then.
pub fn compare(scene: &Scene, fixed: &FixedPicture, reference: &Rendered<()>) -> Comparison {
    assert_eq!(
        fixed.pixels.len(),
        reference.pixels.len(),
        "pictures of one scene have one size"
    );
    let picture = Differing {
        fixed,
        reference: &reference.pixels,
        depths: reference.depth_range,
    };
    let drawn = |i: usize| reference.pixels[i].primitive != 0;
    Comparison::new(fixed, &reference.bytes(), drawn, |differing| {
        if differing.is_empty() {
            return Vec::new();
        }
        picture.classify(&log::polygons(scene), differing)
    })
}

#[cfg(test)]
mod tests;
