//! A triangle of a polygon, and what values the core may have at a sample of it.
//!
//! Why the bounds are exact, slivers included: let the corners P move to P + d with |d| ≤ δ and keep their values. A sample
//! p inside the moved triangle is Σ b (P + d) with weights b ≥ 0 that sum to 1, so every value linear on the screen is there
//! what it is at p - Σ b d in the unmoved one: the value at a point at most δ away, and between the corners' values.
//! Perspective-correct values N/Q are too, since N and Q are linear and go along together.
//!
//! A clipped polygon of n corners has its values from the largest triangle of its fan alone, and a sample outside that one
//! has weights of both signs: at most one is negative, and at least -(n - 3), since no triangle of the fan is larger.
//! So Σ|b| ≤ 2n - 5 =: spread, and the displacement is at most spread · δ. The corners' range still holds: the core clamps to it.

use super::interval::Interval;
use super::stated::{COLOR_LEVELS, DEPTH_PER_COLUMN, GRADIENT, GUARD, PERSPECTIVE, WIDE_GUARD};
use crate::reference::log::{Corner, Polygon};

/// A function linear on the screen.
#[derive(Debug, Clone, Copy)]
struct Linear {
    origin: [f64; 2],
    value: f64,
    gradient: [f64; 2],
}

impl Linear {
    fn at(&self, p: [f64; 2]) -> f64 {
        self.value + self.gradient[0] * (p[0] - self.origin[0]) + self.gradient[1] * (p[1] - self.origin[1])
    }

    /// What the core's relative error of gradients adds up to over the extents of a polygon.
    fn swing(&self, extents: [f64; 2]) -> f64 {
        GRADIENT * (self.gradient[0].abs() * extents[0] + self.gradient[1].abs() * extents[1])
    }

    fn slope(&self) -> f64 {
        self.gradient[0].hypot(self.gradient[1])
    }
}

/// The functions through a triangle's corners.
#[derive(Debug, Clone, Copy)]
struct Fit {
    depth: Linear,
    depth_error: Linear,
    reach: Linear,
    q: Linear,
    colors: [Linear; 3],
    /// Rounding of these functions in float64, relative to the largest corner value.
    noise: f64,
}

/// One triangle.
#[derive(Debug, Clone, Copy)]
pub struct Piece {
    /// Its corners.
    pub corners: [Corner; 3],
    mixed: bool,
    gouraud: bool,
    /// None if the triangle has no area that float64 can tell.
    fit: Option<Fit>,
    /// The largest |1/w| of the triangle inside the guard band.
    greatest_q: f64,
    /// Width and height of the polygon, as far as it lies in the guard band.
    extents: [f64; 2],
    /// See the module.
    spread: f64,
    /// Rounding of the reference, which adds steps along rows and columns, relative to the largest value.
    walk: f64,
    /// Stepping of the core's depth along a row, in z/w.
    depth_steps: f64,
}

/// Half the side of the guard band of a picture of `size` px.
pub fn guard(size: [f64; 2]) -> f64 {
    if size[0].max(size[1]) <= GUARD {
        GUARD
    } else {
        WIDE_GUARD
    }
}

impl Piece {
    /// A triangle of a polygon's fan in a picture of `size` px; `count` is the most corners that clipping leaves the polygon.
    pub fn new(corners: [Corner; 3], polygon: &Polygon, count: usize, size: [f64; 2]) -> Self {
        let fit = Fit::through(&corners, size);
        let guard = guard(size);
        let mut greatest_q = Interval::of(corners.map(|c| c.w.recip().abs())).high;
        if let Some(fit) = fit {
            let band = [[-guard, -guard], [guard, -guard], [-guard, guard], [guard, guard]];
            greatest_q = greatest_q.min(Interval::of(band.map(|p| fit.q.at(p).abs())).high);
        }
        let extents = [0, 1].map(|i| {
            let range = Interval::of(polygon.outer.iter().map(|c| c.position[i].clamp(-guard, guard)));
            range.high - range.low + 1.0
        });
        Self {
            corners,
            mixed: polygon.mixed,
            gouraud: polygon.gouraud,
            fit,
            greatest_q,
            extents,
            spread: (2 * count - 5) as f64,
            walk: (size[0] + size[1] + 8.0) * f64::EPSILON,
            depth_steps: DEPTH_PER_COLUMN * (size[0] + 8.0) / 65535.0,
        }
    }

    /// δ at a sample in px: the displacement is the corners' mean at the unmoved point, which is itself δ away.
    fn reach(&self, p: [f64; 2]) -> f64 {
        let all = Interval::of(self.corners.map(|c| c.reach));
        let Some(fit) = self.fit else { return all.high };
        let slope = fit.reach.slope();
        if slope >= 1.0 {
            return all.high;
        }
        let here = fit.reach.at(p).max(all.low) + fit.noise * all.high;
        (here / (1.0 - slope)).min(all.high)
    }

    /// z/w of the unmoved points that may lie on a sample: what decides about the border of the depth range.
    pub fn depth(&self, p: [f64; 2]) -> Interval {
        self.moved_depth(p, self.reach(p))
    }

    /// z/w as the core interpolates it, before it is rounded to 16 bits.
    pub fn interpolated_depth(&self, p: [f64; 2]) -> Interval {
        let swing = self.fit.map_or(0.0, |fit| fit.depth.swing(self.extents));
        self.moved_depth(p, self.spread * self.reach(p))
            .widened(self.depth_steps + swing)
    }

    fn moved_depth(&self, p: [f64; 2], by: f64) -> Interval {
        let range = Interval::of(self.corners.map(|c| c.z));
        let errors = Interval::of(self.corners.map(|c| c.depth_error));
        let largest = range.low.abs().max(range.high.abs());
        let Some(fit) = self.fit else {
            return range.widened(errors.high + self.walk * largest);
        };
        let error = fit.depth_error.at(p).clamp(errors.low, errors.high) + fit.noise * errors.high;
        Interval::around(fit.depth.at(p), fit.depth.slope() * by)
            .clamped(range)
            .widened(error + (fit.noise + self.walk) * largest)
    }

    /// The colour as the core may have it at a sample; `known` is the reference's own value there, else the triangle's is
    /// continued to it. None is a pole: 1/w is within its bound of 0 there, and the colour may be anything.
    pub fn color(&self, p: [f64; 2], known: Option<[f64; 3]>) -> Option<[Interval; 3]> {
        let greatest = self
            .corners
            .iter()
            .flat_map(|c| c.color.map(f64::abs))
            .fold(0.0, f64::max);
        let arithmetic = COLOR_LEVELS / 255.0 * greatest.max(1.0);
        if !self.gouraud {
            return Some(self.corners[0].color.map(|c| Interval::around(c, arithmetic)));
        }
        let (least, fit) = (self.least_q(p), self.fit);
        if self.mixed && least <= PERSPECTIVE * self.greatest_q {
            return None;
        }
        let weights = Interval::of(self.corners.map(|c| c.weight_error)).high;
        let noise = fit.map_or(0.0, |fit| fit.noise);
        let relative = PERSPECTIVE + 2.0 * weights + self.walk + noise;
        let ratio = self.greatest_q / least;
        let swing = fit.map_or(0.0, |fit| fit.color_swing(self.extents, greatest)) / least;
        let bound = arithmetic + relative * ratio * greatest + swing;
        Some([0, 1, 2].map(|channel| {
            let range = Interval::of(self.corners.map(|c| c.color[channel]));
            let value = self.value(p, channel, known.map(|k| k[channel]), least);
            let inside = if self.mixed { value } else { value.clamped(range) };
            inside.widened(bound)
        }))
    }

    /// N/Q and what moving by δ makes of it: |∇N - c ∇Q| δ over the least Q within δ.
    fn value(&self, p: [f64; 2], channel: usize, known: Option<f64>, least: f64) -> Interval {
        let Some(fit) = self.fit else { return Interval::ALL };
        let (n, q) = (fit.colors[channel], fit.q);
        let moved = self.spread * self.reach(p);
        if q.at(p).abs() <= q.slope() * moved {
            return Interval::ALL;
        }
        let value = known.unwrap_or_else(|| n.at(p) / q.at(p));
        let along = [0, 1].map(|i| n.gradient[i] - value * q.gradient[i]);
        Interval::around(value, along[0].hypot(along[1]) * moved / least)
    }

    /// The least |1/w| within δ of a sample; with one sign it is never below the corners' least.
    fn least_q(&self, p: [f64; 2]) -> f64 {
        let corners = Interval::of(self.corners.map(|c| c.w.recip().abs())).low;
        let here = self.fit.map_or(0.0, |fit| {
            fit.q.at(p).abs() - fit.q.slope() * self.spread * self.reach(p)
        });
        if self.mixed { here } else { here.max(corners) }
    }
}

impl Fit {
    /// |ΔN| + |c| |ΔQ| of the worst channel.
    fn color_swing(&self, extents: [f64; 2], greatest: f64) -> f64 {
        let numerators = self.colors.map(|n| n.swing(extents));
        Interval::of(numerators).high + greatest * self.q.swing(extents)
    }

    fn through(corners: &[Corner; 3], size: [f64; 2]) -> Option<Self> {
        let distance = |c: &Corner| (c.position[0] - size[0] / 2.0).hypot(c.position[1] - size[1] / 2.0);
        // From the corner nearest to the screen, so that rounding grows with the distance from there.
        let mut sorted = *corners;
        sorted.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let origin = sorted[0].position;
        let [a, b] = [1, 2].map(|k| [0, 1].map(|i| sorted[k].position[i] - origin[i]));
        let area = a[0] * b[1] - a[1] * b[0];
        let noise = 4.0 * f64::EPSILON * a[0].hypot(a[1]) * b[0].hypot(b[1]) / area.abs();
        if noise.is_nan() || noise > 1e-3 {
            return None;
        }
        let linear = |value: &dyn Fn(&Corner) -> f64| {
            let value = [value(&sorted[0]), value(&sorted[1]), value(&sorted[2])];
            let (da, db) = (value[1] - value[0], value[2] - value[0]);
            Linear {
                origin,
                value: value[0],
                gradient: [(da * b[1] - db * a[1]) / area, (db * a[0] - da * b[0]) / area],
            }
        };
        Some(Self {
            depth: linear(&|c| c.z),
            depth_error: linear(&|c| c.depth_error),
            reach: linear(&|c| c.reach),
            q: linear(&|c| 1.0 / c.w),
            colors: [0, 1, 2].map(|i| linear(&|c| c.color[i] / c.w)),
            noise,
        })
    }
}
