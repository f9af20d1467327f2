//! `line` and `wuline` (formats/mp1.md section 4): one step per sample along x or y, the near end in, the far end out.

use super::clip::{self, corner};
use super::fragment::Canvas;
use super::screen::{Point, values};
use crate::reference::raster::{Walk, X, Y, Z};
use crate::scene::mp1::Vertex;

/// Draws a line of one sample's width: at each step the sample nearest to it on the other axis, halves up.
pub fn line(canvas: &mut Canvas<'_>, ends: &[Vertex; 2]) {
    walk(canvas, ends, |canvas, along, at, point, color| {
        let other = (point[along.other] + 0.5).floor();
        along.draw(canvas, at, other, point, color);
    });
}

/// Draws an antialiased line: at each step the two samples around it share its alpha.
pub fn wu_line(canvas: &mut Canvas<'_>, ends: &[Vertex; 2]) {
    walk(canvas, ends, |canvas, along, at, point, color| {
        let [r, g, b, alpha] = color;
        let first = point[along.other].floor();
        let share = point[along.other] - first;
        along.draw(canvas, at, first, point, [r, g, b, alpha * (1.0 - share)]);
        along.draw(canvas, at, first + 1.0, point, [r, g, b, alpha * share]);
    });
}

/// Which axis is stepped along.
#[derive(Clone, Copy)]
struct Along {
    step: usize,
    other: usize,
}

impl Along {
    /// A fragment at `at` along the stepped axis and `other` on the other one, which may be off the picture.
    fn draw(self, canvas: &mut Canvas<'_>, at: usize, other: f64, point: &Point, color: [f64; 4]) {
        let limit = if self.step == X { canvas.height } else { canvas.width };
        if !(0.0..f64::from(limit)).contains(&other) {
            return;
        }
        let other = other as usize;
        let (column, row) = if self.step == X { (at, other) } else { (other, at) };
        canvas.fragment(column, row, point[Z], color);
    }
}

/// Visits the steps of a line: the coordinate along the stepped axis, the point there, and its colour.
fn walk(canvas: &mut Canvas<'_>, ends: &[Vertex; 2], visit: impl Fn(&mut Canvas<'_>, Along, usize, &Point, [f64; 4])) {
    let corners = ends.each_ref().map(|vertex| corner(vertex, canvas.switches.srgb));
    let clipped = clip::line(corners, clip::frustum(canvas.switches));
    let Some([Some(a), Some(b)]) = clipped.map(|ends| ends.map(|c| canvas.screen.place(&c))) else {
        return;
    };
    let (along, limit) = if (b[X] - a[X]).abs() >= (b[Y] - a[Y]).abs() {
        (Along { step: X, other: Y }, canvas.width)
    } else {
        (Along { step: Y, other: X }, canvas.height)
    };
    let (from, to) = if a[along.step] <= b[along.step] { (a, b) } else { (b, a) };
    for (at, point) in Walk::new(&from, &to, along.step, limit) {
        if let Some([r, g, b, alpha, _, _]) = values(&point) {
            visit(canvas, along, at, &point, [r, g, b, alpha]);
        }
    }
}
