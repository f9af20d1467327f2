//! Every public function of the core, called with numbers that the compiler cannot know, so that what an image of this lacks
//! no firmware can have: a panic path, a float, a recursion.
//!
//! The scenes call most of them; the rest is here. `cargo xtask firmware` compares both with the core's sources.

use core::hint::black_box;

use fixel::bands::{Bands, Blocking, Pool};
use fixel::blend::{ONE, Rgba, over888};
use fixel::clip::{DepthRange, Planes, Polygon};
use fixel::depth::{Depth, LessOrEqual, NoDepth, Options, Relation, Switched};
use fixel::dither;
use fixel::draw;
use fixel::edge::{Edge, first_row};
use fixel::error::Error;
use fixel::fragment::{Antialiased, Compact, Flat, Flat565, Fragment, Gouraud565};
use fixel::gradient::Basis;
use fixel::light::world::{FULL, Glossy, Material, PointLights};
use fixel::light::{Lights, Matte, Shiny, Sunlight};
use fixel::line::Line;
use fixel::matrix::{Directions, Matrix};
use fixel::mesh::{Cache, Mesh, Normalized};
use fixel::num::{
    Angle, Block, Divisor, OneStep, Precision, Scaled, ShortSine, SineTable, Table, Trigonometry, TwoSteps, Word, dot,
    power, reciprocal, reciprocal_square_root, square_root, unit, unit_wide,
};
use fixel::patch::{ControlPoint, Level, RectangularPatch, TriangularPatch};
use fixel::pipeline::shapes::{BOX, Corner as ShapeCorner};
use fixel::pipeline::{
    self, Filtering, OneBit, Picture, Pixel, PixelFormat, Program, Region, Sampler, Shaded, State, Wrapping, clip_line,
    clip_polygon, clip_to_region, from_the_top, get, plane_distance, set,
};
use fixel::screen::{Corner, FineDepth, Position, SubPx};
use fixel::segment::{Nearest, Pairs};
use fixel::slope::Weights;
use fixel::span::{doubled_area, scan};
use fixel::srgb::decode_wide;
use fixel::supersample;
use fixel::target::Buffer;
use fixel::texture::{
    self, Bilinear565, Palette, Rgb565, Rgba8888, Texel, Texture, Tiled565, TiledBilinear565, TowardsZero,
};
use fixel::varying::{Color565, Linear, Packed565, Perspective};
use fixel::view::{Assembled, ScreenVertex, Vertex, View, Wants};
use fixel::viewport::Viewport;
use fixel::window::Window;
use heapless::Vec;

use crate::scenes::TIERS;
use crate::scenes::part::{HEIGHT, Memory, Part};

/// Calls everything.
pub fn run(memory: &mut Memory) {
    let mut part = memory.cleared(0, HEIGHT);
    for &(_, draw) in TIERS.iter().flat_map(|tier| &tier.scenes) {
        let _ = black_box(black_box(draw)(&mut part));
    }
    let _ = black_box(small(&mut part));
    let _ = black_box(words::<i32>(&mut part));
    let _ = black_box(words::<i64>(&mut part));
    let _ = black_box(meshes());
    let _ = black_box(banded());
    let _ = black_box(programs(&mut part));
    let _ = black_box(textures());
    numbers();
}

/// Adds a part of a colour.
struct Ink;

impl Fragment for Ink {
    type Varying = ();
    type Pixel = u16;
    fn shade(&self, (): (), below: u16) -> Option<u16> {
        Some(!below)
    }
}

impl Antialiased for Ink {
    fn shade_part(&self, (): (), part: i32, below: u16) -> Option<u16> {
        Some(below ^ (part >> 12) as u16)
    }
}

/// Takes two values.
struct Pair;

impl Fragment for Pair {
    type Varying = Linear<2>;
    type Pixel = u16;
    fn shade(&self, [a, b]: [i32; 2], _below: u16) -> Option<u16> {
        Some((a ^ b) as u16)
    }
}

/// Both of what a pixel gets of a colour.
struct Packed;

impl Fragment for Packed {
    type Varying = Color565;
    type Pixel = u16;
    fn shade(&self, values: Packed565, below: u16) -> Option<u16> {
        let [red, green, blue] = values.levels();
        Some(values.pixel() ^ below ^ (red ^ green ^ blue) as u16)
    }
}

/// Somewhere.
fn corner<V>(i: u8, varying: V) -> Corner<V> {
    let x = i16::from(black_box(i));
    Corner {
        position: Position::from_pixels(x * 5, x * x),
        depth: FineDepth::from_num(x),
        varying,
    }
}

/// Rooms below the draw, targets and windows.
fn small(part: &mut Part<'_>) -> Result<(), Error> {
    let corners = black_box([(1, 2), (30, 40), (50, 6)]).map(|(x, y)| Position::from_pixels(x, y).flat());
    let window = black_box(part.window()).intersect(black_box(Window::new(3, 4, 50, 60)));
    black_box((window.is_empty(), window.contains(black_box((7, 8)))));
    let position = Position::new(black_box(SubPx::ONE), black_box(SubPx::ONE))?;
    black_box((position.x(), position.y()));
    if let Some(basis) = Basis::new(&corners) {
        black_box(basis.corners());
        let plane = basis.plane(black_box([1, 200, 3000]), black_box((1, 3000)));
        scan::<i32>(&corners, doubled_area(&corners) > 0, window, |span| {
            let place = basis.place(&span);
            let (mut narrow, mut fine) = (plane.ramp(&place), plane.fine_ramp(&place));
            narrow.advance();
            fine.advance();
            black_box((narrow.after(black_box(3)), fine.after(black_box(3))));
        });
    }
    if let Some(weights) = Weights::new(black_box([(1, 2), (30, 4000), (5000, 6)])) {
        let slope = weights.slope(black_box([1, 200, 3000]));
        black_box(slope.ramp((black_box(7), black_box(8))));
    }
    Line::new(black_box((9, 2)), black_box((7, 50)), window).for_each(|at| {
        black_box(at);
    });
    Line::closed(black_box((1, 2)), black_box((70, 50)), window).for_each(|at| {
        black_box(at);
    });
    let color = part.colors_mut();
    let mut target = Buffer::with_stride(color, black_box(80), black_box(Window::new(0, 0, 70, 40)))?;
    let mut memory = black_box([9u16; 64]);
    let mut depth = Switched::new(Buffer::new(&mut memory, black_box(8), black_box(8))?);
    depth.options = black_box(Options::default());
    draw::triangle(&mut target, &mut depth, corners, &Flat(black_box(7)));
    draw::triangle(&mut target, &mut depth, corners, &Flat565::new(black_box(7)));
    let colors = |i: u8| Gouraud565::corner(black_box(i), 2, 3);
    let colored = [1, 2, 3].map(|i| corner(i, colors(i)));
    draw::triangle(&mut target, &mut depth, colored, &Packed);
    draw::triangle(&mut target, &mut depth, colored, &Compact(Packed));
    draw::triangle(&mut target, &mut NoDepth, corners, &Compact(Flat565::new(black_box(7))));
    let texels = black_box([[1u16, 2], [3, 4]]);
    let textured = [4, 9, 20].map(|i| corner(i, Perspective::new(black_box([7, 8]), black_box(1 << 30))));
    draw::triangle(&mut target, &mut depth, textured, &Tiled565::new(&texels));
    black_box(depth.limit(window));
    black_box(Relation::passes(black_box(Relation::Less), black_box(3), black_box(4)));
    black_box(set(&mut target, black_box((SubPx::ONE, SubPx::ONE)), 5));
    black_box(get(&mut target, black_box((1, 1))));
    from_the_top(black_box(&memory[..]), black_box(8)).for_each(|row| {
        black_box(row);
    });
    let mut samples = black_box([0u16; 64]);
    let level = supersample::Level::new(black_box(2))?;
    level.resolve565(&samples, black_box(8) * level.side() / 2, |column, pixel| {
        black_box((column, pixel));
    });
    samples.fill(1);
    black_box(samples);
    black_box(Wants::SCREEN.and(black_box(Wants::SPACE)));
    Ok(())
}

/// What is generic over the word.
fn words<T: Word>(part: &mut Part<'_>) -> Result<(), Error> {
    let point = |values: [i32; 3]| Block::<T, 3>::from_integers(black_box(values));
    let (a, b) = (point([1, 2, 3]), point([-4, 5, 6]));
    black_box((
        a.plus(b),
        a.minus(b),
        a.cross(b),
        a.dot(b),
        a.negated(),
        a.unit(),
        a.is_zero(),
    ));
    black_box((a.scaled(black_box(3)), a.exponent(), a.mantissas(), a.split()));
    let scalar = Scaled::<T>::from_integer(black_box(3));
    black_box((
        a.times(scalar),
        a.over(scalar),
        scalar.to_fixed(black_box(9)),
        scalar.over(scalar),
    ));
    black_box(Block::<T, 3>::gather([scalar; 3]));
    black_box(Block::<T, 2>::from_wide(black_box([T::ONE.widen(); 2]), black_box(-3)));
    black_box(Block::<T, 2>::new(black_box([T::ONE; 2]), black_box(-3)));

    let scalars = black_box([-1, 1, -1, 1, 1, 9]).map(Scaled::<T>::from_integer);
    let (angle, up) = (black_box(Angle::from_degrees(77)), point([0, 1, 0]));
    let projection = Matrix::frustum(scalars)?;
    let matrices = [
        Matrix::ortho(scalars)?,
        Matrix::look_at(a, b, up)?,
        Matrix::camera::<SineTable>(a, b, angle)?,
        Matrix::rotation::<SineTable>(angle, a)?,
        Matrix::translation(a),
        Matrix::scaling(b),
        Matrix::perspective::<SineTable>(angle, scalar, scalar, Scaled::from_integer(black_box(50)))?,
        Matrix::from_scaled([scalar; 16]),
        Matrix::from_rows(Block::from_integers(black_box([3; 16]))),
    ];
    let mut product = Matrix::identity();
    for matrix in black_box(&matrices) {
        product = product.product(matrix);
    }
    let model = Matrix::model(a, &product, b);
    black_box(model.entries());
    let mut directions = Directions::identity();
    directions.rotate::<SineTable>(angle, b)?;
    directions.scale(b);
    black_box((directions.turn(a), directions.turn_back(a)));
    black_box(model.transform_point(black_box([1, 2, 3])));
    directions.look_at(a, b, up)?;
    directions.load(&model);
    directions.load_product(&projection);
    black_box(directions.turn(b));

    let mut planes = Planes::<T, 2>::default();
    planes.push(Block::from_integers(black_box([1, 0, 0, 1])))?;
    black_box(planes.is_empty());
    let corners = black_box([[-1, -1, -3, 1], [2, -1, -4, 1], [0, 2, 5, 1]]).map(Block::<T, 4>::from_integers);
    if let Some(polygon) = planes.clip(corners) {
        black_box((polygon.len(), polygon.is_empty(), polygon.get(black_box(1)).is_some()));
        let copied: Polygon<_, 2> = polygon.iter().copied().collect();
        black_box(copied);
    }
    let plane = Block::from_integers(black_box([0, 1, 0, 1]));
    let [first, second, _] = corners;
    black_box((plane_distance(plane, first), clip_line([first, second], plane)));
    black_box(clip_polygon::<T, 5>(&corners, plane, &mut Vec::new()));

    in_view(part, projection, planes, corners)?;
    ready(part, projection, corners)?;
    patches::<T>();
    lights::<T>()?;
    let ends = black_box([(1, 2), (30, 40)]).map(|(x, y)| Position::from_pixels(x, y).flat());
    Nearest::<T>::new(&ends, part.window()).for_each(|at| {
        black_box(at);
    });
    Pairs::<T>::new(&ends, part.window()).for_each(|pair| {
        black_box(pair);
    });
    let mut edge = Edge::<T>::new(black_box((3, 4)), black_box((500, 600)), first_row(black_box(77)));
    edge.descend();
    black_box(edge.column());
    Ok(())
}

fn in_view<T: Word>(
    part: &mut Part<'_>,
    projection: Matrix<T>,
    planes: Planes<T, 2>,
    corners: [Block<T, 4>; 3],
) -> Result<(), Error> {
    let viewport = Viewport::<T>::new(black_box(0), 0, 90, 60)?.y_up().samples_at_centers();
    black_box(viewport.place(corners[0], black_box(DepthRange::ZeroToOne)));
    black_box(viewport.window());
    let view = View {
        projection,
        planes,
        viewport,
        depth_range: black_box(DepthRange::MinusOneToOne),
        behind: black_box(fixel::clip::Behind::Divide),
        cull: black_box(fixel::view::Cull::Nothing),
    };
    let (mut color, mut depth) = part.compared::<LessOrEqual>()?;
    let vertices = corners.map(|position| Vertex { position, carried: () });
    view.project::<()>(&vertices, |shape| {
        draw::polygon::<T, _, _, _, _>(&mut color, &mut depth, shape, doubled_area(shape), &Ink);
    });
    draw::primitive(&view, &mut color, &mut depth, &vertices, &Compact(Ink));
    let valued = corners.map(|position| Vertex {
        position,
        carried: black_box([7; 3]),
    });
    draw::primitive(&view, &mut color, &mut depth, &valued, &Compact(Packed));
    let [first, second, _] = vertices;
    if let Some(line) = view.project_line::<()>(&[first, second]) {
        draw::stroke::<T, _, _, _, _>(&mut color, &mut depth, &line, &Ink);
        draw::wu_stroke::<T, _, _, _, _>(&mut color, &mut depth, &line, &Ink);
    }
    black_box(view.project_point(first.position));
    let (size, values) = (black_box(SubPx::ONE), black_box(([1, 2], [3, 4])));
    draw::primitive_billboard(&view, &mut color, &mut depth, first.position, size, values, &Pair);
    Ok(())
}

/// Vertices made once.
fn ready<T: Word>(part: &mut Part<'_>, projection: Matrix<T>, corners: [Block<T, 4>; 3]) -> Result<(), Error> {
    let view = View::<T, T, 0> {
        projection,
        planes: Planes::default(),
        viewport: Viewport::new(black_box(0), 0, 90, 60)?,
        depth_range: black_box(DepthRange::ZeroToOne),
        behind: black_box(fixel::clip::Behind::Cut),
        cull: black_box(fixel::view::Cull::Nothing),
    };
    let stored = View::<i32, i32, 0> {
        projection: black_box(Matrix::identity()),
        planes: Planes::default(),
        viewport: Viewport::new(black_box(0), 0, 90, 60)?,
        depth_range: view.depth_range,
        behind: view.behind,
        cull: view.cull,
    };
    black_box(stored.stored().vertex(black_box([3, 2, 1]), [7, 8]));
    let mut vertices = [ScreenVertex::empty([0; 2]); 4];
    for (vertex, corner) in vertices.iter_mut().zip(corners) {
        *vertex = view.clip_vertex(corner, black_box([1, 2]));
        black_box((vertex.is_inside(), vertex.position()));
    }
    let [a, b, c, d] = &mut vertices;
    *d = view.stored_vertex(black_box([1i16, 2, 3]), [3, 4]);
    *a = view.vertex(a.position(), [5, 6]);
    view.assemble::<Linear<2>>([a, b, c], |left| {
        if let Assembled::Triangle(triangle) = left {
            black_box(triangle.area());
        }
    });
    let (mut color, mut depth) = part.compared::<LessOrEqual>()?;
    draw::assembled(&view, &mut color, &mut depth, [a, b, c], &Pair);
    draw::indexed(
        &view,
        &mut color,
        &mut depth,
        &vertices,
        black_box([[0u16, 1, 2]]),
        &Pair,
    );
    Ok(())
}

/// Frames in bands.
fn banded() -> Result<(), Error> {
    let (mut one, mut two, mut depth) = (black_box([0u16; 256]), black_box([0; 256]), black_box([0; 256]));
    let mut sink = Blocking(|window: Window, band: &[u16]| {
        black_box((window, band));
        Ok::<(), Error>(())
    });
    let bands = Bands::new(black_box(32), black_box(32), [&mut one[..], &mut two[..]], 0)?;
    let mut bands = bands.with_depth::<LessOrEqual>(&mut depth)?;
    bands.set_background(black_box(7));
    black_box(bands.rows());
    let view = View::<i32, i32, 0> {
        projection: black_box(Matrix::identity()),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, 32, 32)?,
        depth_range: black_box(DepthRange::ZeroToOne),
        behind: black_box(fixel::clip::Behind::Cut),
        cull: black_box(fixel::view::Cull::Nothing),
    };
    let corners = black_box([[-1, -1, 0, 1], [2, -1, 0, 2], [0, 2, 1, 3]]).map(Block::from_integers);
    let vertices = corners.map(|position| view.vertex(position, ()));
    let mut pool = Pool::<Flat<u16>, 30, 10, 4>::new();
    bands.render(&mut pool, &mut sink, |frame| {
        let on_screen = black_box([(1, 2), (30, 40), (50, 6)]).map(|(x, y)| Position::from_pixels(x, y).flat());
        black_box(frame.window());
        frame.triangle(on_screen, Flat(1));
        frame.polygon(&on_screen, Flat(2));
        let eye = corners.map(|position| Vertex { position, carried: () });
        frame.primitive(&view, &eye, Flat(3));
        frame.indexed(&view, &vertices, black_box([[0u16, 1, 2]]), Flat(4));
        frame.assembled(&view, vertices.each_ref(), Flat(5));
    })?;
    black_box(pool.used());
    let mut single = Bands::single(black_box(32), black_box(32), &mut one[..], 0)?;
    single.each(&mut sink, |color, depth| {
        draw::triangle(color, depth, [Position::default().flat(); 3], &Flat(6));
    })
}

fn patches<T: Word>() {
    let point = |i: i32| ControlPoint {
        position: Block::<T, 4>::from_integers(black_box([i, i * i, 3 - i, 1])),
        color: black_box([i; 2]),
    };
    let Ok(level) = Level::new(black_box(2)) else { return };
    black_box(level.pieces());
    let rectangle = RectangularPatch::new([point(1); 16]);
    rectangle.for_each_triangle::<true>(level, &mut |triangle| {
        black_box(triangle);
    });
    let triangle = TriangularPatch::new([point(2); 10]);
    triangle.for_each_triangle::<true>(level, &mut |triangle| {
        black_box(triangle);
    });
}

fn lights<T: Word>() -> Result<(), Error> {
    let directions = Directions::<T>::identity();
    let sun = Sunlight::new(black_box([1, 2, 3]), &directions, black_box([9; 3]), black_box([5; 3]))?;
    black_box(sun.shade(black_box([0, 0, i16::MAX])));
    lights_at::<T, TwoSteps>();
    lights_at::<T, OneStep>();
    lights_at::<T, Table>();
    Ok(())
}

fn lights_at<T: Word, P: Precision>() {
    let normal = black_box([0, 0, 1 << 30]);
    let shiny = Shiny(black_box(9 << 16));
    let lights = Lights::<T, 2, 2, P>::default();
    black_box(lights.is_empty());
    let lit = lights.at_scale(black_box(-8));
    black_box(lit.shade_wide(normal, [1; 3], [2; 3], &Matte));
    black_box(lit.shade(normal, [1; 3], black_box([2; 3]), &shiny));
    black_box(lit.shade_wide(normal, [1; 3], black_box([2; 3]), &shiny));
    let specular = Glossy {
        color: black_box([FULL; 3]),
        shininess: black_box(9 << 16),
    };
    let material = Material {
        ambient: black_box([FULL; 3]),
        diffuse: [9; 3],
        specular,
    };
    let lights = PointLights::<T, 2, P>::new(black_box(Block::ZERO));
    black_box(lights.shade_wide(normal, black_box(Block::ZERO), &material));
    black_box(lights.at_scale(black_box(-8)).shade_wide(normal, [1; 3], &material));
}

fn meshes() -> Result<(), Error> {
    let indices = black_box([0u32, 1, 2, u32::MAX]);
    let mesh = Mesh::new([&indices[..]], [3])?;
    let mut cache = Cache::<i32, 1, 4>::default();
    for face in mesh.faces() {
        face.corners().for_each(|corner| {
            black_box(cache.get(corner, |[i]| i as i32));
        });
        face.triangles(
            &mut cache,
            |[i]| i as i32,
            |corners| {
                black_box(corners);
            },
        );
    }
    black_box(cache.transforms());
    cache.clear();
    black_box((
        Normalized::point::<i32>(black_box([1i32, 2, 3])),
        Normalized::point::<i64>(black_box([1i16, 2, 3])),
    ));
    Ok(())
}

/// Marks what it covers.
struct Mark(Matrix<i32>);

impl Program for Mark {
    type Vertex = ShapeCorner;
    type Varying = [i32; 2];
    type At = Pixel;
    type Output = u16;

    fn vertex(&self, corner: &ShapeCorner) -> (Block<i32, 4>, [i32; 2]) {
        (self.0.transform(corner.point()), corner.uv.map(i32::from))
    }
    fn fragment(&self, at: Pixel, [u, v]: [i32; 2]) -> Option<u16> {
        (at.x != u).then_some(v as u16)
    }
}

fn programs(part: &mut Part<'_>) -> Result<(), Error> {
    let state = State::new(Viewport::<i32>::new(0, 0, 90, 60)?).with_planes(black_box(Planes::<i32, 2>::default()));
    let program = Mark(black_box(Matrix::identity()));
    let mut buffer = [Shaded::<i32, [i32; 2]>::EMPTY; 36];
    let mut color = part.color()?;
    pipeline::triangles_buffered(&state, &mut color, &mut NoDepth, &program, BOX, &mut buffer);
    pipeline::lines_buffered(&state, &mut color, &mut NoDepth, &program, BOX, &mut buffer);
    let [a, b, c, ..] = &BOX;
    let [a, b, c] = [a, b, c].map(|corner| Shaded::new(&program, corner));
    pipeline::triangle(&state, &mut color, &mut NoDepth, &program, [&a, &b, &c]);
    pipeline::line(&state, &mut color, &mut NoDepth, &program, [&a, &b]);
    let region = black_box(Region {
        left: 1,
        top: 2,
        right: 30,
        bottom: 40,
    });
    black_box((
        region.code(black_box((3, 4))),
        clip_to_region(&region, black_box([(0, 0), (99, 50)])),
    ));
    Ok(())
}

fn textures() -> Result<(), Error> {
    let bytes = black_box([[1, 2, 3, 4]; 4]);
    let texture = Texture::new(Rgba8888, &bytes, black_box(2), black_box(2))?;
    black_box((
        texture.width(),
        texture.height(),
        texture.texel(black_box(1), black_box(1)),
    ));
    let nearest = texture::Nearest::<_, TowardsZero>::new(texture, black_box(16));
    black_box((nearest.texel(black_box([5, 6])), nearest.stored(black_box([5, 6]))));
    let pixels = black_box([9u16; 4]);
    black_box(Sampler::new(Picture::new(Rgb565, &pixels, black_box(2), 2)?, 16).sample(black_box([1, 2])));
    let indices = black_box([0, 1, 2, 3]);
    let palette = Texture::new(Palette(&bytes), &indices, 2, 2)?;
    black_box(palette.texel(black_box(1), black_box(0)));
    let words = black_box([1, 2, 3, 4]);
    let smooth = Bilinear565::new(Texture::new(Rgb565, &words, 2, 2)?, black_box(16));
    let clamped = smooth.wrapped(black_box(Wrapping::ClampToEdge), black_box(Wrapping::Repeat));
    black_box((smooth.stored(black_box([5, 6])), smooth.levels(black_box([5, 6]))));
    black_box((clamped.stored(black_box([5, 6])), clamped.levels(black_box([5, 6]))));
    let rows = black_box([[1, 2], [3, 4]]);
    let tiled = TiledBilinear565::<Linear<2>, 2, 2>::new(&rows);
    black_box((tiled.shade(black_box([7, 8]), 0), tiled.levels(black_box([7, 8]))));
    let sampler = Sampler::new(texture, black_box(16));
    let chosen = sampler
        .filtered(black_box(Filtering::Linear))
        .wrapped(black_box(Wrapping::Repeat), black_box(Wrapping::MirroredRepeat));
    black_box((sampler.sample(black_box([1, 2])), chosen.sample(black_box([1, 2]))));
    let texel = black_box(Texel([1, 2, 3, 4]));
    black_box((
        texel.channels(black_box(1)),
        texel.over(black_box([5; 3]), black_box(1)),
    ));
    let color = Rgba::from_texel(texel, black_box(2));
    black_box((color.to_bytes(), color.over(color), color.faded(black_box(7))));
    black_box((
        over888(color, black_box([1, 2, 3])),
        OneBit.decode(black_box(true)),
        OneBit.encode(color),
    ));
    black_box((
        Rgb565.encode(color),
        Rgb565.decode(black_box(9)),
        Rgba8888.encode(color),
    ));
    black_box(ONE);
    Ok(())
}

fn numbers() {
    let divisor = Divisor::new(black_box(77));
    black_box((divisor.floor_small(black_box(99)), divisor.floor(black_box(9999))));
    black_box((
        power(black_box(3), black_box(4)),
        reciprocal(black_box(5)),
        square_root(black_box(6)),
    ));
    black_box((
        reciprocal_square_root(black_box(7)),
        unit(black_box([1, 2, 3])),
        unit_wide(black_box([1, 2, 3])),
    ));
    black_box((dot(black_box([1; 3]), black_box([2; 3])), decode_wide(black_box(99))));
    precisions::<TwoSteps>();
    precisions::<OneStep>();
    precisions::<Table>();
    let at = black_box((3, 4));
    black_box((
        dither::sixteenth(at),
        dither::rgb565(black_box([1, 2, 3]), at),
        dither::rgb565_fine(black_box([1, 2, 3]), at),
        dither::one_bit(black_box(9), at),
    ));
    for angle in black_box([Angle::from_turns(5), Angle::from_radians(6), Angle::from_degrees(7)]) {
        black_box((
            angle.turns(),
            SineTable::sin_cos::<i32>(angle),
            SineTable::sin_cos::<i64>(angle),
        ));
        black_box((ShortSine::sin_cos::<i32>(angle), ShortSine::sin_cos::<i64>(angle)));
    }
}

fn precisions<P: Precision>() {
    black_box((
        P::reciprocal(black_box(5)),
        P::reciprocal_square_root(black_box(7)),
        P::power(black_box(3), black_box(4)),
    ));
    black_box((
        P::unit(black_box([1, 2, 3])),
        P::unit_wide(black_box([1, 2, 3])),
        P::dot(black_box([1; 3]), black_box([2; 3])),
    ));
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;

    #[test]
    fn everything_runs() {
        let mut memory = std::boxed::Box::new(<Memory>::new());
        run(&mut memory);
        let mut part = memory.cleared(0, HEIGHT);
        let done = [
            small(&mut part),
            words::<i32>(&mut part),
            words::<i64>(&mut part),
            meshes(),
            programs(&mut part),
            textures(),
        ];
        assert_eq!(done, [Ok(()); 6]);
    }
}
