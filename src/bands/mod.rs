//! A frame band by band, for displays whose picture does not fit the memory: two small buffers, one being sent while the
//! other is drawn.
//!
//! ```text
//! submit ──► Frame ──► Pool (polygons, binned by band) ──► band buffer ──► Sink ──► display
//!    vertex, clip, projection: once        setup, spans, pixels              DMA
//! ```
//!
//! The polygons of a frame are stored on the screen, after vertices, clipping and projection, and drawn band by band: what
//! comes before the screen is done once per frame, what comes after it once per band that a polygon covers. A frame of more
//! polygons than the [`Pool`] holds is drawn in several passes over as many bands as fit, down to one band at a time without
//! any pool; each pass submits the scene again. The picture does not depend on any of it: it has the bits of the picture drawn
//! whole.

mod frame;
mod pool;
mod sink;

use crate::depth::{Comparison, Depth, DepthBuffer, FAR, NoDepth};
use crate::error::Error;
use crate::fragment::Fragment;
use crate::num::Word;
use crate::target::Buffer;
use crate::window::Window;

pub use frame::Frame;
use frame::Mode;
use pool::Bins;
pub use pool::Pool;
use sink::Queue;
pub use sink::{Blocking, Sink};

/// Whether bands have depth, and how it is compared: [`NoDepth`] or any [`Comparison`].
pub trait DepthTest {
    /// For one band.
    type Of<'a>: Depth;
    /// Whether it needs memory.
    const ENABLED: bool;
    /// Over the cells of `window`, cleared to the far end. `None` where there is too little memory.
    fn over(memory: &mut [u16], window: Window) -> Option<Self::Of<'_>>;
}

type Cells<'a, Z> = <Z as DepthTest>::Of<'a>;

impl DepthTest for NoDepth {
    type Of<'a> = NoDepth;
    const ENABLED: bool = false;

    fn over(_: &mut [u16], _: Window) -> Option<NoDepth> {
        Some(NoDepth)
    }
}

impl<C: Comparison> DepthTest for C {
    type Of<'a> = DepthBuffer<Buffer<'a, u16>, C>;
    const ENABLED: bool = true;

    fn over(memory: &mut [u16], window: Window) -> Option<Self::Of<'_>> {
        memory.fill(FAR);
        Buffer::strip(memory, window).ok().map(DepthBuffer::new)
    }
}

/// A picture drawn in bands: its size, the memory of its bands, and what they are cleared to.
///
/// `P` is the pixel, `B` a buffer of them (`&'static mut [u16]`, an array, anything that gives a slice), `Z` the
/// [`DepthTest`].
///
/// ```
/// use fixel::{bands::{Bands, Blocking, Pool}, depth::LessOrEqual, fragment::Flat, screen::Position};
///
/// // A display of 24×6 in bands of two rows.
/// let (mut front, mut back, mut depth) = ([0; 48], [0; 48], [0; 48]);
/// let bands = Bands::new(24, 6, [&mut front[..], &mut back[..]], b'.')?;
/// let mut bands = bands.with_depth::<LessOrEqual>(&mut depth)?;
/// assert_eq!(bands.rows(), 2);
///
/// let mut display = String::new();
/// let mut pool = Pool::<Flat<u8>, 30, 10, 3>::new();
/// let corners = [(2, 0), (0, 6), (24, 4)].map(|(x, y)| Position::from_pixels(x, y).flat());
/// let passes = bands.render(
///     &mut pool,
///     &mut Blocking(|_, pixels: &[u8]| {
///         pixels.chunks(24).for_each(|row| display += &format!("{}\n", str::from_utf8(row).unwrap()));
///         Ok::<(), ()>(())
///     }),
///     |frame| frame.triangle(corners, Flat(b'#')),
/// );
/// assert_eq!((passes, pool.used()), (Ok(1), (3, 1)));
/// assert_eq!(display, "\
/// ........................
/// ..######................
/// ..###########...........
/// .##################.....
/// .#######################
/// .###########............
/// ");
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Bands<'m, P, B, Z = NoDepth> {
    width: i32,
    height: i32,
    rows: i32,
    idle: [Option<B>; 2],
    depths: &'m mut [u16],
    background: P,
    test: core::marker::PhantomData<Z>,
}

impl<P: Copy, B: AsMut<[P]>> Bands<'_, P, B> {
    /// A picture of `width` × `height` pixels in bands of as many rows as both buffers hold, cleared to `background`.
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`] where a buffer holds less than a row; [`Error::TooLarge`] beyond 4096 pixels a side.
    pub fn new(width: u16, height: u16, buffers: [B; 2], background: P) -> Result<Self, Error> {
        Self::over(width, height, buffers.map(Some), background)
    }

    /// The same with one buffer: nothing is drawn while it is being sent.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn single(width: u16, height: u16, buffer: B, background: P) -> Result<Self, Error> {
        Self::over(width, height, [Some(buffer), None], background)
    }

    fn over(width: u16, height: u16, mut idle: [Option<B>; 2], background: P) -> Result<Self, Error> {
        const MOST: u16 = <i32 as Word>::GUARD as u16;
        if width > MOST || height > MOST {
            return Err(Error::TooLarge);
        }
        let lengths = idle.iter_mut().flatten().map(|buffer| buffer.as_mut().len());
        let least = lengths.min().unwrap_or(0);
        Ok(Bands {
            width: width as i32,
            height: height as i32,
            rows: rows(least, width, height)?,
            idle,
            depths: &mut [],
            background,
            test: core::marker::PhantomData,
        })
    }

    /// With 16-bit depth, for which there is one buffer. Bands have fewer rows where it is smaller than the others.
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`] where it holds less than a row.
    pub fn with_depth<Z: DepthTest>(self, depths: &mut [u16]) -> Result<Bands<'_, P, B, Z>, Error> {
        let most = if Z::ENABLED {
            rows(depths.len(), self.width as u16, self.height as u16)?
        } else {
            self.rows
        };
        Ok(Bands {
            width: self.width,
            height: self.height,
            rows: self.rows.min(most),
            idle: self.idle,
            depths,
            background: self.background,
            test: core::marker::PhantomData,
        })
    }
}

impl<P: Copy, B: AsMut<[P]>, Z: DepthTest> Bands<'_, P, B, Z> {
    /// Rows of a band; the last may have fewer.
    pub fn rows(&self) -> u16 {
        self.rows as u16
    }

    /// What the buffers are cleared to before they are drawn into, from the next frame on.
    pub fn set_background(&mut self, background: P) {
        self.background = background;
    }

    /// Draws the bands from the top, each by a call of `draw` with its buffers, and hands them to `sink`. Whatever the rooms
    /// of this crate draw can be drawn so, lines and pipelines too; positions are those of the whole picture.
    ///
    /// # Errors
    /// Those of the sink, with which it ends.
    ///
    /// ```
    /// use fixel::{bands::{Bands, Blocking}, draw, fragment::Flat};
    /// let mut memory = [0; 6];
    /// let mut bands = Bands::single(6, 3, &mut memory[..], b'.')?;
    /// let mut picture = Vec::new();
    /// let mut sink = Blocking(|_, row: &[u8]| Ok::<(), ()>(picture.extend_from_slice(row)));
    /// bands.each(&mut sink, |color, _| draw::line(color, (0, 2), (6, 0), &Flat(b'#'))).unwrap();
    /// assert_eq!(picture, b".....#..###.##....");
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    pub fn each<S: Sink<P, B>>(
        &mut self,
        sink: &mut S,
        mut draw: impl FnMut(&mut Buffer<'_, P>, &mut Cells<'_, Z>),
    ) -> Result<(), S::Error> {
        let (whole, rows) = (self.whole(), self.rows);
        let mut queue = Queue::new(&mut self.idle, sink);
        for window in split(whole, rows) {
            queue.band(window, |buffer| {
                if let Some((mut color, mut depth)) =
                    cleared::<P, Z>(buffer.as_mut(), self.depths, window, self.background)
                {
                    draw(&mut color, &mut depth);
                }
            })?;
        }
        queue.settle()
    }

    /// Draws a frame: `submit` hands its triangles over, `sink` gets the bands from the top. Returns how often `submit` was
    /// called: once where the pool held everything. It has to submit the same each time.
    ///
    /// The picture is that of drawing the same triangles in the same order onto the whole.
    ///
    /// # Errors
    /// Those of the sink, with which it ends.
    pub fn render<F, S, const CORNERS: usize, const POLYGONS: usize, const BANDS: usize>(
        &mut self,
        pool: &mut Pool<F, CORNERS, POLYGONS, BANDS>,
        sink: &mut S,
        mut submit: impl FnMut(&mut Frame<'_, F, Z>),
    ) -> Result<u32, S::Error>
    where
        F: Fragment<Pixel = P> + Copy,
        S: Sink<P, B>,
    {
        let (whole, rows) = (self.whole(), self.rows);
        let mut queue = Queue::new(&mut self.idle, sink);
        let (mut top, mut passes) = (0, 0u32);
        pool.bins().retry();
        while top < whole.bottom {
            passes = passes.wrapping_add(1);
            let mut bins = pool.bins();
            let reach = bins.reach();
            // Both below 2^16, and the height below 2^13.
            let bottom = whole
                .bottom
                .min(top.saturating_add(rows.saturating_mul(reach.max(1) as i32)));
            let pass = Window { top, bottom, ..whole };
            if reach == 0 {
                queue.band(pass, |buffer| {
                    if let Some((color, depth)) = cleared::<P, Z>(buffer.as_mut(), self.depths, pass, self.background) {
                        submit(&mut Frame(Mode::Draw {
                            color,
                            depth,
                            window: pass,
                        }));
                    }
                })?;
                top = bottom;
                continue;
            }
            bins.begin(pass, rows);
            let Some(mut bins) = store(bins, &mut submit) else {
                continue;
            };
            for (band, window) in (0..).zip(split(pass, rows)) {
                queue.band(window, |buffer| {
                    if let Some((mut color, mut depth)) =
                        cleared::<P, Z>(buffer.as_mut(), self.depths, window, self.background)
                    {
                        bins.draw(band, &mut color, &mut depth);
                    }
                })?;
            }
            bins.lengthen();
            top = bottom;
        }
        queue.settle()?;
        Ok(passes)
    }

    fn whole(&self) -> Window {
        Window::new(0, 0, self.width, self.height)
    }
}

/// The pool with everything in it; `None` where that did not fit, and the next pass has to be shorter.
fn store<'p, F, Z>(bins: Bins<'p, F>, submit: &mut impl FnMut(&mut Frame<'_, F, Z>)) -> Option<Bins<'p, F>>
where
    F: Fragment + Copy,
    Z: DepthTest,
{
    let mut frame = Frame(Mode::Store(bins));
    submit(&mut frame);
    let Frame(Mode::Store(mut bins)) = frame else {
        return None;
    };
    if bins.is_complete() {
        return Some(bins);
    }
    bins.shorten();
    None
}

/// A band's buffers, ready to be drawn into. `None` never: there is room for a band.
fn cleared<'b, P: Copy, Z: DepthTest>(
    buffer: &'b mut [P],
    depths: &'b mut [u16],
    window: Window,
    background: P,
) -> Option<(Buffer<'b, P>, Cells<'b, Z>)> {
    let count = window.width().saturating_mul(window.height());
    let buffer = buffer.get_mut(..count)?;
    buffer.fill(background);
    let depths = if Z::ENABLED { depths.get_mut(..count)? } else { depths };
    Some((Buffer::strip(buffer, window).ok()?, Z::over(depths, window)?))
}

/// Bands of `rows` rows from the top.
fn split(window: Window, rows: i32) -> impl Iterator<Item = Window> {
    let mut top = window.top;
    core::iter::from_fn(move || {
        let bottom = top.saturating_add(rows.max(1)).min(window.bottom);
        let band = Window { top, bottom, ..window };
        top = bottom;
        (!band.is_empty()).then_some(band)
    })
}

/// Rows that `pixels` hold, no more than the picture has, and at least one.
fn rows(pixels: usize, width: u16, height: u16) -> Result<i32, Error> {
    let height = height.max(1);
    match pixels.checked_div(width as usize).unwrap_or(usize::MAX) {
        0 => Err(Error::BufferTooSmall),
        rows => Ok(rows.min(height as usize) as i32),
    }
}
