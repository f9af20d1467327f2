//! The picture that grows, and the view that brings triangles onto it.

use fixel::clip::Planes;
use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::draw;
use fixel::fragment::Fragment;
use fixel::num::{Block, Word};
use fixel::target::Buffer;
use fixel::view::{Carried, Vertex, View};
use fixel::window::Window;

use crate::emit::drawing::Program;
use crate::emit::log::{Log, Read};
use crate::fixed::{FixedPicture, Pixel};

/// Clip planes that a scene may set.
const PLANES: usize = 256;

/// Pixels and depths, and how eye space comes to them.
pub struct Canvas<W> {
    /// Projection and culling. Without clip planes, so that scenes without them do not pay for their room.
    pub view: View<i64, W, 0>,
    planes: Planes<i64, PLANES>,
    has_planes: bool,
    window: Window,
    pixels: Vec<Pixel>,
    depths: Vec<u16>,
    /// What is drawn is written down, if somebody wants it.
    pub log: Option<Log>,
}

impl<W: Word> Canvas<W> {
    /// Empty.
    pub fn new(view: View<i64, W, 0>, window: Window) -> Self {
        let size = window.width() * window.height();
        Canvas {
            view,
            planes: Planes::default(),
            has_planes: false,
            window,
            pixels: vec![Pixel::default(); size],
            depths: vec![FAR; size],
            log: None,
        }
    }

    /// Tells the log what colours the triangles from now on.
    pub fn describe(&mut self, program: impl FnOnce(&mut Log) -> Program) {
        if let Some(log) = &mut self.log {
            let program = program(log);
            log.program(program);
        }
    }

    /// One clip plane more, in eye space.
    ///
    /// # Errors
    /// Where there is no room for it.
    pub fn clip(&mut self, plane: Block<i64, 4>) -> Result<(), String> {
        self.has_planes = true;
        self.planes.push(plane).map_err(|e| format!("{e} ({PLANES})"))
    }

    /// Whether some of the points have w < 0 on the screen and some w > 0.
    pub fn divides_by_both_signs(&self, eye: [Block<i64, 4>; 3]) -> bool {
        let w = eye.map(|p| {
            let [.., w] = self.view.projection.transform(p).mantissas();
            w
        });
        w.iter().any(|&w| w < 0) && w.iter().any(|&w| w > 0)
    }

    /// Draws one triangle, given in eye space.
    pub fn draw<F>(&mut self, eye: [Block<i64, 4>; 3], carried: [<F::Varying as Carried>::Vertex; 3], fragment: &F)
    where
        F: Fragment<Pixel = Pixel, Varying: Carried + Read>,
    {
        let ([a, b, c], [u, v, w]) = (eye, carried);
        let corners = [(a, u), (b, v), (c, w)].map(|(position, carried)| Vertex { position, carried });
        let color = Buffer::strip(&mut self.pixels, self.window);
        let depth = Buffer::strip(&mut self.depths, self.window);
        if let (Ok(mut color), Ok(depth)) = (color, depth) {
            let mut depth = DepthBuffer::<_, LessOrEqual>::new(depth);
            if self.has_planes {
                let view = with_planes(&self.view, self.planes.clone());
                draw::primitive(&view, &mut color, &mut depth, &corners, fragment);
                if let Some(log) = &mut self.log {
                    view.project::<F::Varying>(&corners, |polygon| log.polygon(polygon));
                }
            } else {
                draw::primitive(&self.view, &mut color, &mut depth, &corners, fragment);
                if let Some(log) = &mut self.log {
                    self.view
                        .project::<F::Varying>(&corners, |polygon| log.polygon(polygon));
                }
            }
        }
    }

    /// What was drawn, and what was written down.
    pub fn finish(self) -> (FixedPicture, Option<Log>) {
        let picture = FixedPicture {
            width: self.window.width() as u32,
            height: self.window.height() as u32,
            pixels: self.pixels,
            depth: self.depths,
        };
        (picture, self.log)
    }
}

fn with_planes<W: Word>(view: &View<i64, W, 0>, planes: Planes<i64, PLANES>) -> View<i64, W, PLANES> {
    View {
        projection: view.projection,
        planes,
        viewport: view.viewport,
        depth_range: view.depth_range,
        behind: view.behind,
        cull: view.cull,
    }
}
