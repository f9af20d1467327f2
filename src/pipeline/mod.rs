//! The programmable pipeline: your own vertex and fragment programs, compiled into the loops.
//!
//! A [`Program`] turns vertices into positions in clip space and what goes with them, and covered pixels into colours. A
//! [`State`] has the viewport, clip planes, culling and the kind of interpolation. [`triangles`] and [`lines`] draw lists
//! of vertices with both into [colour buffers](Targets) and a [depth](crate::depth::Depth) buffer or none.
//!
//! ```
//! use fixel::{depth::NoDepth, num::Block, target::Buffer, viewport::Viewport};
//! use fixel::pipeline::{self, Pixel, Program, State};
//!
//! struct Hello;
//!
//! impl Program for Hello {
//!     type Vertex = ([i32; 2], i32);
//!     type Varying = [i32; 1];
//!     type At = Pixel;
//!     type Output = u8;
//!
//!     fn vertex(&self, &([x, y], brightness): &([i32; 2], i32)) -> (Block<i32, 4>, [i32; 1]) {
//!         (Block::from_integers([x, y, 0, 1]), [brightness << 16])
//!     }
//!     fn fragment(&self, _at: Pixel, [brightness]: [i32; 1]) -> Option<u8> {
//!         Some((brightness >> 16) as u8)
//!     }
//! }
//!
//! let mut picture = [0; 64 * 48];
//! let state = State::new(Viewport::<i32>::new(0, 0, 64, 48)?.y_up().samples_at_centers());
//! let corners = [([-1, -1], 0), ([1, -1], 100), ([0, 1], 200)];
//! pipeline::triangles(&state, &mut Buffer::new(&mut picture, 64, 48)?, &mut NoDepth, &Hello, &corners);
//! # assert!((98..=100).contains(&picture[47 * 64 + 63]) && picture[47 * 64] <= 2 && picture[0] == 0);
//! # assert!((194..=197).contains(&picture[64 + 32]));
//! # Ok::<(), fixel::error::Error>(())
//! ```
//!
//! Without a program nothing compiles, so nothing is drawn. What a program does not use is not there: no varyings, no
//! interpolation; no [`FragCoord`], no depth plane; no [`Surface`], no conversion.
//!
//! A larger program, step by step: `docs/toon-shader.md`; more in `examples/`.
//!
//! **The order of a draw.** [Vertex program](Program::vertex) · clip planes, in homogeneous space · culling of the whole
//! clipped polygon · division and viewport · coverage by the top-left rule · interpolation ·
//! [fragment program](Program::fragment) · discard · depth test · depth write · [blending](crate::blend::Blending) · colour
//! write.
//!
//! **Conventions.** Samples at pixel centres: [`Viewport::samples_at_centers`](crate::viewport::Viewport::samples_at_centers).
//! The first row of memory is the bottom one, and pictures are turned over when written out: [`from_the_top`]; or the first
//! row is the top one: [`Viewport::y_up`](crate::viewport::Viewport::y_up). Colours with head-room: a target of
//! [`Rgba`](crate::blend::Rgba), written out by [`to_bytes`](crate::blend::Rgba::to_bytes).
//!
//! **Depth** runs from z = −w to z = w, 0 to 65535. There is no far plane unless one is given: what lies beyond is drawn
//! where there is no depth buffer, never passes [`Less`](crate::depth::Less) or
//! [`LessOrEqual`](crate::depth::LessOrEqual), and counts as 65535 for other comparisons. What lies before the range, where
//! the near plane was taken away, counts as 0.
//!
//! **Lines** are Bresenham's from the pixel that one end lies in to that of the other, both drawn; a viewport's border moves
//! no pixel. Values are those at the projection of the pixel's centre on the uncut line. Planes cut lines as they cut
//! triangles.

use core::borrow::Borrow;

use crate::depth::Depth;
use crate::num::Word;

mod fill;
mod format;
mod planes;
mod program;
mod project;
mod region;
mod sampler;
pub mod shapes;
mod state;
mod targets;

pub use format::{HeadRoom, OneBit, PixelFormat, from_the_top, get, set};
pub use planes::{clip_line, clip_polygon, plane_distance};
pub use program::{Coordinates, FragCoord, Pixel, Place, Program, Shaded, Values, Varyings};
pub use region::{Region, clip_to_region};
pub use sampler::{
    ClampToEdge, Filter, Filtering, Image, Linear as LinearFilter, MirroredClampToEdge, MirroredRepeat, Nearest,
    Picture, Repeat, Sampler, Wrap, Wrapping,
};
pub use state::{Culling, Interpolation, Linear, PerspectiveCorrected, State};
pub use targets::{Accepts, Attachment, Color, Outputs, Slot, Surface, Targets, Together};

use project::Wanted;

/// Draws a list of triangles: every three vertices are one, and what is left over is ignored.
///
/// `vertices` is a slice, or anything else that gives vertices or references to them. The vertex program runs once for each
/// vertex; a triangle is drawn as soon as its three have run.
///
/// The example is the [module](self)'s.
pub fn triangles<I, T, W, C, D, P, const N: usize>(
    state: &State<I, T, W, N>,
    colors: &mut C,
    depth: &mut D,
    program: &P,
    vertices: impl IntoIterator<Item: Borrow<P::Vertex>>,
) where
    I: Interpolation,
    T: Word,
    W: Word,
    C: Targets,
    D: Depth,
    P: Program<T, Output: Outputs<C>>,
{
    let mut vertices = vertices.into_iter();
    while let (Some(a), Some(b), Some(c)) = (vertices.next(), vertices.next(), vertices.next()) {
        let corners = [a.borrow(), b.borrow(), c.borrow()].map(|v| Shaded::new(program, v));
        triangle(state, colors, depth, program, corners.each_ref());
    }
}

/// Draws a list of lines: every two vertices are one, and a last one alone is ignored.
///
/// ```
/// use fixel::{depth::NoDepth, num::Block, target::Buffer, viewport::Viewport};
/// use fixel::pipeline::{self, Pixel, Program, State};
///
/// struct Chalk;
///
/// impl Program for Chalk {
///     type Vertex = [i32; 2];
///     type Varying = ();
///     type At = Pixel;
///     type Output = u8;
///     fn vertex(&self, &[x, y]: &[i32; 2]) -> (Block<i32, 4>, ()) {
///         (Block::from_integers([x, y, 0, 4]), ())
///     }
///     fn fragment(&self, _at: Pixel, (): ()) -> Option<u8> {
///         Some(b'#')
///     }
/// }
///
/// let mut picture = [b'.'; 8 * 4];
/// let state = State::new(Viewport::<i32>::new(0, 0, 8, 4)?.samples_at_centers());
/// pipeline::lines(&state, &mut Buffer::new(&mut picture, 8, 4)?, &mut NoDepth, &Chalk, &[[-3, -3], [3, 3]]);
/// let rows: Vec<_> = picture.chunks(8).map(|row| str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, [".#......", "..##....", "....##..", "......##"]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn lines<I, T, W, C, D, P, const N: usize>(
    state: &State<I, T, W, N>,
    colors: &mut C,
    depth: &mut D,
    program: &P,
    vertices: impl IntoIterator<Item: Borrow<P::Vertex>>,
) where
    I: Interpolation,
    T: Word,
    W: Word,
    C: Targets,
    D: Depth,
    P: Program<T, Output: Outputs<C>>,
{
    let mut vertices = vertices.into_iter();
    while let (Some(a), Some(b)) = (vertices.next(), vertices.next()) {
        let ends = [a.borrow(), b.borrow()].map(|v| Shaded::new(program, v));
        line(state, colors, depth, program, ends.each_ref());
    }
}

/// As [`triangles`], but the vertex program runs for as many triangles as fit in `buffer` before the first of them is
/// drawn: with a place for every vertex, before any fragment. A buffer of less than three draws nothing.
///
/// ```
/// # use fixel::{depth::NoDepth, num::Block, target::Buffer, viewport::Viewport};
/// # use fixel::pipeline::{self, Pixel, Program, Shaded, State};
/// # struct Chalk;
/// # impl Program for Chalk {
/// #     type Vertex = [i32; 2];
/// #     type Varying = ();
/// #     type At = Pixel;
/// #     type Output = u8;
/// #     fn vertex(&self, &[x, y]: &[i32; 2]) -> (Block<i32, 4>, ()) {
/// #         (Block::from_integers([x, y, 0, 1]), ())
/// #     }
/// #     fn fragment(&self, _at: Pixel, (): ()) -> Option<u8> {
/// #         Some(b'#')
/// #     }
/// # }
/// # let mut picture = [b'.'; 8 * 4];
/// # let state = State::new(Viewport::<i32>::new(0, 0, 8, 4)?);
/// # let mut color = Buffer::new(&mut picture, 8, 4)?;
/// let mut buffer = [Shaded::EMPTY; 3];
/// let corners = [[-1, -1], [1, -1], [-1, 1]];
/// pipeline::triangles_buffered(&state, &mut color, &mut NoDepth, &Chalk, &corners, &mut buffer);
/// # assert_eq!(&picture[..9], b"########.".map(|c| if c == b'.' { b'#' } else { c }));
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn triangles_buffered<I, T, W, C, D, P, const N: usize>(
    state: &State<I, T, W, N>,
    colors: &mut C,
    depth: &mut D,
    program: &P,
    vertices: impl IntoIterator<Item: Borrow<P::Vertex>>,
    buffer: &mut [Shaded<T, <P::Varying as Varyings>::Values>],
) where
    I: Interpolation,
    T: Word,
    W: Word,
    C: Targets,
    D: Depth,
    P: Program<T, Output: Outputs<C>>,
{
    buffered(program, vertices, buffer, |[a, b, c]| {
        triangle(state, colors, depth, program, [a, b, c])
    });
}

/// As [`lines`], but the vertex program runs for as many lines as fit in `buffer` before the first of them is drawn; see
/// [`triangles_buffered`].
pub fn lines_buffered<I, T, W, C, D, P, const N: usize>(
    state: &State<I, T, W, N>,
    colors: &mut C,
    depth: &mut D,
    program: &P,
    vertices: impl IntoIterator<Item: Borrow<P::Vertex>>,
    buffer: &mut [Shaded<T, <P::Varying as Varyings>::Values>],
) where
    I: Interpolation,
    T: Word,
    W: Word,
    C: Targets,
    D: Depth,
    P: Program<T, Output: Outputs<C>>,
{
    buffered(program, vertices, buffer, |[a, b]| {
        line(state, colors, depth, program, [a, b])
    });
}

/// Fills the buffer with whole primitives of K vertices and calls `draw` with each, until there are no more.
fn buffered<T, P, const K: usize>(
    program: &P,
    vertices: impl IntoIterator<Item: Borrow<P::Vertex>>,
    buffer: &mut [Shaded<T, <P::Varying as Varyings>::Values>],
    mut draw: impl FnMut([&Shaded<T, <P::Varying as Varyings>::Values>; K]),
) where
    T: Word,
    P: Program<T>,
{
    let mut vertices = vertices.into_iter();
    loop {
        let mut filled = 0;
        let (places, _) = buffer.as_chunks_mut::<K>();
        for primitive in places {
            let given = [(); K].map(|()| vertices.next());
            if !given.iter().all(Option::is_some) {
                break;
            }
            for (place, vertex) in primitive.iter_mut().zip(given.iter().flatten()) {
                *place = Shaded::new(program, vertex.borrow());
            }
            filled += 1;
        }
        if filled == 0 {
            return;
        }
        let (primitives, _) = buffer.as_chunks::<K>();
        primitives
            .iter()
            .take(filled)
            .for_each(|primitive| draw(primitive.each_ref()));
    }
}

/// Draws one triangle whose vertices the vertex program has [made](Shaded::new): for indexed meshes that keep them.
///
/// ```
/// # use fixel::{depth::NoDepth, num::Block, target::Buffer, viewport::Viewport};
/// # use fixel::pipeline::{self, Pixel, Program, Shaded, State};
/// # struct Chalk;
/// # impl Program for Chalk {
/// #     type Vertex = [i32; 2];
/// #     type Varying = ();
/// #     type At = Pixel;
/// #     type Output = u8;
/// #     fn vertex(&self, &[x, y]: &[i32; 2]) -> (Block<i32, 4>, ()) {
/// #         (Block::from_integers([x, y, 0, 1]), ())
/// #     }
/// #     fn fragment(&self, _at: Pixel, (): ()) -> Option<u8> {
/// #         Some(b'#')
/// #     }
/// # }
/// # let mut picture = [b'.'; 8 * 4];
/// # let state = State::new(Viewport::<i32>::new(0, 0, 8, 4)?);
/// # let mut color = Buffer::new(&mut picture, 8, 4)?;
/// // A square of two triangles, and four vertices.
/// let [a, b, c, d] = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(|v| Shaded::new(&Chalk, &v));
/// for corners in [[&a, &b, &c], [&a, &c, &d]] {
///     pipeline::triangle(&state, &mut color, &mut NoDepth, &Chalk, corners);
/// }
/// assert_eq!(picture, [b'#'; 8 * 4]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub fn triangle<I, T, W, C, D, P, const N: usize>(
    state: &State<I, T, W, N>,
    colors: &mut C,
    depth: &mut D,
    program: &P,
    [a, b, c]: [&Shaded<T, <P::Varying as Varyings>::Values>; 3],
) where
    I: Interpolation,
    T: Word,
    W: Word,
    C: Targets,
    D: Depth,
    P: Program<T, Output: Outputs<C>>,
{
    let window = depth.limit(colors.limit(state.viewport.window()));
    let positions = [a.position, b.position, c.position];
    let values = [a.values, b.values, c.values];
    let wanted = wanted::<T, D, P>(depth);
    project::triangle::<_, T, W, I::Of<_>, N>(state, wanted, positions, values, |piece| {
        fill::polygon::<T, W, C, D, P, _, N>(colors, depth, window, piece, program);
    });
}

/// Draws one line whose vertices the vertex program has [made](Shaded::new); see [`triangle`].
pub fn line<I, T, W, C, D, P, const N: usize>(
    state: &State<I, T, W, N>,
    colors: &mut C,
    depth: &mut D,
    program: &P,
    [a, b]: [&Shaded<T, <P::Varying as Varyings>::Values>; 2],
) where
    I: Interpolation,
    T: Word,
    W: Word,
    C: Targets,
    D: Depth,
    P: Program<T, Output: Outputs<C>>,
{
    let window = depth.limit(colors.limit(state.viewport.window()));
    let (positions, values) = ([a.position, b.position], [a.values, b.values]);
    let wanted = wanted::<T, D, P>(depth);
    if let Some(piece) = project::line::<_, T, W, I::Of<_>, N>(state, wanted, positions, values) {
        let against = state.viewport.is_y_up();
        fill::line::<T, C, D, P, _, N>(colors, depth, window, against, &piece, program);
    }
}

/// What has to be interpolated.
#[inline(always)]
fn wanted<T: Word, D: Depth, P: Program<T>>(depth: &D) -> Wanted {
    Wanted {
        depth: D::ENABLED || P::At::DEPTH,
        beyond: !D::ENABLED || depth.takes_beyond(),
        inverse_w: P::At::INVERSE_W,
    }
}
