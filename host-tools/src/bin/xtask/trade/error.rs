//! How far the core's colours are from float64's.

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
        let pairs = fine
            .iter()
            .zip(reference.sure())
            .filter(|(fine, _)| **fine != Fine::EMPTY);
        let levels = |Fine(channels): &Fine| channels.map(|c| f64::from(c) / 65536.0);
        let pairs = pairs.filter_map(|(fine, exact)| Some((levels(fine), exact?)));
        Self::of_colors(&pairs.collect::<Vec<_>>())
    }

    /// Of pairs of colours in levels of 255; `None` of none.
    fn of_colors(colors: &[([f64; 3], [f64; 3])]) -> Option<Self> {
        let largest = |(color, exact): &([f64; 3], [f64; 3])| {
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

/// The nearest levels of RGB565.
fn rgb565(color: [f64; 3]) -> [i32; 3] {
    let most = [31.0, 63.0, 31.0];
    std::array::from_fn(|i| (color[i] * most[i] / 255.0).round().clamp(0.0, most[i]) as i32)
}

#[cfg(test)]
mod tests {
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

    #[test]
    fn rgb565_rounds_to_the_nearest_level() {
        assert_eq!(rgb565([4.0, 2.0, 251.0]), [0, 0, 31]);
        assert_eq!(rgb565([4.2, 2.1, 300.0]), [1, 1, 31]);
    }
}
