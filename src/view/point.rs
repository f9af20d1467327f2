//! Points through a view: the centers of squares and discs.

use crate::clip::{Behind, DepthRange};
use crate::num::{Block, Wide, Word};
use crate::screen::{Center, FineDepth, SubPx};

use super::View;

impl<T: Word, W: Word, const N: usize> View<T, W, N> {
    /// Where a point in eye space lies on the screen, rounded once to the nearest subpixel (a tie upwards), and how deep.
    ///
    /// `None` where it is outside a user plane or the depth range, both decided exactly, where w = 0, and where w < 0 is
    /// [cut](Behind::Cut). The guard band does not count: a position beyond ±2^23 px, less 1/15 px, is moved there, which is so far out
    /// that no square or disc around it reaches a picture.
    ///
    /// ```
    /// use fixel::{clip::{Behind, DepthRange, Planes}, matrix::Matrix, num::Block, view::{Cull, View}, viewport::Viewport};
    /// let view = View::<i32, i32, 0> {
    ///     projection: Matrix::identity(),
    ///     planes: Planes::default(),
    ///     viewport: Viewport::new(0, 0, 320, 240)?,
    ///     depth_range: DepthRange::MinusOneToOne,
    ///     behind: Behind::Divide,
    ///     cull: Cull::Nothing,
    /// };
    /// let center = view.project_point(Block::from_integers([1, 0, 0, -2])).unwrap();
    /// assert_eq!((center.x.to_num::<i32>(), center.y.to_num::<i32>()), (80, 120));
    /// assert_eq!(view.project_point(Block::from_integers([1, 0, 3, 2])), None);
    /// # Ok::<(), fixel::error::Error>(())
    /// ```
    pub fn project_point(&self, position: Block<T, 4>) -> Option<Center> {
        if !self.planes.hold(position) {
            return None;
        }
        let mut position = self.projection.transform(position);
        let [.., w] = position.mantissas();
        if w < T::ZERO && self.behind == Behind::Divide {
            position = position.negated();
        }
        let [_, _, z, w] = position.mantissas().map(T::widen);
        let zero = T::Wide::ZERO;
        let in_range = match self.depth_range {
            DepthRange::ZeroToOne => z >= zero && z <= w,
            DepthRange::MinusOneToOne => z + w >= zero && z <= w,
            DepthRange::Unlimited => true,
        };
        if !in_range {
            return None;
        }
        let (x, y, depth) = self.viewport.place_anywhere(position, self.depth_range)?;
        Some(Center {
            x: SubPx::from_bits(x),
            y: SubPx::from_bits(y),
            depth: FineDepth::from_bits(depth as u32),
        })
    }
}
