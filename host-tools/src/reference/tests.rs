//! The rules of formats/hw2.md section 5 on hand cases.

use super::*;

const WHITE: Surface = Surface::Flat([1.0; 3]);

fn vertex(position: Vector) -> Vertex {
    Vertex {
        position,
        color: [1.0; 3],
    }
}

/// Everything, seen from -1 to 1, at depth z.
fn everything(z: f64) -> [Vertex; 3] {
    [[-1.0, -1.0, z, 1.0], [3.0, -1.0, z, 1.0], [-1.0, 3.0, z, 1.0]].map(vertex)
}

fn drawn(draw: impl Fn(&mut Reference)) -> Rendered {
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
    let corner = reference.eye_corner(&vertex([0.0, 0.0, 0.0, 1.0]), [1.0; 3]);
    assert!(corner.eye[0].abs() < 1e-15 && (corner.eye[1] - 1.0).abs() < 1e-15);
    // The eye goes to the origin and the center to -z; both are divided by their w.
    reference
        .look_at([2.0, 0.0, 0.0, 2.0], [8.0, 0.0, 0.0, 2.0], [0.0, 1.0, 0.0])
        .unwrap();
    let seen = |p: Vector| reference.eye_corner(&vertex(p), [1.0; 3]).eye;
    assert_eq!(seen([1.0, 0.0, 0.0, 1.0]), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(seen([4.0, 0.0, 0.0, 1.0]), [0.0, 0.0, -3.0, 1.0]);
    assert_eq!(seen([1.0, 0.0, 2.0, 1.0]), [2.0, 0.0, 0.0, 1.0]);
}
