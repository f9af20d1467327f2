//! Corners of triangles in eye space, and what fragments want to know of them in units of the triangle's own.

use fixel::num::{Block, Scaled};

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

/// Corners' texture coordinates in texels, and the number of fraction bits: as many as fit. A whole number of textures,
/// common to the corners, is taken off first.
///
/// # Errors
/// Where they are more than 2^31 texels apart.
pub fn texels(corners: &[Corner; 3], size: [u16; 2], headroom: u32) -> Result<([[i32; 2]; 3], u32), String> {
    let [a, b, c] = corners.map(|corner| corner.texcoord);
    let [[sa, ta], [sb, tb], [sc, tc]] = [a, b, c];
    let axes = [
        (Block::gather([sa, sb, sc]), size[0]),
        (Block::gather([ta, tb, tc]), size[1]),
    ];
    let [s, t] = axes.map(|(coordinates, size)| without_periods(coordinates).times(Scaled::from_integer(size.into())));
    // A block's numbers are at most 2^(62 + exponent).
    let fitting = |axis: &Block<i64, 3>| if axis.is_zero() { 30 } else { -32 - axis.exponent() };
    let fraction_bits = fitting(&s).min(fitting(&t)).min(30);
    if fraction_bits < 0 {
        return Err("texture coordinates of one triangle that are more than 2^31 texels apart".into());
    }
    let fraction_bits = (fraction_bits - headroom as i32).max(0);
    let [[sa, sb, sc], [ta, tb, tc]] = [s, t].map(|axis| axis.split().map(|c| nearest(c, fraction_bits)));
    Ok(([[sa, ta], [sb, tb], [sc, tc]], fraction_bits as u32))
}

/// The three numbers less the whole number that is nearest to the middle between the least and the largest.
fn without_periods(coordinates: Block<i64, 3>) -> Block<i64, 3> {
    let [a, b, c] = coordinates.mantissas();
    let (least, most) = (a.min(b).min(c), a.max(b).max(c));
    let middle = Scaled::new([(least >> 1) + (most >> 1)], coordinates.exponent());
    let periods = Scaled::new([nearest_wide(middle, 0)], 0);
    let [periods] = periods.split();
    coordinates.minus(Block::gather([periods; 3]))
}

/// In units of 2^-`fraction_bits`, rounded to nearest.
fn nearest_wide(number: Scaled<i64>, fraction_bits: i32) -> i64 {
    let halves = number.scaled(fraction_bits + 1).to_fixed(0);
    (halves >> 1) + (halves & 1)
}

/// [`nearest_wide`] where the caller has shown that it fits.
fn nearest(number: Scaled<i64>, fraction_bits: i32) -> i32 {
    nearest_wide(number, fraction_bits) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower;

    fn corners(s: [f64; 3], t: [f64; 3]) -> [Corner; 3] {
        std::array::from_fn(|i| Corner {
            eye: Block::ZERO,
            color: [0; 3],
            normal: None,
            texcoord: [lower::block([s[i]]), lower::block([t[i]])],
        })
    }

    #[test]
    fn whole_textures_are_taken_off() {
        let (near, bits) = texels(&corners([0.0, 1.0, 0.5], [0.0, 0.25, 1.0]), [8, 5], 0).unwrap();
        let (far, same) = texels(&corners([1e6, 1e6 + 1.0, 1e6 + 0.5], [-7.0, -6.75, -6.0]), [8, 5], 0).unwrap();
        // 8 texels are 2^61 · 2^-58: taken for less than 2^4, they get 26 bits of 30.
        assert_eq!((bits, same), (26, 26));
        for (near, far) in near.into_iter().zip(far) {
            let period = [8 << bits, 5 << bits];
            for axis in 0..2 {
                assert_eq!((near[axis] - far[axis]) % period[axis], 0);
            }
        }
    }

    #[test]
    fn coordinates_that_do_not_fit_are_refused() {
        assert!(texels(&corners([0.0, 1e12, 0.0], [0.0; 3]), [8, 8], 0).is_err());
        assert!(texels(&corners([1e300; 3], [0.0; 3]), [8, 8], 0).is_err());
    }

    #[test]
    fn the_largest_coordinate_fills_its_word() {
        let places = [[0.5, -3.0, 0.25], [1.0, 0.0, 0.0], [0.0; 3]].map(lower::block);
        let (fixed, exponent) = in_own_unit(places, 0);
        assert_eq!(exponent, -28);
        assert_eq!(fixed, [[1 << 27, -3 << 28, 1 << 26], [1 << 28, 0, 0], [0; 3]]);
    }
}
