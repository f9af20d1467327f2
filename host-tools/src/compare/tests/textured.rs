//! Class *texel*, and colours of texels and decals.

use std::sync::Arc;

use super::*;
use crate::compare::stated::TEXEL_NUDGE;
use crate::picture::Picture;

/// 8 × 4 texels: red tells the column, green the row.
fn board(alpha: u8) -> Arc<Picture> {
    let texels = (0..32u8).map(|k| [20 * (k % 8), 50 * (k / 8), 7, alpha]);
    Arc::new(Picture::new(8, 4, texels.collect()))
}

fn texel(column: u8, row: u8) -> [u8; 4] {
    [20 * column, 50 * row, 7, 255]
}

/// A triangle over pixel (10, 16) with `scale` texels per px, whose texture coordinate there is (s, t) texels.
fn mapped([s, t]: [f64; 2], scale: f64) -> [Vertex; 3] {
    right_of(-20.0, 0.5).map(|vertex| {
        let [x, y] = [0, 1].map(|i| (vertex.position[i] + 1.0) * f64::from(SIZE) / 2.0);
        Vertex {
            texcoord: [(s + scale * (x - 10.0)) / 8.0, (t + scale * (y - 16.0)) / 4.0],
            color: [1.0 - 0.01 * x, 0.5, 0.01 * y],
            ..vertex
        }
    })
}

fn textured(at: [f64; 2], scale: f64) -> Rendered {
    prepared(
        |r| r.texture(&board(0)).unwrap(),
        &[(mapped(at, scale), Surface::Textured)],
    )
}

#[test]
fn a_coordinate_near_a_border_may_pick_the_texel_beyond() {
    for (off, expected) in [(0.5, Class::Texel), (0.99, Class::Texel), (1.02, Class::Unexplained)] {
        for scale in [0.25, 1.0, 2.0] {
            let near = off * (scale * SNAP + TEXEL_NUDGE);
            assert_eq!(class(&textured([2.5 - near, 1.1], scale), texel(3, 1), 1), expected);
            assert_eq!(class(&textured([2.5 + near, 1.1], scale), texel(2, 1), 1), expected);
            assert_eq!(class(&textured([2.1, 1.5 - near], scale), texel(2, 2), 1), expected);
            assert_eq!(
                class(&textured([7.5 - near, -0.5 + near], scale), texel(0, 3), 1),
                expected
            );
        }
    }
}

#[test]
fn no_texel_further_off_is_possible() {
    let near = textured([2.5 - 0.5 * SNAP, 1.1], 1.0);
    for (column, row) in [(1, 1), (4, 1), (3, 2), (3, 0), (2, 2)] {
        assert_eq!(
            class(&near, texel(column, row), 1),
            Class::Unexplained,
            "{column} {row}"
        );
    }
    // A mixture of both, or one level off, is no texel's.
    assert_eq!(class(&near, [50, 50, 7, 255], 1), Class::Unexplained);
    assert_eq!(class(&near, [61, 50, 7, 255], 1), Class::Unexplained);
}

#[test]
fn near_a_corner_of_four_texels_each_is_possible() {
    let near = textured([2.5 - 0.5 * SNAP, 1.5 - 0.5 * SNAP], 1.0);
    for (column, row) in [(3, 1), (2, 2), (3, 2)] {
        assert_eq!(class(&near, texel(column, row), 1), Class::Texel);
    }
    assert_eq!(class(&near, texel(1, 1), 1), Class::Unexplained);
}

#[test]
fn where_delta_spans_many_texels_any_of_them_is_possible() {
    // 1000 texels per px: ±2.76 texels, of the 8 columns and 4 rows.
    let far = textured([2.0, 1.0], 1000.0);
    assert_eq!(class(&far, texel(4, 3), 1), Class::Texel);
    assert_eq!(class(&far, texel(6, 3), 1), Class::Unexplained);
}

#[test]
fn decals_are_over_the_colours_interval() {
    // Half of texel (2, 1), and red falling by 2.55 levels per px, half of which shows: 0.0035 level in δ.
    let decal = |red: f64| {
        let prepare = |r: &mut Reference| {
            r.texture(&board(51)).unwrap();
            r.decals();
        };
        let corners = mapped([2.1, 1.1], 0.1).map(|mut v| {
            v.color[0] += (red - 8.0) / (255.0 * 0.8) - 0.9;
            v
        });
        prepared(prepare, &[(corners, Surface::Textured)])
    };
    // 40 · 0.2 + 0.8 · red.
    let green = ((50.0 + 127.5 * 4.0) / 5.0) as u8;
    let blue = ((7.0 + 0.16 * 255.0 * 4.0) / 5.0) as u8;
    let shown = |red: u8| [red, green, blue, 255];
    assert_eq!(class(&decal(100.999), shown(101), 1), Class::Colour);
    assert_eq!(class(&decal(100.98), shown(101), 1), Class::Unexplained);
    assert_eq!(class(&decal(100.999), shown(103), 1), Class::Unexplained);
}
