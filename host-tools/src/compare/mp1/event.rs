//! What a mark may do at one sample: whether it covers it, at what depth, and with which fragments.

use super::mark::{Figure, Mark};
use super::paint::{Fragment, Values, fragments};
use crate::compare::interval::Interval;
use crate::compare::screen::{Screen, guard};
use crate::compare::shape::{Coverage, Shape};
use crate::compare::stated::{ALONG, DEPTH_PER_COLUMN, DEPTH_ROUNDING, GRADIENT, SIZE_ROUNDING, SNAP};
use crate::compare::tiles;
use crate::reference::attributes::CARRIED;
use crate::reference::log::Corner;

/// A mark, ready to be asked about samples.
pub struct Drawn<'a> {
    mark: &'a Mark,
    /// The shapes of a triangle.
    shapes: Vec<Shape<'a>>,
    screen: Screen,
}

/// What happens at a sample.
pub struct Event {
    /// Whether the sample is covered.
    pub coverage: Coverage,
    /// z/w as the core may have it, half a step of 16 bits included.
    pub depth: Interval,
    /// Whether the sample lies on an edge between triangles of a fan, so that each fragment may be another's than the reference's.
    pub is_between: bool,
    /// What may be drawn: one of these.
    pub fragments: Vec<Fragment>,
}

/// Where a sample lies: how far inside, at the least; below 0 it is outside.
struct Inside {
    margin: f64,
    bound: f64,
}

impl Inside {
    /// None if it is certainly outside.
    fn coverage(&self) -> Option<Coverage> {
        if self.margin > self.bound {
            Some(Coverage::Certain)
        } else {
            (self.margin >= -self.bound).then_some(Coverage::Perhaps)
        }
    }
}

impl<'a> Drawn<'a> {
    /// A mark on a screen.
    pub fn new(mark: &'a Mark, screen: &Screen) -> Self {
        let shapes = match &mark.figure {
            Figure::Triangle(outlines) => outlines.iter().map(|outline| Shape::new(outline, screen)).collect(),
            _ => Vec::new(),
        };
        Self {
            mark,
            shapes,
            screen: *screen,
        }
    }

    /// The samples that it may touch; none if all are off the picture.
    pub fn bounds(&self) -> Option<tiles::Bounds> {
        let [width, height] = self.screen.size.map(|s| s as u32);
        if let Figure::Triangle(_) = self.mark.figure {
            let all = self.shapes.iter().filter_map(|shape| shape.bounds(width, height));
            return all.reduce(|a, b| [0, 1].map(|i| [a[i][0].min(b[i][0]), a[i][1].max(b[i][1])]));
        }
        let around: &[Corner] = match &self.mark.figure {
            Figure::Triangle(_) => &[],
            Figure::Square(_, centre) | Figure::Disc(_, centre) => std::slice::from_ref(centre),
            Figure::Line(ends) | Figure::WuLine(ends) => ends,
        };
        let margin = match &self.mark.figure {
            Figure::Square(size, _) | Figure::Disc(size, _) => size / 2.0 + 1.0,
            _ => 2.0,
        };
        let span = |axis: usize| {
            let range = Interval::of(around.iter().flat_map(|c| {
                let by = margin + c.reach;
                [c.position[axis] - by, c.position[axis] + by]
            }));
            let last = self.screen.size[axis] - 1.0;
            let (first, end) = (range.low.ceil().max(0.0), range.high.floor().min(last));
            (first <= end).then_some([first as usize, end as usize])
        };
        Some([span(0)?, span(1)?])
    }

    /// What it may do at a sample, in drawing order: nothing if it certainly does nothing, more than one thing if it is a fan of
    /// triangles through infinity, which are separate and may overlap.
    pub fn events(&self, p: [f64; 2]) -> Vec<Event> {
        let one = match &self.mark.figure {
            Figure::Triangle(_) => return self.shapes.iter().filter_map(|shape| self.polygon(shape, p)).collect(),
            Figure::Square(size, centre) => self.square(p, *size, centre),
            Figure::Disc(size, centre) => self.disc(p, *size, centre),
            Figure::Line(ends) => self.line(p, ends, false),
            Figure::WuLine(ends) => self.line(p, ends, true),
        };
        one.into_iter().collect()
    }

    fn polygon(&self, shape: &Shape<'_>, p: [f64; 2]) -> Option<Event> {
        let claim = shape.claim(p)?;
        let fragments = if shape.outline.wild {
            vec![Fragment::ANYTHING]
        } else {
            (shape.near(p))
                .flat_map(|piece| self.fragments(Values::of_piece(piece, p, self.mark)))
                .collect()
        };
        Some(Event {
            coverage: claim.coverage,
            depth: claim.depth,
            is_between: !shape.outline.wild && shape.near(p).count() > 1,
            fragments,
        })
    }

    fn fragments(&self, values: Option<Values>) -> Vec<Fragment> {
        match values {
            Some(values) => fragments(&self.mark.paint, &values),
            None => vec![Fragment::ANYTHING],
        }
    }

    fn square(&self, p: [f64; 2], size: f64, centre: &Corner) -> Option<Event> {
        let half = size / 2.0;
        let side = |i: usize| {
            let from = p[i] - centre.position[i];
            (from + half).min(half - from)
        };
        let bound = side_error(centre, size);
        let inside = Inside {
            margin: side(0).min(side(1)),
            bound,
        };
        let texcoord = [0, 1].map(|i| (p[i] - centre.position[i] + half) / size);
        // A unit of 30 bits of the texture a column.
        let columns = size.min(self.screen.size[0].max(self.screen.size[1]));
        let arithmetic = (columns + 8.0) * CARRIED;
        // Of the centre's place on the screen, and of a few operations with it.
        let places = Interval::of([0, 1].map(|i| self.screen.size[i] + centre.position[i].abs())).high;
        let noise = 4.0 * f64::EPSILON * (places / size + 1.0);
        let values = Values::constant(
            centre,
            texcoord,
            [(bound + SIZE_ROUNDING) / size, arithmetic, noise],
            self.mark,
        );
        self.at_once(inside.coverage()?, centre, self.fragments(Some(values)))
    }

    fn disc(&self, p: [f64; 2], size: f64, centre: &Corner) -> Option<Event> {
        let [dx, dy] = [0, 1].map(|i| p[i] - centre.position[i]);
        let bound = side_error(centre, size);
        let inside = Inside {
            margin: size / 2.0 - dx.hypot(dy),
            bound,
        };
        let values = Values::constant(centre, [0.0; 2], [0.0; 3], self.mark);
        self.at_once(inside.coverage()?, centre, self.fragments(Some(values)))
    }

    /// At one depth for all samples.
    fn at_once(&self, coverage: Coverage, centre: &Corner, fragments: Vec<Fragment>) -> Option<Event> {
        let depth = Interval::around(centre.z, centre.depth_error);
        self.in_range(coverage, depth, fragments)
    }

    /// The event, if a z/w that is only known to an interval is not certainly outside the depths that are drawn.
    fn in_range(&self, coverage: Coverage, depth: Interval, fragments: Vec<Fragment>) -> Option<Event> {
        let range = self.screen.depths;
        if depth.high < range.low || depth.low > range.high {
            return None;
        }
        Some(Event {
            coverage: if range.holds(depth) && !self.mark.perhaps {
                coverage
            } else {
                Coverage::Perhaps
            },
            depth: depth.widened(DEPTH_ROUNDING * self.screen.depth_step()),
            is_between: false,
            fragments,
        })
    }

    /// The most steps that the core takes along a line: it starts at the guard band if not before.
    fn steps(&self, [a, b]: &[Corner; 2]) -> f64 {
        let extents = [0, 1].map(|i| (b.position[i] - a.position[i]).abs());
        let all = extents[0].max(extents[1]);
        all.min(2.0 * guard(self.screen.size)) + ALONG
    }

    fn line(&self, p: [f64; 2], ends: &[Corner; 2], antialiased: bool) -> Option<Event> {
        let [a, b] = ends;
        let reach = a.reach.max(b.reach);
        if !reach.is_finite() || [a, b].iter().any(|c| !c.position.iter().all(|x| x.is_finite())) {
            return Some(Event {
                coverage: Coverage::Perhaps,
                depth: Interval::ALL,
                is_between: false,
                fragments: vec![Fragment::ANYTHING],
            });
        }
        let [dx, dy] = [0, 1].map(|i| (b.position[i] - a.position[i]).abs());
        // Along x if that is longer or as long; ends that move may turn it.
        let turn = 4.0 * reach;
        let along: Vec<Along> = [(0, dx - dy), (1, dy - dx)]
            .into_iter()
            .filter(|&(_, longer)| longer >= -turn)
            .filter_map(|(axis, _)| Along::new(axis, ends, p, antialiased))
            .collect();
        let certain = (dx - dy).abs() > turn;
        let depths = along
            .iter()
            .map(|a| a.depth(ends, self.steps(ends) * self.screen.depth_step()));
        let depth = depths.reduce(Interval::join)?;
        let coverage = along
            .iter()
            .map(|a| a.coverage)
            .min_by_key(|c| *c == Coverage::Certain)?;
        let fragments = (along.iter())
            .flat_map(|a| {
                let mut fragments = self.fragments(Values::on_line(ends, a.part, self.steps(ends), self.mark));
                fragments.iter_mut().for_each(|f| f.fade(a.weight));
                fragments
            })
            .collect();
        let coverage = if certain { coverage } else { Coverage::Perhaps };
        self.in_range(coverage, depth, fragments)
    }
}

/// By how much a side of a square or a disc may be off: the centre's rounding, half the size's, and float64's own.
fn side_error(centre: &Corner, size: f64) -> f64 {
    centre.reach + SIZE_ROUNDING / 2.0 + 2.0 * f64::EPSILON * size
}

/// A sample on a line, seen along one axis.
struct Along {
    coverage: Coverage,
    /// Where between the ends, 0 to 1.
    part: Interval,
    /// How much of the pixel is covered.
    weight: Interval,
}

impl Along {
    /// None if the line certainly does not touch the sample.
    fn new(axis: usize, ends: &[Corner; 2], p: [f64; 2], antialiased: bool) -> Option<Self> {
        let across = 1 - axis;
        let [mut from, mut to] = *ends;
        let turned = to.position[axis] < from.position[axis];
        if turned {
            std::mem::swap(&mut from, &mut to);
        }
        let reach = from.reach.max(to.reach);
        let length = to.position[axis] - from.position[axis];
        let start = p[axis] - from.position[axis];
        let between = Inside {
            margin: start.min(length - start),
            bound: reach,
        };
        let part = if length > 0.0 {
            (start / length).clamp(0.0, 1.0)
        } else {
            0.5
        };
        let other = from.position[across] + part * (to.position[across] - from.position[across]);
        let distance = other - p[across];
        // Both axes' rounding, on a line of slope 1 at most; and float64's own of far ends.
        let bound = 2.0 * reach + 4.0 * f64::EPSILON * (from.position[across].abs() + to.position[across].abs());
        let near = Inside {
            margin: if antialiased {
                1.0 - distance.abs()
            } else {
                0.5 - distance.abs()
            },
            bound,
        };
        let coverage = match (between.coverage()?, near.coverage()?) {
            (Coverage::Certain, Coverage::Certain) => Coverage::Certain,
            _ => Coverage::Perhaps,
        };
        let whole = Interval { low: 0.0, high: 1.0 };
        let moved = if length > 0.0 {
            2.0 * (reach + SNAP) / length
        } else {
            1.0
        };
        let part = Interval::around(if turned { 1.0 - part } else { part }, moved).clamped(whole);
        let weight = if antialiased {
            Interval::around(near.margin, bound).clamped(whole)
        } else {
            Interval::around(1.0, 0.0)
        };
        Some(Self { coverage, part, weight })
    }

    /// In `steps` of depth along the line, each a unit of 2⁻¹⁵ off.
    fn depth(&self, [a, b]: &[Corner; 2], steps: f64) -> Interval {
        let at = |t: f64| a.z + t * (b.z - a.z);
        let error = a.depth_error.max(b.depth_error) + GRADIENT * (a.z - b.z).abs();
        Interval::of([at(self.part.low), at(self.part.high)]).widened(error + DEPTH_PER_COLUMN * steps)
    }
}
