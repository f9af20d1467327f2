//! Point lights in a fragment shader (chapter 09): an application of the pipeline, not a part of it.

use crate::reference::matrix::{dot, unit};

/// A point light without falloff.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// In view space.
    pub position: [f64; 3],
    /// Red, green, blue.
    pub color: [f64; 3],
}

/// How a surface answers light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Red, green, blue and alpha, texture included.
    pub diffuse: [f64; 4],
    /// The share of highlights.
    pub specular: f64,
    /// Their exponent.
    pub shininess: f64,
    /// What it shines of itself.
    pub emission: [f64; 3],
}

impl Default for Material {
    fn default() -> Self {
        Self {
            diffuse: [1.0; 4],
            specular: 1.0,
            shininess: 16.0,
            emission: [0.0; 3],
        }
    }
}

impl Material {
    /// The same with a texture's colour on it.
    #[must_use]
    pub fn textured(mut self, texel: [f64; 4]) -> Self {
        self.diffuse = std::array::from_fn(|i| self.diffuse[i] * texel[i]);
        self
    }

    /// The colour of the surface at `p` with a normal of any length, both in view space; alpha is the diffuse one.
    pub fn lit(&self, lights: &[Light], p: [f64; 3], normal: [f64; 3]) -> [f64; 4] {
        let n = unit(normal);
        let mut color = self.emission;
        for light in lights {
            let l = unit([0, 1, 2].map(|i| light.position[i] - p[i]));
            let (diffuse, specular) = self.shares(n, l, unit(p.map(|c| -c)));
            for (i, c) in color.iter_mut().enumerate() {
                *c += (self.diffuse[i] * diffuse + self.specular * specular) * light.color[i];
            }
        }
        [color[0], color[1], color[2], self.diffuse[3]]
    }

    /// What a light in direction `l` gives to an eye in direction `v`: diffuse and specular.
    fn shares(&self, n: [f64; 3], l: [f64; 3], v: [f64; 3]) -> (f64, f64) {
        let facing = dot(l, n);
        let reflected = [0, 1, 2].map(|i| 2.0 * facing * n[i] - l[i]);
        let diffuse = facing.clamp(0.0, 1.0);
        let highlight = dot(reflected, v).clamp(0.0, 1.0).powf(self.shininess);
        (diffuse, if diffuse > 0.0 { highlight } else { 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::super::camera::Transform;
    use super::*;

    fn near(found: [f64; 4], expected: [f64; 4]) {
        assert!(
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6),
            "{found:?}"
        );
    }

    #[test]
    fn i09_1_normals_stay_perpendicular() {
        let turn = (33.0, [1.0, 2.0, 3.0]);
        let scale = [1.0, 4.0, 1.0];
        let m = Transform {
            scale,
            turn,
            ..Transform::default()
        }
        .matrix();
        let (normals, _) = m.inverse_transpose().expect("invertible");
        let [x, y, z, _] = normals.apply(&[1.0, 1.0, 0.0, 0.0]);
        for edge in [[1.0, -1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] {
            let [a, b, c, _] = m.apply(&edge);
            assert!(dot([x, y, z], [a, b, c]).abs() < 1e-12);
        }
    }

    #[test]
    fn i09_2_two_points_by_hand() {
        let material = Material {
            diffuse: [0.8, 0.6, 0.4, 1.0],
            ..Material::default()
        };
        let at_the_eye = Light {
            position: [0.0; 3],
            color: [0.5; 3],
        };
        near(
            material.lit(&[at_the_eye], [0.0, 0.0, -2.0], [0.0, 0.0, 1.0]),
            [0.9, 0.8, 0.7, 1.0],
        );
        let material = Material {
            diffuse: [0.8, 0.8, 0.8, 1.0],
            ..Material::default()
        };
        let light = Light {
            position: [0.0, 2.0, -1.0],
            color: [1.0; 3],
        };
        let once = material.lit(&[light], [0.0, 0.0, -3.0], [0.0, 0.6, 0.8]);
        near(once, [0.914001, 0.914001, 0.914001, 1.0]);
        // Normals of any length, and a sum over lights with no clamp.
        let twice = material.lit(&[light; 2], [0.0, 0.0, -3.0], [0.0, 1.2, 1.6]);
        near(twice, [1.828002, 1.828002, 1.828002, 1.0]);
    }

    #[test]
    fn i09_2_a_light_behind_the_surface_gives_nothing() {
        let behind = Light {
            position: [0.0, 0.0, -5.0],
            color: [1.0; 3],
        };
        let emission = [0.1, 0.2, 0.3];
        let material = Material {
            emission,
            ..Material::default()
        };
        near(
            material.lit(&[behind], [0.0, 0.0, -2.0], [0.0, 0.0, 1.0]),
            [0.1, 0.2, 0.3, 1.0],
        );
    }

    #[test]
    fn i09_3_alpha_of_texture_and_material() {
        let diffuse = [1.0, 1.0, 1.0, 0.8];
        let material = Material {
            diffuse,
            ..Material::default()
        }
        .textured([0.5; 4]);
        near(material.diffuse, [0.5, 0.5, 0.5, 0.4]);
        assert_eq!(material.lit(&[], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0])[3], 0.4);
    }
}
