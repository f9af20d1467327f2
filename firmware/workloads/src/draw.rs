//! The measured regions: prepared triangles to pixels, through the core's raster door, and nothing else.
//!
//! One function per kind of drawing, never inlined: its code can be found and read in the image.

use core::hint::black_box;

use fixel::depth::NoDepth;
use fixel::draw::triangle;
use fixel::fragment::{Compact, Flat565, Gouraud565};
use fixel::screen::Corner;
use fixel::texture::Tiled565;
use fixel::varying::{Color565, Perspective32, PerspectiveSpans};

use crate::bytes::Vertex;
use crate::frame::Frame;

/// A triangle of one colour.
pub type FlatTriangle = ([Corner<()>; 3], u16);
/// A triangle with a colour at each corner.
pub type GouraudTriangle = [Corner<Color565>; 3];

/// A textured triangle in perspective.
pub type TexturedTriangle = [Corner<Perspective32<2>>; 3];

/// Perspective to within half a texel: 92/256 by subdivision, the rest is left to arithmetic.
pub type HalfTexel = PerspectiveSpans<2, 92>;

/// A textured triangle in perspective, by reciprocals from a table.
pub type SpannedTriangle = [Corner<HalfTexel>; 3];

/// Texels of a side of [`TEXTURE`].
pub const TEXTURE_SIDE: usize = 64;

/// Every texel is its own place, v·64 + u, so that a wrong one is seen.
pub static TEXTURE: [[u16; TEXTURE_SIDE]; TEXTURE_SIDE] = {
    let mut texels = [[0; TEXTURE_SIDE]; TEXTURE_SIDE];
    let mut place = 0;
    while place < TEXTURE_SIDE * TEXTURE_SIDE {
        texels[place / TEXTURE_SIDE][place % TEXTURE_SIDE] = place as u16;
        place += 1;
    }
    texels
};

/// `corners` for [`textured_depth`].
pub fn prepare_textured(corners: [Vertex; 3]) -> TexturedTriangle {
    corners.map(Vertex::textured)
}

/// Texels in perspective, a division at every pixel, with depth.
#[inline(never)]
pub fn textured_depth(frame: &mut Frame, triangles: &[TexturedTriangle]) {
    let Ok((mut color, mut depth)) = frame.with_depth() else {
        return;
    };
    // Textures are loaded, in general: their address is no constant.
    let texture = Tiled565::new(black_box(&TEXTURE));
    for corners in triangles {
        triangle(&mut color, &mut depth, corners, &texture);
    }
}

/// `corners` for [`spanned_depth`].
pub fn prepare_spanned(corners: [Vertex; 3]) -> SpannedTriangle {
    corners.map(Vertex::spanned)
}

/// Texels in perspective to within half a texel, with depth.
#[inline(never)]
pub fn spanned_depth(frame: &mut Frame, triangles: &[SpannedTriangle]) {
    let Ok((mut color, mut depth)) = frame.with_depth() else {
        return;
    };
    let texture = Tiled565::new(black_box(&TEXTURE));
    for corners in triangles {
        triangle(&mut color, &mut depth, corners, &texture);
    }
}

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
        triangle(&mut color, &mut NoDepth, corners, &Flat565::new(*pixel));
    }
}

/// One colour, with depth.
#[inline(never)]
pub fn flat_depth(frame: &mut Frame, triangles: &[FlatTriangle]) {
    let Ok((mut color, mut depth)) = frame.with_depth() else {
        return;
    };
    for (corners, pixel) in triangles {
        triangle(&mut color, &mut depth, corners, &Flat565::new(*pixel));
    }
}

/// Interpolated colour, no depth.
#[inline(never)]
pub fn gouraud(frame: &mut Frame, triangles: &[GouraudTriangle]) {
    let Ok(mut color) = frame.color() else { return };
    for corners in triangles {
        triangle(&mut color, &mut NoDepth, corners, &Gouraud565);
    }
}

/// Interpolated colour, with depth.
#[inline(never)]
pub fn gouraud_depth(frame: &mut Frame, triangles: &[GouraudTriangle]) {
    let Ok((mut color, mut depth)) = frame.with_depth() else {
        return;
    };
    for corners in triangles {
        triangle(&mut color, &mut depth, corners, &Gouraud565);
    }
}

/// As [`gouraud_depth`], by less code.
#[inline(never)]
pub fn gouraud_depth_compact(frame: &mut Frame, triangles: &[GouraudTriangle]) {
    let Ok((mut color, mut depth)) = frame.with_depth() else {
        return;
    };
    for corners in triangles {
        triangle(&mut color, &mut depth, corners, &Compact(Gouraud565));
    }
}
