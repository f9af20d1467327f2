//! One fragment's way into the framebuffer (10.5): shader, discard, depth test, depth write, blend, colour write.

use super::blend::blend;
use super::framebuffer::Framebuffer;
use super::program::{Colors, Values};
use super::state::State;

/// A draw that is under way.
pub struct Canvas<'a> {
    /// What is drawn into.
    pub framebuffer: &'a mut Framebuffer,
    /// The options.
    pub state: &'a State,
    /// The fragment shader.
    pub shade: &'a dyn Fn([f64; 4], &Values, &mut Colors) -> bool,
}

impl Canvas<'_> {
    /// Columns and rows that may be drawn to: first and last.
    pub fn pixels(&self) -> [[i64; 2]; 2] {
        self.state.viewport.within(self.framebuffer.size())
    }

    /// Shades the fragment of pixel (x, y) and writes what is left of it.
    pub fn fragment(&mut self, [x, y]: [i64; 2], at: [f64; 4], inputs: &Values) {
        let mut colors = Colors::new();
        let kept = (self.shade)(at, inputs, &mut colors);
        if !kept || !self.depth([x, y], at[2]) {
            return;
        }
        for (number, source) in colors {
            // A colour for a buffer that is not there is ignored.
            let Some(buffer) = self.framebuffer.colors.get_mut(&number) else {
                continue;
            };
            let Some(destination) = buffer.get(x, y) else {
                continue;
            };
            let result = self.state.blend.map_or(source, |how| blend(&how, source, destination));
            buffer.set(x, y, result);
        }
    }

    /// The depth test and write; whether the fragment goes on.
    fn depth(&mut self, [x, y]: [i64; 2], z: f64) -> bool {
        let Some(buffer) = &mut self.framebuffer.depth else {
            return true;
        };
        let behind = buffer.get(x, y).is_some_and(|[stored]| z > stored);
        if self.state.depth.test && behind {
            return false;
        }
        if self.state.depth.write {
            buffer.set(x, y, [z]);
        }
        true
    }
}
