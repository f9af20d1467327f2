//! Lists of indices: faces of corners, each ended by -1.

use super::parser::{Parser, number, quoted, unexpected};
use super::{Corner, Face};
use crate::scene::lex::Token;
use crate::scene::{Fault, Place};

/// What a list's indices point at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Of {
    /// `coordIndex`.
    Points,
    /// `normalIndex`.
    Normals,
}

/// One list.
#[derive(Debug)]
pub struct Indices {
    of: Of,
    /// All faces' indices.
    corners: Vec<usize>,
    /// Behind the last corner of each face.
    ends: Vec<usize>,
    /// Every index that is larger than all before it. The first index that is out of range is one of them, whatever the
    /// range turns out to be.
    records: Vec<(f64, Place)>,
}

impl Indices {
    /// The empty list, as if there were none in the text.
    pub fn none(of: Of) -> Self {
        Self {
            of,
            corners: Vec::new(),
            ends: Vec::new(),
            records: Vec::new(),
        }
    }

    /// Reads a list in brackets.
    pub fn read(of: Of, parser: &mut Parser<'_>) -> Result<Self, Fault> {
        let mut list = Self::none(of);
        let end = parser.list(|_, token| list.push(token))?;
        if list.corners.len() > list.last_end() {
            return Err(Fault::new(end, "last face is not closed by -1"));
        }
        Ok(list)
    }

    fn last_end(&self) -> usize {
        self.ends.last().copied().unwrap_or(0)
    }

    fn push(&mut self, token: Token<'_>) -> Result<(), Fault> {
        let value = number(token)?;
        if value.fract() != 0.0 {
            return Err(unexpected(token, "an integer index"));
        }
        if value == -1.0 {
            return self.close(token.place);
        }
        if value < 0.0 {
            let message = format!("index is negative, found {}", quoted(token));
            return Err(Fault::new(token.place, message));
        }
        if self.records.last().is_none_or(|&(largest, _)| value > largest) {
            self.records.push((value, token.place));
        }
        // One beyond what a usize holds is out of every range, and reported by its record.
        self.corners.push(value as usize);
        Ok(())
    }

    /// Ends a face. How many normals it has is compared with its points later, with a message that has both counts.
    fn close(&mut self, place: Place) -> Result<(), Fault> {
        if self.of == Of::Points && self.corners.len() - self.last_end() < 3 {
            let message = format!("face {} has fewer than 3 vertices", self.ends.len());
            return Err(Fault::new(place, message));
        }
        self.ends.push(self.corners.len());
        Ok(())
    }

    /// A fault if an index is not below `count`, the number of points or normals; the first such index.
    pub fn within(&self, count: usize) -> Option<Fault> {
        let &(index, place) = self.records.iter().find(|(index, _)| *index >= count as f64)?;
        let index = shown(index);
        let message = match self.of {
            Of::Points => format!("coordinate index {index} out of range ({count} points)"),
            Of::Normals => format!("normal index {index} out of range ({count} normals)"),
        };
        Some(Fault::new(place, message))
    }

    fn faces(&self) -> impl Iterator<Item = &[usize]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.corners[start..end])
    }
}

/// An index as it may have been written: one that no list is long enough for has up to 309 digits, of which few were.
fn shown(index: f64) -> String {
    if index < 1e15 {
        index.to_string()
    } else {
        format!("{index:e}")
    }
}

/// Both lists as faces; the error is how their shapes differ.
pub fn join(points: &Indices, normals: &Indices) -> Result<Vec<Face>, String> {
    let (faces, others) = (points.ends.len(), normals.ends.len());
    if faces != others {
        return Err(format!("{faces} faces in coordIndex but {others} in normalIndex"));
    }
    let pairs = points.faces().zip(normals.faces()).enumerate();
    pairs.map(|(i, (points, normals))| face(i, points, normals)).collect()
}

fn face(index: usize, points: &[usize], normals: &[usize]) -> Result<Face, String> {
    let (corners, others) = (points.len(), normals.len());
    if corners != others {
        return Err(format!(
            "face {index} has {corners} vertices in coordIndex but {others} in normalIndex"
        ));
    }
    let pairs = points.iter().zip(normals);
    let corners = pairs.map(|(&point, &normal)| Corner { point, normal }).collect();
    Ok(Face { corners })
}
