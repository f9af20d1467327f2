//! Comparison of the fixed-point core's picture with the reference's, which explains every differing pixel or says that
//! it cannot.
//!
//! δ of a corner is √2 · 2⁻⁹ px for the snapping plus the stated error of its vertex path; see
//! [`reference::log`]. Every allowance is computed from the float64 scene, never from the difference
//! seen; the constants are in [`stated`].

mod direction;
pub mod interval;
pub mod iv;
mod judge;
mod lighting;
mod linear;
pub mod look;
pub mod mp1;
pub mod picture;
mod piece;
pub mod screen;
mod shape;
pub mod stated;
mod surface;
mod texels;
mod tiles;

use rayon::prelude::*;

use crate::reference::log::Polygon;
use crate::reference::{self, Rendered};
use interval::Interval;
use judge::Case;
use look::{Look, Painted};
use picture::FixedPicture;
use screen::Screen;
use shape::Shape;
use tiles::Tiles;

/// What became of a pixel. A differing pixel is in the first class that fits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Class {
    /// The same bytes.
    Equal,
    /// The same winner; each byte is within the stated arithmetic bound plus what moving the corners by δ changes there.
    Colour,
    /// Coverage differs, and the sample lies within δ of an edge, of one made by clipping, or of the border of the depth range.
    Edge,
    /// Visibility differs, and the two depths are within one step of 16 bits plus depth gradient times δ.
    Depth,
    /// The texture coordinate lies within its bound of a texel's border.
    Texel,
    /// The interpolated 1/w is within its bound of 0.
    Pole,
    /// A power's base lies so near 0 or 1 that its stated error explains the colour, or n·l so near 0 that the light may be on or off.
    Steep,
    /// None of these: a bug.
    Unexplained,
}

/// Pixel counts of the classes that explain a difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Explained {
    /// [`Class::Colour`].
    pub colour: u64,
    /// [`Class::Edge`].
    pub edge: u64,
    /// [`Class::Depth`].
    pub depth: u64,
    /// [`Class::Texel`].
    pub texel: u64,
    /// [`Class::Pole`].
    pub pole: u64,
    /// [`Class::Steep`].
    pub steep: u64,
}

/// The outcome for a whole picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Pixels covered in the core's picture.
    pub pixels_drawn: u64,
    /// Pixels covered in the core's picture or in the reference's, whichever are more: what shares are of.
    pub most_drawn: u64,
    /// Pixels covered in exactly one of the two pictures.
    pub coverage_differs: u64,
    /// Pixels of [`Class::Unexplained`].
    pub unexplained: u64,
    /// The largest difference of a byte of RGBA.
    pub max_channel_error: u8,
    /// Root of the mean square difference over all bytes of RGBA, in levels.
    pub rmse: f64,
    /// 20 log₁₀(255 / rmse); none when the pictures are equal.
    pub psnr: Option<f64>,
    /// How many levels a pixel of [`Class::Colour`] lies beyond what moving the corners by δ makes of the value, at the most.
    pub beyond_gradient: u8,
    /// How many differing pixels each class explains.
    pub explained: Explained,
    /// The class of every pixel, row by row.
    pub classes: Vec<Class>,
}

/// Compares the two pictures of one scene.
///
/// # Panics
///
/// If the pictures differ in size: they are not of one scene then.
pub fn compare<M: Look + Sync>(fixed: &FixedPicture, reference: &Rendered<M>) -> Comparison {
    let size = (fixed.width, fixed.height, fixed.pixels.len());
    let other = (reference.width, reference.height, reference.pixels.len());
    assert_eq!(size, other, "pictures of one scene have one size");
    let drawn = |i: usize| reference.pixels[i].primitive != 0;
    let picture = Differing {
        fixed,
        reference: &reference.pixels,
        depths: reference.depth_range,
    };
    Comparison::new(fixed, &reference.bytes(), drawn, |differing| {
        picture.classify(&reference.polygons, differing)
    })
}

/// Two pictures of which one primitive wins each pixel.
struct Differing<'a> {
    fixed: &'a FixedPicture,
    reference: &'a [reference::Pixel],
    /// Which z/w are drawn.
    depths: [f64; 2],
}

impl Differing<'_> {
    /// The classes of the differing pixels, and by how many levels those of class *colour* are beyond their gradient.
    fn classify<M: Look + Sync>(&self, polygons: &[Polygon<M>], differing: &[usize]) -> Vec<(Class, u8)> {
        let (fixed, reference) = (self.fixed, self.reference);
        if differing.is_empty() {
            return Vec::new();
        }
        let (width, height) = (fixed.width, fixed.height);
        let [low, high] = self.depths;
        let screen = Screen {
            size: [f64::from(width), f64::from(height)],
            depths: Interval { low, high },
        };
        let shapes: Vec<Painted<'_, M>> = (polygons.iter())
            .map(|polygon| Painted {
                shape: Shape::new(&polygon.outline, &screen),
                material: &polygon.material,
            })
            .collect();
        let other_winner = |&i: &usize| fixed.pixels[i].primitive != reference[i].primitive;
        let contested: Vec<usize> = differing.iter().copied().filter(other_winner).collect();
        let bounds = shapes.iter().map(|painted| painted.shape.bounds(width, height));
        let tiles = Tiles::new(bounds, width, height, &contested);
        let class = |&i: &usize| {
            let (x, y) = (i % width as usize, i / width as usize);
            let case = Case {
                sample: [x as f64, y as f64],
                fixed: &fixed.pixels[i],
                reference: &reference[i],
            };
            if other_winner(&i) {
                return (
                    case.other_winner(tiles.near(x, y).iter().map(|&shape| &shapes[shape])),
                    0,
                );
            }
            case.same_winner(of_primitive(&shapes, case.fixed.primitive))
        };
        differing.par_iter().map(class).collect()
    }
}

/// The shapes of one primitive; they stand together, since primitives are numbered in drawing order.
fn of_primitive<'a, 'b, M>(shapes: &'a [Painted<'b, M>], primitive: u32) -> &'a [Painted<'b, M>] {
    let from = shapes.partition_point(|painted| painted.shape.outline.primitive < primitive);
    let end = shapes.partition_point(|painted| painted.shape.outline.primitive <= primitive);
    &shapes[from..end]
}

impl Comparison {
    /// The figures, and the classes of the differing pixels as `classify` finds them; `drawn` tells where the reference drew.
    fn new(
        fixed: &FixedPicture,
        reference: &[[u8; 4]],
        drawn: impl Fn(usize) -> bool,
        classify: impl FnOnce(&[usize]) -> Vec<(Class, u8)>,
    ) -> Self {
        let mut comparison = Self::figures(fixed, reference, drawn);
        let differs = |&i: &usize| fixed.pixels[i].rgba != reference[i];
        let differing: Vec<usize> = (0..reference.len()).filter(differs).collect();
        comparison.classes = vec![Class::Equal; reference.len()];
        for (&i, (class, beyond)) in differing.iter().zip(classify(&differing)) {
            comparison.classes[i] = class;
            comparison.beyond_gradient = comparison.beyond_gradient.max(beyond);
            comparison.count(class);
        }
        comparison
    }

    /// The figures that need no explanation.
    fn figures(fixed: &FixedPicture, reference: &[[u8; 4]], drawn: impl Fn(usize) -> bool) -> Self {
        let mut max_channel_error = 0;
        let mut squares = 0;
        for (pixel, bytes) in fixed.pixels.iter().zip(reference) {
            for (a, b) in pixel.rgba.iter().zip(bytes) {
                let difference = a.abs_diff(*b);
                max_channel_error = max_channel_error.max(difference);
                squares += u64::from(difference) * u64::from(difference);
            }
        }
        let rmse = (squares as f64 / (4 * reference.len()) as f64).sqrt();
        let ours = |pixel: &picture::Pixel| pixel.primitive != 0;
        let differ = |&(i, pixel): &(usize, &picture::Pixel)| ours(pixel) != drawn(i);
        let pixels_drawn = fixed.pixels.iter().filter(|p| ours(p)).count() as u64;
        let theirs = (0..reference.len()).filter(|&i| drawn(i)).count() as u64;
        Self {
            pixels_drawn,
            most_drawn: pixels_drawn.max(theirs),
            coverage_differs: fixed.pixels.iter().enumerate().filter(differ).count() as u64,
            unexplained: 0,
            max_channel_error,
            rmse,
            psnr: (squares > 0).then(|| 20.0 * (255.0 / rmse).log10()),
            beyond_gradient: 0,
            explained: Explained::default(),
            classes: Vec::new(),
        }
    }

    fn count(&mut self, class: Class) {
        let counter = match class {
            Class::Equal => return,
            Class::Colour => &mut self.explained.colour,
            Class::Edge => &mut self.explained.edge,
            Class::Depth => &mut self.explained.depth,
            Class::Texel => &mut self.explained.texel,
            Class::Pole => &mut self.explained.pole,
            Class::Steep => &mut self.explained.steep,
            Class::Unexplained => &mut self.unexplained,
        };
        *counter += 1;
    }
}

#[cfg(test)]
mod tests;
