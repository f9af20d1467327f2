//! The standard workloads: their units, what is to be reached, and what others need.

use crate::failure::Failure;
use crate::outcome::{Outcome, find};
use crate::workloads::Workloads;

/// What a figure is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Pixels covered, hidden ones included.
    Pixel,
    /// Triangles of the file.
    Triangle,
    /// Everything, drawn once.
    Frame,
}

impl Unit {
    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Unit::Pixel => "pixel",
            Unit::Triangle => "triangle",
            Unit::Frame => "frame",
        }
    }
}

/// A figure of the table.
#[derive(Debug, Clone, Copy)]
pub struct Workload {
    /// What images report it as.
    pub name: &'static str,
    /// Its key in a workloads file, and what other crates report it as.
    pub key: &'static str,
    /// What it is divided by.
    pub unit: Unit,
}

/// All of them.
pub const WORKLOADS: [Workload; 8] = [
    Workload {
        name: "W1",
        key: "W1",
        unit: Unit::Pixel,
    },
    Workload {
        name: "W2",
        key: "W2",
        unit: Unit::Pixel,
    },
    Workload {
        name: "W2_compact",
        key: "W2",
        unit: Unit::Pixel,
    },
    Workload {
        name: "W3_exact",
        key: "W3",
        unit: Unit::Pixel,
    },
    Workload {
        name: "W3_spans",
        key: "W3",
        unit: Unit::Pixel,
    },
    Workload {
        name: "W4",
        key: "W4",
        unit: Unit::Triangle,
    },
    Workload {
        name: "W4_compact",
        key: "W4",
        unit: Unit::Triangle,
    },
    Workload {
        name: "W5",
        key: "W5",
        unit: Unit::Frame,
    },
];

/// What a figure is held against, on one machine.
#[derive(Debug, Clone, Copy)]
pub struct Goal {
    /// At most this.
    pub must: f64,
    /// Where this is aimed at; no aim where none was set.
    pub aim: Option<f64>,
    /// The best of the C and C++ libraries that were measured on `bench/workloads.json`, and which it is.
    pub best: Option<(f64, &'static str)>,
    /// The best of the Rust crates that were, each in a firmware of its own; euc with the multiply-add of the FPU.
    pub best_rust: Option<(f64, &'static str)>,
}

const fn goal(must: f64, aim: f64, best: f64, who: &'static str) -> Goal {
    Goal {
        must,
        aim: Some(aim),
        best: Some((best, who)),
        best_rust: None,
    }
}

const fn with_rust(goal: Goal, best: f64, who: &'static str) -> Goal {
    Goal {
        best_rust: Some((best, who)),
        ..goal
    }
}

const fn at_most(must: f64, best: f64) -> Goal {
    Goal {
        must,
        aim: None,
        best: Some((best, "TinyGL or TGX")),
        best_rust: None,
    }
}

/// By machine and workload.
const GOALS: [(&str, &[(&str, Goal)]); 3] = [
    (
        "m4",
        &[
            ("W1", with_rust(goal(1.0, 0.7, 1.99, "raylib's rlsw"), 26.6, "euc")),
            ("W2", with_rust(goal(19.0, 16.5, 26.2, "TinyGL"), 68.5, "euc")),
            ("W2_compact", with_rust(goal(19.0, 16.5, 26.2, "TinyGL"), 68.5, "euc")),
            (
                "W3_exact",
                with_rust(goal(28.0, 26.0, 32.4, "TinyGL, 9 texels off"), 87.0, "retrofire"),
            ),
            (
                "W3_spans",
                with_rust(goal(25.0, 22.0, 32.4, "TinyGL, 9 texels off"), 87.0, "retrofire"),
            ),
            ("W4", with_rust(goal(720.0, 620.0, 1_017.0, "TGX"), 2_264.0, "euc")),
            (
                "W5",
                with_rust(goal(2.2e6, 1.8e6, 4.04e6, "TGX, indexed"), 7.27e6, "euc"),
            ),
        ],
    ),
    (
        "m0",
        &[
            ("W1", goal(1.3, 1.2, 4.61, "best measured")),
            ("W2", goal(32.0, 28.0, 49.1, "best measured")),
            ("W2_compact", goal(32.0, 28.0, 49.1, "best measured")),
            ("W3_spans", goal(75.0, 60.0, 170.0, "12 texels off")),
            ("W4", goal(1_900.0, 1_500.0, 4_722.0, "best measured")),
            ("W5", goal(6.5e6, 5.5e6, 12.8e6, "best measured")),
        ],
    ),
    (
        "host",
        &[
            ("W2", at_most(22.0, 25.4)),
            ("W3_exact", at_most(30.0, 32.4)),
            ("W3_spans", at_most(30.0, 32.4)),
            ("W4", at_most(850.0, 1_033.0)),
        ],
    ),
];

/// The goal of a workload on a machine, if one was set.
pub fn goal_of(machine: &str, workload: &str) -> Option<Goal> {
    let (_, goals) = GOALS.iter().find(|(key, _)| *key == machine)?;
    goals.iter().find(|(name, _)| *name == workload).map(|&(_, goal)| goal)
}

/// How many units of every workload there are, so that whoever draws it is divided by the same number.
pub struct Units([Option<u32>; WORKLOADS.len()]);

impl Units {
    /// Pixels by the core's own count, which is exact, in `outcomes`.
    pub fn of(workloads: &Workloads, outcomes: &[Outcome]) -> Result<Self, Failure> {
        let mut units = [None; WORKLOADS.len()];
        for (units, workload) in units.iter_mut().zip(WORKLOADS) {
            *units = match workload.unit {
                Unit::Pixel => find(outcomes, workload.name).map(|outcome| outcome.units),
                Unit::Triangle => Some(workloads.corners(workload.key)?.len() as u32),
                Unit::Frame => Some(1),
            };
        }
        Ok(Units(units))
    }

    /// Instructions per unit of a workload.
    pub fn per_unit(&self, workload: &Workload, instructions: u64) -> Option<f64> {
        let index = WORKLOADS.iter().position(|w| w.name == workload.name)?;
        let units = self.0[index].filter(|&units| units > 0)?;
        Some(instructions as f64 / f64::from(units))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_goal_is_of_a_workload_and_every_aim_below_what_must_be() {
        for (machine, goals) in GOALS {
            for (name, goal) in goals {
                assert!(WORKLOADS.iter().any(|w| w.name == *name), "{machine} {name}");
                assert!(goal.aim.is_none_or(|aim| aim < goal.must), "{machine} {name}");
                assert!(goal.best.is_none_or(|(best, _)| goal.must < best), "{machine} {name}");
            }
        }
        assert!(goal_of("m4", "W5").is_some() && goal_of("m0", "W3_exact").is_none());
    }
}
