//! Lines: nearest pixels, each once, and a window changes none of them.

use fixel::line::Line;
use fixel::window::Window;
use proptest::prelude::*;

/// The obviously correct line: at every step along the longer axis the nearest pixel, ties down and to the right.
fn naive((ax, ay): (i16, i16), (bx, by): (i16, i16)) -> Vec<(i32, i32)> {
    let [ax, ay, bx, by] = [ax, ay, bx, by].map(i64::from);
    let (dx, dy) = (bx - ax, by - ay);
    let steps = dx.abs().max(dy.abs());
    let nearest = |from: i64, delta: i64, n: i64| (2 * (from * steps + delta * n) + steps).div_euclid(2 * steps);
    (0..steps)
        .map(|n| (nearest(ax, dx, n) as i32, nearest(ay, dy, n) as i32))
        .collect()
}

fn inside(window: Window, pixels: &[(i32, i32)]) -> Vec<(i32, i32)> {
    let holds =
        |&(x, y): &(i32, i32)| (window.left..window.right).contains(&x) && (window.top..window.bottom).contains(&y);
    pixels.iter().copied().filter(holds).collect()
}

const EVERYWHERE: Window = Window::new(-40000, -40000, 40000, 40000);

/// All lines between the pixels of an 11×11 grid, in all windows of a 5×5 one: 14,641 lines, 225 windows each.
#[test]
fn every_small_line_in_every_small_window() {
    let ends: Vec<(i16, i16)> = (0..121).map(|i| (i % 11 - 3, i / 11 - 3)).collect();
    for &a in &ends {
        for &b in &ends {
            let whole = naive(a, b);
            assert_eq!(Line::new(a, b, EVERYWHERE).collect::<Vec<_>>(), whole, "{a:?} to {b:?}");
            for (left, top) in (0..25).map(|i| (i % 5, i / 5)) {
                for (right, bottom) in (0..25)
                    .map(|i| (i % 5 + 1, i / 5 + 1))
                    .filter(|&(r, b)| r > left && b > top)
                {
                    let window = Window::new(left, top, right, bottom);
                    let clipped: Vec<_> = Line::new(a, b, window).collect();
                    assert_eq!(clipped, inside(window, &whole), "{a:?} to {b:?} in {window:?}");
                }
            }
        }
    }
}

proptest! {
    #[test]
    fn any_line_in_any_window(
        a in any::<(i16, i16)>(), b in any::<(i16, i16)>(),
        left in -33000..33000i32, top in -33000..33000i32, width in 0..3000i32, height in 0..3000i32,
    ) {
        let window = Window::new(left, top, left + width, top + height);
        prop_assert_eq!(Line::new(a, b, window).collect::<Vec<_>>(), inside(window, &naive(a, b)));
    }

    /// Backwards, a line lights the same pixels, but for the end that is left out.
    #[test]
    fn backwards_is_the_same(a in any::<(i16, i16)>(), b in any::<(i16, i16)>()) {
        prop_assume!(a != b);
        let mut there: Vec<_> = Line::new(a, b, EVERYWHERE).collect();
        let mut back: Vec<_> = Line::new(b, a, EVERYWHERE).collect();
        there.push((b.0.into(), b.1.into()));
        back.push((a.0.into(), a.1.into()));
        back.reverse();
        prop_assert_eq!(there, back);
    }
}

/// A closed chain draws every joint once.
#[test]
fn joints_are_drawn_once() {
    let corners = [(0, 0), (9, 3), (4, 11), (-6, 5)];
    let mut seen = std::collections::BTreeSet::new();
    for i in 0..4 {
        for pixel in Line::new(corners[i], corners[(i + 1) % 4], EVERYWHERE) {
            assert!(seen.insert(pixel), "{pixel:?} twice");
        }
    }
    assert!(corners.iter().all(|&(x, y)| seen.contains(&(x.into(), y.into()))));
}
