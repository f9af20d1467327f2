//! What vertices carry, mixed for the corners that clipping leaves.

use super::{in_front, w_of};
use crate::clip::{ClipCorner, Held};
use crate::num::{Block, Scaled, Word};
use crate::varying::{Color565, Linear, Linear32, LinearFan, Perspective, Perspective32, PerspectiveSpans, Varying};

/// A varying that can be mixed from what three vertices carry.
pub trait Carried: Varying {
    /// What a vertex carries.
    type Vertex: Copy + core::fmt::Debug;
    /// Which shares [`mix`](Self::mix) wants.
    const WANTS: Wants;
    /// What of them a corner of a polygon keeps until it is mixed: as little as [`mix`](Self::mix) looks at.
    type Shares: Shares;
    /// At a corner of the polygon.
    fn mix(vertices: [Self::Vertex; 3], weights: &Weights) -> Self;
    /// At the three vertices, of a triangle that nothing was cut from. The weights are what [`mix`](Self::mix) wants; not made
    /// where they are not looked at.
    #[inline(always)]
    fn whole(vertices: [Self::Vertex; 3], weights: impl Fn() -> [Weights; 3]) -> [Self; 3] {
        let [a, b, c] = weights();
        [
            Self::mix(vertices, &a),
            Self::mix(vertices, &b),
            Self::mix(vertices, &c),
        ]
    }
    /// At a vertex of such a triangle, where it is what the vertex carries and nothing else: then it is not copied.
    #[inline(always)]
    fn given(_: &Self::Vertex) -> Option<Self> {
        None
    }
    /// What a vertex would carry where the triangle leaves the space before the camera.
    fn between(vertices: [Self::Vertex; 3], weights: &Weights) -> Self::Vertex;
}

/// Which shares a varying is mixed by. What it does not want is not computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wants {
    /// For values that are linear over the screen.
    pub screen: bool,
    /// For values that are linear in space.
    pub space: bool,
    /// Whether what user planes leave is drawn as a fan, each triangle with values of its own.
    pub fan: bool,
}

impl Wants {
    /// No values.
    pub const NOTHING: Self = Wants {
        screen: false,
        space: false,
        fan: false,
    };
    /// Values that are linear over the screen.
    pub const SCREEN: Self = Wants {
        screen: true,
        space: false,
        fan: false,
    };
    /// Values that are linear in space.
    pub const SPACE: Self = Wants {
        screen: false,
        space: true,
        fan: false,
    };

    /// What either wants.
    ///
    /// ```
    /// use fixel::view::Wants;
    /// assert_eq!(Wants::SCREEN.and(Wants::SPACE), Wants { screen: true, space: true, fan: false });
    /// ```
    pub const fn and(self, other: Self) -> Self {
        Wants {
            screen: self.screen || other.screen,
            space: self.space || other.space,
            fan: self.fan || other.fan,
        }
    }
}

/// How much of each vertex a corner of the polygon is made of, in units of 2^-30.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Weights {
    /// Linear over the screen: they add up to 1.
    screen: [i32; 3],
    /// Linear in space: over w, the largest sum of the polygon between a quarter and 1; where `affine`, they add up to 1.
    space: [i32; 3],
    /// The vertex that this corner is, unless a plane made it.
    vertex: Option<u8>,
    /// With the same w everywhere, what is linear in space is linear over the screen.
    affine: bool,
}

/// [`Weights`] as they are kept: a corner with eight values is a third of what it would be with the values.
pub trait Shares: Copy + core::fmt::Debug {
    /// What is kept of these.
    fn of(weights: &Weights) -> Self;
    /// With all that was kept; what was not is any.
    fn weights(&self) -> Weights;
}

impl Shares for () {
    #[inline(always)]
    fn of(_: &Weights) {}
    #[inline(always)]
    fn weights(&self) -> Weights {
        Weights::of_vertex(0)
    }
}

/// For values that are linear over the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OnScreen {
    shares: [i32; 3],
    vertex: Option<u8>,
}

impl Shares for OnScreen {
    #[inline]
    fn of(weights: &Weights) -> Self {
        OnScreen {
            shares: weights.screen,
            vertex: weights.vertex,
        }
    }
    #[inline]
    fn weights(&self) -> Weights {
        Weights {
            screen: self.shares,
            space: self.shares,
            vertex: self.vertex,
            affine: true,
        }
    }
}

/// For values that are linear in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InSpace {
    shares: [i32; 3],
    vertex: Option<u8>,
    affine: bool,
}

impl Shares for InSpace {
    #[inline]
    fn of(weights: &Weights) -> Self {
        InSpace {
            shares: weights.space,
            vertex: weights.vertex,
            affine: weights.affine,
        }
    }
    #[inline]
    fn weights(&self) -> Weights {
        Weights {
            screen: self.shares,
            space: self.shares,
            vertex: self.vertex,
            affine: self.affine,
        }
    }
}

/// For both.
impl Shares for Weights {
    #[inline]
    fn of(weights: &Weights) -> Self {
        *weights
    }
    #[inline]
    fn weights(&self) -> Weights {
        *self
    }
}

impl Carried for () {
    type Vertex = ();
    const WANTS: Wants = Wants::NOTHING;
    type Shares = ();
    #[inline(always)]
    fn mix(_: [(); 3], _: &Weights) -> Self {}
    #[inline(always)]
    fn given((): &()) -> Option<Self> {
        Some(())
    }
    #[inline(always)]
    fn between(_: [(); 3], _: &Weights) {}
}

impl<const N: usize> Carried for Linear<N> {
    type Vertex = [i32; N];
    const WANTS: Wants = Wants::SCREEN;
    type Shares = OnScreen;
    #[inline]
    fn mix(vertices: [[i32; N]; 3], weights: &Weights) -> Self {
        Linear(Self::between(vertices, weights))
    }
    #[inline(always)]
    fn given(vertex: &[i32; N]) -> Option<Self> {
        Some(Linear(*vertex))
    }
    #[inline(always)]
    fn whole([a, b, c]: [Self::Vertex; 3], _: impl Fn() -> [Weights; 3]) -> [Self; 3] {
        [Linear(a), Linear(b), Linear(c)]
    }
    #[inline]
    fn between(vertices: [[i32; N]; 3], weights: &Weights) -> [i32; N] {
        weights.pick(vertices).unwrap_or_else(|| sum(weights.screen, &vertices))
    }
}

impl Carried for Color565 {
    type Vertex = [i32; 3];
    const WANTS: Wants = Wants::SCREEN;
    type Shares = OnScreen;
    #[inline]
    fn mix(vertices: [[i32; 3]; 3], weights: &Weights) -> Self {
        Color565(Self::between(vertices, weights))
    }
    #[inline(always)]
    fn given(vertex: &[i32; 3]) -> Option<Self> {
        Some(Color565(*vertex))
    }
    #[inline(always)]
    fn whole([a, b, c]: [Self::Vertex; 3], _: impl Fn() -> [Weights; 3]) -> [Self; 3] {
        [Color565(a), Color565(b), Color565(c)]
    }
    #[inline]
    fn between(vertices: [[i32; 3]; 3], weights: &Weights) -> [i32; 3] {
        Linear::<3>::between(vertices, weights)
    }
}

impl<const N: usize> Carried for LinearFan<N> {
    type Vertex = [i32; N];
    const WANTS: Wants = Wants {
        fan: true,
        ..Wants::SCREEN
    };
    type Shares = OnScreen;
    #[inline]
    fn mix(vertices: [[i32; N]; 3], weights: &Weights) -> Self {
        LinearFan(Self::between(vertices, weights))
    }
    #[inline(always)]
    fn given(vertex: &[i32; N]) -> Option<Self> {
        Some(LinearFan(*vertex))
    }
    #[inline(always)]
    fn whole([a, b, c]: [Self::Vertex; 3], _: impl Fn() -> [Weights; 3]) -> [Self; 3] {
        [LinearFan(a), LinearFan(b), LinearFan(c)]
    }
    #[inline]
    fn between(vertices: [[i32; N]; 3], weights: &Weights) -> [i32; N] {
        Linear::<N>::between(vertices, weights)
    }
}

impl<const N: usize> Carried for Perspective<N> {
    type Vertex = [i32; N];
    const WANTS: Wants = Wants::SPACE;
    type Shares = InSpace;
    fn mix(vertices: [[i32; N]; 3], weights: &Weights) -> Self {
        if weights.affine {
            let values = Self::between(vertices, weights);
            return Perspective {
                over_w: values,
                inverse: 1 << 30,
                values,
            };
        }
        let over_w = sum(weights.space, &vertices);
        // At most 1 but for the rounding of three: far from overflow.
        let [a, b, c] = weights.space;
        let inverse = a.saturating_add(b).saturating_add(c);
        let values = weights
            .pick(vertices)
            .unwrap_or_else(|| over_w.map(|v| over(v, inverse)));
        Perspective {
            over_w,
            inverse,
            values,
        }
    }
    #[inline]
    fn between(vertices: [[i32; N]; 3], weights: &Weights) -> [i32; N] {
        weights.pick(vertices).unwrap_or_else(|| sum(weights.space, &vertices))
    }
}

impl<const N: usize> Carried for Linear32<N> {
    type Vertex = [i32; N];
    const WANTS: Wants = Wants::SCREEN;
    type Shares = OnScreen;
    #[inline]
    fn mix(vertices: [[i32; N]; 3], weights: &Weights) -> Self {
        Linear32(Self::between(vertices, weights))
    }
    #[inline(always)]
    fn whole([a, b, c]: [Self::Vertex; 3], _: impl Fn() -> [Weights; 3]) -> [Self; 3] {
        [Linear32(a), Linear32(b), Linear32(c)]
    }
    #[inline]
    fn between(vertices: [[i32; N]; 3], weights: &Weights) -> [i32; N] {
        Linear::<N>::between(vertices, weights)
    }
}

impl<const N: usize> Carried for Perspective32<N> {
    type Vertex = [i32; N];
    const WANTS: Wants = Wants::SPACE;
    type Shares = InSpace;
    #[inline]
    fn mix(vertices: [[i32; N]; 3], weights: &Weights) -> Self {
        Perspective32(Perspective::mix(vertices, weights))
    }
    #[inline]
    fn between(vertices: [[i32; N]; 3], weights: &Weights) -> [i32; N] {
        Perspective::<N>::between(vertices, weights)
    }
}

impl<const N: usize, const BOUND: u32> Carried for PerspectiveSpans<N, BOUND> {
    type Vertex = [i32; N];
    const WANTS: Wants = Wants::SPACE;
    type Shares = InSpace;
    #[inline]
    fn mix(vertices: [[i32; N]; 3], weights: &Weights) -> Self {
        PerspectiveSpans(Perspective::mix(vertices, weights))
    }
    #[inline]
    fn between(vertices: [[i32; N]; 3], weights: &Weights) -> [i32; N] {
        Perspective::<N>::between(vertices, weights)
    }
}

/// Both, side by side.
impl<A: Carried, B: Carried> Carried for (A, B) {
    type Vertex = (A::Vertex, B::Vertex);
    const WANTS: Wants = A::WANTS.and(B::WANTS);
    type Shares = Weights;
    #[inline]
    fn mix(vertices: [Self::Vertex; 3], weights: &Weights) -> Self {
        let (first, second) = (vertices.map(|v| v.0), vertices.map(|v| v.1));
        (A::mix(first, weights), B::mix(second, weights))
    }
    #[inline(always)]
    fn given(vertex: &Self::Vertex) -> Option<Self> {
        Some((A::given(&vertex.0)?, B::given(&vertex.1)?))
    }
    #[inline(always)]
    fn whole(vertices: [Self::Vertex; 3], weights: impl Fn() -> [Weights; 3]) -> [Self; 3] {
        let [a, b, c] = A::whole(vertices.map(|v| v.0), &weights);
        let [x, y, z] = B::whole(vertices.map(|v| v.1), &weights);
        [(a, x), (b, y), (c, z)]
    }
    #[inline]
    fn between(vertices: [Self::Vertex; 3], weights: &Weights) -> Self::Vertex {
        let (first, second) = (vertices.map(|v| v.0), vertices.map(|v| v.1));
        (A::between(first, weights), B::between(second, weights))
    }
}

/// value/w over 1/w in units of 2^-30, cut towards 0 and saturating; 0 where 1/w is.
#[inline(never)]
fn over(value: i32, inverse: i32) -> i32 {
    let (magnitude, divisor) = (value.saturating_abs(), inverse.saturating_abs());
    let quotient = match divisor {
        0 => return 0,
        _ if magnitude >> 1 >= divisor => i64::MAX,
        _ => magnitude.ratio(divisor),
    };
    let quotient = if value ^ inverse < 0 { -quotient } else { quotient };
    quotient.clamp(i32::MIN as i64, i32::MAX as i64) as i32
}

/// Σ share · value, rounded.
#[inline(never)]
fn sum<const N: usize>(shares: [i32; 3], vertices: &[[i32; N]; 3]) -> [i32; N] {
    let mut sums = [1i64 << 29; N];
    for (share, values) in shares.into_iter().zip(vertices) {
        for (sum, &v) in sums.iter_mut().zip(values) {
            *sum += share as i64 * v as i64;
        }
    }
    // Three products of at most 2^30 and 2^31.
    sums.map(|s| (s >> 30).clamp(i32::MIN as i64, i32::MAX as i64) as i32)
}

impl Weights {
    /// Those of vertex `index` where w is the same everywhere.
    pub(super) fn of_vertex(index: usize) -> Self {
        Weights {
            screen: [0; 3],
            space: [0; 3],
            vertex: Some(index as u8),
            affine: true,
        }
    }

    /// Of a corner that is a vertex by itself: `part` is its 1/w, in units of 2^-30 of the polygon's largest, unless w is the same
    /// everywhere.
    pub(super) fn of_one(part: i32, affine: bool) -> Self {
        Weights {
            space: [part, 0, 0],
            affine,
            ..Self::of_vertex(0)
        }
    }

    /// Of what lies between two ends; how much of it is the second.
    pub(super) fn of_two(screen: i32, space: i32) -> Self {
        let parts = |second: i32| [(1 << 30) - second, second, 0];
        Weights {
            screen: parts(screen),
            space: parts(space),
            vertex: None,
            affine: true,
        }
    }

    fn pick<V>(&self, [a, b, c]: [V; 3]) -> Option<V> {
        match self.vertex? {
            0 => Some(a),
            1 => Some(b),
            _ => Some(c),
        }
    }
}

/// How the weights of a polygon's corners become shares, where all that is left of it is before the camera.
pub(crate) struct Weigh<T> {
    /// w of the three vertices.
    vertex_w: [Scaled<T>; 3],
    wants: Wants,
    /// See [`Weights`].
    affine: bool,
    /// Linear in space: every corner's sum of |weight| over w is at most 2^magnitude, and the largest more than a quarter.
    magnitude: i32,
}

impl<T: Word> Weigh<T> {
    pub(crate) fn new(polygon: Held<'_, ClipCorner<T>>, vertex_w: [Scaled<T>; 3], wants: Wants) -> Self {
        let [a, b, c] = vertex_w;
        let affine = a == b && b == c;
        let mut magnitude = i32::MIN;
        if wants.space && !affine {
            for corner in polygon.iter() {
                if let Some(over_w) = corner.weights.over(w_of(corner.position)) {
                    let absolute = |s: Scaled<T>| if s.mantissas() < [T::ZERO] { s.negated() } else { s };
                    let [x, y, z] = over_w.split().map(absolute);
                    magnitude = magnitude.max(x.plus(y).plus(z).exponent().saturating_add(T::BITS as i32));
                }
            }
        }
        Weigh {
            vertex_w,
            wants,
            affine,
            magnitude,
        }
    }

    /// Those of a corner. Where nothing is wanted, nothing is compiled.
    #[inline(always)]
    pub(crate) fn weights<V: Carried>(&self, corner: &ClipCorner<T>) -> Weights {
        if V::WANTS.screen || V::WANTS.space {
            self.shares(corner)
        } else {
            Weights::of_vertex(0)
        }
    }

    /// What is kept of them, likewise.
    #[inline(always)]
    pub(super) fn shares_of<S: Shares>(&self, corner: &ClipCorner<T>) -> S {
        S::of(&if size_of::<S>() > 0 {
            self.shares(corner)
        } else {
            Weights::of_vertex(0)
        })
    }

    #[inline(never)]
    fn shares(&self, corner: &ClipCorner<T>) -> Weights {
        let vertex = vertex_of(corner);
        // Nothing of it is mixed, and nothing divided by its w.
        if let (Some(vertex), true) = (vertex, self.affine || !self.wants.space) {
            return Weights::of_vertex(vertex as usize);
        }
        let on_screen = if self.wants.screen || (self.wants.space && self.affine) {
            over_screen(corner, self.vertex_w)
        } else {
            [0; 3]
        };
        let space = if self.wants.space && !self.affine {
            // weight/w of the corner.
            let over_w = corner.weights.over(w_of(corner.position)).unwrap_or(Block::ZERO);
            over_w.scaled(self.magnitude.saturating_neg()).split().map(share)
        } else {
            on_screen
        };
        Weights {
            screen: on_screen,
            space,
            vertex,
            affine: self.affine,
        }
    }
}

/// The weights of a triangle's own corners, before the camera all of them: what [`Weigh`] makes of them.
pub(super) fn at_vertices<T: Word>(w: [Scaled<T>; 3]) -> [Weights; 3] {
    let mut weights = [0, 1, 2].map(Weights::of_vertex);
    let [a, b, c] = w;
    if a == b && b == c {
        return weights;
    }
    // Of three weights over w two are 0.
    let inverses = w.map(|w| Scaled::from_integer(1).over(w).unwrap_or(Scaled::ZERO));
    let magnitudes = inverses.map(|s| s.exponent().saturating_add(T::BITS as i32));
    let largest = magnitudes.into_iter().fold(i32::MIN, i32::max);
    for (i, (weights, inverse)) in weights.iter_mut().zip(inverses).enumerate() {
        weights.affine = false;
        if let Some(own) = weights.space.get_mut(i) {
            *own = share(inverse.scaled(largest.saturating_neg()));
        }
    }
    weights
}

/// The vertex that a corner is.
fn vertex_of<T: Word>(corner: &ClipCorner<T>) -> Option<u8> {
    let zero = T::ZERO;
    match corner.weights.mantissas() {
        [_, b, c] if b == zero && c == zero => Some(0),
        [a, _, c] if a == zero && c == zero => Some(1),
        [a, b, _] if a == zero && b == zero => Some(2),
        _ => None,
    }
}

/// Shares in proportion to weight·w of the vertices, whose sum is the corner's w: linear over the screen.
fn over_screen<T: Word>(corner: &ClipCorner<T>, [a_w, b_w, _]: [Scaled<T>; 3]) -> [i32; 3] {
    let [a, b, _] = corner.weights.split();
    parts_of_one(a.times(a_w), b.times(b_w), w_of(corner.position))
}

/// Shares of a corner that are linear in clip space, whatever is asked for.
pub(crate) fn in_clip_space<T: Word>(corner: &ClipCorner<T>) -> Weights {
    let [a, b, _] = corner.weights.split();
    let shares = parts_of_one(a, b, whole(corner.weights));
    Weights {
        screen: shares,
        space: shares,
        vertex: vertex_of(corner),
        affine: true,
    }
}

/// Shares of a corner that the near plane made (formats: `.iv`, clipping). Linear in clip space is linear in space; over
/// the screen only where all vertices of the corner have a place there.
pub(super) fn at_cut<T: Word>(corner: &ClipCorner<T>, vertex_w: [Scaled<T>; 3]) -> Weights {
    if let Some(vertex) = vertex_of(corner) {
        return Weights::of_vertex(vertex as usize);
    }
    let Weights { space, .. } = in_clip_space(corner);
    let mut parts = corner.weights.split().into_iter().zip(vertex_w);
    let on_screen = parts.all(|(part, w)| part.is_zero() || in_front(w));
    Weights {
        screen: if on_screen {
            over_screen(corner, vertex_w)
        } else {
            space
        },
        space,
        vertex: None,
        affine: true,
    }
}

/// What the weights add up to.
pub(super) fn whole<T: Word>(weights: Block<T, 3>) -> Scaled<T> {
    let [a, b, c] = weights.split();
    a.plus(b).plus(c)
}

/// a/whole, b/whole and what they leave of 1, each at most 1 either way.
fn parts_of_one<T: Word>(a: Scaled<T>, b: Scaled<T>, whole: Scaled<T>) -> [i32; 3] {
    let [a, b] = [a, b].map(|part| part.over(whole).map_or(0, share));
    [
        a,
        b,
        ((1i64 << 30) - a as i64 - b as i64).clamp(-1 << 30, 1 << 30) as i32,
    ]
}

/// In units of 2^-30, within ±1.
pub(super) fn share<T: Word>(part: Scaled<T>) -> i32 {
    part.to_fixed(30).clamp(-1 << 30, 1 << 30) as i32
}
