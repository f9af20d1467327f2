//! Which settings of the dials a scene is drawn with.

use crate::fixed::dials::{CHANGES, Change, Dial, Dials, Tier};
use crate::scene::hw2::{Action, Fill};
use crate::scene::iv::Shading;
use crate::scene::mp1::Shape;
use crate::scene::{Scene, hw2, mp1};

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
    let tiers = [Tier::Exact, Tier::Balanced, Tier::Fast].map(Setting::tier);
    let changes = CHANGES.iter().filter(|change| matters(change.dial, scene));
    let idle = || Dial::ALL.into_iter().filter(|&dial| !matters(dial, scene));
    let settings = tiers.into_iter().chain(changes.map(Setting::change));
    settings
        .map(|setting| Setting {
            dials: idle().fold(setting.dials, Dials::without),
            ..setting
        })
        .collect()
}

/// Whether the core asks for the dial when it draws the scene.
fn matters(dial: Dial, scene: &Scene) -> bool {
    match (dial, scene) {
        (Dial::Perspective, Scene::Hw2(scene)) => is_interpolated(scene) || is_lit(scene),
        (Dial::Perspective, Scene::Mp1(scene)) => scene.switches.hyp && has_values(scene),
        (Dial::Perspective | Dial::Lighting, Scene::Iv(scene)) => scene.shading == Shading::Phong,
        (Dial::Lighting, Scene::Hw2(scene)) => is_lit(scene),
        (Dial::StoredLight, Scene::Mp1(scene)) => scene.switches.srgb,
        _ => false,
    }
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

/// Whether there is light and something to shine on.
fn is_lit(scene: &hw2::Scene) -> bool {
    let light = |command: &hw2::Command| matches!(command.action, Action::Sun(_) | Action::Bulb(_));
    scene.commands.iter().any(light) && fills(scene).next().is_some()
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
        let tiers = ["exact", "balanced", "fast"];
        let corners = "png 9 9 a.png\nxyz -1 -1 0\nxyz -1 1 0\nxyz 1 -1 0\n";
        assert_eq!(names(&format!("{corners}trif 1 2 3\n")), tiers);
        let gouraud = names(&format!("{corners}trig 1 2 3\n"));
        assert!(gouraud.contains(&"exact+perspective=affine".to_owned()), "{gouraud:?}");
        assert!(!gouraud.contains(&"exact+lighting=vertex".to_owned()), "{gouraud:?}");
        let lit = names(&format!("{corners}sunlight 0 0 1\ntrif 1 2 3\n"));
        assert!(lit.contains(&"exact+lighting=vertex".to_owned()), "{lit:?}");
        let scene = hw2::parse(format!("{corners}trig 1 2 3\n").as_bytes(), Path::new("")).expect("a scene");
        let dials: Vec<Dials> = settings(&Scene::Hw2(scene)).into_iter().map(|s| s.dials).collect();
        // Without lights, balanced is words of 32 bits and nothing else, and fast is subspans.
        assert_eq!(dials[1], dials[3]);
        assert_eq!(dials[2], dials[4]);
        assert_ne!(dials[1], dials[2]);
        // Light that shines on nothing.
        assert_eq!(names(&format!("{corners}sunlight 0 0 1\n")), tiers);
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
