//! Pictures enlarged by whole numbers: every pixel shows the texel that exact arithmetic gives, though many coordinates lie on the
//! border between two of them.

mod program;

use fixel_host::picture::Picture;
use program::Folder;

/// Grey levels that are the texels' own numbers, from the upper left.
fn texture(width: u32, height: u32) -> Vec<u8> {
    let texels = (0..width * height).map(|i| {
        let level = i as u8;
        [level, level, level, 255]
    });
    fixel_host::png::encode(&Picture::new(width, height, texels.collect())).expect("a picture")
}

/// The red of each pixel of the fixed-point core's picture.
fn drawn(scene: &str, texture: &[u8], format: &str) -> Vec<u8> {
    let folder = Folder::new();
    folder.write("s.txt", scene).write("t.png", texture);
    let run = folder.run(&format!("s.txt --format {format}"));
    // Where float64 has rounded a border the other way, that is no difference that is not explained; nothing else is looked at.
    assert!(matches!(run.code, Some(0 | 1)), "{}{}", run.out, run.err);
    assert_eq!(folder.names(), ["o.png", "s.txt", "t.png"]);
    let bytes = folder.read("o.png");
    let picture = fixel_host::png::decode(std::io::Cursor::new(bytes)).expect("a picture");
    picture.pixels.iter().map(|[red, ..]| *red).collect()
}

/// All of a square picture of `side` pixels, with the whole texture or a part of it.
fn quad(side: u32, far: f64, start: f64) -> String {
    let corner = |x: i32, y: i32| {
        let [s, t] = [x, y].map(|c| start + if c > 0 { far } else { 0.0 });
        format!("texcoord {s} {t}\nxyzw {x} {y} 0 1\n")
    };
    let corners: String = [(-1, -1), (1, -1), (1, 1), (-1, 1)].map(|(x, y)| corner(x, y)).concat();
    format!("png {side} {side} o.png\ntexture t.png\n{corners}trit 1 2 3\ntrit 1 3 4\n")
}

/// floor(n/d + ½).
fn nearest(n: i64, d: i64) -> i64 {
    (2 * n + d).div_euclid(2 * d)
}

#[test]
fn whole_pictures_of_hw2_and_mp1() {
    for (side, size) in [
        (16, 8),
        (16, 4),
        (64, 8),
        (20, 10),
        (40, 10),
        (30, 10),
        (48, 16),
        (45, 15),
    ] {
        let texture = texture(size, size);
        for periods in [1, 2] {
            // Samples of both formats are at whole numbers.
            let texel = |pixel: u32| nearest((pixel * periods * size).into(), side.into()) as u32 % size;
            let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
            let wanted: Vec<_> = pixels.map(|(x, y)| (texel(y) * size + texel(x)) as u8).collect();
            for format in ["hw2", "mp1"] {
                let found = drawn(&quad(side, f64::from(periods), 0.0), &texture, format);
                let off = found.iter().zip(&wanted).filter(|(a, b)| a != b).count();
                assert_eq!(off, 0, "{format}: {size} texels {periods} times on {side} pixels");
            }
        }
    }
}

/// Below zero a coordinate of MP1 is cut towards zero, so that borders belong to the other side.
#[test]
fn negative_coordinates_of_mp1() {
    let (side, size) = (16, 8);
    let found = drawn(&quad(side, 1.0, -2.0), &texture(size, size), "mp1");
    let texel = |pixel: u32| {
        // trunc(n/(2·side) + ½) of what is negative.
        let twice = 2 * i64::from(pixel * size) - 4 * i64::from(size * side);
        let cut = (twice + i64::from(side)) / i64::from(2 * side);
        cut.rem_euclid(i64::from(size)) as u32
    };
    let off = (0..side * side).filter(|i| u32::from(found[*i as usize]) != texel(i / side) * size + texel(i % side));
    assert_eq!(off.count(), 0);
}

#[test]
fn billboards() {
    for (size, texels) in [(16, 8), (48, 8), (40, 10), (30, 15)] {
        let scene = format!("png 64 64 o.png\nxyzw 0 0 0 1\ntexture t.png\nbillboard {size} 1\n");
        let found = drawn(&scene, &texture(texels, texels), "mp1");
        let texel = |pixel: u32| nearest((pixel * texels).into(), size.into()) as u32 % texels;
        let first = 32 - size / 2;
        let off = (0..size * size).filter(|i| {
            let (x, y) = (i % size, i / size);
            u32::from(found[((first + y) * 64 + first + x) as usize]) != texel(y) * texels + texel(x)
        });
        assert_eq!(off.count(), 0, "{texels} texels on {size} pixels");
    }
}
