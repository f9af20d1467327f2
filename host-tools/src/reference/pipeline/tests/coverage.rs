//! Pixels, vertices and programs: chapters 02 to 05.

use super::*;

#[test]
fn i02_3_lines_that_leave_the_screen_reach_its_border() {
    for i in 0..100 {
        let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 100.0).sin_cos();
        let end = [32.0 + 100.0 * cos, 32.0 + 100.0 * sin, 0.0];
        let found = set(&drawn(&state(), &line([32.0, 32.0, 0.0], end)));
        assert!(found.contains(&[32, 32]), "{i}");
        let border = |[x, y]: &[i64; 2]| [0, 63].contains(x) || [0, 63].contains(y);
        assert!(found.iter().any(border), "{i}");
    }
}

#[test]
fn i03_3_only_centres_inside_and_only_the_screen() {
    let corners = [[-10.0, -40.0, 0.0], [20.0, 10.0, 0.0], [25.0, 90.0, 0.0]];
    let found = set(&drawn(&state(), &triangles(&corners)));
    assert!(found.len() > 100 && found.iter().all(|&[x, _]| x < 25));
    let places = corners.map(|[x, y, _]| [x, y]);
    let center = |[x, y]: [i64; 2]| [x as f64 + 0.5, y as f64 + 0.5];
    assert!(found.iter().all(|&p| triangle::inside(places, center(p)).is_some()));
    let outside = corners.map(|[x, y, z]| [x + 100.0, y, z]);
    assert_eq!(set(&drawn(&state(), &triangles(&outside))), [[0; 2]; 0]);
}

#[test]
fn i03_5_a_square_of_two_triangles_has_100_pixels_once() {
    let mut adding = state();
    adding.blend = Some(Blend {
        destination: blend::Factor::One,
        ..Blend::default()
    });
    let mut framebuffer = buffer();
    draw(
        &mut framebuffer,
        &adding,
        &flat([0.25; 4]),
        &pixels(),
        &square(10.0, 10.0, 10.0, 0.0),
    );
    let found = set(&framebuffer);
    assert_eq!(found.len(), 100);
    assert!(found.iter().all(|&[x, y]| color(&framebuffer, x, y)[0] == 0.25));
    assert!(found.iter().all(|p| p.iter().all(|c| (10..20).contains(c))));
}

#[test]
fn i03_6_vertices_left_over_are_ignored() {
    let corners = [[4.0, 4.0, 0.0], [20.0, 4.0, 0.0], [4.0, 20.0, 0.0], [60.0, 60.0, 0.0]];
    let three = drawn(&state(), &triangles(&corners[..3]));
    assert!(!set(&three).is_empty());
    assert_eq!(drawn(&state(), &triangles(&corners)), three);
    assert_eq!(set(&drawn(&state(), &triangles(&corners[..2]))), [[0; 2]; 0]);
    let odd = Geometry::new(Topology::Lines, corners[..3].to_vec());
    assert_eq!(drawn(&state(), &odd), drawn(&state(), &line(corners[0], corners[1])));
}

#[test]
fn i04_4_planes_change_between_draws() {
    let mut cut = state();
    cut.clip_planes = vec![[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]];
    let all = square(0.0, 0.0, 64.0, 0.0);
    assert_eq!(set(&drawn(&cut, &all)).len(), 32 * 32);
    cut.clip_planes.clear();
    assert_eq!(set(&drawn(&cut, &all)).len(), 64 * 64);
}

#[test]
fn i05_2_every_vertex_once_before_any_fragment() {
    struct Counting(Cell<usize>, Cell<usize>);
    impl Program for Counting {
        type Uniforms = ();
        fn vertex(&self, attributes: &Values, (): &(), _: &mut Values) -> [f64; 4] {
            assert_eq!(self.1.get(), 0, "a fragment came first");
            self.0.set(self.0.get() + 1);
            let p = &attributes[VERTEX];
            [p[0], p[1], p[2], 1.0]
        }
        fn fragment(&self, _: Color, _: &Values, (): &(), _: &mut Colors) -> bool {
            self.1.set(self.1.get() + 1);
            true
        }
    }
    let program = Counting(Cell::new(0), Cell::new(0));
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
    let geometry = triangles(&[corners, corners].concat());
    draw(&mut buffer(), &state(), &program, &(), &geometry);
    assert_eq!(program.0.get(), 6);
    assert!(program.1.get() >= 2 * 2016);
}

#[test]
fn i05_3_uniforms_put_one_geometry_in_two_places() {
    let mut framebuffer = buffer();
    for x in [0.0, 30.0] {
        let matrix = pixels().times(&Matrix::translation([x, 5.0, 0.0]));
        draw(
            &mut framebuffer,
            &state(),
            &flat(RED),
            &matrix,
            &square(0.0, 0.0, 4.0, 0.0),
        );
    }
    let found = set(&framebuffer);
    assert_eq!(found.len(), 32);
    assert!(
        found
            .iter()
            .all(|&[x, y]| (x < 4 || (30..34).contains(&x)) && (5..9).contains(&y))
    );
}

#[test]
fn i05_4_and_6_colours_for_numbered_buffers() {
    struct Two;
    impl Program for Two {
        type Uniforms = ();
        fn vertex(&self, attributes: &Values, (): &(), _: &mut Values) -> [f64; 4] {
            let p = &attributes[VERTEX];
            pixels().apply(&[p[0], p[1], p[2], 1.0])
        }
        fn fragment(&self, _: Color, _: &Values, (): &(), colors: &mut Colors) -> bool {
            colors.extend([(0, RED), (1, GREEN), (7, GREEN)]);
            true
        }
    }
    let mut framebuffer = buffer();
    framebuffer.colors.insert(1, Image::new(SIZE, SIZE, BLACK));
    framebuffer.colors.insert(2, Image::new(SIZE, SIZE, BLACK));
    draw(&mut framebuffer, &state(), &Two, &(), &square(0.0, 0.0, 64.0, 0.0));
    assert_eq!(framebuffer.colors[&0], Image::new(SIZE, SIZE, RED));
    assert_eq!(framebuffer.colors[&1], Image::new(SIZE, SIZE, GREEN));
    assert_eq!(framebuffer.colors[&2], Image::new(SIZE, SIZE, BLACK));
    assert_eq!(framebuffer.colors.len(), 3);
}

#[test]
fn i05_5_discard_writes_neither_colour_nor_depth() {
    let mut tested = state();
    tested.depth.test = true;
    let mut framebuffer = buffer();
    let holes = Paint(|at: Color, _: &Values| ((at[0].floor() + at[1].floor()) % 2.0 == 0.0).then_some(RED));
    draw(
        &mut framebuffer,
        &tested,
        &holes,
        &pixels(),
        &square(0.0, 0.0, 64.0, 0.25),
    );
    draw(
        &mut framebuffer,
        &tested,
        &flat(GREEN),
        &pixels(),
        &square(0.0, 0.0, 64.0, 0.75),
    );
    for (x, y) in (0..64).flat_map(|y| (0..64).map(move |x| (x, y))) {
        let (expected, z) = if (x + y) % 2 == 0 { (RED, 0.25) } else { (GREEN, 0.75) };
        assert_eq!(color(&framebuffer, x, y), expected);
        assert!((depth(&framebuffer, x, y) - z).abs() < 1e-12);
    }
}

#[test]
fn i05_7_the_fragments_place_is_its_centre_with_depth_and_1_over_w() {
    let seen = RefCell::new(Vec::new());
    let note = Paint(|at: Color, _: &Values| {
        seen.borrow_mut().push(at);
        Some([at[2], at[2], at[2], 1.0])
    });
    let slope = [[0.0, 0.0, 0.0], [64.0, 0.0, 1.0], [0.0, 64.0, 0.0]];
    for geometry in [triangles(&slope), line([3.0, 3.0, 0.5], [60.0, 9.0, 0.25])] {
        let mut framebuffer = buffer();
        draw(&mut framebuffer, &state(), &note, &pixels(), &geometry);
        assert!(!seen.borrow().is_empty());
        for [x, y, z, w] in seen.take() {
            assert_eq!([x.fract(), y.fract(), w], [0.5, 0.5, 1.0]);
            let [i, j] = [x, y].map(|c| c.floor() as i64);
            assert_eq!([depth(&framebuffer, i, j), color(&framebuffer, i, j)[0]], [z, z]);
        }
    }
}
