//! Squares and discs around a point.

use crate::depth::Depth;
use crate::disc::Disc;
use crate::fragment::Fragment;
use crate::gradient::Basis;
use crate::num::{Block, Word};
use crate::screen::SubPx;
use crate::square::Square;
use crate::target::Target;
use crate::varying::Linear;
use crate::view::View;

use super::paint;

/// Draws a square around a point; see [`square`](mod@crate::square).
///
/// ```
/// use fixel::{depth::NoDepth, draw, fragment::Flat, screen::{Center, FineDepth, SubPx}, square::Square, target::Buffer};
/// let mut picture = [b'.'; 5 * 4];
/// let center = Center { x: SubPx::lit("2"), y: SubPx::lit("1.5"), depth: FineDepth::ZERO };
/// let square = Square::new(center, SubPx::lit("2"), ());
/// draw::square(&mut Buffer::new(&mut picture, 5, 4)?, &mut NoDepth, &square, &Flat(b'#'));
/// let rows: Vec<_> = picture.chunks(5).map(|row| str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, [".....", ".##..", ".##..", "....."]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn square<C, D, F>(color: &mut C, depth: &mut D, square: &Square<F::Varying>, fragment: &F)
where
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    paint(color, depth, square, &Basis::new(square), square, fragment);
}

/// Draws a disc around a point; see [`disc`](mod@crate::disc).
///
/// ```
/// use fixel::{depth::NoDepth, disc::Disc, draw, fragment::Flat, screen::{Center, FineDepth, SubPx}, target::Buffer};
/// let mut picture = [b'.'; 6 * 6];
/// let center = Center { x: SubPx::lit("3"), y: SubPx::lit("3"), depth: FineDepth::ZERO };
/// let disc = Disc::new(center, SubPx::lit("4"), ());
/// draw::disc(&mut Buffer::new(&mut picture, 6, 6)?, &mut NoDepth, &disc, &Flat(b'#'));
/// let rows: Vec<_> = picture.chunks(6).map(|row| str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, ["......", "...#..", "..###.", ".####.", "..###.", "......"]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn disc<C, D, F>(color: &mut C, depth: &mut D, disc: &Disc<F::Varying>, fragment: &F)
where
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    paint(color, depth, disc, &Basis::new(disc), disc, fragment);
}

/// Draws a [`square`](square()) around a point in eye space, unless it is clipped: all of it or none.
///
/// ```
/// use fixel::{clip::{Behind, DepthRange, Planes}, matrix::Matrix, num::Block, screen::SubPx};
/// use fixel::{depth::NoDepth, draw, fragment::Flat, target::Buffer, view::{Cull, View}, viewport::Viewport};
/// let view = View::<i32, i32, 0> {
///     projection: Matrix::identity(),
///     planes: Planes::default(),
///     viewport: Viewport::new(0, 0, 8, 4)?,
///     depth_range: DepthRange::MinusOneToOne,
///     behind: Behind::Cut,
///     cull: Cull::Nothing,
/// };
/// let (mut picture, size) = ([b'.'; 8 * 4], SubPx::lit("2"));
/// let mut target = Buffer::new(&mut picture, 8, 4)?;
/// draw::primitive_square(&view, &mut target, &mut NoDepth, Block::from_integers([1, 0, 0, 2]), size, (), &Flat(b's'));
/// draw::primitive_disc(&view, &mut target, &mut NoDepth, Block::from_integers([-1, 0, 0, 2]), size, (), &Flat(b'd'));
/// let rows: Vec<_> = picture.chunks(8).map(|row| str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, ["........", "..d..ss.", ".dd..ss.", "........"]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn primitive_square<T, W, C, D, F, const N: usize>(
    view: &View<T, W, N>,
    color: &mut C,
    depth: &mut D,
    position: Block<T, 4>,
    size: SubPx,
    varying: F::Varying,
    fragment: &F,
) where
    T: Word,
    W: Word,
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    if let Some(center) = view.project_point(position) {
        square(color, depth, &Square::new(center, size, varying), fragment);
    }
}

/// Draws a [billboard](Square::billboard) around a point in eye space, unless it is clipped: all of it or none. Its values
/// run from the first two to the second two.
///
/// But for the values its example is [`primitive_square`]'s.
pub fn primitive_billboard<T, W, C, D, F, const N: usize>(
    view: &View<T, W, N>,
    color: &mut C,
    depth: &mut D,
    position: Block<T, 4>,
    size: SubPx,
    (from, to): ([i32; 2], [i32; 2]),
    fragment: &F,
) where
    T: Word,
    W: Word,
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel, Varying = Linear<2>>,
{
    if let Some(center) = view.project_point(position) {
        square(color, depth, &Square::billboard(center, size, from, to), fragment);
    }
}

/// Draws a [`disc`](disc()) around a point in eye space, unless it is clipped: all of it or none.
///
/// The example is [`primitive_square`]'s.
pub fn primitive_disc<T, W, C, D, F, const N: usize>(
    view: &View<T, W, N>,
    color: &mut C,
    depth: &mut D,
    position: Block<T, 4>,
    diameter: SubPx,
    varying: F::Varying,
    fragment: &F,
) where
    T: Word,
    W: Word,
    C: Target,
    D: Depth,
    F: Fragment<Pixel = C::Pixel>,
{
    if let Some(center) = view.project_point(position) {
        disc(color, depth, &Disc::new(center, diameter, varying), fragment);
    }
}
