//! Every row of the table of faults in the description of HW2, by the parser alone: no disk, no picture.

use fixel_host::scene::Place;
use fixel_host::scene::hw2::{self, Action, Command, Fill, Scene};

fn parse(text: &str) -> Result<Scene, (usize, usize)> {
    hw2::parse_with(text.as_bytes(), &mut |name| match name {
        "good.png" => Ok(()),
        _ => Err("no such file".to_owned()),
    })
    .map_err(|fault| (fault.place.line, fault.place.column))
}

const HEAD: &str = "png 8 8 out.png\nxyz 0 0 0\nxyz 1 0 0\nxyz 0 1 0\nxyzw 1 2 3 0\n";

/// The column of the fault in a line after [`HEAD`], which makes four vertices, the last with w = 0.
fn column(line: &str) -> Option<usize> {
    parse(&format!("{HEAD}{line}\n")).err().map(|(at, column)| {
        assert_eq!(at, 5 + line.lines().count(), "{line}");
        column
    })
}

#[test]
fn the_picture_comes_first_and_once() {
    assert_eq!(parse(""), Err((1, 1)));
    assert_eq!(parse("\n \n# only a comment\n"), Err((1, 1)));
    assert_eq!(parse("\n  cull\npng 8 8 a.png"), Err((2, 3)));
    assert_eq!(parse("\n  nonsense\n"), Err((2, 3)));
    assert_eq!(column(" png 8 8 a.png"), Some(2));
    assert_eq!(column("png"), Some(1));
}

#[test]
fn the_picture_has_limits() {
    for (text, expected) in [
        ("png 1 16384 a.png", None),
        ("png 8192 8192 a.png", None),
        ("png 8193 8192 a.png", Some(1)),
        (" png 16384 16384 /a.png", Some(2)),
        ("png 0 8 a.png", Some(5)),
        ("png 8 16385 a.png", Some(7)),
        ("png -8 8 a.png", Some(5)),
        ("png 8.0 8 a.png", Some(5)),
        ("png 8 1e2 a.png", Some(7)),
        ("png 99999999999999999999 8 a.png", Some(5)),
        ("png 8 8", Some(1)),
        ("png 8 8 a b.png", Some(1)),
        ("png 8 8 /a.png", Some(9)),
        ("png 8 8 ../a.png", Some(9)),
        ("png 8 8 a/../../b.png", Some(9)),
        ("png 8 8 C:\\a.png", Some(9)),
        ("png 8 8 \\a.png", Some(9)),
        ("png 8 8 a/../b.png", None),
    ] {
        let found = parse(text).err();
        assert_eq!(found, expected.map(|column| (1, column)), "{text}");
    }
}

#[test]
fn keywords_and_how_much_they_take() {
    let takes = [
        ("xyz", 3),
        ("xyzw", 4),
        ("color", 3),
        ("normal", 3),
        ("texcoord", 2),
        ("translate", 3),
        ("scale", 3),
        ("rotatex", 1),
        ("rotatey", 1),
        ("rotatez", 1),
        ("rotate", 4),
        ("loadmv", 16),
        ("multmv", 16),
        ("loadp", 16),
        ("clipplane", 4),
        ("cull", 0),
        ("decals", 0),
        ("flatnormals", 0),
        ("sunlight", 3),
        ("shininess", 1),
        ("trif", 3),
        ("trig", 3),
        ("rectbezf", 17),
        ("rectbezg", 17),
        ("tribezf", 11),
        ("tribezg", 11),
        ("bulb", 1),
    ];
    for (keyword, count) in takes {
        let with = |count: usize| column(&format!(" {keyword}{}", " 1".repeat(count)));
        assert_eq!(with(count), None, "{keyword}");
        assert_eq!(with(count + 1), Some(2), "{keyword}");
        assert_eq!(
            count.checked_sub(1).and_then(with),
            (count > 0).then_some(2),
            "{keyword}"
        );
    }
    for line in [
        "lookat 1 2 0 1",
        "lookat 1 2 0 1 0 0",
        "frustum 1 2 3 4 5",
        "ortho 1 2 3 4 5 6 7",
        "texture",
        "trit 1 2",
    ] {
        assert_eq!(column(line), Some(1), "{line}");
    }
    for line in ["XYZ 0 0 0", "tri 1 2 3", "rgb 1 2 3", "hyp", "xyz,0,0,0", "cull#"] {
        assert_eq!(column(line), Some(1), "{line}");
    }
}

#[test]
fn numbers() {
    for (line, expected) in [
        ("color 1 red 0", 9),
        ("rotatex nan", 9),
        ("scale 1 1 -inf", 11),
        ("xyz 0 0 1e999", 9),
        ("xyz 0x1 0 0", 5),
        ("xyz\t1_0\t0\t0", 5),
        ("\txyz  1 2\t q", 12),
        ("loadmv 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 one", 38),
        ("shininess -", 11),
        ("texcoord é 0", 10),
        ("texcoord 0 é", 12),
        ("normal 0 0 1 # no", 1),
    ] {
        assert_eq!(column(line), Some(expected), "{line}");
    }
    for line in [
        "xyz .5 -.5 1.",
        "xyz +1e2 1E-2 1.e+2",
        "shininess -3",
        "scale 0 0 0",
        "rotatex 1e-999",
    ] {
        assert_eq!(column(line), None, "{line}");
    }
}

#[test]
fn indices() {
    for (line, expected) in [
        ("trif 1 0 2", 8),
        ("trig 1 2 5", 10),
        ("bulb -5", 6),
        ("trif 1 2 3.0", 10),
        ("trif one 2 3", 6),
        ("lookat 1 9 0 1 0", 10),
        ("lookat 0 9 0 1 0", 8),
        ("rectbezf 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 7", 42),
        ("tribezg 1 1 1 1 1 1 1 1 1 1 0", 29),
        ("texture good.png\ntrit 1 2 5", 10),
    ] {
        assert_eq!(column(line), Some(expected), "{line}");
    }
    let scene = parse(&format!("{HEAD}trif -1 2 -4\nxyz 0 0 0\ntrig -1 -5 5\n"));
    let actions: Vec<_> = scene.map(|s| s.commands).unwrap_or_default();
    let place = |line| Place { line, column: 1 };
    let drawn = |line, fill, corners| Command {
        place: place(line),
        action: Action::Triangle(fill, corners),
    };
    assert_eq!(actions[4], drawn(6, Fill::Flat, [3, 1, 0]));
    assert_eq!(actions[6], drawn(8, Fill::Gouraud, [4, 0, 4]));
}

#[test]
fn what_must_not_be_flat() {
    for (line, expected) in [
        ("frustum 1 1 -1 1 1 10", 9),
        ("frustum 1 2 3 3.0 1 10", 13),
        ("ortho -1 1 -1 1 5 5", 17),
        ("ortho 0 -0 -1 1 5 6", 7),
        ("frustum 1 1 x 1 1 1", 9),
        ("frustum 1 x 1 1 1 1", 11),
        ("rotate 30 0 -0 0e7", 11),
        ("rotate 30 0 0 x", 15),
        ("rectbezf 0 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1", 10),
        ("tribezg 9 1 1 1 1 1 1 1 1 1 1", 9),
        ("tribezg 1.5 1 1 1 1 1 1 1 1 1 1", 9),
        ("trit 1 2 3", 1),
        ("trit 1 2 x", 1),
    ] {
        assert_eq!(column(line), Some(expected), "{line}");
    }
    for line in [
        "frustum -1 1 1 -1 -1 -10",
        "ortho 1 -1 1 -1 5 -5",
        "rotate 30 0 0 -1e-300",
    ] {
        assert_eq!(column(line), None, "{line}");
    }
}

#[test]
fn views_need_a_direction() {
    for (line, expected) in [
        ("lookat 1 1 0 1 0", 1),
        (" lookat 1 -4 0 1 0", 2),
        ("xyzw 2 0 0 2\nlookat 2 5 0 1 0", 1),
        ("lookat 1 2 1 0 0", 1),
        ("lookat 1 2 -3 0 0", 1),
        ("lookat 1 2 0 0 0", 1),
        ("lookat 4 2 0 1 0", 8),
        ("lookat 1 4 0 1 0", 10),
        ("lookat 1 4 x 1 0", 10),
        ("lookat 1 2 0 x 0", 14),
    ] {
        assert_eq!(column(line), Some(expected), "{line}");
    }
    for line in [
        "lookat 1 2 0 1 0",
        "lookat 1 2 1 1e-9 0",
        "scale 0 0 0\nlookat 1 2 0 0 1",
    ] {
        assert_eq!(column(line), None, "{line}");
    }
}

#[test]
fn a_bulb_needs_a_place_under_the_matrix() {
    for (lines, expected) in [
        ("bulb 4", Some(6)),
        ("bulb 3", None),
        ("loadmv 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0\nbulb 3", Some(6)),
        // w = x - w: 0 for the second vertex, and for the third after a quarter turn took y to -x.
        ("loadmv 1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 -1\nbulb 2", Some(6)),
        ("loadmv 1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 -1\nbulb 3", None),
        ("loadmv 1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 -1\nrotatez -90\nbulb 3", Some(6)),
        ("loadmv 1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 -1\nscale 2 1 1\nbulb 2", None),
        (
            "loadmv 1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 -1\ntranslate 1 0 0\nbulb 3",
            Some(6),
        ),
        ("multmv 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0\nlookat 1 2 0 1 0\nbulb 3", None),
        ("scale 0 0 0\nbulb 3", None),
    ] {
        assert_eq!(column(lines), expected, "{lines}");
    }
}

#[test]
fn textures() {
    assert_eq!(column("texture good.png\ntrit 1 2 3"), None);
    for name in [
        "nosuch.png",
        "/good.png",
        "../good.png",
        "C:\\good.png",
        "a/..",
        "\\good.png",
    ] {
        assert_eq!(column(&format!("texture {name}")), Some(9), "{name}");
    }
}

#[test]
fn a_texture_is_looked_up_once() {
    let mut asked = Vec::new();
    let text = "png 1 1 o.png\ntexture a.png\ntexture b/../a.png\ntexture b.png\n";
    let scene = hw2::parse_with(text.as_bytes(), &mut |name| {
        asked.push(name.to_owned());
        Ok(())
    });
    assert!(scene.is_ok());
    assert_eq!(asked, ["a.png", "b.png"]);
}

#[test]
fn lines_end_either_way() {
    let unix = "# a scene\npng 8 8 out.png\n\n xyz 1 2 3\n\tcull\nrotate 30 0 0 1";
    let dos = format!("\u{feff}{}", unix.replace('\n', "\r\n"));
    assert_eq!(parse(unix), parse(&dos));
    assert_eq!(parse(&format!("{unix}\r")), parse(unix));
    assert_eq!(parse("png 8 8 out.png\r\nxyz 1 2 q\r\n"), Err((2, 9)));
}

#[test]
fn the_first_fault_counts() {
    assert_eq!(parse("png 8 8 a.png\nxyz 1 2\nfoo\n"), Err((2, 1)));
    let latin1 = b"png 8 8 a.png\nxyz 1 2\n# caf\xE9\n";
    let fault = hw2::parse_with(latin1, &mut |_| Ok(())).err();
    assert_eq!(fault.map(|fault| fault.place.line), Some(2));
    let latin1 = b"png 8 8 a.png\n# caf\xE9\nxyz 1 2\n";
    let place = hw2::parse_with(latin1, &mut |_| Ok(())).err().map(|fault| fault.place);
    assert_eq!(place, Some(Place { line: 2, column: 6 }));
}

#[test]
fn a_long_scene_takes_no_longer_per_line() {
    let long = "png 8 8 a.png\n".to_owned() + &"xyz 1 2 3\ntrif -1 1 1\n".repeat(200_000);
    assert_eq!(parse(&long).map(|scene| scene.commands.len()), Ok(400_000));
    let one_line = format!("png 8 8 a.png\ncull{}", " x".repeat(1_000_000));
    assert_eq!(parse(&one_line), Err((2, 1)));
}
