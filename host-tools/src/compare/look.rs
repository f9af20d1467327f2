//! What a format's materials say of a colour at a sample.

use std::cmp::Reverse;

use super::piece::Piece;
use super::shape::Shape;

/// Whether a colour can be a surface's; the better, the greater.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// It cannot.
    Differs,
    /// Only by a steep power's error, or if a light is switched.
    Steep,
    /// 1/w is within its bound of 0: it may be anything.
    Pole,
    /// It is that of another texel within reach.
    Texel,
    /// It is. The number is how many levels it lies beyond what moving the corners by δ makes of the value.
    Colour(Reverse<u8>),
}

/// A sample, and what to look for.
#[derive(Debug, Clone, Copy)]
pub struct Sight {
    /// The sample in px.
    pub sample: [f64; 2],
    /// The core's red, green and blue.
    pub fixed: [u8; 3],
    /// The reference's own unrounded colour, if it is the same surface's.
    pub known: Option<[f64; 3]>,
}

/// What primitives are painted with.
pub trait Look {
    /// Whether anything of it changes from fragment to fragment.
    fn varies(&self) -> bool;

    /// Whether the core may have given a sample of the piece its colour.
    fn verdict(&self, piece: &Piece<'_>, sight: &Sight) -> Verdict;
}

/// A shape and what it is painted with.
pub struct Painted<'a, M> {
    /// Where it is.
    pub shape: Shape<'a>,
    /// Its material.
    pub material: &'a M,
}

impl<M: Look> Painted<'_, M> {
    /// Whether the core may have given a sample its colour.
    pub fn verdict(&self, sight: &Sight) -> Verdict {
        if self.shape.outline.wild && self.material.varies() {
            return Verdict::Pole;
        }
        let verdicts = (self.shape.near(sight.sample)).map(|piece| self.material.verdict(piece, sight));
        verdicts.max().unwrap_or(Verdict::Differs)
    }
}
