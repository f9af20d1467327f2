//! Every row of the table of faults in the description of MP1, by the parser alone: no disk, no picture.

use std::sync::Arc;

use fixel_host::picture::Picture;
use fixel_host::scene::Place;
use fixel_host::scene::mp1::{self, Scene, Shape};

fn load(name: &str) -> Result<Arc<Picture>, String> {
    match name {
        "good.png" => Ok(Arc::new(Picture::new(1, 1, vec![[1, 2, 3, 4]]))),
        _ => Err("no such file".to_owned()),
    }
}

fn parse(text: &str) -> Result<Scene, (usize, usize)> {
    mp1::parse_with(text.as_bytes(), &mut load).map_err(|fault| (fault.place.line, fault.place.column))
}

const HEAD: &str = "png 8 8 out.png\nxyzw 0 0 0 1\nxyzw 1 0 0 1\nxyzw 0 1 0 1\n";

/// The column of the fault in the last line after [`HEAD`], which makes three vertices.
fn column(lines: &str) -> Option<usize> {
    parse(&format!("{HEAD}{lines}\n")).err().map(|(at, column)| {
        assert_eq!(at, 4 + lines.lines().count(), "{lines}");
        column
    })
}

/// The column of the fault in the last line after `png`.
fn early(lines: &str) -> Option<usize> {
    parse(&format!("png 8 8 out.png\n{lines}\n")).err().map(|(at, column)| {
        assert_eq!(at, 1 + lines.lines().count(), "{lines}");
        column
    })
}

#[test]
fn the_picture_comes_first_and_once() {
    assert_eq!(parse(""), Err((1, 1)));
    assert_eq!(parse("\n \n# only a comment\n"), Err((1, 1)));
    assert_eq!(parse("\n  sRGB\npng 8 8 a.png"), Err((2, 3)));
    assert_eq!(parse("\n  nonsense\n"), Err((2, 3)));
    assert_eq!(column(" png 8 8 a.png"), Some(2));
    assert_eq!(early(" png 8 8 a.png"), Some(2));
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
        ("png 8 8 C:\\a.png", Some(9)),
        ("png 8 8 a/../b.png", None),
    ] {
        let found = parse(text).err();
        assert_eq!(found, expected.map(|column| (1, column)), "{text}");
    }
}

#[test]
fn samples_have_the_limits_of_pixels() {
    for (size, line, expected) in [
        ("8 8", "fsaa 1", None),
        ("8 8", "fsaa 16", None),
        ("8 8", "fsaa 17", Some(6)),
        ("8 8", "fsaa 0", Some(6)),
        ("8 8", "fsaa -1", Some(6)),
        ("8 8", "fsaa 2.0", Some(6)),
        ("8 8", "fsaa 99999999999999999999", Some(6)),
        ("1024 8", "fsaa 16", None),
        ("1025 8", " fsaa 16", Some(7)),
        ("8 8192", "fsaa 2", None),
        ("8 8193", "fsaa 2", Some(6)),
        ("512 512", "fsaa 16", None),
        ("513 512", "fsaa 16", Some(6)),
        ("4096 4096", "fsaa 2", None),
        ("4096 4096", "fsaa 3", Some(6)),
        ("16384 4096", "fsaa 1", None),
        ("16384 4096", "fsaa 2", Some(6)),
    ] {
        let found = parse(&format!("png {size} a.png\n{line}\n")).err();
        assert_eq!(found, expected.map(|column| (2, column)), "{size} {line}");
    }
}

#[test]
fn keywords_and_how_much_they_take() {
    let takes = [
        ("depth", 0),
        ("sRGB", 0),
        ("hyp", 0),
        ("frustum", 0),
        ("cull", 0),
        ("decals", 0),
        ("fsaa", 1),
        ("clipplane", 4),
        ("rgb", 3),
        ("rgba", 4),
        ("texcoord", 2),
        ("xyzw", 4),
        ("tri", 3),
        ("point", 2),
        ("circle", 2),
        ("line", 2),
        ("wuline", 2),
    ];
    for (keyword, count) in takes {
        let switch = ["depth", "sRGB", "hyp", "frustum", "cull", "decals", "fsaa", "clipplane"].contains(&keyword);
        let place = if switch { early } else { column };
        let with = |count: usize| place(&format!(" {keyword}{}", " 1".repeat(count)));
        assert_eq!(with(count), None, "{keyword}");
        assert_eq!(with(count + 1), Some(2), "{keyword}");
        assert_eq!(
            count.checked_sub(1).and_then(with),
            (count > 0).then_some(2),
            "{keyword}"
        );
        // A switch after another command, whatever its arguments.
        let late = column(&format!(" {keyword}{}", " x".repeat(count)));
        let first_argument = 3 + keyword.len();
        assert_eq!(late, Some(if switch { 2 } else { first_argument }), "{keyword}");
    }
    for line in [
        "texture",
        "texture a b",
        "trit 1 2",
        "trit 1 2 3 4",
        "billboard 1",
        "billboard 1 2 3",
    ] {
        assert_eq!(column(&format!("texture good.png\n{line}")), Some(1), "{line}");
    }
    for line in [
        "XYZW 0 0 0 1",
        "srgb",
        "xyz 1 2 3",
        "trif 1 2 3",
        "color 1 2 3",
        "rgb,1,2,3",
        "tri#",
    ] {
        assert_eq!(column(line), Some(1), "{line}");
    }
}

#[test]
fn switches_come_right_after_the_picture() {
    let all = "hyp\n# still early\n\nfsaa 2\nclipplane 1 2 3 4\nsRGB\nsRGB\nfsaa 3\nclipplane 5 6 7 8\n";
    let switches = parse(&format!("png 8 8 a.png\n{all}")).expect("a good scene").switches;
    assert!(switches.hyp && switches.srgb && !switches.depth && !switches.cull);
    assert!(!switches.frustum && !switches.decals);
    assert_eq!(switches.fsaa, 3);
    assert_eq!(switches.clip_planes, [[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0]]);
    for begun in [
        "rgb 1 2 3",
        "rgba 1 2 3 1",
        "texcoord 0 0",
        "texture good.png",
        "xyzw 0 0 0 1",
    ] {
        assert_eq!(early(&format!("depth\n{begun}\n\tcull")), Some(2), "{begun}");
    }
}

#[test]
fn numbers() {
    for (line, expected) in [
        ("rgb 1 red 0", 7),
        ("rgba 1 nan 0 1", 8),
        ("xyzw 1 1 -inf 1", 10),
        ("xyzw 0 0 0 1e999", 12),
        ("xyzw 0x1 0 0 1", 6),
        ("rgb\t1_0\t0\t0", 5),
        ("\txyzw  1 2\t q 1", 13),
        ("texcoord é 0", 10),
        ("rgba 1 2 3 -0.001", 12),
        ("rgba 1 2 3 1.001", 12),
        ("rgba 1 2 3 x", 12),
        ("point -1 1", 7),
        ("circle -1e-300 1", 8),
        ("texture good.png\nbillboard -0.5 1", 11),
        ("point x 1", 7),
        ("rgb 0 0 1 # no", 1),
    ] {
        assert_eq!(column(line), Some(expected), "{line}");
    }
    for line in [
        "rgb -3 1e300 .5",
        "rgba 0 0 0 0",
        "rgba 0 0 0 1.",
        "point 0 1",
        "circle -0 1",
        "texcoord -1e9 5.",
    ] {
        assert_eq!(column(line), None, "{line}");
    }
}

#[test]
fn indices() {
    for (line, expected) in [
        ("tri 1 0 2", 7),
        ("tri 1 2 4", 9),
        ("line -4 1", 6),
        ("wuline 1 2.0", 10),
        ("point 2.5 one", 11),
        ("circle 1 0", 10),
        ("texture good.png\ntrit 1 2 5", 10),
        ("texture good.png\nbillboard 1 5", 13),
    ] {
        assert_eq!(column(line), Some(expected), "{line}");
    }
}

#[test]
fn a_texture_comes_before_what_shows_it() {
    for line in ["trit 1 2 3", "trit 1 2 x", "billboard 1 1", "billboard -1 0"] {
        assert_eq!(column(line), Some(1), "{line}");
        assert_eq!(
            column(&format!(
                "texture good.png\ntri 1 2 3\n {}",
                line.replace(['x', '-', '0'], "3")
            )),
            None
        );
    }
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
    let scene = mp1::parse_with(text.as_bytes(), &mut |name| {
        asked.push(name.to_owned());
        load("good.png")
    });
    assert_eq!(scene.map(|scene| scene.textures.len()), Ok(2));
    assert_eq!(asked, ["a.png", "b.png"]);
}

#[test]
fn shapes_hold_the_state_of_the_moment() {
    let text = "png 8 8 a.png\nxyzw 1 0 0 1\nrgba 1 2 3 0.5\ntexcoord 7 8\nxyzw 2 0 0 1\nline 1 -1\nrgb 4 5 6\n\
        xyzw 3 0 0 1\n texture good.png\n billboard 2.5 -1\n trit -1 -2 1\npoint 0 1\n";
    let primitives = parse(text).expect("a good scene").primitives;
    let Shape::Line([first, second]) = &primitives[0].shape else {
        panic!("{primitives:?}")
    };
    // A vertex before any colour is white.
    assert_eq!(
        (first.position, first.rgb, first.alpha),
        ([1.0, 0.0, 0.0, 1.0], [255.0; 3], 1.0)
    );
    assert_eq!((first.texcoord, second.texcoord), ([0.0; 2], [7.0, 8.0]));
    assert_eq!((second.rgb, second.alpha), ([1.0, 2.0, 3.0], 0.5));
    let Shape::Billboard(size, center, texture) = &primitives[1].shape else {
        panic!("{primitives:?}")
    };
    // `rgb` makes the alpha 1 again.
    assert_eq!((*size, center.rgb, center.alpha), (2.5, [4.0, 5.0, 6.0], 1.0));
    assert_eq!(texture.pixels, [[1, 2, 3, 4]]);
    assert!(matches!(&primitives[2].shape, Shape::Textured([a, b, c], _) if [a, b, c] == [center, second, first]));
    let places: Vec<_> = primitives.iter().map(|primitive| primitive.place).collect();
    let expected = [(6, 1), (10, 2), (11, 2), (12, 1)];
    assert_eq!(places, expected.map(|(line, column)| Place { line, column }));
}

#[test]
fn lines_end_either_way() {
    let unix = "# a scene\npng 8 8 out.png\n\n\tcull\n xyzw 1 2 3 1\npoint 3 1";
    let dos = format!("\u{feff}{}", unix.replace('\n', "\r\n"));
    assert_eq!(parse(unix), parse(&dos));
    assert!(parse(unix).is_ok());
    assert_eq!(parse("png 8 8 out.png\r\nxyzw 1 2 q 1\r\n"), Err((2, 10)));
}

#[test]
fn the_first_fault_counts() {
    assert_eq!(parse("png 8 8 a.png\nxyzw 1 2 3\nfoo\n"), Err((2, 1)));
    for (text, line, column) in [
        (b"png 8 8 a.png\nxyzw 1 2\n# caf\xE9\n", 2, 1),
        (b"png 8 8 a.png\n# caf\xE9\nxyzw 1 2\n", 2, 6),
    ] {
        let fault = mp1::parse_with(text, &mut load).err();
        assert_eq!(fault.map(|fault| fault.place), Some(Place { line, column }));
    }
}

#[test]
fn a_long_scene_takes_no_longer_per_line() {
    let long = "png 8 8 a.png\n".to_owned() + &"xyzw 1 2 3 1\ntri -1 1 1\n".repeat(200_000);
    assert_eq!(parse(&long).map(|scene| scene.primitives.len()), Ok(200_000));
    let one_line = format!("png 8 8 a.png\ncull{}", " x".repeat(1_000_000));
    assert_eq!(parse(&one_line), Err((2, 1)));
}

#[test]
fn the_257th_clip_plane_is_where_there_are_too_many() {
    let planes = |count: usize| parse(&format!("png 8 8 a.png\n{}", " clipplane 1 0 0 1\n".repeat(count)));
    assert!(planes(256).is_ok());
    assert_eq!(planes(257).err(), Some((258, 2)));
}
