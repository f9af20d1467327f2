//! Walks an HW2 scene's commands once and drives a back end: the state that belongs to no back end lives here.

use crate::backend::{BackEnd, Patch, Surface, Vertex};
use crate::lower;
use crate::scene::hw2::{Action, Fill, Scene};
use crate::scene::{Fault, Place};

/// Draws the scene.
///
/// # Errors
/// A fault at the keyword of a command whose values do not fit the back end, or at a vertex that is drawn and does not fit the core.
pub fn interpret(scene: &Scene, back_end: &mut dyn BackEnd) -> Result<(), Fault> {
    let mut state = State {
        scene,
        vertices: Vec::new(),
        places: Vec::new(),
        next: Vertex {
            position: [0.0; 4],
            color: [1.0; 3],
            normal: None,
            texcoord: [0.0; 2],
        },
        primitives: 0,
    };
    for command in &scene.commands {
        let fault = |message| Fault::new(command.place, message);
        if matches!(command.action, Action::Vertex(_)) {
            state.places.push(command.place);
        }
        if !state.remember(&command.action) {
            state.fits(&command.action)?;
            state.obey(&command.action, back_end).map_err(fault)?;
        }
    }
    Ok(())
}

/// What commands leave behind for later ones.
struct State<'s> {
    scene: &'s Scene,
    vertices: Vec<Vertex>,
    /// Where the vertices were made.
    places: Vec<Place>,
    /// What the next vertex will be, but for its position.
    next: Vertex,
    /// Drawn so far.
    primitives: u32,
}

impl State<'_> {
    /// Whether the action only changes what later ones draw with.
    fn remember(&mut self, action: &Action) -> bool {
        match *action {
            Action::Vertex(position) => self.vertices.push(Vertex { position, ..self.next }),
            Action::Color(color) => self.next.color = color,
            Action::Normal(normal) => self.next.normal = (normal != [0.0; 3]).then_some(normal),
            Action::TexCoord(texcoord) => self.next.texcoord = texcoord,
            _ => return false,
        }
        true
    }

    /// Whether what is drawn has vertices that the core can hold.
    fn fits(&self, action: &Action) -> Result<(), Fault> {
        let used: &[usize] = match action {
            Action::Triangle(_, corners) => corners,
            Action::RectPatch(_, _, points) => &points[..],
            Action::TriPatch(_, _, points) => &points[..],
            _ => &[],
        };
        for (vertex, place) in used
            .iter()
            .filter_map(|&i| Some((self.vertices.get(i)?, self.places.get(i)?)))
        {
            lower::keeps_w(vertex.position).map_err(|message| Fault::new(*place, message))?;
        }
        Ok(())
    }

    fn obey(&mut self, action: &Action, back_end: &mut dyn BackEnd) -> Result<(), String> {
        match action {
            Action::Vertex(_) | Action::Color(_) | Action::Normal(_) | Action::TexCoord(_) => {}
            Action::Texture(name) => {
                let texture = self.scene.textures.get(name).ok_or("the texture was not loaded")?;
                back_end.texture(texture)?;
            }
            Action::Triangle(fill, corners) => {
                let corners = self.vertices(corners)?;
                let first = self.count(1)?;
                back_end.triangle(first, corners, self.surface(*fill))?;
            }
            Action::RectPatch(fill, level, points) => {
                self.patch(Patch::Rectangular(&self.vertices(points)?), *level, *fill, back_end)?;
            }
            Action::TriPatch(fill, level, points) => {
                self.patch(Patch::Triangular(&self.vertices(points)?), *level, *fill, back_end)?;
            }
            Action::LoadMv(m) => back_end.load_mv(m)?,
            Action::MultMv(m) => back_end.mult_mv(m)?,
            Action::LoadP(m) => back_end.load_p(m)?,
            Action::Translate(by) => back_end.translate(*by)?,
            Action::Rotate(degrees, axis) => back_end.rotate(*degrees, *axis)?,
            Action::Scale(by) => back_end.scale(*by)?,
            Action::LookAt(eye, center, up) => {
                let [eye, center] = self.vertices(&[*eye, *center])?;
                back_end.look_at(eye.position, center.position, *up)?;
            }
            Action::Frustum(planes) => back_end.frustum(*planes)?,
            Action::Ortho(planes) => back_end.ortho(*planes)?,
            Action::ClipPlane(plane) => back_end.clip_plane(*plane)?,
            Action::Cull => back_end.cull(),
            Action::Decals => back_end.decals(),
            Action::FlatNormals => back_end.flat_normals(),
            Action::Sun(direction) => back_end.sun(*direction, self.next.color)?,
            Action::Bulb(vertex) => {
                let [at] = self.vertices(&[*vertex])?;
                back_end.bulb(at.position, self.next.color)?;
            }
            Action::Shininess(exponent) => back_end.shininess(*exponent)?,
        }
        Ok(())
    }

    fn patch(&mut self, patch: Patch<'_>, level: u32, fill: Fill, back_end: &mut dyn BackEnd) -> Result<(), String> {
        let first = self.count(patch.triangles(level))?;
        back_end.patch(first, level, patch, self.surface(fill))
    }

    fn surface(&self, fill: Fill) -> Surface {
        match fill {
            Fill::Flat => Surface::Flat(self.next.color),
            Fill::Gouraud => Surface::Gouraud,
            Fill::Textured => Surface::Textured,
        }
    }

    /// The number of the first of so many primitives.
    fn count(&mut self, more: u32) -> Result<u32, String> {
        let first = self.primitives + 1;
        self.primitives = (self.primitives.checked_add(more)).ok_or("more than 2^32 - 1 triangles in one scene")?;
        Ok(first)
    }

    /// The parser has resolved and checked the indices.
    fn vertices<const N: usize>(&self, indices: &[usize; N]) -> Result<[Vertex; N], String> {
        let mut found = [self.next; N];
        for (vertex, &index) in found.iter_mut().zip(indices) {
            let made = self.vertices.get(index);
            *vertex = *made.ok_or_else(|| format!("vertex {} does not exist", index + 1))?;
        }
        Ok(found)
    }
}
