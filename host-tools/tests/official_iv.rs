//! The float64 reference against the pictures of the Inventor subset: those made in float64 from the same rules, and
//! the course's own, which are JPEG and have edges up to a pixel beside ours.
//!
//! The pictures are not ours to ship. `FIXEL_CONFORMANCE` names the folder that holds `MANIFEST-iv.tsv` and the files it
//! names; where it is set, every file must be there.

mod iv_pictures;

use fixel_host::picture::Picture;
use fixel_host::reference::Rendered;
use fixel_host::reference::iv::draw;
use iv_pictures::{Case, STEP, apart, cases, like_the_course, picture, scene};

#[test]
fn the_reference_agrees_with_every_picture() {
    let Some(cases) = cases() else {
        eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, no picture was compared");
        return;
    };
    let mut wrong = Vec::new();
    for case in &cases {
        let ours = drawn(case);
        let ours = Picture::new(ours.width, ours.height, ours.bytes());
        let theirs = picture(&case.reference);
        assert_eq!(ours.size(), theirs.size(), "{}: the size", case.name);
        let verdict = match &*case.kind {
            "oracle" => like_the_oracle(&ours, &theirs),
            "course" if case.name.starts_with("lion") => like_the_course(&ours, &theirs, STEP, 4.0),
            "course" => like_the_course(&ours, &theirs, STEP, 3.0),
            // No JPEG: inside of the flat triangles the colours are the very same, so every step is an edge.
            "course?" => like_the_course(&ours, &theirs, 0, 0.0),
            kind => panic!("{}: unknown kind {kind}", case.name),
        };
        println!("{}: {}", case.name, verdict.clone().unwrap_or_else(|figures| figures));
        wrong.extend(verdict.err().map(|figures| format!("{}: {figures}", case.name)));
    }
    println!("{} pictures compared", cases.len());
    assert!(!cases.is_empty() && wrong.is_empty(), "too far off: {wrong:?}");
}

/// Colours of the cube in flat mode, and of a corner in Gouraud mode, that the description has in a table.
#[test]
fn the_cubes_colors_are_those_of_the_table() {
    let Some(cases) = cases() else {
        eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, no colour was compared");
        return;
    };
    let named = |name: &str| {
        cases
            .iter()
            .find(|case| case.name == name)
            .expect("a case of this name")
    };
    let flat = drawn(named("cube3-flat"));
    let table = [
        (1, [51, 79, 51]),
        (2, [51, 255, 51]),
        (7, [93, 51, 51]),
        (8, [89, 51, 51]),
        (9, [51, 51, 255]),
        (10, [51, 51, 74]),
    ];
    let mut seen = [0; 13];
    for (pixel, [r, g, b, _]) in flat.pixels.iter().zip(flat.bytes()) {
        seen[pixel.primitive as usize] += 1;
        let expected = table.iter().find(|(primitive, _)| *primitive == pixel.primitive);
        assert_eq!([r, g, b], expected.map_or([0; 3], |(_, color)| *color));
    }
    assert!(
        table.iter().all(|(primitive, _)| seen[*primitive as usize] > 1000),
        "{seen:?}"
    );
    // The second triangle's corners are (51, 63, 51) twice and (51, 232, 51); pixels lie between them.
    let gouraud = drawn(named("cube3-gouraud"));
    let pixels = gouraud.pixels.iter().zip(gouraud.bytes());
    let greens = || {
        pixels
            .clone()
            .filter(|(pixel, _)| pixel.primitive == 2)
            .map(|(_, [r, g, b, _])| {
                assert_eq!([r, b], [51, 51]);
                g
            })
    };
    assert!(
        greens().min().is_some_and(|least| (63..=64).contains(&least)),
        "{:?}",
        greens().min()
    );
    assert!(
        greens().max().is_some_and(|most| (230..=232).contains(&most)),
        "{:?}",
        greens().max()
    );
}

fn drawn(case: &Case) -> Rendered<()> {
    draw(&scene(case))
}

/// Within one level, where rounding falls on either side of a whole number, but for 20 pixels, where it falls on either
/// side of an edge.
fn like_the_oracle(ours: &Picture, theirs: &Picture) -> Result<String, String> {
    let pairs = || ours.pixels.iter().zip(&theirs.pixels);
    let different = pairs().filter(|(a, b)| apart(**a, **b) > 0).count();
    let far = pairs().filter(|(a, b)| apart(**a, **b) > 1).count();
    let figures = format!("{different} pixels differ, {far} by more than one level");
    if far > 20 { Err(figures) } else { Ok(figures) }
}
