//! The core's coverage against exact geometry: one exact question a pixel.

use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::Fragment;
use fixel::target::Buffer;
use fixel_workloads::bytes::Vertex;
use fixel_workloads::frame::{HEIGHT, WIDTH};

use crate::failure::Failure;
use crate::workloads::{Triangle, Workloads};

const PIXELS: usize = WIDTH as usize * HEIGHT as usize;

/// Numbers of pixels that are wrong: all 0, or something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exactness {
    /// Each with its key: the coverage sets, then gaps and double hits of the mesh.
    pub figures: [(&'static str, u64); 5],
}

impl Exactness {
    /// Draws the exactness sets of a workloads file.
    pub fn of(workloads: &Workloads) -> Result<Self, Failure> {
        let wrong = |key| workloads.triangles(key).map(|t| (key, wrong_pixels(&t)));
        let hits = hits(&workloads.triangles("mesh_grid")?);
        let count = |wrong: fn(&u8) -> bool| hits.iter().filter(|&h| wrong(h)).count() as u64;
        Ok(Exactness {
            figures: [
                wrong("coverage_16")?,
                wrong("coverage_ties")?,
                wrong("coverage_256")?,
                ("mesh_gaps", count(|&hits| hits == 0)),
                ("mesh_double", count(|&hits| hits > 1)),
            ],
        })
    }

    /// Whether nothing is wrong.
    pub fn holds(&self) -> bool {
        self.figures.iter().all(|&(_, wrong)| wrong == 0)
    }
}

/// Pixels where the core and exact geometry differ, summed over the triangles.
fn wrong_pixels(triangles: &[Triangle]) -> u64 {
    let columns = usize::from(WIDTH);
    let wrong = |triangle: &Triangle| {
        let drawn = hits(&[*triangle]);
        let differs =
            |&(at, &hits): &(usize, &u8)| covers(triangle, (at % columns) as i64, (at / columns) as i64) != (hits == 1);
        drawn.iter().enumerate().filter(differs).count() as u64
    };
    triangles.iter().map(wrong).sum()
}

/// How often the core hits each pixel.
fn hits(triangles: &[Triangle]) -> Vec<u8> {
    let mut hits = vec![0; PIXELS];
    if let Ok(mut target) = Buffer::new(&mut hits, WIDTH, HEIGHT) {
        for triangle in triangles {
            draw::triangle(&mut target, &mut NoDepth, triangle.map(Vertex::flat), &Count);
        }
    }
    hits
}

/// One more than was there.
struct Count;

impl Fragment for Count {
    type Varying = ();
    type Pixel = u8;

    fn shade(&self, (): (), below: u8) -> Option<u8> {
        Some(below.saturating_add(1))
    }
}

/// Whether the sample of pixel (x, y) lies inside, on a left edge, or on a horizontal top edge.
fn covers(triangle: &Triangle, x: i64, y: i64) -> bool {
    let [a, b, c] = triangle.map(|v| (i64::from(v.x), i64::from(v.y)));
    let side = |(ax, ay): (i64, i64), (bx, by): (i64, i64), (px, py): (i64, i64)| {
        (bx - ax) * (py - ay) - (by - ay) * (px - ax)
    };
    let area = side(a, b, c);
    // Clockwise on a screen whose rows run downwards: a left edge runs up, a top edge runs right.
    let [b, c] = if area < 0 { [c, b] } else { [b, c] };
    area != 0
        && [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| {
            let s = side(from, to, (x * 256, y * 256));
            s > 0 || s == 0 && (to.1 < from.1 || to.1 == from.1 && to.0 > from.0)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_too_many_or_too_few_is_seen() {
        let corner = |x: i32, y: i32| Vertex {
            x: x << 8,
            y: y << 8,
            depth: 0,
            color: [0; 3],
        };
        let triangle = [corner(0, 0), corner(0, 4), corner(4, 0)];
        let covered = |y| (0..8).filter(|&x| covers(&triangle, x, y)).count();
        assert_eq!([0, 1, 2, 3, 4].map(covered), [4, 3, 2, 1, 0]);
        assert_eq!(wrong_pixels(&[triangle]), 0);
        assert_eq!(hits(&[triangle, triangle]).iter().filter(|&&h| h == 2).count(), 10);
    }
}
