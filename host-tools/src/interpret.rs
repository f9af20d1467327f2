//! Walks a scene's commands once and drives a back end: the state that belongs to no back end lives here.

use crate::backend::{BackEnd, Surface, Vertex};
use crate::scene::{Action, Command, Fault, Fill, Scene};

/// Draws the scene.
///
/// # Errors
/// A fault at the keyword of a command that is not supported yet, or whose values do not fit the back end.
pub fn interpret(scene: &Scene, back_end: &mut dyn BackEnd) -> Result<(), Fault> {
    let mut state = State {
        vertices: Vec::new(),
        color: [1.0; 3],
        primitive: 0,
    };
    for command in &scene.commands {
        let fault = |message| Fault {
            place: command.place,
            message,
        };
        state.obey(command, back_end).map_err(fault)?;
    }
    Ok(())
}

/// What commands leave behind for later ones.
struct State {
    vertices: Vec<Vertex>,
    color: [f64; 3],
    primitive: u32,
}

impl State {
    fn obey(&mut self, command: &Command, back_end: &mut dyn BackEnd) -> Result<(), String> {
        match &command.action {
            Action::Vertex(position) => {
                self.vertices.push(Vertex {
                    position: *position,
                    color: self.color,
                });
                Ok(())
            }
            Action::Color(color) => {
                self.color = *color;
                Ok(())
            }
            // Nothing that is drawn yet looks at these.
            Action::Normal(_) | Action::TexCoord(_) | Action::Texture(_) | Action::Decals | Action::FlatNormals => {
                Err(unsupported(&command.action))
            }
            Action::Triangle(fill, corners) => self.triangle(*fill, *corners, back_end),
            Action::LoadMv(m) => back_end.load_mv(m),
            Action::MultMv(m) => back_end.mult_mv(m),
            Action::LoadP(m) => back_end.load_p(m),
            Action::Translate(by) => back_end.translate(*by),
            Action::Rotate(degrees, axis) => back_end.rotate(*degrees, *axis),
            Action::Scale(by) => back_end.scale(*by),
            Action::LookAt(eye, center, up) => {
                back_end.look_at(self.vertex(*eye)?.position, self.vertex(*center)?.position, *up)
            }
            Action::Frustum(planes) => back_end.frustum(*planes),
            Action::Ortho(planes) => back_end.ortho(*planes),
            Action::ClipPlane(plane) => back_end.clip_plane(*plane),
            Action::Cull => {
                back_end.cull();
                Ok(())
            }
            Action::RectPatch(..) | Action::TriPatch(..) | Action::Sun(_) | Action::Bulb(_) | Action::Shininess(_) => {
                Err(unsupported(&command.action))
            }
        }
    }

    fn triangle(&mut self, fill: Fill, corners: [usize; 3], back_end: &mut dyn BackEnd) -> Result<(), String> {
        let surface = match fill {
            Fill::Flat => Surface::Flat(self.color),
            Fill::Gouraud => Surface::Gouraud,
            Fill::Textured => return Err(unsupported(&Action::Triangle(fill, corners))),
        };
        let [a, b, c] = corners;
        self.primitive += 1;
        back_end.triangle(
            self.primitive,
            [self.vertex(a)?, self.vertex(b)?, self.vertex(c)?],
            surface,
        )
    }

    /// The parser has resolved and checked the index.
    fn vertex(&self, index: usize) -> Result<Vertex, String> {
        self.vertices
            .get(index)
            .copied()
            .ok_or_else(|| format!("vertex {} does not exist", index + 1))
    }
}

fn unsupported(action: &Action) -> String {
    let keyword = match action {
        Action::Normal(_) => "normal",
        Action::TexCoord(_) => "texcoord",
        Action::Texture(_) => "texture",
        Action::Decals => "decals",
        Action::FlatNormals => "flatnormals",
        Action::Triangle(..) => "trit",
        Action::RectPatch(Fill::Flat, ..) => "rectbezf",
        Action::RectPatch(..) => "rectbezg",
        Action::TriPatch(Fill::Flat, ..) => "tribezf",
        Action::TriPatch(..) => "tribezg",
        Action::Sun(_) => "sunlight",
        Action::Bulb(_) => "bulb",
        _ => "shininess",
    };
    format!("{keyword} is not supported yet")
}
