//! Lights and materials as the core takes them.

use fixel::light::Matte;
use fixel::light::world::{FULL, Glossy, Material, PointLight, PointLights};
use fixel::num::Block;

use crate::lower;
use crate::scene::iv::{self, Light, Scene};

/// Lights that a scene may have.
pub const LIGHTS: usize = 1024;

/// The eye and the lights of a scene, seen from `origin`: so far from it that an object far away from the world's origin does
/// not lose the places of the lights beside it.
///
/// # Errors
/// More lights than there is room for.
pub fn lights(scene: &Scene, origin: Block<i64, 3>) -> Result<PointLights<i64, LIGHTS>, String> {
    let (eye, all) = seen_from(scene, origin);
    let mut lights = PointLights::new(eye);
    for light in all {
        lights.add(light).map_err(|e| format!("{e} ({LIGHTS})"))?;
    }
    Ok(lights)
}

/// The eye and each light, seen from `origin`.
pub(super) fn seen_from(scene: &Scene, origin: Block<i64, 3>) -> (Block<i64, 3>, Vec<PointLight<i64>>) {
    let from_origin = |point: [f64; 3]| lower::block::<3>(point).minus(origin);
    let light = |light: Light| PointLight {
        position: from_origin(light.location),
        color: color(light.color),
    };
    let lights = scene.lights().into_iter().map(light).collect();
    (from_origin(scene.model.camera.position), lights)
}

/// Any colour: to 2^-30 of its largest channel.
fn color(color: [f64; 3]) -> Block<i32, 3> {
    let wide = lower::block(color);
    Block::from_wide(wide.mantissas().map(|m| m >> 1), wide.exponent().saturating_add(1))
}

/// A material, with highlights or without.
pub enum Surface {
    /// Without: its specular colour is black.
    Matte(Material<Matte>),
    /// With.
    Glossy(Material<Glossy>),
}

impl Surface {
    /// As the scene gives it.
    ///
    /// # Errors
    /// A shininess of 65536 or more.
    pub fn of(material: &iv::Material) -> Result<Self, String> {
        let units = |color: [f64; 3]| color.map(|c| (c * f64::from(FULL)).round() as i32);
        let (ambient, diffuse) = (units(material.ambient), units(material.diffuse));
        if material.specular == [0.0; 3] {
            return Ok(Self::Matte(Material {
                ambient,
                diffuse,
                specular: Matte,
            }));
        }
        let specular = Glossy {
            color: units(material.specular),
            // 0 is an exponent here: every highlight is full.
            shininess: lower::shininess(material.shininess)?.unwrap_or(0),
        };
        Ok(Self::Glossy(Material {
            ambient,
            diffuse,
            specular,
        }))
    }

    /// With or without: without, their colour is black.
    pub fn described(&self) -> Material<Glossy> {
        match *self {
            Self::Glossy(material) => material,
            Self::Matte(Material { ambient, diffuse, .. }) => Material {
                ambient,
                diffuse,
                specular: Glossy {
                    color: [0; 3],
                    shininess: 0,
                },
            },
        }
    }
}
