//! Which class a differing pixel belongs to (see [`Class`]), told from the float64 scene alone.

use std::cmp::Reverse;

use super::look::{Look, Painted, Sight, Verdict};
use super::shape::{Claim, Coverage};
use super::{Class, picture};
use crate::reference;

/// One differing pixel.
pub struct Case<'a> {
    /// The sample, in px.
    pub sample: [f64; 2],
    /// The core's pixel.
    pub fixed: &'a picture::Pixel,
    /// The reference's pixel.
    pub reference: &'a reference::Pixel,
}

impl Case<'_> {
    /// The class if both pictures have the same winner, whose shapes these are: *colour*, *texel*, *pole*, *steep* or unexplained;
    /// and of class *colour* how many levels the pixel is beyond what moving the corners by δ makes of the value.
    pub fn same_winner<M: Look>(&self, own: &[Painted<'_, M>]) -> (Class, u8) {
        let present: Vec<&Painted<'_, M>> = (own.iter())
            .filter(|painted| painted.shape.claim(self.sample).is_some())
            .collect();
        let [r, g, b, _] = self.reference.color;
        // With one shape the reference's value is its; of several it is not known which won.
        let known = (present.len() == 1).then_some([r, g, b]);
        let best = present.iter().map(|painted| self.verdict(painted, known)).max();
        let class = match best.unwrap_or(Verdict::Differs) {
            Verdict::Colour(Reverse(beyond)) => return (Class::Colour, beyond),
            Verdict::Texel => Class::Texel,
            Verdict::Pole => Class::Pole,
            Verdict::Steep => Class::Steep,
            Verdict::Differs => Class::Unexplained,
        };
        (class, 0)
    }

    /// The class if the winners differ, given every shape that may touch the pixel, in any order: *edge*, *depth*, *pole* or
    /// unexplained.
    ///
    /// The core's winner is possible if nothing that certainly covers the sample lies certainly in front of it. Which of
    /// two came later does not matter: where depths may be equal, either may be in front.
    pub fn other_winner<'s, 'p: 's, M: Look + 'p>(&self, near: impl Iterator<Item = &'s Painted<'p, M>>) -> Class {
        let claims: Vec<(&Painted<'_, M>, Claim)> = near
            .filter_map(|painted| Some((painted, painted.shape.claim(self.sample)?)))
            .collect();
        let certain = |claim: &Claim| claim.coverage == Coverage::Certain;
        let of = |primitive: u32| {
            let number = move |painted: &Painted<'_, M>| painted.shape.outline.primitive == primitive;
            claims.iter().filter(move |(painted, _)| number(painted))
        };
        if self.fixed.primitive == 0 {
            let empty = self.fixed.rgba == [0; 4] && !claims.iter().any(|(_, c)| certain(c));
            return if empty { Class::Edge } else { Class::Unexplained };
        }
        let reference_certain = of(self.reference.primitive).any(|(_, claim)| certain(claim));
        let hidden =
            |claim: &Claim| (claims.iter()).any(|(_, other)| certain(other) && other.depth.high < claim.depth.low);
        let mut class = Class::Unexplained;
        for (painted, claim) in of(self.fixed.primitive).filter(|(_, claim)| !hidden(claim)) {
            let explained = if !certain(claim) || self.reference.primitive != 0 && !reference_certain {
                Class::Edge
            } else if reference_certain {
                Class::Depth
            } else {
                continue;
            };
            match self.verdict(painted, None) {
                Verdict::Colour(_) | Verdict::Texel | Verdict::Steep => return explained,
                Verdict::Pole => class = Class::Pole,
                Verdict::Differs => {}
            }
        }
        class
    }

    fn verdict<M: Look>(&self, painted: &Painted<'_, M>, known: Option<[f64; 3]>) -> Verdict {
        let [r, g, b, alpha] = self.fixed.rgba;
        let sight = Sight {
            sample: self.sample,
            fixed: [r, g, b],
            known,
        };
        if alpha == 255 {
            painted.verdict(&sight)
        } else {
            Verdict::Differs
        }
    }
}
