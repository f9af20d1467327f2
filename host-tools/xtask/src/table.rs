//! The measurements as tables for people.

use crate::added::{MOST_FLASH, MOST_RAM, Sizes};
use crate::measure::{Machine, Report};
use crate::outcome::find;
use crate::parts::Parts;
use crate::rivals::{MACHINES, Rival};
use crate::standard::{Units, WORKLOADS, Workload, goal_of};

/// What stands where there is no figure.
const NONE: &str = "-";

/// All of them.
pub fn print(report: &Report) {
    for machine in &report.machines {
        print_machine(machine, &report.units, &report.rivals);
    }
    print_exactness(report);
    print_sizes(&report.sizes);
    for machine in &report.machines {
        print_parts(machine);
    }
}

fn print_machine(machine: &Machine, units: &Units, rivals: &[Rival]) {
    let rivals: Vec<_> = rivals.iter().filter(|_| MACHINES.contains(&machine.key)).collect();
    println!("{}, rustc {}: instructions per unit\n", machine.name, machine.compiler);
    print!("{:<10}{:>9}{:>12}", "", "unit", "fixel");
    for rival in &rivals {
        print!("{:>19}", rival.name);
    }
    println!("{:>20}{:>20}   C or C++ at best", "must reach", "aim");
    for workload in &WORKLOADS {
        let ours = find(&machine.outcomes, workload.name).map(|outcome| outcome.instructions.into());
        let ours = ours.and_then(|count| units.per_unit(workload, count));
        print!("{:<10}{:>9}{:>12}", workload.name, workload.unit.name(), shown(ours));
        for rival in &rivals {
            let theirs = rival.instructions(machine.key, workload.key);
            let theirs = theirs.and_then(|count| units.per_unit(workload, count));
            print!("{:>19}", shown(theirs));
        }
        print_goals(machine, workload, ours);
    }
    println!();
}

fn print_goals(machine: &Machine, workload: &Workload, ours: Option<f64>) {
    let goal = goal_of(machine.key, workload.name);
    let held = |most: Option<f64>| {
        most.map_or(NONE.into(), |most| {
            format!("{} {}", shown(Some(most)), verdict(ours, most))
        })
    };
    let best =
        |best: Option<(f64, &str)>| best.map_or(NONE.into(), |(best, who)| format!("{} {who}", shown(Some(best))));
    println!(
        "{:>20}{:>20}   {}; {}",
        held(goal.map(|goal| goal.must)),
        held(goal.and_then(|goal| goal.aim)),
        best(goal.and_then(|goal| goal.best)),
        best(goal.and_then(|goal| goal.best_rust))
    );
}

fn verdict(ours: Option<f64>, most: f64) -> &'static str {
    match ours {
        Some(ours) if ours <= most => "met",
        Some(_) => "not met",
        None => "?",
    }
}

/// With as many digits as tell something.
fn shown(value: Option<f64>) -> String {
    match value {
        None => NONE.into(),
        Some(value) if value >= 1e5 => format!("{:.3} M", value / 1e6),
        Some(value) if value >= 200.0 => format!("{value:.0}"),
        Some(value) => format!("{value:.2}"),
    }
}

fn print_exactness(report: &Report) {
    print!("{:<24}{:>12}", "wrong pixels", "fixel");
    for rival in &report.rivals {
        print!("{:>19}", rival.name);
    }
    println!();
    for (index, (key, wrong)) in report.exactness.figures.into_iter().enumerate() {
        print!("{key:<24}{wrong:>12}");
        for rival in &report.rivals {
            print!("{:>19}", rival.exactness.figures[index].1);
        }
        println!();
    }
    println!("\n{:<24}{:>12}{:>12}{:>12}", "error", "worst", "at most", "pixels off");
    for figure in &report.values {
        let name = format!("{} {}", figure.name, figure.what);
        println!(
            "{name:<24}{:>12.4}{:>12.4}{:>12}   {}",
            figure.worst, figure.most, figure.off, figure.unit
        );
    }
    println!();
}

fn print_sizes(sizes: &Sizes) {
    println!("{:<36}{:>8}{:>9}", "bytes, drawing as W2", "", "at most");
    let line = |what: &str, bytes: usize, most: usize| {
        println!(
            "{what:<36}{bytes:>8}{most:>9} {}",
            verdict(Some(bytes as f64), most as f64)
        );
    };
    let ([flash, flash_s], [most, most_s]) = (sizes.flash, MOST_FLASH);
    line("flash over an empty firmware, 3", flash, most);
    line("flash over an empty firmware, s", flash_s, most_s);
    let [compact, compact_s] = sizes.compact;
    line("the same, compact drawing, 3", compact, most);
    line("the same, compact drawing, s", compact_s, most_s);
    line("RAM beside the buffers", sizes.ram(), MOST_RAM);
    println!("  of which stack {:>29}\n", sizes.stack);
}

fn print_parts(machine: &Machine) {
    let parts = Parts::of(&machine.outcomes);
    if parts.is_empty() {
        return;
    }
    println!("{:<24}{:>12}{:>12}{:>12}", machine.name, "pixel", "row", "triangle");
    for part in parts {
        println!(
            "{:<24}{:>12.2}{:>12.1}{:>12.0}",
            part.kind, part.pixel, part.row, part.triangle
        );
    }
    println!();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_at_its_goal_meets_it() {
        assert_eq!(
            [Some(1.0), Some(1.01), None].map(|ours| verdict(ours, 1.0)),
            ["met", "not met", "?"]
        );
    }

    #[test]
    fn figures_keep_their_digits() {
        let figures = [1.994, 720.4, 2.2e6].map(|value| shown(Some(value)));
        assert_eq!(figures, ["1.99", "720", "2.200 M"]);
    }
}
