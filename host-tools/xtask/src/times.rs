//! `cargo xtask times`: what the core and float64 take for the same scene on this machine.

use std::ffi::OsStr;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use fixel_host::scene::Fault;
use fixel_host::scene::iv::{Scene, Shading};
use fixel_host::{fixed, reference};

use crate::callgrind::count;
use crate::failure::Failure;
use crate::model::{Size, read};

/// Times that each is drawn: the one in the middle counts.
const RUNS: usize = 15;

const SHADINGS: [(&str, Shading); 3] = [
    ("flat", Shading::Flat),
    ("gouraud", Shading::Gouraud),
    ("phong", Shading::Phong),
];

/// Prints both, and how they compare.
pub fn run(file: &Path, size: Size) -> Result<(), Failure> {
    println!("{}, {size}, medians of {RUNS}\n", file.display());
    println!(
        "{:<8}{:>10}{:>10}{:>8}{:>16}{:>16}{:>8}",
        "shading", "core ms", "float ms", "ratio", "core instr.", "float instr.", "ratio"
    );
    for (name, shading) in SHADINGS {
        let scene = read(file, size, shading)?;
        let [core, float] = medians(&scene).map_err(|e| Failure::trouble(file.display(), e))?;
        let counted = |back_end: &str| {
            let words = ["draw-scene".as_ref(), file.as_os_str()].into_iter();
            let size = size.to_string();
            count(
                "counted_scene",
                words.chain([size.as_str(), name, back_end].map(OsStr::new)),
            )
        };
        let (fixed, reference) = (counted("core")?, counted("float")?);
        println!(
            "{name:<8}{:>10.2}{:>10.2}{:>8.2}{fixed:>16}{reference:>16}{:>8.2}",
            core * 1e3,
            float * 1e3,
            core / float,
            fixed as f64 / reference as f64
        );
    }
    Ok(())
}

/// Seconds of the core and of float64, drawn in turn so that a busy machine slows both.
fn medians(scene: &Scene) -> Result<[f64; 2], Fault> {
    let mut times = [[0.0; RUNS]; 2];
    for i in 0..RUNS {
        for (seconds, float) in times.iter_mut().zip([false, true]) {
            let start = Instant::now();
            counted_scene(scene, float)?;
            seconds[i] = start.elapsed().as_secs_f64();
        }
    }
    Ok(times.map(|mut seconds| {
        seconds.sort_by(f64::total_cmp);
        seconds[RUNS / 2]
    }))
}

/// What valgrind runs: a scene, drawn once.
pub fn draw_scene(file: &Path, size: Size, shading: &str, back_end: &str) -> Result<(), Failure> {
    let shading = SHADINGS.iter().find(|(name, _)| *name == shading);
    let (_, shading) = *shading.ok_or_else(|| Failure::Usage("expected flat, gouraud or phong".into()))?;
    let scene = read(file, size, shading)?;
    counted_scene(&scene, back_end == "float").map_err(|e| Failure::trouble(file.display(), e))
}

/// Valgrind counts in here, by name.
#[inline(never)]
fn counted_scene(scene: &Scene, float: bool) -> Result<(), Fault> {
    if float {
        black_box(reference::iv::draw(scene));
    } else {
        black_box(fixed::iv::draw(scene)?);
    }
    Ok(())
}
