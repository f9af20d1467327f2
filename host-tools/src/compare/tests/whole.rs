//! Whole pictures: the figures, and that no wrong picture is explained away.

use super::*;

/// Two triangles that overlap, one of them with a gradient.
fn scene() -> Vec<([Vertex; 3], Surface)> {
    let gouraud = [
        colored(at(3.3, 2.1, 0.3), 10.0),
        colored(at(29.7, 8.2, 0.7), 240.0),
        colored(at(6.4, 28.9, 0.5), 130.0),
    ];
    let flat = [at(1.2, 25.0, 0.2), at(28.0, 29.0, 0.9), at(22.5, 1.7, 0.4)];
    vec![(gouraud, Surface::Gouraud), (flat, GREEN)]
}

#[test]
fn the_same_picture_is_equal_everywhere() {
    let reference = rendered(&scene());
    let comparison = compare(&as_fixed(&reference), &reference);
    assert!(comparison.classes.iter().all(|class| *class == Class::Equal));
    assert_eq!(
        (comparison.psnr, comparison.rmse, comparison.max_channel_error),
        (None, 0.0, 0)
    );
    assert_eq!((comparison.unexplained, comparison.coverage_differs), (0, 0));
    let drawn = reference.pixels.iter().filter(|pixel| pixel.primitive != 0).count();
    assert_eq!(comparison.pixels_drawn, drawn as u64);
}

#[test]
fn the_figures_of_one_missing_pixel() {
    let reference = rendered(&scene());
    let mut fixed = as_fixed(&reference);
    let index = 16 * SIZE as usize + 20;
    assert_eq!(fixed.pixels[index].rgba, GREEN_BYTES);
    fixed.pixels[index] = Pixel::default();
    let comparison = compare(&fixed, &reference);
    let rmse = (2.0 * 255.0f64.powi(2) / f64::from(4 * SIZE * SIZE)).sqrt();
    assert!((comparison.rmse - rmse).abs() < 1e-12);
    assert!((comparison.psnr.unwrap() - 20.0 * (255.0 / rmse).log10()).abs() < 1e-12);
    assert_eq!(
        (
            comparison.coverage_differs,
            comparison.unexplained,
            comparison.max_channel_error
        ),
        (1, 1, 255)
    );
}

#[test]
fn corners_moved_by_less_than_delta_are_explained_and_by_more_are_not() {
    // Every corner by the same distance in a direction of its own.
    let moved = |by: f64| {
        let mut triangles = scene();
        for (i, vertex) in triangles.iter_mut().flat_map(|(corners, _)| corners).enumerate() {
            let (sin, cos) = (1.0 + 2.4 * i as f64).sin_cos();
            vertex.position[0] += by * cos / 16.0;
            vertex.position[1] += by * sin / 16.0;
        }
        compare(&as_fixed(&rendered(&triangles)), &rendered(&scene()))
    };
    let near = moved(0.95 * SNAP);
    assert_eq!(near.unexplained, 0, "{:?}", near.explained);
    assert!(
        near.explained.colour > 0,
        "a bound that nothing comes near to is not tested"
    );
    assert!(moved(30.0 * SNAP).unexplained > 0);
}

#[test]
fn a_picture_shifted_by_a_pixel_is_unexplained() {
    let reference = rendered(&scene());
    let mut fixed = as_fixed(&reference);
    fixed.pixels.rotate_right(1);
    let comparison = compare(&fixed, &reference);
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

#[test]
fn colours_two_levels_off_are_unexplained() {
    let reference = rendered(&scene());
    let mut fixed = as_fixed(&reference);
    let mut changed = 0;
    for pixel in fixed.pixels.iter_mut().filter(|pixel| pixel.primitive != 0) {
        pixel.rgba[1] = pixel.rgba[1].checked_sub(2).unwrap_or(2);
        changed += 1;
    }
    assert_eq!(compare(&fixed, &reference).unexplained, changed);
}

#[test]
fn a_swapped_depth_order_is_unexplained() {
    let depths = |near: f64, far: f64| rendered(&[(right_of(2.5, near), RED), (right_of(2.5, far), GREEN)]);
    let comparison = compare(&as_fixed(&depths(0.6, 0.4)), &depths(0.4, 0.6));
    assert_eq!(comparison.unexplained, comparison.pixels_drawn);
}

#[test]
fn a_wrong_winner_of_the_right_colour_is_equal() {
    // What counts is the picture: the bytes are the same.
    let reference = rendered(&[(right_of(2.5, 0.5), RED)]);
    assert_eq!(class(&reference, RED_BYTES, 2), Class::Equal);
}
