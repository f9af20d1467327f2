//! What is left of a triangle on the screen, whatever the view had room for: so that a fragment program is compiled once, and
//! not once for every view.

use fixel::screen::Shape;
use fixel::span::Corners;
use fixel::varying::Varying;

/// The corners of a polygon.
pub struct Outline<'s, V>(pub &'s dyn Outlined<V>);

/// [`Shape`], of which there can be a reference to any.
pub trait Outlined<V> {
    /// See [`Corners::count`].
    fn count(&self) -> usize;
    /// See [`Corners::position`].
    fn position(&self, index: usize) -> (i32, i32);
    /// See [`Shape::depth`].
    fn depth(&self, index: usize) -> i32;
    /// See [`Shape::varying`].
    fn varying(&self, index: usize) -> V;
}

impl<S: Shape> Outlined<S::Varying> for S {
    fn count(&self) -> usize {
        Corners::count(self)
    }
    fn position(&self, index: usize) -> (i32, i32) {
        Corners::position(self, index)
    }
    fn depth(&self, index: usize) -> i32 {
        Shape::depth(self, index)
    }
    fn varying(&self, index: usize) -> S::Varying {
        Shape::varying(self, index)
    }
}

impl<V> Corners for Outline<'_, V> {
    fn count(&self) -> usize {
        self.0.count()
    }
    fn position(&self, index: usize) -> (i32, i32) {
        self.0.position(index)
    }
}

impl<V: Varying> Shape for Outline<'_, V> {
    type Varying = V;

    fn depth(&self, index: usize) -> i32 {
        self.0.depth(index)
    }
    fn varying(&self, index: usize) -> V {
        self.0.varying(index)
    }
}
