//! Textures that are not what they claim: one clear error each, at the texture's name, in little memory.

mod program;

use program::Folder;

/// A scene that draws with `t.png`, whose name stands in line 2, column 11.
const SCENE: &str = "png 4 4 out.png\n  texture t.png\nxyz -1 -1 0\nxyz 3 -1 0\ntexcoord 0 1\nxyz -1 3 0\ntrit 1 2 3\n";
const START: &str = "s.txt: line 2, column 11: texture `t.png`: ";

/// Runs the scene with an address space of 64 MiB in all, so that memory that is asked for and not used counts too.
fn run(texture: &[u8]) -> program::Run {
    let folder = Folder::new();
    folder.write("s.txt", SCENE).write("t.png", texture);
    let run = folder.run_within(64 << 20, "s.txt");
    if run.code != Some(0) {
        assert_eq!(folder.names(), ["s.txt", "t.png"], "something was written");
    }
    run
}

/// A picture of this size, all pixels 0.
fn blank(color: png::ColorType, (width, height): (u32, u32)) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().expect("a header");
    let size = color.samples() * width as usize * height as usize;
    writer.write_image_data(&vec![0; size]).expect("data");
    writer.finish().expect("an end");
    bytes
}

/// A file with these chunks.
fn file(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in chunks {
        bytes.extend(u32::try_from(data.len()).expect("short").to_be_bytes());
        let start = bytes.len();
        bytes.extend(*kind);
        bytes.extend(*data);
        bytes.extend(crc(&bytes[start..]).to_be_bytes());
    }
    bytes
}

fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xEDB8_8320 & 0_u32.wrapping_sub(crc & 1))
        })
    })
}

/// Data of the header: 8-bit RGBA.
fn header(width: u32, height: u32) -> Vec<u8> {
    [&width.to_be_bytes()[..], &height.to_be_bytes(), &[8, 6, 0, 0, 0]].concat()
}

/// Where the first chunk of a kind starts, and its data's length.
fn find(bytes: &[u8], kind: &[u8; 4]) -> (usize, usize) {
    let at = bytes.windows(4).position(|window| window == kind).expect("the chunk");
    let length: [u8; 4] = bytes[at - 4..at].try_into().expect("four bytes");
    (at, u32::from_be_bytes(length) as usize)
}

/// With another last byte of the pixels' checksum (that of zlib), the chunk's being right.
fn wrong_sum(mut bytes: Vec<u8>) -> Vec<u8> {
    let (at, length) = find(&bytes, b"IDAT");
    let end = at + 4 + length;
    bytes[end - 1] ^= 1;
    let sum = crc(&bytes[at..end]);
    bytes[end..end + 4].copy_from_slice(&sum.to_be_bytes());
    bytes
}

/// The pixels of `from` under a header that says something else.
fn with_header(from: &[u8], width: u32, height: u32) -> Vec<u8> {
    let (at, length) = find(from, b"IDAT");
    let data = &from[at + 4..at + 4 + length];
    file(&[(b"IHDR", &header(width, height)), (b"IDAT", data), (b"IEND", &[])])
}

#[test]
fn hostile_textures_have_one_clear_error_and_little_memory() {
    let good = blank(png::ColorType::Rgba, (8, 8));
    let mut wrong_crc = good.clone();
    let (data, _) = find(&good, b"IDAT");
    wrong_crc[data + 6] ^= 4;
    let mut endless_chunk = good[..data - 4].to_vec();
    endless_chunk.extend(b"\x7f\xff\xff\xffpHYs\0\0\0\0");
    let empty_palette = [0, 0, 0, 8, 0, 0, 0, 8, 8, 3, 0, 0, 0];
    let largest = blank(png::ColorType::Rgba, (4096, 2048));
    for (what, texture, message) in [
        ("truncated", good[..good.len() / 2].to_vec(), "it ends too early"),
        ("without its end", good[..good.len() - 12].to_vec(), "not a "),
        ("not PNG", b"png 8 8 out.png\n".to_vec(), "not a PNG file"),
        ("empty", Vec::new(), "it ends too early"),
        ("a wrong checksum", wrong_crc, "not a readable PNG file"),
        (
            "a wrong checksum of the pixels",
            wrong_sum(good.clone()),
            "not a readable PNG file",
        ),
        (
            "a huge header",
            with_header(&good, 0x7fff_ffff, 0x7fff_ffff),
            "too large",
        ),
        ("zero texels", with_header(&good, 0, 8), "not a readable PNG file"),
        ("a bomb", blank(png::ColorType::Grayscale, (8192, 8192)), "too large"),
        ("too long", blank(png::ColorType::Grayscale, (16385, 1)), "too large"),
        (
            "a header beyond its data",
            with_header(&good, 2048, 4096),
            "cannot come out of",
        ),
        ("too few rows", with_header(&good, 8, 9), "not a "),
        ("an endless chunk", endless_chunk, "not a "),
        (
            "no palette",
            file(&[(b"IHDR", &empty_palette), (b"IDAT", &[]), (b"IEND", &[])]),
            "not a ",
        ),
        (
            "the largest, wrong at its end",
            wrong_sum(largest),
            "not a readable PNG file",
        ),
    ] {
        let run = run(&texture);
        assert_eq!(run.code, Some(2), "{what}: {run:?}");
        assert_eq!(run.out, "", "{what}");
        assert!(
            run.err.starts_with(START) && run.err.contains(message),
            "{what}: {}",
            run.err
        );
        assert_eq!(run.err.lines().count(), 1, "{what}: {}", run.err);
    }
}

#[test]
fn what_is_no_file_is_no_texture() {
    let folder = Folder::new();
    folder.write("s.txt", SCENE);
    let run = folder.run("s.txt");
    assert!(run.code == Some(2) && run.err.starts_with(START), "{run:?}");
    std::fs::create_dir(folder.path("t.png")).expect("a folder");
    let run = folder.run("s.txt");
    assert!(
        run.code == Some(2) && run.err == format!("{START}not a file\n"),
        "{run:?}"
    );
}

#[test]
fn many_textures_share_a_limit() {
    let folder = Folder::new();
    let largest = blank(png::ColorType::Grayscale, (4096, 2048));
    let mut scene = "png 4 4 out.png\n".to_owned();
    for i in 0..9 {
        folder.write(&format!("{i}.png"), &largest);
        scene += &format!("texture {i}.png\n");
    }
    let run = folder.write("s.txt", scene).run("s.txt");
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(
        run.err.starts_with("s.txt: line 10, column 9: ") && run.err.contains("too large"),
        "{run:?}"
    );
}

#[test]
fn a_picture_of_ours_is_a_texture() {
    let folder = Folder::new();
    // The lower right half stays transparent black.
    folder.write(
        "t.txt",
        "png 5 3 t.png\ncolor 1 .5 0\nxyz -1 -1 0\nxyz 1 -1 0\nxyz -1 1 0\ntrif 1 2 3\n",
    );
    assert_eq!(folder.run("t.txt").code, Some(0));
    let run = folder.write("s.txt", SCENE).run("s.txt --reference-out ref.png");
    assert!(run.err.is_empty() && run.code.is_some_and(|code| code < 2), "{run:?}");
    let drawn = folder.read("ref.png");
    let mut reader = png::Decoder::new(std::io::Cursor::new(drawn))
        .read_info()
        .expect("a PNG file");
    let mut pixels = [[0; 4]; 16];
    reader.next_frame(pixels.as_flattened_mut()).expect("pixels");
    // All of its texels are opaque now: alpha is ignored without decals. At (-1, -1) is the texel (0, 0).
    assert!(pixels.iter().all(|pixel| pixel[3] == 255));
    assert_eq!(pixels[0], [255, 127, 0, 255]);
}
