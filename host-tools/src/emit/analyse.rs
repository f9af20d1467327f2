//! The smallest set of features that gives the same bytes.
//!
//! A reduction is taken either because it is exact (values that are the same at all corners are the same everywhere
//! between, alpha of 1 hides what is below), or because the picture drawn with it, here and by the core, has the same
//! bytes: no depth buffer, values linear over the screen where w is constant.

use std::mem;

use fixel::blend::ONE;

use super::drawing::{Corner, Draw, Drawing, ONE_W, Paint, Pixels, Program, Shape, Surface, Varying};
use super::evaluate::{Evaluator, sampled};
use super::replay::{Work, blended, replay};
use crate::picture::Picture;

/// A drawing that asks for no more than it needs, and what drawing it takes.
#[derive(Debug, Clone)]
pub struct Analysed {
    /// The drawing.
    pub drawing: Drawing,
    /// Of each draw.
    pub work: Vec<Work>,
    /// Why there is or is no depth buffer.
    pub depth: Depth,
    /// Shapes of the scene that cover no sample.
    pub unseen: usize,
}

/// What has become of the depth buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// The scene does not ask for one.
    Unasked,
    /// No sample is covered twice.
    NoOverlap,
    /// Shapes overlap, but what is drawn later is nearer.
    InOrder,
    /// Something is drawn behind what is there.
    Needed,
}

/// Reduces a drawing whose picture is `wanted`.
///
/// # Panics
/// Where the drawing does not give that picture: a bug of ours.
pub fn analyse(mut drawing: Drawing, wanted: &[[u8; 4]]) -> Analysed {
    let first = replay(&drawing);
    let shapes = drawing.draws.len();
    let mut covered = first.work.iter().map(|work| work.covered > 0);
    drawing.draws.retain(|_| covered.next().unwrap_or(true));
    let unseen = shapes - drawing.draws.len();

    fold_constants(&mut drawing);
    drop_alpha(&mut drawing);
    linear_where_equal(&mut drawing, wanted);
    let depth = depth(&mut drawing, wanted);

    let last = replay(&drawing);
    assert!(last.bytes == wanted, "what was to be emitted gives another picture");
    Analysed {
        drawing,
        work: last.work,
        depth,
        unseen,
    }
}

/// Whether all corners of it lie on one side of the camera: then values stay in the range of the corners'.
fn is_of_one_sign(corners: &[Corner]) -> bool {
    corners.iter().all(|c| c.inverse > 0) || corners.iter().all(|c| c.inverse < 0)
}

/// The values from `start` on, if they are the same at all corners, and so everywhere between.
fn constant<const N: usize>(draw: &Draw, start: usize) -> Option<[i32; N]> {
    let corners = draw.shape.corners();
    let values = |corner: &Corner| {
        let values = corner.values.get(start..)?;
        values.first_chunk::<N>().copied()
    };
    let first = values(corners.first()?)?;
    let same = corners.iter().all(|corner| values(corner) == Some(first));
    (same && is_of_one_sign(corners)).then_some(first)
}

/// Takes `count` values from `start` on off all corners.
fn strip(draw: &mut Draw, start: usize, count: usize) {
    for corner in draw.shape.corners_mut() {
        corner.values.drain(start..start + count);
        corner.over_w.drain(start..start + count);
    }
}

/// Values that are constant go into the program.
fn fold_constants(drawing: &mut Drawing) {
    let mut draws = mem::take(&mut drawing.draws);
    for draw in &mut draws {
        let mut program = draw.program.clone();
        if let Program::Surface { surface, lit, .. } = &mut program {
            if let (Surface::Gouraud, Some(color)) = (&*surface, constant::<3>(draw, 0)) {
                *surface = Surface::Plain(color);
                strip(draw, 0, 3);
            }
            if let Some(lit) = lit
                && lit.normal.is_none()
            {
                let start = carried(surface);
                if let Some(normal) = constant::<3>(draw, start) {
                    lit.normal = Some(normal);
                    strip(draw, start, 3);
                }
            }
        }
        draw.program = program;
    }
    let evaluator = Evaluator::new(drawing);
    for draw in &mut draws {
        let corners = draw.shape.corners();
        let Some(first) = corners.first().map(|c| c.values.clone()) else {
            continue;
        };
        if !is_of_one_sign(corners) || corners.iter().any(|c| c.values != first) {
            continue;
        }
        let mut folded = None;
        evaluator.ready(&draw.program, &mut |ready| {
            folded = Some(match &draw.program {
                Program::Paint(paint) => Program::Paint(Paint::Plain(ready.paint(paint, &first))),
                _ => Program::Flat(ready.bytes(&first)),
            });
        });
        if let Some(folded) = folded {
            draw.program = folded;
            strip(draw, 0, first.len());
            draw.varying = Varying::Nothing;
        }
    }
    drawing.draws = draws;
}

/// How many values a surface carries.
pub fn carried(surface: &Surface) -> usize {
    match surface {
        Surface::Plain(_) => 0,
        Surface::Gouraud => 3,
        Surface::Textured(_) => 2,
        Surface::Decal(..) => 5,
    }
}

/// Alpha that is 1 is not carried; where all is opaque, nothing is blended.
fn drop_alpha(drawing: &mut Drawing) {
    let Pixels::Blended(units) = drawing.pixels else {
        return;
    };
    let solid = |picture: &Picture| picture.pixels.iter().all(|[.., alpha]| *alpha == 255);
    let solid: Vec<bool> = drawing.textures.iter().map(|t| solid(t)).collect();
    let mut all = true;
    for draw in &mut drawing.draws {
        let alpha_is_one = constant::<1>(draw, 3) == Some([ONE]);
        let opaque_texture = sampled(&draw.program).is_some_and(|s| solid.get(s.texture) == Some(&true));
        let Program::Paint(paint) = &mut draw.program else {
            continue;
        };
        let is_opaque = match paint {
            Paint::Plain(color) => color.alpha == ONE,
            Paint::Texels(_) => opaque_texture,
            Paint::Colors { headroom, opaque } | Paint::Decal { headroom, opaque, .. } => {
                *opaque = *headroom == 0 && alpha_is_one;
                *opaque
            }
        };
        if is_opaque && matches!(paint, Paint::Colors { .. } | Paint::Decal { .. }) {
            strip(draw, 3, 1);
        }
        all &= is_opaque && !matches!(draw.shape, Shape::Line { smooth: true, .. });
    }
    if all && drawing.level == 1 {
        drawing.pixels = Pixels::Opaque(units);
        for draw in &mut drawing.draws {
            if let Program::Paint(Paint::Plain(color)) = draw.program {
                draw.program = Program::Flat(blended(units, color));
            }
        }
    }
}

/// Shapes with w constant are drawn with values linear over the screen, kind of program by kind, where that gives the
/// same bytes: 32-bit steps instead of 64-bit ones, and no code for a division.
fn linear_where_equal(drawing: &mut Drawing, wanted: &[[u8; 4]]) {
    let is_affine =
        |draw: &Draw| draw.varying == Varying::Perspective && draw.shape.corners().iter().all(|c| c.inverse == ONE_W);
    let mut kinds: Vec<_> = drawing.draws.iter().filter(|d| is_affine(d)).map(kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for wanted_kind in kinds {
        let mut tried = drawing.clone();
        for draw in &mut tried.draws {
            if is_affine(draw) && kind(draw) == wanted_kind {
                draw.varying = Varying::Linear;
                for corner in draw.shape.corners_mut() {
                    corner.over_w.clone_from(&corner.values);
                }
            }
        }
        if replay(&tried).bytes == wanted {
            *drawing = tried;
        }
    }
}

/// A number for what a program is and what it carries.
fn kind(draw: &Draw) -> (u8, usize) {
    let program = match &draw.program {
        Program::Flat(_) => 0,
        Program::Surface { surface, lit, .. } => {
            let surface = match surface {
                Surface::Plain(_) => 1,
                Surface::Gouraud => 2,
                Surface::Textured(_) => 3,
                Surface::Decal(..) => 4,
            };
            surface + if lit.is_some() { 10 } else { 0 }
        }
        Program::Paint(Paint::Plain(_)) => 20,
        Program::Paint(Paint::Colors { .. }) => 21,
        Program::Paint(Paint::Texels(_)) => 22,
        Program::Paint(Paint::Decal { .. }) => 23,
        Program::Corners => 30,
        Program::Phong { .. } => 31,
    };
    (program, draw.shape.corners().first().map_or(0, |c| c.values.len()))
}

/// Drops the depth buffer where that changes nothing.
pub(super) fn depth(drawing: &mut Drawing, wanted: &[[u8; 4]]) -> Depth {
    let Some(rule) = drawing.depth.take() else {
        return Depth::Unasked;
    };
    let drawn = replay(drawing);
    if drawn.bytes != wanted {
        drawing.depth = Some(rule);
        return Depth::Needed;
    }
    let covered: u64 = drawn.work.iter().map(|work| work.covered).sum();
    // What is drawn has alpha but for a few blended samples, which then count as overlaps.
    let touched = drawn.bytes.iter().filter(|[.., alpha]| *alpha > 0).count() as u64;
    if covered == touched * u64::from(drawing.level).pow(2) {
        Depth::NoOverlap
    } else {
        Depth::InOrder
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::emit::{Requirements, emit};
    use crate::scene::{Scene, hw2, mp1};

    /// A square of two triangles, (0, 0) to (½, ½) of the picture, at some depth.
    const SQUARE: &str = "xyz -1 -1 0.5\nxyz 0 -1 0.5\nxyz 0 0 0.5\nxyz -1 0 0.5\n";

    fn requirements(text: &str) -> (Requirements, String) {
        let scene = hw2::parse(text.as_bytes(), Path::new("")).expect("a good scene");
        let emitted = emit(&Scene::Hw2(scene), "a test").expect("it fits");
        (emitted.requirements, emitted.text)
    }

    #[test]
    fn a_single_surface_needs_no_depth_and_no_varyings() {
        let (needs, text) = requirements(&format!("png 8 8 a.png\n{SQUARE}trif -1 -2 -3\ntrif -1 -3 -4\n"));
        assert_eq!(needs.depth, Depth::NoOverlap);
        assert_eq!(needs.kinds, ["triangles, flat: no varyings"]);
        assert!(!text.contains("DepthBuffer") && !text.contains("Perspective") && !text.contains("Linear"));
    }

    #[test]
    fn what_comes_later_and_nearer_needs_no_depth() {
        let near = "xyz -1 -1 0.2\nxyz 0 -1 0.2\nxyz 0 0 0.2\n";
        let far = "xyz -1 -1 0.8\nxyz 0 -1 0.8\nxyz 0 0 0.8\n";
        let draw = |color: &str, points: &str| format!("color {color}\n{points}trif -1 -2 -3\n");
        let (needs, _) = requirements(&format!("png 8 8 a.png\n{}{}", draw("1 0 0", far), draw("0 1 0", near)));
        assert_eq!(needs.depth, Depth::InOrder);
        let (needs, text) = requirements(&format!("png 8 8 a.png\n{}{}", draw("1 0 0", near), draw("0 1 0", far)));
        assert_eq!(needs.depth, Depth::Needed);
        assert!(text.contains("DepthBuffer"));
    }

    #[test]
    fn equal_colors_are_flat_and_constant_w_divides_nothing() {
        let (needs, _) = requirements(&format!("png 8 8 a.png\ncolor 1 0 0\n{SQUARE}trig -1 -2 -3\n"));
        assert_eq!(needs.kinds, ["triangles, flat: no varyings"]);
        let corners = "xyz -1 -1 0\ncolor 0 1 0\nxyz 1 -1 0\ncolor 0 0 1\nxyz 1 1 0\n";
        let (needs, text) = requirements(&format!("png 8 8 a.png\n{corners}trig 1 2 3\n"));
        assert_eq!(needs.kinds, ["triangles, Gouraud: 3 values, linear"]);
        assert!(!text.contains("Perspective"));
        let corners = "xyzw -1 -1 0 1\ncolor 0 1 0\nxyzw 2 -2 0 2\ncolor 0 0 1\nxyzw 3 3 0 3\n";
        let (_, text) = requirements(&format!("png 8 8 a.png\n{corners}trig 1 2 3\n"));
        assert!(text.contains("Perspective<3>"));
    }

    #[test]
    fn only_the_lights_there_are() {
        let lit = "normal 0 0 -1\nsunlight 0 0 -1\nsunlight 0 1 -1\n";
        let corners = "xyz -1 -1 0\nnormal 0 1 -1\nxyz 1 -1 0\nnormal 1 0 -1\nxyz 1 1 0\n";
        let (_, text) = requirements(&format!("png 8 8 a.png\n{lit}{corners}trif 1 2 3\n"));
        assert!(text.contains("Lights<i64, 2, 0>"));
        assert!(!text.contains("Polished") && !text.contains("Light::Bulb"));
        // A flat surface in the sun is of one colour.
        let (needs, text) = requirements(&format!("png 8 8 a.png\nflatnormals\n{lit}{SQUARE}trif -1 -2 -3\n"));
        assert_eq!(needs.kinds, ["triangles, flat: no varyings"]);
        assert!(!text.contains("Light"));
    }

    #[test]
    fn opaque_scenes_are_not_blended() {
        let emitted = |color: &str| {
            let text =
                format!("png 8 8 a.png\n{color}\nxyzw -1 -1 0 1\nrgb 9 9 9\nxyzw 1 -1 0 1\nxyzw 1 1 0 1\ntri 1 2 3\n");
            let scene = mp1::parse(text.into_bytes(), Path::new("")).expect("a good scene");
            emit(&Scene::Mp1(scene), "a test").expect("it fits")
        };
        let opaque = emitted("rgb 1 2 3");
        assert!(!opaque.requirements.finished);
        assert_eq!(opaque.requirements.frame, 8 * 8 * 4);
        let glass = emitted("rgba 1 2 3 0.5");
        assert!(glass.requirements.finished);
        assert_eq!(glass.requirements.frame, 8 * 8 * 16);
    }

    #[test]
    fn what_is_not_seen_is_left_out() {
        let (needs, _) = requirements("png 8 8 a.png\nxyz 2 2 0\nxyz 3 2 0\nxyz 2 3 0\ntrif 1 2 3\n");
        assert_eq!((needs.unseen, needs.data), (1, 0));
    }
}
