//! Which settings of the dials a scene is drawn with.

use crate::emit::{self, Depth};
use crate::fixed::dials::{CHANGES, Change, Dial, Dials, Tier};
use crate::scene::hw2::{Action, Fill};
use crate::scene::iv::Shading;
use crate::scene::mp1::Shape;
use crate::scene::{Scene, hw2, iv, mp1};

/// A setting by name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    /// A tier, or `exact` with one dial turned.
    pub name: String,
    /// The dials.
    pub dials: Dials,
}

impl Setting {
    fn tier(tier: Tier) -> Self {
        Setting {
            name: tier.to_string(),
            dials: Dials::of(tier),
        }
    }

    fn change(change: &Change) -> Self {
        Setting {
            name: format!("{}+{}", Tier::Exact, change.name),
            dials: change.of(Dials::default()),
        }
    }
}

/// Of a tier, or of a dial turned alone, by its name.
pub fn setting(name: &str) -> Option<Setting> {
    let tiers = [Tier::Fast, Tier::Balanced, Tier::Exact].map(Setting::tier);
    let changes = CHANGES.iter().map(Setting::change);
    tiers.into_iter().chain(changes).find(|setting| setting.name == name)
}

/// The three tiers, and each dial turned alone that does something for the scene. Dials that do nothing are left as for exact, so
/// that equal dials mean equal draws.
pub fn settings(scene: &Scene) -> Vec<Setting> {
    let (live, idle): (Vec<Dial>, Vec<Dial>) = Dial::ALL.into_iter().partition(|&dial| matters(dial, scene));
    let tiers = [Tier::Exact, Tier::Balanced, Tier::Fast].map(Setting::tier);
    let changes = CHANGES.iter().filter(|change| live.contains(&change.dial));
    let settings = tiers.into_iter().chain(changes.map(Setting::change));
    settings
        .map(|setting| Setting {
            dials: idle.iter().copied().fold(setting.dials, Dials::without),
            ..setting
        })
        .collect()
}

/// Whether the core asks for the dial when it draws the scene.
fn matters(dial: Dial, scene: &Scene) -> bool {
    if !has_something(scene) {
        return false;
    }
    match (dial, scene) {
        (Dial::Output, _) => true,
        (Dial::Depth, scene) => is_in_order(scene),
        (Dial::Perspective, Scene::Hw2(scene)) => is_interpolated(scene) || is_lit(scene),
        (Dial::Perspective, Scene::Mp1(scene)) => scene.switches.hyp && has_values(scene),
        (Dial::Perspective | Dial::Lighting, Scene::Iv(scene)) => scene.shading == Shading::Phong,
        (Dial::Lighting | Dial::Precision, Scene::Hw2(scene)) => is_lit(scene),
        (Dial::Precision, Scene::Iv(scene)) => !scene.lights().is_empty(),
        (Dial::Trigonometry, Scene::Hw2(scene)) => is_turned(scene),
        (Dial::Trigonometry, Scene::Iv(scene)) => is_turned_iv(scene),
        (Dial::Colors, Scene::Iv(scene)) => scene.shading == Shading::Gouraud,
        (Dial::Sampling, Scene::Hw2(scene)) => fills(scene).any(|fill| fill == Fill::Textured),
        (Dial::Sampling, Scene::Mp1(scene)) => is_textured(scene),
        (Dial::StoredLight, Scene::Mp1(scene)) => scene.switches.srgb,
        _ => false,
    }
}

/// Whether anything is drawn.
fn has_something(scene: &Scene) -> bool {
    match scene {
        Scene::Hw2(scene) => fills(scene).next().is_some(),
        Scene::Mp1(scene) => !scene.primitives.is_empty(),
        Scene::Iv(scene) => scene.model.objects.iter().any(|object| !object.faces.is_empty()),
    }
}

/// Whether there is a depth buffer that changes nothing: nothing overlaps, or what is drawn later is nearer.
fn is_in_order(scene: &Scene) -> bool {
    matches!(emit::depth(scene), Ok(Depth::NoOverlap | Depth::InOrder))
}

/// Whether there is a rotation.
fn is_turned(scene: &hw2::Scene) -> bool {
    let turn = |command: &hw2::Command| matches!(command.action, Action::Rotate(..));
    scene.commands.iter().any(turn)
}

/// The same: by the camera, or an object.
fn is_turned_iv(scene: &iv::Scene) -> bool {
    let transforms = scene.model.objects.iter().flat_map(|object| &object.transforms);
    let mut angles = transforms.map(|transform| transform.rotation.angle);
    scene.model.camera.orientation.angle != 0.0 || angles.any(|angle| angle != 0.0)
}

/// What each primitive of a scene is filled with.
fn fills(scene: &hw2::Scene) -> impl Iterator<Item = Fill> {
    scene.commands.iter().filter_map(|command| match command.action {
        Action::Triangle(fill, _) | Action::RectPatch(fill, ..) | Action::TriPatch(fill, ..) => Some(fill),
        _ => None,
    })
}

fn is_interpolated(scene: &hw2::Scene) -> bool {
    fills(scene).any(|fill| fill != Fill::Flat)
}

/// Whether there is light.
fn is_lit(scene: &hw2::Scene) -> bool {
    let light = |command: &hw2::Command| matches!(command.action, Action::Sun(_) | Action::Bulb(_));
    scene.commands.iter().any(light)
}

fn is_textured(scene: &mp1::Scene) -> bool {
    let mut shapes = scene.primitives.iter().map(|primitive| &primitive.shape);
    shapes.any(|shape| matches!(shape, Shape::Textured(..) | Shape::Billboard(..)))
}

/// Whether anything has corners with values.
fn has_values(scene: &mp1::Scene) -> bool {
    scene.primitives.iter().any(|primitive| {
        matches!(
            primitive.shape,
            Shape::Triangle(_) | Shape::Textured(..) | Shape::Line(_) | Shape::WuLine(_)
        )
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn names(text: &str) -> Vec<String> {
        let scene = hw2::parse(text.as_bytes(), Path::new("")).expect("a scene");
        settings(&Scene::Hw2(scene)).into_iter().map(|s| s.name).collect()
    }

    #[test]
    fn only_dials_that_matter_are_turned() {
        let always = ["exact", "balanced", "fast"];
        let outputs = ["exact+output=565", "exact+output=565-dither", "exact+output=1-bit"];
        let perspectives = ["32-bit", "spans", "affine"].map(|name| format!("exact+perspective={name}"));
        let corners = "png 9 9 a.png\nxyz -1 -1 0\nxyz -1 1 0\nxyz 1 -1 0\n";
        let flat = names(&format!("{corners}trif 1 2 3\n"));
        assert_eq!(flat[..3], always);
        assert_eq!(flat[3..], [&["exact+depth=off"], &outputs[..]].concat());
        // The second triangle is behind the first.
        let behind = "xyz -1 -1 .5\nxyz -1 1 .5\nxyz 1 -1 .5\n";
        let hidden = names(&format!("{corners}trif 1 2 3\ncolor 1 0 0\n{behind}trif 4 5 6\n"));
        assert_eq!(hidden[3..], outputs);
        let gouraud = names(&format!("{corners}trig 1 2 3\n"));
        assert_eq!(gouraud[3..6], perspectives);
        assert!(
            !gouraud
                .iter()
                .any(|name| name.contains("lighting") || name.contains("precision"))
        );
        let lit = names(&format!("{corners}sunlight 0 0 1\ntrif 1 2 3\n"));
        for name in ["lighting=vertex", "precision=one-step", "precision=table"] {
            assert!(lit.contains(&format!("exact+{name}")), "{lit:?}");
        }
        assert!(!lit.iter().any(|name| name.contains("trigonometry")), "{lit:?}");
        let turned = names(&format!("{corners}rotatez 20\ntrif 1 2 3\n"));
        assert!(turned.contains(&"exact+trigonometry=short".to_owned()), "{turned:?}");
        // Light that shines on nothing, and a turn of nothing.
        assert_eq!(names(&format!("{corners}sunlight 0 0 1\nrotatez 20\n")), always);
    }

    #[test]
    fn dials_that_do_nothing_are_as_for_exact() {
        let text = b"png 9 9 a.png\nxyz -1 -1 0\nxyz -1 1 0\nxyz 1 -1 0\ntrig 1 2 3\n";
        let scene = hw2::parse(&text[..], Path::new("")).expect("a scene");
        let dials: Vec<Dials> = settings(&Scene::Hw2(scene)).into_iter().map(|s| s.dials).collect();
        // Without lights and rotations, balanced is words of 32 bits and nothing else, and fast is reciprocals from a table.
        assert_eq!(dials[1], dials[3]);
        assert_eq!(dials[2], dials[4]);
        assert_ne!(dials[1], dials[2]);
    }

    #[test]
    fn every_name_is_found_again_and_no_other() {
        for change in &CHANGES {
            let found = Setting::change(change);
            assert_ne!(found.dials, Dials::default(), "{}", found.name);
            assert_eq!(setting(&found.name), Some(found));
        }
        assert_eq!(setting("exact").map(|s| s.dials), Some(Dials::default()));
        assert_eq!(setting("fast").map(|s| s.dials), Some(Dials::of(Tier::Fast)));
        assert_eq!(setting("exact+"), None);
    }
}
