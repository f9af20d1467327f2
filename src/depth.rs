//! The 16-bit depth buffer, or none.

use core::hint::black_box;
use core::iter::RepeatN;
use core::marker::PhantomData;
use core::mem;
use core::slice::IterMut;

use crate::span::Span;
use crate::target::Target;
use crate::window::Window;

/// Whether a fragment of depth `new` is drawn over one of depth `old`, both 0…65535; smaller is nearer.
pub trait Comparison {
    /// Whether the depth of what passes is stored.
    const STORES: bool = true;

    /// The rule. On words: comparing halfwords costs an instruction more per pixel.
    fn passes(new: u32, old: u32) -> bool;
}

macro_rules! comparisons {
    ($($name:ident: $operator:tt, $what:literal;)*) => {$(
        #[doc = $what]
        ///
        /// ```
        /// use fixel::depth::{Comparison, LessOrEqual};
        /// assert!(LessOrEqual::passes(5, 5));
        /// ```
        #[derive(Debug, Clone, Copy)]
        pub enum $name {}

        impl Comparison for $name {
            #[inline(always)]
            fn passes(new: u32, old: u32) -> bool {
                new $operator old
            }
        }
    )*};
}

comparisons! {
    Less: <, "Nearer wins; of equals the earlier stays (`.iv`, OpenGL's default).";
    LessOrEqual: <=, "Nearer wins; of equals the later (HW2, MP1).";
    Greater: >, "Farther wins; of equals the earlier stays.";
    GreaterOrEqual: >=, "Farther wins; of equals the later.";
    Equal: ==, "Only fragments of the very depth that is stored.";
    NotEqual: !=, "Only fragments of another depth than is stored.";
}

/// As [`Less`], but on a cell at [`FAR`] everything passes: so a fragment on the far plane itself is drawn where nothing else
/// is, as if the buffer had been cleared to infinity (`.iv`).
///
/// ```
/// use fixel::depth::{Comparison, FAR, LessOrFar};
/// assert!(LessOrFar::passes(5, 6) && !LessOrFar::passes(5, 5));
/// assert!(LessOrFar::passes(FAR as u32, FAR as u32));
/// ```
#[derive(Debug, Clone, Copy)]
pub enum LessOrFar {}

impl Comparison for LessOrFar {
    #[inline(always)]
    fn passes(new: u32, old: u32) -> bool {
        new < old || old == FAR as u32
    }
}

/// Every fragment passes, and its depth is stored.
#[derive(Debug, Clone, Copy)]
pub enum Always {}

impl Comparison for Always {
    #[inline(always)]
    fn passes(_: u32, _: u32) -> bool {
        true
    }
}

/// Compares as `C` does, and stores nothing: for what is translucent.
///
/// ```
/// use fixel::depth::{Comparison, Keep, LessOrEqual};
/// assert!(Keep::<LessOrEqual>::passes(5, 5) && !Keep::<LessOrEqual>::STORES);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Keep<C>(PhantomData<C>);

impl<C: Comparison> Comparison for Keep<C> {
    const STORES: bool = false;

    #[inline(always)]
    fn passes(new: u32, old: u32) -> bool {
        C::passes(new, old)
    }
}

/// What a draw does about depth: [`NoDepth`], a [`DepthBuffer`], or a [`Switched`] one.
pub trait Depth {
    /// What there is to compare with at one pixel.
    type Cell<'a>;
    /// The cells of a span.
    type Cells<'a>: Iterator<Item = Self::Cell<'a>>
    where
        Self: 'a;
    /// All cells.
    type Block<'a>
    where
        Self: 'a;
    /// Whether depth is interpolated at all.
    const ENABLED: bool;

    /// What of `window` can be drawn.
    fn limit(&self, window: Window) -> Window;
    /// The cells of `span`.
    fn cells(&mut self, span: &Span) -> Self::Cells<'_>;
    /// The `count` cells of just this `window`, its rows `stride` apart; `None` where they are of another or lie in another way. As
    /// [`Target::block`].
    fn block(&mut self, window: &Window, stride: usize, count: usize) -> Option<Self::Block<'_>>;
    /// Some `count` cells of a block.
    fn block_cells<'a, 'b: 'a>(block: &'a mut Self::Block<'b>, start: usize, count: usize) -> Self::Cells<'a>
    where
        Self: 'b;
    /// Compares `depth`, 0…65535, and stores it; whether the fragment is drawn.
    fn test(cell: Self::Cell<'_>, depth: u32) -> bool;

    /// `cells` without those at the front whose fragments do not pass, as far as that is faster than to [`test`](Self::test)
    /// each, and the depth of what is first then: from `fine` on in units of 2^-15 step, `step` from cell to cell. `None` where
    /// none are left.
    #[inline(always)]
    fn skip<'a>(cells: Self::Cells<'a>, fine: u32, _step: u32) -> Option<(Self::Cells<'a>, u32)>
    where
        Self: 'a,
    {
        Some((cells, fine))
    }

    /// Calls `draw` with `pixels` from the first on, up to the first whose fragment does not pass; how many are left from that
    /// one on. Depths as in [`pass`](Self::pass).
    #[inline(always)]
    fn pass_first<'a, P>(
        cells: Self::Cells<'a>,
        pixels: &mut [P],
        mut fine: u32,
        step: u32,
        mut draw: impl FnMut(&mut P),
    ) -> usize
    where
        Self: 'a,
    {
        let mut fragments = pixels.iter_mut().zip(cells);
        while let Some((pixel, cell)) = fragments.next() {
            if !Self::test(cell, fine >> 15) {
                return fragments.size_hint().0.wrapping_add(1);
            }
            draw(pixel);
            fine = fine.wrapping_add(step);
        }
        0
    }

    /// How many fragments pass at the front of `cells`, up to the first that does not, whose depths are stored: from `fine` on in
    /// units of 2^-15 step, `step` from cell to cell. With it the cells that are left to be looked at, from that first or the one
    /// behind it on, and the depth of the first of them.
    #[inline(always)]
    fn pass<'a>(mut cells: Self::Cells<'a>, mut fine: u32, step: u32) -> (usize, Self::Cells<'a>, u32)
    where
        Self: 'a,
    {
        let mut passed = 0;
        for cell in &mut cells {
            let passes = Self::test(cell, fine >> 15);
            fine = fine.wrapping_add(step);
            if !passes {
                break;
            }
            passed += 1;
        }
        (passed, cells, fine)
    }

    /// Whether a fragment beyond the far end of the range, where nothing is cut off there, can pass at all. It then comes
    /// with depth 65535.
    fn takes_beyond(&self) -> bool {
        true
    }
}

/// No depth: later drawing covers earlier, and nothing is computed or stored.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoDepth;

impl Depth for NoDepth {
    type Cell<'a> = ();
    type Cells<'a> = RepeatN<()>;
    type Block<'a> = ();
    const ENABLED: bool = false;

    #[inline(always)]
    fn limit(&self, window: Window) -> Window {
        window
    }
    #[inline(always)]
    fn cells(&mut self, span: &Span) -> RepeatN<()> {
        core::iter::repeat_n((), (span.right - span.left) as usize)
    }
    #[inline(always)]
    fn block(&mut self, _: &Window, _: usize, _: usize) -> Option<()> {
        Some(())
    }
    #[inline(always)]
    fn block_cells<'a, 'b: 'a>(_: &'a mut (), _: usize, count: usize) -> RepeatN<()> {
        core::iter::repeat_n((), count)
    }
    #[inline(always)]
    fn test(_: (), _: u32) -> bool {
        true
    }
}

/// Depths in a [`Target`] of `u16`, 0 near, 65535 far: clear it to [`FAR`] first.
///
/// Depth is linear over the screen. A depth in 0…1 is stored as the nearest of 65536 steps; the stored one is within one
/// step of the true one on pictures within ±4096 px (half by rounding, less than a quarter by interpolation, an eighth in
/// triangles), within 2.5 on larger ones, where a row's 32-bit steps add up.
///
/// Of any window: what it shares with the picture's is drawn. Triangles are drawn fastest where both have one window and stride
/// ([`Target::block`]).
///
/// ```
/// use fixel::{depth::{DepthBuffer, FAR, LessOrEqual}, target::Buffer};
/// let mut memory = [FAR; 16 * 16];
/// let depth = DepthBuffer::<_, LessOrEqual>::new(Buffer::new(&mut memory, 16, 16)?);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug)]
pub struct DepthBuffer<D, C> {
    depths: D,
    comparison: PhantomData<C>,
}

/// What to clear a depth buffer to: the far end of the range.
pub const FAR: u16 = u16::MAX;

impl<D: Target<Pixel = u16>, C: Comparison> DepthBuffer<D, C> {
    /// Tests against `depths` and writes what passes there.
    pub fn new(depths: D) -> Self {
        DepthBuffer {
            depths,
            comparison: PhantomData,
        }
    }
}

impl<D: Target<Pixel = u16>, C: Comparison> Depth for DepthBuffer<D, C> {
    type Cell<'a> = &'a mut u16;
    type Cells<'a>
        = IterMut<'a, u16>
    where
        Self: 'a;
    type Block<'a>
        = &'a mut [u16]
    where
        Self: 'a;
    const ENABLED: bool = true;

    #[inline(always)]
    fn limit(&self, window: Window) -> Window {
        window.intersect(self.depths.window())
    }
    #[inline(always)]
    fn cells(&mut self, span: &Span) -> IterMut<'_, u16> {
        self.depths.span(span.row, span.left, span.right).iter_mut()
    }
    #[inline(always)]
    fn block(&mut self, window: &Window, stride: usize, count: usize) -> Option<&mut [u16]> {
        block(&mut self.depths, window, stride, count)
    }
    #[inline(always)]
    fn block_cells<'a, 'b: 'a>(block: &'a mut &'b mut [u16], start: usize, count: usize) -> IterMut<'a, u16>
    where
        Self: 'b,
    {
        some(block, start, count).iter_mut()
    }
    #[inline(always)]
    fn test(cell: &mut u16, depth: u32) -> bool {
        let passes = C::passes(depth, *cell as u32);
        if passes && C::STORES {
            *cell = depth as u16;
        }
        passes
    }
    #[inline(always)]
    fn skip<'a>(cells: Self::Cells<'a>, fine: u32, step: u32) -> Option<(Self::Cells<'a>, u32)>
    where
        Self: 'a,
    {
        skip(cells, fine, step, C::passes)
    }
    #[inline(always)]
    fn pass_first<'a, P>(
        cells: Self::Cells<'a>,
        pixels: &mut [P],
        mut fine: u32,
        step: u32,
        mut draw: impl FnMut(&mut P),
    ) -> usize
    where
        Self: 'a,
    {
        let cells = cells.into_slice();
        // Slices of one length, which is the only number that is counted.
        let count = pixels.len().min(cells.len());
        let (Some(mut pixels), Some(mut cells)) = (pixels.get_mut(..count), cells.get_mut(..count)) else {
            return 0;
        };
        while let ([pixel, other_pixels @ ..], [cell, others @ ..]) = (pixels, cells) {
            // Not unrolled: the state of several would not fit the registers.
            black_box(());
            if !Self::test(cell, fine >> 15) {
                return others.len().wrapping_add(1);
            }
            draw(pixel);
            fine = fine.wrapping_add(step);
            (pixels, cells) = (other_pixels, others);
        }
        0
    }
    #[inline(always)]
    fn pass<'a>(cells: IterMut<'a, u16>, fine: u32, step: u32) -> (usize, IterMut<'a, u16>, u32)
    where
        Self: 'a,
    {
        pass(cells, fine, step, C::passes, C::STORES)
    }
    #[inline(always)]
    fn takes_beyond(&self) -> bool {
        C::passes(1 << 16, 0) || C::passes(1 << 16, FAR as u32)
    }
}

/// The `count` depths of `window`, where they are those of just that and rows are `stride` apart.
#[inline(always)]
fn block<'a, D: Target<Pixel = u16>>(
    depths: &'a mut D,
    window: &Window,
    stride: usize,
    count: usize,
) -> Option<&'a mut [u16]> {
    if depths.window() != *window {
        return None;
    }
    let (block, own) = depths.block()?;
    if own == stride { block.get_mut(..count) } else { None }
}

/// `count` of `block`, or none.
#[inline(always)]
fn some(block: &mut [u16], start: usize, count: usize) -> &mut [u16] {
    block
        .get_mut(start..)
        .and_then(|rest| rest.get_mut(..count))
        .unwrap_or_default()
}

/// As [`Depth::skip`], six instructions a cell on Cortex-M4.
#[inline(always)]
fn skip(
    cells: IterMut<'_, u16>,
    mut fine: u32,
    step: u32,
    passes: impl Fn(u32, u32) -> bool,
) -> Option<(IterMut<'_, u16>, u32)> {
    let mut cells = cells.into_slice();
    while !passes(fine >> 15, *cells.first()? as u32) {
        // Rolled: the state of four would not fit the registers.
        black_box(());
        cells = cells.split_first_mut()?.1;
        fine = fine.wrapping_add(step);
    }
    Some((cells.iter_mut(), fine))
}

/// As [`Depth::pass`]: on Cortex-M4 eight instructions a cell.
#[inline(always)]
fn pass(
    cells: IterMut<'_, u16>,
    mut fine: u32,
    step: u32,
    passes: impl Fn(u32, u32) -> bool,
    stores: bool,
) -> (usize, IterMut<'_, u16>, u32) {
    let mut others = cells.into_slice();
    let count = others.len();
    while let [cell, ..] = others {
        // Rolled: unrolled, a compiler keeps several depths at a time.
        black_box(());
        if !passes(fine >> 15, *cell as u32) {
            break;
        }
        if stores {
            *cell = (fine >> 15) as u16;
        }
        fine = fine.wrapping_add(step);
        others = mem::take(&mut others).get_mut(1..).unwrap_or_default();
    }
    (count.wrapping_sub(others.len()), others.iter_mut(), fine)
}

/// As a [`DepthBuffer`], but what is done is chosen when drawing: for programs that draw both ways.
///
/// Costs the look at the options per fragment.
///
/// ```
/// use fixel::depth::{FAR, Options, Switched};
/// use fixel::target::Buffer;
/// let mut memory = [FAR; 16 * 16];
/// let mut depth = Switched::new(Buffer::new(&mut memory, 16, 16)?);
/// depth.options.stores = false;
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Switched<D> {
    depths: D,
    /// What is done.
    pub options: Options,
}

/// What a [`Switched`] depth buffer does. The default compares with [`Relation::LessOrEqual`] and stores.
///
/// ```
/// use fixel::depth::{Options, Relation};
/// assert_eq!(Options::default(), Options { passes: Relation::LessOrEqual, stores: true });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Which fragments pass: [`Relation::Always`] is a test switched off.
    pub passes: Relation,
    /// Whether the depths of those that pass are stored.
    pub stores: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            passes: Relation::LessOrEqual,
            stores: true,
        }
    }
}

/// A [`Comparison`] chosen when drawing.
///
/// ```
/// use fixel::depth::Relation;
/// assert!(Relation::Less.passes(4, 5) && !Relation::Less.passes(5, 5));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// As [`Less`].
    Less,
    /// As [`LessOrEqual`].
    LessOrEqual,
    /// As [`Greater`].
    Greater,
    /// As [`GreaterOrEqual`].
    GreaterOrEqual,
    /// As [`Equal`].
    Equal,
    /// As [`NotEqual`].
    NotEqual,
    /// As [`Always`].
    Always,
}

impl Relation {
    /// Whether a fragment of depth `new` is drawn over one of depth `old`.
    #[inline(always)]
    pub fn passes(self, new: u32, old: u32) -> bool {
        match self {
            Relation::Less => new < old,
            Relation::LessOrEqual => new <= old,
            Relation::Greater => new > old,
            Relation::GreaterOrEqual => new >= old,
            Relation::Equal => new == old,
            Relation::NotEqual => new != old,
            Relation::Always => true,
        }
    }
}

impl<D: Target<Pixel = u16>> Switched<D> {
    /// Tests against `depths` and writes what passes there, with the default [`Options`].
    pub fn new(depths: D) -> Self {
        Switched {
            depths,
            options: Options::default(),
        }
    }
}

/// The cells of a span of a [`Switched`] depth buffer.
#[derive(Debug)]
pub struct SwitchedCells<'a> {
    cells: IterMut<'a, u16>,
    options: Options,
}

impl<'a> Iterator for SwitchedCells<'a> {
    type Item = (&'a mut u16, Options);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        Some((self.cells.next()?, self.options))
    }
    #[inline(always)]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.cells.size_hint()
    }
}

impl<D: Target<Pixel = u16>> Depth for Switched<D> {
    type Cell<'a> = (&'a mut u16, Options);
    type Cells<'a>
        = SwitchedCells<'a>
    where
        Self: 'a;
    type Block<'a>
        = (&'a mut [u16], Options)
    where
        Self: 'a;
    const ENABLED: bool = true;

    #[inline(always)]
    fn limit(&self, window: Window) -> Window {
        window.intersect(self.depths.window())
    }
    #[inline(always)]
    fn cells(&mut self, span: &Span) -> Self::Cells<'_> {
        SwitchedCells {
            cells: self.depths.span(span.row, span.left, span.right).iter_mut(),
            options: self.options,
        }
    }
    #[inline(always)]
    fn block(&mut self, window: &Window, stride: usize, count: usize) -> Option<Self::Block<'_>> {
        Some((block(&mut self.depths, window, stride, count)?, self.options))
    }
    #[inline(always)]
    fn block_cells<'a, 'b: 'a>((block, options): &'a mut Self::Block<'b>, start: usize, count: usize) -> Self::Cells<'a>
    where
        Self: 'b,
    {
        SwitchedCells {
            cells: some(block, start, count).iter_mut(),
            options: *options,
        }
    }
    #[inline(always)]
    fn test((cell, options): (&mut u16, Options), depth: u32) -> bool {
        let passes = options.passes.passes(depth, *cell as u32);
        if passes && options.stores {
            *cell = depth as u16;
        }
        passes
    }
    #[inline(always)]
    fn skip<'a>(
        SwitchedCells { cells, options }: SwitchedCells<'a>,
        fine: u32,
        step: u32,
    ) -> Option<(SwitchedCells<'a>, u32)>
    where
        Self: 'a,
    {
        let (cells, fine) = skip(cells, fine, step, |new, old| options.passes.passes(new, old))?;
        Some((SwitchedCells { cells, options }, fine))
    }
    #[inline(always)]
    fn pass<'a>(
        SwitchedCells { cells, options }: SwitchedCells<'a>,
        fine: u32,
        step: u32,
    ) -> (usize, SwitchedCells<'a>, u32)
    where
        Self: 'a,
    {
        let (passed, cells, fine) = pass(
            cells,
            fine,
            step,
            |new, old| options.passes.passes(new, old),
            options.stores,
        );
        (passed, SwitchedCells { cells, options }, fine)
    }
    #[inline(always)]
    fn takes_beyond(&self) -> bool {
        let passes = self.options.passes;
        passes.passes(1 << 16, 0) || passes.passes(1 << 16, FAR as u32)
    }
}
