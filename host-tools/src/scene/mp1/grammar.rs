//! The grammar of MP1: which keyword takes what, and what must hold of it.
//!
//! Commands are checked in file order and their arguments from left to right, so that the fault reported is the
//! first one in the text.

use std::array;
use std::path::Path;
use std::sync::Arc;

use super::{MOST_CLIP_PLANES, Primitive, Scene, Shape, Switches, Vertex};
use crate::picture::Picture;
use crate::scene::arguments::{Arguments, quoted};
use crate::scene::header::{Header, header};
use crate::scene::lex::{self, Line};
use crate::scene::textures::{self, Textures};
use crate::scene::{Fault, LONGEST_SIDE, MOST_PIXELS};

/// The most samples per pixel in each direction.
const MOST_FSAA: u32 = 16;

/// Parses a scene; textures are looked for in `folder`, and may have [`MOST_PIXELS`] in all.
pub fn parse(text: impl AsRef<[u8]>, folder: &Path) -> Result<Scene, Fault> {
    parse_with(text.as_ref(), &mut textures::in_folder(folder))
}

/// Parses a scene; `load_texture` gives the texture of a name or says what is wrong with it, and is asked once for each.
pub fn parse_with(
    text: &[u8],
    load_texture: &mut dyn FnMut(&str) -> Result<Arc<Picture>, String>,
) -> Result<Scene, Fault> {
    let mut lines = lex::lines(text);
    let mut parser = Parser {
        header: header(lines.next().transpose()?)?,
        switches: Switches::default(),
        begun: false,
        rgb: [255.0; 3],
        alpha: 1.0,
        texcoord: [0.0; 2],
        texture: None,
        textures: Textures::new(load_texture),
        vertices: Vec::new(),
        primitives: Vec::new(),
    };
    for line in lines {
        parser.command(line?)?;
    }
    Ok(parser.finish())
}

/// The keywords; those up to `ClipPlane` are full-scene switches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Keyword {
    Depth,
    Srgb,
    Hyp,
    Frustum,
    Cull,
    Decals,
    Fsaa,
    ClipPlane,
    Png,
    Rgb,
    Rgba,
    TexCoord,
    Texture,
    Xyzw,
    Tri,
    Trit,
    Point,
    Billboard,
    Circle,
    Line,
    WuLine,
}

/// The keyword that a word is and how many arguments it takes; nothing for a word that is none.
fn keyword(word: &str) -> Option<(Keyword, usize)> {
    Some(match word {
        "depth" => (Keyword::Depth, 0),
        "sRGB" => (Keyword::Srgb, 0),
        "hyp" => (Keyword::Hyp, 0),
        "frustum" => (Keyword::Frustum, 0),
        "cull" => (Keyword::Cull, 0),
        "decals" => (Keyword::Decals, 0),
        "fsaa" => (Keyword::Fsaa, 1),
        "clipplane" => (Keyword::ClipPlane, 4),
        "png" => (Keyword::Png, 3),
        "rgb" => (Keyword::Rgb, 3),
        "rgba" => (Keyword::Rgba, 4),
        "texcoord" => (Keyword::TexCoord, 2),
        "texture" => (Keyword::Texture, 1),
        "xyzw" => (Keyword::Xyzw, 4),
        "tri" => (Keyword::Tri, 3),
        "trit" => (Keyword::Trit, 3),
        "point" => (Keyword::Point, 2),
        "billboard" => (Keyword::Billboard, 2),
        "circle" => (Keyword::Circle, 2),
        "line" => (Keyword::Line, 2),
        "wuline" => (Keyword::WuLine, 2),
        _ => return None,
    })
}

/// The scene so far and the state that the next command finds.
struct Parser<'t> {
    header: Header,
    switches: Switches,
    /// Whether the time for full-scene switches is over.
    begun: bool,
    rgb: [f64; 3],
    alpha: f64,
    texcoord: [f64; 2],
    texture: Option<Arc<Picture>>,
    textures: Textures<'t, Arc<Picture>>,
    vertices: Vec<Vertex>,
    primitives: Vec<Primitive>,
}

impl Parser<'_> {
    fn finish(self) -> Scene {
        Scene {
            width: self.header.width,
            height: self.header.height,
            output: self.header.output,
            switches: self.switches,
            primitives: self.primitives,
            textures: self.textures.into_found(),
        }
    }

    fn command(&mut self, line: Line<'_>) -> Result<(), Fault> {
        let word = line.keyword;
        let fault = |message: String| Fault::new(word.place, message);
        let (keyword, count) =
            keyword(word.text).ok_or_else(|| fault(format!("{} is not an MP1 keyword", quoted(word.text))))?;
        let switch = keyword <= Keyword::ClipPlane;
        if switch && self.begun {
            let message = format!("{} must come right after png, before any other command", word.text);
            return Err(fault(message));
        }
        self.begun |= !switch;
        let arguments = &mut Arguments::new(line, count)?;
        match keyword {
            Keyword::Depth => self.switches.depth = true,
            Keyword::Srgb => self.switches.srgb = true,
            Keyword::Hyp => self.switches.hyp = true,
            Keyword::Frustum => self.switches.frustum = true,
            Keyword::Cull => self.switches.cull = true,
            Keyword::Decals => self.switches.decals = true,
            Keyword::Fsaa => self.switches.fsaa = self.fsaa(arguments)?,
            Keyword::ClipPlane if self.switches.clip_planes.len() == MOST_CLIP_PLANES => {
                return Err(fault(format!("more than {MOST_CLIP_PLANES} clip planes")));
            }
            Keyword::ClipPlane => self.switches.clip_planes.push(arguments.numbers()?),
            Keyword::Png => return Err(fault("png appears a second time".to_owned())),
            Keyword::Rgb => (self.rgb, self.alpha) = (arguments.numbers()?, 1.0),
            Keyword::Rgba => (self.rgb, self.alpha) = (arguments.numbers()?, alpha(arguments)?),
            Keyword::TexCoord => self.texcoord = arguments.numbers()?,
            Keyword::Texture => self.texture = Some(self.textures.read(arguments)?.1),
            Keyword::Xyzw => self.vertex(arguments)?,
            Keyword::Tri => self.draw(arguments, |p, a| Ok(Shape::Triangle(p.corners(a)?)))?,
            Keyword::Trit => self.draw(arguments, |p, a| {
                let texture = p.current_texture(a, "trit")?;
                Ok(Shape::Textured(p.corners(a)?, texture))
            })?,
            Keyword::Point => self.draw(arguments, |p, a| Ok(Shape::Point(size(a)?, p.corner(a)?)))?,
            Keyword::Billboard => self.draw(arguments, |p, a| {
                let texture = p.current_texture(a, "billboard")?;
                Ok(Shape::Billboard(size(a)?, p.corner(a)?, texture))
            })?,
            Keyword::Circle => self.draw(arguments, |p, a| Ok(Shape::Circle(size(a)?, p.corner(a)?)))?,
            Keyword::Line => self.draw(arguments, |p, a| Ok(Shape::Line(p.corners(a)?)))?,
            Keyword::WuLine => self.draw(arguments, |p, a| Ok(Shape::WuLine(p.corners(a)?)))?,
        }
        Ok(())
    }

    /// A level at which the samples, too, keep to the limits of a picture.
    fn fsaa(&self, arguments: &mut Arguments<'_>) -> Result<u32, Fault> {
        let level = arguments.integer("fsaa level", 1, MOST_FSAA)?;
        // At most 16 · 16384 each.
        let (width, height) = (self.header.width * level, self.header.height * level);
        let samples = u64::from(width) * u64::from(height);
        if width.max(height) > LONGEST_SIDE || samples > MOST_PIXELS {
            let limits = format!("at most {LONGEST_SIDE} a side and {MOST_PIXELS} in all");
            let message = format!("fsaa {level} makes {width} x {height} samples: {limits}");
            return Err(Fault::new(arguments.last(), message));
        }
        Ok(level)
    }

    fn vertex(&mut self, arguments: &mut Arguments<'_>) -> Result<(), Fault> {
        self.vertices.push(Vertex {
            position: arguments.numbers()?,
            rgb: self.rgb,
            alpha: self.alpha,
            texcoord: self.texcoord,
        });
        Ok(())
    }

    fn draw<'a>(
        &mut self,
        arguments: &mut Arguments<'a>,
        shape: impl FnOnce(&Self, &mut Arguments<'a>) -> Result<Shape, Fault>,
    ) -> Result<(), Fault> {
        let place = arguments.keyword();
        let shape = shape(self, arguments)?;
        self.primitives.push(Primitive { place, shape });
        Ok(())
    }

    fn corner(&self, arguments: &mut Arguments<'_>) -> Result<Vertex, Fault> {
        Ok(self.vertices[arguments.index(self.vertices.len())?])
    }

    fn corners<const N: usize>(&self, arguments: &mut Arguments<'_>) -> Result<[Vertex; N], Fault> {
        let indices: [usize; N] = arguments.indices(self.vertices.len())?;
        Ok(array::from_fn(|i| self.vertices[indices[i]]))
    }

    fn current_texture(&self, arguments: &Arguments<'_>, keyword: &str) -> Result<Arc<Picture>, Fault> {
        let missing = || Fault::new(arguments.keyword(), format!("{keyword} before any texture"));
        self.texture.clone().ok_or_else(missing)
    }
}

fn alpha(arguments: &mut Arguments<'_>) -> Result<f64, Fault> {
    let alpha = arguments.number()?;
    if (0.0..=1.0).contains(&alpha) {
        Ok(alpha)
    } else {
        Err(Fault::new(arguments.last(), "alpha must be from 0 to 1"))
    }
}

fn size(arguments: &mut Arguments<'_>) -> Result<f64, Fault> {
    let size = arguments.number()?;
    if size >= 0.0 {
        Ok(size)
    } else {
        Err(Fault::new(arguments.last(), "the size must not be negative"))
    }
}
