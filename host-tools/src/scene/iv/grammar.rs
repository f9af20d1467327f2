//! The grammar of the Inventor subset: which block takes which fields, and what must hold of them.
//!
//! A fault is reported as soon as it shows: of words and of a list by itself at once, of values when their block ends,
//! since a field may be given again and the last counts, of indices as soon as what they point at is known. So it is the
//! first one of the text wherever one can be called first.

use super::check::{CameraFields, MaterialFields, TransformFields, first};
use super::faces::{self, Indices, Of};
use super::parser::{Parser, quoted, unexpected};
use super::{Camera, Light, MOST_LIGHTS, Model, Object};
use crate::scene::lex::Token;
use crate::scene::{Fault, Place};

/// Parses a model.
///
/// # Errors
/// The first fault of the text. Of a text without a camera it is [of the whole](Fault::whole).
pub fn parse(text: impl AsRef<[u8]>) -> Result<Model, Fault> {
    let parser = &mut Parser::new(text.as_ref());
    let mut camera = None;
    let mut lights = Vec::new();
    let mut objects = Vec::new();
    while let Some(token) = parser.next()? {
        match token.text {
            "PerspectiveCamera" if camera.is_some() => {
                return Err(Fault::new(token.place, "a second PerspectiveCamera"));
            }
            "PerspectiveCamera" => camera = Some(read_camera(parser)?),
            "PointLight" if lights.len() == MOST_LIGHTS => {
                return Err(Fault::new(token.place, format!("more than {MOST_LIGHTS} lights")));
            }
            "PointLight" => lights.push(read_light(parser)?),
            "Separator" => objects.push(read_separator(parser)?),
            "{" | "}" | "[" | "]" | "," => return Err(unexpected(token, "a block")),
            _ => {
                let message = format!("unknown block {}", quoted(token));
                return Err(Fault::new(token.place, message));
            }
        }
    }
    Ok(Model {
        camera: camera.ok_or_else(|| Fault::of_whole("no PerspectiveCamera"))?,
        lights,
        objects,
    })
}

fn read_camera(parser: &mut Parser<'_>) -> Result<Camera, Fault> {
    let mut camera = CameraFields::new();
    parser.block("field", "PerspectiveCamera", |parser, token| {
        match token.text {
            "position" => camera.position.set(parser.numbers()?),
            "orientation" => camera.orientation.set(parser.numbers()?),
            "nearDistance" => camera.near.set(parser.numbers()?),
            "farDistance" => camera.far.set(parser.numbers()?),
            "left" => camera.left.set(parser.numbers()?),
            "right" => camera.right.set(parser.numbers()?),
            "top" => camera.top.set(parser.numbers()?),
            "bottom" => camera.bottom.set(parser.numbers()?),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    camera.checked()
}

fn read_light(parser: &mut Parser<'_>) -> Result<Light, Fault> {
    let mut light = Light::default();
    parser.block("field", "PointLight", |parser, token| {
        match token.text {
            "location" => light.location = parser.numbers()?.values,
            "color" => light.color = parser.numbers()?.values,
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    Ok(light)
}

/// What a Separator has so far.
#[derive(Default)]
struct Separator {
    object: Object,
    has_material: bool,
    points: Option<Vec<[f64; 3]>>,
    normals: Option<Vec<[f64; 3]>>,
    faces: Option<FaceSet>,
}

/// `coordIndex` and `normalIndex`.
struct FaceSet {
    points: Indices,
    normals: Indices,
}

fn read_separator(parser: &mut Parser<'_>) -> Result<Object, Fault> {
    let mut separator = Separator::default();
    let end = parser.block("block", "Separator", |parser, token| separator.read(parser, token))?;
    separator.finish(end)
}

impl Separator {
    fn read(&mut self, parser: &mut Parser<'_>, token: Token<'_>) -> Result<bool, Fault> {
        let second = match token.text {
            "Material" => self.has_material,
            "Coordinate3" => self.points.is_some(),
            "Normal" => self.normals.is_some(),
            "IndexedFaceSet" => self.faces.is_some(),
            _ => false,
        };
        if second {
            let message = format!("a second {} in one Separator", token.text);
            return Err(Fault::new(token.place, message));
        }
        match token.text {
            "Transform" => self.read_transform(parser)?,
            "Material" => self.read_material(parser)?,
            "Coordinate3" => self.points = Some(read_triples(parser, "Coordinate3", "point")?),
            "Normal" => self.normals = Some(read_triples(parser, "Normal", "vector")?),
            "IndexedFaceSet" => self.faces = Some(read_faces(parser)?),
            _ => return Ok(false),
        }
        if matches!(token.text, "Coordinate3" | "Normal" | "IndexedFaceSet") {
            self.check_indices(self.points.as_ref().map(Vec::len), self.normals.as_ref().map(Vec::len))?;
        }
        Ok(true)
    }

    fn read_transform(&mut self, parser: &mut Parser<'_>) -> Result<(), Fault> {
        let mut transform = TransformFields::new();
        parser.block("field", "Transform", |parser, token| {
            match token.text {
                "translation" => transform.translation.set(parser.numbers()?),
                "rotation" => transform.rotation.set(parser.numbers()?),
                "scaleFactor" => transform.scale_factor.set(parser.numbers()?),
                _ => return Ok(false),
            }
            Ok(true)
        })?;
        self.object.transforms.push(transform.checked()?);
        Ok(())
    }

    fn read_material(&mut self, parser: &mut Parser<'_>) -> Result<(), Fault> {
        let mut material = MaterialFields::new();
        parser.block("field", "Material", |parser, token| {
            match token.text {
                "ambientColor" => material.ambient.set(parser.numbers()?),
                "diffuseColor" => material.diffuse.set(parser.numbers()?),
                "specularColor" => material.specular.set(parser.numbers()?),
                "shininess" => material.shininess.set(parser.numbers()?),
                _ => return Ok(false),
            }
            Ok(true)
        })?;
        self.has_material = true;
        self.object.material = material.checked()?;
        Ok(())
    }

    /// The first index out of range, as far as the numbers of points and normals are known.
    fn check_indices(&self, points: Option<usize>, normals: Option<usize>) -> Result<(), Fault> {
        let Some(faces) = &self.faces else {
            return Ok(());
        };
        first([
            points.and_then(|count| faces.points.within(count)),
            normals.and_then(|count| faces.normals.within(count)),
        ])
    }

    /// The object; `end` is the place of the closing brace.
    fn finish(mut self, end: Place) -> Result<Object, Fault> {
        let points = self.points.take().unwrap_or_default();
        let normals = self.normals.take().unwrap_or_default();
        self.check_indices(Some(points.len()), Some(normals.len()))?;
        let faces = match self.faces {
            Some(faces) => faces::join(&faces.points, &faces.normals),
            None => Ok(Vec::new()),
        };
        Ok(Object {
            points,
            normals,
            faces: faces.map_err(|message| Fault::new(end, message))?,
            ..self.object
        })
    }
}

fn read_triples(parser: &mut Parser<'_>, block: &str, field: &str) -> Result<Vec<[f64; 3]>, Fault> {
    let mut triples = Vec::new();
    parser.block("field", block, |parser, token| {
        if token.text != field {
            return Ok(false);
        }
        triples.clear();
        parser.list(|parser, first| {
            triples.push(parser.triple(first)?);
            Ok(())
        })?;
        Ok(true)
    })?;
    Ok(triples)
}

fn read_faces(parser: &mut Parser<'_>) -> Result<FaceSet, Fault> {
    let mut faces = FaceSet {
        points: Indices::none(Of::Points),
        normals: Indices::none(Of::Normals),
    };
    parser.block("field", "IndexedFaceSet", |parser, token| {
        match token.text {
            "coordIndex" => faces.points = Indices::read(Of::Points, parser)?,
            "normalIndex" => faces.normals = Indices::read(Of::Normals, parser)?,
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    Ok(faces)
}
