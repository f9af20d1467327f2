//! A frame of a mesh, drawn by the core on this machine: what it looks like, and what it took.

use std::cell::Cell;

use fixel::depth::FAR;
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Compact, Flat565, Fragment, Gouraud565};
use fixel::target::Buffer;
use fixel::view::{Carried, View};
use fixel::window::Window;
use fixel_workloads::shown;

use super::{Corner, Mesh};
use crate::emit::drawing::Nearer;
use crate::emit::replay::Chosen;

/// A mesh as [`shown`] shows it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Frame {
    /// RGB565, row by row.
    pub pixels: Vec<u16>,
    /// Triangles that cover a pixel.
    seen: u64,
    /// Their rows.
    spans: u64,
    /// Their pixels, hidden ones included.
    covered: u64,
}

/// What it takes on a Cortex-M4 to make view and light from angles, once a frame.
const SETUP: f64 = 45_000.0;

/// What a step of drawing takes on a Cortex-M4, rounded from what `cargo xtask emitted` measures.
struct Cost {
    vertex: f64,
    /// One that is turned away or too small to be seen.
    unseen: f64,
    seen: f64,
    span: f64,
    pixel: f64,
}

impl Cost {
    fn of(flat: bool, depth: bool) -> Self {
        let by_depth = |without, with| if depth { with } else { without };
        if flat {
            Cost {
                vertex: 130.0,
                unseen: 200.0,
                seen: by_depth(700.0, 1100.0),
                span: by_depth(30.0, 45.0),
                pixel: by_depth(0.7, 9.0),
            }
        } else {
            Cost {
                vertex: 165.0,
                unseen: 200.0,
                seen: by_depth(1000.0, 1300.0),
                span: by_depth(50.0, 60.0),
                pixel: by_depth(9.5, 16.0),
            }
        }
    }
}

impl Frame {
    /// Draws it.
    ///
    /// # Errors
    /// Where the core cannot: beyond 4096 pixels a side.
    pub fn of(mesh: &Mesh, width: u16, height: u16) -> Result<Self, Error> {
        let window = Window::new(0, 0, width.into(), height.into());
        let mut frame = Frame {
            pixels: vec![0; usize::from(width) * usize::from(height)],
            seen: 0,
            spans: 0,
            covered: 0,
        };
        let (view, sun) = (shown::view(width, height)?, shown::sun()?);
        match &mesh.normals {
            Some(normals) => {
                let corners: Vec<_> = mesh.corners.iter().map(|(position, _)| (*position, ())).collect();
                let pixel = |triangle: usize| {
                    let normal = normals.get(triangle).copied().unwrap_or_default();
                    let [red, green, blue] = sun.shade(normal).map(|channel| channel >> 16);
                    Flat565::new((red << 11 | green << 5 | blue) as u16)
                };
                if mesh.compact {
                    frame.draw(mesh, &view, window, &corners, |triangle| Compact(pixel(triangle)))?;
                } else {
                    frame.draw(mesh, &view, window, &corners, pixel)?;
                }
            }
            None => {
                let lit = |(position, normal): &Corner| (*position, sun.shade(*normal));
                let corners: Vec<_> = mesh.corners.iter().map(lit).collect();
                if mesh.compact {
                    frame.draw(mesh, &view, window, &corners, |_| Compact(Gouraud565))?;
                } else {
                    frame.draw(mesh, &view, window, &corners, |_| Gouraud565)?;
                }
            }
        }
        Ok(frame)
    }

    /// Triangle by triangle, so that those are counted which are seen.
    fn draw<F: Fragment<Varying: Carried, Pixel = u16>>(
        &mut self,
        mesh: &Mesh,
        view: &View<i32, i32, 0>,
        window: Window,
        corners: &[([i16; 3], <F::Varying as Carried>::Vertex)],
        fragment: impl Fn(usize) -> F,
    ) -> Result<(), Error>
    where
        <F::Varying as Carried>::Vertex: Copy,
    {
        let vertices: Vec<_> = corners
            .iter()
            .map(|(position, carried)| view.stored_vertex(*position, *carried))
            .collect();
        let mut depths = vec![FAR; self.pixels.len()];
        let (spans, covered) = (Cell::new(0), Cell::new(0));
        let mut color = Buffer::strip(&mut self.pixels, window)?;
        let mut depth = Chosen {
            cells: Buffer::strip(&mut depths, window)?,
            rule: (!mesh.convex).then_some(Nearer::LessOrEqual),
            spans: &spans,
            covered: &covered,
        };
        for (number, triangle) in mesh.triangles.iter().enumerate() {
            let before = spans.get();
            draw::indexed(view, &mut color, &mut depth, &vertices, [*triangle], &fragment(number));
            self.seen += u64::from(spans.get() > before);
        }
        (self.spans, self.covered) = (spans.get(), covered.get());
        Ok(())
    }

    /// Instructions of a Cortex-M4 for a frame, with its clearing, and with making view and light: an estimate.
    pub fn instructions(&self, mesh: &Mesh) -> u64 {
        let depth = !mesh.convex;
        let cost = Cost::of(mesh.normals.is_some(), depth);
        let clear = if depth { 1.0 } else { 0.5 } * self.pixels.len() as f64;
        let unseen = mesh.triangles.len() as u64 - self.seen;
        let parts = [
            (mesh.corners.len() as u64, cost.vertex),
            (unseen, cost.unseen),
            (self.seen, cost.seen),
            (self.spans, cost.span),
            (self.covered, cost.pixel),
        ];
        let sum: f64 = parts.into_iter().map(|(count, each)| count as f64 * each).sum();
        (SETUP + clear + sum) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::iv::Shading;
    use crate::scene::obj;
    use crate::scene::size::Size;

    const OCTAHEDRON: &str = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
        f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";

    fn frame(shading: Shading, side: u16) -> (Mesh, Frame) {
        let mesh = Mesh::new(&obj::parse(OCTAHEDRON, Size::DEFAULT).unwrap(), shading).unwrap();
        let frame = Frame::of(&mesh, side, side).unwrap();
        (mesh, frame)
    }

    #[test]
    fn a_convex_mesh_covers_each_pixel_once_with_the_triangles_before_it() {
        let (_, frame) = frame(Shading::Flat, 100);
        let drawn = frame.pixels.iter().filter(|pixel| **pixel != 0).count();
        assert_eq!(frame.covered, drawn as u64);
        // Half of the sphere's disc at least.
        assert!(drawn > 2500 && (2..=5).contains(&frame.seen), "{drawn} {}", frame.seen);
    }

    #[test]
    fn larger_pictures_and_finer_shading_take_more() {
        let estimate = |shading, side| {
            let (mesh, frame) = frame(shading, side);
            frame.instructions(&mesh)
        };
        assert!(estimate(Shading::Flat, 200) > estimate(Shading::Flat, 100));
        assert!(estimate(Shading::Gouraud, 200) > estimate(Shading::Flat, 200) + 50_000);
    }
}
