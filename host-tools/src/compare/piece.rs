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
//! To do so it moves a row's values as a whole, those of N and of Q each by itself, wherever one end of the row would leave the range:
//! by at most (spread + 1) · δ times the gradient, since what the plane should have there lies within the range.

use std::array::from_fn;

use super::interval::Interval;
use super::linear::{Frame, Linear, Range};
use super::screen::{Screen, guard};
use super::stated::{DEPTH_PER_COLUMN, INVERSE, PERSPECTIVE};
use crate::reference::log::{Corner, Outline};

/// The functions through a triangle's corners.
#[derive(Debug, Clone, Copy)]
struct Fit {
    frame: Frame,
    depth: Linear,
    depth_error: Linear,
    reach: Linear,
    q: Linear,
}

/// One triangle.
#[derive(Debug, Clone, Copy)]
pub struct Piece<'a> {
    /// Its corners.
    pub corners: [Corner; 3],
    outline: &'a Outline,
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
    /// Whether the depth range or the guard band may cut it, and has corners of its own.
    cut: bool,
}

impl<'a> Piece<'a> {
    /// A triangle of an outline's fan; `sides` is how many of the depth range's borders and the guard band's sides may cut it, each of
    /// which can add a corner to those that share its values.
    pub fn new(corners: [Corner; 3], outline: &'a Outline, sides: usize, screen: &Screen) -> Self {
        let size = screen.size;
        let fit = Fit::through(&corners, size);
        let guard = guard(size);
        // What shares its values with a far corner has the units that this one needs.
        let sharing = sharing(&corners, outline);
        let count = sharing.len() + sides;
        let mut greatest_q = Interval::of(sharing.iter().map(|c| c.w.recip().abs())).high;
        if let Some(fit) = fit {
            let band = [[-guard, -guard], [guard, -guard], [-guard, guard], [guard, guard]];
            greatest_q = greatest_q.min(Interval::of(band.map(|p| fit.q.at(p).abs())).high);
        }
        let extents = [0, 1].map(|i| {
            let range = Interval::of(outline.outer.iter().map(|c| c.position[i].clamp(-guard, guard)));
            range.high - range.low + 1.0
        });
        Self {
            corners,
            outline,
            fit,
            greatest_q,
            extents,
            spread: (2 * count - 5) as f64,
            walk: (size[0] + size[1] + 8.0) * f64::EPSILON,
            depth_steps: DEPTH_PER_COLUMN * (extents[0] + 8.0) * screen.depth_step(),
            cut: sides > 0,
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
        let here = fit.reach.at(p).max(all.low) + fit.frame.noise * all.high;
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
        let error = fit.depth_error.at(p).clamp(errors.low, errors.high) + fit.frame.noise * errors.high;
        Interval::around(fit.depth.at(p), fit.depth.slope() * by)
            .clamped(range)
            .widened(error + (fit.frame.noise + self.walk) * largest)
    }

    /// N values in perspective as the core may have them at a sample; `known` are the reference's own there, else the triangle's
    /// are continued to it. `lowering` is the core's error of a value before it is interpolated. None is a pole: 1/w is within
    /// its bound of 0 there, and the values may be anything.
    pub fn values<const N: usize>(
        &self,
        p: [f64; 2],
        of: fn(&Corner) -> [f64; N],
        known: Option<[f64; N]>,
        lowering: f64,
    ) -> Option<Range<N>> {
        let least = self.least_q(p);
        if self.outline.mixed && least <= INVERSE * self.greatest_q {
            return None;
        }
        let numerators = self.numerators(of);
        let bound = lowering + self.interpolation(numerators.as_ref().map(|n| &n[..]), self.greatest(of), least);
        let quotients = |n: [Linear; N], fit: &Fit| n.map(|n| n.at(p) / fit.q.at(p));
        let own = numerators.zip(self.fit.as_ref()).map(|(n, fit)| quotients(n, fit));
        let value = known.or(own).unwrap_or([f64::NAN; N]);
        let moved = from_fn(|i| {
            let range = Interval::of(sharing(&self.corners, self.outline).iter().map(|c| of(c)[i] / c.w));
            let free = self.along(p, numerators.map(|n| (n[i], range)), value[i], least);
            let range = Interval::of(sharing(&self.corners, self.outline).iter().map(|c| of(c)[i]));
            if self.outline.mixed { free } else { free.clamped(range) }
        });
        Some(Range {
            value,
            moved,
            full: moved.map(|m| m.widened(bound)),
        })
    }

    /// How far apart float64 may have a value here and in the reference, which walks there by adding steps, and over the triangles of
    /// the polygon's fan: four times what one way there rounds.
    pub fn noise<const N: usize>(&self, p: [f64; 2], of: fn(&Corner) -> [f64; N]) -> f64 {
        let noise = self.fit.map_or(f64::INFINITY, |fit| fit.frame.noise);
        4.0 * (self.walk + noise) * self.greatest(of) * self.ratio(p)
    }

    /// The most columns of a span, those off the picture included.
    pub fn columns(&self) -> f64 {
        self.extents[0]
    }

    /// The largest 1/w that counts over the least that a sample may have.
    pub fn ratio(&self, p: [f64; 2]) -> f64 {
        self.greatest_q / self.least_q(p)
    }

    /// In how many times larger units than usual the core carries the values.
    pub fn headroom(&self) -> f64 {
        self.outline.headroom
    }

    /// The largest of some values at the polygon's corners.
    pub fn greatest<const N: usize>(&self, of: impl Fn(&Corner) -> [f64; N]) -> f64 {
        let all = self.outline.outer.iter().flat_map(of);
        all.map(f64::abs).fold(0.0, f64::max)
    }

    fn numerators<const N: usize>(&self, of: fn(&Corner) -> [f64; N]) -> Option<[Linear; N]> {
        let corners = self.corners.map(|c| of(&c).map(|v| v / c.w));
        let frame = self.fit?.frame;
        Some(from_fn(|i| frame.linear(corners.map(|values| values[i]))))
    }

    /// The error of interpolation: relative to the greatest value, in proportion to 1/w, and what the gradients add up to.
    fn interpolation(&self, numerators: Option<&[Linear]>, greatest: f64, least: f64) -> f64 {
        let weights = Interval::of(self.corners.map(|c| c.weight_error)).high;
        let noise = self.fit.map_or(0.0, |fit| fit.frame.noise);
        // Values with headroom are rounded at the corners to 2⁻¹⁹ of the largest; colours that are not lit have none.
        let units = (self.outline.headroom / 8.0).max(1.0);
        let relative = PERSPECTIVE * units + 2.0 * weights + self.walk + noise;
        let swing = |n: &[Linear]| Interval::of(n.iter().map(|n| n.swing(self.extents))).high.max(0.0);
        let q = self.fit.map_or(0.0, |fit| fit.q.swing(self.extents));
        let swing = numerators.map_or(0.0, swing) + greatest * q;
        (relative * self.greatest_q * greatest + swing) / least
    }

    /// N/Q and what moving by δ makes of it: |∇N - v ∇Q| δ over the least Q within δ. `numerator` with the corners' range.
    fn along(&self, p: [f64; 2], numerator: Option<(Linear, Interval)>, value: f64, least: f64) -> Interval {
        let Some(((n, range), fit)) = numerator.zip(self.fit) else {
            return Interval::ALL;
        };
        let moved = self.spread * self.reach(p);
        let q_range = Interval::of(sharing(&self.corners, self.outline).iter().map(|c| 1.0 / c.w));
        let (kept, kept_q) = (self.kept(p, &n, range), self.kept(p, &fit.q, q_range));
        if fit.q.at(p).abs() <= fit.q.slope() * moved || least <= kept_q {
            return Interval::ALL;
        }
        let along = [0, 1].map(|i| n.gradient[i] - value * fit.q.gradient[i]);
        let by = along[0].hypot(along[1]) * moved + kept + value.abs() * kept_q;
        Interval::around(value, by / (least - kept_q))
    }

    /// By how much the core may move the values of the sample's row to keep its ends within the corners' `range`. Of three corners, it
    /// moves none.
    fn kept(&self, p: [f64; 2], function: &Linear, range: Interval) -> f64 {
        if self.spread <= 1.0 {
            return 0.0;
        }
        let reach = Interval::of(self.outline.outer.iter().map(|c| c.reach)).high;
        // The plane there, and where the row ends.
        let most = function.slope() * (self.spread + 1.0) * reach;
        let Some(ends) = self.row(p[1], reach).filter(|_| !self.cut) else {
            return most;
        };
        let beyond = |x: f64| {
            let value = function.at([x, p[1]]);
            (value - range.high).max(range.low - value) + most
        };
        beyond(ends[0]).max(beyond(ends[1])).clamp(0.0, most)
    }

    /// Where the polygon begins and ends in the rows within `reach` of y; none where it has none.
    fn row(&self, y: f64, reach: f64) -> Option<[f64; 2]> {
        let corners = &self.outline.outer;
        let mut row = [f64::INFINITY, f64::NEG_INFINITY];
        for (i, a) in corners.iter().enumerate() {
            let (a, b) = (a.position, corners[(i + 1) % corners.len()].position);
            let [top, bottom] = [a[1].min(b[1]), a[1].max(b[1])];
            if bottom < y - reach || top > y + reach {
                continue;
            }
            for end in [y - reach, y + reach].map(|y| y.clamp(top, bottom)) {
                let part = if a[1] == b[1] {
                    [0.0, 1.0]
                } else {
                    [(end - a[1]) / (b[1] - a[1]); 2]
                };
                for x in part.map(|t| a[0] + t * (b[0] - a[0])) {
                    row = [row[0].min(x), row[1].max(x)];
                }
            }
        }
        Some(row).filter(|row| row[0] <= row[1])
    }

    /// The least |1/w| within δ of a sample; with one sign it is never below the corners' least.
    fn least_q(&self, p: [f64; 2]) -> f64 {
        let corners = Interval::of(self.corners.map(|c| c.w.recip().abs())).low;
        let here = self.fit.map_or(0.0, |fit| {
            fit.q.at(p).abs() - fit.q.slope() * self.spread * self.reach(p)
        });
        if self.outline.mixed { here } else { here.max(corners) }
    }
}

/// The corners that have one plane of values with those of a triangle of the fan.
fn sharing<'c>(triangle: &'c [Corner; 3], outline: &'c Outline) -> &'c [Corner] {
    if outline.fanned { triangle } else { &outline.outer }
}

impl Fit {
    fn through(corners: &[Corner; 3], size: [f64; 2]) -> Option<Self> {
        let frame = Frame::through(corners, size)?;
        let linear = |value: fn(&Corner) -> f64| frame.linear(corners.each_ref().map(value));
        Some(Self {
            frame,
            depth: linear(|c| c.z),
            depth_error: linear(|c| c.depth_error),
            reach: linear(|c| c.reach),
            q: linear(|c| 1.0 / c.w),
        })
    }
}
