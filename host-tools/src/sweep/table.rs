//! A sweep for people, for programs and for spreadsheets.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::{Budget, Errors, Point, Sweep, Unit, recommended};
use crate::words::counted;

impl Sweep {
    /// A table, and what is recommended for the budget.
    pub fn table(&self, budget: &Budget) -> String {
        let (width, height) = self.size;
        let name = self.points.iter().map(|point| point.name.len()).max().unwrap_or(0);
        let mut text = format!(
            "{}: {width}x{height}, {} drawn; errors against float64 in levels of 255\n  {:name$} {:>12} {:>9} {:>4} {:>6} {:>7} {:>7} {:>8} {:>8}\n",
            self.scene,
            counted(self.pixels, "pixel"),
            "",
            self.unit.name(),
            "per pixel",
            "max",
            "99.9 %",
            "mean",
            "4x4",
            "differ",
            "coverage",
        );
        for point in &self.points {
            let mark = if point.pareto { '*' } else { ' ' };
            let errors = &point.errors;
            // Writing into a string cannot fail.
            let _ = writeln!(
                text,
                "{mark} {:name$} {:>12} {:>9} {:>4} {:>6} {:>7.3} {:>7} {:>6.2} % {:>8}",
                point.name,
                self.unit.number(point.cost),
                self.unit.per_pixel(self.per_pixel(point)),
                errors.max,
                errors.p999,
                errors.mean,
                mean_4x4(errors),
                100.0 * errors.differing_share,
                errors.coverage_differs,
            );
        }
        text.push_str(
            "* nothing is as cheap and has as small a mean error; 4x4: mean error of means over 4x4 pixels,\n",
        );
        text.push_str("  which dither is made for; 1-bit is held against brightness\n");
        if !budget.is_open() {
            text.push_str(&self.advice(budget));
        }
        text
    }

    /// One line.
    fn advice(&self, budget: &Budget) -> String {
        let error = budget
            .max_error
            .map(|most| format!("at most {} on 99.9 % of the pixels", counted(most, "level")));
        let cost = budget
            .max_instructions
            .map(|most| format!("at most {} per pixel", counted(most, "instruction")));
        let asked: Vec<String> = error.into_iter().chain(cost).collect();
        let best = recommended(self, budget).map_or("nothing", |point| point.name.as_str());
        format!("{}: {best}\n", asked.join(" and "))
    }

    /// One object for programs; its keys stay.
    pub fn json(&self, budget: &Budget) -> Value {
        let point = |point: &Point| {
            json!({
                "name": point.name,
                "max_error": point.errors.max,
                "p999_error": point.errors.p999,
                "mean_error": point.errors.mean,
                "differing_share": point.errors.differing_share,
                "coverage_differs": point.errors.coverage_differs,
                "cost": point.cost,
                "cost_unit": self.unit.name(),
                "pareto": point.pareto,
                "mean_error_4x4": point.errors.mean_4x4,
            })
        };
        let mut object = json!({
            "scene": self.scene,
            "pixels_drawn": self.pixels,
            "points": self.points.iter().map(point).collect::<Vec<_>>(),
        });
        if !budget.is_open() {
            object["recommended"] = recommended(self, budget).map(|point| point.name.clone()).into();
        }
        object
    }

    /// Rows under the header of all tables.
    pub fn csv(&self) -> String {
        let row = |point: &Point| {
            let errors = &point.errors;
            format!(
                "{},{},{},{},{},{},{},{},{},{},{}\n",
                quoted(&self.scene),
                point.name,
                errors.max,
                errors.p999,
                errors.mean,
                errors.differing_share,
                errors.coverage_differs,
                point.cost,
                self.unit.name(),
                point.pareto,
                errors.mean_4x4.map(|mean| mean.to_string()).unwrap_or_default(),
            )
        };
        self.points.iter().map(row).collect()
    }
}

/// What the columns of [`Sweep::csv`] are.
pub const CSV_HEADER: &str = "scene,name,max_error,p999_error,mean_error,differing_share,coverage_differs,cost,cost_unit,pareto,mean_error_4x4\n";

/// [`Errors::mean_4x4`] in digits.
pub fn mean_4x4(errors: &Errors) -> String {
    errors
        .mean_4x4
        .map_or_else(|| "-".to_owned(), |mean| format!("{mean:.3}"))
}

/// A field with whatever it holds.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

impl Unit {
    /// A cost in digits.
    pub fn number(self, cost: f64) -> String {
        match self {
            Unit::Instructions => format!("{cost}"),
            Unit::Seconds => format!("{cost:.6}"),
        }
    }

    /// A pixel's cost in digits.
    pub fn per_pixel(self, cost: f64) -> String {
        match self {
            Unit::Instructions => format!("{cost:.1}"),
            Unit::Seconds => format!("{:.1} ns", cost * 1e9),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_of_a_row_stay_one() {
        assert_eq!(quoted("a.txt"), "a.txt");
        assert_eq!(quoted("a, \"b\".txt"), "\"a, \"\"b\"\".txt\"");
    }
}
