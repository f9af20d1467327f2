//! Every row of the table of faults in the description of the Inventor subset, and the corners of its grammar.

use std::fs;
use std::path::PathBuf;

use fixel_host::scene::iv::{self, Camera, Corner, Face, Light, Material, Model, Rotation, Transform};
use fixel_host::scene::{Fault, Place};
use proptest::prelude::*;

const CAMERA: &str = "PerspectiveCamera { }";
const POINTS: &str = "Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0 ] }";
const NORMALS: &str = "Normal { vector [ 0 0 1, 1 0 0 ] }";
const SCENE: &str = "#Inventor V2.1 ascii\nPerspectiveCamera { position 0 0 5 orientation 0 0 1 .5 nearDistance 1\n\
    farDistance 9 left -.5 right .5 top .5 bottom -.5 }\nPointLight { location 1 2 3 color 1 .5 0 }\nSeparator {\n\
    Transform { translation 1 2 3 rotation 0 1 0 -1e-1 scaleFactor 1 2 1 }\n\
    Material { ambientColor 0 .1 .2 diffuseColor 1 1 1 specularColor .5 .5 .5 shininess 9 } # a comment\n\
    Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0, ] } Normal { vector [ 0 0 1, 1 0 0 ] }\n\
    IndexedFaceSet { coordIndex [ 0,1,2,-1, 2,1,3,-1, ] normalIndex [ 0,0,0,-1, 0,0,1,-1 ] }\n}\n";

/// Line, column and message of the fault; none if there is none.
fn fault(text: &str) -> Option<(usize, usize, String)> {
    let Fault { place, message, .. } = iv::parse(text).err()?;
    Some((place.line, place.column, message))
}

fn parsed(text: &str) -> Model {
    iv::parse(text).unwrap_or_else(|fault| panic!("{fault}\n{text}"))
}

/// Compares the fault of each text, after a line with a camera, with column and message; `|` marks the place.
fn check(cases: &[(&str, &str)]) {
    for (marked, message) in cases {
        let text = format!("{CAMERA}\n{}", marked.replace('|', ""));
        let before = format!("{CAMERA}\n{}", marked.split('|').next().unwrap_or_default());
        let line = before.lines().count() + usize::from(before.ends_with('\n'));
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        assert!(marked.contains('|'), "{marked}");
        assert_eq!(fault(&text), Some((line, column, (*message).to_owned())), "{marked}");
    }
}

#[test]
fn unknown_names() {
    check(&[
        ("|SpotLight { location 0 0 1 }", "unknown block 'SpotLight'"),
        ("|pointLight { }", "unknown block 'pointLight'"),
        ("|Material { }", "unknown block 'Material'"),
        ("PointLight { } |location 0 0 1", "unknown block 'location'"),
        (
            "PointLight { |position 0 0 1 }",
            "unknown field 'position' in PointLight",
        ),
        ("Separator { |Foo { } }", "unknown block 'Foo' in Separator"),
        (
            "Separator {\n |Separator { } }",
            "unknown block 'Separator' in Separator",
        ),
        (
            "Separator { |PointLight { } }",
            "unknown block 'PointLight' in Separator",
        ),
        (
            "Separator { Transform { |center 0 0 0 } }",
            "unknown field 'center' in Transform",
        ),
        (
            "Separator { Material { |emissiveColor 0 0 0 } }",
            "unknown field 'emissiveColor' in Material",
        ),
        (
            "Separator { Coordinate3 { |vector [ ] } }",
            "unknown field 'vector' in Coordinate3",
        ),
        ("Separator { Normal { |point [ ] } }", "unknown field 'point' in Normal"),
        (
            "Separator { IndexedFaceSet { |index [ ] } }",
            "unknown field 'index' in IndexedFaceSet",
        ),
        ("PointLight { location 0 0 1 |2 }", "unknown field '2' in PointLight"),
        ("PointLight { |\u{7}é }", "unknown field '\\u{7}é' in PointLight"),
    ]);
    assert_eq!(
        fault("PerspectiveCamera {\n fieldOfView 1 }"),
        Some((2, 2, "unknown field 'fieldOfView' in PerspectiveCamera".into()))
    );
}

#[test]
fn braces_and_brackets() {
    let end = |expected: &str| format!("unexpected end of input, expected {expected}");
    check(&[
        ("Separator {|", &end("'}'")),
        ("Separator {|\n\n# more\n", &end("'}'")),
        ("Separator|", &end("'{'")),
        ("PointLight { location 0 0|", &end("a number")),
        ("PointLight { location 0 0 1|", &end("'}'")),
        ("Separator { Coordinate3 { point|", &end("'['")),
        ("Separator { Coordinate3 { point [|", &end("']'")),
        ("Separator { Coordinate3 { point [ 1 2 3|", &end("']'")),
        ("Separator { Coordinate3 { point [ 1 2 3,|", &end("']'")),
        ("Separator { IndexedFaceSet { coordIndex [ 1,|", &end("']'")),
        ("Separator { Coordinate3 { point [ ]|", &end("'}'")),
        ("PointLight |location 0 0 1", "expected '{', found 'location'"),
        ("PointLight |[ ]", "expected '{', found '['"),
        ("PointLight { |[ ]", "expected a field or '}', found '['"),
        ("PointLight { } |}", "expected a block, found '}'"),
        ("Separator { |, }", "expected a block or '}', found ','"),
        ("Separator { Normal { vector |1 2 3 } }", "expected '[', found '1'"),
        (
            "Separator { Normal { vector [ 1 2 3 |4 5 6 ] } }",
            "expected ',' or ']', found '4'",
        ),
        (
            "Separator { Normal { vector [ 1 2 3 |} }",
            "expected ',' or ']', found '}'",
        ),
        (
            "Separator { IndexedFaceSet { coordIndex [ 0 |1 ] } }",
            "expected ',' or ']', found '1'",
        ),
    ]);
}

#[test]
fn numbers() {
    check(&[
        ("PointLight { location 0 |zero 1 }", "expected a number, found 'zero'"),
        ("PointLight { location 0 |. 1 }", "expected a number, found '.'"),
        ("PointLight { location 0 0 |}", "expected a number, found '}'"),
        (
            "PointLight { location 0 0 |color 1 1 1 }",
            "expected a number, found 'color'",
        ),
        ("PointLight { location 0|, 0 1 }", "expected a number, found ','"),
        (
            "Separator { Coordinate3 { point [ 0 0 0, 1 0 |] } }",
            "expected a number, found ']'",
        ),
        (
            "Separator { Coordinate3 { point [ 0 0|, 1 0 0 ] } }",
            "expected a number, found ','",
        ),
        (
            "Separator { Coordinate3 { point [ |, ] } }",
            "expected a number, found ','",
        ),
        (
            "Separator { Coordinate3 { point [ 0 0 0,|, ] } }",
            "expected a number, found ','",
        ),
        (
            "Separator { IndexedFaceSet { coordIndex [ 0,|x ] } }",
            "expected a number, found 'x'",
        ),
        (
            "Separator { IndexedFaceSet { coordIndex [ |. ] } }",
            "expected a number, found '.'",
        ),
        ("PointLight { color 1 1 |1e309 }", "number too large, found '1e309'"),
        (
            "Separator { Normal { vector [ 1 |-1e999 1 ] } }",
            "number too large, found '-1e999'",
        ),
        (
            "Separator { IndexedFaceSet { coordIndex [ |1e999 ] } }",
            "number too large, found '1e999'",
        ),
    ]);
    for bad in [
        "1e", "e1", "0x10", "inf", "-inf", "nan", "NaN", "infinity", "+", "-", "1-2", "1.2.3", "1_0", "1f", ".e1", "١",
    ] {
        let message = format!("expected a number, found '{bad}'");
        check(&[(&format!("PointLight {{ location |{bad} 0 0 }}"), &message)]);
    }
    for (good, value) in [
        ("-5", -5.0),
        ("0.", 0.0),
        (".75", 0.75),
        ("+1E1", 10.0),
        ("1.e-2", 0.01),
        ("1e-999", 0.0),
        ("007", 7.0),
        ("1.7976931348623157e308", f64::MAX),
    ] {
        let model = parsed(&format!("{CAMERA} PointLight {{location {good}#1\n 1 2}}"));
        assert_eq!(model.lights[0].location, [value, 1.0, 2.0], "{good}");
    }
    let long = fault(&format!("{CAMERA} PointLight {{ color {} }}", "9x".repeat(9000)));
    assert!(long.is_some_and(|(_, _, message)| message.len() < 100));
}

/// A Separator with four points, two normals and these faces.
fn faces(coord_index: &str, normal_index: &str) -> String {
    format!(
        "Separator {{ {POINTS} {NORMALS} IndexedFaceSet {{ coordIndex [{coord_index}] normalIndex [{normal_index}] }}\n}}"
    )
}

#[test]
fn indices() {
    for (coord_index, normal_index, message) in [
        ("0,|1.5,2,-1", "0,0,0,-1", "expected an integer index, found '1.5'"),
        ("0,|-1.5,2,-1", "0,0,0,-1", "expected an integer index, found '-1.5'"),
        ("0,|-2,2,-1", "0,0,0,-1", "index is negative, found '-2'"),
        ("0,1,2,-1", "0,|-3,0,-1", "index is negative, found '-3'"),
        ("0,1,|4,-1", "0,0,0,-1", "coordinate index 4 out of range (4 points)"),
        (
            "0,1,2,3,|9,8,-1",
            "0,0,7,0,-1",
            "coordinate index 9 out of range (4 points)",
        ),
        ("0,1,2,-1", "0,0,|2,-1", "normal index 2 out of range (2 normals)"),
        (
            "0,1,|1e30,-1",
            "0,0,0,-1",
            "coordinate index 1e30 out of range (4 points)",
        ),
        ("0,1,|4,-1", "0,0,0,0,-1", "coordinate index 4 out of range (4 points)"),
    ] {
        check(&[(&faces(coord_index, normal_index), message)]);
    }
    // Whole numbers, however they are written.
    let model = parsed(&format!("{CAMERA}{}", faces("0.0,1e0,+2,-1.", "-0,0,0,-1")));
    assert_eq!(model.objects[0].faces[0].corners[1], Corner { point: 1, normal: 0 });
}

#[test]
fn shapes_of_faces() {
    for (coord_index, normal_index, message) in [
        ("0,1,2,-1", "", "1 faces in coordIndex but 0 in normalIndex"),
        ("", "0,0,0,-1", "0 faces in coordIndex but 1 in normalIndex"),
        (
            "0,1,2,-1,0,1,2,-1",
            "0,0,0,-1",
            "2 faces in coordIndex but 1 in normalIndex",
        ),
        (
            "0,1,2,-1,0,1,2,-1",
            "0,0,0,-1,0,0,-1",
            "face 1 has 3 vertices in coordIndex but 2 in normalIndex",
        ),
        (
            "0,1,2,-1",
            "0,0,0,0,-1",
            "face 0 has 3 vertices in coordIndex but 4 in normalIndex",
        ),
    ] {
        let text = faces(coord_index, normal_index).replace("\n}", "\n|}");
        check(&[(&text, message)]);
    }
    check(&[(
        &format!("Separator {{ {POINTS} {NORMALS} IndexedFaceSet {{ coordIndex [ 0,1,2,-1 ] }}\n |}}"),
        "1 faces in coordIndex but 0 in normalIndex",
    )]);
    for (coord_index, normal_index, message) in [
        ("0,1,|-1", "0,0,-1", "face 0 has fewer than 3 vertices"),
        ("0,1,2,-1,|-1", "0,0,0,-1,-1", "face 1 has fewer than 3 vertices"),
        ("0,1,2|", "0,0,0", "last face is not closed by -1"),
        ("0,1,2,-1,0,|", "0,0,0", "last face is not closed by -1"),
        ("0,1,2,-1", "0,0,0|", "last face is not closed by -1"),
    ] {
        check(&[(&faces(coord_index, normal_index), message)]);
    }
}

#[test]
fn indices_are_checked_wherever_the_points_stand() {
    for text in [
        "IndexedFaceSet { coordIndex [ 0,1,|7,9,8,-1 ] normalIndex [ 0,0,0,0,0,-1 ] } NORMALS POINTS }",
        "IndexedFaceSet { coordIndex [ 0,1,|7,-1 ] normalIndex [ 0,0,9,-1 ] } POINTS NORMALS }",
        "NORMALS IndexedFaceSet { coordIndex [ 0,1,|7,-1 ] normalIndex [ 0,0,0,-1 ] } POINTS Foo }",
        "POINTS NORMALS IndexedFaceSet { coordIndex [ 0,1,|7,-1 ] normalIndex [ 0,0,0,-1 ] } Foo",
        "POINTS IndexedFaceSet { coordIndex [ 0,1,|7,-1 ] }",
    ] {
        let text = text.replace("NORMALS", NORMALS).replace("POINTS", POINTS);
        check(&[(
            &format!("Separator {{ {text}"),
            "coordinate index 7 out of range (4 points)",
        )]);
    }
    check(&[
        (
            "Separator { IndexedFaceSet { coordIndex [ |0,1,2,-1 ] normalIndex [ 0,0,0,-1 ] } }",
            "coordinate index 0 out of range (0 points)",
        ),
        (
            &format!("Separator {{ {POINTS} IndexedFaceSet {{ coordIndex [ 0,1,2,-1 ] normalIndex [ |0,0,0,-1 ] }} }}"),
            "normal index 0 out of range (0 normals)",
        ),
    ]);
}

#[test]
fn exactly_one_camera() {
    for text in ["", "\n\n", "# nothing", "PointLight { }", "\u{feff}Separator { }"] {
        let fault = iv::parse(text).expect_err("no camera");
        assert!(fault.whole, "{text}");
        assert_eq!(fault.place, Place { line: 1, column: 1 });
        assert_eq!(fault.message, "no PerspectiveCamera");
    }
    check(&[("|PerspectiveCamera { }", "a second PerspectiveCamera")]);
    assert!(!iv::parse("PointLight }").expect_err("no brace").whole);
}

#[test]
fn the_camera_sees_something() {
    let near = "nearDistance must be > 0";
    let far = "farDistance must be > nearDistance";
    for (fields, column, message) in [
        ("nearDistance 0", 34, near),
        ("nearDistance -0.0 nearDistance -1", 52, near),
        ("farDistance 1", 33, far),
        ("nearDistance 10", 34, far),
        ("nearDistance 20 farDistance 19", 49, far),
        ("farDistance 19 nearDistance 20", 49, far),
        ("left 1", 26, "left and right must differ"),
        ("right 0.5 left .5", 36, "left and right must differ"),
        ("top -1", 25, "bottom and top must differ"),
        (
            "orientation 0 0 -0 1",
            33,
            "the axis must not be 0 0 0 where the angle is not 0",
        ),
        ("right -1 nearDistance 0 top -1", 27, "left and right must differ"),
    ] {
        let found = fault(&format!("PerspectiveCamera {{ {fields} }}"));
        assert_eq!(found, Some((1, column, message.into())), "{fields}");
    }
    for fine in [
        "left 1 right -1 top -1 bottom 1",
        "nearDistance 0 nearDistance 1",
        "nearDistance 1e-300 farDistance 2e-300",
        "orientation 0 0 0 0",
        "orientation 0 0 0 1 orientation 0 0 1e-300 1",
    ] {
        assert_eq!(fault(&format!("PerspectiveCamera {{ {fine} }}")), None, "{fine}");
    }
}

#[test]
fn values_of_a_separator() {
    check(&[
        (
            "Separator { Transform { scaleFactor 1 |0 0 } }",
            "scaleFactor must not be 0",
        ),
        (
            "Separator { Transform { scaleFactor |1e-999 1 1 } }",
            "scaleFactor must not be 0",
        ),
        (
            "Separator { Transform { rotation |0 0 0 .1 scaleFactor 1 1 0 } }",
            "the axis must not be 0 0 0 where the angle is not 0",
        ),
        (
            "Separator { Transform { scaleFactor 1 1 |0 rotation 0 0 0 1 } }",
            "scaleFactor must not be 0",
        ),
        (
            "Separator { Material { shininess |-1 } }",
            "shininess must not be negative",
        ),
    ]);
    for block in ["Material { }", POINTS, NORMALS, "IndexedFaceSet { }"] {
        let name = block.split(' ').next().unwrap_or_default();
        let message = format!("a second {name} in one Separator");
        check(&[(&format!("Separator {{ {block} Transform {{ }}\n |{block} }}"), &message)]);
        assert_eq!(
            fault(&format!("{CAMERA} Separator {{ {block} }} Separator {{ {block} }}")),
            None
        );
    }
    for fine in [
        "Transform { scaleFactor 0 0 0 scaleFactor -1 1 1 rotation 0 0 0 0 }",
        "Material { shininess -1 shininess 0 }",
        "Transform { } Transform { }",
    ] {
        assert_eq!(fault(&format!("{CAMERA} Separator {{ {fine} }}")), None, "{fine}");
    }
}

#[test]
fn what_is_left_out_has_its_default() {
    let model = parsed("PerspectiveCamera { } PointLight { } Separator { Transform { } Material { } } Separator { }");
    let turn = Rotation {
        axis: [0.0, 0.0, 1.0],
        angle: 0.0,
    };
    let camera = Camera {
        position: [0.0, 0.0, 1.0],
        orientation: turn,
        near: 1.0,
        far: 10.0,
        left: -1.0,
        right: 1.0,
        bottom: -1.0,
        top: 1.0,
    };
    let light = Light {
        location: [0.0, 0.0, 1.0],
        color: [1.0; 3],
    };
    let transform = Transform {
        translation: [0.0; 3],
        rotation: turn,
        scale_factor: [1.0; 3],
    };
    let material = Material {
        ambient: [0.2; 3],
        diffuse: [0.8; 3],
        specular: [0.0; 3],
        shininess: 0.2,
    };
    assert_eq!(model.camera, camera);
    assert_eq!(model.lights, [light]);
    assert_eq!(model.objects[0].transforms, [transform]);
    assert_eq!(model.objects[1].transforms, []);
    assert!(
        model
            .objects
            .iter()
            .all(|object| object.material == material && object.faces.is_empty())
    );
    assert_eq!(parsed(CAMERA).objects, []);
}

#[test]
fn fields_and_blocks_come_in_any_order() {
    let model = parsed(
        "Separator { IndexedFaceSet{normalIndex[0,0,1,-1]coordIndex[2,1,0,-1]} Transform { scaleFactor 1 2 3 }\n\
         Normal { vector [] vector [ 0 0 1, 1 0 0 ] } Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, ] }\n\
         Transform { rotation 1 0 0 2 translation 4 5 6 } Material { ambientColor -1 .5 2 ambientColor -1 2 .5 } }\n\
         PointLight { color 3 -1 0 } PerspectiveCamera { top 2 #}\nfarDistance#\n3 }",
    );
    let object = &model.objects[0];
    assert_eq!((model.camera.top, model.camera.far), (2.0, 3.0));
    assert_eq!(model.lights[0].color, [3.0, -1.0, 0.0], "not clamped");
    assert_eq!(object.material.ambient, [0.0, 1.0, 0.5], "clamped");
    assert_eq!(object.transforms[0].scale_factor, [1.0, 2.0, 3.0]);
    assert_eq!(object.transforms[1].translation, [4.0, 5.0, 6.0]);
    assert_eq!(object.transforms[1].rotation.angle, 2.0);
    assert_eq!((object.points.len(), object.normals.len()), (3, 2));
    let corners = [(2, 0), (1, 0), (0, 1)].map(|(point, normal)| Corner { point, normal });
    assert_eq!(
        object.faces,
        [Face {
            corners: corners.into()
        }]
    );
}

#[test]
fn lines_end_either_way() {
    let dos = format!("\u{feff}{}", SCENE.replace('\n', "\r\n"));
    assert_eq!(parsed(SCENE), parsed(&dos));
    assert_eq!(parsed(SCENE).objects[0].faces.len(), 2);
}

#[test]
fn the_first_fault_counts() {
    check(&[
        (
            "PointLight { |foo }\nSeparator { Bar }",
            "unknown field 'foo' in PointLight",
        ),
        (
            "Separator { Material { shininess |-1 } Foo }",
            "shininess must not be negative",
        ),
    ]);
    let place = |text: &[u8]| {
        iv::parse(text)
            .err()
            .map(|fault| (fault.place.line, fault.place.column))
    };
    assert_eq!(place(b"Foo { }\n# caf\xE9\n"), Some((1, 1)));
    assert_eq!(place(b"# \xC3\xA9\n# caf\xE9\nFoo"), Some((2, 6)));
}

#[test]
fn the_1025th_light_is_where_there_are_too_many() {
    let lights = |count: usize| fault(&format!("PerspectiveCamera {{}}\n{}", " PointLight {}\n".repeat(count)));
    assert_eq!(lights(1024), None);
    assert_eq!(lights(1025), Some((1026, 2, "more than 1024 lights".to_owned())));
}

#[test]
fn a_long_scene_takes_no_longer_per_token() {
    let points = "0 1.5 -2e3,".repeat(1_000_000);
    let indices = "0,1,2,-1,".repeat(500_000);
    let one_line = format!(
        "{CAMERA} Separator {{ Coordinate3 {{ point [ {points} ] }} Normal {{ vector [ {points} ] }} \
         IndexedFaceSet {{ coordIndex [ {indices} ] normalIndex [ {indices} ] }} }}"
    );
    let model = parsed(&one_line);
    assert_eq!(model.objects[0].points.len(), 1_000_000);
    assert_eq!(model.objects[0].faces.len(), 500_000);
    let counting: String = (0..1_000_000).map(|i| format!("{i},")).collect();
    let found = fault(&format!(
        "{CAMERA} Separator {{ IndexedFaceSet {{\ncoordIndex [ {counting} -1 ] }} }}"
    ));
    assert_eq!(found.map(|(line, column, _)| (line, column)), Some((2, 14)));
    for braces in ["{", "Separator{", "[", "PerspectiveCamera{orientation"] {
        assert!(fault(&braces.repeat(1_000_000)).is_some());
    }
}

/// The manifest's bad scenes: the message starts as the manifest says it.
#[test]
fn every_bad_scene_is_refused_where_it_is_bad() {
    let Some(folder) = std::env::var_os("FIXEL_CONFORMANCE").map(PathBuf::from) else {
        eprintln!("SKIPPED: FIXEL_CONFORMANCE is not set, no bad scene was read");
        return;
    };
    let manifest = fs::read_to_string(folder.join("MANIFEST-iv.tsv")).expect("MANIFEST-iv.tsv");
    let mut count = 0;
    for line in manifest.lines() {
        let fields: Vec<&str> = line.split('\t').collect();
        let [_, name, _, "error", notes, scene, ..] = fields[..] else {
            continue;
        };
        let (_, expected) = notes.split_once("says as much as: ").expect("what it says");
        let text = fs::read(folder.join(scene)).unwrap_or_else(|e| panic!("{scene}: {e}"));
        let fault = iv::parse(text).expect_err(name);
        let found = match fault.whole {
            true => fault.message,
            false => format!("line {}: {}", fault.place.line, fault.message),
        };
        assert_eq!(found, expected.trim_end(), "{name}");
        count += 1;
    }
    println!("{count} bad scenes refused");
    assert!(count > 0);
}

/// A fault lies in the text, and what it says is one line.
fn sensible(text: &[u8], fault: &Fault) -> bool {
    let line = text.split(|&byte| byte == b'\n').nth(fault.place.line - 1);
    let columns = line.map_or(0, <[u8]>::len);
    let in_line = (1..=columns + 1).contains(&fault.place.column);
    in_line && !fault.message.is_empty() && !fault.message.contains(char::is_control)
}

proptest! {
    #[test]
    fn mutated_scenes(changes in proptest::collection::vec((any::<usize>(), any::<u8>(), 0..3), 1..8)) {
        let mut text = SCENE.as_bytes().to_vec();
        for (at, byte, how) in changes {
            let at = at % text.len();
            match how {
                0 => text[at] = byte,
                1 => text.insert(at, byte),
                _ => drop(text.remove(at)),
            }
        }
        if let Err(fault) = iv::parse(&text) {
            prop_assert!(sensible(&text, &fault), "{fault}");
        }
    }

    #[test]
    fn swapped_words(swaps in proptest::collection::vec((any::<usize>(), any::<usize>()), 1..6)) {
        let mut words: Vec<_> = SCENE.split_inclusive([' ', ',', '\n']).collect();
        for (a, b) in swaps {
            let count = words.len();
            words.swap(a % count, b % count);
        }
        let text = words.concat();
        if let Err(fault) = iv::parse(text.as_bytes()) {
            prop_assert!(sensible(text.as_bytes(), &fault), "{fault}");
        }
    }
}
