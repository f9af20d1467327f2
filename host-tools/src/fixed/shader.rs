//! Fragment programs on values in perspective, drawn with the varying that the dial asks for.

use std::any::Any;
use std::marker::PhantomData;

use fixel::fragment::Fragment;
use fixel::num::Block;
use fixel::varying::{Linear32, Perspective, Perspective32, PerspectiveSpans, Varying};
use fixel::view::Carried;

use super::Pixel;
use super::dials::{self, Dials};
use crate::emit::log::Read;

/// What being linear may add to a value, in units of 2^8: an eighth of a texel, or of a level, in units of 2^-16. That of the
/// core's own tier ([`fixel::quality::Fast`]).
pub const BOUND: u32 = 32;

/// What makes a pixel of K values.
pub trait Shader<const K: usize> {
    /// The pixel.
    fn shaded(&self, values: [i32; K]) -> Pixel;
}

/// A shader on values of the varying `V`.
struct On<'s, V, S>(&'s S, PhantomData<V>);

impl<V: Varying<Values = [i32; K]>, S: Shader<K>, const K: usize> Fragment for On<'_, V, S> {
    type Varying = V;
    type Pixel = Pixel;

    #[inline]
    fn shade(&self, values: [i32; K], _below: Pixel) -> Option<Pixel> {
        Some(self.0.shaded(values))
    }
}

/// A picture that triangles are drawn on.
pub trait Canvas: Any + Sized {
    /// The same with edges of 32 bits.
    type Narrow: Canvas;

    /// How accurately.
    fn dials(&self) -> Dials;

    /// Draws one triangle, given where the view wants it, with a depth buffer or without, and writes nothing down.
    fn paint<F, const DEPTH: bool>(
        &mut self,
        place: [Block<i64, 4>; 3],
        carried: [<F::Varying as Carried>::Vertex; 3],
        fragment: &F,
    ) where
        F: Fragment<Pixel = Pixel, Varying: Carried>;

    /// Writes down what is drawn of a triangle, if somebody wants it.
    fn record<V: Carried + Read>(&mut self, place: [Block<i64, 4>; 3], carried: [V::Vertex; 3]);

    /// The same, if its edges are of 32 bits. Wider pictures with other dials than exact have been refused; nothing is compiled
    /// for them but what is exact.
    fn narrow(&mut self) -> Option<&mut Self::Narrow> {
        (self as &mut dyn Any).downcast_mut()
    }

    /// Draws one triangle, given where the view wants it.
    fn draw<F>(&mut self, place: [Block<i64, 4>; 3], carried: [<F::Varying as Carried>::Vertex; 3], fragment: &F)
    where
        F: Fragment<Pixel = Pixel, Varying: Carried + Read>,
    {
        if self.dials().no_depth {
            if let Some(canvas) = self.narrow() {
                canvas.paint::<F, false>(place, carried, fragment);
            }
            return;
        }
        self.paint::<F, true>(place, carried, fragment);
        self.record::<F::Varying>(place, carried);
    }

    /// Draws one triangle, its values in perspective as the dial says.
    fn draw_shaded<S: Shader<K>, const K: usize>(
        &mut self,
        place: [Block<i64, 4>; 3],
        values: [[i32; K]; 3],
        shader: &S,
    ) {
        match self.dials().perspective {
            dials::Perspective::Exact => self.draw(place, values, &On::<Perspective<K>, S>(shader, PhantomData)),
            setting => {
                if let Some(canvas) = self.narrow() {
                    draw_roughly(canvas, setting, place, values, shader);
                }
            }
        }
    }
}

/// With another setting of the dial than exact.
fn draw_roughly<C: Canvas, S: Shader<K>, const K: usize>(
    canvas: &mut C,
    setting: dials::Perspective,
    place: [Block<i64, 4>; 3],
    values: [[i32; K]; 3],
    shader: &S,
) {
    match setting {
        dials::Perspective::Exact => {}
        dials::Perspective::Narrow => {
            canvas.paint::<_, true>(place, values, &On::<Perspective32<K>, S>(shader, PhantomData));
        }
        dials::Perspective::Spans => {
            canvas.paint::<_, true>(place, values, &On::<PerspectiveSpans<K, BOUND>, S>(shader, PhantomData));
        }
        dials::Perspective::Affine => {
            canvas.paint::<_, true>(place, values, &On::<Linear32<K>, S>(shader, PhantomData))
        }
    }
}
