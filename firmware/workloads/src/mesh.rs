//! W5: a mesh from its stored vertices to the picture, every frame anew.
//!
//! ```text
//! mesh     = vertices: u32 · triangles: u32 · { x, y, z: i16 (2^-15) } · { normal: 3 × i16 (2^-15) } · { 3 × index: u16 }
//!            · half-size: matrix · model/view: matrix · projection: matrix · towards the light, in eye space: 3 × i32
//! matrix   = 16 × i32, row by row · exponent: i32
//! ```
//!
//! All little-endian.

mod strips;

use core::hint::black_box;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::draw::indexed;
use fixel::error::Error;
use fixel::fragment::Gouraud565;
use fixel::light::Sunlight;
use fixel::matrix::{Directions, Matrix};
use fixel::num::Block;
use fixel::view::{Cull, ScreenVertex, View};
use fixel::viewport::Viewport;
use heapless::Vec;

use crate::bytes::section;
use crate::frame::{Frame, HEIGHT, WIDTH};
use crate::machine::{Line, Machine};

/// Vertices that there is room for.
const VERTICES: usize = 2_903;
/// Triangles that there is room for.
const TRIANGLES: usize = 5_804;

/// Levels of RGB565 without the light, in units of 2^-16, with the half that makes cutting off round.
const AMBIENT: [i32; 3] = [(6 << 16) + 0x8000, (12 << 16) + 0x8000, (6 << 16) + 0x8000];
/// What the light adds at most.
const DIFFUSE: [i32; 3] = [25 << 16, 51 << 16, 25 << 16];

/// A vertex on the screen with its colour.
pub type Lit = ScreenVertex<i32, [i32; 3]>;

/// What a firmware has in flash, but for the matrices, which change with every frame.
pub struct Scene {
    points: Vec<[i16; 3], VERTICES>,
    normals: Vec<[i16; 3], VERTICES>,
    triangles: Vec<[u16; 3], TRIANGLES>,
    size: Matrix<i32>,
    model_view: Matrix<i32>,
    projection: Matrix<i32>,
    light: [i32; 3],
}

/// Draws the mesh of `file`, if there is one with room here.
pub fn run(machine: &mut impl Machine, frame: &mut Frame, file: &[u8]) {
    let Some(scene) = section(file, "W5").and_then(Scene::read) else {
        return;
    };
    let mut vertices = [Lit::empty([0; 3]); VERTICES];
    frame.clear();
    let scene = black_box(&scene);
    let mut drawn = Ok(());
    let instructions = machine.count(|| drawn = draw(black_box(&mut *frame), scene, &mut vertices));
    if drawn.is_err() {
        return;
    }
    let (color, depth) = frame.checksums();
    machine.report(&Line {
        name: "W5",
        instructions,
        units: 1,
        color,
        depth,
    });
    strips::run(machine, frame, scene, &mut vertices);
}

/// The measured region: matrices, light, vertices, triangles.
///
/// # Errors
/// None but for a light without a direction or a matrix without an inverse.
#[inline(never)]
pub fn draw(frame: &mut Frame, scene: &Scene, vertices: &mut [Lit]) -> Result<(), Error> {
    let view = place(scene, vertices)?;
    let (mut color, mut depth) = frame.with_depth()?;
    indexed(
        &view,
        &mut color,
        &mut depth,
        vertices,
        scene.triangles.iter().copied(),
        &Gouraud565,
    );
    Ok(())
}

/// Matrices, light, vertices.
#[inline(always)]
fn place(scene: &Scene, vertices: &mut [Lit]) -> Result<View<i32, i32, 0>, Error> {
    let mut directions = Directions::identity();
    directions.load(&scene.model_view);
    let light = Sunlight::new(scene.light, &directions, AMBIENT, DIFFUSE)?;
    let view = View {
        projection: scene.projection.product(&scene.model_view).product(&scene.size),
        planes: Planes::default(),
        viewport: Viewport::<i32>::new(0, 0, WIDTH, HEIGHT)?.y_up().samples_at_centers(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Clockwise,
    };
    let stored = view.stored();
    // One after the other: both at once need more registers than there are.
    for (vertex, &point) in vertices.iter_mut().zip(&scene.points) {
        *vertex = stored.vertex(point, vertex.carried);
    }
    for (vertex, &normal) in vertices.iter_mut().zip(&scene.normals) {
        vertex.carried = light.shade(normal);
    }
    Ok(view)
}

impl Scene {
    fn read(bytes: &[u8]) -> Option<Self> {
        let mut words = Words(bytes);
        let (vertices, triangles) = (words.word()? as usize, words.word()? as usize);
        let mut scene = Scene {
            points: Vec::new(),
            normals: Vec::new(),
            triangles: Vec::new(),
            size: Matrix::identity(),
            model_view: Matrix::identity(),
            projection: Matrix::identity(),
            light: [0; 3],
        };
        for _ in 0..vertices {
            scene.points.push(words.triple()?).ok()?;
        }
        for _ in 0..vertices {
            scene.normals.push(words.triple()?).ok()?;
        }
        for _ in 0..triangles {
            scene.triangles.push(words.triple()?.map(|index| index as u16)).ok()?;
        }
        (scene.size, scene.model_view) = (words.matrix()?, words.matrix()?);
        (scene.projection, scene.light) = (words.matrix()?, words.words()?);
        Some(scene)
    }
}

/// What is left to read.
struct Words<'a>(&'a [u8]);

impl Words<'_> {
    fn word(&mut self) -> Option<i32> {
        let (word, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(i32::from_le_bytes(*word))
    }

    fn half(&mut self) -> Option<i16> {
        let (half, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(i16::from_le_bytes(*half))
    }

    fn triple(&mut self) -> Option<[i16; 3]> {
        Some([self.half()?, self.half()?, self.half()?])
    }

    fn words<const N: usize>(&mut self) -> Option<[i32; N]> {
        let mut words = [0; N];
        for word in &mut words {
            *word = self.word()?;
        }
        Some(words)
    }

    fn matrix(&mut self) -> Option<Matrix<i32>> {
        let entries = self.words()?;
        Some(Matrix::from_rows(Block::new(entries, self.word()?)))
    }
}
