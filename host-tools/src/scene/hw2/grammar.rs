//! The grammar of HW2: which keyword takes what, and what must hold of it.
//!
//! Commands are checked in file order and their arguments from left to right, so that the fault reported is the
//! first one in the text.

use std::collections::BTreeMap;
use std::path::Path;

use super::view::{self, WRow};
use super::{Action, Command, Fill, Scene};
use crate::scene::Fault;
use crate::scene::arguments::{Arguments, quoted};
use crate::scene::header::header;
use crate::scene::lex::{self, Line};
use crate::scene::textures::{self, Textures};

/// Parses a scene; textures are looked for in `folder`, and may have [`MOST_PIXELS`](crate::scene::MOST_PIXELS) in all.
pub fn parse(text: impl AsRef<[u8]>, folder: &Path) -> Result<Scene, Fault> {
    let mut textures = BTreeMap::new();
    let mut look_up = textures::in_folder(folder);
    let mut scene = parse_with(text.as_ref(), &mut |name| {
        textures.insert(name.to_owned(), look_up(name)?);
        Ok(())
    })?;
    scene.textures = textures;
    Ok(scene)
}

/// Parses a scene; `check_texture` says what is wrong with the texture of a name, and is asked once for each.
pub fn parse_with(text: &[u8], check_texture: &mut dyn FnMut(&str) -> Result<(), String>) -> Result<Scene, Fault> {
    let mut lines = lex::lines(text);
    let header = header(lines.next().transpose()?)?;
    let mut parser = Parser {
        textures: Textures::new(check_texture),
        vertices: Vec::new(),
        w_row: WRow::IDENTITY,
    };
    let mut commands = Vec::new();
    for line in lines {
        let line = line?;
        let place = line.keyword.place;
        let action = parser.action(line)?;
        commands.push(Command { place, action });
    }
    Ok(Scene {
        width: header.width,
        height: header.height,
        output: header.output,
        commands,
        textures: BTreeMap::new(),
    })
}

/// How many arguments a keyword takes; nothing for a word that is no keyword.
fn arity(keyword: &str) -> Option<usize> {
    Some(match keyword {
        "cull" | "decals" | "flatnormals" => 0,
        "texture" | "rotatex" | "rotatey" | "rotatez" | "bulb" | "shininess" => 1,
        "texcoord" => 2,
        "png" | "xyz" | "color" | "normal" | "trif" | "trig" | "trit" => 3,
        "translate" | "scale" | "sunlight" => 3,
        "xyzw" | "rotate" | "clipplane" => 4,
        "lookat" => 5,
        "frustum" | "ortho" => 6,
        "tribezf" | "tribezg" => 11,
        "loadmv" | "multmv" | "loadp" => 16,
        "rectbezf" | "rectbezg" => 17,
        _ => return None,
    })
}

/// What of the state so far decides whether a command is valid.
struct Parser<'t> {
    textures: Textures<'t, ()>,
    vertices: Vec<[f64; 4]>,
    w_row: WRow,
}

impl Parser<'_> {
    fn action(&mut self, line: Line<'_>) -> Result<Action, Fault> {
        let keyword = line.keyword;
        let fault = |message: String| Err(Fault::new(keyword.place, message));
        let Some(count) = arity(keyword.text) else {
            return fault(format!("{} is not an HW2 keyword", quoted(keyword.text)));
        };
        if keyword.text == "png" {
            return fault("png appears a second time".to_owned());
        }
        let arguments = &mut Arguments::new(line, count)?;
        if keyword.text == "trit" && self.textures.is_empty() {
            return fault("trit before any texture".to_owned());
        }
        match keyword.text {
            "xyz" | "xyzw" => self.vertex(arguments, count),
            "trif" | "trig" | "trit" => self.triangle(arguments, fill(keyword.text)),
            "rectbezf" | "rectbezg" => self.rect_patch(arguments, fill(keyword.text)),
            "tribezf" | "tribezg" => self.tri_patch(arguments, fill(keyword.text)),
            "rotatex" => self.rotate(arguments, Some([1.0, 0.0, 0.0])),
            "rotatey" => self.rotate(arguments, Some([0.0, 1.0, 0.0])),
            "rotatez" => self.rotate(arguments, Some([0.0, 0.0, 1.0])),
            "rotate" => self.rotate(arguments, None),
            "loadmv" | "multmv" | "translate" | "scale" => self.transform(arguments, keyword.text),
            "lookat" => self.look_at(arguments),
            "texture" => self.texture(arguments),
            "bulb" => self.bulb(arguments),
            "frustum" => Ok(Action::Frustum(planes(arguments)?)),
            "ortho" => Ok(Action::Ortho(planes(arguments)?)),
            other => plain(arguments, other),
        }
    }

    fn vertex(&mut self, arguments: &mut Arguments<'_>, count: usize) -> Result<Action, Fault> {
        let [x, y, z] = arguments.numbers()?;
        let w = if count == 4 { arguments.number()? } else { 1.0 };
        self.vertices.push([x, y, z, w]);
        Ok(Action::Vertex([x, y, z, w]))
    }

    fn triangle(&self, arguments: &mut Arguments<'_>, fill: Fill) -> Result<Action, Fault> {
        let corners = arguments.indices(self.vertices.len())?;
        Ok(Action::Triangle(fill, corners))
    }

    fn rect_patch(&self, arguments: &mut Arguments<'_>, fill: Fill) -> Result<Action, Fault> {
        let level = arguments.integer("subdivision level", 1, 8)?;
        let points = arguments.indices(self.vertices.len())?;
        Ok(Action::RectPatch(fill, level, points))
    }

    fn tri_patch(&self, arguments: &mut Arguments<'_>, fill: Fill) -> Result<Action, Fault> {
        let level = arguments.integer("subdivision level", 1, 8)?;
        let points = arguments.indices(self.vertices.len())?;
        Ok(Action::TriPatch(fill, level, points))
    }

    /// With an axis of its own, or one to be read.
    fn rotate(&mut self, arguments: &mut Arguments<'_>, axis: Option<[f64; 3]>) -> Result<Action, Fault> {
        let degrees = arguments.number()?;
        let axis = match axis {
            Some(axis) => axis,
            None => {
                let x = arguments.number()?;
                let place = arguments.last();
                let [y, z] = arguments.numbers()?;
                if [x, y, z] == [0.0; 3] {
                    return Err(Fault::new(place, "the axis of rotate must not be 0 0 0"));
                }
                [x, y, z]
            }
        };
        self.w_row = self.w_row.rotate(degrees, axis);
        Ok(Action::Rotate(degrees, axis))
    }

    fn transform(&mut self, arguments: &mut Arguments<'_>, keyword: &str) -> Result<Action, Fault> {
        Ok(match keyword {
            "loadmv" => {
                let matrix = arguments.matrix()?;
                self.w_row = WRow::load(&matrix);
                Action::LoadMv(matrix)
            }
            "multmv" => {
                let matrix = arguments.matrix()?;
                self.w_row = self.w_row.times(&matrix);
                Action::MultMv(matrix)
            }
            "translate" => {
                let by = arguments.numbers()?;
                self.w_row = self.w_row.translate(by);
                Action::Translate(by)
            }
            _ => {
                let by = arguments.numbers()?;
                self.w_row = self.w_row.scale(by);
                Action::Scale(by)
            }
        })
    }

    fn look_at(&mut self, arguments: &mut Arguments<'_>) -> Result<Action, Fault> {
        let (eye, from) = self.point(arguments)?;
        let (center, to) = self.point(arguments)?;
        if from == to {
            let message = "lookat needs a center that is not the eye";
            return Err(Fault::new(arguments.keyword(), message));
        }
        let up = arguments.numbers()?;
        let forward = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        if view::parallel(forward, up) {
            let message = "the up of lookat must not lie along the view";
            return Err(Fault::new(arguments.keyword(), message));
        }
        self.w_row = WRow::IDENTITY;
        Ok(Action::LookAt(eye, center, up))
    }

    /// A vertex that must be a point: where it is in the list, and xyz/w.
    fn point(&self, arguments: &mut Arguments<'_>) -> Result<(usize, [f64; 3]), Fault> {
        let index = arguments.index(self.vertices.len())?;
        match view::point(self.vertices[index]) {
            Some(point) => Ok((index, point)),
            None => Err(Fault::new(arguments.last(), "this vertex is no point: its w is 0")),
        }
    }

    fn texture(&mut self, arguments: &mut Arguments<'_>) -> Result<Action, Fault> {
        let (name, ()) = self.textures.read(arguments)?;
        Ok(Action::Texture(name))
    }

    fn bulb(&self, arguments: &mut Arguments<'_>) -> Result<Action, Fault> {
        let index = arguments.index(self.vertices.len())?;
        if self.w_row.vanishes_at(self.vertices[index]) {
            return Err(Fault::new(
                arguments.last(),
                "this vertex is no point under the model/view matrix: its w is 0",
            ));
        }
        Ok(Action::Bulb(index))
    }
}

/// The keywords whose arguments are numbers and nothing else.
fn plain(arguments: &mut Arguments<'_>, keyword: &str) -> Result<Action, Fault> {
    Ok(match keyword {
        "color" => Action::Color(arguments.numbers()?),
        "normal" => Action::Normal(arguments.numbers()?),
        "texcoord" => Action::TexCoord(arguments.numbers()?),
        "loadp" => Action::LoadP(arguments.matrix()?),
        "clipplane" => Action::ClipPlane(arguments.numbers()?),
        "sunlight" => Action::Sun(arguments.numbers()?),
        "shininess" => Action::Shininess(arguments.number()?),
        "cull" => Action::Cull,
        "decals" => Action::Decals,
        "flatnormals" => Action::FlatNormals,
        other => {
            let message = format!("{} is not an HW2 keyword", quoted(other));
            return Err(Fault::new(arguments.keyword(), message));
        }
    })
}

/// The last letter of a drawing keyword.
fn fill(keyword: &str) -> Fill {
    match keyword.as_bytes().last() {
        Some(b'f') => Fill::Flat,
        Some(b'g') => Fill::Gouraud,
        _ => Fill::Textured,
    }
}

/// l r b t n f, of which no two neighbours may be equal.
fn planes(arguments: &mut Arguments<'_>) -> Result<[f64; 6], Fault> {
    let mut planes = [0.0; 6];
    for (pair, names) in planes
        .chunks_exact_mut(2)
        .zip(["left and right", "bottom and top", "near and far"])
    {
        pair[0] = arguments.number()?;
        let place = arguments.last();
        pair[1] = arguments.number()?;
        if pair[0] == pair[1] {
            return Err(Fault::new(place, format!("{names} must differ")));
        }
    }
    Ok(planes)
}
