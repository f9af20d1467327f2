//! What is interpolated over a triangle, and its pixels: span by span, or rows at once where the targets have blocks.

use core::hint::black_box;
use core::mem;

use crate::depth::Depth;
use crate::fragment::Fragment;
use crate::gradient::Ramp;
use crate::screen::{Shape, of_corners};
use crate::slope::{Slope, Slopes, Weights};
use crate::span::Span;
use crate::target::Target;
use crate::varying::Varying;
use crate::window::Window;

/// All that is interpolated over a triangle, or a piece of its spans.
pub(crate) struct Inside<V: Varying> {
    /// At the place that all count from, with the half that rounds to the nearest step: modulo 2^32, where it was 0…65535 steps.
    pub(crate) depth: Slope,
    pub(crate) slopes: V::Slopes,
}

impl<V: Varying> Inside<V> {
    /// Becomes what `shape` carries; none where its varying has no use for weights. In place: returned, it would be copied.
    #[inline(never)]
    pub(super) fn lay<D: Depth, S: Shape<Varying = V>>(inside: &mut Option<Self>, weights: &Weights, shape: &S) {
        let mut depth = Slope::default();
        if D::ENABLED {
            depth = weights.slope(of_corners(|i| shape.depth(i)));
            depth.value = depth.value.wrapping_add(1 << 14);
            // Nothing of the others is loaded before that is done, as if there were registers for all.
            black_box(());
        }
        let slopes = V::Slopes::new(weights, of_corners(|i| shape.varying(i)));
        *inside = slopes.map(|slopes| Inside { depth, slopes });
    }

    /// One span: what is hidden at its start costs the comparison and one addition for each pixel, and nothing else is looked
    /// at before the first visible one. How many pixels are left from a hidden one on that comes
    /// behind a visible one, or first where a [`Depth`] of one's own skips none; that one is done with.
    #[inline(always)]
    pub(super) fn span<C, D, F>(&self, color: &mut C, depth: &mut D, span: &Span, fragment: &F) -> usize
    where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let Span { row, left, right, .. } = *span;
        if V::Slopes::DRAWS || !D::ENABLED {
            let pixels = color.span(row, left, right);
            if pixels.is_empty() || !D::ENABLED && fragment.fill(pixels) {
                return 0;
            }
            if !V::Slopes::DRAWS {
                self.shade(pixels, (left, row), fragment);
            } else if D::ENABLED {
                self.draw_visible::<D, F>(span, pixels, depth.cells(span), fragment);
            } else {
                self.slopes.draw(span, pixels, fragment);
            }
            return 0;
        }
        let Ramp { value, step } = self.depth.ramp((left, row));
        let Some((cells, fine)) = D::skip(depth.cells(span), value as u32, step as u32) else {
            return 0;
        };
        let column = right.wrapping_sub(cells.size_hint().0 as i32);
        let pixels = color.span(row, column, right);
        self.shade_visible::<D, F>(pixels, cells, fine, (column, row), fragment)
    }

    /// Spans of `columns` from row `top` on; whether the targets have blocks.
    #[inline(never)]
    pub(super) fn draw_rows<C, D, F>(
        &self,
        color: &mut C,
        depth: &mut D,
        top: i32,
        columns: &[(i32, i32)],
        window: &Window,
        fragment: &F,
    ) -> bool
    where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let whole = color.window();
        let Some((block, stride)) = color.block() else {
            return false;
        };
        let Some(mut cells) = depth.block(&whole, stride, block.len()) else {
            return false;
        };
        let mut start = (top.wrapping_sub(whole.top) as u32 as usize).wrapping_mul(stride);
        for (row, &columns) in (top..).zip(columns) {
            let span = Span::new(row, columns, window);
            if span.left < span.right {
                let first = start.wrapping_add(span.left.wrapping_sub(window.left) as u32 as usize);
                let count = span.right.wrapping_sub(span.left) as u32 as usize;
                if let Some(pixels) = block.get_mut(first..).and_then(|rest| rest.get_mut(..count)) {
                    self.draw_runs::<D, F>(&span, pixels, D::block_cells(&mut cells, first, count), fragment);
                }
            }
            start = start.wrapping_add(stride);
        }
        true
    }

    /// As [`draw_runs`](Self::draw_runs), in a function of its own for targets without blocks.
    #[cold]
    #[inline(never)]
    fn draw_visible<D, F>(&self, span: &Span, pixels: &mut [F::Pixel], cells: D::Cells<'_>, fragment: &F)
    where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        self.draw_runs::<D, F>(span, pixels, cells, fragment);
    }

    /// The visible runs of a span, each after its depths: most spans are one.
    #[inline(always)]
    fn draw_runs<D, F>(&self, span: &Span, pixels: &mut [F::Pixel], cells: D::Cells<'_>, fragment: &F)
    where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        let Ramp { value, step } = self.depth.ramp((span.left, span.row));
        let (fine, step) = (value as u32, step as u32);
        let (passed, others, next) = D::pass(cells, fine, step);
        if passed == pixels.len() {
            self.slopes.draw(span, pixels, fragment);
        } else {
            self.draw_others::<D, F>(span, pixels, passed, (others, next), fragment);
        }
    }

    /// As [`draw_runs`](Self::draw_runs), of a span with hidden pixels: `passed` is how many are visible at its front, what is
    /// left behind them is to be looked at.
    #[inline(never)]
    fn draw_others<D, F>(
        &self,
        span: &Span,
        pixels: &mut [F::Pixel],
        passed: usize,
        left: (D::Cells<'_>, u32),
        fragment: &F,
    ) where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        let step = self.depth.x as u32;
        let (mut passed, (mut others, mut next)) = (passed, left);
        let mut run = *span;
        let mut rest = pixels;
        loop {
            let Some((visible, hidden)) = mem::take(&mut rest).split_at_mut_checked(passed) else {
                return;
            };
            if !visible.is_empty() {
                self.slopes.draw(&run, visible, fragment);
            }
            if hidden.is_empty() {
                return;
            }
            let Some((cells, fine)) = D::skip(others, next, step) else {
                return;
            };
            let skipped = hidden.len().wrapping_sub(cells.size_hint().0);
            run.left = run.left.wrapping_add(passed.wrapping_add(skipped) as i32);
            rest = hidden.get_mut(skipped..).unwrap_or_default();
            (passed, others, next) = D::pass(cells, fine, step);
        }
    }

    /// What is left of a span where something hides a pixel behind a visible one: pixel by pixel. `place` is where it begins.
    #[cold]
    #[inline(never)]
    pub(crate) fn shade_others<C, D, F>(
        &self,
        color: &mut C,
        depth: &mut D,
        span: &Span,
        place: (i32, i32),
        fragment: &F,
    ) where
        C: Target,
        D: Depth,
        F: Fragment<Pixel = C::Pixel, Varying = V>,
    {
        let Span { row, left, right, .. } = *span;
        let mut ramps = self.slopes.ramps(place);
        let Ramp { value, step } = self.depth.ramp(place);
        let mut fine = value as u32;
        for (pixel, cell) in color.span(row, left, right).iter_mut().zip(depth.cells(span)) {
            black_box(());
            if D::test(cell, fine >> 15) {
                self.shade_one(pixel, &ramps, fragment);
            }
            fine = fine.wrapping_add(step as u32);
            V::advance(&mut ramps);
        }
    }

    /// All of `pixels`.
    #[inline(never)]
    fn shade<F>(&self, pixels: &mut [F::Pixel], place: (i32, i32), fragment: &F)
    where
        F: Fragment<Varying = V>,
    {
        let mut ramps = self.slopes.ramps(place);
        for pixel in pixels {
            self.shade_one(pixel, &ramps, fragment);
            V::advance(&mut ramps);
        }
    }

    /// `pixels` from the first on, at depth `fine`, up to the first that is hidden, which `cells` tell; how many are left
    /// from that one on.
    ///
    /// A function of its own: inlined, the rows' state takes its registers. On Cortex-M4 an RGB565 pixel of interpolated colour
    /// costs 15 instructions here (`cargo xtask measure`), as by hand, on ARMv6-M, which keeps five of its words in memory, 27.
    #[inline(never)]
    fn shade_visible<D, F>(
        &self,
        pixels: &mut [F::Pixel],
        cells: D::Cells<'_>,
        fine: u32,
        place: (i32, i32),
        fragment: &F,
    ) -> usize
    where
        D: Depth,
        F: Fragment<Varying = V>,
    {
        let mut ramps = self.slopes.ramps(place);
        // With the half all values lie in 0…65536 steps, so that the sum fits 32 bits.
        D::pass_first(cells, pixels, fine, self.depth.x as u32, |pixel| {
            self.shade_one(pixel, &ramps, fragment);
            V::advance(&mut ramps);
        })
    }

    #[inline(always)]
    fn shade_one<F: Fragment<Varying = V>>(&self, pixel: &mut F::Pixel, ramps: &V::Ramps, fragment: &F) {
        if let Some(new) = fragment.shade(self.slopes.values(ramps), *pixel) {
            *pixel = new;
        }
    }
}
