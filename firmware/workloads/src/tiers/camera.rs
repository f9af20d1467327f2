//! Where things are seen from.

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::error::Error;
use fixel::matrix::Matrix;
use fixel::num::Block;
use fixel::view::{Cull, View};
use fixel::viewport::Viewport;

use super::canvas::{HEIGHT, WIDTH};

/// A view without user planes.
pub type Eye = View<i32, i32, 0>;

/// A camera, and how far before it a model lies.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    /// Left, right, bottom, top, near, far, in units of 1/8.
    pub frustum: [i32; 6],
    /// From the camera to the model's origin.
    pub away: i32,
}

/// Before the torus.
pub const TORUS: Camera = Camera {
    frustum: [-4, 4, -3, 3, 8, 64],
    away: 2,
};

/// Before the sphere.
pub const SPHERE: Camera = Camera { away: 3, ..TORUS };

/// In the corridor.
pub const CORRIDOR: Camera = Camera {
    frustum: [-32, 32, -24, 24, 32, 512],
    away: 0,
};

impl Camera {
    /// A view by a projection from the model's space.
    ///
    /// # Errors
    /// None: the frustum has a volume.
    pub fn view(&self) -> Result<Eye, Error> {
        let model = Matrix::translation(Block::from_integers([0, 0, -self.away]));
        let projection = Matrix::frustum(self.frustum.map(|side| Block::new([side], -3)))?;
        Ok(View {
            projection: projection.product(&model),
            planes: Planes::default(),
            viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up().samples_at_centers(),
            depth_range: DepthRange::MinusOneToOne,
            behind: Behind::Cut,
            cull: Cull::Clockwise,
        })
    }
}
