//! Whatever finite numbers an MP1 scene holds, the reference ends quickly with a picture, and never panics.

use std::fmt::Write;
use std::sync::Arc;

use fixel_host::picture::Picture;
use fixel_host::reference::mp1::draw;
use fixel_host::scene::mp1::parse_with;
use proptest::prelude::*;

/// Numbers of every kind: ordinary, enormous, tiny, and round ones that meet.
fn number() -> impl Strategy<Value = f64> {
    let finite = any::<f64>().prop_filter("finite", |v| v.is_finite());
    let round = (-4i32..=4).prop_map(f64::from);
    prop_oneof![
        finite,
        round,
        -2.0..2.0,
        Just(f64::MAX),
        Just(f64::MIN),
        Just(5e-324),
        Just(1e12),
        Just(-1e12)
    ]
}

const SWITCHES: [&str; 7] = ["depth", "sRGB", "hyp", "frustum", "cull", "decals", "fsaa 3"];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]
    #[test]
    fn any_scene_ends_with_a_picture(
        switches in proptest::collection::vec(any::<bool>(), SWITCHES.len()),
        plane in proptest::option::of(proptest::array::uniform4(number())),
        vertices in proptest::collection::vec((proptest::array::uniform9(number()), 0.0..=1.0), 6),
        size in number(),
    ) {
        let mut text = String::from("png 9 7 a.png\n");
        for (name, _) in SWITCHES.into_iter().zip(switches).filter(|(_, on)| *on) {
            writeln!(text, "{name}")?;
        }
        if let Some([a, b, c, d]) = plane {
            writeln!(text, "clipplane {a:e} {b:e} {c:e} {d:e}")?;
        }
        text += "texture t.png\n";
        for ([x, y, z, w, r, g, b, s, t], alpha) in vertices {
            writeln!(text, "rgba {r:e} {g:e} {b:e} {alpha:e}\ntexcoord {s:e} {t:e}\nxyzw {x:e} {y:e} {z:e} {w:e}")?;
        }
        let size = size.abs();
        text += "tri 1 2 3\ntrit 4 5 6\ntri 1 4 2\nline 1 2\nline 3 6\nwuline 3 4\nwuline 5 1\n";
        writeln!(text, "point {size:e} 5\ncircle {size:e} 6\nbillboard {size:e} 1")?;
        let texture = Arc::new(Picture::new(3, 2, vec![[255, 128, 0, 77]; 6]));
        let scene = parse_with(text.as_bytes(), &mut |_| Ok(Arc::clone(&texture)));
        let scene = scene.map_err(|fault| TestCaseError::fail(format!("{fault}\n{text}")))?;
        let picture = draw(&scene);
        prop_assert!(picture.samples.iter().all(|sample| sample.rgba().iter().all(|v| v.is_finite())));
        prop_assert_eq!(picture.bytes().len(), 63);
    }
}

#[test]
fn a_thousand_enormous_primitives_take_no_longer_than_small_ones() {
    let mut text =
        String::from("png 16 16 a.png\nxyzw -1e12 -1e11 0 1\nxyzw 2e12 -1e12 0 1\nxyzw 1e12 3e12 0 1\nxyzw 0 0 0 1\n");
    for _ in 0..1000 {
        text += "tri 1 2 3\ntri 2 3 4\nline 1 3\nline 2 4\nwuline 1 2\nwuline 4 3\npoint 1e300 4\ncircle 1e150 4\n";
    }
    let scene = parse_with(text.as_bytes(), &mut |_| Err(String::new())).expect("a good scene");
    assert!(draw(&scene).samples.iter().all(|sample| sample.primitive == 8000));
}
