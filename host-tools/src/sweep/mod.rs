//! `host-render sweep`: what a scene's speed costs in accuracy. Every tier and every dial turned alone is drawn, held against
//! float64, and its cost counted.
//!
//! ```text
//! scene -> settings (which dials) -> the core -> errors (against float64) -> front (Pareto, recommendation) -> command
//!                                 -> cost (callgrind, or time) ------------^
//! ```

pub mod command;
mod cost;
mod errors;
mod front;
mod settings;
mod table;

pub use cost::Unit;
pub use errors::Errors;
pub use front::{Budget, pareto, recommended};
pub use settings::{Setting, setting, settings};
pub use table::mean_4x4;

use rayon::prelude::*;

use crate::args::Args;
use crate::exit::Failure;
use crate::fixed;
use crate::fixed::dials::{Dials, Tier};
use crate::load::Loaded;
use crate::render::Reference;
use crate::scene::Scene;

/// One setting of the dials, drawn and counted.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// A tier, or `exact` with one dial turned: `exact+perspective=affine`.
    pub name: String,
    /// How its picture differs from float64's.
    pub errors: Errors,
    /// Of drawing the picture, in the sweep's unit.
    pub cost: f64,
    /// Whether no other point is as cheap and as near, and better in one of the two.
    pub pareto: bool,
}

/// All settings of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// The scene's file, as the user named it.
    pub scene: String,
    /// Width and height of the picture.
    pub size: (u32, u32),
    /// Pixels that the core draws with the dials of exact: no dial changes which, but that of trigonometry near edges.
    pub pixels: u64,
    /// What costs are counted in.
    pub unit: Unit,
    /// The tiers first.
    pub points: Vec<Point>,
}

/// Whether all tiers can draw a scene.
///
/// # Errors
/// Why not, without the scene's name.
pub fn fits(scene: &Scene) -> Result<(), String> {
    Dials::of(Tier::Fast).fit(scene, "a sweep")
}

/// Draws and counts every setting that matters for a scene.
///
/// # Errors
/// A scene that does not fit the core or one of its tiers, or a valgrind that counts nothing.
pub fn sweep(loaded: &Loaded, args: &Args) -> Result<Sweep, Failure> {
    fits(&loaded.scene).map_err(|message| Failure::bad(message).of(&loaded.file))?;
    let failed = |fault| Failure::scene(&loaded.file, &fault);
    let settings = settings(&loaded.scene);
    // Equal dials draw the same at the same cost: each is drawn and counted once.
    let mut unique: Vec<Setting> = Vec::new();
    for setting in &settings {
        if !unique.iter().any(|other| other.dials == setting.dials) {
            unique.push(setting.clone());
        }
    }
    let reference = Reference::draw(&loaded.scene).map_err(failed)?;
    let bytes = reference.bytes();
    let compared = unique.par_iter().map(|setting| {
        let fixed = fixed::draw(&loaded.scene, setting.dials)?;
        let comparison = reference.compare(&fixed)?;
        let output = setting.dials.output;
        let (shown, wanted) = (output.shown(fixed), errors::wanted(&bytes, output));
        let errors = Errors::new(&shown, &wanted, comparison.coverage_differs);
        Ok((errors, comparison.pixels_drawn))
    });
    let compared: Vec<_> = compared.collect::<Result<_, _>>().map_err(failed)?;
    let (unit, costs) = cost::costs(loaded, args, &unique)?;
    let pixels = compared.first().map_or(0, |(_, pixels)| *pixels);
    let drawn: Vec<_> = unique.iter().zip(compared).zip(costs).collect();
    let point = |setting: Setting| {
        let same = |((other, _), _): &&((&Setting, _), _)| other.dials == setting.dials;
        drawn.iter().find(same).map(|((_, (errors, _)), cost)| Point {
            name: setting.name.clone(),
            errors: *errors,
            cost: *cost,
            pareto: false,
        })
    };
    let mut points: Vec<Point> = settings.into_iter().filter_map(point).collect();
    let front = pareto(&points);
    for (point, pareto) in points.iter_mut().zip(front) {
        point.pareto = pareto;
    }
    Ok(Sweep {
        scene: loaded.file.display().to_string(),
        size: loaded.scene.size(),
        pixels,
        unit,
        points,
    })
}
