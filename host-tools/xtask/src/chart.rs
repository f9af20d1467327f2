//! Charts with logarithmic axes, as SVG for light and dark pages.

use std::fmt::Write;

/// Size of a panel's plot, and the margins that its text needs.
const WIDTH: f64 = 300.0;
const HEIGHT: f64 = 220.0;
const LEFT: f64 = 64.0;
const TOP: f64 = 64.0;
const BOTTOM: f64 = 44.0;
const GAP: f64 = 24.0;

const STYLE: &str = "\
    text { font: 12px sans-serif; fill: #333 }\n\
    .title { font-weight: bold }\n\
    .grid { stroke: #ddd }\n\
    .line { stroke: #0969da; fill: none; stroke-width: 1.5 }\n\
    .point { fill: #cf222e }\n\
    @media (prefers-color-scheme: dark) {\n\
    text { fill: #ddd }\n\
    .grid { stroke: #444 }\n\
    .line { stroke: #58a6ff }\n\
    .point { fill: #ff7b72 }\n\
    }\n";

/// One plot.
pub struct Panel {
    /// Above it.
    pub title: String,
    /// Below it.
    pub x: String,
    /// Beside it, at the top.
    pub y: String,
    /// What it shows.
    pub series: Series,
}

/// Points, and a line among them; all positive.
pub struct Series {
    /// Measured.
    pub points: Vec<[f64; 2]>,
    /// Fitted.
    pub line: Vec<[f64; 2]>,
}

/// Powers of ten that an axis spans.
struct Axis {
    least: i32,
    most: i32,
}

impl Axis {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let (least, most) = values
            .map(f64::log10)
            .fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)));
        Axis {
            least: least.floor() as i32,
            most: (most.ceil() as i32).max(least.floor() as i32 + 1),
        }
    }

    /// 0 to 1.
    fn place(&self, value: f64) -> f64 {
        (value.log10() - f64::from(self.least)) / f64::from(self.most - self.least)
    }
}

/// The panels side by side.
pub fn draw(title: &str, panels: &[Panel]) -> String {
    let width = panels.len() as f64 * (LEFT + WIDTH + GAP);
    let height = TOP + HEIGHT + BOTTOM;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\">\n\
         <style>\n{STYLE}</style>\n<text class=\"title\" x=\"{LEFT}\" y=\"20\">{}</text>\n",
        escaped(title)
    );
    for (i, panel) in panels.iter().enumerate() {
        svg += &format!(
            "<g transform=\"translate({} {TOP})\">\n",
            LEFT + i as f64 * (LEFT + WIDTH + GAP)
        );
        draw_panel(&mut svg, panel);
        svg += "</g>\n";
    }
    svg + "</svg>\n"
}

fn draw_panel(svg: &mut String, panel: &Panel) {
    let Series { points, line } = &panel.series;
    let x = Axis::of(points.iter().map(|p| p[0]));
    let y = Axis::of(points.iter().chain(line).map(|p| p[1]));
    for power in x.least..=x.most {
        let at = x.place(10f64.powi(power)) * WIDTH;
        *svg += &format!("<path class=\"grid\" d=\"M{at:.1} 0V{HEIGHT}\"/>\n");
        text(svg, [at, HEIGHT + 16.0], "middle", "", &power_of_ten(power));
    }
    for power in y.least..=y.most {
        let at = (1.0 - y.place(10f64.powi(power))) * HEIGHT;
        *svg += &format!("<path class=\"grid\" d=\"M0 {at:.1}H{WIDTH}\"/>\n");
        text(svg, [-6.0, at + 4.0], "end", "", &power_of_ten(power));
    }
    let place = |&[px, py]: &[f64; 2]| [x.place(px) * WIDTH, (1.0 - y.place(py)) * HEIGHT];
    let corners = line.iter().map(place).map(|[px, py]| format!("{px:.1},{py:.1}"));
    *svg += &format!(
        "<polyline class=\"line\" points=\"{}\"/>\n",
        corners.collect::<Vec<_>>().join(" ")
    );
    for [px, py] in points.iter().map(place) {
        // A string takes whatever is written.
        let _: std::fmt::Result = writeln!(svg, "<circle class=\"point\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"3.5\"/>");
    }
    text(svg, [0.0, -20.0], "start", "title", &panel.title);
    text(svg, [-6.0, -6.0], "start", "", &panel.y);
    text(svg, [WIDTH / 2.0, HEIGHT + 34.0], "middle", "", &panel.x);
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, class: &str, what: &str) {
    *svg += &format!("<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{what}</text>\n");
}

fn power_of_ten(power: i32) -> String {
    match power {
        0 => "1".into(),
        1 => "10".into(),
        _ => format!("10<tspan dy=\"-5\" font-size=\"9\">{power}</tspan>"),
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_span_whole_powers_of_ten() {
        let axis = Axis::of([3.0, 2_000.0].into_iter());
        assert_eq!((axis.least, axis.most), (0, 4));
        assert_eq!([1.0, 100.0, 10_000.0].map(|v| axis.place(v)), [0.0, 0.5, 1.0]);
        let single = Axis::of([10.0].into_iter());
        assert_eq!((single.least, single.most), (1, 2));
    }

    #[test]
    fn every_point_is_drawn() {
        let series = Series {
            points: vec![[1.0, 10.0], [10.0, 100.0]],
            line: vec![[1.0, 10.0], [10.0, 100.0]],
        };
        let panel = Panel {
            title: "a".into(),
            x: "n".into(),
            y: "cost".into(),
            series,
        };
        let svg = draw("a < b", &[panel]);
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(svg.contains("a &lt; b") && svg.ends_with("</svg>\n"));
    }
}
