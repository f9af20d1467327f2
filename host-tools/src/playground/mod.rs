//! The course's playground (formats/pipeline.md, PG): three walls, three boxes and a frosted glass under three lights.
//!
//! [`scene`], [`shapes`] and [`texture`] are plain data that any renderer can draw; [`float`] draws them with the float64
//! [`pipeline`](crate::reference::pipeline), `examples/playground.rs` with the fixed-point one.

pub mod command;
pub mod float;
pub mod scene;
pub mod shapes;
pub mod texture;

use crate::picture::Picture;
use texture::Textures;

/// The float64 picture, 400 by 300.
pub fn draw_float(textures: &Textures) -> Picture {
    float::draw(textures).colors[&0].picture()
}
