//! Lines between subpixel ends.

use crate::depth::Depth;
use crate::fragment::{Antialiased, Fragment};
use crate::gradient::{Basis, Ramp};
use crate::num::Word;
use crate::screen::{Corner, Shape};
use crate::segment::{Axis, Nearest, Pairs, WHOLE};
use crate::span::Span;
use crate::target::Target;
use crate::varying::Varying;
use crate::view::{Carried, Vertex, View};

use super::planes::depth_plane;

/// Draws the line between two ends within ±4096 px, one pixel at every step of its longer axis; see
/// [`segment`](mod@crate::segment).
///
/// ```
/// use fixel::{depth::NoDepth, draw, fragment::Flat, screen::{Position, SubPx}, target::Buffer};
/// let mut picture = [b'.'; 8 * 3];
/// let ends = [("0.5", "0"), ("7", "1.9")].map(|(x, y)| {
///     Position::nearest(x.parse().unwrap(), y.parse().unwrap()).flat()
/// });
/// draw::segment(&mut Buffer::new(&mut picture, 8, 3)?, &mut NoDepth, ends, &Flat(b'#'));
/// let rows: Vec<_> = picture.chunks(8).map(|row| str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, [".##.....", "...###..", "......#."]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn segment<C, D, F>(color: &mut C, depth: &mut D, ends: [Corner<F::Varying>; 2], fragment: &F)
where
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    stroke::<i32, _, _, _, _>(color, depth, &ends, fragment);
}

/// Draws the antialiased line between two ends within ±4096 px: at every step of its longer axis two neighbouring pixels,
/// each in part; see [`segment`](mod@crate::segment).
///
/// Both are drawn at every step, the second after the first, with depth and all even where a part is 0.
///
/// ```
/// use fixel::{depth::NoDepth, draw, fragment::{Antialiased, Fragment}, screen::Position, target::Buffer};
///
/// /// White on any grey.
/// struct White;
///
/// impl Fragment for White {
///     type Varying = ();
///     type Pixel = u8;
///     fn shade(&self, (): (), _below: u8) -> Option<u8> {
///         Some(255)
///     }
/// }
///
/// impl Antialiased for White {
///     fn shade_part(&self, (): (), part: i32, below: u8) -> Option<u8> {
///         Some(below + ((255 - below) as i64 * part as i64 >> 28) as u8)
///     }
/// }
///
/// let mut picture = [0; 4 * 3];
/// let ends = [(0, 0), (4, 2)].map(|(x, y)| Position::from_pixels(x, y).flat());
/// draw::wu_line(&mut Buffer::new(&mut picture, 4, 3)?, &mut NoDepth, ends, &White);
/// assert_eq!(picture, [255, 127, 0, 0, 0, 127, 255, 127, 0, 0, 0, 127]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn wu_line<C, D, F>(color: &mut C, depth: &mut D, ends: [Corner<F::Varying>; 2], fragment: &F)
where
    C: Target,
    D: Depth,
    F: Antialiased<Pixel = C::Pixel>,
{
    wu_stroke::<i32, _, _, _, _>(color, depth, &ends, fragment);
}

/// Draws a line given in eye space: clips, projects and [draws](segment) what is left of it.
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
/// let rail = [[1, -1, -4, 1], [-3, -1, 2, 1]]; // one end is behind the camera
/// let ends = rail.map(|p| Vertex { position: Block::from_integers(p), carried: () });
/// let mut picture = [b'.'; 8 * 4];
/// draw::primitive_segment(&view, &mut Buffer::new(&mut picture, 8, 4)?, &mut NoDepth, &ends, &Flat(b'#'));
/// assert_eq!(&picture[24..], b"..###...");
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn primitive_segment<T, W, C, D, F, const N: usize>(
    view: &View<T, W, N>,
    color: &mut C,
    depth: &mut D,
    ends: &[Vertex<T, <F::Varying as Carried>::Vertex>; 2],
    fragment: &F,
) where
    T: Word,
    W: Word,
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel, Varying: Carried>,
{
    if let Some(line) = view.project_line::<F::Varying>(ends) {
        stroke::<W, _, _, _, _>(color, depth, &line, fragment);
    }
}

/// Draws an antialiased line given in eye space: clips, projects and [draws](wu_line) what is left of it.
///
/// The example of use is [`primitive_segment`]'s, that of a program [`wu_line`]'s.
pub fn primitive_wu_line<T, W, C, D, F, const N: usize>(
    view: &View<T, W, N>,
    color: &mut C,
    depth: &mut D,
    ends: &[Vertex<T, <F::Varying as Carried>::Vertex>; 2],
    fragment: &F,
) where
    T: Word,
    W: Word,
    C: Target,
    D: Depth,
    F: Antialiased<Pixel = C::Pixel, Varying: Carried>,
{
    if let Some(line) = view.project_line::<F::Varying>(ends) {
        wu_stroke::<W, _, _, _, _>(color, depth, &line, fragment);
    }
}

/// Draws the line between the two corners of `ends`, which lie within ±[`Word::GUARD`] px: [`segment`] for either word.
pub fn stroke<W, C, D, S, F>(color: &mut C, depth: &mut D, ends: &S, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Fragment<Pixel = C::Pixel>,
{
    let line = Nearest::<W>::new(ends, depth.limit(color.window()));
    let Some(mut along) = line.walk().span().and_then(|span| Along::new::<D>(ends, &span)) else {
        return;
    };
    for at in line {
        let values = || along.values();
        plot(color, depth, at, along.steps(), |below| fragment.shade(values(), below));
        along.advance();
    }
}

/// Draws the antialiased line between the two corners of `ends`, which lie within ±[`Word::GUARD`] px: [`wu_line`] for
/// either word.
pub fn wu_stroke<W, C, D, S, F>(color: &mut C, depth: &mut D, ends: &S, fragment: &F)
where
    W: Word,
    C: Target,
    D: Depth,
    S: Shape<Varying = F::Varying>,
    F: Antialiased<Pixel = C::Pixel>,
{
    let limit = depth.limit(color.window());
    let line = Pairs::<W>::new(ends, limit);
    let Some(mut along) = line.walk().span().and_then(|span| Along::new::<D>(ends, &span)) else {
        return;
    };
    for pair in line {
        for (at, part) in [(pair.first, WHOLE - pair.weight), (pair.second, pair.weight)] {
            if limit.contains(at) {
                let values = || along.values();
                plot(color, depth, at, along.steps(), |below| {
                    fragment.shade_part(values(), part, below)
                });
            }
        }
        along.advance();
    }
}

/// Depth and values at the current step of a line.
struct Along<V: Varying> {
    planes: V::Planes,
    ramps: V::Ramps,
    depth: Ramp<i32>,
}

impl<V: Varying> Along<V> {
    /// At the first step of `span`, the line's steps.
    fn new<D: Depth>(ends: &impl Shape<Varying = V>, span: &Span) -> Option<Self> {
        let axis = Axis::new(ends);
        let basis = Basis::new(&axis)?;
        let place = basis.place(span);
        let depth = if D::ENABLED {
            depth_plane(&basis, &axis).ramp(&place)
        } else {
            Ramp::default()
        };
        let mut planes = V::NO_PLANES;
        V::lay(&mut planes, &basis, 3, |i| axis.varying(i));
        let ramps = V::ramps(&planes, &place);
        Some(Along { planes, ramps, depth })
    }

    #[inline(always)]
    fn values(&self) -> V::Values {
        V::values(&self.planes, &self.ramps)
    }

    /// The nearest step of the 16-bit buffer.
    #[inline(always)]
    fn steps(&self) -> u32 {
        (self.depth.value as u32).wrapping_add(1 << 14) >> 15
    }

    #[inline(always)]
    fn advance(&mut self) {
        self.depth.advance();
        V::advance(&mut self.ramps);
    }
}

/// One fragment at a pixel of the window. Depth is tested before anything else is looked at.
#[inline(always)]
fn plot<C: Target, D: Depth>(
    color: &mut C,
    depth: &mut D,
    (x, y): (i32, i32),
    steps: u32,
    shade: impl Fn(C::Pixel) -> Option<C::Pixel>,
) {
    let pixel = Span {
        row: y,
        left: x,
        right: x + 1,
        whole_left: x,
        whole_right: x + 1,
    };
    let pixels = color.span(y, x, x + 1).iter_mut();
    for (pixel, cell) in pixels.zip(depth.cells(&pixel)) {
        if D::test(cell, steps)
            && let Some(new) = shade(*pixel)
        {
            *pixel = new;
        }
    }
}
