//! What a sample may hold after all marks: every way that the uncertain decisions may go.

use super::event::Event;
use super::paint::{Channels, Texel, joined, over};
use crate::compare::interval::Interval;
use crate::compare::shape::Coverage;

/// Which uncertain decisions led to a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Decisions {
    /// 1/w within its bound of 0.
    pub pole: bool,
    /// Perhaps another texel than the reference's.
    pub texel: bool,
    /// Which of two depths is nearer.
    pub depth: bool,
    /// Whether a mark covers the sample, and with which triangle of its fan.
    pub edge: bool,
}

impl Decisions {
    /// Those of both.
    pub fn and(self, other: Self) -> Self {
        Self {
            pole: self.pole || other.pole,
            texel: self.texel || other.texel,
            depth: self.depth || other.depth,
            edge: self.edge || other.edge,
        }
    }
}

/// What a sample may hold.
#[derive(Debug, Clone, Copy)]
pub struct State {
    /// Where moving the corners by δ may take it.
    pub moved: Channels,
    /// What the core's own arithmetic may make of that.
    pub full: Channels,
    depth: Interval,
    /// What led here.
    pub decisions: Decisions,
    /// Whether several ways to go are taken together.
    pub merged: bool,
}

impl State {
    /// Nothing drawn. Every depth that is drawn at all passes.
    pub const EMPTY: Self = Self {
        moved: [Interval::ZERO; 4],
        full: [Interval::ZERO; 4],
        depth: Interval {
            low: f64::INFINITY,
            high: f64::INFINITY,
        },
        decisions: Decisions {
            pole: false,
            texel: false,
            depth: false,
            edge: false,
        },
        merged: false,
    };

    fn after(&self, decision: Decisions) -> Self {
        Self {
            decisions: self.decisions.and(decision),
            ..*self
        }
    }
}

const EDGE: Decisions = Decisions {
    edge: true,
    ..State::EMPTY.decisions
};
const DEPTH: Decisions = Decisions {
    depth: true,
    ..State::EMPTY.decisions
};

/// More states than these are taken together by what led to them.
const MANY: usize = 48;

/// The states of a sample after its events in drawing order; with a depth test if `tested`. Channels are in the core's `unit`.
pub fn states(events: &[Event], tested: bool, unit: f64) -> Vec<State> {
    let mut states = vec![State::EMPTY];
    for event in events {
        let mut next = Vec::with_capacity(states.len());
        for state in &states {
            step(state, event, tested, unit, &mut next);
        }
        states = if next.len() > MANY { together(next) } else { next };
    }
    states
}

fn step(state: &State, event: &Event, tested: bool, unit: f64, next: &mut Vec<State>) {
    let perhaps = event.coverage == Coverage::Perhaps;
    let passes = !tested || event.depth.high <= state.depth.low;
    let fails = tested && event.depth.low > state.depth.high;
    if fails {
        next.push(*state);
        return;
    }
    if perhaps {
        next.push(state.after(EDGE));
    } else if !passes {
        next.push(state.after(DEPTH));
    }
    let mut decision = State::EMPTY.decisions;
    decision.edge = perhaps || event.is_between;
    decision.depth = !passes;
    for fragment in &event.fragments {
        decision.texel = fragment.texel == Texel::Other;
        decision.pole = fragment.texel == Texel::Pole;
        let moved = over(&fragment.moved, &state.moved, 0.0);
        let full = over(&fragment.full, &state.full, unit);
        next.push(State {
            moved,
            full,
            depth: if tested { event.depth } else { state.depth },
            ..state.after(decision)
        });
    }
}

/// One state for each set of decisions.
fn together(mut states: Vec<State>) -> Vec<State> {
    states.sort_by_key(|state| state.decisions);
    let mut merged: Vec<State> = Vec::new();
    for state in states {
        match merged.last_mut() {
            Some(last) if last.decisions == state.decisions => {
                last.moved = joined(&last.moved, &state.moved);
                last.full = joined(&last.full, &state.full);
                last.depth = last.depth.join(state.depth);
                last.merged = true;
            }
            _ => merged.push(state),
        }
    }
    merged
}
