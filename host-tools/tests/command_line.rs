//! The contract of the command line: what is written where, what is refused, and how a run ends.

mod program;

use program::{Folder, Run};

const SCENE: &str = "png 6 5 out.png\nxyz -1 -1 0\nxyz -1 1 0\nxyz 1 -1 0\ncolor 1 .5 .25\ntrif 1 2 3\n";

fn scene(output: &str) -> String {
    SCENE.replace("out.png", output)
}

fn refused(run: &Run, what: &str) {
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(run.err.contains(what), "expected {what:?} in {}", run.err);
}

/// A PNG file of one colour.
fn picture(width: u32, height: u32, pixel: [u8; 4]) -> Vec<u8> {
    let pixels = vec![pixel; (width * height) as usize];
    let picture = fixel_host::picture::Picture::new(width, height, pixels);
    fixel_host::png::encode(&picture).expect("encoded")
}

#[test]
fn a_scene_becomes_a_picture() {
    let folder = Folder::new();
    let run = folder.write("a.txt", SCENE).run("a.txt");
    assert_eq!(run.code, Some(0), "{run:?}");
    assert_eq!(run.out.lines().count(), 1);
    assert!(run.out.starts_with("a.txt: 6x5, "), "{}", run.out);
    assert_eq!(run.err, "");
    assert_eq!(folder.names(), ["a.txt", "out.png"]);
    let picture = fixel_host::png::decode(std::io::Cursor::new(folder.read("out.png"))).expect("a PNG file");
    assert_eq!(picture.size(), (6, 5));
}

#[test]
fn every_picture_has_its_option() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE);
    let run = folder.run("a.txt -o f.png --reference-out r.png --diff-out d.png --depth-out z.png");
    assert_eq!(run.code, Some(0), "{run:?}");
    assert_eq!(folder.names(), ["a.txt", "d.png", "f.png", "r.png", "z.png"]);
    assert_eq!(folder.read("f.png"), folder.read("r.png"));
}

#[test]
fn out_dir_takes_the_names_of_the_scenes() {
    let folder = Folder::new();
    folder.write("a.txt", scene("x.png")).write("b.txt", scene("./y.png"));
    std::fs::create_dir(folder.path("out")).expect("a folder");
    let run = folder.run("a.txt b.txt --out-dir out");
    assert_eq!(run.code, Some(0), "{run:?}");
    let first: Vec<_> = run.out.lines().map(|line| &line[..5]).collect();
    assert_eq!(first, ["a.txt", "b.txt"]);
    assert_eq!(folder.names(), ["a.txt", "b.txt", "out"]);
    assert!(folder.path("out/x.png").exists() && folder.path("out/y.png").exists());
}

#[test]
fn json_has_the_keys_that_stay() {
    let folder = Folder::new();
    folder
        .write("a.txt", SCENE)
        .write("b.txt", scene("b.png"))
        .write("bad.txt", "png 1 1 c.png\nxyz");
    let run = folder.run("--json a.txt bad.txt b.txt");
    assert_eq!(run.code, Some(2), "{run:?}");
    let objects: Vec<serde_json::Value> = run
        .out
        .lines()
        .map(|line| serde_json::from_str(line).expect("one object per line"))
        .collect();
    let scenes: Vec<_> = objects.iter().map(|object| object["scene"].as_str()).collect();
    assert_eq!(scenes, [Some("a.txt"), Some("bad.txt"), Some("b.txt")]);
    let keys = "scene format width height pixels_drawn coverage_differs unexplained max_channel_error rmse psnr \
                seconds_fixed seconds_reference explained";
    for key in keys.split_whitespace() {
        assert!(objects[0].get(key).is_some(), "{key} is missing");
    }
    for class in ["colour", "edge", "depth", "texel", "pole", "steep"] {
        assert!(objects[0]["explained"][class].is_u64(), "{class} is missing");
    }
    assert_eq!(
        (&objects[0]["format"], &objects[0]["width"]),
        (&"hw2".into(), &6.into())
    );
    assert!(objects[0].get("against_fixed").is_none());
    assert_eq!((&objects[1]["line"], &objects[1]["column"]), (&2.into(), &1.into()));
}

#[test]
fn against_counts_what_is_over_two_percent() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE);
    assert_eq!(folder.run("a.txt --reference-out ref.png").code, Some(0));
    let run = folder.run("a.txt --json --against ref.png");
    assert_eq!(run.code, Some(0), "{run:?}");
    let object: serde_json::Value = serde_json::from_str(&run.out).expect("an object");
    for picture in ["against_fixed", "against_reference"] {
        let keys = ["over_2_percent", "over_2_percent_outside_ties", "max_channel_error"];
        assert!(keys.iter().all(|key| object[picture][key] == 0), "{object}");
        assert_eq!(object[picture]["identical"], true);
    }
    folder
        .write("white.png", picture(6, 5, [255; 4]))
        .write("ties.png", picture(6, 5, [255; 4]));
    let run = folder.run("a.txt --json --against white.png");
    assert_eq!(run.code, Some(1), "{run:?}");
    let object: serde_json::Value = serde_json::from_str(&run.out).expect("an object");
    assert_eq!(object["against_fixed"]["over_2_percent_outside_ties"], 30);
    let run = folder.run("a.txt --json --against white.png --ties ties.png");
    // Every pixel is excused, but the reference is not the picture.
    assert_eq!(run.code, Some(1), "{run:?}");
    let object: serde_json::Value = serde_json::from_str(&run.out).expect("an object");
    assert_eq!(object["against_fixed"]["over_2_percent"], 30);
    assert_eq!(object["against_fixed"]["over_2_percent_outside_ties"], 0);
}

#[test]
fn what_is_compared_must_fit() {
    let folder = Folder::new();
    folder
        .write("a.txt", SCENE)
        .write("small.png", picture(5, 5, [0; 4]))
        .write("ref.png", picture(6, 5, [0; 4]));
    refused(&folder.run("a.txt --against small.png"), "5x5");
    refused(&folder.run("a.txt --against ref.png --ties small.png"), "5x5");
    assert_eq!(folder.run("a.txt --against nosuch.png").code, Some(3));
    assert_eq!(folder.run("a.txt --against a.txt").code, Some(3));
    assert_eq!(folder.names(), ["a.txt", "ref.png", "small.png"]);
}

#[test]
fn outputs_must_not_collide() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE).write("b.txt", scene("./x/../out.png"));
    refused(&folder.run("a.txt b.txt"), "would both write");
    refused(&folder.run("a.txt -o x.png --diff-out ./x.png"), "two pictures");
    refused(&folder.run("a.txt --depth-out out.png"), "two pictures");
    assert_eq!(folder.names(), ["a.txt", "b.txt"]);
}

/// An object for every scene, whatever becomes of them.
#[test]
fn scenes_that_collide_have_objects_too() {
    let folder = Folder::new();
    folder
        .write("a.txt", SCENE)
        .write("b.txt", SCENE)
        .write("bad.txt", "png 1 1 c.png\nxyz");
    let run = folder.run("a.txt bad.txt b.txt --json --report r.html");
    let collision = "a.txt and b.txt would both write ./out.png";
    let expected: [(_, _, Option<u64>); 3] = [
        ("a.txt", collision, None),
        ("bad.txt", "bad.txt: line 2", Some(2)),
        ("b.txt", collision, None),
    ];
    refused(&run, collision);
    assert_eq!(run.out.lines().count(), expected.len(), "{}", run.out);
    for (line, (scene, error, place)) in run.out.lines().zip(expected) {
        let object: serde_json::Value = serde_json::from_str(line).expect("an object");
        assert_eq!((&object["scene"], &object["exit"]), (&scene.into(), &2.into()));
        assert!(
            object["error"].as_str().is_some_and(|text| text.starts_with(error)),
            "{line}"
        );
        assert_eq!(object["line"].as_u64(), place, "{line}");
    }
    // The scene's own fault first, the collision once.
    assert!(run.err.starts_with("bad.txt: line 2, column 1: "), "{}", run.err);
    assert_eq!(run.err.lines().count(), 2, "{}", run.err);

    let run = folder.run("a.txt a.txt --json");
    refused(&run, "a.txt is named twice, and would write ./out.png twice");
    assert_eq!(run.out.lines().count(), 2, "{}", run.out);
    assert_eq!(folder.names(), ["a.txt", "b.txt", "bad.txt"]);
}

#[test]
fn what_is_read_is_never_written() {
    let folder = Folder::new();
    let png = picture(6, 5, [0; 4]);
    let textured = scene("t.png").replace("xyz -1 -1 0", "texture t.png\nxyz -1 -1 0");
    folder
        .write("a.txt", SCENE)
        .write("self.txt", scene("self.txt"))
        .write("t.txt", textured);
    folder
        .write("t.png", &png)
        .write("ref.png", &png)
        .write("ties.png", &png);
    for (arguments, what) in [
        ("self.txt", "overwrite a scene"),
        ("a.txt -o a.txt", "overwrite a scene"),
        ("a.txt -o x/../a.txt --out-dir .", "overwrite a scene"),
        ("t.txt", "overwrite a texture"),
        ("t.txt -o ok.png --diff-out t.png", "overwrite a texture"),
        ("a.txt --against ref.png -o ./ref.png", "overwrite --against"),
        (
            "a.txt --against ref.png --ties ties.png --depth-out ties.png",
            "overwrite --ties",
        ),
    ] {
        if arguments.contains("x/..") {
            std::fs::create_dir(folder.path("x")).expect("a folder");
        }
        refused(&folder.run(arguments), what);
    }
    assert_eq!(folder.read("t.png"), png);
    assert_eq!(folder.read("a.txt"), SCENE.as_bytes());
    assert!(!folder.path("ok.png").exists() && !folder.path("out.png").exists());
}

/// What a scene names is its own even while the scene has a fault: its author is going to mend it.
#[test]
fn textures_of_bad_scenes_are_never_written() {
    let folder = Folder::new();
    let brick = picture(6, 5, [9; 4]);
    folder
        .write("brick.png", &brick)
        .write("before.txt", "png 6 5 q.png\nxyz 1 2\ntexture ./brick.png\n")
        .write("behind.txt", "png 6 5 q.png\ntexture brick.png\nxyz 1 2\n")
        .write("m.txt", "png 6 5 q.png\nsRGB\ntexture brick.png\nxyzw 1 2\n")
        .write(
            "good.txt",
            scene("q.png").replace("xyz -1 -1 0", "texture brick.png\nxyz -1 -1 0"),
        )
        .write("over.txt", scene("brick.png"))
        .write("brick.iv", IV);
    for arguments in [
        "before.txt over.txt",
        "over.txt behind.txt",
        "over.txt m.txt",
        "behind.txt --report brick.png",
        "good.txt brick.iv --eyelight",
    ] {
        let run = folder.run(arguments);
        refused(&run, "brick.png would overwrite a texture");
        assert!(folder.read("brick.png") == brick, "{arguments}");
        assert!(!folder.path("q.png").exists(), "{arguments}");
    }
}

#[test]
fn a_scene_that_fails_takes_no_other_down() {
    let folder = Folder::new();
    folder
        .write("good.txt", scene("good.png"))
        .write("bad.txt", scene("/bad.png"));
    let run = folder.run("bad.txt good.txt");
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(run.err.starts_with("bad.txt: line 1, column 9: "), "{}", run.err);
    assert!(run.out.starts_with("good.txt: "), "{}", run.out);
    let run = folder.run("nosuch.txt bad.txt good.txt");
    assert_eq!(run.code, Some(3), "{run:?}");
    assert_eq!(run.err.lines().count(), 2);
    assert!(run.err.starts_with("nosuch.txt: cannot read: "), "{}", run.err);
    assert_eq!(folder.names(), ["bad.txt", "good.png", "good.txt"]);
}

/// To run out of memory ends a program on the spot.
#[cfg(target_os = "linux")]
#[test]
fn a_scene_that_has_no_room_takes_no_other_down() {
    let folder = Folder::new();
    folder
        .write("a.txt", SCENE)
        .write("big.txt", scene("big.png").replace("6 5", "16384 4096"))
        .write("samples.txt", "png 4096 1024 s.png\nfsaa 4\n");
    let run = folder.run_within(1 << 30, "big.txt a.txt samples.txt --json");
    for file in [
        "big.txt: a picture of 16384x4096",
        "samples.txt: a picture of 4096x1024",
    ] {
        refused(
            &run,
            &format!("{file} takes 4096 MiB of memory and more, which cannot be had\n"),
        );
    }
    assert_eq!(run.out.lines().count(), 3, "{}", run.out);
    assert_eq!(folder.names(), ["a.txt", "big.txt", "out.png", "samples.txt"]);
}

#[test]
fn other_formats_and_keywords_are_told_apart() {
    let folder = Folder::new();
    folder
        .write("m.txt", "png 1 1 m.png\nxyzw 0 0 0 1\n sRGB\n")
        .write("s.iv", "#Inventor V2.0 ascii\nSeparator { }\n PointLamp { }")
        .write("c.obj", "v 0 0 0\nv 1 0 0\n f 1 2 3\n")
        .write(
            "n.txt",
            "png 1 1 n.png\nxyz 0 0 0\n shininess 3\nsunlight 0 0 1\nxyz 0 0 0\nxyz 1 0 0\ntrig 1 2 3\n",
        );
    for (arguments, start) in [
        ("m.txt", "m.txt: line 3, column 2: sRGB must come right after png"),
        ("s.iv", "s.iv: line 3, column 2: unknown block 'PointLamp'"),
        ("c.obj", "c.obj: line 3, column 8: no such vertex: 2 made so far"),
        ("n.txt --format obj", "n.txt: line 1, column 1: no faces"),
        ("c.obj --format iv", "c.obj: line 1, column 1: unknown block 'v'"),
        (
            "c.obj --format hw2",
            "c.obj: line 1, column 1: the first command must be png",
        ),
    ] {
        let run = folder.run(arguments);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(run.err.starts_with(start), "{}", run.err);
    }
    assert_eq!(folder.names(), ["c.obj", "m.txt", "n.txt", "s.iv"]);
}

/// A square in front of the camera, in the colours that make every channel 255.
const IV: &str = "PerspectiveCamera { position 0 0 3 }\nSeparator {\n Material { ambientColor 1 1 1 }\n \
    Coordinate3 { point [ -1 -1 0, 1 -1 0, 1 1 0, -1 1 0 ] }\n Normal { vector [ 0 0 1 ] }\n \
    IndexedFaceSet { coordIndex [ 0,1,2,3,-1 ] normalIndex [ 0,0,0,0,-1 ] }\n}\n";

const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn options_of_scenes_that_leave_them_open() {
    let folder = Folder::new();
    folder
        .write("h.txt", SCENE)
        .write("m.txt", "png 6 5 m.png\nsRGB\n")
        .write("s.iv", IV)
        .write("c.obj", OBJ);
    for option in ["--size 9x9", "--shading phong", "--eyelight"] {
        let name = option.split(' ').next().unwrap_or_default();
        for (file, format) in [("h.txt", "hw2"), ("m.txt", "mp1"), ("s.iv --format hw2", "hw2")] {
            let run = folder.run(&format!("{file} {option}"));
            refused(&run, &format!("{name} is for iv and obj scenes, this one is {format}"));
            assert_eq!(run.err.lines().count(), 1, "{}", run.err);
        }
    }
    for bad in [
        "--size 0x9",
        "--size 9",
        "--size 16384x16384",
        "--shading none",
        "--size",
    ] {
        assert_eq!(folder.run(&format!("s.iv {bad}")).code, Some(2), "{bad}");
    }
    assert_eq!(folder.names(), ["c.obj", "h.txt", "m.txt", "s.iv"]);
    let two = folder.write("s.obj", OBJ).run("s.iv s.obj");
    refused(&two, "would both write");
}

/// Size, shading and name of the picture where nobody says otherwise.
#[test]
fn inventor_and_wavefront_scenes_have_defaults() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("sub")).expect("a folder");
    folder.write("sub/s.iv", IV).write("c.d.obj", OBJ);
    let run = folder.run("--json sub/s.iv c.d.obj");
    assert_eq!(run.code, Some(0), "{run:?}");
    let objects: Vec<serde_json::Value> = run
        .out
        .lines()
        .map(|line| serde_json::from_str(line).expect("one object per line"))
        .collect();
    for (object, format) in objects.iter().zip(["iv", "obj"]) {
        assert_eq!(object["format"], format);
        assert_eq!((&object["width"], &object["height"]), (&500.into(), &500.into()));
        assert!(
            object["pixels_drawn"].as_u64().is_some_and(|pixels| pixels > 1000),
            "{object}"
        );
    }
    assert_eq!(folder.names(), ["c.d.obj", "c.d.png", "s.png", "sub"]);
    let decoded = |name: &str| fixel_host::png::decode(std::io::Cursor::new(folder.read(name))).expect("a PNG file");
    assert_eq!(decoded("s.png").size(), (500, 500));
    assert_eq!(decoded("s.png").pixels[250 * 500 + 250], [255; 4]);
    assert_eq!(folder.run("sub/s.iv --shading gouraud -o g.png").code, Some(0));
    assert_eq!(folder.read("g.png"), folder.read("s.png"));
    assert_eq!(
        folder
            .run("c.d.obj --size 40x30 --shading flat --eyelight -o f.png")
            .code,
        Some(0)
    );
    assert_eq!(decoded("f.png").size(), (40, 30));
}

#[test]
fn an_mp1_scene_becomes_a_picture() {
    let folder = Folder::new();
    let text = "png 9 7 m.png\nsRGB\nrgba 255 9 9 .5\nxyzw -1 -1 0 1\nxyzw 1 -1 0 1\nxyzw 0 1 0 1\ntri 1 2 3\n";
    let shared = "png 9 7 s.png\nxyzw -1 -1 0 1\nxyzw 1 -1 0 1\nxyzw 0 1 0 1\ntexture m.png\ntrit 1 2 3\n";
    folder.write("m.txt", text).write("s.txt", shared);
    for (arguments, output) in [("m.txt --json", "m.png"), ("s.txt --json --format mp1", "s.png")] {
        let run = folder.run(arguments);
        assert_eq!(run.code, Some(0), "{run:?}");
        let object: serde_json::Value = serde_json::from_str(&run.out).expect("an object");
        assert_eq!((&object["format"], &object["unexplained"]), (&"mp1".into(), &0.into()));
        let picture = fixel_host::png::decode(std::io::Cursor::new(folder.read(output))).expect("a PNG file");
        assert_eq!(picture.size(), (9, 7));
    }
}

#[test]
fn what_the_core_cannot_hold_is_refused_at_its_keyword() {
    let folder = Folder::new();
    folder
        .write(
            "bright.txt",
            "png 9 7 a.png\nrgba 32640 0 0 1\nxyzw 0 0 0 1\n point 3 1\n",
        )
        .write(
            "large.txt",
            "png 9 7 b.png\nrgba 1 1 1 1\nxyzw 0 0 0 1\n  circle 5000000 1\n",
        );
    for (arguments, start) in [
        ("bright.txt", "bright.txt: line 4, column 2: a colour of 32640"),
        ("large.txt", "large.txt: line 4, column 3: a size of 5000000"),
    ] {
        let run = folder.run(arguments);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(run.err.starts_with(start), "{}", run.err);
    }
    assert_eq!(folder.names(), ["bright.txt", "large.txt"]);
}

#[test]
fn files_that_cannot_be_had() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE);
    std::fs::create_dir(folder.path("out.png")).expect("a folder");
    for (arguments, file) in [
        ("a.txt", "out.png: "),
        (
            "a.txt -o nosuch/x.png",
            "nosuch/x.png: cannot write: there is no folder nosuch\n",
        ),
        (
            "a.txt --out-dir nosuch",
            "nosuch/out.png: cannot write: there is no folder nosuch\n",
        ),
        ("a.txt --out-dir a.txt", "a.txt/out.png: "),
        ("a.txt -o x.png --diff-out nosuch/x.png", "nosuch/x.png: "),
        ("a.txt -o new/", "new/: "),
        ("out.png", "out.png: cannot read: "),
    ] {
        let run = folder.run(arguments);
        assert_eq!(run.code, Some(3), "{run:?}");
        assert!(run.err.contains(file), "{}", run.err);
        assert_eq!(run.err.lines().count(), 1, "{}", run.err);
        let scene = arguments.split(' ').next().unwrap_or_default();
        assert!(run.err.starts_with(&format!("{scene}: ")), "{}", run.err);
    }
    let run = folder.run("a.txt -o out.png");
    assert!(run.err.contains("it is a directory"), "{}", run.err);
    assert_eq!(folder.names(), ["a.txt", "out.png"]);
}

#[test]
fn a_bad_scene_is_told_before_a_report_that_cannot_be_written() {
    let folder = Folder::new();
    let run = folder
        .write("bad.txt", "png 1 1 c.png\nxyz")
        .run("bad.txt --report nosuch/r.html");
    assert_eq!(run.code, Some(3), "{run:?}");
    assert!(run.err.starts_with("bad.txt: line 2, column 1: "), "{}", run.err);
    assert!(run.err.contains("\nnosuch/r.html: cannot write: "), "{}", run.err);
}

#[test]
fn bad_usage() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE).write("b.txt", scene("b.png"));
    for arguments in [
        "",
        "--nosuch a.txt",
        "a.txt b.txt -o x.png",
        "a.txt --ties t.png",
        "a.txt --format gif",
    ] {
        assert_eq!(folder.run(arguments).code, Some(2), "{arguments}");
    }
    assert_eq!(folder.run("--help").code, Some(0));
    assert_eq!(folder.names(), ["a.txt", "b.txt"]);
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

    #[test]
    fn links_hide_no_collision() {
        let folder = Folder::new();
        folder.write("a.txt", SCENE).write("b.txt", scene("b.png"));
        symlink("a.txt", folder.path("soft.png")).expect("a link");
        symlink("nosuch.png", folder.path("dangling.png")).expect("a link");
        symlink(".", folder.path("here")).expect("a link");
        std::fs::hard_link(folder.path("a.txt"), folder.path("hard.png")).expect("a link");
        for arguments in [
            "a.txt -o soft.png",
            "a.txt -o hard.png",
            "a.txt -o here/a.txt",
            "a.txt -o dangling.png --diff-out here/nosuch.png",
            "a.txt --depth-out here/out.png",
        ] {
            let run = folder.run(arguments);
            assert_eq!(run.code, Some(2), "{arguments}: {run:?}");
        }
        assert_eq!(folder.read("a.txt"), SCENE.as_bytes());
    }

    #[test]
    fn a_link_keeps_pointing_and_a_file_keeps_its_mode() {
        let folder = Folder::new();
        folder.write("a.txt", SCENE).write("real.png", "old").write("plain", "");
        let mode = |name: &str| {
            let found = std::fs::metadata(folder.path(name)).expect("a file");
            found.permissions().mode() & 0o777
        };
        let narrow = std::fs::Permissions::from_mode(0o640);
        std::fs::set_permissions(folder.path("real.png"), narrow).expect("a mode");
        symlink("real.png", folder.path("link.png")).expect("a link");
        assert_eq!(folder.run("a.txt -o link.png --diff-out new.png").code, Some(0));
        assert!(folder.path("link.png").is_symlink());
        assert!(folder.read("real.png").starts_with(b"\x89PNG"));
        assert_eq!(mode("real.png"), 0o640);
        assert_eq!(mode("new.png"), mode("plain"), "as any new file");
    }

    /// Whoever opened it for us, as `>>` of a shell does, wants it written where it stands.
    #[test]
    fn standard_output_is_written_to_and_not_replaced() {
        let folder = Folder::new();
        folder.write("a.txt", SCENE);
        for (redirection, before) in [("1>>all", "old\n"), ("1>all", ""), ("3>>all", "old\n")] {
            folder.write("all", "old\n");
            let number = &redirection[..1];
            let shell = format!("exec \"$0\" a.txt -o /dev/fd/{number} {redirection}");
            let status = std::process::Command::new("sh")
                .args(["-c", &shell, env!("CARGO_BIN_EXE_host-render")])
                .current_dir(folder.path("."))
                .stdout(std::process::Stdio::null())
                .status()
                .expect("a shell");
            assert_eq!(status.code(), Some(0), "{redirection}");
            let all = folder.read("all");
            let picture = all.strip_prefix(before.as_bytes()).expect(redirection);
            assert!(picture.starts_with(b"\x89PNG"), "{redirection}");
            let line = String::from_utf8_lossy(picture).contains("a.txt: 6x5, ");
            assert_eq!(line, number == "1", "{redirection}");
            assert_eq!(folder.names(), ["a.txt", "all"]);
        }
    }

    #[test]
    fn nobody_is_waited_for_at_a_pipe() {
        let folder = Folder::new();
        let made = std::process::Command::new("mkfifo")
            .arg(folder.path("pipe.png"))
            .status()
            .expect("mkfifo");
        assert!(made.success());
        let run = folder.write("a.txt", SCENE).run("a.txt --against pipe.png");
        assert_eq!(run.code, Some(3), "{run:?}");
        assert_eq!(run.err, "pipe.png: cannot read: not a file\n");
    }

    #[test]
    fn a_device_is_written_to_and_not_replaced() {
        let folder = Folder::new();
        let run = folder
            .write("a.txt", SCENE)
            .run("a.txt -o /dev/null --diff-out /dev/null");
        assert_eq!(run.code, Some(0), "{run:?}");
        let device = std::fs::metadata("/dev/null").expect("a device");
        assert!(device.file_type().is_char_device());
    }
}

#[test]
fn the_help_names_the_tiers_and_the_sweep() {
    let folder = Folder::new();
    let run = folder.run("--help");
    assert_eq!(run.code, Some(0), "{run:?}");
    for text in [
        "--quality",
        "fast",
        "balanced",
        "exact",
        "host-render sweep",
        "counted as unexplained",
    ] {
        assert!(run.out.contains(text), "no {text:?} in {}", run.out);
    }
    let run = folder.run("sweep --help");
    assert_eq!(run.code, Some(0), "{run:?}");
    for text in ["--max-error", "--max-instructions", "--csv", "valgrind"] {
        assert!(run.out.contains(text), "no {text:?} in {}", run.out);
    }
    assert!(!run.out.contains("--draw"), "{}", run.out);
}

#[test]
fn commands_name_themselves() {
    let folder = Folder::new();
    for (command, text) in [
        ("emit", "Exit codes: 0 written, "),
        ("sweep", "Exit codes: 0 done, "),
        ("extremes", "Exit codes: 0 every bound holds"),
    ] {
        let help = folder.run(&format!("{command} --help"));
        assert_eq!(help.code, Some(0), "{help:?}");
        let usage = format!("Usage: host-render {command} [OPTIONS]");
        assert!(help.out.contains(&usage) && help.out.contains(text), "{}", help.out);
        let wrong = folder.run(&format!("{command} --nosuch"));
        refused(&wrong, &format!("Usage: host-render {command} "));
        let version = folder.run(&format!("{command} -V"));
        assert_eq!(version.code, Some(0), "{version:?}");
        assert!(
            version.out.starts_with(&format!("host-render {command} ")),
            "{}",
            version.out
        );
    }
}

/// Before a minute's work.
#[test]
fn charts_of_extremes_have_a_folder_or_are_not_drawn() {
    let folder = Folder::new();
    let run = folder.run("extremes --out-dir nosuch");
    assert_eq!(run.code, Some(3), "{run:?}");
    assert!(run.err.contains("there is no folder nosuch"), "{}", run.err);
    assert_eq!(run.out, "");
}

#[test]
fn what_is_emitted_says_by_which_command() {
    let folder = Folder::new();
    let run = folder
        .write("it's.txt", SCENE)
        .run("emit it's.txt -o x.rs --format hw2");
    assert_eq!(run.code, Some(0), "{run:?}");
    let text = String::from_utf8(folder.read("x.rs")).expect("UTF-8");
    let line = text.lines().next().unwrap_or_default();
    assert_eq!(line, "// Made by: host-render emit \"it's.txt\" -o x.rs --format hw2");
}

#[test]
fn messages_say_what_is_wrong() {
    let folder = Folder::new();
    folder
        .write("a.txt", SCENE)
        .write("c.obj", OBJ)
        .write(
            "bright.txt",
            scene("b.png").replace("color", "sunlight 0 0 1\nshininess 70000\ncolor"),
        )
        .write("far.iv", IV.replace("0,1,2,3,-1", "0,1,1e300,3,-1"));
    for (arguments, message) in [
        ("sweep a.txt --max-error 0.5", "a whole number from 0 to 255 is wanted"),
        (
            "emit c.obj -o c.rs --mesh --shading phong",
            "--mesh takes --shading flat or gouraud",
        ),
        (
            "bright.txt",
            "bright.txt: line 6, column 1: a shininess of 70000: the core takes exponents below 65536",
        ),
        ("far.iv", "coordinate index 1e300 out of range (4 points)"),
    ] {
        let run = folder.run(arguments);
        refused(&run, message);
        assert!(
            !arguments.contains("--mesh") || run.err.starts_with(message),
            "{}",
            run.err
        );
    }
}
