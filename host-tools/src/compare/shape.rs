//! An outline of the log, ready to be asked about samples: does the core cover it, and at what depth?

use super::interval::Interval;
use super::piece::Piece;
use super::screen::{Screen, guard};
use super::stated::DEPTH_ROUNDING;
use crate::reference::log::{Corner, Outline, doubled_area};

/// Whether the core covers a sample with a polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coverage {
    /// It may: the sample is within δ of an edge or of the border of the depth range.
    Perhaps,
    /// It does.
    Certain,
}

/// What a polygon may do at a sample.
#[derive(Debug, Clone, Copy)]
pub struct Claim {
    /// Whether the sample is covered.
    pub coverage: Coverage,
    /// z/w as the core may have it, half a step of 16 bits included.
    pub depth: Interval,
}

/// An outline of the log.
pub struct Shape<'a> {
    /// The log's entry.
    pub outline: &'a Outline,
    pieces: Vec<Piece<'a>>,
    screen: Screen,
    /// The picture's centre, in px.
    centre: [f64; 2],
    /// Whether moving the corners by their reach may turn the polygon over, so that `cull` may decide otherwise.
    flimsy: bool,
}

impl<'a> Shape<'a> {
    /// The outline on a screen.
    pub fn new(outline: &'a Outline, screen: &Screen) -> Self {
        let corners = &outline.outer;
        let sides = clipping_sides(corners, screen);
        let piece = |i: usize| {
            let fan = [corners[0], corners[i - 1], corners[i]];
            Piece::new(fan, outline, sides, screen)
        };
        Self {
            outline,
            pieces: (2..corners.len()).map(piece).collect(),
            screen: *screen,
            centre: screen.size.map(|s| s / 2.0),
            flimsy: doubled_area(corners).abs() <= area_error(corners),
        }
    }

    /// First and last column and row, both included, that the core may cover; none if all are off the picture.
    pub fn bounds(&self, width: u32, height: u32) -> Option<[[usize; 2]; 2]> {
        let last = [width, height].map(|s| f64::from(s) - 1.0);
        if self.outline.wild {
            return Some(last.map(|last| [0, last as usize]));
        }
        let span = |axis: usize| {
            let ends = self.outline.outer.iter().map(|c| (c.position[axis], c.reach));
            let low = ends.clone().map(|(x, r)| x - r).fold(f64::INFINITY, f64::min);
            let high = ends.map(|(x, r)| x + r).fold(f64::NEG_INFINITY, f64::max);
            let (first, end) = (low.ceil().max(0.0), high.floor().min(last[axis]));
            (first <= end).then_some([first as usize, end as usize])
        };
        Some([span(0)?, span(1)?])
    }

    /// What the polygon may do at a sample; none if it certainly does not cover it.
    pub fn claim(&self, p: [f64; 2]) -> Option<Claim> {
        if self.outline.wild {
            let (coverage, depth) = (Coverage::Perhaps, Interval::ALL);
            return Some(Claim { coverage, depth });
        }
        let on_edges = self.coverage(p)?;
        let depth = (self.near(p).map(|piece| piece.depth(p))).reduce(Interval::join)?;
        let range = self.screen.depths;
        if depth.high < range.low || depth.low > range.high {
            return None;
        }
        // The range is decided on the unrounded depth.
        let coverage = if range.holds(depth) {
            on_edges
        } else {
            Coverage::Perhaps
        };
        let depth = (self.near(p).map(|piece| piece.interpolated_depth(p))).reduce(Interval::join)?;
        let depth = depth.widened(DEPTH_ROUNDING * self.screen.depth_step());
        Some(Claim { coverage, depth })
    }

    fn coverage(&self, p: [f64; 2]) -> Option<Coverage> {
        let outer = Ring::around(&self.outline.outer, self.centre, p);
        let near_an_edge = !outer.clear;
        if self.outline.culled {
            return (self.flimsy && near_an_edge).then_some(Coverage::Perhaps);
        }
        if !outer.inside && !near_an_edge {
            return None;
        }
        let inner = match &self.outline.inner {
            Some(corners) => Ring::around(corners, self.centre, p),
            None => outer,
        };
        let certain = inner.inside && inner.clear && !self.flimsy;
        Some(if certain { Coverage::Certain } else { Coverage::Perhaps })
    }

    /// The pieces that a sample may belong to.
    pub fn near(&self, p: [f64; 2]) -> impl Iterator<Item = &Piece<'a>> {
        let alone = self.pieces.len() == 1;
        self.pieces.iter().filter(move |piece| {
            let ring = || Ring::around(&piece.corners, self.centre, p);
            alone || ring().inside || !ring().clear
        })
    }
}

/// Where a sample lies with respect to a convex polygon.
#[derive(Debug, Clone, Copy)]
struct Ring {
    /// On the inner side of every edge.
    inside: bool,
    /// No edge, moved with its ends by their reach, can come to lie on it.
    clear: bool,
}

impl Ring {
    fn around(corners: &[Corner], centre: [f64; 2], p: [f64; 2]) -> Self {
        let turn = doubled_area(corners).signum();
        let mut ring = Self {
            inside: corners.len() >= 3,
            clear: true,
        };
        for (i, a) in corners.iter().enumerate() {
            let edge = Edge::between(a, &corners[(i + 1) % corners.len()], centre, p);
            ring.inside &= edge.side * turn >= 0.0;
            ring.clear &= edge.clearance > 0.0;
        }
        ring
    }
}

/// A sample seen from an edge.
struct Edge {
    /// The sign tells the side.
    side: f64,
    /// Least distance from a point that may come to lie on the moved edge's line, less how far it moves across, in px.
    clearance: f64,
}

impl Edge {
    /// An end is moved by its shift in any direction, and by ε times its distance from the centre along the line to the
    /// centre; across the edge that is ε times the centre's distance from the edge's line. So a point at s of the edge moves
    /// across by at most δ(s), the mean of the ends' shares, so that a far end does not count where it is far; and the ends
    /// lengthen the edge. The distance to the point at s less δ(s) is convex in s: its minimum is at an end or where the slope
    /// is 0.
    fn between(a: &Corner, b: &Corner, centre: [f64; 2], p: [f64; 2]) -> Self {
        let along = [0, 1].map(|i| b.position[i] - a.position[i]);
        let length = along[0].hypot(along[1]);
        if !length.is_finite() {
            // Nothing is known of where it lies.
            return Self {
                side: 0.0,
                clearance: f64::NEG_INFINITY,
            };
        }
        if length == 0.0 {
            let from = [0, 1].map(|i| p[i] - a.position[i]);
            let clearance = from[0].hypot(from[1]) - a.reach.max(b.reach);
            return Self { side: 0.0, clearance };
        }
        let (side, foot) = seen(a, b, p);
        let from_centre = seen(a, b, centre).0.abs() / length;
        let across = |c: &Corner| c.shift + c.weight_error * from_centre;
        let (start, end) = (a.shift - a.reach, length + b.reach - b.shift);
        let slope = (across(b) - across(a)) / length;
        let clearance = |s: f64| (s - foot).hypot(side / length) - (across(a) + slope * s.clamp(0.0, length));
        let mut least = clearance(start).min(clearance(end));
        if slope.abs() < 1.0 {
            let lowest = foot + (side / length).abs() * slope / (1.0 - slope * slope).sqrt();
            least = least.min(clearance(lowest.clamp(start, end)));
        }
        Self { side, clearance: least }
    }
}

/// A point from an edge: its distance from the edge's line times the edge's length, the sign telling the side, and how far
/// along the edge its foot is. Seen from the nearer end, since the other may be 10⁸ px away.
fn seen(a: &Corner, b: &Corner, p: [f64; 2]) -> (f64, f64) {
    let along = [0, 1].map(|i| b.position[i] - a.position[i]);
    let from = |c: &Corner| [0, 1].map(|i| p[i] - c.position[i]);
    let (to_a, to_b) = (from(a), from(b));
    let a_is_nearer = to_a[0].hypot(to_a[1]) <= to_b[0].hypot(to_b[1]);
    let near = if a_is_nearer { to_a } else { to_b };
    let length = along[0].hypot(along[1]);
    let dot = (along[0] * near[0] + along[1] * near[1]) / length;
    let side = along[0] * near[1] - along[1] * near[0];
    (side, if a_is_nearer { dot } else { length + dot })
}

/// How many of the depth range's borders and the guard band's sides cut the polygon: each can add a corner. A corner that
/// the core sees beyond a border by its error only adds one right beside it, which moves nothing.
fn clipping_sides(corners: &[Corner], screen: &Screen) -> usize {
    let guard = guard(screen.size);
    let beyond = |outside: &dyn Fn(&Corner) -> bool| usize::from(corners.iter().any(outside));
    beyond(&|c| c.z < screen.depths.low)
        + beyond(&|c| c.z > screen.depths.high)
        + beyond(&|c| c.position[0] < -guard)
        + beyond(&|c| c.position[0] > guard)
        + beyond(&|c| c.position[1] < -guard)
        + beyond(&|c| c.position[1] > guard)
}

/// How much the doubled area may change when the corners move by their reaches, to first order and a margin for the second.
fn area_error(corners: &[Corner]) -> f64 {
    let n = corners.len();
    let largest = corners.iter().map(|c| c.reach).fold(0.0, f64::max);
    let mut error = 0.0;
    for (i, corner) in corners.iter().enumerate() {
        let (a, b) = (corners[(i + n - 1) % n].position, corners[(i + 1) % n].position);
        error += corner.reach * ((b[0] - a[0]).hypot(b[1] - a[1]) + 2.0 * largest);
    }
    error
}
