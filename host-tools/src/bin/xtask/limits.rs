//! Stored counts, and what a run may exceed them by.

use std::fs;
use std::path::PathBuf;

use serde_json::{Map, Value, json};

use crate::board::Board;
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

/// The limits of all boards, each with the compiler that they belong to.
pub struct Limits {
    boards: Map<String, Value>,
}

impl Limits {
    fn file() -> PathBuf {
        root().join("firmware/limits.json")
    }

    /// As stored.
    pub fn read() -> Result<Self, Failure> {
        let file = Self::file();
        let text = fs::read_to_string(&file).map_err(|e| Failure::trouble(file.display(), e))?;
        let boards = serde_json::from_str(&text).map_err(|e| Failure::trouble(file.display(), e))?;
        Ok(Limits { boards })
    }

    /// Stores these limits.
    pub fn write(&self) -> Result<(), Failure> {
        let file = Self::file();
        let text = format!("{:#}\n", Value::Object(self.boards.clone()));
        fs::write(&file, text).map_err(|e| Failure::trouble(file.display(), e))
    }

    /// Makes `outcomes` the limits of `board`; what was not drawn this time keeps its own.
    pub fn update(&mut self, board: &Board, compiler: &str, outcomes: &[Outcome]) {
        let entry = self.boards.entry(board.key).or_insert_with(|| json!({"counts": {}}));
        entry["compiler"] = compiler.into();
        for outcome in outcomes {
            entry["counts"][&outcome.name] = json!({"instructions": outcome.instructions, "pixels": outcome.units});
        }
    }

    /// Compares. Counts of another compiler are other counts: they are noted, not judged.
    pub fn compare(&self, board: &Board, compiler: &str, outcomes: &[Outcome]) -> Verdict {
        let mut verdict = Verdict::default();
        let stored = self.boards.get(board.key).unwrap_or(&Value::Null);
        let same_compiler = stored["compiler"] == compiler;
        if !same_compiler {
            verdict.notes.push(format!(
                "{}: limits are of rustc {}, this is rustc {compiler}: nothing fails for its cost",
                board.key, stored["compiler"]
            ));
        }
        for outcome in outcomes {
            let name = format!("{} {}", board.key, outcome.name);
            let limit = &stored["counts"][&outcome.name];
            let Some(instructions) = limit["instructions"].as_f64() else {
                verdict.notes.push(format!("{name}: no limit is stored"));
                continue;
            };
            if limit["pixels"] != outcome.units {
                verdict
                    .notes
                    .push(format!("{name}: other geometry than the limit's: not compared"));
                continue;
            }
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
    use crate::board::M4;

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
        let mut limits = Limits { boards: Map::new() };
        limits.update(&M4, "1.0", &outcome(10_000, 50));
        limits
    }

    #[test]
    fn a_hundredth_more_passes_and_more_fails() {
        let over = |count| limits().compare(&M4, "1.0", &outcome(count, 50)).over.len();
        assert_eq!([over(9_000), over(10_100), over(10_101)], [0, 0, 1]);
    }

    #[test]
    fn another_compiler_or_geometry_is_noted() {
        for verdict in [
            limits().compare(&M4, "1.1", &outcome(20_000, 50)),
            limits().compare(&M4, "1.0", &outcome(20_000, 51)),
        ] {
            assert!(verdict.over.is_empty() && !verdict.notes.is_empty());
        }
    }
}
