//! Whatever finite numbers an Inventor scene holds, both back ends end quickly and never panic: with a picture, or the core with a
//! fault that says what does not fit.

use std::cell::Cell;

use fixel_host::compare;
use fixel_host::fixed;
use fixel_host::reference;
use fixel_host::scene::iv::{
    Camera, Corner, Face, Light, Material, Model, Object, Rotation, Scene, Shading, Transform,
};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

/// Numbers of every kind: ordinary, enormous, tiny, and round ones that meet.
fn number() -> impl Strategy<Value = f64> {
    let finite = any::<f64>().prop_filter("finite", |v| v.is_finite());
    let power = (-300.0..300.0f64, any::<bool>()).prop_map(|(e, minus)| 10f64.powf(e) * if minus { -1.0 } else { 1.0 });
    let round = (-4i32..=4).prop_map(f64::from);
    prop_oneof![
        1 => finite,
        1 => power,
        12 => round,
        12 => -3.0..3.0f64,
        1 => Just(f64::MAX),
        1 => Just(1e300),
        1 => Just(-1e-300),
        1 => Just(5e-324)
    ]
}

fn triple() -> impl Strategy<Value = [f64; 3]> {
    proptest::array::uniform3(number())
}

fn unit() -> impl Strategy<Value = [f64; 3]> {
    proptest::array::uniform3(0.0..=1.0)
}

/// As the grammar lets through: no axis of 0 with an angle.
fn rotation() -> impl Strategy<Value = Rotation> {
    // From 2^60 radians on the core knows no angle.
    let angle = prop_oneof![30 => -10.0..10.0, 1 => number()];
    (triple(), angle).prop_map(|(axis, angle)| Rotation {
        axis,
        angle: if axis == [0.0; 3] { 0.0 } else { angle },
    })
}

fn camera() -> impl Strategy<Value = Camera> {
    let window = proptest::array::uniform4(number());
    (triple(), rotation(), window, [number(), number()]).prop_filter_map(
        "a camera",
        |(position, orientation, [left, right, bottom, top], [a, b])| {
            let (near, far) = (a.abs().min(b.abs()), a.abs().max(b.abs()));
            let good = near > 0.0 && near < far && left != right && bottom != top;
            good.then_some(Camera {
                position,
                orientation,
                near,
                far,
                left,
                right,
                bottom,
                top,
            })
        },
    )
}

fn transform() -> impl Strategy<Value = Transform> {
    (triple(), rotation(), triple()).prop_map(|(translation, rotation, scale)| Transform {
        translation,
        rotation,
        scale_factor: scale.map(|s| if s == 0.0 { 1.0 } else { s }),
    })
}

fn object() -> impl Strategy<Value = Object> {
    let shininess = prop_oneof![30 => 0.0..1e4f64, 1 => number()];
    let material =
        (unit(), unit(), unit(), shininess).prop_map(|(ambient, diffuse, specular, shininess): (_, _, _, f64)| {
            Material {
                ambient,
                diffuse,
                specular,
                shininess: shininess.abs(),
            }
        });
    let corner = || (0..6usize, 0..4usize).prop_map(|(point, normal)| Corner { point, normal });
    let face = proptest::collection::vec(corner(), 3..=6).prop_map(|corners| Face { corners });
    (
        proptest::collection::vec(transform(), 0..3),
        material,
        proptest::collection::vec(triple(), 6),
        proptest::collection::vec(triple(), 4),
        proptest::collection::vec(face, 1..6),
    )
        .prop_map(|(transforms, material, points, normals, faces)| Object {
            transforms,
            material,
            points,
            normals,
            faces,
        })
}

fn light() -> impl Strategy<Value = Light> {
    (triple(), triple()).prop_map(|(location, color)| Light { location, color })
}

fn scene() -> impl Strategy<Value = Scene> {
    let shading = prop::sample::select(&[Shading::Flat, Shading::Gouraud, Shading::Phong][..]);
    let lights = proptest::collection::vec(light(), 0..4);
    let objects = proptest::collection::vec(object(), 1..4);
    (camera(), lights, objects, any::<bool>(), 1u32..40, shading).prop_map(
        |(camera, lights, objects, eyelight, width, shading)| Scene {
            width,
            height: 23,
            output: "o.png".into(),
            shading,
            eyelight,
            model: Model {
                camera,
                lights,
                objects,
            },
        },
    )
}

#[test]
fn any_scene_ends() {
    let (drawn, covered) = (Cell::new(0), Cell::new(0));
    let mut runner = TestRunner::new(ProptestConfig::with_cases(1000));
    let ended = runner.run(&scene(), |scene| {
        let reference = reference::iv::draw(&scene);
        let finite = |pixel: &reference::Pixel| pixel.color.iter().all(|c| c.is_finite());
        prop_assert!(reference.pixels.iter().all(finite));
        match fixed::iv::draw(&scene) {
            // What the comparison says is another matter: nothing is known of numbers that overflow.
            Ok(fixed) => {
                let comparison = compare::iv::compare(&scene, &fixed, &reference);
                prop_assert_eq!(comparison.classes.len(), fixed.pixels.len());
                drawn.set(drawn.get() + 1);
                covered.set(covered.get() + u32::from(comparison.pixels_drawn > 0));
            }
            Err(fault) => prop_assert!(!fault.to_string().is_empty()),
        }
        Ok(())
    });
    ended.unwrap_or_else(|e| panic!("{e}"));
    let (drawn, covered) = (drawn.get(), covered.get());
    println!("{drawn} of 1000 scenes drawn, {covered} of them show something");
    assert!(drawn > 500 && covered > 20, "{drawn} scenes drawn, {covered} not empty");
}
