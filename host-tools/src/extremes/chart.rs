//! A family's curve as SVG: errors over the parameter, both on scales that show a pixel.

use maud::{PreEscaped, html};

use super::{Curve, Outcome};

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 260.0;
const LEFT: f64 = 60.0;
const RIGHT: f64 = 60.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = 44.0;

/// Readable on a light page and on a dark one.
const STYLE: &str = "text{font:12px system-ui,sans-serif;fill:#57606a}.grid{stroke:#8886}.colour{stroke:#4060ff;fill:none;\
stroke-width:2}.excused{stroke:#d29922;fill:none;stroke-width:2}.refused{fill:#cf222e}\
@media(prefers-color-scheme:dark){text{fill:#c9d1d9}}";

/// Levels of colour at the top of the chart, and percent of pixels.
const MOST_LEVELS: f64 = 16.0;
const MOST_PERCENT: f64 = 100.0;

pub(super) fn chart(curve: &Curve) -> String {
    let values = curve.family.values;
    let step = (WIDTH - LEFT - RIGHT) / (values.len().max(2) - 1) as f64;
    let x = |i: usize| LEFT + i as f64 * step;
    let y = |part: f64| HEIGHT - BOTTOM - part.clamp(0.0, 1.0) * (HEIGHT - TOP - BOTTOM);
    // A root: 0.01 % is to be seen beside 100 %.
    let levels = |value: f64| y((value / MOST_LEVELS).sqrt());
    let percent = |value: f64| y((value / MOST_PERCENT).sqrt().sqrt());
    let drawn = || {
        curve
            .outcomes
            .iter()
            .enumerate()
            .filter_map(|(i, (_, outcome))| match outcome {
                Outcome::Drawn(errors) => Some((i, errors)),
                Outcome::Refused(_) => None,
            })
    };
    let line = |y: &dyn Fn(&super::Errors) -> f64| {
        let points: Vec<_> = drawn()
            .map(|(i, errors)| format!("{:.1},{:.1}", x(i), y(errors)))
            .collect();
        points.join(" ")
    };
    let svg = html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } {
            style { (PreEscaped(STYLE)) }
            @for value in [0.0, 1.0, 4.0, 16.0] {
                line.grid x1=(LEFT) x2=(WIDTH - RIGHT) y1=(levels(value)) y2=(levels(value)) {}
                text x=(LEFT - 6.0) y=(levels(value) + 4.0) text-anchor="end" { (value) }
            }
            @for value in [0.01, 1.0, 10.0, 100.0] {
                text x=(WIDTH - RIGHT + 6.0) y=(percent(value) + 4.0) { (value) " %" }
            }
            @for (i, (value, outcome)) in curve.outcomes.iter().enumerate() {
                text x=(x(i)) y=(HEIGHT - BOTTOM + 16.0) text-anchor="middle" { (format!("{value:e}")) }
                @if let Outcome::Refused(_) = outcome {
                    text.refused x=(x(i)) y=(HEIGHT - BOTTOM - 4.0) text-anchor="middle" { "refused" }
                }
            }
            polyline.colour points=(line(&|errors| levels(f64::from(errors.colour)))) {}
            polyline.excused points=(line(&|errors| percent(errors.excused))) {}
            text x=(LEFT) y="16" { "blue: largest colour error, levels (left) · yellow: pixels of other classes (right)" }
            text x=(WIDTH / 2.0) y=(HEIGHT - 6.0) text-anchor="middle" { (curve.family.parameter) }
        }
    };
    svg.into_string() + "\n"
}
