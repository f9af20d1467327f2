//! Scenes with transparent objects (10.6): opaque ones first, then the others from the back to the front.

use super::blend::Blend;
use super::framebuffer::Framebuffer;
use super::geometry::Geometry;
use super::program::{Program, VERTEX};
use super::state::State;
use crate::reference::matrix::Matrix;

/// A geometry in its place.
pub struct Object<U> {
    /// Its shape, in its own space.
    pub geometry: Geometry,
    /// From its own space to view space.
    pub model_view: Matrix,
    /// What its program is given.
    pub uniforms: U,
    /// Whether what is behind shows through.
    pub transparent: bool,
}

/// Draws the opaque objects as they come and the transparent ones over them, with no depth write.
pub fn draw_scene<P: Program<Uniforms = U>, U>(
    framebuffer: &mut Framebuffer,
    state: &State,
    program: &P,
    objects: &[Object<U>],
) {
    let (mut transparent, opaque): (Vec<_>, Vec<_>) = objects.iter().partition(|object| object.transparent);
    for object in opaque {
        super::draw(framebuffer, state, program, &object.uniforms, &object.geometry);
    }
    let mut over = state.clone();
    over.depth.write = false;
    over.blend = Some(Blend::transparency());
    transparent.sort_by(|a, b| a.view_z().total_cmp(&b.view_z()));
    for object in transparent {
        super::draw(framebuffer, &over, program, &object.uniforms, &object.geometry);
    }
}

impl<U> Object<U> {
    /// z of the mean of the vertices, in view space.
    fn view_z(&self) -> f64 {
        let positions = self
            .geometry
            .vertices()
            .filter_map(|v| <[f64; 3]>::try_from(v.get(VERTEX)?.clone()).ok());
        let z = positions.map(|[x, y, z]| self.model_view.apply(&[x, y, z, 1.0])[2]);
        let (count, sum) = z.fold((0.0, 0.0), |(count, sum), z| (count + 1.0, sum + z));
        sum / count
    }
}
