//! The course's own pictures against the core's pipeline: chapters 01 and 10.

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use fixel::blend::{ONE, Rgba, Translucent};
use fixel::depth::NoDepth;
use fixel::num::Block;
use fixel::pipeline::{self, HeadRoom, Pixel, Program, State, Surface, from_the_top};
use fixel::target::Buffer;
use fixel::viewport::Viewport;

const SIDE: usize = 300;

/// Vertices in 1/256 px, one colour for all.
struct Paint(Rgba);

impl Program for Paint {
    type Vertex = (i32, i32);
    type Varying = ();
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, &(x, y): &(i32, i32)) -> (Block<i32, 4>, ()) {
        let side = 256 * SIDE as i32;
        (Block::from_integers([2 * x - side, 2 * y - side, 0, side]), ())
    }
    fn fragment(&self, _: Pixel, (): ()) -> Option<Rgba> {
        Some(self.0)
    }
}

/// Red, green and blue of the picture `name` from the top, or `None` where there are no pictures to compare.
fn wanted(name: &str) -> Option<Vec<[u8; 3]>> {
    let folder = std::env::var_os("FIXEL_CONFORMANCE").map(PathBuf::from);
    let Some(folder) = folder else {
        eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, {name} is not compared");
        return None;
    };
    Some(read(&folder.join("pipeline").join(name)))
}

fn read(path: &Path) -> Vec<[u8; 3]> {
    let file = File::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut decoder = png::Decoder::new(BufReader::new(file));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!((info.width as usize, info.height as usize), (SIDE, SIDE));
    let samples = info.color_type.samples();
    bytes[..info.buffer_size()]
        .chunks(samples)
        .map(|p| if samples < 3 { [p[0]; 3] } else { [p[0], p[1], p[2]] })
        .collect()
}

fn state() -> State<pipeline::PerspectiveCorrected, i32, i32, 1> {
    State::new(
        Viewport::new(0, 0, SIDE as u16, SIDE as u16)
            .unwrap()
            .samples_at_centers(),
    )
}

fn written_out(pixels: &[Rgba]) -> Vec<[u8; 3]> {
    from_the_top(pixels, SIDE).flatten().map(|p| p.to_bytes()).collect()
}

fn color([red, green, blue, alpha]: [f64; 4]) -> Rgba {
    let unit = |v: f64| (v * f64::from(ONE)).round() as i32;
    Rgba {
        color: [red, green, blue].map(unit),
        alpha: unit(alpha),
    }
}

#[test]
fn beginning() {
    let Some(want) = wanted("beginning.png") else {
        return;
    };
    let mut pixels = vec![color([0.0, 0.0, 0.0, 1.0]); SIDE * SIDE];
    let fine = |v: f64| (v * 256.0).round() as i32;
    let rays = (0..20).flat_map(|i| {
        let angle = TAU * f64::from(i) / 20.0;
        let end = (150.0 + 105.0 * angle.cos(), 150.0 + 105.0 * angle.sin());
        [(fine(150.0), fine(150.0)), (fine(end.0), fine(end.1))]
    });
    let mut target = Buffer::new(&mut pixels, SIDE as u16, SIDE as u16).unwrap();
    pipeline::lines(
        &state(),
        &mut target,
        &mut NoDepth,
        &Paint(color([1.0, 0.0, 0.0, 1.0])),
        rays,
    );
    let red = |picture: &[[u8; 3]]| -> BTreeSet<usize> {
        (0..picture.len()).filter(|&i| picture[i] == [255, 0, 0]).collect()
    };
    let (got, want) = (red(&written_out(&pixels)), red(&want));
    println!(
        "beginning.png: {} red pixels, {} wanted, {} only here",
        got.len(),
        want.len(),
        got.difference(&want).count()
    );
    assert_eq!(want.len(), 1873);
    // Ties, each one pixel beside.
    let lost: Vec<_> = want.difference(&got).collect();
    let beside = |i: &usize| {
        [1, SIDE]
            .iter()
            .any(|d| want.contains(&(i + d)) || want.contains(&i.wrapping_sub(*d)))
    };
    assert!(
        lost.len() <= 8 && got.difference(&want).count() <= 8,
        "{lost:?} are missing"
    );
    assert!(got.difference(&want).all(beside));
}

#[test]
fn blended_rectangles() {
    let Some(want) = wanted("blend-rects.png") else {
        return;
    };
    let rectangles = [
        ([10, 10, 100, 100], [1.0, 0.0, 0.0, 0.5]),
        ([80, 20, 100, 100], [0.0, 1.0, 0.0, 0.5]),
        ([70, 60, 40, 200], [0.0, 0.0, 1.0, 0.75]),
        ([20, 240, 200, 20], [1.0, 1.0, 1.0, 1.0]),
        ([20, 200, 200, 20], [1.0, 1.0, 1.0, 0.75]),
        ([20, 160, 200, 20], [1.0, 1.0, 1.0, 0.5]),
        ([20, 120, 200, 20], [1.0, 1.0, 1.0, 0.25]),
        ([20, 80, 200, 20], [1.0, 1.0, 1.0, 0.15]),
    ];
    let mut pixels = vec![color([0.0, 0.0, 0.0, 1.0]); SIDE * SIDE];
    for ([x, y, w, h], c) in rectangles {
        let target = Buffer::new(&mut pixels, SIDE as u16, SIDE as u16).unwrap();
        let mut surface = Surface::new(target, HeadRoom).blended(Translucent);
        let [a, b, c_, d] = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)].map(|(x, y)| (x * 256, y * 256));
        pipeline::triangles(
            &state(),
            &mut surface,
            &mut NoDepth,
            &Paint(color(c)),
            [a, b, c_, a, c_, d],
        );
    }
    let got = written_out(&pixels);
    let off = |(g, w): (&[u8; 3], &[u8; 3])| (0..3).map(|i| g[i].abs_diff(w[i])).max().unwrap_or(0);
    let worst = got.iter().zip(&want).map(off).max().unwrap();
    let different = got.iter().zip(&want).filter(|(g, w)| g != w).count();
    println!(
        "blend-rects.png: {different} of {} pixels differ, by {worst} at most",
        want.len()
    );
    // The course's colours are floats of 32 bits: a level where a value lies on a half.
    assert!(worst <= 1);
}
