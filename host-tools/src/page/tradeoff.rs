//! What speed costs in accuracy: a chart of cost against error, and its numbers.

use std::fmt::Write as _;

use maud::{Markup, html};

use crate::sweep::{Point, Sweep, Unit, mean_4x4};

/// Of the drawing, in its own units.
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 320.0;
/// Of the plot; names stand to the right of it.
const LEFT: f64 = 56.0;
const RIGHT: f64 = 440.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 272.0;
/// Between the names of two points.
const LINE: f64 = 15.0;

/// The chart and the table.
pub fn tradeoff(sweep: &Sweep) -> Markup {
    html! {
        figure.chart.tradeoff {
            figcaption { "Speed against accuracy: " (cost_name(sweep)) " and mean error (levels of 255) of tiers and single dials" }
            (chart(sweep))
        }
        table.tradeoff {
            caption { "Errors against float64 in levels of 255" }
            thead {
                tr {
                    @for name in ["", sweep.unit.name(), "per pixel", "largest", "99.9 %", "mean", "mean of 4×4", "differing", "coverage differs"] {
                        th { (name) }
                    }
                }
            }
            tbody {
                @for point in &sweep.points {
                    tr.front[point.pareto] {
                        th { (point.name) @if point.pareto { " *" } }
                        td.number { (sweep.unit.number(point.cost)) }
                        td.number { (sweep.unit.per_pixel(sweep.per_pixel(point))) }
                        td.number { (point.errors.max) }
                        td.number { (point.errors.p999) }
                        td.number { (format!("{:.4}", point.errors.mean)) }
                        td.number { (mean_4x4(&point.errors)) }
                        td.number { (format!("{:.2} %", 100.0 * point.errors.differing_share)) }
                        td.number { (point.errors.coverage_differs) }
                    }
                }
            }
        }
        p {
            "* and filled: nothing is as cheap and has as small a mean error. The line is what speed costs. Mean of 4×4: the mean \
             error of means over 4×4 pixels, which dither is made for. 1-bit is held against brightness."
        }
    }
}

fn cost_name(sweep: &Sweep) -> &'static str {
    match sweep.unit {
        Unit::Instructions => "instructions of the host per drawn pixel",
        Unit::Seconds => "time per drawn pixel in ns",
    }
}

/// Where points stand.
struct Axes {
    /// The largest cost per pixel of the plot, in what it is labelled in.
    most: f64,
    /// Powers of ten below and above all mean errors that are not 0; a tenth and 1 at least.
    decades: [i32; 2],
}

impl Axes {
    fn new(sweep: &Sweep) -> Self {
        let costs = sweep.points.iter().map(|point| shown(sweep, point));
        let errors = sweep.points.iter().map(|point| point.errors.mean).filter(|e| *e > 0.0);
        let (least, most) = errors.fold((0.1f64, 1.0f64), |(least, most), e| (least.min(e), most.max(e)));
        Axes {
            most: 1.05 * costs.fold(f64::MIN_POSITIVE, f64::max),
            decades: [least.log10().floor() as i32, most.log10().ceil() as i32],
        }
    }

    fn x(&self, cost: f64) -> f64 {
        LEFT + cost / self.most * (RIGHT - LEFT)
    }

    /// An error of 0 stands a decade below the smallest other.
    fn y(&self, error: f64) -> f64 {
        let [least, most] = self.decades.map(f64::from);
        let bottom = least - 1.0;
        let decade = if error > 0.0 { error.log10() } else { bottom };
        BOTTOM - (decade - bottom) / (most - bottom) * (BOTTOM - TOP)
    }

    fn place(&self, sweep: &Sweep, point: &Point) -> [f64; 2] {
        [self.x(shown(sweep, point)), self.y(point.errors.mean)]
    }
}

/// A point's cost as its axis is labelled.
fn shown(sweep: &Sweep, point: &Point) -> f64 {
    let cost = sweep.per_pixel(point);
    match sweep.unit {
        Unit::Instructions => cost,
        Unit::Seconds => cost * 1e9,
    }
}

fn chart(sweep: &Sweep) -> Markup {
    let axes = Axes::new(sweep);
    let [least, most] = axes.decades;
    let mut points: Vec<(&Point, [f64; 2])> = sweep.points.iter().map(|p| (p, axes.place(sweep, p))).collect();
    points.sort_by(|(_, [_, a]), (_, [_, b])| a.total_cmp(b));
    let names = spread(points.iter().map(|(_, [_, y])| *y));
    html! {
        svg viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } role="img" aria-label="Chart of cost against error" {
            (grid_row(axes.y(0.0), "0"))
            @for decade in least..=most {
                (grid_row(axes.y(10f64.powi(decade)), &format!("{}", 10f64.powi(decade))))
            }
            @for quarter in 0..=4 {
                @let cost = axes.most / 1.05 * f64::from(quarter) / 4.0;
                text x=(axes.x(cost)) y=(BOTTOM + 16.0) text-anchor="middle" { (format!("{cost:.0}")) }
            }
            text x=((LEFT + RIGHT) / 2.0) y=(HEIGHT - 12.0) text-anchor="middle" { (cost_name(sweep)) }
            path.curve d=(front(&points)) {}
            @for ((point, [x, y]), name) in points.iter().zip(names) {
                line.leader x1=(x) y1=(y) x2=(RIGHT + 8.0) y2=(name) {}
                circle.point.front[point.pareto] cx=(x) cy=(y) r="4" {}
                text.name x=(RIGHT + 12.0) y=(name + 4.0) { (point.name) }
            }
        }
    }
}

fn grid_row(y: f64, label: &str) -> Markup {
    html! {
        line.grid x1=(LEFT) x2=(RIGHT) y1=(y) y2=(y) {}
        text x=(LEFT - 6.0) y=(y + 4.0) text-anchor="end" { (label) }
    }
}

/// Through the points of the front, the dearest first.
fn front(points: &[(&Point, [f64; 2])]) -> String {
    let mut front: Vec<[f64; 2]> = points
        .iter()
        .filter(|(p, _)| p.pareto)
        .map(|(_, place)| *place)
        .collect();
    front.sort_by(|a, b| b[0].total_cmp(&a[0]));
    let mut path = String::new();
    for [x, y] in front {
        let to = if path.is_empty() { 'M' } else { 'L' };
        // Writing into a string cannot fail.
        let _ = write!(path, "{to}{x:.2} {y:.2}");
    }
    path
}

/// Heights for names beside points at these heights, which ascend: as near as they may be without running into one another.
fn spread(heights: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut next = f64::NEG_INFINITY;
    let mut names: Vec<f64> = heights
        .map(|height| {
            let name = height.max(next);
            next = name + LINE;
            name
        })
        .collect();
    let mut room = BOTTOM;
    for name in names.iter_mut().rev() {
        *name = name.min(room);
        room = *name - LINE;
    }
    names
}

#[cfg(test)]
mod tests {
    use std::iter;

    use super::*;
    use crate::fixed::dials::CHANGES;
    use crate::sweep::Errors;

    fn sweep(points: &[(&str, f64, f64, bool)]) -> Sweep {
        let point = |&(name, cost, mean, pareto): &(&str, f64, f64, bool)| Point {
            name: name.to_owned(),
            errors: Errors {
                mean,
                ..Errors::default()
            },
            cost,
            pareto,
        };
        Sweep {
            scene: "a.txt".to_owned(),
            size: (10, 10),
            pixels: 10,
            unit: Unit::Instructions,
            points: points.iter().map(point).collect(),
        }
    }

    #[test]
    fn every_point_is_drawn_and_named() {
        let sweep = sweep(&[
            ("exact", 100.0, 0.0, true),
            ("b<", 90.0, 0.5, false),
            ("c", 50.0, 0.25, true),
        ]);
        let svg = chart(&sweep).into_string();
        assert_eq!(svg.matches("<circle").count(), 3);
        assert_eq!(svg.matches("class=\"point front\"").count(), 2);
        assert!(svg.contains(">b&lt;<") && svg.contains(">exact<"));
        let (_, line) = svg.split_once("class=\"curve\" d=\"").expect("a line");
        let line = line.split('"').next().expect("its end");
        assert_eq!((line.matches('M').count(), line.matches('L').count()), (1, 1), "{line}");
    }

    #[test]
    fn cheaper_is_left_and_nearer_is_lower() {
        let sweep = sweep(&[("a", 100.0, 0.0, true), ("b", 50.0, 0.01, true), ("c", 10.0, 3.0, true)]);
        let axes = Axes::new(&sweep);
        let [a, b, c] = [0, 1, 2].map(|i| axes.place(&sweep, &sweep.points[i]));
        assert!(c[0] < b[0] && b[0] < a[0] && c[0] >= LEFT && a[0] <= RIGHT);
        assert!(c[1] < b[1] && b[1] < a[1] && c[1] >= TOP && a[1] <= BOTTOM);
    }

    #[test]
    fn pictures_without_errors_have_a_chart_too() {
        let sweep = sweep(&[("a", 0.0, 0.0, true), ("b", 0.0, 0.0, true)]);
        let axes = Axes::new(&sweep);
        assert_eq!(axes.place(&sweep, &sweep.points[0]), [LEFT, BOTTOM]);
        assert!(!chart(&sweep).into_string().contains("NaN"));
    }

    #[test]
    fn names_keep_apart_and_inside() {
        let names = spread([100.0, 101.0, 180.0, BOTTOM, BOTTOM].into_iter());
        assert!(names.windows(2).all(|pair| pair[1] - pair[0] >= LINE), "{names:?}");
        assert_eq!(names[0], 100.0);
        assert_eq!(names.last(), Some(&BOTTOM));
        // As many points as there can be, all at the bottom.
        let names = spread(iter::repeat_n(BOTTOM, 3 + CHANGES.len()));
        assert!(names.first().is_some_and(|first| *first >= TOP), "{names:?}");
    }
}
