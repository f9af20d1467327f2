//! Pictures about pictures: where the two differ and why, and how deep the pixels lie.
//!
//! The legend of the classified difference picture, from harmless to a bug: black *equal*, blue *colour*, yellow
//! *edge*, green *depth*, cyan *texel*, magenta *pole*, orange *steep*, red **unexplained**.

use crate::compare::Class;
use crate::picture::Picture;

/// The colour of a class in the classified difference picture.
pub fn class_color(class: Class) -> [u8; 4] {
    match class {
        Class::Equal => [0, 0, 0, 255],
        Class::Colour => [64, 96, 255, 255],
        Class::Edge => [255, 255, 0, 255],
        Class::Depth => [0, 200, 0, 255],
        Class::Texel => [0, 255, 255, 255],
        Class::Pole => [255, 0, 255, 255],
        Class::Steep => [255, 144, 0, 255],
        Class::Unexplained => [255, 0, 0, 255],
    }
}

/// The classified difference picture; one class per pixel.
pub fn classes(width: u32, height: u32, classes: &[Class]) -> Picture {
    let pixels = classes.iter().map(|&class| class_color(class)).collect();
    Picture::new(width, height, pixels)
}

/// Depths as grey, 0 black to 65535 white, cut off like every colour: floor(255·depth/65535).
pub fn depths(width: u32, height: u32, depths: &[u16]) -> Picture {
    let grey = |&depth: &u16| {
        let [value, ..] = (depth / 257).to_le_bytes();
        [value, value, value, 255]
    };
    Picture::new(width, height, depths.iter().map(grey).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_classes_look_alike() {
        let all = [
            Class::Equal,
            Class::Colour,
            Class::Edge,
            Class::Depth,
            Class::Texel,
            Class::Pole,
            Class::Steep,
            Class::Unexplained,
        ];
        let colors: std::collections::HashSet<_> = all.map(class_color).into();
        assert_eq!(colors.len(), all.len());
    }

    #[test]
    fn depth_is_grey() {
        let picture = depths(4, 1, &[0, 256, 32768, 65535]);
        let grey: Vec<_> = picture.pixels.iter().map(|pixel| pixel[0]).collect();
        assert_eq!(grey, [0, 0, 127, 255]);
    }
}
