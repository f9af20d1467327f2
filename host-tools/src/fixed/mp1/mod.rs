//! MP1 scenes drawn by the core.
//!
//! ```text
//! scene -> units (numbers) -> primitive (which program) -> canvas (the core's draw) -> resolve, encode, cut off
//!                              program (colour, over)
//! ```

use fixel::blend::Rgba;
use fixel::depth::FAR;
use fixel::num::Word;
use fixel::supersample::Level;
use fixel::viewport::Viewport;
use fixel::window::Window;

use crate::emit::drawing::{self, Drawing, Nearer, Pixels};
use crate::emit::log::Log;
use crate::fixed::dials::Dials;
use crate::fixed::{FixedPicture, Pixel};
use crate::scene::mp1::Scene;
use crate::scene::{Fault, Place};

mod canvas;
mod primitive;
pub(crate) mod program;
pub(crate) mod units;

use canvas::{Canvas, Views};
use primitive::Brush;
use units::Units;

/// By how many bits the unit of the scene's colours is larger than 2^-28 of full.
///
/// # Errors
/// As [`draw`].
pub fn color_shift(scene: &Scene) -> Result<u32, Fault> {
    Ok(Units::of(scene)?.shift)
}

/// The scene's picture.
///
/// # Errors
/// A fault at the keyword of a primitive whose values do not fit the core.
pub fn draw(scene: &Scene) -> Result<FixedPicture, Fault> {
    draw_with(scene, Dials::default())
}

/// The scene's picture with the dials set as given, where edges of 32 bits do.
///
/// # Errors
/// As [`draw`].
pub fn draw_with(scene: &Scene, dials: Dials) -> Result<FixedPicture, Fault> {
    let window = Window::new(0, 0, scene.width as i32, scene.height as i32);
    if dials.are_exact() {
        return draw_part(scene, window);
    }
    let (picture, _) = logged::<i32>(scene, window, dials, None)?;
    Ok(picture)
}

/// The part `window` of it: what a strip or a tile holds.
///
/// # Errors
/// As [`draw`].
pub fn draw_part(scene: &Scene, window: Window) -> Result<FixedPicture, Fault> {
    if most_samples(scene) <= <i32 as Word>::GUARD as u32 {
        with_word::<i32>(scene, window)
    } else {
        with_word::<i64>(scene, window)
    }
}

/// The scene's picture and what it is drawn from.
///
/// # Errors
/// As [`draw`].
pub fn recorded(scene: &Scene) -> Result<(FixedPicture, Option<Drawing>), Fault> {
    let window = Window::new(0, 0, scene.width as i32, scene.height as i32);
    let Units { shift, srgb } = Units::of(scene)?;
    let wide = most_samples(scene) > <i32 as Word>::GUARD as u32;
    let log = Log::new(Drawing {
        width: scene.width,
        height: scene.height,
        level: scene.switches.fsaa,
        wide,
        depth: scene.switches.depth.then_some(Nearer::LessOrEqual),
        pixels: Pixels::Blended(drawing::Units { shift, srgb }),
        textures: Vec::new(),
        lights: Vec::new(),
        draws: Vec::new(),
    });
    let (picture, log) = if wide {
        logged::<i64>(scene, window, Dials::default(), Some(log))?
    } else {
        logged::<i32>(scene, window, Dials::default(), Some(log))?
    };
    Ok((picture, log.map(Log::finish)))
}

fn most_samples(scene: &Scene) -> u32 {
    scene.width.max(scene.height) * scene.switches.fsaa
}

/// With a certain word for the edges.
///
/// # Errors
/// As [`draw`], and where the picture does not fit the word.
pub fn with_word<W: Word>(scene: &Scene, window: Window) -> Result<FixedPicture, Fault> {
    let (picture, _) = logged::<W>(scene, window, Dials::default(), None)?;
    Ok(picture)
}

fn logged<W: Word>(
    scene: &Scene,
    window: Window,
    dials: Dials,
    log: Option<Log>,
) -> Result<(FixedPicture, Option<Log>), Fault> {
    let start = Place { line: 1, column: 1 };
    let whole = |message: String| Fault::new(start, message);
    let fsaa = scene.switches.fsaa;
    let level = Level::new(fsaa).map_err(|e| whole(e.to_string()))?;
    let side = |pixels: u32| u16::try_from(pixels * fsaa).map_err(|e| whole(e.to_string()));
    let viewport =
        Viewport::<W>::new(0, 0, side(scene.width)?, side(scene.height)?).map_err(|e| whole(e.to_string()))?;
    let brush = Brush {
        switches: &scene.switches,
        views: Views::new(&scene.switches, viewport).map_err(whole)?,
        units: Units::with(scene, dials)?,
        dials,
    };
    let n = fsaa as i32;
    let samples = Window::new(window.left * n, window.top * n, window.right * n, window.bottom * n);
    let mut canvas = Canvas::new(samples, scene.switches.depth && !dials.no_depth);
    canvas.log = log;
    for (number, primitive) in (1..).zip(&scene.primitives) {
        let drawn = brush.draw(&mut canvas, number, &primitive.shape);
        drawn.map_err(|message| Fault::new(primitive.place, message))?;
    }
    let picture = finish(&canvas, level, brush.units, window);
    Ok((picture, canvas.log))
}

/// Resolved, encoded, cut off. A pixel's depth is that of its first sample.
fn finish(canvas: &Canvas, level: Level, units: Units, window: Window) -> FixedPicture {
    let (width, n) = (window.width(), level.side());
    let mut pixels = Vec::with_capacity(width * window.height());
    for block in canvas.samples.chunks(width * n * n) {
        let colors: Vec<Rgba> = block.iter().map(|sample| sample.color).collect();
        level.resolve(&colors, width * n, |x, Rgba { color, alpha }| {
            let [r, g, b] = color.map(|c| units.byte(c));
            let samples = block.chunks(width * n).flat_map(|row| &row[x * n..(x + 1) * n]);
            pixels.push(Pixel {
                rgba: [r, g, b, units::byte(alpha)],
                primitive: samples.map(|sample| sample.primitive).max().unwrap_or_default(),
            });
        });
    }
    let first = |i: usize| (i / width * n * width + i % width) * n;
    let depth = |i: usize| canvas.depths.get(first(i)).copied().unwrap_or(FAR);
    FixedPicture {
        width: width as u32,
        height: window.height() as u32,
        depth: (0..pixels.len()).map(depth).collect(),
        pixels,
    }
}
