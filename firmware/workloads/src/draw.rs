//! The measured regions: prepared triangles to pixels, through the core's raster door, and nothing else.
//!
//! One function per kind of drawing, never inlined: its code can be found and read in the image.

use fixel::depth::NoDepth;
use fixel::draw::triangle;
use fixel::fragment::{Flat, Gouraud565};
use fixel::screen::Corner;
use fixel::varying::Linear;

use crate::bytes::Vertex;
use crate::frame::Frame;

/// A triangle of one colour.
pub type FlatTriangle = ([Corner<()>; 3], u16);
/// A triangle with a colour at each corner.
pub type GouraudTriangle = [Corner<Linear<3>>; 3];

/// `corners` for [`flat`] and [`flat_depth`]: the colour is the first corner's.
pub fn prepare_flat(corners: [Vertex; 3]) -> FlatTriangle {
    let [first, ..] = corners;
    (corners.map(Vertex::flat), first.rgb565())
}

/// `corners` for [`gouraud`] and [`gouraud_depth`].
pub fn prepare_gouraud(corners: [Vertex; 3]) -> GouraudTriangle {
    corners.map(Vertex::gouraud)
}

/// One colour, no depth.
#[inline(never)]
pub fn flat(frame: &mut Frame, triangles: &[FlatTriangle]) {
    let Ok(mut color) = frame.color() else { return };
    for (corners, pixel) in triangles {
        triangle(&mut color, &mut NoDepth, *corners, &Flat(*pixel));
    }
}

/// One colour, with depth.
#[inline(never)]
pub fn flat_depth(frame: &mut Frame, triangles: &[FlatTriangle]) {
    let Ok((mut color, mut depth)) = frame.with_depth() else {
        return;
    };
    for (corners, pixel) in triangles {
        triangle(&mut color, &mut depth, *corners, &Flat(*pixel));
    }
}

/// Interpolated colour, no depth.
#[inline(never)]
pub fn gouraud(frame: &mut Frame, triangles: &[GouraudTriangle]) {
    let Ok(mut color) = frame.color() else { return };
    for corners in triangles {
        triangle(&mut color, &mut NoDepth, *corners, &Gouraud565);
    }
}

/// Interpolated colour, with depth.
#[inline(never)]
pub fn gouraud_depth(frame: &mut Frame, triangles: &[GouraudTriangle]) {
    let Ok((mut color, mut depth)) = frame.with_depth() else {
        return;
    };
    for corners in triangles {
        triangle(&mut color, &mut depth, *corners, &Gouraud565);
    }
}
