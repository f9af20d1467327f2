//! From clip space to the screen: clip planes, culling, the guard band, the division.

use crate::clip::{Behind, ClipCorner, DepthRange, Held, Polygon, cut, depth_plane, to_view};
use crate::num::{Block, Scaled, Wide, Word};
use crate::screen::Shape;
use crate::span::Corners;
use crate::varying::Varying;
use crate::view::{Carried, Fan, PlacedCorner, Weigh, in_clip_space, w_of};
use crate::viewport::Viewport;

use super::state::{Culling, State};

/// Depth beyond this is beyond the far end of the range.
pub(super) const FULL_DEPTH: i64 = 65535 << 15;

/// What is interpolated besides the varyings.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    pub(super) depth: bool,
    /// Something can pass the depth test beyond the far end of the range.
    pub(super) beyond: bool,
    pub(super) inverse_w: bool,
}

/// What belongs to a corner on the screen.
#[derive(Debug, Clone, Copy)]
struct Own<V> {
    /// 1/w in units of 2^`exponent` of the piece.
    inverse: i32,
    varying: V,
}

/// A polygon or a line on the screen.
#[derive(Debug)]
pub(super) struct Piece<V, const N: usize> {
    corners: Polygon<PlacedCorner, N>,
    own: Polygon<Own<V>, N>,
    first: Own<V>,
    /// Of 1/w.
    pub(super) exponent: i32,
    /// Depths are in units of 2^(`depth_shift` − 15) step.
    pub(super) depth_shift: u32,
}

impl<V: Copy, const N: usize> Piece<V, N> {
    #[inline]
    fn own(&self, index: usize) -> &Own<V> {
        self.own.get(index).unwrap_or(&self.first)
    }

    #[inline]
    pub(super) fn inverse(&self, index: usize) -> i32 {
        self.own(index).inverse
    }

    /// The corners by themselves: what walks them is in a program once, whatever they carry.
    #[inline(always)]
    pub(super) fn outline(&self) -> Held<'_, PlacedCorner> {
        self.corners.held()
    }
}

impl<V: Copy, const N: usize> Corners for Piece<V, N> {
    #[inline]
    fn count(&self) -> usize {
        self.corners.len()
    }
    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.outline().position(index)
    }
}

impl<V: Varying, const N: usize> Shape for Piece<V, N> {
    type Varying = V;
    #[inline]
    fn depth(&self, index: usize) -> i32 {
        self.corners.get(index).map_or(0, |corner| corner.depth)
    }
    #[inline]
    fn varying(&self, index: usize) -> V {
        self.own(index).varying
    }
}

/// What vertices carry, and their w.
struct Given<T, A> {
    w: [Scaled<T>; 3],
    values: [A; 3],
}

/// Calls `draw` with what is left of a triangle on the screen.
pub(super) fn triangle<I, T, W, V, const N: usize>(
    state: &State<I, T, W, N>,
    wanted: Wanted,
    positions: [Block<T, 4>; 3],
    values: [V::Vertex; 3],
    mut draw: impl FnMut(&Piece<V, N>),
) where
    T: Word,
    W: Word,
    V: Carried,
{
    let clipped = if V::WANTS.fan {
        state.planes.clip_to_fan(positions)
    } else {
        state.planes.clip(positions)
    };
    let Some(clipped) = clipped else {
        return;
    };
    let vertices = Given {
        w: positions.map(w_of),
        values,
    };
    let is_whole = || clipped.len() == 3 && clipped.iter().zip(&positions).all(|(corner, p)| corner.position == *p);
    if V::WANTS.fan && !is_whole() {
        // Values are linear in clip space up to here, and over the screen from here on: the fan, each part as if given.
        if !keeps_whole(state, &clipped) {
            return;
        }
        let mut fan = Fan::new(&state.viewport, clipped.len(), |i| clipped.get(i).map(as_vertex));
        for i in 2..clipped.len() {
            let Some(start) = fan.start(i) else {
                continue;
            };
            let (Some(first), Some(start), Some(second), Some(third)) =
                (clipped.get(0), clipped.get(start), clipped.get(i - 1), clipped.get(i))
            else {
                return;
            };
            let positions = [first, start, third].map(as_vertex);
            let vertices = Given {
                values: [first, second, third].map(|corner| V::between(vertices.values, &in_clip_space(corner))),
                w: positions.map(w_of),
            };
            let part = Polygon::of_vertices(positions);
            in_range(part, &vertices, &state.viewport, Culling::Off, wanted, &mut draw);
        }
    } else {
        in_range(clipped, &vertices, &state.viewport, state.culling, wanted, &mut draw);
    }
}

/// What is left of a line on the screen. Lines are never culled.
pub(super) fn line<I, T, W, V, const N: usize>(
    state: &State<I, T, W, N>,
    wanted: Wanted,
    positions: [Block<T, 4>; 2],
    [a, b]: [V::Vertex; 2],
) -> Option<Piece<V, N>>
where
    T: Word,
    W: Word,
    V: Carried,
{
    let mut line = state.planes.clip(positions)?;
    let [from, to] = positions;
    // A triangle whose third vertex has no weight: it may be the second once more.
    let mut vertices = Given {
        w: [from, to, to].map(w_of),
        values: [a, b, b],
    };
    if V::WANTS.fan {
        let (a, b) = (*line.get(0)?, *line.get(1)?);
        let corners = [&a, &b, &b];
        let positions = corners.map(as_vertex);
        vertices = Given {
            values: corners.map(|corner| V::between(vertices.values, &in_clip_space(corner))),
            w: positions.map(w_of),
        };
        let [from, to, _] = positions;
        line = Polygon::of_vertices([from, to]);
    }
    to_view(&mut line.slots(), &state.viewport, DepthRange::Unlimited, Behind::Cut)?;
    let shift = if wanted.depth && beyond_range(&line) {
        // The whole line keeps its pixels: a unit of 2^-7 step reaches 128 depth ranges far.
        8
    } else {
        0
    };
    place(&line, &vertices, &state.viewport, wanted, shift)
}

/// Whether a clipped polygon is drawn, where it is not placed on the screen as a whole.
#[cold]
fn keeps_whole<I, T: Word, W: Word, const N: usize>(
    state: &State<I, T, W, N>,
    clipped: &Polygon<ClipCorner<T>, N>,
) -> bool {
    if state.culling == Culling::Off {
        return true;
    }
    let mut polygon = clipped.clone();
    let left = to_view(
        &mut polygon.slots(),
        &state.viewport,
        DepthRange::Unlimited,
        Behind::Cut,
    );
    left.is_some() && keeps(state.culling, &polygon, &state.viewport)
}

/// Whether a polygon is drawn that [`to_view`] has made.
fn keeps<T: Word, W: Word, const N: usize>(
    culling: Culling,
    polygon: &Polygon<ClipCorner<T>, N>,
    viewport: &Viewport<W>,
) -> bool {
    let nothing = Given {
        w: [Scaled::ZERO; 3],
        values: [(); 3],
    };
    let wanted = Wanted {
        depth: false,
        beyond: false,
        inverse_w: false,
    };
    let piece = place::<T, W, (), N>(polygon, &nothing, viewport, wanted, 0);
    piece.is_some_and(|piece| keeps_piece(culling, piece.outline(), viewport))
}

/// Whether a polygon is drawn, by the way its corners run on the screen.
#[inline]
fn keeps_piece<W: Word>(culling: Culling, outline: Held<'_, PlacedCorner>, viewport: &Viewport<W>) -> bool {
    culling == Culling::Off || {
        // Positive is counter-clockwise with rows downwards, as seen where y is up.
        let area = outline.area();
        culling.keeps(if viewport.is_y_up() { area > 0 } else { area < 0 })
    }
}

fn beyond_range<T: Word, const N: usize>(polygon: &Polygon<ClipCorner<T>, N>) -> bool {
    polygon.iter().any(|corner| {
        let [_, _, z, w] = corner.position.mantissas().map(T::widen);
        z > w || z + w < T::Wide::ZERO
    })
}

/// Calls `draw` with a convex part of the polygon, or where depth leaves its range, with up to three: before it, at depth
/// 0, in it, and beyond it, at its end. They share their edges exactly.
fn in_range<T, W, V, const N: usize>(
    mut polygon: Polygon<ClipCorner<T>, N>,
    vertices: &Given<T, V::Vertex>,
    viewport: &Viewport<W>,
    culling: Culling,
    wanted: Wanted,
    draw: &mut impl FnMut(&Piece<V, N>),
) where
    T: Word,
    W: Word,
    V: Carried,
{
    if to_view(&mut polygon.slots(), viewport, DepthRange::Unlimited, Behind::Cut).is_none() {
        return;
    }
    if !wanted.depth || !beyond_range(&polygon) {
        if let Some(piece) = place(&polygon, vertices, viewport, wanted, 0)
            && keeps_piece(culling, piece.outline(), viewport)
        {
            draw(&piece);
        }
        return;
    }
    if culling != Culling::Off && !keeps(culling, &polygon, viewport) {
        return;
    }
    let mut emit = |polygon: &Polygon<ClipCorner<T>, N>| {
        if let Some(piece) = place(polygon, vertices, viewport, wanted, 0) {
            draw(&piece);
        }
    };
    let mut before = polygon.clone();
    cut(&mut before.slots(), depth_plane(-1, -1));
    emit(&before);
    let mut within = polygon.clone();
    cut(&mut within.slots(), depth_plane(1, 1));
    cut(&mut within.slots(), depth_plane(-1, 1));
    emit(&within);
    if wanted.beyond {
        let mut beyond = polygon;
        cut(&mut beyond.slots(), depth_plane(1, -1));
        emit(&beyond);
    }
}

/// The corners on the screen.
fn place<T, W, V, const N: usize>(
    polygon: &Polygon<ClipCorner<T>, N>,
    vertices: &Given<T, V::Vertex>,
    viewport: &Viewport<W>,
    wanted: Wanted,
    depth_shift: u32,
) -> Option<Piece<V, N>>
where
    T: Word,
    W: Word,
    V: Carried,
{
    let weigh = Weigh::new(polygon.held(), vertices.w, V::WANTS);
    let inverses = || polygon.iter().map(inverse_w);
    let mut exponent = 0;
    if wanted.inverse_w {
        let magnitude = |s: Scaled<T>| s.exponent().saturating_add(T::BITS as i32);
        exponent = inverses().map(magnitude).fold(i32::MIN, i32::max).saturating_sub(30);
    }
    let range = if wanted.depth {
        DepthRange::MinusOneToOne
    } else {
        DepthRange::Unlimited
    };
    let (mut corners, mut own) = (Polygon::default(), Polygon::default());
    for corner in polygon.iter() {
        let Some((x, y, mut depth)) = viewport.place(corner.position, range) else {
            continue;
        };
        if depth_shift > 0 {
            depth = coarse_depth(corner.position, depth_shift);
        }
        let inverse = if wanted.inverse_w {
            inverse_w(corner).scaled(exponent.saturating_neg()).to_fixed(0)
        } else {
            0
        };
        corners.slots().push(PlacedCorner {
            position: (x, y),
            depth,
        });
        own.slots().push(Own {
            inverse: inverse.clamp(0, 1 << 30) as i32,
            varying: V::mix(vertices.values, &weigh.weights::<V>(corner)),
        });
    }
    Some(Piece {
        first: *own.get(0)?,
        corners,
        own,
        exponent,
        depth_shift,
    })
}

/// A corner's position at the scale of a vertex there: homogeneous points have any scale, their weights tell which.
fn as_vertex<T: Word>(corner: &ClipCorner<T>) -> Block<T, 4> {
    let [a, b, c] = corner.weights.split();
    corner.position.over(a.plus(b).plus(c)).unwrap_or(corner.position)
}

/// 1/w of a vertex there.
fn inverse_w<T: Word>(corner: &ClipCorner<T>) -> Scaled<T> {
    let [a, b, c] = corner.weights.split();
    let whole = a.plus(b).plus(c);
    whole.over(w_of(corner.position)).unwrap_or(Scaled::ZERO)
}

/// Window depth in units of 2^(shift − 15) step, in the range or not; |depth| ≤ 2^30.
fn coarse_depth<T: Word>(position: Block<T, 4>, shift: u32) -> i32 {
    let [_, _, z, w] = position.mantissas().map(T::widen);
    let depth = (z + w).times_small((FULL_DEPTH >> shift) as i32).div_floor(w + w);
    let most = T::from_i32(1 << 30).widen();
    depth.max(-most).min(most).narrow().low_i32()
}
