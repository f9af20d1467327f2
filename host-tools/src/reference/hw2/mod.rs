//! HW2 scenes in float64, in the evaluation order of formats/hw2.md.

mod draw;
mod patch;
mod state;
mod vertex;

use std::sync::Arc;

use crate::picture::Picture;
use crate::reference::bound::Tracked;
use crate::reference::clip::Plane;
use crate::reference::log::Polygon;
use crate::reference::material::{Light, Material};
use crate::reference::matrix::Matrix;
use crate::reference::{Pixel, Rendered};

/// A picture and its log.
pub type Drawn = Rendered<Arc<Material>>;

/// The float64 back end.
pub struct Reference {
    width: u32,
    height: u32,
    pixels: Vec<Pixel>,
    polygons: Vec<Polygon<Arc<Material>>>,
    model_view: Tracked,
    projection: Tracked,
    directions: Tracked,
    planes: Vec<Plane>,
    cull: bool,
    decals: bool,
    flat_normals: bool,
    texture: Option<Arc<Picture>>,
    lights: Arc<Vec<Light>>,
    shininess: f64,
}

impl Reference {
    /// An empty picture of `width` x `height` pixels, every pixel (0, 0, 0, 0) at depth 1.
    pub fn new(width: u32, height: u32) -> Self {
        let empty = Pixel {
            color: [0.0; 4],
            depth: 1.0,
            primitive: 0,
        };
        Self {
            width,
            height,
            pixels: vec![empty; width as usize * height as usize],
            polygons: Vec::new(),
            model_view: Tracked::identity(),
            projection: Tracked::identity(),
            directions: Tracked::new(Matrix::IDENTITY.linear_part(), 0.0),
            planes: Vec::new(),
            cull: false,
            decals: false,
            flat_normals: false,
            texture: None,
            lights: Arc::default(),
            shininess: 0.0,
        }
    }

    /// The picture and the log.
    pub fn finish(self) -> Drawn {
        Rendered {
            width: self.width,
            height: self.height,
            pixels: self.pixels,
            depth_range: [0.0, 1.0],
            polygons: self.polygons,
        }
    }
}

#[cfg(test)]
mod tests;
