//! `cargo xtask scale`: how cost grows with pictures and with triangles, and what triangles cost that are not there to see.
//!
//! Valgrind counts the host's instructions in the draw calls, Gouraud with depth, one run per point.

use std::fs;
use std::path::Path;

use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::draw::triangle;
use fixel::error::Error;
use fixel::fragment::Gouraud565;
use fixel::target::Buffer;
use fixel_workloads::bytes::Vertex;
use fixel_workloads::draw::{GouraudTriangle, prepare_gouraud};

use crate::callgrind::count;
use crate::chart::{self, Panel, Series};
use crate::failure::Failure;
use crate::host::counted_region;

/// Most that a fitted exponent may be: linear, and no more.
const MOST_EXPONENT: f64 = 1.02;
/// Most instructions for a triangle beside the picture, whatever its size.
const MOST_OFF_SCREEN: f64 = 1_000.0;
/// Most that a triangle may cost that covers the picture and reaches far beyond it, against one that just covers it.
const MOST_GIGANTIC: f64 = 1.25;

/// Pixels along the sides of pictures.
const SIDES: [u32; 9] = [16, 32, 64, 128, 256, 512, 1_024, 2_048, 4_096];
/// Numbers of triangles.
const COUNTS: [u32; 7] = [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000];
/// Pixels along the sides of triangles beside the picture.
const BESIDE: [u32; 4] = [4, 40, 400, 3_000];
/// How many pictures the gigantic ones reach beyond.
const BEYOND: [u32; 4] = [1, 2, 4, 12];

/// Of those that were drawn beside the picture.
const REPEATS: u32 = 1_000;
/// Sides of the picture that triangles of ten pixels are drawn into, and so on.
const PICTURE: u16 = 320;

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Case {
    /// A picture of so many pixels along a side, covered by two triangles.
    Pixels,
    /// So many triangles of ten pixels.
    Triangles,
    /// Triangles of so many pixels along a side, beside the picture.
    OffScreen,
    /// One triangle that reaches so many pictures beyond the picture.
    Gigantic,
}

impl Case {
    fn name(self) -> &'static str {
        match self {
            Case::Pixels => "pixels",
            Case::Triangles => "triangles",
            Case::OffScreen => "off-screen",
            Case::Gigantic => "gigantic",
        }
    }

    /// The picture's side, and the triangles.
    fn scene(self, n: u32) -> (u16, Vec<GouraudTriangle>) {
        let side = n as i32;
        match self {
            Case::Pixels => {
                let [a, b, c, d] = [(0, 0), (0, side), (side, 0), (side, side)].map(corner);
                (n as u16, [[a, b, c], [c, b, d]].map(prepare_gouraud).into())
            }
            Case::Triangles => (PICTURE, (0..side).map(ten_pixels).collect()),
            Case::OffScreen => {
                let x = i32::from(PICTURE) + 10;
                let beside = [(x, 0), (x, side), (x + side, side / 2)].map(corner);
                (PICTURE, vec![prepare_gouraud(beside); REPEATS as usize])
            }
            Case::Gigantic => {
                let (beyond, side) = (side * i32::from(PICTURE), i32::from(PICTURE));
                let around = [(-beyond, 0), (0, 2 * side), (2 * side, 0)];
                let mut triangle = around.map(corner);
                // The corner opposite the picture's own moves away, along both of its sides.
                triangle[0] = corner((-beyond + side, -beyond + side));
                (PICTURE, vec![prepare_gouraud(triangle)])
            }
        }
    }
}

/// With depth and colour that differ from corner to corner.
fn corner((x, y): (i32, i32)) -> Vertex {
    Vertex {
        x: x * 256,
        y: y * 256,
        depth: (20_000 + (x + 2 * y).rem_euclid(30_000) as u32) << 15,
        color: [x, y, x + y].map(|v| 20 + v.rem_euclid(200) as u8),
        inverse_w: 1 << 30,
        texel: [0; 2],
    }
}

/// The triangle number `i` of ten pixels, somewhere in the picture; each before the one before it, so that all are seen.
fn ten_pixels(i: i32) -> GouraudTriangle {
    let free = i32::from(PICTURE) - 8;
    let (x, y) = (
        i.wrapping_mul(7_919).rem_euclid(free),
        i.wrapping_mul(104_729).rem_euclid(free),
    );
    let nearer = (60_000 - i.min(1_000_000) / 20) as u32;
    let corners = [(0, 0), (1, 5), (5, 1)].map(|(dx, dy)| Vertex {
        depth: (nearer + (dx + dy) as u32) << 15,
        ..corner((x + dx, y + dy))
    });
    prepare_gouraud(corners)
}

/// What valgrind runs.
pub fn draw(case: Case, n: u32) -> Result<(), Failure> {
    draw_scene(case, n).map_err(|e| Failure::trouble("drawing", e))
}

fn draw_scene(case: Case, n: u32) -> Result<(), Error> {
    let (side, triangles) = case.scene(n);
    let area = usize::from(side).pow(2);
    let (mut colors, mut depths) = (vec![0; area], vec![FAR; area]);
    let mut color = Buffer::new(&mut colors, side, side)?;
    let mut depth: DepthBuffer<_, LessOrEqual> = DepthBuffer::new(Buffer::new(&mut depths, side, side)?);
    counted_region(|| {
        for corners in &triangles {
            triangle(&mut color, &mut depth, *corners, &Gouraud565);
        }
    });
    Ok(())
}

/// Points of a case: how many, and instructions.
fn points(case: Case, numbers: &[u32]) -> Result<Vec<[f64; 2]>, Failure> {
    let point = |&n: &u32| {
        let instructions = count("counted_region", ["draw-scale", case.name(), &n.to_string()])?;
        Ok([f64::from(n), instructions as f64])
    };
    numbers.iter().map(point).collect()
}

/// Measures, prints, writes the chart; an exponent or a constant over its limit is a failure.
pub fn run(svg: &Path) -> Result<(), Failure> {
    let squared = |points: Vec<[f64; 2]>| {
        points
            .into_iter()
            .map(|[side, cost]| [side * side, cost])
            .collect::<Vec<_>>()
    };
    let pixels = squared(points(Case::Pixels, &SIDES)?);
    let triangles = points(Case::Triangles, &COUNTS)?;
    let mut off = Vec::new();
    let mut panels = Vec::new();
    for (unit, points) in [("pixel", &pixels), ("triangle", &triangles)] {
        print_points(unit, points);
        let fit = Fit::of(points);
        println!(
            "  cost grows as the {:.4}th power; {:.1} instructions a {unit} and {:.0} besides\n",
            fit.exponent, fit.each, fit.base
        );
        if fit.exponent > MOST_EXPONENT {
            off.push(format!(
                "cost grows as the {:.4}th power of {unit}s, more than {MOST_EXPONENT}",
                fit.exponent
            ));
        }
        panels.push(Panel {
            title: format!("{:.1} instructions a {unit}, exponent {:.3}", fit.each, fit.exponent),
            x: format!("{unit}s"),
            y: "instructions".into(),
            series: Series {
                points: points.clone(),
                line: points.iter().map(|&[n, _]| [n, fit.base + fit.each * n]).collect(),
            },
        });
    }
    off.extend(constants()?);
    fs::write(
        svg,
        chart::draw("Cost against size, Gouraud with depth, instructions on x86-64", &panels),
    )
    .map_err(|e| Failure::trouble(svg.display(), e))?;
    println!("chart: {}", svg.display());
    if off.is_empty() {
        Ok(())
    } else {
        Err(Failure::Off(off.join("\n")))
    }
}

fn print_points(unit: &str, points: &[[f64; 2]]) {
    println!("{:>12}s{:>16}{:>16}", unit, "instructions", format!("per {unit}"));
    for [n, cost] in points {
        println!("{n:>13}{cost:>16}{:>16.2}", cost / n);
    }
}

/// Prints what triangles cost that are beside the picture, or far larger; what is off.
fn constants() -> Result<Vec<String>, Failure> {
    let mut off = Vec::new();
    println!("wholly off the screen, side in pixels: instructions a triangle");
    for [side, cost] in points(Case::OffScreen, &BESIDE)? {
        let each = cost / f64::from(REPEATS);
        println!("{side:>13}{each:>16.1}");
        if each > MOST_OFF_SCREEN {
            off.push(format!(
                "a triangle of {side} pixels off the screen costs {each:.0}, more than {MOST_OFF_SCREEN}"
            ));
        }
    }
    println!("\none that covers the picture and reaches so many pictures beyond: instructions");
    let gigantic = points(Case::Gigantic, &BEYOND)?;
    let just = gigantic.first().map_or(0.0, |[_, cost]| *cost);
    for [beyond, cost] in gigantic {
        println!("{beyond:>13}{cost:>16}{:>9.3} times", cost / just);
        if cost > MOST_GIGANTIC * just {
            off.push(format!(
                "reaching {beyond} pictures beyond costs {:.2} times",
                cost / just
            ));
        }
    }
    println!();
    Ok(off)
}

/// How cost grows.
#[derive(Debug, Clone, Copy)]
struct Fit {
    /// Slope of a line through the larger half's logarithms.
    exponent: f64,
    /// Slope of the line that fits best, relative errors counted.
    each: f64,
    /// And where it starts.
    base: f64,
}

impl Fit {
    fn of(points: &[[f64; 2]]) -> Self {
        let logarithms: Vec<_> = points[points.len() / 2..]
            .iter()
            .map(|p| (p.map(f64::ln), 1.0))
            .collect();
        let relative: Vec<_> = points
            .iter()
            .map(|&[n, cost]| ([n, cost], 1.0 / (cost * cost)))
            .collect();
        let (exponent, _) = line(&logarithms);
        let (each, base) = line(&relative);
        Fit { exponent, each, base }
    }
}

/// Slope and start of the line through weighted points that leaves the least squares.
fn line(points: &[([f64; 2], f64)]) -> (f64, f64) {
    let sum = |of: fn(f64, f64) -> f64| points.iter().map(|&([x, y], weight)| weight * of(x, y)).sum::<f64>();
    let (all, x, y) = (sum(|_, _| 1.0), sum(|x, _| x), sum(|_, y| y));
    let (xx, xy) = (sum(|x, _| x * x), sum(|x, y| x * y));
    let slope = (all * xy - x * y) / (all * xx - x * x);
    (slope, (y - slope * x) / all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_and_a_square_are_told_apart() {
        let numbers = [1.0, 10.0, 100.0, 1e3, 1e4, 1e5];
        let linear = Fit::of(&numbers.map(|n| [n, 500.0 + 20.0 * n]));
        assert!((linear.each - 20.0).abs() < 1e-6 && (linear.base - 500.0).abs() < 1e-3);
        assert!((0.98..MOST_EXPONENT).contains(&linear.exponent));
        assert!(Fit::of(&numbers.map(|n| [n, n * n])).exponent > 1.99);
    }

    #[test]
    fn scenes_are_what_they_are_called() {
        let hit = |case: Case, n| {
            let (side, triangles) = case.scene(n);
            let mut pixels = vec![0u16; usize::from(side).pow(2)];
            let mut target = Buffer::new(&mut pixels, side, side).unwrap();
            for corners in triangles {
                triangle(&mut target, &mut fixel::depth::NoDepth, corners, &Gouraud565);
            }
            pixels.iter().filter(|&&pixel| pixel != 0).count()
        };
        let area = usize::from(PICTURE).pow(2);
        assert_eq!(hit(Case::Pixels, 16), 256);
        assert!((8..=12).contains(&hit(Case::Triangles, 1)));
        assert_eq!(hit(Case::OffScreen, 40), 0);
        assert_eq!(BEYOND.map(|n| hit(Case::Gigantic, n)), [area; 4]);
    }
}
