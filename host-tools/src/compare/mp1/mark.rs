//! What an MP1 scene draws, as float64 has it, with the bounds of the core's differences (formats/mp1.md section 4).

use std::sync::Arc;

use crate::compare::stated::{CARRIED_CHANNEL, DECODED, FIXED_PRODUCT, MIXED_HEADROOM, SUBPIXEL};
use crate::picture::Picture;
use crate::reference::attributes::{Attributes, Bounds};
use crate::reference::bound::{Tracked, size};
use crate::reference::clip::{Corner as ClipCorner, Over, Plane, Side, clip_line};
use crate::reference::log::{Corner, Outline, Primitive, divided, widened};
use crate::reference::mp1::clip::FRUSTUM;
use crate::reference::mp1::color::decode;
use crate::scene::mp1::{Scene, Shape, Switches, Vertex};

/// Where something is drawn, in samples.
pub enum Figure {
    /// What clipping leaves of a triangle.
    Triangle(Vec<Outline>),
    /// The square of a size around a centre.
    Square(f64, Corner),
    /// The disc of a diameter around a centre.
    Disc(f64, Corner),
    /// A line.
    Line([Corner; 2]),
    /// An antialiased line.
    WuLine([Corner; 2]),
}

/// What a figure is painted with.
pub enum Paint {
    /// Colour and alpha of its corners.
    Colors,
    /// A texture.
    Texture(Arc<Picture>),
    /// A texture over colour and alpha of its corners.
    Decal(Arc<Picture>),
}

/// Something that is drawn.
pub struct Mark {
    /// Where.
    pub figure: Figure,
    /// With what.
    pub paint: Paint,
    /// The core's unit of a channel, 1 being full.
    pub unit: f64,
    /// In how many times larger units the core carries its values: its vertices' w have both signs, whatever clipping leaves.
    pub headroom: f64,
    /// Whether its values are linear over the screen, and stepped in their own units.
    pub linear: bool,
    /// Whether clipping may leave nothing of it.
    pub perhaps: bool,
}

/// What the marks of a scene have in common.
pub struct Maker<'s> {
    switches: &'s Switches,
    planes: Vec<Plane>,
    frustum: Vec<Plane>,
    size: [f64; 2],
    /// The core's unit of a channel, 1 being full.
    pub unit: f64,
}

impl<'s> Maker<'s> {
    /// For a scene; `shift` is by how many bits the unit of its colours is larger than 2⁻²⁸.
    pub fn new(scene: &'s Scene, shift: u32) -> Self {
        let identity = Tracked::identity();
        let plane = |p: &[f64; 4]| Plane::new(*p, &identity);
        let switches = &scene.switches;
        let frustum: Vec<Plane> = if switches.frustum {
            FRUSTUM.iter().map(plane).collect()
        } else {
            Vec::new()
        };
        let mut planes: Vec<Plane> = switches.clip_planes.iter().map(plane).collect();
        planes.extend(&frustum);
        let samples = |side: u32| f64::from(side * switches.fsaa);
        Self {
            switches,
            planes,
            frustum,
            size: [samples(scene.width), samples(scene.height)],
            unit: f64::from(shift).exp2() * CARRIED_CHANNEL,
        }
    }

    /// What a primitive draws; none if that is certainly nothing.
    pub fn mark(&self, number: u32, shape: &Shape) -> Option<Mark> {
        let (figure, perhaps) = match shape {
            Shape::Triangle(vertices) | Shape::Textured(vertices, _) => (self.triangle(number, vertices)?, false),
            Shape::Point(size, vertex) | Shape::Billboard(size, vertex, _) => {
                let (centre, perhaps) = self.point(vertex)?;
                (Figure::Square(self.samples(*size), centre), perhaps)
            }
            Shape::Circle(size, vertex) => {
                let (centre, perhaps) = self.point(vertex)?;
                (Figure::Disc(self.samples(*size), centre), perhaps)
            }
            Shape::Line(vertices) => {
                let (ends, perhaps) = self.line(vertices)?;
                (Figure::Line(ends), perhaps)
            }
            Shape::WuLine(vertices) => {
                let (ends, perhaps) = self.line(vertices)?;
                (Figure::WuLine(ends), perhaps)
            }
        };
        let paint = match shape {
            Shape::Textured(_, texture) if self.switches.decals => Paint::Decal(Arc::clone(texture)),
            Shape::Textured(_, texture) | Shape::Billboard(.., texture) => Paint::Texture(Arc::clone(texture)),
            _ => Paint::Colors,
        };
        Some(Mark {
            figure,
            paint,
            unit: self.unit,
            headroom: match shape {
                Shape::Triangle(vertices) | Shape::Textured(vertices, _) => self.headroom(vertices),
                _ => 1.0,
            },
            linear: !self.switches.hyp,
            perhaps,
        })
    }

    fn samples(&self, size: f64) -> f64 {
        size * f64::from(self.switches.fsaa)
    }

    fn at(&self, vertex: &Vertex) -> Attributes {
        let channel = |c: f64| {
            if self.switches.srgb {
                decode(c / 255.0)
            } else {
                c / 255.0
            }
        };
        Attributes {
            color: vertex.rgb.map(channel),
            alpha: vertex.alpha,
            texcoord: vertex.texcoord,
            ..Attributes::default()
        }
    }

    /// A vertex in clip space: the core rounds its numbers once.
    fn corner(&self, vertex: &Vertex) -> ClipCorner {
        let at = self.at(vertex);
        let brightest = at.color.iter().fold(1.0, |most: f64, c| most.max(c.abs()));
        let decoded = if self.switches.srgb { DECODED * brightest } else { 0.0 };
        ClipCorner {
            eye: vertex.position,
            at,
            error: FIXED_PRODUCT * size(&vertex.position),
            at_error: Bounds {
                color: self.unit + decoded,
                ..Bounds::default()
            },
        }
    }

    fn headroom(&self, vertices: &[Vertex]) -> f64 {
        let w = |sign: f64| vertices.iter().any(|v| v.position[3] * sign > 0.0);
        let mixed = self.switches.hyp && !self.switches.frustum && w(1.0) && w(-1.0);
        if mixed { MIXED_HEADROOM } else { 1.0 }
    }

    fn triangle(&self, number: u32, vertices: &[Vertex; 3]) -> Option<Figure> {
        let mut triangle = vertices.each_ref().map(|vertex| self.corner(vertex));
        let headroom = self.headroom(vertices);
        let carrying = Bounds::of_carrying(triangle.iter().map(|c| &c.at), headroom);
        for corner in &mut triangle {
            corner.at_error.texcoord = carrying.texcoord;
            corner.at_error.color += (headroom - 1.0) * self.unit;
        }
        let primitive = Primitive {
            number,
            mixed_headroom: headroom,
            triangle: &triangle,
            planes: &self.planes,
            projection: &Tracked::identity(),
            size: self.size,
            cull: self.switches.cull,
            over: Over::Space,
        };
        let mut outlines = primitive.outlines();
        if !self.switches.hyp {
            outlines.iter_mut().for_each(linear);
        }
        (!outlines.is_empty()).then_some(Figure::Triangle(outlines))
    }

    /// A centre on the screen, and whether it may be left out; none if it certainly is.
    fn point(&self, vertex: &Vertex) -> Option<(Corner, bool)> {
        let corner = self.corner(vertex);
        clip_line(&[corner; 2], &self.frustum, Side::Generous)?;
        let perhaps = clip_line(&[corner; 2], &self.frustum, Side::Strict).is_none();
        let point = divided(corner.eye, corner.error, &corner, self.size);
        (vertex.position[3] != 0.0).then_some((point, perhaps))
    }

    /// The ends on the screen, and whether the line may be left out; none if it certainly is.
    fn line(&self, vertices: &[Vertex; 2]) -> Option<([Corner; 2], bool)> {
        let ends = vertices.each_ref().map(|vertex| self.corner(vertex));
        let [exact, outer, inner] =
            [Side::Exact, Side::Generous, Side::Strict].map(|side| clip_line(&ends, &self.frustum, side));
        let outer = self.on_screen(outer?);
        let perhaps = exact.is_none() || inner.is_none();
        let exact = exact.map_or(outer, |ends| self.on_screen(ends));
        let inner = inner.map_or(exact, |ends| self.on_screen(ends));
        let mut ends = [0, 1].map(|i| widened(&exact[i], &outer[i], &inner[i]));
        if ends.iter().any(|end| end.w == 0.0) {
            return None;
        }
        if !self.switches.hyp {
            ends.iter_mut().for_each(without_w);
        }
        Some((ends, perhaps))
    }

    fn on_screen(&self, ends: [ClipCorner; 2]) -> [Corner; 2] {
        ends.map(|end| divided(end.eye, end.error, &end, self.size))
    }
}

/// Values linear over the screen in each triangle of the fan: w does not count.
fn linear(outline: &mut Outline) {
    outline.fanned = outline.outer.len() > 3;
    if outline.fanned {
        loosen_near(&mut outline.outer);
        outline.inner.iter_mut().for_each(|inner| loosen_near(inner));
    }
    outline.mixed = false;
    outline.outer.iter_mut().for_each(without_w);
    outline.inner.iter_mut().flatten().for_each(without_w);
}

/// Where two corners may be rounded to within a subpixel of each other in x and in y, the core may take one of them for both.
fn loosen_near(corners: &mut [Corner]) {
    let places: Vec<[f64; 2]> = corners.iter().map(|corner| corner.position).collect();
    let count = corners.len();
    for (i, corner) in corners.iter_mut().enumerate() {
        let is_near = |other: [f64; 2]| {
            let [dx, dy] = [0, 1].map(|k| corner.position[k] - other[k]);
            dx.hypot(dy) <= SUBPIXEL + 2.0 * corner.reach
        };
        if is_near(places[(i + 1) % count]) || is_near(places[(i + count - 1) % count]) {
            corner.reach += SUBPIXEL;
            corner.shift += SUBPIXEL;
        }
    }
}

fn without_w(corner: &mut Corner) {
    corner.w = 1.0;
    corner.weight_error = 0.0;
}
