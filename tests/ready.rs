//! Vertices projected once: triangles of them are, to the bit, those that are projected one by one.

mod exact;

use std::cell::Cell;
use std::fmt::Debug;

use exact::block;
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::{Flat, Gouraud565};
use fixel::light::Sunlight;
use fixel::matrix::{Directions, Matrix};
use fixel::mesh::Normalized;
use fixel::num::{Angle, Block, SineTable, Word};
use fixel::screen::Shape;
use fixel::target::Buffer;
use fixel::varying::{Color565, Linear, LinearFan, Perspective};
use fixel::view::{Assembled, Carried, Cull, ScreenVertex, Vertex, View};
use fixel::viewport::Viewport;
use proptest::prelude::*;

/// Numbers that lie in the volume, on its borders, in the guard band, and beyond it.
fn coordinate() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![6 => -1.2..1.2f64, 1 => Just(1.0), 1 => Just(-1.0), 1 => -90.0..90.0f64, 1 => Just(0.0)]
}

fn w() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![6 => 0.3..3.0f64, 2 => Just(1.0), 1 => -2.0..2.0f64, 1 => Just(0.0)]
}

/// Homogeneous, x, y and z times w.
fn position() -> impl Strategy<Value = [f64; 4]> + Clone {
    (coordinate(), coordinate(), coordinate(), w(), 0.9999..1.0001f64).prop_map(|(x, y, z, w, near)| {
        let size = if w == 0.0 { 1.0 } else { w };
        [x * size, y * size, z * size * near, w]
    })
}

fn view<T: Word, W: Word>() -> impl Strategy<Value = View<T, W, 0>> {
    let ranges = [DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited];
    let culls = [Cull::Nothing, Cull::Clockwise, Cull::CounterClockwise];
    // The last reaches the border of the guard band, half a pixel over with samples at centres.
    let places = [(0, 0, 320, 240), (-10, 5, 7, 3000), (-W::GUARD, -W::GUARD, 900, 64)];
    (
        prop::sample::select(ranges.to_vec()),
        prop::sample::select(culls.to_vec()),
        prop::sample::select(places.to_vec()),
        any::<[bool; 3]>(),
    )
        .prop_map(
            |(depth_range, cull, (left, top, width, height), [divide, up, centers])| {
                let mut viewport = Viewport::new(left, top, width, height).unwrap();
                if up {
                    viewport = viewport.y_up();
                }
                if centers {
                    viewport = viewport.samples_at_centers();
                }
                View {
                    projection: Matrix::identity(),
                    planes: Planes::default(),
                    viewport,
                    depth_range,
                    behind: if divide { Behind::Divide } else { Behind::Cut },
                    cull,
                }
            },
        )
}

/// Everything that a shape gives.
fn outline<S: Shape<Varying: Debug>>(shape: &S) -> Vec<((i32, i32), i32, String)> {
    let corner = |i| (shape.position(i), shape.depth(i), format!("{:?}", shape.varying(i)));
    (0..shape.count()).map(corner).collect()
}

/// Whether the triangle went around the clipper, into it and was seen, or was not seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Whole,
    Clipped,
    Nothing,
}

/// Whether the box of a polygon holds a sample.
fn draws_something(polygon: &[((i32, i32), i32, String)]) -> bool {
    let holds = |values: Vec<i32>| {
        let first = |v: i32| (v + 255).div_euclid(256);
        first(*values.iter().min().unwrap()) < first(*values.iter().max().unwrap())
    };
    holds(polygon.iter().map(|c| c.0.0).collect()) && holds(polygon.iter().map(|c| c.0.1).collect())
}

fn compare<T: Word, W: Word, V>(view: &View<T, W, 0>, points: [[f64; 4]; 3], carried: [V::Vertex; 3]) -> Way
where
    V: Carried + Debug,
{
    let vertices: Vec<_> = points
        .iter()
        .zip(carried)
        .map(|(p, carried)| Vertex {
            position: block::<T, 4>(*p),
            carried,
        })
        .collect();
    let vertices: [Vertex<T, V::Vertex>; 3] = vertices.try_into().ok().unwrap();
    let ready = vertices.map(|v| view.vertex(v.position, v.carried));
    compare_ready::<T, W, V>(view, vertices, ready)
}

fn compare_ready<T: Word, W: Word, V>(
    view: &View<T, W, 0>,
    vertices: [Vertex<T, V::Vertex>; 3],
    ready: [ScreenVertex<T, V::Vertex>; 3],
) -> Way
where
    V: Carried + Debug,
{
    let mut expected = Vec::new();
    view.project::<V>(&vertices, |polygon| expected.push(outline(polygon)));
    let (mut found, mut way) = (Vec::new(), Way::Nothing);
    view.assemble::<V>(ready.each_ref(), |left| match left {
        Assembled::Triangle(triangle) => {
            way = Way::Whole;
            assert_eq!(fixel::span::doubled_area(triangle), triangle.area());
            found.push(outline(triangle));
        }
        Assembled::Polygon(polygon) => {
            way = Way::Clipped;
            found.push(outline(polygon));
        }
    });
    if found.is_empty() {
        // Of what is small enough to have no pixel nothing is left.
        expected.retain(|polygon| draws_something(polygon));
    }
    assert_eq!(found, expected);
    way
}

fn compare_all<T: Word, W: Word>(view: &View<T, W, 0>, points: [[f64; 4]; 3], values: [[i32; 3]; 3]) -> Way {
    let pairs = values.map(|[a, b, c]| ([a, b], [c]));
    let ways = [
        compare::<T, W, ()>(view, points, [(); 3]),
        compare::<T, W, Linear<3>>(view, points, values),
        compare::<T, W, LinearFan<3>>(view, points, values),
        compare::<T, W, Perspective<3>>(view, points, values),
        compare::<T, W, Color565>(view, points, values.map(|v| v.map(|c| c & 0x1f_ffff))),
        compare::<T, W, (Linear<2>, Perspective<1>)>(view, points, pairs),
    ];
    ways[0]
}

/// Runs `cases` triangles, and sees that all ways were taken.
fn check<T: Word, W: Word>(cases: u32) {
    let ways = Cell::new([0u32; 3]);
    let mut runner = proptest::test_runner::TestRunner::new(ProptestConfig::with_cases(cases));
    let values = prop::array::uniform3(prop::array::uniform3(-(1 << 30)..1 << 30i32));
    let triangle = prop_oneof![
        3 => prop::array::uniform3(position()),
        // The same w everywhere: nothing is divided.
        1 => prop::array::uniform3(position()).prop_map(|points| points.map(|[x, y, z, _]| [x, y, z, 1.0])),
    ];
    runner
        .run(&(view::<T, W>(), triangle, values), |(view, points, values)| {
            let way = compare_all(&view, points, values);
            let mut counts = ways.get();
            counts[way as usize] += 1;
            ways.set(counts);
            Ok(())
        })
        .unwrap();
    let counts = ways.get();
    assert!(counts.iter().all(|&n| n > cases / 50), "{counts:?}");
}

#[test]
fn same_bits_with_32_bit_words() {
    check::<i32, i32>(20_000);
}

#[test]
fn same_bits_with_64_bit_words() {
    check::<i64, i64>(5_000);
}

#[test]
fn same_bits_with_mixed_words() {
    check::<i32, i64>(5_000);
}

fn turned<T: Word>(angle: i32, away: i32) -> Matrix<T> {
    let turn = Matrix::rotation::<SineTable>(Angle::from_degrees(angle), Block::from_integers([3, 2, 1])).unwrap();
    Matrix::translation(Block::from_integers([0, 0, -away])).product(&turn)
}

/// Where the short way is off by as much as it can be, next to the border between two subpixels: found among all divisors.
#[test]
fn ratios_that_are_as_far_off_as_any() {
    let view = View::<i32, i32, 0> {
        projection: Matrix::identity(),
        planes: Planes::default(),
        viewport: Viewport::new(-4096, -4096, 8191, 8191).unwrap(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    };
    for (w, v) in [(1_073_737_746, 1_069_789_247), (1_073_737_763, 1_069_772_878)] {
        let positions = [[v, 0, 0, w], [0, 0, 0, w], [0, v, 0, w]].map(|p| Block::new(p, 0));
        let vertices = positions.map(|position| Vertex { position, carried: () });
        let ready = positions.map(|position| view.clip_vertex(position, ()));
        assert_eq!(compare_ready::<i32, i32, ()>(&view, vertices, ready), Way::Whole);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Stored positions need no block of their own.
    #[test]
    fn stored_positions_are_transformed_alike(
        point in any::<[i16; 3]>(),
        entries in prop::array::uniform16(-3000.0..3000.0f64),
        small in prop::sample::select(&[1.0, 1e-4, 1e-12][..]),
    ) {
        fn check<T: Word>(point: [i16; 3], entries: [f64; 16]) {
            let matrix = Matrix::<T>::from_rows(block(entries));
            assert_eq!(point.transformed(&matrix), matrix.transform(point.point()));
            let wide = point.map(|c| (c as i32) << 15);
            assert_eq!(wide.transformed(&matrix), matrix.transform(wide.point()));
        }
        let mut entries = entries;
        entries[5] *= small;
        check::<i32>(point, entries);
        check::<i64>(point, entries);
    }

    /// Positions of 16 bits lie where the exact projection has them, within their bound; and triangles of them are, to the bit,
    /// those of the places in clip space that they were given, clipped or not.
    #[test]
    fn stored_vertices_are_where_they_say(
        view in view::<i32, i32>(),
        points in prop::array::uniform3(any::<[i16; 3]>()),
        linear in prop::array::uniform12(-1.0..1.0f64),
        distance in prop::array::uniform4(-2.0..2.0f64),
        (far, tiny) in (0.5..4.0f64, prop::sample::select(&[1.0, 1e-3, 1e-9][..])),
        values in prop::array::uniform3(prop::array::uniform3(0..0x1f_ffffi32)),
    ) {
        let mut entries = [0.0; 16];
        for (row, chunk) in linear.chunks(3).enumerate() {
            entries[4 * row..][..3].copy_from_slice(chunk);
            entries[4 * row + 3] = distance[row];
        }
        // Mostly before the camera.
        entries[15] += far;
        entries[..12].iter_mut().for_each(|entry| *entry *= tiny);
        let projection = Matrix::<i32>::from_rows(block(entries));
        let view = View { projection, ..view };
        let stored = view.stored();
        let ready = [0, 1, 2].map(|i| stored.vertex(points[i], values[i]));

        let exact: Matrix<i64> = Matrix::from_rows(block(exact::floats(projection.entries())));
        let entries = exact::floats(exact.entries());
        let most = entries.chunks(4).map(|row| row.iter().map(|m| m.abs()).sum());
        let bound = most.fold(0.0, f64::max) * 2f64.powi(-26);
        for (point, vertex) in points.iter().zip(&ready) {
            let expected = exact::floats(exact.transform(point.point()));
            for (found, expected) in exact::floats(vertex.position()).iter().zip(expected) {
                prop_assert!((found - expected).abs() <= bound, "{found} instead of {expected}");
            }
        }
        let vertices = [0, 1, 2].map(|i| Vertex { position: ready[i].position(), carried: values[i] });
        let as_given = View { projection: Matrix::identity(), ..view.clone() };
        compare_ready::<i32, i32, Linear<3>>(&as_given, vertices, ready);
        compare_ready::<i32, i32, Perspective<3>>(&as_given, vertices, ready);
    }

    /// A sun on a turned model, against the formula in float64.
    #[test]
    fn sunlight_is_the_formula(
        normal in prop::array::uniform3(-1.0..1.0f64),
        towards in prop::array::uniform3(-1000..1000i32),
        ambient in prop::array::uniform3(0..1 << 24i32),
        diffuse in prop::array::uniform3(-(1 << 24)..=1 << 24i32),
        angle in 0..360,
    ) {
        let length = normal.iter().map(|v| v * v).sum::<f64>().sqrt();
        prop_assume!(length > 0.01 && towards != [0; 3]);
        let normal = normal.map(|v| (v / length * 32767.0).round() as i16);
        let mut directions = Directions::<i32>::identity();
        directions.load(&turned(angle, 3));
        let light = Sunlight::new(towards, &directions, ambient, diffuse).unwrap();

        let to_eye: Block<i64, 3> = Block::new(normal.map(i64::from), -15);
        let mut exact = Directions::<i64>::identity();
        exact.load(&turned(angle, 3));
        let eye = exact::floats(exact.turn(to_eye));
        let size = towards.iter().map(|&v| f64::from(v).powi(2)).sum::<f64>().sqrt();
        let cosine = eye.iter().zip(towards).map(|(n, l)| n * f64::from(l)).sum::<f64>() / size;
        for (i, found) in light.shade(normal).into_iter().enumerate() {
            let expected = f64::from(ambient[i]) + f64::from(diffuse[i]) * cosine.max(0.0);
            let bound = 512.0 + f64::from(diffuse[i]).abs() / 8192.0;
            prop_assert!((f64::from(found) - expected).abs() <= bound, "{found} instead of {expected}");
        }
    }

    /// Indices and numbers of any kind draw something or nothing.
    #[test]
    fn nothing_panics(
        mantissas in prop::array::uniform4(any::<i32>()),
        exponent in any::<i32>(),
        indices in prop::array::uniform3(any::<u16>()),
        normal in any::<[i16; 3]>(),
        light in any::<[i32; 3]>(),
        view in view::<i32, i32>(),
    ) {
        let wild = Block::from_wide(mantissas.map(i64::from), exponent);
        let shade = Sunlight::new(light, &Directions::<i32>::identity(), [1 << 30; 3], [-1 << 24; 3]);
        let color = shade.map_or([0; 3], |sun| sun.shade(normal));
        let vertices = [
            view.vertex(wild, color),
            view.stored_vertex(normal, color),
            view.clip_vertex(wild.negated(), color),
            ScreenVertex::empty([0; 3]),
        ];
        let mut memory = [0u16; 16 * 16];
        let mut target = Buffer::new(&mut memory, 16, 16).unwrap();
        let triangles = [[0, 1, 2], [1, 1, 0], [3, 0, 1], [3, 3, 3], indices];
        draw::indexed(&view, &mut target, &mut NoDepth, &vertices, triangles, &Gouraud565);
    }
}

/// Lights that do not fit are refused.
#[test]
fn sunlight_says_what_it_cannot_do() {
    use fixel::error::Error;
    let directions = Directions::<i32>::identity();
    let new = |towards, ambient, diffuse| Sunlight::new(towards, &directions, [ambient; 3], [diffuse; 3]).err();
    assert_eq!(new([0; 3], 0, 0), Some(Error::ZeroVector));
    assert_eq!(new([1, 0, 0], (1 << 30) + 1, 0), Some(Error::TooLarge));
    assert_eq!(new([1, 0, 0], 0, (1 << 24) + 1), Some(Error::TooLarge));
    assert_eq!(new([1, 0, 0], 1 << 30, -1 << 24), None);
}

/// An index beyond the vertices leaves its triangle out, and no other.
#[test]
fn triangles_with_missing_vertices_are_left_out() {
    let view = View::<i32, i32, 0> {
        projection: Matrix::identity(),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, 4, 4).unwrap(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    };
    let corner = |x, y| view.vertex(Block::from_integers([x, y, 0, 1]), ());
    let vertices = [corner(-1, -1), corner(-1, 1), corner(1, 1), corner(1, -1)];
    let mut picture = [0u8; 16];
    let mut target = Buffer::new(&mut picture, 4, 4).unwrap();
    draw::indexed(&view, &mut target, &mut NoDepth, &vertices, [[0, 1, 4u16]], &Flat(1));
    assert_eq!(target_sum(&picture), 0);
    let mut target = Buffer::new(&mut picture, 4, 4).unwrap();
    draw::indexed(
        &view,
        &mut target,
        &mut NoDepth,
        &vertices,
        [[0, 1, 9], [0, 1, 2], [0, 2, 3u16]],
        &Flat(1),
    );
    assert_eq!(target_sum(&picture), 16);
}

fn target_sum(picture: &[u8]) -> u32 {
    picture.iter().map(|&p| u32::from(p)).sum()
}
