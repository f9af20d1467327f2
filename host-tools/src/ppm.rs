//! Plain PPM files: pictures as text, without alpha.

use std::io::{self, Write};

/// Writes pixels as `P3`, one in a line, so that no line is longer than the format advises. Alpha is left out: what is
/// invisible is black in every picture of ours.
///
/// # Errors
/// Those of `out`, which is flushed: what it could not take shows here.
pub fn write(
    mut out: impl Write,
    [width, height]: [u32; 2],
    pixels: impl IntoIterator<Item = [u8; 4]>,
) -> io::Result<()> {
    write!(out, "P3\n{width} {height}\n255\n")?;
    for [r, g, b, _] in pixels {
        writeln!(out, "{r} {g} {b}")?;
    }
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_row_by_row() {
        let mut out = Vec::new();
        let pixels = [[0, 0, 0, 0], [1, 20, 255, 255]];
        write(&mut out, [1, 2], pixels).expect("memory");
        assert_eq!(out, b"P3\n1 2\n255\n0 0 0\n1 20 255\n");
    }

    #[test]
    fn what_is_only_noticed_at_the_end_is_noticed() {
        let mut room = [0; 8];
        let out = io::BufWriter::new(&mut room[..]);
        assert!(write(out, [1, 1], [[0; 4]]).is_err());
    }
}
