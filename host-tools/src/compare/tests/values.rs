//! Classes *colour*, *depth* and *pole*.

use super::*;

fn grey(level: u8) -> [u8; 4] {
    [level, level, level, 255]
}

#[test]
fn a_flat_colour_may_be_off_by_its_rounding_only() {
    let flat = |level: f64| rendered(&[(right_of(-20.0, 0.5), Surface::Flat([level / 255.0; 3]))]);
    assert_eq!(class(&flat(127.001), grey(126), 1), Class::Colour);
    assert_eq!(class(&flat(127.01), grey(126), 1), Class::Unexplained);
    assert_eq!(class(&flat(127.999), grey(128), 1), Class::Colour);
    assert_eq!(class(&flat(127.99), grey(128), 1), Class::Unexplained);
    assert_eq!(class(&flat(127.001), grey(125), 1), Class::Unexplained);
}

/// A Gouraud triangle whose levels rise by 100 per px, where δ is 0.276 level, with `level` at the pixel. Its right corner
/// is at depth `far`.
fn steep(level: f64, far: f64) -> Rendered {
    let mut corners = right_of(-20.0, 0.5);
    corners[1].position[2] = far;
    let x = |v: &Vertex| (v.position[0] + 1.0) * 16.0;
    rendered(&[(
        corners.map(|v| colored(v, level + 100.0 * (x(&v) - 10.0))),
        Surface::Gouraud,
    )])
}

#[test]
fn a_colour_may_be_off_by_gradient_times_delta() {
    let moved = 100.0 * SNAP;
    // Colours up to 30 times full may have 30 times the rounding: 0.16 level.
    for (off, expected) in [(0.5, Class::Colour), (0.99, Class::Colour), (1.7, Class::Unexplained)] {
        assert_eq!(
            class(&steep(101.0 - off * moved, 0.5), grey(101), 1),
            expected,
            "{off} below"
        );
        assert_eq!(
            class(&steep(100.0 + off * moved, 0.5), grey(99), 1),
            expected,
            "{off} above"
        );
    }
    assert_eq!(class(&steep(100.1, 0.5), grey(98), 1), Class::Unexplained);
}

#[test]
fn a_clipped_polygon_continues_the_plane_of_a_part_of_it() {
    // The depth range cuts off the right corner; of the four that are left, three carry the plane: up to 3 δ, and 4 more where a row
    // is moved to end within their range.
    for (off, expected) in [(6.9, Class::Colour), (7.7, Class::Unexplained)] {
        assert_eq!(
            class(&steep(101.0 - off * 100.0 * SNAP, 1.2), grey(101), 1),
            expected,
            "{off}"
        );
    }
}

#[test]
fn a_colour_never_leaves_the_range_of_the_corners() {
    // A gradient of 200 levels per px, 0.55 level in δ, and the largest value is 100.8, a hair beyond the pixel.
    let top = |x: f64| {
        let low = 100.8 - 200.0 * 50.0;
        let corners = [(x, -40.0, 100.8), (x - 50.0, 16.0, low), (x, 72.0, 100.8)];
        rendered(&[(
            corners.map(|(x, y, level)| colored(at(x, y, 0.5), level)),
            Surface::Gouraud,
        )])
    };
    assert_eq!(class(&top(10.0 + 0.1 * SNAP), grey(101), 1), Class::Unexplained);
    // 99.7 further inside.
    assert_eq!(class(&top(10.0 + 2.0 * SNAP), grey(100), 1), Class::Colour);
}

#[test]
fn perspective_moves_along_its_own_gradient() {
    // 1/w runs from 1 to 1/4 over 64 px, and so does everything that is seen: the gradient grows where w does.
    let wall = |level: f64| {
        let corners = [
            projective(-10.0, -90.0, 0.5, 1.0),
            projective(54.0, 16.0, 0.5, 4.0),
            projective(-10.0, 122.0, 0.5, 1.0),
        ];
        let q = |x: f64| 1.0 - 0.75 * (x + 10.0) / 64.0;
        // A colour of a + b w has the gradient b q'/q² = 2000 at the pixel.
        let here = q(10.0);
        let b = 2000.0 * here * here / (0.75 / 64.0);
        let a = level - b / here;
        let [p, q, r] = corners;
        (
            rendered(&[(
                [colored(p, a + b), colored(q, a + 4.0 * b), colored(r, a + b)],
                Surface::Gouraud,
            )]),
            a + 4.0 * b,
        )
    };
    // The rounding of colours this bright comes on top.
    let (_, brightest) = wall(100.0);
    let rounding = brightest / 255.0 / 256.0 + brightest * 4.0 / 67_108_864.0;
    for (off, expected) in [(0.9, Class::Colour), (1.1, Class::Unexplained)] {
        let (reference, _) = wall(100.0 + off * (2000.0 * SNAP + rounding));
        assert_eq!(class(&reference, grey(99), 1), expected, "{off}");
    }
}

#[test]
fn depths_one_step_apart_may_change_places() {
    let two = |steps: f64| {
        let nearer = 0.5 - steps / 65535.0;
        rendered(&[(right_of(-20.0, 0.5), RED), (right_of(-20.0, nearer), GREEN)])
    };
    assert_eq!(class(&two(0.5), RED_BYTES, 1), Class::Depth);
    assert_eq!(class(&two(1.0), RED_BYTES, 1), Class::Depth);
    // Stepping along a row of 32 px is off by 0.001 steps.
    assert_eq!(class(&two(1.01), RED_BYTES, 1), Class::Unexplained);
    // Neither may vanish.
    assert_eq!(class_if_missing(&two(0.5)), Class::Unexplained);
}

#[test]
fn depths_may_differ_by_gradient_times_delta() {
    // The red one's depth falls by 1/60 per px, 4 steps in δ; the green one is that much nearer at the pixel.
    let two = |off: f64| {
        let z = |x: f64| 0.5 - (x - 10.0) / 60.0;
        let tilted = [
            at(-9.0, -40.0, z(-9.0)),
            at(30.0, 16.0, z(30.0)),
            at(-9.0, 72.0, z(-9.0)),
        ];
        let nearer = 0.5 - 1.0 / 65535.0 - off * SNAP / 60.0;
        rendered(&[(tilted, RED), (right_of(-20.0, nearer), GREEN)])
    };
    assert_eq!(class(&two(0.5), RED_BYTES, 1), Class::Depth);
    assert_eq!(class(&two(0.99), RED_BYTES, 1), Class::Depth);
    assert_eq!(class(&two(1.01), RED_BYTES, 1), Class::Unexplained);
}

#[test]
fn a_winner_behind_a_certain_third_is_not_possible() {
    let step = 1.0 / 65535.0;
    let pile = rendered(&[
        (right_of(-20.0, 0.5), RED),
        (right_of(-20.0, 0.5 - 1.5 * step), GREEN),
        (right_of(-20.0, 0.5 - 2.2 * step), Surface::Flat([0.0, 0.0, 1.0])),
    ]);
    assert_eq!(class(&pile, GREEN_BYTES, 2), Class::Depth);
    assert_eq!(class(&pile, RED_BYTES, 1), Class::Unexplained);
}

/// A triangle of one grey whose 1/w is 0 on the column x, w having both signs.
fn pole(x: f64) -> Rendered {
    let corner = |column: f64, y: f64| colored(projective(column, y, 0.5, 8.0 / (column - x)), 100.0);
    rendered(&[(
        [corner(-20.0, -40.0), corner(60.0, 16.0), corner(-20.0, 72.0)],
        Surface::Gouraud,
    )])
}

#[test]
fn any_colour_goes_at_a_pole_and_only_there() {
    // Within δ of the pole, and the bound of 1/w: 2⁻²⁶ of its largest value in the guard band.
    for (off, expected) in [(0.5, Class::Pole), (0.99, Class::Pole), (1.1, Class::Unexplained)] {
        assert_eq!(class(&pole(10.0 + off * SNAP), grey(7), 1), expected, "{off}");
    }
    assert_eq!(class(&pole(10.0 + 2.0 * SNAP), grey(98), 1), Class::Unexplained);
}

#[test]
fn a_pole_excuses_the_colour_and_not_the_winner() {
    assert_eq!(class_if_missing(&pole(10.0)), Class::Unexplained);
    assert_eq!(class(&pole(10.0), grey(7), 2), Class::Unexplained);
}
