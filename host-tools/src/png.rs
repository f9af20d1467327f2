//! PNG, in and out. Whatever comes in is bounded by its header before anything is allocated for it.

use std::io::{BufRead, Seek, SeekFrom};

use png::{ColorType, Decoder, DecodingError, Encoder, EncodingError, Limits, Reader, Transformations};

use crate::picture::Picture;
use crate::scene::{LONGEST_SIDE, MOST_PIXELS};

/// The most texels of a texture: 32 MiB as RGBA.
pub const MOST_TEXELS: u64 = 1 << 23;
/// What one chunk beside the pixels, or a few rows of them, may take: bytes.
const LARGEST_CHUNK: usize = 1 << 22;
/// The most bytes that deflate makes of one (RFC 1951: a match of 258 bytes in 2 bits).
const DEFLATE: u64 = 1032;

/// The bytes of an 8-bit RGBA PNG file.
pub fn encode(picture: &Picture) -> Result<Vec<u8>, EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, picture.width, picture.height);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(picture.pixels.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

/// Any PNG file as 8-bit RGBA: palettes and low depths are expanded, of 16 bits the upper 8 are kept, a missing alpha
/// is 255. The error is what is wrong with the file.
pub fn decode(file: impl BufRead + Seek) -> Result<Picture, String> {
    decode_within(file, MOST_PIXELS)
}

/// As [`decode`], for a texture: at most [`MOST_TEXELS`].
pub fn decode_texture(file: impl BufRead + Seek) -> Result<Picture, String> {
    decode_within(file, MOST_TEXELS)
}

/// All in one buffer, allocated when the header has been found good.
fn decode_within(mut file: impl BufRead + Seek, most: u64) -> Result<Picture, String> {
    let length = file.seek(SeekFrom::End(0)).map_err(|error| error.to_string())?;
    file.rewind().map_err(|error| error.to_string())?;
    let mut reader = open(file, length, most)?;
    let (width, height) = reader.info().size();
    let mut pixels = vec![[0; 4]; width as usize * height as usize];
    let frame = (reader.next_frame(pixels.as_flattened_mut())).map_err(unreadable)?;
    // What follows the pixels counts too: their checksum, and the file's end.
    reader.finish().map_err(unreadable)?;
    match frame.color_type {
        ColorType::Rgba => {}
        ColorType::Rgb => spread(&mut pixels, |[r, g, b]| [r, g, b, 255]),
        ColorType::GrayscaleAlpha => spread(&mut pixels, |[v, a]| [v, v, v, a]),
        ColorType::Grayscale => spread(&mut pixels, |[v]| [v, v, v, 255]),
        ColorType::Indexed => return Err("its palette could not be expanded".to_owned()),
    }
    Ok(Picture::new(width, height, pixels))
}

/// Reads the header and refuses what is too large, or larger than what so short a file can hold.
fn open<R: BufRead + Seek>(file: R, length: u64, most: u64) -> Result<Reader<R>, String> {
    let mut decoder = Decoder::new_with_limits(file, Limits { bytes: LARGEST_CHUNK });
    decoder.ignore_checksums(false);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_transformations(Transformations::EXPAND | Transformations::STRIP_16 | Transformations::ALPHA);
    let header = decoder.read_header_info().map_err(unreadable)?;
    let (width, height) = header.size();
    let pixels = u64::from(width) * u64::from(height);
    if width.max(height) > LONGEST_SIDE || pixels > most {
        return Err(format!(
            "{width} x {height} is too large: at most {LONGEST_SIDE} a side and {most} pixels"
        ));
    }
    if pixels * header.bits_per_pixel() as u64 / 8 > length.saturating_mul(DEFLATE) {
        return Err(format!(
            "not a whole PNG file: {width} x {height} pixels cannot come out of {length} bytes"
        ));
    }
    decoder.read_info().map_err(unreadable)
}

/// Makes pixels of the samples that fill the buffer's first part, from the last to the first, so that no sample is
/// overwritten before it is read.
fn spread<const N: usize>(pixels: &mut [[u8; 4]], pixel: impl Fn([u8; N]) -> [u8; 4]) {
    for i in (0..pixels.len()).rev() {
        let mut samples = [0; N];
        samples.copy_from_slice(&pixels.as_flattened()[N * i..N * (i + 1)]);
        pixels[i] = pixel(samples);
    }
}

fn unreadable(error: DecodingError) -> String {
    match error {
        DecodingError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            "not a whole PNG file: it ends too early".to_owned()
        }
        DecodingError::IoError(error) => error.to_string(),
        DecodingError::Format(error) => malformed(&error.to_string()),
        DecodingError::LimitsExceeded => "not a readable PNG file: a part beside its pixels is too large".to_owned(),
        DecodingError::Parameter(_) => "not a readable PNG file: it cannot be decoded".to_owned(),
    }
}

/// What is wrong with a file, from what the decoder says, whose words show how it keeps chunks and are for its authors.
fn malformed(said: &str) -> String {
    const REASONS: [(&str, &str); 6] = [
        ("CRC error", "a checksum is wrong"),
        ("Invalid image dimensions", "its header gives it no pixels"),
        ("Invalid bit depth", "its header is wrong"),
        ("Invalid color", "its header is wrong"),
        ("Missing palette", "its palette is missing"),
        ("Not enough palette", "its palette is too short"),
    ];
    if said.starts_with("Invalid PNG signature") {
        return "not a PNG file".to_owned();
    }
    let reason = REASONS.iter().find(|(beginning, _)| said.starts_with(beginning));
    let reason = reason.map_or("its data is damaged", |(_, reason)| reason);
    format!("not a readable PNG file: {reason}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    fn file(
        color: ColorType,
        depth: png::BitDepth,
        (width, height): (u32, u32),
        data: &[u8],
        palette: Option<(&[u8], &[u8])>,
    ) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, width, height);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if let Some((colors, alphas)) = palette {
            encoder.set_palette(colors.to_vec());
            encoder.set_trns(alphas.to_vec());
        }
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(data).expect("data");
        writer.finish().expect("an end");
        bytes
    }

    #[test]
    fn there_and_back() {
        let pixels = (0..6).map(|i| [i, 2 * i, 255 - i, 40 * i]).collect();
        let picture = Picture::new(3, 2, pixels);
        let bytes = encode(&picture).expect("encoded");
        assert_eq!(decode(Cursor::new(&bytes)), Ok(picture));
    }

    #[test]
    fn every_kind_becomes_rgba() {
        use png::BitDepth::{Eight, One, Sixteen, Two};
        let palette = Some((&[1, 2, 3, 4, 5, 6][..], &[255, 7][..]));
        for (bytes, pixels) in [
            (
                file(ColorType::Grayscale, One, (2, 1), &[0b0100_0000], None),
                [[0, 0, 0, 255], [255; 4]],
            ),
            (
                file(ColorType::Indexed, Two, (2, 1), &[0b0001_0000], palette),
                [[1, 2, 3, 255], [4, 5, 6, 7]],
            ),
            (
                file(ColorType::Rgb, Eight, (2, 1), &[1, 2, 3, 4, 5, 6], None),
                [[1, 2, 3, 255], [4, 5, 6, 255]],
            ),
            (
                file(ColorType::GrayscaleAlpha, Eight, (2, 1), &[1, 2, 3, 4], None),
                [[1, 1, 1, 2], [3, 3, 3, 4]],
            ),
            (
                file(ColorType::Grayscale, Sixteen, (2, 1), &[1, 255, 255, 0], None),
                [[1, 1, 1, 255], [255, 255, 255, 255]],
            ),
        ] {
            let picture = decode(Cursor::new(&bytes)).expect("decoded");
            assert_eq!(picture.pixels, pixels);
        }
    }

    #[test]
    fn an_interlaced_picture_is_put_in_order() {
        // Adam7 of a 2 x 2 greyscale picture: pass 1 holds (0, 0), pass 6 (1, 0), pass 7 the second row.
        let interlaced: &[u8] = &[0, 10, 0, 20, 0, 30, 40];
        let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
        chunk(&mut bytes, b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 2, 8, 0, 0, 0, 1]);
        chunk(&mut bytes, b"IDAT", &stored(interlaced));
        chunk(&mut bytes, b"IEND", &[]);
        let picture = decode(Cursor::new(&bytes)).expect("decoded");
        let grey: Vec<u8> = picture.pixels.iter().map(|pixel| pixel[0]).collect();
        assert_eq!(grey, [10, 20, 30, 40]);
    }

    #[test]
    fn the_header_decides_what_is_too_large() {
        for (width, height, fits) in [
            (16384_u32, 1_u32, true),
            (16385, 1, false),
            (1, 16385, false),
            (16384, 8192, false),
            (u32::MAX >> 1, u32::MAX >> 1, false),
        ] {
            let mut header = Vec::new();
            header.extend(width.to_be_bytes());
            header.extend(height.to_be_bytes());
            header.extend([8, 6, 0, 0, 0]);
            let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
            chunk(&mut bytes, b"IHDR", &header);
            let error = decode(Cursor::new(&bytes)).expect_err("no data follows");
            assert_eq!(!error.contains("too large"), fits, "{width} x {height}: {error}");
        }
    }

    #[test]
    fn cut_off_files_are_refused() {
        let whole = encode(&Picture::new(4, 4, vec![[9, 8, 7, 6]; 16])).expect("encoded");
        for length in 0..whole.len() {
            let cut = &whole[..length];
            assert!(decode(Cursor::new(cut)).is_err(), "{length} bytes");
        }
        assert!(decode(Cursor::new(b"png 8 8 out.png")).is_err());
    }

    #[test]
    fn what_is_wrong_is_said_in_our_words() {
        let whole = encode(&Picture::new(4, 4, vec![[9, 8, 7, 6]; 16])).expect("encoded");
        let mut wrong_sum = whole.clone();
        wrong_sum[29] ^= 1;
        let with = |header: &[u8], data: &[u8]| {
            let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
            chunk(&mut bytes, b"IHDR", header);
            chunk(&mut bytes, b"IDAT", data);
            chunk(&mut bytes, b"IEND", &[]);
            bytes
        };
        let unreadable = |reason: &str| format!("not a readable PNG file: {reason}");
        for (bytes, message) in [
            (b"png 8 8 out.png".to_vec(), "not a PNG file".to_owned()),
            (wrong_sum, unreadable("a checksum is wrong")),
            (
                with(&[0, 0, 0, 0, 0, 0, 0, 2, 8, 6, 0, 0, 0], &[]),
                unreadable("its header gives it no pixels"),
            ),
            (
                with(&[0, 0, 0, 2, 0, 0, 0, 2, 3, 6, 0, 0, 0], &[]),
                unreadable("its header is wrong"),
            ),
            (
                with(&[0, 0, 0, 2, 0, 0, 0, 2, 8, 5, 0, 0, 0], &[]),
                unreadable("its header is wrong"),
            ),
            (
                with(&[0, 0, 0, 2, 0, 0, 0, 2, 8, 3, 0, 0, 0], &stored(&[0; 6])),
                unreadable("its palette is missing"),
            ),
            (
                with(&[0, 0, 0, 2, 0, 0, 0, 2, 8, 0, 0, 0, 0], &[0xFF; 9]),
                unreadable("its data is damaged"),
            ),
        ] {
            assert_eq!(decode(Cursor::new(&bytes)), Err(message));
        }
    }

    fn chunk(bytes: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
        bytes.extend(u32::try_from(data.len()).expect("short").to_be_bytes());
        let start = bytes.len();
        bytes.extend(kind);
        bytes.extend(data);
        let mut crc = u32::MAX;
        for &byte in &bytes[start..] {
            crc ^= u32::from(byte);
            for _ in 0..8 {
                crc = (crc >> 1) ^ (0xEDB8_8320 & 0_u32.wrapping_sub(crc & 1));
            }
        }
        bytes.extend((!crc).to_be_bytes());
    }

    /// A zlib stream of one stored block.
    fn stored(data: &[u8]) -> Vec<u8> {
        let length = u16::try_from(data.len()).expect("short");
        let mut bytes = vec![0x78, 0x01, 1];
        bytes.extend(length.to_le_bytes());
        bytes.extend((!length).to_le_bytes());
        bytes.extend(data);
        let (mut a, mut b) = (1_u32, 0_u32);
        for &byte in data {
            a = (a + u32::from(byte)) % 65521;
            b = (b + a) % 65521;
        }
        bytes.extend(((b << 16) | a).to_be_bytes());
        bytes
    }
}
