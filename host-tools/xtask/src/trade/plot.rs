//! The trade as a chart: error against cost, a panel for each scene and machine, as SVG for light and dark pages.

use std::fmt::Write;

use fixel_workloads::tiers::TIERS;

use super::page::title;
use super::points::{MACHINES, Point, Sweep};

/// Size of a panel's plot, and the margins that its text needs.
const WIDTH: f64 = 360.0;
const HEIGHT: f64 = 230.0;
const LEFT: f64 = 66.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 46.0;
const RIGHT: f64 = 20.0;
const HEADER: f64 = 34.0;

/// Height of a label's line, and width of a letter, roughly.
const LINE: f64 = 13.0;
const LETTER: f64 = 6.2;

const STYLE: &str = "\
    svg { background: #fff }\n\
    text { font: 12px sans-serif; fill: #333 }\n\
    .title { font-weight: bold }\n\
    .grid { stroke: #ddd }\n\
    .front { stroke: #0969da; fill: none; stroke-width: 1.5 }\n\
    .tier { fill: #cf222e }\n\
    .dial { fill: none; stroke: #777; stroke-width: 1.5 }\n\
    .name { font-weight: bold }\n\
    @media (prefers-color-scheme: dark) {\n\
    svg { background: #111 }\n\
    text { fill: #ddd }\n\
    .grid { stroke: #444 }\n\
    .front { stroke: #58a6ff }\n\
    .tier { fill: #ff7b72 }\n\
    .dial { stroke: #999 }\n\
    }\n";

/// Errors below this are drawn as this.
const LEAST: f64 = 1e-5;

/// A logarithmic axis over a little more than its values.
struct Axis {
    least: f64,
    most: f64,
}

impl Axis {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let (least, most) = values
            .map(f64::log10)
            .fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)));
        let margin = 0.12 * (most - least).max(0.2);
        Axis {
            least: least - margin,
            most: most + margin,
        }
    }

    /// 0 to 1.
    fn place(&self, value: f64) -> f64 {
        (value.log10() - self.least) / (self.most - self.least)
    }

    /// Powers of ten on it, with numbers between them where there are few.
    fn marks(&self) -> Vec<f64> {
        let powers = self.least.floor() as i32..=self.most.ceil() as i32;
        let factors: &[f64] = match self.most - self.least {
            ..0.8 => &[1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0],
            ..2.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let marks = powers.flat_map(|power| factors.iter().map(move |factor| factor * 10f64.powi(power)));
        marks.filter(|&mark| (0.0..=1.0).contains(&self.place(mark))).collect()
    }
}

/// Panels of the tiers that trade anything, Cortex-M4 to the left and M0 to the right.
pub fn draw(sweeps: &[Sweep]) -> String {
    let (across, down) = (LEFT + WIDTH + RIGHT, TOP + HEIGHT + BOTTOM);
    let sweeps: Vec<_> = sweeps.iter().filter(|sweep| trades(sweep)).collect();
    let (width, height) = (2.0 * across, HEADER + sweeps.len() as f64 * down);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\">\n\
         <style>\n{STYLE}</style>\n"
    );
    text(
        &mut svg,
        [LEFT, 22.0],
        "start",
        "title",
        "Mean error in levels of 255 against instructions per pixel",
    );
    for (row, sweep) in sweeps.iter().enumerate() {
        for machine in 0..2 {
            let at = [LEFT + machine as f64 * across, HEADER + TOP + row as f64 * down];
            put(
                &mut svg,
                format_args!("<g transform=\"translate({} {})\">\n", at[0], at[1]),
            );
            panel(&mut svg, sweep, machine);
            svg += "</g>\n";
        }
    }
    svg + "</svg>\n"
}

fn trades(sweep: &Sweep) -> bool {
    sweep.scene != "flat" && TIERS.iter().all(|tier| sweep.point(tier).is_some())
}

fn panel(svg: &mut String, sweep: &Sweep, machine: usize) {
    let cost = |point: &Point| sweep.per_pixel(point, machine);
    let error = |point: &Point| point.errors.mean.max(LEAST);
    let (x, y) = (
        Axis::of(sweep.points.iter().map(cost)),
        Axis::of(sweep.points.iter().map(error)),
    );
    let place = |cost: f64, error: f64| [x.place(cost) * WIDTH, (1.0 - y.place(error)) * HEIGHT];
    for mark in x.marks() {
        let [at, _] = place(mark, LEAST);
        put(svg, format_args!("<path class=\"grid\" d=\"M{at:.1} 0V{HEIGHT}\"/>\n"));
        text(svg, [at, HEIGHT + 16.0], "middle", "", &format!("{mark}"));
    }
    for mark in y.marks() {
        let [_, at] = place(1.0, mark);
        put(svg, format_args!("<path class=\"grid\" d=\"M0 {at:.1}H{WIDTH}\"/>\n"));
        text(svg, [-6.0, at + 4.0], "end", "", &format!("{mark}"));
    }
    let title = format!("{}, {}", title(&sweep.scene), MACHINES[machine].1);
    text(svg, [0.0, -10.0], "start", "title", &title);
    text(
        svg,
        [WIDTH / 2.0, HEIGHT + 34.0],
        "middle",
        "",
        "instructions per pixel",
    );

    let mut front: Vec<_> = sweep.points.iter().filter(|p| sweep.is_on_front(p, machine)).collect();
    front.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    let front: Vec<_> = front.iter().map(|p| place(cost(p), error(p))).collect();
    let corners = front.iter().map(|corner| corner.map(|v| format!("{v:.1}")).join(","));
    let corners = corners.collect::<Vec<_>>().join(" ");
    put(svg, format_args!("<polyline class=\"front\" points=\"{corners}\"/>\n"));
    let mut labels = Labels::default();
    front
        .windows(2)
        .for_each(|ends| labels.keep_line_free(ends[0], ends[1]));
    // The tiers first: they get the places beside their points.
    let is_tier = |point: &&Point| TIERS.contains(&point.dial.as_str());
    let (tiers, dials): (Vec<_>, Vec<_>) = sweep.points.iter().partition(is_tier);
    let points = tiers
        .iter()
        .chain(&dials)
        .map(|point| (*point, place(cost(point), error(point))));
    let points: Vec<_> = points.collect();
    for (point, [px, py]) in &points {
        let class = if is_tier(point) { "tier" } else { "dial" };
        put(
            svg,
            format_args!("<circle class=\"{class}\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"4\"/>\n"),
        );
        labels.keep_free([px - 4.0, py - 4.0, px + 4.0, py + 4.0]);
    }
    for (point, at) in points {
        let class = if is_tier(&point) { "name" } else { "" };
        let (at, anchor) = labels.place(at, &point.dial);
        text(svg, at, anchor, class, &point.dial);
    }
}

/// Where something is written already: left, top, right, bottom.
#[derive(Default)]
struct Labels(Vec<[f64; 4]>);

impl Labels {
    fn keep_free(&mut self, area: [f64; 4]) {
        self.0.push(area);
    }

    fn keep_line_free(&mut self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) {
        let steps = (x1 - x0).hypot(y1 - y0).ceil() as u32 / 4 + 1;
        for share in (0..=steps).map(|step| f64::from(step) / f64::from(steps)) {
            let [x, y] = [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
            self.keep_free([x, y, x, y]);
        }
    }

    /// The nearest free place to the right or to the left of a point.
    fn place(&mut self, [x, y]: [f64; 2], label: &str) -> ([f64; 2], &'static str) {
        let width = label.len() as f64 * LETTER;
        let area = |right: bool, down: f64| {
            let left = if right { x + 8.0 } else { x - 8.0 - width };
            [left, y - 5.0 + down, left + width, y - 5.0 + down + LINE]
        };
        let is_free = |[left, top, right, bottom]: [f64; 4]| {
            let apart = |o: &[f64; 4]| right < o[0] || o[2] < left || bottom < o[1] || o[3] < top;
            left >= 0.0 && right <= WIDTH + RIGHT && self.0.iter().all(apart)
        };
        let downs = (0..12).flat_map(|i| [f64::from(i) * 6.0, f64::from(-i) * 6.0]);
        let mut places = downs.flat_map(|down| [(true, down), (false, down)]);
        let (right, down) = places
            .find(|&(right, down)| is_free(area(right, down)))
            .unwrap_or((true, 0.0));
        self.0.push(area(right, down));
        let at = [if right { x + 8.0 } else { x - 8.0 }, y + 4.0 + down];
        (at, if right { "start" } else { "end" })
    }
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, class: &str, what: &str) {
    put(
        svg,
        format_args!("<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{what}</text>\n"),
    );
}

fn put(svg: &mut String, what: std::fmt::Arguments<'_>) {
    // A string takes whatever is written.
    let _: std::fmt::Result = svg.write_fmt(what);
}

#[cfg(test)]
mod tests {
    use super::super::points::tests::{point, sweep};
    use super::*;

    #[test]
    fn every_point_is_drawn_and_named_on_both_machines() {
        let points = vec![
            point("fast", 10.0, 2.0),
            point("balanced", 20.0, 1.0),
            point("exact", 30.0, 0.5),
            point("affine", 29.0, 0.5),
        ];
        let alone = sweep(vec![point("nearest", 10.0, 2.0)]);
        let svg = draw(&[sweep(points), alone]);
        assert_eq!(svg.matches("<circle").count(), 8);
        assert!(
            ["fast", "balanced", "exact", "affine"]
                .iter()
                .all(|name| svg.matches(&format!(">{name}<")).count() == 2)
        );
    }

    #[test]
    fn labels_do_not_lie_on_one_another() {
        let mut labels = Labels::default();
        let places: Vec<_> = (0..5).map(|_| labels.place([100.0, 100.0], "a label")).collect();
        assert!((0..5).all(|i| (0..i).all(|j| places[i] != places[j])));
    }

    #[test]
    fn marks_lie_on_the_axis() {
        assert_eq!(Axis::of([20.0, 200.0].into_iter()).marks(), [20.0, 50.0, 100.0, 200.0]);
    }
}
