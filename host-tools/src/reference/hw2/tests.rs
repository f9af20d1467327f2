//! The rules of formats/hw2.md section 5 on hand cases.

use super::vertex::Given;
use super::*;
use crate::backend::{BackEnd, Patch, Surface, Vertex};
use crate::reference::byte;
use crate::reference::material::Source;
use crate::reference::matrix::Vector;

const WHITE: Surface = Surface::Flat([1.0; 3]);

fn vertex(position: Vector) -> Vertex {
    Vertex {
        position,
        color: [1.0; 3],
        normal: None,
        texcoord: [0.0; 2],
    }
}

/// Everything, seen from -1 to 1, at depth z.
fn everything(z: f64) -> [Vertex; 3] {
    [[-1.0, -1.0, z, 1.0], [3.0, -1.0, z, 1.0], [-1.0, 3.0, z, 1.0]].map(vertex)
}

fn drawn(draw: impl Fn(&mut Reference)) -> Rendered<Arc<Material>> {
    let mut reference = Reference::new(4, 4);
    draw(&mut reference);
    reference.finish()
}

/// Which primitive won each pixel, rows parted by spaces.
fn winners(draw: impl Fn(&mut Reference)) -> String {
    let picture = drawn(draw);
    let row = |row: &[Pixel]| row.iter().map(|p| p.primitive.to_string()).collect::<String>();
    picture.pixels.chunks(4).map(row).collect::<Vec<_>>().join(" ")
}

const NOTHING: &str = "0000 0000 0000 0000";
const ALL: &str = "1111 1111 1111 1111";

#[test]
fn positions_reach_the_screen_with_y_down() {
    // Corners at (0, 0), (4, 0) and (0, 4) px: the top left half, without its lower right edge.
    let corners = [[-1.0, -1.0, 0.5, 1.0], [1.0, -1.0, 0.5, 1.0], [-1.0, 1.0, 0.5, 1.0]].map(vertex);
    assert_eq!(
        winners(|r| r.triangle(1, corners, WHITE).unwrap()),
        "1111 1110 1100 1000"
    );
}

#[test]
fn negative_w_is_divided_by_and_0_is_not() {
    let scaled = |w: f64| everything(0.5).map(|v| vertex(v.position.map(|c| c * w)));
    assert_eq!(winners(|r| r.triangle(1, scaled(-2.0), WHITE).unwrap()), ALL);
    let mut corners = everything(0.5);
    corners[1].position[3] = 0.0;
    assert_eq!(winners(|r| r.triangle(1, corners, WHITE).unwrap()), NOTHING);
}

#[test]
fn depths_0_and_1_are_in_and_the_later_of_equals_wins() {
    for (z, expected) in [(0.0, ALL), (1.0, ALL), (-1e-12, NOTHING), (1.0 + 1e-12, NOTHING)] {
        assert_eq!(
            winners(|r| r.triangle(1, everything(z), WHITE).unwrap()),
            expected,
            "{z}"
        );
    }
    let two = |first: f64, second: f64| {
        winners(|r| {
            r.triangle(1, everything(first), WHITE).unwrap();
            r.triangle(2, everything(second), WHITE).unwrap();
        })
    };
    assert_eq!(two(0.5, 0.5), ALL.replace('1', "2"));
    assert_eq!(two(0.5, 0.75), ALL);
}

#[test]
fn cull_keeps_what_appears_counter_clockwise() {
    let [a, b, c] = everything(0.5);
    let culled = |corners: [Vertex; 3]| {
        winners(|r| {
            r.cull();
            r.triangle(1, corners, WHITE).unwrap();
        })
    };
    // a, b, c runs clockwise on the screen, y pointing down.
    assert_eq!(culled([a, b, c]), NOTHING);
    assert_eq!(culled([a, c, b]), ALL);
}

#[test]
fn bytes_are_cut_off_and_the_background_is_transparent() {
    let picture = drawn(|r| r.triangle(1, everything(0.5), Surface::Flat([0.5, -1.0, 7.0])).unwrap());
    assert!(picture.bytes().iter().all(|bytes| *bytes == [127, 0, 255, 255]));
    assert!(drawn(|_| {}).bytes().iter().all(|bytes| *bytes == [0; 4]));
    assert_eq!(
        [byte(f64::NAN), byte(f64::INFINITY), byte(254.999 / 255.0)],
        [0, 255, 254]
    );
}

#[test]
fn a_clip_plane_keeps_its_side_and_its_boundary() {
    let cut = |plane: [f64; 4]| {
        winners(|r| {
            r.clip_plane(plane).unwrap();
            r.triangle(1, everything(0.5), WHITE).unwrap();
        })
    };
    // x ≥ 0 is from column 2 on; the left edge of the cut is in.
    assert_eq!(cut([1.0, 0.0, 0.0, 0.0]), "0011 0011 0011 0011");
    assert_eq!(cut([-1.0, 0.0, 0.0, 0.0]), "1100 1100 1100 1100");
    assert_eq!(cut([0.0, 0.0, 1.0, -0.5]), ALL);
    assert_eq!(cut([0.0, 0.0, 0.0, -1.0]), NOTHING);
}

#[test]
fn a_plane_is_turned_by_the_directions_matrix_when_it_is_read() {
    let after = |prepare: &dyn Fn(&mut Reference) -> Result<(), String>| {
        winners(|r| {
            prepare(r).unwrap();
            r.clip_plane([1.0, 0.0, 0.0, 0.5]).unwrap();
            r.load_mv(&Matrix::IDENTITY.0).unwrap();
            r.triangle(1, everything(0.5), WHITE).unwrap();
        })
    };
    let (right, lower) = ("0111 0111 0111 0111", "0000 1111 1111 1111");
    assert_eq!(after(&|_| Ok(())), right);
    assert_eq!(after(&|r| r.translate([9.0, 9.0, 9.0])), right);
    assert_eq!(after(&|r| r.rotate(90.0, [0.0, 0.0, 1.0])), lower);
    // A normal half as long: 0.5 x ≥ -0.5 is everything. Twice as long: 2 x ≥ -0.5; a factor of 0 changes nothing.
    assert_eq!(after(&|r| r.scale([2.0, 1.0, 1.0])), ALL);
    assert_eq!(
        after(&|r| r.scale([0.5, 1.0, 1.0]).and_then(|()| r.scale([0.0, 1.0, 1.0]))),
        "0011 0011 0011 0011"
    );
    let quarter_turn = [
        [0.0, -1.0, 0.0, 5.0],
        [1.0, 0.0, 0.0, 5.0],
        [0.0, 0.0, 1.0, 5.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    assert_eq!(after(&|r| r.mult_mv(&quarter_turn)), lower);
    assert_eq!(after(&|r| r.load_mv(&quarter_turn)), lower);
    assert_eq!(after(&|r| r.load_mv(&[[0.0; 4]; 4])), right);
}

#[test]
fn colours_are_perspective_correct() {
    let mut corners = everything(0.5);
    corners[1].position = corners[1].position.map(|c| 3.0 * c);
    for (corner, red) in corners.iter_mut().zip([0.0, 1.0, 0.0]) {
        corner.color = [red, 0.5, 1.0 - red];
    }
    let picture = drawn(|r| r.triangle(1, corners, Surface::Gouraud).unwrap());
    // Halfway in x (column 2 of 8 px is a quarter): 1/w = 1 - 2/3 · 1/4, red/w = 1/3 · 1/4.
    let [red, green, blue, alpha] = picture.pixels[2].color;
    assert!((red - (1.0 / 12.0) / (5.0 / 6.0)).abs() < 1e-15, "{red}");
    assert!((green - 0.5).abs() < 1e-15 && (red + blue - 1.0).abs() < 1e-15 && alpha == 1.0);
}

#[test]
fn matrices_compose_as_the_text_says() {
    // A vertex at (0, 0): translated by 1 in x after a quarter turn that takes x to y.
    let mut reference = Reference::new(4, 4);
    reference.rotate(90.0, [0.0, 0.0, 1.0]).unwrap();
    reference.translate([1.0, 0.0, 0.0]).unwrap();
    let seen = |reference: &Reference, p: Vector| {
        let material = reference.material(WHITE).unwrap();
        reference.placed(&Given::of(&vertex(p)), &material).corner.eye
    };
    let eye = seen(&reference, [0.0, 0.0, 0.0, 1.0]);
    assert!(eye[0].abs() < 1e-15 && (eye[1] - 1.0).abs() < 1e-15);
    // The eye goes to the origin and the center to -z; both are divided by their w.
    reference
        .look_at([2.0, 0.0, 0.0, 2.0], [8.0, 0.0, 0.0, 2.0], [0.0, 1.0, 0.0])
        .unwrap();
    assert_eq!(seen(&reference, [1.0, 0.0, 0.0, 1.0]), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(seen(&reference, [4.0, 0.0, 0.0, 1.0]), [0.0, 0.0, -3.0, 1.0]);
    assert_eq!(seen(&reference, [1.0, 0.0, 2.0, 1.0]), [2.0, 0.0, 0.0, 1.0]);
}

/// A white sun's light on a triangle in front of the viewer, whose corners run counter-clockwise or not and have normals.
fn lit(surface: Surface, clockwise: bool, normals: [Option<[f64; 3]>; 3], prepare: impl Fn(&mut Reference)) -> f64 {
    let mut corners = everything(0.5);
    if !clockwise {
        corners.swap(1, 2);
    }
    for (corner, normal) in corners.iter_mut().zip(normals) {
        corner.normal = normal;
    }
    let picture = drawn(|r| {
        r.sun([0.0, 0.0, -5.0], [1.0; 3]).unwrap();
        prepare(r);
        r.triangle(1, corners, surface).unwrap();
    });
    let red = picture.pixels[0].color[0];
    assert!(picture.pixels.iter().all(|p| (p.color[0] - red).abs() < 1e-12));
    (red * 1e12).round() / 1e12
}

const SLANTED: Option<[f64; 3]> = Some([3.0, 0.0, -4.0]);

#[test]
fn a_triangle_with_a_vertex_without_normal_uses_its_own() {
    let plain = |_: &mut Reference| {};
    for surface in [WHITE, Surface::Gouraud] {
        assert_eq!(lit(surface, false, [SLANTED; 3], plain), 0.8);
        assert_eq!(lit(surface, false, [SLANTED, SLANTED, None], plain), 1.0);
        // (B - A) x (C - A) of corners that run clockwise on the screen points away from the viewer.
        assert_eq!(lit(surface, true, [None; 3], plain), 0.0);
    }
}

#[test]
fn flatnormals_are_for_flat_surfaces() {
    let flat = |r: &mut Reference| r.flat_normals();
    assert_eq!(lit(WHITE, false, [SLANTED; 3], flat), 1.0);
    assert_eq!(lit(Surface::Gouraud, false, [SLANTED; 3], flat), 0.8);
}

#[test]
fn normals_and_lights_turn_with_the_directions_matrix() {
    let squeezed = |r: &mut Reference| r.scale([0.5, 1.0, 1.0]).unwrap();
    // The normal (3, 0, -4) becomes (6, 0, -4); a triangle half as wide still covers what it covered of the picture.
    let expected = (4.0 / 52f64.sqrt() * 1e12).round() / 1e12;
    let mut wide = Reference::new(1, 1);
    squeezed(&mut wide);
    let placed = |r: &Reference| {
        let given = Given::of(&Vertex {
            normal: SLANTED,
            ..vertex([1.0, 0.0, 0.0, 2.0])
        });
        r.placed(&given, &r.material(WHITE).unwrap()).corner.at
    };
    assert_eq!(placed(&wide).normal, [0.0; 3], "nobody asks without light");
    wide.sun([1.0, 0.0, 0.0], [1.0; 3]).unwrap();
    wide.bulb([2.0, 4.0, 6.0, 2.0], [1.0; 3]).unwrap();
    let at = placed(&wide);
    assert!((-at.normal[2] - expected).abs() < 1e-11);
    assert_eq!(at.eye, [0.25, 0.0, 0.0]);
    assert_eq!(wide.lights[0].source, Source::Sun([1.0, 0.0, 0.0]));
    assert_eq!(wide.lights[1].source, Source::Bulb([0.5, 2.0, 3.0]));
}

#[test]
fn lights_shine_on_what_is_drawn_after_them() {
    let picture = drawn(|r| {
        let halves = [everything(0.5), everything(0.25)];
        r.triangle(1, halves[0], WHITE).unwrap();
        r.sun([0.0, 0.0, 1.0], [0.5; 3]).unwrap();
        r.clip_plane([1.0, 0.0, 0.0, 0.0]).unwrap();
        r.triangle(2, halves[1], WHITE).unwrap();
    });
    let row: Vec<f64> = picture.pixels[..4].iter().map(|p| p.color[0]).collect();
    assert_eq!(row, [1.0, 1.0, 0.5, 0.5]);
}

#[test]
fn texture_coordinates_are_perspective_correct() {
    // Four texels in a row, red 0, 10, 20, 30; s from 0 at the left to 1 at 8 px, where w is 3.
    let texture = Arc::new(Picture::new(4, 1, (0..4).map(|i| [10 * i, 0, 0, 255]).collect()));
    let mut corners = everything(0.5);
    corners[1].position = corners[1].position.map(|c| 3.0 * c);
    corners[1].texcoord = [1.0, 0.0];
    let picture = drawn(|r| {
        assert!(r.triangle(1, corners, Surface::Textured).is_err(), "no texture yet");
        r.texture(&texture).unwrap();
        r.triangle(1, corners, Surface::Textured).unwrap();
    });
    // At x/8 = a: s = (a/3) / (1 - 2a/3), so 0, 1/22, 1/10, 1/6; texel 1 begins at 1/8.
    let reds: Vec<u8> = picture.bytes()[..4].iter().map(|p| p[0]).collect();
    assert_eq!(reds, [0, 0, 0, 10]);
}

/// A flat square patch over the whole picture, seen from in front if s and t run like x and y.
fn patch(z: f64) -> [Vertex; 16] {
    std::array::from_fn(|k| {
        let [x, y] = [k % 4, k / 4].map(|c| c as f64 * 1.5 - 1.0);
        Vertex {
            normal: SLANTED,
            ..vertex([x, y, z, 1.0])
        }
    })
}

#[test]
fn a_patch_draws_numbered_triangles_without_gaps() {
    let picture = drawn(|r| r.patch(5, 1, Patch::Rectangular(&patch(0.5)), WHITE).unwrap());
    let numbers: Vec<u32> = picture.polygons.iter().map(|p| p.outline.primitive).collect();
    assert_eq!(numbers, (5..13).collect::<Vec<_>>());
    assert!(picture.pixels.iter().all(|p| (5..13).contains(&p.primitive)));
    assert!(picture.polygons[0].outline.outer.iter().all(|c| c.reach < 0.003));
}

#[test]
fn a_lit_patch_has_its_own_normals() {
    let shade = |direction: f64, points: [Vertex; 16], flat: bool| {
        let picture = drawn(|r| {
            r.sun([0.0, 0.0, direction], [1.0; 3]).unwrap();
            if flat {
                r.flat_normals();
            }
            r.patch(1, 1, Patch::Rectangular(&points), WHITE).unwrap();
        });
        picture.pixels[0].color[0]
    };
    // d/ds x d/dt with y down points away from the viewer, whatever the vertices' normals.
    assert_eq!(shade(1.0, patch(0.5), false), 1.0);
    assert_eq!(shade(-1.0, patch(0.5), false), 0.0);
    // A hill, its border flat: the normal at the corner is (1.5, 1.5, -0.5) x (-1.5, 1.5, 0), the first triangle's is not.
    let mut hill = patch(0.5);
    for k in [5, 6, 9, 10] {
        hill[k].position[2] = 0.0;
    }
    let (smooth, flat) = (shade(1.0, hill, false), shade(1.0, hill, true));
    let expected = 4.5 / (0.75f64.powi(2) * 2.0 + 4.5f64.powi(2)).sqrt();
    assert!((smooth - expected).abs() < 1e-15 && flat == 1.0, "{smooth} {flat}");
}
