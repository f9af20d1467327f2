//! The state of a scene: what commands leave behind for later ones.

use std::sync::Arc;

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Block, Scaled, Word};
use fixel::patch::{Level, PatchVertex};
use fixel::texture::{Rgba8888, Texture};
use fixel::view::{Cull, View};
use fixel::viewport::Viewport;
use fixel::window::Window;

use super::Renderer;
use super::canvas::Canvas;
use super::corner::{self, Corner};
use super::lamps::{Lamps, Place};
use super::patch::Lowered;
use super::shade::{self, Look, Paint};
use crate::backend::{BackEnd, Patch, Surface, Vertex};
use crate::emit::log::Log;
use crate::fixed::FixedPicture;
use crate::fixed::dials::{Dials, Precision};
use crate::lower;
use crate::picture::Picture;

/// The state of a scene and its picture.
pub struct Scene<W> {
    state: State,
    canvas: Canvas<W>,
}

/// All but projection, clip planes and culling, which the picture's view holds.
struct State {
    model_view: Matrix<i64>,
    directions: Directions<i64>,
    lamps: Lamps,
    shininess: Option<u32>,
    texture: Option<Arc<Picture>>,
    decals: bool,
    flat_normals: bool,
}

impl<W: Word> Scene<W> {
    /// An empty picture.
    pub fn new(viewport: Viewport<W>, window: Window) -> Self {
        let view = View {
            projection: Matrix::identity(),
            planes: Planes::default(),
            viewport,
            depth_range: DepthRange::ZeroToOne,
            behind: Behind::Divide,
            cull: Cull::Nothing,
        };
        Scene {
            state: State {
                model_view: Matrix::identity(),
                directions: Directions::identity(),
                lamps: Lamps::new(Precision::default()),
                shininess: None,
                texture: None,
                decals: false,
                flat_normals: false,
            },
            canvas: Canvas::new(view, window),
        }
    }
}

impl State {
    fn multiply(&mut self, matrix: &Matrix<i64>) {
        self.model_view = self.model_view.product(matrix);
    }

    /// A normal's direction in eye space; nothing asks for it without lights.
    fn normal(&self, normal: Block<i64, 3>) -> Option<[i32; 3]> {
        if self.lamps.is_empty() {
            None
        } else {
            corner::unit(self.directions.turn(normal))
        }
    }

    fn corner(&self, vertex: &Vertex, color: [i32; 3]) -> Corner {
        Corner {
            eye: self.model_view.transform(lower::block(vertex.position)),
            color,
            normal: vertex.normal.and_then(|normal| self.normal(lower::block(normal))),
            texcoord: vertex.texcoord.map(|c| lower::block([c])),
        }
    }

    fn patch_corner(&self, vertex: PatchVertex<i64, 3>) -> Corner {
        Corner {
            eye: self.model_view.transform(vertex.position),
            color: vertex.color,
            normal: self.normal(vertex.normal),
            texcoord: [Scaled::ZERO; 2],
        }
    }

    /// The finest unit of a surface's colours.
    fn finest(&self, surface: Surface) -> i32 {
        if self.lamps.is_empty() || surface == Surface::Textured {
            lower::PLAIN
        } else {
            lower::LIT
        }
    }

    /// The look of a primitive whose corners' colours have the unit `shift`; and that of a single colour.
    fn look(&self, surface: Surface, shift: i32) -> Result<Look<'_>, String> {
        let (paint, shift) = match surface {
            Surface::Flat(color) => {
                let lowered = lower::channels([color], self.finest(surface));
                let [color] = lowered.corners;
                (Paint::Plain(color), lowered.shift)
            }
            Surface::Gouraud => (Paint::Gouraud, shift),
            Surface::Textured if self.decals => (Paint::Decal(self.texture()?), shift),
            Surface::Textured => (Paint::Textured(self.texture()?), lower::PLAIN),
        };
        Ok(Look {
            paint,
            shift,
            flat_normal: self.flat_normals && matches!(surface, Surface::Flat(_)),
            shininess: self.shininess,
            picture: self.texture.as_ref(),
        })
    }

    fn texture(&self) -> Result<Texture<'_, Rgba8888>, String> {
        let picture = self.texture.as_deref().ok_or("no texture")?;
        let side = |v: u32| u16::try_from(v).map_err(|_| "a texture of more than 65535 texels a side");
        Texture::new(Rgba8888, &picture.pixels, side(picture.width)?, side(picture.height)?).map_err(|e| e.to_string())
    }
}

impl<W: Word> BackEnd for Scene<W> {
    fn load_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.state.model_view = matrix(m);
        self.state.directions.load(&self.state.model_view);
        Ok(())
    }

    fn mult_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        let m = matrix(m);
        self.state.multiply(&m);
        self.state.directions.load_product(&m);
        Ok(())
    }

    fn load_p(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.canvas.view.projection = matrix(m);
        Ok(())
    }

    fn translate(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.state.multiply(&Matrix::translation(lower::block(by)));
        Ok(())
    }

    fn rotate(&mut self, degrees: f64, axis: [f64; 3]) -> Result<(), String> {
        let (angle, axis) = (lower::angle(degrees), lower::block(axis));
        let trigonometry = self.canvas.dials.trigonometry;
        let rotation = trigonometry.rotation(angle, axis).map_err(|e| e.to_string())?;
        self.state.multiply(&rotation);
        let turned = trigonometry.rotate(&mut self.state.directions, angle, axis);
        turned.map_err(|e| e.to_string())
    }

    fn scale(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.state.multiply(&Matrix::scaling(lower::block(by)));
        self.state.directions.scale(lower::block(by));
        Ok(())
    }

    fn look_at(&mut self, eye: [f64; 4], center: [f64; 4], up: [f64; 3]) -> Result<(), String> {
        let point = |p| divided(lower::block(p)).ok_or("a point at infinity");
        let (eye, center, up) = (point(eye)?, point(center)?, lower::block(up));
        self.state.model_view = Matrix::look_at(eye, center, up).map_err(|e| e.to_string())?;
        self.state
            .directions
            .look_at(eye, center, up)
            .map_err(|e| e.to_string())
    }

    fn frustum(&mut self, planes: [f64; 6]) -> Result<(), String> {
        let planes = planes.map(|v| lower::block([v]));
        self.canvas.view.projection = Matrix::frustum(planes).map_err(|e| e.to_string())?;
        Ok(())
    }

    fn ortho(&mut self, planes: [f64; 6]) -> Result<(), String> {
        // n' = 2n − f takes −n to depth 0 (hw2.md, section 4).
        let [l, r, b, t, n, f] = planes.map(|v| lower::block([v]));
        let near = n.scaled(1).minus(f);
        self.canvas.view.projection = Matrix::ortho([l, r, b, t, near, f]).map_err(|e| e.to_string())?;
        Ok(())
    }

    fn clip_plane(&mut self, [a, b, c, d]: [f64; 4]) -> Result<(), String> {
        let [a, b, c] = self.state.directions.turn(lower::block([a, b, c])).split();
        let plane = Block::gather([a, b, c, lower::block([d])]);
        self.canvas.clip(plane)
    }

    fn cull(&mut self) {
        self.canvas.view.cull = Cull::Clockwise;
    }

    fn decals(&mut self) {
        self.state.decals = true;
    }

    fn flat_normals(&mut self) {
        self.state.flat_normals = true;
    }

    fn texture(&mut self, texture: &Arc<Picture>) -> Result<(), String> {
        self.state.texture = Some(Arc::clone(texture));
        Ok(())
    }

    fn sun(&mut self, direction: [f64; 3], color: [f64; 3]) -> Result<(), String> {
        let direction = corner::unit(self.state.directions.turn(lower::block(direction)));
        self.state
            .lamps
            .add(Place::Sun(direction.unwrap_or_default()), lower::block(color))
    }

    fn bulb(&mut self, position: [f64; 4], color: [f64; 3]) -> Result<(), String> {
        let position = self.state.model_view.transform(lower::block(position));
        let position = divided(position).ok_or("a bulb at infinity")?;
        self.state.lamps.add(Place::Bulb(position), lower::block(color))
    }

    fn shininess(&mut self, exponent: f64) -> Result<(), String> {
        self.state.shininess = lower::shininess(exponent)?;
        Ok(())
    }

    fn triangle(&mut self, primitive: u32, corners: [Vertex; 3], surface: Surface) -> Result<(), String> {
        let colors = lower::channels(corners.map(|v| v.color), self.state.finest(surface));
        let look = self.state.look(surface, colors.shift)?;
        let corners = std::array::from_fn(|i| self.state.corner(&corners[i], colors.corners[i]));
        shade::triangle(
            &mut self.canvas,
            look,
            &mut self.state.lamps.scaled(),
            &corners,
            primitive,
        )
    }

    fn patch(&mut self, first: u32, level: u32, patch: Patch<'_>, surface: Surface) -> Result<(), String> {
        let level = Level::new(level).map_err(|e| e.to_string())?;
        let (patch, shift) = Lowered::new(patch, self.state.finest(surface));
        let look = self.state.look(surface, shift)?;
        let normals = !self.state.lamps.is_empty() && !look.flat_normal;
        let mut lights = self.state.lamps.scaled();
        let (mut next, mut drawn) = (first, Ok(()));
        let mut map = |vertex| self.state.patch_corner(vertex);
        patch.for_each(level, normals, &mut map, &mut |corners| {
            let one = shade::triangle(&mut self.canvas, look, &mut lights, &corners, next);
            drawn = drawn.clone().and(one);
            next += 1;
        });
        drawn
    }
}

impl<W: Word> Renderer for Scene<W> {
    fn record(&mut self, log: Log) {
        self.canvas.log = Some(log);
    }

    fn set(&mut self, dials: Dials) {
        self.canvas.dials = dials;
        self.state.lamps = Lamps::new(dials.precision);
    }

    fn finish(self: Box<Self>) -> (FixedPicture, Option<Log>) {
        self.canvas.finish()
    }
}

fn matrix(m: &[[f64; 4]; 4]) -> Matrix<i64> {
    let [[a, b, c, d], [e, f, g, h], [i, j, k, l], [n, o, p, q]] = *m;
    Matrix::from_rows(lower::block([a, b, c, d, e, f, g, h, i, j, k, l, n, o, p, q]))
}

/// (x, y, z)/w.
fn divided(point: Block<i64, 4>) -> Option<Block<i64, 3>> {
    let [x, y, z, w] = point.split();
    Block::gather([x, y, z]).over(w)
}
