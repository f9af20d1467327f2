//! Coverage against exact geometry: one exact question a pixel.

use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::Fragment;
use fixel::target::Buffer;
use fixel_workloads::bytes::Vertex;
use fixel_workloads::frame::{HEIGHT, WIDTH};

use crate::failure::Failure;
use crate::workloads::{Triangle, Workloads};

/// Pixels of the picture.
pub const PIXELS: usize = WIDTH as usize * HEIGHT as usize;

/// Sets that are drawn triangle by triangle.
const SETS: [&str; 3] = ["coverage_16", "coverage_ties", "coverage_256"];

/// The set that covers every pixel once.
const MESH: &str = "mesh_grid";

/// Numbers of pixels that are wrong: all 0, or something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exactness {
    /// Each with its key: the coverage sets, then gaps and double hits of the mesh.
    pub figures: [(&'static str, u64); 5],
}

impl Exactness {
    /// Of the core, on the exactness sets of a workloads file.
    pub fn of(workloads: &Workloads) -> Result<Self, Failure> {
        Self::of_drawn(workloads, |key| {
            Ok(workloads.triangles(key)?.iter().map(hits).collect())
        })
    }

    /// Of whoever says how often each triangle of a set hits each pixel.
    pub fn of_drawn(
        workloads: &Workloads,
        mut drawn: impl FnMut(&'static str) -> Result<Vec<Vec<u8>>, Failure>,
    ) -> Result<Self, Failure> {
        let mut wrong = |key| {
            let (triangles, drawn) = (workloads.triangles(key)?, drawn(key)?);
            Ok((key, wrong_pixels(&triangles, &drawn)))
        };
        let [of_16, of_ties, of_256] = SETS;
        let (of_16, of_ties, of_256) = (wrong(of_16)?, wrong(of_ties)?, wrong(of_256)?);
        let sums = sums(&drawn(MESH)?);
        let count = |wrong: fn(u32) -> bool| sums.iter().filter(|&&hits| wrong(hits)).count() as u64;
        Ok(Exactness {
            figures: [
                of_16,
                of_ties,
                of_256,
                ("mesh_gaps", count(|hits| hits == 0)),
                ("mesh_double", count(|hits| hits > 1)),
            ],
        })
    }

    /// Whether nothing is wrong.
    pub fn holds(&self) -> bool {
        self.figures.iter().all(|&(_, wrong)| wrong == 0)
    }
}

/// Pixels where what was drawn and exact geometry differ, summed over the triangles. A triangle that was not drawn at all
/// misses every pixel.
fn wrong_pixels(triangles: &[Triangle], drawn: &[Vec<u8>]) -> u64 {
    let nothing = vec![0; PIXELS];
    let drawn = drawn.iter().chain(std::iter::repeat(&nothing));
    let wrong = |(triangle, drawn): (&Triangle, &Vec<u8>)| {
        let differs = |&(at, &hits): &(usize, &u8)| covers(triangle, at) != (hits == 1);
        drawn.iter().enumerate().filter(differs).count() as u64
    };
    triangles.iter().zip(drawn).map(wrong).sum()
}

/// How often each pixel is hit by all together.
fn sums(drawn: &[Vec<u8>]) -> Vec<u32> {
    let mut sums = vec![0; PIXELS];
    for triangle in drawn {
        for (sum, &hits) in sums.iter_mut().zip(triangle) {
            *sum += u32::from(hits);
        }
    }
    sums
}

/// How often the core hits each pixel.
fn hits(triangle: &Triangle) -> Vec<u8> {
    let mut hits = vec![0; PIXELS];
    if let Ok(mut target) = Buffer::new(&mut hits, WIDTH, HEIGHT) {
        draw::triangle(&mut target, &mut NoDepth, triangle.map(Vertex::flat), &Count);
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

/// Whether the sample of pixel `at`, counted row by row, lies inside, on a left edge, or on a horizontal top edge.
pub fn covers(triangle: &Triangle, at: usize) -> bool {
    let columns = usize::from(WIDTH);
    let sample = ((at % columns) as i64 * 256, (at / columns) as i64 * 256);
    let [a, b, c] = triangle.map(|v| (i64::from(v.x), i64::from(v.y)));
    let area = side(a, b, c);
    // Clockwise on a screen whose rows run downwards: a left edge runs up, a top edge runs right.
    let [b, c] = if area < 0 { [c, b] } else { [b, c] };
    area != 0
        && [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| {
            let s = side(from, to, sample);
            s > 0 || s == 0 && (to.1 < from.1 || to.1 == from.1 && to.0 > from.0)
        })
}

/// Twice the signed area of a triangle.
fn side((ax, ay): (i64, i64), (bx, by): (i64, i64), (px, py): (i64, i64)) -> i64 {
    (bx - ax) * (py - ay) - (by - ay) * (px - ax)
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
            inverse_w: 1 << 30,
            texel: [0; 2],
        };
        let triangle = [corner(0, 0), corner(0, 4), corner(4, 0)];
        let covered = |y: usize| {
            (0..8)
                .filter(|&x| covers(&triangle, y * usize::from(WIDTH) + x))
                .count()
        };
        assert_eq!([0, 1, 2, 3, 4].map(covered), [4, 3, 2, 1, 0]);

        let drawn = hits(&triangle);
        assert_eq!(wrong_pixels(&[triangle], std::slice::from_ref(&drawn)), 0);
        assert_eq!(wrong_pixels(&[triangle], &[]), 10);
        let mut wrong = drawn.clone();
        (wrong[0], wrong[5]) = (0, 1);
        assert_eq!(wrong_pixels(&[triangle], &[wrong]), 2);
        assert_eq!(sums(&[drawn.clone(), drawn]).iter().filter(|&&h| h == 2).count(), 10);
    }
}
