//! From a vertex to a corner in eye space, with the bounds of the core's difference from it (formats/hw2.md section 5,
//! step 1).

use super::Reference;
use super::patch::Sample;
use crate::backend::Vertex;
use crate::compare::stated::{FIXED_PRODUCT, FLOAT_PRODUCT};
use crate::reference::attributes::{Attributes, Bounds, CARRIED};
use crate::reference::bound::size;
use crate::reference::clip::Corner;
use crate::reference::material::{Fill, Material};
use crate::reference::matrix::{Vector, cross, length, unit_or_zero};

/// What is left of a unit vector's knowledge when nothing is known of its direction: the distance of opposite ones.
const ANY_DIRECTION: f64 = 2.0;

/// What a colour of a patch counts, in units that all of the patch share: its small triangles may be dark beside its brightest
/// control point. Half a unit for each control point's rounding and half of one for the point's, two for the quotient of
/// interpolation and four for its steps (see [`LIT_SURFACE`]), of which the comparison counts [`UNITS`] each.
///
/// [`LIT_SURFACE`]: crate::compare::stated::LIT_SURFACE
/// [`UNITS`]: crate::compare::stated::UNITS
const PATCH_UNITS: f64 = 3.0;

/// A vertex before MV, given by the scene or made of a patch.
pub struct Given {
    position: Vector,
    color: [f64; 3],
    texcoord: [f64; 2],
    normal: Option<[f64; 3]>,
    /// The largest channel of all control points whose unit of colours it has; 0 for a vertex of the scene, which has its triangle's.
    brightest: f64,
    /// Bound of the distance of the core's position from this one.
    error: f64,
    /// Bound of the length of the difference of the core's normal from this one.
    normal_error: f64,
}

impl Given {
    /// A vertex of the scene: the core rounds its numbers once.
    pub fn of(vertex: &Vertex) -> Self {
        Self {
            position: vertex.position,
            color: vertex.color,
            texcoord: vertex.texcoord,
            normal: vertex.normal,
            brightest: 0.0,
            error: FIXED_PRODUCT * size(&vertex.position),
            normal_error: FIXED_PRODUCT * vertex.normal.map_or(0.0, length),
        }
    }

    /// A point of a patch.
    pub fn of_patch(sample: &Sample) -> Self {
        Self {
            position: sample.position,
            color: sample.color,
            texcoord: [0.0; 2],
            normal: sample.normal,
            brightest: sample.brightest,
            error: sample.error,
            normal_error: sample.normal_error,
        }
    }
}

/// A corner, and whether its vertex has a normal.
#[derive(Debug, Clone, Copy)]
pub struct Placed {
    /// The corner in eye space.
    pub corner: Corner,
    /// Whether there is a normal.
    pub has_normal: bool,
}

impl Reference {
    /// The vertex under MV; eye position and normal only where there is light.
    pub(super) fn placed(&self, given: &Given, material: &Material) -> Placed {
        let (eye, error) = self.model_view.apply(&given.position, given.error);
        let (color, brightest) = match &material.fill {
            Fill::Flat(color) => (*color, 0.0),
            Fill::Gouraud | Fill::Textured(_) => (given.color, given.brightest),
        };
        let mut at = Attributes {
            color,
            texcoord: given.texcoord,
            ..Attributes::default()
        };
        let mut at_error = Bounds {
            color: PATCH_UNITS * CARRIED * brightest,
            ..Bounds::default()
        };
        if material.is_lit() {
            (at.eye, at_error.eye) = divided_within(&eye, error);
            if let Some([x, y, z]) = given.normal {
                let ([x, y, z, _], off) = self.directions.apply(&[x, y, z, 0.0], given.normal_error);
                (at.normal, at_error.normal) = unit_within([x, y, z], off);
            }
        }
        Placed {
            corner: Corner {
                eye,
                at,
                error,
                at_error,
            },
            has_normal: given.normal.is_some(),
        }
    }

    /// The unit perpendicular (B − A) × (C − A) of the eye positions, vertices in the order given (section 7), and the bound
    /// of its error.
    pub(super) fn perpendicular(corners: &[Corner; 3]) -> ([f64; 3], f64) {
        let [a, b, c] = corners.map(|corner| corner.at.eye);
        let (b, c) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
        let errors =
            corners.map(|corner| corner.at_error.eye + (FIXED_PRODUCT + FLOAT_PRODUCT) * length(corner.at.eye));
        let (off_b, off_c) = (errors[0] + errors[1], errors[0] + errors[2]);
        let product = 2.0 * (FIXED_PRODUCT + FLOAT_PRODUCT) * length(b) * length(c);
        let off = off_b * length(c) + off_c * length(b) + off_b * off_c + product;
        unit_within(cross(b, c), off)
    }
}

/// Nothing is known of a corner's normal any more.
pub fn any_direction(corner: &mut Corner) {
    corner.at_error.normal = ANY_DIRECTION;
}

/// Whether a normal so uncertain may be 0.
pub fn may_vanish(corner: &Corner) -> bool {
    corner.at_error.normal >= ANY_DIRECTION
}

/// The unit vector, and the bound of the length of its difference from the core's, where the vector may be off by `error`:
/// a vector moved by E turns by at most 2 E / |v|.
pub fn unit_within(v: [f64; 3], error: f64) -> ([f64; 3], f64) {
    let turned = 2.0 * error / length(v);
    let bound = if turned < ANY_DIRECTION { turned } else { ANY_DIRECTION };
    (unit_or_zero(v), bound + 2.0 * (FIXED_PRODUCT + FLOAT_PRODUCT))
}

/// xyz/w and the bound of its distance from the core's: off by E, the vector moves it by (E + E |xyz/w|) / (|w| − E). What has no
/// place is at the eye, as the core has it, which may have any place where float64 has none.
pub fn divided_within([x, y, z, w]: &Vector, error: f64) -> ([f64; 3], f64) {
    let point = [x / w, y / w, z / w];
    if !point.iter().all(|c| c.is_finite()) {
        return ([0.0; 3], f64::INFINITY);
    }
    let margin = w.abs() - error;
    let relative = if margin > 0.0 { error / margin } else { f64::INFINITY };
    let rounding = FIXED_PRODUCT + FLOAT_PRODUCT;
    (point, relative * (1.0 + length(point)) + rounding * length(point))
}
