//! The functions that draw a kind's shapes.

use std::fmt::Write;

use super::kinds::{Form, Kind};
use super::{Sorted, program};
use crate::emit::drawing::{Lights, Varying};

/// Characters of calls behind each other that rustfmt leaves on one line.
const LONGEST_CHAIN: usize = 60;

/// The text of convex polygons, and of lines that need 64-bit words.
pub const POLYGON: &str = "/// A convex polygon, or a line: positions in 1/256 px, depths in 2^-15 step, values.
struct Polygon<V, const N: usize> {
    first: Place<V>,
    corners: [Place<V>; N],
    count: usize,
}

type Place<V> = ((i32, i32), i32, V);

impl<V: Copy, const N: usize> Polygon<V, N> {
    fn new(first: Place<V>, rest: impl Iterator<Item = Place<V>>) -> Self {
        let mut polygon = Polygon {
            first,
            corners: [first; N],
            count: 1,
        };
        for (corner, place) in polygon.corners.iter_mut().skip(1).zip(rest) {
            *corner = place;
            polygon.count += 1;
        }
        polygon
    }

    #[inline]
    fn at(&self, index: usize) -> &Place<V> {
        self.corners.get(index).unwrap_or(&self.first)
    }
}

impl<V: Copy, const N: usize> span::Corners for Polygon<V, N> {
    #[inline]
    fn count(&self) -> usize {
        self.count
    }

    #[inline]
    fn position(&self, index: usize) -> (i32, i32) {
        self.at(index).0
    }
}

impl<V: Varying, const N: usize> Shape for Polygon<V, N> {
    type Varying = V;

    #[inline]
    fn depth(&self, index: usize) -> i32 {
        self.at(index).1
    }

    #[inline]
    fn varying(&self, index: usize) -> V {
        self.at(index).2
    }
}

";

/// The text that makes corners of numbers.
pub const CORNER: &str = "/// A corner: position in 1/256 px, depth in 2^-15 step, values.
#[inline]
fn corner<V>(x: i32, y: i32, depth: i32, varying: V) -> Corner<V> {
    Corner {
        position: Position::nearest(SubPx::from_bits(x), SubPx::from_bits(y)),
        depth: FineDepth::from_bits(depth as u32),
        varying,
    }
}

";

/// The row of a kind's table of corners: its type, its pattern and the varying made of it.
pub fn row(sorted: &Sorted<'_>, kind: &Kind) -> (String, String, String) {
    let (mut of, mut pattern) = (vec!["i32".to_owned(), "i32".into()], vec!["x", "y"]);
    if sorted.drawing.depth.is_some() {
        of.push("i32".into());
        pattern.push("depth");
    }
    let numbers = format!("[i32; {}]", kind.values);
    let varying = match kind.varying {
        Varying::Nothing => "()".into(),
        Varying::Linear => {
            of.push(numbers);
            pattern.push("values");
            "Linear(values)".into()
        }
        Varying::Perspective => {
            of.extend(["i32".into(), numbers.clone()]);
            pattern.extend(["inverse", "values"]);
            if kind.stores_over_w() {
                of.push(numbers);
                pattern.push("over_w");
                "Perspective {\n        over_w,\n        inverse,\n        values,\n    }".into()
            } else {
                "Perspective::new(values, inverse)".into()
            }
        }
    };
    (
        format!("({})", of.join(", ")),
        format!("({})", pattern.join(", ")),
        varying,
    )
}

/// The type of the kind's indices.
pub fn index(kind: &Kind) -> &'static str {
    if kind.corners.len().max(kind.looks.len()) < usize::from(u16::MAX) {
        "u16"
    } else {
        "u32"
    }
}

/// The functions that fetch a corner and draw a table of faces.
pub fn push(sorted: &Sorted<'_>, kind: &Kind, made: &str, code: &mut String) {
    let (snake, index) = (kind.snake(), index(kind));
    let depth = sorted.drawing.depth.is_some();
    push_corner(sorted, kind, code);
    let parameters = if depth {
        vec![
            "color: &mut C".to_owned(),
            "depth: &mut D".into(),
            format!("faces: &[{index}]"),
        ]
    } else {
        vec!["color: &mut C".to_owned(), format!("faces: &[{index}]")]
    };
    let generics = if depth {
        "C: Target<Pixel = Pixel>, D: Depth"
    } else {
        "C: Target<Pixel = Pixel>"
    };
    let _ = writeln!(code, "/// Of each face {}.", contents(sorted, kind));
    let short = format!("fn {snake}<{generics}>({}) {{\n", parameters.join(", "));
    if short.len() <= 101 {
        *code += &short;
    } else {
        let _ = writeln!(
            code,
            "fn {snake}<{generics}>(\n    {},\n) {{",
            parameters.join(",\n    ")
        );
    }
    push_lights(sorted, kind, code, false);
    push_loop(sorted, kind, code);
    push_look(kind, code);
    push_lights(sorted, kind, code, true);
    push_shape(sorted, kind, made, code);
    *code += "    }\n}\n\n";
}

fn contents(sorted: &Sorted<'_>, kind: &Kind) -> &'static str {
    let around_point = matches!(kind.form, Form::Square | Form::Disc | Form::Billboard);
    match (kind.has_looks(), around_point, sorted.is_general(kind)) {
        (true, true, _) => "the look and the centre",
        (false, true, _) => "the centre",
        (true, _, true) => "the look and the corners, up to the largest number",
        (false, _, true) => "the corners, up to the largest number",
        (true, ..) => "the look and the corners",
        (false, ..) => "the corners",
    }
}

fn push_corner(sorted: &Sorted<'_>, kind: &Kind, code: &mut String) {
    if matches!(kind.form, Form::Square | Form::Disc | Form::Billboard) {
        return;
    }
    let (snake, upper, index) = (kind.snake(), kind.upper(), index(kind));
    let (_, pattern, varying) = row(sorted, kind);
    let of = program::varying(kind);
    let depth = if sorted.drawing.depth.is_some() { "depth" } else { "0" };
    let (returned, made) = if sorted.is_general(kind) {
        (format!("Place<{of}>"), format!("((x, y), {depth}, varying)"))
    } else {
        (format!("Corner<{of}>"), format!("corner(x, y, {depth}, varying)"))
    };
    let _ = write!(
        code,
        "#[inline]
fn {snake}_corner(index: {index}) -> {returned} {{
    let row = {upper}_CORNERS.get(index as usize);
    let {pattern} = row.copied().unwrap_or_default();
"
    );
    if varying == "()" {
        let _ = write!(code, "    {}\n}}\n\n", made.replace("varying", "()"));
    } else {
        let _ = write!(code, "    let varying = {varying};\n    {made}\n}}\n\n");
    }
}

/// Lights at their scale: before the faces, or for each where its scale is its own.
fn push_lights(sorted: &Sorted<'_>, kind: &Kind, code: &mut String, within: bool) {
    let Some(set) = kind.lights else {
        return;
    };
    let unit = kind.parameters.iter().find(|p| p.name == "unit").map(|p| &p.constant);
    let scale = match unit {
        None => "0",
        Some(Some(value)) => value,
        Some(None) => "look.unit",
    };
    let is_own = scale == "look.unit";
    let all = match &sorted.drawing.lights[set] {
        Lights::Eye(_) | Lights::World(..) => format!("lights_{set}()"),
    };
    match (within, is_own) {
        (false, true) => {
            let _ = writeln!(code, "    let all = {all};");
        }
        (false, false) => {
            let _ = writeln!(code, "    let all = {all};\n    let lights = all.at_scale({scale});");
        }
        (true, true) => *code += "        let lights = all.at_scale(look.unit);\n",
        (true, false) => {}
    }
}

const NAMES: [&str; 3] = ["a", "b", "c"];

/// The names of a face's corners.
fn names(kind: &Kind) -> &'static [&'static str] {
    match kind.form {
        Form::Polygon => &NAMES,
        Form::Line | Form::SmoothLine => &NAMES[..2],
        Form::Square | Form::Disc | Form::Billboard => &["center"],
    }
}

fn push_loop(sorted: &Sorted<'_>, kind: &Kind, code: &mut String) {
    if sorted.is_general(kind) {
        let end = index(kind);
        let _ = writeln!(code, "    for face in faces.split(|&index| index == {end}::MAX) {{");
        let heads = if kind.has_looks() {
            "&look, &first, ref rest @ .."
        } else {
            "&first, ref rest @ .."
        };
        let _ = write!(
            code,
            "        let &[{}] = face else {{\n            continue;\n        }};\n",
            heads.replace('&', "")
        );
        return;
    }
    let mut all: Vec<&str> = Vec::new();
    all.extend(kind.has_looks().then_some("look"));
    all.extend(names(kind));
    let count = all.len();
    let _ = writeln!(
        code,
        "    for &[{}] in faces.as_chunks::<{count}>().0 {{",
        all.join(", ")
    );
}

fn push_look(kind: &Kind, code: &mut String) {
    if kind.has_looks() {
        let _ = write!(
            code,
            "        let Some(look) = {}_LOOKS.get(look as usize) else {{
            continue;
        }};
",
            kind.upper()
        );
    }
}

fn push_shape(sorted: &Sorted<'_>, kind: &Kind, made: &str, code: &mut String) {
    let snake = kind.snake();
    let depth = if sorted.drawing.depth.is_some() {
        "depth"
    } else {
        "&mut NoDepth"
    };
    let _ = writeln!(code, "        let program = {made};");
    if sorted.is_general(kind) {
        let word = if sorted.drawing.wide { "i64" } else { "i32" };
        let most = kind.most_corners;
        let made = format!(".map(|&index| {snake}_corner(index))");
        let chain = match "rest.iter()".len() + made.len() {
            ..=LONGEST_CHAIN => format!("rest.iter(){made}"),
            _ => format!("rest\n            .iter()\n            {made}"),
        };
        let _ = write!(
            code,
            "        let rest = {chain};
        let polygon = Polygon::<_, {most}>::new({snake}_corner(first), rest);
"
        );
        match kind.form {
            Form::Line => {
                let _ = writeln!(
                    code,
                    "        draw::stroke::<{word}, _, _, _, _>(color, {depth}, &polygon, &program);"
                );
            }
            Form::SmoothLine => {
                let _ = writeln!(
                    code,
                    "        draw::wu_stroke::<{word}, _, _, _, _>(color, {depth}, &polygon, &program);"
                );
            }
            _ => {
                let _ = write!(
                    code,
                    "        let area = span::doubled_area(&polygon);
        draw::polygon::<{word}, _, _, _, _>(color, {depth}, &polygon, area, &program);
"
                );
            }
        }
        return;
    }
    let names = names(kind).join(", ");
    let of_corners = |function: &str| {
        format!(
            "        let corners = [{names}].map({snake}_corner);
        draw::{function}(color, {depth}, corners, &program);
"
        )
    };
    let center_depth = if sorted.drawing.depth.is_some() { "z" } else { "0" };
    let fetched = |pattern: &str| {
        let pattern = if sorted.drawing.depth.is_some() {
            pattern.to_owned()
        } else {
            pattern.replace("z, ", "")
        };
        format!(
            "        let row = {}_CENTERS.get(center as usize);
        let ({pattern}) = row.copied().unwrap_or_default();
        let center = Center {{
            x: SubPx::from_bits(x),
            y: SubPx::from_bits(y),
            depth: FineDepth::from_bits({center_depth}),
        }};
        let size = SubPx::from_bits(size);
",
            kind.upper()
        )
    };
    *code += &match kind.form {
        Form::Polygon => of_corners("triangle"),
        Form::Line => of_corners("segment"),
        Form::SmoothLine => of_corners("wu_line"),
        Form::Square => {
            fetched("x, y, z, size")
                + "        let square = Square::new(center, size, ());\n"
                + &format!("        draw::square(color, {depth}, &square, &program);\n")
        }
        Form::Disc => {
            fetched("x, y, z, size")
                + "        let disc = Disc::new(center, size, ());\n"
                + &format!("        draw::disc(color, {depth}, &disc, &program);\n")
        }
        Form::Billboard => {
            fetched("x, y, z, size, far")
                + "        let square = Square::billboard(center, size, [0; 2], far);\n"
                + &format!("        draw::square(color, {depth}, &square, &program);\n")
        }
    };
}
