//! Vertices as models store them: the projection in the form that costs least for each.

use super::ready::Placed;
use super::{ScreenVertex, View};
use crate::matrix::Matrix;
use crate::num::product::LONG_SUM;
use crate::num::{Block, Word};
use crate::viewport::DepthScale;

/// A view that projects positions of 16 bits; made once per draw by [`View::stored`].
///
/// Clip coordinates have one scale for the draw instead of one each, so that nothing has to be found out about a vertex before
/// it is divided, and a position takes twelve products. What lies in the view volume costs about 120 instructions on Cortex-M4,
/// and the light of a [`Sunlight`](crate::light::Sunlight) 30, in a loop of its own: one loop for both would need more registers
/// than there are. What does not lie there goes the way of [`View::vertex`].
///
/// **Error**: with B the largest that a clip coordinate of any stored position could be, which is that of a corner of the box
/// of ±1, each is within 2^-26·B of what [`View::stored_vertex`] has. A vertex near w comes to lie within 2^-25·B/w half-sizes of
/// the viewport; where w is a hundredth of B, and the picture 320 pixels wide, that is 1/2000 px.
///
/// ```
/// use fixel::{clip::{Behind, DepthRange, Planes}, matrix::Matrix, num::{Block, Scaled}};
/// use fixel::{depth::NoDepth, draw, fragment::Flat, target::Buffer, view::{Cull, View}, viewport::Viewport};
///
/// static POSITIONS: [[i16; 3]; 3] = [[-32768, -32768, 0], [32767, -32768, 0], [-32768, 32767, 0]];
///
/// // 2 away from the camera.
/// let camera = Matrix::frustum([-1, 1, -1, 1, 1, 10].map(Scaled::from_integer))?;
/// let view = View::<i32, i32, 0> {
///     projection: camera.product(&Matrix::translation(Block::from_integers([0, 0, -2]))),
///     planes: Planes::default(),
///     viewport: Viewport::new(0, 0, 8, 4)?.y_up().samples_at_centers(),
///     depth_range: DepthRange::MinusOneToOne,
///     behind: Behind::Cut,
///     cull: Cull::Clockwise,
/// };
/// let stored = view.stored();
/// let vertices = POSITIONS.map(|position| stored.vertex(position, ()));
/// let mut picture = [b'.'; 8 * 4];
/// draw::indexed(&view, &mut Buffer::new(&mut picture, 8, 4)?, &mut NoDepth, &vertices, [[0, 1, 2u16]], &Flat(b'#'));
/// let rows: Vec<_> = picture.chunks(8).map(|row| str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, ["........", "..#.....", "..###...", "........"]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct StoredView<'v, W> {
    view: &'v View<i32, W, 0>,
    rows: [Row<LONG_SUM>; 4],
    exponent: i32,
    depth: DepthScale,
    /// Whether the view volume lies within the guard band.
    in_guard: bool,
}

impl<W: Word> View<i32, W, 0> {
    /// This view for positions as they are stored, in units of 2^-15.
    pub fn stored(&self) -> StoredView<'_, W> {
        let (rows, exponent) = rows(&self.projection);
        StoredView {
            view: self,
            rows,
            exponent,
            depth: DepthScale::new(self.depth_range),
            in_guard: self.viewport.is_in_guard(),
        }
    }
}

impl<W: Word> StoredView<'_, W> {
    /// Projects a vertex, for triangles of the view that this was made of.
    #[inline(always)]
    pub fn vertex<A>(&self, position: [i16; 3], carried: A) -> ScreenVertex<i32, A> {
        let [x, y, z, w] = &self.rows;
        let clip = [x.at(position), y.at(position), z.at(position), w.at(position)];
        let [x, y, z, w] = clip;
        let (place, outcode) = if self.in_guard && self.depth.is_in_volume(clip) {
            (self.view.viewport.place_in_volume(clip, self.depth), 0)
        } else {
            self.beside(x, y, z, w)
        };
        Placed {
            clip: Block::raw(clip, self.exponent),
            place,
            outcode,
        }
        .with(carried)
    }

    /// A vertex that is clipped, or at least not seen.
    #[cold]
    #[inline(never)]
    fn beside(&self, x: i32, y: i32, z: i32, w: i32) -> ((i32, i32, i32), u8) {
        let placed = Placed::new(self.view, Block::new([x, y, z, w], self.exponent));
        (placed.place, placed.outcode)
    }
}

/// The rows of a projection in units of 2^exponent, the least for which no coordinate of a stored position reaches 2^29.
fn rows<const LONG_SUM: bool>(projection: &Matrix<i32>) -> ([Row<LONG_SUM>; 4], i32) {
    let largest = |row: [i32; 4]| row.iter().fold(0u32, |sum, m| sum.saturating_add(m.unsigned_abs()));
    let rows = projection.rows();
    let most = rows.into_iter().map(largest).fold(0, u32::max);
    // Rounding adds a unit to each of four at most.
    let shift = (most.saturating_add(4 << 3))
        .checked_ilog2()
        .unwrap_or(0)
        .saturating_sub(28);
    let rounded = |m: i32| ((m as i64 + (1 << shift >> 1)) >> shift) as i32;
    (
        rows.map(|row| Row::new(row.map(rounded))),
        projection.entries().exponent().saturating_add(shift as i32),
    )
}

/// A row of a matrix, the sum of whose magnitudes is below 2^29.
#[derive(Debug, Clone, Copy)]
struct Row<const LONG_SUM: bool> {
    /// Where products of 64 bits are added up, twice the factors of x, y and z. Else their upper 15 bits, and the lower 14.
    upper: [i32; 3],
    lower: [i32; 3],
    last: i32,
}

impl<const LONG_SUM: bool> Row<LONG_SUM> {
    fn new([x, y, z, last]: [i32; 4]) -> Self {
        let factors = [x, y, z];
        let (upper, lower) = if LONG_SUM {
            (factors.map(|m| m << 1), [0; 3])
        } else {
            (factors.map(|m| m >> 14), factors.map(|m| m & 0x3fff))
        };
        Row { upper, lower, last }
    }

    /// At (x, y, z, 1), x, y and z in units of 2^-15, rounded down.
    #[inline(always)]
    fn at(&self, position: [i16; 3]) -> i32 {
        let [a, b, c] = self.upper;
        let [x, y, z] = position.map(i32::from);
        if LONG_SUM {
            // Twice the factor and 2^16 times the coordinate: the upper half is in the row's units.
            let product = |m: i32, v: i32| m as i64 * (v << 16) as i64;
            let sum = ((self.last as i64) << 32) + product(a, x) + product(b, y) + product(c, z);
            return (sum >> 32) as i32;
        }
        // The upper parts' magnitudes add up to 2^15 and 3 at most, the lower ones are below 2^14: below 2^30 + 2^17 and 2^31.
        let [d, e, f] = self.lower;
        let upper = (a * x).wrapping_add(b * y).wrapping_add(c * z);
        let lower = (d * x).wrapping_add(e * y).wrapping_add(f * z);
        self.last + ((upper + (lower >> 14)) >> 1)
    }
}

#[cfg(test)]
mod tests {
    use super::Row;

    #[test]
    fn short_sums_are_the_long_ones() {
        let mut state = 1u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state as i32 >> 2
        };
        let ends = [i16::MIN, -32767, -1, 0, 1, i16::MAX];
        for case in 0..20_000 {
            // Rows whose sum is just below 2^29 now and then, in one entry or in all.
            let mut row = core::array::from_fn::<i32, 4, _>(|_| next() >> 3);
            if case % 4 == 0 {
                let rest = (1 << 29) - 1 - row.iter().skip(1).map(|m| m.abs()).sum::<i32>();
                row[0] = if case % 8 == 0 { rest } else { -rest };
            }
            let pick = |n: i32| ends.get((n & 7) as usize).copied().unwrap_or((n >> 8) as i16);
            let position = core::array::from_fn(|_| pick(next()));
            let exact = [0, 1, 2]
                .map(|i| row[i] as i64 * position[i] as i64)
                .iter()
                .sum::<i64>();
            let expected = (row[3] as i64 + (exact >> 15)) as i32;
            assert_eq!(Row::<true>::new(row).at(position), expected);
            assert_eq!(Row::<false>::new(row).at(position), expected);
        }
    }
}
