//! The texture: every texel tells its own place.

/// Texels along a side.
pub const SIDE: usize = 64;

/// Texels, row by row.
pub static TEXELS: [u16; SIDE * SIDE] = {
    let mut texels = [0; SIDE * SIDE];
    let mut i = 0;
    while i < texels.len() {
        texels[i] = 0x8000 | i as u16;
        i += 1;
    }
    texels
};
