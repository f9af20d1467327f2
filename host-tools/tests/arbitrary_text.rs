//! Whatever the text, the parsers answer: a scene or a fault within the text, never a panic.

use std::sync::Arc;

use fixel_host::picture::Picture;
use fixel_host::scene::size::Size;
use fixel_host::scene::{Fault, format, hw2, iv, mp1, obj};
use proptest::prelude::*;

const HW2: &str = "png 40 30 out.png\nxyz 0 0 0\nxyz 1 0 .5\nxyzw 0 1 0 -1\ncolor 1 0.5 -.25\nnormal 0 0 -1\n\
    texcoord .5 1e-3\ntexture t.png\nloadmv 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\ntranslate 1 2 3\nrotate 30 1 2 3\n\
    scale 2 2 2\nlookat 1 2 0 1 0\nfrustum -1 1 1 -1 1 10\northo -1 1 -1 1 0 5\nclipplane 1 0 0 .5\ncull\n\
    sunlight 0 0 -1\nbulb 3\nshininess 8\ntrif 1 2 3\ntrig -1 -2 -3\ntrit 1 2 3\n\
    tribezf 2 1 2 3 1 2 3 1 2 3 1\nrectbezg 3 1 2 3 1 2 3 1 2 3 1 2 3 1 2 3 1\n";

const MP1: &str = "png 40 30 out.png\ndepth\nsRGB\nhyp\nfsaa 4\nfrustum\ncull\ndecals\nclipplane 1 0 0 .5\nrgb 1 2 3\n\
    xyzw 0 0 0 1\nrgba 1 0.5 -.25 .5\nxyzw 1 0 .5 -1\ntexcoord .5 1e-3\nxyzw 0 1 0 2.\ntexture t.png\ntri 1 2 3\n\
    trit -1 -2 -3\npoint 2.5 1\nbillboard 3 2\ncircle 1e2 3\nline 1 2\nwuline 3 -1\n";

const IV: &str = "#Inventor V2.0 ascii\nPerspectiveCamera { position 0 0 5 orientation 0 1 0 .5 nearDistance 1 farDistance 9 left -1 }\n\
    PointLight { location 1 2 3 color 1 .5 -1 }\nSeparator {\n Transform { translation 1 2 3 rotation 1 0 0 2 scaleFactor 1 2 3 }\n\
    Material { ambientColor 0 .1 2 shininess 5 }\n Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, ] } Normal { vector [ 0 0 1 ] }\n\
    IndexedFaceSet { coordIndex [ 0,1,2,-1, 2,1,0,-1 ] normalIndex [ 0,0,0,-1,0,0,0,-1, ] }\n}\n";

const OBJ: &str = "# mesh\no \u{e9}\nv 0 0 0\nv 1 0 \\\n .5 # x\nv 0 1e3 -0.25 1 1 1\nvn 0 0 -1\r\nvt .5 1\nusemtl a\nf 1 2 3\n\
    f 1//1 -2//-1 3/1/1\nf 1/1 2/1 3/1 -1 1\ns off\n";

/// The fault that each parser finds.
fn faults(text: &[u8]) -> [Option<Fault>; 4] {
    let texture = Arc::new(Picture::new(1, 1, vec![[0; 4]]));
    let hw2 = hw2::parse_with(text, &mut |_| Ok(())).err();
    let mp1 = mp1::parse_with(text, &mut |_| Ok(Arc::clone(&texture))).err();
    let iv = iv::parse(text).err();
    let obj = obj::parse(text, Size::DEFAULT).err();
    [hw2, mp1, iv, obj]
}

/// The parsers' faults lie in the text, and what they say is one line.
fn check(text: &[u8]) -> Result<(), TestCaseError> {
    for fault in faults(text).into_iter().flatten() {
        prop_assert!(sensible(text, &fault), "{fault}");
    }
    Ok(())
}

/// A fault lies in the text, and what it says is one line.
fn sensible(text: &[u8], fault: &Fault) -> bool {
    let line = text.split(|&byte| byte == b'\n').nth(fault.place.line - 1);
    let columns = line.map_or(0, <[u8]>::len);
    let in_line = (1..=columns + 1).contains(&fault.place.column);
    in_line && !fault.message.is_empty() && !fault.message.contains(char::is_control)
}

#[test]
fn the_scenes_that_are_mutated_are_valid() {
    assert_eq!(faults(HW2.as_bytes())[0], None);
    assert_eq!(faults(MP1.as_bytes())[1], None);
    assert_eq!(faults(IV.as_bytes())[2], None);
    assert_eq!(faults(OBJ.as_bytes())[3], None);
}

proptest! {
    #[test]
    fn bytes(text in proptest::collection::vec(any::<u8>(), 0..200)) {
        format::detect("a.txt".as_ref(), &text);
        check(&text)?;
    }

    #[test]
    fn words(words in proptest::collection::vec(
        prop_oneof![
            Just("\n"), Just("\n"), Just("\r\n"), Just(" "), Just("\t"), Just("#"), Just("png 1 1 a\n"), Just("xyz"),
            Just("trif"), Just("bulb"), Just("lookat"), Just("1"), Just("-1"), Just("0"), Just("1e308"),
            Just("-1e-308"), Just("99999999999999999999"), Just("../a"), Just("é"), Just("\u{feff}"),
            Just("rgba"), Just("fsaa"), Just("tri"), Just("line"), Just("billboard"),
            Just("\nv"), Just("\nf"), Just("\nvn"), Just("1//1"), Just("-1/2/3"), Just("\\\n"), Just("{"), Just("}"),
            Just("["), Just("Separator"), Just("Transform"), Just("rotation"),
        ],
        0..60,
    )) {
        check(format!("png 9 9 a.png\nxyz 1 2 3\nxyzw 1 2 3 1e308\n{}", words.join(" ")).as_bytes())?;
        check(format!("png 9 9 a.png\nxyzw 1 2 3 1e308\n{}", words.join(" ")).as_bytes())?;
        check(format!("v 1 2 3\nv 1e308 0 -1e308\nvn 1 0 0\nf 1 2 1\n{}", words.join(" ")).as_bytes())?;
        check(format!("PerspectiveCamera {{ }} Separator {{ {}", words.join(" ")).as_bytes())?;
    }

    #[test]
    fn mutated_scenes(
        scene in prop_oneof![Just(HW2), Just(MP1), Just(IV), Just(OBJ)],
        changes in proptest::collection::vec((any::<usize>(), any::<u8>(), 0..3), 1..8),
    ) {
        let mut text = scene.as_bytes().to_vec();
        for (at, byte, how) in changes {
            let at = at % text.len();
            match how {
                0 => text[at] = byte,
                1 => text.insert(at, byte),
                _ => drop(text.remove(at)),
            }
        }
        check(&text)?;
    }

    #[test]
    fn swapped_words(
        scene in prop_oneof![Just(HW2), Just(MP1), Just(IV), Just(OBJ)],
        swaps in proptest::collection::vec((any::<usize>(), any::<usize>()), 1..6),
    ) {
        let mut words: Vec<_> = scene.split_inclusive([' ', '\n']).collect();
        for (a, b) in swaps {
            let count = words.len();
            words.swap(a % count, b % count);
        }
        check(words.concat().as_bytes())?;
    }
}
