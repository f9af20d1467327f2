//! Colours for RGB565 targets: two channels a word.

use super::{Varying, each, lay};
use crate::gradient::{Basis, Place, Plane, Ramp};
use crate::slope::{Slope, Slopes, SmallWeights, Weights};

/// A colour for RGB565 targets, linear over the screen: red and blue in units of 2^-16 of 0…31, green of 0…63, each with
/// the half that makes cutting off round to nearest, so within 0.5…31.5 and 0.5…63.5.
/// [`Gouraud565::corner`](crate::fragment::Gouraud565::corner) makes it.
///
/// Two words are stepped for the three channels, which do not touch each other as long as the colours are in range.
///
/// **Error**: at most half a level before rounding, so that a stored channel is within one level of the exact value, over
/// triangles of any size; over polygons of more corners on spans of up to 1024 px, and 2^-11 level more for every further
/// pixel (`tests/narrow.rs`).
///
/// ```
/// use fixel::{fragment::Gouraud565, varying::Color565};
/// assert_eq!(Gouraud565::corner(255, 0, 255), Color565([0x1f_8000, 0x8000, 0x1f_8000]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Color565(pub [i32; 3]);

/// Blue in the upper half, red in the lower, each 5 bits and 11 of fraction; `red` and `blue` in 2^-16.
#[inline(always)]
fn pair(red: i32, blue: i32) -> i32 {
    (blue << 16).wrapping_add(red)
}

/// The slopes of a [`Color565`], in packed words.
#[derive(Debug, Clone, Copy)]
pub struct Color565Slopes {
    pair: Slope,
    green: Slope,
}

/// The ramps of a [`Color565`].
#[derive(Debug, Clone, Copy)]
pub struct Color565Ramps {
    pair: Ramp<i32>,
    green: Ramp<i32>,
}

/// What a pixel gets of a [`Color565`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Packed565 {
    pair: u32,
    green: u32,
}

impl Packed565 {
    /// The nearest RGB565 colour.
    #[inline(always)]
    pub fn pixel(self) -> u16 {
        (self.pair & 0xf800 | self.pair >> 27 | self.green >> 16 << 5) as u16
    }

    /// Red, green and blue in the units of a [`Color565`], before they are cut off; red and blue are whole 2^-11 levels.
    #[inline]
    pub fn levels(self) -> [i32; 3] {
        [self.pair << 16 >> 11, self.green, self.pair >> 16 << 5].map(|v| v as i32)
    }
}

impl Color565Ramps {
    #[inline(always)]
    fn values(&self) -> Packed565 {
        Packed565 {
            pair: self.pair.value as u32,
            green: self.green.value as u32,
        }
    }
}

impl Slopes<Color565> for Color565Slopes {
    #[inline(always)]
    fn new(weights: &Weights, [Color565(a), Color565(b), Color565(c)]: [Color565; 3]) -> Option<Self> {
        let ([ra, ga, ba], [rb, gb, bb], [rc, gc, bc]) = (a, b, c);
        // At the anchor, where they fit their halves.
        let (red, blue) = (weights.anchored([ra, rb, rc]), weights.anchored([ba, bb, bc]));
        // To the nearest 2^-11: over 1024 rows and columns a quarter of a level. Wrapping: of weights that are none, anything.
        let both = |red: i32, blue: i32| pair(red.wrapping_add(16) >> 5, blue.wrapping_add(16) >> 5);
        Some(Color565Slopes {
            pair: weights.at_origin(Slope {
                value: both(red.value, blue.value),
                x: both(red.x, blue.x),
                y: both(red.y, blue.y),
            }),
            green: weights.slope([ga, gb, gc]),
        })
    }
    /// In 2^-11 level, cut down: over 32 rows and columns less than a 64th of a level (`tests/small.rs`).
    #[inline(always)]
    fn small(weights: &SmallWeights, [Color565(a), Color565(b), Color565(c)]: [Color565; 3]) -> Option<Self> {
        let ([ra, ga, ba], [rb, gb, bb], [rc, gc, bc]) = (a, b, c);
        let (red, blue) = (weights.short::<7>([ra, rb, rc]), weights.short::<7>([ba, bb, bc]));
        let green = weights.short::<8>([ga, gb, gc]);
        Some(Color565Slopes {
            pair: Slope {
                value: pair(red.value, blue.value),
                x: pair(red.x, blue.x),
                y: pair(red.y, blue.y),
            },
            green: Slope {
                value: green.value << 5,
                x: green.x << 5,
                y: green.y << 5,
            },
        })
    }
    #[inline(always)]
    fn ramps(&self, place: (i32, i32)) -> Color565Ramps {
        Color565Ramps {
            pair: self.pair.ramp(place),
            green: self.green.ramp(place),
        }
    }
    #[inline(always)]
    fn values(&self, ramps: &Color565Ramps) -> Packed565 {
        ramps.values()
    }
}

impl Varying for Color565 {
    type Planes = [Plane; 3];
    type Slopes = Color565Slopes;
    type Ramps = Color565Ramps;
    type Values = Packed565;

    const NO_PLANES: [Plane; 3] = [Plane::NONE; 3];

    #[inline]
    fn lay(planes: &mut [Plane; 3], basis: &Basis, count: usize, corner: impl Fn(usize) -> Self) {
        lay(planes, basis, count, |i| corner(i).0);
    }
    #[inline]
    fn ramps(planes: &[Plane; 3], place: &Place) -> Color565Ramps {
        let (place, skipped) = place.whole();
        // Cut towards zero as the planes' own steps are: the last pixel stays in range like the first.
        let [red, green, blue] = each(planes, |plane| plane.ramp(&place));
        let mut ramps = Color565Ramps {
            pair: Ramp {
                value: pair(red.value >> 5, blue.value >> 5),
                step: pair(red.step / 32, blue.step / 32),
            },
            green,
        };
        Self::advance_by(&mut ramps, skipped);
        ramps
    }
    #[inline(always)]
    fn values(_: &[Plane; 3], ramps: &Color565Ramps) -> Packed565 {
        ramps.values()
    }
    #[inline(always)]
    fn advance(ramps: &mut Color565Ramps) {
        ramps.pair.advance();
        ramps.green.advance();
    }
    #[inline(always)]
    fn advance_by(ramps: &mut Color565Ramps, count: i32) {
        ramps.pair = ramps.pair.after(count);
        ramps.green = ramps.green.after(count);
    }
}
