//! What the trade must show, and what is stale.

use std::collections::HashSet;

use fixel_workloads::tiers::TIERS;

use super::error::Errors;
use super::points::{MACHINES, Point, Sweep};

/// Scenes in which every tier must be on the front of these machines.
const TRADES: [&str; 3] = ["gouraud", "textured", "lit"];
/// Scenes in which the fast tier must cost at most half of the exact one on Cortex-M0.
const HALVED: [&str; 2] = ["textured", "lit"];
/// Scenes of a dial that is offered: every one of its values must be on the front of these machines.
const OFFERED: [&str; 4] = ["filtered", "sky by 4×4", "two levels by 4×4", "linear light"];
/// Scene, what is not offered, and what must be nearer on every machine for no more instructions.
const DROPPED: [[&str; 3]; 2] = [["sines", "micromath", "short table"], ["edges", "1/16 px", "1/256 px"]];
/// A difference in cost that is none.
const AS_MANY: f64 = 0.01;
/// The first machines of [`MACHINES`], Cortex-M4 and M0.
const JUDGED: usize = 2;
/// How far stored figures may be off.
const STALE: f64 = 0.05;
/// Errors below this are no different: in levels, and as a share.
const NOTHING: f64 = 0.001;

/// Promises that do not hold.
pub fn broken(sweeps: &[Sweep]) -> Vec<String> {
    let named = |scene: &str| sweeps.iter().find(|sweep| sweep.scene == scene);
    let mut off = Vec::new();
    for scene in TRADES {
        let Some(sweep) = named(scene) else {
            off.push(format!("{scene}: not drawn"));
            continue;
        };
        for (machine, (key, _)) in MACHINES.iter().enumerate().take(JUDGED) {
            let on_front = |tier: &&str| sweep.point(tier).is_some_and(|point| sweep.is_on_front(point, machine));
            let beaten = TIERS.iter().filter(|tier| !on_front(tier));
            off.extend(beaten.map(|tier| format!("{scene} on {key}: {tier} is not on the front")));
            let front: HashSet<_> = sweep
                .points
                .iter()
                .filter(|point| sweep.is_on_front(point, machine))
                .map(|point| point.instructions[machine].to_bits())
                .collect();
            if front.len() < 3 {
                off.push(format!("{scene} on {key}: {} points on the front", front.len()));
            }
        }
    }
    for scene in OFFERED {
        let Some(sweep) = named(scene) else {
            off.push(format!("{scene}: not drawn"));
            continue;
        };
        for (machine, (key, _)) in MACHINES.iter().enumerate().take(JUDGED) {
            let beaten = sweep.points.iter().filter(|point| !sweep.is_on_front(point, machine));
            off.extend(beaten.map(|point| format!("{scene} on {key}: {} trades nothing", point.dial)));
        }
    }
    for [scene, dropped, offered] in DROPPED {
        let point = |dial: &str| named(scene)?.point(dial);
        let beats = |(better, worse): (&Point, &Point)| {
            let mut costs = better.instructions.iter().zip(worse.instructions);
            better.errors.mean < worse.errors.mean && costs.all(|(b, w)| *b <= w * (1.0 + AS_MANY))
        };
        if !point(offered).zip(point(dropped)).is_some_and(beats) {
            off.push(format!("{scene}: {dropped} is not beaten by {offered}"));
        }
    }
    for scene in HALVED {
        let cost = |tier: &str| Some(named(scene)?.point(tier)?.instructions[1]);
        if !matches!((cost("fast"), cost("exact")), (Some(fast), Some(exact)) if 2.0 * fast <= exact) {
            off.push(format!("{scene} on m0: fast costs more than half of exact"));
        }
    }
    off
}

/// What is stored otherwise than measured by more than 5 %; instructions only where they are `comparable`.
pub fn stale(stored: &[Sweep], measured: &[Sweep], comparable: [bool; MACHINES.len()]) -> Vec<String> {
    let mut off = Vec::new();
    for sweep in measured {
        let there = stored.iter().find(|other| other.scene == sweep.scene);
        if there.is_none_or(|there| there.points.len() != sweep.points.len()) {
            off.push(format!("{}: other points are stored", sweep.scene));
        }
        for point in &sweep.points {
            let name = format!("{}, {}", sweep.scene, point.dial);
            match there.and_then(|there| there.point(&point.dial)) {
                Some(other) => off.extend(changes(other, point, comparable).map(|what| format!("{name}: {what}"))),
                None => off.push(format!("{name}: not stored")),
            }
        }
    }
    off
}

fn changes(stored: &Point, measured: &Point, comparable: [bool; MACHINES.len()]) -> impl Iterator<Item = String> {
    let counts = stored.instructions.into_iter().zip(measured.instructions);
    let counts = MACHINES.iter().zip(comparable).zip(counts);
    let counts = counts.filter_map(|(((key, _), comparable), (old, new))| {
        let moved = comparable && (new - old).abs() > STALE * old;
        moved.then(|| format!("{new} instructions on {key}, {old} stored"))
    });
    let numbers = |errors: Errors| {
        [
            ("maximum", errors.max),
            ("99.9 %", errors.p999),
            ("mean", errors.mean),
            ("share", errors.differing),
        ]
    };
    let errors = numbers(stored.errors).into_iter().zip(numbers(measured.errors));
    let errors = errors.filter_map(|((what, old), (_, new))| {
        let moved = (new - old).abs() > (STALE * old).max(NOTHING);
        moved.then(|| format!("error, {what}: {new:.4}, {old:.4} stored"))
    });
    counts.collect::<Vec<_>>().into_iter().chain(errors)
}

#[cfg(test)]
mod tests {
    use super::super::points::tests::{point, sweep};
    use super::*;

    fn good() -> Vec<Sweep> {
        let points = vec![
            point("fast", 10.0, 2.0),
            point("balanced", 20.0, 1.0),
            point("exact", 30.0, 0.5),
        ];
        let tiers = TRADES.map(|scene| Sweep {
            scene: scene.into(),
            ..sweep(points.clone())
        });
        let offered = OFFERED.map(|scene| Sweep {
            scene: scene.into(),
            ..sweep(vec![point("off", 10.0, 2.0), point("on", 11.0, 1.0)])
        });
        let dropped = DROPPED.map(|[scene, dropped, offered]| Sweep {
            scene: scene.into(),
            ..sweep(vec![point(dropped, 10.0, 2.0), point(offered, 10.05, 1.0)])
        });
        tiers.into_iter().chain(offered).chain(dropped).collect()
    }

    #[test]
    fn a_dial_trades_or_is_dropped() {
        let mut all = good();
        all[3].points[1] = point("on", 11.0, 2.0);
        assert_eq!(broken(&all).len(), 2);
        all[7].points[1] = point(DROPPED[0][2], 10.2, 1.0);
        assert_eq!(broken(&all).len(), 3);
        all[8].points[1] = point(DROPPED[1][2], 10.0, 2.0);
        assert_eq!(broken(&all).len(), 4);
        all.truncate(7);
        all.remove(4);
        assert_eq!(broken(&all).len(), 5);
    }

    #[test]
    fn promises_are_kept_and_broken() {
        assert!(broken(&good()).is_empty());
        let mut dear = good();
        dear[2].points[0] = point("fast", 16.0, 2.0);
        assert_eq!(broken(&dear).len(), 1);
        // Off the front of both machines, which then have two points.
        dear[2].points[1] = point("balanced", 16.0, 3.0);
        assert_eq!(broken(&dear).len(), 5);
        dear.remove(2);
        assert_eq!(broken(&dear).len(), 2);
    }

    #[test]
    fn a_tier_that_is_beaten_is_named_however_many_points_there_are() {
        let mut beaten = good();
        beaten[1].points[0] = point("fast", 21.0, 2.0);
        // Two points on either front, fast off both, and more than half of exact on the M0.
        assert_eq!(broken(&beaten).len(), 5);
        beaten[1].points.push(point("affine", 5.0, 9.0));
        assert_eq!(broken(&beaten).len(), 3);
    }

    #[test]
    fn five_percent_are_stale() {
        let one = |cost: f64, mean: f64| [sweep(vec![point("fast", cost, mean)])];
        let stale = |cost, mean, comparable| stale(&one(100.0, 1.0), &one(cost, mean), [comparable; 3]).len();
        assert_eq!(stale(104.0, 1.04, true), 0);
        assert_eq!(
            [
                stale(106.0, 1.0, true),
                stale(94.0, 1.0, true),
                stale(106.0, 1.0, false)
            ],
            [3, 3, 0]
        );
        // The largest, the quantile and the mean.
        assert_eq!(stale(100.0, 1.06, true), 3);
        assert_eq!(super::stale(&[], &one(100.0, 1.0), [true; 3]).len(), 2);
    }
}
