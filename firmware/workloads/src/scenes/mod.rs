//! Scenes that have the same bits on every machine: small pictures that between them use every way of drawing.
//!
//! Each is drawn in every tier of [`fixel::quality`], whole and in strips of several heights, and colour and depth are reported as CRC-32 of all rows.

mod camera;
mod finish;
mod grid;
mod lit;
pub mod part;
mod programs;
mod raster;
mod ratios;

use core::fmt::{self, Write};
use core::hint::black_box;

use fixel::error::Error;
use fixel::quality::{Balanced, Exact, Fast, Quality};
use heapless::String;
use part::{HEIGHT, Memory, Part, WIDTH};
pub use raster::TEXTURE;

use crate::frame::Crc32;
use crate::machine::{Line, Machine};

/// Draws a scene, as much of it as lies on the part of the picture.
pub type Draw = fn(&mut Part<'_>) -> Result<(), Error>;

/// A way of computing that is chosen when a firmware is compiled.
pub struct Tier {
    /// What its scenes' names begin with.
    pub name: &'static str,
    /// Name and drawing of every scene.
    pub scenes: [(&'static str, Draw); SCENES],
}

/// Scenes in every tier.
pub const SCENES: usize = 46;

/// Every scene in the tier `Q`. What has neither values between corners, light nor angles is the same in all of them, and is
/// drawn for each by the same function.
const fn scenes<Q: Quality>() -> [(&'static str, Draw); SCENES] {
    [
        ("flat", raster::flat),
        ("flat_depth", raster::flat_depth),
        ("gouraud", raster::gouraud::<Q>),
        ("gouraud_depth", raster::gouraud_depth::<Q>),
        ("gouraud_compact", raster::gouraud_compact::<Q>),
        ("texture_nearest", raster::texture_nearest),
        ("guard_band", raster::guard_band::<Q>),
        ("depth_comparisons", raster::depth_comparisons),
        ("over", raster::over),
        ("bresenham_lines", raster::bresenham_lines),
        ("subpixel_lines", raster::subpixel_lines::<Q>),
        ("wu_lines", raster::wu_lines),
        ("points", raster::points),
        ("squares", raster::squares::<Q>),
        ("discs", raster::discs),
        ("billboards", raster::billboards),
        ("perspective_nearest", camera::perspective_nearest::<Q>),
        ("near_plane", camera::near_plane::<Q>),
        ("near_plane_compact", camera::near_plane_compact::<Q>),
        ("user_planes", camera::user_planes::<Q>),
        ("both_signs_of_w", camera::both_signs_of_w::<Q>),
        ("culled_mesh", camera::culled_mesh::<Q>),
        ("lines_in_space", camera::lines_in_space::<Q>),
        ("wide_words", camera::wide_words::<Q>),
        ("rectangular_patch", camera::rectangular_patch::<Q>),
        ("triangular_patch", camera::triangular_patch::<Q>),
        ("w_ratio_1", ratios::ratio::<Q, 0>),
        ("w_ratio_4", ratios::ratio::<Q, 2>),
        ("w_ratio_64", ratios::ratio::<Q, 6>),
        ("w_ratio_1024", ratios::ratio::<Q, 10>),
        ("w_ratio_32768", ratios::ratio::<Q, 15>),
        ("lit_grid", grid::lit::<Q>),
        ("textured_grid", grid::textured::<Q>),
        ("lambert_per_pixel", lit::lambert_per_pixel::<Q>),
        ("blinn_phong_per_pixel", lit::blinn_phong_per_pixel::<Q>),
        ("phong_in_world", lit::phong_in_world::<Q>),
        ("gouraud_in_world", lit::gouraud_in_world::<Q>),
        ("pipeline_smooth", programs::smooth::<Q>),
        ("pipeline_linear_filter", programs::linear_filter::<Q>),
        ("pipeline_blending", programs::blending::<Q>),
        ("pipeline_two_targets", programs::two_targets::<Q>),
        ("pipeline_discard", programs::discard::<Q>),
        ("pipeline_lines", programs::lines::<Q>),
        ("supersampled", finish::supersampled),
        ("srgb", finish::srgb),
        ("one_bit", finish::one_bit),
    ]
}

/// All tiers with all scenes.
pub const TIERS: [Tier; 3] = [tier::<Fast>(), tier::<Balanced>(), tier::<Exact>()];

const fn tier<Q: Quality>() -> Tier {
    Tier {
        name: Q::NAME,
        scenes: scenes::<Q>(),
    }
}

/// Heights of the strips that every scene is drawn in again; the last strip may be lower.
pub const STRIPS: [u16; 3] = [1, 7, 24];

/// Draws every scene whole, counted, and in strips. A line is called `tier/scene`, that of strips `tier/scene@height`;
/// its units are pixels of the picture that are not black.
pub fn run(machine: &mut impl Machine, memory: &mut Memory) {
    for tier in &TIERS {
        for &(name, draw) in &tier.scenes {
            report(machine, memory, (tier.name, name), black_box(draw), HEIGHT);
            for height in STRIPS {
                report(machine, memory, (tier.name, name), black_box(draw), height);
            }
        }
    }
}

/// Rows of the strips that [`run_strips`] is for.
pub const STRIP: u16 = 16;

/// Memory for such a strip: 6 KiB.
pub type StripMemory = Memory<{ WIDTH as usize * STRIP as usize }>;

/// What a machine with little memory draws: scenes that between them clip, divide, light and walk a mesh.
const STRIP_DEMO: [(&str, Draw); 3] = [
    ("user_planes", camera::user_planes::<Exact>),
    ("culled_mesh", camera::culled_mesh::<Exact>),
    ("blinn_phong_per_pixel", lit::blinn_phong_per_pixel::<Exact>),
];

/// Draws some scenes in strips of `height` rows. Lines are called by the scene alone.
pub fn run_strips<const PIXELS: usize>(machine: &mut impl Machine, memory: &mut Memory<PIXELS>, height: u16) {
    for (name, draw) in STRIP_DEMO {
        let drawn = in_strips(machine, memory, black_box(draw), height);
        machine.report(&drawn.line(name));
    }
}

fn report(machine: &mut impl Machine, memory: &mut Memory, (tier, scene): (&str, &str), draw: Draw, height: u16) {
    let mut name = String::<48>::new();
    // Names are constants that fit.
    let _: fmt::Result = match height {
        HEIGHT => write!(name, "{tier}/{scene}"),
        _ => write!(name, "{tier}/{scene}@{height}"),
    };
    let drawn = in_strips(machine, memory, draw, height);
    machine.report(&drawn.line(&name));
}

/// What drawing a picture came to.
#[derive(Default)]
pub struct Drawn {
    /// Of drawing alone.
    pub instructions: u32,
    /// Not black.
    pub pixels: u32,
    /// Of all rows.
    pub color: Crc32,
    /// Of all rows.
    pub depth: Crc32,
}

impl Drawn {
    fn line<'a>(&self, name: &'a str) -> Line<'a> {
        Line {
            name,
            instructions: self.instructions,
            units: self.pixels,
            color: self.color.value(),
            depth: self.depth.value(),
        }
    }
}

/// Draws a picture strip by strip. A scene that cannot be drawn has no pixels, and no checksum that fits.
pub fn in_strips<const PIXELS: usize>(
    machine: &mut impl Machine,
    memory: &mut Memory<PIXELS>,
    draw: Draw,
    height: u16,
) -> Drawn {
    let mut drawn = Drawn::default();
    for top in (0..HEIGHT).step_by(height.max(1).into()) {
        let mut part = memory.cleared(top, top.saturating_add(height).min(HEIGHT));
        let mut done = Ok(());
        drawn.instructions += machine.count(|| done = draw(&mut part));
        if done.is_err() {
            return Drawn::default();
        }
        drawn.pixels += part.colors().iter().filter(|&&pixel| pixel != 0).count() as u32;
        drawn.color.update(part.colors());
        drawn.depth.update(part.depths());
    }
    drawn
}

#[cfg(test)]
mod tests {
    use super::*;

    extern crate std;
    use std::boxed::Box;
    use std::vec::Vec;

    struct Host;

    impl Machine for Host {
        fn count(&mut self, work: impl FnOnce()) -> u32 {
            work();
            0
        }
        fn report(&mut self, _: &Line<'_>) {}
    }

    fn drawn(draw: Draw, height: u16) -> (u32, u32, u32) {
        let drawn = in_strips(&mut Host, &mut Box::new(<Memory>::new()), draw, height);
        (drawn.pixels, drawn.color.value(), drawn.depth.value())
    }

    #[test]
    fn every_scene_shows_something_of_its_own() {
        for tier in &TIERS {
            let mut seen = Vec::new();
            for &(name, draw) in &tier.scenes {
                let (pixels, color, depth) = drawn(draw, HEIGHT);
                assert!(pixels > 90, "{name}: {pixels} pixels");
                assert!(!seen.contains(&(color, depth)), "{name}: as another");
                seen.push((color, depth));
            }
        }
    }

    #[test]
    fn a_tier_is_more_than_a_name() {
        let colors = |tier: &Tier| tier.scenes.map(|(_, draw)| drawn(draw, HEIGHT).1);
        let [fast, balanced, exact] = TIERS.each_ref().map(colors);
        let different = |a: [u32; SCENES], b: [u32; SCENES]| a.iter().zip(b).filter(|(a, b)| **a != *b).count();
        let counts = [
            different(fast, balanced),
            different(balanced, exact),
            different(fast, exact),
        ];
        assert!(counts.iter().all(|&count| count >= 15), "{counts:?}");
    }

    #[test]
    fn strips_equal_the_whole_picture() {
        for &(name, draw) in TIERS.iter().flat_map(|tier| &tier.scenes) {
            for height in STRIPS {
                assert_eq!(drawn(draw, height), drawn(draw, HEIGHT), "{name} in strips of {height}");
            }
        }
    }

    #[test]
    fn a_scene_that_depends_on_its_strip_is_found_out() {
        fn wrong(part: &mut Part<'_>) -> Result<(), Error> {
            let top = part.window().top as i16;
            let mut color = part.color()?;
            fixel::draw::line(&mut color, (0, top), (90, top), &fixel::fragment::Flat(1));
            Ok(())
        }
        assert_ne!(drawn(wrong, 7), drawn(wrong, HEIGHT));
    }
}
