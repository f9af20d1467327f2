//! Dials: where a picture may do without some of the core's accuracy, for the sake of speed. Tiers set all of them at once.
//!
//! A dial is turned by picking other types of the core. The tiers are those of [`fixel::quality`], but for one thing: the host's
//! picture has bytes, so that the tiers' [`Quality::Color`](fixel::quality::Quality::Color), which is for RGB565 targets, is a
//! dial of its own here. Coverage is exact whatever the dials, of the corners that there are; that of trigonometry alone moves
//! corners. Depth is within a step of that of exact, as it may be interpolated in words of 32 bits, too.

use std::fmt;

use clap::ValueEnum;
use fixel::error::Error;
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Angle, Block, ShortSine, SineTable, Word};

use super::output::Output;
use crate::scene::{Fault, Scene};

/// All dials set at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Tier {
    /// As cheap as it gets
    Fast,
    /// What is lost is hard to see
    Balanced,
    /// Within the stated bounds of float64
    Exact,
}

impl fmt::Display for Tier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Tier::Fast => "fast",
            Tier::Balanced => "balanced",
            Tier::Exact => "exact",
        })
    }
}

/// How values in perspective come to the pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Perspective {
    /// Divided at every pixel, in words of 64 bits.
    #[default]
    Exact,
    /// Divided at every pixel, in words of 32 bits.
    Narrow,
    /// By a reciprocal from a table of 1024 at every pixel, or linear where that is within an eighth of a texel or of a level, in
    /// words of 32 bits.
    Spans,
    /// Linear over the screen: right where all corners are equally far away.
    Affine,
}

/// Where light is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Lighting {
    /// At every pixel.
    #[default]
    Pixel,
    /// At the corners, and interpolated: highlights between them are lost, and those of a textured surface take on the
    /// texture's colour.
    Vertex,
}

/// How lights compute directions and powers: see [`fixel::num::Precision`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// [`fixel::num::TwoSteps`].
    #[default]
    TwoSteps,
    /// [`fixel::num::OneStep`].
    OneStep,
    /// [`fixel::num::Table`].
    Table,
}

/// Where rotations get sine and cosine from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Trigonometry {
    /// [`SineTable`]: words of 64 bits and a polynomial.
    #[default]
    Long,
    /// [`ShortSine`]: entries of 16 bits and a straight line.
    Short,
}

impl Trigonometry {
    /// [`Matrix::rotation`].
    ///
    /// # Errors
    /// Those.
    pub fn rotation(self, angle: Angle, axis: Block<i64, 3>) -> Result<Matrix<i64>, Error> {
        match self {
            Trigonometry::Long => Matrix::rotation::<SineTable>(angle, axis),
            Trigonometry::Short => Matrix::rotation::<ShortSine>(angle, axis),
        }
    }

    /// [`Matrix::camera`].
    ///
    /// # Errors
    /// Those.
    pub fn camera(self, position: Block<i64, 3>, axis: Block<i64, 3>, angle: Angle) -> Result<Matrix<i64>, Error> {
        match self {
            Trigonometry::Long => Matrix::camera::<SineTable>(position, axis, angle),
            Trigonometry::Short => Matrix::camera::<ShortSine>(position, axis, angle),
        }
    }

    /// [`Directions::rotate`].
    ///
    /// # Errors
    /// Those.
    pub fn rotate(self, directions: &mut Directions<i64>, angle: Angle, axis: Block<i64, 3>) -> Result<(), Error> {
        match self {
            Trigonometry::Long => directions.rotate::<SineTable>(angle, axis),
            Trigonometry::Short => directions.rotate::<ShortSine>(angle, axis),
        }
    }
}

/// How colours that are linear over the screen come to the pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Colors {
    /// [`fixel::varying::Linear`]: a word a channel, kept within the corners'.
    #[default]
    Exact,
    /// [`fixel::varying::Linear32`]: a word a channel, by slopes.
    Narrow,
    /// [`fixel::varying::Color565`]: two channels a word, for RGB565 targets.
    Packed,
}

/// How texels make a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sampling {
    /// The texel in which the place lies, as the formats want it.
    #[default]
    Nearest,
    /// The four texels around it.
    Linear,
}

/// The dials. By default they are set as for [`Tier::Exact`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Dials {
    /// Of values in perspective.
    pub perspective: Perspective,
    /// Of lights.
    pub precision: Precision,
    /// Of rotations.
    pub trigonometry: Trigonometry,
    /// Where light is computed.
    pub lighting: Lighting,
    /// Of colours that are linear over the screen.
    pub colors: Colors,
    /// Of textures.
    pub sampling: Sampling,
    /// Whether there is no depth buffer, of a scene that asks for one; with values in perspective as for [`Tier::Exact`].
    pub no_depth: bool,
    /// Whether sRGB colours are blended as they are stored, without being decoded and encoded again.
    pub stored_light: bool,
    /// What the picture is shown on. Drawing does not ask for it: see [`Output::words`].
    pub output: Output,
}

/// A dial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dial {
    /// [`Dials::perspective`].
    Perspective,
    /// [`Dials::precision`].
    Precision,
    /// [`Dials::trigonometry`].
    Trigonometry,
    /// [`Dials::lighting`].
    Lighting,
    /// [`Dials::colors`].
    Colors,
    /// [`Dials::sampling`].
    Sampling,
    /// [`Dials::no_depth`].
    Depth,
    /// [`Dials::stored_light`].
    StoredLight,
    /// [`Dials::output`].
    Output,
}

impl Dial {
    /// All of them.
    pub const ALL: [Dial; 9] = [
        Dial::Perspective,
        Dial::Precision,
        Dial::Trigonometry,
        Dial::Lighting,
        Dial::Colors,
        Dial::Sampling,
        Dial::Depth,
        Dial::StoredLight,
        Dial::Output,
    ];
}

/// A dial turned away from where it is for [`Tier::Exact`].
pub struct Change {
    /// The dial and its setting, as reports call them.
    pub name: &'static str,
    /// The dial.
    pub dial: Dial,
    set: fn(&mut Dials),
}

/// All settings of single dials.
pub const CHANGES: [Change; 15] = [
    change("perspective=32-bit", Dial::Perspective, |d| {
        d.perspective = Perspective::Narrow
    }),
    change("perspective=spans", Dial::Perspective, |d| {
        d.perspective = Perspective::Spans
    }),
    change("perspective=affine", Dial::Perspective, |d| {
        d.perspective = Perspective::Affine
    }),
    change("precision=one-step", Dial::Precision, |d| {
        d.precision = Precision::OneStep
    }),
    change("precision=table", Dial::Precision, |d| d.precision = Precision::Table),
    change("trigonometry=short", Dial::Trigonometry, |d| {
        d.trigonometry = Trigonometry::Short
    }),
    change("lighting=vertex", Dial::Lighting, |d| d.lighting = Lighting::Vertex),
    change("colors=32-bit", Dial::Colors, |d| d.colors = Colors::Narrow),
    change("colors=packed", Dial::Colors, |d| d.colors = Colors::Packed),
    change("sampling=linear", Dial::Sampling, |d| d.sampling = Sampling::Linear),
    change("depth=off", Dial::Depth, |d| d.no_depth = true),
    change("linear-light=off", Dial::StoredLight, |d| d.stored_light = true),
    change("output=565", Dial::Output, |d| d.output = Output::Rgb565),
    change("output=565-dither", Dial::Output, |d| d.output = Output::Dithered565),
    change("output=1-bit", Dial::Output, |d| d.output = Output::OneBit),
];

const fn change(name: &'static str, dial: Dial, set: fn(&mut Dials)) -> Change {
    Change { name, dial, set }
}

impl Change {
    /// The dials with this one turned.
    pub fn of(&self, mut dials: Dials) -> Dials {
        (self.set)(&mut dials);
        dials
    }
}

/// The largest side of a picture in samples for which there are tiers other than exact: edges of 32 bits.
pub const LARGEST: u32 = <i32 as Word>::GUARD as u32;

impl Dials {
    /// The dials of a tier: those of the core's [`Fast`](fixel::quality::Fast), [`Balanced`](fixel::quality::Balanced) and
    /// [`Exact`](fixel::quality::Exact).
    pub fn of(tier: Tier) -> Self {
        match tier {
            Tier::Exact => Dials::default(),
            Tier::Balanced => Dials {
                perspective: Perspective::Narrow,
                precision: Precision::OneStep,
                ..Dials::default()
            },
            Tier::Fast => Dials {
                perspective: Perspective::Spans,
                precision: Precision::Table,
                trigonometry: Trigonometry::Short,
                ..Dials::default()
            },
        }
    }

    /// Whether they are those of [`Tier::Exact`].
    pub fn are_exact(self) -> bool {
        self == Dials::default()
    }

    /// With one of them as for [`Tier::Exact`].
    pub fn without(mut self, dial: Dial) -> Self {
        let exact = Dials::default();
        match dial {
            Dial::Perspective => self.perspective = exact.perspective,
            Dial::Precision => self.precision = exact.precision,
            Dial::Trigonometry => self.trigonometry = exact.trigonometry,
            Dial::Lighting => self.lighting = exact.lighting,
            Dial::Colors => self.colors = exact.colors,
            Dial::Sampling => self.sampling = exact.sampling,
            Dial::Depth => self.no_depth = exact.no_depth,
            Dial::StoredLight => self.stored_light = exact.stored_light,
            Dial::Output => self.output = exact.output,
        }
        self
    }

    /// Refuses pictures that are too large for a tier other than exact.
    ///
    /// # Errors
    /// A fault of the whole scene.
    pub fn check(self, scene: &Scene) -> Result<(), Fault> {
        self.fit(scene, "a quality other than exact").map_err(Fault::of_whole)
    }

    /// As [`check`](Self::check), in words of `what` asked for these dials.
    ///
    /// # Errors
    /// What is wrong, without the scene's name.
    pub fn fit(self, scene: &Scene, what: impl fmt::Display) -> Result<(), String> {
        let (width, height) = scene.size();
        let side = width.max(height) * scene.fsaa();
        if self.are_exact() || side <= LARGEST {
            return Ok(());
        }
        Err(format!(
            "{side} samples a side are too many for {what}: it takes at most {LARGEST}"
        ))
    }
}
