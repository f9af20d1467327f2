//! Triangles of vertices that were projected before.

use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::mesh::Index;
use crate::num::Word;
use crate::span::doubled_area;
use crate::target::Target;
use crate::view::{Carried, ScreenVertex, View, Way};

use super::polygon;

/// Draws triangles whose corners are indices into `vertices`, made by [`View::vertex`] of the same view. A triangle with an
/// index beyond the last vertex draws nothing.
///
/// The same pixels as [`primitive`](super::primitive) draws triangle by triangle, but each vertex is projected once.
///
/// ```
/// use fixel::{clip::{Behind, DepthRange, Planes}, matrix::Matrix, num::{Block, Scaled}};
/// use fixel::{depth::NoDepth, draw, fragment::Flat, target::Buffer, view::{Cull, View}, viewport::Viewport};
///
/// static POSITIONS: [[i16; 3]; 4] = [[-32768, -32768, 0], [32767, -32768, 0], [32767, 32767, 0], [-32768, 32767, 0]];
/// static TRIANGLES: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
///
/// // 2 away from the camera, by a projection from the model's own space.
/// let camera = Matrix::frustum([-1, 1, -1, 1, 1, 10].map(Scaled::from_integer))?;
/// let view = View::<i32, i32, 0> {
///     projection: camera.product(&Matrix::translation(Block::from_integers([0, 0, -2]))),
///     planes: Planes::default(),
///     viewport: Viewport::new(0, 0, 8, 4)?.y_up().samples_at_centers(),
///     depth_range: DepthRange::MinusOneToOne,
///     behind: Behind::Cut,
///     cull: Cull::Clockwise,
/// };
/// let vertices = POSITIONS.map(|position| view.stored_vertex(position, ()));
/// let mut picture = [b'.'; 8 * 4];
/// draw::indexed(&view, &mut Buffer::new(&mut picture, 8, 4)?, &mut NoDepth, &vertices, TRIANGLES, &Flat(b'#'));
/// let rows: Vec<_> = picture.chunks(8).map(|row| str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, ["........", "..####..", "..####..", "........"]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn indexed<T, W, C, D, F, I>(
    view: &View<T, W, 0>,
    color: &mut C,
    depth: &mut D,
    vertices: &[ScreenVertex<T, <F::Varying as Carried>::Vertex>],
    triangles: impl IntoIterator<Item = [I; 3]>,
    fragment: &F,
) where
    T: Word,
    W: Word,
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel, Varying: Carried>,
    I: Index,
{
    for [a, b, c] in triangles {
        let Some(a) = vertices.get(a.to_usize()) else {
            continue;
        };
        let Some(b) = vertices.get(b.to_usize()) else {
            continue;
        };
        let Some(c) = vertices.get(c.to_usize()) else {
            continue;
        };
        assembled(view, color, depth, [a, b, c], fragment);
    }
}

/// Draws one triangle of vertices made by [`View::vertex`] of the same view: for meshes that keep them in a
/// [cache](crate::mesh::Cache); see [`indexed`].
#[inline]
pub fn assembled<T, W, C, D, F>(
    view: &View<T, W, 0>,
    color: &mut C,
    depth: &mut D,
    vertices: [&ScreenVertex<T, <F::Varying as Carried>::Vertex>; 3],
    fragment: &F,
) where
    T: Word,
    W: Word,
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel, Varying: Carried>,
{
    let [a, b, c] = vertices;
    match view.way::<F::Varying>([a, b, c]) {
        Way::Nowhere => {}
        Way::Whole(triangle) => polygon::<W, _, _, _, _>(color, depth, &triangle, triangle.area(), fragment),
        Way::Across => view.clip_triangle::<F::Varying>([a, b, c], &mut |shape| {
            polygon::<W, _, _, _, _>(color, depth, shape, doubled_area(shape), fragment);
        }),
    }
}
