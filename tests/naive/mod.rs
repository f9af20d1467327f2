//! The obviously correct rasterizer: one exact question per sample. Everything clever is held against it.

#![allow(dead_code, reason = "each test file uses a part of it")]

/// A point in subpixels.
pub type Point = (i32, i32);

/// Twice the signed area of a, b, p: positive where p lies right of a→b, rows running downwards.
fn side(a: Point, b: Point, p: Point) -> i128 {
    let [ax, ay, bx, by, px, py] = [a.0, a.1, b.0, b.1, p.0, p.1].map(i128::from);
    (bx - ax) * (py - ay) - (by - ay) * (px - ax)
}

/// The top-left rule for a→b of a triangle that runs clockwise on a screen with rows downwards: a left edge runs up, a
/// top edge runs right.
fn is_top_left(a: Point, b: Point) -> bool {
    b.1 < a.1 || (b.1 == a.1 && b.0 > a.0)
}

/// Whether the sample of pixel (x, y) is covered: strictly inside, or on a left or top edge.
pub fn covers([a, b, c]: [Point; 3], x: i32, y: i32) -> bool {
    let area = side(a, b, c);
    let [a, b, c] = if area < 0 { [a, c, b] } else { [a, b, c] };
    let p = (x * 256, y * 256);
    area != 0
        && [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| {
            let s = side(from, to, p);
            s > 0 || (s == 0 && is_top_left(from, to))
        })
}

/// The exact value at (x, y) of what is linear over the triangle and v0, v1, v2 at its corners: numerator, denominator.
pub fn value([a, b, c]: [Point; 3], [v0, v1, v2]: [i64; 3], x: i32, y: i32) -> (i128, i128) {
    let p = (x * 256, y * 256);
    let numerator = i128::from(v0) * side(b, c, p) + i128::from(v1) * side(c, a, p) + i128::from(v2) * side(a, b, p);
    let area = side(a, b, c);
    if area < 0 {
        (-numerator, -area)
    } else {
        (numerator, area)
    }
}
