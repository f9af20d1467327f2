//! Picks the fragment program for a primitive: the one that carries no more than it needs.

use std::sync::Arc;

use fixel::blend::Rgba;
use fixel::depth::Depth;
use fixel::draw;
use fixel::num::Word;
use fixel::screen::SubPx;
use fixel::target::Buffer;
use fixel::texture::{Rgba8888, Texture};
use fixel::varying::{Linear, LinearFan, Perspective, Perspective32, PerspectiveSpans};
use fixel::view::{self, Carried};

use super::canvas::{Canvas, Draw, Views};
use super::program::{Colors, Decal, Paint, Plain, Program, Sample, Sampler, Texels};
use super::units::{self, Units};
use crate::emit::drawing::Sampled;
use crate::emit::log::{Log, Read};
use crate::fixed::dials::{self, Dials};
use crate::fixed::shader::BOUND;
use crate::fixed::texcoord;
use crate::lower;
use crate::picture::Picture;
use crate::scene::mp1::{Shape, Switches, Vertex};

/// Headroom of values in perspective where w has both signs: 2^10 times the corners', as for HW2.
const MIXED_HEADROOM: u32 = 10;

/// What all primitives of a scene are drawn with.
pub struct Brush<'s, W> {
    /// The full-scene switches.
    pub switches: &'s Switches,
    /// Clip space to the screen.
    pub views: Views<W>,
    /// Of colours.
    pub units: Units,
    /// How accurately.
    pub dials: Dials,
}

impl<W: Word> Brush<'_, W> {
    /// Draws a primitive.
    ///
    /// # Errors
    /// One line that says what does not fit the core.
    pub fn draw(&self, canvas: &mut Canvas, number: u32, shape: &Shape) -> Result<(), String> {
        for vertex in shape.vertices() {
            lower::keeps_w(vertex.position)?;
        }
        match shape {
            Shape::Triangle(vertices) => {
                let (headroom, values) = self.colors(vertices);
                self.triangle(canvas, number, vertices, values, Colors { headroom });
            }
            Shape::Textured(vertices, texture) => self.textured(canvas, number, vertices, texture)?,
            Shape::Point(size, vertex) => {
                let (paint, size) = (Plain(self.color(vertex)), units::size(*size, self.switches.fsaa)?);
                canvas.draw(&Square(self, vertex, size, Program::<Linear<0>, _>::new(paint, number)));
            }
            Shape::Circle(size, vertex) => {
                let (paint, size) = (Plain(self.color(vertex)), units::size(*size, self.switches.fsaa)?);
                canvas.draw(&Disc(self, vertex, size, Program::<Linear<0>, _>::new(paint, number)));
            }
            Shape::Billboard(size, vertex, picture) => {
                let texture = texture(picture)?;
                // As many fraction bits as fit the longer side.
                let longer = u32::from(texture.width().max(texture.height()));
                let fraction_bits = longer.leading_zeros() - 2;
                let paint = self.texels(canvas, picture, texture, fraction_bits);
                let nudge = texcoord::nudge(fraction_bits as i32);
                let far = [texture.width(), texture.height()].map(|side| (i32::from(side) << fraction_bits) + nudge);
                let size = units::size(*size, self.switches.fsaa)?;
                canvas.draw(&Billboard(self, vertex, size, far, Program::new(paint, number)));
            }
            Shape::Line(vertices) => self.line::<false>(canvas, number, vertices),
            Shape::WuLine(vertices) => self.line::<true>(canvas, number, vertices),
        }
        Ok(())
    }

    fn color(&self, vertex: &Vertex) -> Rgba {
        let [r, g, b, alpha] = self.units.channels(vertex);
        Rgba {
            color: [r, g, b],
            alpha,
        }
    }

    fn texels<'t>(
        &self,
        canvas: &mut Canvas,
        picture: &Arc<Picture>,
        texture: Texture<'t, Rgba8888>,
        fraction_bits: u32,
    ) -> Texels<'t> {
        Texels {
            sampler: Sampler::new(texture, fraction_bits, self.dials.sampling),
            sampled: Sampled {
                texture: canvas.log.as_mut().map_or(0, |log| log.texture(picture)),
                fraction_bits,
            },
            shift: self.units.shift,
        }
    }

    /// The headroom of values between some vertices.
    fn headroom(&self, vertices: &[Vertex]) -> u32 {
        let w = |sign: f64| vertices.iter().any(|v| v.position[3] * sign > 0.0);
        let mixed = self.switches.hyp && !self.switches.frustum && w(1.0) && w(-1.0);
        if mixed { MIXED_HEADROOM } else { 0 }
    }

    /// Colours and alphas, and their headroom.
    fn colors<const N: usize>(&self, vertices: &[Vertex; N]) -> (u32, [[i32; 4]; N]) {
        let headroom = self.headroom(vertices);
        let coarser = |v: i32| (v + ((1 << headroom) >> 1)) >> headroom;
        let values = vertices.each_ref().map(|v| self.units.channels(v).map(coarser));
        (headroom, values)
    }

    fn textured(
        &self,
        canvas: &mut Canvas,
        number: u32,
        vertices: &[Vertex; 3],
        picture: &Arc<Picture>,
    ) -> Result<(), String> {
        let texture = texture(picture)?;
        let (headroom, colors) = self.colors(vertices);
        let size = [texture.width(), texture.height()];
        let coordinates = vertices.each_ref().map(units::texcoord);
        let most_bits = match self.dials.perspective {
            dials::Perspective::Spans => texcoord::IN_SPANS,
            _ => texcoord::FINE,
        };
        let rounding = texcoord::Rounding::TowardsZero;
        let (st, fraction_bits) = texcoord::texels(coordinates, size, headroom, most_bits, rounding)?;
        let texels = self.texels(canvas, picture, texture, fraction_bits);
        if self.switches.decals {
            let values = std::array::from_fn(|i| {
                let ([r, g, b, alpha], [s, t]) = (colors[i], st[i]);
                [r, g, b, alpha, s, t]
            });
            let paint = Decal {
                colors: Colors { headroom },
                texels,
            };
            self.triangle(canvas, number, vertices, values, paint);
        } else {
            self.triangle(canvas, number, vertices, st, texels);
        }
        Ok(())
    }

    fn triangle<P: Paint<N>, const N: usize>(
        &self,
        canvas: &mut Canvas,
        number: u32,
        vertices: &[Vertex; 3],
        values: [[i32; N]; 3],
        paint: P,
    ) {
        if self.in_perspective() && self.dials.perspective == dials::Perspective::Spans {
            canvas.draw(&Triangle(
                self,
                carrying(vertices, values),
                Program::<PerspectiveSpans<N, BOUND>, P>::new(paint, number),
            ));
        } else if self.in_perspective() && self.dials.perspective == dials::Perspective::Narrow {
            canvas.draw(&Triangle(
                self,
                carrying(vertices, values),
                Program::<Perspective32<N>, P>::new(paint, number),
            ));
        } else if self.in_perspective() {
            canvas.draw(&Triangle(
                self,
                carrying(vertices, values),
                Program::<Perspective<N>, P>::new(paint, number),
            ));
        } else {
            canvas.draw(&Triangle(
                self,
                carrying(vertices, values),
                Program::<LinearFan<N>, P>::new(paint, number),
            ));
        }
    }

    /// Whether values are divided. Those that the dial leaves undivided are as in a scene without `hyp`; lines know no table, and
    /// are divided at every pixel otherwise.
    fn in_perspective(&self) -> bool {
        self.switches.hyp && self.dials.perspective != dials::Perspective::Affine
    }

    fn line<const WU: bool>(&self, canvas: &mut Canvas, number: u32, vertices: &[Vertex; 2]) {
        let (headroom, values) = self.colors(vertices);
        let ends = carrying(vertices, values);
        let paint = Colors { headroom };
        if self.in_perspective() {
            canvas.draw(&Line::<'_, W, Perspective<4>, WU>(
                self,
                ends,
                Program::new(paint, number),
            ));
        } else {
            canvas.draw(&Line::<'_, W, LinearFan<4>, WU>(
                self,
                ends,
                Program::new(paint, number),
            ));
        }
    }
}

fn texture(picture: &Picture) -> Result<Texture<'_, Rgba8888>, String> {
    let side = |v: u32| u16::try_from(v).map_err(|_| "a texture of more than 65535 texels a side");
    Texture::new(Rgba8888, &picture.pixels, side(picture.width)?, side(picture.height)?).map_err(|e| e.to_string())
}

/// A vertex in clip space and what it carries.
type Carrying<const N: usize> = view::Vertex<i64, [i32; N]>;

fn carrying<const N: usize, const K: usize>(vertices: &[Vertex; K], values: [[i32; N]; K]) -> [Carrying<N>; K] {
    std::array::from_fn(|i| view::Vertex {
        position: lower::block(vertices[i].position),
        carried: values[i],
    })
}

struct Triangle<'b, W, V, P, const N: usize>(&'b Brush<'b, W>, [Carrying<N>; 3], Program<V, P>);

impl<W: Word, V, P: Paint<N>, const N: usize> Draw for Triangle<'_, W, V, P, N>
where
    V: Carried<Vertex = [i32; N], Values = [i32; N]> + Read,
{
    fn draw(&self, color: &mut Buffer<'_, Sample>, depth: &mut impl Depth) {
        let Triangle(brush, vertices, program) = self;
        draw::primitive(&brush.views.triangles, color, depth, vertices, program);
    }

    fn record(&self, log: &mut Log) {
        let Triangle(brush, vertices, program) = self;
        log.program(program.described());
        let view = &brush.views.triangles;
        view.project::<V>(vertices, |polygon| log.polygon(polygon));
    }
}

struct Line<'b, W, V, const WU: bool>(&'b Brush<'b, W>, [Carrying<4>; 2], Program<V, Colors>);

impl<W: Word, V, const WU: bool> Draw for Line<'_, W, V, WU>
where
    V: Carried<Vertex = [i32; 4], Values = [i32; 4]> + Read,
{
    fn draw(&self, color: &mut Buffer<'_, Sample>, depth: &mut impl Depth) {
        let Line(brush, ends, program) = self;
        if WU {
            draw::primitive_wu_line(&brush.views.others, color, depth, ends, program);
        } else {
            draw::primitive_segment(&brush.views.others, color, depth, ends, program);
        }
    }

    fn record(&self, log: &mut Log) {
        let Line(brush, ends, program) = self;
        log.program(program.described());
        if let Some(line) = brush.views.others.project_line::<V>(ends) {
            log.line(&line, WU);
        }
    }
}

struct Square<'b, W>(&'b Brush<'b, W>, &'b Vertex, SubPx, Program<Linear<0>, Plain>);

impl<W: Word> Draw for Square<'_, W> {
    fn draw(&self, color: &mut Buffer<'_, Sample>, depth: &mut impl Depth) {
        let Square(brush, vertex, size, program) = self;
        let position = lower::block(vertex.position);
        draw::primitive_square(&brush.views.others, color, depth, position, *size, Linear([]), program);
    }

    fn record(&self, log: &mut Log) {
        let Square(brush, vertex, size, program) = self;
        log.program(program.described::<0>());
        let center = brush.views.others.project_point(lower::block(vertex.position));
        center.into_iter().for_each(|center| log.point(center, *size, false));
    }
}

struct Disc<'b, W>(&'b Brush<'b, W>, &'b Vertex, SubPx, Program<Linear<0>, Plain>);

impl<W: Word> Draw for Disc<'_, W> {
    fn draw(&self, color: &mut Buffer<'_, Sample>, depth: &mut impl Depth) {
        let Disc(brush, vertex, size, program) = self;
        let position = lower::block(vertex.position);
        draw::primitive_disc(&brush.views.others, color, depth, position, *size, Linear([]), program);
    }

    fn record(&self, log: &mut Log) {
        let Disc(brush, vertex, size, program) = self;
        log.program(program.described::<0>());
        let center = brush.views.others.project_point(lower::block(vertex.position));
        center.into_iter().for_each(|center| log.point(center, *size, true));
    }
}

struct Billboard<'b, 't, W>(
    &'b Brush<'b, W>,
    &'b Vertex,
    SubPx,
    [i32; 2],
    Program<Linear<2>, Texels<'t>>,
);

impl<W: Word> Draw for Billboard<'_, '_, W> {
    fn draw(&self, color: &mut Buffer<'_, Sample>, depth: &mut impl Depth) {
        let Billboard(brush, vertex, size, far, program) = self;
        let position = lower::block(vertex.position);
        draw::primitive_billboard(
            &brush.views.others,
            color,
            depth,
            position,
            *size,
            ([0; 2], *far),
            program,
        );
    }

    fn record(&self, log: &mut Log) {
        let Billboard(brush, vertex, size, far, program) = self;
        log.program(program.described());
        let center = brush.views.others.project_point(lower::block(vertex.position));
        center.into_iter().for_each(|center| log.billboard(center, *size, *far));
    }
}
