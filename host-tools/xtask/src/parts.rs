//! The cost of a pixel, of a row and of a triangle, told apart by the built-in shapes.

use fixel_workloads::shapes::{LOW, NARROW, REPEATS, WIDE};

use crate::outcome::{Outcome, find};

/// The kinds of drawing that the shapes are drawn by.
const KINDS: [&str; 4] = ["flat", "flat_depth", "gouraud", "gouraud_depth"];

/// What one kind of drawing costs in instructions, every fragment passing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parts {
    /// Which kind.
    pub kind: &'static str,
    /// Of a pixel.
    pub pixel: f64,
    /// Of a row.
    pub row: f64,
    /// Of a triangle.
    pub triangle: f64,
}

impl Parts {
    /// Solves the shapes' costs for pixel, row and triangle; without what was not drawn.
    pub fn of(outcomes: &[Outcome]) -> Vec<Self> {
        KINDS
            .into_iter()
            .filter_map(|kind| Self::of_kind(outcomes, kind))
            .collect()
    }

    fn of_kind(outcomes: &[Outcome], kind: &'static str) -> Option<Self> {
        let shape = |shape: &str| {
            let outcome = find(outcomes, &format!("{kind}/{shape}"))?;
            let once = |v: u32| f64::from(v) / f64::from(REPEATS);
            Some((once(outcome.instructions), once(outcome.units)))
        };
        let (wide, narrow, low) = (shape(WIDE.name)?, shape(NARROW.name)?, shape(LOW.name)?);
        let pixel = (wide.0 - narrow.0) / (wide.1 - narrow.1);
        let rest = |(instructions, pixels): (f64, f64)| instructions - pixels * pixel;
        let row = (rest(narrow) - rest(low)) / f64::from(NARROW.height - LOW.height);
        Some(Parts {
            kind,
            pixel,
            row,
            triangle: rest(low) - row * f64::from(LOW.height),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_those_that_the_shapes_were_made_of() {
        let outcome = |shape: &str, rows: i32, pixels: u32| Outcome {
            name: format!("flat/{shape}"),
            instructions: REPEATS * (2 * pixels + 30 * rows as u32 + 400),
            units: REPEATS * pixels,
            color: 0,
            depth: 0,
        };
        let outcomes = [
            outcome(WIDE.name, WIDE.height, 38_000),
            outcome(NARROW.name, NARROW.height, 19_000),
            outcome(LOW.name, LOW.height, 9_500),
        ];
        let expected = Parts {
            kind: "flat",
            pixel: 2.0,
            row: 30.0,
            triangle: 400.0,
        };
        assert_eq!(Parts::of(&outcomes), [expected]);
    }
}
