//! The state of the pipeline: what is set once and holds for many draws.

use core::marker::PhantomData;

use crate::clip::Planes;
use crate::num::{Block, Word};
use crate::varying::Varying;
use crate::view::Carried;
use crate::viewport::Viewport;

use super::program::Values;

/// Viewport, clip planes, culling; `I` is how varyings are interpolated, `T` the word of positions, `W` of the edge walk, N
/// the most clip planes. Depth and blending belong to the [buffers](super::Targets).
///
/// ```
/// use fixel::{clip::Planes, num::Block};
/// use fixel::pipeline::{Culling, State};
/// use fixel::viewport::Viewport;
///
/// let mut state = State::new(Viewport::<i32>::new(0, 0, 320, 240)?.samples_at_centers());
/// state.culling = Culling::Back;
///
/// // One plane more than the near plane: x ≥ 0.
/// let mut planes = Planes::<i32, 2>::default();
/// planes.push(Block::from_integers([0, 0, 1, 1]))?;
/// planes.push(Block::from_integers([1, 0, 0, 0]))?;
/// let state = state.with_planes(planes).linear();
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct State<I, T: Word, W, const N: usize> {
    /// Where −1…1 goes; nothing is drawn outside it.
    pub viewport: Viewport<W>,
    /// In clip space, before the division: p·(x, y, z, w) ≥ 0 is kept. At first the near plane, (0, 0, 1, 1).
    pub planes: Planes<T, N>,
    /// Which faces of triangles are left out. At first none.
    pub culling: Culling,
    interpolation: PhantomData<I>,
}

/// Which triangles are left out: front is counter-clockwise in clip space, y upwards, whatever the viewport.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Culling {
    /// None.
    #[default]
    Off,
    /// Front faces.
    Front,
    /// Back faces.
    Back,
    /// All triangles; lines are drawn.
    FrontAndBack,
}

impl Culling {
    /// Whether a polygon is drawn that is seen from the front, or not.
    pub(super) fn keeps(self, front: bool) -> bool {
        match self {
            Culling::Off => true,
            Culling::Front => !front,
            Culling::Back => front,
            Culling::FrontAndBack => false,
        }
    }
}

/// How varyings are interpolated: [`PerspectiveCorrected`] or [`Linear`].
pub trait Interpolation {
    /// The kind of varying for these values.
    type Of<A: Values>: Carried<Vertex = A> + Varying<Values = A>;
}

/// Linear in space: divided by w per pixel, unless w is the same everywhere.
#[derive(Debug, Clone, Copy)]
pub enum PerspectiveCorrected {}

impl Interpolation for PerspectiveCorrected {
    type Of<A: Values> = A::Perspective;
}

/// Linear over the screen: no division is compiled in. Where a clip plane cuts, values are mixed as positions are, before
/// the division.
#[derive(Debug, Clone, Copy)]
pub enum Linear {}

impl Interpolation for Linear {
    type Of<A: Values> = A::Linear;
}

impl<T: Word, W: Word> State<PerspectiveCorrected, T, W, 1> {
    /// Clipped at the near plane, nothing culled, perspective-corrected.
    pub fn new(viewport: Viewport<W>) -> Self {
        let mut planes = Planes::default();
        // There is room for one.
        let _ = planes.push(Block::from_integers([0, 0, 1, 1]));
        State {
            viewport,
            planes,
            culling: Culling::Off,
            interpolation: PhantomData,
        }
    }
}

impl<I, T: Word, W, const N: usize> State<I, T, W, N> {
    /// The same with these planes instead, the near plane among them or not.
    pub fn with_planes<const M: usize>(self, planes: Planes<T, M>) -> State<I, T, W, M> {
        State {
            viewport: self.viewport,
            planes,
            culling: self.culling,
            interpolation: PhantomData,
        }
    }

    /// The same with varyings that are linear over the screen.
    pub fn linear(self) -> State<Linear, T, W, N> {
        State {
            viewport: self.viewport,
            planes: self.planes,
            culling: self.culling,
            interpolation: PhantomData,
        }
    }
}
