//! The text of a fragment program.

use super::kinds::{Form, Kind, Parameter};
use crate::emit::drawing::{Drawing, Lights, Paint, Pixels, Program, Surface, Varying};

/// A program, and the expression that makes one.
pub struct Text {
    /// The type and its implementations; nothing where the core has it.
    pub items: String,
    /// Makes one, with `look` and `lights` at hand where they are needed.
    pub made: String,
}

/// The type of a kind's varying.
pub fn varying(kind: &Kind) -> String {
    match kind.varying {
        Varying::Nothing => "()".into(),
        Varying::Linear => format!("Linear<{}>", kind.values),
        Varying::Perspective => format!("Perspective<{}>", kind.values),
    }
}

/// The type of a set of lights at some scale.
pub fn lit(drawing: &Drawing, set: usize) -> String {
    match &drawing.lights[set] {
        Lights::Eye(lights) => format!("Lit<'a, {}>", super::lights::bulbs(lights)),
        Lights::World(_, lights) => format!("PointLit<{}>", lights.len()),
    }
}

/// How a parameter is written in the code: its value, or where it stands.
fn reference(kind: &Kind, name: &str, look: &str) -> String {
    let parameter = |p: &&Parameter| p.name == name;
    match kind.parameters.iter().find(parameter) {
        Some(Parameter {
            constant: Some(value), ..
        }) => value.clone(),
        _ => format!("{look}.{name}"),
    }
}

/// The kind's program.
pub fn text(drawing: &Drawing, kind: &Kind) -> Text {
    if let Program::Flat(_) = kind.program {
        return Text {
            items: String::new(),
            made: format!("Flat({})", reference(kind, "color", "look")),
        };
    }
    let (values, body, tail) = body(drawing, kind);
    let values = match values.as_slice() {
        [] => "(): ()".to_owned(),
        names => format!("[{}]: [i32; {}]", names.join(", "), names.len()),
    };
    let has_look = body.contains("self.look") || tail.contains("self.look");
    let (fields, made) = fields(drawing, kind, has_look);
    let name = &kind.name;
    let life = if fields.contains("'a") { "<'a>" } else { "" };
    let hidden = if life.is_empty() { "" } else { "<'_>" };
    let mut items = if fields.is_empty() {
        format!("struct {name};\n\n")
    } else {
        format!("struct {name}{life} {{\n{fields}}}\n\n")
    };
    let below = if tail.contains("below") { "below" } else { "_below" };
    let varying = varying(kind);
    if kind.form == Form::SmoothLine {
        items += &smooth(name, hidden, &varying, &values, &body);
    } else {
        items += &format!(
            "impl Fragment for {name}{hidden} {{
    type Varying = {varying};
    type Pixel = Pixel;

    #[inline]
{}{body}        Some({tail})
    }}
}}

",
            signature("shade", &values, &format!("{below}: Pixel"))
        );
    }
    Text { items, made }
}

/// A program that colours parts of pixels too.
fn smooth(name: &str, hidden: &str, varying: &str, values: &str, body: &str) -> String {
    let (names, of) = values.split_once(": ").unwrap_or((values, ""));
    format!(
        "impl {name}{hidden} {{
    #[inline]
    fn color(&self, {names}: {of}) -> Rgba {{
{body}        color
    }}
}}

impl Fragment for {name}{hidden} {{
    type Varying = {varying};
    type Pixel = Pixel;

    #[inline]
    fn shade(&self, values: {of}, below: Pixel) -> Option<Pixel> {{
        Some(self.color(values).over(below))
    }}
}}

impl Antialiased for {name}{hidden} {{
    #[inline]
    fn shade_part(&self, values: {of}, part: i32, below: Pixel) -> Option<Pixel> {{
        Some(self.color(values).faded(part).over(below))
    }}
}}

"
    )
}

fn signature(name: &str, values: &str, below: &str) -> String {
    let short = format!("    fn {name}(&self, {values}, {below}) -> Option<Pixel> {{\n");
    if short.len() <= 101 {
        return short;
    }
    format!("    fn {name}(\n        &self,\n        {values},\n        {below},\n    ) -> Option<Pixel> {{\n")
}

/// Fields of the type, and what makes one. The look may be of use to the lights alone.
fn fields(drawing: &Drawing, kind: &Kind, has_look: bool) -> (String, String) {
    let (mut fields, mut made) = (String::new(), Vec::new());
    if let Some(set) = kind.lights {
        fields += &format!("    lights: &'a {},\n", lit(drawing, set));
        made.push("lights: &lights");
    }
    if has_look {
        fields += &format!("    look: &'static {}Look,\n", kind.name);
        made.push("look");
    }
    if made.is_empty() {
        return (fields, kind.name.clone());
    }
    // As rustfmt lays it out: on one line up to 18 characters.
    let short = made.join(", ");
    let made = if short.len() <= 18 {
        format!("{} {{ {short} }}", kind.name)
    } else {
        let made: String = made.iter().map(|field| format!("            {field},\n")).collect();
        format!("{} {{\n{made}        }}", kind.name)
    };
    (fields, made)
}

/// Names of values, statements, and the pixel.
fn body(drawing: &Drawing, kind: &Kind) -> (Vec<&'static str>, String, String) {
    let of = |name| reference(kind, name, "self.look");
    match &kind.program {
        Program::Flat(_) => (Vec::new(), String::new(), String::new()),
        Program::Surface { surface, lit, .. } => {
            let (mut values, color) = match surface {
                Surface::Plain(_) => (vec![], of("color")),
                Surface::Gouraud => (vec!["r", "g", "b"], "[r, g, b]".to_owned()),
                Surface::Textured(_) => (vec!["s", "t"], "texel.channels(0)".into()),
                Surface::Decal(..) => (
                    vec!["r", "g", "b", "s", "t"],
                    format!("texel.over([r, g, b], {})", of("below")),
                ),
            };
            let mut body = match surface {
                Surface::Textured(_) | Surface::Decal(..) => sampled(&of("texture")),
                Surface::Plain(_) | Surface::Gouraud => String::new(),
            };
            body += &statement("color", &color);
            let Some(lit) = lit else {
                return (values, body, format!("levels(color, {})", of("shift")));
            };
            let mut vector = |own: Option<String>, names: [&'static str; 3]| {
                own.unwrap_or_else(|| {
                    values.extend(names);
                    format!("[{}]", names.join(", "))
                })
            };
            let normal = vector(lit.normal.map(|_| of("normal")), ["nx", "ny", "nz"]);
            let place = vector((!lit.places).then(|| "[0; 3]".into()), ["x", "y", "z"]);
            body += &statement("normal", &normal);
            body += &statement("place", &place);
            let finish = match lit.shiny {
                Some(_) => of("finish"),
                None => "Matte".into(),
            };
            body += &statement("finish", &finish);
            body += "        let color = self.lights.shade_wide(normal, place, color, &finish);\n";
            (values, body, format!("wide_levels(color, {})", of("shift")))
        }
        Program::Paint(paint) => painted(drawing, kind, paint),
        Program::Corners => {
            let body = "        let color = [r, g, b].map(|c| c >> 2);\n".into();
            (vec!["r", "g", "b"], body, "bytes(color)".into())
        }
        Program::Phong { .. } => {
            let mut body = statement("material", &of("material"));
            body += "        let color = self.lights.shade([nx, ny, nz], [x, y, z], &material);\n";
            (vec!["x", "y", "z", "nx", "ny", "nz"], body, "bytes(color)".into())
        }
    }
}

fn painted(drawing: &Drawing, kind: &Kind, paint: &Paint) -> (Vec<&'static str>, String, String) {
    let of = |name| reference(kind, name, "self.look");
    let texel = |name| sampled(&of("texture")) + &statement(name, "Rgba::from_texel(texel, SHIFT)");
    let corners = |opaque: bool| {
        if opaque {
            return "Rgba { color: [r, g, b], alpha: fixel::blend::ONE }".to_owned();
        }
        match of("headroom").as_str() {
            "0" => "Rgba { color: [r, g, b], alpha }".to_owned(),
            headroom => format!("fine([r, g, b, alpha], {headroom})"),
        }
    };
    let (values, body, is_opaque) = match paint {
        Paint::Plain(color) => (
            vec![],
            statement("color", &of("color")),
            color.alpha == fixel::blend::ONE,
        ),
        Paint::Colors { opaque: true, .. } => (vec!["r", "g", "b"], statement("color", &corners(true)), true),
        Paint::Colors { .. } => (vec!["r", "g", "b", "alpha"], statement("color", &corners(false)), false),
        Paint::Texels(_) => (vec!["s", "t"], texel("color"), false),
        Paint::Decal { opaque, .. } => {
            let mut values = vec!["r", "g", "b", "alpha", "s", "t"];
            values.retain(|name| !opaque || *name != "alpha");
            let body = statement("corners", &corners(*opaque)) + &texel("texel");
            (values, body + "        let color = texel.over(corners);\n", *opaque)
        }
    };
    // A plain colour's alpha may differ between looks.
    let is_opaque = is_opaque && !matches!(paint, Paint::Plain(_));
    let tail = match drawing.pixels {
        Pixels::Opaque(_) | Pixels::Bytes => "bytes(color.color)",
        Pixels::Blended(_) if is_opaque => "color",
        Pixels::Blended(_) => "color.over(below)",
    };
    (values, body, tail.into())
}

/// A texel at (s, t).
fn sampled(texture: &str) -> String {
    statement("texture", texture) + &statement("texel", "texture.texel([s, t])")
}

/// `let name = value;`.
fn statement(name: &str, value: &str) -> String {
    format!("        let {name} = {};\n", literal(value, "        "))
}

/// A value, a structure over several lines where it is long, those within it as well; `indent` is its line's.
fn literal(value: &str, indent: &str) -> String {
    let fields = value
        .split_once(" { ")
        .and_then(|(of, fields)| Some((of, fields.strip_suffix(" }")?)));
    let Some((of, fields)) = fields.filter(|_| value.len() > 18) else {
        return value.to_owned();
    };
    let inner = format!("{indent}    ");
    let mut text = format!("{of} {{\n");
    for field in split_fields(fields) {
        let field = match field.split_once(": ") {
            Some((name, value)) => format!("{name}: {}", literal(value, &inner)),
            None => field,
        };
        text += &format!("{inner}{field},\n");
    }
    text + indent + "}"
}

/// The fields of a structure, without those within its fields.
fn split_fields(fields: &str) -> Vec<String> {
    let (mut depth, mut all, mut field) = (0, Vec::new(), String::new());
    for c in fields.chars() {
        depth += match c {
            '[' | '{' | '(' => 1,
            ']' | '}' | ')' => -1,
            _ => 0,
        };
        if c == ',' && depth == 0 {
            all.push(field.trim().to_owned());
            field.clear();
        } else {
            field.push(c);
        }
    }
    all.push(field.trim().to_owned());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_structures_take_lines_at_every_depth() {
        assert_eq!(statement("a", "B { c: 1 }"), "        let a = B { c: 1 };\n");
        assert_eq!(
            statement("a", "Outer { first: [1, 2], inner: Inner { x: [100, 200], y: 300 } }"),
            "        let a = Outer {
            first: [1, 2],
            inner: Inner {
                x: [100, 200],
                y: 300,
            },
        };
"
        );
    }
}
