//! The course's conventions, points and lines: items C1–C5 and chapters 00 to 02.

mod course;

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use course::{
    Random, SIDE, Seen, all_near, at, block, buffer, deep, draw, floats, line, lit, near, picture, pixel, program, rgba,
};
use course::{state, unit};
use fixel::blend::{ONE, Rgba};
use fixel::depth::NoDepth;
use fixel::matrix::Matrix;
use fixel::num::{Angle, Block, SineTable};
use fixel::pipeline::{self, Region, State, clip_to_region, from_the_top, get, set};
use fixel::screen::SubPx;
use fixel::target::Buffer;
use fixel::viewport::Viewport;

/// One setting turns y over, and nothing else changes: the picture with row 0 on top is the other one turned over.
#[test]
fn item_c_1_y_is_turned_over_once() {
    let side = SIDE as u16;
    let up = State::new(
        Viewport::<i32>::new(0, 0, side, side)
            .unwrap()
            .y_up()
            .samples_at_centers(),
    );
    let corners = [at((10.3, 20.4), []), at((280.7, 60.1), []), at((100.2, 290.6), [])];
    let ends = [at((5.3, 290.2), []), at((250.1, 8.7), [])];
    let white = program(|_, []: [i32; 0]| Some(1u8));
    let (mut bottom_first, mut top_first) = (picture(0u8), picture(0u8));
    draw(&state(), &mut buffer(&mut bottom_first), &mut NoDepth, &white, &corners);
    pipeline::lines(&state(), &mut buffer(&mut bottom_first), &mut NoDepth, &white, ends);
    draw(&up, &mut buffer(&mut top_first), &mut NoDepth, &white, &corners);
    pipeline::lines(&up, &mut buffer(&mut top_first), &mut NoDepth, &white, ends);
    assert!(from_the_top(&bottom_first, SIDE as usize).eq(top_first.chunks(SIDE as usize)));
    assert!(lit(&top_first).len() > 20_000);
    // Also where ends lie on the borders of pixels: those belong to the upper pixel in y, whichever way rows run.
    let on_borders = [at((5.0, 10.0), []), at((9.0, 10.0), [])];
    let (mut bottom_first, mut top_first) = (picture(0u8), picture(0u8));
    pipeline::lines(
        &state(),
        &mut buffer(&mut bottom_first),
        &mut NoDepth,
        &white,
        on_borders,
    );
    pipeline::lines(&up, &mut buffer(&mut top_first), &mut NoDepth, &white, on_borders);
    assert_eq!(lit(&bottom_first), (5..=9).map(|x| (x, 10)).collect());
    assert_eq!(lit(&top_first), (5..=9).map(|x| (x, 289)).collect());
}

#[test]
fn item_c_2_reading_outside_is_none_and_colors_have_head_room() {
    let mut pixels = [rgba([7.5, -3.0, 1.5, 0.5]); 4];
    let mut image = Buffer::new(&mut pixels, 2, 2).unwrap();
    assert_eq!(get(&mut image, (1, 1)), Some(rgba([7.5, -3.0, 1.5, 0.5])));
    for outside in [(-1, 0), (2, 0), (0, 2), (0, -1), (i32::MIN, i32::MAX)] {
        assert_eq!(get(&mut image, outside), None);
    }
    // Drawn, they survive as well.
    let mut pixels = picture(Rgba::default());
    let bright = program(|_, []: [i32; 0]| Some(rgba([4.0, -2.0, 0.0, 1.0])));
    draw(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &bright,
        &course::square([0.0, 0.0, 9.0, 9.0], 0.0, []),
    );
    assert_eq!(pixel(&pixels, 4, 4), rgba([4.0, -2.0, 0.0, 1.0]));
}

#[test]
fn item_c_3_written_out_clamped_rounded_and_without_alpha() {
    for level in 0..=255u32 {
        for (offset, want) in [(-0.49, level), (0.0, level), (0.49, level)] {
            let v = unit((f64::from(level) + offset) / 255.0);
            let color = Rgba {
                color: [v; 3],
                alpha: 3,
            };
            assert_eq!(color.to_bytes(), [want as u8; 3]);
        }
    }
    assert_eq!(rgba([1.5, -0.5, 0.5, 9.0 / 4.0]).to_bytes(), [255, 0, 128]);
    assert_eq!(
        Rgba {
            color: [i32::MAX, i32::MIN, ONE],
            alpha: 0
        }
        .to_bytes(),
        [255, 0, 255]
    );
}

#[test]
fn item_c_4_columns_from_the_left_and_the_right_hand_rule() {
    // An axis of length 5, which is made 1. The right-hand rule takes x to y about z.
    let turn = Matrix::<i32>::rotation::<SineTable>(Angle::from_degrees(90), block([0.0, 0.0, 5.0])).unwrap();
    all_near(
        floats(turn.transform(block([1.0, 0.0, 0.0, 1.0]))),
        [0.0, 1.0, 0.0, 1.0],
        1e-7,
    );
    // Scaled first, then turned, then moved.
    let object = Matrix::model(block([10.0, 0.0, 0.0]), &turn, block([2.0, 1.0, 1.0]));
    all_near(
        floats(object.transform(block([1.0, 0.0, 0.0, 1.0]))),
        [10.0, 2.0, 0.0, 1.0],
        1e-6,
    );
}

/// Vertices are four numbers; those of the early chapters have w the same for all.
#[test]
fn item_c_5_vertices_have_four_components() {
    let mut pixels = picture(0u8);
    let white = program(|_, []: [i32; 0]| Some(1u8));
    // The same point with w = 1 and w = 7.
    let [a, b, c] = [(10.0, 10.0), (20.0, 10.0), (10.0, 20.0)].map(|p| at(p, []));
    let doubled = (Block::from_integers([-1960, -1960, -2100, 2100]), []);
    all_near(
        floats(doubled.0).map(|v| v / 2100.0),
        floats(a.0).map(|v| v / 300.0),
        1e-9,
    );
    draw(
        &state(),
        &mut buffer(&mut pixels),
        &mut NoDepth,
        &white,
        &[doubled, b, c],
    );
    assert_eq!(pixels, course::triangles_hit(&state(), &[a, b, c]));
}

#[test]
fn item_00_1_a_position_is_in_the_pixel_of_its_floor() {
    let mut pixels = picture(0u8);
    let mut image = buffer(&mut pixels);
    assert!(set(&mut image, (SubPx::lit("10.99"), SubPx::lit("3.01")), 1));
    assert!(!set(&mut image, (SubPx::lit("-0.5"), SubPx::lit("0")), 1));
    assert!(!set(&mut image, (SubPx::lit("0"), SubPx::lit("300")), 1));
    assert_eq!(lit(&pixels), BTreeSet::from([(10, 3)]));
}

#[test]
fn item_00_2_the_chaos_game() {
    let mut pixels = vec![0u8; 257 * 257];
    let mut random = Random(5);
    let points = [(0, 0), (256 << 8, 0), (0, 256 << 8)];
    let (mut x, mut y) = points[0];
    for step in 1..=5000 {
        let (to_x, to_y) = points[random.below(3) as usize];
        (x, y) = ((x + to_x) / 2, (y + to_y) / 2);
        let mut image = Buffer::new(&mut pixels, 257, 257).unwrap();
        assert!(set(
            &mut image,
            (SubPx::from_bits(x), SubPx::from_bits(y)),
            if step > 8 { 1 } else { 2 }
        ));
    }
    let plotted = |x: usize, y: usize| pixels[y * 257 + x] == 1;
    let count = (0..257 * 257).filter(|i| pixels[*i] == 1).count();
    assert!(count > 1000, "{count} points");
    for y in 0..257 {
        for x in 0..257 {
            let hole = x >= 128 && y >= 128 || (64..128).contains(&x) && (64..128).contains(&y);
            assert!(!(hole && plotted(x, y)), "({x}, {y})");
        }
    }
}

#[test]
fn item_01_1_both_ends_are_floored_and_drawn() {
    let want = BTreeSet::from([(2, 3), (3, 3), (4, 4), (5, 4), (6, 5), (7, 5), (8, 6), (9, 6)]);
    assert_eq!(line((2.0, 3.0), (9.0, 6.0)), want);
    assert_eq!(line((9.0, 6.0), (2.0, 3.0)), want);
    assert_eq!(line((2.96875, 3.0), (9.5, 6.75)), want);
    let steep = BTreeSet::from([(5, 1), (5, 2), (4, 3), (4, 4), (4, 5), (4, 6), (3, 7), (3, 8)]);
    assert_eq!(line((5.0, 1.0), (3.0, 8.0)), steep);
}

/// The pixels by the slope: y = floor(the line + ½) at every column of the longer axis, where it is no tie.
fn by_slope((ax, ay): (i32, i32), (bx, by): (i32, i32)) -> Vec<((i32, i32), bool)> {
    let steep = (by - ay).abs() > (bx - ax).abs();
    let turn = |(x, y)| if steep { (y, x) } else { (x, y) };
    let ((ax, ay), (bx, by)) = (turn((ax, ay)), turn((bx, by)));
    let (from, to) = if ax <= bx {
        ((ax, ay), (bx, by))
    } else {
        ((bx, by), (ax, ay))
    };
    let length = to.0 - from.0;
    (from.0..=to.0)
        .map(|x| {
            let doubled = 2 * (x - from.0) * (to.1 - from.1) + length;
            let step = if length == 0 { 0 } else { doubled.div_euclid(2 * length) };
            let tie = length > 0 && doubled.rem_euclid(2 * length) == 0;
            (turn((x, from.1 + step)), tie)
        })
        .collect()
}

#[test]
fn item_01_2_bresenham_is_the_slope_version_but_for_ties() {
    let four_two = line((0.0, 0.0), (4.0, 2.0));
    let bresenham = BTreeSet::from([(0, 0), (1, 0), (2, 1), (3, 1), (4, 2)]);
    let slope = BTreeSet::from([(0, 0), (1, 1), (2, 1), (3, 2), (4, 2)]);
    assert!(four_two == bresenham || four_two == slope);
    for dx in -9..=9 {
        for dy in -9..=9 {
            let drawn = line((20.0, 20.0), (f64::from(20 + dx), f64::from(20 + dy)));
            let want = by_slope((20, 20), (20 + dx, 20 + dy));
            // One pixel in every column.
            assert_eq!(drawn.len(), want.len());
            let certain = want.iter().filter(|(_, tie)| !tie);
            assert!(
                certain.into_iter().all(|(p, _)| drawn.contains(p)),
                "to ({dx}, {dy}): {drawn:?}"
            );
        }
    }
}

#[test]
fn item_01_3_vertical_horizontal_and_one_pixel() {
    assert_eq!(line((7.0, 7.0), (7.0, 7.0)), BTreeSet::from([(7, 7)]));
    assert_eq!(line((3.0, 9.0), (3.0, 2.0)), (2..=9).map(|y| (3, y)).collect());
    assert_eq!(line((3.0, 9.0), (8.0, 9.0)), (3..=8).map(|x| (x, 9)).collect());
}

/// The picture itself is compared in the host tools' `pipeline_pictures`.
#[test]
fn item_01_4_lists_take_vertices_in_pairs() {
    let red = program(|_, []: [i32; 0]| Some(1u8));
    let ray = |i: i32| {
        let angle = TAU * f64::from(i) / 20.0;
        (150.0 + 105.0 * angle.cos(), 150.0 + 105.0 * angle.sin())
    };
    let vertices: Vec<_> = (0..20).flat_map(|i| [at((150.0, 150.0), []), at(ray(i), [])]).collect();
    let mut together = picture(0u8);
    pipeline::lines(&state(), &mut buffer(&mut together), &mut NoDepth, &red, &vertices);
    let one_by_one: BTreeSet<_> = (0..20).flat_map(|i| line((150.0, 150.0), ray(i))).collect();
    assert_eq!(lit(&together), one_by_one);
    assert!(one_by_one.len().abs_diff(1873) <= 8, "{}", one_by_one.len());
    // A last vertex alone is no line.
    let mut odd = picture(0u8);
    pipeline::lines(&state(), &mut buffer(&mut odd), &mut NoDepth, &red, &vertices[..3]);
    assert_eq!(lit(&odd), line((150.0, 150.0), ray(0)));
}

#[test]
fn item_02_1_region_codes() {
    let region = Region {
        left: 60,
        bottom: 60,
        right: 240,
        top: 240,
    };
    let (l, r, t, b) = (Region::LEFT, Region::RIGHT, Region::TOP, Region::BOTTOM);
    assert!([l, r, t, b].iter().all(|bit| bit.count_ones() == 1) && l | r | t | b == 15);
    assert_eq!(region.code((59, 59)), l | b);
    assert_eq!(region.code((60, 240)), 0);
    assert_eq!(region.code((241, 100)), r);
    assert_eq!(region.code((150, 241)), t);
    let nine = [59, 150, 241].map(|y| [59, 150, 241].map(|x| region.code((x, y))));
    assert_eq!(nine, [[l | b, b, r | b], [l, 0, r], [l | t, t, r | t]]);
}

/// In units of 2^-16 px.
fn cut(from: (i32, i32), to: (i32, i32)) -> Option<[(f64, f64); 2]> {
    let screen = Region {
        left: 0,
        bottom: 0,
        right: 299 << 16,
        top: 299 << 16,
    };
    let fine = |(x, y): (i32, i32)| (x << 16, y << 16);
    let real = |v: i32| f64::from(v) / 65536.0;
    clip_to_region(&screen, [fine(from), fine(to)]).map(|ends| ends.map(|(x, y)| (real(x), real(y))))
}

#[test]
fn item_02_2_lines_are_cut_to_the_screen() {
    let cases = [
        ((-100, 50), (400, 200), [(0.0, 80.0), (299.0, 169.7)]),
        ((-50, 150), (150, 350), [(0.0, 200.0), (99.0, 299.0)]),
        ((150, -20), (150, 500), [(150.0, 0.0), (150.0, 299.0)]),
    ];
    for (from, to, want) in cases {
        let got = cut(from, to).unwrap();
        for ((gx, gy), (wx, wy)) in got.into_iter().zip(want) {
            near(gx, wx, 1.0 / 4096.0);
            near(gy, wy, 1.0 / 4096.0);
        }
    }
    assert_eq!(cut((-100, 200), (-100, 400)), None);
    assert_eq!(cut((-10, -10), (-5, 400)), None);
}

#[test]
fn item_02_3_lines_partly_outside_stay_inside_and_reach_the_border() {
    for i in 0..100 {
        let angle = TAU * f64::from(i) / 100.0;
        let pixels = line(
            (150.0, 150.0),
            (150.0 + 525.0 * angle.cos(), 150.0 + 525.0 * angle.sin()),
        );
        let border = |&(x, y): &(i32, i32)| x == 0 || y == 0 || x == SIDE - 1 || y == SIDE - 1;
        assert!(pixels.iter().any(border), "line {i}");
        assert!(pixels.contains(&(150, 150)));
    }
}

/// What is left of a line has the values and depths that it has where nothing is cut off.
#[test]
fn item_02_4_attributes_and_depths_belong_to_the_uncut_ends() {
    let ends = [deep((-120.0, 40.0), 0.1, [0]), deep((500.0, 260.0), 0.9, [unit(1.0)])];
    let look = program(|at, [v]: [i32; 1]| Some(Seen(at.x, at.y, v, at.z.to_bits())));
    let mut pixels = picture(Seen(-1, -1, 0, 0));
    pipeline::lines(&state(), &mut buffer(&mut pixels), &mut NoDepth, &look, ends);
    let drawn: Vec<_> = pixels.iter().filter(|seen| seen.0 >= 0).collect();
    assert!(drawn.len() >= 299);
    for &&Seen(x, y, v, z) in &drawn {
        let (along_x, along_y) = (620.0, 220.0);
        let (px, py) = (f64::from(x) + 0.5 + 120.0, f64::from(y) + 0.5 - 40.0);
        let t = (px * along_x + py * along_y) / (along_x * along_x + along_y * along_y);
        near(course::real(v), t, 1e-6);
        near(f64::from(z) / f64::from(65535u32 << 15), 0.1 + 0.8 * t, 1e-6);
    }
}
