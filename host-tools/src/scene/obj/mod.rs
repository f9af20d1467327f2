//! A Wavefront mesh as a scene: a look at the whole of it from the front, from the left and from above.
//!
//! The reader is our own: the loaders there are do not tell where a fault stands, and a corner without a normal gets that
//! of the corner before it. It reads `v`, `vn` and `f`, the faces convex as everywhere here, and passes over all other
//! statements: texture coordinates, groups, materials, lines, points, free-form surfaces. So every mesh is of the default
//! material. A corner without a normal gets its face's.
//!
//! A mesh may have any size and stand anywhere: it is moved and scaled so that it just fits into the sphere of radius 1
//! about the origin, and camera and light stand where that is looked at well.

mod mesh;

use super::Fault;
use super::iv::{Camera, Light, Model, Object, Rotation};
use super::size::Size;
use mesh::Mesh;

/// How far the camera stands from the middle of the mesh, in radii of its sphere.
const DISTANCE: f64 = 4.0;
/// How far the camera is turned to the left of the mesh's front, which is +z, in radians.
const YAW: f64 = -0.6;
/// How far it is turned down, in radians.
const PITCH: f64 = -0.4;
/// How much larger than the sphere the window is, and how much farther than it the planes are apart.
const MARGIN: f64 = 1.05;

/// Parses a mesh. The camera's window has the shape of a picture of `size`, so that the mesh is not distorted.
///
/// # Errors
/// The first fault of the text. Of a text without faces, or whose faces are all one point, it is
/// [of the whole](Fault::whole).
pub fn parse(text: impl AsRef<[u8]>, size: Size) -> Result<Model, Fault> {
    let text = String::from_utf8_lossy(text.as_ref());
    let mesh = Mesh::read(&text)?.framed()?;
    Ok(Model {
        camera: camera(size),
        // Left of the camera and above it, so that faces of different directions differ in colour.
        lights: vec![Light {
            location: turned([-1.5, 1.5, DISTANCE]),
            color: [1.0; 3],
        }],
        objects: vec![mesh.object()],
    })
}

impl Mesh {
    fn object(self) -> Object {
        let (normals, faces) = self.normals_and_faces();
        Object {
            points: self.points,
            normals,
            faces,
            ..Object::default()
        }
    }
}

/// The camera that looks at the sphere of radius 1 about the origin. The sphere fits into the shorter side of the window.
fn camera(size: Size) -> Camera {
    let near = DISTANCE - MARGIN;
    // The cone about the sphere: its sine is 1 / DISTANCE.
    let half = MARGIN * near / (DISTANCE * DISTANCE - 1.0).sqrt();
    let [width, height] = [size.width(), size.height()].map(f64::from);
    let (right, top) = (half * (width / height).max(1.0), half * (height / width).max(1.0));
    Camera {
        position: turned([0.0, 0.0, DISTANCE]),
        orientation: orientation(),
        near,
        far: DISTANCE + MARGIN,
        left: -right,
        right,
        bottom: -top,
        top,
    }
}

/// From the camera's axes to the world's: turned about x by the pitch, then about y by the yaw.
fn turned([x, y, z]: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = PITCH.sin_cos();
    let [y, z] = [y * cos - z * sin, y * sin + z * cos];
    let (sin, cos) = YAW.sin_cos();
    [x * cos + z * sin, y, z * cos - x * sin]
}

/// The same turn about one axis: the product of the two turns as quaternions.
fn orientation() -> Rotation {
    let ((sin_yaw, cos_yaw), (sin_pitch, cos_pitch)) = ((YAW / 2.0).sin_cos(), (PITCH / 2.0).sin_cos());
    Rotation {
        axis: [cos_yaw * sin_pitch, sin_yaw * cos_pitch, -sin_yaw * sin_pitch],
        angle: 2.0 * (cos_yaw * cos_pitch).acos(),
    }
}

#[cfg(test)]
mod tests;
