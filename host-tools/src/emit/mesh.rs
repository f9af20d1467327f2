//! A mesh as Rust: what a firmware turns and moves itself.
//!
//! ```text
//! model -> corners welded, numbers of 16 bits -> convex? -> Rust
//! ```

mod frame;

use std::collections::HashMap;
use std::fmt::{Debug, Write};
use std::mem::size_of;

use fixel::view::ScreenVertex;

pub use frame::Frame;

use super::write::tables::push_table;
use crate::scene::Fault;
use crate::scene::iv::{Model, Shading};

/// 1 in the tables' units of 2^-15, or as near as 16 bits get.
const ONE: f64 = 32767.0;
/// Rows of the strips for which RAM is told.
const STRIP: usize = 16;

/// What a corner is: a position, and with Gouraud shading its normal.
type Corner = ([i16; 3], [i16; 3]);

/// A mesh as a firmware holds it.
#[derive(Debug, Clone)]
pub struct Mesh {
    corners: Vec<Corner>,
    triangles: Vec<[u16; 3]>,
    /// Of the triangles, with flat shading.
    normals: Option<Vec<[i16; 3]>>,
    convex: bool,
    unseen: usize,
    compact: bool,
}

/// A mesh as Rust.
#[derive(Debug, Clone)]
pub struct EmittedMesh {
    /// The file.
    pub text: String,
    /// What it takes, for people.
    pub lines: Vec<String>,
    /// Bytes of its tables.
    pub data: usize,
    /// Bytes of code on a Cortex-M4 at opt-level 3, with what makes view and light: an estimate.
    pub code: usize,
    /// Whether it is drawn with a depth buffer.
    pub depth: bool,
    /// A frame of it, and the instructions of a Cortex-M4 that this is estimated to take. `None` where the picture is too
    /// large for the core, beyond 4096 pixels a side.
    pub frame: Option<(Frame, u64)>,
}

impl Mesh {
    /// Of all objects of a model, before their transforms, which [OBJ meshes](crate::scene::obj) do not have. Triangles
    /// that have no area, or lose it in 16 bits, are left out.
    ///
    /// # Errors
    /// A fault of the whole where there are more than 65535 different corners, no triangle, or with Phong shading, for
    /// which a firmware needs a program of its own.
    pub fn new(model: &Model, shading: Shading) -> Result<Self, Fault> {
        if shading == Shading::Phong {
            return Err(Fault::of_whole("a mesh is emitted with flat or gouraud shading"));
        }
        let mut welded = Welded::default();
        let (mut triangles, mut normals) = (Vec::new(), Vec::new());
        let mut unseen = 0;
        for object in &model.objects {
            for face in &object.faces {
                let corners: Vec<Corner> = face
                    .corners
                    .iter()
                    .map(|corner| {
                        (
                            quantised(object.points[corner.point]),
                            unit(object.normals[corner.normal]),
                        )
                    })
                    .collect();
                for pair in corners.windows(2).skip(1) {
                    let triangle = [corners[0], pair[0], pair[1]];
                    let across = perpendicular(triangle.map(|(position, _)| position));
                    if across == [0; 3] {
                        unseen += 1;
                        continue;
                    }
                    normals.push(unit(across.map(|c| c as f64)));
                    let mut indices = [0; 3];
                    for (index, (position, normal)) in indices.iter_mut().zip(triangle) {
                        let normal = if shading == Shading::Flat { [0; 3] } else { normal };
                        *index = welded.index((position, normal))?;
                    }
                    triangles.push(indices);
                }
            }
        }
        if triangles.is_empty() {
            return Err(Fault::of_whole("no triangle has an area"));
        }
        let corners = welded.corners;
        let convex = is_convex(&corners, &triangles);
        Ok(Mesh {
            corners,
            triangles,
            normals: (shading == Shading::Flat).then_some(normals),
            convex,
            unseen,
            compact: false,
        })
    }

    /// Drawn by less code and more instructions, as [`Compact`](fixel::fragment::Compact) has it.
    pub fn compact(self) -> Self {
        Mesh { compact: true, ..self }
    }

    /// As Rust, for a picture of this size. `origin` says in the file's first lines where it came from.
    pub fn emit(&self, origin: &str, (width, height): (u32, u32)) -> EmittedMesh {
        let side = |side: u32| u16::try_from(side).ok();
        let frame = side(width).zip(side(height));
        let frame = frame.and_then(|(width, height)| Frame::of(self, width, height).ok());
        let frame = frame.map(|frame| {
            let instructions = frame.instructions(self);
            (frame, instructions)
        });
        let mut lines = self.lines(width as usize, height as usize);
        if let Some((_, instructions)) = &frame {
            lines.push(format!(
                "instructions: about {instructions} for a frame with all of it seen, as large as fits (estimated, Cortex-M4)"
            ));
        }
        let mut text = format!("// Made by: {origin}\n//\n");
        for line in &lines {
            let _ = writeln!(text, "// {line}");
        }
        text += "\n";
        text += &self.code();
        let positions = self.corners.iter().map(|(position, _)| position);
        text += "/// x, y, z in units of 2^-15.\n";
        push_static("POSITIONS", "[i16; 3]", positions, &mut text);
        text += "/// Of length 1 in units of 2^-15.\n";
        match &self.normals {
            Some(normals) => push_static("NORMALS", "[i16; 3]", normals.iter(), &mut text),
            None => push_static(
                "NORMALS",
                "[i16; 3]",
                self.corners.iter().map(|(_, normal)| normal),
                &mut text,
            ),
        }
        text += "/// Counter-clockwise as seen from outside.\n";
        push_static("TRIANGLES", "[u16; 3]", self.triangles.iter(), &mut text);
        let text = text.trim_end().to_owned() + "\n";
        EmittedMesh {
            text,
            lines,
            data: self.data(),
            code: self.code_size(),
            depth: !self.convex,
            frame,
        }
    }

    /// Bytes of all tables.
    fn data(&self) -> usize {
        let corners = self.corners.len();
        6 * (corners + self.normals.as_ref().map_or(corners, Vec::len) + self.triangles.len())
    }

    /// Rounded from images of one mesh each with a view and light made from angles, less one of none; `cargo xtask emitted` measures
    /// them again.
    fn code_size(&self) -> usize {
        let flat = self.normals.is_some();
        match (flat, self.convex, self.compact) {
            (true, true, false) => 27_500,
            (true, true, true) => 22_000,
            (true, false, false) => 37_000,
            (true, false, true) => 30_500,
            (false, true, false) => 40_500,
            (false, true, true) => 25_000,
            (false, false, false) => 48_000,
            (false, false, true) => 31_000,
        }
    }

    fn lines(&self, width: usize, height: usize) -> Vec<String> {
        let (vertices, triangles) = (self.corners.len(), self.triangles.len());
        let flat = self.normals.is_some();
        let shading = if flat {
            "a colour for each triangle"
        } else {
            "a colour for each vertex"
        };
        let mut lines = vec![format!(
            "mesh: {vertices} vertices, {triangles} triangles, {shading}, one sun"
        )];
        lines.push(format!(
            "depth buffer: {}",
            if self.convex {
                "none, the mesh is convex (leave out what is turned away: Cull::Clockwise)"
            } else {
                "16 bits a pixel"
            }
        ));
        if self.unseen > 0 {
            lines.push(format!("left out: {} triangles without area", self.unseen));
        }
        lines.push(format!(
            "flash: {} bytes of data, about {} of {}code with what makes view and light (Cortex-M4, opt-level 3)",
            self.data(),
            self.code_size(),
            if self.compact { "compact " } else { "" }
        ));
        let vertex = if flat {
            size_of::<ScreenVertex<i32, ()>>()
        } else {
            size_of::<ScreenVertex<i32, [i32; 3]>>()
        };
        let pixel = if self.convex { 2 } else { 4 };
        lines.push(format!(
            "RAM: {} bytes of vertices; {} bytes for a frame of {width} x {height}, {} for a strip of {STRIP} rows",
            vertex * vertices,
            pixel * width * height,
            pixel * width * height.min(STRIP)
        ));
        lines
    }

    /// Everything but the tables.
    fn code(&self) -> String {
        let count = self.corners.len();
        let flat = self.normals.is_some();
        let mut code = String::from("use fixel::depth::");
        code += if self.convex { "NoDepth" } else { "Depth" };
        code += ";\nuse fixel::draw;\nuse fixel::fragment::";
        let program = if flat { "Flat565" } else { "Gouraud565" };
        code += &if self.compact {
            format!("{{Compact, {program}}}")
        } else {
            program.to_owned()
        };
        code +=
            ";\nuse fixel::light::Sunlight;\nuse fixel::target::Target;\nuse fixel::view::{ScreenVertex, View};\n\n";
        let carried = if flat { "()" } else { "[i32; 3]" };
        let empty = if flat { "()" } else { "[0; 3]" };
        let _ = write!(
            code,
            "/// A vertex on the screen{with}.
pub type Vertex = ScreenVertex<i32, {carried}>;

/// Room for all vertices.
pub const EMPTY: [Vertex; {count}] = [Vertex::empty({empty}); {count}];

/// Draws the mesh: `view`'s projection takes its own space, in which it fills the sphere of radius 1,
/// to clip space. `light` shines in units of 2^-16 of RGB565's levels.
pub fn draw<C{generic}>(
    view: &View<i32, i32, 0>,
    light: &Sunlight,
    vertices: &mut [Vertex; {count}],
    color: &mut C,
{parameter}) where
    C: Target<Pixel = u16>,
{bound}{{
",
            with = if flat { "" } else { " with its colour" },
            generic = if self.convex { "" } else { ", D" },
            parameter = if self.convex { "" } else { "    depth: &mut D,\n" },
            bound = if self.convex { "" } else { "    D: Depth,\n" },
        );
        let depth = if self.convex { "&mut NoDepth" } else { "depth" };
        let drawn = |program: &str| {
            if self.compact {
                format!("Compact({program})")
            } else {
                program.to_owned()
            }
        };
        if flat {
            let _ = write!(
                code,
                "    for (vertex, position) in vertices.iter_mut().zip(&POSITIONS) {{
        *vertex = view.stored_vertex(*position, ());
    }}
    for (triangle, normal) in TRIANGLES.iter().zip(&NORMALS) {{
        let [red, green, blue] = light.shade(*normal).map(|channel| channel >> 16);
        let pixel = {};
        draw::indexed(view, color, {depth}, vertices, [*triangle], &pixel);
    }}
}}

",
                drawn("Flat565::new((red << 11 | green << 5 | blue) as u16)")
            );
        } else {
            let _ = write!(
                code,
                "    let stored = POSITIONS.iter().zip(&NORMALS);
    for (vertex, (position, normal)) in vertices.iter_mut().zip(stored) {{
        *vertex = view.stored_vertex(*position, light.shade(*normal));
    }}
    let triangles = TRIANGLES.iter().copied();
    let fragment = {};
    draw::indexed(view, color, {depth}, vertices, triangles, &fragment);
}}

",
                drawn("Gouraud565")
            );
        }
        code
    }
}

/// A table in flash that is never copied.
fn push_static<'t, T: Debug + 't>(
    name: &str,
    of: &str,
    items: impl ExactSizeIterator<Item = &'t T>,
    text: &mut String,
) {
    let count = items.len();
    push_table(name, of, count, items.map(|item| format!("{item:?}")), text);
}

/// Corners by what they are, numbered in the order of their first use.
#[derive(Default)]
struct Welded {
    numbers: HashMap<Corner, u16>,
    corners: Vec<Corner>,
}

impl Welded {
    fn index(&mut self, corner: Corner) -> Result<u16, Fault> {
        if let Some(&number) = self.numbers.get(&corner) {
            return Ok(number);
        }
        // The largest index ends a face in meshes of the core.
        let number = u16::try_from(self.corners.len())
            .ok()
            .filter(|&number| number < u16::MAX);
        let number = number.ok_or_else(|| Fault::of_whole("more than 65535 different vertices"))?;
        self.numbers.insert(corner, number);
        self.corners.push(corner);
        Ok(number)
    }
}

/// Coordinates in −1…1 to the nearest unit.
fn quantised(point: [f64; 3]) -> [i16; 3] {
    point.map(|c| (c * ONE).round() as i16)
}

/// The same direction with length 1; the zero vector stays.
fn unit(direction: [f64; 3]) -> [i16; 3] {
    // Halves of the largest first: any finite numbers will do.
    let largest = direction.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    if largest == 0.0 {
        return [0; 3];
    }
    let direction = direction.map(|c| c / largest);
    let length = direction.iter().map(|c| c * c).sum::<f64>().sqrt();
    quantised(direction.map(|c| c / length))
}

/// (B − A) × (C − A), exactly.
fn perpendicular([a, b, c]: [[i16; 3]; 3]) -> [i64; 3] {
    let from_a = |p: [i16; 3]| [0, 1, 2].map(|i| i64::from(p[i]) - i64::from(a[i]));
    let (b, c) = (from_a(b), from_a(c));
    [0, 1, 2].map(|i| b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3])
}

/// Whether no corner lies before any triangle: then no two triangles that face the same eye overlap. Exact: coordinates
/// have 17 bits as differences, perpendiculars 35, their products 54.
fn is_convex(corners: &[Corner], triangles: &[[u16; 3]]) -> bool {
    triangles.iter().all(|triangle| {
        let [a, b, c] = triangle.map(|index| corners[usize::from(index)].0);
        let across = perpendicular([a, b, c]);
        corners.iter().all(|(p, _)| {
            let before: i64 = (0..3).map(|i| across[i] * (i64::from(p[i]) - i64::from(a[i]))).sum();
            before <= 0
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::obj;
    use crate::scene::size::Size;

    const TETRAHEDRON: &str = "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";

    fn mesh(text: &str, shading: Shading) -> Result<Mesh, Fault> {
        Mesh::new(&obj::parse(text, Size::DEFAULT).unwrap(), shading)
    }

    #[test]
    fn flat_corners_are_shared_and_smooth_ones_only_with_equal_normals() {
        assert_eq!(mesh(TETRAHEDRON, Shading::Flat).unwrap().corners.len(), 4);
        assert_eq!(mesh(TETRAHEDRON, Shading::Gouraud).unwrap().corners.len(), 12);
    }

    #[test]
    fn a_convex_mesh_needs_no_depth_and_a_dented_or_inverted_one_does() {
        assert!(mesh(TETRAHEDRON, Shading::Flat).unwrap().convex);
        let dented = "v 0 0 0\n".to_owned() + &TETRAHEDRON.replace("f 2 4 3", "f 2 4 5");
        assert!(!mesh(&dented, Shading::Flat).unwrap().convex);
        let inverted = TETRAHEDRON.replace("f 1 2 3", "f 1 3 2");
        assert!(!mesh(&inverted, Shading::Flat).unwrap().convex);
    }

    #[test]
    fn what_has_no_area_is_left_out_and_nothing_else_is_not_a_mesh() {
        let with_point = TETRAHEDRON.to_owned() + "f 1 1 2\n";
        let mesh_of = mesh(&with_point, Shading::Flat).unwrap();
        assert_eq!((mesh_of.triangles.len(), mesh_of.unseen), (4, 1));
        assert!(mesh("v 0 0 0\nv 1 0 0\nf 1 2 1\n", Shading::Flat).is_err());
        assert!(mesh(TETRAHEDRON, Shading::Phong).is_err());
    }
}
