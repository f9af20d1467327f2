//! Fragments (formats/mp1.md section 5): depth test, texel, blending.

use super::color::over;
use super::screen::Screen;
use super::{Rendered, Sample};
use crate::picture::Picture;
use crate::scene::mp1::{Scene, Switches};

/// The picture that is being drawn.
pub struct Canvas<'s> {
    /// What holds for the whole scene.
    pub switches: &'s Switches,
    /// Where vertices land.
    pub screen: Screen,
    /// Samples in a row.
    pub width: u32,
    /// Rows of samples.
    pub height: u32,
    /// The primitive that is being drawn, from 1.
    pub primitive: u32,
    picture: Rendered,
}

impl<'s> Canvas<'s> {
    /// An empty picture: every sample (0, 0, 0, 0) at depth 1.
    pub fn new(scene: &'s Scene) -> Self {
        let fsaa = scene.switches.fsaa;
        let (width, height) = (scene.width * fsaa, scene.height * fsaa);
        let empty = Sample {
            color: [0.0; 3],
            alpha: 0.0,
            depth: 1.0,
            primitive: 0,
        };
        Self {
            switches: &scene.switches,
            screen: Screen::new(scene),
            width,
            height,
            primitive: 0,
            picture: Rendered {
                width: scene.width,
                height: scene.height,
                fsaa,
                srgb: scene.switches.srgb,
                samples: vec![empty; width as usize * height as usize],
            },
        }
    }

    /// The picture.
    pub fn finish(self) -> Rendered {
        self.picture
    }

    /// A fragment on the picture: tested against the depth with `depth`, and blended over what is there. It stores its
    /// depth whatever its alpha. One that would leave nothing finite behind is left out.
    pub fn fragment(&mut self, column: usize, row: usize, depth: f64, color: [f64; 4]) {
        let sample = &mut self.picture.samples[row * self.width as usize + column];
        // Z = −1 and a Z equal to the stored one are drawn.
        if self.switches.depth && !(-1.0..=sample.depth).contains(&depth) {
            return;
        }
        let blended = over(color, sample.rgba());
        if blended.iter().any(|value| !value.is_finite()) {
            return;
        }
        let [r, g, b, alpha] = blended;
        *sample = Sample {
            color: [r, g, b],
            alpha,
            depth: if self.switches.depth { depth } else { sample.depth },
            primitive: self.primitive,
        };
    }
}

/// The texel that a texture coordinate picks: red, green, blue, alpha; 1 is full; never decoded.
pub fn texel(texture: &Picture, [s, t]: [f64; 2]) -> [f64; 4] {
    let column = texel_index(s, texture.width) as usize;
    let row = texel_index(t, texture.height) as usize;
    texture.pixels[row * texture.width as usize + column].map(|level| f64::from(level) / 255.0)
}

/// The column or row of `size` that a coordinate picks: trunc(coordinate·size + ½) mod size, where trunc cuts towards 0 and
/// mod gives 0 to size − 1. 0 for what is not finite.
pub fn texel_index(coordinate: f64, size: u32) -> u32 {
    let size = f64::from(size);
    (coordinate * size + 0.5).trunc().rem_euclid(size) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texel_lies_around_its_index_and_repeats() {
        // Texel i of 4 is taken from (i − ½)/4 up to before (i + ½)/4.
        for (coordinate, index) in [
            (0.0, 0),
            (0.124, 0),
            (0.125, 1),
            (0.374, 1),
            (0.375, 2),
            (0.874, 3),
            (0.875, 0),
            (1.0, 0),
            (1.125, 1),
            (1000.125, 1),
        ] {
            assert_eq!(texel_index(coordinate, 4), index, "{coordinate}");
        }
    }

    #[test]
    fn a_negative_coordinate_picks_the_texel_right_of_the_proper_one() {
        // −1.3, −0.3 and 0.7 of 10 texels: −12.5, −2.5 and 7.5 after the half, cut towards 0.
        assert_eq!([-1.3, -0.3, 0.7].map(|s| texel_index(s, 10)), [8, 8, 7]);
        // Everything from −1.5 to 0.5 texels is texel 0; −1 texel is one of them.
        assert_eq!([-0.375, -0.374, -0.25, 0.124].map(|s| texel_index(s, 4)), [3, 0, 0, 0]);
        assert_eq!([-1.0, -2.0].map(|s| texel_index(s, 4)), [1, 1]);
    }

    #[test]
    fn coordinates_of_any_size_pick_a_texel() {
        for coordinate in [1e300, -1e300, f64::MAX, f64::MIN, 1e-320, f64::NAN, f64::INFINITY] {
            for size in [1, 3, 16384] {
                assert!(texel_index(coordinate, size) < size, "{coordinate} {size}");
            }
        }
    }
}
