//! Every feature in one program, each used once: what a firmware has in flash that leaves nothing out.
//!
//! On one set of types: words of 32 bits, RGB565, one comparison of depths, one view. Whatever is generic is compiled again for
//! other types: a second kind of target or of depth buffer costs the loops that draw to it once more. An image that *calls*
//! every public function, for all words and tiers, is another one (`everything`), which has no size to keep.

use fixel::blend::{ONE, Rgba, Translucent, over565};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{DepthBuffer, Less};
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Antialiased, Flat, Fragment, Gouraud565};
use fixel::light::world::{FULL, Glossy, Material, PointLight, PointLights, PointLit};
use fixel::light::{Light, Lights, Lit, Shiny, Sunlight};
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Angle, Block, SineTable, unit};
use fixel::patch::{ControlPoint, Level, PatchVertex, RectangularPatch};
use fixel::pipeline::shapes::{Corner, PLANE_XY};
use fixel::pipeline::{self, LinearFilter, OneBit, Pixel, PixelFormat, Program, Repeat, Sampler, State, Surface};
use fixel::screen::SubPx;
use fixel::srgb::encode;
use fixel::supersample;
use fixel::target::Buffer;
use fixel::texture::{Nearest, Rgb565, Texture};
use fixel::varying::{Linear, Perspective};
use fixel::view::{Cull, ScreenVertex, Vertex, View};
use fixel::viewport::Viewport;

use super::{Input, Point, Textured};
use crate::scenes::part::{HEIGHT, Part, WIDTH};

type Color<'a> = Buffer<'a, u16>;
type Depth<'a> = DepthBuffer<Buffer<'a, u16>, Less>;
type Eye<const PLANES: usize> = View<i32, i32, PLANES>;

fn view<const PLANES: usize>(input: &Input<'_>) -> Result<Eye<PLANES>, Error> {
    Ok(View {
        projection: Matrix::from_rows(Block::from_integers(input.matrix)),
        planes: Planes::default(),
        viewport: Viewport::new(0, 0, WIDTH, HEIGHT)?.y_up(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Clockwise,
    })
}

/// Draws with each feature.
pub fn everything(part: &mut Part<'_>, input: &Input<'_>) -> Result<(), Error> {
    let [a, b, c, d, ..] = input.matrix;
    let mut view = view::<2>(input)?;
    view.planes.push(Block::from_integers([a, b, c, d]))?;
    let (mut color, mut depth) = part.compared::<Less>()?;
    triangles(&view, &mut color, &mut depth, input)?;
    lit(&view, &mut color, &mut depth, input)?;
    lines_and_points(&view, &mut color, &mut depth, input);
    mesh(&mut color, &mut depth, input)?;
    patch(&view, &mut color, &mut depth, input)?;
    program(&mut color, &mut depth, input)?;
    average(part)
}

fn placed<A>((position, _): Point, carried: A) -> Vertex<i32, A> {
    Vertex {
        position: Block::from_integers(position),
        carried,
    }
}

/// Flat, coloured, textured in perspective, translucent.
fn triangles(view: &Eye<2>, color: &mut Color<'_>, depth: &mut Depth<'_>, input: &Input<'_>) -> Result<(), Error> {
    let textured = Textured(Nearest::new(Texture::new(Rgb565, input.texels, 16, 16)?, 16));
    for points in input.points.as_chunks::<3>().0 {
        let [(_, [red, green, _]), ..] = *points;
        draw::primitive(
            view,
            color,
            depth,
            &points.map(|p| placed(p, ())),
            &Flat(u16::from_le_bytes([red, green])),
        );
        let colored = points.map(|p @ (_, [r, g, b])| placed(p, Gouraud565::corner(r, g, b).0));
        draw::primitive(view, color, depth, &colored, &Gouraud565);
        let texels = points.map(|p @ (_, [s, t, _])| placed(p, [s, t].map(|v| i32::from(v) << 16)));
        draw::primitive(view, color, depth, &texels, &textured);
        draw::primitive(view, color, depth, &points.map(|p| placed(p, ())), &Glass(red));
    }
    Ok(())
}

/// A colour with alpha over what is there, wholly or in part.
struct Glass(u8);

impl Glass {
    fn color(&self) -> Rgba {
        Rgba {
            color: [i32::from(self.0) << 8; 3],
            alpha: ONE / 2,
        }
    }
}

impl Fragment for Glass {
    type Varying = ();
    type Pixel = u16;
    fn shade(&self, (): (), below: u16) -> Option<u16> {
        Some(over565(self.color(), below))
    }
}

impl Antialiased for Glass {
    fn shade_part(&self, (): (), part: i32, below: u16) -> Option<u16> {
        Some(over565(self.color().faded(part), below))
    }
}

/// By a sun and a bulb, with highlights, and by a light in the world, per pixel, as sRGB.
struct PerPixel<'a> {
    lights: Lit<'a, 1>,
    world: PointLit<1>,
    material: Material<Glossy>,
}

impl Fragment for PerPixel<'_> {
    type Varying = Perspective<6>;
    type Pixel = u16;
    fn shade(&self, [x, y, z, nx, ny, nz]: [i32; 6], _below: u16) -> Option<u16> {
        let normal = unit([nx, ny, nz]).unwrap_or_default();
        let [red, green, blue] = self.lights.shade(normal, [x, y, z], [1 << 16; 3], &Shiny(9 << 16));
        let [glow, ..] = self.world.shade(normal, [x, y, z], &self.material);
        let [red, green, blue] = [red ^ glow, green, blue].map(|c| encode(c) >> 16);
        Some((red << 11 ^ green << 5 ^ blue) as u16)
    }
}

fn material(input: &Input<'_>) -> Material<Glossy> {
    let [a, ..] = input.matrix;
    Material {
        ambient: [a; 3],
        diffuse: [FULL / 2; 3],
        specular: Glossy {
            color: [FULL / 2; 3],
            shininess: 9 << 16,
        },
    }
}

fn world(input: &Input<'_>) -> Result<PointLights<i32, 1>, Error> {
    let [x, y, z, w, ..] = input.matrix;
    let mut lights = PointLights::new(Block::ZERO);
    lights.add(PointLight {
        position: Block::from_integers([x, y, z]),
        color: Block::new([w; 3], -2),
    })?;
    Ok(lights)
}

fn lit(view: &Eye<2>, color: &mut Color<'_>, depth: &mut Depth<'_>, input: &Input<'_>) -> Result<(), Error> {
    let [x, y, z, ..] = input.matrix;
    let mut lights = Lights::<i32, 1, 1>::default();
    lights.add(Light::sun([x, y, z], [1 << 15; 3])?)?;
    lights.add(Light::Bulb {
        position: Block::from_integers([x, y, z]),
        color: [1 << 15; 3],
    })?;
    let world = world(input)?;
    let fragment = PerPixel {
        lights: lights.at_scale(-16),
        world: world.at_scale(-16),
        material: material(input),
    };
    for points in input.points.as_chunks::<3>().0 {
        let corners = points.map(|p @ ([x, y, z, _], [nx, ny, nz])| {
            let normal = [nx, ny, nz].map(|v| i32::from(v) << 16);
            let [nx, ny, nz] = unit(normal).unwrap_or_default();
            placed(p, [x << 16, y << 16, z << 16, nx, ny, nz])
        });
        draw::primitive(view, color, depth, &corners, &fragment);
    }
    Ok(())
}

/// Two values over a billboard, as one bit.
struct Pair;

impl Fragment for Pair {
    type Varying = Linear<2>;
    type Pixel = u16;
    fn shade(&self, [u, v]: [i32; 2], _below: u16) -> Option<u16> {
        let color = Rgba {
            color: [u ^ v; 3],
            alpha: ONE,
        };
        Some(if OneBit.encode(color) { 0xffff } else { 0 })
    }
}

fn lines_and_points(view: &Eye<2>, color: &mut Color<'_>, depth: &mut Depth<'_>, input: &Input<'_>) {
    for &[from, to] in input.points.as_chunks::<2>().0 {
        let ends = [from, to].map(|p| placed(p, ()));
        let [(_, [size, ..]), (_, [shade, ..])] = [from, to];
        draw::primitive_segment(view, color, depth, &ends, &Flat(shade.into()));
        draw::primitive_wu_line(view, color, depth, &ends, &Glass(shade));
        let (center, size) = (placed(from, ()).position, SubPx::from_num(size));
        draw::primitive_square(view, color, depth, center, size, (), &Flat(shade.into()));
        draw::primitive_disc(view, color, depth, center, size, (), &Flat(shade.into()));
        draw::primitive_billboard(view, color, depth, center, size, ([0; 2], [ONE; 2]), &Pair);
        let [(x, y), _] = [(shade.into(), 3), (9, 4)];
        draw::line(color, (x, y), (40, 50), &Flat(shade.into()));
    }
}

/// Vertices projected and lit once.
fn mesh(color: &mut Color<'_>, depth: &mut Depth<'_>, input: &Input<'_>) -> Result<(), Error> {
    let (view, [x, y, z, degrees, ..]) = (view::<0>(input)?, input.matrix);
    let mut directions = Directions::<i32>::identity();
    directions.rotate::<SineTable>(Angle::from_degrees(degrees), Block::from_integers([x, y, z]))?;
    let sun = Sunlight::new([x, y, z], &directions, [9; 3], [1 << 20; 3])?;
    let mut vertices = [ScreenVertex::empty([0; 3]); 6];
    for (vertex, (_, values)) in vertices.iter_mut().zip(input.points) {
        let [a, b, c] = values.map(i16::from);
        *vertex = view.stored_vertex([a, b, c], sun.shade([c, b, a]));
    }
    draw::indexed(&view, color, depth, &vertices, [[0u16, 1, 2], [3, 4, 5]], &Gouraud565);
    Ok(())
}

/// Lit at the points where it is divided.
fn patch(view: &Eye<2>, color: &mut Color<'_>, depth: &mut Depth<'_>, input: &Input<'_>) -> Result<(), Error> {
    let (lights, material) = (world(input)?, material(input));
    let mut points = input.points.iter().cycle();
    let mut control = || {
        let (position, values) = points.next().copied().unwrap_or_default();
        ControlPoint {
            position: Block::from_integers(position),
            color: values.map(i32::from),
        }
    };
    let patch = RectangularPatch::<i32, 3>::new(core::array::from_fn(|_| control()));
    let mut shaded = |vertex: PatchVertex<i32, 3>| {
        let [x, y, z] = vertex.normal.mantissas();
        let carried = lights.shade([x, y, z], Block::from_integers(vertex.color), &material);
        Vertex {
            position: vertex.position,
            carried: carried.map(|c| c >> 8),
        }
    };
    let mut draw = |corners| draw::primitive(view, color, depth, &corners, &Gouraud565);
    patch.for_each_mapped::<true, _>(Level::new(3)?, &mut shaded, &mut draw);
    Ok(())
}

/// An own program: a texture sampled linearly, blended.
struct Sampled<'a> {
    to_clip: Matrix<i32>,
    sampler: Sampler<Texture<'a, Rgb565>, LinearFilter, Repeat, Repeat>,
}

impl Program for Sampled<'_> {
    type Vertex = Corner;
    type Varying = [i32; 2];
    type At = Pixel;
    type Output = Rgba;

    fn vertex(&self, corner: &Corner) -> (Block<i32, 4>, [i32; 2]) {
        (
            self.to_clip.transform(corner.point()),
            corner.uv.map(|v| i32::from(v) << 20),
        )
    }
    fn fragment(&self, at: Pixel, uv: [i32; 2]) -> Option<Rgba> {
        (at.x != at.y).then(|| self.sampler.sample(uv))
    }
}

fn program(color: &mut Color<'_>, depth: &mut Depth<'_>, input: &Input<'_>) -> Result<(), Error> {
    let [x, y, z, degrees, ..] = input.matrix;
    let turned = Matrix::rotation::<SineTable>(Angle::from_degrees(degrees), Block::from_integers([x, y, z]))?;
    let sides = [-1, 1, -1, 1, 1, 40].map(|side| Block::new([side], 0));
    let program = Sampled {
        to_clip: Matrix::frustum(sides)?.product(&turned),
        sampler: Sampler::new(Texture::new(Rgb565, input.texels, 16, 16)?, 20)
            .filtered(LinearFilter)
            .wrapped(Repeat, Repeat),
    };
    let state = State::new(Viewport::<i32>::new(0, 0, WIDTH, HEIGHT)?.y_up());
    let mut surface = Surface::new(&mut *color, Rgb565).blended(Translucent);
    pipeline::triangles(&state, &mut surface, depth, &program, PLANE_XY);
    Ok(())
}

/// Four samples a pixel.
fn average(part: &mut Part<'_>) -> Result<(), Error> {
    let level = supersample::Level::new(2)?;
    let mut samples = [0; 64];
    for (sample, color) in samples.iter_mut().zip(part.colors()) {
        *sample = *color;
    }
    let mut row = part.colors_mut().iter_mut();
    level.resolve565(&samples, 32, |_, pixel| {
        if let Some(color) = row.next() {
            *color = pixel;
        }
    });
    Ok(())
}
