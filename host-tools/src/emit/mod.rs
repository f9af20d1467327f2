//! Scenes as firmware draws them: `host-render emit`.
//!
//! ```text
//! scene -> fixed back end -> log -> drawing -> analyse -> drawing -> write -> Rust
//!                                                |  ^             -> cost  -> what it takes
//!                                                v  |
//!                                              replay (the core, on this machine)
//! ```
//!
//! A scene does not move, so that all that the core does before the screen is done once, here, by the core: matrices,
//! clipping, subdivision. What is emitted is drawn from the screen on. A [`mesh`] does move, and is emitted before all that.

mod analyse;
pub mod command;
mod cost;
pub mod drawing;
mod evaluate;
pub mod harness;
pub mod log;
pub mod mesh;
mod replay;
mod write;

use crate::fixed::{self, FixedPicture};
use crate::interpret::interpret;
use crate::scene::{Fault, Scene};

pub use analyse::Depth;
pub use cost::Requirements;
use drawing::Drawing;

/// A scene as Rust.
#[derive(Debug, Clone)]
pub struct Emitted {
    /// The file.
    pub text: String,
    /// What it takes.
    pub requirements: Requirements,
    /// What it draws: red, green, blue and alpha, row by row.
    pub bytes: Vec<[u8; 4]>,
}

/// A scene as Rust. `origin` says in the file's first lines where it came from.
///
/// # Errors
/// A fault at the keyword of a command whose values do not fit the core.
///
/// # Panics
/// Where what is to be emitted does not give the scene's picture, which is checked here: a bug of ours.
pub fn emit(scene: &Scene, origin: &str) -> Result<Emitted, Fault> {
    let (bytes, drawing) = recorded(scene)?;
    let analysed = analyse::analyse(drawing, &bytes);
    let sorted = write::Sorted::new(&analysed.drawing);
    let requirements = Requirements::new(&analysed, &sorted);
    let text = sorted.text(&requirements.comment(origin));
    Ok(Emitted {
        text,
        requirements,
        bytes,
    })
}

/// Whether the scene needs a depth buffer, and why.
///
/// # Errors
/// As [`emit`].
pub fn depth(scene: &Scene) -> Result<Depth, Fault> {
    let (bytes, mut drawing) = recorded(scene)?;
    Ok(analyse::depth(&mut drawing, &bytes))
}

/// What the core draws, and what it draws it from.
fn recorded(scene: &Scene) -> Result<(Vec<[u8; 4]>, Drawing), Fault> {
    let (picture, drawing) = match scene {
        Scene::Hw2(scene) => {
            let mut back_end = fixed::hw2::Fixed::recorded(scene.width, scene.height);
            interpret(scene, &mut back_end)?;
            back_end.finish_recorded()
        }
        Scene::Mp1(scene) => fixed::mp1::recorded(scene)?,
        Scene::Iv(scene) => fixed::iv::recorded(scene)?,
    };
    let FixedPicture { pixels, .. } = picture;
    let bytes = pixels.iter().map(|pixel| pixel.rgba).collect();
    let drawing = drawing.ok_or_else(|| Fault::of_whole("nothing was written down"))?;
    Ok((bytes, drawing))
}
