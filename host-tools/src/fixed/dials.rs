//! Dials: where a picture may do without some of the core's accuracy, for the sake of speed. Tiers set all of them at once.
//!
//! A dial is turned by picking other types of the core. Coverage is exact in every tier: no dial moves an edge. Depth is within
//! a step of that of exact, as it may be interpolated in words of 32 bits, too.

use std::fmt;

use clap::ValueEnum;
use fixel::num::Word;

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
    /// Divided at the ends of subspans, so that texture coordinates are within an eighth of a texel more and colours within an
    /// eighth of a level, in words of 32 bits.
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

/// The dials. By default they are set as for [`Tier::Exact`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Dials {
    /// Of values in perspective.
    pub perspective: Perspective,
    /// Where light is computed.
    pub lighting: Lighting,
    /// Whether sRGB colours are blended as they are stored, without being decoded and encoded again.
    pub stored_light: bool,
}

/// A dial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dial {
    /// [`Dials::perspective`].
    Perspective,
    /// [`Dials::lighting`].
    Lighting,
    /// [`Dials::stored_light`].
    StoredLight,
}

impl Dial {
    /// All of them.
    pub const ALL: [Dial; 3] = [Dial::Perspective, Dial::Lighting, Dial::StoredLight];
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
pub const CHANGES: [Change; 5] = [
    Change {
        name: "perspective=32-bit",
        dial: Dial::Perspective,
        set: |dials| dials.perspective = Perspective::Narrow,
    },
    Change {
        name: "perspective=spans",
        dial: Dial::Perspective,
        set: |dials| dials.perspective = Perspective::Spans,
    },
    Change {
        name: "perspective=affine",
        dial: Dial::Perspective,
        set: |dials| dials.perspective = Perspective::Affine,
    },
    Change {
        name: "lighting=vertex",
        dial: Dial::Lighting,
        set: |dials| dials.lighting = Lighting::Vertex,
    },
    Change {
        name: "linear-light=off",
        dial: Dial::StoredLight,
        set: |dials| dials.stored_light = true,
    },
];

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
    /// The dials of a tier.
    pub fn of(tier: Tier) -> Self {
        match tier {
            Tier::Exact => Dials::default(),
            Tier::Balanced => Dials {
                perspective: Perspective::Narrow,
                ..Dials::default()
            },
            Tier::Fast => Dials {
                perspective: Perspective::Spans,
                lighting: Lighting::Vertex,
                stored_light: true,
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
            Dial::Lighting => self.lighting = exact.lighting,
            Dial::StoredLight => self.stored_light = exact.stored_light,
        }
        self
    }

    /// Refuses pictures that are too large for a tier other than exact.
    ///
    /// # Errors
    /// A fault of the whole scene.
    pub fn check(self, scene: &Scene) -> Result<(), Fault> {
        let fsaa = match scene {
            Scene::Mp1(scene) => scene.switches.fsaa,
            Scene::Hw2(_) | Scene::Iv(_) => 1,
        };
        let (width, height) = scene.size();
        let side = width.max(height) * fsaa;
        if self.are_exact() || side <= LARGEST {
            return Ok(());
        }
        Err(Fault::of_whole(format!(
            "{side} samples a side: with a quality other than exact there are at most {LARGEST}"
        )))
    }
}
