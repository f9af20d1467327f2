//! The fixed-point back end: the core, fed with lowered numbers. Nothing here that firmware could not do.

pub mod dials;
pub mod hw2;
pub mod iv;
pub mod mp1;
mod outline;
pub mod output;
pub mod sampling;
mod shader;
mod texcoord;

pub use crate::compare::picture::{FixedPicture, Pixel};

use crate::interpret::interpret;
use crate::scene::{Fault, Scene};
use dials::{Colors, Dials};

/// The scene's picture with the dials set as given, in bytes whatever the output.
///
/// # Errors
/// A fault at the keyword of a command whose values do not fit the core, or of the whole scene where the picture is too large
/// for a quality other than exact.
pub fn draw(scene: &Scene, dials: Dials) -> Result<FixedPicture, Fault> {
    let picture = stored(scene, dials)?;
    Ok(if dials.colors == Colors::Packed {
        output::unpacked(picture)
    } else {
        picture
    })
}

/// The picture as drawing leaves it, and the words that the output is sent: what a device would do, and no more.
///
/// # Errors
/// As [`draw`].
pub fn draw_out(scene: &Scene, dials: Dials) -> Result<(FixedPicture, Vec<u16>), Fault> {
    let picture = stored(scene, dials)?;
    let words = dials.output.words(&picture);
    Ok((picture, words))
}

fn stored(scene: &Scene, dials: Dials) -> Result<FixedPicture, Fault> {
    dials.check(scene)?;
    match scene {
        Scene::Hw2(scene) => {
            let mut back_end = hw2::Fixed::new(scene.width, scene.height).with(dials);
            interpret(scene, &mut back_end)?;
            Ok(back_end.finish())
        }
        Scene::Mp1(scene) => mp1::draw_with(scene, dials),
        Scene::Iv(scene) => iv::draw_with(scene, dials),
    }
}
