//! Meshes of vertices that are projected once: hills of triangles of a few pixels.

use core::hint::black_box;
use core::marker::PhantomData;

use fixel::depth::{Depth, Less, NoDepth};
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Fragment, Gouraud565};
use fixel::light::{Light, Lights, Shiny};
use fixel::matrix::Matrix;
use fixel::num::{Angle, Block, Precision};
use fixel::quality::Quality;
use fixel::target::Target;
use fixel::texture::Nearest;
use fixel::view::{Carried, View};
use heapless::Vec;

use super::camera::{Textured, view};
use super::part::Part;
use super::raster::TEXTURE;

/// Cells on a side.
const CELLS: u16 = 10;
const SIDE: u16 = CELLS + 1;
const VERTICES: usize = SIDE as usize * SIDE as usize;

/// Column and row of every vertex.
fn places() -> impl Iterator<Item = [i32; 2]> {
    (0..i32::from(SIDE)).flat_map(|j| (0..i32::from(SIDE)).map(move |i| [i, j]))
}

/// How high the hills are there: a few waves that the compiler cannot know.
fn height([i, j]: [i32; 2]) -> i32 {
    (i * i * 5 + j * j * 3 + i * j * 7 + black_box(3)) % 11 - 5
}

/// As a mesh stores it: 1 is 2^15.
fn stored([i, j]: [i32; 2]) -> [i16; 3] {
    [i * 6_000 - 30_000, height([i, j]) * 900, j * 6_000 - 30_000].map(|v| v as i16)
}

/// Two triangles a cell.
fn triangles() -> impl Iterator<Item = [u16; 3]> {
    let cells = (0..CELLS).flat_map(|j| (0..CELLS).map(move |i| j * SIDE + i));
    cells.flat_map(|first| {
        let [right, below, across] = [first + 1, first + SIDE, first + SIDE + 1];
        [[first, right, across], [first, across, below]]
    })
}

/// Before the camera, turned and tilted.
fn placed<Q: Quality>() -> Result<View<i32, i32, 0>, Error> {
    let turned =
        Matrix::rotation::<Q::Trigonometry>(Angle::from_degrees(black_box(31)), Block::from_integers([2, 3, 1]))?;
    let model = Matrix::model(
        Block::from_integers([0, 0, -4]),
        &turned,
        Block::from_integers([2, 1, 2]),
    );
    let mut view = view::<Q, i32, i32, 0>(&[])?;
    view.projection = view.projection.product(&model);
    Ok(view)
}

fn drawn<F: Fragment<Varying: Carried, Pixel = u16>>(
    view: &View<i32, i32, 0>,
    color: &mut impl Target<Pixel = u16>,
    depth: &mut impl Depth,
    carried: impl Fn([i32; 2]) -> <F::Varying as Carried>::Vertex,
    fragment: &F,
) {
    let mut vertices = Vec::<_, VERTICES>::new();
    for place in places() {
        // As many as there are places; collecting them would be a panic path of the image.
        let _ = vertices.push(view.stored_vertex(stored(place), carried(place)));
    }
    draw::indexed(view, color, depth, &vertices, triangles(), fragment);
}

/// A sun at every vertex, colours between.
pub fn lit<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let mut lights = Lights::<i32, 1, 0, Q::Precision>::default();
    lights.add(Light::sun(black_box([-3, 5, 4]), [60_000, 52_000, 44_000])?)?;
    let lights = lights.at_scale(-8);
    let (mut color, mut depth) = part.compared::<Less>()?;
    let carried = |place: [i32; 2]| {
        let [i, j] = place;
        let slope = [[i + 1, j], [i, j + 1]].map(|beside| height(place) - height(beside));
        let normal = Q::Precision::unit([slope[0], 8, slope[1]]).unwrap_or_default();
        let eye = [i - 5, height(place), j - 30].map(|v| v << 8);
        let levels = lights.shade(normal, eye, [65_536, 50_000, 30_000], &Shiny(black_box(9 << 16)));
        let [red, green, blue] = levels.map(|c| (c.clamp(0, 65_535) >> 8) as u8);
        Gouraud565::corner(red, green, blue).0
    };
    drawn(&placed::<Q>()?, &mut color, &mut depth, carried, &Q::GOURAUD);
    Ok(())
}

/// A texture without a depth buffer: what comes later hides.
pub fn textured<Q: Quality>(part: &mut Part<'_>) -> Result<(), Error> {
    let mut color = part.color()?;
    let fragment = Textured::<Q>(Nearest::new(TEXTURE?, 16), PhantomData);
    let carried = |place: [i32; 2]| place.map(|v| (v * 3) << 16);
    drawn(&placed::<Q>()?, &mut color, &mut NoDepth, carried, &fragment);
    Ok(())
}
