//! The fixed-point back end: the core, fed with lowered numbers. Nothing here that firmware could not do.

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Flat, Fragment};
use fixel::matrix::{Directions, Matrix};
use fixel::num::{Block, SineTable, Word};
use fixel::target::Buffer;
use fixel::varying::Perspective;
use fixel::view::{Cull, Vertex as EyeVertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;

use crate::backend::{BackEnd, Surface, Vertex};
pub use crate::compare::picture::{FixedPicture, Pixel};
use crate::lower;

/// Clip planes that a scene may set.
const PLANES: usize = 256;

/// Renders with the core: 64-bit words for vertices, and for edges the word that the picture needs.
pub struct Fixed(Box<dyn Renderer>);

/// A back end with a picture at the end.
trait Renderer: BackEnd {
    fn finish(self: Box<Self>) -> FixedPicture;
}

impl Fixed {
    /// An empty picture of `width` × `height` pixels, at most 16384 a side.
    ///
    /// # Panics
    /// Beyond 32768 pixels a side, which the scene's parser has excluded.
    pub fn new(width: u32, height: u32) -> Self {
        Self::part(width, height, Window::new(0, 0, width as i32, height as i32))
    }

    /// The part `window` of such a picture: what a strip or a tile of it holds.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn part(width: u32, height: u32, window: Window) -> Self {
        let fits = |size: u32| size <= <i32 as Word>::GUARD as u32;
        if fits(width) && fits(height) {
            Self::with_word::<i32>(width, height, window)
        } else {
            Self::with_word::<i64>(width, height, window)
        }
    }

    /// With a certain word for the edges.
    ///
    /// # Panics
    /// Where the picture does not fit the word.
    pub fn with_word<W: Word>(width: u32, height: u32, window: Window) -> Self {
        let size = |v: u32| u16::try_from(v).expect("a scene's picture has at most 16384 pixels a side");
        let viewport = Viewport::<W>::new(0, 0, size(width), size(height)).expect("the word was chosen by the size");
        Fixed(Box::new(Scene {
            model_view: Matrix::identity(),
            directions: Directions::identity(),
            view: View {
                projection: Matrix::identity(),
                planes: Planes::default(),
                viewport,
                depth_range: DepthRange::ZeroToOne,
                behind: Behind::Divide,
                cull: Cull::Nothing,
            },
            window,
            pixels: vec![
                Pixel {
                    rgba: [0; 4],
                    primitive: 0
                };
                window.width() * window.height()
            ],
            depths: vec![FAR; window.width() * window.height()],
        }))
    }

    /// What was drawn.
    pub fn finish(self) -> FixedPicture {
        self.0.finish()
    }
}

/// The state of a scene and its picture.
struct Scene<W> {
    model_view: Matrix<i64>,
    directions: Directions<i64>,
    view: View<i64, W, PLANES>,
    window: Window,
    pixels: Vec<Pixel>,
    depths: Vec<u16>,
}

/// A Gouraud colour as bytes.
struct Gouraud {
    shift: u32,
    primitive: u32,
}

impl Fragment for Gouraud {
    type Varying = Perspective<3>;
    type Pixel = Pixel;

    fn shade(&self, values: [i32; 3], _below: Pixel) -> Option<Pixel> {
        let [red, green, blue] = values.map(|v| lower::byte(v, self.shift));
        Some(Pixel {
            rgba: [red, green, blue, 255],
            primitive: self.primitive,
        })
    }
}

impl<W: Word> Scene<W> {
    fn draw<F>(&mut self, corners: [EyeVertex<i64, <F::Varying as fixel::view::Carried>::Vertex>; 3], fragment: &F)
    where
        F: Fragment<Pixel = Pixel, Varying: fixel::view::Carried>,
    {
        let color = Buffer::strip(&mut self.pixels, self.window);
        let depth = Buffer::strip(&mut self.depths, self.window);
        if let (Ok(mut color), Ok(depth)) = (color, depth) {
            let mut depth = DepthBuffer::<_, LessOrEqual>::new(depth);
            draw::primitive(&self.view, &mut color, &mut depth, &corners, fragment);
        }
    }

    fn multiply(&mut self, matrix: &Matrix<i64>) {
        self.model_view = self.model_view.product(matrix);
    }
}

impl<W: Word> BackEnd for Scene<W> {
    fn load_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.model_view = matrix(m);
        self.directions.load(&self.model_view);
        Ok(())
    }

    fn mult_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        let m = matrix(m);
        self.multiply(&m);
        self.directions.load_product(&m);
        Ok(())
    }

    fn load_p(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.view.projection = matrix(m);
        Ok(())
    }

    fn translate(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.multiply(&Matrix::translation(lower::block(by)));
        Ok(())
    }

    fn rotate(&mut self, degrees: f64, axis: [f64; 3]) -> Result<(), String> {
        let (angle, axis) = (lower::angle(degrees), lower::block(axis));
        self.multiply(&Matrix::rotation::<SineTable>(angle, axis).map_err(|e| e.to_string())?);
        self.directions
            .rotate::<SineTable>(angle, axis)
            .map_err(|e| e.to_string())
    }

    fn scale(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.multiply(&Matrix::scaling(lower::block(by)));
        self.directions.scale(lower::block(by));
        Ok(())
    }

    fn look_at(&mut self, eye: [f64; 4], center: [f64; 4], up: [f64; 3]) -> Result<(), String> {
        let point = |p| divided(p).ok_or("a point at infinity");
        let (eye, center, up) = (point(eye)?, point(center)?, lower::block(up));
        self.model_view = Matrix::look_at(eye, center, up).map_err(|e| e.to_string())?;
        self.directions.look_at(eye, center, up).map_err(|e| e.to_string())
    }

    fn frustum(&mut self, planes: [f64; 6]) -> Result<(), String> {
        let planes = planes.map(|v| lower::block([v]));
        self.view.projection = Matrix::frustum(planes).map_err(|e| e.to_string())?;
        Ok(())
    }

    fn ortho(&mut self, [l, r, b, t, n, f]: [f64; 6]) -> Result<(), String> {
        // n' = 2n − f takes −n to depth 0 (hw2.md, section 4).
        let [l, r, b, t, n, f] = [l, r, b, t, n, f].map(|v| lower::block([v]));
        let near = n.scaled(1).minus(f);
        self.view.projection = Matrix::ortho([l, r, b, t, near, f]).map_err(|e| e.to_string())?;
        Ok(())
    }

    fn clip_plane(&mut self, [a, b, c, d]: [f64; 4]) -> Result<(), String> {
        let [a, b, c] = self.directions.turn(lower::block([a, b, c])).split();
        let plane = Block::gather([a, b, c, lower::block([d])]);
        self.view
            .planes
            .push(plane)
            .map_err(|e: Error| format!("{e} ({PLANES})"))
    }

    fn cull(&mut self) {
        self.view.cull = Cull::Clockwise;
    }

    fn triangle(&mut self, primitive: u32, corners: [Vertex; 3], surface: Surface) -> Result<(), String> {
        let eye = corners.map(|v| self.model_view.transform(lower::block(v.position)));
        match surface {
            Surface::Flat(color) => {
                let lower::Channels {
                    corners: [channels],
                    shift,
                } = lower::channels([color]);
                let [red, green, blue] = channels.map(|v| lower::byte(v, shift));
                let pixel = Pixel {
                    rgba: [red, green, blue, 255],
                    primitive,
                };
                self.draw(eye.map(|position| EyeVertex { position, carried: () }), &Flat(pixel));
            }
            Surface::Gouraud => {
                let lower::Channels { corners: colors, shift } = lower::channels(corners.map(|v| v.color));
                let mut colors = colors.into_iter();
                let vertices = eye.map(|position| EyeVertex {
                    position,
                    carried: colors.next().unwrap_or_default(),
                });
                self.draw(vertices, &Gouraud { shift, primitive });
            }
        }
        Ok(())
    }
}

impl<W: Word> Renderer for Scene<W> {
    fn finish(self: Box<Self>) -> FixedPicture {
        FixedPicture {
            width: self.window.width() as u32,
            height: self.window.height() as u32,
            pixels: self.pixels,
            depth: self.depths,
        }
    }
}

impl BackEnd for Fixed {
    fn load_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.0.load_mv(m)
    }
    fn mult_mv(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.0.mult_mv(m)
    }
    fn load_p(&mut self, m: &[[f64; 4]; 4]) -> Result<(), String> {
        self.0.load_p(m)
    }
    fn translate(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.0.translate(by)
    }
    fn rotate(&mut self, degrees: f64, axis: [f64; 3]) -> Result<(), String> {
        self.0.rotate(degrees, axis)
    }
    fn scale(&mut self, by: [f64; 3]) -> Result<(), String> {
        self.0.scale(by)
    }
    fn look_at(&mut self, eye: [f64; 4], center: [f64; 4], up: [f64; 3]) -> Result<(), String> {
        self.0.look_at(eye, center, up)
    }
    fn frustum(&mut self, planes: [f64; 6]) -> Result<(), String> {
        self.0.frustum(planes)
    }
    fn ortho(&mut self, planes: [f64; 6]) -> Result<(), String> {
        self.0.ortho(planes)
    }
    fn clip_plane(&mut self, plane: [f64; 4]) -> Result<(), String> {
        self.0.clip_plane(plane)
    }
    fn cull(&mut self) {
        self.0.cull();
    }
    fn triangle(&mut self, primitive: u32, corners: [Vertex; 3], surface: Surface) -> Result<(), String> {
        self.0.triangle(primitive, corners, surface)
    }
}

fn matrix(m: &[[f64; 4]; 4]) -> Matrix<i64> {
    let [[a, b, c, d], [e, f, g, h], [i, j, k, l], [n, o, p, q]] = *m;
    Matrix::from_rows(lower::block([a, b, c, d, e, f, g, h, i, j, k, l, n, o, p, q]))
}

/// (x, y, z)/w.
fn divided([x, y, z, w]: [f64; 4]) -> Option<Block<i64, 3>> {
    lower::block([x, y, z]).over(lower::block([w]))
}
