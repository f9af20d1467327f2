//! Interpolated values: chapters 06 and 08, and depth on the window.

use super::*;

#[test]
fn i06_1_a_number_at_each_vertex() {
    let corners = [[0.5, 0.5, 0.0], [40.5, 0.5, 0.0], [0.5, 40.5, 0.0]];
    let geometry = triangles(&corners).with("shade", [[0.0], [0.5], [1.0]]);
    let mut framebuffer = buffer();
    let shade = Paint(|_: Color, inputs: &Values| Some([inputs["shade"][0], 0.0, 0.0, 1.0]));
    draw(&mut framebuffer, &state(), &shade, &pixels(), &geometry);
    for (x, y) in (1..20).flat_map(|y| (0..20).map(move |x| (x, y))) {
        let expected = 0.5 * f64::from(x) / 40.0 + f64::from(y) / 40.0;
        assert!((color(&framebuffer, x.into(), y.into())[0] - expected).abs() < 1e-12);
    }
}

#[test]
fn i06_3_values_belong_to_the_uncut_ends() {
    let shade = Paint(|_: Color, inputs: &Values| Some([inputs["shade"][0], 1.0, 0.0, 1.0]));
    let red = |ends: [f64; 2], shades: [f64; 2]| {
        let geometry = line([ends[0], 10.5, 0.0], [ends[1], 10.5, 0.0]).with("shade", shades.map(|s| [s]));
        let mut framebuffer = buffer();
        draw(&mut framebuffer, &state(), &shade, &pixels(), &geometry);
        assert_eq!(set(&framebuffer).len(), 64);
        (0..64).map(|x| color(&framebuffer, x, 10)[0]).collect::<Vec<f64>>()
    };
    let forwards = red([-100.5, 100.5], [0.0, 1.0]);
    assert!((forwards[0] - 101.0 / 201.0).abs() < 1e-12);
    let backwards = red([100.5, -100.5], [0.0, 1.0]);
    assert!(forwards.iter().zip(backwards).all(|(a, b)| (a + b - 1.0).abs() < 1e-12));
}

#[test]
fn i07_10_window_depth_is_linear_on_the_window() {
    // From view z = −1 at the left border to −3 at the right one: half way is view z = −1.5.
    let projection = perspective(90.0, 1.0, 1.0, 3.0);
    let (a, b) = ([-1.0, 0.0, -1.0], [3.0, 0.0, -3.0]);
    let wall = triangles(&[[-1.0, -9.0, -1.0], b, [-1.0, 9.0, -1.0]]);
    for geometry in [line(a, b), wall] {
        let mut framebuffer = buffer();
        draw(&mut framebuffer, &state(), &flat(RED), &projection, &geometry);
        for x in 0..60 {
            let expected = (f64::from(x) + 0.5) / 64.0;
            assert!((depth(&framebuffer, x.into(), 32) - expected).abs() < 1e-9, "{x}");
        }
    }
}

/// A floor with stripes across the view, and its pixels' shades.
fn floor(interpolation: Interpolation) -> Vec<Color> {
    let corners = [
        [-4.0, -1.0, -1.5],
        [4.0, -1.0, -1.5],
        [4.0, -1.0, -9.0],
        [-4.0, -1.0, -9.0],
    ];
    let [a, b, c, d] = corners;
    let geometry = triangles(&[a, b, c, a, c, d]).with("place", [a, b, c, a, c, d]);
    let board = Paint(|_: Color, inputs: &Values| {
        let place = &inputs["place"];
        Some([place[0], place[1], place[2], 1.0])
    });
    let mut state = state();
    state.interpolation = interpolation;
    let mut framebuffer = buffer();
    draw(
        &mut framebuffer,
        &state,
        &board,
        &perspective(90.0, 1.0, 1.0, 10.0),
        &geometry,
    );
    set(&framebuffer)
        .iter()
        .map(|&[x, y]| color(&framebuffer, x, y))
        .collect()
}

#[test]
fn i08_3_corrected_values_lie_where_the_surface_is() {
    let corrected = floor(Interpolation::PerspectiveCorrected);
    assert_eq!(corrected.len(), floor(Interpolation::Linear).len());
    assert!(corrected.len() > 500);
    let projection = perspective(90.0, 1.0, 1.0, 10.0);
    let apart = |places: Vec<Color>| {
        let mut framebuffer = buffer();
        let geometry = triangles(&[[-4.0, -1.0, -1.5], [4.0, -1.0, -1.5], [4.0, -1.0, -9.0]]);
        draw(&mut framebuffer, &state(), &flat(RED), &projection, &geometry);
        // Half a pixel at most between a place's projection and the nearest centre.
        let window = places.iter().map(|&[x, y, z, _]| projection.apply(&[x, y, z, 1.0]));
        let window = window.flat_map(|[x, y, _, w]| [x / w, y / w].map(|c| (c + 1.0) * 32.0 - 0.5));
        window.map(|c| (c - c.round()).abs()).fold(0.0, f64::max)
    };
    assert!(apart(corrected) < 1e-9);
    assert!(apart(floor(Interpolation::Linear)) > 0.1);
}

#[test]
fn i08_4_without_perspective_both_are_the_same() {
    let geometry = square(3.0, 5.0, 50.0, 0.5).with("shade", (0..6).map(|i| [f64::from(i) / 6.0]));
    let shade = Paint(|_: Color, inputs: &Values| Some([inputs["shade"][0], 0.0, 0.0, 1.0]));
    let [linear, corrected] = [Interpolation::Linear, Interpolation::PerspectiveCorrected].map(|interpolation| {
        let mut framebuffer = buffer();
        draw(
            &mut framebuffer,
            &State {
                interpolation,
                ..state()
            },
            &shade,
            &pixels(),
            &geometry,
        );
        framebuffer.colors[&0].picture()
    });
    // One level, as a value on the border of two may be rounded either way.
    let levels = |picture: Picture| picture.pixels.into_iter().map(|pixel| pixel[0]);
    assert!(levels(linear).zip(levels(corrected)).all(|(a, b)| a.abs_diff(b) <= 1));
}
