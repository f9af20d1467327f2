//! The examples that need nothing but the core: what their pictures show.

#[allow(dead_code)]
#[path = "../examples/hello_triangle.rs"]
mod hello_triangle;

#[allow(dead_code)]
#[path = "../examples/wireframe.rs"]
mod wireframe;

#[test]
fn hello_triangle_is_a_triangle_that_brightens_upwards() {
    let picture = hello_triangle::draw().unwrap();
    let rows: Vec<_> = picture.lines().map(str::trim).collect();
    assert_eq!(rows.len(), 24);
    // 64 columns wide at the bottom, 0 at the top: the samples of row i lie (i + ½)/24 of the way down.
    for (i, row) in rows.iter().enumerate() {
        assert!(row.len().abs_diff((2 * i + 1) * 64 / 48) <= 1, "{i}: {row}");
        assert!(!row.contains(' '), "{i}: {row}");
    }
    // The shade is 4x + 6y of the picture's width and height: 0.2 and 4.1 at the ends of the lowest row, 7.8 and 7.9 in
    // the highest one.
    assert!(rows[23].starts_with('.') && rows[23].ends_with('+'), "{}", rows[23]);
    assert_eq!(rows[0], "%%");
}

#[test]
fn wireframe_is_the_twelve_edges_of_a_cube() {
    let picture = wireframe::draw().unwrap();
    let lit = |x: usize, y: usize| picture[y * wireframe::WIDTH + x];
    // An oracle in floating point: the eight corners, and the twelve edges between those that differ in one sign.
    let project = |p: [f64; 3]| {
        let unit = |v: [f64; 3]| v.map(|c| c / v.iter().map(|c| c * c).sum::<f64>().sqrt());
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
        };
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let z = unit([3.0, 2.0, 4.0]);
        let x = unit(cross([0.0, 1.0, 0.0], z));
        let from_eye = [p[0] - 3.0, p[1] - 2.0, p[2] - 4.0];
        let scale = 64.0 / 35f64.to_radians().tan() / -dot(from_eye, z);
        [
            64.0 + scale * dot(from_eye, x),
            32.0 - scale * dot(from_eye, cross(z, x)),
        ]
    };
    let corners: Vec<[f64; 3]> = (0..8)
        .map(|i| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 1.0 } else { -1.0 }))
        .collect();
    let mut segments = Vec::new();
    for (i, a) in corners.iter().enumerate() {
        let [x, y] = project(*a).map(|c| c.floor() as usize);
        assert!(lit(x, y), "corner {a:?} at {x}, {y}");
        segments.extend(
            (0..3)
                .filter(|k| i >> k & 1 == 0)
                .map(|k| [project(*a), project(corners[i | 1 << k])]),
        );
    }
    assert_eq!(segments.len(), 12);
    let distance = |p: [f64; 2], [a, b]: [[f64; 2]; 2]| {
        let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let square = along[0].powi(2) + along[1].powi(2);
        let t = ((to[0] * along[0] + to[1] * along[1]) / square).clamp(0.0, 1.0);
        (to[0] - t * along[0]).hypot(to[1] - t * along[1])
    };
    // Bresenham's pixels are within half a pixel of the line between the centres of the end pixels, which are within √½
    // of the ends.
    let bound = 0.5 + 0.5f64.sqrt();
    for y in 0..wireframe::HEIGHT {
        for x in 0..wireframe::WIDTH {
            let center = [x as f64 + 0.5, y as f64 + 0.5];
            let nearest = segments.iter().map(|&s| distance(center, s)).fold(f64::MAX, f64::min);
            assert!(!lit(x, y) || nearest <= bound, "{x}, {y}: {nearest}");
        }
    }
    // A line has as many pixels as it has columns or rows, whichever are more; few are shared.
    let steps = |[a, b]: &[[f64; 2]; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
    let whole: f64 = segments.iter().map(steps).sum();
    let drawn = picture.iter().filter(|&&p| p).count() as f64;
    assert!((0.9 * whole..whole + 12.0).contains(&drawn), "{drawn} of {whole}");
}
