//! Inventor scenes drawn by the core.
//!
//! ```text
//! scene -> lamps (lights, materials) -> object (mesh, world space) -> shade (which program) -> the core's draw
//! ```

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{DepthBuffer, FAR, LessOrFar, NoDepth};
use fixel::draw;
use fixel::fragment::Fragment;
use fixel::matrix::Matrix;
use fixel::num::{Block, Word};
use fixel::target::Buffer;
use fixel::view::{Carried, Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;

use crate::emit::drawing::{Drawing, Nearer, Pixels, Program};
use crate::emit::log::{Log, Read};
use crate::fixed::dials::{Dials, Trigonometry};
use crate::fixed::{FixedPicture, Pixel, shader};
use crate::lower;
use crate::scene::Fault;
use crate::scene::iv::{Camera, Scene};

pub(crate) mod lamps;
mod object;
pub(crate) mod shade;
mod words;

pub use words::words;

/// The scene's picture.
///
/// # Errors
/// A fault of the whole scene where its values do not fit the core.
pub fn draw(scene: &Scene) -> Result<FixedPicture, Fault> {
    draw_with(scene, Dials::default())
}

/// The scene's picture with the dials set as given, where edges of 32 bits do.
///
/// # Errors
/// As [`draw()`].
pub fn draw_with(scene: &Scene, dials: Dials) -> Result<FixedPicture, Fault> {
    let window = Window::new(0, 0, scene.width as i32, scene.height as i32);
    if dials.are_exact() {
        return draw_part(scene, window);
    }
    let (picture, _) = logged::<i32>(scene, window, dials, None)?;
    Ok(picture)
}

/// The part `window` of it: what a strip or a tile holds.
///
/// # Errors
/// As [`draw()`].
pub fn draw_part(scene: &Scene, window: Window) -> Result<FixedPicture, Fault> {
    if scene.width.max(scene.height) <= <i32 as Word>::GUARD as u32 {
        with_word::<i32>(scene, window)
    } else {
        with_word::<i64>(scene, window)
    }
}

/// The scene's picture and what it is drawn from.
///
/// # Errors
/// As [`draw()`].
pub fn recorded(scene: &Scene) -> Result<(FixedPicture, Option<Drawing>), Fault> {
    let window = Window::new(0, 0, scene.width as i32, scene.height as i32);
    let wide = scene.width.max(scene.height) > <i32 as Word>::GUARD as u32;
    let log = Log::new(Drawing {
        width: scene.width,
        height: scene.height,
        level: 1,
        wide,
        depth: Some(Nearer::LessOrFar),
        pixels: Pixels::Bytes,
        textures: Vec::new(),
        lights: Vec::new(),
        draws: Vec::new(),
    });
    let (picture, log) = if wide {
        logged::<i64>(scene, window, Dials::default(), Some(log))?
    } else {
        logged::<i32>(scene, window, Dials::default(), Some(log))?
    };
    Ok((picture, log.map(Log::finish)))
}

/// With a certain word for the edges.
///
/// # Errors
/// As [`draw()`], and where the picture does not fit the word.
pub fn with_word<W: Word>(scene: &Scene, window: Window) -> Result<FixedPicture, Fault> {
    let (picture, _) = logged::<W>(scene, window, Dials::default(), None)?;
    Ok(picture)
}

fn logged<W: Word>(
    scene: &Scene,
    window: Window,
    dials: Dials,
    log: Option<Log>,
) -> Result<(FixedPicture, Option<Log>), Fault> {
    let size = window.width() * window.height();
    let mut canvas = Canvas {
        view: view::<W>(scene, dials.trigonometry).map_err(Fault::of_whole)?,
        window,
        pixels: vec![Pixel::default(); size],
        depths: vec![FAR; size],
        primitives: 0,
        dials,
        log,
    };
    for object in &scene.model.objects {
        object::draw(&mut canvas, scene, object).map_err(Fault::of_whole)?;
    }
    let picture = FixedPicture {
        width: window.width() as u32,
        height: window.height() as u32,
        pixels: canvas.pixels,
        depth: canvas.depths,
    };
    Ok((picture, canvas.log))
}

fn view<W: Word>(scene: &Scene, trigonometry: Trigonometry) -> Result<View<i64, W, 0>, String> {
    let side = |pixels: u32| u16::try_from(pixels).map_err(|e| e.to_string());
    let viewport = Viewport::<W>::new(0, 0, side(scene.width)?, side(scene.height)?).map_err(|e| e.to_string())?;
    Ok(View {
        projection: to_clip(&scene.model.camera, trigonometry)?,
        planes: Planes::default(),
        viewport: viewport.y_up().samples_at_centers(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Clockwise,
    })
}

/// World space to clip space.
fn to_clip(camera: &Camera, trigonometry: Trigonometry) -> Result<Matrix<i64>, String> {
    let window = [
        camera.left,
        camera.right,
        camera.bottom,
        camera.top,
        camera.near,
        camera.far,
    ];
    let projection = Matrix::frustum(window.map(|v| lower::block([v]))).map_err(|e| e.to_string())?;
    let turn = &camera.orientation;
    let position = lower::block(camera.position);
    let to_eye = trigonometry.camera(position, lower::block(turn.axis), lower::radians(turn.angle)?);
    Ok(projection.product(&to_eye.map_err(|e| e.to_string())?))
}

/// The picture that grows, and the view that brings triangles onto it.
struct Canvas<W> {
    view: View<i64, W, 0>,
    window: Window,
    pixels: Vec<Pixel>,
    depths: Vec<u16>,
    /// Triangles so far.
    primitives: u32,
    /// How accurately.
    dials: Dials,
    /// What is drawn is written down, if somebody wants it.
    log: Option<Log>,
}

impl<W: Word> Canvas<W> {
    /// Tells the log what colours the triangles from now on.
    fn describe(&mut self, program: impl FnOnce(&mut Log) -> Program) {
        if let Some(log) = &mut self.log {
            let program = program(log);
            log.program(program);
        }
    }
}

impl<W: Word> shader::Canvas for Canvas<W> {
    type Narrow = Canvas<i32>;

    fn dials(&self) -> Dials {
        self.dials
    }

    fn paint<F, const DEPTH: bool>(
        &mut self,
        world: [Block<i64, 4>; 3],
        carried: [<F::Varying as Carried>::Vertex; 3],
        fragment: &F,
    ) where
        F: Fragment<Pixel = Pixel, Varying: Carried>,
    {
        let color = Buffer::strip(&mut self.pixels, self.window);
        let depth = Buffer::strip(&mut self.depths, self.window);
        if let (Ok(mut color), Ok(depth)) = (color, depth) {
            let mut depth = DepthBuffer::<_, LessOrFar>::new(depth);
            let corners = corners(world, carried);
            if DEPTH {
                draw::primitive(&self.view, &mut color, &mut depth, &corners, fragment);
            } else {
                draw::primitive(&self.view, &mut color, &mut NoDepth, &corners, fragment);
            }
        }
    }

    fn record<V: Carried + Read>(&mut self, world: [Block<i64, 4>; 3], carried: [V::Vertex; 3]) {
        if let Some(log) = &mut self.log {
            let corners = corners(world, carried);
            self.view.project::<V>(&corners, |polygon| log.polygon(polygon));
        }
    }
}

fn corners<C>([a, b, c]: [Block<i64, 4>; 3], [u, v, w]: [C; 3]) -> [Vertex<i64, C>; 3] {
    [(a, u), (b, v), (c, w)].map(|(position, carried)| Vertex { position, carried })
}
