//! Colour buffers: one or several, of any pixel, with blending or without.

use core::iter::{Repeat, RepeatN, Zip, repeat, repeat_n};
use core::slice::IterMut;

use crate::blend::{Blending, Replace, Rgba};
use crate::span::Span;
use crate::target::Target;
use crate::window::Window;

use super::format::PixelFormat;

/// A type that is a colour of its own: what a fragment program may put out for a buffer.
///
/// ```
/// #[derive(Clone, Copy)]
/// struct Heat(u8);
///
/// impl fixel::pipeline::Color for Heat {}
/// ```
pub trait Color: Copy {}

impl Color for Rgba {}
impl Color for bool {}
impl Color for u8 {}
impl Color for u16 {}
impl Color for u32 {}
impl Color for [u8; 3] {}
impl Color for [u8; 4] {}

/// One numbered place for colours: a [`Target`], a [`Surface`], or `()`. The example is [`Targets`]'.
pub trait Attachment {
    /// One pixel.
    type Cell<'a>
    where
        Self: 'a;
    /// The pixels of a span.
    type Cells<'a>: Iterator<Item = Self::Cell<'a>>
    where
        Self: 'a;
    /// What of `window` can be drawn.
    fn limit(&self, window: Window) -> Window;
    /// The pixels of `span`.
    fn cells(&mut self, span: &Span) -> Self::Cells<'_>;
}

/// A place that takes colours of type `X`. The example is [`Targets`]'.
pub trait Accepts<X>: Attachment {
    /// Writes `color`.
    fn put<'a>(cell: Self::Cell<'a>, color: X)
    where
        Self: 'a;
}

impl<C: Target> Attachment for C {
    type Cell<'a>
        = &'a mut C::Pixel
    where
        C: 'a;
    type Cells<'a>
        = IterMut<'a, C::Pixel>
    where
        C: 'a;

    #[inline(always)]
    fn limit(&self, window: Window) -> Window {
        window.intersect(self.window())
    }
    #[inline(always)]
    fn cells(&mut self, span: &Span) -> IterMut<'_, C::Pixel> {
        // Not by `span`, whose way for spans that are not there hides from the compiler how many pixels there are: flat fills
        // would look for the end at each of them (452 thousand instructions for 3 large triangles, not 315).
        let left = span.left.wrapping_sub(self.window().left) as u32 as usize;
        let right = left.wrapping_add(span.right.wrapping_sub(span.left) as u32 as usize);
        self.row(span.row).get_mut(left..right).unwrap_or_default().iter_mut()
    }
}

impl<C: Target> Accepts<C::Pixel> for C {
    #[inline(always)]
    fn put<'a>(cell: &'a mut C::Pixel, color: C::Pixel)
    where
        C: 'a,
    {
        *cell = color;
    }
}

/// Nothing attached.
impl Attachment for () {
    type Cell<'a> = ();
    type Cells<'a> = RepeatN<()>;

    #[inline(always)]
    fn limit(&self, window: Window) -> Window {
        window
    }
    #[inline(always)]
    fn cells(&mut self, span: &Span) -> RepeatN<()> {
        repeat_n((), span.right.saturating_sub(span.left).max(0) as usize)
    }
}

impl<X> Accepts<X> for () {
    #[inline(always)]
    fn put<'a>((): (), _: X)
    where
        Self: 'a,
    {
    }
}

/// A target that takes [`Rgba`] colours: blended with the pixel as `B` says, stored as `F` says.
///
/// ```
/// use fixel::{blend::Translucent, pipeline::Surface, target::Buffer, texture::Rgb565};
/// let mut memory = [0; 320 * 240];
/// let plain = Surface::new(Buffer::new(&mut memory, 320, 240)?, Rgb565);
/// let blended = plain.blended(Translucent);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Surface<C, F, B = Replace> {
    /// Where pixels go.
    pub target: C,
    /// How they are stored.
    pub format: F,
    /// What becomes of what is there: [`Replace`], an `Option<Blend>` to choose when drawing, or any other rule.
    pub blending: B,
}

impl<F: PixelFormat, C: Target<Pixel = F::Pixel>> Surface<C, F> {
    /// Without blending.
    pub const fn new(target: C, format: F) -> Self {
        Surface {
            target,
            format,
            blending: Replace,
        }
    }
}

impl<C, F, B> Surface<C, F, B> {
    /// The same with this blending instead.
    pub fn blended<R: Blending>(self, blending: R) -> Surface<C, F, R> {
        Surface {
            target: self.target,
            format: self.format,
            blending,
        }
    }
}

impl<F: PixelFormat, C: Target<Pixel = F::Pixel>, B: Blending> Attachment for Surface<C, F, B> {
    type Cell<'a>
        = (&'a mut F::Pixel, (&'a F, &'a B))
    where
        Self: 'a;
    type Cells<'a>
        = Zip<IterMut<'a, F::Pixel>, Repeat<(&'a F, &'a B)>>
    where
        Self: 'a;

    #[inline(always)]
    fn limit(&self, window: Window) -> Window {
        window.intersect(self.target.window())
    }
    #[inline(always)]
    fn cells(&mut self, span: &Span) -> Self::Cells<'_> {
        Attachment::cells(&mut self.target, span).zip(repeat((&self.format, &self.blending)))
    }
}

impl<F: PixelFormat, C: Target<Pixel = F::Pixel>, B: Blending> Accepts<Rgba> for Surface<C, F, B> {
    #[inline(always)]
    fn put<'a>((pixel, (format, blending)): Self::Cell<'a>, color: Rgba)
    where
        Self: 'a,
    {
        *pixel = format.encode(blending.blend(color, format.decode(*pixel)));
    }
}

/// All colour buffers of a draw: one [`Attachment`], a tuple of up to four, or an array.
///
/// A program's output has a colour for every buffer, in the same order: one for one, a tuple for a tuple, an array for an
/// array. A colour may be an `Option`, and `None` leaves that pixel as it is. The buffer `()` is none at all: what is put
/// out for it goes nowhere. Drawn is what all of them, and the depth buffer, have in common.
///
/// | buffer | takes |
/// |---|---|
/// | a [`Target`], or `&mut` to one | its pixels, as they are |
/// | a [`Surface`] | [`Rgba`], blended and encoded |
/// | `()` | anything |
///
/// ```
/// use fixel::{depth::NoDepth, num::Block, target::Buffer, viewport::Viewport};
/// use fixel::pipeline::{self, Pixel, Program, State};
///
/// struct Two;
///
/// impl Program for Two {
///     type Vertex = [i32; 2];
///     type Varying = ();
///     type At = Pixel;
///     type Output = (u16, Option<u8>);
///     fn vertex(&self, &[x, y]: &[i32; 2]) -> (Block<i32, 4>, ()) {
///         (Block::from_integers([x, y, 0, 1]), ())
///     }
///     fn fragment(&self, at: Pixel, (): ()) -> Option<(u16, Option<u8>)> {
///         Some((0xf800, (at.x < 2).then_some(7)))
///     }
/// }
///
/// let (mut colors, mut marks) = ([0; 4 * 4], [0; 4 * 4]);
/// let state = State::new(Viewport::<i32>::new(0, 0, 4, 4)?);
/// let mut targets = (Buffer::new(&mut colors, 4, 4)?, Buffer::new(&mut marks, 4, 4)?);
/// pipeline::triangles(&state, &mut targets, &mut NoDepth, &Two, &[[-1, -1], [3, -1], [-1, 3]]);
/// assert_eq!((colors[..4] == [0xf800; 4], &marks[..4]), (true, &[7, 7, 0, 0][..]));
///
/// // Only the second one.
/// let mut targets = ((), Buffer::new(&mut marks, 4, 4)?);
/// pipeline::triangles(&state, &mut targets, &mut NoDepth, &Two, &[[-1, -1], [3, -1], [-1, 3]]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
pub trait Targets {
    /// One pixel in all of them.
    type Cell<'a>
    where
        Self: 'a;
    /// The pixels of a span.
    type Cells<'a>: Iterator<Item = Self::Cell<'a>>
    where
        Self: 'a;
    /// What of `window` can be drawn in all of them.
    fn limit(&self, window: Window) -> Window;
    /// The pixels of `span`.
    fn cells(&mut self, span: &Span) -> Self::Cells<'_>;
}

/// What a program may put out for the buffers `C`. The example is [`Targets`]'.
pub trait Outputs<C: Targets> {
    /// Writes every colour to its buffer.
    fn put<'a>(self, cell: C::Cell<'a>)
    where
        C: 'a;
}

/// What a program may put out for one buffer `A`: a [`Color`], or an `Option` of one. The example is [`Targets`]'.
pub trait Slot<A: Attachment> {
    /// Writes the colour, if there is one.
    fn put<'a>(self, cell: A::Cell<'a>)
    where
        A: 'a;
}

impl<X: Color, A: Accepts<X>> Slot<A> for X {
    #[inline(always)]
    fn put<'a>(self, cell: A::Cell<'a>)
    where
        A: 'a,
    {
        A::put(cell, self);
    }
}

impl<X: Color, A: Accepts<X>> Slot<A> for Option<X> {
    #[inline(always)]
    fn put<'a>(self, cell: A::Cell<'a>)
    where
        A: 'a,
    {
        if let Some(color) = self {
            A::put(cell, color);
        }
    }
}

impl<A: Attachment> Targets for A {
    type Cell<'a>
        = A::Cell<'a>
    where
        A: 'a;
    type Cells<'a>
        = A::Cells<'a>
    where
        A: 'a;

    #[inline(always)]
    fn limit(&self, window: Window) -> Window {
        Attachment::limit(self, window)
    }
    #[inline(always)]
    fn cells(&mut self, span: &Span) -> A::Cells<'_> {
        Attachment::cells(self, span)
    }
}

impl<A: Attachment, S: Slot<A>> Outputs<A> for S {
    #[inline(always)]
    fn put<'a>(self, cell: A::Cell<'a>)
    where
        A: 'a,
    {
        Slot::put(self, cell);
    }
}

macro_rules! tuples {
    ($(($first:ident $first_slot:ident $first_index:tt, $($rest:ident $slot:ident $index:tt),*), $cells:ty, $cell:ty,
       $pattern:tt;)*) => {$(
        impl<$first: Attachment, $($rest: Attachment),*> Targets for ($first, $($rest),*) {
            type Cell<'a>
                = $cell
            where
                Self: 'a;
            type Cells<'a>
                = $cells
            where
                Self: 'a;

            #[inline(always)]
            fn limit(&self, window: Window) -> Window {
                let window = Attachment::limit(&self.$first_index, window);
                $(let window = Attachment::limit(&self.$index, window);)*
                window
            }
            #[inline(always)]
            fn cells(&mut self, span: &Span) -> Self::Cells<'_> {
                Attachment::cells(&mut self.$first_index, span)$(.zip(Attachment::cells(&mut self.$index, span)))*
            }
        }

        impl<$first, $first_slot, $($rest, $slot),*> Outputs<($first, $($rest),*)> for ($first_slot, $($slot),*)
        where
            $first: Attachment,
            $first_slot: Slot<$first>,
            $($rest: Attachment, $slot: Slot<$rest>),*
        {
            #[allow(non_snake_case)]
            #[inline(always)]
            fn put<'a>(self, $pattern: $cell)
            where
                ($first, $($rest),*): 'a,
            {
                Slot::put(self.$first_index, $first);
                $(Slot::put(self.$index, $rest);)*
            }
        }
    )*};
}

tuples! {
    (A S 0, B R 1), Zip<A::Cells<'a>, B::Cells<'a>>, (A::Cell<'a>, B::Cell<'a>), (A, B);
    (A S 0, B R 1, C Q 2), Zip<Zip<A::Cells<'a>, B::Cells<'a>>, C::Cells<'a>>,
        ((A::Cell<'a>, B::Cell<'a>), C::Cell<'a>), ((A, B), C);
    (A S 0, B R 1, C Q 2, D P 3), Zip<Zip<Zip<A::Cells<'a>, B::Cells<'a>>, C::Cells<'a>>, D::Cells<'a>>,
        (((A::Cell<'a>, B::Cell<'a>), C::Cell<'a>), D::Cell<'a>), (((A, B), C), D);
}

/// The pixels of a span in an array of buffers.
#[derive(Debug)]
pub struct Together<I, const N: usize>([I; N]);

impl<I: Iterator, const N: usize> Iterator for Together<I, N> {
    type Item = [Option<I::Item>; N];

    #[inline(always)]
    fn next(&mut self) -> Option<[Option<I::Item>; N]> {
        let cells = self.0.each_mut().map(Iterator::next);
        (N > 0 && cells.iter().all(Option::is_some)).then_some(cells)
    }
}

impl<A: Attachment, const N: usize> Targets for [A; N] {
    type Cell<'a>
        = [Option<A::Cell<'a>>; N]
    where
        A: 'a;
    type Cells<'a>
        = Together<A::Cells<'a>, N>
    where
        A: 'a;

    #[inline(always)]
    fn limit(&self, window: Window) -> Window {
        self.iter()
            .fold(window, |window, target| Attachment::limit(target, window))
    }
    #[inline(always)]
    fn cells(&mut self, span: &Span) -> Self::Cells<'_> {
        Together(self.each_mut().map(|target| Attachment::cells(target, span)))
    }
}

impl<A: Attachment, S: Slot<A>, const N: usize> Outputs<[A; N]> for [S; N] {
    #[inline(always)]
    fn put<'a>(self, cells: [Option<A::Cell<'a>>; N])
    where
        [A; N]: 'a,
    {
        for (output, cell) in self.into_iter().zip(cells) {
            if let Some(cell) = cell {
                Slot::put(output, cell);
            }
        }
    }
}
