//! The text of a mesh: points, normals, faces.

use std::num::IntErrorKind;

use crate::scene::Fault;
use crate::scene::arguments::{decimal, quoted};
use crate::scene::iv::{Corner, Face};
use crate::scene::lex::{self, Token};

/// A corner as the text gives it: the normal may be missing.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    point: usize,
    normal: Option<usize>,
}

/// What a text says: all numbers finite, all indices valid.
#[derive(Debug, Default)]
pub struct Mesh {
    /// Positions.
    pub points: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    /// Three or more corners each.
    faces: Vec<Vec<Vertex>>,
}

impl Mesh {
    /// Reads a text.
    pub fn read(text: &str) -> Result<Self, Fault> {
        let mut mesh = Self::default();
        let mut words = Vec::new();
        let mut lines = text
            .strip_prefix('\u{feff}')
            .unwrap_or(text)
            .lines()
            .zip(1..)
            .peekable();
        while let Some((line, number)) = lines.next() {
            let line = line.strip_suffix('\r').unwrap_or(line);
            // A line that ends in a backslash goes on in the next, unless that is part of a comment. Blanks behind it are not seen.
            let (line, goes_on) = match line.trim_ascii_end().strip_suffix('\\') {
                Some(line) if !line.contains('#') => (line, lines.peek().is_some()),
                _ => (line, false),
            };
            let comment = |word: &Token<'_>| word.text.starts_with('#');
            words.extend(lex::tokens(line, number).take_while(|word| !comment(word)));
            if let (false, Some((keyword, arguments))) = (goes_on, words.split_first()) {
                mesh.statement(*keyword, arguments)?;
                words.clear();
            }
        }
        Ok(mesh)
    }

    fn statement(&mut self, keyword: Token<'_>, arguments: &[Token<'_>]) -> Result<(), Fault> {
        match keyword.text {
            "v" => self.points.push(triple(keyword, arguments)?),
            "vn" => self.normals.push(triple(keyword, arguments)?),
            "f" if arguments.len() < 3 => {
                let message = format!("a face needs 3 vertices or more, found {}", arguments.len());
                return Err(Fault::new(keyword.place, message));
            }
            "f" => {
                let vertices = arguments.iter().map(|&word| self.vertex(word));
                self.faces.push(vertices.collect::<Result<_, _>>()?);
            }
            _ => {}
        }
        Ok(())
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`; slashes with nothing behind them are common and mean nothing.
    fn vertex(&self, word: Token<'_>) -> Result<Vertex, Fault> {
        let malformed = || fault(word, "expected a vertex as v, v/vt, v//vn or v/vt/vn");
        let mut parts = word.text.split('/');
        let mut part = || parts.next().filter(|part| !part.is_empty()).map(index);
        let (point, texture, normal) = (part(), part(), part());
        let point = point.flatten().ok_or_else(malformed)?;
        let given = |part: Option<Option<i64>>| part.map_or(Ok(None), |part| part.map(Some).ok_or_else(malformed));
        let (_, normal) = (given(texture)?, given(normal)?);
        if parts.next().is_some() {
            return Err(malformed());
        }
        let normal = normal.map(|index| position(word, index, self.normals.len(), "normal"));
        Ok(Vertex {
            point: position(word, point, self.points.len(), "vertex")?,
            normal: normal.transpose()?,
        })
    }

    /// The mesh moved and scaled into the sphere of radius 1 about the origin.
    pub fn framed(mut self) -> Result<Self, Fault> {
        let mut used = (self.faces.iter().flatten()).map(|vertex| self.points[vertex.point]);
        let first = used.next().ok_or_else(|| Fault::of_whole("no faces"))?;
        let (low, high) = used.fold((first, first), |(low, high), point| {
            let pick = |a: [f64; 3], of: fn(f64, f64) -> f64| [0, 1, 2].map(|i| of(a[i], point[i]));
            (pick(low, f64::min), pick(high, f64::max))
        });
        // Halved before they are added, and made small before they are squared: any finite numbers will do.
        let middle = [0, 1, 2].map(|i| low[i] / 2.0 + high[i] / 2.0);
        let half = (0..3).map(|i| high[i] / 2.0 - low[i] / 2.0).fold(0.0, f64::max);
        if half == 0.0 {
            return Err(Fault::of_whole("all faces are one point"));
        }
        let scaled = |point: [f64; 3]| [0, 1, 2].map(|i| (point[i] / 2.0 - middle[i] / 2.0) / half * 2.0);
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let used = self.faces.iter().flatten();
        let radius = used.fold(0.0, |r: f64, vertex| r.max(length(scaled(self.points[vertex.point]))));
        for point in &mut self.points {
            // Points of no face may be as far away as they like; all others are inside anyway.
            *point = scaled(*point).map(|x| (x / radius).clamp(-1.0, 1.0));
        }
        Ok(self)
    }

    /// The faces with a normal for every corner, and the normals.
    pub fn normals_and_faces(&self) -> (Vec<[f64; 3]>, Vec<Face>) {
        let mut normals = self.normals.clone();
        let faces = self.faces.iter().map(|vertices| {
            let own = normals.len();
            if vertices.iter().any(|vertex| vertex.normal.is_none()) {
                normals.push(self.normal(vertices));
            }
            let corner = |vertex: &Vertex| Corner {
                point: vertex.point,
                normal: vertex.normal.unwrap_or(own),
            };
            Face {
                corners: vertices.iter().map(corner).collect(),
            }
        });
        let faces = faces.collect();
        (normals, faces)
    }

    /// A face's normal: the sum of the cross products of its fan, which is 0 if it has no area: where a face is folded onto itself
    /// they cancel, and what float64 leaves of them has any direction.
    fn normal(&self, vertices: &[Vertex]) -> [f64; 3] {
        let [first, rest @ ..] = vertices else {
            return [0.0; 3];
        };
        let from_first =
            |vertex: &Vertex| [0, 1, 2].map(|i| self.points[vertex.point][i] - self.points[first.point][i]);
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let (mut sum, mut all) = ([0.0; 3], 0.0);
        for pair in rest.windows(2) {
            let (a, b) = (from_first(&pair[0]), from_first(&pair[1]));
            let product = [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
            sum = [0, 1, 2].map(|i| sum[i] + product[i]);
            all += length(product);
        }
        if length(sum) <= CANCELLED * all { [0.0; 3] } else { sum }
    }
}

/// What the roundings of a sum of products leave of it where it is 0, of the products' lengths.
const CANCELLED: f64 = 1e-12;

/// A number of a list; one too large for a word of 64 bits is as far beyond any list as the largest.
fn index(text: &str) -> Option<i64> {
    match text.parse::<i64>() {
        Ok(index) => Some(index),
        Err(error) if *error.kind() == IntErrorKind::PosOverflow => Some(i64::MAX),
        Err(error) if *error.kind() == IntErrorKind::NegOverflow => Some(-i64::MAX),
        Err(_) => None,
    }
}

/// Three numbers; more may follow, as a weight or a colour.
fn triple(keyword: Token<'_>, arguments: &[Token<'_>]) -> Result<[f64; 3], Fault> {
    let Some((&[x, y, z], _)) = arguments.split_first_chunk() else {
        let message = format!("{} takes 3 numbers, found {}", keyword.text, arguments.len());
        return Err(Fault::new(keyword.place, message));
    };
    Ok([number(x)?, number(y)?, number(z)?])
}

fn number(word: Token<'_>) -> Result<f64, Fault> {
    let value = decimal(word.text).ok_or_else(|| fault(word, "expected a number"))?;
    if value.is_finite() {
        return Ok(value);
    }
    Err(fault(word, "too large a number"))
}

/// An index from 1, or from -1 backwards, as a position in a list of `count` so far.
fn position(word: Token<'_>, index: i64, count: usize, what: &str) -> Result<usize, Fault> {
    let distance = usize::try_from(index.unsigned_abs()).unwrap_or(usize::MAX);
    let position = match index {
        0 => return Err(fault(word, "indices start at 1 (or -1)")),
        1.. => Some(distance - 1).filter(|&position| position < count),
        _ => count.checked_sub(distance),
    };
    position.ok_or_else(|| fault(word, &format!("no such {what}: {count} made so far")))
}

fn fault(word: Token<'_>, message: &str) -> Fault {
    Fault::new(word.place, format!("{message}, found {}", quoted(word.text)))
}
