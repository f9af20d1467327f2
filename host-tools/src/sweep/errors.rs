//! How far a picture is from float64's, in levels of 255.

use crate::compare::Comparison;
use crate::fixed::FixedPicture;

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
}

impl Errors {
    /// Of the core's picture against the reference's bytes.
    pub fn new(fixed: &FixedPicture, reference: &[[u8; 4]], comparison: &Comparison) -> Self {
        let pixels = fixed.pixels.iter().zip(reference);
        let drawn = pixels.filter(|(pixel, bytes)| pixel.primitive != 0 || **bytes != [0; 4]);
        let error = |a: [u8; 4], b: [u8; 4]| a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max();
        let mut errors: Vec<u8> = drawn
            .map(|(pixel, bytes)| error(pixel.rgba, *bytes).unwrap_or_default())
            .collect();
        errors.sort_unstable();
        Errors {
            coverage_differs: comparison.coverage_differs,
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
        }
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
            }
        );
        // Of 999 pixels the worst counts: 998 are less than 99.9 %.
        assert_eq!(Errors::of_sorted(&errors[1001..]).p999, 200);
        assert_eq!(Errors::of_sorted(&[0, 7]).p999, 7);
        assert_eq!(Errors::of_sorted(&[]), Errors::default());
    }
}
