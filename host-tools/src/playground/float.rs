//! The playground drawn with the float64 pipeline.

use super::scene::{self, Object, Texture};
use super::texture::Textures;
use crate::reference::matrix::Matrix;
use crate::reference::pipeline::camera::{Transform, look_at, perspective};
use crate::reference::pipeline::light::{Light, Material};
use crate::reference::pipeline::order::{self, draw_scene};
use crate::reference::pipeline::program::{Colors, NORMAL, UV, VERTEX, Values};
use crate::reference::pipeline::sample::{Filter, Sampler};
use crate::reference::pipeline::state::{Face, Viewport};
use crate::reference::pipeline::{Framebuffer, Geometry, Image, Program, State, Topology};

/// Where a point is in view space.
const POSITION: &str = "view position";

/// What an object's program is given.
struct Uniforms {
    model_view: Matrix,
    normals: Matrix,
    projection: Matrix,
    material: Material,
    texture: Option<(Image<4>, Sampler)>,
    lights: Vec<Light>,
}

/// Point lights on a surface with or without a texture.
struct Lit;

impl Program for Lit {
    type Uniforms = Uniforms;

    fn vertex(&self, attributes: &Values, uniforms: &Uniforms, outputs: &mut Values) -> [f64; 4] {
        let [x, y, z] = vector(attributes, VERTEX);
        let position = uniforms.model_view.apply(&[x, y, z, 1.0]);
        let [x, y, z] = vector(attributes, NORMAL);
        let normal = uniforms.normals.apply(&[x, y, z, 0.0]);
        outputs.insert(POSITION, position[..3].to_vec());
        outputs.insert(NORMAL, normal[..3].to_vec());
        outputs.insert(UV, attributes[UV].clone());
        uniforms.projection.apply(&position)
    }

    fn fragment(&self, _at: [f64; 4], inputs: &Values, uniforms: &Uniforms, colors: &mut Colors) -> bool {
        let uv = vector(inputs, UV);
        let texture = uniforms.texture.as_ref();
        let texel = texture.and_then(|(image, sampler)| sampler.sample(image, uv));
        let material = texel.map_or(uniforms.material, |texel| uniforms.material.textured(texel));
        let [position, normal] = [POSITION, NORMAL].map(|key| vector(inputs, key));
        colors.insert(0, material.lit(&uniforms.lights, position, normal));
        true
    }
}

/// A value of as many components as are asked for; the scene's values have them.
fn vector<const N: usize>(values: &Values, key: &str) -> [f64; N] {
    std::array::from_fn(|i| values[key][i])
}

/// The picture and its depths.
pub fn draw(textures: &Textures) -> Framebuffer {
    let mut framebuffer = Framebuffer::new(scene::WIDTH, scene::HEIGHT, scene::CLEAR);
    let mut state = State::new(Viewport::of(scene::WIDTH, scene::HEIGHT));
    state.depth.test = true;
    state.cull = Some(Face::Back);
    let objects = scene::OBJECTS.map(|object| placed(&object, textures));
    draw_scene(&mut framebuffer, &state, &Lit, &objects);
    framebuffer
}

fn placed(object: &Object, textures: &Textures) -> order::Object<Uniforms> {
    let &Object {
        position, scale, turn, ..
    } = object;
    let view = look_at(scene::EYE, scene::CENTER, scene::UP);
    let model_view = view.times(&Transform { position, scale, turn }.matrix());
    let (normals, _) = model_view.inverse_transpose().expect("no scale of the scene is 0");
    let uniforms = Uniforms {
        model_view,
        normals,
        projection: perspective(scene::FIELD_OF_VIEW, scene::ASPECT, scene::NEAR, scene::FAR),
        material: Material {
            diffuse: object.color,
            specular: scene::SPECULAR,
            shininess: f64::from(scene::SHININESS),
            emission: [0.0; 3],
        },
        texture: object.texture.map(|texture| image(texture, textures)),
        lights: lights(&view),
    };
    order::Object {
        geometry: geometry(object),
        model_view,
        uniforms,
        transparent: object.transparent,
    }
}

fn geometry(object: &Object) -> Geometry {
    let corners = object.shape.iter();
    Geometry::new(Topology::Triangles, corners.clone().map(|c| c.position.map(f64::from)))
        .with(NORMAL, corners.clone().map(|c| c.normal.map(f64::from)))
        .with(UV, corners.map(|c| c.uv.map(f64::from)))
}

fn image(texture: Texture, textures: &Textures) -> (Image<4>, Sampler) {
    let texels = textures.texels(texture);
    let size = texels.size;
    let image = Image::from_fn(size, size, |x, y| texels.colors[(y * size + x) as usize]);
    let filter = match texture {
        Texture::Board | Texture::Random => Filter::Nearest,
        Texture::Frost => Filter::Linear,
    };
    (
        image,
        Sampler {
            filter,
            ..Sampler::default()
        },
    )
}

fn lights(view: &Matrix) -> Vec<Light> {
    let lights = scene::LIGHTS.iter().map(|&scene::Light([x, y, z], color)| {
        let [x, y, z, _] = view.apply(&[x, y, z, 1.0]);
        let position = [x, y, z];
        Light { position, color }
    });
    lights.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pg_single_pixels_and_depths() {
        let framebuffer = draw(&Textures::fixed());
        let picture = framebuffer.colors[&0].picture();
        let depths = framebuffer.depth.expect("attached");
        let expected = [
            (200, 240, [255, 255, 255], 0.945992),
            (20, 150, [165, 24, 33], 0.923197),
            (380, 100, [44, 194, 62], 0.922764),
            (120, 60, [17, 17, 149], 0.966214),
            (60, 260, [35, 35, 35], 0.896702),
        ];
        for (column, row, [r, g, b], z) in expected {
            assert_eq!(picture.pixels[row * 400 + column], [r, g, b, 255], "{column} {row}");
            let [found] = depths.get(column as i64, 299 - row as i64).expect("inside");
            assert!((found - z).abs() < 1e-6, "{column} {row}: {found}");
        }
    }
}
