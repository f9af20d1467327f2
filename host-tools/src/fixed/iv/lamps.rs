//! Lights and materials as the core takes them.

use fixel::light::Matte;
use fixel::light::world::{FULL, Glossy, Material, PointLight, PointLights, PointLit, Specular};
use fixel::num::{self, Block, OneStep, Table, TwoSteps};

use crate::fixed::dials::Precision;
use crate::lower;
use crate::scene::iv::{self, Light, MOST_LIGHTS, Scene};

/// Lights that a scene may have, that of the eye included.
pub const LIGHTS: usize = MOST_LIGHTS + 1;

/// The eye and the lights of a scene at a precision.
pub enum AllLights {
    /// That of exact.
    TwoSteps(PointLights<i64, LIGHTS, TwoSteps>),
    /// That of balanced.
    OneStep(PointLights<i64, LIGHTS, OneStep>),
    /// That of fast.
    Table(PointLights<i64, LIGHTS, Table>),
}

impl AllLights {
    /// Those of a scene, seen from `origin`: so far from it that an object far away from the world's origin does not lose the
    /// places of the lights beside it.
    ///
    /// # Errors
    /// More lights than there is room for.
    pub fn new(scene: &Scene, origin: Block<i64, 3>, precision: Precision) -> Result<Self, String> {
        Ok(match precision {
            Precision::TwoSteps => AllLights::TwoSteps(lights(scene, origin)?),
            Precision::OneStep => AllLights::OneStep(lights(scene, origin)?),
            Precision::Table => AllLights::Table(lights(scene, origin)?),
        })
    }

    /// See [`PointLights::shade`].
    pub fn shade<S: Specular>(&self, normal: [i32; 3], position: Block<i64, 3>, material: &Material<S>) -> [i32; 3] {
        match self {
            AllLights::TwoSteps(lights) => lights.shade(normal, position, material),
            AllLights::OneStep(lights) => lights.shade(normal, position, material),
            AllLights::Table(lights) => lights.shade(normal, position, material),
        }
    }

    /// See [`PointLights::at_scale`].
    pub fn at_scale(&self, exponent: i32) -> Lit {
        match self {
            AllLights::TwoSteps(lights) => Lit::TwoSteps(lights.at_scale(exponent)),
            AllLights::OneStep(lights) => Lit::OneStep(lights.at_scale(exponent)),
            AllLights::Table(lights) => Lit::Table(lights.at_scale(exponent)),
        }
    }
}

/// The lights for places at one scale. Which precision is told when a pixel is lit, as for HW2.
pub enum Lit {
    /// That of exact.
    TwoSteps(PointLit<LIGHTS, TwoSteps>),
    /// That of balanced.
    OneStep(PointLit<LIGHTS, OneStep>),
    /// That of fast.
    Table(PointLit<LIGHTS, Table>),
}

impl Lit {
    /// See [`PointLit::shade`].
    pub fn shade<S: Specular>(&self, normal: [i32; 3], position: [i32; 3], material: &Material<S>) -> [i32; 3] {
        match self {
            Lit::TwoSteps(lit) => lit.shade(normal, position, material),
            Lit::OneStep(lit) => lit.shade(normal, position, material),
            Lit::Table(lit) => lit.shade(normal, position, material),
        }
    }
}

fn lights<P: num::Precision>(scene: &Scene, origin: Block<i64, 3>) -> Result<PointLights<i64, LIGHTS, P>, String> {
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
