//! The picture that grows, and the view that brings triangles onto it.

use fixel::clip::Planes;
use fixel::depth::{DepthBuffer, FAR, LessOrEqual, NoDepth};
use fixel::draw;
use fixel::fragment::Fragment;
use fixel::num::{Block, Word};
use fixel::span::doubled_area;
use fixel::target::Buffer;
use fixel::view::{Carried, Vertex, View};
use fixel::window::Window;

use crate::emit::drawing::Program;
use crate::emit::log::{Log, Read};
use crate::fixed::dials::Dials;
use crate::fixed::outline::{Outline, Outlined};
use crate::fixed::{FixedPicture, Pixel, shader};

/// Clip planes that a scene may set.
const PLANES: usize = 256;

/// Pixels and depths, and how eye space comes to them.
pub struct Canvas<W> {
    /// Projection and culling. Without clip planes, so that scenes without them do not pay for their room.
    pub view: View<i64, W, 0>,
    /// The same with clip planes, as soon as there are any.
    cut: Option<Box<View<i64, W, PLANES>>>,
    window: Window,
    pixels: Vec<Pixel>,
    depths: Vec<u16>,
    /// How accurately.
    pub dials: Dials,
    /// What is drawn is written down, if somebody wants it.
    pub log: Option<Log>,
}

impl<W: Word> Canvas<W> {
    /// Empty.
    pub fn new(view: View<i64, W, 0>, window: Window) -> Self {
        let size = window.width() * window.height();
        Canvas {
            view,
            cut: None,
            window,
            pixels: vec![Pixel::default(); size],
            depths: vec![FAR; size],
            dials: Dials::default(),
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
        let view = &self.view;
        let cut = self.cut.get_or_insert_with(|| Box::new(with_room(view)));
        cut.planes.push(plane).map_err(|e| format!("{e} ({PLANES})"))
    }

    /// Whether some of the points have w < 0 on the screen and some w > 0.
    pub fn divides_by_both_signs(&self, eye: [Block<i64, 4>; 3]) -> bool {
        let w = eye.map(|p| {
            let [.., w] = self.view.projection.transform(p).mantissas();
            w
        });
        w.iter().any(|&w| w < 0) && w.iter().any(|&w| w > 0)
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

impl<W: Word> shader::Canvas for Canvas<W> {
    type Narrow = Canvas<i32>;

    fn dials(&self) -> Dials {
        self.dials
    }

    fn paint<F, const DEPTH: bool>(
        &mut self,
        eye: [Block<i64, 4>; 3],
        carried: [<F::Varying as Carried>::Vertex; 3],
        fragment: &F,
    ) where
        F: Fragment<Pixel = Pixel, Varying: Carried>,
    {
        let corners = corners(eye, carried);
        let color = Buffer::strip(&mut self.pixels, self.window);
        let depth = Buffer::strip(&mut self.depths, self.window);
        if let (Ok(mut color), Ok(depth)) = (color, depth) {
            let mut depth = DepthBuffer::<_, LessOrEqual>::new(depth);
            // As `draw::primitive`, but that its rows are compiled once for both views.
            let mut polygon = |shape: &dyn Outlined<F::Varying>| {
                let shape = &Outline(shape);
                let area = doubled_area(shape);
                if DEPTH {
                    draw::polygon::<W, _, _, _, _>(&mut color, &mut depth, shape, area, fragment);
                } else {
                    draw::polygon::<W, _, _, _, _>(&mut color, &mut NoDepth, shape, area, fragment);
                }
            };
            if let Some(view) = &mut self.cut {
                follow(view, &self.view);
                view.project::<F::Varying>(&corners, |shape| polygon(shape));
            } else {
                self.view.project::<F::Varying>(&corners, |shape| polygon(shape));
            }
        }
    }

    fn record<V: Carried + Read>(&mut self, eye: [Block<i64, 4>; 3], carried: [V::Vertex; 3]) {
        let Some(log) = &mut self.log else { return };
        let corners = corners(eye, carried);
        if let Some(view) = &mut self.cut {
            follow(view, &self.view);
            view.project::<V>(&corners, |polygon| log.polygon(polygon));
        } else {
            self.view.project::<V>(&corners, |polygon| log.polygon(polygon));
        }
    }
}

fn corners<C>([a, b, c]: [Block<i64, 4>; 3], [u, v, w]: [C; 3]) -> [Vertex<i64, C>; 3] {
    [(a, u), (b, v), (c, w)].map(|(position, carried)| Vertex { position, carried })
}

/// A view with room for clip planes.
fn with_room<W: Word>(view: &View<i64, W, 0>) -> View<i64, W, PLANES> {
    View {
        projection: view.projection,
        planes: Planes::default(),
        viewport: view.viewport,
        depth_range: view.depth_range,
        behind: view.behind,
        cull: view.cull,
    }
}

/// What a scene may have changed since.
fn follow<W: Word>(cut: &mut View<i64, W, PLANES>, view: &View<i64, W, 0>) {
    cut.projection = view.projection;
    cut.cull = view.cull;
}
