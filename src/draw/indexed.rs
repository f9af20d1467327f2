//! Triangles of vertices that were projected before.

use core::hint::black_box;
use core::marker::PhantomData;

use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::mesh::Index;
use crate::num::Word;
use crate::screen::Shape;
use crate::target::Target;
use crate::view::{Carried, Facing, Painting, ScreenVertex, Triangle, View, Way};

use super::{any_size, projected, shape};

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
    let mut painter = Painter::<W, _, _, _>::new(color, depth, fragment);
    // Hidden from the compiler, which would decide anew for each triangle.
    let facing = black_box(view.cull.facing());
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
        painter.assembled(view, facing, [a, b, c]);
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
    let mut painter = Painter::<W, _, _, _>::new(color, depth, fragment);
    painter.assembled(view, view.cull.facing(), vertices);
}

/// All that triangles are drawn with, behind one reference: most of them are culled, and the loop that finds out needs the
/// registers.
pub(super) struct Painter<'p, W, C, D, F> {
    color: &'p mut C,
    depth: &'p mut D,
    fragment: &'p F,
    word: PhantomData<W>,
}

impl<'p, W, C, D, F> Painter<'p, W, C, D, F> {
    #[inline(always)]
    pub(super) fn new(color: &'p mut C, depth: &'p mut D, fragment: &'p F) -> Self {
        Painter {
            color,
            depth,
            fragment,
            word: PhantomData,
        }
    }
}

impl<W, C, D, F> Painting<F::Varying> for Painter<'_, W, C, D, F>
where
    W: Word,
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    #[inline]
    fn paint<S: Shape<Varying = F::Varying>>(&mut self, left: &S, area: i64) {
        any_size::<W, _, _, _, _>(self.color, self.depth, left, left, area, self.fragment);
    }
}

impl<W, C, D, F> Painter<'_, W, C, D, F>
where
    W: Word,
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel, Varying: Carried>,
{
    #[inline(always)]
    fn assembled<T: Word>(
        &mut self,
        view: &View<T, W, 0>,
        facing: Facing,
        [a, b, c]: [&ScreenVertex<T, <F::Varying as Carried>::Vertex>; 3],
    ) {
        match view.way([a, b, c], facing) {
            Way::Nowhere => {}
            Way::Whole => self.whole(a, b, c),
            Way::Across => self.across(view, a, b, c),
        }
    }

    #[inline(never)]
    fn whole<T: Word>(
        &mut self,
        a: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        b: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        c: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
    ) {
        shape::<W, _, _, _, _>(self.color, self.depth, &Triangle::new([a, b, c]), self.fragment);
    }

    #[cold]
    #[inline(never)]
    fn across<T: Word>(
        &mut self,
        view: &View<T, W, 0>,
        a: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        b: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        c: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
    ) {
        if F::COMPACT {
            view.paint_assembled([a, b, c], self);
            return;
        }
        view.clip_triangle::<F::Varying>([a, b, c], |left| {
            projected::<W, _, _, _, _>(self.color, self.depth, &left.shown(), self.fragment);
        });
    }
}
