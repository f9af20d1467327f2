//! Whatever the text, the parser answers: a scene or a fault within the text, never a panic.

use fixel_host::scene::hw2::{self, Scene};
use fixel_host::scene::{Fault, format};
use proptest::prelude::*;

const SCENE: &str = "png 40 30 out.png\nxyz 0 0 0\nxyz 1 0 .5\nxyzw 0 1 0 -1\ncolor 1 0.5 -.25\nnormal 0 0 -1\n\
    texcoord .5 1e-3\ntexture t.png\nloadmv 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\ntranslate 1 2 3\nrotate 30 1 2 3\n\
    scale 2 2 2\nlookat 1 2 0 1 0\nfrustum -1 1 1 -1 1 10\northo -1 1 -1 1 0 5\nclipplane 1 0 0 .5\ncull\n\
    sunlight 0 0 -1\nbulb 3\nshininess 8\ntrif 1 2 3\ntrig -1 -2 -3\ntrit 1 2 3\n\
    tribezf 2 1 2 3 1 2 3 1 2 3 1\nrectbezg 3 1 2 3 1 2 3 1 2 3 1 2 3 1 2 3 1\n";

fn parse(text: &[u8]) -> Result<Scene, Fault> {
    hw2::parse_with(text, &mut |_| Ok(()))
}

/// A fault lies in the text, and what it says is one line.
fn sensible(text: &[u8], fault: &Fault) -> bool {
    let line = text.split(|&byte| byte == b'\n').nth(fault.place.line - 1);
    let columns = line.map_or(0, <[u8]>::len);
    let in_line = (1..=columns + 1).contains(&fault.place.column);
    in_line && !fault.message.is_empty() && !fault.message.contains(char::is_control)
}

#[test]
fn the_scene_that_is_mutated_is_valid() {
    assert_eq!(parse(SCENE.as_bytes()).map(|scene| scene.commands.len()), Ok(24));
}

proptest! {
    #[test]
    fn bytes(text in proptest::collection::vec(any::<u8>(), 0..200)) {
        format::detect("a.txt".as_ref(), &text);
        if let Err(fault) = parse(&text) {
            prop_assert!(sensible(&text, &fault), "{fault}");
        }
    }

    #[test]
    fn words(words in proptest::collection::vec(
        prop_oneof![
            Just("\n"), Just("\n"), Just("\r\n"), Just(" "), Just("\t"), Just("#"), Just("png 1 1 a\n"), Just("xyz"),
            Just("trif"), Just("bulb"), Just("lookat"), Just("1"), Just("-1"), Just("0"), Just("1e308"),
            Just("-1e-308"), Just("99999999999999999999"), Just("../a"), Just("é"), Just("\u{feff}"),
        ],
        0..60,
    )) {
        let text = format!("png 9 9 a.png\nxyz 1 2 3\nxyzw 1 2 3 1e308\n{}", words.join(" "));
        if let Err(fault) = parse(text.as_bytes()) {
            prop_assert!(sensible(text.as_bytes(), &fault), "{fault}");
        }
    }

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
        if let Err(fault) = parse(&text) {
            prop_assert!(sensible(&text, &fault), "{fault}");
        }
    }

    #[test]
    fn swapped_words(swaps in proptest::collection::vec((any::<usize>(), any::<usize>()), 1..6)) {
        let mut words: Vec<_> = SCENE.split_inclusive([' ', '\n']).collect();
        for (a, b) in swaps {
            let count = words.len();
            words.swap(a % count, b % count);
        }
        let text = words.concat();
        if let Err(fault) = parse(text.as_bytes()) {
            prop_assert!(sensible(text.as_bytes(), &fault), "{fault}");
        }
    }
}
