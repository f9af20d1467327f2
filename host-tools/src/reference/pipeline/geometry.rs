//! Draw lists (01.4, 03.6, 05.2): attributes by key, and what the vertices make.

use std::collections::BTreeMap;

use super::program::{Key, VERTEX, Values};

/// What vertices are taken together to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topology {
    /// Pairs.
    Lines,
    /// Threes.
    Triangles,
}

/// Vertices, attribute by attribute.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// What the vertices make.
    pub topology: Topology,
    /// Each attribute's value for every vertex; [`VERTEX`] says how many vertices there are.
    pub attributes: BTreeMap<Key, Vec<Vec<f64>>>,
}

impl Geometry {
    /// A geometry of positions; more attributes may be added with [`Geometry::with`].
    pub fn new<const N: usize>(topology: Topology, positions: impl IntoIterator<Item = [f64; N]>) -> Self {
        let attributes = BTreeMap::new();
        Self { topology, attributes }.with(VERTEX, positions)
    }

    /// The same with one more attribute.
    #[must_use]
    pub fn with<const N: usize>(mut self, key: Key, values: impl IntoIterator<Item = [f64; N]>) -> Self {
        let values = values.into_iter().map(Vec::from).collect();
        self.attributes.insert(key, values);
        self
    }

    /// Each vertex's attributes.
    pub fn vertices(&self) -> impl Iterator<Item = Values> {
        let count = self.attributes.get(VERTEX).map_or(0, Vec::len);
        (0..count).map(|i| {
            let own = self
                .attributes
                .iter()
                .filter_map(|(&key, values)| Some((key, values.get(i)?.clone())));
            own.collect()
        })
    }
}
