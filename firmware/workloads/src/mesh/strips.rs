//! W5 in 15 strips of 16 rows: triangles set up once and binned, one strip sent while the next is drawn.

use core::convert::Infallible;
use core::hint::black_box;

use fixel::bands::{Bands, Pool, Sink};
use fixel::depth::LessOrEqual;
use fixel::error::Error;
use fixel::fragment::Gouraud565;
use fixel::window::Window;

use super::{Lit, Scene, TRIANGLES, place};
use crate::frame::{Frame, HEIGHT, WIDTH};
use crate::machine::{Line, Machine};

const ROWS: usize = 16;
const STRIP: usize = WIDTH as usize * ROWS;

/// Room for the triangles of a closed mesh that face us, and some more.
type Strips = Pool<Gouraud565, { 3 * TRIANGLES / 2 }, { TRIANGLES / 2 }, { HEIGHT as usize / ROWS }>;

/// Sends at once and to nowhere, or to `picture`.
struct Nowhere<'p> {
    picture: Option<&'p mut [u16]>,
}

impl<'b> Sink<u16, &'b mut [u16]> for Nowhere<'_> {
    type Transfer = &'b mut [u16];
    type Error = Infallible;

    #[inline(never)]
    fn send(&mut self, window: Window, strip: &'b mut [u16]) -> &'b mut [u16] {
        let start = window.top as usize * WIDTH as usize;
        let rows = self.picture.as_deref_mut().and_then(|picture| picture.get_mut(start..));
        for (to, from) in rows.into_iter().flatten().zip(strip.iter()) {
            *to = *from;
        }
        strip
    }

    fn wait(&mut self, strip: &'b mut [u16]) -> (&'b mut [u16], Result<(), Infallible>) {
        (strip, Ok(()))
    }
}

/// Draws the mesh in strips. As with the whole frame, clearing is not counted: what strips without anything in them take is
/// taken off. The colours must be those of the whole frame; there is no depth of it to look at.
pub fn run(machine: &mut impl Machine, frame: &mut Frame, scene: &Scene, vertices: &mut [Lit]) {
    let (mut front, mut back, mut depths) = ([0; STRIP], [0; STRIP], [0; STRIP]);
    let Ok(bands) = Bands::new(WIDTH, HEIGHT, [&mut front[..], &mut back[..]], 0) else {
        return;
    };
    let Ok(mut bands) = bands.with_depth::<LessOrEqual>(&mut depths) else {
        return;
    };
    let mut pool = Strips::new();
    let mut drawn = Ok(0);
    let mut sink = Nowhere { picture: None };
    let all = machine.count(|| drawn = draw(&mut bands, &mut pool, scene, vertices, black_box(&mut sink)));
    let empty = machine.count(|| {
        let Ok(()) = bands.each(black_box(&mut sink), |color, depth| {
            black_box((color, depth));
        });
    });
    frame.clear();
    let mut sink = Nowhere {
        picture: Some(frame.pixels()),
    };
    if drawn == Ok(1) && draw(&mut bands, &mut pool, scene, vertices, &mut sink) == Ok(1) {
        let (color, depth) = frame.checksums();
        machine.report(&Line {
            name: "W5_strips",
            instructions: all.saturating_sub(empty),
            units: 1,
            color,
            depth,
        });
    }
}

/// The measured region; how often the triangles were submitted.
#[inline(never)]
fn draw(
    bands: &mut Bands<'_, u16, &mut [u16], LessOrEqual>,
    pool: &mut Strips,
    scene: &Scene,
    vertices: &mut [Lit],
    sink: &mut Nowhere<'_>,
) -> Result<u32, Error> {
    let view = place(scene, vertices)?;
    let Ok(passes) = bands.render(pool, sink, |frame| {
        frame.indexed(&view, vertices, scene.triangles.iter().copied(), Gouraud565);
    });
    Ok(passes)
}
