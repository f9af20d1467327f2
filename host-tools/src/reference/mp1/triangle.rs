//! `tri` and `trit`: clip, place, cull, and a fan of triangles walked as raster.rs says.

use super::clip::{self, corner};
use super::color::over;
use super::fragment::{Canvas, texel};
use super::screen::{Point, values};
use crate::picture::Picture;
use crate::reference::raster::{self, X, Y, Z};
use crate::scene::mp1::Vertex;

/// Draws a triangle in its vertices' colours or with a texture.
pub fn draw(canvas: &mut Canvas<'_>, corners: &[Vertex; 3], texture: Option<&Picture>) {
    let switches = canvas.switches;
    let corners = corners.each_ref().map(|vertex| corner(vertex, switches.srgb));
    let planes = switches.clip_planes.iter().chain(clip::frustum(switches));
    let polygon = clip::triangle(&corners, planes);
    // One corner without a place, and the whole primitive is not drawn.
    let placed: Option<Vec<Point>> = polygon.iter().map(|c| canvas.screen.place(c)).collect();
    if let Some([first, rest @ ..]) = placed.as_deref() {
        for pair in rest.windows(2) {
            fill(canvas, &[*first, pair[0], pair[1]], texture);
        }
    }
}

fn fill(canvas: &mut Canvas<'_>, corners: &[Point; 3], texture: Option<&Picture>) {
    if canvas.switches.cull && !counter_clockwise(corners) {
        return;
    }
    let decals = canvas.switches.decals;
    raster::walk(corners, canvas.width, canvas.height, |column, row, point| {
        let Some([r, g, b, alpha, s, t]) = values(point) else {
            return;
        };
        let below = [r, g, b, alpha];
        let color = match texture.map(|texture| texel(texture, [s, t])) {
            None => below,
            Some(texel) if decals => over(texel, below),
            Some(texel) => texel,
        };
        canvas.fragment(column, row, point[Z], color);
    });
}

/// Whether the corners look counter-clockwise to a viewer, y pointing down.
pub fn counter_clockwise([a, b, c]: &[Point; 3]) -> bool {
    (b[X] - a[X]) * (c[Y] - a[Y]) - (b[Y] - a[Y]) * (c[X] - a[X]) < 0.0
}
