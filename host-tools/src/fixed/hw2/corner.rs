//! Corners of triangles in eye space, and what fragments want to know of them in units of the triangle's own.

use fixel::num::{Block, Scaled};

use crate::fixed::texcoord::nearest;

/// A vertex on its way: all that some fragment program may carry.
#[derive(Debug, Clone, Copy)]
pub struct Corner {
    /// MV·v.
    pub eye: Block<i64, 4>,
    /// Its channels in the primitive's unit.
    pub color: [i32; 3],
    /// unit(D·normal) in units of 2^-30.
    pub normal: Option<[i32; 3]>,
    /// s, t; 1 is the whole texture.
    pub texcoord: [Scaled<i64>; 2],
}

impl Corner {
    /// Colour and normal in units 2^`color` and 2^`normal` times as large.
    pub fn with_headroom(self, color: u32, normal: u32) -> Self {
        let coarser = |v: i32, bits: u32| (v + ((1 << bits) >> 1)) >> bits;
        Corner {
            color: self.color.map(|c| coarser(c, color)),
            normal: self.normal.map(|n| n.map(|c| coarser(c, normal))),
            ..self
        }
    }
}

/// The same direction with length 1 in units of 2^-30; `None` for the zero vector.
pub fn unit(direction: Block<i64, 3>) -> Option<[i32; 3]> {
    let unit = direction.unit()?;
    Some(unit.map(|c| ((c + (1 << 31)) >> 32) as i32))
}

/// The eye position: (x, y, z)/w, the eye itself where that is infinite.
pub fn place(eye: Block<i64, 4>) -> Block<i64, 3> {
    let [x, y, z, w] = eye.split();
    Block::gather([x, y, z]).over(w).unwrap_or(Block::ZERO)
}

/// unit((B − A) × (C − A)); 0 for a triangle without area, which is dark.
pub fn perpendicular([a, b, c]: [Block<i64, 3>; 3]) -> [i32; 3] {
    unit(b.minus(a).cross(c.minus(a))).unwrap_or_default()
}

/// Places in a unit of their own, 2^exponent, in which the largest coordinate lies in 2^29…2^30, less the headroom.
pub fn in_own_unit(places: [Block<i64, 3>; 3], headroom: u32) -> ([[i32; 3]; 3], i32) {
    let exponents = places.iter().filter(|p| !p.is_zero()).map(Block::exponent);
    let exponent = exponents.max().unwrap_or(0).saturating_add(32 + headroom as i32);
    let fixed = |p: Block<i64, 3>| p.scaled(exponent.saturating_neg()).split().map(|c| nearest(c, 0));
    (places.map(fixed), exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower;

    #[test]
    fn the_largest_coordinate_fills_its_word() {
        let places = [[0.5, -3.0, 0.25], [1.0, 0.0, 0.0], [0.0; 3]].map(lower::block);
        let (fixed, exponent) = in_own_unit(places, 0);
        assert_eq!(exponent, -28);
        assert_eq!(fixed, [[1 << 27, -3 << 28, 1 << 26], [1 << 28, 0, 0], [0; 3]]);
    }
}
