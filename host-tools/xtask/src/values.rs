//! What was drawn against real numbers: colour and depth of every pixel, each triangle by itself.

use fixel_workloads::draw::{
    gouraud_depth, prepare_gouraud, prepare_spanned, prepare_textured, spanned_depth, textured_depth,
};
use fixel_workloads::frame::{Frame, HEIGHT, WIDTH};
use serde_json::{Value, json};

use crate::exactness::covers;
use crate::failure::Failure;
use crate::workloads::{Corner, TEXELS, Triangle, Workloads};

/// Most that a colour may be off, in levels of RGB565, and a depth, in steps.
const MOST: f64 = 1.0;

/// Workloads with interpolated colour and depth.
const GOURAUD: [&str; 2] = ["W2", "W4"];

/// Most that a texel's place may be off where it is divided for at every pixel, in texels, and by reciprocals from a table.
const MOST_TEXEL: f64 = 1.0 / 32.0;
const MOST_SPANNED: f64 = 0.5;

/// How textured triangles are drawn: the region's name, what draws one by itself, and what it may be off.
type Textured = (&'static str, fn(&mut Frame, Triangle), f64);

/// All ways.
const TEXTURED: [Textured; 2] = [
    (
        "W3_exact",
        |frame, triangle| textured_depth(frame, &[prepare_textured(triangle)]),
        MOST_TEXEL,
    ),
    (
        "W3_spans",
        |frame, triangle| spanned_depth(frame, &[prepare_spanned(triangle)]),
        MOST_SPANNED,
    ),
];

/// The worst of a workload.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figure {
    /// Which workload.
    pub name: &'static str,
    /// What was looked at.
    pub what: &'static str,
    /// In which unit.
    pub unit: &'static str,
    /// The largest error.
    pub worst: f64,
    /// What it may be.
    pub most: f64,
    /// Pixels beyond that.
    pub off: u64,
}

impl Figure {
    fn new(name: &'static str, what: &'static str, unit: &'static str, most: f64) -> Self {
        Figure {
            name,
            what,
            unit,
            worst: 0.0,
            most,
            off: 0,
        }
    }

    fn add(&mut self, error: f64) {
        self.worst = self.worst.max(error);
        self.off += u64::from(error > self.most);
    }

    /// One member of a JSON object.
    pub fn as_json(&self) -> (String, Value) {
        let worst = (self.worst * 1e4).round() / 1e4;
        let figures = json!({"worst": worst, "most": self.most, "unit": self.unit, "pixels_off": self.off});
        (format!("{}_{}", self.name, self.what), figures)
    }
}

/// All errors.
pub fn of(workloads: &Workloads) -> Result<Vec<Figure>, Failure> {
    let mut figures = Vec::new();
    for name in GOURAUD {
        figures.extend(gouraud(name, workloads)?);
    }
    for way in TEXTURED {
        figures.extend(textured(way, workloads)?);
    }
    Ok(figures)
}

fn gouraud(name: &'static str, workloads: &Workloads) -> Result<[Figure; 2], Failure> {
    let mut colors = Figure::new(name, "color", "levels of 565", MOST);
    let mut depths = Figure::new(name, "depth", "steps", MOST);
    let mut frame = Box::new(Frame::new());
    for (real, triangle) in workloads.corners(name)?.iter().zip(workloads.triangles(name)?) {
        frame.clear();
        gouraud_depth(&mut frame, &[prepare_gouraud(triangle)]);
        let (color, depth) = frame.words();
        for at in covered(&triangle) {
            let weights = weights(&triangle, at);
            let channel = |of: fn(&Corner) -> f64| mean(weights, real.each_ref().map(of));
            let expected = [
                channel(|c| c.color[0]) * 31.0 / 255.0,
                channel(|c| c.color[1]) * 63.0 / 255.0,
                channel(|c| c.color[2]) * 31.0 / 255.0,
            ];
            let levels = [color[at] >> 11, color[at] >> 5 & 63, color[at] & 31].map(f64::from);
            let errors = expected.iter().zip(levels).map(|(real, level)| (real - level).abs());
            colors.add(errors.fold(0.0, f64::max));
            depths.add((channel(|c| c.z) * 65535.0 - f64::from(depth[at])).abs());
        }
    }
    Ok([colors, depths])
}

/// Texels tell their place. The one drawn is wrong by as much as the real place lies outside it.
fn textured((name, draw, most): Textured, workloads: &Workloads) -> Result<[Figure; 2], Failure> {
    let mut texels = Figure::new(name, "place", "texels", most);
    let mut depths = Figure::new(name, "depth", "steps", MOST);
    let mut frame = Box::new(Frame::new());
    for (real, triangle) in workloads.corners("W3")?.iter().zip(workloads.triangles("W3")?) {
        frame.clear();
        draw(&mut frame, triangle);
        let (color, depth) = frame.words();
        for at in covered(&triangle) {
            let weights = weights(&triangle, at);
            let over_w = |of: fn(&Corner) -> f64| mean(weights, real.each_ref().map(|c| of(c) / c.w));
            let w = 1.0 / over_w(|_| 1.0);
            let place = [over_w(|c| c.uv[0]) * w * TEXELS, over_w(|c| c.uv[1]) * w * TEXELS];
            let drawn = [color[at] % 64, color[at] / 64].map(f64::from);
            let errors = place.iter().zip(drawn).map(|(real, texel)| beside(*real, texel));
            texels.add(errors.fold(0.0, f64::max));
            depths.add((mean(weights, real.each_ref().map(|c| c.z)) * 65535.0 - f64::from(depth[at])).abs());
        }
    }
    Ok([texels, depths])
}

/// How far a place lies outside of a texel; the texture repeats.
fn beside(place: f64, texel: f64) -> f64 {
    let from = (place - texel - 0.5 + TEXELS / 2.0).rem_euclid(TEXELS) - TEXELS / 2.0;
    (from.abs() - 0.5).max(0.0)
}

/// The pixels that a triangle covers, by exact geometry.
pub fn covered(triangle: &Triangle) -> impl Iterator<Item = usize> + use<'_> {
    let range = |of: fn(&Triangle) -> [i32; 3], most: u16| {
        let values = of(triangle);
        let least = values.into_iter().fold(i32::MAX, i32::min) >> 8;
        let last = values.into_iter().fold(i32::MIN, i32::max) >> 8;
        least.clamp(0, most.into()) as usize..(last + 1).clamp(0, most.into()) as usize
    };
    let columns = range(|t| t.map(|v| v.x), WIDTH);
    let rows = range(|t| t.map(|v| v.y), HEIGHT);
    let pixels = rows.flat_map(move |y| columns.clone().map(move |x| y * usize::from(WIDTH) + x));
    pixels.filter(|&at| covers(triangle, at))
}

/// The share of each corner at the sample of pixel `at`.
pub fn weights(triangle: &Triangle, at: usize) -> [f64; 3] {
    let columns = usize::from(WIDTH);
    let sample = ((at % columns) as f64 * 256.0, (at / columns) as f64 * 256.0);
    let [a, b, c] = triangle.map(|v| (f64::from(v.x), f64::from(v.y)));
    let area = |(ax, ay): (f64, f64), (bx, by): (f64, f64), (cx, cy): (f64, f64)| {
        (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    };
    [(sample, b, c), (a, sample, c), (a, b, sample)].map(|(p, q, r)| area(p, q, r) / area(a, b, c))
}

/// What three corners' values come to.
pub fn mean(weights: [f64; 3], values: [f64; 3]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_just_beyond_is_off() {
        let mut figure = Figure::new("W2", "depth", "steps", MOST);
        [0.5, 1.0, 1.001].iter().for_each(|&error| figure.add(error));
        assert_eq!((figure.worst, figure.off), (1.001, 1));
    }

    #[test]
    fn a_place_is_in_its_texel_or_beside_it() {
        let beside = [
            (5.0, 5.0),
            (5.99, 5.0),
            (6.25, 5.0),
            (4.5, 5.0),
            (63.75, 0.0),
            (0.25, 63.0),
        ]
        .map(|(p, t)| beside(p, t));
        assert_eq!(beside, [0.0, 0.0, 0.25, 0.5, 0.25, 0.25]);
    }

    #[test]
    fn a_corner_has_its_own_value_and_an_edge_the_mean() {
        let corner = |x: i32, y: i32| fixel_workloads::bytes::Vertex {
            x: x << 8,
            y: y << 8,
            depth: 0,
            color: [0; 3],
            inverse_w: 1 << 30,
            texel: [0; 2],
        };
        let triangle = [corner(0, 0), corner(0, 4), corner(4, 0)];
        let at = |x: usize, y: usize| mean(weights(&triangle, y * usize::from(WIDTH) + x), [1.0, 2.0, 5.0]);
        assert_eq!(
            [at(0, 0), at(0, 4), at(4, 0), at(2, 0), at(0, 2)],
            [1.0, 2.0, 5.0, 3.0, 1.5]
        );
        assert_eq!(covered(&triangle).count(), 10);
    }
}
