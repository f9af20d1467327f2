//! What a scene's picture is drawn from: shapes on the screen, each with the program that colours it.
//!
//! All that a still scene asks for before the screen (matrices, clipping, subdivision, normals) has been done by the core
//! when a shape gets here; what is left is what every frame has to do again.

use std::sync::Arc;

use fixel::blend::Rgba;
use fixel::light::Light;
use fixel::light::world::{Glossy, Material, PointLight};
use fixel::num::Block;
use fixel::screen::{Center, SubPx};

use crate::picture::Picture;

/// Everything that a picture takes.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples per pixel in each direction.
    pub level: u32,
    /// Whether edges need 64-bit words.
    pub wide: bool,
    /// How depths are compared, if they are.
    pub depth: Option<Nearer>,
    /// What the pixels are.
    pub pixels: Pixels,
    /// What programs refer to by number.
    pub textures: Vec<Arc<Picture>>,
    /// What programs refer to by number.
    pub lights: Vec<Lights>,
    /// In order.
    pub draws: Vec<Draw>,
}

/// Which of two depths wins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nearer {
    /// The nearer, of equals the later.
    LessOrEqual,
    /// The nearer, of equals the earlier; at the far end the later.
    LessOrFar,
}

/// What is drawn onto.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pixels {
    /// Red, green, blue and alpha as bytes, written over.
    Bytes,
    /// Linear colours with alpha in units of 2^(shift − 28) of full, blended, and made bytes at the end.
    Blended(Units),
    /// Bytes, made of linear colours that nothing shines through.
    Opaque(Units),
}

/// How linear colours become bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Units {
    /// The unit is 2^(shift − 28) of full.
    pub shift: u32,
    /// Whether bytes are encoded.
    pub srgb: bool,
}

/// A scene's lights at some moment.
#[derive(Debug, Clone, PartialEq)]
pub enum Lights {
    /// Of HW2.
    Eye(Vec<Light<i64>>),
    /// Of iv: the eye and the lights.
    World(Block<i64, 3>, Vec<PointLight<i64>>),
}

impl Lights {
    /// How many.
    pub fn len(&self) -> usize {
        match self {
            Lights::Eye(lights) => lights.len(),
            Lights::World(_, lights) => lights.len(),
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// One shape and its program.
#[derive(Debug, Clone, PartialEq)]
pub struct Draw {
    /// What is covered.
    pub shape: Shape,
    /// How values run between the corners.
    pub varying: Varying,
    /// What colours it.
    pub program: Program,
}

/// How values run between corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Varying {
    /// There are none.
    Nothing,
    /// Linear over the screen.
    Linear,
    /// In perspective.
    Perspective,
}

/// What is covered.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A convex polygon.
    Polygon(Vec<Corner>),
    /// A line, plain or antialiased.
    Line {
        /// Antialiased.
        smooth: bool,
        /// The first and the last.
        ends: Vec<Corner>,
    },
    /// A square or disc of one colour.
    Point {
        /// A disc.
        round: bool,
        /// Where.
        center: Center,
        /// Side or diameter.
        size: SubPx,
    },
    /// A square with a texture from its upper left corner to `far`.
    Billboard {
        /// Where.
        center: Center,
        /// Side.
        size: SubPx,
        /// Texture coordinates of the lower right corner.
        far: [i32; 2],
    },
}

impl Shape {
    /// Corners or ends; none of a shape around a point.
    pub fn corners(&self) -> &[Corner] {
        match self {
            Shape::Polygon(corners) | Shape::Line { ends: corners, .. } => corners,
            Shape::Point { .. } | Shape::Billboard { .. } => &[],
        }
    }

    /// The same, to change them.
    pub fn corners_mut(&mut self) -> &mut [Corner] {
        match self {
            Shape::Polygon(corners) | Shape::Line { ends: corners, .. } => corners,
            Shape::Point { .. } | Shape::Billboard { .. } => &mut [],
        }
    }
}

/// 1/w of a corner whose values are linear over the screen.
pub const ONE_W: i32 = 1 << 30;

/// A corner on the screen.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Corner {
    /// In 1/256 px.
    pub position: (i32, i32),
    /// In units of 2^-15 step.
    pub depth: i32,
    /// What it carries.
    pub values: Vec<i32>,
    /// The same over w.
    pub over_w: Vec<i32>,
    /// 1/w.
    pub inverse: i32,
}

/// What colours a shape.
#[derive(Debug, Clone, PartialEq)]
pub enum Program {
    /// One colour.
    Flat([u8; 4]),
    /// HW2: a surface, perhaps under lights.
    Surface {
        /// Its colour.
        surface: Surface,
        /// What comes out is in units of 2^(shift − 16) levels.
        shift: i32,
        /// Light, if there is any.
        lit: Option<Lit>,
    },
    /// MP1: a colour with alpha.
    Paint(Paint),
    /// iv: the corners' colours in units of 2^-30.
    Corners,
    /// iv: light at every pixel; the values are place and normal.
    Phong {
        /// Which lights.
        lights: usize,
        /// Unit of places.
        exponent: i32,
        /// Without highlights where the specular colour is black.
        material: Material<Glossy>,
        /// Whether there is code for highlights.
        shines: bool,
    },
}

/// Where HW2 takes a colour from.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// One colour.
    Plain([i32; 3]),
    /// The corners'.
    Gouraud,
    /// A texture's.
    Textured(Sampled),
    /// A texture over the corners', those in units of 2^(shift − 16) levels.
    Decal(Sampled, u32),
}

/// A texture and the fraction bits of its coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sampled {
    /// Which texture.
    pub texture: usize,
    /// Of coordinates in texels.
    pub fraction_bits: u32,
}

/// Light on an HW2 surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Lit {
    /// Which lights.
    pub lights: usize,
    /// Unit of places.
    pub exponent: i32,
    /// The triangle's own, or `None` for the corners'.
    pub normal: Option<[i32; 3]>,
    /// Whether the corners carry places.
    pub places: bool,
    /// Exponent and brightness of highlights.
    pub shiny: Option<(u32, i32)>,
}

/// Where MP1 takes a colour and alpha from.
#[derive(Debug, Clone, PartialEq)]
pub enum Paint {
    /// One colour.
    Plain(Rgba),
    /// The corners', in units 2^headroom as large.
    Colors {
        /// 0 but where w has both signs.
        headroom: u32,
        /// Alpha is 1 everywhere and not carried.
        opaque: bool,
    },
    /// A texture's, in the scene's unit.
    Texels(Sampled),
    /// A texture over the corners'.
    Decal {
        /// The texture.
        sampled: Sampled,
        /// As for `Colors`.
        headroom: u32,
        /// As for `Colors`.
        opaque: bool,
    },
}
