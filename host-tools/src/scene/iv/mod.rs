//! An Inventor scene: a camera, lights, and objects of convex faces.

mod check;
mod faces;
mod grammar;
mod lex;
mod parser;

pub use grammar::parse;

/// A model and the picture to make of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Width of the picture in pixels, 1 to 16384.
    pub width: u32,
    /// Height of the picture in pixels, 1 to 16384; at most 2^26 pixels in all.
    pub height: u32,
    /// The picture's file name; relative, inside the folder.
    pub output: String,
    /// How faces get their colours.
    pub shading: Shading,
    /// Whether a dim light at the camera is added to the model's own.
    pub eyelight: bool,
    /// What the text says.
    pub model: Model,
}

impl Scene {
    /// The lights that shine: the model's, and last the eyelight if it is on. That is grey, 0.15 times the largest
    /// colour component among the others, or 0.15 if there are none.
    pub fn lights(&self) -> Vec<Light> {
        let mut lights = self.model.lights.clone();
        if self.eyelight {
            let components = lights.iter().flat_map(|light| light.color);
            let largest = components.reduce(f64::max).unwrap_or(1.0);
            lights.push(Light {
                location: self.model.camera.position,
                color: [0.15 * largest; 3],
            });
        }
        lights
    }
}

/// Where the lighting function is evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Shading {
    /// Once for a face.
    Flat,
    /// At the corners; the colours are interpolated linearly over the screen.
    Gouraud,
    /// At every pixel; position and normal are interpolated in perspective.
    Phong,
}

/// What a text says: all numbers finite, all indices valid.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// The camera.
    pub camera: Camera,
    /// The lights in file order.
    pub lights: Vec<Light>,
    /// The Separators in file order.
    pub objects: Vec<Object>,
}

/// `rotation`, `orientation`: a turn, counter-clockwise seen against the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rotation {
    /// Of any length; 0 only if the angle is 0.
    pub axis: [f64; 3],
    /// In radians.
    pub angle: f64,
}

impl Default for Rotation {
    fn default() -> Self {
        Self {
            axis: [0.0, 0.0, 1.0],
            angle: 0.0,
        }
    }
}

/// `PerspectiveCamera`: looks along its own -z with +y up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub position: [f64; 3],
    /// How it is turned.
    pub orientation: Rotation,
    /// Distance of the near plane, above 0.
    pub near: f64,
    /// Distance of the far plane, above `near`.
    pub far: f64,
    /// Left edge of the window on the near plane.
    pub left: f64,
    /// Right edge of the window; not `left`.
    pub right: f64,
    /// Bottom edge of the window.
    pub bottom: f64,
    /// Top edge of the window; not `bottom`.
    pub top: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            position: [0.0, 0.0, 1.0],
            orientation: Rotation::default(),
            near: 1.0,
            far: 10.0,
            left: -1.0,
            right: 1.0,
            bottom: -1.0,
            top: 1.0,
        }
    }
}

/// The most lights: what the core has room for beside that of the eye.
pub const MOST_LIGHTS: usize = 1024;

/// `PointLight`: does not fade with the distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Where it stands in the world.
    pub location: [f64; 3],
    /// Red, green, blue; 1 is full; not clamped.
    pub color: [f64; 3],
}

impl Default for Light {
    fn default() -> Self {
        Self {
            location: [0.0, 0.0, 1.0],
            color: [1.0; 3],
        }
    }
}

/// `Separator`: faces, and what is needed to draw them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Object {
    /// From the outermost to the one that is applied to the points first.
    pub transforms: Vec<Transform>,
    /// What the faces are made of.
    pub material: Material,
    /// Positions before the transforms.
    pub points: Vec<[f64; 3]>,
    /// Directions before the transforms, of any length.
    pub normals: Vec<[f64; 3]>,
    /// The faces, in drawing order.
    pub faces: Vec<Face>,
}

impl Object {
    /// The points that faces refer to, each once: others are not drawn, and lie as far away as they like.
    pub fn used(&self) -> Vec<[f64; 3]> {
        let mut used = vec![false; self.points.len()];
        for corner in self.faces.iter().flat_map(|face| &face.corners) {
            used[corner.point] = true;
        }
        let points = self.points.iter().zip(used);
        points.filter_map(|(&point, used)| used.then_some(point)).collect()
    }
}

/// `Transform`: points are scaled, then turned, then moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// Moves.
    pub translation: [f64; 3],
    /// Turns.
    pub rotation: Rotation,
    /// Scales along the axes; no component is 0.
    pub scale_factor: [f64; 3],
}

impl Default for Transform {
    fn default() -> Self {
        Self {
            translation: [0.0; 3],
            rotation: Rotation::default(),
            scale_factor: [1.0; 3],
        }
    }
}

/// `Material`: colours from 0 to 1, clamped when read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Shines by itself.
    pub ambient: [f64; 3],
    /// Times the light from all sides.
    pub diffuse: [f64; 3],
    /// Times the highlights.
    pub specular: [f64; 3],
    /// The highlights' exponent, 0 or more.
    pub shininess: f64,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            ambient: [0.2; 3],
            diffuse: [0.8; 3],
            specular: [0.0; 3],
            shininess: 0.2,
        }
    }
}

/// A corner of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner {
    /// Index into [`Object::points`].
    pub point: usize,
    /// Index into [`Object::normals`].
    pub normal: usize,
}

/// A face, convex and planar if the text keeps its word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Face {
    /// Three or more, counter-clockwise seen from the front.
    pub corners: Vec<Corner>,
}

impl Face {
    /// How many triangles it is drawn as. Primitives are numbered by them, drawn or not, from 1 over all objects.
    pub fn triangles(&self) -> usize {
        self.corners.len() - 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(eyelight: bool, colors: &[[f64; 3]]) -> Scene {
        let light = |&color: &[f64; 3]| Light {
            color,
            ..Light::default()
        };
        Scene {
            width: 1,
            height: 1,
            output: "o.png".into(),
            shading: Shading::Flat,
            eyelight,
            model: Model {
                camera: Camera {
                    position: [1.0, 2.0, 3.0],
                    ..Camera::default()
                },
                lights: colors.iter().map(light).collect(),
                objects: Vec::new(),
            },
        }
    }

    #[test]
    fn the_eyelight_follows_the_brightest_component() {
        for (colors, grey) in [
            (&[][..], 0.15),
            (&[[0.5, 0.25, 0.0], [0.0, 2.0, -3.0]], 0.3),
            (&[[-1.0, -2.0, -4.0]], -0.15),
            (&[[0.0; 3]], 0.0),
        ] {
            assert_eq!(scene(false, colors).lights().len(), colors.len());
            let lights = scene(true, colors).lights();
            assert_eq!(lights.len(), colors.len() + 1);
            let eyelight = Light {
                location: [1.0, 2.0, 3.0],
                color: [grey; 3],
            };
            assert_eq!(lights.last(), Some(&eyelight));
        }
    }
}
