//! `cargo xtask workloads SEED`: a workloads file of the standard shape from a seed, so that figures can be seen to hold on
//! geometry that nothing was tuned for.

use serde_json::{Value, json};

use fixel_workloads::frame::{HEIGHT, WIDTH};

/// Pixels of a cell in which W2 and W3 have a triangle each: eight by four of them.
const CELL: [f64; 2] = [40.0, 60.0];
/// Cells of the mesh along the two sides.
const MESH: [usize; 2] = [16, 12];
/// Rings of the ball between its poles, and vertices of a ring: 2,890 vertices, 5,776 triangles.
const BALL: [usize; 2] = [38, 76];

/// A vertex: x, y, z, w, r, g, b, u, v.
type Vertex = [f64; 9];

/// The file.
pub fn from_seed(seed: u64) -> Value {
    let mut random = Random(seed);
    json!({
        "width": WIDTH,
        "height": HEIGHT,
        "vertex": ["x", "y", "z", "w", "r", "g", "b", "u", "v"],
        "W1": flat(&mut random),
        "W2": hidden(&mut random),
        "W3": textured(&mut random),
        "W4": small(&mut random),
        "W5": ball(&mut random),
        "coverage_16": coverage(&mut random, 16.0, 0.0),
        "coverage_ties": coverage(&mut random, 1.0, 0.5),
        "coverage_256": coverage(&mut random, 256.0, 0.0),
        "mesh_grid": mesh(&mut random),
    })
}

/// SplitMix64: the same numbers everywhere.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn within(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// On a grid of so many steps in a pixel.
    fn on_grid(&mut self, least: f64, most: f64, steps: f64) -> f64 {
        (self.within(least, most) * steps).round() / steps
    }

    fn color(&mut self) -> [f64; 3] {
        [(); 3].map(|()| self.within(20.0, 255.0).round())
    }

    /// Counter-clockwise as seen, with an area within bounds, in a box on the 1/16 grid.
    fn triangle(&mut self, [left, top]: [f64; 2], [width, height]: [f64; 2], areas: [f64; 2]) -> [[f64; 2]; 3] {
        loop {
            let triangle = [(); 3].map(|()| {
                let x = self.on_grid(left, left + width, 16.0);
                [x, self.on_grid(top, top + height, 16.0)]
            });
            let area = -area(&triangle);
            if area >= areas[0] && area <= areas[1] {
                return triangle;
            }
        }
    }
}

/// Positive for clockwise as seen, y running downwards.
fn area(&[[ax, ay], [bx, by], [cx, cy]]: &[[f64; 2]; 3]) -> f64 {
    ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2.0
}

/// Without perspective.
fn vertex([x, y]: [f64; 2], z: f64, [red, green, blue]: [f64; 3]) -> Vertex {
    [x, y, z, 1.0, red, green, blue, 0.0, 0.0]
}

/// One large triangle.
fn flat(random: &mut Random) -> Vec<Vertex> {
    let color = random.color();
    [[4.0, 4.0], [60.0, 236.0], [316.0, 60.0]]
        .map(|corner| vertex(corner.map(|v| random.on_grid(v - 3.0, v + 3.0, 16.0)), 0.5, color))
        .into()
}

/// A triangle in each cell of the picture.
fn in_cells(random: &mut Random) -> Vec<[[f64; 2]; 3]> {
    let cells = (0..32).map(|i| [f64::from(i % 8) * CELL[0] + 1.0, f64::from(i / 8) * CELL[1] + 1.0]);
    cells
        .map(|corner| random.triangle(corner, CELL.map(|v| v - 2.0), [570.0, 630.0]))
        .collect()
}

/// Near triangles, then the same ones wholly hidden.
fn hidden(random: &mut Random) -> Vec<Vertex> {
    let cells = in_cells(random);
    let mut vertices = Vec::new();
    for [near, far] in [[0.2, 0.4], [0.6, 0.8]] {
        for &corner in cells.iter().flatten() {
            let z = random.within(near, far);
            vertices.push(vertex(corner, z, random.color()));
        }
    }
    vertices
}

/// Far triangles, then others before them; distance varies by 2.4 to 3 within each.
fn textured(random: &mut Random) -> Vec<Vertex> {
    let mut vertices = Vec::new();
    for nearest in [3.3, 1.0] {
        for corners in in_cells(random) {
            let farthest = random.within(2.4, 3.0);
            let mut distances =
                [1.0, farthest, random.within(1.0, farthest)].map(|w| (w * nearest * 256.0).round() / 256.0);
            distances.rotate_left((random.next() % 3) as usize);
            for (corner, w) in corners.into_iter().zip(distances) {
                // Between planes at 1 and 10.
                let z = (1.0 - 1.0 / w) / 0.9;
                let [x, y] = corner;
                let [u, v] = [(); 2].map(|()| random.on_grid(0.0, 1.0, 1024.0));
                vertices.push([x, y, z, w, 255.0, 255.0, 255.0, u, v]);
            }
        }
    }
    vertices
}

/// Two thousand of about ten pixels.
fn small(random: &mut Random) -> Vec<Vertex> {
    const SIDE: f64 = 8.75;
    let mut vertices = Vec::new();
    for _ in 0..2_000 {
        let corner = [f64::from(WIDTH), f64::from(HEIGHT)].map(|side| random.within(0.5, side - 0.5 - SIDE));
        let z = random.within(0.1, 0.9);
        for corner in random.triangle(corner, [SIDE; 2], [9.0, 11.0]) {
            let z = random.within(z - 0.04, z + 0.04);
            vertices.push(vertex(corner, z, random.color()));
        }
    }
    vertices
}

/// Two hundred of all sizes up to 130 pixels, on a grid of so many steps in a pixel, a shift beside it.
fn coverage(random: &mut Random, steps: f64, shift: f64) -> Vec<Vertex> {
    let mut vertices = Vec::new();
    while vertices.len() < 600 {
        let size = random.within(3f64.ln(), 130f64.ln()).exp();
        let corner = [f64::from(WIDTH), f64::from(HEIGHT)].map(|side| random.within(1.0, side - 2.0 - size));
        let triangle = [(); 3].map(|()| corner.map(|v| random.on_grid(v, v + size, steps) + shift));
        if -area(&triangle) >= 1.0 {
            vertices.extend(triangle.map(|corner| vertex(corner, 0.5, [255.0; 3])));
        }
    }
    vertices
}

/// Cells with shaken corners, two triangles each, that tile the picture.
fn mesh(random: &mut Random) -> Vec<Vertex> {
    let [columns, rows] = MESH;
    let steps = [f64::from(WIDTH) / columns as f64, f64::from(HEIGHT) / rows as f64];
    let mut shaken = |i: usize, cells: usize, step: f64| {
        let inside = i > 0 && i < cells;
        let by = random.on_grid(-6.0, 6.0, 16.0);
        i as f64 * step + if inside { by } else { 0.0 }
    };
    let points: Vec<_> = (0..(columns + 1) * (rows + 1))
        .map(|i| {
            let (column, row) = (i % (columns + 1), i / (columns + 1));
            [shaken(column, columns, steps[0]), shaken(row, rows, steps[1])]
        })
        .collect();
    let at = |column: usize, row: usize| points[row * (columns + 1) + column];
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    cells
        .flat_map(|(x, y)| {
            let [a, b, c, d] = [at(x, y), at(x, y + 1), at(x + 1, y), at(x + 1, y + 1)];
            [a, b, c, c, b, d].map(|corner| vertex(corner, 0.5, [255.0; 3]))
        })
        .collect()
}

/// A ball with bumps, before the camera.
fn ball(random: &mut Random) -> Value {
    let [rings, around] = BALL;
    let waves = [(); 3].map(|()| (random.within(2.0, 6.0).round(), random.within(0.0, 6.0)));
    let radius = |latitude: f64, longitude: f64| {
        let bumps = waves
            .iter()
            .map(|(n, phase)| (n * longitude + phase).cos() * (2.0 * latitude).sin().powi(2));
        0.42 * (1.0 + 0.03 * bumps.sum::<f64>())
    };
    let mut normals = vec![[0.0, 1.0, 0.0]];
    let mut positions = vec![[0.0, radius(0.0, 0.0), 0.0]];
    for i in 0..rings * around {
        let latitude = std::f64::consts::PI * (i / around + 1) as f64 / (rings + 1) as f64;
        let longitude = std::f64::consts::TAU * (i % around) as f64 / around as f64;
        let (sin, cos) = latitude.sin_cos();
        let direction = [sin * longitude.cos(), cos, sin * longitude.sin()];
        // Of the ball without bumps: light is to be computed, not admired.
        normals.push(direction);
        positions.push(direction.map(|v| v * radius(latitude, longitude)));
    }
    normals.push([0.0, -1.0, 0.0]);
    positions.push([0.0, -radius(0.0, 0.0), 0.0]);
    json!({
        "positions": positions,
        "normals": normals,
        "triangles": ball_triangles(),
        "model_view": turned(random.within(-0.6, 0.6), 0.26, -2.6),
        "projection": [[1.810_660_2, 0, 0, 0], [0, 2.414_213_6, 0, 0], [0, 0, -1.222_222_2, -2.222_222_2], [0, 0, -1, 0]],
        "light_eye": [0.398_014_9, 0.597_022_3, 0.696_526],
    })
}

/// Counter-clockwise from outside.
fn ball_triangles() -> Vec<[usize; 3]> {
    let [rings, around] = BALL;
    let at = |ring: usize, i: usize| 1 + ring * around + i % around;
    let last = 1 + rings * around;
    let mut triangles = Vec::new();
    for i in 0..around {
        triangles.push([0, at(0, i + 1), at(0, i)]);
        for ring in 1..rings {
            let [a, b] = [at(ring - 1, i), at(ring - 1, i + 1)];
            let [c, d] = [at(ring, i), at(ring, i + 1)];
            triangles.extend([[a, b, c], [c, b, d]]);
        }
        triangles.push([last, at(rings - 1, i), at(rings - 1, i + 1)]);
    }
    triangles
}

/// Turned about y, then about x, and moved away; rows of a matrix.
fn turned(about_y: f64, about_x: f64, away: f64) -> [[f64; 4]; 4] {
    let ((sin_y, cos_y), (sin_x, cos_x)) = (about_y.sin_cos(), about_x.sin_cos());
    [
        [cos_y, 0.0, sin_y, 0.0],
        [sin_x * sin_y, cos_x, -sin_x * cos_y, 0.0],
        [-cos_x * sin_y, sin_x, cos_x * cos_y, away],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_is_always_the_same_file_and_another_another() {
        assert_eq!(from_seed(1), from_seed(1));
        assert_ne!(from_seed(1)["W4"], from_seed(2)["W4"]);
    }

    #[test]
    fn counts_and_winding_are_the_standard_ones() {
        let file = from_seed(7);
        for (key, triangles) in [
            ("W1", 1),
            ("W2", 64),
            ("W3", 64),
            ("W4", 2_000),
            ("coverage_ties", 200),
            ("mesh_grid", 384),
        ] {
            let vertices: Vec<Vertex> = serde_json::from_value(file[key].clone()).unwrap();
            let (all, rest) = vertices.as_chunks::<3>();
            assert_eq!((all.len(), rest.len()), (triangles, 0), "{key}");
            assert!(all.iter().all(|t| area(&t.map(|v| [v[0], v[1]])) < 0.0), "{key}");
        }
    }

    #[test]
    fn the_ball_is_closed_and_looks_outwards() {
        let triangles = ball_triangles();
        assert_eq!(
            (triangles.len(), triangles.iter().flatten().max()),
            (5_776, Some(&2_889))
        );
        let edges = |[a, b, c]: [usize; 3]| [(a, b), (b, c), (c, a)];
        let all: std::collections::HashSet<_> = triangles.iter().flat_map(|&t| edges(t)).collect();
        assert_eq!(all.len(), 3 * triangles.len());
        assert!(all.iter().all(|&(a, b)| all.contains(&(b, a))));

        let ball = ball(&mut Random(3));
        let points: Vec<[f64; 3]> = serde_json::from_value(ball["positions"].clone()).unwrap();
        for [a, b, c] in triangles.into_iter().map(|t| t.map(|i| points[i])) {
            let side = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
            let (u, v) = (side(b), side(c));
            let normal = [
                u[1] * v[2] - u[2] * v[1],
                u[2] * v[0] - u[0] * v[2],
                u[0] * v[1] - u[1] * v[0],
            ];
            assert!(normal.iter().zip(a).map(|(n, p)| n * p).sum::<f64>() > 0.0);
        }
    }
}
