//! What is in the scene (PG.1 to PG.13), in numbers and names.

use super::shapes::{BOX, Corner, PLANE};

/// Pixels in a row.
pub const WIDTH: u32 = 400;
/// Rows.
pub const HEIGHT: u32 = 300;
/// What is behind everything; depth is cleared to 1.
pub const CLEAR: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

/// Where the camera is.
pub const EYE: [f64; 3] = [-2.5, 1.0, 0.0];
/// What it looks at.
pub const CENTER: [f64; 3] = [0.0, 0.0, 0.0];
/// What is up on its pictures.
pub const UP: [f64; 3] = [0.0, 1.0, 0.0];
/// The full horizontal angle, in degrees.
pub const FIELD_OF_VIEW: f64 = 120.0;
/// Width over height of the view.
pub const ASPECT: f64 = 4.0 / 3.0;
/// How far away drawing begins.
pub const NEAR: f64 = 0.1;
/// How far away depth is 1.
pub const FAR: f64 = 100.0;

/// The share of highlights in every material.
pub const SPECULAR: f64 = 1.0;
/// The exponent of highlights in every material.
pub const SHININESS: u32 = 16;

/// A point light without falloff: where it is in the world; red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light(pub [f64; 3], pub [f64; 3]);

/// The lights; there is no other light.
pub const LIGHTS: [Light; 3] = [
    Light([-2.5, 2.0, 0.0], [0.7, 0.7, 0.7]),
    Light([1.0, 3.0, 0.0], [0.2, 0.2, 0.9]),
    Light([0.0, 1.0, 0.0], [0.1, 0.1, 0.1]),
];

/// The textures by their names; all are clamped to their edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Texture {
    /// 9x9, white where x + y is even, black elsewhere; nearest.
    Board,
    /// 16x16 of any colours; nearest.
    Random,
    /// 32x32, white, of different alphas; linear.
    Frost,
}

/// A shape with a colour in a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Object {
    /// Corners of triangles, in threes.
    pub shape: &'static [Corner],
    /// Where its origin is in the world.
    pub position: [f64; 3],
    /// Factors along its own axes, applied first.
    pub scale: [f64; 3],
    /// Degrees and axis, by the right-hand rule, applied second.
    pub turn: (f64, [f64; 3]),
    /// Red, green, blue, alpha.
    pub color: [f64; 4],
    /// What its colour is multiplied by.
    pub texture: Option<Texture>,
    /// Whether it is drawn last, blended by its alpha.
    pub transparent: bool,
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A plane of four units a side.
const fn wall(position: [f64; 3], turn: (f64, [f64; 3]), [r, g, b]: [f64; 3]) -> Object {
    Object {
        shape: &PLANE,
        position,
        scale: [2.0; 3],
        turn,
        color: [r, g, b, 1.0],
        texture: None,
        transparent: false,
    }
}

/// A box as it stands, light grey.
const fn solid(position: [f64; 3], scale: [f64; 3], texture: Texture) -> Object {
    Object {
        shape: &BOX,
        scale,
        texture: Some(texture),
        ..wall(position, (0.0, Z), [0.9, 0.9, 0.9])
    }
}

/// The objects in drawing order: floor, left, right and back wall, board box, tall board box, random box, frosted glass.
pub const OBJECTS: [Object; 8] = [
    wall([0.0, -1.0, 0.0], (0.0, Z), [0.8, 0.8, 0.8]),
    wall([0.0, 1.0, -2.0], (90.0, X), [0.9, 0.1, 0.1]),
    wall([0.0, 1.0, 2.0], (-90.0, X), [0.1, 0.9, 0.1]),
    wall([1.0, 1.0, 0.0], (90.0, Z), [0.1, 0.1, 0.9]),
    solid([-1.75, 0.0, -1.0], [0.2, 0.5, 0.2], Texture::Board),
    solid([0.5, 2.0, 0.0], [0.1, 2.0, 1.0], Texture::Board),
    solid([-1.75, 0.0, 1.0], [0.2, 0.5, 0.2], Texture::Random),
    Object {
        scale: [0.75, 0.25, 0.5],
        texture: Some(Texture::Frost),
        transparent: true,
        ..wall([-1.5, 1.1, 0.0], (37.0, Z), [0.9, 0.6, 0.9])
    },
];
