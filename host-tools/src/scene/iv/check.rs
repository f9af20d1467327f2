//! What must hold of the values that count: those that a block's fields have when it ends. A fault stands where the
//! value does.

use super::parser::Given;
use super::{Camera, Material, Rotation, Transform};
use crate::scene::{Fault, Place};

/// The one that stands first in the text.
pub fn first(faults: impl IntoIterator<Item = Option<Fault>>) -> Result<(), Fault> {
    let found = faults.into_iter().flatten().min_by_key(|fault| fault.place);
    found.map_or(Ok(()), Err)
}

/// A field's values and where they stand; a default stands nowhere.
#[derive(Debug, Clone, Copy)]
pub struct Field<const N: usize> {
    values: [f64; N],
    places: Option<[Place; N]>,
}

impl<const N: usize> Field<N> {
    fn new(default: [f64; N]) -> Self {
        Self {
            values: default,
            places: None,
        }
    }

    /// The field is given, perhaps not for the first time.
    pub fn set(&mut self, given: Given<N>) {
        self.values = given.values;
        self.places = Some(given.places);
    }
}

/// A turn as x, y, z, angle.
fn rotation() -> Field<4> {
    let Rotation { axis: [x, y, z], angle } = Rotation::default();
    Field::new([x, y, z, angle])
}

impl Field<4> {
    fn checked(&self) -> Result<Rotation, Fault> {
        let [x, y, z, angle] = self.values;
        let axis = [x, y, z];
        if let Some([place, ..]) = self.places.filter(|_| axis == [0.0; 3] && angle != 0.0) {
            return Err(Fault::new(place, "the axis must not be 0 0 0 where the angle is not 0"));
        }
        Ok(Rotation { axis, angle })
    }
}

/// `PerspectiveCamera`.
#[derive(Debug)]
pub struct CameraFields {
    pub position: Field<3>,
    pub orientation: Field<4>,
    pub near: Field<1>,
    pub far: Field<1>,
    pub left: Field<1>,
    pub right: Field<1>,
    pub bottom: Field<1>,
    pub top: Field<1>,
}

impl CameraFields {
    /// All defaults.
    pub fn new() -> Self {
        let camera = Camera::default();
        Self {
            position: Field::new(camera.position),
            orientation: rotation(),
            near: Field::new([camera.near]),
            far: Field::new([camera.far]),
            left: Field::new([camera.left]),
            right: Field::new([camera.right]),
            bottom: Field::new([camera.bottom]),
            top: Field::new([camera.top]),
        }
    }

    /// The camera, if it is one.
    pub fn checked(&self) -> Result<Camera, Fault> {
        let [near, far, left, right, bottom, top] =
            [self.near, self.far, self.left, self.right, self.bottom, self.top].map(|field| field.values[0]);
        // The defaults are right: of a pair that is wrong at least one is given. It shows at the later.
        let fault = |wrong: bool, fields: [Field<1>; 2], message| {
            let [place] = fields.iter().filter_map(|field| field.places).max()?;
            wrong.then(|| Fault::new(place, message))
        };
        let orientation = self.orientation.checked();
        first([
            fault(near <= 0.0, [self.near; 2], "nearDistance must be > 0"),
            fault(far <= near, [self.near, self.far], "farDistance must be > nearDistance"),
            fault(left == right, [self.left, self.right], "left and right must differ"),
            fault(bottom == top, [self.bottom, self.top], "bottom and top must differ"),
            orientation.clone().err(),
        ])?;
        Ok(Camera {
            position: self.position.values,
            orientation: orientation?,
            near,
            far,
            left,
            right,
            bottom,
            top,
        })
    }
}

/// `Transform`.
#[derive(Debug)]
pub struct TransformFields {
    pub translation: Field<3>,
    pub rotation: Field<4>,
    pub scale_factor: Field<3>,
}

impl TransformFields {
    /// All defaults.
    pub fn new() -> Self {
        let transform = Transform::default();
        Self {
            translation: Field::new(transform.translation),
            rotation: rotation(),
            scale_factor: Field::new(transform.scale_factor),
        }
    }

    /// The transform, if it can be undone.
    pub fn checked(&self) -> Result<Transform, Fault> {
        let scale_factor = self.scale_factor.values;
        let places = self.scale_factor.places.into_iter().flatten();
        let zero = scale_factor.into_iter().zip(places).find(|&(factor, _)| factor == 0.0);
        let rotation = self.rotation.checked();
        first([
            zero.map(|(_, place)| Fault::new(place, "scaleFactor must not be 0")),
            rotation.clone().err(),
        ])?;
        Ok(Transform {
            translation: self.translation.values,
            rotation: rotation?,
            scale_factor,
        })
    }
}

/// `Material`.
#[derive(Debug)]
pub struct MaterialFields {
    pub ambient: Field<3>,
    pub diffuse: Field<3>,
    pub specular: Field<3>,
    pub shininess: Field<1>,
}

impl MaterialFields {
    /// All defaults.
    pub fn new() -> Self {
        let material = Material::default();
        Self {
            ambient: Field::new(material.ambient),
            diffuse: Field::new(material.diffuse),
            specular: Field::new(material.specular),
            shininess: Field::new([material.shininess]),
        }
    }

    /// The material, its colours clamped to 0…1.
    pub fn checked(&self) -> Result<Material, Fault> {
        let [shininess] = self.shininess.values;
        if let Some([place]) = self.shininess.places.filter(|_| shininess < 0.0) {
            return Err(Fault::new(place, "shininess must not be negative"));
        }
        let clamped = |color: Field<3>| color.values.map(|c| c.clamp(0.0, 1.0));
        Ok(Material {
            ambient: clamped(self.ambient),
            diffuse: clamped(self.diffuse),
            specular: clamped(self.specular),
            shininess,
        })
    }
}
