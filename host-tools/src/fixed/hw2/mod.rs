//! HW2 scenes drawn by the core.
//!
//! ```text
//! scene (matrices, lights, switches) -> corner (eye space) -> shade (which program) -> canvas (the core's draw)
//!                      patch ----------^                       material (programs)
//! ```

use std::sync::Arc;

use fixel::num::Word;
use fixel::viewport::Viewport;
use fixel::window::Window;

use crate::backend::{BackEnd, Patch, Surface, Vertex};
use crate::emit::drawing::{Drawing, Nearer, Pixels};
use crate::emit::log::Log;
use crate::fixed::FixedPicture;
use crate::fixed::dials::Dials;
use crate::picture::Picture;

mod canvas;
mod corner;
pub(crate) mod lamps;
pub(crate) mod material;
mod patch;
mod scene;
mod shade;

/// Renders with the core: 64-bit words for vertices, and for edges the word that the picture needs.
pub struct Fixed(Box<dyn Renderer>);

/// A back end with a picture at the end.
trait Renderer: BackEnd {
    /// From now on what is drawn is written down.
    fn record(&mut self, log: Log);
    /// The dials are set so, before anything is drawn or lit.
    fn set(&mut self, dials: Dials);
    fn finish(self: Box<Self>) -> (FixedPicture, Option<Log>);
}

impl Fixed {
    /// An empty picture of `width` × `height` pixels, at most 16384 a side.
    ///
    /// # Panics
    /// Beyond 32768 pixels a side, which the scene's parser has excluded.
    pub fn new(width: u32, height: u32) -> Self {
        Self::part(width, height, Window::new(0, 0, width as i32, height as i32))
    }

    /// The part `window` of such a picture: what a strip or a tile of it holds.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn part(width: u32, height: u32, window: Window) -> Self {
        let fits = |size: u32| size <= <i32 as Word>::GUARD as u32;
        if fits(width) && fits(height) {
            Self::with_word::<i32>(width, height, window)
        } else {
            Self::with_word::<i64>(width, height, window)
        }
    }

    /// With a certain word for the edges.
    ///
    /// # Panics
    /// Where the picture does not fit the word.
    pub fn with_word<W: Word>(width: u32, height: u32, window: Window) -> Self {
        let size = |v: u32| u16::try_from(v).expect("a scene's picture has at most 16384 pixels a side");
        let viewport = Viewport::<W>::new(0, 0, size(width), size(height)).expect("the word was chosen by the size");
        Fixed(Box::new(scene::Scene::new(viewport, window)))
    }

    /// With the dials set so, before the first command. Beyond [`dials::LARGEST`](crate::fixed::dials::LARGEST) pixels a side, where edges are wider,
    /// that of perspective stays exact.
    pub fn with(mut self, dials: Dials) -> Self {
        self.0.set(dials);
        self
    }

    /// What was drawn.
    pub fn finish(self) -> FixedPicture {
        self.0.finish().0
    }

    /// As [`new`](Self::new), with a log.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn recorded(width: u32, height: u32) -> Self {
        let mut fixed = Self::new(width, height);
        fixed.0.record(Log::new(Drawing {
            width,
            height,
            level: 1,
            wide: width.max(height) > <i32 as Word>::GUARD as u32,
            depth: Some(Nearer::LessOrEqual),
            pixels: Pixels::Bytes,
            textures: Vec::new(),
            lights: Vec::new(),
            draws: Vec::new(),
        }));
        fixed
    }

    /// What was drawn, and what a log says about it.
    pub fn finish_recorded(self) -> (FixedPicture, Option<Drawing>) {
        let (picture, log) = self.0.finish();
        (picture, log.map(Log::finish))
    }
}

impl BackEnd for Fixed {
    fn load_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.0.load_mv(m)
    }
    fn mult_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.0.mult_mv(m)
    }
    fn load_p(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.0.load_p(m)
    }
    fn translate(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.0.translate(by)
    }
    fn rotate(&mut self, degrees: f64, axis: [f64; 3]) -> Result<(), String> {
        self.0.rotate(degrees, axis)
    }
    fn scale(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.0.scale(by)
    }
    fn look_at(&mut self, eye: [f64; 4], center: [f64; 4], up: [f64; 3]) -> Result<(), String> {
        self.0.look_at(eye, center, up)
    }
    fn frustum(&mut self, planes: [f64; 6]) -> Result<(), String> {
        self.0.frustum(planes)
    }
    fn ortho(&mut self, planes: [f64; 6]) -> Result<(), String> {
        self.0.ortho(planes)
    }
    fn clip_plane(&mut self, plane: [f64; 4]) -> Result<(), String> {
        self.0.clip_plane(plane)
    }
    fn cull(&mut self) {
        self.0.cull();
    }
    fn decals(&mut self) {
        self.0.decals();
    }
    fn flat_normals(&mut self) {
        self.0.flat_normals();
    }
    fn texture(&mut self, texture: &Arc<Picture>) -> Result<(), String> {
        self.0.texture(texture)
    }
    fn sun(&mut self, direction: [f64; 3], color: [f64; 3]) -> Result<(), String> {
        self.0.sun(direction, color)
    }
    fn bulb(&mut self, position: [f64; 4], color: [f64; 3]) -> Result<(), String> {
        self.0.bulb(position, color)
    }
    fn shininess(&mut self, exponent: f64) -> Result<(), String> {
        self.0.shininess(exponent)
    }
    fn triangle(&mut self, primitive: u32, corners: [Vertex; 3], surface: Surface) -> Result<(), String> {
        self.0.triangle(primitive, corners, surface)
    }
    fn patch(&mut self, first: u32, level: u32, patch: Patch<'_>, surface: Surface) -> Result<(), String> {
        self.0.patch(first, level, patch, surface)
    }
}
