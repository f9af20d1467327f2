//! A picture without blocks.

use fixel::target::{Buffer, Target};
use fixel::window::Window;

/// A picture that lends its rows, but no block of them.
pub struct RowByRow<'a>(pub Buffer<'a, u16>);

impl Target for RowByRow<'_> {
    type Pixel = u16;

    fn window(&self) -> Window {
        self.0.window()
    }
    fn row(&mut self, row: i32) -> &mut [u16] {
        self.0.row(row)
    }
}
