//! Sutherland and Hodgman's cutting of polygons and lines by planes, on homogeneous points.
//!
//! The pipeline cuts with the same rule, and weights of its own ([`clip`](mod@crate::clip)); this is for users.

use heapless::Vec;

use crate::clip::distance;
use crate::num::{Block, Scaled, Word};

/// plane · point, as the two are given: at least 0 inside.
///
/// ```
/// use fixel::{num::Block, pipeline::plane_distance};
/// let [plane, point] = [[-180, 300, 0, 0], [20, 20, 0, 1]].map(Block::<i32, 4>::from_integers);
/// assert_eq!(plane_distance(plane, point).to_fixed(0), 2400);
/// ```
pub fn plane_distance<T: Word>(plane: Block<T, 4>, point: Block<T, 4>) -> Scaled<T> {
    let exponent = plane.exponent().saturating_add(point.exponent());
    Scaled::from_wide([distance(plane.mantissas(), point.mantissas())], exponent)
}

/// What of a convex polygon lies inside a plane, in `cut`, which is emptied first: whether it had room for all corners,
/// one more than there were.
///
/// Corners inside stay as they are, in their order; a cut is (1 − t)·a + t·b with t = d(a)/(d(a) − d(b)), w and all. A
/// cut lies within 2^(4−BITS) of the largest component of its two ends.
///
/// ```
/// use fixel::{num::Block, pipeline::clip_polygon};
/// use heapless::Vec;
/// let triangle = [[0, 0, 0, 1], [4, 0, 0, 1], [0, 4, 0, 1]].map(Block::<i32, 4>::from_integers);
/// let left_of_2 = Block::from_integers([-1, 0, 0, 2]);
/// let mut cut = Vec::<_, 4>::new();
/// assert!(clip_polygon(&triangle, left_of_2, &mut cut));
/// assert_eq!(cut, [[0, 0, 0, 1], [2, 0, 0, 1], [2, 2, 0, 1], [0, 4, 0, 1]].map(Block::from_integers));
/// ```
pub fn clip_polygon<T: Word, const N: usize>(
    polygon: &[Block<T, 4>],
    plane: Block<T, 4>,
    cut: &mut Vec<Block<T, 4>, N>,
) -> bool {
    cut.clear();
    let Some(&last) = polygon.last() else {
        return true;
    };
    let mut fits = true;
    let mut previous = (last, plane_distance(plane, last));
    for &corner in polygon {
        let current = (corner, plane_distance(plane, corner));
        if is_inside(current.1) != is_inside(previous.1) {
            fits &= cut.push(crossing(previous, current)).is_ok();
        }
        if is_inside(current.1) {
            fits &= cut.push(corner).is_ok();
        }
        previous = current;
    }
    fits
}

/// What of a line lies inside a plane, in the same direction; `None` for nothing.
///
/// ```
/// use fixel::{num::Block, pipeline::clip_line};
/// let ends = [[0, -10, 0, 1], [0, 10, 0, 1]].map(Block::<i32, 4>::from_integers);
/// let upper = clip_line(ends, Block::from_integers([0, 1, 0, 0]));
/// assert_eq!(upper, Some([[0, 0, 0, 1], [0, 10, 0, 1]].map(Block::from_integers)));
/// ```
pub fn clip_line<T: Word>([a, b]: [Block<T, 4>; 2], plane: Block<T, 4>) -> Option<[Block<T, 4>; 2]> {
    let (from, to) = ((a, plane_distance(plane, a)), (b, plane_distance(plane, b)));
    match (is_inside(from.1), is_inside(to.1)) {
        (false, false) => None,
        (true, true) => Some([a, b]),
        (true, false) => Some([a, crossing(from, to)]),
        (false, true) => Some([crossing(from, to), b]),
    }
}

fn is_inside<T: Word>(distance: Scaled<T>) -> bool {
    let [d] = distance.mantissas();
    d >= T::ZERO
}

/// Where the edge between two points of different sides crosses the plane.
fn crossing<T: Word>((a, d_a): (Block<T, 4>, Scaled<T>), (b, d_b): (Block<T, 4>, Scaled<T>)) -> Block<T, 4> {
    let whole = d_a.minus(d_b);
    let part = |d: Scaled<T>| d.over(whole).unwrap_or(Scaled::ZERO);
    a.times(part(d_b.negated())).plus(b.times(part(d_a)))
}
