//! The near plane, viewports and the depth buffer: chapter 07.

use super::*;

#[test]
fn i07_3_nothing_behind_the_camera_shows() {
    let projection = perspective(90.0, 1.0, 1.0, 3.0);
    let behind = triangles(&[[-1.0, -1.0, 2.0], [1.0, -1.0, 2.0], [0.0, 1.0, 0.5]]);
    let mut framebuffer = buffer();
    draw(&mut framebuffer, &state(), &flat(RED), &projection, &behind);
    assert_eq!(set(&framebuffer), [[0; 2]; 0]);
    // A floor from the far to behind the camera covers nothing above the horizon.
    let floor = triangles(&[[-9.0, -1.0, -3.0], [9.0, -1.0, -3.0], [0.0, -1.0, 9.0]]);
    draw(&mut framebuffer, &state(), &flat(RED), &projection, &floor);
    let found = set(&framebuffer);
    assert!(found.len() > 500 && found.iter().all(|&[_, y]| y < 32));
    // No division by zero without the plane either.
    let mut unclipped = state();
    unclipped.clip_planes.clear();
    let at_the_eye = triangles(&[[-1.0, -1.0, -2.0], [1.0, -1.0, -2.0], [0.0, 1.0, 0.0]]);
    let mut framebuffer = buffer();
    draw(&mut framebuffer, &unclipped, &flat(RED), &projection, &at_the_eye);
    assert_eq!(set(&framebuffer), [[0; 2]; 0]);
}

#[test]
fn i07_3_beyond_the_far_plane_the_depth_test_fails() {
    let mut tested = state();
    tested.depth.test = true;
    assert_eq!(set(&drawn(&tested, &square(0.0, 0.0, 64.0, 1.01))), [[0; 2]; 0]);
    assert_eq!(set(&drawn(&tested, &square(0.0, 0.0, 64.0, 1.0))).len(), 64 * 64);
}

#[test]
fn i07_6_two_viewports_show_two_equal_halves() {
    let scene = |framebuffer: &mut Framebuffer, x: i32| {
        let half = State::new(Viewport {
            x,
            width: SIZE / 2,
            ..Viewport::of(SIZE, SIZE)
        });
        let large = triangles(&[[-20.0, 3.0, 0.0], [90.0, 20.0, 0.0], [20.0, 60.0, 0.0]]);
        draw(framebuffer, &half, &flat(RED), &pixels(), &large);
        draw(
            framebuffer,
            &half,
            &flat(GREEN),
            &pixels(),
            &line([-50.0, 9.0, 0.0], [99.0, 50.0, 0.0]),
        );
    };
    let (mut left, mut right) = (buffer(), buffer());
    scene(&mut left, 0);
    scene(&mut right, 32);
    assert!(set(&left).iter().all(|&[x, _]| x < 32));
    let moved: Vec<_> = set(&left).iter().map(|&[x, y]| [x + 32, y]).collect();
    assert!(moved.len() > 100);
    assert_eq!(set(&right), moved);
    assert!(
        moved
            .iter()
            .all(|&[x, y]| color(&right, x, y) == color(&left, x - 32, y))
    );
}

#[test]
fn i07_6_a_viewport_may_reach_beyond_the_image() {
    let beyond = State::new(Viewport {
        x: -40,
        y: 30,
        width: 200,
        height: 200,
    });
    let everything = triangles(&[[-500.0, -500.0, 0.0], [900.0, -500.0, 0.0], [0.0, 900.0, 0.0]]);
    assert_eq!(set(&drawn(&beyond, &everything)).len(), 64 * 34);
    assert!(!set(&drawn(&beyond, &line([-500.0, -20.0, 0.0], [500.0, 20.0, 0.0]))).is_empty());
}

#[test]
fn i07_7_drawing_without_a_depth_buffer_works() {
    let mut framebuffer = buffer();
    framebuffer.depth = None;
    let mut tested = state();
    tested.depth.test = true;
    draw(
        &mut framebuffer,
        &tested,
        &flat(RED),
        &pixels(),
        &square(0.0, 0.0, 64.0, 2.0),
    );
    assert_eq!(set(&framebuffer).len(), 64 * 64);
    draw(
        &mut Framebuffer::default(),
        &tested,
        &flat(RED),
        &pixels(),
        &square(0.0, 0.0, 64.0, 2.0),
    );
}

/// Two squares, red and green, at these depths; the colour and depth that stay.
fn two(depth_options: Depth, depths: [f64; 2]) -> (Color, f64) {
    let mut framebuffer = buffer();
    let mut state = state();
    state.depth = depth_options;
    for (color, z) in [RED, GREEN].into_iter().zip(depths) {
        draw(
            &mut framebuffer,
            &state,
            &flat(color),
            &pixels(),
            &square(0.0, 0.0, 64.0, z),
        );
    }
    (color(&framebuffer, 5, 50), depth(&framebuffer, 5, 50))
}

#[test]
fn i07_8_the_depth_test_lets_equals_pass() {
    assert_eq!(
        state().depth,
        Depth {
            test: false,
            write: true
        }
    );
    let on = Depth {
        test: true,
        write: true,
    };
    assert_eq!(two(on, [0.25, 0.25]), (GREEN, 0.25));
    assert_eq!(two(on, [0.25, 0.5]), (RED, 0.25));
    assert_eq!(two(on, [0.5, 0.25]), (GREEN, 0.25));
    assert_eq!(two(state().depth, [0.25, 0.5]), (GREEN, 0.5));
}

#[test]
fn i07_9_depth_is_written_also_without_a_test() {
    assert_eq!(
        two(
            Depth {
                test: false,
                write: true
            },
            [0.25, 0.5]
        )
        .1,
        0.5
    );
    assert_eq!(
        two(
            Depth {
                test: false,
                write: false
            },
            [0.25, 0.5]
        ),
        (GREEN, 1.0)
    );
    assert_eq!(
        two(
            Depth {
                test: true,
                write: false
            },
            [0.25, 0.5]
        ),
        (GREEN, 1.0)
    );
}
