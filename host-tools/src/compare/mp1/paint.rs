//! The fragments that a mark may draw at a sample: colour and alpha to an interval, texel by texel.

use super::mark::{Mark, Paint};
use crate::compare::interval::Interval;
use crate::compare::linear::Range;
use crate::compare::piece::Piece;
use crate::compare::stated::{ALONG, BLENDED, CARRIED_CHANNEL, GRADIENT, INTERPOLATED, PERSPECTIVE, UNITS, WEIGHT};
use crate::compare::texels::Texels;
use crate::picture::Picture;
use crate::reference::attributes::Bounds;
use crate::reference::log::Corner;

/// Red, green, blue, alpha.
pub type Channels = [Interval; 4];

/// A fragment that the core may draw.
#[derive(Debug, Clone, Copy)]
pub struct Fragment {
    /// Where moving the corners by δ may take it.
    pub moved: Channels,
    /// What the core's own arithmetic may make of that.
    pub full: Channels,
    /// Of which texel.
    pub texel: Texel,
}

/// Which texel a fragment has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Texel {
    /// Certainly the reference's, or there is no texture.
    Own,
    /// Perhaps another.
    Other,
    /// Nothing is known: 1/w is within its bound of 0.
    Pole,
}

impl Fragment {
    /// Any colour, any alpha.
    pub const ANYTHING: Self = Self {
        moved: [Interval::ALL, Interval::ALL, Interval::ALL, OPACITY],
        full: [Interval::ALL, Interval::ALL, Interval::ALL, OPACITY],
        texel: Texel::Pole,
    };

    /// Alpha times the covered part of the pixel.
    pub fn fade(&mut self, weight: Interval) {
        let [.., moved] = &mut self.moved;
        *moved = moved.times(weight);
        let [.., full] = &mut self.full;
        // The product is rounded to a unit.
        let product = full.times(weight.widened(WEIGHT * CARRIED_CHANNEL));
        *full = product.widened(CARRIED_CHANNEL / 2.0).clamped(OPACITY);
    }
}

/// What alpha may be.
pub const OPACITY: Interval = Interval { low: 0.0, high: 1.0 };

/// Interpolated values at a sample.
pub struct Values {
    channels: Range<4>,
    texcoord: Range<2>,
    /// The core's error of the texture coordinate by rounding to units, which both of its axes share: before it is interpolated, over
    /// w at the corners, and at each step of what is linear over the screen.
    texel_error: f64,
    /// How far the reference's texture coordinate may be from `texcoord.value`.
    texel_noise: f64,
    unit: f64,
}

fn channels(corner: &Corner) -> [f64; 4] {
    let [r, g, b] = corner.at.color;
    [r, g, b, corner.at.alpha]
}

fn lowering(error: f64) -> f64 {
    UNITS * error
}

impl Values {
    /// Of a triangle; none at a pole.
    pub fn of_piece(piece: &Piece<'_>, p: [f64; 2], mark: &Mark) -> Option<Self> {
        let error = |of: fn(&Bounds) -> f64| lowering(piece.greatest(|c| [of(&c.at_error)]));
        // With w of both signs the corners' shares in a sample are of both signs, and add up to the ratio of the 1/w.
        let shares = if piece.headroom() > 1.0 {
            piece.ratio(p).max(1.0)
        } else {
            1.0
        };
        let units = (piece.columns() + piece.ratio(p) + INTERPOLATED) * mark.headroom;
        let stepped = if mark.linear {
            piece.columns() + INTERPOLATED
        } else {
            0.0
        };
        Some(Self {
            channels: piece.values(p, channels, None, error(|e| e.color) * shares + units * mark.unit)?,
            texcoord: piece.values(p, |c| c.at.texcoord, None, error(|e| e.texcoord))?,
            texel_error: error(|e| e.texcoord) * piece.ratio(p).max(1.0)
                + stepped * piece.greatest(|c| [c.at_error.texcoord]),
            texel_noise: piece.noise(p, |c| c.at.texcoord),
            unit: mark.unit,
        })
    }

    /// Of something with one corner; the texture coordinate moves by `moved`, by `arithmetic` beyond that, and by `noise` in the
    /// reference.
    pub fn constant(corner: &Corner, texcoord: [f64; 2], [moved, arithmetic, noise]: [f64; 3], mark: &Mark) -> Self {
        let by = texcoord.map(|s| Interval::around(s, moved));
        Self {
            channels: Range::constant(channels(corner), lowering(corner.at_error.color)),
            texcoord: Range {
                value: texcoord,
                moved: by,
                full: by.map(|s| s.widened(arithmetic)),
            },
            texel_error: 0.0,
            texel_noise: noise,
            unit: mark.unit,
        }
    }

    /// Between the ends of a line, up to `steps` from its start; none where 1/w passes 0.
    pub fn on_line(ends: &[Corner; 2], part: Interval, steps: f64, mark: &Mark) -> Option<Self> {
        let [a, b] = ends;
        if (a.w < 0.0) != (b.w < 0.0) {
            return None;
        }
        let (near, far) = (1.0 / a.w, 1.0 / b.w);
        let at = |t: f64| {
            let q = near + t * (far - near);
            let (from, to) = (channels(a), channels(b));
            [0, 1, 2, 3].map(|i| (from[i] * near + t * (to[i] * far - from[i] * near)) / q)
        };
        let (low, high) = (at(part.low), at(part.high));
        let middle = at(f64::midpoint(part.low, part.high));
        let moved = [0, 1, 2, 3].map(|i| Interval::of([low[i], high[i]]));
        let ratio = (near / far).abs().max((far / near).abs());
        let largest = Interval::of([a, b].into_iter().flat_map(|c| channels(c).map(f64::abs))).high;
        let arithmetic = lowering(a.at_error.color.max(b.at_error.color))
            + (steps + ratio + ALONG) * mark.unit
            + 2.0 * GRADIENT * largest
            + ratio * (PERSPECTIVE + a.weight_error + b.weight_error) * largest;
        Some(Self {
            channels: Range {
                value: middle,
                moved,
                full: moved.map(|m| m.widened(arithmetic)),
            },
            texcoord: Range::constant([0.0; 2], 0.0),
            texel_error: 0.0,
            texel_noise: 0.0,
            unit: mark.unit,
        })
    }
}

/// The fragments that a paint may make of values.
pub fn fragments(paint: &Paint, values: &Values) -> Vec<Fragment> {
    let channels = &values.channels;
    // What the core cannot hold saturates, which only extrapolation next to a pole leads to.
    let carried = channels.full.map(|c| c.clamped(largest(values.unit)));
    let own = Fragment {
        moved: opacity(channels.moved),
        full: opacity(carried),
        texel: if carried == channels.full {
            Texel::Own
        } else {
            Texel::Pole
        },
    };
    match paint {
        Paint::Colors => vec![own],
        Paint::Texture(texture) => textured(texture, values, None),
        Paint::Decal(texture) => textured(texture, values, Some(&own)),
    }
}

/// A channel in 32 bits.
fn largest(unit: f64) -> Interval {
    Interval::around(0.0, f64::from(i32::MAX) * unit)
}

/// More texels than these are taken together.
const FEW: usize = 12;

fn textured(texture: &Picture, values: &Values, below: Option<&Fragment>) -> Vec<Fragment> {
    // Cut towards zero (formats/mp1.md section 5).
    let errors = [values.texel_error, values.texel_noise];
    let texels = Texels::new(texture, &values.texcoord, errors, f64::trunc);
    let mut all: Vec<Fragment> = Vec::new();
    for (texel, own) in texels.all() {
        let color = texel.map(|level| Interval::around(f64::from(level) / 255.0, 0.0));
        let top = Fragment {
            moved: color,
            full: [0, 1, 2, 3].map(|i| {
                let unit = if i < 3 { values.unit } else { CARRIED_CHANNEL };
                color[i].widened(unit / 2.0)
            }),
            texel: if own { Texel::Own } else { Texel::Other },
        };
        let fragment = match below {
            None => top,
            Some(below) => Fragment {
                moved: over(&top.moved, &below.moved, 0.0),
                full: over(&top.full, &below.full, values.unit),
                texel: if below.texel == Texel::Pole {
                    Texel::Pole
                } else {
                    top.texel
                },
            },
        };
        if all.len() < FEW {
            all.push(fragment);
        } else if let Some(last) = all.last_mut() {
            *last = Fragment {
                moved: joined(&last.moved, &fragment.moved),
                full: joined(&last.full, &fragment.full),
                texel: Texel::Other,
            };
        }
    }
    all
}

fn opacity(mut channels: Channels) -> Channels {
    channels[3] = channels[3].clamped(OPACITY);
    channels
}

/// The least channels that hold both.
pub fn joined(a: &Channels, b: &Channels) -> Channels {
    [0, 1, 2, 3].map(|i| a[i].join(b[i]))
}

/// *Over* (formats/mp1.md section 5): what it may be of two layers, with the core's own error for colours
/// in units of `unit`, or with none if that is 0.
pub fn over(top: &Channels, below: &Channels, unit: f64) -> Channels {
    let (at, ab) = (top[3], below[3]);
    // The upper layer's weight grows with its alpha and falls with the lower one's.
    let weight = |at: f64, ab: f64| {
        let alpha = at + ab * (1.0 - at);
        if alpha > 0.0 { at / alpha } else { f64::NAN }
    };
    let weights = Interval::of([weight(at.low, ab.high), weight(at.high, ab.low)]).clamped(OPACITY);
    let sum = |at: f64, ab: f64| at + ab * (1.0 - at);
    let alpha = Interval::of([sum(at.low, ab.low), sum(at.high, ab.high)])
        .widened(if unit > 0.0 { CARRIED_CHANNEL / 2.0 } else { 0.0 })
        .clamped(OPACITY);
    let color = |i: usize| {
        if at.high <= 0.0 && ab.high <= 0.0 {
            return Interval::ZERO;
        }
        let mix = |top: f64, below: f64| {
            let at = |w: f64| {
                let part = |weight: f64, c: f64| if weight == 0.0 { 0.0 } else { weight * c };
                part(w, top) + part(1.0 - w, below)
            };
            [at(weights.low), at(weights.high)]
        };
        let ends = [(top[i].low, below[i].low), (top[i].high, below[i].high)];
        let both = top[i].join(below[i]);
        let error = if unit > 0.0 {
            unit / 2.0 + BLENDED * (both.high - both.low)
        } else {
            0.0
        };
        let mixed = Interval::of(ends.into_iter().flat_map(|(t, b)| mix(t, b))).widened(error);
        // Where nothing may be there at all, colour is 0.
        if at.low <= 0.0 && ab.low <= 0.0 {
            mixed.join(Interval::ZERO)
        } else {
            mixed
        }
    };
    [color(0), color(1), color(2), alpha]
}
