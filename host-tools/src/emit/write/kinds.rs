//! Draws sorted by the code that they need.

use std::collections::HashMap;
use std::fmt::Write;

use fixel::light::world::{Glossy, Material};

use super::Palettes;
use crate::emit::drawing::{
    Corner, Draw, Drawing, Lights, Lit, Paint, Pixels, Program, Sampled, Shape, Surface, Varying,
};

/// Draws that one function draws.
#[derive(Debug, Clone)]
pub struct Kind {
    /// In camel case; unique.
    pub name: String,
    /// How values run.
    pub varying: Varying,
    /// How many there are.
    pub values: usize,
    /// What is covered.
    pub form: Form,
    /// The most corners of a polygon.
    pub most_corners: usize,
    /// The lights it needs.
    pub lights: Option<usize>,
    /// What the program is, by an example.
    pub program: Program,
    /// What the looks are made of: name, type, and whether it differs between looks.
    pub parameters: Vec<Parameter>,
    /// Different corners, or centers, in the order of their first use.
    pub corners: Vec<Place>,
    /// Values of the parameters, as Rust.
    pub looks: Vec<Vec<String>>,
}

/// A number of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its type.
    pub of: String,
    /// The one value that it has, as Rust.
    pub constant: Option<String>,
}

/// What a draw covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A polygon.
    Polygon,
    /// A plain line.
    Line,
    /// An antialiased line.
    SmoothLine,
    /// A square.
    Square,
    /// A disc.
    Disc,
    /// A square with a texture.
    Billboard,
}

/// A row of a kind's table of corners.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Place {
    /// A polygon's or a line's.
    Corner(Corner),
    /// x, y, depth, size.
    Center([i32; 4]),
    /// x, y, depth, size, and the texture coordinates of the far corner.
    Billboard([i32; 6]),
}

/// Consecutive draws of one kind.
#[derive(Debug, Clone)]
pub struct Batch {
    /// Number of the kind.
    pub kind: usize,
    /// The draws: a look and corners each.
    pub draws: Vec<(usize, Vec<usize>)>,
}

/// Sorts the draws.
pub fn sort(drawing: &Drawing, palettes: &Palettes) -> (Vec<Kind>, Vec<Batch>) {
    let mut kinds: Vec<Kind> = Vec::new();
    let mut places: Vec<HashMap<Place, usize>> = Vec::new();
    let mut looks: Vec<HashMap<Vec<String>, usize>> = Vec::new();
    let mut batches: Vec<Batch> = Vec::new();
    for draw in &drawing.draws {
        let name = name(drawing, draw, palettes);
        let found = kinds.iter().position(|kind| kind.name == name);
        let number = found.unwrap_or_else(|| {
            kinds.push(Kind::new(name, drawing, draw, palettes));
            places.push(HashMap::new());
            looks.push(HashMap::new());
            kinds.len() - 1
        });
        let kind = &mut kinds[number];
        let mut numbers = Vec::new();
        for place in rows(&draw.shape) {
            let next = kind.corners.len();
            let row = *places[number].entry(place.clone()).or_insert(next);
            if row == next {
                kind.corners.push(place);
            }
            numbers.push(row);
        }
        kind.most_corners = kind.most_corners.max(numbers.len());
        let look: Vec<String> = parameters(drawing, draw, palettes).into_iter().map(|p| p.2).collect();
        let next = kind.looks.len();
        let row = *looks[number].entry(look.clone()).or_insert(next);
        if row == next {
            kind.looks.push(look);
        }
        match batches.last_mut() {
            Some(batch) if batch.kind == number => batch.draws.push((row, numbers)),
            _ => batches.push(Batch {
                kind: number,
                draws: vec![(row, numbers)],
            }),
        }
    }
    kinds.iter_mut().for_each(Kind::find_constants);
    (kinds, batches)
}

impl Kind {
    fn new(name: String, drawing: &Drawing, draw: &Draw, palettes: &Palettes) -> Self {
        let parameter = |(name, of, _)| Parameter {
            name,
            of,
            constant: None,
        };
        let values = match &draw.shape {
            Shape::Polygon(corners) | Shape::Line { ends: corners, .. } => {
                corners.first().map_or(0, |corner| corner.values.len())
            }
            Shape::Point { .. } => 0,
            Shape::Billboard { .. } => 2,
        };
        Kind {
            name,
            varying: draw.varying,
            values,
            form: form(&draw.shape),
            most_corners: 0,
            lights: lights(&draw.program),
            program: draw.program.clone(),
            parameters: parameters(drawing, draw, palettes).into_iter().map(parameter).collect(),
            corners: Vec::new(),
            looks: Vec::new(),
        }
    }

    /// Parameters with one value go into the code.
    fn find_constants(&mut self) {
        for (i, parameter) in self.parameters.iter_mut().enumerate() {
            let first = self.looks.first().map(|look| look[i].clone());
            if self.looks.iter().all(|look| Some(&look[i]) == first.as_ref()) {
                parameter.constant = first;
            }
        }
        if !self.has_looks() {
            self.looks.truncate(1);
        }
    }

    /// Whether its draws differ in more than their corners.
    pub fn has_looks(&self) -> bool {
        self.parameters.iter().any(|p| p.constant.is_none())
    }

    /// In snake case.
    pub fn snake(&self) -> String {
        let mut snake = String::new();
        for c in self.name.chars() {
            if c.is_ascii_uppercase() && !snake.is_empty() {
                snake.push('_');
            }
            snake.push(c.to_ascii_lowercase());
        }
        snake
    }

    /// In upper case.
    pub fn upper(&self) -> String {
        self.snake().to_ascii_uppercase()
    }

    /// Whether 1/w and values do not give the values over w.
    pub fn stores_over_w(&self) -> bool {
        let differs = |place: &Place| match place {
            Place::Corner(corner) => !corner.values.iter().zip(&corner.over_w).all(|(v, over_w)| {
                let product = i64::from(*v) * i64::from(corner.inverse) + (1 << 29);
                (product >> 30) as i32 == *over_w
            }),
            _ => false,
        };
        self.varying == Varying::Perspective && self.corners.iter().any(differs)
    }

    /// Whether all corners have the same w.
    pub fn has_one_w(&self) -> bool {
        let inverse = |place: &Place| match place {
            Place::Corner(corner) => Some(corner.inverse),
            _ => None,
        };
        let mut inverses = self.corners.iter().map(inverse);
        let first = inverses.next();
        inverses.all(|inverse| Some(inverse) == first)
    }
}

fn form(shape: &Shape) -> Form {
    match shape {
        Shape::Polygon(_) => Form::Polygon,
        Shape::Line { smooth: false, .. } => Form::Line,
        Shape::Line { smooth: true, .. } => Form::SmoothLine,
        Shape::Point { round: false, .. } => Form::Square,
        Shape::Point { round: true, .. } => Form::Disc,
        Shape::Billboard { .. } => Form::Billboard,
    }
}

fn rows(shape: &Shape) -> Vec<Place> {
    match shape {
        Shape::Polygon(corners) | Shape::Line { ends: corners, .. } => {
            corners.iter().cloned().map(Place::Corner).collect()
        }
        Shape::Point { center, size, .. } => vec![Place::Center([
            center.x.to_bits(),
            center.y.to_bits(),
            center.depth.to_bits() as i32,
            size.to_bits(),
        ])],
        Shape::Billboard {
            center,
            size,
            far: [s, t],
        } => vec![Place::Billboard([
            center.x.to_bits(),
            center.y.to_bits(),
            center.depth.to_bits() as i32,
            size.to_bits(),
            *s,
            *t,
        ])],
    }
}

fn lights(program: &Program) -> Option<usize> {
    match program {
        Program::Surface { lit: Some(lit), .. } => Some(lit.lights),
        Program::Phong { lights, .. } => Some(*lights),
        _ => None,
    }
}

/// What its code is called: draws of one name share it.
fn name(drawing: &Drawing, draw: &Draw, palettes: &Palettes) -> String {
    let mut name = String::new();
    let mut push = |part: &str| name.push_str(part);
    let indexed = |sampled: &Sampled| {
        if palettes.of(sampled.texture).is_some() {
            "Indexed"
        } else {
            ""
        }
    };
    let set = |lights: usize| match drawing.lights.len() {
        1 => String::new(),
        _ => lights.to_string(),
    };
    match &draw.program {
        Program::Flat(_) => push("Plain"),
        Program::Surface { surface, lit, .. } => {
            match surface {
                Surface::Plain(_) => push("Even"),
                Surface::Gouraud => push("Gouraud"),
                Surface::Textured(sampled) => push(&format!("Textured{}", indexed(sampled))),
                Surface::Decal(sampled, _) => push(&format!("Decal{}", indexed(sampled))),
            }
            if let Some(lit) = lit {
                push(if lit.shiny.is_some() { "Shiny" } else { "Matte" });
                push(if lit.normal.is_some() { "Facet" } else { "" });
                push(&set(lit.lights));
            }
        }
        Program::Paint(paint) => match paint {
            Paint::Plain(_) => push("Tint"),
            Paint::Colors { opaque, .. } => push(if *opaque { "Gouraud" } else { "Glass" }),
            Paint::Texels(sampled) => push(&format!("Textured{}", indexed(sampled))),
            Paint::Decal { sampled, opaque, .. } => {
                push(if *opaque { "Decal" } else { "GlassDecal" });
                push(indexed(sampled));
            }
        },
        Program::Corners => push("Gouraud"),
        Program::Phong { lights, shines, .. } => {
            push(if *shines { "PhongShiny" } else { "PhongMatte" });
            push(&set(*lights));
        }
    }
    match form(&draw.shape) {
        Form::Polygon => {}
        Form::Line => push("Line"),
        Form::SmoothLine => push("SmoothLine"),
        Form::Square => push("Square"),
        Form::Disc => push("Disc"),
        Form::Billboard => push("Billboard"),
    }
    if draw.varying == Varying::Perspective {
        push("InPerspective");
    }
    name
}

/// Name, type and value of all that a program may vary in.
fn parameters(drawing: &Drawing, draw: &Draw, palettes: &Palettes) -> Vec<(&'static str, String, String)> {
    let mut all = Vec::new();
    let texture = |sampled: &Sampled, rounding: &str| {
        let of = match palettes.of(sampled.texture) {
            Some(_) => "Palette<'static>",
            None => "Rgba8888",
        };
        let value = format!(
            "Nearest::<_, {rounding}>::new(TEXTURE_{}, {})",
            sampled.texture, sampled.fraction_bits
        );
        ("texture", format!("Nearest<'static, {of}, {rounding}>"), value)
    };
    let unit = |lights: usize, exponent: i32| match &drawing.lights[lights] {
        Lights::Eye(lights) if lights.iter().all(|l| matches!(l, fixel::light::Light::Sun { .. })) => None,
        _ => Some(("unit", "i32".to_owned(), exponent.to_string())),
    };
    match &draw.program {
        Program::Flat(bytes) => all.push(("color", "Pixel".into(), format!("{bytes:?}"))),
        Program::Surface { surface, shift, lit } => {
            match surface {
                Surface::Plain(color) => all.push(("color", "[i32; 3]".into(), format!("{color:?}"))),
                Surface::Gouraud => {}
                Surface::Textured(sampled) => all.push(texture(sampled, "Floor")),
                Surface::Decal(sampled, shift) => {
                    all.push(texture(sampled, "Floor"));
                    all.push(("below", "u32".into(), shift.to_string()));
                }
            }
            if let Some(Lit {
                lights,
                exponent,
                normal,
                shiny,
                ..
            }) = lit
            {
                all.extend(normal.map(|n| ("normal", "[i32; 3]".into(), format!("{n:?}"))));
                all.extend(unit(*lights, *exponent));
                all.extend(shiny.map(|(exponent, highlight)| {
                    let value = format!("Polished {{ exponent: {exponent}, highlight: {highlight} }}");
                    ("finish", "Polished".into(), value)
                }));
            }
            all.push(("shift", "i32".into(), shift.to_string()));
        }
        Program::Paint(paint) => match paint {
            Paint::Plain(color) => {
                let value = format!("Rgba {{ color: {:?}, alpha: {} }}", color.color, color.alpha);
                all.push(("color", "Rgba".into(), value));
            }
            Paint::Colors { headroom, opaque } => {
                all.extend((!opaque).then(|| ("headroom", "u32".into(), headroom.to_string())));
            }
            Paint::Texels(sampled) => all.push(texture(sampled, "TowardsZero")),
            Paint::Decal {
                sampled,
                headroom,
                opaque,
            } => {
                all.push(texture(sampled, "TowardsZero"));
                all.extend((!opaque).then(|| ("headroom", "u32".into(), headroom.to_string())));
            }
        },
        Program::Corners => {}
        Program::Phong {
            lights,
            exponent,
            material,
            shines,
        } => {
            all.extend(unit(*lights, *exponent));
            let of = if *shines {
                "Material<Glossy>"
            } else {
                "Material<fixel::light::Matte>"
            };
            all.push(("material", of.into(), literal(material, *shines)));
        }
    }
    debug_assert!(drawing.pixels != Pixels::Bytes || !matches!(draw.program, Program::Paint(_)));
    all
}

fn literal(material: &Material<Glossy>, shines: bool) -> String {
    let Material {
        ambient,
        diffuse,
        specular: Glossy { color, shininess },
    } = material;
    let mut text = format!("Material {{ ambient: {ambient:?}, diffuse: {diffuse:?}, specular: ");
    if shines {
        let _ = write!(text, "Glossy {{ color: {color:?}, shininess: {shininess} }} }}");
    } else {
        text.push_str("fixel::light::Matte }");
    }
    text
}
