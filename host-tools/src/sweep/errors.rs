//! How far a picture is from float64's, in levels of 255.

use std::iter;

use crate::compare::picture::Pixel;
use crate::fixed::FixedPicture;
use crate::fixed::output::Output;

/// Errors over the pixels that either picture draws. A pixel's error is the largest difference of its four bytes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Errors {
    /// The largest.
    pub max: u8,
    /// What 99.9 % of the pixels do not exceed.
    pub p999: u8,
    /// Their mean.
    pub mean: f64,
    /// The share of pixels that differ, 0 to 1.
    pub differing_share: f64,
    /// Pixels covered in exactly one of the two pictures.
    pub coverage_differs: u64,
    /// The mean error of the means over 4 × 4 pixels, of those that both pictures draw wholly: what the eye is to make of dither,
    /// whose cells these are. `None` where there are none.
    pub mean_4x4: Option<f64>,
}

impl Errors {
    /// Of the core's picture against the reference's bytes, which differ in the coverage of so many pixels.
    pub fn new(fixed: &FixedPicture, reference: &[[u8; 4]], coverage_differs: u64) -> Self {
        let pixels = fixed.pixels.iter().zip(reference);
        let drawn = pixels.filter(|(pixel, bytes)| pixel.primitive != 0 || **bytes != [0; 4]);
        let error = |a: [u8; 4], b: [u8; 4]| a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max();
        let mut errors: Vec<u8> = drawn
            .map(|(pixel, bytes)| error(pixel.rgba, *bytes).unwrap_or_default())
            .collect();
        errors.sort_unstable();
        Errors {
            coverage_differs,
            mean_4x4: mean_4x4(fixed, reference),
            ..Self::of_sorted(&errors)
        }
    }

    fn of_sorted(errors: &[u8]) -> Self {
        let count = errors.len();
        let sum: u64 = errors.iter().copied().map(u64::from).sum();
        let differing = count - errors.partition_point(|&error| error == 0);
        // The smallest that 999 of 1000 do not exceed.
        let p999 = (count * 999).div_ceil(1000).checked_sub(1);
        let share = |part: f64| part / count.max(1) as f64;
        Errors {
            max: errors.last().copied().unwrap_or(0),
            p999: p999.and_then(|at| errors.get(at)).copied().unwrap_or(0),
            mean: share(sum as f64),
            differing_share: share(differing as f64),
            coverage_differs: 0,
            mean_4x4: None,
        }
    }
}

/// See [`Errors::mean_4x4`].
fn mean_4x4(fixed: &FixedPicture, reference: &[[u8; 4]]) -> Option<f64> {
    let width = fixed.width as usize;
    let cells = (0..fixed.height as usize / 4).flat_map(|y| (0..width / 4).map(move |x| (4 * x, 4 * y)));
    let errors: Vec<f64> = cells
        .filter_map(|(x, y)| {
            let of_cell = |row: usize| (y + row) * width + x..(y + row) * width + x + 4;
            let pixels = (0..4).flat_map(|row| iter::zip(&fixed.pixels[of_cell(row)], &reference[of_cell(row)]));
            cell_error(pixels)
        })
        .collect();
    (!errors.is_empty()).then(|| errors.iter().sum::<f64>() / errors.len() as f64)
}

/// The largest difference of the four channels' means; `None` where a pixel is not drawn in both pictures.
fn cell_error<'a>(pixels: impl Iterator<Item = (&'a Pixel, &'a [u8; 4])>) -> Option<f64> {
    let mut sums = [0i32; 4];
    for (pixel, bytes) in pixels {
        if pixel.primitive == 0 || *bytes == [0; 4] {
            return None;
        }
        for ((sum, a), b) in sums.iter_mut().zip(pixel.rgba).zip(bytes) {
            *sum += i32::from(a) - i32::from(*b);
        }
    }
    sums.map(i32::abs).into_iter().max().map(|sum| f64::from(sum) / 16.0)
}

/// What a picture is held against that is shown on `output`: of one without colours, float64's brightness by Rec. 601.
pub fn wanted(reference: &[[u8; 4]], output: Output) -> Vec<[u8; 4]> {
    let gray = |&[red, green, blue, alpha]: &[u8; 4]| {
        let brightness = 0.299 * f64::from(red) + 0.587 * f64::from(green) + 0.114 * f64::from(blue);
        let level = brightness.round() as u8;
        [level, level, level, alpha]
    };
    match output {
        Output::OneBit => reference.iter().map(gray).collect(),
        Output::Bytes | Output::Rgb565 | Output::Dithered565 => reference.to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_figures() {
        let mut errors = vec![0; 1998];
        errors.extend([7, 200]);
        assert_eq!(
            Errors::of_sorted(&errors),
            Errors {
                max: 200,
                p999: 0,
                mean: 207.0 / 2000.0,
                differing_share: 0.001,
                coverage_differs: 0,
                mean_4x4: None,
            }
        );
        // Of 999 pixels the worst counts: 998 are less than 99.9 %.
        assert_eq!(Errors::of_sorted(&errors[1001..]).p999, 200);
        assert_eq!(Errors::of_sorted(&[0, 7]).p999, 7);
        assert_eq!(Errors::of_sorted(&[]), Errors::default());
    }

    /// 9 × 4 pixels, so that the last column is in no cell.
    fn picture(reds: impl Fn(usize) -> u8) -> FixedPicture {
        let pixel = |i| Pixel {
            rgba: [reds(i), 0, 0, 255],
            primitive: 1,
        };
        FixedPicture {
            width: 9,
            height: 4,
            pixels: (0..36).map(pixel).collect(),
            depth: vec![0; 36],
        }
    }

    #[test]
    fn what_dither_mixes_is_right_in_the_mean() {
        let reference = [[8, 0, 0, 255]; 36];
        // Every second row 16 and 0.
        let mut striped = picture(|i| 16 * (i / 9 % 2) as u8);
        let errors = Errors::new(&striped, &reference, 0);
        assert_eq!((errors.max, errors.mean, errors.mean_4x4), (8, 8.0, Some(0.0)));
        // A pixel of the first cell 16 brighter is 1 in its mean, and half of that in the mean of two cells.
        striped.pixels[0].rgba[0] = 16;
        assert_eq!(Errors::new(&striped, &reference, 0).mean_4x4, Some(0.5));
        // A cell that is not wholly drawn does not count.
        striped.pixels[1].primitive = 0;
        assert_eq!(Errors::new(&striped, &reference, 0).mean_4x4, Some(0.0));
        striped.pixels[5].primitive = 0;
        assert_eq!(Errors::new(&striped, &reference, 0).mean_4x4, None);
    }

    #[test]
    fn black_and_white_are_held_against_brightness() {
        let colors = [[255, 255, 255, 255], [255, 0, 0, 9]];
        assert_eq!(wanted(&colors, Output::OneBit), [[255; 4], [76, 76, 76, 9]]);
        assert_eq!(wanted(&colors, Output::Dithered565), colors);
    }
}
