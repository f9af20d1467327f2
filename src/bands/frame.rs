//! What a scene is submitted to.

use core::hint::black_box;

use super::pool::{Bins, sample_rows};
use super::{Cells, DepthTest};
use crate::draw;
use crate::fragment::Fragment;
use crate::mesh::Index;
use crate::num::Word;
use crate::screen::{Corner, Position, Shape, SubPx};
use crate::target::Buffer;
use crate::view::{Carried, Facing, Painting, ScreenVertex, Triangle, Vertex, View, Way};
use crate::window::Window;

/// The frame being drawn: takes triangles, and stores them for all bands or draws them into one.
///
/// The example is [`Bands`](super::Bands)'s.
pub struct Frame<'f, F: Fragment, Z: DepthTest>(pub(super) Mode<'f, F, Z>);

pub(super) enum Mode<'f, F: Fragment, Z: DepthTest> {
    Store(Bins<'f, F>),
    Draw {
        color: Buffer<'f, F::Pixel>,
        depth: Cells<'f, Z>,
        window: Window,
    },
}

impl<F: Fragment + Copy, Z: DepthTest> Frame<'_, F, Z> {
    /// The part of the picture that is wanted now: the whole, where the pool holds it all. What lies above or below it need
    /// not be submitted, if that is known more cheaply than by submitting it.
    pub fn window(&self) -> Window {
        match &self.0 {
            Mode::Store(bins) => bins.window(),
            Mode::Draw { window, .. } => *window,
        }
    }

    /// As [`draw::triangle`], with a fragment program that is stored along with the triangle: its colour, say, or the texture
    /// that it refers to.
    #[inline]
    pub fn triangle(&mut self, corners: [Corner<F::Varying>; 3], fragment: F) {
        match &mut self.0 {
            Mode::Store(bins) => bins.polygon(&corners, Position::placed, fragment),
            Mode::Draw { color, depth, window } => {
                if reaches(&corners, *window) {
                    draw::shape::<i32, _, _, [_; 3], _>(color, depth, &corners, &fragment);
                }
            }
        }
    }

    /// As [`draw::primitive`]: a triangle in eye space, clipped and projected.
    pub fn primitive<T, const N: usize>(
        &mut self,
        view: &View<T, i32, N>,
        vertices: &[Vertex<T, <F::Varying as Carried>::Vertex>; 3],
        fragment: F,
    ) where
        T: Word,
        F::Varying: Carried,
    {
        if F::COMPACT {
            view.paint(vertices, &mut (self, fragment));
            return;
        }
        view.project::<F::Varying>(vertices, |shape| self.shape(shape, Position::placed, fragment));
    }

    /// As [`draw::indexed`]: triangles of vertices that were projected before, by the same view.
    pub fn indexed<T, I>(
        &mut self,
        view: &View<T, i32, 0>,
        vertices: &[ScreenVertex<T, <F::Varying as Carried>::Vertex>],
        triangles: impl IntoIterator<Item = [I; 3]>,
        fragment: F,
    ) where
        T: Word,
        F::Varying: Carried,
        I: Index,
    {
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
            self.faced(view, facing, [a, b, c], &fragment);
        }
    }

    /// As [`draw::assembled`]: one triangle of vertices that were projected before, by the same view.
    #[inline]
    pub fn assembled<T>(
        &mut self,
        view: &View<T, i32, 0>,
        vertices: [&ScreenVertex<T, <F::Varying as Carried>::Vertex>; 3],
        fragment: F,
    ) where
        T: Word,
        F::Varying: Carried,
    {
        self.faced(view, view.cull.facing(), vertices, &fragment);
    }

    #[inline(always)]
    fn faced<T>(
        &mut self,
        view: &View<T, i32, 0>,
        facing: Facing,
        [a, b, c]: [&ScreenVertex<T, <F::Varying as Carried>::Vertex>; 3],
        fragment: &F,
    ) where
        T: Word,
        F::Varying: Carried,
    {
        match view.way([a, b, c], facing) {
            Way::Nowhere => {}
            Way::Whole => self.whole(a, b, c, fragment),
            Way::Across => self.across(view, a, b, c, fragment),
        }
    }

    #[inline(never)]
    fn whole<T>(
        &mut self,
        a: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        b: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        c: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        fragment: &F,
    ) where
        T: Word,
        F::Varying: Carried,
    {
        self.shape(&Triangle::new([a, b, c]), Position::placed, *fragment);
    }

    #[cold]
    #[inline(never)]
    fn across<T>(
        &mut self,
        view: &View<T, i32, 0>,
        a: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        b: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        c: &ScreenVertex<T, <F::Varying as Carried>::Vertex>,
        fragment: &F,
    ) where
        T: Word,
        F::Varying: Carried,
    {
        if F::COMPACT {
            view.paint_assembled([a, b, c], &mut (self, *fragment));
            return;
        }
        view.clip_triangle::<F::Varying>([a, b, c], |left| self.shape(&left.shown(), Position::placed, *fragment));
    }

    /// As [`draw::polygon`]: a convex polygon with corners within ±4096 px, such as [`View::project`] makes.
    #[inline]
    pub fn polygon<S: Shape<Varying = F::Varying>>(&mut self, shape: &S, fragment: F) {
        let nearest = |(x, y)| Position::nearest(SubPx::from_bits(x), SubPx::from_bits(y));
        self.shape(shape, nearest, fragment);
    }

    #[inline(always)]
    fn shape<S>(&mut self, shape: &S, place: impl Fn((i32, i32)) -> Position, fragment: F)
    where
        S: Shape<Varying = F::Varying>,
    {
        match &mut self.0 {
            Mode::Store(bins) => bins.polygon(shape, place, fragment),
            Mode::Draw { color, depth, window } => {
                if reaches(shape, *window) {
                    draw::shape::<i32, _, _, _, _>(color, depth, shape, &fragment);
                }
            }
        }
    }
}

impl<F: Fragment + Copy, Z: DepthTest> Painting<F::Varying> for (&mut Frame<'_, F, Z>, F) {
    #[inline]
    fn paint<S: Shape<Varying = F::Varying>>(&mut self, shape: &S, _area: i64) {
        self.0.shape(shape, Position::placed, self.1);
    }
}

/// Whether some of the polygon's rows are among the window's.
#[inline(always)]
fn reaches(shape: &impl crate::span::Corners, window: Window) -> bool {
    let (top, bottom) = sample_rows(shape);
    top.max(window.top) < bottom.min(window.bottom)
}
