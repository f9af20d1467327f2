//! The rules of formats/iv.md on hand cases.

use super::*;
use crate::scene::iv::parse;

fn drawn(text: &str, shading: Shading, side: u32) -> Rendered<()> {
    draw(&Scene {
        width: side,
        height: side,
        output: "out.ppm".into(),
        shading,
        eyelight: false,
        model: parse(text).expect("a model"),
    })
}

/// Which primitive won each pixel, rows parted by spaces.
fn winners(text: &str) -> String {
    let picture = drawn(text, Shading::Flat, 4);
    let row = |row: &[Pixel]| row.iter().map(|p| p.primitive.to_string()).collect::<String>();
    picture.pixels.chunks(4).map(row).collect::<Vec<_>>().join(" ")
}

/// At z = -2 the camera sees from -2 to 2, so that one of four pixels is a unit.
const CAMERA: &str = "PerspectiveCamera { position 0 0 0 }";
const NOTHING: &str = "0000 0000 0000 0000";

/// A face whose corners all have a normal towards +z.
fn face(points: &[[f64; 3]]) -> String {
    let list: String = points.iter().map(|[x, y, z]| format!("{x} {y} {z},")).collect();
    let indices: String = (0..points.len()).map(|i| format!("{i},")).collect();
    let zeroes = "0,".repeat(points.len());
    format!(
        "Separator {{ Coordinate3 {{ point [ {list} ] }} Normal {{ vector [ 0 0 1 ] }} \
         IndexedFaceSet {{ coordIndex [ {indices} -1 ] normalIndex [ {zeroes} -1 ] }} }}"
    )
}

/// Triangles below and above the diagonal from the lower left.
fn square(half: f64, z: f64) -> String {
    face(&[[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]])
}

#[test]
fn y_points_up_and_pixels_are_sampled_in_the_middle() {
    // The lower left half: the diagonal passes through the middles of pixels and is its right edge.
    let half = face(&[[-2.0, -2.0, -2.0], [2.0, -2.0, -2.0], [-2.0, 2.0, -2.0]]);
    assert_eq!(winners(&format!("{CAMERA} {half}")), "0000 1000 1100 1110");
    let other = face(&[[2.0, -2.0, -2.0], [2.0, 2.0, -2.0], [-2.0, 2.0, -2.0]]);
    assert_eq!(winners(&format!("{CAMERA} {half} {other}")), "2222 1222 1122 1112");
}

#[test]
fn left_and_top_edges_through_the_middle_are_in() {
    assert_eq!(
        winners(&format!("{CAMERA} {}", square(1.5, -2.0))),
        "2220 2210 2110 0000"
    );
}

#[test]
fn only_counter_clockwise_triangles_are_drawn_and_all_are_counted() {
    let back = face(&[
        [-2.0, -2.0, -2.0],
        [-2.0, 2.0, -2.0],
        [2.0, 2.0, -2.0],
        [2.0, -2.0, -2.0],
    ]);
    assert_eq!(winners(&format!("{CAMERA} {back}")), NOTHING);
    let front = face(&[[-9.0, -9.0, -3.0], [27.0, -9.0, -3.0], [-9.0, 27.0, -3.0]]);
    assert_eq!(winners(&format!("{CAMERA} {back} {front}")), NOTHING.replace('0', "3"));
    let line = face(&[[-2.0, -2.0, -2.0], [0.0, 0.0, -2.0], [2.0, 2.0, -2.0]]);
    assert_eq!(winners(&format!("{CAMERA} {line}")), NOTHING);
    // A mirrored window makes backs of fronts.
    let mirrored = "PerspectiveCamera { position 0 0 0 left 1 right -1 }";
    assert_eq!(winners(&format!("{mirrored} {}", square(2.0, -2.0))), NOTHING);
    assert!(!winners(&format!("{mirrored} {back}")).contains('0'));
}

#[test]
fn the_nearer_wins_and_the_earlier_of_equals() {
    let (near, far) = (square(1.5, -2.0), square(4.0, -4.0));
    for (scene, expected) in [
        (format!("{near} {far}"), "2223 2213 2113 3333"),
        (format!("{far} {near}"), "4441 4431 4331 1111"),
        (format!("{near} {near}"), "2220 2210 2110 0000"),
    ] {
        assert_eq!(winners(&format!("{CAMERA} {scene}")), expected);
    }
}

#[test]
fn the_far_plane_is_in_and_depths_reach_from_minus_1_to_1() {
    for (z, depth) in [(-1.0, Some(-1.0)), (-10.0, Some(1.0)), (-0.999, None), (-10.001, None)] {
        let picture = drawn(&format!("{CAMERA} {}", square(100.0, z)), Shading::Flat, 2);
        for pixel in picture.pixels {
            match depth {
                Some(depth) => assert!(
                    pixel.primitive > 0 && (pixel.depth - depth).abs() < 1e-12,
                    "{z}: {pixel:?}"
                ),
                None => assert_eq!((pixel.primitive, pixel.depth), (0, 1.0), "{z}"),
            }
        }
    }
}

#[test]
fn a_floor_that_runs_behind_the_camera_leaves_the_sky_alone() {
    let floor = face(&[
        [-50.0, -0.5, 20.0],
        [50.0, -0.5, 20.0],
        [50.0, -0.5, -9.0],
        [-50.0, -0.5, -9.0],
    ]);
    let picture = winners(&format!("{CAMERA} {floor}"));
    assert_eq!(&picture[..9], "0000 0000");
    // The window's lower edge sees the near plane's floor at y = -0.5, two rows of four down to y = -1 see half of it.
    assert!(
        picture[10..14].chars().all(|c| c != '0') && picture.ends_with("0000"),
        "{picture}"
    );
    // From below one looks at its back.
    let ceiling = floor.replace("-0.5", "0.5");
    assert_eq!(winners(&format!("{CAMERA} {ceiling}")), NOTHING);
}

/// Two lights and a face that slants from near the camera into the distance.
fn slanting(near: f64) -> String {
    format!(
        "PerspectiveCamera {{ position 0 0 0 nearDistance {near} left -{near} right {near} bottom -{near} top {near} }}
         PointLight {{ location 1 0 0 color 1 .5 0 }} PointLight {{ location -3 1 -4 color 0 .25 1 }} {}",
        face(&[[-0.4, -0.4, -0.5], [3.0, 0.0, -3.0], [-1.0, 2.0, -4.0]])
    )
}

#[test]
fn clipping_changes_no_pixel_that_stays() {
    for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
        let (whole, cut) = (drawn(&slanting(0.25), shading, 64), drawn(&slanting(1.0), shading, 64));
        let mut gone = 0;
        let mut stayed = 0;
        for (whole, cut) in whole.pixels.iter().zip(&cut.pixels) {
            let near = whole.color.iter().zip(cut.color).all(|(a, b)| (a - b).abs() < 1e-12);
            match (whole.primitive, cut.primitive) {
                (1, 0) => gone += 1,
                (whole, cut) => {
                    assert_eq!(whole, cut);
                    stayed += cut;
                    assert!(near, "{shading:?}");
                }
            }
        }
        assert!(gone > 100 && stayed > 100, "{shading:?}: {gone} gone, {stayed} stayed");
    }
}

#[test]
fn flat_is_one_color_for_a_face_and_not_for_a_triangle() {
    let light = "PointLight { location 1 1 0 }";
    let picture = drawn(&format!("{CAMERA} {light} {}", square(2.0, -2.0)), Shading::Flat, 4);
    let first = picture.pixels[0].color;
    assert!(picture.pixels.iter().all(|pixel| pixel.color == first));
    assert!(picture.pixels.iter().any(|pixel| pixel.primitive == 1) && picture.pixels[0].primitive == 2);
    // The mean position is (0, 0, -2), (1, 1, 2) away from the light: 0.2 + 0.8 cos.
    assert!((first[0] - (0.2 + 0.8 * 2.0 / 6f64.sqrt())).abs() < 1e-15, "{first:?}");
}

#[test]
fn gouraud_is_linear_over_the_screen_and_phong_over_space() {
    // The right end is three times as far away, and the light beside the left end.
    let face = face(&[
        [-2.0, -2.0, -2.0],
        [6.0, -6.0, -6.0],
        [6.0, 6.0, -6.0],
        [-2.0, 2.0, -2.0],
    ]);
    let text = format!("{CAMERA} PointLight {{ location -2 0 0 }} {face}");
    let middle = |shading| {
        let picture = drawn(&text, shading, 65);
        picture.pixels[32 * 65 + 32].color[0]
    };
    let lit = |position: [f64; 3]| {
        let [x, y, z] = position;
        let to_light = [-2.0 - x, -y, -z];
        0.2 + 0.8 * unit_or_zero(to_light)[2]
    };
    // All corners on the left see the light at one angle, so do all on the right.
    let mean = (lit([-2.0, 2.0, -2.0]) + lit([6.0, 6.0, -6.0])) / 2.0;
    assert!((middle(Shading::Gouraud) - mean).abs() < 1e-12);
    // Half way on the screen is a quarter of the way in space, weighted by 1/w: (2·6 : 6·2 over 2 + 6) x = 0, z = -3.
    assert!((middle(Shading::Phong) - lit([0.0, 0.0, -3.0])).abs() < 1e-12);
}

#[test]
fn numbers_that_overflow_draw_nothing() {
    for (scene, shading) in [
        (
            face(&[[-1e308, -1e308, -2.0], [1e308, -1e308, -2.0], [0.0, 1e308, -2.0]]),
            Shading::Phong,
        ),
        (square(1e300, -1e300), Shading::Gouraud),
        (square(1.0, 1e308), Shading::Flat),
    ] {
        for scale in ["1 1 1", "1e308 1e308 1e308", "-1e-308 1e308 1e-308"] {
            let scene = scene.replace(
                "Coordinate3",
                &format!("Transform {{ scaleFactor {scale} }} Coordinate3"),
            );
            let text = format!("PerspectiveCamera {{ position 1e308 -1e308 1e308 }} PointLight {{ }} {scene}");
            let picture = drawn(&text, shading, 8);
            assert!(
                picture
                    .pixels
                    .iter()
                    .all(|pixel| pixel.color.iter().all(|c| c.is_finite()))
            );
        }
    }
}

#[test]
fn a_corner_far_away_does_not_turn_a_triangle() {
    // A corner of whole numbers below 2^40 and two of some below 2^14 that lie side by side: exact in 128 bits.
    let mut state = 1_u64;
    let mut within = |bits: u32| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> (63 - bits)) as i64 - (1 << bits)
    };
    let (mut front, mut back) = (0, 0);
    for far in 14..40 {
        for _ in 0..40 {
            let b = [0; 3].map(|_| i128::from(within(13)));
            let c = b.map(|coordinate| coordinate + i128::from(within(3)));
            let a = [0; 3].map(|_| i128::from(within(far)));
            let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
            let determinant = a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1);
            // What float64 rounds of products as large as these.
            if determinant.abs() < 1 << (far + 26 - 40) {
                continue;
            }
            let clip = |v: [i128; 3]| [v[0] as f64, v[1] as f64, 0.0, v[2] as f64];
            let mut corners = [a, b, c].map(clip);
            for _ in 0..3 {
                assert_eq!(faces_camera(corners), determinant > 0, "{corners:?}");
                corners.rotate_left(1);
            }
            if determinant > 0 { front += 1 } else { back += 1 }
        }
    }
    assert!(front > 400 && back > 400, "{front} {back}");
}
