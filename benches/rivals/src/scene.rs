//! Geometry as bytes: floats only, so that an image needs no parser.
//!
//! ```text
//! file     = { section }
//! section  = name: 16 bytes, padded with 0 · count: u32 · { f32 }
//! ```
//!
//! All little-endian. A section of triangles has nine numbers a corner, in the order of [`Corner`]'s fields.

use alloc::vec::Vec;

/// Bytes of a section's name.
const NAME_BYTES: usize = 16;

/// A corner of a triangle on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Pixels to the right; pixel centres lie at +½.
    pub x: f32,
    /// Pixels downwards.
    pub y: f32,
    /// 0, the nearest, to 1.
    pub z: f32,
    /// Distance, for what is in perspective.
    pub w: f32,
    /// Red, green and blue, 0 to 255.
    pub color: [f32; 3],
    /// Place in the texture, 0 to 1.
    pub uv: [f32; 2],
}

/// Wound counter-clockwise as seen.
pub type Triangle = [Corner; 3];

impl Corner {
    /// The colour in RGB565, rounded to nearest.
    pub fn rgb565(&self) -> u16 {
        let [red, green, blue] = self.color;
        let scale = |v: f32, most: f32| (v * most / 255.0 + 0.5) as u16;
        scale(red, 31.0) << 11 | scale(green, 63.0) << 5 | scale(blue, 31.0)
    }

    /// The whole pixel whose centre is nearest, for those who know no others.
    pub fn pixel(&self) -> [i32; 2] {
        [self.x, self.y].map(whole)
    }
}

/// Rounds a distance from the left or upper border down; centres at +½ make that the nearest pixel.
fn whole(v: f32) -> i32 {
    let cut = v as i32;
    if v < cut as f32 { cut - 1 } else { cut }
}

/// The numbers of section `name`; `None` where there is no such section.
pub fn numbers(mut file: &[u8], name: &str) -> Option<Vec<f32>> {
    loop {
        let (title, rest) = file.split_first_chunk::<NAME_BYTES>()?;
        let (count, rest) = rest.split_first_chunk::<4>()?;
        let (bytes, rest) = rest.split_at_checked(u32::from_le_bytes(*count) as usize * 4)?;
        if title.starts_with(name.as_bytes()) && title.get(name.len()).is_none_or(|&next| next == 0) {
            let (words, _) = bytes.as_chunks::<4>();
            return Some(words.iter().map(|&word| f32::from_le_bytes(word)).collect());
        }
        file = rest;
    }
}

/// The triangles of section `name`; none where there is no such section.
pub fn triangles(file: &[u8], name: &str) -> Vec<Triangle> {
    let numbers = numbers(file, name).unwrap_or_default();
    let (corners, _) = numbers.as_chunks::<9>();
    let (triangles, _) = corners.as_chunks::<3>();
    let corner = |&[x, y, z, w, red, green, blue, u, v]: &[f32; 9]| Corner {
        x,
        y,
        z,
        w,
        color: [red, green, blue],
        uv: [u, v],
    };
    triangles.iter().map(|t| t.each_ref().map(corner)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_is_found_by_its_whole_name() {
        let mut file = Vec::new();
        for (name, value) in [
            (b"W10\0\0\0\0\0\0\0\0\0\0\0\0\0", 1.0f32),
            (b"W1\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 2.0),
        ] {
            file.extend(name);
            file.extend(1u32.to_le_bytes());
            file.extend(value.to_le_bytes());
        }
        assert_eq!(numbers(&file, "W1"), Some([2.0].into()));
        assert_eq!(numbers(&file, "W2"), None);
    }

    #[test]
    fn pixels_are_those_whose_centre_is_nearest() {
        assert_eq!([-0.25, 0.0, 0.75, 1.0].map(whole), [-1, 0, 0, 1]);
    }
}
