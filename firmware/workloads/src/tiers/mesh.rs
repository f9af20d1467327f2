//! A torus in one light: a colour for each face, or one for each vertex.

use core::marker::PhantomData;

use fixel::depth::{Depth, NoDepth};
use fixel::draw::indexed;
use fixel::error::Error;
use fixel::fragment::{Flat, Fragment};
use fixel::quality::Quality;
use fixel::target::Target;
use fixel::varying::Varying;
use fixel::view::ScreenVertex;
use heapless::Vec;

use super::camera::{Camera, Eye, SPHERE, TORUS};
use super::canvas::Canvas;
use super::color::{Color, Output};
use super::geometry::{Mesh, Models, Point};
use super::lit::{self, SCALE};

/// Interpolated colours.
struct Smooth<C, P>(PhantomData<(C, P)>);

impl<C: Color, P: Output> Fragment for Smooth<C, P> {
    type Varying = C;
    type Pixel = P;

    #[inline(always)]
    fn shade(&self, values: <C as Varying>::Values, _below: P) -> Option<P> {
        Some(P::interpolated::<C>(values))
    }
}

/// The vertices of a mesh on the screen.
pub(super) fn vertices<A>(eye: &Eye, mesh: &Mesh, carried: impl Fn(&Point) -> A) -> Vec<ScreenVertex<i32, A>, 300> {
    let vertex = |point: &Point| eye.stored_vertex(point.position, carried(point));
    mesh.points.iter().map(vertex).collect()
}

/// Light at every vertex, colours linear over the screen.
pub(super) fn smooth<Q, P>(
    color: &mut impl Target<Pixel = P>,
    depth: &mut impl Depth,
    mesh: &Mesh,
    camera: &Camera,
) -> Result<(), Error>
where
    Q: Quality<Color: Color>,
    P: Output,
{
    let (eye, lights) = (camera.view()?, lit::lights::<Q::Precision>()?);
    let lights = lights.at_scale(-SCALE);
    let vertices = vertices(&eye, mesh, |point| lit::shade(&lights, lit::carried(point, camera)));
    let fragment = Smooth::<Q::Color, P>(PhantomData);
    indexed(&eye, color, depth, &vertices, mesh.triangles.iter().copied(), &fragment);
    Ok(())
}

/// A colour at each vertex.
pub fn gouraud<Q: Quality<Color: Color>, P: Output>(canvas: &mut Canvas<P>, models: &Models) -> Result<(), Error> {
    let (mut color, mut depth) = canvas.buffers()?;
    smooth::<Q, P>(&mut color, &mut depth, &models.torus, &TORUS)
}

/// The same without a depth buffer: what lies behind is drawn over where it comes later.
pub fn gouraud_without_depth<Q, P>(canvas: &mut Canvas<P>, models: &Models) -> Result<(), Error>
where
    Q: Quality<Color: Color>,
    P: Output,
{
    let (mut color, _) = canvas.buffers()?;
    smooth::<Q, P>(&mut color, &mut NoDepth, &models.torus, &TORUS)
}

/// Light at every vertex of a sphere, which is drawn as well in any order: what is not seen of it faces away.
pub fn sphere<Q: Quality<Color: Color>, P: Output>(canvas: &mut Canvas<P>, models: &Models) -> Result<(), Error> {
    let (mut color, mut depth) = canvas.buffers()?;
    smooth::<Q, P>(&mut color, &mut depth, &models.sphere, &SPHERE)
}

/// The same without a depth buffer.
pub fn sphere_without_depth<Q: Quality<Color: Color>, P: Output>(
    canvas: &mut Canvas<P>,
    models: &Models,
) -> Result<(), Error> {
    let (mut color, _) = canvas.buffers()?;
    smooth::<Q, P>(&mut color, &mut NoDepth, &models.sphere, &SPHERE)
}

/// A colour for each face: that of its first vertex.
pub fn flat<Q: Quality, P: Output>(canvas: &mut Canvas<P>, models: &Models) -> Result<(), Error> {
    let (mut color, mut depth) = canvas.buffers()?;
    faces::<Q, P>(&mut color, &mut depth, &models.torus)
}

/// The same without a depth buffer.
pub fn flat_without_depth<Q: Quality, P: Output>(canvas: &mut Canvas<P>, models: &Models) -> Result<(), Error> {
    let (mut color, _) = canvas.buffers()?;
    faces::<Q, P>(&mut color, &mut NoDepth, &models.torus)
}

fn faces<Q, P>(color: &mut impl Target<Pixel = P>, depth: &mut impl Depth, mesh: &Mesh) -> Result<(), Error>
where
    Q: Quality,
    P: Output,
{
    let (eye, lights) = (TORUS.view()?, lit::lights::<Q::Precision>()?);
    let lights = lights.at_scale(-SCALE);
    let vertices = vertices(&eye, mesh, |_| ());
    for &triangle in &mesh.triangles {
        let [first, ..] = triangle;
        let Some(point) = mesh.points.get(first as usize) else {
            continue;
        };
        let fragment = Flat(P::of(lit::shade(&lights, lit::carried(point, &TORUS))));
        indexed(&eye, color, depth, &vertices, [triangle], &fragment);
    }
    Ok(())
}
