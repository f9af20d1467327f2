//! What a pixel may be of what its samples may hold (formats/mp1.md section 6).

use super::layers::{Decisions, State};
use super::paint::{Channels, OPACITY, joined};
use crate::compare::interval::Interval;
use crate::compare::stated::{CARRIED_CHANNEL, ENCODED, LEVEL_ROUNDING, RESOLVED};
use crate::reference::mp1::color::encode;

/// What a pixel may be, in levels of 255, encoded but not cut off.
pub struct Outcome {
    /// Where moving the corners by δ may take it.
    pub moved: Channels,
    /// What the core's own arithmetic may make of that.
    pub full: Channels,
    /// What led here.
    pub decisions: Decisions,
    /// Whether several ways to go are taken together.
    pub merged: bool,
}

/// Sums over samples: of alpha, and of alpha times the colour's distance from a middle, so that where all colours are the same
/// an uncertain alpha does not matter.
#[derive(Clone, Copy)]
struct Sums {
    moved: Channels,
    full: Channels,
    /// Of the samples' colours, as far as they may have alpha: the mean lies in it.
    moved_range: Colors,
    full_range: Colors,
    decisions: Decisions,
    merged: bool,
}

type Colors = [Interval; 3];

/// Of no samples at all.
const NOTHING: Interval = Interval {
    low: f64::INFINITY,
    high: f64::NEG_INFINITY,
};

/// More sums than these are taken together by what led to them.
const MANY: usize = 64;

/// The outcomes of a pixel whose samples have these states; `middle` is a linear colour near what is expected.
/// Channels are in the core's `unit`.
pub fn outcomes(samples: &[Vec<State>], middle: [f64; 3], unit: f64, srgb: bool) -> Vec<Outcome> {
    if let [states] = samples {
        let outcome = |state: &State| Outcome {
            moved: levels(&state.moved, srgb, false),
            full: levels(&state.full, srgb, true),
            decisions: state.decisions,
            merged: state.merged,
        };
        return states.iter().map(outcome).collect();
    }
    let count = samples.len() as f64;
    let mut sums = vec![Sums {
        moved: [Interval::ZERO; 4],
        full: [Interval::ZERO; 4],
        moved_range: [NOTHING; 3],
        full_range: [NOTHING; 3],
        decisions: State::EMPTY.decisions,
        merged: false,
    }];
    for states in samples {
        let added = sums
            .iter()
            .flat_map(|sum| states.iter().map(|state| sum.plus(state, middle)));
        let next: Vec<Sums> = added.collect();
        sums = if next.len() > MANY { together(next) } else { next };
    }
    let outcome = |sum: &Sums| Outcome {
        moved: levels(&mean(&sum.moved, &sum.moved_range, middle, count, 0.0), srgb, false),
        full: levels(&mean(&sum.full, &sum.full_range, middle, count, unit), srgb, true),
        decisions: sum.decisions,
        merged: sum.merged,
    };
    sums.iter().map(outcome).collect()
}

impl Sums {
    fn plus(&self, state: &State, middle: [f64; 3]) -> Self {
        Self {
            moved: added(&self.moved, &state.moved, middle),
            full: added(&self.full, &state.full, middle),
            moved_range: ranges(&self.moved_range, &state.moved),
            full_range: ranges(&self.full_range, &state.full),
            decisions: self.decisions.and(state.decisions),
            merged: self.merged || state.merged,
        }
    }
}

fn added(sums: &Channels, sample: &Channels, middle: [f64; 3]) -> Channels {
    let alpha = sample[3];
    let weighted = |i: usize| sample[i].plus(Interval::around(-middle[i], 0.0)).times(alpha);
    [0, 1, 2, 3].map(|i| sums[i].plus(if i < 3 { weighted(i) } else { alpha }))
}

fn ranges(ranges: &Colors, sample: &Channels) -> Colors {
    let [r, g, b, alpha] = *sample;
    let colors = [r, g, b];
    [0, 1, 2].map(|i| {
        if alpha.high > 0.0 {
            ranges[i].join(colors[i])
        } else {
            ranges[i]
        }
    })
}

/// Means of `count` samples whose colours lie in `ranges`; with the core's own error for colours in units of `unit`, or with none if
/// that is 0.
fn mean(sums: &Channels, ranges: &Colors, middle: [f64; 3], count: f64, unit: f64) -> Channels {
    let alpha = sums[3];
    let color = |i: usize| {
        let sum = sums[i];
        if alpha.high <= 0.0 {
            return Interval::ZERO;
        }
        if alpha.low <= 0.0 {
            // There may be nothing at all, or next to nothing of any of the colours.
            return ranges[i].join(Interval::ZERO);
        }
        let quotients = [
            sum.low / alpha.low,
            sum.low / alpha.high,
            sum.high / alpha.low,
            sum.high / alpha.high,
        ];
        let mean = Interval::of(quotients).plus(Interval::around(middle[i], 0.0));
        let error = if unit > 0.0 {
            unit / 2.0 + RESOLVED * (ranges[i].high - ranges[i].low)
        } else {
            0.0
        };
        mean.widened(error).clamped(ranges[i])
    };
    let rounding = if unit > 0.0 { CARRIED_CHANNEL / 2.0 } else { 0.0 };
    let alpha = Interval {
        low: alpha.low / count,
        high: alpha.high / count,
    };
    [color(0), color(1), color(2), alpha.widened(rounding).clamped(OPACITY)]
}

fn together(mut sums: Vec<Sums>) -> Vec<Sums> {
    sums.sort_by_key(|sum| sum.decisions);
    let mut merged: Vec<Sums> = Vec::new();
    for sum in sums {
        match merged.last_mut() {
            Some(last) if last.decisions == sum.decisions => {
                last.moved = joined(&last.moved, &sum.moved);
                last.full = joined(&last.full, &sum.full);
                last.merged = true;
                last.moved_range = [0, 1, 2].map(|i| last.moved_range[i].join(sum.moved_range[i]));
                last.full_range = [0, 1, 2].map(|i| last.full_range[i].join(sum.full_range[i]));
            }
            _ => merged.push(sum),
        }
    }
    merged
}

/// In levels of 255; float64 rounds its own by some 10⁻¹², and the core, if it is its values', rounds or encodes.
fn levels(channels: &Channels, srgb: bool, core: bool) -> Channels {
    const FLOAT: f64 = 1e-9;
    let plain = |c: Interval| {
        let [low, high] = [c.low, c.high].map(|v| 255.0 * v);
        let error = FLOAT + if core { LEVEL_ROUNDING } else { 0.0 };
        Interval { low, high }.widened(error)
    };
    let encoded = |c: Interval| {
        let [low, high] = [c.low, c.high].map(|v| 255.0 * encode(v));
        let high = high + if core { ENCODED } else { 0.0 };
        Interval { low, high }.widened(FLOAT)
    };
    let [r, g, b, alpha] = *channels;
    let [r, g, b] = [r, g, b].map(|c| if srgb { encoded(c) } else { plain(c) });
    [r, g, b, plain(alpha)]
}
