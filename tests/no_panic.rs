//! No input whatsoever panics, overflows or indexes out of bounds: this profile keeps overflow checks and debug
//! assertions on. What is drawn is not looked at here.

use fixel::blend::{Blend, Equation, Factor, Rgba};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{Always, DepthBuffer, LessOrEqual, NoDepth, Options, Relation, Switched};
use fixel::disc::Disc;
use fixel::draw;
use fixel::fragment::{Antialiased, Compact, Fragment};
use fixel::matrix::Matrix;
use fixel::mesh::{Cache, Mesh};
use fixel::num::{Block, Word};
use fixel::pipeline::{
    self, Culling, Filtering, FragCoord, HeadRoom, Interpolation, LinearFilter, Picture, Program, Region, Sampler,
    Shaded, State, Surface, Wrapping, clip_line, clip_polygon, clip_to_region, get, set,
};
use fixel::screen::{Center, Corner, FineDepth, Position, Shape, SubPx};
use fixel::span::Corners;
use fixel::square::Square;
use fixel::target::{Buffer, Target};
use fixel::varying::{Color565, Linear, Linear32, Perspective, Perspective32, PerspectiveSpans, Varying};
use fixel::view::{Carried, Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;

/// Says that it holds `window` and lends rows of `row` pixels, too few of them or too many.
struct Anywhere<P> {
    window: Window,
    row: Vec<P>,
}

impl<P: Copy> Target for Anywhere<P> {
    type Pixel = P;
    fn window(&self) -> Window {
        self.window
    }
    fn row(&mut self, row: i32) -> &mut [P] {
        assert!(
            (self.window.top..self.window.bottom).contains(&row),
            "row {row} was not offered"
        );
        &mut self.row
    }
}

/// Looks at the values, so that they are computed.
struct Look<V>(std::marker::PhantomData<V>);

impl<V: Varying> Fragment for Look<V> {
    type Varying = V;
    type Pixel = u8;
    fn shade(&self, values: V::Values, below: u8) -> Option<u8> {
        let _ = std::hint::black_box(values);
        Some(below.wrapping_add(1))
    }
}

impl<V: Varying> Antialiased for Look<V> {
    fn shade_part(&self, values: V::Values, part: i32, below: u8) -> Option<u8> {
        assert!((0..=1 << 28).contains(&part));
        self.shade(values, below)
    }
}

fn look<V>() -> Look<V> {
    Look(std::marker::PhantomData)
}

/// Any number, the ends of the range and small ones more often.
fn int() -> impl Strategy<Value = i32> + Clone {
    const ENDS: &[i32] = &[i32::MIN, i32::MIN + 1, i32::MAX, 0, 1, -1, 1 << 30, -(1 << 30), 1 << 29];
    prop_oneof![3 => any::<i32>(), 2 => prop::sample::select(ENDS), 2 => -300..300i32, 1 => (0..31u32).prop_map(|b| 1 << b)]
}

fn long() -> impl Strategy<Value = i64> + Clone {
    const ENDS: &[i64] = &[i64::MIN, i64::MIN + 1, i64::MAX, 0, 1, -1, 1 << 62, -(1 << 62), 1 << 61];
    prop_oneof![3 => any::<i64>(), 2 => prop::sample::select(ENDS), 2 => -300..300i64, 1 => (0..63u32).prop_map(|b| 1 << b)]
}

fn exponent() -> impl Strategy<Value = i32> + Clone {
    prop_oneof![4 => -40..40i32, 1 => any::<i32>(), 1 => prop::sample::select(&[i32::MIN, i32::MAX][..])]
}

/// A window anywhere, inverted, empty, as large as numbers allow, or an ordinary one.
fn window() -> impl Strategy<Value = Window> {
    let anywhere = (int(), int(), int(), int()).prop_map(|(l, t, r, b)| Window::new(l, t, r, b));
    let ordinary =
        (-20..20i32, -20..20i32, -3..40i32, -3..40i32).prop_map(|(l, t, w, h)| Window::new(l, t, l + w, t + h));
    prop_oneof![1 => anywhere, 2 => ordinary]
}

/// Positions near the windows, and anywhere within the guard band.
fn positions() -> impl Strategy<Value = [Position; 3]> {
    let near = (-9000..9000i32, -9000..9000i32);
    let one = prop_oneof![2 => near, 1 => (int(), int())];
    let nearest = |(x, y)| Position::nearest(SubPx::from_bits(x), SubPx::from_bits(y));
    prop::array::uniform3(one).prop_map(move |p| p.map(nearest))
}

/// Draws with no depth, and with depth in another window.
fn draw_corners<V: Varying>(corners: [Corner<V>; 3], window: Window, depth_window: Window, length: usize) {
    let mut color = Anywhere {
        window,
        row: vec![0; length],
    };
    draw::triangle(&mut color, &mut NoDepth, corners, &look());
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Anywhere {
        window: depth_window,
        row: vec![9999; 50],
    });
    draw::triangle(&mut color, &mut depth, corners, &look());

    let [a, b, c] = corners;
    draw::segment(&mut color, &mut NoDepth, [a, b], &look());
    draw::segment(&mut color, &mut depth, [b, c], &look());
    draw::wu_line(&mut color, &mut NoDepth, [a, b], &look());
    draw::wu_line(&mut color, &mut depth, [b, c], &look());
}

/// A line for words of 64 bits: eight times as far out.
struct Wide<V>([Corner<V>; 2]);

impl<V> Corners for Wide<V> {
    fn count(&self) -> usize {
        2
    }
    fn position(&self, index: usize) -> (i32, i32) {
        let (x, y) = self.0.position(index);
        (8 * x, 8 * y)
    }
}

impl<V: Varying> Shape for Wide<V> {
    type Varying = V;
    fn depth(&self, index: usize) -> i32 {
        self.0.depth(index)
    }
    fn varying(&self, index: usize) -> V {
        self.0.varying(index)
    }
}

/// Squares and discs with no depth, and with depth in another window.
fn draw_around<V: Varying>(center: Center, size: SubPx, varying: V, window: Window, depth_window: Window) {
    let row = vec![0; 50];
    let mut color = Anywhere { window, row };
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Anywhere {
        window: depth_window,
        row: vec![9999; 50],
    });
    let (square, disc) = (Square::new(center, size, varying), Disc::new(center, size, varying));
    draw::square(&mut color, &mut NoDepth, &square, &look());
    draw::square(&mut color, &mut depth, &square, &look());
    draw::disc(&mut color, &mut NoDepth, &disc, &look());
    draw::disc(&mut color, &mut depth, &disc, &look());
}

/// Everything that makes a view of words `T` and `W`, as numbers.
#[derive(Debug, Clone)]
struct Parts<T> {
    projection: Option<([T; 16], i32)>,
    planes: Vec<([T; 4], i32)>,
    viewport: (i32, i32, u16, u16, bool, bool),
    depth_range: DepthRange,
    behind: Behind,
    cull: Cull,
    vertices: [([T; 4], i32); 3],
    carried: [[i32; 2]; 3],
}

fn parts<T: Word>(word: impl Strategy<Value = T> + Clone + 'static) -> impl Strategy<Value = Parts<T>> {
    use prop::sample::select;
    let point = || (prop::array::uniform4(word.clone()), exponent());
    let near = prop::array::uniform4(-9..10i32).prop_map(|p| (p.map(T::from_i32), 0));
    let vertices = prop_oneof![prop::array::uniform3(point()), prop::array::uniform3(near)];
    let matrix = (prop::array::uniform16(word.clone()), exponent());
    let edges = (int(), int(), any::<u16>(), any::<u16>(), any::<bool>(), any::<bool>());
    let small = (-9..9i32, -9..9i32, 0..70u16, 0..70u16, any::<bool>(), any::<bool>());
    (
        prop::option::of(matrix),
        prop::collection::vec(point(), 0..4),
        prop_oneof![1 => edges, 3 => small],
        select(&[DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited][..]),
        select(&[Behind::Cut, Behind::Divide][..]),
        select(&[Cull::Nothing, Cull::Clockwise, Cull::CounterClockwise][..]),
        vertices,
        prop::array::uniform3(prop::array::uniform2(int())),
    )
        .prop_map(
            |(projection, planes, viewport, depth_range, behind, cull, vertices, carried)| Parts {
                projection,
                planes,
                viewport,
                depth_range,
                behind,
                cull,
                vertices,
                carried,
            },
        )
}

fn draw_view<T: Word, W: Word>(parts: &Parts<T>, window: Window) {
    let (left, top, width, height, up, centers) = parts.viewport;
    let Ok(mut viewport) = Viewport::<W>::new(left, top, width, height) else {
        return;
    };
    viewport = if up { viewport.y_up() } else { viewport };
    viewport = if centers {
        viewport.samples_at_centers()
    } else {
        viewport
    };
    let mut planes = Planes::<T, 3>::default();
    for &(plane, exponent) in &parts.planes {
        planes.push(Block::new(plane, exponent)).unwrap();
    }
    let matrix = |(m, e)| Matrix::from_rows(Block::new(m, e));
    let view = View {
        projection: parts.projection.map_or(Matrix::identity(), matrix),
        planes,
        viewport,
        depth_range: parts.depth_range,
        behind: parts.behind,
        cull: parts.cull,
    };
    draw_kind::<T, W, Linear<2>>(&view, parts, window, |carried| carried);
    draw_kind::<T, W, Perspective<2>>(&view, parts, window, |carried| carried);
    draw_kind::<T, W, Linear32<2>>(&view, parts, window, |carried| carried);
    draw_kind::<T, W, Perspective32<2>>(&view, parts, window, |carried| carried);
    draw_kind::<T, W, PerspectiveSpans<2, 128>>(&view, parts, window, |carried| carried);
    draw_kind::<T, W, (Linear<2>, Perspective<2>)>(&view, parts, window, |carried| (carried, carried));
}

fn draw_kind<T: Word, W: Word, V: Carried>(
    view: &View<T, W, 3>,
    parts: &Parts<T>,
    window: Window,
    carry: impl Fn([i32; 2]) -> V::Vertex,
) {
    let vertices = [0, 1, 2].map(|i| {
        let (position, exponent) = parts.vertices[i];
        Vertex {
            position: Block::new(position, exponent),
            carried: carry(parts.carried[i]),
        }
    });
    let mut color = Anywhere {
        window,
        row: vec![0; 70],
    };
    let mut depth = DepthBuffer::<_, Always>::new(Anywhere {
        window,
        row: vec![0; 70],
    });
    draw::primitive(view, &mut color, &mut depth, &vertices, &look::<V>());
    draw::primitive(view, &mut color, &mut depth, &vertices, &Compact(look::<V>()));
    let [a, b, c] = vertices;
    draw::primitive_segment(view, &mut color, &mut depth, &[a, b], &look::<V>());
    draw::primitive_wu_line(view, &mut color, &mut depth, &[b, c], &look::<V>());
    let size = SubPx::from_bits(parts.carried[0][0]);
    draw::primitive_square(view, &mut color, &mut depth, a.position, size, (), &look::<()>());
    draw::primitive_disc(view, &mut color, &mut depth, b.position, size, (), &look::<()>());
    let values = (parts.carried[1], parts.carried[2]);
    draw::primitive_billboard(
        view,
        &mut color,
        &mut depth,
        c.position,
        size,
        values,
        &look::<Linear<2>>(),
    );
}

/// A program that samples, blends and discards; its vertices come as they are.
struct Sampled<'a> {
    sampler: Sampler<Picture<'a, HeadRoom>, Filtering, Wrapping, Wrapping>,
    discards: i32,
}

impl<T: Word> Program<T> for Sampled<'_> {
    type Vertex = (Block<T, 4>, [i32; 2]);
    type Varying = [i32; 2];
    type At = FragCoord;
    type Output = (Option<Rgba>, Rgba, u8);

    fn vertex(&self, &vertex: &Self::Vertex) -> Self::Vertex {
        vertex
    }
    fn fragment(&self, at: FragCoord, [u, v]: [i32; 2]) -> Option<Self::Output> {
        let color = self.sampler.sample([u, v]);
        let _ = std::hint::black_box((at.inverse_w().to_fixed(16), at.z));
        let _ = self.sampler.filtered(LinearFilter).sample([v, u]);
        (at.x.wrapping_add(at.y) & 3 != self.discards).then_some(((u > 0).then_some(color), color, at.y as u8))
    }
}

/// What of a pipeline is not geometry.
#[derive(Debug, Clone)]
struct Drawing {
    texels: Vec<[i32; 4]>,
    linear: bool,
    wrapping: [Wrapping; 2],
    fraction_bits: u32,
    blend: Option<Blend>,
    culling: Culling,
    options: Options,
    discards: i32,
}

fn color() -> impl Strategy<Value = [i32; 4]> + Clone {
    prop::array::uniform4(int())
}

fn drawing() -> impl Strategy<Value = Drawing> {
    use prop::sample::select;
    const WRAPPINGS: &[Wrapping] = &[
        Wrapping::ClampToEdge,
        Wrapping::Repeat,
        Wrapping::MirroredRepeat,
        Wrapping::MirroredClampToEdge,
    ];
    const FACTORS: &[Factor] = &[
        Factor::SourceColor,
        Factor::OneMinusDestinationColor,
        Factor::SourceAlphaSaturate,
    ];
    const EQUATIONS: &[Equation] = &[
        Equation::Add,
        Equation::Subtract,
        Equation::ReverseSubtract,
        Equation::Max,
    ];
    const CULLINGS: &[Culling] = &[Culling::Off, Culling::Front, Culling::Back];
    const RELATIONS: &[Relation] = &[Relation::LessOrEqual, Relation::Greater, Relation::Always];
    let blend = (select(FACTORS), select(FACTORS), select(EQUATIONS), color()).prop_map(
        |(source, destination, equation, c)| Blend {
            source,
            destination,
            equation,
            constant: rgba(c),
        },
    );
    let options = (select(RELATIONS), any::<bool>()).prop_map(|(passes, stores)| Options { passes, stores });
    let wrapping = prop::array::uniform2(select(WRAPPINGS));
    (
        prop::collection::vec(color(), 6),
        any::<bool>(),
        wrapping,
        any::<u32>(),
        prop::option::of(blend),
        select(CULLINGS),
        options,
        0..5,
    )
        .prop_map(
            |(texels, linear, wrapping, fraction_bits, blend, culling, options, discards)| Drawing {
                texels,
                linear,
                wrapping,
                fraction_bits,
                blend,
                culling,
                options,
                discards,
            },
        )
}

fn rgba([r, g, b, alpha]: [i32; 4]) -> Rgba {
    Rgba {
        color: [r, g, b],
        alpha,
    }
}

fn draw_pipeline<T: Word, W: Word>(parts: &Parts<T>, drawing: &Drawing, window: Window) {
    let (left, top, width, height, up, _) = parts.viewport;
    let Ok(mut viewport) = Viewport::<W>::new(left, top, width, height) else {
        return;
    };
    viewport = if up {
        viewport.y_up()
    } else {
        viewport.samples_at_centers()
    };
    let mut planes = Planes::<T, 3>::default();
    for &(plane, exponent) in &parts.planes {
        planes.push(Block::new(plane, exponent)).unwrap();
    }
    let mut state = State::new(viewport).with_planes(planes);
    state.culling = drawing.culling;
    if drawing.linear {
        draw_lists(&state.linear(), parts, drawing, window);
    } else {
        draw_lists(&state, parts, drawing, window);
    }
}

fn draw_lists<I: Interpolation, T: Word, W: Word>(
    state: &State<I, T, W, 3>,
    parts: &Parts<T>,
    drawing: &Drawing,
    window: Window,
) {
    let texels: Vec<_> = drawing.texels.iter().map(|&c| rgba(c)).collect();
    let filter = if drawing.linear {
        Filtering::Linear
    } else {
        Filtering::Nearest
    };
    let [s, t] = drawing.wrapping;
    let sampler = Sampler::new(Picture::new(HeadRoom, &texels, 3, 2).unwrap(), drawing.fraction_bits);
    let program = Sampled {
        sampler: sampler.filtered(filter).wrapped(s, t),
        discards: drawing.discards,
    };
    let vertices = [0, 1, 2].map(|i| {
        let (position, exponent) = parts.vertices[i];
        (Block::new(position, exponent), parts.carried[i])
    });
    let anywhere = |length| Anywhere {
        window,
        row: vec![rgba(drawing.texels[0]); length],
    };
    let mut colors = (
        Surface::new(anywhere(70), HeadRoom).blended(drawing.blend),
        anywhere(30),
        (),
    );
    let mut depth = Switched::new(Anywhere {
        window,
        row: vec![9999; 60],
    });
    depth.options = drawing.options;
    pipeline::triangles(state, &mut colors, &mut depth, &program, &vertices);
    pipeline::lines(state, &mut colors, &mut depth, &program, &vertices);
    pipeline::triangles(state, &mut colors, &mut NoDepth, &program, &vertices);
    let mut places = [Shaded::EMPTY; 2];
    pipeline::lines_buffered(state, &mut colors, &mut NoDepth, &program, &vertices, &mut places);
    let [a, b, c] = vertices.map(|(position, _)| position);
    let mut cut = heapless::Vec::<_, 3>::new();
    let _ = (clip_polygon(&[a, b, c], a, &mut cut), clip_line([b, c], a));
}

/// Thin triangles whose weights do not fit are not drawn by them; random ones are hardly ever of this kind.
#[test]
fn thin_triangles_of_packed_colors() {
    for (points, reds) in [
        (
            [(11350, 687_885), (1_022_687, -557_084), (487_691, 101_503)],
            [131_064, 285_661, 816_644],
        ),
        (
            [(0, 0), (1_000_000, 999_999), (500_000, 500_000)],
            [0x8000, 0x1f_8000, 0x8000],
        ),
    ] {
        let corner = |(i, (x, y)): (usize, (i32, i32))| Corner {
            position: Position::new(SubPx::from_bits(x), SubPx::from_bits(y)).unwrap(),
            depth: FineDepth::ZERO,
            varying: Color565([reds[i], 0x8000, 0x8000]),
        };
        let corners: Vec<_> = points.into_iter().enumerate().map(corner).collect();
        let window = Window::new(0, 0, 64, 64);
        draw_corners([corners[0], corners[1], corners[2]], window, window, 64);
    }
}

/// Nothing is nothing.
#[test]
fn polygons_without_corners() {
    let window = Window::new(0, 0, 64, 64);
    fixel::span::scan::<i32>(&[(0, 0); 0], true, window, |_| panic!("nothing is covered"));
    fixel::span::scan::<i64>(&[(0, 0); 0], false, window, |_| panic!("nothing is covered"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn any_program_and_state_of_narrow_words(parts in parts(int()), drawing in drawing(), window in window()) {
        draw_pipeline::<i32, i32>(&parts, &drawing, window);
        draw_pipeline::<i32, i64>(&parts, &drawing, window);
    }

    #[test]
    fn any_program_and_state_of_wide_words(parts in parts(long()), drawing in drawing(), window in window()) {
        draw_pipeline::<i64, i32>(&parts, &drawing, window);
        draw_pipeline::<i64, i64>(&parts, &drawing, window);
    }

    #[test]
    fn any_region_and_pixel(sides in color(), a in (int(), int()), b in (int(), int()), window in window()) {
        let [left, bottom, right, top] = sides;
        let _ = clip_to_region(&Region { left, bottom, right, top }, [a, b]);
        let mut target = Anywhere { window, row: vec![0u8; 40] };
        let _ = (get(&mut target, a), set(&mut target, (SubPx::from_bits(b.0), SubPx::from_bits(b.1)), 1));
        let _ = fixel::line::Line::closed(a, b, Window::new(-5, -5, 30, 20)).take(100).count();
    }

    #[test]
    fn any_corners_in_any_window(
        positions in positions(), depths in prop::array::uniform3(any::<u32>()),
        values in prop::array::uniform3(prop::array::uniform2(int())), inverses in prop::array::uniform3(int()),
        over_w in prop::array::uniform3(prop::array::uniform2(int())),
        window in window(), depth_window in window(), length in 0..60usize,
    ) {
        fn corners<V>(positions: [Position; 3], depths: [u32; 3], varying: impl Fn(usize) -> V) -> [Corner<V>; 3] {
            [0, 1, 2].map(|i| Corner {
                position: positions[i],
                depth: FineDepth::from_bits(depths[i]),
                varying: varying(i),
            })
        }
        draw_corners(corners(positions, depths, |_| ()), window, depth_window, length);
        draw_corners(corners(positions, depths, |i| Linear(values[i])), window, depth_window, length);
        let honest = |i: usize| Perspective::new(values[i], inverses[i]);
        draw_corners(corners(positions, depths, honest), window, depth_window, length);
        let nonsense = |i: usize| Perspective { over_w: over_w[i], inverse: inverses[i], values: values[i] };
        draw_corners(corners(positions, depths, nonsense), window, depth_window, length);
        draw_corners(corners(positions, depths, |i| Linear32(values[i])), window, depth_window, length);
        let colors = |i: usize| Color565([values[i][0], values[i][1], inverses[i]]);
        draw_corners(corners(positions, depths, colors), window, depth_window, length);
        for of in [&honest as &dyn Fn(usize) -> Perspective<2>, &nonsense] {
            draw_corners(corners(positions, depths, |i| Perspective32(of(i))), window, depth_window, length);
            let spans = |i: usize| PerspectiveSpans::<2, 128>(of(i));
            draw_corners(corners(positions, depths, spans), window, depth_window, length);
        }
    }

    /// Whatever the indices say: an error, or triangles of vertices that there are.
    #[test]
    fn any_mesh(
        first in prop::collection::vec(prop_oneof![3 => 0..9u16, 2 => Just(u16::MAX), 1 => any::<u16>()], 0..20),
        second in prop::collection::vec(prop_oneof![0..9u16, Just(u16::MAX)], 0..20),
        ends in any::<bool>(), counts in prop::array::uniform2(prop_oneof![0..12usize, any::<usize>()]),
    ) {
        // Random lists hardly ever have the same faces.
        let like_first = |(&i, j)| if i == u16::MAX { i } else { j };
        let second: Vec<u16> = if ends { first.iter().zip(second).map(like_first).collect() } else { second };
        if let Ok(mesh) = Mesh::new([&first, &second], counts) {
            let mut caches = (Cache::<_, 2, 0>::default(), Cache::<_, 2, 3>::default());
            let check = |corners: [[usize; 2]; 3]| assert!(corners.iter().all(|[a, b]| *a < counts[0] && *b < counts[1]));
            mesh.triangles(&mut caches.0, |corner| corner, check);
            mesh.triangles(&mut caches.1, |corner| corner, check);
        }
        if let Ok(mesh) = Mesh::new([&first], [counts[0]]) {
            mesh.triangles(&mut Cache::<_, 1, 5>::default(), |[i]| assert!(i < counts[0]), |_| ());
        }
    }

    /// Caches of any corners at all.
    #[test]
    fn any_cache(corners in prop::collection::vec(prop::array::uniform3(any::<usize>()), 0..20)) {
        let mut cache = Cache::<_, 3, 7>::default();
        for corner in corners {
            prop_assert_eq!(cache.get(corner, |corner| corner), corner);
        }
    }

    #[test]
    fn any_line_in_any_window(from in any::<(i16, i16)>(), to in any::<(i16, i16)>(), window in window()) {
        let mut color = Anywhere { window, row: vec![0; 50] };
        draw::line(&mut color, from, to, &look());
    }

    #[test]
    fn any_wide_line_in_any_window(
        positions in positions(), depths in prop::array::uniform2(any::<u32>()),
        values in prop::array::uniform2(prop::array::uniform2(int())), window in window(),
    ) {
        let ends = [0, 1].map(|i| Corner {
            position: positions[i],
            depth: FineDepth::from_bits(depths[i]),
            varying: Linear(values[i]),
        });
        let mut color = Anywhere { window, row: vec![0; 50] };
        let mut depth = DepthBuffer::<_, LessOrEqual>::new(Anywhere { window, row: vec![9999; 50] });
        draw::stroke::<i64, _, _, _, _>(&mut color, &mut depth, &Wide(ends), &look());
        draw::wu_stroke::<i64, _, _, _, _>(&mut color, &mut depth, &Wide(ends), &look());
    }

    #[test]
    fn any_square_and_disc_in_any_window(
        x in int(), y in int(), depth in any::<u32>(), size in int(), from in prop::array::uniform2(int()),
        to in prop::array::uniform2(int()), inverse in int(), window in window(), depth_window in window(),
    ) {
        let center = Center { x: SubPx::from_bits(x), y: SubPx::from_bits(y), depth: FineDepth::from_bits(depth) };
        let size = SubPx::from_bits(size);
        draw_around(center, size, (), window, depth_window);
        draw_around(center, size, Linear(from), window, depth_window);
        draw_around(center, size, Perspective::new(from, inverse), window, depth_window);
        let row = vec![0; 50];
        let mut color = Anywhere { window, row };
        draw::square(&mut color, &mut NoDepth, &Square::billboard(center, size, from, to), &look());
    }

    #[test]
    fn any_view_of_narrow_words(parts in parts(int()), window in window()) {
        draw_view::<i32, i32>(&parts, window);
        draw_view::<i32, i64>(&parts, window);
    }

    #[test]
    fn any_view_of_wide_words(parts in parts(long()), window in window()) {
        draw_view::<i64, i32>(&parts, window);
        draw_view::<i64, i64>(&parts, window);
    }

    #[test]
    fn any_buffer(window in window(), stride in prop_oneof![0..80usize, any::<usize>()], length in 0..4000usize) {
        let mut pixels = vec![0u8; length];
        if let Ok(mut buffer) = Buffer::with_stride(&mut pixels, stride, window) {
            for row in window.top..window.bottom {
                // What was accepted has all its rows.
                prop_assert_eq!(buffer.row(row).len(), window.width());
            }
        }
        prop_assert_eq!(window.width() == 0 || window.height() == 0, window.is_empty());
    }
}
