//! A drawing drawn by the core on this machine: what decides whether a smaller set of features gives the same bytes.

use std::cell::Cell;
use std::convert::Infallible;
use std::iter::{Repeat, Zip, repeat};
use std::slice::IterMut;

use fixel::blend::Rgba;
use fixel::depth::{Comparison, Depth, FAR, LessOrEqual, LessOrFar};
use fixel::disc::Disc;
use fixel::draw;
use fixel::fragment::{Antialiased, Fragment};
use fixel::num::Word;
use fixel::span::{Corners, Span, doubled_area};
use fixel::square::Square;
use fixel::supersample::Level;
use fixel::target::{Buffer, Target};
use fixel::varying::{self, Linear, Perspective};
use fixel::window::Window;

use super::drawing::{Corner, Draw, Drawing, Nearer, Pixels, Shape, Units, Varying};
use super::evaluate::{Evaluator, Ready};
use crate::fixed::mp1::units;

/// What a drawing came to.
#[derive(Debug, Clone)]
pub struct Replayed {
    /// Its pixels.
    pub bytes: Vec<[u8; 4]>,
    /// What each draw had to do.
    pub work: Vec<Work>,
}

/// What a draw had to do.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Rows it covers.
    pub spans: u64,
    /// Samples it covers.
    pub covered: u64,
    /// Samples it colours.
    pub shaded: u64,
}

/// Draws all of it.
pub fn replay(drawing: &Drawing) -> Replayed {
    if drawing.wide {
        with_word::<i64>(drawing)
    } else {
        with_word::<i32>(drawing)
    }
}

/// The most values that a corner carries.
const MOST: usize = 12;

fn with_word<W: Word>(drawing: &Drawing) -> Replayed {
    let (width, height) = (drawing.width * drawing.level, drawing.height * drawing.level);
    let window = Window::new(0, 0, width as i32, height as i32);
    let mut samples = vec![Rgba::default(); window.width() * window.height()];
    let mut depths = vec![FAR; samples.len()];
    let evaluator = Evaluator::new(drawing);
    let mut work = Vec::with_capacity(drawing.draws.len());
    for draw in &drawing.draws {
        let (spans, covered, shaded) = (Cell::new(0), Cell::new(0), Cell::new(0));
        let color = Buffer::strip(&mut samples, window);
        let cells = Buffer::strip(&mut depths, window);
        if let (Ok(mut color), Ok(cells)) = (color, cells) {
            let mut depth = Chosen {
                cells,
                rule: drawing.depth,
                spans: &spans,
                covered: &covered,
            };
            let mut ready = |ready: &Ready<'_>| {
                one::<W>(&mut color, &mut depth, draw, ready, &shaded);
            };
            evaluator.ready(&draw.program, &mut ready);
        }
        work.push(Work {
            spans: spans.get(),
            covered: covered.get(),
            shaded: shaded.get(),
        });
    }
    Replayed {
        bytes: bytes(drawing, &samples),
        work,
    }
}

fn bytes(drawing: &Drawing, samples: &[Rgba]) -> Vec<[u8; 4]> {
    match drawing.pixels {
        Pixels::Bytes | Pixels::Opaque(_) => samples.iter().map(|s| stored(*s)).collect(),
        Pixels::Blended(units) => {
            let level = Level::new(drawing.level).expect("the scene's parser has checked it");
            let stride = (drawing.width * drawing.level) as usize;
            let mut bytes = Vec::with_capacity((drawing.width * drawing.height) as usize);
            for rows in samples.chunks(stride * level.side()) {
                level.resolve(rows, stride, |_, color| bytes.push(blended(units, color)));
            }
            bytes
        }
    }
}

/// A pixel of bytes, kept in a wider one.
fn stored(Rgba { color, alpha }: Rgba) -> [u8; 4] {
    let [r, g, b] = color.map(|c| c as u8);
    [r, g, b, alpha as u8]
}

/// A linear colour as bytes.
pub fn blended(Units { shift, srgb }: Units, Rgba { color, alpha }: Rgba) -> [u8; 4] {
    let units = units::Units { shift, srgb };
    let [r, g, b] = color.map(|c| units.byte(c));
    [r, g, b, units::byte(alpha)]
}

fn one<W: Word>(
    color: &mut Buffer<'_, Rgba>,
    depth: &mut Chosen<'_>,
    draw: &Draw,
    ready: &Ready<'_>,
    shaded: &Cell<u64>,
) {
    let corners = draw.shape.corners();
    let count = corners.first().map_or(0, |corner| corner.values.len());
    let program = (ready, shaded);
    match (draw.varying, count) {
        (Varying::Perspective, ..=4) => shape::<W, Perspective<4>, 4>(color, depth, &draw.shape, program),
        (Varying::Perspective, _) => shape::<W, Perspective<MOST>, MOST>(color, depth, &draw.shape, program),
        (_, ..=4) => shape::<W, Linear<4>, 4>(color, depth, &draw.shape, program),
        (_, _) => shape::<W, Linear<MOST>, MOST>(color, depth, &draw.shape, program),
    }
}

fn shape<W: Word, V: Made<N>, const N: usize>(
    color: &mut Buffer<'_, Rgba>,
    depth: &mut Chosen<'_>,
    drawn: &Shape,
    (ready, shaded): (&Ready<'_>, &Cell<u64>),
) {
    let program = Dynamic::<'_, V, N> {
        ready,
        shaded,
        count: drawn.corners().first().map_or(0, |corner| corner.values.len()),
        varying: std::marker::PhantomData,
    };
    let made = |corners: &[Corner]| OnScreen(corners.iter().map(|c| (c.position, c.depth, V::made(c))).collect());
    match drawn {
        Shape::Polygon(corners) => {
            let polygon = made(corners);
            draw::polygon::<W, _, _, _, _>(color, depth, &polygon, doubled_area(&polygon), &program);
        }
        Shape::Line { smooth: false, ends } => {
            draw::stroke::<W, _, _, _, _>(color, depth, &made(ends), &program);
        }
        Shape::Line { smooth: true, ends } => {
            draw::wu_stroke::<W, _, _, _, _>(color, depth, &made(ends), &program);
        }
        Shape::Point {
            round: false,
            center,
            size,
        } => {
            let program = Dynamic::<'_, Linear<0>, 0>::new(ready, shaded);
            draw::square(color, depth, &Square::new(*center, *size, Linear([])), &program);
        }
        Shape::Point {
            round: true,
            center,
            size,
        } => {
            let program = Dynamic::<'_, Linear<0>, 0>::new(ready, shaded);
            draw::disc(color, depth, &Disc::new(*center, *size, Linear([])), &program);
        }
        Shape::Billboard { center, size, far } => {
            let program = Dynamic::<'_, Linear<2>, 2>::new(ready, shaded);
            draw::square(color, depth, &Square::billboard(*center, *size, [0; 2], *far), &program);
        }
    }
}

/// Corners with positions, depths and varyings.
struct OnScreen<V>(Vec<((i32, i32), i32, V)>);

impl<V> Corners for OnScreen<V> {
    fn count(&self) -> usize {
        self.0.len()
    }
    fn position(&self, index: usize) -> (i32, i32) {
        self.0[index].0
    }
}

impl<V: varying::Varying> fixel::screen::Shape for OnScreen<V> {
    type Varying = V;
    fn depth(&self, index: usize) -> i32 {
        self.0[index].1
    }
    fn varying(&self, index: usize) -> V {
        self.0[index].2
    }
}

/// A varying made of a corner that was written down.
trait Made<const N: usize>: varying::Varying<Values = [i32; N]> {
    fn made(corner: &Corner) -> Self;
}

/// The values, and 0 for those that are not there.
fn padded<const N: usize>(values: &[i32]) -> [i32; N] {
    let mut values = values.iter();
    std::array::from_fn(|_| values.next().copied().unwrap_or_default())
}

impl<const N: usize> Made<N> for Linear<N> {
    fn made(corner: &Corner) -> Self {
        Linear(padded(&corner.values))
    }
}

impl<const N: usize> Made<N> for Perspective<N> {
    fn made(corner: &Corner) -> Self {
        Perspective {
            over_w: padded(&corner.over_w),
            inverse: corner.inverse,
            values: padded(&corner.values),
        }
    }
}

/// Any program on the first `count` of N values.
struct Dynamic<'a, V, const N: usize> {
    ready: &'a Ready<'a>,
    shaded: &'a Cell<u64>,
    count: usize,
    varying: std::marker::PhantomData<V>,
}

impl<'a, V, const N: usize> Dynamic<'a, V, N> {
    fn new(ready: &'a Ready<'a>, shaded: &'a Cell<u64>) -> Self {
        Dynamic {
            ready,
            shaded,
            count: N,
            varying: std::marker::PhantomData,
        }
    }
}

impl<V: varying::Varying<Values = [i32; N]>, const N: usize> Fragment for Dynamic<'_, V, N> {
    type Varying = V;
    type Pixel = Rgba;

    fn shade(&self, values: [i32; N], below: Rgba) -> Option<Rgba> {
        self.shaded.set(self.shaded.get() + 1);
        Some(self.ready.shade(&values[..self.count], None, below))
    }
}

impl<V: varying::Varying<Values = [i32; N]>, const N: usize> Antialiased for Dynamic<'_, V, N> {
    fn shade_part(&self, values: [i32; N], part: i32, below: Rgba) -> Option<Rgba> {
        self.shaded.set(self.shaded.get() + 1);
        Some(self.ready.shade(&values[..self.count], Some(part), below))
    }
}

/// A depth buffer with the drawing's rule, or none, that counts.
pub(super) struct Chosen<'a> {
    pub(super) cells: Buffer<'a, u16>,
    pub(super) rule: Option<Nearer>,
    pub(super) spans: &'a Cell<u64>,
    pub(super) covered: &'a Cell<u64>,
}

impl<'b> Depth for Chosen<'b> {
    type Cell<'a> = (&'a mut u16, (Option<Nearer>, &'b Cell<u64>));
    type Cells<'a>
        = Zip<IterMut<'a, u16>, Repeat<(Option<Nearer>, &'b Cell<u64>)>>
    where
        Self: 'a;
    type Block<'a>
        = Infallible
    where
        Self: 'a;
    const ENABLED: bool = true;

    fn limit(&self, window: Window) -> Window {
        window
    }
    fn cells(&mut self, span: &Span) -> Self::Cells<'_> {
        self.spans.set(self.spans.get() + 1);
        let left = span.left as usize;
        let right = span.right as usize;
        let cells = &mut self.cells.row(span.row)[left..right];
        cells.iter_mut().zip(repeat((self.rule, self.covered)))
    }
    /// None: small triangles are counted span by span, too.
    fn block(&mut self, _: &Window, _: usize, _: usize) -> Option<Infallible> {
        None
    }
    fn block_cells<'a, 'c: 'a>(block: &'a mut Infallible, _: usize, _: usize) -> Self::Cells<'a>
    where
        Self: 'c,
    {
        match *block {}
    }
    fn test((cell, (rule, covered)): Self::Cell<'_>, depth: u32) -> bool {
        covered.set(covered.get() + 1);
        let old = u32::from(*cell);
        let passes = match rule {
            None => return true,
            Some(Nearer::LessOrEqual) => LessOrEqual::passes(depth, old),
            Some(Nearer::LessOrFar) => LessOrFar::passes(depth, old),
        };
        if passes {
            *cell = depth as u16;
        }
        passes
    }
}
