//! Stored counts, and what a run may exceed them by.

use std::fs;
use std::path::PathBuf;

use serde_json::{Map, Value, json};

use crate::failure::Failure;
use crate::image::root;
use crate::outcome::Outcome;

/// Counts may grow by a hundredth: they change with nothing but the code and the compiler.
const TOLERANCE: f64 = 1.01;

/// What a comparison came to.
#[derive(Debug, Default)]
pub struct Verdict {
    /// Counts over their limit.
    pub over: Vec<String>,
    /// What the reader should know besides.
    pub notes: Vec<String>,
}

/// The limits of all machines, each with the compiler that they belong to.
pub struct Limits {
    machines: Map<String, Value>,
}

impl Limits {
    fn file() -> PathBuf {
        root().join("firmware/limits.json")
    }

    /// As stored.
    pub fn read() -> Result<Self, Failure> {
        let file = Self::file();
        let text = fs::read_to_string(&file).map_err(|e| Failure::trouble(file.display(), e))?;
        let machines = serde_json::from_str(&text).map_err(|e| Failure::trouble(file.display(), e))?;
        Ok(Limits { machines })
    }

    /// Stores these limits.
    pub fn write(&self) -> Result<(), Failure> {
        let file = Self::file();
        let text = format!("{:#}\n", Value::Object(self.machines.clone()));
        fs::write(&file, text).map_err(|e| Failure::trouble(file.display(), e))
    }

    /// Makes `outcomes` the limits of `machine`; what was not drawn this time keeps its own.
    pub fn update(&mut self, machine: &str, compiler: &str, outcomes: &[Outcome]) {
        let entry = self.machines.entry(machine).or_insert_with(|| json!({"counts": {}}));
        entry["compiler"] = compiler.into();
        for outcome in outcomes {
            entry["counts"][&outcome.name] = json!({"instructions": outcome.instructions, "pixels": outcome.units});
        }
    }

    /// Compares. Counts of another compiler are other counts: they are noted, not judged.
    pub fn compare(&self, machine: &str, compiler: &str, outcomes: &[Outcome]) -> Verdict {
        let mut verdict = Verdict::default();
        let stored = self.machines.get(machine).unwrap_or(&Value::Null);
        if stored.is_null() {
            verdict.notes.push(format!("{machine}: no limits are stored"));
            return verdict;
        }
        let same_compiler = stored["compiler"] == compiler;
        if !same_compiler {
            verdict.notes.push(format!(
                "{machine}: limits are of rustc {}, this is rustc {compiler}: nothing fails for its cost",
                stored["compiler"]
            ));
        }
        let others = |outcome: &&Outcome| {
            let limit = &stored["counts"][&outcome.name]["pixels"];
            !limit.is_null() && *limit != outcome.units
        };
        if let Some(other) = outcomes.iter().find(others) {
            let name = &other.name;
            verdict.notes.push(format!(
                "{machine} {name}: other geometry than the limits': nothing is compared"
            ));
            return verdict;
        }
        for outcome in outcomes {
            let name = format!("{machine} {}", outcome.name);
            let limit = &stored["counts"][&outcome.name];
            let Some(instructions) = limit["instructions"].as_f64() else {
                verdict.notes.push(format!("{name}: no limit is stored"));
                continue;
            };
            let ratio = f64::from(outcome.instructions) / instructions;
            let change = format!(
                "{name}: {} instructions, limit {instructions} ({:+.1} %)",
                outcome.instructions,
                (ratio - 1.0) * 100.0
            );
            if ratio > TOLERANCE && same_compiler {
                verdict.over.push(change);
            } else if !(1.0 / TOLERANCE..=TOLERANCE).contains(&ratio) {
                verdict.notes.push(change);
            }
        }
        verdict
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(instructions: u32, units: u32) -> [Outcome; 1] {
        [Outcome {
            name: "W1".into(),
            instructions,
            units,
            color: 0,
            depth: 0,
        }]
    }

    fn limits() -> Limits {
        let mut limits = Limits { machines: Map::new() };
        limits.update("m4", "1.0", &outcome(10_000, 50));
        limits
    }

    #[test]
    fn a_hundredth_more_passes_and_more_fails() {
        let over = |count| limits().compare("m4", "1.0", &outcome(count, 50)).over.len();
        assert_eq!([over(9_000), over(10_100), over(10_101)], [0, 0, 1]);
    }

    #[test]
    fn another_compiler_geometry_or_machine_is_noted() {
        for verdict in [
            limits().compare("m4", "1.1", &outcome(20_000, 50)),
            limits().compare("m4", "1.0", &outcome(20_000, 51)),
            limits().compare("m0", "1.0", &outcome(20_000, 50)),
        ] {
            assert!(verdict.over.is_empty() && !verdict.notes.is_empty());
        }
    }
}
