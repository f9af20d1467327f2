//! The rules of formats/mp1.md on hand cases.

use std::sync::Arc;

use super::*;
use crate::picture::Picture;
use crate::scene::mp1::parse_with;

/// Four texels: red, green / blue, white at half alpha.
fn texture() -> Picture {
    let texels = [
        [255, 0, 0, 255],
        [0, 255, 0, 255],
        [0, 0, 255, 255],
        [255, 255, 255, 51],
    ];
    Picture::new(2, 2, texels.to_vec())
}

/// A picture of 8 x 8, on which x and y of −1, −0.75, … 1 are 0, 1, … 8.
fn drawn(scene: &str) -> Rendered {
    sized(8, 8, scene)
}

fn sized(width: u32, height: u32, scene: &str) -> Rendered {
    let text = format!("png {width} {height} a.png\n{scene}");
    let scene = parse_with(text.as_bytes(), &mut |_| Ok(Arc::new(texture())));
    draw(&scene.expect("a good scene"))
}

/// Which primitive drew each sample last, rows parted by spaces.
fn winners(picture: &Rendered) -> String {
    let row = |row: &[Sample]| row.iter().map(|s| s.primitive.to_string()).collect::<String>();
    let width = (picture.width * picture.fsaa) as usize;
    picture
        .samples
        .chunks(width)
        .map(row)
        .collect::<Vec<_>>()
        .join(" ")
        .replace('0', ".")
}

/// Vertices by their place in pixels of the picture of 8 x 8, at depth z, w = 1.
fn vertices(places: &[[f64; 2]], z: f64) -> String {
    let vertex = |[x, y]: &[f64; 2]| format!("xyzw {} {} {z} 1\n", x / 4.0 - 1.0, y / 4.0 - 1.0);
    places.iter().map(vertex).collect()
}

/// A triangle over the whole picture, clockwise on the screen.
fn everything(z: f64) -> String {
    vertices(&[[0.0, 0.0], [16.0, 0.0], [0.0, 16.0]], z) + "tri -3 -2 -1\n"
}

const NOTHING: &str = "........ ........ ........ ........ ........ ........ ........ ........";

fn all(winner: u32) -> String {
    NOTHING.replace('.', &winner.to_string())
}

#[test]
fn the_example_of_the_format() {
    let picture = sized(20, 30, "xyzw 1 3.5 3 4\nxyzw -1 -2 -3 4\nxyzw 2 0 0 2\ntri 1 2 3");
    let winners = winners(&picture);
    let rows: Vec<&str> = winners.split(' ').collect();
    assert!(rows[..8].iter().all(|row| !row.contains('1')));
    assert_eq!(rows[8], "........1...........");
    assert_eq!(rows[9], "........11..........");
    assert_eq!(rows[15], "..........1111111111");
    // Row 27 runs from 12.227… to 13.142…; row 28 from 12.469… to 12.571…, between two samples.
    assert_eq!(rows[27], ".............1......");
    assert!(rows[28..].iter().all(|row| !row.contains('1')));
}

#[test]
fn depths_from_minus_1_to_1_are_drawn_and_the_later_of_equals_wins() {
    let switch = |z: f64| winners(&drawn(&format!("depth\n{}", everything(z))));
    assert_eq!([-1.0, 1.0].map(switch), [all(1), all(1)]);
    assert_eq!([-1.001, 1.001].map(switch), [NOTHING, NOTHING]);
    assert_eq!(winners(&drawn(&everything(7.0))), all(1));
    let two = |switch: &str, a, b| winners(&drawn(&format!("{switch}\n{}{}", everything(a), everything(b))));
    assert_eq!(two("depth", 0.5, 0.5), all(2));
    assert_eq!(two("depth", 0.5, 0.75), all(1));
    assert_eq!(two("", 0.5, 0.75), all(2));
}

#[test]
fn a_fragment_stores_its_depth_whatever_its_alpha() {
    let scene = format!(
        "depth\nrgba 9 9 9 0\n{}rgb 255 0 0\n{}",
        everything(0.0),
        everything(0.5)
    );
    let picture = drawn(&scene);
    assert_eq!(winners(&picture), all(1));
    assert!(
        picture
            .samples
            .iter()
            .all(|s| (s.depth, s.alpha, s.color) == (0.0, 0.0, [0.0; 3]))
    );
    assert!(drawn(&everything(0.0)).samples.iter().all(|s| s.depth == 1.0));
}

#[test]
fn cull_keeps_what_looks_counter_clockwise() {
    assert_eq!(winners(&drawn(&format!("cull\n{}", everything(0.0)))), NOTHING);
    assert_eq!(winners(&drawn(&format!("cull\n{}tri 1 3 2", everything(0.0)))), all(2));
}

#[test]
fn w_of_0_is_not_drawn_and_a_negative_one_is_divided_by() {
    let corners = |w: i32, last: i32| {
        format!(
            "xyzw {a} {a} 0 {w}\nxyzw {b} {a} 0 {w}\nxyzw {a} {b} 0 {last}\ntri 1 2 3",
            a = -w,
            b = 3 * w
        )
    };
    assert_eq!(winners(&drawn(&corners(1, 1))), all(1));
    assert_eq!(winners(&drawn(&corners(-2, -2))), all(1));
    assert_eq!(winners(&drawn(&corners(-2, 0))), NOTHING);
    assert_eq!(winners(&drawn(&format!("frustum\n{}", corners(-2, -2)))), NOTHING);
    // One corner left with w = 0 and the whole primitive is gone, though one triangle of its fan has none.
    let cut = "clipplane 1 0 0 1\nxyzw -5 -1 0 1\nxyzw 3 -1 0 1\nxyzw 1 1 0 0\ntri 1 2 3";
    assert_eq!(winners(&drawn(cut)), NOTHING);
}

#[test]
fn clip_planes_are_for_triangles_and_the_frustum_for_all() {
    let others = vertices(&[[1.0, 1.0], [5.0, 1.0]], 1.5) + "point 2 1\nline 1 2\nwuline 1 2\ncircle 2 2\n";
    let clipped = |switch: &str, shapes: &str| winners(&drawn(&format!("{switch}\n{shapes}")));
    assert_eq!(clipped("clipplane 0 0 -1 1", &everything(1.5)), NOTHING);
    assert_eq!(clipped("clipplane 0 0 -1 1", &others), clipped("", &others));
    assert_ne!(clipped("", &others), NOTHING);
    assert_eq!(clipped("frustum", &everything(1.5)), NOTHING);
    assert_eq!(clipped("frustum", &others), NOTHING);
    // x ≥ 0 is from column 4 on; the second plane takes the lower half.
    let corner = "clipplane 1 0 0 0\nclipplane 0 -1 0 0";
    let upper = "....1111 ....1111 ....1111 ....1111 ........ ........ ........ ........";
    assert_eq!(clipped(corner, &everything(0.0)), upper);
}

#[test]
fn the_frustum_cuts_lines_and_drops_points_by_their_centre() {
    // Depth 1 is reached half way, at x = 4.
    let line = "xyzw -1 0 0 1\nxyzw 1 0 2 1\nline 1 2\n";
    let clipped = winners(&drawn(&format!("frustum\n{line}")));
    assert_eq!(clipped.split(' ').nth(4), Some("1111...."));
    let point = |x: f64| drawn(&format!("frustum\n{}point 4 1", vertices(&[[x, 4.0]], 0.0)));
    assert_eq!(winners(&point(-0.01)), NOTHING);
    assert_eq!(winners(&point(0.0)).split(' ').nth(4), Some("11......"));
}

#[test]
fn a_square_has_its_left_and_top_and_not_its_right_and_bottom() {
    let point = |size: &str, at: [f64; 2]| winners(&drawn(&format!("{}point {size} 1", vertices(&[at], 0.0))));
    assert_eq!(
        point("2", [3.0, 2.0]),
        "........ ..11.... ..11.... ........ ........ ........ ........ ........"
    );
    assert_eq!(point("0", [3.0, 2.0]), NOTHING);
    assert_eq!(point("0.9", [3.5, 2.5]), NOTHING);
    assert_eq!(point("16", [0.0, 0.0]), all(1));
}

#[test]
fn a_disc_has_its_left_and_upper_extreme_point_and_not_the_others() {
    let picture = drawn(&format!("{}circle 4 1", vertices(&[[4.0, 4.0]], 0.0)));
    assert_eq!(
        winners(&picture),
        "........ ........ ....1... ...111.. ..1111.. ...111.. ........ ........"
    );
}

#[test]
fn a_billboard_measures_from_its_exact_corner() {
    let center = vertices(&[[3.7, 4.5]], 0.0);
    let picture = drawn(&format!("decals\ntexture t.png\n{center}billboard 3 1"));
    // Columns 3, 4, 5 are 0.8, 1.8, 2.8 of 3 pixels: 1.03…, 1.7, 2.36… of 2 texels with the half added.
    // Rows 3, 4, 5 are 0, 1, 2 of 3 pixels: 0.5, 1.16…, 1.83….
    let bytes = picture.bytes();
    let row = |row: usize| [2, 3, 4, 5, 6].map(|column| bytes[row * 8 + column]);
    let (none, [red, green, blue, white]) = ([0; 4], [0, 1, 2, 3].map(|i| texture().pixels[i]));
    assert_eq!(row(2), [none; 5]);
    assert_eq!(row(3), [none, green, green, red, none]);
    assert_eq!(row(4), [none, white, white, blue, none]);
    assert_eq!(row(5), row(4));
    assert_eq!(row(6), [none; 5]);
}

#[test]
fn a_line_steps_along_its_longer_axis_and_leaves_out_its_far_end() {
    let line = |a: [f64; 2], b: [f64; 2]| winners(&drawn(&format!("{}line 1 2", vertices(&[a, b], 0.0))));
    // On the other axis 1, 1.5, 2, 2.5: halves go up.
    let flat = "........ .1...... ..11.... ....1... ........ ........ ........ ........";
    assert_eq!(line([1.0, 1.0], [5.0, 3.0]), flat);
    assert_eq!(line([5.0, 3.0], [1.0, 1.0]), flat);
    let steep = "........ .1...... ..1..... ..1..... ...1.... ........ ........ ........";
    assert_eq!(line([1.0, 1.0], [3.0, 5.0]), steep);
    assert_eq!(line([3.0, 5.0], [1.0, 1.0]), steep);
    // As long as wide: along x, so the end at x = 1 is in and the one at x = 3 is out.
    let tie = "........ ........ ..1..... .1...... ........ ........ ........ ........";
    assert_eq!(line([1.0, 3.0], [3.0, 1.0]), tie);
    assert_eq!(line([1.0, 3.0], [1.0, 3.0]), NOTHING);
    assert_eq!(line([-3.0, -0.75], [12.0, -0.75]), NOTHING);
    assert_eq!(
        line([-3.0, -0.5], [12.0, -0.5]),
        NOTHING.replacen("........", "11111111", 1)
    );
}

#[test]
fn an_antialiased_line_shares_its_alpha_between_two_samples() {
    let scene = vertices(&[[1.0, 1.0], [5.0, 3.0]], 0.0);
    let picture = drawn(&format!("rgba 255 0 0 0.5\n{scene}wuline 2 1"));
    let alphas = |row: usize| [1, 2, 3, 4, 5].map(|column| picture.samples[row * 8 + column].alpha);
    assert_eq!(alphas(1), [0.5, 0.25, 0.0, 0.0, 0.0]);
    assert_eq!(alphas(2), [0.0, 0.25, 0.5, 0.25, 0.0]);
    assert_eq!(alphas(3), [0.0, 0.0, 0.0, 0.25, 0.0]);
    // A sample that gets a share of 0 is drawn all the same.
    assert_eq!(picture.samples[2 * 8 + 1].primitive, 1);
}

#[test]
fn a_texture_brings_its_own_alpha_and_decals_a_ground() {
    let triangle = everything(0.0).replace("tri", "trit");
    // Texel (1, 1): white at alpha 0.2, over red.
    let draw = |switch: &str| {
        let scene = format!("{switch}\ntexture t.png\nrgb 255 0 0\ntexcoord 0.5 0.5\n{triangle}");
        drawn(&scene).bytes()[9]
    };
    assert_eq!(draw(""), [255, 255, 255, 51]);
    assert_eq!(draw("decals"), [255, 51, 51, 255]);
    // Texels are not decoded, only encoded.
    let encoded = (255.0 * color::encode(0.2)).floor() as u8;
    // And 1.055 − 0.055 is less than 1 in float64.
    assert_eq!(draw("sRGB\ndecals"), [254, encoded, encoded, 255]);
}

#[test]
fn hyp_interpolates_in_perspective() {
    // Seen along x, from w = 1 at the left end to w = 3 beyond the right one.
    let line = "rgb 0 0 0\nxyzw -1 0 0 1\nrgb 255 255 255\nxyzw 3 0 0 3\nline 1 2";
    let middle = |switch: &str| drawn(&format!("{switch}\n{line}")).samples[4 * 8 + 4].color[0];
    assert_eq!(middle(""), 0.5);
    assert!((middle("hyp") - 0.25).abs() < 1e-15);
}

#[test]
fn bytes_are_cut_off_and_clamped() {
    let byte = |rgb: &str| drawn(&format!("rgb {rgb}\n{}", everything(0.0))).bytes()[0];
    assert_eq!(byte("127.5 254.99 1e300"), [127, 254, 255, 255]);
    assert_eq!(byte("-1 256 0"), [0, 255, 0, 255]);
    assert_eq!(drawn("").bytes(), [[0; 4]; 64]);
}

#[test]
fn samples_are_averaged_by_alpha_before_encoding() {
    // One red sample of four, then one black one beside it.
    let red = "xyzw -1 -1 0 1\nrgb 255 0 0\nxyzw -1 -1 0 1\npoint 0.5 2\n";
    assert_eq!(sized(1, 1, &format!("fsaa 2\n{red}")).bytes(), [[255, 0, 0, 63]]);
    let both = format!("sRGB\nfsaa 2\n{red}rgb 0 0 0\nxyzw 0 -1 0 1\npoint 0.5 3\n");
    let half = (255.0 * color::encode(0.5)).floor() as u8;
    let picture = sized(1, 1, &both);
    assert_eq!(winners(&picture), "12 ..");
    assert_eq!(picture.bytes(), [[half, 0, 0, 127]]);
    assert_eq!(picture.resolved()[0][3], 127.5);
}

#[test]
fn enormous_primitives_cost_what_is_on_the_screen() {
    let far = "xyzw -1e12 -1e12 0 1\nxyzw 3e12 -1e12 0 1\nxyzw -1e12 3e12 0 1\ntri 1 2 3\n";
    assert_eq!(winners(&drawn(far)), all(1));
    assert_eq!(winners(&drawn("xyzw 0 0 0 1\npoint 1e300 1\ncircle 1e300 1")), all(2));
    assert_eq!(winners(&drawn("xyzw 1e12 0 0 1\npoint 1e11 1\ncircle 1e11 1")), NOTHING);
    let lines = "xyzw -1e12 0 0 1\nxyzw 1e12 0 0 1\nline 1 2\nwuline 1 2\n";
    assert_eq!(winners(&drawn(lines)).matches('2').count(), 16);
}

#[test]
fn what_is_no_number_is_left_out() {
    let squares = "xyzw 0 0 0 1\npoint 1.7e308 1\ncircle 1.7e308 1\ntexture t.png\nbillboard 1.7e308 1\n";
    for scene in [
        // Nothing finite after the division, and infinity less infinity on the way.
        "xyzw 1 0 0 1e-310\nxyzw 0 1 0 1\nxyzw 0 0 0 1\ntri 1 2 3\npoint 9 1\nline 1 2\nwuline 2 1",
        "clipplane 1e308 -1e308 0 0\nxyzw 1e10 1e10 0 1\nxyzw 0 0 0 1\nxyzw 0 1 0 1\ntri 1 2 3",
        "sRGB\nrgb 1e300 0 0\nxyzw 0 0 0 1\npoint 9 1\ncircle 9 1",
        "texture t.png\ntexcoord 1.7e308 0\nxyzw -1 -1 0 1\nxyzw -1 3 0 1\ntexcoord -1.7e308 0\nxyzw 3 -1 0 1\ntrit 1 2 3",
        "fsaa 16\nxyzw 1e308 0 0 1\nxyzw 0 0 0 1\nline 1 2\nwuline 1 2",
        &format!("fsaa 16\n{squares}"),
    ] {
        let picture = drawn(scene);
        assert!(picture.samples.iter().all(|s| s.primitive == 0), "{scene}");
        assert_eq!(picture.bytes(), [[0; 4]; 64], "{scene}");
    }
    assert_eq!(winners(&drawn(squares)), all(3));
}

#[test]
fn where_1_over_w_is_no_number_there_is_no_fragment() {
    // 1/w runs from 1 to −1 and is 0 at x = 4.
    let line = "hyp\nxyzw -1 0 0 1\nxyzw -1 0 0 -1\nline 1 2";
    assert_eq!(winners(&drawn(line)).split(' ').nth(4), Some("1111.111"));
    // The same for a triangle, whose texture has no texel there either.
    let triangle = "hyp\ntexture t.png\ntexcoord 3 4\nxyzw -1 -1 0 1\nxyzw -1 1 0 -1\nxyzw -1 1 0 1\ntrit 1 2 3";
    assert_eq!(
        winners(&drawn(triangle)),
        "1111.111 1111.11. 1111.1.. 1111.... 1111.... 111..... 11...... 1......."
    );
}
