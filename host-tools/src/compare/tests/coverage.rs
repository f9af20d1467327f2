//! Class *edge*: edges, corners, cuts of planes, the border of the depth range, culling.

use super::*;

/// By how many δ a sample may be off, and what becomes of it.
const CASES: [(f64, Class); 3] = [(0.5, Class::Edge), (0.99, Class::Edge), (1.01, Class::Unexplained)];

#[test]
fn a_sample_near_an_edge_may_be_in_or_out() {
    for (off, expected) in CASES {
        let beyond = rendered(&[(right_of(10.0 + off * SNAP, 0.5), RED)]);
        assert_eq!(class(&beyond, RED_BYTES, 1), expected, "{off} outside");
        let inside = rendered(&[(right_of(10.0 - off * SNAP, 0.5), RED)]);
        assert_eq!(class_if_missing(&inside), expected, "{off} inside");
    }
}

#[test]
fn distance_is_across_the_edge() {
    // An edge at 45 degrees: √2 further along the row.
    let slanted = |x: f64| {
        [
            at(x - 40.0, -24.0, 0.5),
            at(x + 99.0, 16.0, 0.5),
            at(x + 40.0, 56.0, 0.5),
        ]
    };
    for (off, expected) in CASES {
        let x = 10.0 - off * SNAP * std::f64::consts::SQRT_2;
        assert_eq!(class_if_missing(&rendered(&[(slanted(x), RED)])), expected, "{off}");
    }
}

#[test]
fn beyond_a_corner_the_distance_is_to_the_corner() {
    for (off, expected) in CASES {
        let tip = rendered(&[(
            [at(10.0 - off * SNAP, 16.0, 0.5), at(0.0, 15.9, 0.5), at(0.0, 16.1, 0.5)],
            RED,
        )]);
        assert_eq!(class(&tip, RED_BYTES, 1), expected, "{off}");
    }
}

#[test]
fn an_enormous_triangle_reaches_no_further_on_the_screen() {
    for (off, expected) in CASES {
        let x = 10.0 - off * SNAP;
        let corners = [at(x, -1e9, 0.5), at(1e9, 16.0, 0.5), at(x, 1e9, 0.5)];
        assert_eq!(class_if_missing(&rendered(&[(corners, RED)])), expected, "{off}");
    }
}

#[test]
fn what_lies_behind_an_uncertain_edge_may_show_and_nothing_else() {
    let three = |x: f64| {
        let behind = (right_of(-20.0, 0.8), GREEN);
        let far_behind = (right_of(-20.0, 0.9), Surface::Flat([0.0, 0.0, 1.0]));
        rendered(&[far_behind, behind, (right_of(x, 0.5), RED)])
    };
    for (off, expected) in CASES {
        assert_eq!(class(&three(10.0 - off * SNAP), GREEN_BYTES, 2), expected, "{off}");
    }
    let near = three(10.0 - 0.5 * SNAP);
    assert_eq!(class(&near, [0, 0, 255, 255], 1), Class::Unexplained);
    assert_eq!(class_if_missing(&near), Class::Unexplained);
    // The right winner in a wrong colour, or without its alpha.
    assert_eq!(class(&near, [0, 253, 0, 255], 2), Class::Unexplained);
    assert_eq!(class(&near, [0, 255, 0, 254], 2), Class::Unexplained);
}

#[test]
fn the_border_of_the_depth_range_is_an_edge() {
    // Depth rises by 1/50 per px and passes `border` at x.
    let ramp = |x: f64, border: f64| {
        let z = |column: f64| border + (column - x) / 50.0;
        [
            at(-9.0, -40.0, z(-9.0)),
            at(90.0, 16.0, z(90.0)),
            at(-9.0, 72.0, z(-9.0)),
        ]
    };
    for (off, expected) in CASES {
        let d = off * SNAP;
        assert_eq!(
            class(&rendered(&[(ramp(10.0 + d, 0.0), RED)]), RED_BYTES, 1),
            expected,
            "{off} below 0"
        );
        assert_eq!(
            class_if_missing(&rendered(&[(ramp(10.0 - d, 0.0), RED)])),
            expected,
            "{off} above 0"
        );
        assert_eq!(
            class_if_missing(&rendered(&[(ramp(10.0 + d, 1.0), RED)])),
            expected,
            "{off} below 1"
        );
        assert_eq!(
            class(&rendered(&[(ramp(10.0 - d, 1.0), RED)]), RED_BYTES, 1),
            expected,
            "{off} above 1"
        );
    }
}

#[test]
fn a_cut_by_a_plane_is_an_edge() {
    let cut_at = |x: f64| {
        let plane = [1.0, 0.0, 0.0, 1.0 - x / 16.0];
        prepared(|r| r.clip_plane(plane).unwrap(), &[(right_of(-20.0, 0.5), RED)])
    };
    for (off, expected) in CASES {
        assert_eq!(
            class(&cut_at(10.0 + off * SNAP), RED_BYTES, 1),
            expected,
            "{off} outside"
        );
        assert_eq!(class_if_missing(&cut_at(10.0 - off * SNAP)), expected, "{off} inside");
    }
}

#[test]
fn a_plane_through_the_triangle_decides_only_if_it_is_clear_of_it() {
    let turned = |distance: f64| {
        let prepare = |r: &mut Reference| {
            r.rotate(20.0, [1.0, 0.0, 0.0]).unwrap();
            r.clip_plane([0.0, 0.0, 1.0, -0.5 - distance]).unwrap();
        };
        prepared(prepare, &[(right_of(-20.0, 0.5), RED)])
    };
    // The plane is the triangle's own, up to rounding; then a hair before and behind it.
    let own = turned(0.0);
    let drawn = own.pixels[16 * SIZE as usize + 10].primitive == 1;
    let class_of_the_other = if drawn {
        class_if_missing(&own)
    } else {
        class(&own, RED_BYTES, 1)
    };
    assert_eq!(class_of_the_other, Class::Edge);
    assert_eq!(class_if_missing(&turned(-1e-9)), Class::Unexplained);
    assert_eq!(class(&turned(1e-9), RED_BYTES, 1), Class::Unexplained);
}

#[test]
fn culling_is_uncertain_for_slivers_only() {
    // Clockwise, so culled, and as high as some δ.
    let sliver = |height: f64| {
        let corners = [
            at(0.0, 16.0, 0.5),
            at(30.0, 16.0, 0.5),
            at(10.0, 16.0 + height * SNAP, 0.5),
        ];
        prepared(|r| r.cull(), &[(corners, RED)])
    };
    assert_eq!(class(&sliver(1.0), RED_BYTES, 1), Class::Edge);
    assert_eq!(class(&sliver(3.0), RED_BYTES, 1), Class::Unexplained);
    let large = prepared(|r| r.cull(), &[(right_of(-20.0, 0.5), RED)]);
    assert_eq!(class(&large, RED_BYTES, 1), Class::Unexplained);
}

#[test]
fn a_corner_with_w_0_may_be_anywhere_and_one_with_a_little_more_may_not() {
    let towards = |w: f64| {
        let mut far = projective(20.0, 16.0, 0.5, 1.0);
        far.position = [0.25, 0.0, 0.0, w];
        rendered(&[([at(20.0, 10.0, 0.5), far, at(20.0, 20.0, 0.5)], RED)])
    };
    assert_eq!(class(&towards(0.0), RED_BYTES, 1), Class::Edge);
    assert_eq!(class(&towards(1e-12), RED_BYTES, 1), Class::Unexplained);
}
