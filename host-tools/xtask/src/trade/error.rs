//! How far the core's colours are from float64's.

use fixel_workloads::tiers::canvas::{HEIGHT, WIDTH};
use fixel_workloads::tiers::color::{Fine, Output};

use super::reference::Picture;

/// Errors of a picture, each the largest of a pixel's three channels, in levels of 255.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// The largest.
    pub max: f64,
    /// All but a thousandth are at most this.
    pub p999: f64,
    /// Their mean.
    pub mean: f64,
    /// Share of pixels that RGB565 shows otherwise.
    pub differing: f64,
}

impl Errors {
    /// Of the pixels that both have drawn, and that show the same triangle wherever within the snapping their middle is.
    pub fn of(fine: &[Fine], reference: &Picture) -> Option<Self> {
        Self::of_colors(&pairs(fine, reference).flatten().collect::<Vec<_>>())
    }

    /// Of the means of 4×4 such pixels.
    pub fn of_means(fine: &[Fine], reference: &Picture) -> Option<Self> {
        const SIDE: usize = 4;
        let pairs: Vec<_> = pairs(fine, reference).collect();
        let width = usize::from(WIDTH);
        let corners = (0..usize::from(HEIGHT)).step_by(SIDE);
        let corners = corners.flat_map(|y| (0..width).step_by(SIDE).map(move |x| y * width + x));
        let means = corners.filter_map(|corner| {
            let block = (0..SIDE * SIDE).map(|i| corner + i / SIDE * width + i % SIDE);
            let block: Vec<Pair> = block.map(|i| *pairs.get(i)?).collect::<Option<_>>()?;
            let mean = |of: fn(&Pair) -> [f64; 3]| {
                let sum = |channel: usize| block.iter().map(|pair| of(pair)[channel]).sum::<f64>();
                [0, 1, 2].map(|channel| sum(channel) / (SIDE * SIDE) as f64)
            };
            Some((mean(|pair| pair.0), mean(|pair| pair.1)))
        });
        Self::of_colors(&means.collect::<Vec<_>>())
    }

    /// Of pairs of colours in levels of 255; `None` of none.
    fn of_colors(colors: &[Pair]) -> Option<Self> {
        let largest = |(color, exact): &Pair| {
            let errors = color.iter().zip(exact).map(|(a, b)| (a - b).abs());
            errors.fold(0.0, f64::max)
        };
        let mut errors: Vec<f64> = colors.iter().map(largest).collect();
        errors.sort_by(f64::total_cmp);
        let count = errors.len() as f64;
        Some(Errors {
            max: *errors.last()?,
            p999: *errors.get((count * 0.999) as usize)?,
            mean: errors.iter().sum::<f64>() / count,
            differing: colors.iter().filter(|(a, b)| rgb565(*a) != rgb565(*b)).count() as f64 / count,
        })
    }
}

/// A colour and what it should be, in levels of 255.
type Pair = ([f64; 3], [f64; 3]);

/// The colours of every pixel that both have drawn and that is sure.
fn pairs(fine: &[Fine], reference: &Picture) -> impl Iterator<Item = Option<Pair>> {
    let levels = |Fine(channels): &Fine| channels.map(|c| f64::from(c) / 65536.0);
    let pairs = fine.iter().zip(reference.sure());
    pairs.map(move |(fine, exact)| (*fine != Fine::EMPTY).then_some((levels(fine), exact?)))
}

/// The nearest levels of RGB565.
fn rgb565(color: [f64; 3]) -> [i32; 3] {
    let most = [31.0, 63.0, 31.0];
    std::array::from_fn(|i| (color[i] * most[i] / 255.0).round().clamp(0.0, most[i]) as i32)
}

#[cfg(test)]
mod tests {
    use fixel_workloads::tiers::geometry::Models;

    use super::*;

    #[test]
    fn errors_are_the_largest_channel_s() {
        let mut colors = vec![([10.0; 3], [10.0; 3]); 1_999];
        colors.push(([10.0, 20.0, 30.0], [11.0, 24.0, 28.0]));
        let errors = Errors::of_colors(&colors);
        assert_eq!(
            errors,
            Some(Errors {
                max: 4.0,
                p999: 0.0,
                mean: 0.002,
                differing: 0.0005
            })
        );
        assert_eq!(Errors::of_colors(&[]), None);
    }

    /// A picture of angles, each pixel off by what `off` says of its place.
    fn errors_with(off: impl Fn(usize) -> f64) -> [f64; 2] {
        let picture = Picture::named("sines", &Models::new(), 0.0).unwrap();
        let pixels = picture.sure().enumerate();
        let fine = pixels.map(|(i, exact)| Fine(exact.unwrap().map(|c| ((c + off(i)) * 65536.0).round() as i32)));
        let fine: Vec<_> = fine.collect();
        [Errors::of(&fine, &picture), Errors::of_means(&fine, &picture)].map(|errors| errors.unwrap().mean)
    }

    #[test]
    fn what_4_by_4_pixels_make_up_for_is_no_error_of_their_mean() {
        let board = |i: usize| {
            if (i + i / usize::from(WIDTH)).is_multiple_of(2) {
                8.0
            } else {
                -8.0
            }
        };
        let [pixel, mean] = errors_with(board);
        assert!((pixel - 8.0).abs() < 1e-4 && mean < 1e-4, "{pixel}, {mean}");
        let [pixel, mean] = errors_with(|_| 3.0);
        assert!(
            (pixel - 3.0).abs() < 1e-4 && (mean - 3.0).abs() < 1e-4,
            "{pixel}, {mean}"
        );
    }

    #[test]
    fn rgb565_rounds_to_the_nearest_level() {
        assert_eq!(rgb565([4.0, 2.0, 251.0]), [0, 0, 31]);
        assert_eq!(rgb565([4.2, 2.1, 300.0]), [1, 1, 31]);
    }
}
