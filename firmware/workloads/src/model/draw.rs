//! The measured regions: an object's vertices, what is left of its triangles on the screen, and its pixels, each with all
//! that comes before it.

use core::hint::black_box;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::draw::primitive;
use fixel::error::Error;
use fixel::fragment::Gouraud565;
use fixel::light::Matte;
use fixel::light::world::{FULL, Material, Specular};
use fixel::mesh::{Cache, Normalized};
use fixel::num::Block;
use fixel::target::Buffer;
use fixel::varying::Color565;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;

use super::canvas::Depths;
use super::{Model, Object};

/// Vertices that are kept.
const CACHE: usize = 64;

/// With its colour in [`Gouraud565`]'s units.
type LitVertex = Vertex<i32, [i32; 3]>;

/// Transforms and lights the vertices; how many that were. Those that leave the cache before they are used again are made
/// again.
#[inline(never)]
pub fn vertices(object: &Object<'_>) -> u32 {
    triangles(object, |corners| {
        black_box(corners);
    })
}

/// Beyond that clips, projects and culls the triangles; how many polygons are left.
#[inline(never)]
pub fn polygons(object: &Object<'_>, view: &View<i32, i32, 0>) -> u32 {
    let mut polygons = 0;
    triangles(object, |corners| {
        view.project::<Color565>(corners, |polygon| {
            black_box(polygon);
            polygons += 1;
        });
    });
    polygons
}

/// Beyond that draws them.
#[inline(never)]
pub fn pixels(object: &Object<'_>, view: &View<i32, i32, 0>, color: &mut Buffer<'_, u16>, depth: &mut Depths<'_>) {
    triangles(object, |corners| primitive(view, color, depth, corners, &Gouraud565));
}

/// As `.iv` wants it.
///
/// # Errors
/// A picture of more than 4096 pixels a side.
pub fn view(model: &Model<'_>, object: &Object<'_>) -> Result<View<i32, i32, 0>, Error> {
    let viewport = Viewport::new(0, 0, model.width, model.height)?;
    Ok(View {
        projection: object.projection,
        planes: Planes::default(),
        viewport: viewport.y_up().samples_at_centers(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Clockwise,
    })
}

/// Calls `draw` with every triangle; how many vertices were made.
#[inline(always)]
fn triangles(object: &Object<'_>, draw: impl FnMut(&[LitVertex; 3])) -> u32 {
    // Without highlights their code is not run, as it would not be there in a firmware that has none.
    let Material {
        ambient,
        diffuse,
        specular,
    } = object.material;
    if specular.color == [0; 3] {
        let matte = Material {
            ambient,
            diffuse,
            specular: Matte,
        };
        shaded(object, &matte, draw)
    } else {
        shaded(object, &object.material, draw)
    }
}

#[inline(always)]
fn shaded<S: Specular>(object: &Object<'_>, material: &Material<S>, mut draw: impl FnMut(&[LitVertex; 3])) -> u32 {
    let mut cache = Cache::<LitVertex, 1, CACHE>::default();
    let vertex = |[index]: [usize; 1]| object.vertex(index, material);
    object.mesh.triangles(&mut cache, vertex, |corners| draw(&corners));
    cache.transforms() as u32
}

impl Object<'_> {
    /// Placed and lit.
    fn vertex<S: Specular>(&self, index: usize, material: &Material<S>) -> LitVertex {
        let signed = |words: &[[u16; 3]]| words.get(index).copied().unwrap_or_default().map(|word| word as i16);
        let position = self.placement.transform(signed(self.points).point());
        let normal = Block::new(signed(self.normals).map(i32::from), -15);
        let normal = self.directions.turn(normal).mantissas();
        let [x, y, z, _] = position.mantissas();
        // The placement is affine: w stays 1.
        let place = Block::new([x, y, z], position.exponent());
        Vertex {
            position,
            carried: rgb565(self.lights.shade(normal, place, material)),
        }
    }
}

/// A colour in units of 2^-28 of full, in [`Gouraud565`]'s: to 2^-16 of full, with the half that makes cutting off round.
fn rgb565(color: [i32; 3]) -> [i32; 3] {
    let [red, green, blue] = color.map(|c| c.clamp(0, FULL) >> 12);
    [31 * red + 0x8000, 63 * green + 0x8000, 31 * blue + 0x8000]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_those_of_bytes() {
        let Color565(white) = Gouraud565::corner(255, 255, 255);
        let Color565(black) = Gouraud565::corner(0, 0, 0);
        assert_eq!([rgb565([FULL; 3]), rgb565([-1; 3])], [white, black]);
    }
}
