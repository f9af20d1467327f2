//! `cargo xtask callgrind`: geometry far beyond the screen must not cost much more than what fits it.
//!
//! The picture is that of the conformance scene `hw2screenclip`, one triangle with corners 10^8 pictures away; beside it
//! the same picture drawn by triangles that fit the screen. Valgrind runs this program once for each and counts the
//! host's instructions in the core's draw calls.

use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;
use std::{env, io};

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::draw::primitive;
use fixel::error::Error;
use fixel::fragment::Flat;
use fixel::matrix::Matrix;
use fixel::num::Block;
use fixel::target::Buffer;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;

use crate::failure::Failure;

/// How much more the far corners may cost.
const LIMIT: f64 = 1.5;

/// Pixels along a side of the picture.
const SIDE: u16 = 120;

/// Clip coordinates: x, y, z, w.
type Point = [i32; 4];

/// The scene's triangle, with w at 2.
const FAR_AWAY: [[Point; 3]; 1] = [[
    [200_000_000, 320_000_000, 1, 2],
    [-160_000_000, 200_000_000, 1, 2],
    [0, -4, 1, 2],
]];

/// What of it lies on the screen, with w at 40: cut at the borders by hand, then a fan.
const FITTING: [[Point; 3]; 4] = {
    const CUT: [Point; 6] = [
        [-32, -40, 20, 40],
        [25, -40, 20, 40],
        [40, -16, 20, 40],
        [40, 40, 20, 40],
        [-40, 40, 20, 40],
        [-40, -30, 20, 40],
    ];
    let [a, b, c, d, e, f] = CUT;
    [[a, b, c], [a, c, d], [a, d, e], [a, e, f]]
};

/// Counts both and judges.
pub fn run() -> Result<(), Failure> {
    let differing = pixels_that_differ().map_err(|e| Failure::trouble("drawing", e))?;
    let (far, fitting) = (count_case("far")?, count_case("fitting")?);
    let ratio = far as f64 / fitting as f64;
    println!("corners 10^8 pictures away   {far:>8} instructions on the host");
    println!("triangles that fit           {fitting:>8}");
    println!(
        "ratio {ratio:.2}, at most {LIMIT}; {differing} of {} pixels differ",
        u32::from(SIDE).pow(2)
    );
    // Cut by hand, the fan's corners were rounded to subpixels: an edge's pixel here and there is not the same.
    if differing > usize::from(SIDE) / 10 {
        return Err(Failure::Off("the two are not the same picture".into()));
    }
    if ratio > LIMIT {
        return Err(Failure::Off(format!(
            "geometry beyond the screen costs {ratio:.2} times as much"
        )));
    }
    Ok(())
}

/// What valgrind runs: one of the two cases, drawn once.
pub fn draw_case(case: &str) -> Result<(), Failure> {
    let triangles: &[[Point; 3]] = if case == "far" { &FAR_AWAY } else { &FITTING };
    draw(triangles).map(drop).map_err(|e| Failure::trouble("drawing", e))
}

fn pixels_that_differ() -> Result<usize, Error> {
    let (far, fitting) = (draw(&FAR_AWAY)?, draw(&FITTING)?);
    Ok(far.iter().zip(&fitting).filter(|(a, b)| a != b).count())
}

fn draw(triangles: &[[Point; 3]]) -> Result<Vec<u16>, Error> {
    let area = usize::from(SIDE).pow(2);
    let (mut pixels, mut depths) = (vec![0; area], vec![FAR; area]);
    let view = View {
        projection: Matrix::identity(),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, SIDE, SIDE)?,
        depth_range: DepthRange::ZeroToOne,
        behind: Behind::Divide,
        cull: Cull::Nothing,
    };
    let mut color = Buffer::new(&mut pixels, SIDE, SIDE)?;
    let mut depth = DepthBuffer::new(Buffer::new(&mut depths, SIDE, SIDE)?);
    let corner = |p| Vertex {
        position: Block::from_integers(p),
        carried: (),
    };
    let triangles: Vec<_> = triangles.iter().map(|triangle| triangle.map(corner)).collect();
    counted_draw_calls(&view, &mut color, &mut depth, &triangles);
    Ok(pixels)
}

/// The host's back end has room for so many clip planes.
type HostView = View<i64, i32, 64>;
type Depths<'a> = DepthBuffer<Buffer<'a, u16>, LessOrEqual>;

/// Valgrind counts in here, by name.
#[inline(never)]
fn counted_draw_calls(
    view: &HostView,
    color: &mut Buffer<'_, u16>,
    depth: &mut Depths<'_>,
    triangles: &[[Vertex<i64, ()>; 3]],
) {
    for corners in triangles {
        primitive(view, color, depth, corners, &Flat(0xffff));
    }
}

/// Instructions in the draw calls of a case.
fn count_case(case: &str) -> Result<u64, Failure> {
    count("counted_draw_calls", ["draw-case", case])
}

/// Instructions that this program, run with `arguments`, spends in `function`.
pub fn count(function: &str, arguments: impl IntoIterator<Item: AsRef<OsStr>>) -> Result<u64, Failure> {
    let program = env::current_exe().map_err(|e| Failure::trouble("this program", e))?;
    count_in(&program, function, arguments)
}

/// Instructions that `program`, run with `arguments`, spends in `function`.
pub fn count_in(
    program: &Path,
    function: &str,
    arguments: impl IntoIterator<Item: AsRef<OsStr>>,
) -> Result<u64, Failure> {
    let output = Command::new("valgrind")
        .args([
            "--tool=callgrind",
            &format!("--toggle-collect=*{function}*"),
            "--callgrind-out-file=/dev/null",
        ])
        .arg(program)
        .args(arguments)
        .output()
        .map_err(|e| match e.kind() {
            io::ErrorKind::NotFound => Failure::Usage(
                "valgrind is not installed; on Debian: apt-get install --no-install-recommends valgrind".into(),
            ),
            _ => Failure::trouble("valgrind", e),
        })?;
    let report = String::from_utf8_lossy(&output.stderr);
    collected(&report).ok_or_else(|| Failure::Trouble(format!("valgrind counted nothing:\n{report}")))
}

/// The count in valgrind's report; `None` where nothing was counted.
fn collected(report: &str) -> Option<u64> {
    let count = report
        .lines()
        .find_map(|line| line.split_once("Collected : ")?.1.trim().parse().ok());
    count.filter(|&count| count > 0)
}

#[cfg(test)]
mod tests {
    use super::collected;

    #[test]
    fn nothing_counted_is_no_count() {
        assert_eq!(collected("==1== Events    : Ir\n==1== Collected : 123\n"), Some(123));
        assert_eq!(collected("==1== Collected : 0\n"), None);
        assert_eq!(collected("no such program\n"), None);
    }
}
