//! Transparent objects and culling: chapters 10 and 11.

use super::*;

/// A pane or wall at a depth of the view, facing an eye at the origin.
fn pane(z: f64, color: Color, transparent: bool) -> Object<(Matrix, Color)> {
    let shape = [[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]];
    let model_view = Matrix::translation([0.0, 0.0, z]);
    let projection = perspective(90.0, 1.0, 1.0, 10.0);
    Object {
        geometry: triangles(&shape),
        model_view,
        uniforms: (projection.times(&model_view), color),
        transparent,
    }
}

struct Colored;

impl Program for Colored {
    type Uniforms = (Matrix, Color);

    fn vertex(&self, attributes: &Values, (matrix, _): &(Matrix, Color), _: &mut Values) -> [f64; 4] {
        let p = &attributes[VERTEX];
        matrix.apply(&[p[0], p[1], p[2], 1.0])
    }

    fn fragment(&self, _: Color, _: &Values, (_, color): &(Matrix, Color), colors: &mut Colors) -> bool {
        colors.insert(0, *color);
        true
    }
}

#[test]
fn i10_6_transparent_objects_from_the_back_to_the_front() {
    let mut tested = state();
    tested.depth.test = true;
    let near_red = || pane(-2.0, [1.0, 0.0, 0.0, 0.5], true);
    let far_green = || pane(-3.0, [0.0, 1.0, 0.0, 0.5], true);
    let middle = |objects: &[Object<_>]| {
        let mut framebuffer = buffer();
        draw_scene(&mut framebuffer, &tested, &Colored, objects);
        (color(&framebuffer, 32, 32), depth(&framebuffer, 32, 32))
    };
    for objects in [[near_red(), far_green()], [far_green(), near_red()]] {
        let ([r, g, b, _], z) = middle(&objects);
        assert_eq!(([r, g, b], z), ([0.5, 0.25, 0.0], 1.0));
    }
    let wall = || pane(-2.5, [0.0, 0.0, 1.0, 1.0], false);
    for objects in [[far_green(), wall()], [wall(), far_green()]] {
        assert_eq!(middle(&objects).0, [0.0, 0.0, 1.0, 1.0]);
    }
}

/// A cube in front of a camera, each triangle in its own colour.
fn cube(order: impl Fn(usize) -> usize) -> (Geometry, Matrix) {
    let (corners, _) = crate::playground::shapes::BOX.as_chunks::<3>();
    let shuffled = (0..12).map(|i| (order(i), corners[order(i)]));
    let (colors, places): (Vec<_>, Vec<_>) = shuffled
        .flat_map(|(i, triangle)| triangle.map(|c| ([i as f64 / 12.0 + 0.05], c.position.map(f64::from))))
        .unzip();
    let turned = Transform {
        scale: [0.6; 3],
        turn: (20.0, [0.0, 0.0, 1.0]),
        ..Transform::default()
    };
    let view = look_at([1.5, 1.9, 2.1], [0.0; 3], [0.0, 1.0, 0.0]);
    let matrix = perspective(90.0, 1.0, 0.1, 10.0).times(&view).times(&turned.matrix());
    (triangles(&places).with("shade", colors), matrix)
}

fn cube_drawn(state: &State, order: impl Fn(usize) -> usize) -> Framebuffer {
    let (geometry, matrix) = cube(order);
    let mut framebuffer = buffer();
    let shade = Paint(|_: Color, inputs: &Values| {
        let shade = (inputs["shade"][0] * 1e9).round() / 1e9;
        Some([shade, 0.0, 0.0, 0.5])
    });
    draw(&mut framebuffer, state, &shade, &matrix, &geometry);
    framebuffer
}

#[test]
fn i11_2_culling_a_cube() {
    let cube = |cull, test| {
        let mut state = state();
        state.depth.test = test;
        state.cull = cull;
        cube_drawn(&state, |i| i).colors[&0].clone()
    };
    let shades = |image: &Image<4>| {
        let places = (0..64).flat_map(|y| (0..64).map(move |x| (x, y)));
        let mut shades: Vec<i64> = places
            .filter_map(|(x, y)| image.get(x, y))
            .filter(|color| *color != BLACK)
            .map(|color| (color[0] * 12.0) as i64)
            .collect();
        shades.sort_unstable();
        shades.dedup();
        shades
    };
    let outside = cube(Some(Face::Back), true);
    assert_eq!(shades(&outside).len(), 6, "two triangles of three faces");
    assert_eq!(outside, cube(None, true));
    assert_eq!(outside, cube(Some(Face::Back), false));
    let inside = cube(Some(Face::Front), true);
    assert_eq!(shades(&inside).len(), 6);
    assert!(shades(&inside).iter().all(|shade| !shades(&outside).contains(shade)));
    assert_eq!(shades(&cube(Some(Face::FrontAndBack), true)), [0; 0]);
    let mut nothing = state();
    nothing.cull = Some(Face::FrontAndBack);
    assert!(!set(&drawn(&nothing, &line([3.0, 3.0, 0.0], [60.0, 50.0, 0.0]))).is_empty());
}

#[test]
fn i11_3_a_transparent_cube_in_any_order_of_its_triangles() {
    let mut blended = state();
    blended.cull = Some(Face::Back);
    blended.blend = Some(Blend::transparency());
    let straight = cube_drawn(&blended, |i| i);
    assert!(set(&straight).len() > 100);
    assert_eq!(cube_drawn(&blended, |i| 11 - i).colors, straight.colors);
    assert_eq!(cube_drawn(&blended, |i| i * 5 % 12).colors, straight.colors);
}

#[test]
fn i11_4_winding_is_the_same_in_every_viewport() {
    let front = square(3.0, 3.0, 50.0, 0.0);
    for (x, y, width, height) in [(0, 0, 64, 64), (32, 8, 16, 50), (-20, -9, 70, 20)] {
        let mut state = State::new(Viewport { x, y, width, height });
        state.cull = Some(Face::Back);
        assert!(!set(&drawn(&state, &front)).is_empty());
        state.cull = Some(Face::Front);
        assert!(set(&drawn(&state, &front)).is_empty());
    }
}
