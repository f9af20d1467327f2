//! Random lists through the core's pipeline and through float64's: a pixel of the core's is one that float64 draws too, of the list
//! as it is or moved by a little.
//!
//! Each kind of list stresses one thing; the seeds are fixed, so a failure names a list that can be drawn again;
//! `FIXEL_SEEDS=1000..6000` draws others.

mod random;

use fixel::clip::Planes;
use fixel::depth::{Depth, DepthBuffer, FAR, LessOrEqual, NoDepth};
use fixel::num::Block;
use fixel::pipeline::{self, Color, Culling, Interpolation, Pixel, Program, State};
use fixel::target::Buffer;
use fixel::viewport::Viewport;
use fixel_host::reference::pipeline as float;
use float::program::{Colors, Key, VERTEX, Values};
use float::{Framebuffer, Geometry, Topology};
use random::{Random, none_unexplained, seeds};

const SIDE: u16 = 64;
const LISTS: u64 = 60;
const PRIMITIVES: i32 = 6;

/// In px: the core rounds corners to 1/256, and a corner that a plane made, of up to six, may lie off the plane of three others by
/// nine times what that moves them.
const MOVED: f64 = 9.0 * std::f64::consts::SQRT_2 / 512.0;

/// Of five by five ways to move it, that which does not.
const STILL: usize = 12;

/// Of values up to 1, a quarter of a level of 255: for the arithmetic of values in 2^-20, and for rows that are moved to stay within the
/// range of corners that a plane made (`varying::Perspective`).
const ERROR: f64 = 1.0 / (1 << 10) as f64;
const ONE: i32 = 1 << 20;

/// A vertex: where it is in clip space, and what it carries. The number of the primitive is the same at all of its vertices.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    position: [i32; 4],
    values: [i32; 2],
    primitive: i32,
}

/// A pixel: the primitive, 0 for none, and its values.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Shown {
    primitive: i32,
    values: [i32; 2],
}

impl Color for Shown {}

/// Both programs hand on what vertices carry.
struct Carry;

impl Program for Carry {
    type Vertex = Vertex;
    type Varying = [i32; 3];
    type At = Pixel;
    type Output = Shown;

    fn vertex(&self, vertex: &Vertex) -> (Block<i32, 4>, [i32; 3]) {
        let [u, v] = vertex.values;
        (Block::from_integers(vertex.position), [u, v, vertex.primitive * ONE])
    }
    fn fragment(&self, _: Pixel, [u, v, primitive]: [i32; 3]) -> Option<Shown> {
        Some(Shown {
            primitive: (primitive + ONE / 2) / ONE,
            values: [u, v],
        })
    }
}

const CARRIED: Key = "carried";

impl float::Program for Carry {
    type Uniforms = ();

    fn vertex(&self, attributes: &Values, (): &(), outputs: &mut Values) -> [f64; 4] {
        outputs.insert(CARRIED, attributes[CARRIED].clone());
        std::array::from_fn(|i| attributes[VERTEX][i])
    }
    fn fragment(&self, _: [f64; 4], inputs: &Values, (): &(), colors: &mut Colors) -> bool {
        let carried = &inputs[CARRIED];
        colors.insert(0, [carried[0], carried[1], carried[2].round(), 1.0]);
        true
    }
}

/// A list and how it is drawn.
struct List {
    vertices: Vec<Vertex>,
    lines: bool,
    /// Beside the near plane.
    planes: Vec<[i32; 4]>,
    culling: Culling,
    tested: bool,
    linear: bool,
}

impl List {
    fn by_core(&self) -> Vec<Shown> {
        let mut pixels = vec![Shown::default(); usize::from(SIDE) * usize::from(SIDE)];
        let mut depths = vec![FAR; pixels.len()];
        if self.tested {
            let depths = Buffer::new(&mut depths, SIDE, SIDE).unwrap();
            self.onto(&mut pixels, &mut DepthBuffer::<_, LessOrEqual>::new(depths));
        } else {
            self.onto(&mut pixels, &mut NoDepth);
        }
        pixels
    }

    fn onto(&self, pixels: &mut [Shown], depth: &mut impl Depth) {
        let mut planes = Planes::<i32, 3>::default();
        for plane in [[0, 0, 1, 1]].iter().chain(&self.planes) {
            planes.push(Block::from_integers(*plane)).unwrap();
        }
        let viewport = Viewport::<i32>::new(0, 0, SIDE, SIDE).unwrap().samples_at_centers();
        let mut state = State::new(viewport).with_planes(planes);
        state.culling = self.culling;
        if self.linear {
            self.drawn(&state.linear(), pixels, depth);
        } else {
            self.drawn(&state, pixels, depth);
        }
    }

    fn drawn<I: Interpolation>(&self, state: &State<I, i32, i32, 3>, pixels: &mut [Shown], depth: &mut impl Depth) {
        let mut target = Buffer::new(pixels, SIDE, SIDE).unwrap();
        if self.lines {
            pipeline::lines(state, &mut target, depth, &Carry, &self.vertices);
        } else {
            pipeline::triangles(state, &mut target, depth, &Carry, &self.vertices);
        }
    }

    /// Float64's pixels, with everything moved by so many px.
    fn by_float(&self, moved: [f64; 2]) -> Vec<[f64; 4]> {
        self.by_float_each(moved, |_| moved)
    }

    /// Float64's pixels, with the planes moved by so many px, and each vertex by its own.
    fn by_float_each(&self, planes: [f64; 2], each: impl FnMut(&Vertex) -> [f64; 2]) -> Vec<[f64; 4]> {
        let clip = |px: f64| 2.0 * px / f64::from(SIDE);
        let [dx, dy] = planes.map(clip);
        let moves: Vec<[f64; 2]> = self.vertices.iter().map(each).collect();
        let place = |(vertex, moved): (&Vertex, &[f64; 2])| {
            let ([x, y, z, w], [dx, dy]) = (vertex.position.map(f64::from), moved.map(clip));
            [x + dx * w, y + dy * w, z, w]
        };
        let carried = |vertex: &Vertex| {
            let [u, v] = vertex.values.map(|v| f64::from(v) / f64::from(ONE));
            [u, v, f64::from(vertex.primitive)]
        };
        let topology = if self.lines {
            Topology::Lines
        } else {
            Topology::Triangles
        };
        let geometry = Geometry::new(topology, self.vertices.iter().zip(&moves).map(place))
            .with(CARRIED, self.vertices.iter().map(carried));
        // A plane moves along: p · (x − dx·w, y − dy·w, z, w).
        let plane = |plane: &[i32; 4]| {
            let [a, b, c, d] = plane.map(f64::from);
            [a, b, c, d - a * dx - b * dy]
        };
        let side = u32::from(SIDE);
        let state = float::State {
            clip_planes: [[0, 0, 1, 1]].iter().chain(&self.planes).map(plane).collect(),
            depth: float::state::Depth {
                test: self.tested,
                write: self.tested,
            },
            cull: match self.culling {
                Culling::Off => None,
                Culling::Front => Some(float::state::Face::Front),
                Culling::Back => Some(float::state::Face::Back),
                Culling::FrontAndBack => Some(float::state::Face::FrontAndBack),
            },
            interpolation: if self.linear {
                float::state::Interpolation::Linear
            } else {
                float::state::Interpolation::PerspectiveCorrected
            },
            ..float::State::new(float::state::Viewport::of(side, side))
        };
        let mut framebuffer = Framebuffer::new(side, side, [0.0; 4]);
        float::draw(&mut framebuffer, &state, &Carry, &(), &geometry);
        let image = &framebuffer.colors[&0];
        let places = (0..i64::from(side)).flat_map(|y| (0..i64::from(side)).map(move |x| (x, y)));
        places.filter_map(|(x, y)| image.get(x, y)).collect()
    }
}

impl List {
    /// Float64's pixels where each vertex moves by itself, in many ways.
    fn apart(&self) -> Vec<Vec<[f64; 4]>> {
        let mut random = Random::new("apart", 1);
        let mut moved = || [(); 2].map(|()| random.within(-MOVED, MOVED));
        (0..200).map(|_| self.by_float_each(moved(), |_| moved())).collect()
    }

    /// How far a value of a pixel may be off because the core moves rows of what is cut, those of value/w and of 1/w each by itself, to
    /// stay within the corners' range: by (2n − 4) · δ of the gradient for n corners, as `compare/piece.rs` has it.
    fn held(&self, primitive: i32, pixel: usize, value: usize) -> f64 {
        let own: Vec<&Vertex> = self.vertices.iter().filter(|v| v.primitive == primitive).collect();
        let [a, b, c] = own[..] else {
            return 0.0;
        };
        let is_beyond = |vertex: &&Vertex, plane: &[i32; 4]| {
            let distance = plane.iter().zip(vertex.position);
            distance.map(|(&p, v)| i64::from(p) * i64::from(v)).sum::<i64>() < 0
        };
        let planes = || [[0, 0, 1, 1]].into_iter().chain(self.planes.iter().copied());
        let is_cut = planes().any(|plane| own.iter().any(|vertex| is_beyond(vertex, &plane)));
        if self.linear || !is_cut {
            return 0.0;
        }
        let side = usize::from(SIDE);
        let half = f64::from(SIDE) / 2.0;
        let at = [pixel % side, pixel / side].map(|i| (i as f64 + 0.5) / half - 1.0);
        let rows = [a, b, c].map(|v| [0, 1, 3].map(|i| f64::from(v.position[i])));
        let det = |m: [[f64; 3]; 3]| {
            let [[a, b, c], [d, e, f], [g, h, i]] = m;
            a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
        };
        // The function on the screen that is v/w at each vertex: there and its gradient per px.
        let function = |v: [f64; 3]| {
            let [x, y, one] = [0, 1, 2].map(|column| {
                let mut replaced = rows;
                (0..3).for_each(|row| replaced[row][column] = v[row]);
                det(replaced) / det(rows)
            });
            (x * at[0] + y * at[1] + one, x.hypot(y) / half)
        };
        let values = [a, b, c].map(|v| f64::from(v.values[value]) / f64::from(ONE));
        let ((n, n_slope), (q, q_slope)) = (function(values), function([1.0; 3]));
        let corners = 4 + self.planes.len();
        let by = (2 * corners - 4) as f64 * std::f64::consts::SQRT_2 / 512.0;
        (n_slope + (n / q).abs() * q_slope) * by / (q.abs() - q_slope * by).max(0.0)
    }
}

/// How a list's pixels compare.
struct Judged {
    /// The first whose values are not those that float64 has there, and how many there are.
    bad: Option<String>,
    /// Pixels with a primitive that float64 has there in next to no way: slivers, which turn over when one corner moves.
    alone: usize,
    /// Pixels with another primitive than float64 has unmoved.
    other: usize,
    drawn: usize,
}

fn judged(list: &List) -> Judged {
    let steps = [-MOVED, -MOVED / 2.0, 0.0, MOVED / 2.0, MOVED];
    let floats: Vec<Vec<[f64; 4]>> = (steps.iter().flat_map(|&dx| steps.map(|dy| list.by_float([dx, dy])))).collect();
    let core = list.by_core();
    let same = |floats: &[Vec<[f64; 4]>], i: usize| {
        let primitive = f64::from(core[i].primitive);
        floats
            .iter()
            .map(|f| f[i])
            .filter(|f| f[2] == primitive)
            .collect::<Vec<_>>()
    };
    let fits = |floats: &[Vec<[f64; 4]>], i: usize, held: bool| {
        // Between the least and the largest that the same primitive has there, and as much beyond: where only a few ways to move it
        // cover the pixel, these are all to one side of it.
        let same = same(floats, i);
        let within = |k: usize| {
            let value = f64::from(core[i].values[k]) / f64::from(ONE);
            let all = same.iter().map(|f| f[k]);
            let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            let row = if held { list.held(core[i].primitive, i, k) } else { 0.0 };
            let beyond = high - low + ERROR + row;
            low - beyond <= value && value <= high + beyond
        };
        core[i].primitive == 0 || within(0) && within(1)
    };
    let (alone, known): (Vec<usize>, Vec<usize>) = (0..core.len()).partition(|&i| same(&floats, i).len() < 3);
    let mut bad: Vec<usize> = known.into_iter().filter(|&i| !fits(&floats, i, false)).collect();
    if !bad.is_empty() {
        // A sliver has other values, too, where its corners move apart; and what is cut may have rows moved.
        let apart = list.apart();
        bad.retain(|&i| !fits(&apart, i, true));
    }
    let described = bad.first().map(|&i| {
        let (x, y) = (i % usize::from(SIDE), i / usize::from(SIDE));
        format!(
            "{} pixels, first ({x}, {y}): {:?} {:?}",
            bad.len(),
            core[i],
            same(&floats, i)
        )
    });
    Judged {
        bad: described,
        alone: alone.len(),
        other: (0..core.len())
            .filter(|&i| f64::from(core[i].primitive) != floats[STILL][i][2])
            .count(),
        drawn: core.iter().filter(|shown| shown.primitive != 0).count(),
    }
}

/// Draws the lists of a kind; at most one pixel in `excused` of what is drawn may have another primitive than float64 has.
fn compared(kind: &str, excused: usize, make: impl Fn(&mut Random) -> List) {
    let all = seeds(kind, LISTS, &[]);
    let judged: Vec<Judged> = all
        .iter()
        .map(|&seed| judged(&make(&mut Random::new(kind, seed))))
        .collect();
    let sum = |of: fn(&Judged) -> usize| judged.iter().map(of).sum::<usize>();
    let (drawn, other, alone) = (sum(|j| j.drawn), sum(|j| j.other), sum(|j| j.alone));
    println!("{kind}: drawn {drawn}, another primitive {other}, of next to no way {alone}");
    let bad = all
        .iter()
        .zip(&judged)
        .filter_map(|(seed, judged)| Some(format!("{kind} {seed}: {}", judged.bad.as_ref()?)));
    let bad: Vec<String> = bad.collect();
    none_unexplained(&bad, all.len());
    assert!(drawn > 50 * all.len(), "{kind}: {drawn} pixels are too few to tell");
    assert!(
        other * excused < drawn,
        "{kind}: {other} of {drawn} pixels have another primitive"
    );
    assert!(
        alone <= 1 + drawn / 100_000,
        "{kind}: {alone} of {drawn} pixels have one that is hardly ever there"
    );
}

/// Vertices within 1.3 times the viewport, with w from `least` to `most`. Where `flat`, each primitive has a depth of its own; else
/// depth grows with w, and the near plane is at w = 100.
fn list(random: &mut Random, corners: i32, [least, most]: [f64; 2], flat: bool) -> List {
    within(random, 1.3, corners, [least, most], flat)
}

/// The same within `reach` times the viewport.
fn within(random: &mut Random, reach: f64, corners: i32, [least, most]: [f64; 2], flat: bool) -> List {
    let mut vertices = Vec::new();
    for primitive in 1..=PRIMITIVES {
        for _ in 0..corners {
            let w = random.within(least, most);
            let reach = reach * w.abs().max(100.0);
            let [x, y] = [(); 2].map(|()| random.within(-reach, reach));
            let z = if flat {
                w * f64::from(primitive * 5 % 7) / 8.0
            } else {
                w - 200.0
            };
            vertices.push(Vertex {
                position: [x, y, z, w].map(|c| (c * 256.0).round() as i32),
                values: [(); 2].map(|()| (random.unit() * f64::from(ONE)) as i32),
                primitive,
            });
        }
    }
    List {
        vertices,
        lines: false,
        planes: Vec::new(),
        culling: Culling::Off,
        tested: false,
        linear: false,
    }
}

/// A plane that cuts the viewport.
fn plane(random: &mut Random) -> [i32; 4] {
    let mut component = |reach: f64| random.within(-reach, reach) as i32;
    [component(1000.0), component(1000.0), component(100.0), component(400.0)]
}

#[test]
fn on_the_screen() {
    compared("on_the_screen", 1000, |random| list(random, 3, [1000.0, 1000.0], false));
}

#[test]
fn in_perspective() {
    compared("in_perspective", 1000, |random| list(random, 3, [300.0, 3000.0], false));
}

#[test]
fn from_behind_the_camera() {
    compared("from_behind_the_camera", 1000, |random| {
        list(random, 3, [-1000.0, 3000.0], false)
    });
}

#[test]
fn clip_planes() {
    compared("clip_planes", 1000, |random| List {
        planes: vec![plane(random), plane(random)],
        ..list(random, 3, [-300.0, 3000.0], false)
    });
}

#[test]
fn depths_and_faces() {
    compared("depths_and_faces", 1000, |random| List {
        culling: if random.one_in(2) {
            Culling::Back
        } else {
            Culling::Front
        },
        tested: true,
        ..list(random, 3, [300.0, 3000.0], true)
    });
}

#[test]
fn linear_over_the_screen() {
    compared("linear_over_the_screen", 1000, |random| List {
        planes: vec![plane(random)],
        linear: true,
        ..list(random, 3, [300.0, 3000.0], false)
    });
}

/// Where a line's other coordinate lies between two pixels, either may be drawn (formats: 01.2): of lines that run over an odd
/// number of pixels, it never does. With both ends on the viewport: float64 cuts lines at its border first, which moves their pixels.
/// An end within 1/512 px of a border of pixels, one in fifty of them, may be on the other side of it, and some of its line too.
#[test]
fn lines() {
    let pixel = |[x, y, _, w]: [i32; 4]| [x, y].map(|c| (i64::from(c) + i64::from(w)) * 32 / i64::from(w));
    let is_odd = |ends: &[Vertex]| {
        let [a, b] = [0, 1].map(|i| pixel(ends[i].position));
        (0..2)
            .map(|i| a[i].abs_diff(b[i]))
            .max()
            .is_some_and(|steps| steps % 2 == 1)
    };
    compared("lines", 50, |random| {
        let mut drawn = within(random, 0.97, 2, [300.0, 3000.0], false);
        drawn.vertices = drawn
            .vertices
            .chunks(2)
            .filter(|ends| is_odd(ends))
            .flatten()
            .copied()
            .collect();
        List { lines: true, ..drawn }
    });
}
