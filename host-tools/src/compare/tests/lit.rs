//! Classes *colour* and *steep* under lights.

use super::*;

const WHITE: Surface = Surface::Flat([1.0; 3]);

fn grey(level: u8) -> [u8; 4] {
    [level, level, level, 255]
}

/// A triangle over the picture, its normal given for each column.
fn turned(normal: impl Fn(f64) -> [f64; 3]) -> [Vertex; 3] {
    right_of(-20.0, 0.5).map(|vertex| {
        let column = (vertex.position[0] + 1.0) * f64::from(SIZE) / 2.0;
        Vertex {
            normal: Some(normal(column)),
            ..vertex
        }
    })
}

/// A white surface under a sun that it faces at a cosine of ½, of such a brightness that `level` comes out.
fn shaded(level: f64) -> Rendered {
    let prepare = |r: &mut Reference| r.sun([0.0, 0.0, -1.0], [level / 127.5; 3]).unwrap();
    let normal = [0.75f64.sqrt(), 0.0, -0.5];
    prepared(prepare, &[(turned(|_| normal), WHITE)])
}

#[test]
fn a_lit_colour_may_be_off_by_its_rounding_only() {
    assert_eq!(class(&shaded(100.99998), grey(101), 1), Class::Colour);
    assert_eq!(class(&shaded(100.9998), grey(101), 1), Class::Unexplained);
    assert_eq!(class(&shaded(101.00002), grey(100), 1), Class::Colour);
    for off in [2, 3, 100] {
        assert_eq!(class(&shaded(100.999), grey(100 + off), 1), Class::Unexplained);
    }
    assert_eq!(
        class(&shaded(100.999), grey(0), 1),
        Class::Unexplained,
        "without the light"
    );
}

/// Normals that rise through the sun's horizon at a column: n·l is `slope` per px.
fn rising(column: f64, slope: f64) -> [Vertex; 3] {
    let share = (column + 20.0) / 99.0;
    turned(|x| {
        let along = if x < 0.0 { -share } else { 1.0 - share } * 99.0 * slope;
        [along, 0.0, -(1.0 - along * along).sqrt()]
    })
}

#[test]
fn a_lit_colour_may_be_off_by_gradient_times_delta() {
    // n·l is 0.2 at the pixel and rises by 0.004 per px, which a light of 500 times full makes 500 levels per px of; a negative
    // light in front takes off what is too much.
    let share = |x: f64| (x + 40.0) * 0.004;
    let corners = turned(|x| [share(x), 0.0, -(1.0 - share(x) * share(x)).sqrt()]);
    let with = |side: f64, front: f64| {
        let prepare = |r: &mut Reference| {
            r.sun([1.0, 0.0, 0.0], [side; 3]).unwrap();
            r.sun([0.0, 0.0, -1.0], [front; 3]).unwrap();
        };
        prepared(prepare, &[(corners, WHITE)])
    };
    let value = |lit: &Rendered, x: usize| lit.pixels[16 * SIZE as usize + x].color[0];
    let (side, front) = (value(&with(500.0, 0.0), 10), value(&with(0.0, 1.0), 10));
    let steep = |level: f64| with(500.0, (level / 255.0 - side) / front);
    let moved = 255.0 * (value(&steep(100.5), 11) - value(&steep(100.5), 9)) / 2.0 * SNAP;
    assert!((1.3..1.6).contains(&moved), "{moved}");
    for (off, expected) in [(0.5, Class::Colour), (0.9, Class::Colour), (1.2, Class::Unexplained)] {
        assert_eq!(class(&steep(101.0 - off * moved), grey(101), 1), expected, "{off}");
    }
}

/// A highlight of about 114 levels that begins at a column: c = n·l is 0 there, and k = n·h = 0.447.
fn glinting(column: f64) -> Rendered {
    let prepare = |r: &mut Reference| {
        r.sun([1.0, 0.0, 0.0], [1.0; 3]).unwrap();
        r.shininess(1.0).unwrap();
    };
    prepared(prepare, &[(rising(column, 0.002), WHITE)])
}

#[test]
fn near_its_horizon_a_light_may_be_on_or_off() {
    let on = glinting(10.0 - 0.01).bytes()[16 * SIZE as usize + 10];
    assert!((112..116).contains(&on[0]), "{on:?}");
    for (off, expected) in [(0.5, Class::Steep), (0.98, Class::Steep), (1.1, Class::Unexplained)] {
        assert_eq!(
            class(&glinting(10.0 - off * SNAP), [0, 0, 0, 255], 1),
            expected,
            "{off} on"
        );
        assert_eq!(class(&glinting(10.0 + off * SNAP), on, 1), expected, "{off} off");
    }
    // On or off, but nothing between.
    assert_eq!(class(&glinting(10.0), grey(60), 1), Class::Unexplained);
}

#[test]
fn lights_are_switched_one_by_one() {
    let prepare = |r: &mut Reference| {
        r.sun([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]).unwrap();
        r.sun([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
        r.shininess(1.0).unwrap();
    };
    let both = prepared(prepare, &[(rising(10.0 - 0.5 * SNAP, 0.002), WHITE)]);
    let [on, ..] = both.bytes()[16 * SIZE as usize + 10];
    for rgb in [[on, 0, 0], [0, on, 0], [0, 0, 0]] {
        let [r, g, b] = rgb;
        assert_eq!(class(&both, [r, g, b, 255], 1), Class::Steep, "{rgb:?}");
    }
    assert_eq!(class(&both, [on, on, on, 255], 1), Class::Unexplained);
}

/// A flat root of k = n·h, which is so many 2⁻³⁰, seen from so far off, straight ahead, that moving the corners turns next to nothing. The sun's
/// direction and the one to the eye are at a right angle, and n has a cosine of about 0.7 with the sun's.
fn root(units: f64) -> Rendered {
    let prepare = |r: &mut Reference| {
        r.load_p(&[
            [1e4, 0.0, 0.0, -0.375],
            [0.0, 1e4, 0.0, 0.0],
            [0.0, 0.0, 0.5, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ])
        .unwrap();
        r.sun([1.0, 0.0, 0.0], [1.0; 3]).unwrap();
        r.shininess(0.1).unwrap();
    };
    let small = units / f64::from(1 << 30);
    let normal = [0.5f64.sqrt(), 0.0, 0.5f64.sqrt() - small * 2f64.sqrt()];
    let corners = turned(|_| normal).map(|v| {
        let [x, y, ..] = v.position;
        Vertex {
            position: [(x + 0.375) * 1e-4, y * 1e-4, 1.0, 1.0],
            ..v
        }
    });
    prepared(prepare, &[(corners, Surface::Flat([0.0; 3]))])
}

#[test]
fn a_root_of_next_to_nothing_is_steep() {
    let shown = |units: f64| root(units).bytes()[16 * SIZE as usize + 10][0];
    assert!((30..80).contains(&shown(20.0)), "{}", shown(20.0));
    // The normal and the eye position are known to some dozens of units each.
    assert_eq!(class(&root(20.0), grey(0), 1), Class::Steep);
    assert_eq!(class(&root(200.0), grey(0), 1), Class::Unexplained);
}

/// A textured hill of two triangles under a sun and a bulb, polished.
fn hill(moved: impl Fn(usize) -> [f64; 2], changed: impl Fn(&mut Vertex), bulb: f64) -> Rendered {
    let [a, b, c, d] = [[3.3, 2.1], [29.7, 4.2], [6.4, 28.9], [27.1, 30.3]];
    let corner = |i: usize, [x, y]: [f64; 2]| {
        let [dx, dy] = moved(i);
        let mut vertex = Vertex {
            normal: Some([0.02 * (x - 16.0), 0.02 * (y - 16.0), -1.0]),
            texcoord: [(x + 0.3) / 16.0, (y - 0.4) / 16.0],
            color: [x / 32.0, 0.7, y / 32.0],
            ..at(x, y, 0.5)
        };
        vertex.position[0] += dx / 16.0;
        vertex.position[1] += dy / 16.0;
        changed(&mut vertex);
        vertex
    };
    let texels = (0..64u8)
        .map(|k| [50 + 3 * k, 255 - 3 * k, 90 + 20 * (k % 8), 4 * k])
        .collect();
    let texture = Arc::new(crate::picture::Picture::new(8, 8, texels));
    let prepare = |r: &mut Reference| {
        r.texture(&texture).unwrap();
        r.decals();
        r.sun([0.3, 0.2, -1.0], [0.6, 0.5, 0.4]).unwrap();
        r.bulb([0.5, 0.5, -0.5, 1.0], [bulb; 3]).unwrap();
        r.shininess(20.0).unwrap();
    };
    let triangles = [[(0, a), (1, b), (2, c)], [(3, d), (2, c), (1, b)]];
    let triangles = triangles.map(|t| (t.map(|(i, p)| corner(i, p)), Surface::Textured));
    prepared(prepare, &triangles)
}

/// What is not equal, and what of it is unexplained.
fn judged(picture: &Rendered) -> (u64, u64, Comparison) {
    let own = hill(|_| [0.0; 2], |_| {}, 0.5);
    let comparison = compare(&as_fixed(picture), &own);
    let differing = comparison
        .classes
        .iter()
        .filter(|class| **class != Class::Equal)
        .count() as u64;
    (differing, comparison.unexplained, comparison)
}

#[test]
fn corners_moved_by_less_than_delta_are_explained_and_by_more_are_not() {
    let by = |distance: f64| {
        let moved = move |i: usize| {
            let (sin, cos) = (1.0 + 2.4 * i as f64).sin_cos();
            [distance * cos, distance * sin]
        };
        judged(&hill(moved, |_| {}, 0.5))
    };
    let (differing, unexplained, near) = by(0.95 * SNAP);
    assert_eq!(unexplained, 0, "{:?}", near.explained);
    assert!(differing > 0 && near.explained.colour > 0, "{:?}", near.explained);
    let (differing, unexplained, far) = by(30.0 * SNAP);
    assert!(
        unexplained * 2 > differing,
        "{unexplained} of {differing}, {:?}",
        far.explained
    );
}

#[test]
fn wrong_pictures_are_unexplained() {
    let still = |_: usize| [0.0; 2];
    let wrong = [
        ("without the bulb", hill(still, |_| {}, 0.0)),
        ("a brighter bulb", hill(still, |_| {}, 0.53)),
        (
            "flipped normals",
            hill(still, |v| v.normal = v.normal.map(|n| n.map(|c| -c)), 0.5),
        ),
        (
            "mirrored normals",
            hill(still, |v| v.normal = v.normal.map(|[x, y, z]| [-x, y, z]), 0.5),
        ),
        ("shifted by a texel", hill(still, |v| v.texcoord[0] += 0.125, 0.5)),
        ("colours exchanged", hill(still, |v| v.color.swap(0, 2), 0.5)),
    ];
    for (what, picture) in wrong {
        let (differing, unexplained, comparison) = judged(&picture);
        assert!(differing > 300, "{what}: {differing}");
        assert!(
            unexplained * 20 > differing * 19,
            "{what}: {unexplained} of {differing}, {:?}",
            comparison.explained
        );
    }
}

#[test]
fn a_picture_shifted_by_a_pixel_is_unexplained() {
    let own = hill(|_| [0.0; 2], |_| {}, 0.5);
    let mut fixed = as_fixed(&own);
    fixed.pixels.rotate_right(1);
    let comparison = compare(&fixed, &own);
    let differing = comparison
        .classes
        .iter()
        .filter(|class| **class != Class::Equal)
        .count() as u64;
    assert!(
        comparison.unexplained * 10 > differing * 9,
        "{} of {differing}",
        comparison.unexplained
    );
}
