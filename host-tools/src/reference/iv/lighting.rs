//! The lighting function (formats/iv.md, Lighting).

use crate::reference::matrix::{dot, unit_or_zero};
use crate::scene::iv::{Light, Material};

/// What a point's colour depends on, besides itself.
#[derive(Debug, Clone, Copy)]
pub struct Lighting<'a> {
    /// Of the surface.
    pub material: &'a Material,
    /// All that shine.
    pub lights: &'a [Light],
    /// The camera's position.
    pub eye: [f64; 3],
}

impl Lighting<'_> {
    /// Red, green, blue from 0 to 1 of the point `at` with a unit normal, both in the world.
    pub fn color(&self, at: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
        let (mut diffuse, mut specular) = ([0.0; 3], [0.0; 3]);
        let to_eye = unit_or_zero(minus(self.eye, at));
        for light in self.lights {
            let to_light = unit_or_zero(minus(light.location, at));
            let half = unit_or_zero(plus(to_eye, to_light));
            let cosine = dot(normal, to_light);
            // Rounding must not make a cosine more than 1: a large shininess would make much of it.
            let highlight = dot(normal, half).clamp(0.0, 1.0).powf(self.material.shininess);
            for i in 0..3 {
                diffuse[i] += f64::max(0.0, light.color[i] * cosine);
                specular[i] += f64::max(0.0, light.color[i] * highlight);
            }
        }
        let Material {
            ambient: a,
            diffuse: d,
            specular: s,
            ..
        } = self.material;
        // A sum of lights beyond the largest number would be infinite, and nothing times that no number.
        [0, 1, 2].map(|i| {
            f64::min(
                1.0,
                a[i] + f64::min(1.0, diffuse[i]) * d[i] + specular[i].min(f64::MAX) * s[i],
            )
        })
    }
}

fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: [f64; 3] = [0.0, 0.0, 1.0];

    fn light(location: [f64; 3], color: [f64; 3]) -> Light {
        Light { location, color }
    }

    /// The colour of the origin seen from (0, 0, 1).
    fn color(material: Material, lights: &[Light], normal: [f64; 3]) -> [f64; 3] {
        let eye = UP;
        let material = &material;
        (Lighting { material, lights, eye }).color([0.0; 3], normal)
    }

    const BLACK: Material = Material {
        ambient: [0.0; 3],
        diffuse: [0.0; 3],
        specular: [0.0; 3],
        shininess: 1.0,
    };

    #[test]
    fn without_lights_the_ambient_part_is_left() {
        let ambient = [0.25, 0.5, 1.0];
        assert_eq!(color(Material { ambient, ..BLACK }, &[], UP), ambient);
    }

    #[test]
    fn the_diffuse_part_is_the_cosine() {
        let material = Material {
            diffuse: [1.0, 0.5, 0.0],
            ..BLACK
        };
        let shines = |location, normal| color(material, &[light(location, [1.0; 3])], normal);
        assert_eq!(shines([0.0, 0.0, 7.0], UP), [1.0, 0.5, 0.0]);
        assert_eq!(shines([0.0, 3.0, 4.0], UP), [0.8, 0.4, 0.0]);
        assert_eq!(shines([0.0, 3.0, -4.0], UP), [0.0; 3]);
        assert_eq!(shines([0.0; 3], UP), [0.0; 3], "a light at the point has no direction");
        assert_eq!(shines([0.0, 0.0, 7.0], [0.0; 3]), [0.0; 3], "nor has a zero normal");
    }

    #[test]
    fn the_diffuse_sum_is_clamped_before_the_material() {
        let diffuse = [0.5; 3];
        let lights = [light(UP, [3.0, 0.2, 0.0]), light(UP, [3.0, 0.2, 0.0])];
        assert_eq!(color(Material { diffuse, ..BLACK }, &lights, UP), [0.5, 0.2, 0.0]);
    }

    #[test]
    fn the_specular_sum_is_not() {
        let specular = [0.25; 3];
        let lights = [light(UP, [2.0, 1.0, 0.0]), light(UP, [1.0, 8.0, 0.0])];
        assert_eq!(color(Material { specular, ..BLACK }, &lights, UP), [0.75, 1.0, 0.0]);
    }

    #[test]
    fn a_negative_light_takes_nothing_away() {
        let material = Material {
            diffuse: [1.0; 3],
            specular: [1.0; 3],
            ..BLACK
        };
        let (half, negative) = (light(UP, [0.125; 3]), light(UP, [-1.0, 0.25, -1.0]));
        assert_eq!(color(material, &[half, negative], UP), [0.25, 0.75, 0.25]);
        // Its diffuse part does shine from behind: the product is positive.
        let behind = light([0.0, 0.0, -1.0], [-0.5, 0.5, 0.0]);
        let diffuse = Material {
            specular: [0.0; 3],
            ..material
        };
        assert_eq!(color(diffuse, &[behind], UP), [0.5, 0.0, 0.0]);
    }

    #[test]
    fn a_highlight_does_not_care_where_the_light_is() {
        let material = Material {
            specular: [1.0; 3],
            shininess: 2.0,
            ..BLACK
        };
        // The light is just behind the surface, and half way between it and the eye is not: k^2 = (1 - 0.6) / 2.
        let grazing = light([0.8, 0.0, -0.6], [1.0; 3]);
        let [red, ..] = color(material, &[grazing], UP);
        assert!((red - 0.2).abs() < 1e-15, "{red}");
    }

    #[test]
    fn nothing_to_the_power_of_nothing_is_1() {
        let material = Material {
            specular: [0.5; 3],
            shininess: 0.0,
            ..BLACK
        };
        // Opposite the eye: there is no direction half way, and k is 0.
        let opposite = light([0.0, 0.0, -1.0], [1.0; 3]);
        assert_eq!(color(material, &[opposite], UP), [0.5; 3]);
        let shininess = 1e-9;
        assert_eq!(color(Material { shininess, ..material }, &[opposite], UP), [0.0; 3]);
    }

    #[test]
    fn enormous_numbers_do_no_harm() {
        let bright = light(UP, [1e308; 3]);
        let material = Material {
            diffuse: [0.5; 3],
            specular: [1.0, 0.0, 0.0],
            shininess: 1e308,
            ..BLACK
        };
        assert_eq!(color(material, &[bright; 3], UP), [1.0, 0.5, 0.5]);
        let far = light([0.0, 1e300, 1e300], [1.0; 3]);
        let [_, green, _] = color(material, &[far], UP);
        assert!((green - 0.5f64.sqrt() / 2.0).abs() < 1e-15, "{green}");
    }
}
