//! A view: all that lies between vertices in eye space and a polygon on the screen.

mod carried;
mod compact;
mod fan;
mod lens;
mod line;
mod point;
mod projected;
mod ready;
mod stored;

use crate::clip::{Behind, DepthRange, Planes};
use crate::matrix::Matrix;
use crate::num::{Block, Scaled, Word};
use crate::viewport::Viewport;
pub use carried::{Carried, InSpace, OnScreen, Shares, Wants, Weights};
pub(crate) use carried::{Weigh, in_clip_space};
pub(crate) use compact::Painting;
pub(crate) use fan::Fan;
pub use line::ProjectedLine;
use projected::Left;
pub use projected::Projected;
pub(crate) use projected::{PlacedCorner, Shown};
pub(crate) use ready::Way;
pub use ready::{Assembled, ScreenVertex, Triangle};
pub use stored::StoredView;

/// Which triangles are drawn, by the way their corners run on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cull {
    /// All.
    Nothing,
    /// Only those that run counter-clockwise as seen.
    Clockwise,
    /// Only those that run clockwise as seen.
    CounterClockwise,
}

impl Cull {
    /// Whether what has this [`doubled_area`] is drawn.
    #[inline(always)]
    fn keeps(self, area: i64) -> bool {
        match self {
            Cull::Nothing => area != 0,
            Cull::Clockwise => area > 0,
            Cull::CounterClockwise => area < 0,
        }
    }

    /// The same for the words of [`Facing`].
    #[inline(always)]
    pub(crate) fn facing(self) -> Facing {
        let (flip, end) = match self {
            Cull::Nothing => (0, i32::MAX),
            Cull::Clockwise => (0, 0),
            Cull::CounterClockwise => (-1, 0),
        };
        Facing { flip, end }
    }
}

/// A [`Cull`] as numbers: triangle by triangle nothing is decided but by a comparison.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Facing {
    flip: i32,
    end: i32,
}

impl Facing {
    /// Whether a triangle is drawn, by a word with the sign of the doubled area, negated. Some without area are kept.
    #[inline(always)]
    fn keeps(self, negated: i32) -> bool {
        negated ^ self.flip < self.end
    }
}

/// How vertices in eye space become polygons on the screen. `T` is the word of positions, `W` of the edge walk, N the most
/// user planes.
///
/// ```
/// use fixel::{clip::{Behind, DepthRange, Planes}, matrix::Matrix, num::{Block, Scaled}};
/// use fixel::{depth::NoDepth, draw, fragment::Flat, target::Buffer, view::{Cull, Vertex, View}, viewport::Viewport};
///
/// let view = View::<i32, i32, 0> {
///     projection: Matrix::frustum([-1, 1, -1, 1, 1, 10].map(Scaled::from_integer))?,
///     planes: Planes::default(),
///     viewport: Viewport::new(0, 0, 8, 4)?.y_up(),
///     depth_range: DepthRange::MinusOneToOne,
///     behind: Behind::Cut,
///     cull: Cull::Nothing,
/// };
/// let floor = [[-2, -1, -2, 1], [2, -1, -2, 1], [0, -1, 2, 1]]; // one corner is behind the camera
/// let corners = floor.map(|p| Vertex { position: Block::from_integers(p), carried: () });
/// let mut picture = [b'.'; 8 * 4];
/// draw::primitive(&view, &mut Buffer::new(&mut picture, 8, 4)?, &mut NoDepth, &corners, &Flat(b'#'));
/// assert_eq!(&picture[24..], b"########");
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct View<T: Word, W, const N: usize> {
    /// Eye space to clip space.
    pub projection: Matrix<T>,
    /// Clip planes in eye space.
    pub planes: Planes<T, N>,
    /// Clip space to the screen.
    pub viewport: Viewport<W>,
    /// Which depths are drawn.
    pub depth_range: DepthRange,
    /// What w < 0 means.
    pub behind: Behind,
    /// Which triangles are drawn.
    pub cull: Cull,
}

/// A vertex in eye space and what it carries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Vertex<T, A> {
    /// Homogeneous position.
    pub position: Block<T, 4>,
    /// Values for the fragments.
    pub carried: A,
}

impl<T: Word, W: Word, const N: usize> View<T, W, N> {
    /// Calls `draw` with what is left of a triangle on the screen, clipped, projected, snapped and culled: nothing, or one
    /// polygon, or the triangles of its fan from the first corner. A fan is made where a polygon could not be drawn as one:
    ///
    /// * User planes cut a triangle that carries a [`LinearFan`](crate::varying::LinearFan).
    /// * User planes cut a triangle with w of both signs that is [divided by](Behind::Divide): through infinity, the polygon
    ///   itself is not a convex one.
    /// * A triangle that reaches [behind](Behind::Cut) the camera carries values that are linear over the screen (`.iv`).
    ///   A vertex there has no place on the screen, so that the values run linearly in clip space up to the near plane, and
    ///   over the screen only from there on: along the edges to the far plane, which is cut next, and then in each triangle
    ///   of the fan by itself. What else is cut away does not change what stays.
    pub fn project<V: Carried>(&self, vertices: &[Vertex<T, V::Vertex>; 3], mut draw: impl FnMut(&Projected<V, N>)) {
        let mut left = Left::new(vertices.each_ref().map(|v| v.carried));
        loop {
            self.project_next(vertices, &mut left);
            if let Some(projected) = left.projected() {
                draw(projected);
            }
            if !left.go_on() {
                return;
            }
        }
    }
}

fn in_front<T: Word>(w: Scaled<T>) -> bool {
    w.mantissas() > [T::ZERO]
}

pub(crate) fn w_of<T: Word>(position: Block<T, 4>) -> Scaled<T> {
    let [.., w] = position.mantissas();
    Scaled::new([w], position.exponent())
}
