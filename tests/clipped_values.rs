//! What clip planes leave of triangles and lines in the pipeline, against float64: values that are linear over the screen, 1/w in
//! both ways to interpolate, and which way is front (items 04.2, 04.5, 05.7, 06.5, 08.3, 11.1 of `docs/pipeline.md`).

mod course;

use course::{
    Random, SIDE, Seen, Vertex, block, buffer, draw, floats, near, picture, pixel, program, real, state, unit,
};
use fixel::clip::Planes;
use fixel::depth::{DepthBuffer, FAR, LessOrEqual, NoDepth};
use fixel::num::Block;
use fixel::pipeline::{self, Culling, Linear, State};
use fixel::target::Buffer;

/// A corner in clip space with its value.
#[derive(Clone, Copy)]
struct Corner([f64; 4], f64);

/// The corner on the plane between two, of these distances.
fn cut(Corner(a, va): Corner, Corner(b, vb): Corner, da: f64, db: f64) -> Corner {
    let t = da / (da - db);
    Corner([0, 1, 2, 3].map(|i| a[i] + t * (b[i] - a[i])), va + t * (vb - va))
}

/// Sutherland-Hodgman, every plane from the edge between the last corner and the first on.
fn clipped(mut polygon: Vec<Corner>, planes: &[[f64; 4]]) -> Vec<Corner> {
    for plane in planes {
        let distance = |corner: &Corner| (0..4).map(|i| plane[i] * corner.0[i]).sum::<f64>();
        let mut kept = Vec::new();
        for (i, &end) in polygon.iter().enumerate() {
            let start = polygon[(i + polygon.len() - 1) % polygon.len()];
            let (from, to) = (distance(&start), distance(&end));
            if (from >= 0.0) != (to >= 0.0) {
                kept.push(cut(start, end, from, to));
            }
            if to >= 0.0 {
                kept.push(end);
            }
        }
        polygon = kept;
    }
    polygon
}

/// Where it is on the picture.
fn on_screen(Corner([x, y, _, w], _): &Corner) -> [f64; 2] {
    [x, y].map(|c| (c / w + 1.0) / 2.0 * f64::from(SIDE))
}

/// Of the parts of the fan: three places, three values and three 1/w.
struct Part {
    places: [[f64; 2]; 3],
    values: [[f64; 3]; 2],
}

impl Part {
    fn fan(polygon: &[Corner]) -> Vec<Part> {
        let part = |i: usize| {
            let corners = [polygon[0], polygon[i - 1], polygon[i]];
            Part {
                places: corners.map(|corner| on_screen(&corner)),
                values: [
                    corners.map(|Corner(_, value)| value),
                    corners.map(|Corner([.., w], _)| 1.0 / w),
                ],
            }
        };
        (2..polygon.len()).map(part).collect()
    }

    fn area(&self) -> f64 {
        let [a, b, c] = self.places;
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    fn weights(&self, p: [f64; 2]) -> [f64; 3] {
        let [a, b, c] = self.places;
        let edge = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        [edge(b, c), edge(c, a), edge(a, b)].map(|e| e / self.area())
    }

    /// The part's value at a place, and by how much it changes there when corners move by 1/256 px and a little.
    fn at(&self, p: [f64; 2], which: usize) -> (f64, f64) {
        let value = |p| (0..3).map(|i| self.weights(p)[i] * self.values[which][i]).sum::<f64>();
        let here = value(p);
        let slope = (value([p[0] + 1.0, p[1]]) - here).abs() + (value([p[0], p[1] + 1.0]) - here).abs();
        (here, slope / 200.0 + 2e-6)
    }

    /// The least height, below which snapped corners make other triangles.
    fn height(&self) -> f64 {
        let [a, b, c] = self.places;
        let longest = [(a, b), (b, c), (c, a)].map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
        self.area().abs() / longest.into_iter().fold(1e-9, f64::max)
    }
}

type Near = State<pipeline::PerspectiveCorrected, i32, i32, 5>;

/// A state with the near plane and up to four others, and the same planes in float64.
fn planes(random: &mut Random) -> (Near, Vec<[f64; 4]>) {
    let mut planes = Planes::<i32, 5>::default();
    let mut exact = Vec::new();
    planes.push(block([0.0, 0.0, 1.0, 1.0])).unwrap();
    exact.push([0.0, 0.0, 1.0, 1.0]);
    for _ in 0..random.below(5) {
        let plane = block([
            random.unit() * 2.0 - 1.0,
            random.unit() * 2.0 - 1.0,
            random.unit() * 0.5,
            random.unit(),
        ]);
        planes.push(plane).unwrap();
        exact.push(floats(plane));
    }
    (state().with_planes(planes), exact)
}

/// z = ¾·w − ¼, so that the near plane is at w = 1/7, before the camera.
fn vertex(random: &mut Random) -> (Vertex<1>, Corner) {
    let w = random.unit() * 3.0 - 0.6;
    let side = |random: &mut Random| (random.unit() * 3.0 - 1.5) * w.abs().max(0.4);
    let (x, y) = (side(random), side(random));
    let position = block([x, y, 0.75 * w - 0.25, w]);
    let value = unit(random.unit());
    ((position, [value]), Corner(floats(position), real(value)))
}

fn drawn<I>(state: &State<I, i32, i32, 5>, vertices: &[Vertex<1>]) -> Vec<Seen>
where
    I: pipeline::Interpolation,
{
    let mut pixels = picture(Seen::default());
    let look = program(|at, [value]: [i32; 1]| Some(Seen(value, at.inverse_w().to_fixed(24) as i32, 1, 0)));
    draw(state, &mut buffer(&mut pixels), &mut NoDepth, &look, vertices);
    pixels
}

#[test]
fn values_and_inverse_w_are_those_of_the_fan() {
    let mut random = Random(7);
    let (mut checked, mut through_planes) = (0, 0);
    for case in 0..400 {
        let (state, planes) = planes(&mut random);
        let given = [(); 3].map(|()| vertex(&mut random));
        let polygon = clipped(given.map(|(_, corner)| corner).to_vec(), &planes);
        let fan = Part::fan(&polygon);
        if fan.is_empty() || fan.iter().any(|part| part.height() < 2.0) {
            continue;
        }
        through_planes += usize::from(polygon.len() > 3);
        let vertices = given.map(|(vertex, _)| vertex);
        let linear = drawn(&state.clone().linear(), &vertices);
        let corrected = drawn(&state, &vertices);
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let inside = |part: &&Part| part.weights(p).into_iter().all(|weight| weight > 0.02);
            let Some(part) = fan.iter().find(inside) else {
                continue;
            };
            checked += 1;
            let (got, flat) = (pixel(&corrected, x, y), pixel(&linear, x, y));
            assert_eq!((got.2, flat.2), (1, 1), "case {case}: ({x}, {y}) is not drawn");
            let (value, tolerance) = part.at(p, 0);
            near(real(flat.0), value, tolerance);
            let (inverse, tolerance) = part.at(p, 1);
            for seen in [got, flat] {
                near(f64::from(seen.1) / f64::from(1 << 24), inverse, tolerance);
            }
        }
    }
    assert!(checked > 500_000 && through_planes > 60, "{checked} {through_planes}");
}

/// Front and back are told of what planes have left, whichever way values are interpolated: each is the other's rest.
#[test]
fn one_of_front_and_back_is_drawn() {
    let mut random = Random(11);
    let mut both = [0; 2];
    for case in 0..400 {
        let (mut state, planes) = planes(&mut random);
        let given = [(); 3].map(|()| vertex(&mut random));
        let fan = Part::fan(&clipped(given.map(|(_, corner)| corner).to_vec(), &planes));
        if fan.is_empty() || fan.iter().any(|part| part.height() < 2.0) {
            continue;
        }
        let is_front = fan[0].area() > 0.0;
        let vertices = given.map(|(vertex, _)| vertex);
        let all = drawn(&state.clone().linear(), &vertices);
        if !all.iter().any(|seen| seen.2 == 1) {
            continue;
        }
        both[usize::from(is_front)] += 1;
        for culling in [Culling::Front, Culling::Back] {
            state.culling = culling;
            let seen = [drawn(&state, &vertices), drawn(&state.clone().linear(), &vertices)];
            let is_drawn = is_front == (culling == Culling::Back);
            for seen in seen {
                let count = seen.iter().filter(|seen| seen.2 == 1).count();
                assert_eq!(count > 0, is_drawn, "case {case}, {culling:?}");
            }
        }
    }
    assert!(both[0] > 50 && both[1] > 50, "{both:?}");
}

/// Of a line that planes cut: at each pixel the value and 1/w of the nearest place of what is left, linear on the screen.
#[test]
fn lines_are_linear_between_their_cut_ends() {
    let mut random = Random(13);
    let mut checked = 0;
    for _ in 0..600 {
        let (state, planes) = planes(&mut random);
        let state: State<Linear, i32, i32, 5> = state.linear();
        let given = [(); 2].map(|()| vertex(&mut random));
        let mut ends = given.map(|(_, corner)| corner);
        let mut is_left = true;
        for plane in &planes {
            let [from, to] = ends.map(|corner| (0..4).map(|i| plane[i] * corner.0[i]).sum::<f64>());
            is_left &= from >= 0.0 || to >= 0.0;
            if from < 0.0 && is_left {
                ends[0] = cut(ends[0], ends[1], from, to);
            } else if to < 0.0 && is_left {
                ends[1] = cut(ends[0], ends[1], from, to);
            }
        }
        let [a, b] = ends.map(|corner| on_screen(&corner));
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = along[0].hypot(along[1]);
        if !is_left || !(20.0..2000.0).contains(&length) {
            continue;
        }
        let mut pixels = picture(Seen::default());
        let look = program(|at, [value]: [i32; 1]| Some(Seen(value, at.inverse_w().to_fixed(24) as i32, 1, 0)));
        let vertices = given.map(|(vertex, _)| vertex);
        pipeline::lines(&state, &mut buffer(&mut pixels), &mut NoDepth, &look, vertices);
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            let seen = pixel(&pixels, x, y);
            if seen.2 == 0 {
                continue;
            }
            checked += 1;
            let to = [f64::from(x) + 0.5 - a[0], f64::from(y) + 0.5 - a[1]];
            let t = ((to[0] * along[0] + to[1] * along[1]) / length.powi(2)).clamp(0.0, 1.0);
            let between = |a: f64, b: f64| (a + t * (b - a), (b - a).abs() / length / 100.0 + 2e-6);
            let (value, tolerance) = between(ends[0].1, ends[1].1);
            near(real(seen.0), value, tolerance);
            let (inverse, tolerance) = between(1.0 / ends[0].0[3], 1.0 / ends[1].0[3]);
            near(f64::from(seen.1) / f64::from(1 << 24), inverse, tolerance);
        }
    }
    assert!(checked > 10_000, "{checked}");
}

/// A depth buffer that is smaller than the picture limits what is drawn, of triangles and of lines.
#[test]
fn nothing_is_drawn_beyond_the_depth_buffer() {
    let all = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]].map(|[x, y]| (block([x, y, 0.0, 1.0]), []));
    let white = program(|_, []: [i32; 0]| Some(1u8));
    let (mut pixels, mut depths) = (picture(0u8), vec![FAR; 40 * 30]);
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Buffer::new(&mut depths, 40, 30).unwrap());
    pipeline::triangles(&state(), &mut buffer(&mut pixels), &mut depth, &white, all);
    assert_eq!(course::lit(&pixels).len(), 40 * 30);
    let (mut pixels, mut depths) = (picture(0u8), vec![FAR; 40 * 30]);
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Buffer::new(&mut depths, 40, 30).unwrap());
    let diagonal = [[-1.0, -1.0], [1.0, 1.0]].map(|[x, y]| (block([x, y, 0.0, 1.0]), []));
    pipeline::lines(&state(), &mut buffer(&mut pixels), &mut depth, &white, diagonal);
    assert_eq!(course::lit(&pixels).len(), 30);
}

/// The core's own numbers are what float64 is given: nothing is rounded on the way there.
#[test]
fn planes_are_given_exactly() {
    let plane: Block<i32, 4> = block([0.3, -0.7, 0.1, 0.9]);
    assert_eq!(block(floats(plane)), plane);
}
